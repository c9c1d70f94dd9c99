//! Plans of grounds: sound ones pass, and each fault is told at its place.

mod mutate;

use mutate::{Draw, broken};
use phytomer_config::plan::{plan, plan_schema};
use std::fs;

const SOUND: &str = r#"
name = "court"
latitude_deg = 48.2

[[zone]]
name = "terrace"
corners_m = [[0, 0], [8, 0], [8, 5], [0, 5]]
allow = [{ months = [6, 7], least_h = 2 }, { most_h = 5 }]

[[building]]
place_m = [4, -4]
size_m = [10, 6, 7]
turn_deg = 90

[[tree]]
species = "coffee"
age = 12
place_m = [9, 6]

[arrange]
budget = 100

[[arrange.spot]]
name = "a"
place_m = [-1, 3]
row = 1

[[arrange.candidate]]
name = "small"
species = "coffee"
age = 12
cost = 10
"#;

/// What is told of a text, without colours.
fn told(text: &str) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("site.toml");
    fs::write(&file, text).expect("a file");
    match plan(&file.to_string_lossy()) {
        Ok(_) => String::new(),
        Err(report) => report.render(false),
    }
}

#[test]
fn a_sound_plan_has_its_species() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("site.toml");
    fs::write(&file, SOUND).expect("a file");
    let found = plan(&file.to_string_lossy()).unwrap_or_else(|report| panic!("{}", report.render(false)));
    assert_eq!((found.species.len(), found.plan.sun.step_min, found.plan.grid_m), (2, 15.0, 0.5));
    assert!(plan_schema().get("properties").is_some());
}

#[test]
fn each_fault_is_told_at_its_line() {
    let cases = [
        ("[8, 5], [0, 5]]", "[0, 5], [8, 5]]", ":7:", "cross or touch"),
        ("[[0, 0], [8, 0], [8, 5], [0, 5]]", "[[0, 0], [8, 0]]", ":7:", "2 items"),
        ("[[0, 0], [8, 0], [8, 5], [0, 5]]", "[[0, 0], [0, 0], [8, 5]]", ":7:", "same place"),
        ("latitude_deg = 48.2", "latitude_deg = 98.2", ":3:", "[-90, 90]"),
        ("latitude_deg = 48.2", "latitude_deg = nan", ":3:", "a finite number"),
        ("latitude_deg = 48.2", "", "", "`latitude_deg` is missing"),
        ("size_m = [10, 6, 7]", "size_m = [10, 6, -7]", ":12:", "-7"),
        ("size_m = [10, 6, 7]", "size_m = [10, 6, 7]\nfrom_m = 7", ":13:", "underside"),
        ("species = \"coffee\"\nage = 12\nplace_m", "species = \"coffe\"\nage = 12\nplace_m", ":16:", "`coffee`"),
        ("place_m = [9, 6]", "place_m = [-1, 3]", ":25:", "has this place already"),
        ("place_m = [9, 6]", "place_m = [5, -8]", ":18:", "inside building 1"),
        ("least_h = 2", "least_h = 25", ":8:", "25"),
        ("least_h = 2", "least_h = 2, most_h = 1", ":8:", "at least 2 hours and at most 1"),
        ("{ most_h = 5 }", "{ months = [1] }", ":8:", "neither bound"),
        ("months = [6, 7]", "months = [13]", ":8:", "13"),
        ("cost = 10", "cost = -10", ":32:", "-10"),
        ("budget = 100", "buget = 100", ":21:", "`budget`"),
        ("row = 1", "row = 0", ":26:", "0"),
        (
            "[[arrange.candidate]]",
            "[[arrange.spot]]\nname = \"a\"\nplace_m = [1, 9]\n[[arrange.candidate]]",
            ":29:",
            "second spot",
        ),
    ];
    let mut wrong = Vec::new();
    for (from, to, line, words) in cases {
        let text = SOUND.replacen(from, to, 1);
        assert_ne!(text, SOUND, "{from}");
        let told = told(&text);
        if !(told.contains(line) && told.contains(words)) {
            wrong.push(format!("{to}, {line} {words}:\n{told}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn broken_plans_are_read_or_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("site.toml");
    let mut sound = 0;
    for number in 0..1500 {
        let text = broken(SOUND.as_bytes(), &mut Draw::of_mutation(number));
        fs::write(&file, &text).expect("a file");
        match plan(&file.to_string_lossy()) {
            Ok(found) => {
                assert!(found.plan.zone.iter().all(|zone| zone.corners_m.len() >= 3), "mutation {number}");
                sound += 1;
            }
            Err(report) => assert!(!report.faults.is_empty(), "mutation {number}"),
        }
    }
    assert!((30..1350).contains(&sound), "{sound} of 1500 stayed sound");
}
