//! Real random variables compiled to tables: for each point the parameters of one distribution.
//!
//! One uniform 32-bit word gives one draw by the inverse of the distribution function: the word stands for the middle
//! of its interval, (word + ½) · 2⁻³². Draws are clamped to `min`, `max` and the caller's range, and means are those
//! of the clamped variable.

use phytomer_sim::math;
use phytomer_sim::random::share;

use super::clamped::{Clamped, clamp, of_logarithm};
use super::domain::{At, Domain};
use super::form::Law;
use super::formula::{self, Formula};
use super::grid::Grid;
use super::quantile::Deviates;
use super::range::ValueRange;
use super::variate::{Lognormal, Normal, Uniform, Variate, VariateForm};
use super::varies::Varies;
use crate::fault::{Fault, Path};

#[derive(Clone, Debug, PartialEq)]
enum Kind {
    Value,
    Normal,
    Uniform,
    /// The parameters are the mean and the standard deviation of the logarithm.
    Lognormal,
    Empirical(Vec<f64>),
}

/// The parameters of a random variable at a point.
#[derive(Clone, Copy, Debug)]
pub struct Parameters([f64; 2]);

impl PartialEq for Parameters {
    /// Whether both are the same to the bit, so that draws are.
    #[inline]
    fn eq(&self, other: &Self) -> bool {
        self.0.map(f64::to_bits) == other.0.map(f64::to_bits)
    }
}

/// A random variable at a point, looked up once for draws that are made between those of others.
#[derive(Clone, Copy)]
pub struct VariateAt<'a> {
    parameters: Parameters,
    low: f64,
    high: f64,
    is_normal: bool,
    deviates: Deviates,
    table: &'a VariateTable,
}

/// A real random variable, compiled.
#[derive(Clone, Debug, PartialEq)]
pub struct VariateTable {
    grid: Grid,
    kind: Kind,
    /// Two parameters a point: the value and 0; mean and sd; min and max.
    cells: Vec<[f64; 2]>,
    low: f64,
    high: f64,
    /// Whether a longer run can have other parameters.
    goes_on: bool,
}

impl Variate {
    /// Compiles a random variable over a domain, or fails with every fault found. Values, means and bounds must be
    /// within `range`; draws are clamped to it.
    pub fn compile(&self, domain: &Domain, path: &Path, range: ValueRange) -> Result<VariateTable, Vec<Fault>> {
        match self {
            Self::Number(number) if range.holds(*number) => Ok(VariateTable::single(*number)),
            Self::Number(number) => {
                Err(vec![Fault::new(path, format!("the value is {}", range.show(*number)), range.expected())])
            }
            Self::Form(form) => form.compile(domain, path, range),
        }
    }
}

/// A parameter: its law, its key (none where the law stands under the kind itself) and its range.
type Parameter<'a> = (&'a Law, Option<&'static str>, ValueRange);

impl VariateForm {
    /// The distribution that is given, its key and its parameters.
    fn kind(&self, range: ValueRange) -> (Kind, &'static str, Vec<Parameter<'_>>) {
        let sd_range = ValueRange { min: 0.0, max: f64::INFINITY, what: "a standard deviation" };
        let spread = |mean, sd, mean_range| vec![(mean, Some("mean"), mean_range), (sd, Some("sd"), sd_range)];
        if let Some(law) = &self.value {
            (Kind::Value, "value", vec![(law, None, range)])
        } else if let Some(Normal { mean, sd }) = &self.normal {
            (Kind::Normal, "normal", spread(mean, sd, range))
        } else if let Some(Uniform { min, max }) = &self.uniform {
            (Kind::Uniform, "uniform", vec![(min, Some("min"), range), (max, Some("max"), range)])
        } else if let Some(Lognormal { mean, sd }) = &self.lognormal {
            let positive = ValueRange { min: range.min.max(f64::MIN_POSITIVE), ..range };
            (Kind::Lognormal, "lognormal", spread(mean, sd, positive))
        } else {
            (Kind::Empirical(self.empirical.clone().unwrap_or_default()), "empirical", Vec::new())
        }
    }

    fn compile(&self, domain: &Domain, path: &Path, range: ValueRange) -> Result<VariateTable, Vec<Fault>> {
        self.check_kind(path).map_err(|fault| vec![fault])?;
        let mut faults = self.bound_faults(path, &range);
        let (kind, key, parameters) = self.kind(range);
        let path = path.key(key);
        if let Kind::Empirical(values) = &kind {
            faults.extend(value_faults(values, &path, &range));
        }
        let mut formulas = Vec::new();
        for (law, key, range) in parameters {
            match Formula::checked(law, domain, &key.map_or(path.clone(), |key| path.key(key)), &range, false) {
                Ok(formula) => formulas.push(formula),
                Err(more) => faults.extend(more),
            }
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        let grid = formula::grid(&formulas.iter().collect::<Vec<_>>(), domain, &path)?;
        // Draws stay within what a 32-bit float holds.
        let low = self.min.unwrap_or(range.min).max(f64::from(f32::MIN));
        let high = self.max.unwrap_or(range.max).min(f64::from(f32::MAX));
        let goes_on = formulas.iter().any(Formula::goes_on);
        VariateTable { grid, kind, cells: Vec::new(), low, high, goes_on }
            .fill(&formulas, &path)
            .map_err(|fault| vec![fault])
    }

    /// Faults of `min` and `max`.
    fn bound_faults(&self, path: &Path, range: &ValueRange) -> Vec<Fault> {
        let mut faults = Vec::new();
        for (key, bound) in [("min", self.min), ("max", self.max)] {
            if let Some(bound) = bound.filter(|bound| !range.holds(*bound)) {
                let problem = format!("{key} is {}", range.show(bound));
                faults.push(Fault::new(&path.key(key), problem, range.expected()));
            }
        }
        if let (Some(min), Some(max)) = (self.min, self.max)
            && min > max
        {
            faults.push(Fault::new(&path.key("min"), format!("min {min} is above max {max}"), "min ≤ max"));
        }
        faults
    }
}

fn value_faults(values: &[f64], path: &Path, range: &ValueRange) -> Vec<Fault> {
    if values.is_empty() {
        return vec![Fault::new(path, "no values are given", "at least one value")];
    }
    let outside = values.iter().enumerate().filter(|(_, value)| !range.holds(**value)).take(8);
    outside
        .map(|(i, v)| Fault::new(&path.index(i), format!("the value is {}", range.show(*v)), range.expected()))
        .collect()
}

impl VariateTable {
    fn single(number: f64) -> Self {
        let cells = vec![[number, 0.0]];
        Self { grid: Grid::single(), kind: Kind::Value, cells, low: number, high: number, goes_on: false }
    }

    fn fill(mut self, formulas: &[Formula], path: &Path) -> Result<Self, Fault> {
        let mut stack = Vec::new();
        self.cells.reserve_exact(self.grid.len());
        for at in (0..self.grid.len()).map(|cell| self.grid.point(cell)) {
            let mut cell = [0.0; 2];
            for (parameter, formula) in cell.iter_mut().zip(formulas) {
                *parameter = formula.value(at, &mut stack);
            }
            if self.kind == Kind::Uniform && cell[0] > cell[1] {
                let problem = format!("min {} is above max {}", cell[0], cell[1]);
                return Err(Fault::new(path, problem, "min ≤ max at every point"));
            }
            if self.kind == Kind::Lognormal {
                cell = of_logarithm(cell);
                if !cell[0].is_finite() || !cell[1].is_finite() {
                    return Err(Fault::new(path, "sd is too large beside the mean", "a smaller sd / mean"));
                }
            }
            self.cells.push(cell);
        }
        if self.cells.iter().all(|cell| *cell == self.cells[0]) {
            self.grid = Grid::single();
            self.cells.truncate(1);
        }
        Ok(self)
    }

    /// The same value at every point and in every draw.
    pub fn always(value: f64) -> Self {
        Self::single(value)
    }

    /// Whether a parameter depends on a variable that moves only when the bud makes a growth unit.
    pub fn asks_the_bud(&self) -> bool {
        self.grid.asks_the_bud()
    }

    /// Whether a parameter depends on the height of the plant.
    pub fn asks_height(&self) -> bool {
        self.grid.asks_height()
    }

    /// Whether some parameter depends on the light of the bud.
    pub fn asks_light(&self) -> bool {
        self.grid.asks_light()
    }

    /// Whether two draws at the same point can differ, in a run of some length.
    pub fn is_random(&self) -> bool {
        let spread = |&[a, b]: &[f64; 2]| match &self.kind {
            Kind::Value => false,
            Kind::Uniform => a != b,
            Kind::Normal | Kind::Lognormal => b != 0.0,
            Kind::Empirical(values) => values.iter().any(|value| *value != values[0]),
        };
        let may_spread = self.goes_on && self.kind != Kind::Value;
        self.low != self.high && (may_spread || self.cells.iter().any(spread))
    }

    /// A draw at a point with one uniform 32-bit word; rises with the word, except for observed values.
    #[inline]
    pub fn draw(&self, word: u32, at: At) -> f32 {
        self.draw_f64(word, at) as f32
    }

    /// The draw of [`Self::draw`] before it is rounded to single precision.
    #[inline]
    pub fn draw_f64(&self, word: u32, at: At) -> f64 {
        self.draw_in(self.grid.cell(at), word)
    }

    #[inline]
    fn draw_in(&self, cell: usize, word: u32) -> f64 {
        let mut drawn = 0.0;
        self.draw_each(Parameters(self.cells[cell]), std::iter::once((word, &mut drawn)), |value| value);
        drawn
    }

    /// The parameters at a point.
    #[inline]
    pub fn parameters(&self, at: &At) -> Parameters {
        Parameters(self.cells[self.grid.cell_at(at)])
    }

    /// Many draws with the same parameters, each with its own word into its own place and finished by `finish`. Each is
    /// the draw of [`Self::draw`].
    #[inline]
    pub fn draw_many<'a>(
        &self,
        parameters: Parameters,
        draws: impl Iterator<Item = (u32, &'a mut f32)>,
        finish: impl Fn(f32) -> f32,
    ) {
        self.draw_each(parameters, draws, |value| finish(value as f32));
    }

    /// The distribution at a point, for draws that are made between those of others.
    #[inline]
    pub fn at_point(&self, at: &At) -> VariateAt<'_> {
        let parameters = self.parameters(at);
        let is_normal = self.kind == Kind::Normal;
        VariateAt { table: self, parameters, low: self.low, high: self.high, is_normal, deviates: Deviates::new() }
    }

    /// How often the parameters can change along the nodes of an axis.
    pub fn varies(&self) -> Varies {
        self.grid.varies()
    }

    /// Draws with the same parameters; the kind of the distribution is looked at once for all of them.
    #[inline(always)]
    fn draw_each<'a, T: 'a>(
        &self,
        Parameters([a, b]): Parameters,
        draws: impl Iterator<Item = (u32, &'a mut T)>,
        finish: impl Fn(f64) -> T,
    ) {
        let finish = |value: f64| finish(clamp(value, self.low, self.high));
        match &self.kind {
            Kind::Value => draws.for_each(|(_, into)| *into = finish(a)),
            Kind::Uniform => draws.for_each(|(word, into)| *into = finish(a + (b - a) * share(word))),
            Kind::Normal => {
                let deviates = Deviates::new();
                draws.for_each(|(word, into)| *into = finish(a + b * deviates.of(word)));
            }
            Kind::Lognormal => {
                let deviates = Deviates::new();
                draws.for_each(|(word, into)| *into = finish(math::exp(a + b * deviates.of(word))));
            }
            Kind::Empirical(values) => {
                draws.for_each(|(word, into)| *into = finish(values[pick(word, values.len())]));
            }
        }
    }

    /// The value, where it is the same at every point and in every draw, in a run of any length.
    pub fn constant(&self) -> Option<f32> {
        self.exact().map(|value| value as f32)
    }

    /// The value of [`Self::constant`] before it is rounded to single precision.
    pub fn exact(&self) -> Option<f64> {
        let certain = match (&self.kind, self.cells.as_slice()) {
            _ if self.low == self.high => true,
            _ if self.goes_on => false,
            (Kind::Value, [_]) => true,
            (Kind::Uniform, [[a, b]]) => a == b,
            (Kind::Normal | Kind::Lognormal, [[_, sd]]) => *sd == 0.0,
            (Kind::Empirical(values), _) => values.iter().all(|value| *value == values[0]),
            _ => false,
        };
        certain.then(|| self.draw_f64(0, At::default()))
    }

    /// The least and the largest value that can be drawn at any point.
    pub fn extent(&self) -> [f64; 2] {
        let mut extent = [f64::INFINITY, f64::NEG_INFINITY];
        let mut widen = |value: f64| extent = [extent[0].min(value), extent[1].max(value)];
        match &self.kind {
            Kind::Empirical(values) => values.iter().for_each(|value| widen(clamp(*value, self.low, self.high))),
            _ => (0..self.cells.len()).for_each(|cell| {
                widen(self.draw_in(cell, 0));
                widen(self.draw_in(cell, u32::MAX));
            }),
        }
        extent
    }

    /// Whether one of the values that can be drawn at any point is `value`, to the bit.
    pub fn can_be(&self, value: f64) -> bool {
        match &self.kind {
            Kind::Empirical(values) => values.iter().any(|one| clamp(*one, self.low, self.high) == value),
            _ => (0..self.cells.len()).any(|cell| self.meets(cell, value)),
        }
    }

    /// Whether some word draws `value` in a cell. Draws rise with the word, so a binary search finds the first draw not
    /// below `value`.
    fn meets(&self, cell: usize, value: f64) -> bool {
        let (mut low, mut high) = (0, u32::MAX);
        while low < high {
            let middle = low + (high - low) / 2;
            match self.draw_in(cell, middle) < value {
                true => low = middle + 1,
                false => high = middle,
            }
        }
        self.draw_in(cell, low) == value
    }

    /// The mean of the clamped variable at a point.
    pub fn mean(&self, at: At) -> f64 {
        let [a, b] = self.cells[self.grid.cell(at)];
        match &self.kind {
            Kind::Value => clamp(a, self.low, self.high),
            Kind::Uniform => self.clamped().uniform(a, b),
            Kind::Normal | Kind::Lognormal if b == 0.0 => f64::from(self.draw(0, at)),
            Kind::Normal => self.clamped().normal(a, b),
            Kind::Lognormal => self.clamped().lognormal(a, b),
            Kind::Empirical(values) => {
                values.iter().map(|value| clamp(*value, self.low, self.high)).sum::<f64>() / values.len() as f64
            }
        }
    }

    fn clamped(&self) -> Clamped {
        Clamped { low: self.low, high: self.high }
    }
}

impl VariateAt<'_> {
    /// The draw of [`VariateTable::draw`] at the point.
    #[inline(always)]
    pub fn draw(&self, word: u32) -> f32 {
        if !self.is_normal {
            return self.draw_other(word);
        }
        let Parameters([mean, sd]) = self.parameters;
        clamp(mean + sd * self.deviates.of(word), self.low, self.high) as f32
    }

    /// A draw of another distribution than the normal one, which most laws of lengths and angles state.
    #[inline(never)]
    fn draw_other(&self, word: u32) -> f32 {
        let mut drawn = 0.0;
        self.table.draw_each(self.parameters, std::iter::once((word, &mut drawn)), |value| value as f32);
        drawn
    }
}

/// The place that a word picks among `len` equally likely ones.
#[inline]
fn pick(word: u32, len: usize) -> usize {
    ((u128::from(word) * len as u128) >> 32) as usize
}
