//! The search for the rule of a tree: from many guesses of its divergence, level by level, to the one that leaves the
//! least.
//!
//! Terms are least squares (`regress`) once it is known which child is which; that is known once the terms are. Both
//! are found in turn, from guesses of the divergence all around and from the children with smaller angles. The
//! likelihood is normal, each measure with a variance of its own. A deviation moves all measures; it is found by
//! Gauss & Newton's steps, in which the terms follow. Absent: intervals, and what is made of a rule (`estimate`).

use super::fork::{Shape, Vector, length};
use super::labels::{Forks, Labels};
use super::regress::{Line, Row, line};
use super::rule::{ASTRAY, Course, MEASURES, Rule, TURN, wrapped};
use crate::matrix::inverse;
use phytomer_sim::math;
use std::f64::consts::PI;

/// Radians and shares below which nothing that is left tells one rule from another: single precision, and less than any
/// instrument.
const EXACT: f64 = 1e-6;
/// The first guesses are tried on so many growth levels, or on more where these have few branchings.
const FIRST_LEVELS: u32 = 4;
const FIRST_FORKS: usize = 12;
/// Guesses of the divergence, one every five degrees.
const GUESSES: u32 = 72;
/// How many of the guesses are followed to the end.
const FOLLOWED: usize = 3;

/// A rule with the lines that it is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    pub rule: Rule,
    pub labels: Labels,
    pub lines: [Option<Line>; MEASURES],
    /// ln L.
    pub likelihood: f64,
}

/// The measures of branchings with what their terms are multiplied by.
pub struct Measured {
    pub rows: [Vec<Row>; MEASURES],
    pub values: [Vec<f64>; MEASURES],
}

/// What the branchings measure under a deviation, turns near those that the rule expects.
pub fn measured(forks: &Forks<'_>, labels: &Labels, rule: &Rule, deviation: Vector) -> Measured {
    let mut told = Measured { rows: Default::default(), values: Default::default() };
    for (place, children) in labels.children.iter().enumerate() {
        let Some(children) = *children else { continue };
        let shape: Option<Shape> = forks.shape(&forks.all[place], children, deviation);
        let Some(shape) = shape else { continue };
        let stand = forks.stand(place, labels);
        for measure in 0..MEASURES {
            let Some(value) = rule.near(measure, &shape, stand) else { continue };
            told.rows[measure].push(rule.row(measure, stand));
            told.values[measure].push(value);
        }
    }
    told
}

/// The lines of all measures; those that the model has none of are lines of no terms.
pub fn lines(told: &Measured) -> [Option<Line>; MEASURES] {
    std::array::from_fn(|measure| {
        let (rows, values) = (&told.rows[measure], &told.values[measure]);
        if measure < ASTRAY || values.is_empty() {
            return line(rows, values);
        }
        let left = values.iter().map(|value| value * value).sum();
        Some(Line { terms: [0.0; 2], inverse: [[0.0; 2]; 2], set: 0, n: values.len(), left })
    })
}

fn deviation_of(line: &Line) -> f64 {
    (line.left / line.n.max(1) as f64).sqrt().max(EXACT)
}

/// The terms and the likelihood of labelled branchings.
fn settle(forks: &Forks<'_>, rule: &Rule, labels: Labels) -> Found {
    let lines = lines(&measured(forks, &labels, rule, rule.deviation));
    let mut rule = rule.clone();
    let mut likelihood = 0.0;
    for (measure, line) in lines.iter().enumerate() {
        let Some(line) = line else { continue };
        rule.terms[measure] = line.terms;
        rule.spread[measure] = deviation_of(line);
        let variance = rule.spread[measure] * rule.spread[measure];
        likelihood -= 0.5 * line.n as f64 * (math::log(2.0 * PI * variance) + 1.0);
    }
    rule.terms[TURN][1] = wrapped(rule.terms[TURN][1]);
    Found { rule, labels, lines, likelihood }
}

/// The best rule of a course for all branchings, from the guesses.
///
/// `moves` asks for a deviation. `None` where no branching has a plane.
pub fn search(forks: &Forks<'_>, course: Course, moves: bool) -> Option<Found> {
    let last = forks.skeleton.levels();
    let enough = |level: &u32| forks.below(*level) >= FIRST_FORKS;
    let first = (FIRST_LEVELS..last).find(enough).unwrap_or(last);
    let mut tried: Vec<Found> = guesses(forks, course, last)
        .into_iter()
        .map(|guess| {
            let labels = forks.labels(&guess, forks.below(first));
            let guess = if guess.spread[TURN] > 1.0 { with_turns(forks, guess, &labels) } else { guess };
            settle(forks, &guess, labels)
        })
        .collect();
    tried.sort_by(|a, b| b.likelihood.total_cmp(&a.likelihood));
    tried.truncate(2 * FOLLOWED);
    let mut begun: Vec<Found> = tried.into_iter().map(|found| repeated(forks, found, first, 6)).collect();
    begun.sort_by(|a, b| b.likelihood.total_cmp(&a.likelihood));
    begun.dedup_by(|a, b| a.labels == b.labels);
    begun.truncate(FOLLOWED);
    let mut ended: Vec<Found> = begun.into_iter().map(|found| followed(forks, found, first, moves)).collect();
    // The child with the smaller angle is to continue the axis; where only other rules are left, the best of them.
    ended.sort_by(|a, b| continues(b, forks).cmp(&continues(a, forks)).then(b.likelihood.total_cmp(&a.likelihood)));
    ended.into_iter().next().filter(|found| found.lines[0].is_some())
}

/// Whether the child that continues the axis has the smaller angle, in the middle of the levels.
pub fn continues(found: &Found, forks: &Forks<'_>) -> bool {
    let middle = |k: usize| {
        0.5 * (found.rule.terms[k][0] + found.rule.terms[k][usize::from(found.rule.course != Course::Constant)])
    };
    forks.number == 3 || middle(0).abs() <= middle(1).abs() + EXACT
}

fn guesses(forks: &Forks<'_>, course: Course, last: u32) -> Vec<Rule> {
    let mut all = vec![Rule::of_angles(course, last)];
    let halves = if forks.number == 3 { &[0.0][..] } else { &[0.0, PI] };
    for delta in halves {
        let turn = |k: u32| wrapped(2.0 * PI * f64::from(k) / f64::from(GUESSES));
        all.extend((0..GUESSES).map(|k| Rule::of_turns(course, last, *delta, turn(k))));
    }
    all
}

/// The divergence as the mean difference of turns along axes, and δ as the mean of what is left.
fn with_turns(forks: &Forks<'_>, mut rule: Rule, labels: &Labels) -> Rule {
    let turn = |place: usize| {
        let children = (*labels.children.get(place)?)?;
        Some(forks.shape(&forks.all[place], children, rule.deviation)?.turn)
    };
    let branches = &forks.skeleton.branches;
    let (mut step, mut start) = ([0.0; 2], [0.0; 2]);
    let add = |sum: &mut [f64; 2], angle: f64| {
        let (sin, cos) = math::sincos(angle);
        (sum[0], sum[1]) = (sum[0] + cos, sum[1] + sin);
    };
    let ranked = |place: usize| labels.ranks[forks.all[place].mother];
    for place in 0..labels.children.len() {
        let below = branches[forks.all[place].mother].mother.and_then(|mother| forks.of_branch[mother]);
        if let (Some(own), Some(below)) = (turn(place), below.and_then(turn))
            && ranked(place) > 1
        {
            add(&mut step, own - below);
        }
    }
    let divergence = if step == [0.0; 2] { 0.0 } else { math::atan2(step[1], step[0]) };
    for place in 0..labels.children.len() {
        if let Some(own) = turn(place) {
            add(&mut start, own - divergence * f64::from(ranked(place) - 1));
        }
    }
    let delta = if start == [0.0; 2] { 0.0 } else { math::atan2(start[1], start[0]) };
    rule.terms[TURN] = [delta, divergence];
    rule
}

/// Labels and terms in turn until they stay, at most so many times.
fn repeated(forks: &Forks<'_>, mut found: Found, level: u32, times: usize) -> Found {
    for _ in 0..times {
        let labels = forks.labels(&found.rule, forks.below(level));
        let is_same = labels == found.labels;
        found = settle(forks, &found.rule, labels);
        if is_same {
            break;
        }
    }
    found
}

/// A rule of the first levels, led on to the last.
fn followed(forks: &Forks<'_>, mut found: Found, first: u32, moves: bool) -> Found {
    let last = forks.skeleton.levels();
    for level in first..=last {
        let (times, steps) = if level == last { (8, 40) } else { (2, 3) };
        for _ in 0..times {
            let before = (found.labels.clone(), found.rule.deviation);
            found = repeated(forks, found, level, 1);
            if moves {
                found = moved(forks, found, steps);
            }
            let off = [0, 1, 2].map(|k| found.rule.deviation[k] - before.1[k]);
            if before.0 == found.labels && length(off) <= 1e-9 * length(found.rule.deviation) {
                break;
            }
        }
    }
    found
}

/// What is left of each measure under a deviation, in standard deviations.
fn rest(forks: &Forks<'_>, found: &Found, deviation: Vector) -> Vec<f64> {
    let told = measured(forks, &found.labels, &found.rule, deviation);
    let lines = lines(&told);
    let of = |measure: usize| {
        let (rows, values, spread) = (&told.rows[measure], &told.values[measure], found.rule.spread[measure]);
        let at = |row: &Row| lines[measure].as_ref().map_or(0.0, |line| line.at(*row));
        rows.iter().zip(values).map(|(row, value)| (value - at(row)) / spread).collect::<Vec<f64>>()
    };
    (0..MEASURES).flat_map(of).collect()
}

/// The slope of what is left over each part of a deviation.
pub fn slopes(forks: &Forks<'_>, found: &Found) -> Option<[Vec<f64>; 3]> {
    let branches = &forks.skeleton.branches;
    let mean = branches.iter().map(|branch| length(branch.vector)).sum::<f64>() / branches.len().max(1) as f64;
    let h = 1e-5 * mean;
    let along = |k: usize| {
        let at = |by: f64| {
            let mut deviation = found.rule.deviation;
            deviation[k] += by;
            rest(forks, found, deviation)
        };
        let (more, less) = (at(h), at(-h));
        (more.len() == less.len()).then(|| more.iter().zip(&less).map(|(a, b)| (a - b) / (2.0 * h)).collect())
    };
    Some([along(0)?, along(1)?, along(2)?])
}

fn squares(rest: &[f64]) -> f64 {
    rest.iter().map(|x| x * x).sum()
}

/// Steps of Gauss & Newton towards the deviation that leaves the least.
fn moved(forks: &Forks<'_>, mut found: Found, steps: usize) -> Found {
    for _ in 0..steps {
        let own = rest(forks, &found, found.rule.deviation);
        let Some(step) = step(forks, &found, &own) else { break };
        let at = |share: f64| [0, 1, 2].map(|k| found.rule.deviation[k] - share * step[k]);
        let shares = (0..12).map(|k| 1.0 / f64::from(1 << k));
        let better = shares.map(at).find(|deviation| {
            let left = rest(forks, &found, *deviation);
            left.len() == own.len() && squares(&left) < squares(&own)
        });
        let Some(deviation) = better else { break };
        let is_still = length(step) <= 1e-14 * length(deviation);
        found.rule.deviation = deviation;
        found = settle(forks, &found.rule, found.labels);
        if is_still {
            break;
        }
    }
    found
}

fn step(forks: &Forks<'_>, found: &Found, own: &[f64]) -> Option<Vector> {
    let slopes = slopes(forks, found).filter(|slopes| slopes[0].len() == own.len())?;
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let normal = slopes.iter().map(|a| slopes.iter().map(|b| product(a, b)).collect()).collect();
    let inverted = inverse(&normal)?;
    let down = slopes.each_ref().map(|slope| product(slope, own));
    Some([0, 1, 2].map(|k| (0..3).map(|j| inverted[k][j] * down[j]).sum()))
}
