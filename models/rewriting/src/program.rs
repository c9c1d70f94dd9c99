//! A program: what the text of an L-system says, checked, and ready to be derived.
//!
//! One program serves any number of plants, on any threads; what a plant has come to is its [`Derived`].

use crate::code::{Made, Script};
use crate::compile::{Compiled, compile};
use crate::derived::{Derived, Drawn, Variables};
use crate::draws::{Draws, For};
use crate::engine::{self, Anchor, Bounds, Expansion, Pieces, Root};
use crate::evaluate::{Halt, Machine};
use crate::fault::{Fault, Place, Refused, Stopped};
use crate::outside::{Nothing, Outside};
use crate::string::{ModuleString, Slot};
use crate::symbol::{Symbol, SymbolTable};
use crate::syntax::{File, parse, plain};
use crate::text::{Asked, Prepared, prepare};
use phytomer_sim::random::PlantRandom;
use std::sync::Arc;

/// How a text is read.
pub struct Reading<'r> {
    /// The file, as faults are to call it.
    pub name: &'r str,
    /// Whether it is a D0L-system of cells, in which parentheses are branches ([`Cells`](crate::Cells)).
    pub cells: bool,
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
        Reading { name, cells: false, include, define: &[], outside: Arc::new(Nothing), continues_last: &[] }
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
    /// The most modules of a string; all modules together may have eight times as many parameters.
    pub modules: usize,
    /// The most modules that the looks at contexts pass over in a step; a round of a loop, or a call of a function,
    /// counts as 16 of these modules.
    pub rounds: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { modules: 50_000_000, rounds: 2_000_000_000 }
    }
}

/// A program, read and checked.
#[derive(Debug)]
pub struct Program {
    files: Vec<String>,
    symbols: SymbolTable,
    settings: Settings,
    warnings: Vec<Fault>,
    script: Script,
    outside: Arc<dyn Outside>,
    /// Whether it is a D0L-system of cells.
    cells: bool,
    /// The most that a derivation may come to.
    pub limits: Limits,
}

impl Program {
    /// Reads the text of an L-system.
    ///
    /// # Errors
    /// Everything that is wrong with the text.
    pub fn read(text: &str, reading: &Reading<'_>) -> Result<Self, Refused> {
        let (file, files, mut faults) = tree(text, reading)?;
        let compiled = compile(&file, reading.outside.as_ref(), reading.continues_last, &mut faults);
        if !faults.is_empty() {
            return Err(Refused::new(files, faults, Vec::new()));
        }
        let Compiled { script, symbols, steps, seed, angle_deg, warnings } = compiled;
        let settings = Settings { steps, seed, ring: script.ring, angle_deg };
        let (outside, limits) = (Arc::clone(&reading.outside), Limits::default());
        Ok(Self { files, symbols, settings, warnings, script, outside, limits, cells: reading.cells })
    }

    /// A symbol as the file writes it: a bracket of a D0L-system of cells is a parenthesis.
    pub fn written(&self, symbol: Symbol) -> &str {
        match self.symbols.name(symbol) {
            "[" if self.cells => "(",
            "]" if self.cells => ")",
            name => name,
        }
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

    /// The names of the files, by the numbers in [`Place`](crate::Place).
    pub fn files(&self) -> &[String] {
        &self.files
    }

    /// Whether a string of it may hold queries, so that it must be interpreted after each step.
    pub fn has_queries(&self) -> bool {
        (0..self.symbols.len()).any(|number| self.symbols.name(Symbol(number as u16)).starts_with('?'))
    }

    /// A plant at its axiom.
    ///
    /// # Errors
    /// Why it cannot be made.
    pub fn sow(&self, random: PlantRandom, interpreter: &mut dyn Interpreter) -> Result<Derived, Stopped> {
        self.sow_again(None, random, interpreter)
    }

    /// The same in the memory of a plant that is needed no more, of this program or of another.
    ///
    /// # Errors
    /// Why it cannot be made.
    pub fn sow_again(
        &self,
        memory: Option<Derived>,
        random: PlantRandom,
        interpreter: &mut dyn Interpreter,
    ) -> Result<Derived, Stopped> {
        let arrays = self.script.arrays.iter().map(|array| array.values.clone()).collect();
        let seed = self.settings.seed.unwrap_or(0);
        let variables = Variables { values: vec![0.0; self.script.globals], arrays, seed };
        let (kinds, both_ways) = (self.symbols.kinds(), self.script.looks_left());
        let mut derived = match memory {
            Some(Derived { mut string, active, updated, spare, mut cut, .. }) => {
                string.clear(kinds, both_ways);
                cut.clear();
                Derived { string, active, updated, spare, variables, cut, step: 0, random }
            }
            None => {
                let (active, updated, spare, cut) = Default::default();
                let string = ModuleString::new(kinds, both_ways);
                Derived { string, active, updated, spare, variables, cut, step: 0, random }
            }
        };
        let result = engine::sow(&self.script, &mut derived, self.outside.as_ref(), self.bounds());
        result.map_err(|halt| self.stopped(0, *halt))?;
        self.answer(&mut derived, interpreter)?;
        Ok(derived)
    }

    /// Makes one step.
    ///
    /// # Errors
    /// Why it cannot be made; the plant is then in no certain state.
    pub fn step(&self, derived: &mut Derived, interpreter: &mut dyn Interpreter) -> Result<(), Stopped> {
        let result = engine::step(&self.script, derived, self.outside.as_ref(), self.bounds());
        result.map_err(|halt| self.stopped(derived.step, *halt))?;
        self.answer(derived, interpreter)
    }

    /// Where the file first makes a query.
    fn place_of_query(&self) -> Place {
        let rules = [&self.script.rewriting, &self.script.decomposition].into_iter().flat_map(|rules| &rules.rules);
        let mut made = self.script.axiom.iter().chain(rules.flat_map(|rule| rule.successor.iter()));
        let is_query = |made: &&Made| {
            let kind = self.symbols.kinds().get(usize::from(made.kind.0));
            kind.is_some_and(|kind| self.symbols.name(kind.0).starts_with('?'))
        };
        made.find(is_query).map_or(self.script.place(), |made| made.place)
    }

    /// Has the queries answered.
    fn answer(&self, derived: &mut Derived, interpreter: &mut dyn Interpreter) -> Result<(), Stopped> {
        if !self.has_queries() {
            return Ok(());
        }
        let mut answers = Answers::default();
        let result = interpreter.answer(self, derived, &mut answers);
        let halt = |(problem, expected)| Halt { place: self.place_of_query(), problem, expected };
        result.map_err(|why| self.stopped(derived.step, halt(why)))?;
        for (slot, values) in answers.values {
            derived.string.set_parameters(slot, &values);
        }
        Ok(())
    }

    /// Whether every module is drawn as it is: no homomorphism replaces any.
    pub fn draws_its_modules(&self) -> bool {
        self.script.homomorphism.rules.is_empty()
    }

    /// Shows `visit` every module as it is drawn, in the order of the string. What the homomorphism assigns is
    /// forgotten afterwards: drawing changes no plant. Its draws depend on module and path and not on the step, so that
    /// what stays is drawn as it was.
    ///
    /// # Errors
    /// Why the homomorphism cannot be applied.
    pub fn draw(&self, derived: &Derived, mut visit: impl FnMut(Drawn<'_>)) -> Result<(), Stopped> {
        let (script, string, rules) = (&self.script, &derived.string, &self.script.homomorphism);
        let mut variables = derived.variables.clone();
        variables.seed ^= rules.seed;
        let mut machine = Machine {
            functions: &script.functions,
            arrays: &script.arrays,
            outside: self.outside.as_ref(),
            variables: &mut variables,
            draws: Draws::new(&derived.random),
            step: derived.step,
            rounds: self.limits.rounds,
        };
        let (mut expansion, mut roots) = (Expansion::default(), Pieces::default());
        // What a homomorphism draws is bounded as a string is.
        let mut left = self.limits.modules;
        for slot in string.slots_in_order() {
            let kind = string.kind(slot);
            if rules.of(kind).is_empty() {
                let (symbol, parameters, key) = string.shown(slot);
                visit(Drawn { symbol, parameters, key, of: slot, depth: 0 });
                continue;
            }
            let module = string.module(slot);
            roots.clear();
            roots.push(kind, module.parameters, module.identity);
            expansion.begin(&roots);
            let anchor = Anchor { script, string, first: slot, last: slot };
            let (purpose, step, place) = (For::Homomorphism, derived.step, script.place());
            let root = Root { anchor, purpose, step, most: self.limits.modules, place };
            let shown = expansion.run(rules, &root, &mut machine, |piece, parameters, depth, place| {
                let Some(less) = left.checked_sub(1) else {
                    let problem = format!("a homomorphism draws more than {} modules", self.limits.modules);
                    return crate::evaluate::halt(place, problem, "fewer");
                };
                left = less;
                let symbol = self.symbols.kinds().get(usize::from(piece.kind.0)).map_or(module.symbol, |kind| kind.0);
                visit(Drawn { symbol, parameters, key: piece.identity.key, of: slot, depth });
                Ok(())
            });
            shown.map_err(|halt| self.stopped(derived.step, *halt))?;
        }
        Ok(())
    }

    /// Forgets the rows, so that every successor is made piece by piece.
    #[cfg(test)]
    pub(crate) fn forget_rows(&mut self) {
        self.script.rewriting.rules.iter_mut().for_each(|rule| rule.row = None);
    }

    fn bounds(&self) -> Bounds {
        Bounds { modules: self.limits.modules, rounds: self.limits.rounds }
    }

    fn stopped(&self, step: u32, halt: Halt) -> Stopped {
        let Halt { place, problem, expected } = halt;
        let file = self.files.get(place.file as usize).cloned().unwrap_or_default();
        Stopped { file, place, step, problem, expected }
    }
}

/// The tree of a text, the names of its files, and what is wrong in the tree.
pub(crate) fn tree(text: &str, reading: &Reading<'_>) -> Result<(File, Vec<String>, Vec<Fault>), Refused> {
    let mut faults = Vec::new();
    let asked = Asked { name: reading.name, include: reading.include, define: reading.define };
    let Prepared { letters, files, unknown } = prepare(text, &asked, &mut faults);
    if !faults.is_empty() || !unknown.is_empty() {
        return Err(Refused::new(files, faults, unknown));
    }
    let mut file = parse(&letters, reading.cells, &mut faults);
    if reading.cells {
        plain(&mut file, &mut faults);
    }
    Ok((file, files, faults))
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
}
