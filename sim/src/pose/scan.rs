//! The forward scan of a plant whose headings follow from insertion, phyllotaxis and trend.
//!
//! Runs of nodes that follow one another on one axis are the unit of work: base and slope stay in registers as f64 and
//! are rounded to f32 only where they are stored. Where an axis goes on later, it goes on from its [`Tip`], so that the
//! frames are the same bits whether axes were grown one by one or tick by tick. An axis starts from the stored f32
//! frame of its bearing node: 40 m from the seed that is 2 µm, once an order.

use super::course::{Plane, Slope};
use super::{Frames, start_frame};
use crate::clock::Tick;
use crate::plant::standing::begins_axis;
use crate::plant::{AxisId, Nodes, Plant, Trend};
use crate::vector::Vector;
use std::ops::Range;

/// Where an axis goes on from.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Tip {
    /// The end of its last internode, metres.
    pub base: Vector,
    /// The direction of its last internode.
    pub slope: Slope,
}

/// Poses the nodes that appeared by `age` and have no frame yet, run by run.
pub(super) fn follow_trends(plant: &mut Plant, age: Tick) {
    let posed = plant.frames.begin(plant.nodes.len(), plant.axes.len(), age);
    let mut appeared = std::mem::take(&mut plant.appeared);
    for stretch in appeared.by(age, &plant.nodes) {
        let born = stretch.nodes();
        let birth = &plant.nodes.birth[born.clone()];
        let old = if birth[0] < posed { birth.partition_point(|&birth| birth < posed) } else { 0 };
        if old < born.len() {
            follow_axis(plant, stretch.axis, born.start + old..born.end);
        }
    }
    plant.appeared = appeared;
}

#[inline]
fn follow_axis(plant: &mut Plant, axis: AxisId, run: Range<usize>) {
    let start = start_frame(plant, axis);
    let (plane, slope) = Plane::of(&start);
    let Plant { nodes, frames, habit, own_trends, .. } = plant;
    let trends = own_trends.of(axis).unwrap_or(&habit.trends);
    let begins = begins_axis(nodes, run.start);
    let tip = if begins { Tip { base: Vector::from(start.base), slope } } else { frames.tips[axis.index()] };
    frames.tips[axis.index()] = extend(frames, nodes, trends, &plane, tip, run, begins);
}

/// Writes the frames of a run that goes on from `tip`, on an axis of the given trends. The first node of an axis, and
/// one whose trend is not among them, goes straight on.
#[inline]
fn extend(
    frames: &mut Frames,
    nodes: &Nodes,
    trends: &[Trend],
    plane: &Plane,
    tip: Tip,
    run: Range<usize>,
    begins: bool,
) -> Tip {
    let Tip { mut base, mut slope } = tip;
    let mut heading = plane.heading(slope);
    let (mut stored, mut straight) = ((heading.single(), plane.up(slope).single()), begins);
    let columns = frames.base[run.clone()].iter_mut().zip(&mut frames.heading[run.clone()]);
    let columns = columns.zip(&mut frames.up[run.clone()]).zip(&nodes.length[run.clone()]);
    for ((((at, along), up), &length), &trend) in columns.zip(&nodes.trend[run]) {
        let turn = trends.get(usize::from(trend)).filter(|trend| trend.share > 0.0 && !straight);
        if let Some(trend) = turn {
            slope = slope.turned(trend);
            heading = plane.heading(slope);
            stored = (heading.single(), plane.up(slope).single());
        }
        straight = false;
        *at = base.single();
        (*along, *up) = stored;
        base = base + heading * f64::from(length);
    }
    Tip { base, slope }
}
