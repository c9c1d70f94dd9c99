//! The lateral flowers of a block of nodes, with the fruits that they set.
//!
//! Whether a flower opens is tested for all flowers of the block at once; few open, and those are drawn one by one.

use super::block::Block;
use crate::buds::compile::Things;
use crate::buds::lives::{Bloom, FlowerSite};
use phytomer_sim::clock::NEVER;
use phytomer_sim::plant::NewOrgan;

/// The flowers and fruits of a block.
#[derive(Debug, Default)]
pub struct Flowers {
    things: Things,
    /// The flowers that open.
    open: Vec<u32>,
    pub rows: Vec<NewOrgan>,
}

impl Flowers {
    /// Draws the flowers of a block: `numbers` of them on its nodes, from the azimuths `first` on and `spacing` apart.
    pub fn draw(&mut self, block: &Block<'_>, numbers: &[u32], first: &[f32], spacing: impl Fn(usize) -> f32) {
        let laws = &block.laws.node;
        self.rows.clear();
        self.open.clear();
        if laws.flowers.fixed() == Some(0) {
            return;
        }
        self.things.set(numbers, laws.width);
        let open = &mut self.open;
        laws.flower_opens.test_many(block.draws(&self.things), |flower| open.push(flower as u32));
        let (mut node, mut piece) = (0, 0);
        for &flower in &self.open {
            let flower = flower as usize;
            while self.things.of(node).end <= flower {
                node += 1;
            }
            while block.pieces[piece].nodes.1 as usize <= node {
                piece += 1;
            }
            let (at, words) = (block.pieces[piece].at(node), block.record(node));
            let nth = (flower - self.things.of(node).start) as u32;
            let site = FlowerSite {
                node: block.id(node),
                nth,
                birth: at.age.saturating_add(laws.flower_delay.draw(words, nth, at)),
                azimuth: first[node] + spacing(node) * nth as f32,
                position: nth as u16,
            };
            self.rows.extend(Bloom::of(laws, words, site, [NEVER; 2], at).by(block.model.until()));
        }
    }
}
