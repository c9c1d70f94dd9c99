//! The place from which an axis grows on in a tick, and whether a growth unit meets nothing, whatever its way is.
//!
//! An axis with no surface and no stem within the reach of its growth unit asks once a unit, makes its nodes as in the
//! open, and how they lie is not asked. Absent: a unit that is followed past stems (`follow`), and what is asked node
//! by node where something is near (`around`).

use phytomer_sim::plant::{AxisId, NodeId, Plant};
use phytomer_sim::pose::bud_base;
use phytomer_sim::site::solids::{CLEARANCE, Solids};
use phytomer_sim::site::stems::{Spared, Stems};

/// What an internode asks beyond its length and its radius, and more than rounding adds, metres.
const BEYOND: f64 = 3.0 * CLEARANCE;

/// The longest way of a growth unit beyond its first internode for which stems are asked once for all its nodes,
/// metres: about a longer one there are more stems than its nodes ask in turn.
const FURTHEST: f64 = 0.02;

/// How far about an axis surfaces are first looked for, metres.
const LOOKED: f64 = 0.5;

/// Where an axis stood at the end of the last tick.
#[derive(Debug, Clone, Copy)]
pub(super) struct Start {
    /// Its last node, which is posed.
    pub node: Option<NodeId>,
    /// Its tip, metres in the plot.
    pub tip: [f64; 3],
    /// The distance to the nearest surface, or as far as was looked, metres.
    free: f64,
    /// What it has grown since at most, metres.
    pub grown: f64,
    /// How far its growth unit may go on beyond its first internode, metres; 0 of a long one.
    pub further: f64,
    /// How many nodes of its growth unit are known to touch no stem.
    pub past: u32,
}

impl Start {
    /// That of an axis which has not grown in this tick.
    pub fn of(plant: &Plant, axis: AxisId) -> Self {
        let base = bud_base(plant, axis);
        let tip = [0, 1, 2].map(|k| plant.place[k] + f64::from(base[k]));
        Self {
            node: plant.axes.last_node[axis.index()].some(),
            tip,
            grown: 0.0,
            further: 0.0,
            past: 0,
            free: f64::INFINITY,
        }
    }

    /// The same among solids; `None` where it stands in one.
    pub fn among(self, solids: &Solids) -> Option<Self> {
        let looked = if solids.is_empty() { f64::INFINITY } else { LOOKED };
        let free = solids.nearest(self.tip, looked).map_or(looked, |near| near.distance);
        (free > 0.0).then_some(Self { free, ..self })
    }

    /// Whether no surface is as near as what the axis has grown and `reach` beyond it.
    pub fn is_clear_of(&self, solids: &Solids, reach: f64) -> bool {
        let reach = self.grown + reach + BEYOND;
        solids.is_empty()
            || self.free > reach
            || (self.free >= LOOKED && reach.is_finite() && solids.nearest(self.tip, reach).is_none())
    }

    /// Whether it is soon known that no stem is as near as what the axis has grown and `reach` beyond it.
    pub fn is_far(&self, stems: &Stems, reach: f64, spared: Spared) -> bool {
        stems.are_far(self.tip, self.grown + reach + BEYOND, spared)
    }

    /// The same behind a growth unit of at most this length that meets nothing.
    pub fn behind(self, length: f64) -> Self {
        Self { grown: self.grown + length, ..self }
    }

    /// The start before a growth unit which goes on beyond its first internode by no more than `further`, and of which
    /// the first `past` nodes are known to touch no stem.
    pub fn before(self, further: f64, past: u32) -> Self {
        Self { further: if further <= FURTHEST { further } else { 0.0 }, past, ..self }
    }
}
