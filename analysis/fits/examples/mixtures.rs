//! The time of all laws of nodes, mixtures among them, of measured counts, against a plain SciPy script that fits the
//! mixtures alone.
//!
//! ```sh
//! cargo run --release -p phytomer-fits --example mixtures -- ../shared/data/nodes_per_growth_unit_histograms.csv
//! ```
//!
//! `fit_all` finds every law of each data set, with errors, limits and the profile of n for the rivals; the script
//! (`mixtures.py` beside this file, by the Python of `.venv`) has the mixtures of the same pairs of families by the
//! same method, and neither errors nor limits. Beside the times stands the number of mixtures that either finds with a
//! ln L of .01 more. Times are those of the processor, so that other work on the machine does not count; Linux alone
//! tells them of a thread, elsewhere the clock does. Absent: a bound; times depend on the machine.

use phytomer_fits::nodes::laws::PAIRS;
use phytomer_fits::nodes::{Family, fit_all, fit_mixture};
use std::collections::BTreeMap;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

const TURNS: usize = 5;

/// Two ln L that differ by less are the same.
const SAME: f64 = 0.01;

fn main() -> Result<(), Box<dyn Error>> {
    let path: PathBuf = std::env::args_os().nth(1).ok_or("expected a table with dataset, n_nodes and count")?.into();
    let tables = read(&path)?;
    let (mut best, start) = (f64::INFINITY, Instant::now());
    for _ in 0..TURNS {
        let begun = spent(start);
        for counts in tables.values() {
            std::hint::black_box(fit_all(counts)?);
        }
        best = best.min(spent(start) - begun);
    }
    let begun = spent(start);
    let mut ours = BTreeMap::new();
    for (name, counts) in &tables {
        for pair in PAIRS {
            let fit = fit_mixture(counts, pair).ok().and_then(|fitted| fitted.1.log_likelihood);
            ours.insert((name.clone(), letters(pair)), fit.unwrap_or(f64::NAN));
        }
    }
    let with_limits = spent(start) - begun;
    let (theirs, seconds) = of_scipy(&path)?;
    let ahead = |a: &dyn Fn(&(String, String)) -> f64, b: &dyn Fn(&(String, String)) -> f64| {
        ours.keys().filter(|key| a(key) > b(key) + SAME || a(key).is_finite() && b(key).is_nan()).count()
    };
    let (own, other) = (|key: &(String, String)| ours[key], |key: &(String, String)| theirs[key]);
    println!("{} data sets, {} mixtures", tables.len(), ours.len());
    println!("ln L: {} better here, {} better by SciPy", ahead(&own, &other), ahead(&other, &own));
    println!("every law, with limits of the rivals: {best:.3} s; SciPy, mixtures alone: {seconds:.3} s");
    println!(
        "ratio {:.0}; every mixture with limits: {with_limits:.3} s, ratio {:.0}",
        seconds / best,
        seconds / with_limits
    );
    Ok(())
}

/// The seconds that this thread has had a processor; by the clock where the system does not tell.
fn spent(start: Instant) -> f64 {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let of_thread = told.as_deref().and_then(|told| told.split(' ').next()?.parse::<f64>().ok());
    of_thread.map_or_else(|| start.elapsed().as_secs_f64(), |nanoseconds| nanoseconds * 1e-9)
}

/// The letters of a pair, as the script has them.
fn letters(pair: [Family; 2]) -> String {
    let letter = |family| match family {
        Family::Poisson => 'P',
        Family::Binomial => 'B',
        Family::NegativeBinomial => 'N',
    };
    pair.map(letter).iter().collect()
}

/// The counts of 0, 1, 2 … nodes of each data set.
fn read(path: &Path) -> Result<BTreeMap<String, Vec<f64>>, Box<dyn Error>> {
    let text = std::fs::read_to_string(path)?;
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = lines.next().ok_or("an empty table")?;
    let place = |name: &str| head.iter().position(|own| *own == name).ok_or(format!("no column {name}"));
    let [dataset, nodes, count] = [place("dataset")?, place("n_nodes")?, place("count")?];
    let mut tables: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    for row in lines {
        let counts = tables.entry(row[dataset].to_owned()).or_default();
        let nodes: usize = row[nodes].parse()?;
        counts.resize(counts.len().max(nodes + 1), 0.0);
        counts[nodes] += row[count].parse::<f64>()?;
    }
    Ok(tables)
}

/// ln L by data set and pair.
type Values = BTreeMap<(String, String), f64>;

/// The ln L of each mixture by the script, and its seconds.
fn of_scipy(path: &Path) -> Result<(Values, f64), Box<dyn Error>> {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let python = here.join("../../.venv/bin/python");
    let done = Command::new(python).arg(here.join("examples/mixtures.py")).arg(path).output()?;
    if !done.status.success() {
        return Err(String::from_utf8_lossy(&done.stderr).into());
    }
    let (mut found, mut seconds) = (Values::new(), f64::NAN);
    for line in String::from_utf8(done.stdout)?.lines() {
        match line.split(' ').collect::<Vec<_>>()[..] {
            [name, pair, value] => drop(found.insert((name.to_owned(), pair.to_owned()), value.parse()?)),
            ["seconds", value] => seconds = value.parse()?,
            _ => return Err(format!("the script says `{line}`").into()),
        }
    }
    Ok((found, seconds))
}
