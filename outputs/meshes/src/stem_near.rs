//! What an internode is like from near: whether its leaf has fallen and where it stood, whether it ends a stem that was
//! cut, and on which sides it has lobes.
//!
//! Absent: the forms themselves (`turned`, `lamina`).

use super::node_leaves::LeafOf;
use super::stem::Stems;
use super::turned::{Choice, Variant};
use phytomer_sim::plant::{NodeId, Plant};
use phytomer_sim::pose::{node_frame, organ_frame};

impl Stems<'_> {
    /// Which of the forms from near an internode has.
    pub(super) fn variant(&self, choice: &Choice, node: NodeId) -> Variant {
        let nodes = &self.plant.nodes;
        if nodes.diameter[node.index()] < self.thin {
            return Variant::Plain;
        }
        let fallen = self.leaf_of(node).is_some_and(|leaf| !self.leaf_stands(leaf));
        let age = self.age.saturating_sub(nodes.birth[node.index()]);
        let next = self.next.get(node.index()).and_then(|next| next.some());
        let was = |next: NodeId| nodes.birth[next.index()] <= self.age && !self.plant.stands(next, self.age);
        choice.variant((nodes.rank[node.index()], age), fallen, next.is_some_and(was))
    }

    /// The leaf of a node on which the bases of leaves stay.
    fn leaf_of(&self, node: NodeId) -> Option<LeafOf> {
        self.leaves.get(node.index()).copied().flatten()
    }

    /// Whether a leaf stands, or is yet to appear.
    fn leaf_stands(&self, leaf: LeafOf) -> bool {
        let Plant { axes, nodes, .. } = self.plant;
        match leaf {
            LeafOf::Organ(leaf) => self.plant.organ_stands(leaf, self.age),
            LeafOf::Axis(axis) => axes.last_node[axis.index()]
                .some()
                .is_none_or(|last| nodes.birth[last.index()] > self.age || self.plant.stands(last, self.age)),
        }
    }

    /// The direction out of the stem in which the leaf of an internode stands or stood.
    pub(super) fn to_leaf(&self, node: NodeId) -> [f32; 3] {
        let frame = self.plant.frames.at(node);
        let leaf = self.leaf_of(node).map(|leaf| match leaf {
            LeafOf::Organ(leaf) => organ_frame(self.plant, leaf, self.age).heading,
            LeafOf::Axis(axis) => {
                let Plant { axes, .. } = self.plant;
                node_frame(self.plant, node).inserted(axes.azimuth[axis.index()], axes.insertion[axis.index()]).heading
            }
        });
        let ahead = leaf.unwrap_or(frame.up);
        let along: f32 = (0..3).map(|k| ahead[k] * frame.heading[k]).sum();
        let out = [0, 1, 2].map(|k| ahead[k] - along * frame.heading[k]);
        let length = out.iter().map(|x| x * x).sum::<f32>().sqrt();
        if length > 1e-6 { out.map(|x| x / length) } else { frame.up }
    }

    /// Whether a piece of a blade has a lobe on its right and on its left: none at both ends of its axis.
    pub(super) fn lobed(&self, node: NodeId) -> [bool; 2] {
        let Plant { nodes, axes, .. } = self.plant;
        let near = self.paints.near_stem(self.paints.internode(self.plant.look_of_node(node).paint));
        let sides = near.map_or(&[][..], |near| &near.lobed_sides);
        let is_last = self.next.get(node.index()).is_none_or(|next| next.some().is_none());
        let bearer = axes.bearer[nodes.axis[node.index()].index()].some();
        let Some(bearer) = bearer.filter(|_| !sides.is_empty() && nodes.rank[node.index()] > 1 && !is_last) else {
            return [false; 2];
        };
        let place = (nodes.rank[bearer.index()].max(1) - 1) as usize % sides.len();
        [sides[place] > 1, sides[place] > 0]
    }
}
