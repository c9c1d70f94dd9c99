//! What productions have made and what is not yet in the string: modules with their parameters and identities.
//!
//! The parameters of all modules stand in one list, and each module knows where its own begin. Absent: where the
//! modules take their places (`placing`).

use crate::code::Rule;
use crate::evaluate::{Machine, Result, halt};
use crate::string::Identity;
use crate::symbol::Kind;
use phytomer_sim::key::LineageKey;

/// A module that is not in a string.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Piece {
    pub kind: Kind,
    /// Where its parameters begin, and how many they are.
    pub first: u32,
    pub arity: u16,
    pub identity: Identity,
}

/// Modules in a row.
#[derive(Debug, Default)]
pub(crate) struct Pieces {
    pub pieces: Vec<Piece>,
    pub parameters: Vec<f64>,
}

/// What a rewriting is known by: its step, and how many productions of the same step came before it in line.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Moment {
    pub step: u32,
    pub depth: u32,
}

impl Pieces {
    pub fn clear(&mut self) {
        self.pieces.clear();
        self.parameters.clear();
    }

    pub fn of(&self, piece: &Piece) -> &[f64] {
        &self.parameters[piece.first as usize..piece.first as usize + usize::from(piece.arity)]
    }

    pub fn push(&mut self, kind: Kind, parameters: &[f64], identity: Identity) {
        let first = self.parameters.len() as u32;
        self.parameters.extend_from_slice(parameters);
        self.pieces.push(Piece { kind, first, arity: parameters.len() as u16, identity });
    }

    /// Appends the successor of a production. `predecessors` are the modules that it rewrites, of which one may go on.
    #[inline]
    pub fn make(
        &mut self,
        rule: &Rule,
        machine: &mut Machine<'_>,
        frame: &[f64],
        predecessors: &[Identity],
        moment: Moment,
    ) -> Result<()> {
        let Some(first) = predecessors.first() else { return Ok(()) };
        let when = u64::from(moment.step) << 40 | u64::from(moment.depth) << 20;
        for (place, made) in rule.successor.iter().enumerate() {
            let start = self.parameters.len();
            for argument in &made.arguments {
                let value = machine.value(argument, frame)?;
                if !value.is_finite() {
                    return halt(made.place, format!("a parameter of a module becomes {value}"), "a finite number");
                }
                self.parameters.push(value);
            }
            let kept = made.continues.and_then(|number| predecessors.get(usize::from(number)));
            let identity = kept.copied().unwrap_or_else(|| Identity {
                key: first.key.child(when | place as u64),
                birth: moment.step,
                predecessor: first.key,
            });
            let arity = made.arguments.len() as u16;
            self.pieces.push(Piece { kind: made.kind, first: start as u32, arity, identity });
        }
        Ok(())
    }
}

/// The key of what a homomorphism draws at a place of a successor.
pub(super) fn drawn_key(of: LineageKey, place: usize) -> LineageKey {
    of.child(1 << 63 | place as u64)
}
