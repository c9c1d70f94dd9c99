//! Leaves, flowers and fruits, each on a node.
//!
//! An organ's end is planned at its birth, from its life length and the season; its branch may end earlier. Absent: its
//! pose, which follows from that of its node.

use super::form::Form;
use super::handle::{NodeId, OrganId};
use super::joint::Joint;
use super::kind::{Cause, Kind};
use crate::clock::Tick;

/// What a new organ starts from.
#[derive(Debug, Clone, Copy)]
pub struct NewOrgan {
    /// The node that bears it.
    pub node: NodeId,
    /// What it is: a kind of leaf, flower or fruit.
    pub kind: Kind,
    /// Its position among the organs of its kind on the node, from 0.
    pub position: u16,
    /// The tick at which it appears; may lie ahead of the plant's age (a fruit, when its flower opens).
    pub birth: Tick,
    /// The tick at which it falls if its branch lives so long; `NEVER` if it stays as long as its branch.
    pub death: Tick,
    /// Why it falls then.
    pub cause: Cause,
    /// The form that it is drawn with.
    pub form: Form,
    /// Length along its own axis when it is full-grown, metres.
    pub length: f32,
    /// Width across, likewise.
    pub width: f32,
    /// Area of one side, likewise, square metres; 0 where area means nothing.
    pub area: f32,
    /// Around the axis, radians from the axis's reference direction.
    pub azimuth: f32,
    /// Between the axis and the organ, radians.
    pub insertion: f32,
}

/// The columns of the organs.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Organs {
    /// The bearing node.
    pub node: Vec<NodeId>,
    /// The component number.
    pub component: Vec<u32>,
    /// What it is: a kind of leaf, flower or fruit.
    pub kind: Vec<Kind>,
    /// The position among the organs of its kind on the node.
    pub position: Vec<u16>,
    /// The tick of appearance.
    pub birth: Vec<Tick>,
    /// The tick of its fall, planned or past; [`crate::shed`] brings it forward to the death of the branch.
    pub death: Vec<Tick>,
    /// Why it falls.
    pub cause: Vec<Cause>,
    /// The form that it is drawn with.
    pub form: Vec<Form>,
    /// Length when full-grown, metres.
    pub length: Vec<f32>,
    /// Width, likewise.
    pub width: Vec<f32>,
    /// Area of one side, likewise, square metres.
    pub area: Vec<f32>,
    /// Azimuth, radians.
    pub azimuth: Vec<f32>,
    /// Insertion angle, radians.
    pub insertion: Vec<f32>,
}

impl Organs {
    /// How many organs there are.
    #[inline]
    pub fn len(&self) -> usize {
        self.node.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.node.is_empty()
    }

    #[inline]
    pub(super) fn push(&mut self, organ: NewOrgan, component: u32) -> OrganId {
        let id = OrganId(self.len() as u32);
        self.node.push(organ.node);
        self.component.push(component);
        self.kind.push(organ.kind);
        self.position.push(organ.position);
        self.birth.push(organ.birth);
        self.death.push(organ.death);
        self.cause.push(organ.cause);
        self.form.push(organ.form);
        self.length.push(organ.length);
        self.width.push(organ.width);
        self.area.push(organ.area);
        self.azimuth.push(organ.azimuth);
        self.insertion.push(organ.insertion);
        id
    }

    /// Adds the organs of a fragment.
    pub(super) fn join(&mut self, more: &Self, joint: &Joint) {
        self.node.extend(more.node.iter().map(|&node| joint.node(node)));
        self.component.extend(more.component.iter().map(|&component| joint.component(component)));
        self.kind.extend_from_slice(&more.kind);
        self.position.extend_from_slice(&more.position);
        self.birth.extend_from_slice(&more.birth);
        self.death.extend_from_slice(&more.death);
        self.cause.extend_from_slice(&more.cause);
        self.form.extend_from_slice(&more.form);
        self.length.extend_from_slice(&more.length);
        self.width.extend_from_slice(&more.width);
        self.area.extend_from_slice(&more.area);
        self.azimuth.extend_from_slice(&more.azimuth);
        self.insertion.extend_from_slice(&more.insertion);
    }

    pub(super) fn clear(&mut self) {
        self.node.clear();
        self.component.clear();
        self.kind.clear();
        self.position.clear();
        self.birth.clear();
        self.death.clear();
        self.cause.clear();
        self.form.clear();
        self.length.clear();
        self.width.clear();
        self.area.clear();
        self.azimuth.clear();
        self.insertion.clear();
    }
}
