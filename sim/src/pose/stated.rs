//! The forward scan of a plant whose headings a geometric model has stated, one an internode (Aono & Kunii 1984).
//!
//! The heading is taken as it stands; `up` is carried along from the parent by projection, so that it turns no more
//! than the heading does. Where the heading turns into `up` itself, the parent's own direction takes its place.
//! A heading that is missing, or no direction at all, is its parent's.

use super::bearing_frame;
use crate::clock::Tick;
use crate::plant::standing::begins_axis;
use crate::plant::{NodeId, Plant};
use crate::vector::Vector;

/// Below this square of its length a vector has no direction.
const NOTHING: f64 = 1e-12;

/// Poses the nodes that appeared by `age` and have no frame yet, one by one.
pub(super) fn follow_headings(plant: &mut Plant, age: Tick) {
    let posed = plant.frames.begin(plant.nodes.len(), plant.axes.len(), age);
    for node in 0..plant.nodes.len() {
        if (posed..=age).contains(&plant.nodes.birth[node]) {
            follow(plant, node);
        }
    }
}

fn follow(plant: &mut Plant, node: usize) {
    let axis = plant.nodes.axis[node];
    let parent = plant.nodes.parent[node];
    let (base, was, up) = if begins_axis(&plant.nodes, node) {
        let bearing = bearing_frame(plant, axis);
        (Vector::from(bearing.base), Vector::from(bearing.heading), Vector::from(bearing.up))
    } else {
        let frame = plant.frames.at(parent);
        (plant.frames.tips[axis.index()].base, Vector::from(frame.heading), Vector::from(frame.up))
    };
    let heading = stated(plant, NodeId(node as u32)).unwrap_or(was);
    let Plant { frames, nodes, .. } = plant;
    frames.base[node] = base.single();
    frames.heading[node] = heading.single();
    frames.up[node] = carried(up, was, heading).single();
    frames.tips[axis.index()].base = base + heading * f64::from(nodes.length[node]);
}

/// The stated heading of a node, where it is a direction.
fn stated(plant: &Plant, node: NodeId) -> Option<Vector> {
    let heading = Vector::from(*plant.stated_headings.get(node.index())?);
    let square = heading.dot(heading);
    (square > NOTHING && square.is_finite()).then(|| heading * (1.0 / square.sqrt()))
}

/// `up` of a parent with heading `was`, carried to a child with `heading`.
fn carried(up: Vector, was: Vector, heading: Vector) -> Vector {
    let along = up.dot(heading);
    let across = up - heading * along;
    let across = if across.dot(across) > NOTHING { across } else { was * -along.signum() };
    let across = across - heading * across.dot(heading);
    across * (1.0 / across.dot(across).sqrt())
}
