//! Components added many at once: the columns grow by slices instead of entry by entry.
//!
//! The plant is the same as if its model had added them one by one: the model states the component numbers, in the
//! order in which it would have added them. Absent: the entry of one component (`node`, `organ`, `axis`).

use super::handle::{AxisId, NodeId, OrganId};
pub use super::new_organs::OrganTile;
use super::node::{Formation, Nodes, buds_told, told};
use super::{NewAxis, Plant};
use crate::clock::Tick;
use std::iter::repeat_n;

/// Neighbouring nodes of one growth unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OfUnit {
    /// How many they are.
    pub nodes: u32,
    /// The rank of the first in the growth unit, from 1.
    pub first: u32,
    /// The last rank that is preformed; later nodes are neoformed.
    pub preformed: u32,
    /// Whether the growth unit is of the short type.
    pub short: bool,
    /// The tick at which they appear.
    pub birth: Tick,
    /// The number of the growth unit on its axis, from 1.
    pub growth_unit: u32,
    /// The clock step of the axis, from 1.
    pub cycle: u32,
}

/// Nodes that follow one another on one axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OfAxis {
    /// How many they are, at least one.
    pub nodes: u32,
    /// The axis.
    pub axis: AxisId,
    /// The node at the base of the first; [`NodeId::NONE`] for the first internode of the trunk.
    pub parent: NodeId,
    /// The rank of the first along the axis, from 1.
    pub rank: u32,
}

/// Nodes that are added at the tips of axes, one axis after another. Each slice but the first two has an entry a node.
#[derive(Debug, Clone, Copy)]
pub struct NewNodes<'a> {
    /// The axes that bear them, in their order. Their nodes are as many as each slice has entries.
    pub axes: &'a [OfAxis],
    /// The growth units that they belong to, in their order. Their nodes are as many as each slice has entries.
    pub units: &'a [OfUnit],
    /// Component numbers.
    pub component: &'a [u32],
    /// Numbers of axillary buds.
    pub axillary_buds: &'a [u32],
    /// Trends, as places among the habit's trends, or the axis's own.
    pub trend: &'a [u8],
    /// Lengths, metres.
    pub length: &'a [f32],
    /// Diameters at birth, metres.
    pub diameter: &'a [f32],
    /// Azimuths, radians.
    pub azimuth: &'a [f32],
}

impl Plant {
    /// Takes the next `count` component numbers and returns the first of them, or `None` where the plant has no room
    /// for so many. Each of them must be given to one of the components that are added next.
    pub fn take_numbers(&mut self, count: u32) -> Option<u32> {
        let first = self.components;
        self.has_room_for(count).then(|| {
            self.components += count;
            first
        })
    }

    /// Adds nodes at the tips of their axes. Linear in the nodes.
    pub fn add_nodes(&mut self, new: &NewNodes<'_>) {
        let mut end = self.nodes.len() as u32;
        self.nodes.extend(new);
        for of in new.axes {
            end += of.nodes;
            self.axes.grown(of.axis, NodeId(end - 1));
        }
    }

    /// Takes out the organs from a place on, which were added while no other component was and for which there is no
    /// room.
    pub fn take_back_organs(&mut self, first: OrganId) {
        self.organs.truncate(first.index());
    }

    /// Adds axes, each with its component number, and returns the first of them. Linear in the axes.
    pub fn add_axes(&mut self, new: &[NewAxis], components: &[u32]) -> AxisId {
        let first = AxisId(self.axes.len() as u32);
        self.axes.extend_columns(new, components);
        first
    }
}

impl Nodes {
    fn extend(&mut self, new: &NewNodes<'_>) {
        let (mut first, count) = (self.len() as u32, new.component.len());
        for of in new.axes {
            if self.axis.last() != Some(&of.axis) {
                self.runs.push(NodeId(first));
            }
            self.parent.push(of.parent);
            self.parent.extend((first..first + of.nodes - 1).map(NodeId));
            self.axis.extend(repeat_n(of.axis, of.nodes as usize));
            self.rank.extend(of.rank..of.rank + of.nodes);
            first += of.nodes;
        }
        self.component.extend_from_slice(new.component);
        self.axillary_buds.extend(new.axillary_buds.iter().map(|&buds| buds_told(buds)));
        self.trend.extend_from_slice(new.trend);
        self.length.extend_from_slice(new.length);
        self.azimuth.extend_from_slice(new.azimuth);
        for column in [&mut self.primary_diameter, &mut self.diameter, &mut self.diameter_tip] {
            column.extend_from_slice(new.diameter);
        }
        self.extend_by_unit(new.units, count);
    }

    /// The columns of which the growth unit decides.
    fn extend_by_unit(&mut self, units: &[OfUnit], count: usize) {
        let in_unit = |rank: u32| u16::try_from(rank).unwrap_or(u16::MAX);
        let formation = |of: &OfUnit, rank: u32| Formation::new(of.short, rank > of.preformed);
        if units.len() == count {
            self.birth.extend(units.iter().map(|of| of.birth));
            self.unit_rank.extend(units.iter().map(|of| in_unit(of.first)));
            self.growth_unit.extend(units.iter().map(|of| told(of.growth_unit)));
            self.cycle.extend(units.iter().map(|of| told(of.cycle)));
            self.formation.extend(units.iter().map(|of| formation(of, of.first)));
            return;
        }
        for of in units {
            let (nodes, ranks) = (of.nodes as usize, of.first..of.first + of.nodes);
            self.birth.extend(repeat_n(of.birth, nodes));
            self.unit_rank.extend(ranks.clone().map(in_unit));
            self.growth_unit.extend(repeat_n(told(of.growth_unit), nodes));
            self.cycle.extend(repeat_n(told(of.cycle), nodes));
            self.formation.extend(ranks.map(|rank| formation(of, rank)));
        }
    }
}
