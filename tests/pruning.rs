//! What people do to plants, in whole runs: the same bytes on any number of threads and after an interruption, the same
//! plant when it is grown again, and the yield that is picked.
//!
//! What a cut releases is tested with the bud model (`models/src/buds/tests_cuts.rs`), that `summary` agrees with the
//! other tables in `tests/summary.rs`. Absent: bad events, which are fixtures of `config`.

mod ply;
mod program;
mod read;

use ply::{count, mesh, place_in};
use program::{hashes, run};
use read::Columns;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// Bytes of a vertex.
const VERTEX: usize = 49;

/// Apples and coffees of two sowings, pruned by a calendar, by height and by strength, trained and harvested.
const ORCHARD: &str = r#"name = "orchard"
species = "apple"
plants = 8
ages = { until = 24, record = { every = 4 } }
planting_date = "2000-03-01"
calendar = { tick = { days = 30 } }
member = [{}, { at_m = [2, 0], sown = 3 }, { species = "coffee", at_m = [0, 2] }, { species = "london_plane", at_m = [4, 0] }]

[[event]]
operation = "topping"
when = "height_m > 1.2"
every = 6
height_m = 1

[[event]]
operation = "thinning"
tick = 13
every = 4
only = "order >= 2 and height_m > 0.4"
protect = "age < 2"
first = "diameter_m"
share = 0.3

[[event]]
operation = "heading"
date = "2001-02-01"
only = "order == 1"
keep_share = 0.8

[[event]]
operation = "staking"
tick = 4
every = 5
height_m = 0.8

[[event]]
operation = "bending"
age = 8
every = 6
only = "order == 2 and inclination_deg < 70"
first = "length_m"
at_most = 3
angle_deg = 75
stays = 5

[[event]]
operation = "tying"
tick = 15
only = "order == 2 and height_m < 0.5"
wires_m = [0.3, 0.6]
azimuth_deg = 90

[[event]]
operation = "removal"
tick = 22
plants = "member == 3"

[[event]]
operation = "harvest"
age = 6
every = 1
ripe_share = 0.5
"#;

fn written(folder: &Path, name: &str, threads: &str) -> std::path::PathBuf {
    run(folder, &["grow", "orchard.toml", "--threads", threads, "--name", name, "--quiet"]).ending(0);
    folder.join("runs").join(name)
}

#[test]
fn a_pruned_orchard_has_the_same_bytes_on_any_number_of_threads_and_after_an_interruption() {
    let folder = tempfile::tempdir().unwrap();
    let text = format!("output = {{ plants_per_part = 4 }}\n{ORCHARD}");
    fs::write(folder.path().join("orchard.toml"), text).unwrap();
    let all = ["1", "2", "3", "8"].map(|threads| hashes(&written(folder.path(), threads, threads)));
    assert!(all[0].len() >= 10, "two parts of five tables: {}", all[0].len());
    assert!(all.iter().all(|hashes| *hashes == all[0]), "threads show");
    // What a killed run has not written is grown again.
    let cut_short = folder.path().join("runs/2");
    for table in ["components", "records", "events", "summary", "plants"] {
        fs::remove_file(cut_short.join(table).join("part-00001.parquet")).unwrap();
    }
    run(folder.path(), &["grow", "orchard.toml", "--resume", "--name", "2", "--quiet"]).ending(0);
    assert_eq!(hashes(&cut_short), all[0]);
}

#[test]
fn what_was_cut_is_told_with_its_cause_and_what_was_picked_is_the_yield() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("orchard.toml"), ORCHARD).unwrap();
    let run = written(folder.path(), "orchard", "2");
    let [events, components, summary] = ["events", "components", "summary"].map(|table| Columns::of(&run, table));
    let causes = components.words("cause_of_death");
    let pruned = causes.iter().filter(|cause| *cause == "pruned").count();
    assert!(pruned > 100, "{pruned} components are cut");
    let told = |kind: &str| {
        let rows = (0..events.words("event").len()).filter(|row| events.words("event")[*row] == kind);
        rows.map(|row| events.numbers("count")[row]).sum::<f64>()
    };
    // An event for each axis that was cut; its bud dies of it where it lived.
    let buds =
        (0..causes.len()).filter(|row| causes[*row] == "pruned" && components.words("kind")[*row] == "apical_bud");
    assert!(told("pruned") >= buds.count() as f64 && told("reiterated") > 0.0);
    let harvested = causes.iter().filter(|cause| *cause == "harvested").count() as f64;
    assert_eq!(told("harvested"), harvested, "an event counts the fruits of an axis");
    let last = (0..summary.numbers("tick").len()).filter(|row| summary.numbers("tick")[*row] == 24.0);
    let (mut fruits, mut living) = (0.0, Vec::new());
    for row in last {
        fruits += summary.numbers("harvested_fruits")[row];
        living.push(summary.numbers("alive")[row]);
    }
    assert_eq!(fruits, harvested, "the yield of all plants");
    assert_eq!((living.len(), living[3], living[7]), (8, 0.0, 0.0), "the last member of each plot was removed");
    // Any other lives, unless each of its buds was cut.
    let (ids, kinds) = (components.numbers("plant_id"), components.words("kind"));
    for plant in (0..8_u8).filter(|plant| plant % 4 != 3 && living[usize::from(*plant)] == 0.0) {
        let own = (0..causes.len()).filter(|row| ids[*row] == f64::from(plant));
        let mut buds = own.filter(|row| kinds[*row] == "apical_bud");
        assert!(buds.all(|row| causes[row] == "pruned"), "plant {plant} died of something else");
    }
    assert!(living.iter().sum::<f64>() >= 5.0, "{living:?}");
}

/// A mesh is drawn of a plant that is grown again: it has what stands by the tables of the run.
#[test]
fn a_plant_that_is_grown_again_was_pruned_as_in_the_run() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("orchard.toml"), ORCHARD).unwrap();
    let recorded = written(folder.path(), "orchard", "2");
    let records = Columns::of(&recorded, "records");
    for (plant, sown, place) in [(1, 3, [2.0, 0.0, 0.0]), (2, 0, [0.0, 2.0, 0.0]), (4, 0, [0.0; 3])] {
        let (number, age) = (plant.to_string(), (20 - sown).to_string());
        let words = ["mesh", "runs/orchard", "--plant", &number, "--age", &age, "--sides", "3", "--out", "one.ply"];
        run(folder.path(), &words).ending(0);
        let (header, bytes) = mesh(&folder.path().join("one.ply"));
        assert_eq!(place_in(&header), place, "plant {plant}");
        // The number of the component stands before the last byte of a vertex.
        let drawn: BTreeSet<u32> = (0..count(&header, "vertex"))
            .map(|vertex| u32::from_le_bytes(bytes[VERTEX * vertex + 44..][..4].try_into().unwrap()))
            .collect();
        let [of, tick, component] = ["plant_id", "tick", "component_id"].map(|name| records.numbers(name));
        let rows = (0..tick.len()).filter(|row| of[*row] == f64::from(plant) && tick[*row] == 20.0);
        let standing: BTreeSet<u32> = rows.clone().map(|row| component[row] as u32).collect();
        let internode = |row: &usize| records.words("kind")[*row].ends_with("internode");
        let internodes: BTreeSet<u32> = rows.filter(internode).map(|row| component[row] as u32).collect();
        assert!(internodes.len() > 3, "{} internodes of plant {plant}", internodes.len());
        assert!(internodes.is_subset(&drawn) && drawn.is_subset(&standing), "plant {plant}");
    }
}
