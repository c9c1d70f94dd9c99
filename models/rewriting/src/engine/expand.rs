//! Productions within productions: decomposition, which works at once, and homomorphism, which is for drawing alone.
//!
//! A module is replaced, and what replaces it in turn, up to the maximum depth of the section, from the left to the
//! right. Contexts are those of the module of the string with which the expansion began.

use super::choose::{Frames, choose};
use super::context::{Anchor, bind};
use super::pieces::{Moment, Piece, Pieces, drawn_key};
use crate::code::{Item, Rule, Rules};
use crate::draws::For;
use crate::evaluate::{Machine, Result, halt};
use crate::fault::Place;
use crate::string::Identity;

/// A module that waits, and how many productions lie between it and the module of the string.
#[derive(Debug, Clone, Copy)]
struct Waiting {
    piece: Piece,
    depth: u32,
}

/// Where an expansion begins.
pub(crate) struct Root<'s> {
    pub anchor: Anchor<'s>,
    pub purpose: For,
    pub step: u32,
    /// The most modules that may wait, and an eighth of the parameters that they may have.
    pub most: usize,
    /// The place of what is told where no production of the section has been applied.
    pub place: Place,
}

/// Room for expansions.
#[derive(Debug, Default)]
pub(crate) struct Expansion {
    waiting: Vec<Waiting>,
    /// The parameters of the modules that wait, those of the next to come at the end.
    parameters: Vec<f64>,
    made: Pieces,
    frames: Frames,
    shown: Vec<f64>,
    /// The place of the production that was applied last.
    last: Option<Place>,
}

impl Expansion {
    /// Lets modules wait, the first to come first.
    pub fn begin(&mut self, pieces: &Pieces) {
        self.waiting.clear();
        self.parameters.clear();
        self.last = None;
        self.wait(pieces, 0);
    }

    fn wait(&mut self, pieces: &Pieces, depth: u32) {
        for piece in pieces.pieces.iter().rev() {
            let first = self.parameters.len() as u32;
            self.parameters.extend_from_slice(pieces.of(piece));
            self.waiting.push(Waiting { piece: Piece { first, ..*piece }, depth });
        }
    }

    /// Expands what waits, and shows each module that nothing replaces, with its depth and the place of the production
    /// that was applied last.
    pub fn run(
        &mut self,
        rules: &Rules,
        root: &Root<'_>,
        machine: &mut Machine<'_>,
        mut show: impl FnMut(&Piece, &[f64], u32, Place) -> Result<()>,
    ) -> Result<()> {
        while let Some(next) = self.waiting.pop() {
            if next.depth < rules.depth && self.replaces(&next, rules, root, machine)? {
                continue;
            }
            let first = next.piece.first as usize;
            self.shown.clear();
            self.shown.extend_from_slice(&self.parameters[first..]);
            self.parameters.truncate(first);
            show(&next.piece, &self.shown, next.depth, self.last.unwrap_or(root.place))?;
        }
        Ok(())
    }

    /// Replaces a module, if a production applies to it.
    fn replaces(&mut self, next: &Waiting, rules: &Rules, root: &Root<'_>, machine: &mut Machine<'_>) -> Result<bool> {
        let candidates = rules.of(next.piece.kind);
        if candidates.is_empty() {
            return Ok(false);
        }
        let step = if matches!(root.purpose, For::Homomorphism) { 0 } else { root.step };
        machine.draws.turn_to(next.piece.identity.key.child(u64::from(next.depth)), step, root.purpose);
        let Self { waiting, parameters, made, frames, .. } = self;
        let fits = |rule: &Rule, machine: &mut Machine<'_>, frame: &mut [f64]| {
            machine.spend(rule.strict.len() as u64, rule.place, "the looks at predecessors")?;
            let fits = bind_waiting(rule, next, waiting, parameters, frame);
            Ok(fits && root.anchor.holds(rule, machine, frame)?)
        };
        let Some(rule) = choose(rules, candidates, machine, frames, fits)? else { return Ok(false) };
        // A production within productions costs a round, so that those without end are told.
        machine.spend(16 + rule.successor.len() as u64, rule.place, "productions within productions")?;
        if waiting.len() + rule.successor.len() > root.most || parameters.len() > 8 * root.most {
            let problem = format!("more than {} modules, or eight times as many parameters, wait in a step", root.most);
            return halt(rule.place, problem, "fewer");
        }
        machine.run(&rule.after, &mut frames.frame)?;
        let before = waiting.len() + 1 - rule.strict.len();
        let others = waiting[before..].iter().rev().map(|other| other.piece.identity);
        let predecessors: Vec<Identity> = std::iter::once(next.piece.identity).chain(others).collect();
        made.clear();
        let moment = Moment { step: root.step, depth: next.depth + 1 };
        made.make(rule, machine, &frames.frame, &predecessors, moment)?;
        if matches!(root.purpose, For::Homomorphism) {
            for (place, piece) in made.pieces.iter_mut().enumerate() {
                let Identity { key, birth, .. } = next.piece.identity;
                piece.identity = Identity { key: drawn_key(key, place), birth, predecessor: key };
            }
        }
        let first = waiting.get(before).map_or(next.piece.first, |last| last.piece.first) as usize;
        waiting.truncate(before);
        parameters.truncate(first);
        let made = std::mem::take(&mut self.made);
        self.last = Some(rule.place);
        self.wait(&made, next.depth + 1);
        self.made = made;
        Ok(true)
    }
}

/// Whether the modules that come next are a predecessor; its parameters then stand in the frame.
fn bind_waiting(rule: &Rule, next: &Waiting, waiting: &[Waiting], parameters: &[f64], frame: &mut [f64]) -> bool {
    let of = |piece: &Piece| parameters.get(piece.first as usize..piece.first as usize + usize::from(piece.arity));
    let mut others = waiting.iter().rev();
    for (number, item) in rule.strict.iter().enumerate() {
        let Item::Module(kind, first) = *item else { return false };
        let module = if number == 0 { Some(next) } else { others.next().filter(|other| other.depth == next.depth) };
        let Some(module) = module.filter(|module| module.piece.kind == kind) else { return false };
        let Some(values) = of(&module.piece) else { return false };
        bind(values, first, frame);
    }
    true
}
