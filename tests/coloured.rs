//! Plots coloured by light: a picture and a mesh show the shares of light that the table `records` tells of leaves and
//! buds.
//!
//! Absent: the light itself, and the colours of a scale.

use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Int32Type};
use phytomer::outputs::Table;
use phytomer::outputs::colouring::{Belonging, colouring};
use phytomer::run::picturing::pictured_plot;
use phytomer::run::regrowth::Regrowth;
use phytomer::run::{self, Progress};
use phytomer_config::{Resolved, validate_texts};
use std::collections::BTreeMap;
use std::process::Command;

/// Four coffee trees that shade one another.
const STAND: &str = "name = \"lit\"\nspecies = \"coffee\"\nseed = 3\nages = { until = 20, record = [20] }\n\
    [stand]\nlayout = { form = \"rows\", plant_spacing_m = 0.8, row_spacing_m = 0.8, rows = 2, plants = 2 }\n\
    [light]\nvoxel_m = 0.2\n[output]\nlight = true\n";

fn stand() -> Resolved {
    validate_texts("lit", &[("lit", STAND)]).unwrap_or_else(|report| panic!("{}", report.render(false)))
}

/// The share of light of each leaf and bud by its plant and its component, as `records` tells it at the last tick.
fn recorded(resolved: &Resolved) -> BTreeMap<(usize, usize), f64> {
    let run = run::in_memory(resolved, 2, &Progress::default()).expect("the run ends");
    let mut shares = BTreeMap::new();
    for batch in &run.batches[&Table::Records] {
        let column = |name: &str| batch.column_by_name(name).expect("a column");
        let (plants, components) = (column("plant_id"), column("component_id"));
        let whole = |numbers: &dyn arrow_array::Array| numbers.as_primitive::<Int32Type>().values().to_vec();
        let (plants, components) = (whole(plants.as_ref()), whole(components.as_ref()));
        let shared = column("light").as_primitive::<Float32Type>().iter();
        for ((plant, component), share) in plants.into_iter().zip(components).zip(shared) {
            if let Some(share) = share {
                shares.insert((plant as usize, component as usize), f64::from(share));
            }
        }
    }
    shares
}

#[test]
fn a_plot_is_coloured_by_the_light_that_records_tell() {
    let resolved = stand();
    let expected = recorded(&resolved);
    assert!(expected.len() > 200, "{} leaves and buds", expected.len());
    let pictured = pictured_plot(&Regrowth::of(&resolved), &resolved.all_species(), (0, &[20]), true).expect("a plot");
    let lights = pictured.lights();
    let of = Belonging { members: &[], treatments: &[], species: &[], lights: &lights };
    let found = colouring("light", &pictured.subjects(), of).expect("light is known");
    let plants = found.values.iter().enumerate();
    let told: BTreeMap<(usize, usize), f64> = plants
        .flat_map(|(plant, values)| {
            values.iter().enumerate().map(move |(component, share)| ((plant, component), *share))
        })
        .filter(|(_, share)| !share.is_nan())
        .collect();
    assert_eq!(told, expected);
    let most = expected.values().copied().fold(0.0, f64::max);
    let least = expected.values().copied().fold(1.0, f64::min);
    assert!(most > 0.9 && least < 0.4, "the stand shades itself: {least} to {most}");
}

/// The program, its status and what it says.
fn said(words: &[&str]) -> (bool, String) {
    let done = Command::new(env!("CARGO_BIN_EXE_phytomer")).args(words).output().expect("phytomer runs");
    let words = format!("{}{}", String::from_utf8_lossy(&done.stdout), String::from_utf8_lossy(&done.stderr));
    (done.status.success(), words)
}

#[test]
fn meshes_are_coloured_where_their_format_has_colours_of_vertices() {
    let home = tempfile::tempdir().expect("a folder");
    let path = |name: &str| home.path().join(name).display().to_string();
    let (stand, ply, glb) = (path("stand.toml"), path("light.ply"), path("light.glb"));
    std::fs::write(&stand, STAND).expect("a scenario");
    let of_plot = |out: &str| said(&["mesh", &stand, "--plot", "--age", "20", "--colour-by", "light", "--out", out]);
    let (done, words) = of_plot(&ply);
    assert!(done && words.contains("by light from 0."), "{words}");
    let (done, words) = of_plot(&glb);
    assert!(!done && words.contains("--colour-by: this is for a PLY file (.ply) of one age"), "{words}");
    let (done, words) = said(&["mesh", &stand, "--age", "20", "--colour-by", "light", "--out", &ply]);
    assert!(!done && words.contains("light is known of whole plots (--plot)"), "{words}");
    let (done, words) = said(&["mesh", &stand, "--age", "20", "--colour-by", "order", "--out", &ply]);
    assert!(done && words.contains("by order"), "{words}");
    let (done, words) = said(&["mesh", &stand, "--age", "19.5", "--colour-by", "order", "--out", &ply]);
    assert!(!done && words.contains("--colour-by order needs an age such as 19 or 20"), "{words}");
}
