//! A species whose laws name the height of its plants, in whole runs: the same bytes on any number of threads and after
//! an interruption, and the recorded plant when it is grown again.
//!
//! Closed forms of such laws are tested with the bud model (`models/src/buds/tests_height.rs`).

mod ply;
mod program;
mod read;

use ply::{count, mesh, place_in};
use program::{hashes, run};
use read::Columns;
use std::collections::BTreeSet;
use std::fs;

/// Bytes of a vertex.
const VERTEX: usize = 49;

const SPECIES: &str = r#"name = "shy"
model = "buds"
tick = "one month"

[[order]]
death = { expression = "min(0.3, 0.2 * height_m)" }
growth_unit = { nodes = { constant = { expression = "if(height_m > 0.5, 1, 3)" } } }
axillary = { buds = 1, ramification = { expression = "max(0, 0.6 - 0.4 * height_m)" } }
internode = { length_cm = 4 }

[[order]]
pause = { expression = "min(0.9, height_m)" }
internode = { length_cm = 3 }
"#;

const SCENARIO: &str = r#"name = "heights"
species = "shy.toml"
plants = 12
ages = { until = 16, record = { every = 4 } }
output = { plants_per_part = 4 }

[[event]]
operation = "topping"
age = 10
height_m = 0.4
"#;

#[test]
fn runs_of_plants_that_see_their_height_have_the_same_bytes_however_they_are_grown() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("shy.toml"), SPECIES).unwrap();
    fs::write(folder.path().join("heights.toml"), SCENARIO).unwrap();
    let grown = |name: &str, more: &[&str]| {
        run(folder.path(), &[&["grow", "heights.toml", "--name", name, "--quiet"], more].concat()).ending(0);
        folder.path().join("runs").join(name)
    };
    let whole = hashes(&grown("1", &["--threads", "1"]));
    for threads in ["2", "3", "8"] {
        assert_eq!(hashes(&grown(threads, &["--threads", threads])), whole);
    }
    fs::remove_file(folder.path().join("runs/2/records/part-00001.parquet")).unwrap();
    assert_eq!(hashes(&grown("2", &["--resume"])), whole);
    // A mesh is drawn of a plant that is grown again: it has what stands by the tables of the run.
    run(folder.path(), &["mesh", "runs/1", "--plant", "5", "--age", "12", "--sides", "3", "--out", "one.ply"])
        .ending(0);
    let (header, bytes) = mesh(&folder.path().join("one.ply"));
    assert_eq!(place_in(&header), [0.0; 3]);
    let drawn: BTreeSet<u32> = (0..count(&header, "vertex"))
        .map(|vertex| u32::from_le_bytes(bytes[VERTEX * vertex + 44..][..4].try_into().unwrap()))
        .collect();
    let records = Columns::of(&folder.path().join("runs/1"), "records");
    let [of, tick, component] = ["plant_id", "tick", "component_id"].map(|name| records.numbers(name));
    let internode = |row: &usize| records.words("kind")[*row] == "internode";
    let rows = (0..tick.len()).filter(|row| of[*row] == 5.0 && tick[*row] == 12.0).filter(internode);
    let internodes: BTreeSet<u32> = rows.map(|row| component[row] as u32).collect();
    assert!(internodes.len() > 3 && internodes.is_subset(&drawn), "{} internodes", internodes.len());
}
