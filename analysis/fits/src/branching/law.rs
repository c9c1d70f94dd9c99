//! A chain of zones as a law: where it begins, how long its zones are, which follows, and the fates in each.
//!
//! Absent: its estimate (`chain`) and its likelihood (`forward`).

use super::durations::Length;
use crate::draws::Draws;

/// The most zones that are skipped at once.
pub(super) const SKIPPED: usize = 2;

/// A chain of zones.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// The zone in which a shoot begins.
    pub first: Vec<f64>,
    /// From zone to zone; no zone follows the last.
    pub next: Vec<Vec<f64>>,
    /// Shares of fates in each zone.
    pub shares: Vec<Vec<f64>>,
    /// r and p of 1 + NB(r, p) buds, the length of each zone.
    pub lengths: Vec<(f64, f64)>,
}

impl Chain {
    /// The number of zones.
    pub fn zones(&self) -> usize {
        self.first.len()
    }

    /// The zones that may follow a zone.
    pub fn reach(&self, zone: usize) -> std::ops::Range<usize> {
        zone + 1..(zone + 2 + SKIPPED).min(self.zones())
    }

    /// The law of the length of a zone.
    pub(super) fn length(&self, zone: usize) -> Length {
        Length { r: self.lengths[zone].0, p: self.lengths[zone].1 }
    }

    /// The mean length of a zone in buds.
    pub fn mean_length(&self, zone: usize) -> f64 {
        self.length(zone).mean()
    }

    /// The fates of a shoot of so many buds.
    pub fn draw(&self, buds: usize, draws: &mut Draws) -> Vec<usize> {
        let mut fates = Vec::with_capacity(buds);
        let mut zone = draws.among(&self.first);
        while fates.len() < buds {
            let last = zone + 1 == self.zones();
            let length = if last { buds } else { 1 + draws.among(&self.length(zone).masses(buds + 1)) };
            for _ in 0..length.min(buds - fates.len()) {
                fates.push(draws.among(&self.shares[zone]));
            }
            if !last {
                zone = draws.among(&self.next[zone]);
            }
        }
        fates
    }

    /// The same chain with a share of a thousandth for all fates together in each zone, for shoots that it was not
    /// fitted to.
    pub fn softened(&self) -> Self {
        let fates = self.shares.first().map_or(1, Vec::len) as f64;
        let soft = |row: &Vec<f64>| row.iter().map(|share| 0.999 * share + 0.001 / fates).collect();
        Self { shares: self.shares.iter().map(soft).collect(), ..self.clone() }
    }
}
