//! The values of a line, as fields of an observation.

use super::super::names::Meaning;
use crate::exchange::contract::Units;
use crate::exchange::description::{Entity, Individual, Observation, Value};

/// The values of a line.
#[derive(Debug, Clone, Default)]
pub struct Row {
    /// What was observed.
    seen: Observation,
    /// Whether anything was.
    any: bool,
    place: [Option<f64>; 3],
    direction: [Option<f64>; 3],
    up: [Option<f64>; 3],
    birth: Option<u32>,
    death: Option<u32>,
    dead: Option<bool>,
    age: Option<u32>,
    /// The alias that the line gives its entity.
    pub alias: Option<Box<str>>,
}

fn number(value: &Value) -> Option<f64> {
    match value {
        Value::Int(number) => Some(*number as f64),
        Value::Real(number) => Some(*number),
        _ => None,
    }
}

/// A vector of which all is told and that has a length, as a unit vector.
fn unit(parts: [Option<f64>; 3]) -> Option<[f64; 3]> {
    let [Some(x), Some(y), Some(z)] = parts else { return None };
    let length = (x * x + y * y + z * z).sqrt();
    (length > 1e-6 && length.is_finite()).then_some([x, y, z])
}

impl Row {
    /// Takes a value. One that is not what its feature means is left out: a length that is no number has no field.
    pub fn take(&mut self, meaning: Meaning, feature: u32, value: Value, units: Units) {
        let tick =
            |value: &Value| number(value).filter(|t| t.fract() == 0.0 && (0.0..4e9).contains(t)).map(|t| t as u32);
        let metres = |unit: f64| number(&value).map(|number| number * unit);
        match meaning {
            Meaning::Length => self.seen.length = metres(units.length_m),
            Meaning::BaseDiameter => self.seen.base_diameter = metres(units.diameter_m),
            Meaning::TipDiameter => self.seen.tip_diameter = metres(units.diameter_m),
            Meaning::Area => self.seen.area = metres(units.length_m * units.length_m),
            Meaning::Place(k) => self.place[k] = metres(units.length_m),
            Meaning::Direction(k) => self.direction[k] = number(&value),
            Meaning::Up(k) => self.up[k] = number(&value),
            Meaning::Birth => self.birth = tick(&value),
            Meaning::Death => self.death = tick(&value),
            Meaning::Age => self.age = tick(&value),
            Meaning::State => self.dead = Some(matches!(&value, Value::Text(text) if &**text == "dead")),
            Meaning::Date => {
                if let Value::Date(date) = value {
                    self.seen.date = Some(date);
                }
                // A date alone observes nothing more than that the entity is there, which is something.
            }
            Meaning::Alias => {
                if let Value::Text(text) = value {
                    self.alias = Some(text);
                }
                return;
            }
            Meaning::Other => self.seen.values.push((feature, value)),
        }
        self.any = true;
    }

    fn told(mut self) -> (Observation, bool) {
        if let [Some(x), Some(y), Some(z)] = self.place {
            self.seen.place = Some([x, y, z]);
        }
        (self.seen.direction, self.seen.up) = (unit(self.direction), unit(self.up));
        (self.seen, self.any)
    }

    /// Gives an entity of a plant what its line says.
    pub fn observed(self, individual: &mut Individual, entity: u32) {
        if let Some(age) = self.age {
            individual.age = Some(age);
        }
        let of = &mut individual.entities[entity as usize];
        (of.birth, of.death, of.dead) = (self.birth, self.death, self.dead);
        let lone_age = self.seen == Observation::default();
        let is_seen = self.place.iter().chain(&self.direction).any(Option::is_some) || !lone_age;
        let (seen, any) = self.told();
        if any && is_seen {
            // One observation is the rule: no room is left for more.
            of.observations.reserve_exact(1);
            of.observations.push(seen);
        }
    }

    /// Adds another observation of an entity.
    pub fn observed_again(self, entity: &mut Entity) {
        if self.dead.is_some() {
            entity.dead = self.dead;
        }
        let (seen, any) = self.told();
        if any {
            entity.observations.push(seen);
        }
    }
}
