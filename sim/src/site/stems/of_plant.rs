//! The stems of one plant, kept from tick to tick: what has come, moved, grown much thicker or fallen since.
//!
//! The cells in which they lie are made when a bud first asks, and from then on what has changed is entered anew.
//! Absent: the cells (`cells`), and which plants a bud asks (`super`).

use super::cells::{Cells, NO_AXIS};
use super::stem::Stem;
use crate::clock::Tick;
use crate::plant::Plant;
use crate::shape::tree::Tree;
use crate::shape::{Bounds, Point};
use std::sync::OnceLock;

/// The most internodes under one leaf of a tree.
const PIECE: usize = 8;
/// What a stem may grow thicker before it is entered anew: a share of its radius, and metres.
const ROOM: f32 = 1.5;
const LEAST_ROOM: f32 = 1e-3;

/// The stems of one plant, metres from its seed.
#[derive(Debug, Clone, Default)]
pub(super) struct OfPlant {
    pub(super) number: u32,
    pub(super) place: Point,
    /// One a node; those that do not stand are [`Stem::NONE`].
    pub(super) stems: Vec<Stem>,
    /// How many stand.
    pub(super) standing: usize,
    /// The sum of their lengths along the axes of space, metres.
    pub(super) length: f64,
    /// A box that holds all stems, and no less than what they are entered with, in the plot.
    pub(super) about: Bounds,
    /// Where they are, once a bud has asked.
    pub(super) cells: OnceLock<Cells>,
    /// The places of the other plants whose boxes are near, once a bud has asked.
    pub(super) beside: OnceLock<Vec<u32>>,
    /// The nodes whose stems are to be entered anew, with what was entered.
    pub(super) changed: Vec<(u32, Stem)>,
    /// Changes with each time at which the stems are followed.
    pub(super) turn: bool,
    /// The version of the frames at that time.
    pub(super) version: u64,
    /// The nodes of each piece of an axis that stands.
    pub(super) pieces: Vec<(u32, u32)>,
    /// Over the pieces; made when a bud that looks around comes near.
    pub(super) tree: OnceLock<Tree>,
}

impl OfPlant {
    /// Takes the stems to an age of the plant, and enters anew what has changed.
    pub(super) fn follow(&mut self, plant: &Plant, age: Option<Tick>) {
        let posed = plant.frames.base.len();
        let (mut seen, mut fresh, mut length) = (0, 0, self.length);
        // Where the frames are those of the last time, nothing has moved.
        let moves = self.version != plant.frames.version;
        self.version = plant.frames.version;
        self.changed.clear();
        self.pieces.clear();
        (self.tree, self.beside) = (OnceLock::new(), OnceLock::new());
        if moves {
            self.about = Bounds::NOTHING;
        }
        self.stems.resize(posed.max(self.stems.len()), Stem::NONE);
        self.turn = !self.turn;
        let Self { stems, changed, turn, pieces, about, cells, place, .. } = self;
        let cells = cells.get();
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
                    let radii = [0.5 * base, 0.5 * tip];
                    // Most stand where they stood, and are no thicker than they were entered for.
                    if !moves && radii[0].max(radii[1]) <= stem.entered {
                        (stem.radii, stem.turn) = (radii, *turn);
                        continue;
                    }
                    let (was, is_fresh) = (*stem, stem.entered < 0.0);
                    if is_fresh || moves {
                        *stem = Stem { entered: was.entered, ..Stem::of(plant, axis, node) };
                        length += stem.extent() - was.extent();
                    }
                    (stem.radii, stem.turn) = (radii, *turn);
                    fresh += usize::from(is_fresh);
                    if !stem.is_entered_as(&was) {
                        stem.entered = stem.radius() * ROOM + LEAST_ROOM;
                        let is_other = |cells: &Cells| is_fresh || !cells.same(&was, stem);
                        if cells.is_some_and(is_other) {
                            changed.push((node as u32, was));
                        }
                    }
                    *about = about.with(&stem.entered_bounds(*place));
                }
            });
        }
        self.length = length;
        if self.standing + fresh != seen {
            self.forget();
        }
        self.standing = seen;
        self.enter();
    }

    /// Enters what has changed in the cells, or forgets these where stems have become much longer or shorter.
    pub(super) fn enter(&mut self) {
        let length = self.mean_length();
        let changed = std::mem::take(&mut self.changed);
        match self.cells.get_mut() {
            Some(cells) if cells.suit(length) => {
                for (node, was) in &changed {
                    let now = &self.stems[*node as usize];
                    if was.entered >= 0.0 {
                        cells.remove(*node, was);
                    }
                    if now.entered >= 0.0 {
                        cells.enter(*node, now);
                    }
                }
            }
            Some(_) => self.cells = OnceLock::new(),
            None => {}
        }
        self.changed = changed;
    }

    /// The mean length of its stems along the axes of space together, metres.
    pub(super) fn mean_length(&self) -> f64 {
        self.length / self.standing.max(1) as f64
    }

    /// The cells in which the stems lie.
    pub(super) fn cells(&self) -> &Cells {
        self.cells.get_or_init(|| {
            let mut cells = Cells::of(self.mean_length());
            self.each().for_each(|node| cells.enter(node, &self.stems[node as usize]));
            cells
        })
    }

    /// A point of the plot, metres from the seed.
    pub(super) fn seen_from_seed(&self, [x, y, z]: Point) -> Point {
        [x - self.place[0], y - self.place[1], z - self.place[2]]
    }

    /// Whether no stem that counts is nearer than `reach` to a point of the plot, as far as few cells tell.
    pub(super) fn is_far(&self, point: Point, reach: f64, counts: impl Fn(&Self, &Stem) -> bool) -> bool {
        let (at, cells) = (self.seen_from_seed(point), self.cells());
        let Some(range) = cells.about(at, reach) else { return false };
        let mut far = true;
        cells.each_in(&range, NO_AXIS, |node| {
            let stem = &self.stems[node as usize];
            far = !(counts(self, stem) && stem.is_near(at, reach));
            !far
        });
        far
    }

    /// The nodes whose stems stand.
    pub(super) fn each(&self) -> impl Iterator<Item = u32> {
        (0..).zip(&self.stems).filter(|(_, stem)| stem.entered >= 0.0).map(|(node, _)| node)
    }

    pub(super) fn tree(&self) -> &Tree {
        self.tree
            .get_or_init(|| Tree::of(&(0..self.pieces.len()).map(|piece| self.bounds_of(piece)).collect::<Vec<_>>()))
    }

    pub(super) fn piece(&self, piece: usize) -> &[Stem] {
        let (start, end) = self.pieces[piece];
        &self.stems[start as usize..end as usize]
    }

    /// The bounds of a piece of an axis, metres from the seed.
    pub(super) fn bounds_of(&self, piece: usize) -> Bounds {
        self.piece(piece).iter().fold(Bounds::NOTHING, |all, stem| all.with(&stem.bounds()))
    }

    /// Its bounds in the plot.
    pub(super) fn bounds(&self) -> Bounds {
        let all = (0..self.pieces.len()).fold(Bounds::NOTHING, |all, piece| all.with(&self.bounds_of(piece)));
        let placed = |corner: Point| [0, 1, 2].map(|k| corner[k] + self.place[k]);
        Bounds { low: placed(all.low), high: placed(all.high) }
    }

    /// Takes out what does not stand any more.
    pub(super) fn forget(&mut self) {
        for (node, stem) in (0..).zip(&mut self.stems).filter(|(_, stem)| stem.entered >= 0.0) {
            if stem.turn != self.turn {
                self.length -= stem.extent();
                self.changed.push((node, std::mem::replace(stem, Stem::NONE)));
            }
        }
    }
}
