//! Counts compiled to tables: for each point a cumulative distribution as 32-bit thresholds.
//!
//! One uniform 32-bit word gives one count by inverse transform: the number of thresholds not above the word. Tails
//! below 2⁻³² are cut. Points with the same parameters share one distribution.

use std::collections::BTreeMap;

use super::MAX_WORK;
use super::count::Count;
use super::count_source::{Source, check_count, sources};
use super::domain::{At, Domain};
use super::formula::{self, Formula};
use super::grid::Grid;
use super::guides::{Guide, Guides, MOST_GUIDED, not_above};
use super::mass::{MAX_COUNT, Mass};
use super::variable::Variable;
use super::varies::Varies;
use crate::fault::{Fault, Path};

const WORDS: f64 = 4_294_967_296.0;
const MAX_THRESHOLDS: usize = 16 * 1024 * 1024;
const MAX_DISTRIBUTIONS: usize = 1024 * 1024;

/// One distribution: where its thresholds stand, its smallest count and its moments.
#[derive(Clone, Debug, PartialEq)]
struct Distribution {
    start: u32,
    len: u32,
    first: u32,
    mean: f64,
    variance: f64,
}

/// A count, compiled.
#[derive(Clone, Debug, PartialEq)]
pub struct CountTable {
    grid: Grid,
    cells: Vec<u32>,
    distributions: Vec<Distribution>,
    thresholds: Vec<u32>,
    guides: Guides,
    /// The largest count that can be drawn in a run of any length; `None` where a longer run has the same parameters.
    goes_on_to: Option<u32>,
}

/// A count at a point, looked up once for draws that are made between those of others.
#[derive(Clone, Copy, Debug)]
pub struct CountAt<'a> {
    first: u32,
    thresholds: &'a [u32],
    guide: Option<&'a Guide>,
}

impl CountAt<'_> {
    /// The count of [`CountTable::sample`] at the point.
    #[inline(always)]
    pub fn draw(&self, word: u32) -> u32 {
        match self.guide {
            Some(guide) => {
                let (low, high) = guide.ends(word);
                // Most often at most one threshold is left, and where none is the next one is above the word: no branch
                // depends on the word then.
                let above = match high - low {
                    0 | 1 => u32::from(self.thresholds.get(low).is_some_and(|&threshold| threshold <= word)),
                    _ => not_above(&self.thresholds[low..high], word),
                };
                self.first + low as u32 + above
            }
            None => self.first + not_above(self.thresholds, word),
        }
    }
}

impl Count {
    /// Compiles a count over a domain, or fails with every fault found.
    pub fn compile(&self, domain: &Domain, path: &Path) -> Result<CountTable, Vec<Fault>> {
        self.compile_and(false, domain, path)
    }

    /// As [`Count::compile`], and also finds the largest count in a run of any length. For things that each need a
    /// place in a stream of words, since the places must not depend on the length of the run.
    pub fn compile_places(&self, domain: &Domain, path: &Path) -> Result<CountTable, Vec<Fault>> {
        self.compile_and(true, domain, path)
    }

    fn compile_and(&self, look_ahead: bool, domain: &Domain, path: &Path) -> Result<CountTable, Vec<Fault>> {
        let sources = match self {
            Self::Number(number) => vec![Source::constant(*number, path)?],
            Self::Form(form) => sources(form, domain, path)?,
        };
        let formulas: Vec<&Formula> = sources.iter().flat_map(|source| &source.parameters).collect();
        let grid = formula::grid(&formulas, domain, path)?;
        let mut table = CountTable::fill(grid, &sources, path).map_err(|fault| vec![fault])?;
        if sources.iter().flat_map(|source| &source.parameters).any(Formula::goes_on) {
            let most = if look_ahead { most_in_any_run(&sources, path) } else { MAX_COUNT };
            table.goes_on_to = Some(most.max(table.max()));
        }
        Ok(table)
    }
}

impl CountTable {
    fn fill(grid: Grid, sources: &[Source], path: &Path) -> Result<Self, Fault> {
        let mut table = Self::empty(grid);
        table.cells.reserve_exact(table.grid.len());
        let mut known: BTreeMap<Vec<u64>, u32> = BTreeMap::new();
        let (mut stack, mut parameters, mut work) = (Vec::new(), Vec::new(), 0);
        for cell in 0..table.grid.len() {
            parameters.clear();
            let at = table.grid.point(cell);
            parameters.extend(sources.iter().flat_map(|s| &s.parameters).map(|law| law.value(at, &mut stack)));
            let key: Vec<u64> = parameters.iter().map(|parameter: &f64| parameter.to_bits()).collect();
            let found = match known.get(&key) {
                Some(&found) => found,
                None => {
                    work += table.add(sources, &parameters, path)?;
                    let found = (table.distributions.len() - 1) as u32;
                    known.insert(key, found);
                    found
                }
            };
            if work > MAX_WORK || table.thresholds.len() > MAX_THRESHOLDS || known.len() > MAX_DISTRIBUTIONS {
                let problem = "the count takes too many distributions to compile";
                return Err(Fault::new(path, problem, "parameters that depend on fewer variables"));
            }
            table.cells.push(found);
        }
        if table.distributions.len() == 1 {
            table.grid = Grid::single();
            table.cells.truncate(1);
        }
        if table.distributions.len() <= MOST_GUIDED {
            let thresholds = |of: &Distribution| &table.thresholds[of.start as usize..(of.start + of.len) as usize];
            table.guides = Guides::to(table.distributions.iter().map(thresholds));
        }
        Ok(table)
    }

    fn empty(grid: Grid) -> Self {
        let (cells, distributions, thresholds, guides) = (Vec::new(), Vec::new(), Vec::new(), Guides::default());
        Self { grid, cells, distributions, thresholds, guides, goes_on_to: None }
    }

    /// Adds the joint distribution of all sources with the given parameters. Returns the number of steps that this
    /// took.
    fn add(&mut self, sources: &[Source], parameters: &[f64], path: &Path) -> Result<u64, Fault> {
        let mut rest = parameters;
        let mut parts = Vec::with_capacity(sources.len());
        for source in sources {
            let (mine, others) = rest.split_at(source.parameters.len());
            rest = others;
            parts.push((source.weight, source.mass(mine)?));
        }
        let work = parts.iter().map(|(_, mass)| mass.weights.len() as u64).sum();
        let mass = if parts.len() == 1 { parts.swap_remove(0).1 } else { Mass::mixture(&parts) };
        let start = self.thresholds.len();
        let (mean, variance) = mass.moments();
        let first = self.push_thresholds(&mass, start);
        let len = self.thresholds.len() - start;
        check_count(u64::from(first) + len as u64, path)?;
        let distribution = Distribution { start: start as u32, len: len as u32, first, mean, variance };
        self.distributions.push(distribution);
        Ok(work)
    }

    /// Adds the cumulative thresholds, leaving out thresholds that every word or no word reaches. Returns the smallest
    /// count.
    fn push_thresholds(&mut self, mass: &Mass, start: usize) -> u32 {
        let (mut first, mut cumulative) = (mass.first, 0.0);
        let counts = mass.last() - u64::from(mass.first);
        for weight in mass.weights.iter().take(usize::try_from(counts).unwrap_or(usize::MAX)) {
            cumulative += weight;
            let words = (cumulative * WORDS).round();
            if words >= WORDS {
                break;
            }
            if words == 0.0 && self.thresholds.len() == start {
                first += 1;
            } else {
                self.thresholds.push(words as u32);
            }
        }
        first
    }

    /// The count with the given weights of 0, 1, 2 … at every point.
    pub(super) fn of_weights(weights: &[f64], path: &Path) -> Result<Self, Vec<Fault>> {
        let source = Source::of_weights(weights, path)?;
        Self::fill(Grid::single(), &[source], path).map_err(|fault| vec![fault])
    }

    /// The same count at every point and in every draw.
    pub fn always(count: u32) -> Self {
        let only = Distribution { start: 0, len: 0, first: count, mean: f64::from(count), variance: 0.0 };
        Self { cells: vec![0], distributions: vec![only], ..Self::empty(Grid::single()) }
    }

    #[inline]
    fn at(&self, at: At) -> (&Distribution, &[u32]) {
        let distribution = &self.distributions[self.cells[self.grid.cell(at)] as usize];
        let start = distribution.start as usize;
        (distribution, &self.thresholds[start..start + distribution.len as usize])
    }

    /// The count at a point, drawn with one uniform 32-bit word: a search among few of the thresholds.
    #[inline]
    pub fn sample(&self, word: u32, at: At) -> u32 {
        let mut count = 0;
        self.sample_many(self.distribution(&at), std::iter::once((word, &mut count)));
        count
    }

    /// As [`Self::sample`], at a point that stays where it is.
    #[inline]
    pub fn sample_at(&self, word: u32, at: &At) -> u32 {
        let number = self.cells[self.grid.cell_at(at)] as usize;
        let Distribution { start, len, first, .. } = self.distributions[number];
        let thresholds = &self.thresholds[start as usize..(start + len) as usize];
        match self.guides.of(number) {
            Some(guide) => {
                let (low, high) = guide.ends(word);
                first + low as u32 + not_above(&thresholds[low..high], word)
            }
            None => first + not_above(thresholds, word),
        }
    }

    /// The distribution at a point, for counts that are drawn between those of others.
    #[inline]
    pub fn at_point(&self, at: &At) -> CountAt<'_> {
        let number = self.distribution(at);
        let Distribution { start, len, first, .. } = self.distributions[number];
        let thresholds = &self.thresholds[start as usize..(start + len) as usize];
        CountAt { first, thresholds, guide: self.guides.of(number) }
    }

    /// The number of the distribution at a point: points with the same parameters have the same.
    #[inline]
    pub fn distribution(&self, at: &At) -> usize {
        self.cells[self.grid.cell_at(at)] as usize
    }

    /// Many counts of a distribution by its number, each with its own word into its own place. Each is that of
    /// [`Self::sample`].
    #[inline]
    pub fn sample_many<'a>(&self, number: usize, draws: impl Iterator<Item = (u32, &'a mut u32)>) {
        let Distribution { start, len, first, .. } = self.distributions[number];
        let thresholds = &self.thresholds[start as usize..(start + len) as usize];
        match self.guides.of(number) {
            Some(guide) => draws.for_each(|(word, into)| {
                let (low, high) = guide.ends(word);
                *into = first + low as u32 + not_above(&thresholds[low..high], word);
            }),
            None => draws.for_each(|(word, into)| *into = first + not_above(thresholds, word)),
        }
    }

    /// How often the distribution can change along the nodes of an axis.
    pub fn varies(&self) -> Varies {
        self.grid.varies()
    }

    /// The count, where it is the same at every point and in every draw, in a run of any length.
    pub fn constant(&self) -> Option<u32> {
        match self.distributions.as_slice() {
            [only] if only.len == 0 && self.goes_on_to.is_none() => Some(only.first),
            _ => None,
        }
    }

    /// Whether the distribution depends on the state and the variables `known` at most.
    pub fn asks_only(&self, known: &[Variable]) -> bool {
        self.grid.asks_only(known)
    }

    /// Whether the distribution does not depend on the rank.
    pub fn is_rankless(&self) -> bool {
        self.grid.is_rankless()
    }

    /// Whether the distribution depends on a variable that moves only when the bud makes a growth unit.
    pub fn asks_the_bud(&self) -> bool {
        self.grid.asks_the_bud()
    }

    /// Whether the distribution depends on the height of the plant.
    pub fn asks_height(&self) -> bool {
        self.grid.asks_height()
    }

    /// Whether some parameter depends on the light of the bud.
    pub fn asks_light(&self) -> bool {
        self.grid.asks_light()
    }

    /// The mean at a point.
    #[inline]
    pub fn mean(&self, at: At) -> f64 {
        self.at(at).0.mean
    }

    /// The variance at a point.
    #[inline]
    pub fn variance(&self, at: At) -> f64 {
        self.at(at).0.variance
    }

    /// The largest count that can be drawn at any point of the domain. Looks at every distribution.
    pub fn max(&self) -> u32 {
        self.distributions.iter().map(|distribution| distribution.first + distribution.len).max().unwrap_or(0)
    }

    /// The largest count that can be drawn in a run of any length, which is the number of places that are kept for it
    /// in a stream of words. Where a longer run has other parameters it is `MAX_COUNT`, unless
    /// [`Count::compile_places`] found a smaller number in the time that it may take.
    pub fn max_in_any_run(&self) -> u32 {
        self.goes_on_to.unwrap_or_else(|| self.max())
    }

    /// The same count with `most` as the limit of [`Self::max_in_any_run`]: larger counts are refused by the caller in
    /// every run.
    pub fn at_most(self, most: u32) -> Self {
        Self { goes_on_to: self.goes_on_to.map(|ever| ever.min(most)), ..self }
    }

    /// Whether a longer run can have other distributions.
    pub fn goes_on(&self) -> bool {
        self.goes_on_to.is_some()
    }

    /// The smallest count that can be drawn at any point of the domain. Looks at every distribution.
    pub fn min(&self) -> u32 {
        self.distributions.iter().map(|distribution| distribution.first).min().unwrap_or(0)
    }

    /// The probabilities of 0, 1, 2 … up to the largest count at a point, as they are drawn.
    pub fn pmf(&self, at: At) -> Vec<f64> {
        let (distribution, thresholds) = self.at(at);
        let mut pmf = vec![0.0; distribution.first as usize];
        let mut before = 0.0;
        for words in thresholds.iter().map(|&threshold| f64::from(threshold)).chain([WORDS]) {
            pmf.push((words - before) / WORDS);
            before = words;
        }
        pmf
    }
}

/// The largest count that sources can draw together in a run of any length. Counts of each kind grow with its
/// parameters, but fall with the p of the negative binomial; so each parameter is set to its highest or lowest value
/// accordingly. `MAX_COUNT` where a law has too many points to look at.
fn most_in_any_run(sources: &[Source], path: &Path) -> u32 {
    let ends = |source: &Source| -> Option<Vec<f64>> {
        let parameters = source.parameters.iter().enumerate();
        let end = parameters.map(|(place, law)| Some(source.end(place, law.extremes_in_any_run()?)));
        end.collect()
    };
    let parameters: Option<Vec<Vec<f64>>> = sources.iter().map(ends).collect();
    let mut top = CountTable::empty(Grid::single());
    match parameters.map(|ends| top.add(sources, &ends.concat(), path)) {
        Some(Ok(_)) => top.max(),
        _ => MAX_COUNT,
    }
}
