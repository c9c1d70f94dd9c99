//! The lateral flowers of a block of nodes, with the fruits that they set.
//!
//! Whether a flower opens is tested for all flowers of the block at once. What those that open draw, and the fruits of
//! those that set fruit, is drawn a column at a time.

use super::block::Block;
use crate::buds::compile::{Draws, Number, OrganLaws, Things};
use crate::buds::lives::{Bloom, Drawn, FlowerSite};
use phytomer_sim::clock::NEVER;
use phytomer_sim::plant::NewOrgan;

/// The flowers and fruits of a block.
#[derive(Debug, Default)]
pub struct Flowers {
    things: Things,
    /// The places of the flowers that open among all.
    open: Vec<u32>,
    opened: Things,
    delays: Vec<u32>,
    insertions: Vec<f32>,
    flowers: Organs,
    /// The places of the flowers that set fruit among those that open.
    setting: Vec<u32>,
    set: Things,
    fruits: Organs,
    pub rows: Vec<NewOrgan>,
}

/// What organs of one kind draw.
#[derive(Debug, Default)]
struct Organs {
    lives: Vec<u32>,
    lengths: Vec<f32>,
    widths: Vec<f32>,
}

impl Organs {
    fn draw(&mut self, laws: &OrganLaws, life: &Number, draws: Draws<'_>) {
        life.draw_many(draws, &mut self.lives);
        for (measure, into) in [(&laws.length, &mut self.lengths), (&laws.width, &mut self.widths)] {
            into.resize(draws.things.len(), 0.0);
            measure.draw_many(draws, into, |entry| entry);
        }
    }

    #[inline]
    fn of(&self, place: usize) -> Drawn {
        Drawn { life: self.lives[place], length: self.lengths[place], width: self.widths[place] }
    }
}

impl Flowers {
    /// Draws the flowers of a block: `numbers` of them on its nodes, from the azimuths `first` on and `spacing` apart.
    pub fn draw(&mut self, block: &Block<'_>, numbers: &[u32], first: &[f32], spacing: impl Fn(usize) -> f32) {
        let laws = &block.laws.node;
        self.rows.clear();
        self.open.clear();
        self.setting.clear();
        if laws.flowers.fixed() == Some(0) {
            return;
        }
        self.things.set(numbers, block.records);
        laws.flower_opens.test_many(block.draws(&self.things), |flower| self.open.push(flower as u32));
        if self.open.is_empty() {
            return;
        }
        self.opened.choose(&self.things, &self.open);
        let draws = block.draws(&self.opened);
        laws.flower_delay.draw_many(draws, &mut self.delays);
        self.insertions.resize(self.open.len(), 0.0);
        laws.flower.insertion.draw_many(draws, &mut self.insertions, |entry| entry);
        self.flowers.draw(&laws.flower, &laws.flower_life, draws);
        laws.fruit_set.test_many(draws, |flower| self.setting.push(flower as u32));
        if !self.setting.is_empty() {
            self.set.choose(&self.opened, &self.setting);
            self.fruits.draw(&laws.fruit, &laws.fruit_life, block.draws(&self.set));
        }
        self.set_rows(block, first, spacing);
    }

    /// The flowers and fruits in their order, as organs.
    fn set_rows(&mut self, block: &Block<'_>, first: &[f32], spacing: impl Fn(usize) -> f32) {
        let (mut node, mut piece, mut fruit) = (0, 0, 0);
        for (place, &flower) in self.open.iter().enumerate() {
            let flower = flower as usize;
            while self.things.of(node).end <= flower {
                node += 1;
            }
            while block.pieces[piece].nodes.1 as usize <= node {
                piece += 1;
            }
            let nth = (flower - self.things.of(node).start) as u32;
            let site = FlowerSite {
                node: block.id(node),
                nth,
                birth: block.pieces[piece].at.age.saturating_add(self.delays[place]),
                azimuth: first[node] + spacing(node) * nth as f32,
                position: nth as u16,
            };
            let sets = self.setting.get(fruit) == Some(&(place as u32));
            let drawn = (self.flowers.of(place), sets);
            let of_fruit = || self.fruits.of(fruit);
            let bloom = Bloom::drawn(&block.laws.node, (site, self.insertions[place]), drawn, of_fruit, [NEVER; 2]);
            self.rows.extend(bloom.by(block.model.until()));
            fruit += usize::from(sets);
        }
    }
}
