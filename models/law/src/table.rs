//! Laws compiled to tables: probabilities as 32-bit thresholds, values as 32-bit floats.
//!
//! A draw is one look-up and one comparison with a 32-bit word. A threshold is p · 2³² rounded, so a probability is
//! kept to 1.2e-10; `u32::MAX` means certain and 0 never. Every point of the domain is checked here, before the
//! first tick. Absent on purpose: where the words come from.

use super::domain::{At, Domain};
use super::form::Law;
use super::formula::Formula;
use super::grid::Grid;
use super::range::ValueRange;
use super::variable::Variable;
use super::varies::Varies;
use crate::fault::{Fault, Path};

const WORDS: f64 = 4_294_967_296.0;
/// The threshold of a certain event.
const CERTAIN: u32 = u32::MAX;

/// A law of probability, compiled.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbabilityTable {
    grid: Grid,
    thresholds: Vec<u32>,
    constant: Option<f64>,
    /// Whether a longer run can have other probabilities.
    goes_on: bool,
}

/// The thresholds of a probability along the one variable on which it depends, if any.
#[derive(Clone, Debug)]
pub struct Along {
    /// The variable; `None` where there is but one threshold.
    pub variable: Option<Variable>,
    /// The value of the variable at the first threshold; later ones follow, and values beyond have the nearest.
    first: u32,
    thresholds: Box<[u32]>,
}

impl Along {
    /// The threshold at a value of the variable.
    #[inline(always)]
    pub fn threshold(&self, value: u32) -> Threshold {
        let place = value.saturating_sub(self.first) as usize;
        Threshold(self.thresholds[place.min(self.thresholds.len() - 1)])
    }
}

/// A law of values (lengths, diameters, angles), compiled.
#[derive(Clone, Debug, PartialEq)]
pub struct ValueTable {
    grid: Grid,
    values: Vec<f32>,
}

impl Law {
    /// Compiles a law of probability over a domain, or fails with the first fault of each state. Evaluates the law at
    /// every point of its own variables.
    pub fn compile_probability(&self, domain: &Domain, path: &Path) -> Result<ProbabilityTable, Vec<Fault>> {
        let mut constant = None;
        let mut same = true;
        let formula = Formula::new(self, domain, path)?;
        let (mut grid, mut thresholds) = formula.tabulate(path, &ValueRange::PROBABILITY, false, |p| {
            same &= *constant.get_or_insert(p) == p;
            threshold(p)
        })?;
        if same {
            grid = Grid::single();
            thresholds.truncate(1);
        }
        Ok(ProbabilityTable { grid, thresholds, constant: constant.filter(|_| same), goes_on: formula.goes_on() })
    }

    /// Compiles a law of values over a domain, each within `range`, or fails with the first fault of each state.
    /// Evaluates the law at every point of its own variables.
    pub fn compile_value(&self, domain: &Domain, path: &Path, range: ValueRange) -> Result<ValueTable, Vec<Fault>> {
        let (mut grid, mut values) =
            Formula::new(self, domain, path)?.tabulate(path, &range, false, |value| value as f32)?;
        if values.iter().all(|value| *value == values[0]) {
            grid = Grid::single();
            values.truncate(1);
        }
        Ok(ValueTable { grid, values })
    }
}

fn threshold(p: f64) -> u32 {
    // Below 1 it stays below `CERTAIN`; the cast saturates and p is in [0, 1].
    if p >= 1.0 { CERTAIN } else { ((p * WORDS).round() as u32).min(CERTAIN - 1) }
}

/// A probability in the form in which words are compared with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Threshold(u32);

impl Threshold {
    /// The threshold of a probability in [0, 1].
    #[inline]
    pub fn of(p: f64) -> Self {
        Self(threshold(p))
    }

    /// Whether the event happens, drawn with one uniform 32-bit word.
    #[inline]
    pub fn is_met(self, word: u32) -> bool {
        (word < self.0) | (self.0 == CERTAIN)
    }
}

/// Whether an event of probability `p` in [0, 1] happens, drawn with one uniform 32-bit word as a table draws it.
#[inline]
pub fn happens(p: f64, word: u32) -> bool {
    Threshold::of(p).is_met(word)
}

impl ProbabilityTable {
    /// The same probability at every point.
    pub fn certain_or_never(certain: bool) -> Self {
        let p = f64::from(u8::from(certain));
        Self { grid: Grid::single(), thresholds: vec![threshold(p)], constant: Some(p), goes_on: false }
    }

    /// Whether the event happens at a point, drawn with one uniform 32-bit word.
    #[inline]
    pub fn happens(&self, word: u32, at: At) -> bool {
        self.threshold(at).is_met(word)
    }

    /// As [`Self::happens`], at a point that stays where it is: a bud tests one law after another at one point.
    #[inline(always)]
    pub fn happens_at(&self, word: u32, at: &At) -> bool {
        Threshold(self.thresholds[self.grid.cell_at(at)]).is_met(word)
    }

    /// The threshold at a point, for many draws there.
    #[inline]
    pub fn threshold(&self, at: At) -> Threshold {
        Threshold(self.thresholds[self.grid.cell(at)])
    }

    /// The thresholds along the one variable on which the probability depends, if any; `None` where there are more.
    pub fn along(&self) -> Option<Along> {
        let (variable, first) = self.grid.only_variable()?;
        Some(Along { variable, first, thresholds: self.thresholds.as_slice().into() })
    }

    /// How often the probability can change along the nodes of an axis.
    pub fn varies(&self) -> Varies {
        self.grid.varies()
    }

    /// The probability at a point, as it is drawn (to 1.2e-10).
    #[inline]
    pub fn probability(&self, at: At) -> f64 {
        match (self.constant, self.thresholds[self.grid.cell(at)]) {
            (Some(p), _) => p,
            (None, CERTAIN) => 1.0,
            (None, threshold) => f64::from(threshold) / WORDS,
        }
    }

    /// The probability, where it is the same at every point.
    pub fn constant(&self) -> Option<f64> {
        self.constant
    }

    /// Whether the probability depends on the state and the variables `known` at most.
    pub fn asks_only(&self, known: &[Variable]) -> bool {
        self.grid.asks_only(known)
    }

    /// Whether the event happens at no point of a state.
    pub fn is_never_in(&self, state: u8) -> bool {
        let is_never = |(cell, &threshold): (usize, &u32)| threshold == 0 || !self.grid.is_in(cell, state);
        self.thresholds.iter().enumerate().all(is_never)
    }

    /// Whether the law depends on a variable that moves only when the bud makes a growth unit.
    pub fn asks_the_bud(&self) -> bool {
        self.grid.asks_the_bud()
    }

    /// Whether the law depends on the height of the plant.
    pub fn asks_height(&self) -> bool {
        self.grid.asks_height()
    }

    /// Whether the law depends on the light of the bud.
    pub fn asks_light(&self) -> bool {
        self.grid.asks_light()
    }

    /// Whether the event happens at no point of a run of any length, so that no draw is needed.
    #[inline]
    pub fn is_never(&self) -> bool {
        self.constant == Some(0.0) && !self.goes_on
    }

    /// Whether the event happens at every point of a run of any length, so that no draw is needed.
    #[inline]
    pub fn is_certain(&self) -> bool {
        self.constant == Some(1.0) && !self.goes_on
    }
}

impl ValueTable {
    /// The same value at every point.
    pub fn always(value: f32) -> Self {
        Self { grid: Grid::single(), values: vec![value] }
    }

    /// The value at a point.
    #[inline]
    pub fn value(&self, at: At) -> f32 {
        self.values[self.grid.cell(at)]
    }

    /// The value, where it is the same at every point.
    pub fn constant(&self) -> Option<f32> {
        (self.values.len() == 1).then(|| self.values[0])
    }

    /// The smallest and the largest value over the domain.
    pub fn extremes(&self) -> (f32, f32) {
        self.values
            .iter()
            .fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), &value| (low.min(value), high.max(value)))
    }
}
