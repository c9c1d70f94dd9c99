//! The wood of a species in mechanics: whether it bends under the forces of a site, and the volume of an internode.
//!
//! The compiled numbers themselves are part of the habit ([`crate::plant::Wood`]).

use super::section::Section;
use crate::plant::{NodeId, Plant, Wood};
use crate::site::Fields;

impl Wood {
    /// Whether axes bend under these fields of force, or right themselves.
    pub(crate) fn feels(&self, fields: &Fields) -> bool {
        self.bends && (*fields != Fields::NONE || self.tissues.iter().any(|tissue| tissue.uprighting.acts()))
    }
}

/// The volume of an internode, m³: the frustum of its two diameters, or of a blade its mean width by its thickness by
/// its length; where its section is no circle, what the plant states of it beside that ([`Plant::state_bulk`]).
#[inline]
pub fn wood_volume(plant: &Plant, node: NodeId) -> f64 {
    let nodes = &plant.nodes;
    let (section, length) = (Section::of(plant.look_of_node(node)), plant.posed_length(node));
    let (bulk, node) = (plant.own_looks.bulk_of(node), node.index());
    bulk * section.volume(f64::from(length), f64::from(nodes.diameter[node]), f64::from(nodes.diameter_tip[node]))
}
