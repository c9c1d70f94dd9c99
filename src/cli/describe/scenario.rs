//! What a scenario would grow and keep, with what is expected of it.
//!
//! The laws of its species are told with it, since they are half of what a scenario means. Absent: anything grown.

use super::super::amounts;
use super::dates;
use super::levels;
use super::run::ages_in_words;
use anyhow::Result;
use phytomer::run::forecast::{Figure, Forecast};
use phytomer_config::Resolved;
use phytomer_config::scenario::{Design, Planting, Soil, Stems, Table};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// The scenario, its species and its forecast.
///
/// # Errors
/// A number that JSON cannot hold, which no checked run has.
pub fn as_json(resolved: &Resolved) -> Result<Value> {
    let mut json = resolved.to_json()?;
    json["kind"] = "scenario".into();
    json["treatments"] = serde_json::to_value(resolved.trial().treatments())?;
    json["expected"] = json!(Forecast::of(resolved));
    Ok(json)
}

pub fn as_text(resolved: &Resolved) -> String {
    let scenario = &resolved.scenario;
    let mut text = format!("{}: a scenario\n", scenario.name);
    if let Some(description) = &scenario.description {
        let _ = writeln!(text, "  {}", description.split_whitespace().collect::<Vec<_>>().join(" "));
    }
    let mut line = |name: &str, value: String| {
        let _ = writeln!(text, "  {name:<11} {value}");
    };
    for species in resolved.distinct_species() {
        line("species", format!("{} ({})", species.about.name, species.model.name().word()));
    }
    line("plants", plants_in_words(resolved));
    for (name, value) in planting_in_words(&scenario.planting) {
        line(name, value);
    }
    for plane in &scenario.site.plane {
        line("plane", format!("through {:?} m, kills the buds towards {:?}", plane.point_m, plane.normal));
    }
    if scenario.site.ground {
        line("ground", "shoots meet it".to_owned());
    }
    match scenario.site.stems {
        None => {}
        Some(Stems::Neighbours) => line("stems", "shoots meet those of the other plants of their plot".to_owned()),
        Some(Stems::All) => line("stems", "shoots meet those of all plants of their plot".to_owned()),
    }
    match scenario.site.obstacle.iter().filter(|obstacle| obstacle.blocks.is_some()).count() {
        0 => {}
        some => line("obstacles", format!("{some} that shoots meet")),
    }
    for event in &scenario.event {
        line("event", event.in_words());
    }
    let ticks: BTreeSet<&str> = resolved.all_species().iter().map(|species| species.about.tick.as_str()).collect();
    line("tick", ticks.into_iter().collect::<Vec<_>>().join(", "));
    // Where treatments differ in their dates, each tells its own.
    let is_one = have_one_calendar(resolved);
    let of_all = resolved.calendars.first().into_iter().flatten().filter(|_| is_one);
    of_all.flat_map(dates::lines).for_each(|(name, value)| line(name, value));
    if let Some(soil) = soil_in_words(scenario.soil.as_ref()) {
        line("soil", soil);
    }
    line("ages", ages_in_words(&scenario.ages.recorded(), scenario.ages.until));
    line("seed", scenario.seed.to_string());
    line("tables", tables_in_words(&scenario.written_tables()));
    if scenario.sample.is_some() {
        let plants = amounts::of(scenario.sampled().into(), "plant");
        line("sample", format!("components, records and events of {plants}, summary and plants of all"));
    }
    line("meshes", meshes_in_words(resolved));
    if let Some(forecast) = Forecast::of(resolved) {
        line(
            "expected",
            format!(
                "{}, {}",
                foretold(forecast.components_are, forecast.components, "components"),
                foretold(forecast.records_rows_are, forecast.records_rows, "rows of records")
            ),
        );
    }
    text += &treatments_in_words(resolved);
    text
}

/// Whether all treatments have the same dates.
fn have_one_calendar(resolved: &Resolved) -> bool {
    resolved.calendars.windows(2).all(|pair| pair[0] == pair[1])
}

/// The treatments of an experiment: the name of each, the plants of a replicate, and what its levels set, as given and
/// in SI units.
fn treatments_in_words(resolved: &Resolved) -> String {
    let (trial, experiment) = (resolved.trial(), &resolved.scenario.experiment);
    if trial.treatments().len() == 1 && trial.replicates() == 1 {
        return String::new();
    }
    let design = match experiment.experimental_design {
        Design::CompletelyRandomised => "completely randomised",
        Design::RandomisedBlocks => "in randomised blocks",
    };
    let (treatments, replicates) = (trial.treatments().len() as u64, u64::from(trial.replicates()));
    let (treatments, replicates) = (amounts::of(treatments, "treatment"), amounts::of(replicates, "replicate"));
    let mut text = format!("\n  {treatments}, {replicates} of each, {design}\n");
    let is_one = have_one_calendar(resolved);
    for (place, treatment) in trial.treatments().iter().enumerate() {
        let plants = amounts::of(treatment.scenario.plants.into(), "plant");
        let levels = experiment.factor.iter().zip(&treatment.levels);
        let sets = levels.filter_map(|(factor, name)| factor.level.iter().find(|level| level.name == *name));
        let sets: Vec<String> = sets.flat_map(|level| levels::lines(&level.sets)).collect();
        let alike = if sets.is_empty() { "; the scenario as it stands" } else { "" };
        let _ = writeln!(text, "    {}: {plants} a replicate{alike}", treatment.name);
        sets.iter().for_each(|set| _ = writeln!(text, "      {set}"));
        let dates = resolved.calendars.get(place).into_iter().flatten().filter(|_| !is_one).flat_map(dates::lines);
        for (name, value) in dates {
            let _ = writeln!(text, "      {name:<11} {value}");
        }
    }
    text
}

/// How the nitrogen of the soil differs between blocks and field plots; `None` where it does not.
fn soil_in_words(soil: Option<&Soil>) -> Option<String> {
    let differs = |between: &str, sd: f64| {
        (sd > 0.0).then(|| format!("between {between} with a standard deviation of {sd} kg/ha"))
    };
    let Soil { nitrogen_kg_ha, block_sd_kg_ha, field_plot_sd_kg_ha, .. } = soil?;
    let each = [differs("blocks", *block_sd_kg_ha), differs("field plots", *field_plot_sd_kg_ha)];
    let each: Vec<String> = each.into_iter().flatten().collect();
    (!each.is_empty()).then(|| format!("supplies {nitrogen_kg_ha} kg N/ha, which differs {}", each.join(" and ")))
}

/// What is said of planting, in the units of ICASA and in SI.
fn planting_in_words(planting: &Planting) -> Vec<(&'static str, String)> {
    let cm = |name: &'static str, what: Option<f64>| what.map(|cm| (name, format!("{cm} cm ({} m)", cm / 100.0)));
    let density = planting.plant_pop_at_planting;
    let density = density.map(|density| ("density", format!("{density} plants/m² ({density} m⁻²)")));
    let direction = (planting.row_direction != 0.0).then(|| {
        let degrees = planting.row_direction;
        ("rows run", format!("towards {degrees}° from north ({:.4} rad)", degrees.to_radians()))
    });
    let germination = (planting.germination < 100.0)
        .then(|| ("germination", format!("{} % (a share of {})", planting.germination, planting.germination / 100.0)));
    let stated =
        [cm("rows", planting.row_spacing), cm("in a row", planting.plant_spacing), density, direction, germination];
    stated.into_iter().flatten().collect()
}

/// How many plants there are, in how many plots of which members.
fn plants_in_words(resolved: &Resolved) -> String {
    let (scenario, trial) = (&resolved.scenario, resolved.trial());
    let plants = amounts::count(trial.plants().into());
    let members = scenario.stated_members();
    if members.is_empty() || trial.treatments().len() > 1 {
        return plants;
    }
    let plots = amounts::of(trial.plots().into(), "plot");
    let later = members.iter().filter(|member| member.sown > 0).count();
    let sown = if later > 0 { format!(", {later} of them sown later") } else { String::new() };
    let successors = members.iter().filter(|member| member.replaces.is_some()).count();
    let waiting = match successors {
        0 => String::new(),
        1 => ", 1 of them a successor".to_owned(),
        _ => format!(", {successors} of them successors"),
    };
    format!("{plants}, in {plots} of {}{sown}{waiting}", amounts::of(scenario.members().into(), "plant"))
}

/// A number of the forecast with what it is.
fn foretold(figure: Figure, value: f64, unit: &str) -> String {
    let words = [figure.word(), &amounts::about(value), unit];
    words.into_iter().filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
}

fn tables_in_words(tables: &BTreeSet<Table>) -> String {
    let word = |table: &Table| match table {
        Table::Components => "components",
        Table::Records => "records",
        Table::Events => "events",
        Table::Summary => "summary",
        Table::Plants => "plants",
        Table::Treatments => "treatments",
        Table::Site => "site",
    };
    let words: Vec<&str> = tables.iter().map(word).collect();
    if words.is_empty() { "none".to_owned() } else { words.join(", ") }
}

fn meshes_in_words(resolved: &Resolved) -> String {
    let scenario = &resolved.scenario;
    let ages: Vec<String> = scenario.mesh_ages().iter().map(u32::to_string).collect();
    match &scenario.meshes {
        None => "none".to_owned(),
        Some(_) => {
            let plants = (0..resolved.trial().plants()).filter(|plant| scenario.draws(*plant)).count();
            format!("{} at age {}", amounts::of(plants as u64, "plant"), ages.join(", "))
        }
    }
}
