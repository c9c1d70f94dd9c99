//! The log-rank test that groups of lives end alike (Mantel 1966; Peto & Peto 1972; with ties as in Kalbfleisch &
//! Prentice 2002, §1.5), and the same for lives that stand on plants.
//!
//! U_g = Σ (d_g − n_g d / n), with the hypergeometric variance d (n − d) / (n − 1) · n_g / n (δ − n_h / n): χ² with one
//! degree of freedom less than groups, where lives are independent. Of plants: U is the sum of what each plant adds,
//! Σ_g (δ − n_h / n)(d_pg − n_pg h) (Lin & Wei 1989), and Hotelling's T² of these has an F distribution.

use super::lives::{Counts, Lives};
use super::solve::quadratic_form;
use crate::{Lack, quantile};

/// The outcome of the test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LogRank {
    /// χ² of independent lives, or T² of plants.
    pub statistic: f64,
    /// Degrees of freedom: one less than groups.
    pub df: u64,
    /// The degrees of freedom of the denominator of F; `None` for χ².
    pub of_plants: Option<u64>,
    /// The probability of a statistic at least as large where the groups do not differ.
    pub p: f64,
}

/// The groups that have lives, over the longest life of all.
fn counted(groups: &[&Lives]) -> Result<(Vec<Counts>, Counts), Lack> {
    let durations = groups.iter().map(|lives| lives.durations()).max().unwrap_or(0);
    let of_groups: Vec<Counts> =
        groups.iter().filter(|lives| !lives.is_empty()).map(|lives| lives.whole(durations)).collect();
    let Some(mut all) = of_groups.first().cloned() else { return Err(Lack::Empty) };
    if of_groups.len() < 2 {
        return Err(Lack::Groups { found: of_groups.len() as u64, needed: 2 });
    }
    for group in &of_groups[1..] {
        for at in 0..durations {
            all.ended[at] += group.ended[at];
            all.at_risk[at] += group.at_risk[at];
        }
    }
    if all.ended.iter().all(|ended| *ended == 0.0) {
        return Err(Lack::NoEvents);
    }
    Ok((of_groups, all))
}

/// U of all groups but the last.
fn differences(groups: &[Counts], all: &Counts) -> Vec<f64> {
    let of = |group: &Counts| (0..all.ended.len()).map(|at| group.ended[at] - group.at_risk[at] * all.hazard(at)).sum();
    groups[..groups.len() - 1].iter().map(of).collect()
}

/// The log-rank test of independent lives. Groups without lives are left out.
///
/// # Errors
/// [`Lack::Groups`] with fewer than two groups, [`Lack::NoEvents`] where all lives are censored, [`Lack::NoVariance`]
/// where groups are never at risk together.
pub fn log_rank(groups: &[&Lives]) -> Result<LogRank, Lack> {
    let (groups, all) = counted(groups)?;
    let u = differences(&groups, &all);
    let mut variance = vec![vec![0.0; u.len()]; u.len()];
    for at in 0..all.ended.len() {
        let (n, d) = (all.at_risk[at], all.ended[at]);
        if d == 0.0 || n < 2.0 {
            continue;
        }
        let shared = d * (n - d) / (n - 1.0);
        for (g, row) in variance.iter_mut().enumerate() {
            for (h, cell) in row.iter_mut().enumerate() {
                let own = if g == h { 1.0 } else { 0.0 };
                *cell += shared * groups[g].at_risk[at] / n * (own - groups[h].at_risk[at] / n);
            }
        }
    }
    let statistic = quadratic_form(&variance, &u).ok_or(Lack::NoVariance)?.max(0.0);
    let p = quantile::chi2_above(statistic, u.len() as f64)?;
    Ok(LogRank { statistic, df: u.len() as u64, of_plants: None, p })
}

/// The log-rank test of lives that stand on plants. A plant must have the same number in all groups; its lives may lie
/// in several.
///
/// # Errors
/// As [`log_rank`], and [`Lack::Plants`] with hardly more plants than groups.
pub fn log_rank_of_plants(groups: &[&Lives]) -> Result<LogRank, Lack> {
    let (counts, all) = counted(groups)?;
    let lives: Vec<&&Lives> = groups.iter().filter(|lives| !lives.is_empty()).collect();
    let q = counts.len() - 1;
    let clusters = lives.iter().map(|lives| lives.clusters.len()).max().unwrap_or(0);
    let mut of_plants = Vec::new();
    for cluster in 0..clusters {
        of_plants.extend(share_of_cluster(&lives, (&counts, &all), cluster));
    }
    let n = of_plants.len();
    if n < q + 2 {
        return Err(Lack::Plants { found: n as u64, needed: q as u64 + 2 });
    }
    let mean: Vec<f64> = (0..q).map(|g| of_plants.iter().map(|u| u[g]).sum::<f64>() / n as f64).collect();
    let covariance = |g: usize, h: usize| -> f64 {
        of_plants.iter().map(|u| (u[g] - mean[g]) * (u[h] - mean[h])).sum::<f64>() / (n - 1) as f64
    };
    let matrix: Vec<Vec<f64>> = (0..q).map(|g| (0..q).map(|h| covariance(g, h)).collect()).collect();
    let statistic = n as f64 * quadratic_form(&matrix, &mean).ok_or(Lack::NoVariance)?.max(0.0);
    let df2 = n - q;
    let f = statistic * df2 as f64 / (q as f64 * (n - 1) as f64);
    let p = quantile::f_above(f, q as f64, df2 as f64)?;
    Ok(LogRank { statistic, df: q as u64, of_plants: Some(df2 as u64), p })
}

/// What the plants of a cluster add to U; `None` where they have no life.
fn share_of_cluster(lives: &[&&Lives], (counts, all): (&[Counts], &Counts), cluster: usize) -> Option<Vec<f64>> {
    let durations = all.ended.len();
    let own: Vec<Option<Counts>> = lives
        .iter()
        .map(|lives| {
            let table = lives.clusters.get(cluster).filter(|table| !table.is_empty());
            table.map(|table| table.counts(durations, lives.causes()))
        })
        .collect();
    own.iter().any(Option::is_some).then_some(())?;
    let mut shares = vec![0.0; counts.len() - 1];
    for at in (0..durations).filter(|at| all.at_risk[*at] > 0.0) {
        let hazard = all.hazard(at);
        let excess = |own: &Counts| own.ended[at] - own.at_risk[at] * hazard;
        let total: f64 = own.iter().flatten().map(excess).sum();
        for (g, share) in shares.iter_mut().enumerate() {
            let own = own[g].as_ref().map_or(0.0, excess);
            *share += own - counts[g].at_risk[at] / all.at_risk[at] * total;
        }
    }
    Some(shares)
}
