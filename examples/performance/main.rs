//! The table of `docs/performance.md`, from the measurements of `cargo bench` on this machine:
//!
//! ```sh
//! cargo bench && cargo run --release --example performance
//! ```
//!
//! Criterion keeps its estimates in a folder of its own (`folder`). In each group the bench that is called a baseline
//! is the measure for the others. With two folders as arguments the table compares two builds of the program instead
//! (`compare`):
//!
//! ```sh
//! cargo run --release --example performance -- BEFORE AFTER
//! ```

mod compare;
mod folder;

use anyhow::{Context, Result, bail, ensure};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// One bench with its estimate as criterion has stored it.
struct Bench {
    group: String,
    name: String,
    elements: f64,
    seconds: f64,
}

fn main() -> Result<()> {
    let folders: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    match &folders[..] {
        [] => rates(),
        [before, after] => compare::ratios(before, after),
        _ => bail!("two folders are expected, those of the benches before and after, or none"),
    }
}

/// Prints the benches of this machine, each with its rate against the baseline of its group.
fn rates() -> Result<()> {
    let folder = folder::of_benches(Path::new(env!("CARGO_MANIFEST_DIR")), |name| std::env::var_os(name));
    let mut benches = Vec::new();
    collect(&folder, &mut benches)
        .with_context(|| format!("cannot read {}: run `cargo bench` first", folder.display()))?;
    benches.sort_by(|a, b| (&a.group, a.is_baseline(), &a.name).cmp(&(&b.group, b.is_baseline(), &b.name)));
    for bench in &benches {
        let baselines = benches.iter().filter(|other| other.group == bench.group && other.is_baseline()).count();
        let remedy = format!("remove {}, which may hold older benches, and run `cargo bench`", folder.display());
        ensure!(baselines == 1, "{} has {baselines} baselines, not one: {remedy}", bench.group);
    }
    println!("| specimen/what | bench | a run, ms | M elements/s | rate against the baseline |");
    println!("|---|---|---:|---:|---:|");
    for bench in &benches {
        let baseline = benches.iter().find(|other| other.group == bench.group && other.is_baseline());
        let ratio = baseline.map_or_else(String::new, |baseline| format!("{:.3}", baseline.seconds / bench.seconds));
        let rate = bench.elements / bench.seconds / 1e6;
        println!("| {} | {} | {:.3} | {rate:.1} | {ratio} |", bench.group, bench.name, bench.seconds * 1e3);
    }
    Ok(())
}

impl Bench {
    fn is_baseline(&self) -> bool {
        self.name.ends_with("(baseline)")
    }

    /// A bench from its folder, where the folder holds a bench.
    fn read(folder: &Path) -> Result<Option<Self>> {
        let file = folder.join("new/benchmark.json");
        if !file.is_file() {
            return Ok(None);
        }
        let about: Value = serde_json::from_str(&fs::read_to_string(file)?)?;
        let estimates: Value = serde_json::from_str(&fs::read_to_string(folder.join("new/estimates.json"))?)?;
        let text = |key: &str| about[key].as_str().unwrap_or_default().to_owned();
        let throughput = about["throughput"].as_object().and_then(|kinds| kinds.values().next());
        let seconds = estimates["median"]["point_estimate"].as_f64().context("an estimate without a median")? / 1e9;
        let elements = throughput.and_then(Value::as_f64).unwrap_or(f64::NAN);
        Ok(Some(Self { group: text("group_id"), name: text("function_id"), elements, seconds }))
    }
}

/// Every bench below a folder.
fn collect(folder: &Path, benches: &mut Vec<Bench>) -> Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if !path.is_dir() {
            continue;
        }
        match Bench::read(&path)? {
            Some(bench) => benches.push(bench),
            None => collect(&path, benches)?,
        }
    }
    Ok(())
}
