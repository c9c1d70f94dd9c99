//! A plant at all keys as patches: parts of it whose vertices and triangles are the same at all keys.
//!
//! Their places are whole numbers of 16 bits: multiples of a step that is a 32,766th of the largest extent, so that the
//! move from any place to any other is such a number too. Absent: what moves where (`morph`).

use super::keys::{Alone, Keyed};
use super::paint::class_of;
use super::wood::{Ring, Tube};
use phytomer_meshes::Slot;
use std::ops::Range;

/// The largest place on the grid, half of the largest number of 16 bits: the difference of two places must fit too.
const REACH: f64 = 16_383.0;

/// A plant, or what stands among plants, at all keys.
pub struct Body {
    /// What it is called.
    pub name: String,
    /// The place of its seed, metres from the place of the file.
    pub place: [f64; 3],
    /// How it is shown at each key.
    pub keyed: Keyed,
}

/// The grid of positions of a body.
#[derive(Debug, Clone, Copy)]
pub struct Grid {
    pub middle: [f64; 3],
    pub step: f64,
}

impl Grid {
    fn of([low, high]: [[f32; 3]; 2]) -> Self {
        let half = |k: usize| 0.5 * (f64::from(high[k]) - f64::from(low[k]));
        let middle = [0, 1, 2].map(|k| f64::from(low[k]) + half(k));
        let largest = [0, 1, 2].map(half).into_iter().fold(0.0, f64::max);
        Self { middle, step: if largest > 0.0 { largest / REACH } else { 1.0 } }
    }

    #[inline]
    fn place(&self, at: [f32; 3]) -> [i16; 3] {
        [0, 1, 2].map(|k| ((f64::from(at[k]) - self.middle[k]) / self.step).round().clamp(-REACH, REACH) as i16)
    }
}

/// A part of a body whose vertices and triangles are the same at all keys.
#[derive(Clone, Copy)]
pub enum Patch<'a> {
    Tube(&'a Tube),
    Alone(&'a Alone),
}

impl Patch<'_> {
    /// The keys at which it stands.
    fn keys(self) -> Range<usize> {
        match self {
            Self::Tube(tube) => tube.keys.clone(),
            Self::Alone(alone) => alone.keys(),
        }
    }

    /// The nearest of the keys at which it stands and of the two beside them: at all keys beyond it is the same point.
    pub fn near(self, key: usize, keys: usize) -> usize {
        let stands = self.keys();
        key.clamp(stands.start.saturating_sub(1), stands.end.min(keys - 1))
    }
}

/// A body ready to be written.
pub struct Drawn<'a> {
    pub body: &'a Body,
    tubes: Vec<Tube>,
    pub grid: Grid,
    /// Whether anything of it is not the same at all keys.
    pub moves: bool,
}

/// Working memory.
#[derive(Default)]
pub struct Scratch {
    pub rings: Vec<Ring>,
    pub corners: Vec<[f32; 3]>,
    pub faces: Vec<[u32; 3]>,
    pub base: Vec<[i16; 3]>,
    pub state: Vec<[i16; 3]>,
}

impl<'a> Drawn<'a> {
    pub fn of(body: &'a Body, tolerance: f32) -> Self {
        let tubes = Tube::all(&body.keyed, tolerance);
        let mut drawn = Self { body, tubes, grid: Grid { middle: [0.0; 3], step: 1.0 }, moves: false };
        let mut bounds: Option<[[f32; 3]; 2]> = None;
        let (mut scratch, keys) = (Scratch::default(), body.keyed.keys());
        for patch in (0..drawn.slots().len()).flat_map(|slot| drawn.patches(slot)) {
            for key in patch.near(0, keys)..=patch.near(keys - 1, keys) {
                drawn.corners(patch, key, &mut scratch);
                for at in &scratch.corners {
                    let [low, high] = bounds.get_or_insert([*at, *at]);
                    (0..3).for_each(|k| (low[k], high[k]) = (low[k].min(at[k]), high[k].max(at[k])));
                }
            }
        }
        drawn.grid = Grid::of(bounds.unwrap_or_default());
        drawn.moves = (0..keys).any(|key| body.keyed.age(key).is_some());
        drawn
    }

    /// The materials.
    pub fn slots(&self) -> &'a [Slot] {
        self.body.keyed.slots.list()
    }

    /// What has a material.
    pub fn patches(&self, slot: usize) -> impl Iterator<Item = Patch<'_>> {
        let slots = &self.body.keyed.slots;
        let of_tube = move |tube: &&Tube| slots.of_component(0, tube.first(), 0) == slot;
        let tubes = self.tubes.iter().filter(of_tube).map(Patch::Tube);
        let of_alone = move |alone: &&Alone| match u32::try_from(alone.tag.component) {
            Ok(component) => slots.of_component(0, component, class_of(&alone.tag)) == slot,
            Err(_) => slot + 1 == slots.list().len(),
        };
        tubes.chain(self.body.keyed.alone.iter().filter(of_alone).map(Patch::Alone))
    }

    pub fn corners(&self, patch: Patch, key: usize, scratch: &mut Scratch) {
        let Scratch { rings, corners, .. } = scratch;
        match patch {
            Patch::Alone(alone) => self.body.keyed.corners(alone, key, corners),
            Patch::Tube(tube) => {
                corners.clear();
                tube.skin(&self.body.keyed, key, rings, &mut |at, _| corners.push(at.to_array()));
            }
        }
    }

    /// The places of a patch on the grid at a key.
    pub fn state(&self, patch: Patch, key: usize, scratch: &mut Scratch) {
        self.corners(patch, key, scratch);
        let Scratch { corners, state, .. } = scratch;
        state.clear();
        state.extend(corners.iter().map(|at| self.grid.place(*at)));
    }

    pub fn faces(&self, patch: Patch, scratch: &mut Scratch) {
        match patch {
            Patch::Tube(tube) => tube.faces(&self.body.keyed, &mut scratch.faces),
            Patch::Alone(alone) => {
                scratch.faces.clear();
                scratch.faces.extend_from_slice(&self.body.keyed.faces[alone.faces.clone()]);
            }
        }
    }

    pub fn vertices(&self, patch: Patch) -> usize {
        match patch {
            Patch::Tube(tube) => tube.vertices(&self.body.keyed),
            Patch::Alone(alone) => alone.vertices(),
        }
    }
}
