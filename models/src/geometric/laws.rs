//! The laws of a tree's numbers, compiled, and their draws: a plant draws each number once for its whole life, but the
//! angles of GMT4 anew at each branching.
//!
//! Each number of each rule of branching has a word of its own in the plant's stream, whether it is drawn or not, so
//! that stating the law of one number changes no other; a tree that is rebuilt at each age reads the same words again.
//! The laws depend on no variable: a tree has its numbers before it has an age, an order or a rank. Absent on purpose:
//! the use of the numbers (`tree`), and which laws may stand together (`checks`).

use super::descriptor::{Rule, TreeType};
use crate::fault::{Fault, Path};
use crate::law::{At, Domain, ValueRange, Variate, VariateTable};
use crate::turns::{GOLDEN_ANGLE_DEG, fibonacci};
use phytomer_sim::random::Stream;

/// The numbers of a rule that are laws.
pub(super) const NUMBERS: usize = 8;
/// The words that a rule has in the stream of a plant.
pub(super) const WORDS: u64 = 16;

const ANGLE: ValueRange = ValueRange { min: -180.0, max: 180.0, what: "an angle in degrees" };
const TURN: ValueRange = ValueRange { min: -360.0, max: 360.0, what: "an angle in degrees" };
pub(super) const RATIO: ValueRange = ValueRange { min: f64::MIN_POSITIVE, max: 1.0, what: "a ratio" };

/// The numbers of a rule, in the order of [`STATED`].
pub(super) const H1: usize = 0;
pub(super) const H2: usize = 1;
pub(super) const R1: usize = 2;
pub(super) const R2: usize = 3;
pub(super) const DIAMETER: usize = 4;
pub(super) const DIVERGENCE: usize = 5;
pub(super) const DELTA: usize = 6;
pub(super) const R0: usize = 7;

/// A number's key and range, its word in the stream, and its value where no file states it.
type Stated = (&'static str, ValueRange, u64, Option<f64>);

/// The words 6 and 7 are those of the first branch (`plan`).
pub(super) const STATED: [Stated; NUMBERS] = [
    ("h1_deg", ANGLE, 0, None),
    ("h2_deg", ANGLE, 1, None),
    ("r1", RATIO, 2, None),
    ("r2", RATIO, 3, None),
    ("diameter_ratio", RATIO, 4, None),
    ("divergence_deg", TURN, 5, Some(0.0)),
    ("delta_deg", TURN, 8, Some(0.0)),
    ("r0", RATIO, 9, None),
];

/// The laws of one rule of branching; `None` where the number is that of the tree's own rule.
#[derive(Debug, Clone)]
pub(super) struct RuleLaws {
    pub of: TreeType,
    pub tables: [Option<VariateTable>; NUMBERS],
}

/// The law of a key that may be a name.
fn stated(rule: &Rule, place: usize) -> Option<&Variate> {
    let laws = [
        &rule.h1_deg,
        &rule.h2_deg,
        &rule.r1,
        &rule.r2,
        &rule.diameter_ratio,
        &rule.divergence_deg,
        &rule.delta_deg,
        &rule.r0,
    ];
    laws[place].as_ref()
}

/// Compiles a law; one that fails adds its faults and is NaN, in which the other checks find no fault.
pub(super) fn table(law: &Variate, path: &Path, range: ValueRange, faults: &mut Vec<Fault>) -> VariateTable {
    law.compile(&Domain::ONCE, path, range).unwrap_or_else(|mut found| {
        faults.append(&mut found);
        VariateTable::always(f64::NAN)
    })
}

impl RuleLaws {
    /// The laws that a rule at `path` states.
    pub fn compile(rule: &Rule, of: TreeType, path: &Path, faults: &mut Vec<Fault>) -> Self {
        let mut tables = STATED.map(|_| None);
        for (place, (key, range, ..)) in STATED.into_iter().enumerate() {
            if of.takes(key) {
                tables[place] = stated(rule, place).map(|law| table(law, &path.key(key), range, faults));
            }
        }
        if let Some(name) = &rule.divergence {
            let path = path.key("divergence");
            if rule.divergence_deg.is_some() {
                let problem = "divergence and divergence_deg are both given";
                faults.push(Fault::new(&path, problem, "one of the two"));
            }
            tables[DIVERGENCE] = Some(VariateTable::always(named(name, &path, faults)));
        }
        Self { of, tables }
    }

    /// The least and the largest value of a number; NaN where the rule states none.
    pub fn extent(&self, place: usize) -> [f64; 2] {
        self.tables[place].as_ref().map_or([f64::NAN; 2], VariateTable::extent)
    }

    /// Whether any number of the rule is drawn.
    pub fn is_random(&self) -> bool {
        self.tables.iter().flatten().any(VariateTable::is_random)
    }

    /// The numbers of a plant: those of `base` where the rule states none. `words` stands at the first word of the
    /// rule; `None` where nothing is drawn.
    pub fn draw(&self, mut words: Option<(&mut Stream, u64)>, base: Option<&[f64; NUMBERS]>) -> [f64; NUMBERS] {
        let mut read = |word: u64| match &mut words {
            Some((stream, first)) => {
                stream.seek(*first + word);
                stream.word()
            }
            None => 0,
        };
        let mut numbers = [0.0; NUMBERS];
        for (place, (.., word, default)) in STATED.into_iter().enumerate() {
            numbers[place] = match (&self.tables[place], base) {
                (Some(law), _) => law.draw_f64(read(word), At::default()),
                (None, Some(base)) => base[place],
                (None, None) => default.unwrap_or(f64::NAN),
            };
        }
        numbers
    }
}

/// The degrees of a divergence by its name.
fn named(name: &str, path: &Path, faults: &mut Vec<Fault>) -> f64 {
    let degrees = if name == "spiral" { Some(GOLDEN_ANGLE_DEG) } else { fibonacci(name) };
    degrees.unwrap_or_else(|| {
        let expected = "a Fibonacci fraction of a turn such as \"2/5\" or \"3/8\", or \"spiral\"";
        faults.push(Fault::new(path, format!("the divergence is \"{name}\""), expected));
        f64::NAN
    })
}
