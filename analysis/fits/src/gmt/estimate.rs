//! What is fitted to measured branches: the rivals, the one that is taken, and its numbers with t intervals.
//!
//! Rivals are the rules of constant angles and of the five categories, each with and without a uniform deviation. Where
//! tips are moved, the interval of a term has the error of the deviation too, by the covariance of both. Degrees and
//! shares; lengths are in the unit of the data. Absent: how the rule is found (`search`), and species files.

use super::fork::{Vector, length};
use super::labels::Forks;
use super::levels::{LevelMeans, Mean, by_level};
use super::regress::student_quantile;
use super::rule::{Course, H1, R0, R1, Rule, TURN, wrapped};
use super::search::{Found, continues, lines, measured, search, slopes};
use super::skeleton::Skeleton;
use crate::choice::choose;
use crate::fit::{Estimate, Fit};
use crate::matrix::{Matrix, inverse};
use crate::problem::Problem;
use phytomer_sim::math;
use std::f64::consts::PI;

/// The types of trees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TreeModel {
    /// Two children, constant angles.
    Gmt1,
    /// Two children whose tips are moved.
    Gmt2,
    /// Three children.
    Gmt3,
    /// Two children, angles by a category.
    Gmt4,
}

/// The most growth levels of a geometric tree.
pub const MOST_LEVELS: u32 = 28;

/// What is asked of a fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wish {
    /// The level of intervals, in (0, 1).
    pub confidence: f64,
    /// The type; that of the least BIC if not given.
    pub model: Option<TreeModel>,
    /// How the angles change; as it is nearest to the data if not given.
    pub course: Option<Course>,
}

impl Default for Wish {
    fn default() -> Self {
        Self { confidence: 0.95, model: None, course: None }
    }
}

/// A fitted tree.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// Its type.
    pub model: TreeModel,
    /// How its angles change.
    pub course: Course,
    /// The rivals in order of BIC, each with its estimates.
    pub fits: Vec<Fit>,
    /// The place of the one that is taken.
    pub taken: usize,
    /// How many are within 2 of the least BIC.
    pub rivals: usize,
    /// The last growth level.
    pub levels: u32,
    /// The length and the diameter of first branches.
    pub first: [Option<Mean>; 2],
    /// The direction of the first branch, where it leans.
    pub direction: Option<Vector>,
    /// What was measured level by level.
    pub by_level: Vec<LevelMeans>,
    /// The level of the intervals.
    pub confidence: f64,
}

impl Fitted {
    /// The fit that is taken.
    pub fn taken(&self) -> &Fit {
        &self.fits[self.taken]
    }

    /// An estimate of it.
    pub fn value(&self, name: &str) -> Option<f64> {
        self.taken().estimate(name).map(|own| own.value)
    }
}

/// A rival.
#[derive(Debug, Clone, Copy)]
struct Rival {
    model: TreeModel,
    course: Course,
    moves: bool,
}

impl Rival {
    fn words(self) -> String {
        let model = match self.model {
            TreeModel::Gmt1 => "gmt1",
            TreeModel::Gmt2 => "gmt2",
            TreeModel::Gmt3 => "gmt3",
            TreeModel::Gmt4 => "gmt4",
        };
        let course = match self.course {
            Course::Constant => String::new(),
            Course::Category(category) => format!(", category {category}"),
        };
        let moved = if self.moves && self.model != TreeModel::Gmt2 { ", with a deviation" } else { "" };
        format!("{model}{course}{moved}")
    }
}

/// The types that may be meant: a deviation needs three branchings, a category three levels.
fn rivals(forks: &Forks<'_>, wish: &Wish) -> Vec<Rival> {
    let (may_move, may_change) = (forks.all.len() >= 3, forks.skeleton.levels() >= 3);
    let moving = [Some(false), may_move.then_some(true)].into_iter().flatten();
    let plain = if forks.number == 3 { TreeModel::Gmt3 } else { TreeModel::Gmt1 };
    let mut all = Vec::new();
    for moves in moving {
        let model = if moves && plain == TreeModel::Gmt1 { TreeModel::Gmt2 } else { plain };
        all.push(Rival { model, course: Course::Constant, moves });
        if plain == TreeModel::Gmt1 && may_change {
            all.extend((1..=5).map(|k| Rival { model: TreeModel::Gmt4, course: Course::Category(k), moves }));
        }
    }
    all.retain(|rival| wish.model.is_none_or(|model| model == rival.model));
    all.retain(|rival| wish.course.is_none_or(|course| course == rival.course));
    all
}

/// Fits a geometric tree to measured branches.
///
/// # Errors
/// Too few branchings, none that has a plane, or more growth levels than a geometric tree has.
pub fn fit(skeleton: &Skeleton, wish: &Wish) -> Result<Fitted, Problem> {
    let number = wish.model.map(|model| if model == TreeModel::Gmt3 { 3 } else { 2 });
    let forks = Forks::of(skeleton, number);
    let few = |needed, purpose| Problem::TooFew { what: "branchings", found: forks.all.len(), needed, purpose };
    if forks.all.is_empty() {
        return Err(few(1, "a tree of two or three children"));
    }
    if skeleton.levels() > MOST_LEVELS {
        let expected = "28 or less, which a geometric tree can have; leave out the branches of later levels";
        let found = f64::from(skeleton.levels());
        return Err(Problem::Impossible { what: "the last growth level".to_owned(), found, expected });
    }
    let mut found: Vec<(Rival, Found, Fit)> = Vec::new();
    for rival in rivals(&forks, wish) {
        let Some(own) = search(&forks, rival.course, rival.moves) else { continue };
        if let Some(told) = stated(&forks, rival, &own, wish) {
            found.push((rival, own, told));
        }
    }
    let choice = choose(found.iter().map(|(.., fit)| fit.clone()).collect());
    let choice = choice.ok_or_else(|| Problem::Degenerate {
        what: format!("{} branchings of {} growth levels", forks.all.len(), skeleton.levels()),
        consequence: "no such tree can be told from them: measure branchings of more levels, whose children differ in \
                      direction",
    })?;
    let law = &choice.taken().law;
    let (rival, own) = found
        .iter()
        .find(|(.., fit)| fit.law == *law)
        .map(|(rival, own, _)| (*rival, own))
        .ok_or(Problem::NoMaximum { law: "geometric trees", advice: "measure more branchings" })?;
    let first = |of: fn(&super::skeleton::Branch) -> Option<f64>| {
        let values = skeleton.branches.iter().take_while(|branch| branch.level == 0).filter_map(of);
        Mean::of(&values.collect::<Vec<f64>>(), wish.confidence)
    };
    Ok(Fitted {
        model: rival.model,
        course: rival.course,
        levels: skeleton.levels(),
        first: [first(|branch| Some(length(branch.vector))), first(|branch| branch.diameter)],
        direction: direction(skeleton),
        by_level: by_level(&forks, own, is_mirrored(&forks, &own.rule), wish.confidence),
        confidence: wish.confidence,
        taken: choice.taken,
        rivals: choice.rivals,
        fits: choice.fits,
    })
}

/// The mean direction of first branches, where it leans.
fn direction(skeleton: &Skeleton) -> Option<Vector> {
    let mut sum = [0.0; 3];
    for branch in skeleton.branches.iter().take_while(|branch| branch.level == 0) {
        let long = length(branch.vector);
        (0..3).filter(|_| long > 0.0).for_each(|k| sum[k] += branch.vector[k] / long);
    }
    let long = length(sum);
    let unit = sum.map(|x| x / long);
    (long > 0.0 && (unit[2] < 0.0 || math::hypot(unit[0], unit[1]) > 1e-6)).then_some(unit)
}

/// Whether left and right change places: the branchings of a binary tree are turned by about half a turn against the
/// maximal gradient plane if the child that continues the axis is called the left one.
fn is_mirrored(forks: &Forks<'_>, rule: &Rule) -> bool {
    let apart = rule.terms[H1 + 1][0].abs() - rule.terms[H1][0].abs();
    rule.terms[TURN][0].abs() > 0.5 * PI && (forks.number == 3 || apart > 1e-7)
}

/// A number with its standard error and degrees of freedom, before its unit.
#[derive(Clone, Copy)]
struct Term {
    value: f64,
    error: Option<f64>,
    free: f64,
}

/// The covariance of a deviation, and the slope of terms over it.
struct Moving {
    covariance: Matrix,
    slopes: [[[f64; 2]; super::rule::MEASURES]; 3],
}

fn moving(forks: &Forks<'_>, found: &Found) -> Option<Moving> {
    let slopes = slopes(forks, found)?;
    let sizes = found.lines.each_ref().map(|line| line.as_ref().map_or(0, |line| line.n));
    let scales: Vec<f64> = (0..sizes.len())
        .flat_map(|k| {
            let own = found.lines[k].as_ref().and_then(|line| line.variance()).unwrap_or(f64::INFINITY);
            let spread = found.rule.spread[k];
            // What is left without bias; single precision where nothing is left.
            std::iter::repeat_n(spread * spread / own.max(spread * spread), sizes[k])
        })
        .collect();
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).zip(&scales).map(|((x, y), w)| x * y * w).sum::<f64>();
    let normal: Matrix = slopes.iter().map(|a| slopes.iter().map(|b| product(a, b)).collect()).collect();
    let branches = &forks.skeleton.branches;
    let h = 1e-5 * branches.iter().map(|branch| length(branch.vector)).sum::<f64>() / branches.len() as f64;
    let along = |k: usize| {
        let at = |by: f64| {
            let mut deviation = found.rule.deviation;
            deviation[k] += by;
            lines(&measured(forks, &found.labels, &found.rule, deviation))
        };
        let (more, less) = (at(h), at(-h));
        std::array::from_fn(|measure| match (&more[measure], &less[measure]) {
            (Some(a), Some(b)) => [0, 1].map(|term| (a.terms[term] - b.terms[term]) / (2.0 * h)),
            _ => [0.0; 2],
        })
    };
    Some(Moving { covariance: inverse(&normal)?, slopes: [along(0), along(1), along(2)] })
}

fn term(found: &Found, moving: Option<&Moving>, measure: usize, place: usize) -> Option<Term> {
    let line = found.lines[measure].as_ref().filter(|line| place < line.set)?;
    let of_deviation = moving.map_or(0.0, |own| {
        let slope = [0, 1, 2].map(|k| own.slopes[k][measure][place]);
        (0..3).flat_map(|i| (0..3).map(move |j| (i, j))).map(|(i, j)| slope[i] * own.covariance[i][j] * slope[j]).sum()
    });
    let error = line.variance().map(|variance| (variance * line.inverse[place][place] + of_deviation).sqrt());
    let free = line.free() - if moving.is_some() { 0.5 } else { 0.0 };
    Some(Term { value: found.rule.terms[measure][place], error: error.filter(|_| free > 0.0), free })
}

impl Term {
    fn times(self, factor: f64) -> Self {
        Self { value: self.value * factor, error: self.error.map(|error| error * factor.abs()), ..self }
    }

    fn told(self, name: &str, confidence: f64) -> Estimate {
        let bare = Estimate { error: self.error, ..Estimate::bare(name, self.value) };
        let Some(error) = self.error else { return bare };
        let half = student_quantile(self.free, confidence) * error;
        bare.within(self.value - half, self.value + half)
    }
}

const DEGREES: f64 = 180.0 / PI;

/// A rival as a fit; `None` where its angles contradict its type.
fn stated(forks: &Forks<'_>, rival: Rival, found: &Found, wish: &Wish) -> Option<Fit> {
    let confidence = wish.confidence;
    let of_deviation = if rival.moves { Some(moving(forks, found)?) } else { None };
    let term = |measure, place| term(found, of_deviation.as_ref(), measure, place);
    let mirrored = is_mirrored(forks, &found.rule);
    let sides = if mirrored { [1, 0] } else { [0, 1] };
    let sign = if mirrored { -DEGREES } else { DEGREES };
    let mut estimates = Vec::new();
    let mut put = |name: &str, term: Option<Term>| estimates.extend(term.map(|term| term.told(name, confidence)));
    for (name, side) in [("h1", sides[0]), ("h2", sides[1])] {
        let [first, second] = [0, 1].map(|place| term(H1 + side, place).map(|term| term.times(sign)));
        match rival.course {
            Course::Constant => put(&format!("{name}_deg"), first),
            Course::Category(_) => {
                let [greatest, smallest] = falling(first?, second?, wish.model.is_some())?;
                put(&format!("{name}_max_deg"), Some(greatest));
                put(&format!("{name}_min_deg"), Some(smallest));
            }
        }
    }
    put("r0", term(R0, 0));
    put("r1", term(R1 + sides[0], 0));
    put("r2", term(R1 + sides[1], 0));
    let delta = term(TURN, 0).map(|term| {
        let value = if mirrored { wrapped(term.value + PI) } else { wrapped(term.value) };
        Term { value, ..term }.times(DEGREES)
    });
    put("divergence_deg", term(TURN, 1).map(|term| term.times(DEGREES)));
    put("delta_deg", delta);
    if let Some(own) = &of_deviation {
        let lines = found.lines.iter().flatten().filter(|line| line.set > 0);
        let free = lines.map(|line| line.free()).fold(f64::INFINITY, f64::min);
        for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
            let error = own.covariance[k][k].max(0.0).sqrt();
            let term = Term { value: found.rule.deviation[k], error: (free > 0.0).then_some(error), free };
            put(&format!("deviation_{axis}"), Some(term));
        }
    }
    let parameters = estimates.len() + found.lines.iter().flatten().count();
    let diameters = ratios_of_diameters(forks.skeleton);
    if let Some(mean) = Mean::of(&diameters, confidence) {
        let error = mean.deviation.map(|deviation| deviation / (mean.n as f64).sqrt());
        let bare = Estimate { error, ..Estimate::bare("diameter_ratio", mean.value) };
        estimates.push(mean.interval.map_or(bare.clone(), |[low, high]| bare.within(low, high)));
    }
    Some(Fit {
        law: rival.words(),
        estimates,
        covariance: Vec::new(),
        log_likelihood: Some(found.likelihood),
        parameters,
        n: found.lines[H1].as_ref().map_or(0, |line| line.n),
        tests: Vec::new(),
        notes: notes(forks, found),
    })
}

/// The greatest and the smallest angle of a side, in that order and on one side; one angle where they do not differ.
/// `None` where the angle rises with the growth level, which no category does, unless the type was asked for.
fn falling(greatest: Term, smallest: Term, asked: bool) -> Option<[Term; 2]> {
    let falls = greatest.value.abs() >= smallest.value.abs() && greatest.value * smallest.value >= 0.0;
    if falls {
        return Some([greatest, smallest]);
    }
    let error = greatest.error.unwrap_or(0.0) + smallest.error.unwrap_or(0.0);
    let mean = 0.5 * (greatest.value + smallest.value);
    let is_one = (greatest.value - smallest.value).abs() <= 2.0 * error + 1e-6;
    (is_one || asked).then_some([Term { value: mean, ..greatest }, Term { value: mean, ..smallest }])
}

fn ratios_of_diameters(skeleton: &Skeleton) -> Vec<f64> {
    let ratio = |branch: &super::skeleton::Branch| {
        let mother = branch.mother.and_then(|mother| skeleton.branches[mother].diameter)?;
        Some(branch.diameter? / mother)
    };
    skeleton.branches.iter().filter_map(ratio).collect()
}

fn notes(forks: &Forks<'_>, found: &Found) -> Vec<String> {
    let mut notes = Vec::new();
    if forks.others > 0 {
        let (others, number) = (forks.others, forks.number);
        notes.push(format!("{others} branchings have not {number} children, and are left out"));
    }
    let flat = found.labels.children.iter().filter(|children| children.is_none()).count();
    if flat > 0 {
        notes.push(format!("{flat} branchings have children of one direction, and are left out"));
    }
    let spread = found.rule.spread[TURN] * DEGREES;
    if spread > 60.0 {
        notes.push(format!("turns vary by {spread:.0} degrees about the divergence: they tell little of it"));
    }
    if !continues(found, forks) {
        notes.push(
            "the child that continues the axis has the larger angle; a geometric tree lets the other one do so"
                .to_owned(),
        );
    }
    notes
}
