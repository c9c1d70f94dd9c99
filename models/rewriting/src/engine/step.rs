//! The axiom, and a derivation step: the blocks of the file around the rewriting of the string.
//!
//! The axiom is made as a successor of the seed, and is decomposed; `Start:` comes before it. A step is `StartEach:`,
//! the rewriting, `EndEach:`. Absent: the rewriting itself (`rewriting`).

use super::bounds::{Bounds, machine};
use super::pieces::{Moment, Pieces};
use super::placing::Places;
use super::rewriting::{Pass, rewrite};
use super::visits::visits;
use crate::code::{Act, Rule, Script};
use crate::derived::Derived;
use crate::draws::For;
use crate::evaluate::{Result, halt};
use crate::outside::Outside;
use crate::string::Identity;
use phytomer_sim::key::LineageKey;

/// The string of the axiom, with its decomposition.
pub(crate) fn sow(script: &Script, derived: &mut Derived, outside: &dyn Outside, bounds: Bounds) -> Result<()> {
    let random = derived.random.clone();
    run_block(script, &script.start, derived, outside, bounds)?;
    let mut pieces = Pieces::default();
    let mut machine = machine(script, derived, outside, &random, bounds);
    machine.draws.turn_to(LineageKey::SEED, 0, For::Rewriting);
    let seed = Identity { key: LineageKey::SEED, birth: 0, predecessor: LineageKey::SEED };
    let axiom = axiom_rule(script);
    pieces.make(&axiom, &mut machine, &[], &[seed], Moment { step: 0, depth: 0 })?;
    if pieces.pieces.len() > bounds.modules {
        return halt(script.place(), format!("the axiom has more than {} modules", bounds.modules), "a shorter axiom");
    }
    let Derived { string, active, updated, .. } = derived;
    let [noted, changed] = [&mut *active, &mut *updated].map(|list| {
        list.clear();
        std::mem::take(list)
    });
    let mut places = Places { visits: visits(script), active: noted, updated: changed, ..Places::default() };
    let mut last = None;
    for piece in &pieces.pieces {
        let slot = string.insert(last, piece.kind, pieces.of(piece), piece.identity);
        places.note(string, slot, piece.kind);
        last = Some(slot);
    }
    (*active, *updated) = (places.active, places.updated);
    rewrite(script, derived, outside, bounds, Pass::Decomposes(places.cuts))
}

/// Makes a step.
pub(crate) fn step(script: &Script, derived: &mut Derived, outside: &dyn Outside, bounds: Bounds) -> Result<()> {
    derived.step = derived.step.saturating_add(1);
    run_block(script, &script.start_each, derived, outside, bounds)?;
    rewrite(script, derived, outside, bounds, Pass::Rewrites)?;
    run_block(script, &script.end_each, derived, outside, bounds)
}

/// Carries out a block of the file.
pub(crate) fn run_block(
    script: &Script,
    acts: &[Act],
    derived: &mut Derived,
    outside: &dyn Outside,
    bounds: Bounds,
) -> Result<()> {
    let random = derived.random.clone();
    let mut machine = machine(script, derived, outside, &random, bounds);
    machine.draws.turn_to(LineageKey::SEED, machine.step, For::Block);
    machine.run(acts, &mut [])
}

/// The axiom as what becomes of the seed.
fn axiom_rule(script: &Script) -> Rule {
    Rule {
        place: script.place(),
        left: Box::default(),
        strict: Box::default(),
        right: Box::default(),
        before: Box::default(),
        condition: None,
        after: Box::default(),
        successor: script.axiom.clone(),
        weight: None,
        locals: 0,
        cost: 1,
        row: None,
    }
}
