//! What the tests of programs share: reading, deriving, counting, and a turtle small enough to be believed.
#![allow(dead_code, reason = "each test file uses a part of it")]

use phytomer_rewriting::{Answers, Derived, Interpreter, Program, Reading, Refused, Unanswered};
use phytomer_sim::random::PlantRandom;
use std::collections::BTreeMap;

pub fn read(text: &str) -> Program {
    Program::read(text, &Reading::of("plant.l")).unwrap_or_else(|refused| panic!("{refused}"))
}

pub fn refused(text: &str) -> Refused {
    Program::read(text, &Reading::of("plant.l")).expect_err("the text has faults")
}

/// The string of a text after so many steps.
pub fn derive(text: &str, steps: u32) -> (Program, Derived) {
    let program = read(text);
    let derived = derive_program(&program, 1, steps, &mut Unanswered);
    (program, derived)
}

pub fn derive_program(program: &Program, plant: u64, steps: u32, interpreter: &mut dyn Interpreter) -> Derived {
    let mut derived = program.sow(PlantRandom::new(1994, plant), interpreter).unwrap_or_else(|why| panic!("{why}"));
    for _ in 0..steps {
        program.step(&mut derived, interpreter).unwrap_or_else(|why| panic!("{why}"));
    }
    derived
}

/// The string as text.
pub fn text(program: &Program, derived: &Derived) -> String {
    let mut text = String::new();
    for module in derived.string().modules() {
        text.push_str(program.symbols().name(module.symbol));
        let values: Vec<String> = module.parameters.iter().map(|value| format!("{value}")).collect();
        if !values.is_empty() {
            text.push_str(&format!("({})", values.join(",")));
        }
    }
    text
}

pub fn string(text_of: &str, steps: u32) -> String {
    let (program, derived) = derive(text_of, steps);
    text(&program, &derived)
}

/// How many modules there are of each symbol.
pub fn counts(program: &Program, derived: &Derived) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    for module in derived.string().modules() {
        *counts.entry(program.symbols().name(module.symbol).to_owned()).or_insert(0) += 1;
    }
    counts
}

/// Lines drawn: `F` and `G` after the homomorphism.
pub fn lines(program: &Program, derived: &Derived) -> usize {
    let mut lines = 0;
    let names = program.symbols();
    let shown = program.draw(derived, |drawn| lines += usize::from(matches!(names.name(drawn.symbol), "F" | "G")));
    shown.unwrap_or_else(|why| panic!("{why}"));
    lines
}

type Vector = [f64; 3];

/// A turtle with y up, H = +y and L = −x, that answers `?P` and `?H`.
#[derive(Clone)]
pub struct Turtle {
    pub length: f64,
    pub angle: f64,
    /// The positions of all ends of lines.
    pub ends: Vec<Vector>,
    /// The positions of the modules `S`.
    pub signals: Vec<Vector>,
}

#[derive(Clone, Copy)]
struct State {
    at: Vector,
    h: Vector,
    u: Vector,
    l: Vector,
}

impl Turtle {
    pub fn new(angle: f64) -> Self {
        Self { length: 1.0, angle, ends: Vec::new(), signals: Vec::new() }
    }
}

fn turned(a: Vector, b: Vector, degrees: f64) -> (Vector, Vector) {
    let (sin, cos) = match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        other => phytomer_sim::math::sincos(other.to_radians()),
    };
    let mixed = |x: f64, y: f64, s: f64| x * cos + s * y * sin;
    let first = std::array::from_fn(|i| mixed(a[i], b[i], 1.0));
    (first, std::array::from_fn(|i| mixed(b[i], a[i], -1.0)))
}

impl Interpreter for Turtle {
    fn answer(&mut self, program: &Program, derived: &Derived, answers: &mut Answers) -> Result<(), (String, String)> {
        let start = State { at: [0.0; 3], h: [0.0, 1.0, 0.0], u: [0.0, 0.0, -1.0], l: [-1.0, 0.0, 0.0] };
        let (mut state, mut stack) = (start, Vec::new());
        self.ends.clear();
        self.signals.clear();
        let (length, angle) = (self.length, self.angle);
        let names = program.symbols();
        let shown = program.draw(derived, |drawn| {
            let value = drawn.parameters.first().copied();
            let turn = value.unwrap_or(angle);
            match names.name(drawn.symbol) {
                "[" => stack.push(state),
                "]" => state = stack.pop().unwrap_or(start),
                "F" | "G" | "f" => {
                    let step = value.unwrap_or(length);
                    state.at = std::array::from_fn(|i| state.at[i] + step * state.h[i]);
                    self.ends.push(state.at);
                }
                "+" => (state.h, state.l) = turned(state.h, state.l, turn),
                "-" => (state.h, state.l) = turned(state.h, state.l, -turn),
                "&" => (state.u, state.h) = turned(state.u, state.h, turn),
                "^" => (state.u, state.h) = turned(state.u, state.h, -turn),
                "/" => (state.l, state.u) = turned(state.l, state.u, -turn),
                "\\" => (state.l, state.u) = turned(state.l, state.u, turn),
                "S" => self.signals.push(state.at),
                "?P" => answers.give(drawn.of, state.at),
                "?H" => answers.give(drawn.of, state.h),
                _ => {}
            }
        });
        shown.map_err(|why| (why.problem, why.expected))
    }
}
