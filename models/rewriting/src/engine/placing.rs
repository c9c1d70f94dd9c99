//! What a step has made takes its place in the string.
//!
//! The first module of a successor takes the slot of the predecessor, the others are put behind it. New brackets are
//! paired, and cuts and modules that the next step visits are noted. Absent: what is made (`rewriting`).

use super::pieces::Pieces;
use super::visits::Visit;
use crate::string::{ModuleString, Slot};
use crate::symbol::{CLOSE, CUT, Kind, OPEN};

/// What is to become of a module and, with several in a predecessor, of those behind it.
pub(super) struct Change {
    pub slot: Slot,
    /// How many modules are rewritten; 0 where the module stays as it is.
    pub rewritten: u32,
    pub pieces: std::ops::Range<u32>,
}

/// What is noted of a string while its modules take their places.
#[derive(Debug, Default)]
pub(super) struct Places {
    /// For each kind how a step visits its modules.
    pub visits: Vec<Visit>,
    /// The modules that the next step visits in their order, and those of which it changes the parameters alone.
    pub active: Vec<Slot>,
    pub updated: Vec<Slot>,
    /// The modules `%`.
    pub cuts: Vec<Slot>,
    /// The branches that are open.
    pub open: Vec<Slot>,
}

impl Places {
    /// Notes a module of a kind that is new in its place.
    #[inline]
    pub fn note(&mut self, string: &mut ModuleString, slot: Slot, kind: Kind) {
        match kind {
            OPEN => self.open.push(slot),
            CLOSE => {
                if let Some(partner) = self.open.pop() {
                    string.pair(partner, slot);
                }
            }
            CUT => self.cuts.push(slot),
            _ => {}
        }
        match self.visits.get(usize::from(kind.0)) {
            Some(Visit::InOrder) => self.active.push(slot),
            Some(Visit::Updates) => self.updated.push(slot),
            _ => {}
        }
    }

    /// Puts what a module has become in its place.
    #[inline]
    pub fn carry_out(&mut self, change: &Change, made: &Pieces, string: &mut ModuleString) {
        let slot = change.slot;
        if change.rewritten == 0 {
            self.active.push(slot);
            return;
        }
        for _ in 1..change.rewritten {
            if let Some(next) = string.after(slot) {
                string.remove(next);
            }
        }
        let pieces = &made.pieces[change.pieces.start as usize..change.pieces.end as usize];
        let Some((first, others)) = pieces.split_first() else {
            string.remove(slot);
            return;
        };
        string.rewrite(slot, first.kind, made.of(first), first.identity);
        self.note(string, slot, first.kind);
        if string.is_dense()
            && let Some(second) = others.first()
        {
            let base = second.first;
            let end = others.last().map_or(base, |last| last.first + u32::from(last.arity));
            let row = others.iter().map(|piece| (piece.kind, piece.first - base, piece.identity));
            let start = string.insert_row(slot, row, &made.parameters[base as usize..end as usize]);
            (0_u32..).zip(others).for_each(|(number, piece)| self.note(string, start.later(number), piece.kind));
            return;
        }
        let mut last = slot;
        for piece in others {
            last = string.insert(Some(last), piece.kind, made.of(piece), piece.identity);
            self.note(string, last, piece.kind);
        }
    }
}

/// How many of the next modules to visit are rewritten with this one.
pub(super) fn also_rewritten(change: &Change, next: &[Slot], string: &ModuleString) -> usize {
    let (mut at, mut count) = (change.slot, 0);
    for _ in 1..change.rewritten {
        let Some(after) = string.after(at) else { break };
        at = after;
        count += usize::from(next.get(count) == Some(&at));
    }
    count
}
