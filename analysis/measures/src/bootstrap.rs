//! The bootstrap by plant: whole plants are drawn again, with all their units (Davison & Hinkley 1997, §3.8), and the
//! interval is BCa (Efron 1987, eq. 2.3), its acceleration from the jackknife by plant (Efron & Tibshirani 1993,
//! eq. 14.15).
//!
//! Which plants a repetition draws is a function of the seed and the number of the repetition, so the interval is the
//! same on any machine and number of threads. Not for extremes, nor for fewer than about ten plants: see the coverage
//! in `docs/statistics.md`. Absent: the statistic, which the caller reckons from how often each plant was drawn.

use crate::{Interval, Lack, quantile};
use phytomer_sim::key::LineageKey;
use phytomer_sim::random::{PlantRandom, Purpose};

/// The repetitions that intervals use where nothing else is asked for.
pub const REPETITIONS: u32 = 999;

/// The least number of plants.
const LEAST: u64 = 3;

/// How often each of `plants` plants is drawn in one repetition.
pub fn weights(seed: u64, repetition: u32, plants: usize, into: &mut Vec<u32>) {
    into.clear();
    into.resize(plants, 0);
    let mut stream =
        PlantRandom::new(seed, u64::from(repetition)).stream(LineageKey(plants as u64), Purpose::Resampling);
    for _ in 0..plants {
        let place = (u64::from(stream.word()) * plants as u64) >> 32;
        into[place as usize] += 1;
    }
}

/// The BCa interval at `level` of a statistic of plants. `statistic` is asked for the weights of the plants; `None`
/// where it cannot be reckoned from these, which leaves the repetition out.
///
/// # Errors
/// [`Lack::Plants`] with fewer than three plants, [`Lack::OutOfRange`] where the statistic cannot be reckoned for more
/// than a tenth of the repetitions, [`Lack::NoVariance`] where all repetitions agree.
pub fn interval(
    seed: u64,
    plants: usize,
    repetitions: u32,
    level: f64,
    mut statistic: impl FnMut(&[u32]) -> Option<f64>,
) -> Result<Interval, Lack> {
    if (plants as u64) < LEAST {
        return Err(Lack::Plants { found: plants as u64, needed: LEAST });
    }
    let mut drawn = vec![1; plants];
    let whole = statistic(&drawn).ok_or(Lack::OutOfRange)?;
    let acceleration = acceleration(plants, &mut statistic);
    let mut found = Vec::new();
    for repetition in 0..repetitions {
        weights(seed, repetition, plants, &mut drawn);
        found.extend(statistic(&drawn).filter(|value| value.is_finite()));
    }
    if found.len() * 10 < repetitions as usize * 9 || found.is_empty() {
        return Err(Lack::OutOfRange);
    }
    found.sort_by(f64::total_cmp);
    if found.first() == found.last() {
        return Err(Lack::NoVariance);
    }
    let below = found.iter().filter(|value| **value < whole).count() as f64;
    let equal = found.iter().filter(|value| **value == whole).count() as f64;
    // Half of the repetitions that are equal count as below, so that discrete statistics are not shifted.
    let share = ((below + 0.5 * equal) / found.len() as f64)
        .clamp(0.5 / f64::from(repetitions), 1.0 - 0.5 / f64::from(repetitions));
    let bias = quantile::normal(share)?;
    let end = |p: f64| -> Result<f64, Lack> {
        let z = bias + quantile::normal(p)?;
        let shifted = quantile::normal_below(bias + z / (1.0 - acceleration * z));
        Ok(quantile_of(&found, shifted))
    };
    Ok(Interval { low: end(0.5 - 0.5 * level)?, high: end(0.5 + 0.5 * level)? })
}

/// The skewness of the jackknife values over six: Σd³ / (6 (Σd²)^1.5); 0 where they do not differ.
fn acceleration(plants: usize, statistic: &mut impl FnMut(&[u32]) -> Option<f64>) -> f64 {
    let mut drawn = vec![1; plants];
    let mut left_out = Vec::with_capacity(plants);
    for plant in 0..plants {
        drawn[plant] = 0;
        left_out.extend(statistic(&drawn));
        drawn[plant] = 1;
    }
    let mean = left_out.iter().sum::<f64>() / left_out.len().max(1) as f64;
    let apart = left_out.iter().map(|value| mean - value);
    let (squares, cubes) = apart.fold((0.0, 0.0), |(squares, cubes), d| (squares + d * d, cubes + d * d * d));
    if squares > 0.0 { cubes / (6.0 * squares * squares.sqrt()) } else { 0.0 }
}

/// The quantile of sorted values, linear between them (Hyndman & Fan 1996, type 6), as the mean over repetitions asks.
fn quantile_of(sorted: &[f64], share: f64) -> f64 {
    let at = (share * (sorted.len() + 1) as f64 - 1.0).clamp(0.0, (sorted.len() - 1) as f64);
    let below = at as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (at - below as f64) * (sorted[above] - sorted[below])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Moments;

    fn mean(values: &[f64]) -> impl Fn(&[u32]) -> Option<f64> + '_ {
        |weights| {
            let sum: f64 = values.iter().zip(weights).map(|(value, weight)| value * f64::from(*weight)).sum();
            let n: u32 = weights.iter().sum();
            (n > 0).then(|| sum / f64::from(n))
        }
    }

    #[test]
    fn a_repetition_draws_as_many_plants_as_there_are_and_draws_them_again() {
        let (mut first, mut again) = (Vec::new(), Vec::new());
        weights(7, 3, 40, &mut first);
        weights(7, 3, 40, &mut again);
        assert_eq!((first.iter().sum::<u32>(), &first), (40, &again));
        weights(7, 4, 40, &mut again);
        assert_ne!(first, again);
    }

    /// For a mean of many plants the interval is the normal one, within the error of 4,000 repetitions.
    #[test]
    fn the_interval_of_a_mean_of_many_plants_is_the_normal_one() {
        let values: Vec<f64> = (0..200).map(|i| f64::from((i * 37) % 200)).collect();
        let found = interval(1, 200, 4000, 0.95, mean(&values)).unwrap();
        let exact = Moments::of(&values);
        let half = 1.96 * exact.standard_deviation().unwrap() / 200.0_f64.sqrt();
        // A quantile of 4,000 repetitions has a standard error of about .053 standard errors of the mean.
        let bound = 4.0 * 0.053 * half / 1.96;
        assert!((found.low - (exact.mean - half)).abs() < bound && (found.high - (exact.mean + half)).abs() < bound);
    }

    #[test]
    fn what_is_missing_is_said() {
        assert_eq!(interval(1, 2, 99, 0.95, |_| Some(1.0)), Err(Lack::Plants { found: 2, needed: 3 }));
        assert_eq!(interval(1, 5, 99, 0.95, |_| Some(1.0)), Err(Lack::NoVariance));
        assert_eq!(interval(1, 5, 99, 0.95, |_| None), Err(Lack::OutOfRange));
    }
}
