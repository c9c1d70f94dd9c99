//! Contexts of a module in a bracketed string (Prusinkiewicz & Lindenmayer 1990 §1.8), as cpfg looks at them.
//!
//! To the left the look goes out through `[` and past finished branches; to the right past branches that the context
//! does not name. Modules that `consider:` does not name, or that `ignore:` names, are passed over; where brackets are
//! passed over so, the look goes into branches. `[X=]` is a branch that begins with X. A ring goes on at its other end.

use crate::code::{Item, Rule, Script};
use crate::evaluate::{Machine, Result};
use crate::string::{ModuleString, Slot};
use crate::symbol::{CLOSE, OPEN};

/// The modules between which contexts lie: the first and the last of a predecessor in its string.
#[derive(Clone, Copy)]
pub(crate) struct Anchor<'s> {
    pub script: &'s Script,
    pub string: &'s ModuleString,
    pub first: Slot,
    pub last: Slot,
}

impl Anchor<'_> {
    /// Whether both contexts of a rule are there; their parameters then stand in the frame.
    pub fn holds(&self, rule: &Rule, machine: &mut Machine<'_>, frame: &mut [f64]) -> Result<bool> {
        let mut passed = 0;
        let holds = self.right(&rule.right, frame, &mut passed) && self.left(&rule.left, frame, &mut passed);
        if passed > 0 {
            machine.spend(passed, rule.place, "the looks at contexts")?;
        }
        Ok(holds)
    }

    fn is_visible(&self, slot: Slot) -> bool {
        self.script.visible.get(usize::from(self.string.kind(slot).0)).copied().unwrap_or(true)
    }

    /// The module behind `slot`; in a ring the first follows the last, until the look has gone round.
    fn after(&self, slot: Slot, passed: u64) -> Option<Slot> {
        let round = self.script.ring && passed <= 2 * self.string.len() as u64;
        self.string.after(slot).or_else(|| self.string.first_slot().filter(|_| round))
    }

    fn before(&self, slot: Slot, passed: u64) -> Option<Slot> {
        let round = self.script.ring && passed <= 2 * self.string.len() as u64;
        self.string.before(slot).or_else(|| self.string.last_slot().filter(|_| round))
    }

    fn right(&self, items: &[Item], frame: &mut [f64], passed: &mut u64) -> bool {
        let (string, mut at) = (self.string, self.last);
        for item in items {
            let Item::Module(kind, first) = *item else {
                at = self.end_of_branch(at, passed);
                continue;
            };
            loop {
                *passed += 1;
                let Some(next) = self.after(at, *passed) else { return false };
                at = next;
                if !self.is_visible(at) {
                    continue;
                }
                if string.kind(at) == OPEN && kind != OPEN {
                    at = string.partner(at).unwrap_or(at);
                    continue;
                }
                if string.kind(at) != kind {
                    return false;
                }
                break;
            }
            bind(string.parameters(at), first, frame);
        }
        true
    }

    /// The last module of the branch that goes on behind `at`.
    fn end_of_branch(&self, mut at: Slot, passed: &mut u64) -> Slot {
        while let Some(next) = self.string.after(at) {
            *passed += 1;
            match self.string.kind(next) {
                CLOSE => return at,
                OPEN => at = self.string.partner(next).unwrap_or(next),
                _ => at = next,
            }
        }
        at
    }

    fn left(&self, items: &[Item], frame: &mut [f64], passed: &mut u64) -> bool {
        let (string, mut at) = (self.string, self.first);
        for item in items {
            let Item::Module(kind, first) = *item else { return false };
            loop {
                *passed += 1;
                let Some(next) = self.before(at, *passed) else { return false };
                at = next;
                if !self.is_visible(at) || (string.kind(at) == OPEN && kind != OPEN) {
                    continue;
                }
                if string.kind(at) == CLOSE && kind != CLOSE {
                    at = string.partner(at).unwrap_or(at);
                    continue;
                }
                if string.kind(at) != kind {
                    return false;
                }
                break;
            }
            bind(string.parameters(at), first, frame);
        }
        true
    }
}

/// Makes parameters variables of a production.
#[inline]
pub(super) fn bind(parameters: &[f64], first: u16, frame: &mut [f64]) {
    let first = usize::from(first);
    if let Some(variables) = frame.get_mut(first..first + parameters.len()) {
        variables.copy_from_slice(parameters);
    }
}
