//! The trials that ship: each is grown whole, and its tables say what its page says.
//!
//! Tables are read by the parquet crate alone. What can be known without the program is computed here from the
//! numbers of the scenario: degree-days from the lines of a weather file, the share of organs that pests take from the
//! ages of the organs. Statistical tests have the seeds of the scenarios and bounds of at least 4 standard errors,
//! computed. Absent: `coffee_nitrogen`, whose laws `dated_treatments` holds.

mod apple_pruning;
mod cotton_insects;
mod mango_two_sites;
#[path = "../program/mod.rs"]
mod program;
#[path = "../read/mod.rs"]
mod read;
#[path = "../../examples/weather_of_normals.rs"]
#[allow(dead_code, reason = "its main function writes the files")]
mod weather_of_normals;

use std::path::PathBuf;

/// A shipped scenario grown in a folder that lasts as long as the result.
fn grown(name: &str) -> (tempfile::TempDir, PathBuf) {
    let home = tempfile::tempdir().expect("a temporary folder");
    program::run(home.path(), &["grow", name, "--quiet"]).ending(0);
    let run = home.path().join("runs").join(name);
    (home, run)
}

/// The mean of numbers, and its standard error.
fn mean(numbers: &[f64]) -> (f64, f64) {
    let n = numbers.len() as f64;
    let mean = numbers.iter().sum::<f64>() / n;
    let squares = numbers.iter().map(|number| (number - mean) * (number - mean)).sum::<f64>();
    (mean, (squares / (n - 1.0) / n).sqrt())
}
