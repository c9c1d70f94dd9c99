//! The axes that arise from the buds of a block of nodes: axillary buds that ramify, and reiteration buds.
//!
//! Whether a bud becomes an axis is tested for all buds at once, or node by node where there are zones; the few that do
//! are drawn one by one.

use super::block::Block;
use crate::buds::birth::shed_after;
use crate::buds::compile::{Along, Chance};
use crate::buds::plan::Shoot;
use crate::buds::site::{Bearing, BudSite, spacing};
use crate::law::At;
use phytomer_sim::plant::{Dormant, NewAxis, Plant};

/// A bud that becomes an axis.
#[derive(Debug, Clone, Copy)]
struct Released {
    node: u32,
    position: u32,
    reiterates: bool,
    /// The state that its zone states.
    state: Option<u8>,
}

/// The axes of a block.
#[derive(Debug, Default)]
pub struct NewAxes {
    /// The numbers of reiteration buds of each node.
    numbers: Vec<u32>,
    released: Vec<Released>,
    pub rows: Vec<NewAxis>,
}

impl NewAxes {
    /// Draws the axes of a block, whose nodes have `buds` axillary buds, from the azimuths `first` on and `spacing`
    /// apart.
    pub fn draw(&mut self, block: &Block<'_>, buds: &[u32], first: &[f32], spacing: &[f32]) {
        self.released.clear();
        self.rows.clear();
        self.ramify(block, buds);
        self.reiterate(block);
        let (mut piece, mut shoot) = (0, 0);
        for &released in &self.released {
            while block.pieces[piece].nodes.1 <= released.node {
                piece += 1;
            }
            while block.shoots[shoot].nodes.1 <= released.node {
                shoot += 1;
            }
            let node = released.node as usize;
            let at = block.pieces[piece].at(node);
            let new = self.axis((block, &block.shoots[shoot]), released, at, (first[node], spacing[node]));
            self.rows.push(new);
        }
    }

    /// Which axillary buds ramify.
    fn ramify(&mut self, block: &Block<'_>, buds: &[u32]) {
        let laws = &block.laws.node;
        if laws.axillary.count.fixed() == Some(0) || !block.model.has_order(block.laws.number + 1) {
            return;
        }
        let released = &mut self.released;
        let Some(zones) = &laws.zones else {
            return test(block, &laws.axillary.chance, buds, |node, position| {
                released.push(Released { node, position, reiterates: false, state: None });
            });
        };
        for piece in block.pieces {
            let drawn = block.zones_of(piece);
            for node in piece.places() {
                let rank = piece.rank(node);
                let Some(of) = zones.ramification(rank, piece.unit_nodes, drawn, &laws.axillary.chance) else {
                    continue;
                };
                let (words, at) = (block.record(node), piece.at(node));
                let outcome = of.chance.outcome(at);
                for position in 0..buds[node] {
                    if outcome.happens(|| of.chance.word(words, position)) {
                        let state = of.state(words, position, at);
                        released.push(Released { node: node as u32, position, reiterates: false, state });
                    }
                }
            }
        }
    }

    /// Which reiteration buds become axes: they follow the axillary axes of their node.
    fn reiterate(&mut self, block: &Block<'_>) {
        let laws = &block.laws.node.reiteration;
        if laws.count.fixed() == Some(0) {
            return;
        }
        laws.count.draw_many(block.draws(), &mut self.numbers);
        let Self { numbers, released, .. } = self;
        let axillary = released.len();
        test(block, &laws.chance, numbers, |node, position| {
            released.push(Released { node, position, reiterates: true, state: None });
        });
        if released.len() > axillary {
            released.sort_by_key(|released| (released.node, released.reiterates));
        }
    }

    /// The axis of a bud, with what it draws at its birth.
    fn axis(
        &self,
        (block, shoot): (&Block<'_>, &Shoot),
        of: Released,
        at: At,
        (first, between): (f32, f32),
    ) -> NewAxis {
        let Released { node, position, reiterates, state } = of;
        let (laws, node) = (&block.laws.node, node as usize);
        let bearing = Bearing { key: shoot.key, state: at.state };
        let (id, rank) = (block.id(node), shoot.rank(node));
        let new = if reiterates {
            let place = (first + between / 2.0, spacing(self.numbers[node]));
            let site = BudSite::reiteration(id, (laws.reiteration_order, rank), position, place);
            site.axis(&laws.reiteration, block.record(node), bearing, at)
        } else {
            let site = BudSite::axillary(id, (block.laws.number + 1, rank), position, (first, between));
            BudSite { state, ..site }.axis(&laws.axillary, block.record(node), bearing, at)
        };
        NewAxis { shed_after: shed_after(block.model, block.random, &new), ..new }
    }

    /// The axillary buds of a node that lie dormant, one bit a position.
    pub fn dormant(&self, node: usize, buds: u32) -> u32 {
        let all = if buds >= 32 { u32::MAX } else { (1 << buds) - 1 };
        let start = self.released.partition_point(|released| (released.node as usize) < node);
        let of_node = self.released[start..].iter().take_while(|released| released.node as usize == node);
        of_node.filter(|released| !released.reiterates).fold(all, |all, released| all & !(1 << released.position))
    }

    /// Writes down the dormant buds of every node.
    pub fn remember_dormant(&self, plant: &mut Plant, block: &Block<'_>, buds: &[u32], spacing: &[f32]) {
        block.each(|node, piece, _| {
            if buds[node] > 0 {
                let dormant = self.dormant(node, buds[node]);
                let of = Dormant { buds: dormant, spacing: spacing[node], state: piece.at.state };
                plant.dormant.set(block.id(node), of);
            }
        });
    }
}

/// Tests `numbers` buds of the nodes of a block; `told` is called with the node and the position of each for which the
/// event happens.
#[inline]
fn test(block: &Block<'_>, chance: &Chance, numbers: &[u32], mut told: impl FnMut(u32, u32)) {
    let Some(first) = block.pieces.first().filter(|_| !chance.is_never()) else { return };
    let mut tests = Along::of(chance, first);
    for piece in block.pieces {
        tests.go_to(piece);
        for node in piece.places() {
            tests.stand_on(piece, node);
            let words = block.record(node);
            for position in 0..numbers[node] {
                if tests.now.happens(words, position) {
                    told(node as u32, position);
                }
            }
        }
    }
}
