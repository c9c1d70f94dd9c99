//! Zones of equally many ranks: in each a bud has each fate with the share of that fate in the zone, whatever its
//! neighbours are (de Reffye et al. 1988 §4).
//!
//! The shares counted are those of the largest likelihood. Absent: zones of unequal width.

use super::Shoots;
use crate::draws::Draws;
use crate::fit::Fit;
use crate::special::x_ln_y;

/// Shares of the fates in each zone, from the first rank.
#[derive(Debug, Clone, PartialEq)]
pub struct Zones {
    /// Ranks of a zone.
    pub width: usize,
    /// Shares of each fate.
    pub shares: Vec<Vec<f64>>,
}

/// The zones of so many ranks, with the fit.
pub fn fit(shoots: &Shoots, width: usize) -> (Zones, Fit) {
    let width = width.max(1);
    let mut counts = vec![vec![0.0; shoots.fates]; shoots.longest().div_ceil(width)];
    for shoot in &shoots.shoots {
        shoot.iter().enumerate().for_each(|(rank, fate)| counts[rank / width][*fate] += 1.0);
    }
    let total = |zone: &[f64]| zone.iter().sum::<f64>();
    let ln = |zone: &Vec<f64>| zone.iter().map(|count| x_ln_y(*count, *count / total(zone))).sum::<f64>();
    let log_likelihood = counts.iter().map(ln).sum();
    // A fate that a zone has not is no free share.
    let free = |zone: &Vec<f64>| zone.iter().filter(|count| **count > 0.0).count() - 1;
    let parameters = counts.iter().map(free).sum();
    let shares = counts.iter().map(|zone| zone.iter().map(|count| count / total(zone)).collect()).collect();
    let fit = Fit {
        law: format!("zones of {width} ranks, independent buds"),
        estimates: Vec::new(),
        covariance: Vec::new(),
        log_likelihood: Some(log_likelihood),
        parameters,
        n: shoots.buds(),
        tests: Vec::new(),
        notes: Vec::new(),
    };
    (Zones { width, shares }, fit)
}

impl Zones {
    /// ln L of other shoots. A share of a thousandth is kept for all fates together, so that one that the counted
    /// shoots had not is not impossible; the last zone goes on.
    pub fn log_likelihood(&self, shoots: &Shoots) -> f64 {
        let zone = |rank: usize| &self.shares[(rank / self.width).min(self.shares.len() - 1)];
        let ln = |(rank, fate): (usize, &usize)| {
            phytomer_sim::math::log(0.999 * zone(rank)[*fate] + 0.001 / shoots.fates as f64)
        };
        shoots.shoots.iter().map(|shoot| shoot.iter().enumerate().map(ln).sum::<f64>()).sum()
    }

    /// The fates of a shoot of so many buds.
    pub fn draw(&self, buds: usize, draws: &mut Draws) -> Vec<usize> {
        let zone = |rank: usize| &self.shares[(rank / self.width).min(self.shares.len() - 1)];
        (0..buds).map(|rank| draws.among(zone(rank))).collect()
    }
}
