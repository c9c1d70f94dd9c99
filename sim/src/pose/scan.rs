//! The forward scan of a plant whose headings follow from insertion, phyllotaxis and trend.
//!
//! Runs of nodes that follow one another on one axis are the unit of work: base and slope stay in registers as f64 and
//! are rounded to f32 only where they are stored. Where an axis goes on later, it goes on from its [`Tip`], so that the
//! frames are the same bits whether axes were grown one by one or tick by tick. An axis starts from the stored f32
//! frame of its bearing node: 40 m from the seed that is 2 µm, once an order.

use super::course::{Plane, Slope};
use super::vector::Vector;
use super::{Frames, start_frame};
use crate::plant::{AxisId, Nodes, Plant, Trend};
use std::ops::Range;

/// Where an axis goes on from.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Tip {
    /// The end of its last internode, metres.
    pub base: Vector,
    /// The direction of its last internode.
    pub slope: Slope,
}

/// Poses the nodes that have no frame yet, run by run.
pub(super) fn follow_trends(plant: &mut Plant) {
    let nodes = plant.nodes.len();
    plant.frames.reserve(nodes);
    plant.frames.tips.resize(plant.axes.len(), Tip::default());
    let mut node = plant.frames.base.len();
    while node < nodes {
        let axis = plant.nodes.axis[node];
        let run = node..end_of_run(&plant.nodes, node);
        node = run.end;
        follow_axis(plant, axis, run);
    }
}

/// The first node after `node` that is not the next of the same axis.
#[inline]
fn end_of_run(nodes: &Nodes, node: usize) -> usize {
    let axis = nodes.axis[node];
    node + nodes.axis[node..].iter().take_while(|&&other| other == axis).count()
}

#[inline]
fn follow_axis(plant: &mut Plant, axis: AxisId, run: Range<usize>) {
    let start = start_frame(plant, axis);
    let (plane, slope) = Plane::of(&start);
    let Plant { nodes, frames, habit, .. } = plant;
    let tip = if begins_axis(nodes, run.start) {
        let tip = Tip { base: Vector::from(start.base), slope };
        let tip = extend(frames, nodes, &[], &plane, tip, run.start..run.start + 1);
        extend(frames, nodes, &habit.trends, &plane, tip, run.start + 1..run.end)
    } else {
        extend(frames, nodes, &habit.trends, &plane, frames.tips[axis.index()], run)
    };
    frames.tips[axis.index()] = tip;
}

/// Whether a node is the first of its axis: its parent is not on it.
#[inline]
pub(super) fn begins_axis(nodes: &Nodes, node: usize) -> bool {
    nodes.parent[node].some().is_none_or(|parent| nodes.axis[parent.index()] != nodes.axis[node])
}

/// Appends the frames of a run that goes on from `tip`; a node whose trend is not in `trends` goes straight on.
#[inline]
fn extend(frames: &mut Frames, nodes: &Nodes, trends: &[Trend], plane: &Plane, tip: Tip, run: Range<usize>) -> Tip {
    let Tip { mut base, mut slope } = tip;
    let (mut heading, mut up) = (plane.heading(slope), plane.up(slope));
    let (mut heading_32, mut up_32) = (heading.single(), up.single());
    for (&trend, &length) in nodes.trend[run.clone()].iter().zip(&nodes.length[run]) {
        if let Some(trend) = trends.get(usize::from(trend)).filter(|trend| trend.share > 0.0) {
            slope = slope.turned(trend);
            (heading, up) = (plane.heading(slope), plane.up(slope));
            (heading_32, up_32) = (heading.single(), up.single());
        }
        frames.base.push(base.single());
        frames.heading.push(heading_32);
        frames.up.push(up_32);
        base = base + heading * f64::from(length);
    }
    Tip { base, slope }
}
