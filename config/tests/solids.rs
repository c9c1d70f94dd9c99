//! Closed meshes of shapes from PLY files: the mesh is that of the file, the file is an input of the run, a treatment
//! may have another one, and the scenario reads back without the file.
//!
//! Absent: faults (`fixtures.rs`), and the format by itself (`phytomer_config::solids`).

use std::fs;

use phytomer_config::{Resolved, validate, validate_texts};
use phytomer_sim::shape::{Mesh, Shape};

/// A tetrahedron as a PLY, so many metres high.
fn tent(height: u32) -> String {
    format!(
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n\
         property list uchar int vertex_indices\nend_header\n0 0 0\n2 0 0\n0 2 0\n0 0 {height}\n3 0 2 1\n3 0 1 3\n3 1 2 3\n\
         3 0 3 2\n"
    )
}

fn shape_of(height: f64) -> Shape {
    let points = [[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, height]];
    let mesh = Mesh::of(&points, &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]).expect("a closed mesh");
    Shape::Mesh(mesh.into())
}

const SCENARIO: &str = "name = 'rocks'\nspecies = 'coffee'\nplants = 1\nages = { until = 3 }\n\
    [site.shape]\nrock = { form = 'mesh', file = 'tent.ply' }\n[[site.obstacle]]\nshape = 'rock'\n";

const LEVELS: &str = "[[experiment.factor]]\nname = 'rock'\n[[experiment.factor.level]]\nname = 'low'\n\
    [[experiment.factor.level]]\nname = 'high'\n\
    site = { shape = { rock = { form = 'mesh', file = 'high.ply' } } }\n";

/// The shapes of the obstacle in each treatment.
fn rocks(run: &Resolved) -> Vec<Shape> {
    let rock = |of: &phytomer_config::Treatment| of.scenario.site.felt().obstacles[0].shape.as_ref().clone();
    run.trial().treatments().iter().map(rock).collect()
}

#[test]
fn a_mesh_of_a_file_is_the_mesh_that_it_holds() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::write(&path, text).expect("written");
        path.to_str().expect("a name").to_owned()
    };
    let scenario = file("rocks.toml", &format!("{SCENARIO}{LEVELS}"));
    file("tent.ply", &tent(2));
    file("high.ply", &tent(3));
    let run = validate(&scenario).unwrap_or_else(|report| panic!("{}", report.render(false)));
    assert_eq!(rocks(&run), [shape_of(2.0), shape_of(3.0)]);
    let inputs: Vec<&str> = run.sources.iter().map(|source| source.name.as_str()).collect();
    for name in ["tent.ply", "high.ply"] {
        assert_eq!(inputs.iter().filter(|input| input.ends_with(name)).count(), 1, "{name} in {inputs:?}");
    }
    // What is recorded has the mesh and no file.
    let recorded = run.to_json().expect("JSON").to_string();
    assert!(!recorded.contains("tent.ply") && recorded.contains("points_m"));
    fs::remove_file(folder.path().join("tent.ply")).expect("removed");
    let report = validate(&scenario).expect_err("the file is gone").render(false);
    assert!(report.contains("there is no such file") && report.contains("'tent.ply'"), "{report}");
}

#[test]
fn meshes_stand_among_texts_in_memory_too() {
    let tent = tent(2);
    let texts = [("rocks", SCENARIO), ("tent.ply", tent.as_str())];
    let run = validate_texts("rocks", &texts).unwrap_or_else(|report| panic!("{}", report.render(false)));
    assert_eq!(rocks(&run), [shape_of(2.0)]);
    let toml = run.scenario_toml().expect("TOML");
    let again =
        validate_texts("again", &[("again", &toml)]).unwrap_or_else(|report| panic!("{}", report.render(false)));
    assert_eq!(again.scenario, run.scenario, "it reads back without the file");
    let report = validate_texts("rocks", &texts[..1]).expect_err("no such text").render(false);
    assert!(report.contains("`tent.ply`"), "{report}");
}
