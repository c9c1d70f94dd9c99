//! From the tree of a file to a program that can be carried out: names are looked up, symbols become kinds, and what
//! the file says is checked. All faults are told at once.

mod blocks;
mod functions;
mod names;
mod productions;
mod weights;

use crate::code::Script;
use crate::engine::lay_rows;
use crate::fault::{Fault, Place};
use crate::outside::Outside;
use crate::symbol::SymbolTable;
use crate::syntax::{Expression, File, Name};
use names::{Names, Scope};

/// What compilation gives.
pub(crate) struct Compiled {
    pub script: Script,
    pub symbols: SymbolTable,
    pub steps: Option<u32>,
    pub seed: Option<u64>,
    pub angle_deg: Option<f64>,
    pub warnings: Vec<Fault>,
}

/// The most steps, and the deepest decomposition, that a file may ask for.
const MOST_STEPS: f64 = 16_000_000.0;
const DEEPEST: f64 = 1_000_000.0;

/// Compiles what a file says.
pub(crate) fn compile(file: &File, outside: &dyn Outside, last: &[String], faults: &mut Vec<Fault>) -> Compiled {
    let mut names = Names::new(outside);
    let constant = |item: &Option<(Place, Expression)>, names: &Names<'_>, faults: &mut Vec<Fault>| {
        item.as_ref().map(|(place, expression)| names.constant(expression, *place, faults))
    };
    let steps = constant(&file.steps, &names, faults).map(|steps| steps.clamp(0.0, MOST_STEPS) as u32);
    names.steps = f64::from(steps.unwrap_or(0));
    let angle_deg = constant(&file.angle, &names, faults);
    let seed = constant(&file.rewriting.seed, &names, faults).map(f64::to_bits);
    let arrays = blocks::declare(file, &mut names, faults);
    let functions = blocks::functions(file, &mut names, faults);
    let mut symbols = SymbolTable::new();
    let axiom = productions::axiom(file, &names, &mut symbols, faults);
    let mut warnings = Vec::new();
    let context = &mut productions::Context { names: &names, symbols: &mut symbols, last, headed: file.headed };
    let [mut rewriting, decomposition, homomorphism] =
        [&file.rewriting, &file.decomposition, &file.homomorphism].map(|section| {
            let rules = productions::rules(section, context, faults);
            weights::check(&rules, &mut warnings);
            rules
        });
    rewriting.compete |= seed.is_some();
    // The seed of the file is where a derivation begins; `srand` may change it.
    rewriting.seed = 0;
    let scope = &mut Scope::of_blocks();
    let mut script = Script {
        axiom,
        rewriting,
        decomposition,
        homomorphism,
        start: names.acts(&file.start, scope, faults),
        start_each: names.acts(&file.start_each, scope, faults),
        end_each: names.acts(&file.end_each, scope, faults),
        functions,
        globals: names.globals(),
        arrays,
        visible: visible(file, &symbols),
        ring: file.ring,
    };
    productions::check_kinds(&script, &symbols, &mut warnings);
    lay_rows(&mut script);
    Compiled { script, symbols, steps, seed, angle_deg, warnings }
}

/// For each kind whether contexts see it: what `consider:` names, or all but what `ignore:` names.
fn visible(file: &File, symbols: &SymbolTable) -> Vec<bool> {
    let holds = |list: &[Name], name: &str| list.iter().any(|listed| listed.name == name);
    let sees = |name: &str| match (&file.consider, &file.ignore) {
        (Some(consider), _) => holds(consider, name),
        (None, Some(ignore)) => !holds(ignore, name),
        (None, None) => true,
    };
    symbols.kinds().iter().map(|&(symbol, _)| sees(symbols.name(symbol))).collect()
}
