//! What a population takes: plants a second, the peak memory, and where threads wait for the writer.
//!
//! ```sh
//! cargo run --release --example population [PLANTS]
//! ```
//!
//! The shipped `million_coffee` with a tenth of so many plants, on one thread and on two, and with all of them on two:
//! 100,000 if nothing is given. Each is a process of its own (`child`), so that the peak is that of its run. The memory
//! must not grow with the plants, the time must grow as they do, and two threads must be nearly twice as fast as one.
//! Absent: bounds, which depend on the machine; `tests/memory.rs` holds that of the memory.

use anyhow::{Context, Result, anyhow, ensure};
use phytomer::config::validate;
use phytomer::run::{self, Progress, Settings};
use serde_json::{Value, json};
use std::env;
use std::fs;
use std::process::Command;

const PLANTS: u32 = 100_000;

fn main() -> Result<()> {
    let words: Vec<String> = env::args().skip(1).collect();
    if let [word, plants, threads] = &words[..]
        && word == "child"
    {
        return child(plants.parse()?, threads.parse()?);
    }
    let plants = words.first().map_or(Ok(PLANTS), |word| word.parse()).context("the number of plants is expected")?;
    let few = (plants / 10).max(1);
    let runs = [(few, 1), (few, 2), (plants, 2)].map(|(plants, threads)| measured(plants, threads));
    println!("| plants | threads | s | plants/s | peak, MB | waits for columns, % | waits for the disk, % |");
    println!("|---:|---:|---:|---:|---:|---:|---:|");
    let mut rates = Vec::new();
    for run in runs {
        let run = run?;
        let number = |key: &str| run[key].as_f64().unwrap_or(f64::NAN);
        let rate = number("plants") / number("seconds");
        println!(
            "| {} | {} | {:.1} | {rate:.0} | {:.0} | {:.1} | {:.1} |",
            run["plants"],
            run["threads"],
            number("seconds"),
            number("peak_bytes") / 1e6,
            100.0 * number("columns"),
            100.0 * number("disk"),
        );
        rates.push(rate);
    }
    println!(
        "two threads: {:.2} × one; a plant of ten times as many: {:.2} × its time",
        rates[1] / rates[0],
        rates[1] / rates[2]
    );
    Ok(())
}

/// Grows in a process of its own.
fn measured(plants: u32, threads: usize) -> Result<Value> {
    let words = ["child".to_owned(), plants.to_string(), threads.to_string()];
    let output = Command::new(env::current_exe()?).args(words).output()?;
    ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Ok(serde_json::from_slice(&output.stdout)?)
}

fn child(plants: u32, threads: usize) -> Result<()> {
    let mut resolved = validate("million_coffee").map_err(|report| anyhow!("{}", report.render(false)))?;
    resolved.scenario.plants = plants;
    let folder = env::temp_dir().join(format!("phytomer-population-{}", std::process::id()));
    let settings = Settings { threads, ..Settings::in_folder(&folder) };
    let outcome = run::run(&resolved, &settings, &Progress::default())?;
    fs::remove_dir_all(&folder)?;
    let told = json!({
        "plants": plants,
        "threads": threads,
        "seconds": outcome.seconds,
        "peak_bytes": peak(),
        "columns": outcome.waited.columns,
        "disk": outcome.waited.disk,
    });
    println!("{told}");
    Ok(())
}

/// The most memory that this process has held, bytes, where Linux tells it.
fn peak() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()? * 1024)
}
