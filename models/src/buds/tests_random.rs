//! Species drawn at random, with any combination of what the laws of buds and nodes can state.
//!
//! Each is made of the text in which files state it. Some are refused when they are compiled; callers leave them out.

use super::Buds;
use phytomer_sim::plant::LineageKey;
use phytomer_sim::random::{PlantRandom, Purpose, Stream};
use serde_json::{Map, Value, json};

/// A sequence of species.
pub struct RandomSpecies {
    draws: Stream,
}

impl RandomSpecies {
    pub fn new(seed: u64) -> Self {
        Self { draws: PlantRandom::new(seed, 0).stream(LineageKey::SEED, Purpose::Rewriting) }
    }

    /// The next species and the text that states it; `None` where the text is none of a species.
    pub fn next(&mut self) -> Option<(String, Buds)> {
        let states = self.one_of([0, 0, 2, 3]);
        let orders = self.one_of([1, 2, 2, 3]);
        let mut species = Map::new();
        if states > 0 {
            species.insert("states".into(), json!((0..states).map(state).collect::<Vec<_>>()));
        }
        if self.happens(3) {
            let season = match self.happens(2) {
                true => json!({ "ticks_per_year": 6, "leaf_fall": self.count(5) }),
                false => json!({ "ticks_per_year": 4, "leaf_fall": 2 }),
            };
            species.insert("season".into(), season);
        }
        if self.happens(4) {
            let over = if self.happens(2) { "age" } else { "light" };
            let targets = ["death", "pause", "ramification", "flowering", "fruit_set", "nodes", "internode_length"];
            let acts_on: Vec<&str> = targets.into_iter().filter(|_| self.happens(2)).chain(["leaf_area"]).collect();
            let law = json!({ "expression": format!("0.3 + 0.02 * {over}") });
            species.insert("response".into(), json!([{ "acts_on": acts_on, "law": law, "reference": 1 }]));
        }
        let list: Vec<Value> = (0..orders).map(|_| self.order(states, orders)).collect();
        species.insert("order".into(), Value::from(list));
        let text = Value::from(species);
        Some((text.to_string(), serde_json::from_value(text).ok()?))
    }

    fn order(&mut self, states: u32, orders: u32) -> Value {
        let mut order = Map::new();
        let mut set = |key: &str, value: Value| {
            order.insert(key.into(), value);
        };
        set("death", self.chance(0.1));
        set("pause", self.chance(0.4));
        set("growth_unit", self.growth_unit());
        set("axillary", self.axillary(states));
        set("internode", json!({ "length_cm": self.measure(3.0), "diameter_mm": self.measure(4.0) }));
        set("insertion_deg", self.measure(50.0));
        if self.happens(2) {
            set("phyllotaxis", self.phyllotaxis());
        }
        set("leaf", self.leaf());
        if self.happens(2) {
            set("speed", json!(self.one_of(["1/2", "2", "3/2"])));
        }
        if self.happens(2) {
            set("trend", self.trend(states));
        }
        if self.happens(2) {
            set("flower", self.flower());
            set(
                "fruit",
                json!({ "life": self.count(5), "length_cm": self.measure(2.0), "width_cm": self.measure(1.0) }),
            );
        }
        if self.happens(3) {
            let (buds, delay) = (self.count(2), self.count(3));
            let (probability, order) = (self.chance(0.2), 1 + self.below(orders));
            let insertion_deg = self.measure(30.0);
            set(
                "reiteration",
                json!({ "buds": buds, "probability": probability, "order": order, "delay": delay,
                "insertion_deg": insertion_deg }),
            );
        }
        self.ends(states, &mut set);
        Value::from(order)
    }

    /// What follows the ends of apices, and passages between states.
    fn ends(&mut self, states: u32, set: &mut impl FnMut(&str, Value)) {
        if self.happens(3) {
            set("traumatic", json!({ "probability": self.chance(0.5), "delay": self.count(2) }));
        }
        if self.happens(3) {
            let fork = json!({ "axes": 1 + self.below(2), "insertion_deg": self.measure(20.0) });
            let mut apex = json!({ "units": { "poisson": { "mean": 3 }, "shift": 1 } });
            if self.happens(2) {
                apex["fork"] = fork;
            }
            set("apex", apex);
        }
        if self.happens(3) {
            let on: Vec<&str> = ["death", "flower", "completed"].into_iter().filter(|_| self.happens(2)).collect();
            set(
                "relay",
                json!({ "on": on, "count": self.count(2), "probability": self.chance(0.5),
                "below": self.count(2), "delay": self.count(2) }),
            );
        }
        if self.happens(2) {
            set("shed_after", self.count(4));
        }
        if states > 0 && self.happens(2) {
            let passage = json!({ "from": state(0), "to": state(1), "probability": self.chance(0.3),
                "relayed": self.happens(2) });
            set("transition", json!([passage]));
        }
    }

    fn growth_unit(&mut self) -> Value {
        let mut unit = json!({ "nodes": self.count(4) });
        if self.happens(3) {
            unit["per_step"] = self.count(2);
        }
        if self.happens(3) {
            unit["neoformed"] = self.count(2);
        }
        if self.happens(3) {
            unit["short"] = json!({ "probability": self.chance(0.5), "nodes": self.count(2),
                "length_cm": self.measure(0.5) });
        }
        unit
    }

    fn axillary(&mut self, states: u32) -> Value {
        let mut axillary = json!({ "buds": self.count(2), "ramification": self.chance(0.5), "delay": self.count(3) });
        if states > 0 && self.happens(2) {
            axillary["state"] = json!(state(self.below(states)));
        }
        match self.below(4) {
            0 => axillary["pattern"] = json!({ "zones": (0..2).map(|_| self.zone(states)).collect::<Vec<_>>() }),
            1 => axillary["pattern"] = self.chain(states),
            _ => {}
        }
        axillary
    }

    fn zone(&mut self, states: u32) -> Value {
        let mut zone = json!({ "from": self.one_of(["base", "tip"]), "first": self.rank() });
        if self.happens(2) {
            zone["last"] = json!({ "poisson": { "mean": 2 }, "shift": 2 });
        }
        self.add_to_zone(&mut zone, states);
        zone
    }

    fn chain(&mut self, states: u32) -> Value {
        let mut links: Vec<Value> = (0..2).map(|_| json!({ "length": self.rank() })).collect();
        links.iter_mut().for_each(|link| self.add_to_zone(link, states));
        json!({ "from": self.one_of(["base", "tip"]), "begins": [1, 1], "chain": links })
    }

    fn add_to_zone(&mut self, zone: &mut Value, states: u32) {
        if self.happens(2) {
            zone["ramification"] = self.chance(0.5);
        }
        if states > 0 && self.happens(2) {
            zone["state"] = json!({ state(0): 1, state(1): 2 });
        }
    }

    fn leaf(&mut self) -> Value {
        let (per_node, length_cm) = (self.count(2), self.measure(9.0));
        let (width_cm, insertion_deg) = (self.measure(4.0), self.measure(60.0));
        let mut leaf = json!({ "per_node": per_node, "length_cm": length_cm, "width_cm": width_cm,
            "insertion_deg": insertion_deg, "form": "elliptic" });
        if self.happens(2) {
            leaf["life"] = self.count(6);
        }
        if self.happens(3) {
            leaf["area_share"] = self.measure(0.5);
        }
        leaf
    }

    fn flower(&mut self) -> Value {
        let mut flower = json!({ "lateral": self.chance(0.4), "per_node": self.count(2), "delay": self.count(3),
            "life": self.count(3), "fruit_set": self.chance(0.5), "length_cm": self.measure(2.0),
            "width_cm": self.measure(2.0), "insertion_deg": self.measure(40.0) });
        if self.happens(3) {
            flower["terminal"] = self.chance(0.1);
        }
        flower
    }

    fn phyllotaxis(&mut self) -> Value {
        match self.below(3) {
            0 => json!("2/5"),
            1 => self.measure(120.0),
            _ => json!({ "divergence_deg": self.measure(150.0), "first_deg": self.measure(20.0) }),
        }
    }

    fn trend(&mut self, states: u32) -> Value {
        match self.below(4) {
            0 => json!({ "inclination_deg": self.measure(30.0), "share": 0.1 }),
            1 => {
                let phase = |rank: Value, degrees: Value| {
                    json!({ "from_rank": rank, "inclination_deg": degrees,
                    "share": 0.2 })
                };
                json!([
                    phase(json!(1), self.measure(20.0)),
                    phase(json!({ "poisson": { "mean": 3 }, "shift": 2 }), self.measure(80.0))
                ])
            }
            2 if states > 0 => {
                let by_state: Map<String, Value> = (0..states)
                    .map(|number| (state(number), json!({ "inclination_deg": 10 * number, "share": 0.1 })))
                    .collect();
                json!({ "by_state": by_state })
            }
            _ => json!("plagiotropic"),
        }
    }

    /// A law of probability about `p`.
    fn chance(&mut self, p: f64) -> Value {
        match self.below(7) {
            0 => json!(0),
            1 => json!(1.0_f64.min(2.0 * p)),
            2 => json!({ "step": { "over": "age", "at": 8, "before": 0, "after": p } }),
            3 => json!({ "expression": format!("{p} * unit / (unit + 1)") }),
            4 => json!({ "expression": format!("{p} * cycle / (cycle + 2)") }),
            _ => json!(p),
        }
    }

    /// A number of things, `most` or a few more at most.
    fn count(&mut self, most: u32) -> Value {
        match self.below(6) {
            0 => json!({ "empirical": [1, 2, 1] }),
            1 => json!({ "binomial": { "n": most, "p": 0.6 } }),
            2 => json!({ "constant": { "step": { "over": "age", "at": 7, "before": 1, "after": most } } }),
            _ => json!(self.below(most + 1)),
        }
    }

    /// A rank.
    fn rank(&mut self) -> Value {
        match self.below(2) {
            0 => json!({ "poisson": { "mean": 1 }, "shift": 1 }),
            _ => json!(1 + self.below(2)),
        }
    }

    /// A measure about `mean`.
    fn measure(&mut self, mean: f64) -> Value {
        match self.below(8) {
            0 => json!({ "normal": { "mean": mean, "sd": mean / 4.0 }, "min": mean / 3.0, "max": 1.5 * mean }),
            1 => json!({ "uniform": { "min": mean / 2.0, "max": mean } }),
            2 => json!({ "lognormal": { "mean": mean, "sd": mean / 3.0 }, "max": 1.6 * mean }),
            3 => json!({ "empirical": [mean, mean / 2.0, 1.25 * mean] }),
            4 => json!({ "value": { "linear": { "over": "age", "start": mean, "slope": 0.01 } } }),
            5 => json!({ "normal": { "mean": { "expression": format!("{mean} + 0.01 * age") }, "sd": mean / 5.0 },
                "min": mean / 3.0, "max": 1.5 * mean }),
            _ => json!(mean),
        }
    }

    fn below(&mut self, bound: u32) -> u32 {
        self.draws.word() % bound
    }

    /// Once in so many times.
    fn happens(&mut self, once_in: u32) -> bool {
        self.below(once_in) == 0
    }

    fn one_of<T: Copy, const N: usize>(&mut self, things: [T; N]) -> T {
        things[self.below(N as u32) as usize]
    }
}

fn state(number: u32) -> String {
    ["young", "adult", "old"][number as usize % 3].to_owned()
}
