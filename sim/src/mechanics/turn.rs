//! The changes of a Newton step: each internode turns by its response, and its curvature changes by as much.
//!
//! The turn Φ of an internode is the turn of its base times the gain, plus its own. The part across its heading is
//! curvature; the part along the heading would be torsion, which is left out. The pose reads the curvatures on its way
//! from the base to the tips, so that turning and posing are one scan.

use super::loads::Response;
use crate::pose::bent::Curvature;
use crate::vector::Vector;

/// The largest turn of an internode in one step, rad. Far from equilibrium the step overshoots: a slender branch held
/// out level would turn by several radians.
const MOST: f64 = 0.6;

/// Curvatures without a change.
pub(super) struct Kept<'a>(pub &'a [[f32; 2]]);

impl Curvature for Kept<'_> {
    type Carried = ();

    #[inline]
    fn enter(&mut self, _: usize) {}

    #[inline]
    fn next(&mut self, (): (), node: usize, _: f64, _: [f32; 3], _: [f32; 3]) -> ((), [f32; 2]) {
        ((), self.0[node])
    }

    #[inline]
    fn leave(&mut self, (): (), _: usize) {}
}

/// The curvatures after one step.
pub(super) struct Turned<'a> {
    curvature: &'a mut [[f32; 2]],
    responses: &'a [Response],
    /// The turn at the base of each axis, or at the end of its last run.
    turns: &'a mut Vec<Vector>,
    largest: f64,
}

/// The state along an axis: the turn so far, and the square of the largest turn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turn {
    turn: Vector,
    largest: f64,
}

impl<'a> Turned<'a> {
    /// For a plant of `axes` axes; `turns` is scratch memory.
    pub fn new(
        curvature: &'a mut [[f32; 2]],
        responses: &'a [Response],
        turns: &'a mut Vec<Vector>,
        axes: usize,
    ) -> Self {
        turns.clear();
        turns.resize(axes, Vector::default());
        Self { curvature, responses, turns, largest: 0.0 }
    }

    /// The largest turn of any internode, rad.
    pub fn largest(&self) -> f64 {
        self.largest.sqrt()
    }
}

impl Curvature for Turned<'_> {
    type Carried = Turn;

    #[inline]
    fn enter(&mut self, axis: usize) -> Turn {
        Turn { turn: self.turns[axis], largest: 0.0 }
    }

    // Inlined into the scan of the pose, so that the turn stays in registers from internode to internode.
    #[inline(always)]
    fn next(
        &mut self,
        Turn { turn, largest }: Turn,
        node: usize,
        length: f64,
        heading: [f32; 3],
        up: [f32; 3],
    ) -> (Turn, [f32; 2]) {
        let Response { gain, turn: own } = self.responses[node];
        let (heading, up) = (Vector::from(heading), Vector::from(up));
        let axes = [up, heading.cross(up)];
        let more = f64::from(gain) - 1.0;
        let own = [more * turn.dot(axes[0]) + f64::from(own[0]), more * turn.dot(axes[1]) + f64::from(own[1])];
        let (turn, own) = held(turn, axes, own);
        let mut curvature = self.curvature[node];
        if length > 0.0 {
            let per_length = 1.0 / length;
            curvature = [
                (f64::from(curvature[0]) + own[0] * per_length) as f32,
                (f64::from(curvature[1]) + own[1] * per_length) as f32,
            ];
            self.curvature[node] = curvature;
        }
        (Turn { turn, largest: largest.max(turn.dot(turn)) }, curvature)
    }

    #[inline]
    fn leave(&mut self, carried: Turn, axis: usize) {
        self.turns[axis] = carried.turn;
        self.largest = self.largest.max(carried.largest);
    }
}

/// The turn after an internode's own turn, and its own turn, which is reduced so that the former stays within [`MOST`].
#[inline]
fn held(base: Vector, axes: [Vector; 2], own: [f64; 2]) -> (Vector, [f64; 2]) {
    let next = base + axes[0] * own[0] + axes[1] * own[1];
    let square = next.dot(next);
    if square <= MOST * MOST { (next, own) } else { shortened(base, axes, next * (MOST / square.sqrt())) }
}

#[cold]
fn shortened(base: Vector, axes: [Vector; 2], next: Vector) -> (Vector, [f64; 2]) {
    let own = axes.map(|axis| (next - base).dot(axis));
    (base + axes[0] * own[0] + axes[1] * own[1], own)
}
