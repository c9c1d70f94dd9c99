//! The crown's parameters from pairs of branches (crown analysis: de Reffye, Elguero & Costes 1991): the activity b₁ of
//! the bearing axis, b₂ of its branches, and w, the speed of a branch's clock against that of its bearer.
//!
//! K nodes stand above a node with two branches. The N ticks since its birth are those of a bud that has made K nodes
//! and not yet one more: EN = (K + 1)/b₁ − 1, VN = (K + 1)(1 − b₁)/b₁². A branch has made a binomial number of nodes of
//! ⌊w N⌋ trials of b₂, both branches with the same N. Moments (X = w b₂ EN, V − v = (w b₂)² VN, v/X = 1 − b₂, with the
//! variance v within pairs) take the step of the clock for its mean and are biased: for .9, .7 and .8 at K = 20 they
//! tend to .880, .700 and .761. So the exact likelihood of the pairs is maximised; moments are where the search begins.
//! Only living branches may be counted: a dead branch stopped before its node was K nodes old.

use crate::draws::Draws;
use crate::fit::{Estimate, Fit};
use crate::likelihood::{Model, Scale};
use crate::problem::Problem;
use crate::special::{ln_choose, x_ln_y};
use phytomer_sim::math;

/// The two branches of a node.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Pair {
    /// Nodes of the bearing axis above the node of the branches.
    pub above: u32,
    /// Nodes of the branches.
    pub nodes: [u32; 2],
}

/// The fewest pairs of a fit.
const FEWEST: usize = 10;
/// The most trials of a branch, and the most ticks, that the likelihood sums over.
const MOST: usize = 2000;
/// Half the 95 % quantile of χ² with one degree of freedom.
const DROP: f64 = 1.920_729_410_347_062;
/// The width that an interval of b should have, for the number of pairs that is needed.
const WANTED: f64 = 0.05;

/// b₁, b₂ and w by the moments of pairs at one rank, for w N without steps.
///
/// # Errors
/// Fewer than 3 pairs, pairs of several ranks, no nodes, or variances that no such plants have.
pub fn moments(pairs: &[Pair]) -> Result<[f64; 3], Problem> {
    let Some(first) = pairs.first().filter(|_| pairs.len() >= 3) else {
        return Err(Problem::TooFew { what: "pairs", found: pairs.len(), needed: 3, purpose: "the crown's moments" });
    };
    if let Some(other) = pairs.iter().find(|pair| pair.above != first.above) {
        let what = "the number of nodes above a pair".to_owned();
        return Err(Problem::Impossible { what, found: f64::from(other.above), expected: "the same for all moments" });
    }
    let all: Vec<f64> = pairs.iter().flat_map(|pair| pair.nodes.map(f64::from)).collect();
    let n = all.len() as f64;
    let mean = all.iter().sum::<f64>() / n;
    let off = |pair: &Pair| f64::from(pair.nodes[0]) - f64::from(pair.nodes[1]);
    let within = pairs.iter().map(|pair| off(pair) * off(pair) / 2.0).sum::<f64>() / pairs.len() as f64;
    let centred = |pair: &Pair| (f64::from(pair.nodes[0]) - mean) * (f64::from(pair.nodes[1]) - mean);
    let shared = pairs.iter().map(centred).sum::<f64>() / (pairs.len() as f64 - 1.0);
    let b2 = 1.0 - within / mean;
    // VN / EN² = (K + 1)(1 − b₁)/(K + 1 − b₁)².
    let ratio = shared / (mean * mean);
    let k = f64::from(first.above) + 1.0;
    let (mut low, mut high) = (1e-6, 1.0);
    for _ in 0..100 {
        let b1 = 0.5 * (low + high);
        if k * (1.0 - b1) / ((k - b1) * (k - b1)) > ratio { low = b1 } else { high = b1 }
    }
    let b1 = 0.5 * (low + high);
    let w = mean / (b2 * (k / b1 - 1.0));
    if mean > 0.0 && (0.0..1.0).contains(&b2) && b2 > 0.0 && b1 < 1.0 - 1e-9 && w.is_finite() {
        return Ok([b1, b2, w]);
    }
    let what =
        format!("pairs of {mean:.2} nodes on average, variance {within:.2} within pairs and {shared:.2} between");
    Err(Problem::Degenerate {
        what, consequence: "no b₁, b₂ and w have such moments; see whether branches were alive"
    })
}

/// Equal pairs with their number, and the ticks of each rank.
struct Sums {
    pairs: Vec<(Pair, f64)>,
    most_nodes: usize,
}

impl Sums {
    fn of(pairs: &[Pair]) -> Self {
        // The order of the two branches does not matter.
        let mut sorted: Vec<Pair> = pairs
            .iter()
            .map(|pair| Pair { nodes: [pair.nodes[0].min(pair.nodes[1]), pair.nodes[0].max(pair.nodes[1])], ..*pair })
            .collect();
        sorted.sort();
        let mut counted: Vec<(Pair, f64)> = Vec::new();
        for pair in sorted {
            match counted.last_mut() {
                Some((last, number)) if *last == pair => *number += 1.0,
                _ => counted.push((pair, 1.0)),
            }
        }
        let most_nodes = pairs.iter().flat_map(|pair| pair.nodes).max().unwrap_or(0) as usize;
        Self { pairs: counted, most_nodes }
    }

    /// ln L at b₁, b₂ and w.
    fn log_likelihood(&self, b1: f64, b2: f64, w: f64) -> f64 {
        let mut sum = 0.0;
        let mut rank = None;
        let mut ticks: Vec<(usize, f64)> = Vec::new();
        let mut masses: Vec<Vec<f64>> = Vec::new();
        for (pair, number) in &self.pairs {
            if rank != Some(pair.above) {
                rank = Some(pair.above);
                ticks = trials(pair.above, b1, w);
                let most = ticks.last().map_or(0, |last| last.0);
                (masses.len()..=most).for_each(|m| masses.push(binomial(m, b2, self.most_nodes)));
            }
            let [a, b] = pair.nodes.map(|nodes| nodes as usize);
            let mass: f64 = ticks.iter().map(|(m, weight)| weight * masses[*m][a] * masses[*m][b]).sum();
            sum += number * math::log(mass.max(1e-300));
        }
        sum
    }
}

/// The trials ⌊w N⌋ of a branch with their probabilities, in ascending order; those below 10⁻¹³ in all are left out.
fn trials(above: u32, b1: f64, w: f64) -> Vec<(usize, f64)> {
    let k = f64::from(above);
    let mut ticks: Vec<(usize, f64)> = Vec::new();
    let mut left = 1.0;
    for n in above as usize..above as usize + MOST {
        let x = n as f64;
        let mass = math::exp(ln_choose(x, k) + (k + 1.0) * math::log(b1) + x_ln_y(x - k, 1.0 - b1));
        left -= mass;
        // A product that is whole but for rounding is whole.
        let m = ((w * x + 1e-9).floor() as usize).min(MOST);
        match ticks.last_mut() {
            Some((last, weight)) if *last == m => *weight += mass,
            _ => ticks.push((m, mass)),
        }
        if left < 1e-13 {
            break;
        }
    }
    ticks
}

/// The trials of a branch at a number of nodes above it, and their probabilities alone.
type OfRank = (u32, Vec<(usize, f64)>, Vec<f64>);

/// ln L of pairs at b₁, b₂ and w.
pub(crate) fn log_likelihood(pairs: &[Pair], [b1, b2, w]: [f64; 3]) -> f64 {
    Sums::of(pairs).log_likelihood(b1, b2, w)
}

/// Pairs with the nodes above them of others, as the model grows them.
pub fn drawn(like: &[Pair], [b1, b2, w]: [f64; 3], draws: &mut Draws) -> Vec<Pair> {
    let mut kept: Option<OfRank> = None;
    let mut pairs = Vec::with_capacity(like.len());
    for Pair { above, .. } in like.iter().copied() {
        let (_, trials, weights) = match kept.take().filter(|kept| kept.0 == above) {
            Some(same) => kept.insert(same),
            None => {
                let trials = trials(above, b1, w);
                let weights = trials.iter().map(|trial| trial.1).collect();
                kept.insert((above, trials, weights))
            }
        };
        let m = trials[draws.among(weights)].0 as u32;
        pairs.push(Pair { above, nodes: [draws.binomial(m, b2), draws.binomial(m, b2)] });
    }
    pairs
}

/// Binomial probabilities of 0 … `most` successes: that of the most likely number, and from it each by its neighbour,
/// (m − x) p / ((x + 1) q).
fn binomial(trials: usize, p: f64, most: usize) -> Vec<f64> {
    let (m, odds) = (trials as f64, p / (1.0 - p));
    let mut masses = vec![0.0; most + 1];
    let (start, last) = ((((m + 1.0) * p) as usize).min(most).min(trials), most.min(trials));
    let k = start as f64;
    masses[start] = math::exp(ln_choose(m, k) + x_ln_y(k, p) + (m - k) * math::log1p(-p));
    for x in start..last {
        masses[x + 1] = masses[x] * odds * (m - x as f64) / (x as f64 + 1.0);
    }
    for x in (0..start).rev() {
        masses[x] = masses[x + 1] * (x as f64 + 1.0) / (odds * (m - x as f64));
    }
    masses
}

/// b₁, b₂ and w by the exact likelihood of pairs, with as many ranks as there are.
///
/// # Errors
/// Fewer than 10 pairs, or branches without nodes.
pub fn fit(pairs: &[Pair]) -> Result<Fit, Problem> {
    if pairs.len() < FEWEST {
        return Err(Problem::TooFew { what: "pairs", found: pairs.len(), needed: FEWEST, purpose: "the crown" });
    }
    if pairs.iter().all(|pair| pair.nodes == [0, 0]) {
        let consequence = "b₁, b₂ and w cannot be told; count older branches";
        return Err(Problem::Degenerate { what: "no branch has a node (rank 0)".to_owned(), consequence });
    }
    if pairs.iter().all(|pair| pair.above == 0) {
        let consequence = "b₁ and w cannot be told; count pairs with nodes above them";
        return Err(Problem::Degenerate { what: "no pair has a node of its bearer above it".to_owned(), consequence });
    }
    let sums = Sums::of(pairs);
    let begin = begin(pairs);
    // The likelihood has steps in w: all of its neighbourhood is looked at, first coarsely.
    let coarse = scan(&sums, begin, (-45..=60).map(|k| begin[2] * (1.0 + 0.01 * f64::from(k))));
    let best =
        top(&coarse).ok_or(Problem::NoMaximum { law: "the crown", advice: "see whether the branches were alive" })?;
    let near: Vec<f64> =
        coarse.iter().filter(|here| here.value >= best.value - 2.0 * DROP).map(|here| here.w).collect();
    let (low, high) = (near.iter().copied().fold(best.w, f64::min), near.iter().copied().fold(best.w, f64::max));
    let step = ((high - low) / 60.0).max(0.001);
    let fine = scan(&sums, [best.b[0], best.b[1], best.w], (-6..=66).map(|k| low + step * f64::from(k)));
    let all: Vec<AtSpeed> = coarse.into_iter().chain(fine).collect();
    finished(&sums, pairs, &all)
}

/// The best b₁ and b₂ at each speed, each from those of the last.
fn scan(sums: &Sums, begin: [f64; 3], speeds: impl Iterator<Item = f64>) -> Vec<AtSpeed> {
    let mut b = [begin[0], begin[1]];
    let mut found = Vec::new();
    for w in speeds.filter(|w| *w > 0.01) {
        if let Ok(here) = at_speed(sums, w, b) {
            b = here.b.map(|b| b.clamp(0.02, 0.995));
            found.push(here);
        }
    }
    found
}

fn top(found: &[AtSpeed]) -> Option<AtSpeed> {
    found.iter().copied().max_by(|a, b| a.value.total_cmp(&b.value))
}

/// The moments of the most common rank, or values in the middle.
fn begin(pairs: &[Pair]) -> [f64; 3] {
    let mut ranks: Vec<u32> = pairs.iter().map(|pair| pair.above).filter(|above| *above > 0).collect();
    ranks.sort_unstable();
    let of = |rank: u32| pairs.iter().copied().filter(|pair| pair.above == rank).collect::<Vec<_>>();
    let common = ranks.chunk_by(|a, b| a == b).max_by_key(|chunk| chunk.len()).and_then(|chunk| chunk.first());
    let found = common.and_then(|rank| moments(&of(*rank)).ok());
    let [b1, b2, w] = found.unwrap_or([0.8, 0.8, 1.0]);
    [b1.clamp(0.1, 0.98), b2.clamp(0.1, 0.98), w.clamp(0.05, 5.0)]
}

/// The best b₁ and b₂ at a speed.
#[derive(Clone, Copy)]
struct AtSpeed {
    w: f64,
    b: [f64; 2],
    value: f64,
}

const ACTIVITIES: [(&str, Scale); 2] = [("b1", Scale::Share), ("b2", Scale::Share)];

fn at_speed(sums: &Sums, w: f64, from: [f64; 2]) -> Result<AtSpeed, Problem> {
    let f = |at: &[f64]| sums.log_likelihood(at[0], at[1], w);
    let model = Model { law: "the crown", parameters: &ACTIVITIES, log_likelihood: &f, n: 0 };
    let (at, value) = model.nearby(&from)?;
    Ok(AtSpeed { w, b: [at[0], at[1]], value })
}

/// Intervals: that of w has all speeds within 1.92 of the largest ln L; b₁ and b₂ vary at one speed, and from speed to
/// speed.
fn finished(sums: &Sums, pairs: &[Pair], all: &[AtSpeed]) -> Result<Fit, Problem> {
    let advice = "see whether the branches were alive";
    let best = top(all).ok_or(Problem::NoMaximum { law: "the crown", advice })?;
    let mut limits = [[best.b[0]; 2], [best.b[1]; 2], [best.w; 2]];
    for here in all.iter().filter(|here| here.value >= best.value - DROP) {
        for (limit, value) in limits.iter_mut().zip([here.b[0], here.b[1], here.w]) {
            *limit = [limit[0].min(value), limit[1].max(value)];
        }
    }
    let f = |at: &[f64]| sums.log_likelihood(at[0], at[1], best.w);
    let model = Model { law: "the crown", parameters: &ACTIVITIES, log_likelihood: &f, n: pairs.len() };
    let mut fit = model.fit(&[best.b.to_vec()])?;
    for (estimate, [low, high]) in fit.estimates.iter_mut().zip(limits) {
        // The variance at a given w, and that of the course along the profile of w.
        let along = (high - low) / (2.0 * 1.96);
        let error = estimate.error.map_or(along, |error| (error * error + along * along).sqrt());
        estimate.error = Some(error);
        estimate.low = Some((estimate.value - 1.96 * error).max(0.0));
        estimate.high = Some((estimate.value + 1.96 * error).min(1.0));
    }
    let [low, high] = limits[2];
    let speed = Estimate::bare("w", best.w).within(low, high);
    fit.estimates.push(Estimate { error: Some((high - low) / (2.0 * 1.96)), ..speed });
    fit.covariance = Vec::new();
    fit.parameters = 3;
    fit.log_likelihood = Some(best.value);
    fit.notes.push("for living branches only: a branch that died stopped before its bearer did".to_owned());
    fit.notes.extend(needed(&fit, pairs.len()));
    Ok(fit)
}

/// How many pairs make the interval of b₁ ± .05.
fn needed(fit: &Fit, pairs: usize) -> Option<String> {
    let half = fit.estimate("b1").and_then(|b1| b1.error).map(|error| 1.96 * error)?;
    let times = half * half / (WANTED * WANTED);
    let wanted = (pairs as f64 * times).ceil();
    Some(format!("{pairs} pairs give b1 within ± {half:.3}; {wanted} pairs are needed for ± {WANTED}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each probability from its neighbour is that of the formula, and all sum to 1.
    #[test]
    fn binomial_probabilities() {
        for (m, p) in [(0, 0.3), (1, 0.02), (40, 0.7), (90, 0.995), (2000, 0.4)] {
            let masses = binomial(m, p, m + 3);
            for (x, mass) in masses.iter().enumerate() {
                let (m, k) = (m as f64, x as f64);
                let ln = ln_choose(m, k) + x_ln_y(k, p) + x_ln_y(m - k, 1.0 - p);
                let expected = if k > m { 0.0 } else { math::exp(ln) };
                assert!((mass - expected).abs() <= 1e-10 * expected + 1e-300, "B({m}, {p}) at {k}: {mass} {expected}");
            }
            assert!((masses.iter().sum::<f64>() - 1.0).abs() < 1e-10, "B({m}, {p})");
            for (half, whole) in binomial(m, p, m / 2).iter().zip(&masses) {
                assert!((half - whole).abs() <= 1e-10 * whole + 1e-300, "B({m}, {p}), the first half");
            }
        }
    }

    /// Pairs of one rank, as the model grows them.
    fn drawn(above: u32, at: [f64; 3], pairs: usize, seed: u64) -> Vec<Pair> {
        super::drawn(&vec![Pair { above, nodes: [0, 0] }; pairs], at, &mut Draws::new(seed, 0))
    }

    /// EN and VN as the head of this file has them.
    #[test]
    fn ticks_have_their_closed_moments() {
        for (above, b1) in [(0, 0.5), (7, 0.9), (20, 0.9)] {
            let ticks = trials(above, b1, 1.0);
            let mean: f64 = ticks.iter().map(|(n, weight)| *n as f64 * weight).sum();
            let square: f64 = ticks.iter().map(|(n, weight)| (*n as f64 - mean) * (*n as f64 - mean) * weight).sum();
            let k = f64::from(above) + 1.0;
            assert!((mean - (k / b1 - 1.0)).abs() < 1e-9, "{mean}");
            assert!((square - k * (1.0 - b1) / (b1 * b1)).abs() < 1e-8, "{square}");
        }
    }

    /// The moments tend to .880, .700 and .761 for .9, .7 and .8 at 20 nodes above; 400,000 pairs, bounds of 4 errors
    /// (.016 √(1000/400000) and so on).
    #[test]
    fn the_step_of_the_clock_biases_the_moments() {
        let found = moments(&drawn(20, [0.9, 0.7, 0.8], 400_000, 1988)).unwrap();
        for ((found, limit), error) in found.iter().zip([0.880, 0.700, 0.761]).zip([0.016, 0.014, 0.033]) {
            assert!((found - limit).abs() < 4.0 * error * 0.05 + 5e-4, "{found} {limit}");
        }
    }

    #[test]
    fn the_likelihood_of_pairs_is_not_biased() {
        let fit = fit(&drawn(20, [0.9, 0.7, 0.8], 2000, 1989)).unwrap();
        for (name, truth, error) in [("b1", 0.9, 0.016), ("b2", 0.7, 0.014), ("w", 0.8, 0.033)] {
            let found = fit.value(name);
            assert!((found - truth).abs() < 4.0 * error * 0.75, "{name}: {found}");
        }
        assert!(fit.notes.iter().any(|note| note.contains("pairs are needed")), "{:?}", fit.notes);
    }

    /// At .9, .7 and 1 with 1,000 pairs of one rank the standard deviations are .016, .014 and .033 (an independent
    /// program); 24 samples of 250 pairs tell each within 4 of its own errors, 1/√(2·23) of it.
    #[test]
    fn estimates_scatter_as_far_as_is_told() {
        let fits: Vec<Fit> = (0..24).map(|seed| fit(&drawn(20, [0.9, 0.7, 1.0], 250, seed)).unwrap()).collect();
        for (name, sd) in [("b1", 0.016), ("b2", 0.014), ("w", 0.033)] {
            let values: Vec<f64> = fits.iter().map(|fit| fit.value(name)).collect();
            let mean = values.iter().sum::<f64>() / 24.0;
            let found = (values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / 23.0).sqrt() / 2.0;
            println!("{name}: mean {mean:.3}, sd at 1000 pairs {found:.4}, expected {sd}");
            assert!((found / sd - 1.0).abs() < 4.0 / 46.0_f64.sqrt(), "{name}: {found} {sd}");
        }
    }

    #[test]
    fn pairs_that_tell_nothing_are_refused() {
        let pairs = |above, nodes| vec![Pair { above, nodes }; 20];
        let told = |pairs: &[Pair]| fit(pairs).unwrap_err().to_string();
        assert!(told(&pairs(5, [0, 0])).contains("no branch has a node"));
        assert!(told(&pairs(0, [1, 1])).contains("no pair has a node of its bearer above"));
        assert!(told(&pairs(5, [1, 2])[..3]).contains("3 pairs, and at least 10"));
    }
}
