//! Estimation without a likelihood: population Monte-Carlo ABC (Beaumont, Cornuet, Marin & Robert 2009), whose distance
//! halves its share from generation to generation, adjusted by local linear regression (Beaumont, Zhang & Balding
//! 2002).
//!
//! A simulator is a function from parameters and a seed to summaries, or to nothing where the parameters cannot be.
//! Particles are drawn and moved by keyed draws and simulated in parallel, so that the result is the same on any number
//! of threads. Summaries are scaled by their median absolute deviation among the first particles. Absent: checks of
//! the whole (`calibration`), simulators, priors other than uniform ones, and files.

use crate::draws::Draws;
use crate::matrix::inverse;
use crate::problem::Problem;
use phytomer_sim::math;
use rayon::prelude::*;

/// From parameters and a seed to summaries.
pub type Simulator<'a> = &'a (dyn Fn(&[f64], u64) -> Option<Vec<f64>> + Sync);

/// What is asked.
#[derive(Debug, Clone, PartialEq)]
pub struct Asked {
    /// A uniform prior for each parameter: the least and the largest value.
    pub priors: Vec<[f64; 2]>,
    /// Particles of a generation; twice as many are simulated first.
    pub particles: usize,
    /// The most generations.
    pub generations: u32,
    /// The seed.
    pub seed: u64,
}

/// A parameter set with its weight.
#[derive(Debug, Clone, PartialEq)]
pub struct Particle {
    /// The parameters.
    pub at: Vec<f64>,
    /// What was simulated from them.
    pub summaries: Vec<f64>,
    /// Its weight; all sum to 1.
    pub weight: f64,
    /// The distance of its summaries from those observed.
    pub distance: f64,
}

/// The particles of the posterior.
#[derive(Debug, Clone, PartialEq)]
pub struct Posterior {
    /// Adjusted by regression.
    pub particles: Vec<Particle>,
    /// The generations that were made.
    pub generations: u32,
    /// The largest distance that was kept.
    pub within: f64,
}

/// A generation ends the search where it needs more batches of as many simulations as there are particles.
const MOST_BATCHES: u32 = 16;

impl Posterior {
    /// Mean and standard deviation of a parameter.
    pub fn moments(&self, parameter: usize) -> (f64, f64) {
        let mean = self.particles.iter().map(|p| p.weight * p.at[parameter]).sum::<f64>();
        let off = |p: &Particle| (p.at[parameter] - mean) * (p.at[parameter] - mean);
        (mean, self.particles.iter().map(|p| p.weight * off(p)).sum::<f64>().sqrt())
    }

    /// How many particles of equal weight tell as much (Kish 1965).
    pub fn effective(&self) -> f64 {
        1.0 / self.particles.iter().map(|p| p.weight * p.weight).sum::<f64>()
    }

    /// The covariance of two parameters.
    pub fn covariance(&self, a: usize, b: usize) -> f64 {
        let [mean_a, mean_b] = [a, b].map(|parameter| self.moments(parameter).0);
        self.particles.iter().map(|p| p.weight * (p.at[a] - mean_a) * (p.at[b] - mean_b)).sum()
    }

    /// Mean and standard deviation of a summary of the particles.
    pub fn simulated(&self, summary: usize) -> (f64, f64) {
        let mean = self.particles.iter().map(|p| p.weight * p.summaries[summary]).sum::<f64>();
        let off = |p: &Particle| (p.summaries[summary] - mean) * (p.summaries[summary] - mean);
        (mean, self.particles.iter().map(|p| p.weight * off(p)).sum::<f64>().sqrt())
    }

    /// The value that a share of the weight is below.
    pub fn quantile(&self, parameter: usize, share: f64) -> f64 {
        let mut values: Vec<(f64, f64)> = self.particles.iter().map(|p| (p.at[parameter], p.weight)).collect();
        values.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut sum = 0.0;
        let found = values.iter().find(|value| {
            sum += value.1;
            sum >= share
        });
        found.or(values.last()).map_or(f64::NAN, |value| value.0)
    }
}

/// The posterior of parameters.
///
/// # Errors
/// No parameters, a prior that is no interval, fewer than 20 particles, or no parameters of the prior that can be
/// simulated.
pub fn abc(simulate: Simulator<'_>, observed: &[f64], asked: &Asked) -> Result<Posterior, Problem> {
    check(asked)?;
    let begun = first(simulate, observed, asked);
    if begun.len() < asked.particles {
        let (what, purpose) = ("parameter sets that can be simulated", "a posterior");
        return Err(Problem::TooFew { what, found: begun.len(), needed: asked.particles, purpose });
    }
    let scales = scales(&begun);
    let measured = |summaries: &[f64]| distance(summaries, observed, &scales);
    let mut kept: Vec<Particle> =
        begun.into_iter().map(|p| Particle { distance: measured(&p.summaries), ..p }).collect();
    nearest(&mut kept, asked.particles);
    let mut generations = 1;
    while generations < asked.generations {
        let within = kept[kept.len() / 2].distance;
        let Some(next) = generation(simulate, &kept, asked, generations, within, &measured) else { break };
        kept = next;
        nearest(&mut kept, asked.particles);
        generations += 1;
        if within == 0.0 {
            break;
        }
    }
    let within = kept.iter().map(|p| p.distance).fold(0.0, f64::max);
    Ok(Posterior { particles: adjusted(kept, observed, &scales, &asked.priors), generations, within })
}

fn check(asked: &Asked) -> Result<(), Problem> {
    let wrong = asked.priors.iter().find(|[low, high]| !(low.is_finite() && high.is_finite() && low < high));
    if let Some([low, _]) = wrong {
        let what = "the least value of a prior".to_owned();
        return Err(Problem::Impossible { what, found: *low, expected: "a number below the largest value" });
    }
    if asked.priors.is_empty() || asked.particles < 20 {
        let (what, purpose) = ("particles with parameters", "a posterior");
        let found = if asked.priors.is_empty() { 0 } else { asked.particles };
        return Err(Problem::TooFew { what, found, needed: 20, purpose });
    }
    Ok(())
}

/// Particles of the prior, twice as many as are kept.
fn first(simulate: Simulator<'_>, observed: &[f64], asked: &Asked) -> Vec<Particle> {
    let drawn = |number: u64| {
        let mut draws = Draws::new(asked.seed, number);
        let at: Vec<f64> = asked.priors.iter().map(|[low, high]| low + (high - low) * draws.share()).collect();
        let summaries = simulate(&at, seed_of(asked.seed, 0, number))?;
        let usable = summaries.len() == observed.len() && summaries.iter().all(|s| s.is_finite());
        usable.then_some(Particle { at, summaries, weight: 1.0, distance: f64::INFINITY })
    };
    let all: Vec<Option<Particle>> = (0..2 * asked.particles as u64).into_par_iter().map(drawn).collect();
    all.into_iter().flatten().collect()
}

/// The seed of a simulation.
pub(crate) fn seed_of(seed: u64, generation: u32, number: u64) -> u64 {
    seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ (u64::from(generation) << 40) ^ number
}

/// The median absolute deviation of each summary, or 1 where it does not vary.
fn scales(particles: &[Particle]) -> Vec<f64> {
    let median = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    };
    let scale = |k: usize| {
        let middle = median(particles.iter().map(|p| p.summaries[k]).collect());
        let off = median(particles.iter().map(|p| (p.summaries[k] - middle).abs()).collect());
        if off > 0.0 { off } else { 1.0 }
    };
    (0..particles.first().map_or(0, |p| p.summaries.len())).map(scale).collect()
}

fn distance(summaries: &[f64], observed: &[f64], scales: &[f64]) -> f64 {
    let off = |((s, o), scale): ((&f64, &f64), &f64)| ((s - o) / scale) * ((s - o) / scale);
    summaries.iter().zip(observed).zip(scales).map(off).sum::<f64>().sqrt()
}

/// Keeps the nearest. The weights of a generation are of one scale; that of the uniform prior is left out.
fn nearest(particles: &mut Vec<Particle>, most: usize) {
    particles.sort_by(|a, b| a.distance.total_cmp(&b.distance));
    particles.truncate(most);
}

/// As many new particles within a distance, in the order in which they were drawn; `None` where they are too rare.
fn generation(
    simulate: Simulator<'_>,
    kept: &[Particle],
    asked: &Asked,
    number: u32,
    within: f64,
    measured: &(dyn Fn(&[f64]) -> f64 + Sync),
) -> Option<Vec<Particle>> {
    let mut next = Vec::new();
    for batch in 0..MOST_BATCHES {
        let new = moved(simulate, kept, asked, number * MOST_BATCHES + batch, measured);
        next.extend(new.into_iter().filter(|p| p.distance <= within));
        if next.len() >= asked.particles {
            next.truncate(asked.particles);
            return Some(next);
        }
    }
    None
}

/// New particles: kept ones, moved by normal steps of twice their variance (Beaumont et al. 2009).
fn moved(
    simulate: Simulator<'_>,
    kept: &[Particle],
    asked: &Asked,
    generation: u32,
    measured: &(dyn Fn(&[f64]) -> f64 + Sync),
) -> Vec<Particle> {
    let total: f64 = kept.iter().map(|p| p.weight).sum();
    let weights: Vec<f64> = kept.iter().map(|p| p.weight / total).collect();
    let steps: Vec<f64> =
        (0..asked.priors.len()).map(|k| (2.0 * variance(kept, &weights, k)).sqrt().max(1e-12)).collect();
    let drawn = |number: u64| {
        let mut draws = Draws::new(asked.seed ^ (u64::from(generation) << 32), number);
        let from = &kept[draws.among(&weights)].at;
        let at: Vec<f64> = from.iter().zip(&steps).map(|(x, step)| x + step * draws.normal()).collect();
        let inside = at.iter().zip(&asked.priors).all(|(x, [low, high])| (low..=high).contains(&x));
        let summaries = inside.then(|| simulate(&at, seed_of(asked.seed, generation, number))).flatten()?;
        let distance = measured(&summaries);
        let density: f64 = kept.iter().zip(&weights).map(|(p, weight)| weight * kernel(&at, &p.at, &steps)).sum();
        (distance.is_finite() && density > 0.0).then(|| Particle { at, summaries, weight: 1.0 / density, distance })
    };
    let all: Vec<Option<Particle>> = (0..asked.particles as u64).into_par_iter().map(drawn).collect();
    all.into_iter().flatten().collect()
}

fn variance(particles: &[Particle], weights: &[f64], k: usize) -> f64 {
    let mean: f64 = particles.iter().zip(weights).map(|(p, weight)| weight * p.at[k]).sum();
    particles.iter().zip(weights).map(|(p, weight)| weight * (p.at[k] - mean) * (p.at[k] - mean)).sum()
}

/// The normal density of a step.
fn kernel(at: &[f64], from: &[f64], steps: &[f64]) -> f64 {
    let one = |((x, f), s): ((&f64, &f64), &f64)| {
        let z = (x - f) / s;
        math::exp(-0.5 * z * z) / (s * (2.0 * std::f64::consts::PI).sqrt())
    };
    at.iter().zip(from).zip(steps).map(one).product()
}

/// Each parameter, as ln of its odds within the prior, is moved along its regression on the summaries to those
/// observed; Epanechnikov's weights by distance.
fn adjusted(kept: Vec<Particle>, observed: &[f64], scales: &[f64], priors: &[[f64; 2]]) -> Vec<Particle> {
    let widest = kept.iter().map(|p| p.distance).fold(0.0, f64::max) * 1.000_001;
    let near = |p: &Particle| if widest > 0.0 { 1.0 - (p.distance / widest) * (p.distance / widest) } else { 1.0 };
    let rows: Vec<(f64, Vec<f64>)> = kept
        .iter()
        .map(|p| {
            let off = p.summaries.iter().zip(observed).zip(scales).map(|((s, o), scale)| (s - o) / scale);
            (p.weight * near(p), std::iter::once(1.0).chain(off).collect())
        })
        .collect();
    let n = observed.len() + 1;
    let normal = (0..n).map(|i| (0..n).map(|j| rows.iter().map(|(w, x)| w * x[i] * x[j]).sum()).collect()).collect();
    let inverted = inverse(&normal);
    let mut particles = kept;
    for (k, [low, high]) in priors.iter().enumerate() {
        let odds = |x: f64| {
            let share = ((x - low) / (high - low)).clamp(1e-9, 1.0 - 1e-9);
            math::log(share) - math::log1p(-share)
        };
        let Some(inverted) = &inverted else { break };
        let right: Vec<f64> =
            (0..n).map(|i| rows.iter().zip(&particles).map(|((w, x), p)| w * x[i] * odds(p.at[k])).sum()).collect();
        let slopes: Vec<f64> = inverted.iter().map(|row| row.iter().zip(&right).map(|(a, b)| a * b).sum()).collect();
        for (particle, (_, x)) in particles.iter_mut().zip(&rows) {
            let along: f64 = slopes[1..].iter().zip(&x[1..]).map(|(slope, x)| slope * x).sum();
            let share = 1.0 / (1.0 + math::exp(along - odds(particle.at[k])));
            particle.at[k] = low + (high - low) * share;
        }
    }
    particles.iter_mut().zip(&rows).for_each(|(particle, (weight, _))| particle.weight = *weight);
    let sum: f64 = particles.iter().map(|p| p.weight).sum();
    particles.iter_mut().for_each(|p| p.weight /= sum);
    particles
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The share of successes among so many trials.
    fn successes(trials: u32) -> impl Fn(&[f64], u64) -> Option<Vec<f64>> + Sync {
        move |at, seed| Some(vec![f64::from(Draws::new(seed, 1).binomial(trials, at[0])) / f64::from(trials)])
    }

    fn asked(particles: usize, generations: u32) -> Asked {
        Asked { priors: vec![[0.0, 1.0]], particles, generations, seed: 1988 }
    }

    /// 552 of 600 with a flat prior: Beta(553, 49), mean .9186, sd .01114, within 4 errors of as many draws as the
    /// particles are worth.
    #[test]
    fn the_posterior_of_a_share() {
        let posterior = abc(&successes(600), &[552.0 / 600.0], &asked(2000, 12)).unwrap();
        let ((mean, sd), n) = (posterior.moments(0), posterior.effective());
        println!("{mean} {sd} {n} {} {}", posterior.generations, posterior.within);
        assert!(n > 300.0, "{n}");
        assert!((mean - 0.9186).abs() < 4.0 * 0.01114 / n.sqrt(), "{mean} of {n}");
        assert!((sd / 0.01114 - 1.0).abs() < 4.0 / (2.0 * n).sqrt(), "{sd} of {n}");
    }

    #[test]
    fn the_number_of_threads_changes_nothing() {
        let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let run = || abc(&successes(60), &[0.4], &asked(60, 5)).unwrap();
        assert_eq!(pool(1).install(run), pool(4).install(run));
        assert!(abc(&|_: &[f64], _| None, &[0.4], &asked(60, 5)).unwrap_err().to_string().contains("can be simulated"));
        assert!(abc(&successes(6), &[0.4], &Asked { priors: vec![[1.0, 0.0]], ..asked(60, 5) }).is_err());
    }
}
