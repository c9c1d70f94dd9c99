//! Treatments that differ in their dates, their weather or the nitrogen of their soil: each must be the run that it
//! would be alone.
//!
//! The species has laws of the date, so it is compiled for each calendar. The files are read by the parquet crate
//! alone.

mod program;
mod read;

use phytomer::sim::math::exp;
use program::{run, write};
use read::Columns;
use std::fs;
use std::path::Path;

const SPECIES: &str = include_str!("../config/tests/weather/dated.toml");
const WEATHER: &str = include_str!("../config/tests/weather/steady.csv");
const BASE: &str = "name = \"NAME\"\nspecies = \"species.toml\"\nplants = 3\nages = { until = 12 }\n\
    output = { plants_per_part = 4 }\ncalendar = { tick = { days = 10 }, degree_days = { method = \"average\", base_celsius = 10 } }\n\
    weather = { file = \"steady.csv\" }\nsoil = { nitrogen_kg_ha = 10 }\n";
const EARLY: &str = "planting_date = \"2001-02-01\"\n";
const LATE: &str = "planting_date = \"2001-04-12\"\n";
const RICH: &str = "fertilizer = [{ fertilization_date = \"2001-05-01\", N_in_applied_fertilizer = 60 }]\n";
/// Both factors, and the treatments in their order with what they set.
const EXPERIMENT: &str = "[experiment]\nreplicates = 2\n\
    [[experiment.factor]]\nname = \"sowing\"\nlevel = [{ name = \"early\" }, { name = \"late\", planting_date = \"2001-04-12\" }]\n\
    [[experiment.factor]]\nname = \"nitrogen\"\nlevel = [{ name = \"poor\" }, { name = \"rich\", \
    fertilizer = [{ fertilization_date = \"2001-05-01\", N_in_applied_fertilizer = 60 }] }]\n";
const TREATMENTS: [(&str, &str, &str); 4] = [
    ("early + poor", EARLY, ""),
    ("early + rich", EARLY, RICH),
    ("late + poor", LATE, ""),
    ("late + rich", LATE, RICH),
];

fn home() -> tempfile::TempDir {
    let home = tempfile::tempdir().expect("a temporary folder");
    write(home.path(), "species.toml", SPECIES);
    write(home.path(), "steady.csv", WEATHER);
    home
}

fn grown(home: &Path, name: &str, scenario: &str) {
    write(home, &format!("{name}.toml"), &scenario.replace("NAME", name));
    run(home, &["grow", &format!("{name}.toml"), "--quiet"]).ending(0);
}

/// The rows of `records` of some plants, without what names the plants.
fn records(folder: &Path, plants: std::ops::Range<u32>) -> Vec<Vec<u64>> {
    let table = Columns::of(folder, "records");
    let of = |row: &usize| plants.contains(&(table.numbers("plant_id")[*row] as u32));
    let columns = ["tick", "component_id", "axis_id", "birth_age", "x_m", "z_m", "length_m", "area_m2"];
    let rows = (0..table.numbers("tick").len()).filter(of);
    rows.map(|row| columns.map(|column| table.numbers(column)[row].to_bits()).to_vec()).collect()
}

#[test]
fn each_treatment_is_the_run_that_it_would_be_alone() {
    let home = home();
    grown(home.path(), "trial", &format!("{BASE}{EARLY}{EXPERIMENT}"));
    let trial = home.path().join("runs/trial");
    let treatments = Columns::of(&trial, "treatments");
    assert_eq!(treatments.words("treatment"), TREATMENTS.map(|(name, ..)| name));
    let mut seen = Vec::new();
    for (place, (name, sowing, nitrogen)) in (0..).zip(TREATMENTS) {
        let alone = format!("alone_{place}");
        grown(home.path(), &alone, &format!("{BASE}{sowing}{nitrogen}"));
        let of_trial = records(&trial, 6 * place..6 * place + 3);
        assert_eq!(of_trial, records(&home.path().join("runs").join(&alone), 0..3), "{name}");
        assert!(of_trial.len() > 40, "{name}: {} rows", of_trial.len());
        seen.push(of_trial);
    }
    assert!((1..4).all(|k| seen[..k].iter().all(|other| *other != seen[k])), "no two treatments grow alike");
    let plants = Columns::of(&trial, "plants");
    assert!(plants.words("species").iter().all(|species| species == "dated"), "one species, whatever its calendars");
}

/// A response to nitrogen, which stands at its reference where nothing tells the nitrogen, is of each treatment too; at
/// the reference the plants are those of the species without it.
#[test]
fn responses_to_nitrogen_are_of_each_treatment() {
    let home = home();
    let plain = "inherits = \"coffee\"\nname = \"plain\"\n";
    let response = "[[response]]\nacts_on = [\"leaf_area\"]\nreference = 60\n\
                    law = { mitscherlich = { over = \"nitrogen\", rate = 0.02, offset = 20 } }\n";
    write(home.path(), "plain.toml", plain);
    write(home.path(), "fed.toml", &format!("{plain}{response}"));
    let base = BASE.replace("nitrogen_kg_ha = 10", "nitrogen_kg_ha = 0").replace("until = 12", "until = 8");
    let levels = [0, 60, 120].map(|rate| {
        let applied = format!("fertilization_date = \"2001-02-01\", N_in_applied_fertilizer = {rate}");
        format!("{{ name = \"{rate}\", fertilizer = [{{ {applied} }}] }}")
    });
    let factor = format!("[[experiment.factor]]\nname = \"nitrogen\"\nlevel = [{}]\n", levels.join(", "));
    grown(home.path(), "fed_trial", &format!("{}{EARLY}{factor}", base.replace("species.toml", "fed.toml")));
    grown(home.path(), "plain_run", &format!("{}{EARLY}", base.replace("species.toml", "plain.toml")));
    let trial = home.path().join("runs/fed_trial");
    let [poor, at_reference, rich] = [0, 3, 6].map(|first| records(&trial, first..first + 3));
    assert_eq!(at_reference, records(&home.path().join("runs/plain_run"), 0..3));
    let leaves = |rows: &[Vec<u64>]| -> f64 {
        rows.iter().map(|row| f64::from_bits(row[7])).filter(|area| !area.is_nan()).sum()
    };
    let m = |rate: f64| (1.0 - exp(-0.02 * (rate + 20.0))) / (1.0 - exp(-0.02 * 80.0));
    for (rows, rate) in [(&poor, 0.0), (&rich, 120.0)] {
        let ratio = leaves(rows) / leaves(&at_reference);
        assert!((ratio / m(rate) - 1.0).abs() < 1e-4, "{rate} kg: {ratio}, not {}", m(rate));
    }
}

/// The season of the early crop has the fertilizer of 1 May from tick 9 on, that of the late crop from tick 2 on.
#[test]
fn the_site_has_the_calendar_of_each_treatment() {
    let home = home();
    grown(home.path(), "trial", &format!("{BASE}{EARLY}{EXPERIMENT}"));
    let site = Columns::of(&home.path().join("runs/trial"), "site");
    let mut ticks = [0; 4];
    for (row, treatment) in site.words("treatment").iter().enumerate() {
        let place = TREATMENTS.iter().position(|(name, ..)| name == treatment).expect("a treatment");
        let (tick, late, rich) = (site.numbers("tick")[row], place >= 2, place % 2 == 1);
        let planted = if late { 11_424.0 } else { 11_354.0 };
        assert_eq!(site.numbers("date")[row], planted + 10.0 * tick, "{treatment}, tick {tick}");
        let applied = if rich && tick >= if late { 2.0 } else { 9.0 } { 60.0 } else { 0.0 };
        assert_eq!(site.numbers("nitrogen_kg_ha")[row], 10.0 + applied, "{treatment}, tick {tick}");
        ticks[place] += 1;
    }
    assert!(ticks.into_iter().all(|ticks| ticks >= 2 * 12), "two replicates of each treatment: {ticks:?}");
}

#[test]
fn plants_of_each_treatment_grow_again_without_the_files() {
    let home = home();
    grown(home.path(), "trial", &format!("{BASE}{EARLY}{EXPERIMENT}"));
    let mesh = |name: &str, from: &str, plant: &str| {
        run(home.path(), &["mesh", from, "--plant", plant, "--age", "12", "--out", name]).ending(0);
        fs::read(home.path().join(name)).expect("a mesh")
    };
    let plants = ["1", "7", "14", "23"];
    let before = plants.map(|plant| mesh("before.ply", "trial.toml", plant));
    for name in ["steady.csv", "trial.toml", "species.toml"] {
        fs::remove_file(home.path().join(name)).expect("a file");
    }
    assert_eq!(plants.map(|plant| mesh("after.ply", "runs/trial", plant)), before);
    let told = run(home.path(), &["describe", "runs/trial"]).ending(0).stdout;
    assert!(told.contains("dated") && !told.contains("dated, dated"), "{told}");
}

/// A fault that several treatments have, such as weather that ends too early, is told once.
#[test]
fn a_fault_of_the_weather_is_told_once() {
    let home = home();
    let scenario = format!("{BASE}{EARLY}{EXPERIMENT}").replace("until = 12", "until = 30");
    write(home.path(), "late.toml", &scenario);
    let told = run(home.path(), &["validate", "late.toml"]).ending(3).stderr;
    assert_eq!(told.matches("the weather goes from 2001-01-01").count(), 1, "{told}");
    assert!(told.contains("tick 27 needs that of 2002-01-01") || told.contains("needs that of 2002-01-01"), "{told}");
}
