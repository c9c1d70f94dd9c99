//! The place from which an axis grows on in a tick, and whether a growth unit meets nothing, whatever its way is.
//!
//! An axis with no stem within the reach of its growth unit asks once a unit, makes its nodes as in the open, and
//! how they lie is not asked. Absent: what is asked node by node where something is near (`around`).

use super::compile::Reach;
use phytomer_sim::plant::{AxisId, NodeId, Plant};
use phytomer_sim::pose::bud_base;
use phytomer_sim::site::solids::CLEARANCE;
use phytomer_sim::site::stems::{Spared, Stems};

/// What an internode asks beyond its length and its radius, and more than rounding adds, metres.
const BEYOND: f64 = 3.0 * CLEARANCE;

/// The longest way of a growth unit beyond its first internode for which stems are asked once for all its nodes,
/// metres: about a longer one there are more stems than its nodes ask in turn.
const FURTHEST: f64 = 0.02;

/// Where an axis stood at the end of the last tick.
#[derive(Debug, Clone, Copy)]
pub(super) struct Start {
    /// Its last node, which is posed.
    pub node: Option<NodeId>,
    /// Its tip, metres in the plot.
    pub tip: [f64; 3],
    /// What it has grown since at most, metres.
    pub grown: f64,
    /// How far its growth unit may go on beyond its first internode, metres; 0 of a long one.
    pub further: f64,
}

impl Start {
    /// That of an axis which has not grown in this tick.
    pub fn of(plant: &Plant, axis: AxisId) -> Self {
        let base = bud_base(plant, axis);
        let tip = [0, 1, 2].map(|k| plant.place[k] + f64::from(base[k]));
        Self { node: plant.axes.last_node[axis.index()].some(), tip, grown: 0.0, further: 0.0 }
    }

    /// Whether no internode of a growth unit of so many nodes comes near a stem; then it has grown by them.
    pub fn grows(&mut self, reach: &Reach, (short, nodes): (bool, u32), stems: &Stems, spared: Spared) -> bool {
        let grown = self.grown + reach.length(short, nodes);
        let is_free = stems.are_far(self.tip, grown + reach.radius + BEYOND, spared);
        if is_free {
            self.grown = grown;
        }
        let further = reach.length(short, nodes) - reach.length(short, 1);
        self.further = if further <= FURTHEST { further } else { 0.0 };
        is_free
    }
}
