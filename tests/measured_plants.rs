//! Runs of measured plants through the verbs that draw and tell: meshes with the numbers and the places of the tables,
//! pages and reports of the ages at which something was measured, architectural models, and what is refused.
//!
//! Plants are grown, written as MTG and read back, so that what was measured is known; the data of other programs are
//! those of `exchange` in the folder of measured data. Absent: the tables themselves (`measured_runs`).

#[path = "program/absent.rs"]
mod absent;
#[allow(dead_code, reason = "places of plots are not read here")]
mod ply;
mod program;
mod read;

use program::run;
use read::Columns;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use tempfile::{TempDir, tempdir};

/// A plant of two internodes on one date, of three and a branch four weeks later, and one without places. As in files
/// of others a component ends at its place.
const TWO_DATES: &str = "CODE:\tFORM-A\nCLASSES:\nP\t1\nA\t2\nI\t3\nDESCRIPTION:\nFEATURES:\nDate\tDD/MM/YY\nLength\tREAL\n\
    BottomDiameter\tREAL\nXX\tREAL\nYY\tREAL\nZZ\tREAL\nMTG:\nENTITY-CODE\t\tDate\tLength\tBottomDiameter\tXX\tYY\tZZ\n\
    /P1\n^/A1\t\t01/05/20\t\t\t0\t0\t0\n^/I1\t\t01/05/20\t0.1\t0.02\t0\t0\t0.1\n*\t\t29/05/20\t0.1\t0.03\t0\t0\t0.1\n\
    ^<I2\t\t01/05/20\t0.1\t0.02\t0\t0\t0.2\n\t+A2/I1\t29/05/20\t0.1\t0.01\t0.1\t0\t0.2\n\
    ^<I3\t\t29/05/20\t0.1\t0.02\t0\t0\t0.3\n/P2/A1/I1\t\t29/05/20\t0.2\n";

/// A young coffee tree as a run of measured plants.
fn coffee() -> TempDir {
    let folder = tempdir().expect("a folder");
    run(folder.path(), &["convert", "coffee", "coffee.mtg", "--age", "20"]).ending(0);
    run(folder.path(), &["convert", "coffee.mtg", "measured"]).ending(0);
    folder
}

fn two_dates() -> TempDir {
    let folder = tempdir().expect("a folder");
    fs::write(folder.path().join("two.mtg"), TWO_DATES).expect("a file");
    run(folder.path(), &["convert", "two.mtg", "two"]).ending(0);
    folder
}

/// The places of the vertices of each component of a PLY file, and its number of triangles.
fn vertices(path: &Path) -> (BTreeMap<u32, Vec<[f64; 3]>>, usize) {
    const VERTEX: usize = 49;
    let (header, bytes) = ply::mesh(path);
    let mut of: BTreeMap<u32, Vec<[f64; 3]>> = BTreeMap::new();
    for vertex in bytes.chunks(VERTEX).take(ply::count(&header, "vertex")) {
        let number = |at: usize| f64::from(f32::from_le_bytes(vertex[at..at + 4].try_into().expect("four bytes")));
        let component = u32::from_le_bytes(vertex[44..48].try_into().expect("four bytes"));
        of.entry(component).or_default().push([0, 4, 8].map(number));
    }
    (of, ply::count(&header, "face"))
}

/// Each component that has a place in `records` is in the mesh under its number, and no other; the corners of an
/// internode lie on the frustum that its row tells.
#[test]
fn a_mesh_has_the_components_and_the_places_of_the_tables() {
    let folder = coffee();
    let told = run(folder.path(), &["mesh", "measured", "--sides", "64", "--out", "plant.ply"]).ending(0).stdout;
    assert!(told.contains("plant 0 as measured at age 20"), "{told}");
    let (found, faces) = vertices(&folder.path().join("plant.ply"));
    let records = Columns::of(&folder.path().join("measured"), "records");
    let column = |name: &str| records.numbers(name);
    let kinds = records.words("kind");
    let mut placed = Vec::new();
    for row in (0..kinds.len()).filter(|row| !column("x_m")[*row].is_nan()) {
        let vector = |names: [&str; 3]| names.map(|name| column(name)[row]);
        let component = column("component_id")[row] as u32;
        placed.push(component);
        if !kinds[row].ends_with("internode") {
            continue;
        }
        let (base, along) = (vector(["x_m", "y_m", "z_m"]), vector(["dir_x", "dir_y", "dir_z"]));
        let [length, low, tip] = ["length_m", "diameter_m", "diameter_tip_m"].map(|name| column(name)[row]);
        let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
        for at in &found[&component] {
            let from = [0, 1, 2].map(|k| at[k] - base[k]);
            let t = dot(from, along);
            let across = dot(from, from) - t * t;
            let radius = 0.5 * (low + (t / length).clamp(0.0, 1.0) * (tip - low));
            assert!((-1e-5..=length + 1e-5).contains(&t), "{component}: {t} of {length}");
            // A tube of 64 sides has the section of the circle, so that its corners stand out by a thousandth.
            assert!((across.max(0.0).sqrt() - radius).abs() < 2e-3 * radius + 1e-6, "{component}: {across} {radius}");
        }
    }
    placed.sort_unstable();
    assert!(placed.len() > 100 && faces > placed.len());
    assert_eq!(found.keys().copied().collect::<Vec<_>>(), placed);
    for out in ["plant.glb", "plant.stl", "plant.usda", "plot.glb"] {
        let plot: &[&str] = if out.starts_with("plot") { &["--plot", "--leaves", "instances"] } else { &[] };
        let words = ["mesh", "measured", "--tolerance", "1mm", "--detail", "1", "--out", out];
        run(folder.path(), &[&words[..], plot].concat()).ending(0);
        assert!(fs::metadata(folder.path().join(out)).expect("a mesh").len() > 10_000, "{out}");
    }
    let near = ["picture", "measured", "--focus", "leaf", "--detail", "3", "--size", "120x90", "--out", "leaf.png"];
    run(folder.path(), &near).ending(0);
}

#[test]
fn a_page_has_the_ages_at_which_plants_were_measured() {
    let folder = two_dates();
    let told = run(folder.path(), &["view", "two", "--out", "two.html"]).ending(0).stdout;
    assert!(told.starts_with("two.html: 1 plant as measured at 2 ages, within "), "{told}");
    let told = run(folder.path(), &["view", "two", "--plot", "--ages", "0..20", "--out", "plot.html"]).ending(0).stdout;
    assert!(told.starts_with("plot.html: 1 plant as measured at 1 age (1 without places are not drawn)"), "{told}");
    let page = fs::read(folder.path().join("two.html")).expect("a page");
    run(folder.path(), &["view", "two", "--out", "two.html"]).ending(0);
    assert!(fs::read(folder.path().join("two.html")).expect("a page") == page, "other bytes");
    let (found, _) = {
        run(folder.path(), &["mesh", "two", "--age", "0", "--out", "first.ply"]).ending(0);
        vertices(&folder.path().join("first.ply"))
    };
    assert_eq!(found.len(), 2, "two internodes on the first date");
    run(folder.path(), &["mesh", "two", "--out", "last.ply"]).ending(0);
    let (found, _) = vertices(&folder.path().join("last.ply"));
    let top = found.values().flatten().map(|at| at[2]).fold(0.0, f64::max);
    assert!(found.len() == 4 && (top - 0.3).abs() < 1e-6, "{} {top}", found.len());
}

#[test]
fn a_report_tells_what_was_measured_and_no_lives() {
    let folder = two_dates();
    let words = ["report", "two", "--figures", "figures", "--out", "report.html"];
    run(folder.path(), &words).ending(0);
    let page = fs::read_to_string(folder.path().join("report.html")).expect("a page");
    for told in [
        "2 plants of two were measured on 2 dates from 2020-05-01 to 2020-05-29",
        "Of 1 the file tells no places",
        "days since the first date",
        "Leaf area by age: the file of the measured plants does not tell it.",
        "two: 1 plant as measured at age 28 · 2020-05-29 in one scale.",
        "these were measured",
    ] {
        assert!(page.contains(told), "{told} is missing");
    }
    assert!(!page.contains("<h2>Life and death</h2>"));
    let heights = fs::read_to_string(folder.path().join("figures/growth-height-m.csv")).expect("a figure");
    let rows: Vec<Vec<&str>> = heights.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let rows: Vec<[f64; 2]> = rows.iter().map(|row| [1, 2].map(|k| row[k].parse().expect("a number"))).collect();
    assert!(rows.len() == 2 && rows[0][0] == 0.0 && rows[1][0] == 28.0, "{rows:?}");
    assert!((rows[0][1] - 0.2).abs() < 1e-6 && (rows[1][1] - 0.3).abs() < 1e-6, "{rows:?}");
    let measured = run(folder.path(), &["measure", "two", "nodes-per-unit", "--by", "species"]);
    assert_ne!(measured.code, Some(101), "{}", measured.stderr);
    // Beside a grown run both are told, each in its own words.
    let scenario = "name = \"small\"\nspecies = \"coffee\"\nplants = 2\nages = { until = 6, record = \"all\" }\n";
    fs::write(folder.path().join("small.toml"), scenario).expect("a file");
    run(folder.path(), &["grow", "small.toml", "--quiet", "--out", "grown"]).ending(0);
    run(folder.path(), &["report", "grown", "two", "--plants", "0", "--out", "both.html"]).ending(0);
    let page = fs::read_to_string(folder.path().join("both.html")).expect("a page");
    for told in ["were simulated from sowing", "were measured on 2 dates", "<h2>Life and death</h2>"] {
        assert!(page.contains(told), "{told} is missing");
    }
}

#[test]
fn what_measured_plants_lack_is_told() {
    let folder = two_dates();
    for (words, told) in [
        (vec!["mesh", "two", "--plant", "1", "--out", "a.ply"], "plant 1 of two has no places"),
        (vec!["mesh", "two", "--plant", "2", "--out", "a.ply"], "two has the plants 0 to 1"),
        (
            vec!["mesh", "two", "--age", "5", "--out", "a.ply"],
            "--age 5: nothing of two was measured then, but at 0, 28",
        ),
        (vec!["mesh", "two", "--ages", "0..28", "--out", "a.glb"], "--ages: the plants of two were measured"),
        (vec!["mesh", "two", "--wind", "5", "--out", "a.ply"], "--wind: the plants of two were measured"),
        (vec!["mesh", "two", "--plot", "3", "--out", "a.ply"], "--plot 3: two has one plot, 0"),
        (vec!["mesh", "two", "--detail", "9", "--out", "a.ply"], "9 is not in 0..=3"),
        (vec!["view", "two", "--plant", "1", "--out", "a.html"], "plant 1 of two has no places"),
        (vec!["view", "two", "--ages", "1..20", "--out", "a.html"], "nothing of two was measured then, but at 0, 28"),
        (vec!["view", "two", "--ages", "0..28/7", "--out", "a.html"], "no step between them"),
        (vec!["view", "two", "--plants", "0,0", "--out", "a.html"], "plant 0 is named twice"),
        (vec!["picture", "two", "--plot", "--out", "a.png"], "--plot: the plants of two were measured"),
        (vec!["animate", "two", "--out", "a.webp"], "its plants were measured (two.mtg)"),
    ] {
        let said = run(folder.path(), &words).ending(2).stderr;
        assert!(said.contains(told), "{words:?}: {said}");
    }
}

/// The models that `describe` tells of the plants of a file.
fn models(folder: &Path, file: &str, unit: &str) -> Vec<String> {
    run(folder, &["convert", file, "classified", "--unit", unit]).ending(0);
    let told = run(folder, &["describe", "classified", "--json"]).ending(0).json();
    fs::remove_dir_all(folder.join("classified")).expect("a folder");
    let models = told["architectural_models"].as_array().expect("a list");
    models.iter().map(|model| model.as_str().expect("a word").to_owned()).collect()
}

/// Plants without relays, whose axes an MTG tells all of: the model by which they grew is among those that they may be
/// of when they come in as measured plants, and none that the places rule out.
#[test]
fn measured_plants_are_of_the_models_by_which_they_grew() {
    let folder = tempdir().expect("a folder");
    for (grown, not) in [("massart", "rauh"), ("roux", "attims"), ("rauh", "massart"), ("attims", "roux")] {
        let species = format!("halle/{grown}");
        run(folder.path(), &["convert", &species, "plant.mtg"]).ending(0);
        let found = models(folder.path(), "plant.mtg", "m");
        assert!(found.iter().any(|model| model == grown), "{grown}: {found:?}");
        assert!(found.iter().all(|model| model != not), "{grown}: {found:?}");
    }
}

/// The coffee tree that Archimed ships is of Roux's model, as coffee is (Hallé, Oldeman & Tomlinson 1978). It was
/// measured without flowers and growth units, so that it may be of Massart's too, but of no model with upright
/// branches.
#[test]
fn the_measured_coffee_tree_is_of_rouxs_model() {
    let text = absent::measured("exchange/coffee.opf");
    let (Some(data), Some(_)) = (absent::folder(), text) else { return };
    let file = data.join("exchange/coffee.opf");
    let folder = tempdir().expect("a folder");
    let found = models(folder.path(), &file.display().to_string(), "cm");
    assert!(found.iter().any(|model| model == "roux"), "{found:?}");
    assert!(found.iter().all(|model| model != "attims" && model != "rauh"), "{found:?}");
}
