//! The internodes and axes of a plant that grows into space: each internode a straight segment with a stated heading.
//!
//! A tip that goes straight on continues its axis; what leaves it is an axis of the next order. Absent: where a tip
//! goes.

use phytomer_sim::clock::Tick;
use phytomer_sim::model::Overgrown;
use phytomer_sim::plant::key::Place;
use phytomer_sim::plant::{
    AxisId, EventKind, Habit, Looks, NewAxis, NewNode, NodeId, Origin, Plant, Rest, Shape, Trend,
};

/// The end of an axis, from which it may go on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tip {
    /// The last node; [`NodeId::NONE`] of a seed.
    pub node: NodeId,
    pub axis: AxisId,
    /// The rank of the last node, 0 of a seed.
    pub rank: u32,
}

impl Tip {
    /// The tip of a plant that is sown.
    pub const SEED: Self = Self { node: NodeId::NONE, axis: AxisId::TRUNK, rank: 0 };
}

/// A tip that grows in space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Growing {
    pub tip: Tip,
    /// Where it is, metres from the seed.
    pub at: [f64; 3],
    /// Where it grows to: a direction of length 1.
    pub heading: [f64; 3],
}

impl Growing {
    /// The tip of a plant that is sown, which grows upwards.
    pub const SEED: Self = Self { tip: Tip::SEED, at: [0.0; 3], heading: [0.0, 0.0, 1.0] };
}

/// A straight internode.
#[derive(Debug, Clone, Copy)]
pub(super) struct Segment {
    /// A unit vector.
    pub heading: [f64; 3],
    /// Metres.
    pub length: f64,
    /// Metres.
    pub diameter: f64,
    /// The tick at which it appears.
    pub birth: Tick,
}

/// What plants of these models carry: straight cylinders.
pub(super) fn habit() -> Habit {
    Habit { trends: vec![Trend::STRAIGHT], looks: Looks::of_shape(Shape::Cylinder), ..Habit::default() }
}

/// Lengthens the axis of a tip by a segment; the new tip.
///
/// # Errors
/// [`Overgrown`] where the plant has no room for it.
pub(super) fn lengthen(plant: &mut Plant, tip: &Tip, segment: &Segment) -> Result<Tip, Overgrown> {
    room(plant, 1)?;
    Ok(add(plant, tip, tip.axis, tip.rank + 1, segment))
}

/// Begins an axis of the next order at a tip, with its first segment; the new tip. `position` is the number of the axis
/// among those of the node, which has it from no other.
///
/// # Errors
/// [`Overgrown`] where the plant has no room for both.
pub(super) fn branch(plant: &mut Plant, tip: &Tip, position: u16, segment: &Segment) -> Result<Tip, Overgrown> {
    room(plant, 2)?;
    let bearing = tip.axis.index();
    let key = plant.axes.key[bearing];
    let order = plant.axes.order[bearing];
    // At the greatest order that a column holds an axis divides into axes of its own order.
    let (origin, place, event, order) = match order.checked_add(1) {
        Some(next) => (Origin::Axillary, Place::Axillary(position), EventKind::Branched, next),
        None => (Origin::Fork, Place::Fork(position), EventKind::Forked, order),
    };
    let axis = plant.add_axis(NewAxis {
        bearer: Some(tip.node),
        key: key.child(place.on(tip.rank)),
        order,
        origin,
        position,
        appearance: segment.birth,
        birth: segment.birth,
        ..NewAxis::OF_THE_SEED
    });
    plant.note(segment.birth, axis, event, 1);
    Ok(add(plant, tip, axis, 1, segment))
}

fn room(plant: &Plant, more: u32) -> Result<(), Overgrown> {
    let limit = Overgrown::of(plant);
    plant.has_room_for(more).then_some(()).ok_or(limit)
}

fn add(plant: &mut Plant, tip: &Tip, axis: AxisId, rank: u32, segment: &Segment) -> Tip {
    let node = plant.add_node(NewNode {
        parent: tip.node,
        axis,
        birth: segment.birth,
        rank,
        unit_rank: 1,
        short: false,
        neoformed: false,
        trend: 0,
        length: segment.length as f32,
        diameter: segment.diameter as f32,
        azimuth: 0.0,
    });
    plant.state_rest(node, Rest::Heading(segment.heading.map(|x| x as f32)));
    plant.note(segment.birth, axis, EventKind::Grew, 1);
    Tip { node, axis, rank }
}

/// Gives each internode the diameter that it appeared with.
pub(super) fn keep_diameters(plant: &mut Plant) {
    let nodes = &mut plant.nodes;
    nodes.diameter.copy_from_slice(&nodes.primary_diameter);
    nodes.diameter_tip.copy_from_slice(&nodes.primary_diameter);
}
