//! Which modules a step visits, and how: those that a production may rewrite in the order of the string, and those of
//! which it only changes the parameters in the order of their slots, which is that of the memory.
//!
//! What changes parameters alone, with no draw and no variable of the file, has the same result in any order, unless a
//! production looks at these parameters: as a context, or as a later module of its predecessor.

use crate::code::{Code, Item, Rule, Rules, Script};
use crate::evaluate::{Machine, Result, halt};
use crate::string::{ModuleString, Slot};

/// How a step visits the modules of a kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Visit {
    /// Nothing rewrites them.
    #[default]
    Never,
    /// In the order of the string.
    InOrder,
    /// In any order: their parameters change alone.
    Updates,
}

/// For each kind how a step visits its modules.
pub(super) fn visits(script: &Script) -> Vec<Visit> {
    let rules = [&script.rewriting, &script.decomposition];
    let most = rules.iter().map(|rules| rules.by_kind.len()).max().unwrap_or(0);
    let has = |kind: usize| rules.iter().any(|rules| rules.by_kind.get(kind).is_some_and(|list| !list.is_empty()));
    let updates = updates(script, true);
    let looked_at = looked_at(&script.rewriting);
    let of = |kind: usize| {
        let update = updates.get(kind).copied().flatten().filter(|_| !looked_at.contains(&kind));
        match update {
            Some(rule) if rule.successor.iter().all(|made| made.arguments.iter().all(is_pure)) => Visit::Updates,
            _ if has(kind) => Visit::InOrder,
            _ => Visit::Never,
        }
    };
    (0..most).map(of).collect()
}

/// The kinds that stand behind the first module of a predecessor.
fn looked_at(rules: &Rules) -> Vec<usize> {
    let behind = rules.rules.iter().flat_map(|rule| rule.strict.iter().skip(1));
    let mut kinds: Vec<usize> = behind
        .filter_map(|item| match item {
            Item::Module(kind, _) => Some(usize::from(kind.0)),
            Item::Rest => None,
        })
        .collect();
    kinds.sort_unstable();
    kinds.dedup();
    kinds
}

/// Whether an expression has a value that depends on its parameters and the step alone, and does nothing.
fn is_pure(code: &Code) -> bool {
    match code {
        Code::Number(_) | Code::Local(_) | Code::Step => true,
        Code::Negative(inner) | Code::Not(inner) => is_pure(inner),
        Code::Binary(_, pair) => is_pure(&pair.0) && is_pure(&pair.1),
        Code::Choice(three) => is_pure(&three.0) && is_pure(&three.1) && is_pure(&three.2),
        Code::Call(builtin, arguments, _) => !builtin.draws() && arguments.iter().all(is_pure),
        _ => false,
    }
}

/// The production of a kind, where it has one that always applies.
pub(super) fn certain(rules: &Rules, kind: usize) -> Option<&Rule> {
    let list = rules.by_kind.get(kind)?;
    let rule = list.first().map(|&rule| &rules.rules[rule as usize])?;
    (rule.is_certain() && (list.len() == 1 || !rules.compete)).then_some(rule)
}

/// For each kind the production that only changes its parameters, whatever stands around it; none where contexts may
/// look at them.
pub(super) fn updates(script: &Script, rewrites: bool) -> Vec<Option<&Rule>> {
    let looks = script.rewriting.looks || script.decomposition.looks;
    if !rewrites || looks || !script.decomposition.rules.is_empty() {
        return Vec::new();
    }
    let of = |kind: usize| {
        let rule = certain(&script.rewriting, kind).filter(|rule| rule.after.is_empty())?;
        let [made] = &rule.successor[..] else { return None };
        (usize::from(made.kind.0) == kind && made.continues == Some(0)).then_some(rule)
    };
    (0..script.rewriting.by_kind.len()).map(of).collect()
}

/// Changes the parameters of a module where it stands; `values` is room for them.
#[inline]
pub(super) fn update(
    rule: &Rule,
    slot: Slot,
    string: &mut ModuleString,
    machine: &mut Machine<'_>,
    values: &mut Vec<f64>,
) -> Result<()> {
    let [made] = &rule.successor[..] else { return Ok(()) };
    machine.spend(rule.cost, rule.place, "the trials of productions")?;
    values.clear();
    for argument in &made.arguments {
        let value = machine.value(argument, string.parameters(slot))?;
        if !value.is_finite() {
            return halt(made.place, format!("a parameter of a module becomes {value}"), "a finite number");
        }
        values.push(value);
    }
    string.set_parameters(slot, values);
    Ok(())
}
