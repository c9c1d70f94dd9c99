//! `view` as people use it: a page in a real browser, the same bytes on any number of threads, and what is refused.
//!
//! The browser is a headless Chromium, driven by playwright-core (`tests/readers/view.mjs`), which are found where
//! `CHROMIUM` and `PHYTOMER_PLAYWRIGHT` name them; `.ci/run` installs both. Where they are missing the test skips and
//! says so, but never in CI. What it must see are the rows of `records` of the same plant, read by the parquet crate.
//! The data of pages are read once more in Python (`tests/external_readers.rs`).

#[path = "program/browser.rs"]
mod browser;
mod program;
mod read;

use browser::browser;
use program::{data, program as phytomer, run, said, write};
use read::Columns;
use serde_json::{Map, Value, json};
use std::fs;
use std::path::Path;
use std::process::Command;
use tempfile::tempdir;

/// The bush of the tests with every age recorded, and a second plant beside it.
const BUSH: &str = "name = \"viewed\"\nspecies = \"bush.toml\"\nplants = 2\nseed = 7\nspacing_m = 2\n\
                    ages = { until = 16, record = \"all\" }\n";

/// The columns of a row that are compared.
const OF_A_ROW: [&str; 13] = [
    "parent_id",
    "axis_id",
    "order",
    "rank",
    "birth_age",
    "age",
    "plant_id",
    "dir_x",
    "dir_y",
    "dir_z",
    "up_x",
    "up_y",
    "up_z",
];

/// The scenario of the tests in a folder, and its run.
fn bush(folder: &Path) {
    let species = fs::read_to_string(Path::new(&data("small.toml")).with_file_name("bush.toml")).expect("the species");
    write(folder, "bush.toml", &species);
    write(folder, "viewed.toml", BUSH);
}

/// The numbers of components of each kind by age, and the rows of the last age by component, as `records` has them.
fn facts(run: &Path, plant: f64) -> Value {
    let records = Columns::of(run, "records");
    let [plants, ages, components] = ["plant_id", "age", "component_id"].map(|name| records.numbers(name));
    let kinds = records.words("kind");
    let last = ages.iter().copied().fold(0.0, f64::max);
    let (mut counts, mut rows) = (Map::new(), Map::new());
    for row in (0..ages.len()).filter(|row| plants[*row] == plant) {
        let of_age = counts.entry(ages[row].to_string()).or_insert_with(|| json!({}));
        of_age[&kinds[row]] = json!(of_age[&kinds[row]].as_u64().unwrap_or(0) + 1);
        if ages[row] == last {
            let mut values = json!({"kind": kinds[row]});
            for name in OF_A_ROW {
                let value = records.numbers(name)[row];
                values[name] = if value.is_nan() { Value::Null } else { json!(value) };
            }
            rows.insert(components[row].to_string(), values);
        }
    }
    json!({"ages": counts, "plant": {last.to_string(): rows}})
}

#[test]
fn a_browser_shows_the_counts_of_records_and_finds_the_row_of_what_is_clicked() {
    let Some((driver, browser)) = browser() else { return };
    let folder = tempdir().unwrap();
    bush(folder.path());
    run(folder.path(), &["grow", "viewed.toml", "--quiet", "--out", "run"]).ending(0);
    let told = run(folder.path(), &["view", "run", "--out", "life.html"]).ending(0).stdout;
    assert!(told.starts_with("life.html: 1 plant at 17 ages, within "), "{told}");
    write(folder.path(), "facts.json", &facts(&folder.path().join("run"), 0.0).to_string());
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/readers/view.mjs");
    let mut node = Command::new("node");
    node.arg(script).args(["life.html", "facts.json"]).current_dir(folder.path());
    let done = node.env("PHYTOMER_PLAYWRIGHT", driver).env("CHROMIUM", browser).output().expect("node runs");
    let told = format!("{}{}", String::from_utf8_lossy(&done.stdout), String::from_utf8_lossy(&done.stderr));
    assert!(done.status.success(), "{told}");
    println!("{told}");
}

#[test]
fn the_bytes_do_not_depend_on_threads() {
    let folder = tempdir().unwrap();
    bush(folder.path());
    for words in [&["--plants", "0,1", "--tolerance", "1mm"][..], &["--plot", "1", "--ages", "0..16/4"]] {
        let page = |threads: &str| {
            let words = [&["view", "viewed.toml", "--out", "page.html"], words].concat();
            said(phytomer(folder.path(), &words).env("RAYON_NUM_THREADS", threads).output().unwrap()).ending(0);
            fs::read(folder.path().join("page.html")).unwrap()
        };
        let first = page("1");
        for threads in ["2", "8"] {
            assert!(page(threads) == first, "{words:?} on {threads} threads");
        }
    }
}

/// A finer page is larger, fewer ages and a stated tolerance are what the page says of itself.
#[test]
fn a_page_is_as_near_as_it_says() {
    let folder = tempdir().unwrap();
    bush(folder.path());
    let size = |words: &[&str]| {
        let words = [&["view", "viewed.toml", "--quiet", "--out", "page.html"], words].concat();
        let told = run(folder.path(), &words).ending(0).stdout;
        (told, fs::metadata(folder.path().join("page.html")).unwrap().len())
    };
    let (told, fine) = size(&["--tolerance", "0.1mm"]);
    assert!(told.contains("17 ages, within 100 µm"), "{told}");
    let (told, coarse) = size(&["--tolerance", "1cm"]);
    assert!(told.contains("within 10 mm") && coarse < fine, "{told}: {coarse} {fine}");
    let (told, _) = size(&["--ages", "4..12/4"]);
    assert!(told.contains("1 plant at 3 ages"), "{told}");
    // Whole ticks, which have the rows, are there too.
    let (told, _) = size(&["--ages", "1..4/0.75"]);
    assert!(told.contains("1 plant at 7 ages"), "{told}");
    let piped = run(folder.path(), &["view", "viewed.toml", "--ages", "3", "--out", "-"]).ending(0);
    assert!(piped.stdout.starts_with("<!DOCTYPE html>") && piped.stderr.starts_with("stdout: 1 plant at 1 age"));
    assert!(piped.stdout.trim_end().ends_with("</html>"));
}

#[test]
fn what_cannot_be_shown_is_refused() {
    let folder = tempdir().unwrap();
    bush(folder.path());
    let cases: [(&[&str], i32, &str); 15] = [
        (&["viewed.toml"], 2, "--out"),
        (&["viewed.toml", "--out", "a.pdf"], 2, "cannot write `.pdf`; the formats that it has: HTML (.html)"),
        (&["viewed.toml", "--out", "."], 2, "this is a folder"),
        (&["viewed.toml", "--out", "a.html", "--ages", "0..99"], 2, "--ages 99: the run has the ages 0 to 16"),
        (&["viewed.toml", "--out", "a.html", "--ages", "9..1"], 2, "the first age, 9, is after the last, 1"),
        (&["viewed.toml", "--out", "a.html", "--ages", "1..9/0"], 2, "a step of at least 0.001"),
        (&["viewed.toml", "--out", "a.html", "--tolerance", "1"], 2, "its unit is missing"),
        (&["viewed.toml", "--out", "a.html", "--tolerance", "0mm"], 2, "a length from 10 µm to 100 m"),
        (&["viewed.toml", "--out", "a.html", "--plant", "2"], 2, "--plant 2: the run has the plants 0 to 1"),
        (&["viewed.toml", "--out", "a.html", "--plants", "0,7"], 2, "--plants 7: the run has the plants 0 to 1"),
        (&["viewed.toml", "--out", "a.html", "--plants", "0,0"], 2, "--plants: plant 0 is named twice"),
        (&["viewed.toml", "--out", "a.html", "--plot", "9"], 2, "--plot 9: the run has the plots 0 to 1"),
        (&["viewed.toml", "--out", "a.html", "--plot", "0", "--plant", "1"], 2, "cannot be used with"),
        (&["viewed.toml", "--out", "a.html", "--ages", "soon"], 2, "such as 1..96"),
        (&["viewed.toml", "--out", "none/a.html"], 1, "none"),
    ];
    for (words, code, told) in cases {
        let said = run(folder.path(), &[&["view"], words].concat()).ending(code);
        assert!(said.stderr.contains(told), "{words:?}: {}", said.stderr);
        assert!(!folder.path().join("a.html").exists(), "{words:?}");
    }
    run(folder.path(), &["view", "no_such_thing", "--out", "a.html"]).ending(3);
}
