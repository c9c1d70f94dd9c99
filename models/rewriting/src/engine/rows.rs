//! Successors as rows: what a production makes of a single module takes its place in the string column by column, for
//! most of it is the same at every application.
//!
//! The string is the one that `pieces` and `placing` would make, to the number of each slot. Absent: which production
//! applies (`choose`), and successors that are decomposed or that stand for several modules.

use super::placing::Places;
use super::visits::{Visit, visits};
use crate::code::{Code, Item, Row, Rule, Script};
use crate::evaluate::{Machine, Result, halt};
use crate::string::{Identity, ModuleString, Slot};
use crate::symbol::{CLOSE, CUT, OPEN};

/// Lays out the successors of the productions that rewrite single modules, where nothing decomposes what they make.
pub(crate) fn lay_rows(script: &mut Script) {
    if !script.decomposition.rules.is_empty() {
        return;
    }
    let visits = visits(script);
    for rule in &mut script.rewriting.rules {
        rule.row = row(rule, &visits);
    }
}

fn row(rule: &Rule, visits: &[Visit]) -> Option<Row> {
    let ([Item::Module(..)], [_, ..]) = (&rule.strict[..], &rule.successor[..]) else { return None };
    let (mut values, mut first, mut computed) = (Vec::new(), Vec::new(), Vec::new());
    for (place, made) in (0..).zip(&rule.successor) {
        first.push(values.len() as u32);
        for (number, argument) in (0..).zip(&made.arguments) {
            match argument {
                Code::Number(number) if number.is_finite() => values.push(*number),
                _ => {
                    computed.push((values.len() as u32, place, number));
                    values.push(0.0);
                }
            }
        }
    }
    let (mut open, mut pairs) = (Vec::new(), Vec::new());
    let [mut active, mut updated, mut cuts] = [(); 3].map(|()| Vec::new());
    for (place, made) in (0..).zip(&rule.successor).skip(1) {
        match made.kind {
            OPEN => open.push(place),
            CLOSE => pairs.push((open.pop()?, place)),
            CUT => cuts.push(place),
            _ => {}
        }
        match visits.get(usize::from(made.kind.0)) {
            Some(Visit::InOrder) => active.push(place),
            Some(Visit::Updates) => updated.push(place),
            _ => {}
        }
    }
    // A bracket that comes first is paired where all are.
    let first_is_bracket = matches!(rule.successor[0].kind, OPEN | CLOSE);
    let kept = rule.successor.iter().position(|made| made.continues == Some(0));
    (open.is_empty() && !first_is_bracket).then(|| Row {
        kinds: rule.successor.iter().map(|made| made.kind).collect(),
        of_first: rule.successor[0].arguments.len(),
        values: values.into(),
        first: first.into(),
        computed: computed.into(),
        pairs: pairs.into(),
        active: active.into(),
        updated: updated.into(),
        cuts: cuts.into(),
        kept: kept.map(|place| place as u32),
    })
}

/// For each kind whether all its productions make rows.
pub(super) fn of_kinds(script: &Script) -> Vec<bool> {
    let rules = &script.rewriting;
    let all = |list: &Vec<u32>| list.iter().all(|rule| rules.rules[*rule as usize].row.is_some());
    rules.by_kind.iter().map(|list| !list.is_empty() && all(list)).collect()
}

/// The parameters of a successor, in place of what `values` held.
#[inline]
pub(super) fn compute(
    rule: &Rule,
    row: &Row,
    machine: &mut Machine<'_>,
    frame: &[f64],
    values: &mut Vec<f64>,
) -> Result<()> {
    values.clear();
    values.extend_from_slice(&row.values);
    for &(place, module, argument) in &row.computed {
        let made = &rule.successor[module as usize];
        let value = machine.value(&made.arguments[argument as usize], frame)?;
        if !value.is_finite() {
            return halt(made.place, format!("a parameter of a module becomes {value}"), "a finite number");
        }
        values[place as usize] = value;
    }
    Ok(())
}

/// Puts a successor of these parameters in the place of its predecessor, which is rewritten in the step.
#[inline]
pub(super) fn put(
    row: &Row,
    values: &[f64],
    (slot, identity): (Slot, Identity),
    step: u32,
    string: &mut ModuleString,
    places: &mut Places,
) {
    let made = |place: u32| match row.kept {
        Some(kept) if kept == place => identity,
        _ => {
            let key = identity.key.child(u64::from(step) << 40 | u64::from(place));
            Identity { key, birth: step, predecessor: identity.key }
        }
    };
    string.rewrite(slot, row.kinds[0], &values[..row.of_first], made(0));
    places.note(string, slot, row.kinds[0]);
    if row.kinds.len() == 1 {
        return;
    }
    if !string.is_dense() {
        let mut last = slot;
        for place in 1..row.kinds.len() {
            let first = row.first[place] as usize;
            let end = row.first.get(place + 1).map_or(values.len(), |next| *next as usize);
            last = string.insert(Some(last), row.kinds[place], &values[first..end], made(place as u32));
            places.note(string, last, row.kinds[place]);
        }
        return;
    }
    let of_first = row.of_first as u32;
    let first = row.first[1..].iter().map(|first| first - of_first);
    let keys = (1..row.kinds.len() as u32).map(|place| made(place).key);
    let others = (&row.kinds[1..], first, keys);
    let kept = row.kept.filter(|place| *place > 0).map(|place| (place - 1, identity));
    let start = string.insert_successor(slot, others, &values[row.of_first..], (identity.key, step), kept);
    let slot = |place: u32| start.later(place - 1);
    row.pairs.iter().for_each(|&(open, close)| string.pair(slot(open), slot(close)));
    places.active.extend(row.active.iter().map(|place| slot(*place)));
    places.updated.extend(row.updated.iter().map(|place| slot(*place)));
    places.cuts.extend(row.cuts.iter().map(|place| slot(*place)));
}
