//! The stems of the plants of a plot, which shoots of the same plants meet (de Reffye et al. 1988 §4: obstruction due
//! "to part of the plant against another part").
//!
//! They are the internodes as they stood at the end of the last tick, so no order of plants and no number of threads
//! shows: each a straight piece of wood whose radius goes evenly from its base to its tip. Those of a plant lie in its
//! own frame under a bounding tree over pieces of its axes, the plants under a tree over the plot; so memory follows
//! the wood, and a bud far from all wood asks one tree. What is near a bud is copied from here ([`Beside`]). Absent:
//! leaves, flowers and fruits, which no shoot meets.

mod beside;
mod segments;
#[cfg(test)]
mod tests;

pub use beside::{Beside, Spared, Touch};

use crate::clock::Tick;
use crate::plant::{NodeId, Plant};
use crate::shape::tree::{Tree, Walk};
use crate::shape::{Bounds, Point};
use crate::vector::Vector;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};
use std::sync::OnceLock;

/// The most internodes under one leaf of a tree.
const PIECE: usize = 8;

/// Whose stems shoots meet.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Whose {
    /// None's: shoots grow through stems.
    #[default]
    Nobody,
    /// Those of the other plants of the plot.
    Neighbours,
    /// Those of all plants of the plot, their own among them but for the axis itself.
    All,
}

/// The stems of a plot.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Stems {
    whose: Whose,
    plants: Vec<OfPlant>,
    /// Over the plants, in the plot.
    tree: Tree,
}

/// The stems of one plant, metres from its seed.
#[derive(Debug, Clone, PartialEq)]
struct OfPlant {
    number: u32,
    place: Point,
    stems: Vec<Stem>,
    /// Where each piece begins in the stems, and where the last one ends.
    pieces: Vec<u32>,
    /// The bounds of each piece.
    bounds: Vec<Bounds>,
    /// Over the pieces; made when a bud comes near.
    tree: OnceLock<Tree>,
}

/// One internode.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Stem {
    start: [f32; 3],
    end: [f32; 3],
    /// At its base and at its tip.
    radii: [f32; 2],
    axis: u32,
}

impl Stems {
    /// The stems of plants that are posed, each at its age; a plant without an age is not sown yet. Linear in the
    /// internodes that stand. The tree of a plant is made when a bud first comes near it, at the cost of a logarithm of
    /// its pieces more.
    pub fn of(plants: &[Plant], ages: &[Option<Tick>], whose: Whose) -> Self {
        let one = |(plant, age): (&Plant, &Option<Tick>)| OfPlant::of(plant, *age);
        let plants: Vec<OfPlant> = plants.par_iter().zip(ages).map(one).collect();
        let tree = Tree::of(&plants.iter().map(OfPlant::bounds).collect::<Vec<_>>());
        Self { whose, plants, tree }
    }

    /// Whose stems they are for a shoot.
    pub fn whose(&self) -> Whose {
        self.whose
    }

    /// Shows each stem that may be met and is nearer than `reach` to a point, in a fixed order.
    fn each_near(&self, point: Point, reach: f64, spared: Spared, show: &mut impl FnMut(&OfPlant, &Stem)) {
        let far = |bounds: &Bounds, point: Point| bounds.square_distance(point) >= reach * reach;
        self.tree.walk(|_, bounds, item| {
            if far(bounds, point) {
                return Walk::Past;
            }
            let Some(plant) = item.map(|item| &self.plants[item]) else { return Walk::Below };
            let is_own = plant.number == spared.plant;
            if is_own && self.whose != Whose::All {
                return Walk::Past;
            }
            let at = [0, 1, 2].map(|k| point[k] - plant.place[k]);
            plant.tree().walk(|_, bounds, piece| {
                if far(bounds, at) {
                    return Walk::Past;
                }
                for stem in piece.map_or(&[][..], |piece| plant.piece(piece)) {
                    if !(is_own && stem.axis == spared.axis) && stem.distance(at) < reach {
                        show(plant, stem);
                    }
                }
                Walk::Below
            });
            Walk::Below
        });
    }
}

impl OfPlant {
    fn of(plant: &Plant, age: Option<Tick>) -> Self {
        let mut of = Self::empty(plant.id, plant.place);
        if let Some(age) = age {
            plant.each_standing(age, |stretch| {
                let nodes = stretch.nodes();
                let posed = nodes.start..nodes.end.min(plant.frames.base.len());
                for start in posed.clone().step_by(PIECE) {
                    of.add((start..posed.end.min(start + PIECE)).map(|node| Stem::of(plant, node)));
                }
            });
        }
        of
    }

    fn empty(number: u32, place: Point) -> Self {
        Self { number, place, stems: Vec::new(), pieces: vec![0], bounds: Vec::new(), tree: OnceLock::new() }
    }

    /// Adds a piece of an axis.
    fn add(&mut self, stems: impl Iterator<Item = Stem>) {
        let first = self.stems.len();
        self.stems.extend(stems);
        self.pieces.push(self.stems.len() as u32);
        let bounds = self.stems[first..].iter().fold(Bounds::NOTHING, |all, stem| all.with(&stem.bounds()));
        self.bounds.push(bounds);
    }

    fn tree(&self) -> &Tree {
        self.tree.get_or_init(|| Tree::of(&self.bounds))
    }

    fn piece(&self, piece: usize) -> &[Stem] {
        &self.stems[self.pieces[piece] as usize..self.pieces[piece + 1] as usize]
    }

    /// Its bounds in the plot.
    fn bounds(&self) -> Bounds {
        let Bounds { low, high } = self.bounds.iter().fold(Bounds::NOTHING, |all, piece| all.with(piece));
        let placed = |corner: Point| [0, 1, 2].map(|k| corner[k] + self.place[k]);
        Bounds { low: placed(low), high: placed(high) }
    }
}

impl Stem {
    fn of(plant: &Plant, node: usize) -> Self {
        let frame = plant.frames.at(NodeId(node as u32));
        let end = frame.advanced(plant.posed_length(NodeId(node as u32))).base;
        let radii = [plant.nodes.diameter[node], plant.nodes.diameter_tip[node]].map(|diameter| 0.5 * diameter);
        Self { start: frame.base, end, radii, axis: plant.nodes.axis[node].0 }
    }

    fn bounds(&self) -> Bounds {
        let ends = [self.start, self.end].map(|end| end.map(f64::from));
        Bounds::of_points(&ends).with_margin(f64::from(self.radii[0].max(self.radii[1])))
    }

    /// The distance from a point to its bark, metres, negative within.
    fn distance(&self, at: Point) -> f64 {
        beside::Near::of(self, [0.0; 3], 0).distance(Vector::of(at))
    }
}
