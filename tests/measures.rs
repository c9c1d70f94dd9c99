//! `measure` on the command line: what it tells of small runs, and how it refuses what cannot be measured.
//!
//! Numbers are held against other programs in `external_readers`, intervals in `analysis/measures/tests`. Here are runs
//! of one plant, of one group, without a table, unfinished or of another schema: each gives a fault with its file, or a
//! result that says what could not be estimated, and never NaN.

mod program;

use program::run;
use serde_json::Value;
use std::fs;
use std::path::Path;
use tempfile::tempdir;

const SCENARIO: &str =
    "name = \"small\"\nspecies = \"coffee\"\nplants = 6\nseed = 3\nages = { until = 24, record = [12, 24] }\n";

fn grow(folder: &Path, name: &str, text: &str) {
    fs::write(folder.join(format!("{name}.toml")), text).unwrap();
    run(folder, &["grow", &format!("{name}.toml"), "--quiet", "--out", name]).ending(0);
}

fn measured(folder: &Path, words: &[&str]) -> Value {
    let told = run(folder, &[&["measure"], words, &["--json"]].concat()).ending(0).stdout;
    assert!(!told.contains("NaN"), "{told}");
    serde_json::from_str(&told).unwrap()
}

fn rows<'a>(of: &'a Value, sheet: &str) -> &'a [Value] {
    of["tables"][sheet]["rows"].as_array().unwrap_or_else(|| panic!("no sheet {sheet} in {of}"))
}

fn notes(of: &Value) -> String {
    of["notes"].as_array().unwrap().iter().map(|note| note.as_str().unwrap()).collect::<Vec<_>>().join("\n")
}

#[test]
fn every_measure_of_a_list_is_taken_and_written() {
    let folder = tempdir().unwrap();
    grow(folder.path(), "small", SCENARIO);
    let list: Value =
        serde_json::from_str(&run(folder.path(), &["measure", "--list", "--json"]).ending(0).stdout).unwrap();
    let names: Vec<&str> = list.as_array().unwrap().iter().map(|card| card["name"].as_str().unwrap()).collect();
    assert!(names.len() >= 25, "{names:?}");
    for name in names {
        let of = measured(folder.path(), &["small", name, "--difference", "0.1"]);
        let first = of["tables"].as_object().unwrap().values().next().unwrap()["rows"].as_array().unwrap();
        assert!(!first.is_empty() || !notes(&of).is_empty(), "{name} tells nothing: {of}");
        for ending in ["csv", "json"] {
            let file = format!("{name}.{ending}");
            run(folder.path(), &["measure", "small", name, "--difference", "0.1", "--out", &file]).ending(0);
            let text = fs::read_to_string(folder.path().join(file)).unwrap();
            assert!(!text.contains("NaN"), "{text}");
            assert!(ending == "json" || text.lines().count() == first.len() + 1, "{text}");
        }
    }
}

#[test]
fn one_plant_has_no_interval_and_says_so() {
    let folder = tempdir().unwrap();
    grow(folder.path(), "one", &SCENARIO.replace("plants = 6", "plants = 1"));
    for (name, sheet, value) in [
        ("height", "mean", "mean"),
        ("bud-life", "survival", "survival"),
        ("nodes-per-axis", "nodes", "mean"),
        ("activity", "activity", "mean"),
        ("divergence", "angle", "mean"),
        ("clear-bole", "clear_bole", "mean"),
        ("branching", "branching", "count"),
    ] {
        let of = measured(folder.path(), &["one", name]);
        let row = &rows(&of, sheet)[0];
        assert!(row[value].is_number() && row["low"].is_null() && row["high"].is_null(), "{name}: {row}");
        assert!(notes(&of).contains("1 plant: an interval of plant values needs"), "{name}: {}", notes(&of));
    }
    let living = measured(folder.path(), &["one", "living"]);
    assert!(rows(&living, "living")[0]["low"].is_number(), "Wilson's interval holds for one plant: {living}");
    let contrast = measured(folder.path(), &["one", "contrast"]);
    assert!(notes(&contrast).contains("1 group with values: 2 or more are needed"), "{contrast}");
}

#[test]
fn runs_are_measured_together_and_paired_by_seed() {
    let folder = tempdir().unwrap();
    grow(folder.path(), "a", SCENARIO);
    grow(folder.path(), "b", SCENARIO);
    grow(folder.path(), "c", &SCENARIO.replace("seed = 3", "seed = 4"));
    let both = measured(folder.path(), &["a", "c", "height", "--by", "run"]);
    let groups: Vec<&str> = rows(&both, "mean").iter().map(|row| row["group"].as_str().unwrap()).collect();
    assert_eq!(groups, ["a", "c"]);
    assert_eq!(rows(&measured(folder.path(), &["a", "c", "height"]), "mean")[0]["plants"], 12);
    // The same seed draws the same plants: the difference of each pair is nothing.
    let same = measured(folder.path(), &["a", "b", "contrast"]);
    let paired = &rows(&same, "contrast")[0];
    assert_eq!((&paired["design"], &paired["n"], &paired["difference"]), (&"paired".into(), &6.into(), &0.0.into()));
    assert!(notes(&same).contains("all values are equal"), "{}", notes(&same));
    let other = measured(folder.path(), &["a", "c", "contrast"]);
    assert_eq!(rows(&other, "contrast")[0]["n"], 0, "another seed makes no pairs");
    assert!(rows(&other, "contrast")[1]["p"].is_number());
}

/// Trees that are cut: what is cut is censored, and no cause of an end.
#[test]
fn a_cut_censors() {
    let folder = tempdir().unwrap();
    let cut = "planting_date = \"2001-01-01\"\ncalendar = { tick = { days = 30 } }\n\n\
               [[event]]\noperation = \"heading\"\ndate = \"2002-03-01\"\nonly = \"order == 1\"\nkeep_share = 0.5\n";
    grow(folder.path(), "cut", &format!("{SCENARIO}{cut}"));
    let rows_of = |words: &[&str], sheet: &str| rows(&measured(folder.path(), words), sheet).to_vec();
    let causes = rows_of(&["cut", "bud-causes"], "causes");
    assert!(!causes.is_empty() && causes.iter().all(|row| row["cause"] != "pruned"), "{causes:?}");
    let trunks: Vec<Value> = rows_of(&["cut", "bud-life", "--by", "order"], "survival")
        .into_iter()
        .filter(|row| row["group"] == "1")
        .collect();
    let censored: u64 = trunks.iter().map(|row| row["censored"].as_u64().unwrap()).sum();
    let before_the_end = trunks.iter().filter(|row| row["dimension"].as_u64() < Some(24));
    assert!(before_the_end.map(|row| row["censored"].as_u64().unwrap()).sum::<u64>() > 0, "{censored}: {trunks:?}");
}

/// A plot that ends at its limit of components censors at its last whole tick, not at the end of the run.
#[test]
fn a_limit_of_components_censors() {
    let folder = tempdir().unwrap();
    // Between the expectation and the largest plant.
    let limits = "limits = { max_components = 575 }\n";
    let text = SCENARIO.replace("plants = 6", "plants = 40");
    fs::write(folder.path().join("limited.toml"), format!("{text}{limits}")).unwrap();
    run(folder.path(), &["grow", "limited.toml", "--quiet", "--out", "limited"]).ending(1);
    let json: Value =
        serde_json::from_str(&fs::read_to_string(folder.path().join("limited/run.json")).unwrap()).unwrap();
    let ends: Vec<u64> =
        json["overgrown"].as_array().unwrap().iter().map(|of| of["tick"].as_u64().unwrap() - 1).collect();
    assert!(!ends.is_empty() && ends.len() < 40 && ends.iter().all(|end| *end < 24), "{ends:?}");
    let life = measured(folder.path(), &["limited", "bud-life", "--by", "order"]);
    // The bud of a trunk is as old as its plant: it is censored at the end of the run or of its plot.
    let trunks = rows(&life, "survival").iter().filter(|row| row["group"] == "1");
    for row in trunks {
        let (at, censored) = (row["dimension"].as_u64().unwrap(), row["censored"].as_u64().unwrap());
        let limited = ends.iter().filter(|end| **end == at).count() as u64;
        assert!(at == 24 || censored <= limited, "{censored} are censored at {at}, {limited} plots end there");
    }
    let censored_at = |at: u64| {
        let row = rows(&life, "survival").iter().find(|row| row["group"] == "1" && row["dimension"] == at);
        row.map_or(0, |row| row["censored"].as_u64().unwrap())
    };
    assert!(ends.iter().any(|end| censored_at(*end) > 0), "{ends:?}");
}

#[test]
fn what_cannot_be_measured_is_refused_with_its_reason() {
    let folder = tempdir().unwrap();
    grow(folder.path(), "small", SCENARIO);
    let refused = |words: &[&str], code: i32, reason: &str| {
        let told = run(folder.path(), &[&["measure"], words].concat()).ending(code).stderr;
        assert!(told.contains(reason), "{words:?}: {told}");
    };
    refused(&["small", "heigth"], 2, "there is no measure `heigth`; there are: bud-life");
    refused(&["height"], 2, "a run is expected before the name");
    refused(&["nowhere", "height"], 2, "there is no run `nowhere`");
    refused(
        &["small", "height", "--by", "order"],
        2,
        "--by order: `height` has no such groups; it has: run, treatment",
    );
    refused(&["small", "power"], 2, "--difference: `power` needs the difference");
    refused(&["small", "power", "--difference", "nan"], 2, "--difference NaN: a number other than 0 is expected");
    refused(&["small", "height", "--level", "1"], 2, "--level 1: a share between 0 and 1");
    refused(&["small", "crown-profile", "--layer", "0"], 2, "--layer 0: a thickness above 0 m");
    refused(&["small", "contrast", "--of", "weight"], 2, "`weight` is no number of plants; there are: height_m");
    refused(&["small", "height", "--age", "13"], 2, "--age 13: small has no rows of that age; recorded are 12, 24");
    refused(&["small", "height", "--out", "a.xlsx"], 2, "`measure` cannot write `.xlsx`");
    grow(folder.path(), "bare", &format!("{SCENARIO}tables = [\"summary\"]\n"));
    refused(&["bare", "bud-life"], 1, "bare: the run has no table `components`");
    refused(&["bare", "divergence"], 1, "bare: the run has no table `records`");
    change(folder.path(), "small", "older", |json| json["schema_version"] = "1".into());
    refused(&["small", "older", "height"], 1, "older has tables of schema 1, small of schema");
    change(folder.path(), "small", "begun", |json| json["status"] = "unfinished".into());
    refused(&["begun", "height"], 1, "begun: the run is not finished");
}

/// A copy of a run with another `run.json`, written as by an older program, which kept no checks.
fn change(folder: &Path, run: &str, name: &str, change: impl FnOnce(&mut Value)) {
    let (from, to) = (folder.join(run), folder.join(name));
    fs::create_dir(&to).unwrap();
    let mut json: Value = serde_json::from_str(&fs::read_to_string(from.join("run.json")).unwrap()).unwrap();
    json.as_object_mut().unwrap().remove("check");
    json.as_object_mut().unwrap().remove("format_version");
    change(&mut json);
    fs::write(to.join("run.json"), serde_json::to_string(&json).unwrap()).unwrap();
    for table in ["summary", "plants", "treatments"] {
        fs::create_dir(to.join(table)).unwrap();
        for entry in fs::read_dir(from.join(table)).unwrap().flatten() {
            fs::copy(entry.path(), to.join(table).join(entry.file_name())).unwrap();
        }
    }
}
