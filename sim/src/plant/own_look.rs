//! Looks that single nodes and organs have of their own, instead of those that follow from order and starting state:
//! what a turtle, a lobe or a flower made of parts needs.
//!
//! A look is named by its place among [`super::Looks::apart`] or [`super::Looks::organs_apart`]. A place where no look
//! stands names none. A plant without looks of their own has empty columns.

use super::Plant;
use super::handle::{NodeId, OrganId};
use super::rare::Rare;

/// Which nodes and organs have which looks of their own.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OwnLooks {
    /// The place counted from 1; 0 where a node has none.
    nodes: Rare<u16>,
    /// Likewise.
    organs: Rare<u16>,
}

impl OwnLooks {
    /// Whether no node and no organ has one.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty() && self.organs.is_empty()
    }

    /// The place of the look of a node among those apart.
    #[inline]
    pub fn of_node(&self, node: NodeId) -> Option<usize> {
        usize::from(self.nodes.at(node.index())).checked_sub(1)
    }

    /// The place of the look of an organ among those apart.
    #[inline]
    pub fn of_organ(&self, organ: OrganId) -> Option<usize> {
        usize::from(self.organs.at(organ.index())).checked_sub(1)
    }

    /// Takes over those of a fragment, of which the first node and organ become these.
    pub(super) fn join(&mut self, more: &Self, [node, organ]: [usize; 2]) {
        self.nodes.join(&more.nodes, |at| node + at);
        self.organs.join(&more.organs, |at| organ + at);
    }

    pub(super) fn clear(&mut self) {
        self.nodes.clear();
        self.organs.clear();
    }
}

impl Plant {
    /// Gives a node the look at a place among those apart, below 65,535.
    pub fn give_look(&mut self, node: NodeId, place: u16) {
        self.own_looks.nodes.set(node.index(), place.saturating_add(1));
    }

    /// Gives an organ the look at a place among those of organs apart, below 65,535.
    pub fn give_organ_look(&mut self, organ: OrganId, place: u16) {
        self.own_looks.organs.set(organ.index(), place.saturating_add(1));
    }
}
