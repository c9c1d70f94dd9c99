//! The main stem of cotton: variance over mean of its nodes at six dates (GreenLab course, CIRAD), 50 plants each,
//! against the shipped species.
//!
//! A bud that grows in each cycle with probability b makes a number of nodes whose variance is 1 − b of its mean. Of n
//! plants, (n − 1) V / σ² is χ² with n − 1 degrees of freedom.

use crate::chi2::{Outcome, tail};
use crate::measured::{Table, moments};
use crate::simulated::{grown, shipped};

const PLANTS: f64 = 50.0;

/// The mean and the variance of the number of nodes at each date.
fn dates() -> Option<Vec<(f64, f64)>> {
    let table = Table::read("greenlab_published_tables.csv")?;
    let of_cotton = table.rows().filter(|row| row.text("table") == "cotton_main_stem");
    Some(of_cotton.map(|row| (row.number("x"), row.number("y"))).collect())
}

#[test]
fn the_activity_is_the_slope_of_variance_on_mean() {
    let Some(dates) = dates() else { return };
    let (xx, xv) = dates.iter().fold((0.0, 0.0), |(xx, xv), (x, v)| (xx + x * x, xv + x * v));
    let b = 1.0 - xv / xx;
    println!("| cotton, main stem | b {b:.3} |");
    assert!((b - 0.82).abs() < 0.02, "{b}");
}

/// The younger plants of two dates, with 4 and 7 nodes, are more alike than the law states; at the other four dates the
/// law holds.
#[test]
fn the_main_stem_spreads_as_measured() {
    let Some(dates) = dates() else { return };
    let stem = shipped("cotton", 1);
    for (x, v) in dates {
        let cycles = (x / 0.82).round() as u32;
        let nodes: Vec<f64> = grown(&stem, 5000, cycles).iter().map(|plant| plant.nodes.len() as f64).collect();
        let (mean, variance) = moments(&nodes);
        assert!((mean / x - 1.0).abs() < 0.05, "{mean} nodes, measured {x}");
        let statistic = (PLANTS - 1.0) * (v / x) / (variance / mean);
        let above = tail(statistic, 49);
        let outcome = Outcome { statistic, df: 49, p: 2.0 * above.min(1.0 - above) };
        let what = format!("cotton, variance at {x} nodes");
        if x < 4.5 || (7.0..8.0).contains(&x) { outcome.assert_misfit(&what) } else { outcome.assert_fits(&what) }
    }
}
