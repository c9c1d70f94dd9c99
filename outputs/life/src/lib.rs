//! One description of a life: what a plant looks like at every age, made in one pass over a plant that is grown once.
//!
//! A [`Life`] has the axes of a plant as lines of few points, and its organs, each with the ages at which they stand
//! and with keyframes. Points that the others' line passes within the tolerance are left out, and so are keyframes that
//! linear interpolation passes within it. [`Maker`] is shown a plant age by age, and remembers of each point and organ
//! that stands its last key and its last state: memory does not grow with the number of ages, but with what is kept.
//! Any growth model will do: components are known again by their numbers. [`Lives`] records a whole plot. Absent:
//! triangles and files, which are made from a life by its writers, and poses between ticks, which are
//! [`phytomer_sim::between`]'s.
//!
//! **To draw a life** at an age, whole or not: for each [`Line`] a tube through the points of [`Life::line_at`], and
//! for each [`Part`] that [`Part::stands`] its form at [`Life::pose_at`], as [`What`] says. Values between two keys are
//! linear ([`between`]); directions are made unit vectors again. What is born, falls or becomes a point does so at the
//! ages that it states, so the topology is constant between two neighbours of those ages.
//!
//! Ages are ticks in single precision, exact up to 2²⁴, and may have a fraction: a writer should not take them for
//! whole numbers. A plant that is shown between ticks ([`Lives::between`]) has what appears at a tick from just after
//! the tick before on (`from`), with next to no size at first; `birth` is the tick by which it has appeared, as in the
//! tables.

mod kept;
mod lines;
mod lists;
mod lives;
mod maker;
mod models;
mod parts;
mod stand;
mod still;
#[cfg(test)]
mod tests;
mod track;

pub use lives::Lives;
pub use maker::Maker;
pub use models::{Models, stepped};
pub use phytomer_looks::{Surface, SurfacePoint};
pub use phytomer_meshes::Model;
pub use stand::{Member, Organs, StillOrgans, organs_alone, organs_of_plot, wood_of, wood_of_plot};
use track::some_between;
pub use track::{Key, Track, between};

use glam::{Mat3, Vec3};
use kept::Kept;
use phytomer_meshes::{NearForm, Nears};
use phytomer_sim::plant::{Form, Kind};
use std::ops::Range;
use std::sync::Arc;

/// How near the keyframes of a life are to the plant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearness {
    /// The distance, metres, from a place of an axis or of an organ to the place that the life gives back, and between
    /// their radii and sizes.
    pub distance: f32,
    /// The share of its radius by which a radius may be off, where that is less than the distance, so that twigs that
    /// are thinner than the distance keep their thickness; infinite where the distance alone counts.
    pub share: f32,
    /// The most by which a colour is off, in each of three bytes.
    pub colour: f32,
}

impl Nearness {
    /// Within a distance, metres, and four parts of 255 of a colour.
    pub fn of(distance: f32) -> Self {
        Self { distance, share: f32::INFINITY, colour: 4.0 }
    }
}

/// A plant from its first age to its last.
#[derive(Debug, Clone, Default)]
pub struct Life {
    /// The plant's number in the run.
    pub plant: u32,
    /// The place of its seed, metres; all other places are relative to it.
    pub place: [f64; 3],
    /// The ages at which it was shown; of a life in a plot the ticks.
    pub ages: Vec<f32>,
    /// Of a life in a plot the tick at which the plant is sown, else 0: what is to be taken from `from` and `death`,
    /// and not from `birth`, for ages of the plant.
    pub sown: f32,
    /// The lines of its axes.
    pub lines: Vec<Line>,
    /// The points of all lines, line by line in their order along it.
    pub points: Vec<Point>,
    /// Its organs, and internodes that are no tubes.
    pub parts: Vec<Part>,
    /// The outlines that organs state, corner by corner: x along the organ, y to its left, z to its upper side, metres.
    /// They are drawn as the polygon that they are; they may be concave.
    pub outlines: Vec<Vec<[f32; 3]>>,
    /// The curved surfaces that organs are: points, normals and triangles, in the same coordinates.
    pub surfaces: Vec<Surface>,
    /// The forms of internodes that are drawn by themselves.
    pub stems: Vec<Model>,
    /// The forms of organs seen from near; none at detail 0.
    pub nears: Option<Arc<Nears>>,
    places: Kept<4>,
    poses: Kept<12>,
    tints_of_points: Kept<3>,
    tints_of_parts: Kept<3>,
}

/// The line of an axis, or of a part of it that is one tube.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Line {
    /// The component number of the apical bud of the axis.
    pub axis: u32,
    /// The component number of the apical bud of the axis that bears it, when it was first seen; `None` for a trunk.
    pub bearer: Option<u32>,
    /// Its order, from 1.
    pub order: u8,
    /// Its points, as places among those of the life.
    pub points: Range<usize>,
}

/// A point of a line: the base of an internode, the tip of one where the radius steps, or the moving end of the line.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// The component number of the internode that begins here, or that ends here.
    pub component: u32,
    /// Its kind.
    pub kind: Kind,
    /// Whether the internode ends here.
    pub end: bool,
    /// Whether this is the end of the line, which moves on from internode to internode as the axis grows.
    pub tip: bool,
    /// The age at the birth of the internode; of a tip, of the first internode of the line.
    pub birth: f32,
    /// The first age at which the line has the point; before, it lies on the line of the other points. It may be up to
    /// a tick before the birth, where the plant is shown between ticks.
    pub from: f32,
    /// The age from which the line does not have it any more: its internode has fallen, was cut off or rewritten. +∞
    /// where it stands at the last age.
    pub death: f32,
    places: Range<u32>,
    tints: Range<u32>,
}

/// What a part is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum What {
    /// An organ of a form.
    Organ(Form),
    /// An organ of a form from near, which is among those of the life.
    Near(NearForm),
    /// An organ with an outline of its own, by its place among those of the life; its sizes are shares of the outline.
    Outlined(u32),
    /// An organ that is a curved surface, by its place among those of the life. A point (x, y, z) of the surface is at
    /// base + x · s₀ · heading + y · s₁ · (up × heading) + z · s₂ · up with the sizes s of the pose, and its normal is
    /// [`SurfacePoint::normal_scaled`] of them, turned alike.
    Surface(u32),
    /// An internode that is no tube or has sides of its own: drawn as its species states, by itself.
    Internode,
}

/// An organ, or an internode that is drawn by itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Its component number.
    pub component: u32,
    /// The component number of the internode at whose tip it stands; its own, of an internode.
    pub bearer: u32,
    /// The component number of the apical bud of that internode's axis.
    pub axis: u32,
    /// Its kind.
    pub kind: Kind,
    /// What it is.
    pub what: What,
    /// Of an internode its form, by its place among those of the life.
    pub stem: u32,
    /// How much fuller it is than its form, so that it has its area.
    pub fullness: f32,
    /// The colour of its stalk.
    pub stalk: [u8; 3],
    /// The age at its birth.
    pub birth: f32,
    /// The first age at which it was shown.
    pub from: f32,
    /// The age from which it does not stand any more; +∞ where it stands at the last age.
    pub death: f32,
    poses: Range<u32>,
    tints: Range<u32>,
}

/// A part at an age.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Its base, metres.
    pub base: [f32; 3],
    /// The unit vector along it.
    pub heading: [f32; 3],
    /// The unit vector of its upper side.
    pub up: [f32; 3],
    /// Its length; its width, or of an internode its diameter at the base; and that at its tip, metres. Of an outline
    /// its share, twice; of a surface its factors along the organ, to its left and to its upper side.
    pub size: [f32; 3],
}

impl Pose {
    /// The rotation that brings x, y and z to its heading, its left and its upper side.
    pub fn turn(&self) -> Mat3 {
        let heading = Vec3::from_array(self.heading);
        let up = Vec3::from_array(self.up);
        let across = (up - heading * up.dot(heading)).try_normalize();
        let up = across.unwrap_or_else(|| heading.any_orthonormal_vector());
        Mat3::from_cols(heading, up.cross(heading), up)
    }
}

impl Point {
    /// Whether the line has the point at an age.
    pub fn stands(&self, age: f32) -> bool {
        self.from <= age && age < self.death
    }
}

impl Part {
    /// Whether it stands at an age.
    pub fn stands(&self, age: f32) -> bool {
        self.from <= age && age < self.death
    }
}

impl Life {
    /// The same life by the ticks of its plot, in which the plant is sown at a tick. `ticks` are those at which the
    /// plot was shown; the last of them are the ages of the life. Births stay the plant's own ages, as tables have
    /// them.
    #[must_use]
    pub fn in_plot(mut self, sown: f32, ticks: &[f32]) -> Self {
        let own = std::mem::replace(&mut self.ages, ticks.to_vec());
        let before = ticks.len().saturating_sub(own.len());
        let tick = |age: &mut f32| {
            let place = own.partition_point(|at| at < age);
            let is_shown = own.get(place) == Some(age);
            *age = ticks.get(before + place).copied().filter(|_| is_shown).unwrap_or(*age + sown);
        };
        self.sown = sown;
        self.points.iter_mut().flat_map(|point| [&mut point.from, &mut point.death]).for_each(tick);
        self.parts.iter_mut().flat_map(|part| [&mut part.from, &mut part.death]).for_each(tick);
        self.places.iter_mut().map(|(age, _)| age).for_each(tick);
        self.poses.iter_mut().map(|(age, _)| age).for_each(tick);
        let tints = self.tints_of_points.iter_mut().chain(self.tints_of_parts.iter_mut());
        tints.map(|(age, _)| age).for_each(tick);
        self
    }

    /// The keyframes of a point: x, y, z and the radius, metres.
    pub fn places(&self, point: &Point) -> &[Key<4>] {
        self.places.of(&point.places)
    }

    /// The keyframes of the colour of the internode of a point.
    pub fn tints_of_point(&self, point: &Point) -> &[Key<3>] {
        self.tints_of_points.of(&point.tints)
    }

    /// The keyframes of a part: base, heading, upper side and sizes, as in [`Pose`].
    pub fn poses(&self, part: &Part) -> &[Key<12>] {
        self.poses.of(&part.poses)
    }

    /// The keyframes of the colour of a part.
    pub fn tints_of_part(&self, part: &Part) -> &[Key<3>] {
        self.tints_of_parts.of(&part.tints)
    }

    /// The points that a line has at an age, in their order: x, y, z and the radius.
    pub fn line_at(&self, line: &Line, age: f32) -> impl Iterator<Item = (&Point, [f32; 4])> {
        let points = self.points[line.points.clone()].iter().filter(move |point| point.stands(age));
        points.map(move |point| (point, between(self.places(point), age)))
    }

    /// A part at an age.
    pub fn pose_at(&self, part: &Part, age: f32) -> Pose {
        let values = between(self.poses(part), age);
        let three = |first: usize| [values[first], values[first + 1], values[first + 2]];
        Pose { base: three(0), heading: unit(three(3)), up: unit(three(6)), size: three(9) }
    }

    /// Where the base of a part is at an age.
    pub fn base_at(&self, part: &Part, age: f32) -> [f32; 3] {
        some_between(self.poses(part), age, 0)
    }

    /// The sizes of a part at an age, as in [`Pose`].
    pub fn size_at(&self, part: &Part, age: f32) -> [f32; 3] {
        some_between(self.poses(part), age, 9)
    }

    /// The number of its keyframes.
    pub fn keys(&self) -> usize {
        self.places.len() + self.poses.len() + self.tints_of_points.len() + self.tints_of_parts.len()
    }
}

fn unit(direction: [f32; 3]) -> [f32; 3] {
    let length = direction.iter().map(|x| x * x).sum::<f32>().sqrt();
    if length > 0.0 { direction.map(|x| x / length) } else { direction }
}
