//! Successors in whole runs: numbered in advance, planted where plants have died, with the same bytes on any number of
//! threads, in shares that are merged and after an interruption.
//!
//! When a place is free is tested with the bud model (`models/src/buds/tests_replanting.rs`). Absent: bad members,
//! which are fixtures of `config`.

mod program;
mod read;

use program::{hashes, run};
use read::Columns;
use std::fs;
use std::path::{Path, PathBuf};

/// Half of the plants die of a wilt by the age of 6; places are planted every ten ticks, twice at each first place.
const WILTING: &str = r#"name = "wilting"
species = "coffee"
plants = 40
ages = { until = 30, record = { every = 5 } }
output = { plants_per_part = 8 }
member = [{}, { at_m = [2, 0] }, { replaces = 0 }, { replaces = 2 }]

[[pest]]
name = "wilt"
attacks = "plant"
probability = 0.5
ages = [3, 6]

[[event]]
operation = "replanting"
tick = 10
every = 10
"#;

fn grown(folder: &Path, name: &str, more: &[&str]) -> PathBuf {
    let words = [&["grow", "wilting.toml", "--name", name, "--quiet"], more].concat();
    run(folder, &words).ending(0);
    folder.join("runs").join(name)
}

#[test]
fn successors_are_planted_where_plants_have_died() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("wilting.toml"), WILTING).unwrap();
    let run = grown(folder.path(), "whole", &[]);
    let [plants, summary] = ["plants", "summary"].map(|table| Columns::of(&run, table));
    let sown = plants.numbers("sown_tick");
    assert_eq!(sown.len(), 40, "all numbers are there, planted or not");
    let alive = |plant: usize, tick: f64| {
        let [of, at, alive] = ["plant_id", "tick", "alive"].map(|name| summary.numbers(name));
        (0..of.len()).any(|row| of[row] == plant as f64 && at[row] == tick && alive[row] == 1.0)
    };
    let mut planted = 0;
    for first in (0..40).step_by(4) {
        for (plant, follows) in [(first + 2, first), (first + 3, first + 2)] {
            let dead = |tick: f64| sown[follows] < tick && !alive(follows, tick);
            let expected = [10.0, 20.0, 30.0].into_iter().find(|tick| dead(*tick));
            assert_eq!(Some(sown[plant]).filter(|tick| !tick.is_nan()), expected, "plant {plant}");
            planted += usize::from(expected.is_some());
        }
        let place = |plant: usize| plants.numbers("x_m")[plant];
        assert_eq!((place(first + 2), place(first + 3)), (place(first), place(first)));
    }
    assert!(planted > 4, "{planted} successors");
}

#[test]
fn runs_with_successors_have_the_same_bytes_however_they_are_grown() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("wilting.toml"), WILTING).unwrap();
    let whole = hashes(&grown(folder.path(), "one", &["--threads", "1"]));
    for threads in ["2", "3", "8"] {
        assert_eq!(hashes(&grown(folder.path(), threads, &["--threads", threads])), whole);
    }
    let cut_short = folder.path().join("runs/2");
    fs::remove_file(cut_short.join("records/part-00001.parquet")).unwrap();
    fs::remove_file(cut_short.join("plants/part-00002.parquet")).unwrap();
    assert_eq!(hashes(&grown(folder.path(), "2", &["--resume"])), whole);
    let refused = run(folder.path(), &["picture", "runs/one", "--plant", "2", "--out", "a.png"]).ending(1);
    assert!(refused.stderr.contains("--plot 0"), "{}", refused.stderr);
    run(folder.path(), &["mesh", "runs/one", "--plot", "0", "--age", "25", "--out", "plot.ply"]).ending(0);
}
