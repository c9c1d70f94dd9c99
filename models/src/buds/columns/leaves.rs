//! The leaves of a block of nodes, a column of all leaves at a time.

use super::block::Block;
use crate::buds::compile::{LeafFall, Things};
use crate::buds::lives::{fall_of_year, fall_when, leaf_fall};
use phytomer_sim::clock::NEVER;
use phytomer_sim::plant::{Cause, NewOrgan};

/// The leaves of a block.
#[derive(Debug, Default)]
pub struct Leaves {
    pub things: Things,
    pub rows: Vec<NewOrgan>,
    /// The life of each, where lives are limited.
    lives: Vec<u32>,
    /// The tick of the year at which each falls, where leaves draw it.
    falls: Vec<u32>,
}

impl Leaves {
    /// Forgets the leaves of the block before.
    pub fn clear(&mut self) {
        self.rows.clear();
    }

    /// Draws the leaves of a block: `numbers` of them on its nodes, from the azimuths `first` on and `spacing` apart.
    pub fn draw(&mut self, block: &Block<'_>, numbers: &[u32], first: &[f32], spacing: &[f32]) {
        let law = &block.laws.node.leaf;
        self.things.set(numbers, block.records);
        self.rows.clear();
        if self.things.len() == 0 {
            return;
        }
        self.rows.reserve(self.things.len());
        for piece in block.pieces {
            for node in piece.places() {
                let (id, first, spacing) = (block.id(node), first[node], spacing[node]);
                for nth in 0..numbers[node] {
                    self.rows.push(NewOrgan {
                        node: id,
                        kind: law.kind,
                        position: nth as u16,
                        birth: piece.at.age,
                        death: NEVER,
                        cause: Cause::None,
                        form: law.form,
                        length: 0.0,
                        width: 0.0,
                        area: 0.0,
                        azimuth: first + spacing * nth as f32,
                        insertion: 0.0,
                    });
                }
            }
        }
        let draws = block.draws(&self.things);
        law.length.draw_many(draws, &mut self.rows, |leaf| &mut leaf.length);
        law.width.draw_many(draws, &mut self.rows, |leaf| &mut leaf.width);
        law.area_share.draw_many(draws, &mut self.rows, |leaf| &mut leaf.area);
        self.rows.iter_mut().for_each(|leaf| leaf.area *= leaf.length * leaf.width);
        law.insertion.draw_many(draws, &mut self.rows, |leaf| &mut leaf.insertion);
        self.set_ends(block);
    }

    /// Sets the ends of the leaves, by their lives or the season.
    fn set_ends(&mut self, block: &Block<'_>) {
        let laws = &block.laws.node;
        let draws = block.draws(&self.things);
        if let Some(life) = &laws.leaf_life {
            life.draw_many(draws, &mut self.lives);
        }
        if let Some(LeafFall::OfYear(_, fall)) = &laws.leaf_fall {
            fall.draw_many(draws, &mut self.falls);
        }
        let has_lives = laws.leaf_life.is_some();
        for (place, leaf) in self.rows.iter_mut().enumerate() {
            let life = has_lives.then(|| self.lives[place]);
            let seasonal = laws.leaf_fall.as_ref().map_or(NEVER, |fall| match fall {
                LeafFall::OfYear(year, _) => fall_of_year(*year, self.falls[place], leaf.birth),
                LeafFall::When(falls) => fall_when(falls, leaf.birth),
            });
            (leaf.death, leaf.cause) = leaf_fall(seasonal, leaf.birth, life);
        }
    }
}
