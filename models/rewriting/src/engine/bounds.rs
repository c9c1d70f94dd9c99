//! What a step works with, and the most that it may come to.
//!
//! A step stops with a fault where its string or its work would exceed the bounds, so that no text makes it run without
//! end. Absent: what a caller may set (`program`), and the counting of work (`evaluate`).

use crate::code::Script;
use crate::derived::Derived;
use crate::draws::Draws;
use crate::evaluate::Machine;
use crate::outside::Outside;
use phytomer_sim::random::PlantRandom;

/// The most that a derivation may come to.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bounds {
    pub modules: usize,
    pub rounds: u64,
}

/// What expressions and statements of a plant work with.
pub(super) fn machine<'m>(
    script: &'m Script,
    derived: &'m mut Derived,
    outside: &'m dyn Outside,
    random: &'m PlantRandom,
    bounds: Bounds,
) -> Machine<'m> {
    let (functions, arrays) = (&script.functions, &script.arrays);
    let step = derived.step;
    let draws = Draws::new(random);
    Machine { functions, arrays, outside, variables: &mut derived.variables, draws, step, rounds: bounds.rounds }
}
