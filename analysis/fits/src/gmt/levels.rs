//! Means with t intervals, and those of each growth level: what Figs. 14 and 16 of Aono & Kunii 1984 show of *Aucuba*.
//!
//! Absent: the terms of a rule (`estimate`).

use super::fork::{Shape, length};
use super::labels::Forks;
use super::regress::student_quantile;
use super::rule::H1;
use super::search::Found;
use std::f64::consts::PI;

/// A mean with its interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mean {
    /// How many values it is of.
    pub n: usize,
    /// The mean.
    pub value: f64,
    /// The standard deviation of the values; `None` of one.
    pub deviation: Option<f64>,
    /// The interval of the mean; `None` of one value.
    pub interval: Option<[f64; 2]>,
}

impl Mean {
    /// The mean of values with the interval of Student's t; `None` of none.
    pub fn of(values: &[f64], confidence: f64) -> Option<Self> {
        let n = values.len();
        if n == 0 {
            return None;
        }
        let rough = values.iter().sum::<f64>() / n as f64;
        let value = rough + values.iter().map(|x| x - rough).sum::<f64>() / n as f64;
        let squares: f64 = values.iter().map(|x| (x - value) * (x - value)).sum();
        let deviation = (n > 1).then(|| (squares / (n as f64 - 1.0)).sqrt());
        let interval = deviation.map(|deviation| {
            let half = student_quantile(n as f64 - 1.0, confidence) * deviation / (n as f64).sqrt();
            [value - half, value + half]
        });
        Some(Self { n, value, deviation, interval })
    }
}

/// What was measured of a growth level.
#[derive(Debug, Clone, PartialEq)]
pub struct LevelMeans {
    /// The growth level of the branches; 0 is the first branch.
    pub level: u32,
    /// How many branches it has.
    pub branches: usize,
    /// The height of the branchings that bear them, in the unit of the data.
    pub height: Option<Mean>,
    /// Left angles, degrees.
    pub left_deg: Option<Mean>,
    /// Right angles, degrees.
    pub right_deg: Option<Mean>,
    /// The ratios of lengths to the mothers: left, right, centre.
    pub ratios: [Option<Mean>; 3],
    /// The lengths of the branches.
    pub length: Option<Mean>,
    /// The left and the right angle that were fitted, degrees.
    pub fitted_deg: Option<[f64; 2]>,
}

/// What was measured of each growth level; `mirrored` has left and right change places.
pub(super) fn by_level(forks: &Forks<'_>, found: &Found, mirrored: bool, confidence: f64) -> Vec<LevelMeans> {
    let degrees = 180.0 / PI;
    let (sides, sign) = if mirrored { ([1, 0], -degrees) } else { ([0, 1], degrees) };
    let branches = &forks.skeleton.branches;
    let of = |level: u32| {
        let (from, to) = (forks.below(level.saturating_sub(1)), forks.below(level));
        let shapes: Vec<_> = (from..to.min(found.labels.children.len()))
            .filter(|_| level > 0)
            .filter_map(|place| {
                let shape = forks.shape(&forks.all[place], found.labels.children[place]?, found.rule.deviation)?;
                let mother = &branches[forks.all[place].mother];
                Some((shape, mother.base[2] + mother.vector[2]))
            })
            .collect();
        let mean = |of: &dyn Fn(&(Shape, f64)) -> Option<f64>| {
            Mean::of(&shapes.iter().filter_map(of).collect::<Vec<f64>>(), confidence)
        };
        let own: Vec<f64> =
            branches.iter().filter(|branch| branch.level == level).map(|branch| length(branch.vector)).collect();
        let row = found.rule.course.row(level.max(1), found.rule.last);
        let fitted = sides.map(|side| {
            let [a, b] = found.rule.terms[H1 + side];
            sign * (a * row[0] + b * row[1])
        });
        LevelMeans {
            level,
            branches: own.len(),
            height: mean(&|(_, height)| Some(*height)),
            left_deg: mean(&|(shape, _)| Some(sign * shape.angles[sides[0]])),
            right_deg: mean(&|(shape, _)| Some(sign * shape.angles[sides[1]])),
            ratios: [
                mean(&|(shape, _)| Some(shape.ratios[sides[0]])),
                mean(&|(shape, _)| Some(shape.ratios[sides[1]])),
                mean(&|(shape, _)| shape.centre),
            ],
            length: Mean::of(&own, confidence),
            fitted_deg: (level > 0).then_some(fitted),
        }
    };
    (0..=forks.skeleton.levels()).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1, 2, 3, 4 and 5: mean 3, deviation √2.5, and 1.533206 of t with 4 degrees of freedom at 80 %.
    #[test]
    fn the_interval_of_a_mean() {
        let found = Mean::of(&[1.0, 2.0, 3.0, 4.0, 5.0], 0.8).expect("a mean");
        let half = 1.533_206 * (2.5_f64 / 5.0).sqrt();
        let [low, high] = found.interval.expect("an interval");
        assert!(
            (found.value - 3.0).abs() < 1e-12 && (low - 3.0 + half).abs() < 1e-6 && (high - 3.0 - half).abs() < 1e-6
        );
        assert_eq!(Mean::of(&[], 0.8), None);
        assert_eq!(Mean::of(&[2.0], 0.8).map(|mean| (mean.value, mean.interval)), Some((2.0, None)));
    }
}
