//! The leaf of each node, of which the base may stay on the stem: an organ, or an axis with leaflets.
//!
//! Absent: whether a leaf has fallen, and where it stood (`stem_near`).

use phytomer_sim::plant::{AxisId, Class, OrganId, Plant};

/// The leaf of a node: an organ, or an axis with leaflets, as a date palm's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LeafOf {
    /// An organ.
    Organ(OrganId),
    /// The first axis in the axil of a node without leaves.
    Axis(AxisId),
}

/// The first leaf of each node; of a node without leaves the first axis that it bears.
pub fn leaves_of_nodes(plant: &Plant) -> Vec<Option<LeafOf>> {
    let mut leaves = vec![None; plant.nodes.len()];
    let organs = plant.organs.node.iter().zip(&plant.organs.kind).enumerate();
    for (place, (node, _)) in organs.filter(|(_, (_, kind))| kind.class() == Class::Leaf) {
        leaves[node.index()].get_or_insert(LeafOf::Organ(OrganId(place as u32)));
    }
    for (place, bearer) in plant.axes.bearer.iter().enumerate() {
        if let Some(node) = bearer.some() {
            leaves[node.index()].get_or_insert(LeafOf::Axis(AxisId(place as u32)));
        }
    }
    leaves
}
