//! Hours of shade, from the file of a plan to its table, its drawings and an arrangement.
//!
//! Absent: closed forms of shadows (`outputs/shade`), and the faults of a plan's file (`config/tests/plans.rs`).

mod program;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, Int32Type};
use arrow_array::{Array, RecordBatch};
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use phytomer::shade::{Ground, Planted, arrange};
use phytomer_config::plan::{ResolvedPlan, plan};
use phytomer_shade::Watch;
use program::{Said, program, run, said};
use std::fs::{self, File};
use std::path::Path;
use std::process::Command;
use tempfile::tempdir;

/// A yard with a house, a tree and six spots for three kinds of candidates, followed roughly.
const YARD: &str = r#"
name = "yard"
latitude_deg = 47
sun = { days_a_month = 1, step_min = 60 }
grid_m = 0.25
tolerance_m = 0.02

[[zone]]
name = "bench"
corners_m = [[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]]
allow = [{ months = [6, 7], least_h = 1.5 }, { most_h = 6 }]

[[zone]]
name = "bed"
corners_m = [[4, 0], [7, 0], [7, 2], [4, 2]]
weight = -0.5
allow = [{ months = [5], most_h = 7 }]

[[building]]
name = "house"
place_m = [2, -5]
size_m = [6, 4, 3]

[[tree]]
species = "coffee"
age = 30
place_m = [3.5, 1.5]
leafless_months = [3, 4]

[arrange]
budget = 100
spot = [
    { name = "a", place_m = [-0.5, -0.5], row = 1 },
    { name = "b", place_m = [1, -1], row = 1 },
    { name = "c", place_m = [2.5, -0.5], row = 1 },
    { name = "d", place_m = [0.5, -2], row = 2 },
    { name = "e", place_m = [2, -1.5], row = 2 },
    { name = "f", place_m = [3.5, -2] },
]
candidate = [
    { name = "small", species = "coffee", age = 24, cost = 12 },
    { name = "middle", species = "coffee", age = 40, seed = 5, cost = 21, at_most = 3 },
    { name = "high", species = "coffee", age = 60, seed = 9, cost = 40 },
]
"#;

fn lay(folder: &Path, text: &str) {
    fs::write(folder.join("site.toml"), text).unwrap();
}

fn shade(folder: &Path, words: &[&str]) -> Said {
    run(folder, &[&["shade", "site.toml"], words].concat())
}

/// The rows of a table in one batch.
fn table(path: &Path) -> RecordBatch {
    let file = File::open(path).unwrap();
    let mut batches = ParquetRecordBatchReaderBuilder::try_new(file).unwrap().with_batch_size(1 << 20).build().unwrap();
    batches.next().unwrap().unwrap()
}

fn numbers(batch: &RecordBatch, column: &str) -> Vec<Option<f64>> {
    let column = batch.column_by_name(column).unwrap().as_primitive::<Float64Type>();
    (0..column.len()).map(|row| column.is_valid(row).then(|| column.value(row))).collect()
}

#[test]
fn a_plan_becomes_a_table_and_a_drawing() {
    let folder = tempdir().unwrap();
    lay(folder.path(), YARD);
    let json = shade(folder.path(), &["--json", "--quiet"]).ending(0).json();
    assert_eq!(json["files"], serde_json::json!(["shade.parquet", "plan.svg"]));
    let batch = table(&folder.path().join("yard/shade.parquet"));
    assert_eq!((batch.num_rows(), batch.num_columns()), (26, 11));
    let months = batch.column_by_name("month").unwrap().as_primitive::<Int32Type>();
    assert!((0..26).all(|row| months.is_valid(row) == (row % 13 < 12)), "the row of the year has no month");
    let all = |column: &str| numbers(&batch, column).into_iter().map(Option::unwrap).collect::<Vec<f64>>();
    let (sun, hours, of_house, of_tree) = (all("sun_h"), all("shade_h"), all("building_h"), all("plant_h"));
    for row in 0..26 {
        assert!((hours[row] - of_house[row] - of_tree[row]).abs() < 1e-12);
        assert!(hours[row] >= 0.0 && hours[row] <= sun[row] + 1e-9);
    }
    assert!(of_tree[6] > 0.05 && of_house[11] > of_house[5], "the house shades more in winter");
    assert!(all("area_m2")[..13].iter().all(|area| (area - 5.0).abs() < 1e-12));
    // Without leaves the tree shades less, under nearly the same sun.
    assert!(of_tree[13 + 3] < of_tree[13 + 7], "April {}, August {}", of_tree[16], of_tree[20]);
    let year = (0..12).map(|month| hours[month] * [31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31][month] as f64);
    assert!((year.sum::<f64>() / 365.0 - hours[12]).abs() < 1e-9);
    let drawn = fs::read_to_string(folder.path().join("yard/plan.svg")).unwrap();
    for words in ["yard", "bench", "house", "coffee", ">N<", " m</text>", "data:image/png;base64,"] {
        assert!(drawn.contains(words), "{words}");
    }
    let refused = shade(folder.path(), &[]).ending(2);
    assert!(refused.stderr.contains("has hours of shade already"), "{}", refused.stderr);
}

#[test]
fn bytes_do_not_depend_on_threads() {
    let folder = tempdir().unwrap();
    lay(folder.path(), YARD);
    for threads in ["1", "3"] {
        let words = ["shade", "site.toml", "--arrange", "--quiet", "--out", threads];
        said(program(folder.path(), &words).env("RAYON_NUM_THREADS", threads).output().unwrap()).ending(0);
    }
    for file in ["shade.parquet", "plan.svg", "arranged.svg", "arrangement.parquet"] {
        let [one, three] = ["1", "3"].map(|threads| fs::read(folder.path().join(threads).join(file)).unwrap());
        assert!(one == three, "{file}");
    }
}

fn resolved(folder: &Path, text: &str) -> ResolvedPlan {
    lay(folder, text);
    plan(&folder.join("site.toml").to_string_lossy()).unwrap_or_else(|report| panic!("{}", report.render(false)))
}

/// Six spots and three candidates, or nothing: 4,096 arrangements, each asked by what the rules say in words.
#[test]
fn an_arrangement_is_the_best_of_all_of_them() {
    let folder = tempdir().unwrap();
    let resolved = resolved(folder.path(), YARD);
    let (asked, watch) = (resolved.plan.arrange.as_ref().unwrap(), Watch::default());
    let ground = Ground::of(&resolved, &mut |_| {}, &watch).unwrap();
    let (planned, found) = arrange(&ground, asked, &mut |_| {}, &watch).unwrap();
    let trials = (0..18).map(|k| Planted { spot: k / 3, candidate: k % 3 }).collect::<Vec<Planted>>();
    let base = ground.hours(&[], &trials, &watch).unwrap();
    assert_eq!(planned.zones, base.zones);
    let sum = |chosen: &[Option<usize>], zone: usize, month: usize| -> f64 {
        let planted = chosen.iter().enumerate().filter_map(|(spot, chosen)| chosen.map(|chosen| 3 * spot + chosen));
        planted.map(|trial| base.added[trial][zone][month]).sum()
    };
    let rows = [Some(1), Some(1), Some(1), Some(2), Some(2), None];
    let heights = [0, 1, 2].map(|candidate| ground.height_m(candidate));
    assert!(heights[0] < heights[1] && heights[1] < heights[2], "{heights:?}");
    let in_order = |chosen: &[Option<usize>]| {
        let taller = |front: usize, back: usize| {
            chosen[front].zip(chosen[back]).is_some_and(|(front, back)| heights[front] > heights[back])
        };
        (0..6).all(|front| (0..6).all(|back| !(rows[front] == Some(1) && rows[back] == Some(2) && taller(front, back))))
    };
    let keeps = |chosen: &[Option<usize>]| {
        let hours = |zone: usize, month: usize| base.zones[zone][month].shade_h() + sum(chosen, zone, month);
        let cost: f64 = chosen.iter().flatten().map(|candidate| [12.0, 21.0, 40.0][*candidate]).sum();
        cost <= 100.0
            && chosen.iter().filter(|chosen| **chosen == Some(1)).count() <= 3
            && in_order(chosen)
            && [5, 6].iter().all(|month| hours(0, *month) >= 1.5)
            && hours(0, 12) <= 6.0
            && hours(1, 4) <= 7.0
    };
    let worth = |chosen: &[Option<usize>]| sum(chosen, 0, 12) - 0.5 * sum(chosen, 1, 12);
    // What was refused for its union cannot be the answer.
    assert_eq!(found.refused, 0);
    let all = (0..4096_usize).map(|number| (0..6).map(|spot| (number >> (2 * spot) & 3).checked_sub(1)).collect());
    let sound: Vec<Vec<Option<usize>>> = all.filter(|chosen: &Vec<Option<usize>>| keeps(chosen)).collect();
    assert!(sound.len() > 10 && sound.len() < 4000, "{}", sound.len());
    let best = sound.iter().map(|chosen| worth(chosen)).fold(f64::NEG_INFINITY, f64::max);
    assert!(keeps(&found.chosen) && (worth(&found.chosen) - best).abs() < 1e-9, "{:?}, {best}", found.chosen);
    assert!((found.added_h[0] - best).abs() < 1e-9 && found.checks.iter().all(|check| check.holds()));
    for check in &found.checks {
        assert!(check.together_h <= check.summed_h + 1e-9 && check.together_h >= check.planned_h - 1e-9);
    }
}

/// A least that two trees reach by the sum of their hours alone, because their shadows overlap.
#[test]
fn an_arrangement_whose_shadows_overlap_too_much_is_refused() {
    let folder = tempdir().unwrap();
    let text = |least: f64| {
        format!(
            r#"
name = "pair"
latitude_deg = 47
sun = {{ days_a_month = 1, step_min = 30 }}
grid_m = 0.25
zone = [{{ name = "bench", corners_m = [[0, 0], [3, 0], [3, 2], [0, 2]], allow = [{{ months = [6], least_h = {least} }}] }}]
[arrange]
aim = "cheapest"
spot = [
    {{ name = "a", place_m = [1.4, 0.9] }}, {{ name = "b", place_m = [1.6, 0.9] }}, {{ name = "c", place_m = [0.4, 0.4] }},
]
candidate = [{{ name = "high", species = "coffee", age = 60, cost = 10, at_most = 2 }}]
"#
        )
    };
    let watch = Watch::default();
    let loose = resolved(folder.path(), &text(0.0));
    let ground = Ground::of(&loose, &mut |_| {}, &watch).unwrap();
    let trials = [0, 1, 2].map(|spot| Planted { spot, candidate: 0 });
    let alone = ground.hours(&[], &trials, &watch).unwrap();
    let by_sum = |a: usize, b: usize| alone.added[a][0][5] + alone.added[b][0][5];
    let together =
        |a: usize, b: usize| ground.hours(&[trials[a], trials[b]], &[], &watch).unwrap().zones[0][5].shade_h();
    let pairs = [(0, 1), (0, 2), (1, 2)];
    let most = pairs.map(|(a, b)| together(a, b)).into_iter().fold(0.0, f64::max);
    // More than any pair has together, and no more than a pair has by its sum: nothing holds.
    let sums = pairs.map(|(a, b)| by_sum(a, b)).into_iter().fold(0.0, f64::max);
    assert!(sums > most + 0.2, "{sums} {most}");
    lay(folder.path(), &text(most + 0.1));
    let said = shade(folder.path(), &["--arrange", "--quiet"]).ending(3);
    assert!(said.stderr.contains("their shadows together do not"), "{}", said.stderr);
    // What the best pair has together is found, though a pair with a larger sum may come first.
    lay(folder.path(), &text(most - 1e-6));
    let json = shade(folder.path(), &["--arrange", "--quiet", "--json"]).ending(0).json();
    assert!(
        json["allowed"][0]["holds"].as_bool().unwrap()
            && json["allowed"][0]["together_h"].as_f64().unwrap() >= most - 1e-6
    );
}

#[test]
fn what_no_arrangement_keeps_is_named() {
    let folder = tempdir().unwrap();
    let cases: [(&str, &str, &[&str]); 4] = [
        ("least_h = 1.5", "least_h = 14", &["at least 14 h of shade a day on `bench` in July", "site.toml:11:"]),
        (
            "budget = 100",
            "budget = 30\nevery_spot = true",
            &["the budget of 30", "every spot is planted", "site.toml:31:"],
        ),
        ("{ most_h = 6 }", "{ most_h = 0.01 }", &["at most 0.01 h of shade a day on `bench` in the mean of the year"]),
        ("at_most = 3", "at_most = 0", &[]),
    ];
    for (from, to, words) in cases {
        let text = YARD.replacen(from, to, 1);
        assert_ne!(text, YARD);
        lay(folder.path(), &text);
        let said = shade(folder.path(), &["--arrange", "--quiet", "--overwrite"]);
        let said = said.ending(if words.is_empty() { 0 } else { 3 });
        assert!(words.iter().all(|words| said.stderr.contains(words)), "{to}: {}", said.stderr);
    }
    lay(folder.path(), &YARD[..YARD.find("[arrange]").unwrap()]);
    let said = shade(folder.path(), &["--arrange"]).ending(2);
    assert!(said.stderr.contains("has no [arrange]"), "{}", said.stderr);
    lay(folder.path(), &YARD.replacen("grid_m = 0.25", "grid_m = 0.01", 1).replacen("[7, 2]", "[7e4, 2]", 1));
    let said = shade(folder.path(), &["--overwrite"]).ending(3);
    assert!(said.stderr.contains("cells") && said.stderr.contains("grid_m"), "{}", said.stderr);
}

#[test]
fn a_polar_night_has_no_hours_and_no_share() {
    let folder = tempdir().unwrap();
    let text = YARD.replacen("latitude_deg = 47", "latitude_deg = 85", 1);
    lay(folder.path(), &text[..text.find("[arrange]").unwrap()]);
    shade(folder.path(), &["--month", "12", "--quiet"]).ending(0);
    let batch = table(&folder.path().join("yard/shade.parquet"));
    let [sun, hours, share, mostly] =
        ["sun_h", "shade_h", "share", "mostly_shaded"].map(|column| numbers(&batch, column)[11]);
    assert_eq!((sun, hours, share, mostly), (Some(0.0), Some(0.0), None, None));
    assert_eq!(numbers(&batch, "sun_h")[5], Some(24.0));
    assert!(!fs::read_to_string(folder.path().join("yard/plan.svg")).unwrap().contains("NaN"));
}

/// A program of its own in Python casts rays from points of its own at a sun of its own.
#[test]
fn an_independent_program_finds_the_same_hours() {
    let python = Path::new(env!("CARGO_MANIFEST_DIR")).join(".venv/bin/python");
    if !python.is_file() {
        assert!(std::env::var_os("CI").is_none(), "the readers are installed by .ci/run");
        return;
    }
    let folder = tempdir().unwrap();
    let wall = "name = \"wall\"\nlatitude_deg = -34\nlongitude_deg = 151\ngrid_m = 0.1\n\
                sun = { days_a_month = 31, step_min = 5 }\n\
                [[zone]]\nname = 'angle <&> \"a\"'\ncorners_m = [[-6, -8], [5, -7], [4, -1], [0, -4], [-5, -2]]\n\
                [[zone]]\nname = \"yard\"\ncorners_m = [[5, 1], [9, 1], [9, 6], [5, 6]]\n\
                [[building]]\nplace_m = [0, 0]\nsize_m = [9, 2, 5]\nturn_deg = 20\n\
                [[building]]\nplace_m = [6, -3]\nsize_m = [2, 2, 3]\nfrom_m = 2\n";
    lay(folder.path(), wall);
    shade(folder.path(), &["--quiet"]).ending(0);
    let reader = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/readers/shade.py");
    let arguments = [reader, folder.path().join("site.toml"), folder.path().join("wall")];
    let output = Command::new(python).args(arguments).output().unwrap();
    let told = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && told.contains("shade ok"), "{told}");
}

#[test]
fn the_plan_that_ships_is_sound_and_so_is_its_picture() {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/shade");
    let found = plan(&docs.join("court.toml").to_string_lossy());
    let found = found.unwrap_or_else(|report| panic!("{}", report.render(false)));
    for drawing in ["plan.svg", "arranged.svg"] {
        let text = fs::read_to_string(docs.join(drawing)).unwrap();
        assert!(found.plan.zone.iter().all(|zone| text.contains(&zone.name)), "{drawing}");
    }
    let page = fs::read_to_string(docs.join("../shade.md")).unwrap();
    let shown = page.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    assert_eq!(shown, fs::read_to_string(docs.join("court.toml")).unwrap(), "docs/shade.md shows the plan that ships");
}
