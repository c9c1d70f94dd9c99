//! Populations: a sample of the plants in the large tables, the progress of a run for programs, and the shipped million
//! of coffee trees with fewer trees.

mod program;
mod read;

use phytomer::outputs::read::Run;
use program::{contents, data, hashes, run, write};
use read::Columns;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use tempfile::tempdir;

/// A scenario of small plants, by the number of plants and the lines that are added.
fn scenario(folder: &Path, plants: u32, lines: &str) {
    let species = data("bush.toml");
    write(
        folder,
        "s.toml",
        &format!(
            "name = \"s\"\nspecies = '{species}'\nplants = {plants}\nseed = 3\nages = {{ until = 12, record = [6, 12] }}\n\
             {lines}\noutput = {{ plants_per_part = 9 }}\n"
        ),
    );
}

/// The rows of a table by the number of their plant, in their order: every column of numbers but that of the choice.
fn rows(run: &Path, table: &str) -> BTreeMap<u64, Vec<u64>> {
    let columns = Columns::of(run, table);
    let mut rows: BTreeMap<u64, Vec<u64>> = BTreeMap::new();
    for (row, plant) in columns.numbers("plant_id").iter().enumerate() {
        let names = columns.names().filter(|name| *name != "sampled");
        let values = names.map(|name| columns.numbers(name)[row].to_bits());
        rows.entry(*plant as u64).or_default().extend(values);
    }
    rows
}

/// The numbers of the plants of a run's sample.
fn sampled(run: &Path) -> BTreeSet<u64> {
    let plants = Columns::of(run, "plants");
    let pairs = plants.numbers("plant_id").iter().zip(plants.numbers("sampled"));
    pairs.filter(|(_, sampled)| **sampled == 1.0).map(|(plant, _)| *plant as u64).collect()
}

/// The plants of the sample have the rows that they have in the whole run, and the others none; all have their summary.
#[test]
fn a_sample_has_the_rows_of_the_whole_run_and_no_others() {
    let home = tempdir().unwrap();
    scenario(home.path(), 40, "");
    run(home.path(), &["grow", "s.toml", "--quiet", "--name", "whole"]).ending(0);
    scenario(home.path(), 40, "sample = 7");
    run(home.path(), &["grow", "s.toml", "--quiet", "--name", "some"]).ending(0);
    let [whole, some] = ["whole", "some"].map(|name| home.path().join("runs").join(name));
    let chosen = sampled(&some);
    assert_eq!((chosen.len(), sampled(&whole).len()), (7, 40));
    for table in ["components", "records", "events", "summary", "plants"] {
        let (all, few) = (rows(&whole, table), rows(&some, table));
        // A plant that dies before the first recorded age has no records.
        assert!(all.len() > 30, "{table} of {} plants", all.len());
        let of_all = ["summary", "plants"].contains(&table);
        let expected: BTreeMap<_, _> = all.into_iter().filter(|(plant, _)| of_all || chosen.contains(plant)).collect();
        assert!(few == expected, "{table}: rows of {:?} for the sample {chosen:?}", few.keys());
    }
    assert_eq!(Run::open(&some).unwrap().json()["sample"]["plants"], 7);
    let told = run(home.path(), &["describe", "s.toml"]).ending(0).stdout;
    assert!(told.contains("components, records and events of 7 plants, summary and plants of all"), "{told}");
    let dry = run(home.path(), &["grow", "s.toml", "--dry-run", "--json"]).ending(0).json();
    assert_eq!((&dry["expected"]["sampled"], &dry["expected"]["plants"]), (&7.into(), &40.into()));
    run(home.path(), &["describe", "runs/some"]).ending(0);
}

#[test]
fn a_sample_is_the_same_on_any_number_of_threads_in_shards_and_of_more_plants() {
    let home = tempdir().unwrap();
    scenario(home.path(), 40, "sample = 7");
    let grown = ["1", "2", "3", "8"].map(|threads| {
        run(home.path(), &["grow", "s.toml", "--quiet", "--threads", threads, "--name", threads]).ending(0);
        hashes(&home.path().join("runs").join(threads))
    });
    assert!(grown.iter().all(|run| *run == grown[0]));
    for share in ["1/2", "2/2"] {
        run(home.path(), &["grow", "s.toml", "--quiet", "--shard", share]).ending(0);
    }
    run(home.path(), &["merge", "merged", "runs/s-shard-1-of-2", "runs/s-shard-2-of-2", "--quiet"]).ending(0);
    assert!(contents(&home.path().join("merged")) == contents(&home.path().join("runs/1")));
    let few = sampled(&home.path().join("merged"));
    run(home.path(), &["grow", "s.toml", "--quiet", "--plants", "120", "--name", "more"]).ending(0);
    let more = sampled(&home.path().join("runs/more"));
    assert_eq!(more.len(), 7);
    let old: BTreeSet<u64> = more.into_iter().filter(|plant| *plant < 40).collect();
    assert!(old.is_subset(&few), "no plant that was not chosen among fewer");
}

#[test]
fn a_sample_of_no_table_is_refused() {
    let home = tempdir().unwrap();
    scenario(home.path(), 40, "sample = 7\ntables = [\"summary\"]");
    let told = run(home.path(), &["grow", "s.toml"]).ending(3).stderr;
    assert!(told.contains("none of them is written") && told.contains("s.toml:6:"), "{told}");
}

/// The events of a run: each line of stderr that begins with a brace.
fn events(stderr: &str) -> Vec<Value> {
    stderr.lines().filter(|line| line.starts_with('{')).map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn progress_is_told_to_programs_as_events() {
    let home = tempdir().unwrap();
    scenario(home.path(), 40, "");
    let told = run(home.path(), &["grow", "s.toml", "--progress", "json", "--json"]).ending(0);
    let events_of_run = events(&told.stderr);
    assert_eq!(events_of_run.len(), told.stderr.lines().count(), "{}", told.stderr);
    let (first, last) = (&events_of_run[0], events_of_run.last().unwrap());
    assert_eq!((&first["event"], &first["left_s"]), (&"begin".into(), &Value::Null));
    assert_eq!((&last["event"], &last["status"]), (&"end".into(), &"complete".into()));
    let report = told.json();
    for (key, value) in [
        ("plants", 40.into()),
        ("plants_in_all", 40.into()),
        ("parts", 5.into()),
        ("parts_in_all", 5.into()),
        ("share", 1.0.into()),
        ("left_s", 0.0.into()),
        ("bytes", report["bytes"].clone()),
    ] {
        assert_eq!(last[key], value, "{key} in {last}");
    }
    let number = |key: &str| last[key].as_f64().unwrap();
    assert!(number("seconds") > 0.0 && number("components") > 0.0 && number("components_per_s") > 0.0);
    assert!((number("plants_per_s") * number("seconds") - 40.0).abs() < 1e-6);
    // A run that has nothing to grow tells that too.
    let again = run(home.path(), &["grow", "s.toml", "--progress", "json", "--resume"]).ending(0);
    assert_eq!(events(&again.stderr).last().unwrap()["status"], "complete");
}

#[test]
fn quiet_is_quiet_and_a_failed_run_ends_its_events() {
    let home = tempdir().unwrap();
    scenario(home.path(), 40, "");
    let told = run(home.path(), &["grow", "s.toml", "--progress", "json", "--quiet"]).ending(0);
    assert_eq!((told.stderr.as_str(), told.stdout.as_str()), ("", ""));
    let told = run(home.path(), &["grow", "s.toml", "--progress", "json"]).ending(1);
    assert!(told.stderr.contains("already holds files"), "{}", told.stderr);
    assert!(events(&told.stderr).iter().all(|event| event["event"] != "end"), "growth has not begun");
    run(home.path(), &["grow", "s.toml", "--progress", "bars"]).ending(2);
}

/// Two thousand of the million: the tables and their sizes, and a sample that is smaller than the run.
#[test]
fn the_million_of_coffee_trees_grows_with_fewer() {
    const PLANTS: u64 = 2_000;
    let home = tempdir().unwrap();
    let words = ["grow", "million_coffee", "--plants", "2000", "--json", "--name", "coffee"];
    let told = run(home.path(), &words).ending(0).json();
    assert_eq!((&told["plants"], &told["rows"]["summary"]), (&PLANTS.into(), &(12 * PLANTS).into()));
    assert_eq!(told["rows"]["plants"], PLANTS);
    assert_eq!(sampled(&home.path().join("runs/coffee")).len(), 200);
    let expected =
        run(home.path(), &["grow", "million_coffee", "--plants", "2000", "--dry-run", "--json"]).ending(0).json();
    let (rows, foretold) =
        (told["rows"]["components"].as_f64().unwrap(), expected["expected"]["components"].as_f64().unwrap());
    let of_sample = foretold * 200.0 / PLANTS as f64;
    assert!((rows / of_sample - 1.0).abs() < 0.2, "{rows} rows of components, about {of_sample} expected");
    let files: u64 = fs::read_dir(home.path().join("runs/coffee/summary")).unwrap().count() as u64;
    assert_eq!(told["parts"], files);
}
