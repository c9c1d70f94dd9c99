//! The compiler of one order: compiles laws where they stand, collects every fault and goes on.
//!
//! Laws are compiled over the domain of their order: all ages, dimensions, cycles, ranks and states that can occur. A
//! law that fails leaves a harmless table in its place, so that the faults of the others are found too. Absent: what
//! the laws are for, which `step`, `node` and `relay` know.

use super::domain;
use super::look::form_of;
use crate::buds::params::{Buds, FormChoice, Season};
use crate::fault::{Fault, Path};
use crate::law::{
    At, Constant, Count, CountTable, Domain, Law, ProbabilityTable, Quantity, SpeedTable, ValueRange, ValueTable,
    Variate, VariateTable,
};
use phytomer_sim::clock::Speed;
use phytomer_sim::plant::Form;

/// A length or a diameter, in the unit of its key.
const MEASURE: ValueRange = ValueRange { min: 0.0, max: 100_000.0, what: "a measure" };
/// An angle in degrees.
const ANGLE: ValueRange = ValueRange { min: -360.0, max: 360.0, what: "an angle in degrees" };
/// The last rank that can be named.
const LAST_RANK: u32 = 65_535;
/// A part of a whole.
const SHARE: ValueRange = ValueRange { min: 0.0, max: 1.0, what: "a share" };

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
    /// What was wrong so far.
    pub faults: Vec<Fault>,
    /// What was wrong with keys that are asked in several domains, in each of them: other orders may find the same.
    pub asked_again: Vec<Fault>,
}

impl<'a> Compiler<'a> {
    /// The compiler of the order at `index` (from 0).
    pub fn new(buds: &'a Buds, index: usize, until: u32, species_path: &Path) -> Self {
        let orders_path = species_path.key("order");
        let path = orders_path.index(index);
        let mut faults = Vec::new();
        let speeds = buds.order[index].speed.compile(&path.key("speed")).unwrap_or_else(|found| {
            faults = found;
            SpeedTable::always(Speed::ONE)
        });
        let domain = domain(buds, index, until, speeds.most_steps_by(until));
        Self {
            buds,
            domain,
            path,
            species_path: species_path.clone(),
            orders_path,
            speeds,
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

    /// From now on laws may depend on ranks up to `rank`; on none, if that is 0.
    pub fn set_max_rank(&mut self, rank: u32) {
        self.domain.max_rank = rank;
    }

    /// Notes a fault at a dotted path below the order.
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

    /// A law as a probability.
    pub fn probability(&mut self, law: &Law, keys: &str) -> ProbabilityTable {
        let compiled = law.compile_probability(&self.domain, &self.at(keys));
        self.accept(compiled).unwrap_or_else(|| ProbabilityTable::certain_or_never(false))
    }

    /// A number of things, of which more than `most` is a fault.
    pub fn count(&mut self, count: &Count, keys: &str, most: u32) -> CountTable {
        self.count_from(0, count, keys, most)
    }

    /// A rank, from 1: anything else that can be drawn is a fault.
    pub fn rank(&mut self, count: &Count, keys: &str) -> CountTable {
        self.count_from(1, count, keys, LAST_RANK)
    }

    fn count_from(&mut self, least: u32, count: &Count, keys: &str, most: u32) -> CountTable {
        let compiled = count.compile(&self.domain, &self.at(keys));
        let table = self.accept(compiled).unwrap_or_else(|| CountTable::always(least));
        let (outside, expected) = match (table.min() < least, table.max() > most) {
            (true, _) => (table.min(), format!("at least {least}")),
            (_, true) => (table.max(), format!("at most {most}")),
            _ => return table,
        };
        self.fault(keys, format!("it can be {outside}"), &expected);
        CountTable::always(least)
    }

    /// The tick of the year at which leaves fall, in a year of `year` ticks: stated for the species, asked at the nodes of
    /// this order.
    pub fn fall_within(&mut self, season: &Season, year: u32) -> CountTable {
        let path = self.species_path.key("season").key("leaf_fall");
        let compiled = season.leaf_fall.compile(&self.domain, &path);
        let table = self.accept_again(compiled).unwrap_or_else(|| CountTable::always(0));
        if year > 0 && table.max() >= year {
            let found = format!("the tick {} is not in a year of {year} ticks", table.max());
            let expected = format!("a tick of the year from 0 to {}", year.saturating_sub(1));
            self.asked_again.push(Fault::new(&path, found, expected));
        }
        table
    }

    /// A measure in the unit of its key.
    pub fn measure(&mut self, variate: &Variate, keys: &str) -> VariateTable {
        self.variate(variate, keys, MEASURE)
    }

    /// An angle in degrees.
    pub fn angle(&mut self, variate: &Variate, keys: &str) -> VariateTable {
        self.variate(variate, keys, ANGLE)
    }

    /// The insertion angle of the axes that the axillary buds of this order make, degrees: stated with the next order,
    /// asked at the bearing node.
    pub fn insertion_of_next_order(&mut self) -> VariateTable {
        let next = usize::from(self.domain.order);
        let Some(order) = self.buds.order.get(next) else {
            return VariateTable::always(0.0);
        };
        let domain = Domain { order: self.domain.order + 1, ..self.domain.clone() };
        let path = self.orders_path.index(next).key("insertion_deg");
        let compiled = order.insertion_deg.compile(&domain, &path, ANGLE);
        self.accept_again(compiled).unwrap_or_else(|| VariateTable::always(0.0))
    }

    /// The same angle, stated with this order, for relays that have none of their own: asked where an axis ends.
    pub fn insertion_of_relays(&mut self, insertion_deg: &Variate) -> VariateTable {
        let compiled = insertion_deg.compile(&self.domain, &self.at("insertion_deg"), ANGLE);
        self.accept_again(compiled).unwrap_or_else(|| VariateTable::always(0.0))
    }

    /// A share, in [0, 1].
    pub fn share(&mut self, variate: &Variate, keys: &str) -> VariateTable {
        self.variate(variate, keys, SHARE)
    }

    /// A real number in the unit of its key, within `range`.
    pub fn variate(&mut self, variate: &Variate, keys: &str, range: ValueRange) -> VariateTable {
        let compiled = variate.compile(&self.domain, &self.at(keys), range);
        self.accept(compiled).unwrap_or_else(|| VariateTable::always(0.0))
    }

    /// The thickening of internodes, mm.
    pub fn thickening(&mut self, law: &Law) -> ValueTable {
        let domain = Domain { max_cycle: self.domain.until, max_rank: 0, ..self.domain.clone() };
        let compiled = law.compile_value(&domain, &self.at("internode.thickening_mm"), MEASURE);
        self.accept(compiled).unwrap_or_else(|| ValueTable::always(0.0))
    }

    /// A share by the own age of a thing, from 0; ages past the last are as the last.
    pub fn share_by_own_age(&mut self, law: &Law, keys: &str) -> Vec<f32> {
        let until = self.domain.until;
        let domain = Domain { max_cycle: until, max_rank: 0, ..self.domain.clone() };
        let compiled = law.compile_value(&domain, &self.at(keys), SHARE);
        let table = self.accept(compiled).unwrap_or_else(|| ValueTable::always(0.0));
        let at = |own| At { age: until, dimension: own, cycle: own, rank: 0, state: 0 };
        let mut shares: Vec<f32> = (0..=until).map(|own| table.value(at(own))).collect();
        while shares.len() > 1 && shares[shares.len() - 1] == shares[shares.len() - 2] {
            shares.pop();
        }
        shares
    }

    /// A number that is not drawn.
    pub fn constant(&mut self, number: &Constant, keys: &str, range: ValueRange) -> f64 {
        number.within(&self.at(keys), range).unwrap_or_else(|fault| {
            self.faults.push(fault);
            range.min
        })
    }

    /// A whole number of a species, from 1 to `most`, which `what` names with an article.
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

    /// The number of a form.
    pub fn form(&self, choice: &FormChoice) -> Form {
        form_of(self.buds, choice)
    }

    fn accept<T>(&mut self, compiled: Result<T, Vec<Fault>>) -> Option<T> {
        compiled.map_err(|mut faults| self.faults.append(&mut faults)).ok()
    }

    /// As [`Compiler::accept`], of a key that is asked in several domains.
    fn accept_again<T>(&mut self, compiled: Result<T, Vec<Fault>>) -> Option<T> {
        compiled.map_err(|mut faults| self.asked_again.append(&mut faults)).ok()
    }
}
