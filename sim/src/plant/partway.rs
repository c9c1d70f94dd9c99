//! What a plant that is shown between two ticks has beside its columns.
//!
//! Such a plant is made by [`crate::between`] and never grown on. It stands at the age of the later tick, at which all
//! that stood at the earlier one still stands, and each pass that asks for an age is given the later tick. Lengths,
//! diameters, curvatures and frames are those of the moment; sizes and places of organs, and what looked otherwise at
//! the earlier tick, follow from what is kept here. A plant at a tick has none of this. Absent: how the values come
//! about.

use super::handle::{NodeId, OrganId};
use super::placing::Placed;
use super::{InternodeLook, OrganLook, Plant};
use crate::clock::Tick;
use std::sync::Arc;

/// The state between two ticks.
#[derive(Debug, Clone, Default)]
pub struct Partway {
    /// The share of the tick that has passed, between 0 and 1.
    pub(crate) share: f32,
    /// The share of its full size that each organ has.
    pub(crate) sizes: Vec<f32>,
    /// How far each organ has dropped on its way to the ground, from 0 to 1; empty where none drops.
    pub(crate) drops: Vec<f32>,
    /// How each organ stands in the frame of its node; empty where insertion and trend tell it.
    pub(crate) organs: Vec<Placed>,
    /// The looks at the earlier tick of what had others.
    pub(crate) former: Arc<Former>,
}

/// The places of own looks at the earlier tick, of what stood there with another look; `None`: it had none of its own.
#[derive(Debug, Clone, Default)]
pub(crate) struct Former {
    /// Those of nodes, in their order.
    pub(crate) nodes: Vec<(NodeId, Option<usize>)>,
    /// Those of organs, in their order.
    pub(crate) organs: Vec<(OrganId, Option<usize>)>,
}

impl Plant {
    /// The share of the tick that has passed, of a plant that is shown between two ticks.
    #[inline]
    pub fn partway(&self) -> Option<f32> {
        self.partway.as_ref().map(|partway| partway.share)
    }

    /// The age that a plant shows which stands at a tick: that of the tick, or less where it is shown before it; to a
    /// millionth.
    pub fn shown_age(&self, age: Tick) -> f64 {
        let age = f64::from(age);
        self.partway().map_or(age, |share| ((age - 1.0 + f64::from(share)) * 1e6).round() / 1e6)
    }

    /// The last tick by which what has fallen does not stand at `age` any more: of a plant that is shown between two
    /// ticks the one before.
    #[inline]
    pub fn fallen_by(&self, age: Tick) -> Tick {
        age - Tick::from(self.partway.is_some())
    }

    /// How far an organ has dropped.
    #[inline]
    pub(crate) fn dropped(&self, organ: OrganId) -> f32 {
        self.partway.as_ref().and_then(|partway| partway.drops.get(organ.index())).copied().unwrap_or(0.0)
    }

    /// The look that an internode had at the earlier tick; of a plant at a tick the look that it has.
    #[inline]
    pub fn former_look_of_node(&self, node: NodeId) -> &InternodeLook {
        let former = self.partway.as_ref().map(|partway| &partway.former.nodes);
        match former.and_then(|former| Some(former[former.binary_search_by_key(&node, |of| of.0).ok()?].1)) {
            Some(own) => self.look_of_node_as(node, own),
            None => self.look_of_node(node),
        }
    }

    /// The look that an organ had at the earlier tick; of a plant at a tick the look that it has.
    #[inline]
    pub fn former_look_of_organ(&self, organ: OrganId) -> Option<&OrganLook> {
        let former = self.partway.as_ref().map(|partway| &partway.former.organs);
        match former.and_then(|former| Some(former[former.binary_search_by_key(&organ, |of| of.0).ok()?].1)) {
            Some(own) => self.look_of_organ_as(organ, own),
            None => self.look_of_organ(organ),
        }
    }
}
