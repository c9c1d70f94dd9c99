//! The stems of the plants of a plot, which shoots of the same plants meet (de Reffye et al. 1988 §4: obstruction due
//! "to part of the plant against another part").
//!
//! They are the internodes as they stood at the end of the last tick, so no order of plants and no number of threads
//! shows: each a straight piece of wood whose radius goes evenly from its base to its tip. From tick to tick they are
//! kept, and what has come, moved, grown much thicker or fallen is entered anew in the cells of space that stems pass
//! through (`cells`); so a bud far from all wood asks a cell or two. Buds that look around, as climbers do,
//! ask trees. What is near a bud is copied from here ([`Beside`]). Absent: leaves, flowers and fruits, which no shoot
//! meets.

mod beside;
mod cells;
mod segments;
#[cfg(test)]
mod tests;

pub use beside::{Beside, Spared, Touch};

use crate::clock::Tick;
use crate::plant::{NodeId, Plant};
use crate::shape::tree::{Tree, Walk};
use crate::shape::{Bounds, Point};
use crate::vector::Vector;
use cells::{Cells, Which};
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, IntoParallelRefMutIterator, ParallelIterator};
use std::sync::OnceLock;

/// The most internodes under one leaf of a tree.
const PIECE: usize = 8;
/// The fewest plants whose stems are followed on several threads.
const FEWEST_PLANTS: usize = 16;
/// What a stem may grow thicker before it is entered anew: a share of its radius, and metres.
const ROOM: f32 = 1.5;
const LEAST_ROOM: f32 = 4e-3;
/// What a coarse test allows for rounding, metres.
const ROUNDING: f64 = 1e-4;

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
    /// Where they are.
    cells: Cells,
    /// Over the plants, in the plot; made when a bud first looks around.
    tree: OnceLock<Tree>,
}

/// The stems of one plant, metres from its seed.
#[derive(Debug, Clone, Default)]
struct OfPlant {
    number: u32,
    place: Point,
    /// One a node; those that do not stand are [`Stem::NONE`].
    stems: Vec<Stem>,
    /// How many stand.
    standing: usize,
    /// The sum of their lengths along the axes of space, metres.
    length: f64,
    /// The nodes whose stems are to be entered anew, with what was entered.
    changed: Vec<(u32, Stem)>,
    /// Changes with each time at which the stems are followed.
    turn: bool,
    /// The version of the frames at that time.
    version: u64,
    /// The nodes of each piece of an axis that stands.
    pieces: Vec<(u32, u32)>,
    /// Over the pieces; made when a bud that looks around comes near.
    tree: OnceLock<Tree>,
}

/// One internode.
#[derive(Debug, Clone, Copy)]
struct Stem {
    start: [f32; 3],
    end: [f32; 3],
    /// At its base and at its tip.
    radii: [f32; 2],
    axis: u32,
    /// The radius with which it is entered in the cells; negative where it is not.
    entered: f32,
    /// That of its plant when it stood last.
    turn: bool,
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
            (self.plants, self.cells) = (plants.iter().map(empty).collect(), Cells::default());
        }
        self.tree = OnceLock::new();
        let Self { plants: all, cells, .. } = self;
        let follow = |(of, (plant, age)): (&mut OfPlant, (&Plant, &Option<Tick>))| of.follow(plant, *age, cells);
        if plants.len() < FEWEST_PLANTS {
            all.iter_mut().zip(plants.iter().zip(ages)).for_each(follow);
        } else {
            all.par_iter_mut().zip(plants.par_iter().zip(ages)).with_min_len(FEWEST_PLANTS / 2).for_each(follow);
        }
        self.enter();
    }

    /// Enters what has changed in the cells, or all in new ones where stems have become much longer or shorter.
    fn enter(&mut self) {
        let Self { plants, cells, .. } = self;
        let standing: usize = plants.iter().map(|of| of.standing).sum();
        let length = plants.iter().map(|of| of.length).sum::<f64>() / standing.max(1) as f64;
        let made_anew = !cells.suit(length);
        if made_anew {
            *cells = Cells::of(length);
        }
        for (plant, of) in (0..).zip(plants) {
            let changed = std::mem::take(&mut of.changed);
            for (node, was) in &changed {
                let (which, now) = (Which { plant, node: *node }, &of.stems[*node as usize]);
                if made_anew {
                    break;
                }
                if was.entered >= 0.0 {
                    cells.remove(which, was, of.place);
                }
                if now.entered >= 0.0 {
                    cells.enter(which, now, of.place);
                }
            }
            of.changed = changed;
            if made_anew {
                let standing = (0..).zip(&of.stems).filter(|(_, stem)| stem.entered >= 0.0);
                standing.for_each(|(node, stem)| cells.enter(Which { plant, node }, stem, of.place));
            }
        }
    }

    /// Whose stems they are for a shoot.
    pub fn whose(&self) -> Whose {
        self.whose
    }

    /// Whether there is nothing that a shoot may meet.
    pub fn is_empty(&self) -> bool {
        self.whose == Whose::Nobody || self.plants.iter().all(|plant| plant.standing == 0)
    }

    /// Shows each stem that may be met and is nearer than `reach` to a point, in the order of the numbers of
    /// plants and of nodes.
    fn each_near(&self, point: Point, reach: f64, spared: Spared, show: &mut impl FnMut(&OfPlant, &Stem)) {
        let mut near = Vec::new();
        let asked = |which: Which| {
            let plant = &self.plants[which.plant as usize];
            let stem = &plant.stems[which.node as usize];
            if self.is_met(plant, stem, spared) && stem.is_near(plant, point, reach) {
                near.push(which);
            }
        };
        match self.cells.about(point, reach) {
            Some(range) => self.cells.each_in(&range, asked),
            None => self.each().for_each(asked),
        }
        // By the numbers of plants, so that their order in the plot does not show where two are equally near.
        near.sort_unstable_by_key(|which| (self.plants[which.plant as usize].number, *which));
        near.dedup();
        for Which { plant, node } in near {
            let plant = &self.plants[plant as usize];
            show(plant, &plant.stems[node as usize]);
        }
    }

    /// As [`Stems::each_near`], in the order of trees over plants and over pieces of their axes: that in which climbers
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
        let of_plant = |(plant, of): (u32, &OfPlant)| {
            let standing = (0..).zip(&of.stems).filter(|(_, stem)| stem.entered >= 0.0);
            standing.map(move |(node, _)| Which { plant, node }).collect::<Vec<_>>()
        };
        (0..).zip(&self.plants).flat_map(of_plant)
    }

    /// Whether a shoot may meet a stem.
    fn is_met(&self, plant: &OfPlant, stem: &Stem, spared: Spared) -> bool {
        plant.number != spared.plant || (self.whose == Whose::All && stem.axis != spared.axis)
    }
}

impl OfPlant {
    /// Takes the stems to an age of the plant, and notes what is to be entered anew in cells.
    fn follow(&mut self, plant: &Plant, age: Option<Tick>, cells: &Cells) {
        let posed = plant.frames.base.len();
        let (mut seen, mut fresh, mut length) = (0, 0, self.length);
        // Where the frames are those of the last time, nothing has moved.
        let moves = self.version != plant.frames.version;
        self.version = plant.frames.version;
        self.changed.clear();
        self.pieces.clear();
        self.tree = OnceLock::new();
        self.stems.resize(posed.max(self.stems.len()), Stem::NONE);
        self.turn = !self.turn;
        let Self { stems, changed, turn, pieces, .. } = self;
        if let Some(age) = age {
            plant.each_standing(age, |stretch| {
                let nodes = stretch.nodes();
                let nodes = nodes.start..nodes.end.min(posed);
                seen += nodes.len();
                let piece = |start: usize| (start as u32, nodes.end.min(start + PIECE) as u32);
                pieces.extend(nodes.clone().step_by(PIECE).map(piece));
                let axis = stretch.axis.0;
                let radii = plant.nodes.diameter[nodes.clone()].iter().zip(&plant.nodes.diameter_tip[nodes.clone()]);
                for ((node, stem), (base, tip)) in nodes.clone().zip(&mut stems[nodes]).zip(radii) {
                    let (was, is_fresh) = (*stem, stem.entered < 0.0);
                    if is_fresh || moves {
                        *stem = Stem { entered: was.entered, ..Stem::of(plant, axis, node) };
                        length += stem.extent() - was.extent();
                    }
                    (stem.radii, stem.turn) = ([0.5 * base, 0.5 * tip], *turn);
                    fresh += usize::from(is_fresh);
                    if stem.radius() <= was.entered && !moves {
                        continue;
                    }
                    if !stem.is_entered_as(&was) {
                        stem.entered = stem.radius() * ROOM + LEAST_ROOM;
                        if is_fresh || !cells.same(&was, stem, plant.place) {
                            changed.push((node as u32, was));
                        }
                    }
                }
            });
        }
        self.length = length;
        if self.standing + fresh != seen {
            self.forget();
        }
        self.standing = seen;
    }

    fn tree(&self) -> &Tree {
        self.tree
            .get_or_init(|| Tree::of(&(0..self.pieces.len()).map(|piece| self.bounds_of(piece)).collect::<Vec<_>>()))
    }

    fn piece(&self, piece: usize) -> &[Stem] {
        let (start, end) = self.pieces[piece];
        &self.stems[start as usize..end as usize]
    }

    /// The bounds of a piece of an axis, metres from the seed.
    fn bounds_of(&self, piece: usize) -> Bounds {
        self.piece(piece).iter().fold(Bounds::NOTHING, |all, stem| all.with(&stem.bounds()))
    }

    /// Its bounds in the plot.
    fn bounds(&self) -> Bounds {
        let all = (0..self.pieces.len()).fold(Bounds::NOTHING, |all, piece| all.with(&self.bounds_of(piece)));
        let placed = |corner: Point| [0, 1, 2].map(|k| corner[k] + self.place[k]);
        Bounds { low: placed(all.low), high: placed(all.high) }
    }

    /// Takes out what does not stand any more.
    fn forget(&mut self) {
        for (node, stem) in (0..).zip(&mut self.stems).filter(|(_, stem)| stem.entered >= 0.0) {
            if stem.turn != self.turn {
                self.length -= stem.extent();
                self.changed.push((node, std::mem::replace(stem, Stem::NONE)));
            }
        }
    }
}

impl Stem {
    /// That of a node that does not stand.
    const NONE: Self =
        Self { start: [0.0; 3], end: [0.0; 3], radii: [0.0; 2], axis: u32::MAX, entered: -1.0, turn: false };

    fn of(plant: &Plant, axis: u32, node: usize) -> Self {
        let frame = plant.frames.at(NodeId(node as u32));
        let end = frame.advanced(plant.posed_length(NodeId(node as u32))).base;
        let radii = [plant.nodes.diameter[node], plant.nodes.diameter_tip[node]].map(|diameter| 0.5 * diameter);
        Self { start: frame.base, end, radii, axis, ..Self::NONE }
    }

    fn bounds(&self) -> Bounds {
        let ends = [self.start, self.end].map(|end| end.map(f64::from));
        Bounds::of_points(&ends).with_margin(f64::from(self.radii[0].max(self.radii[1])))
    }

    /// The larger of its radii, metres.
    fn radius(&self) -> f32 {
        self.radii[0].max(self.radii[1])
    }

    /// Its length along the three axes of space together, metres.
    fn extent(&self) -> f64 {
        f64::from((0..3).map(|k| (self.end[k] - self.start[k]).abs()).sum::<f32>())
    }

    /// Whether it lies where another one was entered, and within what it was entered for.
    fn is_entered_as(&self, was: &Self) -> bool {
        self.start == was.start && self.end == was.end && self.radius() <= was.entered
    }

    /// Whether it is nearer than `reach` to a point of the plot.
    fn is_near(&self, plant: &OfPlant, point: Point, reach: f64) -> bool {
        let at = [0, 1, 2].map(|k| point[k] - plant.place[k]);
        // All of it lies in the ball about its middle; a coarse test that spares most stems the exact one.
        let [start, end] = [self.start, self.end].map(Vector::from);
        let (along, out) = (end - start, (start + end) * 0.5 - Vector::of(at));
        let most = reach.max(0.0) + f64::from(self.radius()) + ROUNDING;
        let (between, half) = (out.dot(out), 0.25 * along.dot(along));
        if between > 2.0 * (most * most + half) {
            return false;
        }
        self.distance(at) < reach
    }

    /// The distance from a point to its bark, metres, negative within.
    fn distance(&self, at: Point) -> f64 {
        beside::Near::of(self, [0.0; 3], 0).distance(Vector::of(at))
    }
}
