//! Leaves, flowers and fruits, each on a node.
//!
//! An organ's end is planned at its birth, from its life length and the season; its branch may end earlier. Absent: its
//! pose, which follows from that of its node.

use super::columns::columns;
use super::form::Form;
use super::handle::{NodeId, OrganId};
use super::kind::{Cause, Kind};
use crate::clock::Tick;

/// The values of a new organ.
#[derive(Debug, Clone, Copy)]
pub struct NewOrgan {
    /// The bearing node.
    pub node: NodeId,
    /// Its kind: a kind of leaf, flower or fruit.
    pub kind: Kind,
    /// Its position among the organs of its kind on the node, from 0.
    pub position: u16,
    /// The tick at which it appears; may be after the plant's age (a fruit's, when its flower opens).
    pub birth: Tick,
    /// The tick at which it falls if its branch lives that long; `NEVER` if it stays as long as its branch.
    pub death: Tick,
    /// The cause of that fall.
    pub cause: Cause,
    /// The form that it is drawn with.
    pub form: Form,
    /// Length along its own axis when it is full-grown, metres.
    pub length: f32,
    /// Width across when it is full-grown, metres.
    pub width: f32,
    /// Area of one side when it is full-grown, square metres; 0 for organs that have no area.
    pub area: f32,
    /// Azimuth around the axis, radians from the axis's reference direction.
    pub azimuth: f32,
    /// Angle between the axis and the organ, radians.
    pub insertion: f32,
}

columns! {
    /// The columns of the organs.
    pub struct Organs of organ: NewOrgan, numbered component, joined by joint from more at place {
        /// The bearing node.
        node: NodeId = organ.node => joint.node(more.node[place]),
        /// The component number.
        component: u32 = component => joint.component(more.component[place]),
        /// What it is: a kind of leaf, flower or fruit.
        kind: Kind = organ.kind,
        /// The position among the organs of its kind on the node.
        position: u16 = organ.position,
        /// The tick of appearance.
        birth: Tick = organ.birth,
        /// The tick of its fall, planned or past; [`crate::shed`] brings it forward to the death of the branch.
        death: Tick = organ.death,
        /// The cause of its fall.
        cause: Cause = organ.cause,
        /// The form that it is drawn with.
        form: Form = organ.form,
        /// Length when full-grown, metres.
        length: f32 = organ.length,
        /// Width when full-grown, metres.
        width: f32 = organ.width,
        /// Area of one side when full-grown, square metres.
        area: f32 = organ.area,
        /// Azimuth, radians.
        azimuth: f32 = organ.azimuth,
        /// Insertion angle, radians.
        insertion: f32 = organ.insertion,
    }
}

impl Organs {
    #[inline]
    pub(super) fn push(&mut self, organ: NewOrgan, component: u32) -> OrganId {
        let id = OrganId(self.len() as u32);
        self.push_columns(organ, component);
        id
    }
}
