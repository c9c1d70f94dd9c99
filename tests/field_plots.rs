//! Field plots that differ: soils that blocks and field plots shift, replicates in years of their own, and members that
//! are sown at several ticks. Each plant must be the one that it would be in a run where nothing of this differs.
//!
//! The species has laws of the date, so it is compiled for each of them. The files are read by the parquet crate alone.

mod program;
mod read;

use program::{contents, hashes, run, write};
use read::Columns;
use std::fs;
use std::ops::Range;
use std::path::Path;

const SPECIES: &str = include_str!("../config/tests/weather/dated.toml");
const BASE: &str = "name = \"NAME\"\nspecies = \"species.toml\"\nplants = 3\nages = { until = 12 }\n\
    output = { plants_per_part = 4 }\nplanting_date = \"2001-02-01\"\n\
    calendar = { tick = { days = 10 }, degree_days = { method = \"average\", base_celsius = 10 } }\n";
const WEATHER: &str = "weather = { file = \"years.csv\" }\n";
const FACTOR: &str = "[[experiment.factor]]\nname = \"nitrogen\"\nlevel = [{ name = \"poor\" }, { name = \"rich\", soil = { nitrogen_kg_ha = 60 } }]\n";
/// The supply of the two levels, kg/ha.
const SUPPLIES: [f64; 2] = [30.0, 60.0];
const REPLICATES: u32 = 3;

/// Soils with these standard deviations, in randomised blocks.
fn shifted(sds: &str) -> String {
    format!(
        "{BASE}{WEATHER}soil = {{ nitrogen_kg_ha = 30{sds} }}\n[experiment]\nexperimental_design = \"randomised_blocks\"\n\
         replicates = {REPLICATES}\n{FACTOR}"
    )
}

/// Two years of steady weather, the second 5 °C colder than the first.
fn home() -> tempfile::TempDir {
    let home = tempfile::tempdir().expect("a temporary folder");
    let mut years = "WST_LAT,YEAR,DOY,TMAX,TMIN\n".to_owned();
    for (year, celsius) in [(2001, 25), (2002, 20)] {
        (1..=365).for_each(|day| years += &format!("-20.0,{year},{day},{celsius},{celsius}\n"));
    }
    write(home.path(), "species.toml", SPECIES);
    write(home.path(), "years.csv", &years);
    home
}

fn grown(home: &Path, name: &str, scenario: &str, more: &[&str]) {
    write(home, &format!("{name}.toml"), &scenario.replace("NAME", name));
    let file = format!("{name}.toml");
    run(home, &[&["grow", &file, "--quiet"], more].concat()).ending(0);
}

/// The rows of `records` of some plants of a run, without what names the plants.
fn records(home: &Path, name: &str, plants: Range<u32>) -> Vec<Vec<u64>> {
    let table = Columns::of(&home.join("runs").join(name), "records");
    let of = |row: &usize| plants.contains(&(table.numbers("plant_id")[*row] as u32));
    let columns = ["tick", "age", "component_id", "axis_id", "birth_age", "x_m", "z_m", "length_m", "area_m2"];
    let rows = (0..table.numbers("tick").len()).filter(of);
    rows.map(|row| columns.map(|column| table.numbers(column)[row].to_bits()).to_vec()).collect()
}

/// The nitrogen of each field plot by treatment and replicate. Nothing is applied, so it is the same at all ticks.
fn supplies(home: &Path, name: &str) -> Vec<Vec<f64>> {
    let site = Columns::of(&home.join("runs").join(name), "site");
    let mut supplies = vec![vec![f64::NAN; REPLICATES as usize]; 2];
    for (row, treatment) in site.words("treatment").iter().enumerate() {
        let (replicate, nitrogen) = (site.numbers("replicate")[row] as usize, site.numbers("nitrogen_kg_ha")[row]);
        let known = &mut supplies[usize::from(treatment == "rich")][replicate];
        assert!(known.is_nan() || *known == nitrogen, "{treatment}, replicate {replicate}: {known} and {nitrogen}");
        *known = nitrogen;
    }
    supplies
}

#[test]
fn each_field_plot_grows_as_it_would_on_a_field_of_its_soil() {
    let home = home();
    grown(home.path(), "trial", &shifted(", block_sd_kg_ha = 8, field_plot_sd_kg_ha = 4"), &[]);
    let supplies = supplies(home.path(), "trial");
    let mut all: Vec<f64> = supplies.concat();
    all.sort_by(f64::total_cmp);
    assert!(all.windows(2).all(|pair| pair[0] < pair[1]), "each field plot has a soil of its own: {supplies:?}");
    let mut seen = Vec::new();
    for (treatment, of_treatment) in (0..).zip(&supplies) {
        for (replicate, supply) in (0..).zip(of_treatment) {
            let alone = format!("alone_{treatment}_{replicate}");
            let soil = format!(
                "{BASE}{WEATHER}soil = {{ nitrogen_kg_ha = {supply} }}\nexperiment = {{ replicates = {REPLICATES} }}\n"
            );
            grown(home.path(), &alone, &soil, &[]);
            let first = 3 * (REPLICATES * treatment + replicate);
            let of_trial = records(home.path(), "trial", first..first + 3);
            assert_eq!(of_trial, records(home.path(), &alone, 3 * replicate..3 * replicate + 3), "{alone}");
            assert!(of_trial.len() > 40, "{alone}: {} rows", of_trial.len());
            seen.push(of_trial);
        }
    }
    assert!((1..seen.len()).all(|k| seen[..k].iter().all(|other| *other != seen[k])), "no two grow alike");
}

#[test]
fn a_block_shifts_all_its_treatments_alike() {
    let home = home();
    let differences = |name: &str, sds: &str| {
        grown(home.path(), name, &shifted(sds), &[]);
        let supplies = supplies(home.path(), name);
        let each =
            |replicate: usize| [0, 1].map(|treatment: usize| supplies[treatment][replicate] - SUPPLIES[treatment]);
        (0..REPLICATES as usize).map(each).collect::<Vec<_>>()
    };
    let of_blocks = differences("blocks", ", block_sd_kg_ha = 5");
    assert!(of_blocks.iter().all(|[poor, rich]| (poor - rich).abs() < 1e-9 && poor.abs() > 1e-3), "{of_blocks:?}");
    let of_field_plots = differences("field_plots", ", field_plot_sd_kg_ha = 5");
    assert!(of_field_plots.iter().all(|[poor, rich]| (poor - rich).abs() > 1e-3), "{of_field_plots:?}");
    assert_eq!(differences("none", ""), vec![[0.0; 2]; REPLICATES as usize]);
    // Without differences a replicate that is the first grows as in the run without experiment.
    grown(home.path(), "alone", &format!("{BASE}{WEATHER}soil = {{ nitrogen_kg_ha = 30 }}\n"), &[]);
    assert_eq!(records(home.path(), "none", 0..3), records(home.path(), "alone", 0..3));
}

#[test]
fn a_seed_of_the_command_line_draws_its_own_soils() {
    let home = home();
    let scenario = shifted(", block_sd_kg_ha = 8, field_plot_sd_kg_ha = 4");
    grown(home.path(), "first", &scenario, &[]);
    grown(home.path(), "stated", &format!("seed = 7\n{scenario}"), &[]);
    grown(home.path(), "again", &scenario, &["--seed", "7"]);
    let [first, stated, again] = ["first", "stated", "again"].map(|name| supplies(home.path(), name));
    assert!(stated == again && first != again, "{first:?}, {stated:?}, {again:?}");
    assert_eq!(records(home.path(), "stated", 0..18), records(home.path(), "again", 0..18));
}

#[test]
fn replicates_grow_in_years_of_their_own() {
    let home = home();
    let soil = "soil = { nitrogen_kg_ha = 30 }\n\
                fertilizer = [{ fertilization_date = \"2001-04-01\", N_in_applied_fertilizer = 40 }]\n";
    let of_years = |years: &str| {
        let weather = format!("weather = {{ file = \"years.csv\", years = {years} }}\n");
        format!("{BASE}{weather}{soil}experiment = {{ replicates = 2 }}\n")
    };
    grown(home.path(), "years", &of_years("\"replicates\""), &[]);
    grown(home.path(), "turned", &of_years("[2002, 2001]"), &[]);
    let site = Columns::of(&home.path().join("runs/years"), "site");
    let mut rows = [0; 2];
    for row in 0..site.numbers("tick").len() {
        let at = |name: &str| site.numbers(name)[row];
        let replicate = at("replicate") as usize;
        assert_eq!(at("date"), [11_354.0, 11_719.0][replicate] + 10.0 * at("tick"), "2001-02-01 and 2002-02-01");
        assert_eq!(at("degree_day_sum"), [150.0, 100.0][replicate] * at("tick"));
        assert_eq!(at("nitrogen_kg_ha"), if at("tick") < 6.0 { 30.0 } else { 70.0 }, "tick {}", at("tick"));
        rows[replicate] += 1;
    }
    assert!(rows.iter().all(|rows| *rows >= 12), "{rows:?}");
    let later = |text: String| text.replace("2001-0", "2002-0");
    let whole = format!("{BASE}{WEATHER}{soil}experiment = {{ replicates = 2 }}\n");
    grown(home.path(), "early", &whole, &[]);
    grown(home.path(), "late", &later(whole), &[]);
    let of = |name: &str, replicate: u32| records(home.path(), name, 3 * replicate..3 * replicate + 3);
    assert_eq!((of("years", 0), of("years", 1)), (of("early", 0), of("late", 1)));
    assert_eq!((of("turned", 0), of("turned", 1)), (of("late", 0), of("early", 1)));
    assert_ne!(of("early", 1), of("late", 1), "a colder year");
}

/// Days of events and of pests are those of the year in which a replicate grows, and belong to the ticks of its own
/// calendar, also where the species has no laws of the date: 300 °C d take 20 days at 25 °C and 30 at 20 °C.
#[test]
fn days_of_events_and_pests_move_with_the_years_of_replicates() {
    let home = home();
    let done = "[[event]]\noperation = \"removal\"\ndate = \"2001-05-12\"\n\
                [[pest]]\nname = \"caterpillar\"\nattacks = \"leaf\"\nprobability = 0.5\ndates = [\"2001-03-23\", \"2001-03-23\"]\n";
    let scenario = BASE.replace("species.toml", "coffee").replace("until = 12", "until = 10");
    let scenario =
        scenario.replace("days = 10", "degree_days = 300").replace("plants_per_part = 4", "plants_per_part = 8");
    let weather = "weather = { file = \"years.csv\", years = \"replicates\" }\nexperiment = { replicates = 2 }\n";
    grown(home.path(), "years", &format!("{scenario}{weather}{done}"), &[]);
    let site = Columns::of(&home.path().join("runs/years"), "site");
    let mut rows = [0; 2];
    for (row, tick) in site.numbers("tick").iter().enumerate() {
        let replicate = site.numbers("replicate")[row] as usize;
        // Days 50 and 100 after planting.
        let (attacked, removed) = ([3.0, 2.0][replicate], [6.0, 4.0][replicate]);
        let (living, pressure) = (site.numbers("living_plants")[row], site.numbers("pest_pressure_leaf")[row]);
        assert_eq!(living, if *tick < removed { 3.0 } else { 0.0 }, "replicate {replicate}, tick {tick}");
        let expected = if *tick == attacked { 0.5 } else { 0.0 };
        assert!(
            *tick >= removed || (pressure - expected).abs() < 1e-12,
            "replicate {replicate}, tick {tick}: {pressure}"
        );
        rows[replicate] += 1;
    }
    assert_eq!(rows, [10, 10]);
}

/// A member grows as one of a species of its own that is sown at the same tick, by the calendar from its sowing on.
#[test]
fn members_of_a_dated_species_are_sown_at_several_ticks() {
    let home = home();
    let soil = "soil = { nitrogen_kg_ha = 30 }\n\
                fertilizer = [{ fertilization_date = \"2001-04-01\", N_in_applied_fertilizer = 40 }]\n";
    for (name, sown) in [("late", 3), ("later", 5)] {
        let species = SPECIES.replace("name = \"dated\"", &format!("name = \"{name}\""));
        write(home.path(), &format!("{name}_species.toml"), &species);
        assert!(species.contains(name) && sown > 0);
    }
    let members = |of: [&str; 2]| {
        let [late, later] = of;
        format!("{BASE}{WEATHER}{soil}member = [{{}}, {{ sown = 3{late} }}, {{ sown = 5{later} }}]\n")
    };
    grown(home.path(), "one", &members(["", ""]), &[]);
    let own = [", species = \"late_species.toml\"", ", species = \"later_species.toml\""];
    grown(home.path(), "three", &members(own), &[]);
    let rows = records(home.path(), "one", 0..3);
    assert_eq!(rows, records(home.path(), "three", 0..3));
    assert!(rows.len() > 30, "{} rows", rows.len());
    let plants = Columns::of(&home.path().join("runs/one"), "plants");
    assert_eq!(
        (plants.words("species"), plants.numbers("sown_tick")),
        (["dated"; 3].map(str::to_owned).as_slice(), [0.0, 3.0, 5.0].as_slice())
    );
    let told = fs::read_to_string(home.path().join("runs/one/run.json")).expect("run.json");
    assert!(!told.contains("other_species"), "one species, whatever its dates");
}

/// A pest of severity s over n ticks attacks with the hazard 1 − (1 − s)^(1/n) at each of them. Its shift by a field
/// plot is the same for all plants of the plot, and what nothing attacks has no pressure.
#[test]
fn the_site_has_the_pressure_of_pests() {
    let home = home();
    let pests = "[[pest]]\nname = \"borer\"\nattacks = \"apex\"\nprobability = 0.3\nages = [2, 9]\n\
                 [[pest]]\nname = \"wilt\"\nattacks = \"plant\"\nprobability = 0.02\nages = [3, 4]\nfield_plot_sd = 0.005\n\
                 [[pest]]\nname = \"caterpillar\"\nattacks = \"leaf\"\nprobability = 0.4\nages = [4, 4]\n";
    let scenario = shifted("").replace("[experiment]", &format!("{pests}[experiment]"));
    grown(home.path(), "pests", &scenario, &[]);
    let site = Columns::of(&home.path().join("runs/pests"), "site");
    let of = |what: &str| site.numbers(&format!("pest_pressure_{what}"));
    let hazard = 1.0 - phytomer::sim::math::pow(0.7, 1.0 / 8.0);
    let mut wilt = Vec::new();
    for (row, tick) in site.numbers("tick").iter().enumerate() {
        if site.numbers("living_plants")[row] == 0.0 {
            assert!(["apex", "plant", "leaf"].iter().all(|what| of(what)[row].is_nan()), "no plant lives");
            continue;
        }
        let expected = if (2.0..=9.0).contains(tick) { hazard } else { 0.0 };
        assert!((of("apex")[row] - expected).abs() < 1e-12, "tick {tick}: {}", of("apex")[row]);
        let eaten = if *tick == 4.0 { 0.4 } else { 0.0 };
        assert!((of("leaf")[row] - eaten).abs() < 1e-12, "tick {tick}: {}", of("leaf")[row]);
        assert!(of("flower")[row].is_nan() && of("fruit")[row].is_nan());
        assert_eq!(of("plant")[row] > 0.0, (3.0..=4.0).contains(tick), "tick {tick}");
        wilt.extend((*tick == 3.0).then(|| of("plant")[row]));
    }
    assert!(wilt.len() >= 6 && wilt.iter().all(|of| (of - 0.01).abs() < 0.015), "{wilt:?}");
    wilt.sort_by(f64::total_cmp);
    wilt.dedup_by(|a, b| (*a - *b).abs() < 1e-12);
    assert!(wilt.len() >= 5, "the pressure of each of six field plots: {wilt:?}");
}

/// What differs between field plots depends neither on threads nor on shards, and plants grow again from `run.json`.
#[test]
fn field_plots_have_the_same_bytes_however_they_are_grown() {
    let home = home();
    let pest = "[[pest]]\nname = \"borer\"\nattacks = \"apex\"\nprobability = 0.3\nages = [2, 9]\nblock_sd = 0.1\n\
                field_plot_sd = 0.1\n";
    let scenario = shifted(", block_sd_kg_ha = 8, field_plot_sd_kg_ha = 4")
        .replace("[experiment]", &format!("{pest}[experiment]"));
    let scenario = scenario.replace("years.csv\"", "years.csv\", years = [2001, 2002, 2001]");
    grown(home.path(), "trial", &scenario, &["--threads", "1"]);
    let whole = hashes(&home.path().join("runs/trial"));
    grown(home.path(), "trial", &scenario, &["--threads", "3", "--name", "three"]);
    assert_eq!(whole, hashes(&home.path().join("runs/three")));
    for shard in ["1/2", "2/2"] {
        run(home.path(), &["grow", "trial.toml", "--quiet", "--shard", shard]).ending(0);
    }
    run(home.path(), &["merge", "merged", "runs/trial-shard-1-of-2", "runs/trial-shard-2-of-2", "--quiet"]).ending(0);
    assert!(
        contents(&home.path().join("merged")) == contents(&home.path().join("runs/trial")),
        "a merged file differs"
    );
    let mesh = |name: &str, from: &str, plant: &str| {
        run(home.path(), &["mesh", from, "--plant", plant, "--age", "12", "--out", name]).ending(0);
        fs::read(home.path().join(name)).expect("a mesh")
    };
    let plants = ["1", "5", "8", "16"];
    let before = plants.map(|plant| mesh("before.ply", "trial.toml", plant));
    for name in ["years.csv", "trial.toml", "species.toml"] {
        fs::remove_file(home.path().join(name)).expect("a file");
    }
    assert_eq!(plants.map(|plant| mesh("after.ply", "runs/trial", plant)), before);
}
