//! `report` as people use it: its numbers are those of `summary`, a browser shows the page without scripts and without
//! network, and what is wrong with measured plants is told with its line.
//!
//! The means of a figure are reckoned once more here from the rows of `summary`, which the parquet crate reads. Absent:
//! statistics (`analysis/measures`), and how a page is made (`outputs/reports`).

#[path = "program/browser.rs"]
mod browser;
mod program;
mod read;

use browser::browser;
use program::{data, run, write};
use read::Columns;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;
use tempfile::{TempDir, tempdir};

/// A trial of two treatments: the bush of the tests, and one of half the length.
const TRIAL: &str = r#"
name = "trial"
species = "bush.toml"
plants = 12
seed = 7
ages = { until = 16, record = { every = 4 } }

[[experiment.factor]]
name = "genotype"
level = [{ name = "tall" }, { name = "dwarf", genotype_name = "dwarf.toml" }]
"#;

/// Measured plants: the ages 8 and 16 were recorded, 9 was not.
const FIELD: &str = "plot,age,height_m,leaf_area_m2\n1,8,0.30,0.02\n2,8,0.34,\n3,9,0.4,0.03\n4,16,0.5,0.04\n";

fn grown() -> TempDir {
    let folder = tempdir().expect("a folder");
    let species = fs::read_to_string(Path::new(&data("small.toml")).with_file_name("bush.toml")).expect("the species");
    write(folder.path(), "bush.toml", &species);
    let dwarf = "inherits = \"bush.toml\"\nname = \"dwarf\"\n[every_order]\ninternode = { length_cm = 2 }\n";
    write(folder.path(), "dwarf.toml", dwarf);
    write(folder.path(), "trial.toml", TRIAL);
    write(folder.path(), "field.csv", FIELD);
    run(folder.path(), &["grow", "trial.toml", "--quiet", "--out", "run"]).ending(0);
    folder
}

/// The rows of a CSV file without quotes.
fn rows(path: &Path) -> Vec<Vec<String>> {
    let text = fs::read_to_string(path).expect("the numbers of a figure");
    text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

/// By treatment and age, the values of a column of the living plants; plants 0 to 11 are of the first treatment.
fn of_summary(run: &Path, column: &str) -> BTreeMap<(bool, u32), Vec<f64>> {
    let summary = Columns::of(run, "summary");
    let [plants, ages, alive] = ["plant_id", "age", "alive"].map(|name| summary.numbers(name));
    let mut values: BTreeMap<(bool, u32), Vec<f64>> = BTreeMap::new();
    for (row, value) in summary.numbers(column).iter().enumerate() {
        if alive[row] == 1.0 && !value.is_nan() {
            values.entry((plants[row] >= 12.0, ages[row] as u32)).or_default().push(*value);
        }
    }
    values
}

#[test]
fn the_numbers_of_a_report_are_those_of_summary() {
    let folder = grown();
    let words =
        ["report", "run", "--data", "field.csv", "--plants", "2", "--figures", "figures", "--out", "report.html"];
    let told = run(folder.path(), &words).ending(0).stdout;
    assert!(told.starts_with("report.html: 25 figures, "), "{told}");
    let (run, figures) = (folder.path().join("run"), folder.path().join("figures"));
    let heights = of_summary(&run, "height_m");
    let told = rows(&figures.join("growth-height-m.csv"));
    let simulated: Vec<_> = told.iter().filter(|row| row[0] != "measured").collect();
    assert_eq!(simulated.len(), heights.len());
    for row in simulated {
        let values = &heights[&(row[0] == "dwarf", row[1].parse().expect("an age"))];
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        assert!((row[2].parse::<f64>().expect("a mean") / mean - 1.0).abs() < 1e-9, "{row:?} {mean}");
        let [low, high] = [3, 4].map(|k| row[k].parse::<f64>().expect("an end"));
        assert!(low < mean && mean < high && (low + high - 2.0 * mean).abs() < 1e-9);
    }
    let measured: Vec<_> = told.iter().filter(|row| row[0] == "measured").map(|row| (&*row[1], &*row[2])).collect();
    assert_eq!(measured, [("8", "0.32"), ("9", "0.4"), ("16", "0.5")]);

    // Plants of one number are pairs: the mean of the differences is the difference of their means.
    let contrast = &rows(&figures.join("contrast-internodes.csv"))[0];
    assert_eq!(contrast[0], "dwarf");
    let page = fs::read_to_string(folder.path().join("report.html")).expect("the page");
    for heading in ["Methods", "Growth", "Life and death", "Treatments", "Measured plants", "Plants", "Provenance"] {
        assert!(page.contains(&format!("<h2>{heading}</h2>")), "{heading}");
    }
    assert!(page.contains("24 plants of bush") && page.contains("in 2 treatments (tall, dwarf)"), "{page}");
    assert!(page.contains("Columns that are not compared: plot."));
    for ending in ["svg", "png", "csv", "vl.json"] {
        assert!(figures.join(format!("survival.{ending}")).is_file(), "{ending}");
    }
    let specification: Value =
        serde_json::from_str(&fs::read_to_string(figures.join("survival.vl.json")).expect("a file")).expect("JSON");
    assert_eq!(specification["data"]["values"][0]["y"], 1.0);
}

/// Growth units of order 2 of the tall plants, counted here once more from `components`: the shares of the figure, the
/// law of its species beside them, and counted units.
#[test]
fn distributions_are_those_of_components() {
    let folder = grown();
    write(folder.path(), "nodes.csv", "order,nodes,count\n2,1,30\n2,2,12\n5,1,4\n");
    let words =
        ["report", "run", "--data", "field.csv", "--data", "nodes.csv", "--plants", "0", "--figures", "figures"];
    run(folder.path(), &[&words[..], &["--out", "report.html"]].concat()).ending(0);
    let components = Columns::of(&folder.path().join("run"), "components");
    let [plants, axes, units, orders] =
        ["plant_id", "axis_id", "growth_unit", "order"].map(|name| components.numbers(name));
    let kinds = components.words("kind");
    let mut nodes: BTreeMap<[u64; 3], usize> = BTreeMap::new();
    let own = |row: &usize| plants[*row] < 12.0 && orders[*row] == 2.0 && kinds[*row] == "internode";
    for row in (0..plants.len()).filter(own) {
        *nodes.entry([plants[row], axes[row], units[row]].map(|number| number as u64)).or_default() += 1;
    }
    let told = rows(&folder.path().join("figures/nodes-bush-2.csv"));
    let of = |name: &str| -> Vec<[f64; 2]> {
        let own = told.iter().filter(|row| row[0] == name);
        own.map(|row| [1, 2].map(|k| row[k].parse().expect("a number"))).collect()
    };
    for [at, share] in of("grown") {
        let counted = nodes.values().filter(|nodes| **nodes as f64 == at).count() as f64 / nodes.len() as f64;
        assert!((share - counted).abs() < 1e-12, "{at}: {share} {counted}");
    }
    // B(3, .6) of units that have a node.
    let law = of("law");
    for ([at, share], expected) in law.iter().zip([0.288, 0.432, 0.216]) {
        assert!((share - expected / 0.936).abs() < 1e-8, "{at}: {share}");
    }
    assert_eq!(law.len(), 3);
    let measured = told.iter().filter(|row| row[0] == "\"measured");
    assert_eq!(
        measured.map(|row| row[3].parse::<f64>().expect("a share")).collect::<Vec<_>>(),
        [30.0 / 42.0, 12.0 / 42.0]
    );
    let page = fs::read_to_string(folder.path().join("report.html")).expect("the page");
    assert!(
        page.contains("run has no axes of order 5 that nodes.csv could be held against."),
        "an order that did not grow"
    );
    // The law of a trunk whose buds die with .03 at each step, as it stands in the figure of lives.
    let lives = rows(&folder.path().join("figures/lives-bush-1.csv"));
    for row in lives.iter().filter(|row| row[0] == "law") {
        let [tick, share] = [1, 2].map(|k| row[k].parse::<f64>().expect("a number"));
        let alive = (0..tick as u32).fold(1.0, |alive, _| 0.97 * alive);
        assert!((share - alive).abs() < 1e-7, "{row:?}");
    }
}

#[test]
fn a_report_has_the_same_bytes_each_time() {
    let folder = grown();
    let pages = ["one.html", "two.html"].map(|name| {
        run(folder.path(), &["report", "run", "--plants", "1", "--out", name]).ending(0);
        fs::read(folder.path().join(name)).expect("a page")
    });
    assert_eq!(pages[0], pages[1]);
}

#[test]
fn what_is_wrong_is_told() {
    let folder = grown();
    write(folder.path(), "bad.csv", "age,height_m\n8,1\neight,2\n");
    let said = run(folder.path(), &["report", "run", "--data", "bad.csv", "--out", "a.html"]).ending(3);
    assert!(said.stderr.contains("bad.csv:3: the age is `eight`; expected a whole number of ticks"), "{}", said.stderr);
    let said = run(folder.path(), &["report", "trial.toml", "--out", "a.html"]).ending(2);
    assert!(said.stderr.contains("trial.toml is no run folder"), "{}", said.stderr);
    let said = run(folder.path(), &["report", "run", "--out", "a.pdf"]).ending(2);
    assert!(said.stderr.contains("`report` cannot write `.pdf`"), "{}", said.stderr);
    let said = run(folder.path(), &["report", "run", "--data", "none.csv", "--out", "a.html"]).ending(1);
    assert!(said.stderr.contains("cannot read none.csv"), "{}", said.stderr);
    write(folder.path(), "nodes.csv", "nodes,count\n3,1\n4,x\n");
    let said = run(folder.path(), &["report", "run", "--data", "nodes.csv", "--out", "a.html"]).ending(3);
    assert!(said.stderr.contains("nodes.csv:3: `count` is `x`, which is no number"), "{}", said.stderr);
    write(folder.path(), "ragged.csv", "age,axes,dead\n3,10,1\n4,10\n");
    let said = run(folder.path(), &["report", "run", "--data", "ragged.csv", "--out", "a.html"]).ending(3);
    assert!(said.stderr.contains("ragged.csv:3:") && said.stderr.contains("2 cells under 3 names"), "{}", said.stderr);
    let twice = ["report", "run", "--data", "field.csv", "--data", "field.csv", "--out", "a.html"];
    let said = run(folder.path(), &twice).ending(2);
    assert!(said.stderr.contains("both have plants by age"), "{}", said.stderr);
    assert!(!folder.path().join("a.html").exists());
}

#[test]
fn a_browser_shows_a_report_without_scripts_and_without_network() {
    let Some((driver, browser)) = browser() else { return };
    let folder = grown();
    run(folder.path(), &["report", "run", "--data", "field.csv", "--out", "report.html"]).ending(0);
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/readers/report.mjs");
    let done = Command::new("node")
        .arg(script)
        .args([folder.path().join("report.html"), folder.path().join("page.png")])
        .env("PHYTOMER_PLAYWRIGHT", driver)
        .env("CHROMIUM", browser)
        .output()
        .expect("node starts");
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let found: Value = serde_json::from_slice(&done.stdout).expect("JSON");
    assert_eq!(found, serde_json::json!({"figures": 25, "pictures": 1, "tables": 7}));
}
