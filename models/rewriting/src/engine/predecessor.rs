//! The predecessor of a production in a string: whether it is there, and which modules it is.
//!
//! The modules of a predecessor of several stand one directly behind the other, brackets included. Absent: the contexts
//! beside the predecessor (`context`).

use super::context::{Anchor, bind};
use crate::code::{Item, Rule, Script};
use crate::evaluate::{Machine, Result};
use crate::string::{Identity, ModuleString, Slot};

/// Whether the predecessor and the contexts of a production are there.
#[inline]
pub(super) fn fits(
    rule: &Rule,
    script: &Script,
    string: &ModuleString,
    slot: Slot,
    machine: &mut Machine<'_>,
    frame: &mut [f64],
) -> Result<bool> {
    let mut last = slot;
    for (number, item) in rule.strict.iter().enumerate() {
        let Item::Module(kind, first) = *item else { return Ok(false) };
        if number > 0 {
            machine.spend(1, rule.place, "the looks at predecessors")?;
            let Some(next) = string.after(last) else { return Ok(false) };
            last = next;
        }
        if string.kind(last) != kind {
            return Ok(false);
        }
        bind(string.parameters(last), first, frame);
    }
    if rule.left.is_empty() && rule.right.is_empty() {
        return Ok(true);
    }
    Anchor { script, string, first: slot, last }.holds(rule, machine, frame)
}

/// The identities of the modules of a predecessor of several, and the last of them; none of a predecessor of one.
pub(super) fn predecessors(
    rule: &Rule,
    string: &ModuleString,
    slot: Slot,
    last: &mut Slot,
    parameters: &mut usize,
) -> Vec<Identity> {
    *parameters = parameters.saturating_sub(string.parameters(slot).len());
    if rule.strict.len() < 2 {
        return Vec::new();
    }
    let mut identities = vec![string.identity(slot)];
    for _ in 1..rule.strict.len() {
        let Some(next) = string.after(*last) else { break };
        *last = next;
        *parameters = parameters.saturating_sub(string.parameters(next).len());
        identities.push(string.identity(next));
    }
    identities
}
