//! A life in the making: the plant is shown age by age, and the life comes out at the end.
//!
//! At each age the plant must stand as it does then, posed and with its diameters. An age that is not later than the
//! last is left out. Absent: growth, which is the caller's: a recorder of a plot shows what grows (`lives`).

use super::lines::{Lines, Showing};
use super::parts::Parts;
use super::{Life, Nearness};
use phytomer_meshes::{MeshOptions, Scene, chains};
use phytomer_sim::Tick;
use phytomer_sim::plant::Plant;

/// The part of the tolerance by which an internode may begin beside the tip of the internode before it on its line.
const GAP: f32 = 1.0 / 16.0;

/// Makes the life of one plant.
#[derive(Debug, Clone)]
pub struct Maker {
    nearness: Nearness,
    options: MeshOptions,
    life: Life,
    lines: Lines,
    parts: Parts,
}

impl Maker {
    /// The maker of a life this near to the plant; `options` are those of its meshes, of which the kinds that are drawn
    /// and the forms are taken.
    pub fn new(nearness: Nearness, options: &MeshOptions) -> Self {
        let distance = nearness.distance.max(f32::MIN_POSITIVE);
        let nearness = Nearness { distance, ..nearness };
        let options = MeshOptions { tolerance: None, ..options.clone() };
        Self { nearness, options, life: Life::default(), lines: Lines::default(), parts: Parts::default() }
    }

    /// Shows the plant at a later age than before, or on its way to `age` ([`phytomer_sim::between`]). Takes O(n log n)
    /// for n components that stand, at most.
    pub fn show(&mut self, plant: &Plant, age: Tick) {
        let at = plant.shown_age(age) as f32;
        if self.life.ages.last().is_some_and(|last| *last >= at) {
            return;
        }
        self.life.ages.push(at);
        (self.life.plant, self.life.place) = (plant.id, plant.place);
        let scene = Scene::new(plant, age, &self.options);
        if self.life.nears.is_none() {
            self.life.nears = scene.nears().cloned();
        }
        let (stems, nearness) = (scene.stems(), self.nearness);
        let apart = Vec::new();
        let last = (u32::MAX, 0);
        let mut showing = Showing { stems, age: at, nearness, lines: &mut self.lines, apart, last };
        chains(stems, nearness.distance * GAP, &mut showing);
        let apart = showing.apart;
        self.lines.end_unseen(at);
        self.parts.show(&scene, &apart, at, nearness);
    }

    /// The life of all that was shown.
    pub fn finish(self) -> Life {
        let Self { mut life, lines, parts, .. } = self;
        lines.finish(&mut life);
        parts.finish(&mut life);
        life
    }
}
