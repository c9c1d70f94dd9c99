//! A program: what the text of an L-system says, checked, and ready to be derived.
//!
//! One program serves any number of plants, on any threads; what a plant has come to is its [`Derived`].

use crate::derived::{Derived, Drawn};
use crate::fault::{Fault, Place, Refused, Stopped};
use crate::outside::{Nothing, Outside};
use crate::string::Slot;
use crate::symbol::SymbolTable;
use phytomer_sim::random::PlantRandom;
use std::sync::Arc;

/// How a text is read.
pub struct Reading<'r> {
    /// The file, as faults are to call it.
    pub name: &'r str,
    /// The text of an included file, or why it cannot be had.
    pub include: &'r dyn Fn(&str) -> Result<String, String>,
    /// Constants that stand for the `#define` of their names, or for names that the file leaves open.
    pub define: &'r [(String, f64)],
    /// The functions that the file may call.
    pub outside: Arc<dyn Outside>,
    /// The symbols of which the last module in a successor is the predecessor that goes on, where growth is
    /// intercalary; of the others it is the first.
    pub continues_last: &'r [String],
}

impl Reading<'_> {
    /// A file alone: nothing can be included, no constant is set and no function stands outside.
    pub fn of(name: &str) -> Reading<'_> {
        let include = &|_: &str| Err("nothing can be included here".to_owned());
        Reading { name, include, define: &[], outside: Arc::new(Nothing), continues_last: &[] }
    }
}

/// The numbers that a file states beside its productions.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Settings {
    /// `derivation length`, or `n = …` in the papers' notation.
    pub steps: Option<u32>,
    /// `seed`.
    pub seed: Option<u64>,
    /// Whether the string is a ring.
    pub ring: bool,
    /// The angle of turns without a parameter, degrees, as the papers state it: δ = ….
    pub angle_deg: Option<f64>,
}

/// The most that a derivation may come to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Modules of a string, and parameters of all its modules by eight.
    pub modules: usize,
    /// Rounds of loops in a step.
    pub rounds: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { modules: 50_000_000, rounds: 100_000_000 }
    }
}

/// A program, read and checked.
#[derive(Debug)]
pub struct Program {
    pub(crate) files: Vec<String>,
    pub(crate) symbols: SymbolTable,
    pub(crate) settings: Settings,
    pub(crate) warnings: Vec<Fault>,
}

impl Program {
    /// Reads the text of an L-system.
    ///
    /// # Errors
    /// Everything that is wrong with the text.
    pub fn read(_text: &str, reading: &Reading<'_>) -> Result<Self, Refused> {
        let fault = Fault::new(Place::default(), "L-systems are not read yet", "a later version");
        Err(Refused::new(vec![reading.name.to_owned()], vec![fault]))
    }

    /// The names of its modules.
    pub fn symbols(&self) -> &SymbolTable {
        &self.symbols
    }

    /// The numbers that the file states.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// What is doubtful in the file and no fault, with its places.
    pub fn warnings(&self) -> &[Fault] {
        &self.warnings
    }

    /// The names of the files, by the numbers in [`Place`].
    pub fn files(&self) -> &[String] {
        &self.files
    }

    /// Whether a string of it may hold queries, so that it must be interpreted after each step.
    pub fn has_queries(&self) -> bool {
        let names = (0..self.symbols.len()).map(|number| self.symbols.name(crate::symbol::Symbol(number as u16)));
        names.into_iter().any(|name| name.starts_with('?'))
    }

    /// A plant at its axiom.
    ///
    /// # Errors
    /// Why it cannot be made.
    pub fn sow(&self, _random: PlantRandom, _interpreter: &mut dyn Interpreter) -> Result<Derived, Stopped> {
        Err(self.unready())
    }

    /// Makes one step.
    ///
    /// # Errors
    /// Why it cannot be made; the plant is then in no certain state.
    pub fn step(&self, _derived: &mut Derived, _interpreter: &mut dyn Interpreter) -> Result<(), Stopped> {
        Err(self.unready())
    }

    /// Shows `visit` every module as it is drawn, in the order of the string.
    ///
    /// # Errors
    /// Why the homomorphism cannot be applied.
    pub fn draw(&self, _derived: &Derived, _visit: impl FnMut(Drawn<'_>)) -> Result<(), Stopped> {
        Err(self.unready())
    }

    fn unready(&self) -> Stopped {
        let (file, problem, expected) = (String::new(), "nothing is derived yet".to_owned(), "a later version".to_owned());
        Stopped { file, place: Place::default(), step: 0, problem, expected }
    }
}

/// Fills query modules between steps: what draws a string knows where each query stands.
pub trait Interpreter {
    /// Gives `answers` the values of the queries (`?P`, `?H`, `?U`, `?L`, `?E`) of the string. It is asked after the
    /// axiom and after each step of a program that has queries, when cuts have been made.
    ///
    /// # Errors
    /// What is wrong, and what would be right.
    fn answer(&mut self, program: &Program, derived: &Derived, answers: &mut Answers) -> Result<(), (String, String)>;
}

/// Leaves queries as they are.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unanswered;

impl Interpreter for Unanswered {
    fn answer(&mut self, _: &Program, _: &Derived, _: &mut Answers) -> Result<(), (String, String)> {
        Ok(())
    }
}

/// The values of queries, by their modules.
#[derive(Debug, Clone, Default)]
pub struct Answers {
    values: Vec<(Slot, [f64; 3])>,
}

impl Answers {
    /// A query module takes the first of these values, as many as it has parameters.
    pub fn give(&mut self, query: Slot, values: [f64; 3]) {
        self.values.push((query, values));
    }

    pub(crate) fn values(&self) -> &[(Slot, [f64; 3])] {
        &self.values
    }
}
