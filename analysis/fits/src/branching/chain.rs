//! A chain of zones: a left-to-right hidden semi-Markov chain (Guédon 2003; Guédon et al. 2001 for apple shoots).
//!
//! A shoot passes through zones in order, and may skip at most two; in a zone each bud has a fate with the zone's
//! shares; a zone's length is 1 + NB(r, p); the end of the shoot cuts the last. Estimated by EM from several keyed
//! beginnings. Which fates a zone may have can be bounded, such as latent buds alone at both ends. Absent: several
//! chains at once.

use super::Shoots;
use super::durations::Length;
use super::forward::{Expected, Lengths, add};
pub use super::law::Chain;
use super::law::SKIPPED;
use crate::draws::Draws;
use crate::fit::{Estimate, Fit};
use crate::problem::Problem;

/// EM ends where a step gains less.
const LEAST_GAIN: f64 = 1e-5;

/// What is asked of the estimate.
#[derive(Debug, Clone, PartialEq)]
pub struct Asked {
    /// The number of zones.
    pub zones: usize,
    /// The fate that the first and the last zone have alone, if any.
    pub ends: Option<usize>,
    /// The seed of the beginnings.
    pub seed: u64,
    /// How many beginnings.
    pub beginnings: u32,
}

impl Chain {
    /// ln L of shoots.
    pub fn log_likelihood(&self, shoots: &Shoots) -> f64 {
        self.expected(shoots).map_or(f64::NEG_INFINITY, |sums| sums.log_likelihood)
    }

    fn expected(&self, shoots: &Shoots) -> Option<Expected> {
        let longest = shoots.longest();
        let mut masses: Vec<Vec<f64>> = (0..self.zones()).map(|zone| self.length(zone).masses(longest)).collect();
        let mut survivors: Vec<Vec<f64>> = masses.iter().map(|masses| Length::survivors(masses)).collect();
        // The last zone lasts to the end of the shoot.
        if let (Some(masses), Some(survivors)) = (masses.last_mut(), survivors.last_mut()) {
            masses.fill(0.0);
            survivors.fill(1.0);
        }
        let lengths = Lengths { masses, survivors };
        let mut sums = Expected::none(self.zones(), shoots.fates, longest);
        shoots.shoots.iter().all(|shoot| add(self, &lengths, shoot, &mut sums)).then_some(sums)
    }

    /// The chain of other shoots to which EM climbs from this one; `None` where it cannot make them.
    pub fn refitted(&self, shoots: &Shoots) -> Option<Self> {
        let (top, chain) = self.clone().climbed(shoots, 200);
        top.is_finite().then_some(chain)
    }

    /// One step of EM.
    fn improved(&self, sums: &Expected) -> Self {
        let shares = |weights: &[f64], old: &[f64]| {
            let total: f64 = weights.iter().sum();
            if total > 1e-9 { weights.iter().map(|weight| weight / total).collect() } else { old.to_vec() }
        };
        let zones = 0..self.zones();
        let length = |zone: usize| {
            let length = self.length(zone).improved(&sums.ended[zone], &sums.cut[zone]);
            (length.r, length.p)
        };
        Self {
            first: shares(&sums.first, &self.first),
            next: zones.clone().map(|zone| shares(&sums.passed[zone], &self.next[zone])).collect(),
            shares: zones.clone().map(|zone| shares(&sums.emitted[zone], &self.shares[zone])).collect(),
            lengths: zones
                .map(|zone| if zone + 1 == self.zones() { self.lengths[zone] } else { length(zone) })
                .collect(),
        }
    }

    /// A beginning: shoots cut into equal pieces with shifted limits, whose fates are counted.
    fn begun(shoots: &Shoots, asked: &Asked, number: u32) -> Self {
        let mut draws = Draws::new(asked.seed, number.into());
        let zones = asked.zones;
        let mut limits: Vec<f64> = (0..zones).map(|_| 0.15 + draws.share()).collect();
        let total: f64 = limits.iter().sum();
        let mut sum = 0.0;
        limits.iter_mut().for_each(|limit| {
            sum += *limit / total;
            *limit = sum;
        });
        let mut counts = vec![vec![0.3; shoots.fates]; zones];
        for shoot in &shoots.shoots {
            for (rank, fate) in shoot.iter().enumerate() {
                let place = (rank as f64 + 0.5) / shoot.len() as f64;
                let zone = limits.iter().position(|limit| place <= *limit).unwrap_or(zones - 1);
                counts[zone][*fate] += 1.0;
            }
        }
        for (zone, counts) in counts.iter_mut().enumerate() {
            let total: f64 = counts.iter().sum();
            let end = asked.ends.filter(|_| zone == 0 || zone + 1 == zones);
            for (fate, count) in counts.iter_mut().enumerate() {
                *count = end.map_or(*count / total, |end| f64::from(u8::from(fate == end)));
            }
        }
        let after = |from: Option<usize>| {
            let begin = from.map_or(0, |from| from + 1);
            let weight =
                |to: usize| if (begin..=begin + SKIPPED).contains(&to) { [0.7, 0.2, 0.1][to - begin] } else { 0.0 };
            let weights: Vec<f64> = (0..zones).map(weight).collect();
            let total: f64 = weights.iter().sum();
            weights.iter().map(|weight| if total > 0.0 { weight / total } else { 0.0 }).collect::<Vec<f64>>()
        };
        let mean = shoots.buds() as f64 / shoots.shoots.len() as f64 / zones as f64;
        let length = Length::of_mean(mean);
        Self {
            first: after(None),
            next: (0..zones).map(|zone| after(Some(zone))).collect(),
            shares: counts,
            lengths: vec![(length.r, length.p); zones],
        }
    }

    fn climbed(mut self, shoots: &Shoots, steps: u32) -> (f64, Self) {
        let mut last = f64::NEG_INFINITY;
        for _ in 0..steps {
            let Some(sums) = self.expected(shoots) else { return (f64::NEG_INFINITY, self) };
            if sums.log_likelihood - last < LEAST_GAIN {
                break;
            }
            last = sums.log_likelihood;
            self = self.improved(&sums);
        }
        (self.log_likelihood(shoots), self)
    }

    /// Free probabilities above 10⁻⁶, and two numbers for the length of each zone but the last.
    fn parameters(&self) -> usize {
        let free = |row: &Vec<f64>| row.iter().filter(|share| **share > 1e-6).count().saturating_sub(1);
        let shares: usize = self.next.iter().chain(&self.shares).map(free).sum();
        free(&self.first) + shares + 2 * (self.zones() - 1)
    }
}

/// The chain of the largest likelihood that EM finds.
///
/// # Errors
/// Fewer than two zones, or no beginning with a chain that can make the shoots.
pub fn fit(shoots: &Shoots, asked: &Asked) -> Result<(Chain, Fit), Problem> {
    if asked.zones < 2 {
        let found = asked.zones as f64;
        return Err(Problem::Impossible { what: "the number of zones".to_owned(), found, expected: "2 or more" });
    }
    let mut begun: Vec<(f64, Chain)> =
        (0..asked.beginnings).map(|number| Chain::begun(shoots, asked, number).climbed(shoots, 25)).collect();
    begun.sort_by(|a, b| b.0.total_cmp(&a.0));
    begun.truncate(3);
    let ended = begun.into_iter().map(|(_, chain)| chain.climbed(shoots, 600));
    let advice = "ask for other zones, or for ends that may have every fate";
    let best = ended.max_by(|a, b| a.0.total_cmp(&b.0)).filter(|best| best.0.is_finite());
    let (log_likelihood, chain) = best.ok_or(Problem::NoMaximum { law: "a chain of zones", advice })?;
    let estimates =
        (0..chain.zones() - 1).map(|zone| Estimate::bare(&format!("length_{}", zone + 1), chain.mean_length(zone)));
    let fit = Fit {
        law: format!("chain of {} zones", chain.zones()),
        estimates: estimates.collect(),
        covariance: Vec::new(),
        log_likelihood: Some(log_likelihood),
        parameters: chain.parameters(),
        n: shoots.buds(),
        tests: Vec::new(),
        notes: vec!["EM finds a top near its beginnings: another seed may find a higher one".to_owned()],
    };
    Ok((chain, fit))
}
