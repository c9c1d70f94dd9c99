//! The laws of GMT1's parameters, compiled, and their draws: a plant draws each parameter once for its whole life.
//!
//! Each parameter has a word of its own in the plant's stream, whether it is drawn or not, so that stating the law of
//! one parameter changes no other; a tree that is rebuilt at each age reads the same words again. The laws depend on no
//! variable: a tree has its parameters before it has an age, an order or a rank. Absent on purpose: the use of the
//! parameters (`tree`).

use super::gmt1::Gmt1;
use super::tree::Tree;
use crate::fault::{Fault, Path};
use crate::law::{At, Domain, ValueRange, Variate, VariateTable};
use phytomer_sim::plant::LineageKey;
use phytomer_sim::random::{PlantRandom, Purpose};

/// The number of real parameters of GMT1.
const PARAMETERS: usize = 8;

const ANGLE: ValueRange = ValueRange { min: -180.0, max: 180.0, what: "an angle in degrees" };
const TURN: ValueRange = ValueRange { min: -360.0, max: 360.0, what: "an angle in degrees" };
const RATIO: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: 1.0, what: "a ratio" };
const METRES: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: 1000.0, what: "metres" };

/// The shortest and the thinnest branch that a tree may have, metres: less than any cell, and single precision still
/// holds all its digits.
const SMALLEST_M: f64 = 1e-9;

/// The laws of the parameters, in the order of [`stated`], which is the order of their words.
#[derive(Debug, Clone)]
pub(super) struct Laws {
    tables: [VariateTable; PARAMETERS],
    is_random: bool,
}

/// The parameters, each with its key and its range.
fn stated(tree: &Gmt1) -> [(&'static str, &Variate, ValueRange); PARAMETERS] {
    [
        ("h1_deg", &tree.h1_deg, ANGLE),
        ("h2_deg", &tree.h2_deg, ANGLE),
        ("r1", &tree.r1, RATIO),
        ("r2", &tree.r2, RATIO),
        ("diameter_ratio", &tree.diameter_ratio, RATIO),
        ("divergence_deg", &tree.divergence_deg, TURN),
        ("first_length_m", &tree.first_length_m, METRES),
        ("first_diameter_m", &tree.first_diameter_m, METRES),
    ]
}

impl Laws {
    /// The laws of a tree whose parameters stand at `path`. A law that fails adds its faults; its table is then NaN, in
    /// which the other checks find no fault.
    pub fn compile(tree: &Gmt1, path: &Path, faults: &mut Vec<Fault>) -> Self {
        let tables = stated(tree).map(|(key, law, range)| {
            law.compile(&Domain::ONCE, &path.key(key), range).unwrap_or_else(|mut found| {
                faults.append(&mut found);
                VariateTable::always(f64::NAN)
            })
        });
        let is_random = tables.iter().any(VariateTable::is_random);
        Self { tables, is_random }
    }

    /// The tree of a plant.
    pub fn draw(&self, random: &PlantRandom) -> Tree {
        let mut words = [0; PARAMETERS];
        if self.is_random {
            random.stream(LineageKey::SEED, Purpose::Plant).read(&mut words);
        }
        let mut drawn = [0.0; PARAMETERS];
        for ((value, table), word) in drawn.iter_mut().zip(&self.tables).zip(words) {
            *value = table.draw_f64(word, At::default());
        }
        let [h1, h2, r1, r2, diameter_ratio, divergence_deg, length_m, diameter_m] = drawn;
        Tree::new([h1, h2], [r1, r2], diameter_ratio, divergence_deg, [length_m, diameter_m])
    }

    /// Adds a fault where both branching angles can be 0: the two children would coincide.
    pub fn check_angles(&self, path: &Path, faults: &mut Vec<Fault>) {
        let [h1, h2, ..] = &self.tables;
        if h1.can_be(0.0) && h2.can_be(0.0) {
            let how = if h1.is_random() || h2.is_random() { "can both be 0" } else { "are both 0" };
            let expected = "h1² + h2² ≠ 0: at least one branching angle that is not 0";
            faults.push(Fault::new(&path.key("h2_deg"), format!("h1_deg and h2_deg {how}"), expected));
        }
    }

    /// Adds a fault where branches of the last level can be too small: their length by the smaller ratio of lengths,
    /// their diameter by the ratio of diameters, each with the smallest values that can be drawn.
    pub fn check_smallest(&self, levels: u32, path: &Path, faults: &mut Vec<Fault>) {
        let [_, _, r1, r2, diameter_ratio, _, length, diameter] = &self.tables;
        let [left, right] = [r1, r2].map(|ratio| ratio.extent()[0]);
        let (key, ratio) = if left <= right { ("r1", r1) } else { ("r2", r2) };
        for (key, first, ratio, word) in
            [(key, length, ratio, "long"), ("diameter_ratio", diameter, diameter_ratio, "thick")]
        {
            let size = (0..levels).fold(first.extent()[0], |size, _| size * ratio.extent()[0]);
            if size < SMALLEST_M {
                let (how, bounded) = match first.is_random() || ratio.is_random() {
                    true => ("can be", "; `min` bounds what is drawn"),
                    false => ("is", ""),
                };
                let problem = format!("after {levels} levels a branch {how} {size:.1e} m {word}");
                let expected = format!("branches of at least {SMALLEST_M:e} m{bounded}");
                faults.push(Fault::new(&path.key(key), problem, expected));
            }
        }
    }
}
