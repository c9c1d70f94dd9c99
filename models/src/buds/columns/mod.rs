//! All nodes that axes of one order have decided on, made at once.
//!
//! The words of the nodes are read in bulk; one loop a column draws lengths, angles and numbers of organs and buds, and
//! one loop over the nodes draws their organs and gives the component numbers. The plant is the same to the bit as node
//! by node (`node`), where an axis goes that meets obstacles, has pests, or responds node by node. Both ways share
//! their formulas (`compile`, `site`, `lives`). Absent: the steps at which the axis decides (`grow`).

mod axes;
mod block;
mod dress;
mod dressing;
mod nodes;
mod organs;

pub use block::Block;

use super::birth::give_trends;
use super::bud::ApicalBud;
use super::plan::Shoot;
use super::site;
use axes::NewAxes;
use dressing::Borne;
use nodes::NodeColumns;
use organs::Numbers;
use phytomer_sim::plant::{AxisId, Event, EventKind, NewAxis, NewNodes, OfAxis, OrganId, Origin, Plant};

/// Room for the columns of a block, which all axes use in turn.
#[derive(Debug, Default)]
pub struct Columns {
    nodes: NodeColumns,
    /// The numbers of leaves, of flowers and of axillary buds of each node.
    leaf_numbers: Vec<u32>,
    flower_numbers: Vec<u32>,
    bud_numbers: Vec<u32>,
    /// The angle between two neighbouring positions around each node, radians.
    spacing: Vec<f32>,
    axes: NewAxes,
    numbers: Numbers,
    shoots: Vec<OfAxis>,
    /// The bud of each axis, as its nodes leave it.
    pub buds: Vec<ApicalBud>,
}

impl Columns {
    /// Makes the nodes of a block, between the events of their buds. Whether the plant has room for them; otherwise it
    /// has none of them.
    pub fn make(&mut self, block: &Block<'_>, plant: &mut Plant, events: &[(u32, Event)]) -> bool {
        let organs = OrganId(plant.organs.len() as u32);
        self.draw(block, plant);
        let has_room = self.write(block, plant, events);
        if !has_room {
            plant.take_back_organs(organs);
        }
        let mut buds = std::mem::take(&mut self.buds);
        buds.clear();
        let shoots = block.shoots.iter().zip(&self.nodes.next_azimuth);
        buds.extend(shoots.map(|(shoot, &azimuth)| self.bud_after(block, shoot, azimuth)));
        self.buds = buds;
        has_room
    }

    /// Draws everything of a block; its organs are added to those of the plant.
    fn draw(&mut self, block: &Block<'_>, plant: &mut Plant) {
        let number = plant.components();
        let laws = &block.laws.node;
        self.nodes.draw(block);
        if laws.is_bare {
            self.bud_numbers.clear();
            self.bud_numbers.resize(block.nodes(), 0);
            self.axes.rows.clear();
            return self.numbers.set_bare(block, number, &[]);
        }
        let draws = block.draws();
        laws.leaves.draw_many(draws, &mut self.leaf_numbers);
        laws.flowers.draw_many(draws, &mut self.flower_numbers);
        laws.axillary.count.draw_many(draws, &mut self.bud_numbers);
        let places = self.leaf_numbers.iter().zip(&self.bud_numbers).map(|(&leaves, &buds)| leaves.max(buds));
        self.spacing.clear();
        self.spacing.extend(places.map(site::spacing));
        self.axes.draw(block, &self.bud_numbers, &self.nodes.azimuth, &self.spacing);
        let borne = Borne {
            leaves: &self.leaf_numbers,
            flowers: &self.flower_numbers,
            buds: &self.bud_numbers,
            azimuth: &self.nodes.azimuth,
            spacing: &self.spacing,
            axes: &self.axes.rows,
        };
        self.numbers.draw(block, number, &borne, &mut plant.organs);
    }

    /// Writes what was drawn into the columns of the plant. Whether the plant has room for it.
    fn write(&mut self, block: &Block<'_>, plant: &mut Plant, events: &[(u32, Event)]) -> bool {
        let axes = self.axes.rows.as_slice();
        if plant.take_numbers(self.numbers.next.wrapping_sub(plant.components())).is_none() {
            return false;
        }
        let nodes = &self.nodes;
        self.shoots.clear();
        self.shoots.extend(block.shoots.iter().map(|shoot| OfAxis {
            nodes: shoot.nodes.1 - shoot.nodes.0,
            axis: shoot.bud.axis,
            parent: shoot.bud.last_node,
            rank: shoot.bud.rank + 1,
        }));
        plant.add_nodes(&NewNodes {
            axes: &self.shoots,
            units: &nodes.units,
            component: &self.numbers.nodes,
            axillary_buds: &self.bud_numbers,
            trend: &nodes.trend,
            length: &nodes.length,
            diameter: &nodes.diameter,
            azimuth: &nodes.azimuth,
        });
        let first = plant.add_axes(axes, &self.numbers.axes);
        for (place, axis) in axes.iter().enumerate() {
            give_trends(block.model, plant, axis, AxisId(first.0 + place as u32));
        }
        if plant.dormant.are_kept() && !block.laws.node.is_bare {
            self.axes.remember_dormant(plant, block, &self.bud_numbers, &self.spacing);
        }
        note_events(block, plant, events, axes, first);
        true
    }

    /// The bud of an axis when it has made its nodes.
    fn bud_after(&self, block: &Block<'_>, shoot: &Shoot, azimuth: f32) -> ApicalBud {
        let (bud, last) = (shoot.bud, shoot.nodes.1 as usize - 1);
        let made = ApicalBud { azimuth, rank: shoot.rank(last), last_node: block.id(last), passages: 0, ..bud };
        if block.laws.node.is_bare {
            return ApicalBud { dormant: 0, ..made };
        }
        let dormant = self.axes.dormant(last, self.bud_numbers[last]);
        ApicalBud { dormant, bud_spacing: self.spacing[last], ..made }
    }
}

/// Writes down the events of a block, where the plant keeps them: those of the bud, and between them, node by node, the
/// axes that arise.
fn note_events(block: &Block<'_>, plant: &mut Plant, planned: &[(u32, Event)], axes: &[NewAxis], first: AxisId) {
    let Some(events) = &mut plant.events else { return };
    let mut own = planned;
    for (place, new) in axes.iter().enumerate() {
        let node = new.bearer.map_or(0, |bearer| bearer.0 - block.first.0);
        let before = own.iter().take_while(|(nodes, _)| *nodes <= node).count();
        let (earlier, later) = own.split_at(before);
        events.extend(earlier.iter().map(|(_, event)| *event));
        own = later;
        let kind = if new.origin == Origin::Adaptive { EventKind::Reiterated } else { EventKind::Branched };
        let axis = AxisId(first.0 + place as u32);
        events.push(Event { tick: new.appearance, axis, kind, count: 1, state: new.state });
    }
    events.extend(own.iter().map(|(_, event)| *event));
}
