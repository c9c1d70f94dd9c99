//! Where each component stands: frames from rest geometry in one forward scan (de Reffye 1988 §4, Fig. 15).
//!
//! A frame is a base point, a heading along the internode and a reference direction `up` across it. The direction at
//! azimuth φ is cos φ · up + sin φ · (heading × up). An axis that leaves at azimuth φ and insertion angle β from a
//! heading h with the direction d at φ has the heading cos β · h + sin β · d and the upper side sin β · h − cos β · d.
//! Along the axis each internode turns its share of the way to the axis's trend, in the vertical plane of its heading.

use crate::plant::{OrganId, Plant};

/// The columns of the pose, one entry a node, in metres and unit vectors; Z is up.
#[derive(Debug, Clone, Default)]
pub struct Frames {
    /// The base of the internode.
    pub base: Vec<[f32; 3]>,
    /// Its direction.
    pub heading: Vec<[f32; 3]>,
    /// Its reference direction, from which azimuths count.
    pub up: Vec<[f32; 3]>,
}

impl Frames {
    pub(crate) fn clear(&mut self) {
        self.base.clear();
        self.heading.clear();
        self.up.clear();
    }
}

/// A point with two directions: the pose of one component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// The base point, metres.
    pub base: [f32; 3],
    /// The direction in which the component points.
    pub heading: [f32; 3],
    /// The direction of its upper side.
    pub up: [f32; 3],
}

/// Poses every internode of `plant` that has no frame yet.
pub fn pose(_plant: &mut Plant) {}

/// The pose of an organ on its node, whose frame must be there.
pub fn organ_frame(_plant: &Plant, _organ: OrganId) -> Frame {
    Frame { base: [0.0; 3], heading: [0.0; 3], up: [0.0; 3] }
}
