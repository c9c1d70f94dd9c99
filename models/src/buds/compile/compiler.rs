//! The compiler of one order: compiles laws where they stand, collects every fault and goes on.
//!
//! Laws are compiled over the domain of their order: all ages, dimensions, cycles, ranks and states that can occur. A
//! law that fails leaves a harmless table in its place, so that the faults of the others are found too. Absent: what
//! the laws are for, which `step`, `node` and `relay` know.

use super::domain;
use crate::buds::law::{
    Count, CountTable, Domain, Law, ProbabilityTable, ValueRange, ValueTable, Variate, VariateTable,
};
use crate::buds::params::{Buds, SpeedText};
use crate::fault::{Fault, Path};
use phytomer_sim::clock::Speed;

/// A length or a diameter, in the unit of its key.
const MEASURE: ValueRange = ValueRange { min: 0.0, max: 100_000.0, what: "a measure" };
/// An angle in degrees.
const ANGLE: ValueRange = ValueRange { min: -360.0, max: 360.0, what: "an angle in degrees" };

/// Compiles the laws of one order.
pub struct Compiler<'a> {
    buds: &'a Buds,
    domain: Domain,
    path: Path,
    /// The path of the array of orders.
    orders_path: Path,
    /// The clock of the order.
    pub speed: Speed,
    /// What was wrong so far.
    pub faults: Vec<Fault>,
}

impl<'a> Compiler<'a> {
    /// The compiler of the order at `index` (from 0).
    pub fn new(buds: &'a Buds, index: usize, until: u32, orders_path: &Path) -> Self {
        let text = &buds.order[index].speed;
        let parsed = parse_speed(text);
        let speed = parsed.unwrap_or(Speed::ONE);
        let mut compiler = Self {
            buds,
            domain: domain(buds, index, until, speed),
            path: orders_path.index(index),
            orders_path: orders_path.clone(),
            speed,
            faults: Vec::new(),
        };
        if parsed.is_none() || compiler.domain.max_cycle > 64 * until.max(1) {
            let expected = "a positive number or ratio of clock steps per tick such as 1, 0.5 or \"2/3\", at most 64";
            compiler.fault("speed", format!("the speed is {}", speed_in_words(text)), expected);
        }
        compiler
    }

    /// The order's number, from 1.
    pub fn order_number(&self) -> u8 {
        self.domain.order
    }

    /// How many orders the species has.
    pub fn orders(&self) -> usize {
        self.buds.order.len()
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
        let compiled = count.compile(&self.domain, &self.at(keys));
        let table = self.accept(compiled).unwrap_or_else(|| CountTable::always(0));
        if table.max() > most {
            self.fault(keys, format!("it can be {}", table.max()), &format!("at most {most}"));
            return CountTable::always(0);
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
        self.accept(compiled).unwrap_or_else(|| VariateTable::always(0.0))
    }

    fn variate(&mut self, variate: &Variate, keys: &str, range: ValueRange) -> VariateTable {
        let compiled = variate.compile(&self.domain, &self.at(keys), range);
        self.accept(compiled).unwrap_or_else(|| VariateTable::always(0.0))
    }

    /// The thickening of internodes, mm.
    pub fn thickening(&mut self, law: &Law) -> ValueTable {
        let domain = Domain { max_cycle: self.domain.until, max_rank: 0, ..self.domain.clone() };
        let compiled = law.compile_value(&domain, &self.at("internode.thickening_mm"), MEASURE);
        self.accept(compiled).unwrap_or_else(|| ValueTable::always(0.0))
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

    fn accept<T>(&mut self, compiled: Result<T, Vec<Fault>>) -> Option<T> {
        compiled.map_err(|mut faults| self.faults.append(&mut faults)).ok()
    }
}

fn speed_in_words(text: &SpeedText) -> String {
    match text {
        SpeedText::Whole(steps) => steps.to_string(),
        SpeedText::Decimal(steps) => steps.to_string(),
        SpeedText::Ratio(ratio) => format!("\"{ratio}\""),
    }
}

/// The exact ratio of a speed: a decimal number is taken as the decimal fraction that was typed.
fn parse_speed(text: &SpeedText) -> Option<Speed> {
    match text {
        SpeedText::Whole(steps) => Speed::new(*steps, 1),
        SpeedText::Decimal(steps) => decimal(*steps),
        SpeedText::Ratio(ratio) => {
            let (steps, ticks) = ratio.split_once('/').unwrap_or((ratio, "1"));
            Speed::new(steps.trim().parse().ok()?, ticks.trim().parse().ok()?)
        }
    }
}

fn decimal(steps: f64) -> Option<Speed> {
    let digits = (0..=6).find_map(|digits| {
        let scale = f64::from(10_u32.pow(digits));
        let scaled = steps * scale;
        let whole = scaled.round();
        ((scaled - whole).abs() < 1e-9 * scale).then_some((whole, 10_u32.pow(digits)))
    });
    let (whole, scale) = digits?;
    let fits = whole >= 1.0 && whole <= f64::from(Speed::LIMIT);
    if fits { Speed::new(whole as u32, scale) } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_speed_is_exact_however_it_is_typed() {
        let two_thirds = Speed::new(2, 3);
        assert_eq!(parse_speed(&SpeedText::Ratio("2/3".into())), two_thirds);
        assert_eq!(parse_speed(&SpeedText::Ratio(" 4 / 6 ".into())), two_thirds);
        assert_eq!(parse_speed(&SpeedText::Decimal(0.3)), Speed::new(3, 10));
        assert_eq!(parse_speed(&SpeedText::Decimal(1.5)), Speed::new(3, 2));
        assert_eq!(parse_speed(&SpeedText::Whole(2)), Speed::new(2, 1));
        for wrong in ["0", "1/0", "-1", "a/b", "", "1/2/3"] {
            assert_eq!(parse_speed(&SpeedText::Ratio(wrong.into())), None, "{wrong}");
        }
        assert_eq!(parse_speed(&SpeedText::Decimal(f64::NAN)), None);
        assert_eq!(parse_speed(&SpeedText::Decimal(1e300)), None);
        assert_eq!(parse_speed(&SpeedText::Decimal(1.0 / 3.0)), None);
    }
}
