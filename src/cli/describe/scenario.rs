//! What a scenario would grow and keep, with what is expected of it.
//!
//! The laws of its species are told with it, since they are half of what a scenario means. Absent: anything grown.

use super::super::amounts;
use super::dates;
use super::run::ages_in_words;
use anyhow::Result;
use phytomer::run::forecast::{Figure, Forecast};
use phytomer_config::scenario::Table;
use phytomer_config::{Resolved, Scenario};
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
    for species in resolved.all_species() {
        line("species", format!("{} ({})", species.about.name, species.model.name().word()));
    }
    line("plants", plants_in_words(scenario));
    for plane in &scenario.site.plane {
        line("plane", format!("through {:?} m, kills the buds towards {:?}", plane.point_m, plane.normal));
    }
    let ticks: BTreeSet<&str> = resolved.all_species().iter().map(|species| species.about.tick.as_str()).collect();
    line("tick", ticks.into_iter().collect::<Vec<_>>().join(", "));
    resolved.dated.iter().flat_map(dates::lines).for_each(|(name, value)| line(name, value));
    line("ages", ages_in_words(&scenario.ages.recorded(), scenario.ages.until));
    line("seed", scenario.seed.to_string());
    line("tables", tables_in_words(&scenario.written_tables()));
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
    text
}

/// How many plants there are, in how many plots of which members.
fn plants_in_words(scenario: &Scenario) -> String {
    let plants = amounts::count(scenario.plants.into());
    if scenario.member.is_empty() {
        return plants;
    }
    let plots = amounts::of(scenario.plots().into(), "plot");
    let later = scenario.member.iter().filter(|member| member.sown > 0).count();
    let sown = if later > 0 { format!(", {later} of them sown later") } else { String::new() };
    format!("{plants}, in {plots} of {}{sown}", amounts::of(scenario.members().into(), "plant"))
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
            let plants = (0..scenario.plants).filter(|plant| scenario.draws(*plant)).count();
            format!("{} at age {}", amounts::of(plants as u64, "plant"), ages.join(", "))
        }
    }
}
