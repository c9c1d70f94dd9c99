//! `fit` as a person uses it: from a table to a species that validates, with `fit.json` beside it; and the ways in
//! which it refuses.
//!
//! Absent: the estimates, which `analysis/fits/tests` hold to measured plants.

#[path = "program/absent.rs"]
mod absent;
mod program;

use program::{run, write};
use std::fs;
use std::path::Path;
use tempfile::tempdir;

/// The sample of a law, as the program prints it.
fn lay_sample(folder: &Path, law: &str) -> String {
    let name = format!("{law}.csv");
    write(folder, &name, &run(folder, &["fit", "--sample", law]).ending(0).stdout);
    name
}

/// A table of each law becomes a species that the model takes.
#[test]
fn every_sample_becomes_a_species_that_validates() {
    let folder = tempdir().unwrap();
    let folder = folder.path();
    for (sample, law, base, key) in [
        ("activity", "activity", "coffee", "pause"),
        ("activity-days", "activity", "coffee", "pause"),
        ("mortality", "mortality", "coffee", "death"),
        ("mortality-followed", "mortality", "coffee", "death"),
        ("nodes", "nodes", "poplar", "growth_unit.nodes"),
        ("crown", "crown", "coffee", "speed"),
        ("branching", "branching", "poplar", "axillary.pattern"),
    ] {
        let table = lay_sample(folder, sample);
        let words = ["fit", &table, "--law", law, "--base", base, "--out", "mine.toml", "--json"];
        let told = run(folder, &words).ending(0).json();
        let species = fs::read_to_string(folder.join("mine.toml")).unwrap();
        assert!(species.contains(&format!("inherits = \"{base}\"")), "{species}");
        assert!(species.contains(&format!("{key} = {{")) && species.contains("source = "), "{species}");
        assert!(!species.contains("NaN") && !species.contains("inf"), "{species}");
        let json: serde_json::Value = serde_json::from_slice(&fs::read(folder.join("fit.json")).unwrap()).unwrap();
        assert_eq!(json["fits"], told["fits"]);
        assert_eq!(json["data_sha256"].as_str().unwrap().len(), 64);
        let described = run(folder, &["describe", "mine.toml"]).ending(0);
        assert!(!described.stdout.is_empty());
    }
}

#[test]
fn what_is_wrong_is_told_and_nothing_is_written() {
    let folder = tempdir().unwrap();
    let folder = folder.path();
    write(folder, "bad.csv", "nodes\n7\nseven\n");
    let refused =
        run(folder, &["fit", "bad.csv", "--law", "nodes", "--base", "poplar", "--out", "mine.toml"]).ending(3);
    assert!(refused.stderr.contains("bad.csv:3: `nodes` is `seven`"), "{}", refused.stderr);
    write(folder, "equal.csv", "nodes\n7\n7\n7\n");
    let refused = run(folder, &["fit", "equal.csv", "--law", "nodes", "--json"]).ending(3);
    assert!(refused.json()["problem"].as_str().unwrap().contains("V = 0"));
    // A fate that is no state of the species.
    write(folder, "fates.csv", &lay_fates("unheard"));
    let words = ["fit", "fates.csv", "--law", "branching", "--base", "poplar", "--out", "mine.toml"];
    let refused = run(folder, &words).ending(3);
    assert!(refused.stderr.contains("unheard"), "{}", refused.stderr);
    let usage = run(folder, &["fit", "equal.csv", "--law", "nodes", "--window", "9..3"]).ending(2);
    assert!(usage.stderr.contains("two days in order"), "{}", usage.stderr);
    run(folder, &["fit", "equal.csv", "--law", "nodes", "--out", "mine.toml"]).ending(2);
    run(folder, &["fit", "none.csv", "--law", "nodes"]).ending(1);
    assert!(!folder.join("mine.toml").exists() && !folder.join("fit.json").exists());
}

/// Thirty axes of ten buds, latent and of one fate by turns.
fn lay_fates(fate: &str) -> String {
    let mut text = "axis,rank,fate\n".to_owned();
    for axis in 1..=30 {
        for rank in 1..=10 {
            let fate = if (rank + axis) % 3 == 0 { "latent" } else { fate };
            text.push_str(&format!("{axis},{rank},{fate}\n"));
        }
    }
    text
}

/// From the fates counted on trunks of Fuji to an apple with a chain of seven zones, which grows.
#[test]
fn counts_of_fuji_become_an_apple() {
    let Some(counts) = absent::measured("apple_trunk_axillary_fates.csv") else { return };
    let folder = tempdir().unwrap();
    let folder = folder.path();
    let mut table = "cultivar,axis,rank,fate\n".to_owned();
    for line in counts.lines().skip(1) {
        let (row, fate) = line.rsplit_once(',').unwrap();
        let fate = ["latent", "short", "long", "floral", "sylleptic"][fate.parse::<usize>().unwrap()];
        table.push_str(&format!("{row},{fate}\n"));
    }
    write(folder, "fates.csv", &table);
    let words = ["fit", "fates.csv", "--law", "branching", "--where", "cultivar=fuji", "--chain", "7", "--json"];
    let out = ["--base", "apple", "--out", "fuji.toml", "--source", "Costes, 15 trunks of Fuji"];
    let told = run(folder, &[&words[..], &out[..]].concat()).ending(0).json();
    let taken = told["taken"].as_str().unwrap();
    assert!(taken.starts_with("chain of 7 zones"), "{taken}");
    let species = fs::read_to_string(folder.join("fuji.toml")).unwrap();
    assert!(species.contains("chain = ["), "{species}");
    write(folder, "trial.toml", "name = \"trial\"\nspecies = \"fuji.toml\"\nplants = 3\nages = { until = 6 }\n");
    run(folder, &["grow", "trial.toml", "--quiet"]).ending(0);
}

/// A run of coffee as data of each law that its tables can tell of.
#[test]
fn a_run_is_data_of_every_law() {
    let folder = tempdir().unwrap();
    let folder = folder.path();
    let scenario = "name = \"trial\"\nspecies = \"coffee\"\nplants = 60\nages = { until = 30, record = [30] }\n";
    write(folder, "trial.toml", scenario);
    run(folder, &["grow", "trial.toml", "--quiet"]).ending(0);
    let fit = |law: &'static str, more: &[&'static str]| {
        let told = run(folder, &[&["fit", "runs/trial", "--law", law, "--json"][..], more].concat()).ending(0);
        told.json()["fits"][0].clone()
    };
    let within = |fit: &serde_json::Value, name: &str, truth: f64| {
        let own = fit["estimates"].as_array().unwrap().iter().find(|own| own["name"] == name).unwrap();
        let [low, high] = ["low", "high"].map(|limit| own[limit].as_f64().unwrap());
        println!("{name}: {low} to {high}");
        assert!(low <= truth && truth <= high, "{own}");
    };
    // The trunk of this species pauses in .12 of its ticks, and hardly dies by then.
    within(&fit("activity", &["--window", "1..30"]), "b", 0.88);
    // Its branches die by a law of their cycles, which pass as ticks do.
    let deaths = fit("mortality", &["--order", "2", "--check", "10"]);
    assert!(deaths["n"].as_f64().unwrap() > 1.0, "{deaths}");
    let fates = fit("branching", &["--order", "1", "--zone", "10", "--chain", "2"]);
    assert!(fates["n"].as_f64().unwrap() > 1000.0, "{fates}");
    let crown = fit("crown", &["--order", "1"]);
    within(&crown, "b1", 0.88);
    // Whole plants are left out.
    let told = run(folder, &["fit", "runs/trial", "--law", "mortality", "--order", "2", "--check", "10"]).ending(0);
    assert!(told.stdout.contains("left out and predicted"), "{}", told.stdout);
    // Growth units of one node each cannot be fitted, which is told.
    let said = run(folder, &["fit", "runs/trial", "--law", "nodes"]).ending(3);
    assert!(said.stderr.contains("runs/trial"), "{}", said.stderr);
    let out = ["--base", "coffee", "--out", "mine.toml", "--window", "1..30"];
    run(folder, &[&["fit", "runs/trial", "--law", "activity"][..], &out].concat()).ending(0);
    let species = fs::read_to_string(folder.join("mine.toml")).unwrap();
    assert!(species.contains("pause = { value = ") && species.contains("trial"), "{species}");
    for (words, code, told) in [
        (vec!["fit", "runs/trial", "--law", "activity"], 2, "--window 12..36"),
        (vec!["fit", "runs/trial", "--law", "mortality", "--order", "7"], 3, "no plant has an axis of order 7"),
        (vec!["fit", "runs", "--law", "mortality"], 3, "runs"),
    ] {
        let said = run(folder, &words).ending(code);
        assert!(said.stderr.contains(told), "{}", said.stderr);
    }
}
