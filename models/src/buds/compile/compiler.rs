//! The compiler of one order: compiles laws where they stand, collects every fault and continues after each.
//!
//! Laws are compiled over the domain of their order: all ages, dimensions, cycles, ranks and states that can occur. A
//! law that fails leaves a harmless table in its place, so that the faults of the others are found too. Absent: the
//! purposes of the laws, which are in `step`, `node` and `relay`.

use super::domain;
use super::look::form_of;
use crate::buds::params::{Buds, FormChoice, Season};
use crate::fault::{Fault, Path};
use crate::law::{
    Asked, At, Constant, Count, CountTable, Domain, Law, ProbabilityTable, Quantity, SpeedTable, ValueRange,
    ValueTable, Variate, VariateTable,
};
use phytomer_sim::clock::{LAST_TICK, NEVER, Speed, Tick};
use phytomer_sim::plant::Form;
use phytomer_sim::site::calendar::Dates;
use std::ops::RangeInclusive;

/// A length or a diameter, in the unit of its key.
const MEASURE: ValueRange = ValueRange { min: 0.0, max: 100_000.0, what: "a measure" };
/// An angle in degrees.
const ANGLE: ValueRange = ValueRange { min: -360.0, max: 360.0, what: "an angle in degrees" };
/// The longest delay or life length, in ticks.
pub const LONGEST: u32 = 65_535;
/// The last rank that can be named.
const LAST_RANK: u32 = 65_535;
/// A share, of a whole that is 1.
const SHARE: ValueRange = ValueRange { min: 0.0, max: 1.0, what: "a share" };

/// The most nodes that a growth unit can have.
#[derive(Debug, Clone, Copy)]
pub struct Ranks {
    /// In the run at hand.
    pub now: u32,
    /// In a run of any length.
    pub ever: u32,
    /// Whether the numbers of nodes depend on a variable that goes on with time.
    pub go_on: bool,
}

/// Compiles the laws of one order.
pub struct Compiler<'a> {
    buds: &'a Buds,
    domain: Domain,
    path: Path,
    /// The path of the species, and of the array of orders.
    species_path: Path,
    orders_path: Path,
    /// The clocks of the order's axes.
    pub speeds: SpeedTable,
    /// Whether some compiled law depends on a variable that moves with growth units alone, and not with the clock.
    pub asks_the_bud: bool,
    /// Whether some compiled law depends on the height of the plant.
    pub asks_height: bool,
    /// Whether some compiled law depends on the light of the bud.
    pub asks_light: bool,
    /// The faults found so far.
    pub faults: Vec<Fault>,
    /// The faults of keys that are compiled in several domains, for each domain: other orders may find the same faults.
    pub asked_again: Vec<Fault>,
}

impl<'a> Compiler<'a> {
    /// The compiler of the order at `index` (from 0), for ages up to `until` that have these dates.
    pub fn new(buds: &'a Buds, index: usize, (until, dates): (u32, Option<&Dates>), species_path: &Path) -> Self {
        let orders_path = species_path.key("order");
        let path = orders_path.index(index);
        let mut faults = Vec::new();
        let speeds = buds.order[index].speed.compile_dated(&path.key("speed"), dates).unwrap_or_else(|found| {
            faults = found;
            SpeedTable::always(Speed::ONE)
        });
        let mut domain = domain(buds, index, until, speeds.most_steps_by(until));
        domain.longest.max_cycle = speeds.most_steps_by(LAST_TICK);
        domain.dates = dates.cloned();
        Self {
            buds,
            domain,
            path,
            species_path: species_path.clone(),
            orders_path,
            speeds,
            asks_the_bud: false,
            asks_height: false,
            asks_light: false,
            faults,
            asked_again: Vec::new(),
        }
    }

    /// The order's number, from 1.
    pub fn order_number(&self) -> u8 {
        self.domain.order
    }

    /// How many orders the species has.
    pub fn orders(&self) -> usize {
        self.buds.order.len()
    }

    /// The names of the species's states.
    pub fn state_names(&self) -> &[String] {
        &self.buds.states
    }

    /// Sets the purpose of the laws that are compiled from now on.
    pub fn ask(&mut self, asked: Asked) {
        self.domain.asked = asked;
    }

    /// Sets the number of growth units of the laws compiled from now on: an axis makes at most `now` a step in the run
    /// at hand, `ever` in a run of any length, and in all at most `last`, in the same order.
    pub fn set_units(&mut self, [now, ever]: [u32; 2], last: [u32; 2]) {
        let domain = &mut self.domain;
        domain.max_unit = domain.max_cycle.saturating_mul(now).min(last[0]);
        domain.longest.max_unit = domain.longest.max_cycle.saturating_mul(ever).min(last[1]);
    }

    /// Lets the laws compiled from now on depend on ranks: up to the number of nodes that a growth unit can have.
    pub fn set_ranks(&mut self, nodes: Ranks) {
        self.domain.max_rank = nodes.now.max(1);
        self.domain.longest.max_rank = nodes.ever.max(1);
        self.domain.longest.ranks_go_on = nodes.go_on;
    }

    /// Lets the laws compiled from now on depend on no rank.
    pub fn unset_ranks(&mut self) {
        self.domain.max_rank = 0;
        self.domain.longest.max_rank = 0;
        self.domain.longest.ranks_go_on = false;
    }

    /// Adds a fault at a dotted path below the order.
    pub fn fault(&mut self, keys: &str, problem: String, expected: &str) {
        let path = self.at(keys);
        self.faults.push(Fault::new(&path, problem, expected));
    }

    /// The path of a value, by its dotted keys below the order; a number is a place in an array.
    pub fn at(&self, keys: &str) -> Path {
        keys.split('.').fold(self.path.clone(), |path, key| match key.parse() {
            Ok(index) => path.index(index),
            Err(_) => path.key(key),
        })
    }

    /// Compiles a law of probability.
    pub fn probability(&mut self, law: &Law, keys: &str) -> ProbabilityTable {
        let compiled = law.compile_probability(&self.domain, &self.at(keys));
        let table = self.accept(compiled).unwrap_or_else(|| ProbabilityTable::certain_or_never(false));
        self.asks_the_bud |= table.asks_the_bud();
        self.asks_height |= table.asks_height();
        self.asks_light |= table.asks_light();
        table
    }

    /// Compiles a number of things; more than `most` is a fault.
    pub fn count(&mut self, count: &Count, keys: &str, most: u32) -> CountTable {
        self.count_from(0, count, keys, most)
    }

    /// Compiles a number of things that each have a place in a stream of words; more than `most` is a fault.
    pub fn places(&mut self, count: &Count, keys: &str, most: u32) -> CountTable {
        let compiled = count.compile_places(&self.domain, &self.at(keys));
        self.accept_count(compiled, keys, 0..=most)
    }

    /// Compiles a rank, from 1: any other number that can be drawn is a fault.
    pub fn rank(&mut self, count: &Count, keys: &str) -> CountTable {
        self.count_from(1, count, keys, LAST_RANK)
    }

    fn count_from(&mut self, least: u32, count: &Count, keys: &str, most: u32) -> CountTable {
        let compiled = count.compile(&self.domain, &self.at(keys));
        self.accept_count(compiled, keys, least..=most)
    }

    fn accept_count(
        &mut self,
        compiled: Result<CountTable, Vec<Fault>>,
        keys: &str,
        within: RangeInclusive<u32>,
    ) -> CountTable {
        let (least, most) = (*within.start(), *within.end());
        let table = self.accept(compiled).unwrap_or_else(|| CountTable::always(least));
        self.asks_the_bud |= table.asks_the_bud();
        self.asks_height |= table.asks_height();
        self.asks_light |= table.asks_light();
        let (outside, expected) = match (table.min() < least, table.max() > most) {
            (true, _) => (table.min(), format!("at least {least}")),
            (_, true) => (table.max(), format!("at most {most}")),
            _ => return table.at_most(most),
        };
        self.fault(keys, format!("the number can be {outside}"), &expected);
        CountTable::always(least)
    }

    /// Compiles the tick of the year at which leaves fall, in a year of `year` ticks. It is stated for the species and
    /// compiled for the nodes of each order.
    pub fn fall_within(&mut self, fall: &Count, year: u32) -> CountTable {
        let path = self.species_path.key("season").key("leaf_fall");
        let compiled = fall.compile(&self.domain, &path);
        let table = self.accept_again(compiled).unwrap_or_else(|| CountTable::always(0));
        self.asks_the_bud |= table.asks_the_bud();
        self.asks_height |= table.asks_height();
        self.asks_light |= table.asks_light();
        if year > 0 && table.max() >= year {
            let found = format!("the tick {} is not in a year of {year} ticks", table.max());
            let expected = format!("a tick of the year from 0 to {}", year.saturating_sub(1));
            self.asked_again.push(Fault::new(&path, found, expected));
        }
        table
    }

    /// The first tick after each age, from 0, at which a law of the date makes leaves fall; `NEVER` where there is
    /// none in the run.
    pub fn falls_after(&mut self, when: &Law) -> Vec<Tick> {
        let path = self.species_path.key("season").key("leaf_fall_when");
        let domain = Domain { max_rank: 0, states: Vec::new(), asked: Asked::Birth, ..self.domain.clone() };
        let compiled = when.compile_value(&domain, &path, ValueRange { min: 0.0, max: 1.0, what: "0 or 1" });
        let table = self.accept_again(compiled).unwrap_or_else(|| ValueTable::always(0.0));
        let mut falls = vec![NEVER; domain.until as usize + 1];
        for age in (1..=domain.until).rev() {
            let falls_now = table.value(At { age, ..At::default() }) != 0.0;
            falls[age as usize - 1] = if falls_now { age } else { falls[age as usize] };
        }
        falls
    }

    /// Refuses a season that states none or both of its two ways of leaf fall.
    pub fn check_season(&mut self, season: &Season) {
        let problem = match (&season.leaf_fall, &season.leaf_fall_when) {
            (None, None) => "the season does not say when leaves fall",
            (Some(_), Some(_)) => "the season says twice when leaves fall",
            _ => return,
        };
        let path = self.species_path.key("season");
        self.asked_again.push(Fault::new(&path, problem, "either `leaf_fall` or `leaf_fall_when`"));
    }

    /// Compiles a length or a diameter in the unit of its key.
    pub fn measure(&mut self, variate: &Variate, keys: &str) -> VariateTable {
        self.variate(variate, keys, MEASURE)
    }

    /// Compiles an angle in degrees.
    pub fn angle(&mut self, variate: &Variate, keys: &str) -> VariateTable {
        self.variate(variate, keys, ANGLE)
    }

    /// Compiles the insertion angle, in degrees, of the axes that the axillary buds of this order make. It is stated
    /// with the next order and drawn at the bearing node.
    pub fn insertion_of_next_order(&mut self) -> VariateTable {
        let next = usize::from(self.domain.order);
        let Some(order) = self.buds.order.get(next) else {
            return VariateTable::always(0.0);
        };
        let domain = Domain { order: self.domain.order + 1, ..self.domain.clone() };
        let path = self.orders_path.index(next).key("insertion_deg");
        let compiled = order.insertion_deg.compile(&domain, &path, ANGLE);
        self.accept_variate_again(compiled)
    }

    /// Compiles the insertion angle, in degrees, of this order for relays that have none of their own: it is drawn
    /// where an axis ends.
    pub fn insertion_of_relays(&mut self, insertion_deg: &Variate) -> VariateTable {
        let compiled = insertion_deg.compile(&self.domain, &self.at("insertion_deg"), ANGLE);
        self.accept_variate_again(compiled)
    }

    fn accept_variate_again(&mut self, compiled: Result<VariateTable, Vec<Fault>>) -> VariateTable {
        let table = self.accept_again(compiled).unwrap_or_else(|| VariateTable::always(0.0));
        self.asks_the_bud |= table.asks_the_bud();
        self.asks_height |= table.asks_height();
        self.asks_light |= table.asks_light();
        table
    }

    /// Compiles a share, in [0, 1].
    pub fn share(&mut self, variate: &Variate, keys: &str) -> VariateTable {
        self.variate(variate, keys, SHARE)
    }

    /// Compiles a real number in the unit of its key, within `range`.
    pub fn variate(&mut self, variate: &Variate, keys: &str, range: ValueRange) -> VariateTable {
        let compiled = variate.compile(&self.domain, &self.at(keys), range);
        self.accept_variate(compiled)
    }

    fn accept_variate(&mut self, compiled: Result<VariateTable, Vec<Fault>>) -> VariateTable {
        let table = self.accept(compiled).unwrap_or_else(|| VariateTable::always(0.0));
        self.asks_the_bud |= table.asks_the_bud();
        self.asks_height |= table.asks_height();
        self.asks_light |= table.asks_light();
        table
    }

    /// Compiles the thickening of internodes, mm.
    pub fn thickening(&mut self, law: &Law) -> ValueTable {
        let max_cycle = self.domain.until;
        let domain = Domain { max_cycle, max_rank: 0, asked: Asked::Internode, ..self.domain.clone() };
        let compiled = law.compile_value(&domain, &self.at("internode.thickening_mm"), MEASURE);
        self.accept(compiled).unwrap_or_else(|| ValueTable::always(0.0))
    }

    /// Compiles a share by the own age of a thing: entry i is the share at age i, and later ages have the last.
    pub fn share_by_own_age(&mut self, law: &Law, keys: &str) -> Vec<f32> {
        let compiled = law.by_own_age(self.domain.order, self.domain.until, &self.at(keys), SHARE);
        self.accept(compiled).unwrap_or_else(|| vec![0.0])
    }

    /// Reads a number that is not drawn.
    pub fn constant(&mut self, number: &Constant, keys: &str, range: ValueRange) -> f64 {
        number.within(&self.at(keys), range).unwrap_or_else(|fault| {
            self.faults.push(fault);
            range.min
        })
    }

    /// Reads a whole number of a species, from 1 to `most`. `what` is its name in messages: for the value found, and
    /// for the value expected.
    pub fn quantity(&mut self, quantity: &Quantity, keys: &str, most: u32, what: (&str, &str)) -> u32 {
        let value = quantity.value();
        if (1..=most).contains(&value) {
            return value;
        }
        let keys = match quantity {
            Quantity::Number(_) => keys.to_owned(),
            Quantity::Form(_) => format!("{keys}.value"),
        };
        self.fault(&keys, format!("{} is {value}", what.0), &format!("{}, from 1 to {most}", what.1));
        1
    }

    /// The number of a named state.
    pub fn state(&mut self, name: &str, keys: &str) -> u8 {
        let place = self.buds.states.iter().position(|state| state == name);
        if place.is_none() {
            let expected = match self.buds.states.is_empty() {
                true => "no state, since the species names none".to_owned(),
                false => format!("one of {}", self.buds.states.join(", ")),
            };
            self.fault(keys, format!("the state \"{name}\" is not among the species's"), &expected);
        }
        place.and_then(|place| u8::try_from(place).ok()).unwrap_or(0)
    }

    /// The number of a form: its place in the library, or among the species' own meshes.
    pub fn form(&self, choice: &FormChoice) -> Form {
        form_of(self.buds, choice)
    }

    fn accept<T>(&mut self, compiled: Result<T, Vec<Fault>>) -> Option<T> {
        compiled.map_err(|mut faults| self.faults.append(&mut faults)).ok()
    }

    /// As [`Compiler::accept`], for a key that is compiled in several domains.
    fn accept_again<T>(&mut self, compiled: Result<T, Vec<Fault>>) -> Option<T> {
        compiled.map_err(|mut faults| self.asked_again.append(&mut faults)).ok()
    }
}
