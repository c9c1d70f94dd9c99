//! The columns of the pose, one frame a node, and the state at the end of each axis: written by [`crate::pose`] at rest
//! and by [`crate::mechanics`] where a plant bends.
//!
//! A frame is a base point, a heading along the internode and a reference direction `up` across it. The ends of axes
//! are kept in double precision. Absent: how frames follow from rest geometry, which is the pose's.

use super::handle::NodeId;
use super::node::Nodes;
use crate::clock::Tick;
use crate::math::sincosf;
use crate::vector::Vector;

/// The columns of the pose, one entry a node, in metres from the seed and unit vectors; Z is up.
#[derive(Debug, Clone, Default)]
pub struct Frames {
    /// The base of the internode.
    pub base: Vec<[f32; 3]>,
    /// Its direction.
    pub heading: Vec<[f32; 3]>,
    /// Its reference direction, from which azimuths count.
    pub up: Vec<[f32; 3]>,
    /// The end of each axis, from which it grows on, in double precision: one entry an axis.
    pub(crate) tips: Vec<Tip>,
    /// The directions at the end of each axis, where frames are stated; else empty.
    pub(crate) courses: Vec<Stated>,
    /// The lengths of internodes at the age of the frames; empty where they are the lengths in the column.
    pub(crate) lengths: Vec<f32>,
    /// The age of the frames.
    pub(crate) age: Tick,
    /// The age before which frames are made: internodes that appeared earlier have their frame.
    pub(crate) posed: Tick,
    /// So many internodes, from the first on, need not be looked at for those without a frame.
    pub(crate) done: usize,
    /// Changes whenever frames that were there may have become others; new frames alone do not change it.
    pub(crate) version: u64,
}

impl Frames {
    /// The frame at the base of the internode of `node`, which must be posed.
    #[inline]
    pub fn at(&self, node: NodeId) -> Frame {
        let node = node.index();
        Frame { base: self.base[node], heading: self.heading[node], up: self.up[node] }
    }

    /// Forgets every frame, so that the next pose makes all of them. The columns keep their length, so that the next
    /// pose need not fill new memory.
    pub fn clear(&mut self) {
        self.make_anew();
        self.lengths.clear();
    }

    /// Lets the next pose make every frame, and keeps the frames and the lengths that are there until then.
    pub(crate) fn make_anew(&mut self) {
        (self.posed, self.done) = (0, 0);
        self.version += 1;
        self.courses.clear();
    }

    /// The lengths of internodes at the age of the frames.
    #[inline]
    pub(crate) fn lengths<'a>(&'a self, nodes: &'a Nodes) -> &'a [f32] {
        if self.lengths.is_empty() { &nodes.length } else { &self.lengths }
    }

    /// Makes room for the frames of every node and the tip of every axis, to be posed up to `age`. Returns the age
    /// before which frames are already made.
    pub(crate) fn begin(&mut self, nodes: usize, axes: usize, age: Tick) -> Tick {
        self.resize_nodes(nodes);
        self.tips.resize(axes, Tip::default());
        self.age = age;
        std::mem::replace(&mut self.posed, age + 1)
    }

    /// Makes room for the frames of every node of a plant that stands bent at `age`.
    pub(crate) fn bend(&mut self, nodes: usize, age: Tick) {
        self.resize_nodes(nodes);
        self.version += 1;
        self.age = age;
    }

    fn resize_nodes(&mut self, nodes: usize) {
        for column in [&mut self.base, &mut self.heading, &mut self.up] {
            if column.is_empty() {
                // New memory is zeroed by the system when it is first written, instead of twice.
                *column = vec![[0.0; 3]; nodes];
            }
            column.resize(nodes, [0.0; 3]);
        }
    }
}

/// A point with two directions: the pose of one component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// The base point, metres from the seed.
    pub base: [f32; 3],
    /// The direction in which the component points.
    pub heading: [f32; 3],
    /// The direction of its upper side.
    pub up: [f32; 3],
}

impl Frame {
    /// The frame that the axis of the seed leaves.
    pub(crate) const GROUND: Self = Self { base: [0.0; 3], heading: [0.0, 0.0, 1.0], up: [1.0, 0.0, 0.0] };

    /// The frame with the same directions at `distance` metres along the heading.
    #[inline]
    pub fn advanced(self, distance: f32) -> Self {
        let along = |k: usize| self.base[k] + distance * self.heading[k];
        Self { base: [along(0), along(1), along(2)], ..self }
    }

    /// The frame that leaves this frame's base at `azimuth` and `insertion`, radians.
    #[inline]
    pub fn inserted(self, azimuth: f32, insertion: f32) -> Self {
        self.left_at(Leaving { azimuth: sincosf(azimuth), insertion: sincosf(insertion) })
    }

    /// The frame that leaves this frame's base in a direction.
    #[inline]
    pub(crate) fn left_at(self, leaving: Leaving) -> Self {
        let Leaving { azimuth: (sin_azimuth, cos_azimuth), insertion: (sin, cos) } = leaving;
        let (h, up) = (self.heading, self.up);
        let side = [h[1] * up[2] - h[2] * up[1], h[2] * up[0] - h[0] * up[2], h[0] * up[1] - h[1] * up[0]];
        let outward = [0, 1, 2].map(|k| cos_azimuth * up[k] + sin_azimuth * side[k]);
        Self {
            base: self.base,
            heading: [0, 1, 2].map(|k| cos * h[k] + sin * outward[k]),
            up: [0, 1, 2].map(|k| sin * h[k] - cos * outward[k]),
        }
    }
}

/// The direction in which an axis leaves its bearer: sine and cosine of its azimuth and of its insertion.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Leaving {
    pub azimuth: (f32, f32),
    pub insertion: (f32, f32),
}

/// The last insertion angle, with its sine and cosine: neighbouring axes of one order mostly have the same angle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LastInsertion {
    angle: f32,
    sincos: (f32, f32),
}

impl LastInsertion {
    /// The direction of an axis of this azimuth and insertion, radians.
    #[inline]
    pub fn leaving(&mut self, azimuth: f32, insertion: f32) -> Leaving {
        if self.angle.to_bits() != insertion.to_bits() {
            *self = Self { angle: insertion, sincos: sincosf(insertion) };
        }
        Leaving { azimuth: sincosf(azimuth), insertion: self.sincos }
    }
}

impl Default for LastInsertion {
    fn default() -> Self {
        Self { angle: 0.0, sincos: (0.0, 1.0) }
    }
}

/// The end of an axis, from which it grows on.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Tip {
    /// The end of its last internode, metres.
    pub base: Vector,
    /// The direction of its last internode, where it follows insertion and trend.
    pub slope: Slope,
}

/// Heading and upper side.
pub(crate) type Directions = [Vector; 2];

/// The course of an axis by insertion and trend.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Trended {
    pub plane: Plane,
    pub slope: Slope,
}

/// The course of an axis of a plant in which frames are stated.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stated {
    pub along: Along,
    pub length: f64,
}

/// How the directions continue from the end of an axis.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Along {
    Trended(Trended),
    Turned(Directions),
}

/// The vertical plane of an axis, with the components of `up` that do not change along it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plane {
    /// The horizontal direction.
    pub e: [f64; 2],
    /// The component of `up` across the plane, along Z × e.
    pub across: f64,
    /// The component of `up` in the plane, along z · e − r · Z.
    pub within: f64,
}

/// The direction of a heading in its plane: z along the vertical, r along e.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Slope {
    pub z: f64,
    pub r: f64,
    /// The angle to the upward vertical; NaN while the axis has not turned, since many axes never turn.
    pub angle: f64,
}
