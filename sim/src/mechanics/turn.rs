//! The forward scan of a Newton step: each internode turns as it answered, and its curvature changes by as much.
//!
//! The turn Φ of an internode is that of its base times the gain, plus its own. What it adds across its heading is
//! curvature; what it would add along the heading is torsion, which internodes do not take.

use super::loads::Response;
use crate::plant::Plant;
use crate::plant::borne::{Borne, Up};
use crate::plant::standing::{Run, Standing};
use crate::vector::Vector;

/// The most that any internode turns in one step, rad. Far from rest the step overshoots: a slender branch held out
/// level would turn by several radians.
const MOST: f64 = 0.6;

/// Writes the curvatures after one step; the largest turn of any internode, rad. `turns` is scratch, one entry an axis.
pub(super) fn turn(
    plant: &mut Plant,
    standing: &Standing,
    laterals: &Borne,
    responses: &[Response],
    turns: &mut Vec<Vector>,
) -> f64 {
    turns.clear();
    turns.resize(plant.axes.len(), Vector::default());
    let bearers = std::mem::take(&mut plant.axes.bearer);
    let mut borne = Up::new(laterals, &bearers);
    let mut largest = 0.0_f64;
    for run in &standing.runs {
        largest = largest.max(turn_run(plant, run, &mut borne, responses, turns));
    }
    plant.axes.bearer = bearers;
    largest.sqrt()
}

/// The square of the largest turn.
#[inline]
fn turn_run(plant: &mut Plant, run: &Run, borne: &mut Up<'_>, responses: &[Response], turns: &mut [Vector]) -> f64 {
    let Plant { frames, nodes, strain, .. } = plant;
    let mut turned = turns[run.axis.index()];
    let mut largest = 0.0_f64;
    for node in run.nodes() {
        let Response { gain, turn } = responses[node];
        let (heading, up) = (Vector::from(frames.heading[node]), Vector::from(frames.up[node]));
        let axes = [up, heading.cross(up)];
        let more = f64::from(gain) - 1.0;
        let own = [0, 1].map(|k| more * turned.dot(axes[k]) + f64::from(turn[k]));
        let (next, own) = held(turned, axes, own);
        turned = next;
        let per_length = 1.0 / f64::from(nodes.length[node]);
        if per_length.is_finite() {
            let curvature = &mut strain.curvature[node];
            *curvature = [0, 1].map(|k| (f64::from(curvature[k]) + own[k] * per_length) as f32);
        }
        largest = largest.max(turned.dot(turned));
        while let Some(axis) = borne.on(node) {
            turns[axis] = turned;
        }
    }
    turns[run.axis.index()] = turned;
    largest
}

/// The turn after an internode's own, and the latter, so that the former stays within the most.
#[inline]
fn held(base: Vector, axes: [Vector; 2], own: [f64; 2]) -> (Vector, [f64; 2]) {
    let next = base + axes[0] * own[0] + axes[1] * own[1];
    let square = next.dot(next);
    if square <= MOST * MOST {
        return (next, own);
    }
    let shorter = next * (MOST / square.sqrt()) - base;
    let own = axes.map(|axis| shorter.dot(axis));
    (base + axes[0] * own[0] + axes[1] * own[1], own)
}
