//! The cut `%`: at the end of its step it goes, with all modules that follow it in its branch, before anything is
//! drawn.
//!
//! Branches that begin behind the cut go as a whole; the bracket that closes its own branch stays. Absent: which
//! modules are cuts (`placing`).

use crate::string::{ModuleString, Slot};
use crate::symbol::{CLOSE, CUT, OPEN};
use phytomer_sim::key::LineageKey;

/// Carries out the cuts at these slots. A cut that an earlier one has taken away is passed over. `gone` gets the keys
/// of what goes.
pub(super) fn cut(string: &mut ModuleString, cuts: &[Slot], gone: &mut Vec<LineageKey>) {
    for &slot in cuts {
        if !string.is_free(slot) && string.kind(slot) == CUT {
            cut_branch(string, slot, gone);
        }
    }
}

fn cut_branch(string: &mut ModuleString, cut: Slot, gone: &mut Vec<LineageKey>) {
    let (mut depth, mut at) = (0_usize, Some(cut));
    while let Some(slot) = at {
        let next = string.after(slot);
        match string.kind(slot) {
            CLOSE if depth == 0 => return,
            CLOSE => depth -= 1,
            OPEN => depth += 1,
            _ => {}
        }
        gone.push(string.identity(slot).key);
        string.remove(slot);
        at = next;
    }
}
