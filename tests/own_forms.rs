//! A user's mesh as the form of a leaf, from its file to the plant's mesh: it is found beside the species file, checked
//! before the first tick, hashed among the inputs of the run, and compared with that hash when the run is drawn again.
//!
//! Absent: forms of the library (`areas`).

mod program;

use program::run;
use std::fs;
use std::path::Path;

const SPECIES: &str = r#"name = "kite"
model = "buds"
tick = "one month"

[[order]]
leaf = { form = { mesh = "forms/kite.obj" }, per_node = 1, length_cm = 8, width_cm = 4 }
"#;

const SCENARIO: &str = r#"name = "kite"
species = "kite.toml"
plants = 1
ages = { until = 3 }

[meshes]
ages = "last"
"#;

const KITE: &str = "v 0 0 0\nv 2 -1 0\nv 3 0 0\nv 2 1 0\nf 1 2 3 4\n";

fn kite(folder: &Path, mesh: &str) {
    fs::create_dir_all(folder.join("forms")).unwrap();
    fs::write(folder.join("kite.toml"), SPECIES).unwrap();
    fs::write(folder.join("scenario.toml"), SCENARIO).unwrap();
    fs::write(folder.join("forms/kite.obj"), mesh).unwrap();
}

#[test]
fn leaves_are_drawn_with_the_mesh_and_a_run_knows_it_again() {
    let folder = tempfile::tempdir().unwrap();
    kite(folder.path(), KITE);
    let here = |words: &[&str]| run(folder.path(), words);
    here(&["validate", "scenario.toml", "kite.toml"]).ending(0);
    here(&["grow", "scenario.toml", "--name", "kite", "--quiet"]).ending(0);
    let report: serde_json::Value =
        serde_json::from_slice(&fs::read(folder.path().join("runs/kite/run.json")).unwrap()).unwrap();
    let inputs = report["inputs"].as_array().unwrap();
    assert!(
        inputs.iter().any(|input| input["path"] == "forms/kite.obj" && input["sha256"].as_str().unwrap().len() == 64)
    );
    // The kite fills half of its box; the species states no share of its own.
    assert_eq!(report["resolved_scenario"]["species"]["order"][0]["leaf"]["area_share"], 0.5);
    here(&["mesh", "runs/kite", "--out", "again.ply"]).ending(0);
    let drawn = fs::read(folder.path().join("runs/kite/meshes/plant-00000_age-0003.ply")).unwrap();
    assert_eq!(drawn, fs::read(folder.path().join("again.ply")).unwrap());
    // Three tubes of 34 vertices and 28 triangles, three leaves of four and two.
    let head = String::from_utf8_lossy(&drawn[..800]).into_owned();
    assert!(head.contains("element vertex 114\n") && head.contains("element face 90\n"), "{head}");
    here(&["picture", "runs/kite", "--out", "kite.png", "--size", "80x60"]).ending(0);
    fs::write(folder.path().join("forms/kite.obj"), KITE.replace("v 3", "v 4")).unwrap();
    let told = here(&["mesh", "runs/kite", "--out", "changed.ply"]).ending(1).stderr;
    assert!(told.contains("the mesh forms/kite.obj is not the one with which the run was made"), "{told}");
}

#[test]
fn a_bad_mesh_is_told_with_its_place_in_both_files() {
    let folder = tempfile::tempdir().unwrap();
    kite(folder.path(), "v 0 0 0\nv 1 0\nf 1 2 3\n");
    for words in [["validate", "kite.toml"], ["validate", "scenario.toml"], ["grow", "scenario.toml"]] {
        let told = run(folder.path(), &words).ending(3).stderr;
        assert!(told.contains("in the mesh `forms/kite.obj`, line 2: a vertex without three numbers"), "{told}");
        assert!(told.contains("kite.toml:6:26") && told.contains("expected: `v x y z`"), "{told}");
    }
    assert!(!folder.path().join("runs").exists(), "nothing is written");
    fs::remove_file(folder.path().join("forms/kite.obj")).unwrap();
    let told = run(folder.path(), &["validate", "kite.toml"]).ending(3).stderr;
    assert!(told.contains("there is no mesh file `forms/kite.obj`"), "{told}");
}
