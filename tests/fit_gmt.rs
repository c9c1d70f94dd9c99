//! `phytomer fit gmt`: ratios from three lengths, trees from tables of branches and from runs, species that grow the
//! same tree, pictures, and what is refused.
//!
//! Absent: the estimates themselves (`analysis/fits/tests`).

mod program;

use program::run;
use serde_json::Value;
use std::fs;
use std::path::Path;
use tempfile::tempdir;

fn json(folder: &Path, words: &[&str]) -> Value {
    let words: Vec<&str> = ["fit", "gmt"].iter().chain(words).chain(&["--json"]).copied().collect();
    serde_json::from_str(&run(folder, &words).ending(0).stdout).expect("JSON")
}

/// The value of an estimate of the fit that was taken.
fn value(told: &Value, name: &str) -> f64 {
    let taken = told["fits"].as_array().expect("fits").iter().find(|fit| fit["law"] == told["taken"]).expect("taken");
    let own = taken["estimates"].as_array().expect("estimates").iter().find(|own| own["name"] == name);
    own.unwrap_or_else(|| panic!("no {name} in {taken}"))["value"].as_f64().expect("a number")
}

fn square(x: f64) -> f64 {
    x * x
}

/// The young ginkgo: H0/H = .174, L/h = .75, growth level 7.
#[test]
fn three_lengths_give_ratios_and_a_species() {
    let folder = tempdir().unwrap();
    let ginkgo = ["--height", "100", "--first-branch", "17.4", "--lateral", "61.95", "--level", "7", "--ternary"];
    let exact = json(folder.path(), &ginkgo);
    let ratio = |told: &Value, name: &str| told["ratios"][name].as_f64().expect("a ratio");
    assert!((ratio(&exact, "r0") - 0.902756).abs() < 5e-7 && (ratio(&exact, "r2") - 0.677067).abs() < 5e-7);
    assert!((exact["grown"]["height"].as_f64().unwrap() - 100.0).abs() < 1e-9);
    let words: Vec<&str> = ginkgo.into_iter().chain(["--printed"]).collect();
    let printed = json(folder.path(), &words);
    assert!((ratio(&printed, "r0") - 0.826).abs() < 1e-12 && (ratio(&printed, "r2") - 0.6195).abs() < 1e-12);
    let grown = printed["grown"]["height"].as_f64().unwrap() / 17.4;
    assert!((grown - 4.502).abs() < 1e-3, "{grown}");
    let fir = ["fit", "gmt", "--height", "12", "--first-branch", "2", "--lateral", "5", "--level", "6"];
    let words: Vec<&str> = fir.into_iter().chain(["--angles", "0,-60", "--out", "fir.toml"]).collect();
    run(folder.path(), &words).ending(0);
    run(folder.path(), &["grow", "fir.toml", "--quiet", "--out", "runs/fir"]).ending(0);
    // Its main axis goes straight up: the tips of the run reach 12 m.
    let told = json(folder.path(), &["--data", "runs/fir"]);
    let main: f64 = (0..=6).map(|k| 2.0 * phytomer::sim::math::pow(value(&told, "r1"), f64::from(k))).sum();
    assert!((main - 12.0).abs() < 1e-4, "{main} m high");
    assert!((value(&told, "h2_deg") + 60.0).abs() < 1e-4 && told["taken"] == "gmt1", "{}", told["taken"]);
    assert!(folder.path().join("fit.json").is_file());
}

#[test]
fn lengths_that_contradict_one_another_are_refused() {
    let folder = tempdir().unwrap();
    let tree = |height: &str, level: &str| {
        let words = ["--height", height, "--first-branch", "2", "--lateral", "5", "--level", level];
        run(folder.path(), &["fit", "gmt"].into_iter().chain(words).collect::<Vec<_>>()).ending(3).stderr
    };
    assert!(tree("1", "7").contains("expected H0 < H"));
    assert!(tree("-3", "7").contains("height is -3; expected a length above 0"));
    assert!(tree("12", "0").contains("the growth level is 0"));
    assert!(tree("12", "2").contains("6 first branches high"));
    for words in
        [&["--height", "3"][..], &[], &["--data", "b.csv", "--height", "3"], &["--sample", "--confidence", "x"]]
    {
        run(folder.path(), &["fit", "gmt"].iter().chain(words).copied().collect::<Vec<_>>()).ending(2);
    }
}

/// The right angle of Fig. 13c at the sixth of its ten levels, s = 5/9.
const SEEN_DEG: f64 = -(90.0 - 70.0 * 25.0 / 81.0);

/// Species of all four types, grown, fitted from their runs, and grown again.
#[test]
fn a_grown_tree_is_fitted_from_its_run_and_grows_again() {
    let folder = tempdir().unwrap();
    type Case = (&'static str, &'static str, &'static [(&'static str, f64)]);
    let cases: [Case; 4] = [
        ("gmt1/5e", "gmt1", &[("h1_deg", 20.0), ("h2_deg", -50.0), ("divergence_deg", 140.0)]),
        ("gmt2/11a", "gmt2", &[("h1_deg", 0.0), ("h2_deg", -45.0), ("r1", 0.9), ("r2", 0.8), ("deviation_z", -0.3)]),
        ("gmt3/12c", "gmt3, with a deviation", &[("h1_deg", 60.0), ("r0", 0.9), ("r1", 0.6), ("deviation_z", -0.6)]),
        ("gmt4/13c", "gmt4, category 2", &[("h2_max_deg", -90.0), ("h2_min_deg", SEEN_DEG), ("r2", 0.7)]),
    ];
    for (species, law, expected) in cases {
        let scenario = format!("name = \"a\"\nspecies = \"{species}\"\nplants = 1\nages = {{ until = 7 }}\n");
        fs::write(folder.path().join("a.toml"), scenario).unwrap();
        run(folder.path(), &["grow", "a.toml", "--quiet", "--out", "runs/a", "--overwrite"]).ending(0);
        let told = json(folder.path(), &["--data", "runs/a", "--age", "7", "--out", "again.toml"]);
        assert_eq!(told["taken"], law, "{species}");
        for (name, truth) in expected {
            let found = value(&told, name);
            assert!((found - truth).abs() < 1e-4, "{species}: {name} is {found}, {truth} was grown");
        }
        run(folder.path(), &["grow", "again.toml", "--quiet", "--out", "runs/b", "--overwrite"]).ending(0);
        let again = json(folder.path(), &["--data", "runs/b"]);
        assert_eq!(again["taken"], told["taken"], "{species}");
        assert!((value(&again, "r1") - value(&told, "r1")).abs() < 1e-4);
    }
}

/// Four branches of the level 1 in the sample: their lengths by hand, and t of 80 % with 3 degrees of freedom,
/// 1.637744.
#[test]
fn means_of_levels_are_told() {
    let folder = tempdir().unwrap();
    let sample = run(folder.path(), &["fit", "gmt", "--sample"]).ending(0).stdout;
    fs::write(folder.path().join("b.csv"), &sample).unwrap();
    let rows: Vec<Vec<&str>> = sample.lines().skip(2).map(|line| line.split(',').collect()).collect();
    let tip = |row: &Vec<&str>| [3, 4, 5].map(|k| row[k].parse::<f64>().unwrap());
    let first = |plant: &str| tip(rows.iter().find(|row| row[0] == plant && row[2].is_empty()).unwrap());
    let lengths: Vec<f64> = rows
        .iter()
        .filter(|row| row[2] == "1")
        .map(|row| (0..3).map(|k| square(tip(row)[k] - first(row[0])[k])).sum::<f64>().sqrt())
        .collect();
    assert_eq!(lengths.len(), 4);
    let mean = lengths.iter().sum::<f64>() / 4.0;
    let deviation = (lengths.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / 3.0).sqrt();
    let told = json(folder.path(), &["--data", "b.csv", "--confidence", "80"]);
    let length = &told["levels"][1]["length"];
    let near =
        |found: &Value, expected: f64| assert!((found.as_f64().unwrap() - expected).abs() < 1e-6, "{found} {expected}");
    near(&length["value"], mean);
    near(&length["interval"][0], mean - 1.637_744 * deviation / 2.0);
    near(&length["interval"][1], mean + 1.637_744 * deviation / 2.0);
    let table = run(folder.path(), &["fit", "gmt", "--data", "b.csv", "--confidence", "80"]).ending(0).stdout;
    assert!(table.contains("(80 %: ") && table.lines().any(|line| line.starts_with("level  branches")), "{table}");
}

#[test]
fn the_fitted_tree_is_drawn_beside_the_data() {
    let folder = tempdir().unwrap();
    let sample = run(folder.path(), &["fit", "gmt", "--sample"]).ending(0).stdout;
    fs::write(folder.path().join("b.csv"), sample).unwrap();
    let words = ["fit", "gmt", "--data", "b.csv", "--model", "gmt1"];
    for picture in ["beside.svg", "beside.png"] {
        run(folder.path(), &words.into_iter().chain(["--picture", picture]).collect::<Vec<_>>()).ending(0);
    }
    let svg = fs::read_to_string(folder.path().join("beside.svg")).unwrap();
    // Each branch has a side and a joint; 30 measured ones and 15 fitted ones stand twice.
    assert_eq!((svg.matches("#1e4696").count(), svg.matches("fill=\"#000000\"").count()), (2 * 2 * 30, 2 * 2 * 15));
    assert!(fs::read(folder.path().join("beside.png")).unwrap().starts_with(b"\x89PNG"));
    run(folder.path(), &words.into_iter().chain(["--picture", "beside.pdf"]).collect::<Vec<_>>()).ending(2);
}

#[test]
fn bad_tables_are_told_with_line_and_column_and_write_nothing() {
    let folder = tempdir().unwrap();
    let told = |rows: &str| {
        fs::write(folder.path().join("b.csv"), format!("id,parent,x,y,z,diameter\n{rows}")).unwrap();
        run(folder.path(), &["fit", "gmt", "--data", "b.csv", "--out", "t.toml"]).ending(3).stderr
    };
    assert!(told("1,,0,0,1,.1\n2,3,0,0,2,.1").contains("b.csv:3:3: no branch has the id `3`; expected"));
    assert!(told("1,,0,0,1,.1\n").contains("0 branchings, and at least 1 are needed"));
    assert!(told("1,,0,0,nan,.1\n").contains("b.csv:2:8: the z of a tip is `nan`"));
    assert!(!folder.path().join("t.toml").exists() && !folder.path().join("fit.json").exists());
    let none = run(folder.path(), &["fit", "gmt", "--data", "runs/none"]);
    none.ending(1);
}

#[test]
fn the_examples_of_its_help_run() {
    let folder = tempdir().unwrap();
    let sample = run(folder.path(), &["fit", "gmt", "--sample"]).ending(0).stdout;
    fs::write(folder.path().join("branches.csv"), sample).unwrap();
    let help = run(folder.path(), &["fit", "gmt", "--help"]).ending(0).stdout;
    let examples: Vec<&str> = help.lines().filter_map(|line| line.strip_prefix("  phytomer ")).collect();
    assert_eq!(examples.len(), 5, "{help}");
    for example in examples.into_iter().filter(|example| !example.contains("runs/")) {
        let words: Vec<&str> = example.split("   ").next().unwrap_or_default().split_whitespace().collect();
        run(folder.path(), &words).ending(0);
    }
    assert!(folder.path().join("my_fir.toml").is_file() && folder.path().join("beside.svg").is_file());
}
