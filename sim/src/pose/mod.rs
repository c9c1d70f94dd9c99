//! The frame of each component: computed from rest geometry in one forward scan (de Reffye 1988 §4, Fig. 15).
//!
//! A frame is a base point, a heading along the internode and a reference direction `up` across it. The direction at
//! azimuth φ is cos φ · up + sin φ · (heading × up). An axis that leaves at azimuth φ and insertion angle β from a
//! heading h with the direction d at φ has the heading cos β · h + sin β · d and the upper side sin β · h − cos β · d;
//! its internodes then turn towards its trend (`course`). Other models state rest frames (`rest`); the same scans
//! follow both. The seed is the origin of all frames, so that precision does not depend on the place in a plot. Absent:
//! the columns of the pose, which are the plant's; bending, which is the work of mechanics.

mod ahead;
pub(crate) mod bent;
mod course;
pub(crate) mod organs;
mod rest;
mod scan;

use crate::clock::Tick;
use crate::plant::frames::{Stated, Trended};
use crate::plant::stated::{Part, Rest};
use crate::plant::{AxisId, NodeId, Plant};
use crate::vector::Vector;

pub use crate::plant::frames::{Frame, Frames};
pub use ahead::{Ahead, Onward};
pub use organs::{OrganInputs, organ_follows_from, organ_frame, stated_organ_frame};

/// Poses every internode of `plant` that appeared by `age` and has no frame yet. Other frames stay: the pose at rest of
/// a node depends on the nodes before it alone, and to the last bit neither on the order in which the axes grew nor on
/// how often the plant was posed. Where a rest frame or a length has changed since the age of the frames, all frames
/// are made anew. Linear in the internodes posed.
pub fn pose(plant: &mut Plant, age: Tick) {
    if plant.frames.posed > 0 && is_stale(plant, age) {
        plant.frames.clear();
    }
    if age < plant.frames.posed {
        return;
    }
    plant.measure(age);
    if plant.stated.is_empty() {
        scan::follow::<Trended>(plant, age);
    } else {
        scan::follow::<Stated>(plant, age);
    }
}

/// Makes every frame of a plant that does not bend anew, with the lengths that its frames have.
pub(crate) fn pose_anew(plant: &mut Plant, age: Tick) {
    plant.frames.make_anew();
    pose(plant, age);
}

/// Whether the frames are not those of `age`: a rest frame or a length differs, or the first frame was stated after
/// they were made.
fn is_stale(plant: &Plant, age: Tick) -> bool {
    let Plant { stated, frames, .. } = plant;
    let newly = !stated.is_empty() && frames.courses.is_empty();
    newly || stated.differ(frames.age, age) || plant.lengths_differ(frames.age, age)
}

/// The frame at the tip of an internode, where its node is: the directions of the internode, its end as the base.
#[inline]
pub fn node_frame(plant: &Plant, node: NodeId) -> Frame {
    plant.frames.at(node).advanced(plant.posed_length(node))
}

/// The height of the highest tip of an internode that stands at `age`, above the seed, metres; 0 where none does. The
/// internodes must be posed.
pub fn height(plant: &Plant, age: Tick) -> f32 {
    let mut highest = 0.0_f32;
    plant.each_standing(age, |stretch| {
        for node in stretch.nodes() {
            highest = highest.max(node_frame(plant, NodeId(node as u32)).base[2]);
        }
    });
    highest
}

/// The pose of the bud of an axis before its first node: on its bearing node, in the direction of its insertion, or as
/// its rest frame is stated. In a plant that is bent the bearer counts as straight.
pub fn start_frame(plant: &Plant, axis: AxisId) -> Frame {
    let bearing = bearing_frame(plant, axis);
    if plant.stated.is_empty() {
        return inserted(plant, bearing, axis);
    }
    let directions = [bearing.heading, bearing.up].map(Vector::from);
    let start = plant.stated.start(Part::Axis(axis)).map(f64::from);
    let base = (Vector::from(bearing.base) + rest::placed(directions, start)).single();
    match plant.stated.rest(Part::Axis(axis), plant.frames.age) {
        Rest::Follows => Frame { base, ..inserted(plant, bearing, axis) },
        rest => {
            let [heading, up] = rest::turned(directions, rest).map(Vector::single);
            Frame { base, heading, up }
        }
    }
}

/// The frame of an axis that leaves `bearing` at its insertion and azimuth.
#[inline]
fn inserted(plant: &Plant, bearing: Frame, axis: AxisId) -> Frame {
    bearing.inserted(plant.axes.azimuth[axis.index()], plant.axes.insertion[axis.index()])
}

/// The pose of the apical bud of an axis: at the tip of its last node, or at its start. For the bud at an earlier age
/// use [`node_frame`] of the last node of that age, or [`start_frame`].
pub fn bud_frame(plant: &Plant, axis: AxisId) -> Frame {
    match plant.axes.last_node[axis.index()].some() {
        Some(node) => node_frame(plant, node),
        None => start_frame(plant, axis),
    }
}

/// The place of the apical bud of an axis, the base of [`bud_frame`].
pub fn bud_base(plant: &Plant, axis: AxisId) -> [f32; 3] {
    match plant.axes.last_node[axis.index()].some() {
        Some(node) => node_frame(plant, node).base,
        None if plant.stated.is_empty() => bearing_frame(plant, axis).base,
        None => start_frame(plant, axis).base,
    }
}

/// The frame of the bearer of an axis: its bearing node, or the upward vertical at the seed.
fn bearing_frame(plant: &Plant, axis: AxisId) -> Frame {
    match plant.axes.bearer[axis.index()].some() {
        Some(bearer) => node_frame(plant, bearer),
        None => Frame::GROUND,
    }
}

#[cfg(test)]
pub(crate) mod specimen;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_precision;
#[cfg(test)]
mod tests_stated;
