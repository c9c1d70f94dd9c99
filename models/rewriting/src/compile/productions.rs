//! Productions: patterns of kinds, the variables that they bind, and what becomes of the predecessor.
//!
//! A module of the predecessor goes on as the first module of its symbol outside brackets in the successor, or as the
//! last for the symbols of which growth is intercalary.

use super::names::{Names, Scope};
use crate::code::{Item, Made, Rule, Rules, Script};
use crate::fault::{Fault, Place};
use crate::symbol::{CLOSE, CUT, Kind, MOST_SYMBOLS, OPEN, Symbol, SymbolTable};
use crate::syntax::{File, Formal, ModuleText, Production, Section};
use std::collections::{BTreeMap, BTreeSet};

/// The most productions of a section.
const MOST_RULES: usize = 5000;
/// The most parameters of a predecessor with its contexts.
const MOST_LOCALS: usize = 250;

/// What productions are compiled with.
pub(super) struct Context<'c, 'o> {
    pub names: &'c Names<'o>,
    pub symbols: &'c mut SymbolTable,
    /// The symbols that go on as their last module.
    pub last: &'c [String],
    /// Whether the file is in the notation of cpfg.
    pub headed: bool,
}

/// The modules of the axiom.
pub(super) fn axiom(file: &File, names: &Names<'_>, symbols: &mut SymbolTable, faults: &mut Vec<Fault>) -> Box<[Made]> {
    let Some((place, modules)) = &file.axiom else { return Box::default() };
    let mut context = Context { names, symbols, last: &[], headed: file.headed };
    let made = successor(modules, &mut Scope::default(), &mut context, faults);
    check_balance(made.iter().map(|made| (made.kind, made.place)), *place, faults);
    made
}

/// The productions of a section.
pub(super) fn rules(section: &Section, context: &mut Context<'_, '_>, faults: &mut Vec<Fault>) -> Rules {
    let constant = |item: &Option<(Place, crate::syntax::Expression)>, faults: &mut Vec<Fault>| {
        item.as_ref().map(|(place, expression)| context.names.constant(expression, *place, faults))
    };
    let depth = constant(&section.depth, faults).map_or(1, |depth| depth.clamp(0.0, super::DEEPEST) as u32);
    let seed = constant(&section.seed, faults).map_or(0, f64::to_bits);
    let mut rules = Rules { depth, seed, ..Rules::default() };
    for production in section.productions.iter().take(MOST_RULES) {
        let rule = rule(production, context, faults);
        if let Some(Item::Module(kind, _)) = rule.strict.first() {
            let kind = usize::from(kind.0);
            rules.by_kind.resize_with(rules.by_kind.len().max(kind + 1), Vec::new);
            rules.by_kind[kind].push(rules.rules.len() as u32);
        }
        rules.compete |= rule.weight.is_some();
        rules.looks_left |= !rule.left.is_empty();
        rules.looks |= !rule.left.is_empty() || !rule.right.is_empty();
        rules.rules.push(rule);
    }
    if let Some(production) = section.productions.get(MOST_RULES) {
        faults.push(Fault::new(production.place, "there are too many productions", format!("at most {MOST_RULES}")));
    }
    rules
}

fn rule(production: &Production, context: &mut Context<'_, '_>, faults: &mut Vec<Fault>) -> Rule {
    let mut scope = Scope::default();
    let strict = items(&production.strict, &mut scope, context, faults);
    let mut left = items(&production.left, &mut scope, context, faults);
    let mut right = items(&production.right, &mut scope, context, faults);
    left.reverse();
    if !context.headed {
        name_beginnings(&mut right);
    }
    let kinds = strict.iter().zip(&production.strict).filter_map(|(item, formal)| match item {
        Item::Module(kind, _) => Some((*kind, formal.place)),
        Item::Rest => None,
    });
    check_balance(kinds, production.place, faults);
    context.names.declare_local(&production.before, &mut scope, faults);
    context.names.declare_local(&production.after, &mut scope, faults);
    let names = context.names;
    let before = names.acts(&production.before, &mut scope, faults);
    let condition = production.condition.as_ref().map(|condition| names.code(condition, &scope, faults));
    let after = names.acts(&production.after, &mut scope, faults);
    let weight = production.weight.as_ref().map(|(_, weight)| names.code(weight, &scope, faults));
    let mut successor = successor(&production.successor, &mut scope, context, faults);
    check_balance(successor.iter().map(|made| (made.kind, made.place)), production.place, faults);
    go_on(&production.strict, &production.successor, &mut successor, context.last);
    let (left, strict, right) = (left.into(), strict.into(), right.into());
    let locals = scope.locals.len() as u16;
    let cost = Rule::cost_of(condition.as_ref(), weight.as_ref(), &successor);
    let (place, row) = (production.place, None);
    Rule { place, left, strict, right, before, condition, after, successor, weight, locals, cost, row }
}

/// The patterns of modules; their parameters become variables.
fn items(formals: &[Formal], scope: &mut Scope, context: &mut Context<'_, '_>, faults: &mut Vec<Fault>) -> Vec<Item> {
    let mut items = Vec::new();
    for formal in formals {
        if formal.symbol == "=" {
            items.push(Item::Rest);
            continue;
        }
        let first = scope.locals.len() as u16;
        for parameter in &formal.parameters {
            if scope.locals.contains(&parameter.name) {
                let problem = format!("two parameters of a production are named `{}`", parameter.name);
                faults.push(Fault::new(parameter.place, problem, "another name for each"));
            }
            if scope.locals.len() == MOST_LOCALS {
                let expected = format!("at most {MOST_LOCALS}");
                faults.push(Fault::new(parameter.place, "a production has too many parameters", expected));
                return items;
            }
            scope.locals.push(parameter.name.clone());
        }
        let kind = kind(&formal.symbol, formal.parameters.len(), formal.place, context.symbols, faults);
        items.push(Item::Module(kind, first));
    }
    items
}

fn kind(symbol: &str, arity: usize, place: Place, symbols: &mut SymbolTable, faults: &mut Vec<Fault>) -> Kind {
    let was_full = symbols.is_full();
    let number = symbols.add(symbol);
    if arity > 0 && matches!(symbol, "[" | "]" | "%") {
        faults.push(Fault::new(place, format!("`{symbol}` has parameters"), "none"));
        return symbols.kind(number, 0);
    }
    let kind = symbols.kind(number, arity as u16);
    if symbols.is_full() && !was_full {
        let expected = format!("at most {MOST_SYMBOLS} symbols");
        faults.push(Fault::new(place, "the file has too many symbols", expected));
    }
    kind
}

/// In the papers' notation `[H]` in a right context is a branch that begins with H.
fn name_beginnings(right: &mut Vec<Item>) {
    let mut named = Vec::with_capacity(right.len());
    for item in right.drain(..) {
        let closes = matches!(item, Item::Module(CLOSE, _));
        if closes && named.last().is_some_and(|last| *last != Item::Rest) {
            named.push(Item::Rest);
        }
        named.push(item);
    }
    *right = named;
}

fn successor(
    modules: &[ModuleText],
    scope: &mut Scope,
    context: &mut Context<'_, '_>,
    faults: &mut Vec<Fault>,
) -> Box<[Made]> {
    let mut made = Vec::new();
    for module in modules {
        let kind = kind(&module.symbol, module.arguments.len(), module.place, context.symbols, faults);
        scope.open = module.symbol.starts_with('?');
        let arguments = module.arguments.iter().map(|argument| context.names.code(argument, scope, faults)).collect();
        scope.open = false;
        made.push(Made { kind, arguments, place: module.place, continues: None });
    }
    made.into()
}

/// A bracket that has no partner is a fault at its place.
fn check_balance(kinds: impl Iterator<Item = (Kind, Place)>, whole: Place, faults: &mut Vec<Fault>) {
    let mut open = Vec::new();
    for (kind, place) in kinds {
        match kind {
            OPEN => open.push(place),
            CLOSE if open.pop().is_none() => {
                faults.push(Fault::new(place, "`]` closes no branch", "`[` before it"));
                return;
            }
            _ => {}
        }
    }
    if let Some(place) = open.pop() {
        let place = if place == Place::default() { whole } else { place };
        faults.push(Fault::new(place, "`[` begins a branch that does not end", "`]` behind it"));
    }
}

/// Finds for each module of the predecessor the module of the successor as which it goes on.
fn go_on(strict: &[Formal], modules: &[ModuleText], made: &mut [Made], last: &[String]) {
    let mut depth = 0_usize;
    let mut outside = Vec::new();
    for (number, module) in modules.iter().enumerate() {
        match module.symbol.as_str() {
            "[" => depth += 1,
            "]" => depth = depth.saturating_sub(1),
            _ if depth == 0 => outside.push(number),
            _ => {}
        }
    }
    for (number, formal) in strict.iter().enumerate().take(usize::from(u8::MAX)) {
        let mut free =
            outside.iter().copied().filter(|&at| modules[at].symbol == formal.symbol && made[at].continues.is_none());
        let found = if last.contains(&formal.symbol) { free.next_back() } else { free.next() };
        if let Some(found) = found {
            made[found].continues = Some(number as u8);
        }
    }
}

/// Warns of productions whose predecessor has another number of parameters than all modules of its symbol.
pub(super) fn check_kinds(script: &Script, symbols: &SymbolTable, warnings: &mut Vec<Fault>) {
    let sections = [&script.rewriting, &script.decomposition, &script.homomorphism];
    let made = sections.iter().flat_map(|rules| &rules.rules).flat_map(|rule| rule.successor.iter());
    let kinds: BTreeSet<Kind> =
        made.chain(script.axiom.iter()).map(|made| made.kind).chain([OPEN, CLOSE, CUT]).collect();
    // How many parameters the modules of a symbol have.
    let mut arities: BTreeMap<Symbol, Vec<String>> = BTreeMap::new();
    for &(symbol, arity) in kinds.iter().filter_map(|kind| symbols.kinds().get(usize::from(kind.0))) {
        arities.entry(symbol).or_default().push(arity.to_string());
    }
    for rule in sections.iter().flat_map(|rules| &rules.rules) {
        let other = rule.strict.iter().chain(&rule.left).chain(&rule.right).find_map(|item| {
            let Item::Module(kind, _) = *item else { return None };
            let &(symbol, arity) = symbols.kinds().get(usize::from(kind.0)).filter(|_| !kinds.contains(&kind))?;
            Some((symbols.name(symbol), arity, arities.get(&symbol)?))
        });
        if let Some((name, arity, others)) = other {
            let problem = format!("no `{name}` has {arity} parameters, so this production never applies");
            warnings.push(Fault::new(rule.place, problem, others.join(" or ")));
        }
    }
}
