//! Two builds of the program side by side: the times of their benches, run by turns on one machine.
//!
//! Each folder holds the criterion homes of some runs of one build, in folders of any names. Of each bench that both
//! builds have, the table tells the median of its medians before and after, and the fastest: on a machine with other
//! work the fastest runs are those that were disturbed least. Absent: running them; `docs/performance.md` says how.

use super::{Bench, collect};
use anyhow::{Context, Result, ensure};
use std::collections::BTreeMap;
use std::path::Path;

/// The medians of each bench, seconds, one a run, rising.
type Runs = BTreeMap<(String, String), Vec<f64>>;

/// Prints the table.
pub fn ratios(before: &Path, after: &Path) -> Result<()> {
    let [before, after] = [runs(before)?, runs(after)?];
    let both = || before.iter().filter_map(|(bench, times)| Some((bench, times, after.get(bench)?)));
    ensure!(both().next().is_some(), "the two folders have no bench in common");
    println!("| specimen/what | bench | before, ms | after, ms | after / before | fastest / fastest |");
    println!("|---|---|---:|---:|---:|---:|");
    for ((group, name), before, after) in both() {
        let [was, is] = [before, after].map(|times| times[times.len() / 2]);
        let (median, fastest) = (is / was, after[0] / before[0]);
        println!("| {group} | {name} | {:.3} | {:.3} | {median:.2} | {fastest:.2} |", was * 1e3, is * 1e3);
    }
    Ok(())
}

fn runs(folder: &Path) -> Result<Runs> {
    let mut benches = Vec::new();
    collect(folder, &mut benches).with_context(|| format!("cannot read the benches in {}", folder.display()))?;
    let mut runs = Runs::new();
    for Bench { group, name, seconds, .. } in benches {
        runs.entry((group, name)).or_default().push(seconds);
    }
    runs.values_mut().for_each(|times| times.sort_by(f64::total_cmp));
    Ok(runs)
}
