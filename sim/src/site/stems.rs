//! The stems of the plants of a plot, which shoots of the same plants meet (de Reffye et al. 1988 §4: obstruction due
//! "to part of the plant against another part").
//!
//! They are the internodes as they stood at the end of the last tick, so no order of plants and no number of threads
//! shows: each a straight piece of wood whose radius goes evenly from its base to its tip. From tick to tick they are
//! kept, plant by plant, with a box about them. A bud asks the plants alone whose boxes are near. Of a plant that is
//! asked, what has come, moved, grown much thicker or fallen is entered anew in the cells of space in which its stems
//! lie (`cells`); so a bud far from all wood asks a few bits. Buds that look around, as climbers do, ask trees.
//! What is near a bud is copied from here ([`Beside`]). Absent: leaves, flowers and fruits, which no shoot meets.

mod beside;
mod cells;
mod line;
mod of_plant;
mod segments;
mod stem;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_line;

pub use beside::{Beside, Spared, Touch};
pub use line::Line;

use crate::clock::Tick;
use crate::plant::Plant;
use crate::shape::tree::{Tree, Walk};
use crate::shape::{Bounds, Point};
use cells::NO_AXIS;
use of_plant::OfPlant;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, IntoParallelRefMutIterator, ParallelIterator};
use std::sync::OnceLock;
use stem::{ROUNDING, Stem};

/// The fewest plants whose stems are followed on several threads.
const FEWEST_PLANTS: usize = 16;
/// How far from the box about a plant the plants are known that are beside it, metres along each axis.
const ASIDE: f64 = 0.5;
/// The reach up to which cells are asked whether all stems are far, metres: a ball of few cells.
const SHORT: f64 = 0.25;

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

/// The stems of a plot. Two are equal where the same stems stand, however they came to be known.
#[derive(Debug, Clone, Default)]
pub struct Stems {
    whose: Whose,
    plants: Vec<OfPlant>,
    /// The numbers of the plants, rising, with their places among them.
    places: Vec<(u32, u32)>,
    /// Over the boxes about the plants; made when a bud asks for it.
    boxes: OnceLock<Tree>,
    /// Over the plants, in the plot; made when a bud first looks around.
    tree: OnceLock<Tree>,
}

/// Which stem: the place of its plant in the plot and its node.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Which {
    plant: u32,
    node: u32,
}

impl PartialEq for Stems {
    fn eq(&self, other: &Self) -> bool {
        let known = |Which { plant, node }: Which, of: &Self| {
            let of = &of.plants[plant as usize];
            let Stem { start, end, radii, axis, .. } = of.stems[node as usize];
            (of.number, of.place, start, end, radii, axis)
        };
        let all = |of: &Self| of.each().map(|which| known(which, of)).collect::<Vec<_>>();
        self.whose == other.whose && all(self) == all(other)
    }
}

impl Stems {
    /// The stems of plants that are posed, each at its age; a plant without an age is not sown yet. Linear in the
    /// internodes that stand.
    pub fn of(plants: &[Plant], ages: &[Option<Tick>], whose: Whose) -> Self {
        let mut stems = Self { whose, ..Self::default() };
        stems.follow(plants, ages);
        stems
    }

    /// Takes the stems of the same plants to another time. Linear in the internodes that stand, at a few nanoseconds
    /// each where they stand as they stood; those that do not cost about ten times as much.
    pub fn follow(&mut self, plants: &[Plant], ages: &[Option<Tick>]) {
        let known = self.plants.iter().map(|of| (of.number, of.place));
        if !known.eq(plants.iter().map(|plant| (plant.id, plant.place))) {
            let empty = |plant: &Plant| OfPlant { number: plant.id, place: plant.place, ..OfPlant::default() };
            self.plants = plants.iter().map(empty).collect();
            self.number();
        }
        (self.boxes, self.tree) = (OnceLock::new(), OnceLock::new());
        let all = &mut self.plants;
        let follow = |(of, (plant, age)): (&mut OfPlant, (&Plant, &Option<Tick>))| of.follow(plant, *age);
        if plants.len() < FEWEST_PLANTS {
            all.iter_mut().zip(plants.iter().zip(ages)).for_each(follow);
        } else {
            all.par_iter_mut().zip(plants.par_iter().zip(ages)).with_min_len(FEWEST_PLANTS / 2).for_each(follow);
        }
    }

    /// Notes where each plant is among them.
    fn number(&mut self) {
        self.places = self.plants.iter().map(|of| of.number).zip(0..).collect();
        self.places.sort_unstable();
    }

    fn place_of(&self, number: u32) -> Option<usize> {
        let found = self.places.binary_search_by_key(&number, |(number, _)| *number);
        found.ok().map(|found| self.places[found].1 as usize)
    }

    /// Whose stems they are for a shoot.
    pub fn whose(&self) -> Whose {
        self.whose
    }

    /// Whether there is nothing that a shoot may meet.
    pub fn is_empty(&self) -> bool {
        self.whose == Whose::Nobody || self.plants.iter().all(|plant| plant.standing == 0)
    }

    /// Notes each stem that may be met and is nearer than `reach` to a point, in the order of the numbers of plants and
    /// of nodes.
    fn gather(&self, point: Point, reach: f64, spared: Spared, near: &mut Vec<Which>) {
        near.clear();
        self.each_plant_near(point, reach, spared, &mut |plant| {
            let of = &self.plants[plant as usize];
            let (at, cells) = (of.seen_from_seed(point), of.cells());
            let mut asked = |node: u32| {
                let stem = &of.stems[node as usize];
                if self.is_met(of, stem, spared) && stem.is_near(at, reach) {
                    near.push(Which { plant, node });
                }
                false
            };
            match cells.about(at, reach) {
                Some(range) => cells.each_in(&range, NO_AXIS, asked),
                None => of.each().for_each(|node| _ = asked(node)),
            }
        });
        // By the numbers of plants, so that their order in the plot does not show where two are equally near.
        if near.len() > 1 {
            near.sort_unstable_by_key(|which| (self.plants[which.plant as usize].number, *which));
            near.dedup();
        }
    }

    /// A stem, with its plant.
    fn get(&self, Which { plant, node }: Which) -> (&OfPlant, &Stem) {
        let plant = &self.plants[plant as usize];
        (plant, &plant.stems[node as usize])
    }

    /// Whether it is soon known that no stem which may be met is nearer than `reach` to a point: no box about a plant
    /// is, or where the reach is short, no stem in the cells about the point.
    pub fn are_far(&self, point: Point, reach: f64, spared: Spared) -> bool {
        let mut far = true;
        self.each_plant_near(point, reach, spared, &mut |plant| {
            far = far
                && reach < SHORT
                && self.plants[plant as usize].is_far(point, reach, |of, stem| self.is_met(of, stem, spared));
        });
        far
    }

    /// Shows each plant whose stems may be met, and may be nearer than `reach` to a point.
    fn each_plant_near(&self, point: Point, reach: f64, spared: Spared, show: &mut impl FnMut(u32)) {
        let reach = reach.max(0.0) + ROUNDING;
        let is_near = |plant: usize| self.plants[plant].about.square_distance(point) < reach * reach;
        let own = self.place_of(spared.plant);
        if let Some(own) = own.filter(|own| self.whose == Whose::All && is_near(*own)) {
            show(own as u32);
        }
        let knows = |own: &usize| self.plants[*own].about.with_margin(ASIDE - reach).holds(point);
        if let Some(own) = own.filter(knows) {
            return self.beside(own).iter().filter(|plant| is_near(**plant as usize)).for_each(|plant| show(*plant));
        }
        self.boxes().walk(|_, bounds, plant| {
            if bounds.square_distance(point) >= reach * reach {
                return Walk::Past;
            }
            if let Some(plant) = plant.filter(|plant| Some(*plant) != own) {
                show(plant as u32);
            }
            Walk::Below
        });
    }

    fn boxes(&self) -> &Tree {
        self.boxes.get_or_init(|| Tree::of(&self.plants.iter().map(|of| of.about).collect::<Vec<_>>()))
    }

    /// The places of the plants whose boxes come nearer than [`ASIDE`] to that of a plant.
    fn beside(&self, own: usize) -> &[u32] {
        let of = &self.plants[own];
        of.beside.get_or_init(|| {
            let (mut beside, wide) = (Vec::new(), of.about.with_margin(ASIDE));
            self.boxes().walk(|_, bounds, plant| {
                let common = wide.common(bounds);
                if (0..3).any(|k| common.low[k] > common.high[k]) {
                    return Walk::Past;
                }
                beside.extend(plant.filter(|plant| *plant != own).map(|plant| plant as u32));
                Walk::Below
            });
            beside
        })
    }

    /// As [`Stems::gather`], in the order of trees over plants and over pieces of their axes: that in which climbers
    /// have always found what they hold to, where two stems are equally near.
    fn each_around(&self, point: Point, reach: f64, spared: Spared, show: &mut impl FnMut(&OfPlant, &Stem)) {
        let far = |bounds: &Bounds, point: Point| bounds.square_distance(point) >= reach * reach;
        let tree = self.tree.get_or_init(|| Tree::of(&self.plants.iter().map(OfPlant::bounds).collect::<Vec<_>>()));
        tree.walk(|_, bounds, item| {
            if far(bounds, point) {
                return Walk::Past;
            }
            let Some(plant) = item.map(|item| &self.plants[item]) else { return Walk::Below };
            if plant.number == spared.plant && self.whose != Whose::All {
                return Walk::Past;
            }
            let at = [0, 1, 2].map(|k| point[k] - plant.place[k]);
            plant.tree().walk(|_, bounds, piece| {
                if far(bounds, at) {
                    return Walk::Past;
                }
                for stem in piece.map_or(&[][..], |piece| plant.piece(piece)) {
                    if self.is_met(plant, stem, spared) && stem.distance(at) < reach {
                        show(plant, stem);
                    }
                }
                Walk::Below
            });
            Walk::Below
        });
    }

    /// All stems that stand.
    fn each(&self) -> impl Iterator<Item = Which> {
        let of_plant = |(plant, of): (u32, &OfPlant)| of.each().map(|node| Which { plant, node }).collect::<Vec<_>>();
        (0..).zip(&self.plants).flat_map(of_plant)
    }

    /// Whether a shoot may meet a stem.
    fn is_met(&self, plant: &OfPlant, stem: &Stem, spared: Spared) -> bool {
        plant.number != spared.plant || (self.whose == Whose::All && stem.axis != spared.axis)
    }
}
