//! The development trends of an order (de Reffye 1988 §4, Fig. 15), from names and degrees to directions and shares.
//!
//! The smoothed shape of Fig. 15 becomes a share of the angle to the trend that each internode turns. Constant trends
//! are the habit's and shared by all axes; where an order draws an inclination or a share, each of its axes has trends
//! of its own, one a phase. Absent: the turning itself, which is the pose's.

use super::compiler::Compiler;
use super::words::{Layout, Measure, Number};
use crate::buds::params::{Orientation, StateTrends, Tended, Trend};
use crate::law::{At, Count, CountTable, ValueRange, Variate, VariateTable};
use phytomer_sim::plant::Trend as Tendency;
use std::collections::BTreeMap;
use std::ops::Range;

/// The share of the angle to its trend that an internode of a plainly named trend turns. The paper draws the smoothed
/// shape (Fig. 15) and gives no number; a tenth turns an axis through nine tenths of its angle in 22 internodes.
const NAMED_SHARE: f64 = 0.1;

const INCLINATION: ValueRange = ValueRange { min: 0.0, max: 180.0, what: "an angle in degrees" };
/// The most phases of a composite trend.
const MOST_PHASES: usize = 64;

/// The trends of an axis by the rank of the node.
#[derive(Debug, Clone)]
pub struct Trends {
    /// The first rank of each phase, and the place of its trend among the habit's or the axis's own; empty where ranks
    /// are drawn.
    phases: Vec<(u32, u8)>,
    /// The law of the first rank of each phase, and the place of its trend; empty where ranks are constant.
    drawn: Vec<(Number, u8)>,
    /// Inclination and share of each phase, where axes draw trends of their own.
    own: Vec<(Measure, Measure)>,
    /// Whether the phases are the states, in their order, instead of ranks.
    by_state: bool,
}

/// A phase with its compiled laws.
struct Phase {
    from_rank: CountTable,
    /// Whether the law of its first rank is without fault.
    is_ranked: bool,
    inclination: VariateTable,
    share: VariateTable,
}

impl Trends {
    /// Compiles the trends of an order. Constant trends are added to the habit's.
    pub fn compile(trend: &Trend, compiler: &mut Compiler, words: &mut Layout, habit: &mut Vec<Tendency>) -> Self {
        let phases = phases(trend, compiler);
        let constant: Option<Vec<Tendency>> = phases.iter().map(Phase::constant).collect();
        let mut measure = |table: &VariateTable| words.measure(table.clone(), 1.0, 1);
        let own: Vec<_> = match &constant {
            Some(_) => Vec::new(),
            None => phases.iter().map(|phase| (measure(&phase.inclination), measure(&phase.share))).collect(),
        };
        let places: Vec<u8> = match constant {
            Some(trends) => places(trends, habit, compiler),
            None => (0..phases.len()).map(|place| place as u8).collect(),
        };
        let by_state = matches!(trend, Trend::ByState(_));
        let ranks: Option<Vec<u32>> = phases.iter().map(|phase| phase.from_rank.constant()).collect();
        match ranks {
            Some(ranks) => Self { phases: ranks.into_iter().zip(places).collect(), drawn: Vec::new(), own, by_state },
            None => {
                let numbers = phases.into_iter().map(|phase| words.number(phase.from_rank, 1));
                Self { phases: Vec::new(), drawn: numbers.zip(places).collect(), own, by_state }
            }
        }
    }

    /// Whether an axis draws the ranks from which its phases hold.
    pub fn has_drawn_ranks(&self) -> bool {
        !self.drawn.is_empty()
    }

    /// Whether axes draw trends of their own.
    pub fn has_own(&self) -> bool {
        !self.own.is_empty()
    }

    /// Adds to `phases` the ranks from which the phases of an axis hold, with the places of their trends, where the
    /// axis draws them.
    pub fn draw_ranks(&self, words: &[u32], at: At, phases: &mut Vec<(u32, u8)>) {
        phases.clear();
        phases.extend(self.drawn.iter().map(|(rank, place)| (rank.draw(words, 0, at), *place)));
    }

    /// The trends that an axis draws, one a phase.
    pub fn draw_own(&self, words: &[u32], at: At) -> impl Iterator<Item = Tendency> {
        let draw = move |measure: &Measure| f64::from(measure.draw(words, 0, at));
        self.own.iter().map(move |(inclination, share)| tendency(draw(inclination), draw(share)))
    }

    /// The trend of every node of every axis, where there is but one.
    #[inline]
    pub fn only(&self) -> Option<u8> {
        match self.phases.as_slice() {
            [only] if !self.by_state => Some(only.1),
            _ => None,
        }
    }

    /// Whether the trend of a node depends on its state alone.
    #[inline]
    pub fn are_by_state(&self) -> bool {
        self.by_state
    }

    /// Tells the trends of nodes at neighbouring ranks along an axis, in their order, each with the number of nodes
    /// that have it; those of [`Self::at`].
    #[inline]
    pub fn along(&self, ranks: Range<u32>, drawn: &[(u32, u8)], mut told: impl FnMut(u8, u32)) {
        let phases = if self.phases.is_empty() { drawn } else { &self.phases };
        let mut rank = ranks.start;
        while rank < ranks.end {
            // It changes where a phase begins.
            let next = phases.iter().map(|phase| phase.0).filter(|begin| *begin > rank).min();
            let end = next.unwrap_or(u32::MAX).min(ranks.end);
            told(self.at(rank, 0, drawn), end - rank);
            rank = end;
        }
    }

    /// The trend of the node at `rank` along the axis, which is in `state`; `drawn` are the ranks that the axis has
    /// drawn, if any.
    #[inline]
    pub fn at(&self, rank: u32, state: u8, drawn: &[(u32, u8)]) -> u8 {
        if self.by_state {
            return self.phases.get(usize::from(state)).map_or(0, |phase| phase.1);
        }
        let last = |phases: &[(u32, u8)]| phases.iter().rev().find(|phase| phase.0 <= rank).map_or(0, |phase| phase.1);
        match self.phases.as_slice() {
            [only] => only.1,
            [] => last(drawn),
            phases => last(phases),
        }
    }
}

impl Phase {
    fn always(inclination_deg: f64, share: f64) -> Self {
        Self {
            from_rank: CountTable::always(1),
            is_ranked: true,
            inclination: VariateTable::always(inclination_deg),
            share: VariateTable::always(share),
        }
    }

    fn compile(from_rank: &Count, inclination: &Variate, share: &Variate, keys: &str, compiler: &mut Compiler) -> Self {
        let faults = compiler.faults.len();
        Self {
            from_rank: compiler.rank(from_rank, &format!("{keys}.from_rank")),
            is_ranked: compiler.faults.len() == faults,
            inclination: compiler.variate(inclination, &format!("{keys}.inclination_deg"), INCLINATION),
            share: compiler.share(share, &format!("{keys}.share")),
        }
    }

    /// The trend of the phase, where it is the same for every axis.
    fn constant(&self) -> Option<Tendency> {
        Some(tendency(self.inclination.exact()?, self.share.exact()?))
    }
}

fn phases(trend: &Trend, compiler: &mut Compiler) -> Vec<Phase> {
    match trend {
        Trend::Simple(Orientation::Straight) => vec![Phase::always(0.0, 0.0)],
        Trend::Simple(Orientation::Orthotropic) => vec![Phase::always(0.0, NAMED_SHARE)],
        Trend::Simple(Orientation::Plagiotropic) => vec![Phase::always(90.0, NAMED_SHARE)],
        Trend::Tended(t) => {
            vec![Phase::compile(&Count::from(1), &t.inclination_deg, &t.share, "trend", compiler)]
        }
        Trend::Composite(stated) => {
            let compiled = stated.iter().take(MOST_PHASES).enumerate().map(|(place, phase)| {
                let keys = format!("trend.{place}");
                Phase::compile(&phase.from_rank, &phase.inclination_deg, &phase.share, &keys, compiler)
            });
            let compiled: Vec<Phase> = compiled.collect();
            check_ranks(&compiled, stated.len(), compiler);
            compiled
        }
        Trend::ByState(StateTrends { by_state }) => states(by_state, compiler),
    }
}

/// The phases of a trend by state, in the order of the states.
fn states(stated: &BTreeMap<String, Tended>, compiler: &mut Compiler) -> Vec<Phase> {
    let names = compiler.state_names().to_vec();
    for name in stated.keys().filter(|name| !names.contains(name)) {
        compiler.state(name, &format!("trend.by_state.{name}"));
    }
    let missing: Vec<&str> = names.iter().filter(|name| !stated.contains_key(*name)).map(String::as_str).collect();
    if !missing.is_empty() {
        let found = format!("no trend is stated for {}", missing.join(", "));
        compiler.fault("trend.by_state", found, "a trend for each of the species's states");
    }
    let phases = stated_in_order(&names, stated).map(|(name, tended)| {
        let keys = format!("trend.by_state.{name}");
        Phase::compile(&Count::from(1), &tended.inclination_deg, &tended.share, &keys, compiler)
    });
    let mut phases: Vec<Phase> = phases.collect();
    if phases.is_empty() {
        phases.push(Phase::always(0.0, 0.0));
    }
    phases
}

fn stated_in_order<'a>(
    names: &'a [String],
    stated: &'a BTreeMap<String, Tended>,
) -> impl Iterator<Item = (&'a String, &'a Tended)> {
    names.iter().filter_map(|name| Some((name, stated.get(name)?)))
}

/// The first phase starts at rank 1, and each can begin before the next one.
fn check_ranks(phases: &[Phase], stated: usize, compiler: &mut Compiler) {
    let begins = phases.first().is_some_and(|phase| phase.from_rank.constant() == Some(1));
    let ascending = phases.windows(2).all(|pair| pair[0].from_rank.min() < pair[1].from_rank.max());
    if phases.iter().all(|phase| phase.is_ranked) && (!begins || !ascending || stated > MOST_PHASES) {
        let found = "the phases do not start at rank 1 and ascend".to_owned();
        compiler.fault("trend", found, "at most 64 phases, the first from rank 1, in ascending order");
    }
}

fn tendency(inclination_deg: f64, share: f64) -> Tendency {
    Tendency { inclination: inclination_deg.to_radians(), share }
}

/// The places of `tendencies` among the trends of the habit. New trends are added to the habit.
fn places(tendencies: Vec<Tendency>, habit: &mut Vec<Tendency>, compiler: &mut Compiler) -> Vec<u8> {
    let place = |tendency| {
        habit.iter().position(|known| *known == tendency).unwrap_or_else(|| {
            habit.push(tendency);
            habit.len() - 1
        })
    };
    let places = tendencies.into_iter().map(place).map(|place| u8::try_from(place).ok());
    places.collect::<Option<_>>().unwrap_or_else(|| {
        compiler.fault("trend", "the species has more than 256 trends".to_owned(), "at most 256 trends in all");
        Vec::new()
    })
}
