//! Looks that single nodes and organs have instead of those of their order and starting state, as a turtle, a lobe or a
//! flower made of parts needs.
//!
//! A look is named by its place among [`super::Looks::apart`] or [`super::Looks::organs_apart`]. A place past their end
//! names no look. Beside its look a node may have a cross section of its own. A plant without own looks has empty
//! columns.

use super::handle::{NodeId, OrganId};
use super::rare::Rare;
use super::{InternodeLook, OrganLook, Plant};

/// The own looks of nodes and organs.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OwnLooks {
    /// For each node the place of its look, counted from 1; 0 for none.
    nodes: Rare<u16>,
    /// For each organ the place of its look, counted from 1; 0 for none.
    organs: Rare<u16>,
    /// For each node the place of its cross section among those that the habit carries for drawing, counted from 1; 0
    /// for a circle.
    sections: Rare<u16>,
    /// For each node its volume over that of the frustum of its two diameters; 0 where it is that frustum.
    bulks: Rare<f32>,
}

impl OwnLooks {
    /// Whether no node and no organ has an own look or section.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty() && self.organs.is_empty() && self.sections.is_empty()
    }

    /// The place of the own look of a node among [`super::Looks::apart`]; `None` where it has none.
    #[inline]
    pub fn of_node(&self, node: NodeId) -> Option<usize> {
        usize::from(self.nodes.at(node.index())).checked_sub(1)
    }

    /// The place of the own look of an organ among [`super::Looks::organs_apart`]; `None` where it has none.
    #[inline]
    pub fn of_organ(&self, organ: OrganId) -> Option<usize> {
        usize::from(self.organs.at(organ.index())).checked_sub(1)
    }

    /// The place of the cross section of a node among those of the habit; `None` where it is a circle.
    #[inline]
    pub fn section_of(&self, node: NodeId) -> Option<usize> {
        usize::from(self.sections.at(node.index())).checked_sub(1)
    }

    /// The volume of a node over that of the round frustum, or the slab, of its two diameters.
    #[inline]
    pub fn bulk_of(&self, node: NodeId) -> f64 {
        let bulk = self.bulks.at(node.index());
        if bulk == 0.0 { 1.0 } else { f64::from(bulk) }
    }

    /// Adds the own looks of a fragment, whose first node and organ become `node` and `organ`.
    pub(super) fn join(&mut self, more: &Self, [node, organ]: [usize; 2]) {
        self.nodes.join(&more.nodes, |at| node + at);
        self.organs.join(&more.organs, |at| organ + at);
        self.sections.join(&more.sections, |at| node + at);
        self.bulks.join(&more.bulks, |at| node + at);
    }

    pub(super) fn clear(&mut self) {
        self.nodes.clear();
        self.organs.clear();
        self.sections.clear();
        self.bulks.clear();
    }
}

impl Plant {
    /// Gives a node the look at a place of [`super::Looks::apart`], below 65,535.
    pub fn give_look(&mut self, node: NodeId, place: u16) {
        self.own_looks.nodes.set(node.index(), place.saturating_add(1));
    }

    /// Gives a node the cross section at a place among those of the habit, below 65,535.
    pub fn give_section(&mut self, node: NodeId, place: u16) {
        self.own_looks.sections.set(node.index(), place.saturating_add(1));
    }

    /// States the volume of a node over that of the frustum of its two diameters, above 0, where its section makes it
    /// another solid.
    pub fn state_bulk(&mut self, node: NodeId, bulk: f32) {
        self.own_looks.bulks.set(node.index(), bulk);
    }

    /// Gives an organ the look at a place of [`super::Looks::organs_apart`], below 65,535.
    pub fn give_organ_look(&mut self, organ: OrganId, place: u16) {
        self.own_looks.organs.set(organ.index(), place.saturating_add(1));
    }

    /// The look of one internode: its own look, or that of its axis.
    #[inline]
    pub fn look_of_node(&self, node: NodeId) -> &InternodeLook {
        self.look_of_node_as(node, self.own_looks.of_node(node))
    }

    #[inline]
    pub(crate) fn look_of_node_as(&self, node: NodeId, own: Option<usize>) -> &InternodeLook {
        let own = own.and_then(|place| self.habit.looks.apart.get(place));
        own.unwrap_or_else(|| self.look_of(self.nodes.axis[node.index()]))
    }

    /// The look of an organ: its own look, or that of its class and order; `None` where none is stated.
    #[inline]
    pub fn look_of_organ(&self, organ: OrganId) -> Option<&OrganLook> {
        self.look_of_organ_as(organ, self.own_looks.of_organ(organ))
    }

    #[inline]
    pub(crate) fn look_of_organ_as(&self, organ: OrganId, own: Option<usize>) -> Option<&OrganLook> {
        let own = own.and_then(|place| self.habit.looks.organs_apart.get(place));
        if own.is_some() {
            return own;
        }
        let axis = self.nodes.axis[self.organs.node[organ.index()].index()];
        self.habit.looks.organ(self.axes.order[axis.index()], self.organs.kind[organ.index()].class())
    }
}
