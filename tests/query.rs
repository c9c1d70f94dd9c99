//! `phytomer query` on the command line, with the feature `sql`: what it shows and writes, and its exit codes.
//!
//! Absent: the rows (`analysis/query/tests/engine.rs`), and the views (`views`).

#![cfg(feature = "sql")]

mod program;

use program::run;
use std::fs;
use tempfile::tempdir;

const SCENARIO: &str = "
name = \"two\"
species = \"apple\"
plants = 4
seed = 7
spacing_m = 2
ages = { until = 8, record = \"all\" }
output = { mechanics = true, plants_per_part = 2 }

[[experiment.factor]]
name = \"stand\"
level = [{ name = \"wide\" }, { name = \"dense\", spacing_m = 1 }]
";

#[test]
fn the_command_line_shows_and_writes_rows() {
    let home = tempdir().expect("a temporary folder");
    let folder = home.path();
    program::write(folder, "two.toml", SCENARIO);
    for (seed, name) in [("7", "runs/one"), ("8", "runs/the other's")] {
        run(folder, &["grow", "two.toml", "--seed", seed, "--out", name, "--quiet"]).ending(0);
    }
    let sql = "SELECT run, treatment, plants, height_m FROM treatments_at(8) ORDER BY run, treatment";
    let runs = ["query", "one", "runs/the other's"];
    let shown = run(folder, &[&runs[..], &[sql]].concat()).ending(0);
    assert!(shown.stdout.contains("| the other's | wide") && shown.stderr.contains("4 rows"), "{}", shown.stdout);
    let json = run(folder, &[&runs[..], &[sql, "--json"]].concat()).ending(0).json();
    assert_eq!(json.as_array().map(Vec::len), Some(4));
    assert_eq!(json[0]["treatment"], "dense");
    for name in ["rows.csv", "rows.json", "rows.parquet"] {
        run(folder, &[&runs[..], &[sql, "--out", name]].concat()).ending(0);
    }
    let csv = fs::read_to_string(folder.join("rows.csv")).expect("a file");
    assert!(csv.starts_with("run,treatment,plants,height_m\none,dense,4,") && csv.lines().count() == 5, "{csv}");
    let written: serde_json::Value =
        serde_json::from_slice(&fs::read(folder.join("rows.json")).expect("a file")).expect("JSON");
    assert_eq!(written, json);
    assert!(fs::read(folder.join("rows.parquet")).expect("a file").starts_with(b"PAR1"));
    let few = run(folder, &[&runs[..], &["SELECT * FROM events", "--rows", "2"]].concat()).ending(0);
    assert!(few.stderr.contains("the first 2 shown"), "{}", few.stderr);
    let none =
        run(folder, &[&runs[..], &["SELECT age FROM summary WHERE age < 0", "--out", "none.csv"]].concat()).ending(0);
    assert!(none.stdout.contains("0 rows") && fs::read(folder.join("none.csv")).expect("a file") == b"age\n");
    for (words, code) in [
        (&["SELECT nothing FROM summary"][..], 3),
        (&["DROP VIEW records"], 3),
        (&["SELECT 1", "--out", "rows.xlsx"], 2),
        (&["SELECT 1", "--out", "rows"], 2),
        (&["SELECT 1", "--memory", "lots"], 2),
    ] {
        let told = run(folder, &[&runs[..], words].concat()).ending(code);
        assert!(told.stdout.is_empty() && !told.stderr.is_empty(), "{words:?}");
    }
}
