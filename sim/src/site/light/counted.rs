//! The leaf area of a plot, kept from tick to tick: what has come is added, what is gone is taken away.
//!
//! Sums of whole numbers give the same grid as all leaves added anew. A leaf is counted as it was when it was grown to
//! its full size, and until then at each tick. That holds for plants whose leaves stay where they are: those that
//! neither bend nor lengthen, whose leaves do not turn, and that state no frames. Where a plant of the plot is none of
//! these, its frames have become others, or most leaves fall at a tick, all area is added up anew (`grid_of`). Absent:
//! wood, whose area changes at each tick.

use super::canopy::{Canopy, Standing, pieces_of_leaf};
use super::grid::{Grid, Voxel};
use super::{Lighting, Piece};
use crate::clock::Tick;
use crate::plant::{OrganId, Plant};
use crate::shape::Point;
use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, IntoParallelRefMutIterator, ParallelIterator};

/// The fewest plants whose leaves a thread looks through.
const FEWEST_PLANTS: usize = 16;
/// So many leaves may be taken away at a tick of any plot.
const MOST_TAKEN: usize = 1_000;
/// The most units of a piece: all pieces that there can be do not fill a voxel then.
const MOST_UNITS: u64 = 1 << 30;

/// The area that is counted.
#[derive(Debug, Clone, Default)]
pub struct Counted {
    /// The voxels, in the order in which they were made; `None` where nothing is counted.
    grid: Option<Grid>,
    plants: Vec<OfPlant>,
    /// Whether so many leaves fall at a tick that all are sooner added anew.
    given_up: bool,
    /// Memory for the buds of each plant, kept from tick to tick.
    pub(crate) buds: Vec<Vec<(usize, Point)>>,
}

/// What is counted of a plant.
#[derive(Debug, Clone, Default)]
struct OfPlant {
    /// Its number, its place and the version of its frames.
    of: (u32, Point, u64),
    /// Its age when it was counted last.
    age: Tick,
    /// Of each organ whether it is counted.
    organs: Vec<Share>,
    /// What has changed.
    changes: Vec<(Voxel, u8, i64)>,
    /// The voxels of its buds; one after the other they differ.
    marks: Vec<Voxel>,
    /// How many leaves stand, and how many had to be taken away.
    leaves: [usize; 2],
}

/// Whether an organ is counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Share {
    /// It is not.
    Nothing,
    /// As it was at the age of the plant; it may be larger at the next.
    Growing,
    /// As it will be until it is gone.
    Grown,
}

/// What is counted follows from the plants, however often they were.
impl PartialEq for Counted {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Counted {
    /// Whether area is kept for the next tick.
    pub fn counts(&self) -> bool {
        self.grid.is_some()
    }

    /// The leaf area of plants, with the voxels of their buds marked, as `grid_of` finds it; `None` where their leaves
    /// do not stay where they are. Linear in the organs, at about a nanosecond each where nothing has changed.
    pub fn grid(&mut self, lighting: &Lighting, standing: &Standing, buds: &[Vec<(usize, Point)>]) -> Option<Grid> {
        if !self.follows(lighting, standing) {
            self.grid = None;
            return None;
        }
        let empty = || Grid::of(lighting);
        let grid = self.grid.get_or_insert_with(empty);
        let shape = &*grid;
        let of = self.plants.par_iter_mut().zip(standing.plants).zip(standing.ages).zip(buds);
        let longest = lighting.voxel_m / 2.0;
        let fit = of.with_min_len(FEWEST_PLANTS).map(|(((of, plant), age), buds)| {
            of.mark(shape, buds);
            of.count(shape, plant, *age, longest)
        });
        if !fit.reduce(|| true, |one, two| one && two) {
            self.grid = None;
            return None;
        }
        let [stand, taken] = self.plants.iter().fold([0; 2], |[a, b], of| [a + of.leaves[0], b + of.leaves[1]]);
        self.given_up = taken > MOST_TAKEN.max(stand / 3);
        for of in &self.plants {
            for (voxel, class, units) in &of.changes {
                grid.shift(*voxel, usize::from(*class), *units);
            }
        }
        grid.unmark();
        self.plants.iter().flat_map(|of| &of.marks).for_each(|voxel| grid.mark_voxel(*voxel));
        let mut sorted = grid.sorted();
        let anchor = sorted.voxel(standing.anchor());
        sorted.anchor = [anchor[0], anchor[1]];
        Some(sorted)
    }

    /// Whether leaves are where they were when they were counted, or none is counted; keeps the versions of the frames
    /// for the next time.
    fn follows(&mut self, lighting: &Lighting, standing: &Standing) -> bool {
        let versions = |plant: &Plant| (plant.id, plant.place, plant.frames.version);
        let known = self.plants.iter().map(|of| of.of);
        let same = known.eq(standing.plants.iter().map(versions));
        let ages = standing.ages.iter().zip(&self.plants);
        let later = same && ages.into_iter().all(|(age, of)| age.is_none_or(|age| age >= of.age));
        if !later || self.grid.is_none() {
            let fresh = |plant: &Plant| OfPlant { of: versions(plant), ..OfPlant::default() };
            (self.grid, self.plants) = (None, standing.plants.iter().map(fresh).collect());
        }
        same && !self.given_up
            && !lighting.wood
            && standing.plants.par_iter().with_min_len(FEWEST_PLANTS).all(keeps_its_leaves)
    }
}

/// Whether the leaves of a plant stay where they are as long as its frames do.
fn keeps_its_leaves(plant: &Plant) -> bool {
    plant.partway().is_none()
        && plant.stated.is_empty()
        && plant.stated_organs.keep_insertion()
        && plant.own_looks.is_empty()
        && plant.habit.organ_trends.is_empty()
        && !plant.lengths_change()
}

impl OfPlant {
    /// Notes the voxels of its buds.
    fn mark(&mut self, grid: &Grid, buds: &[(usize, Point)]) {
        self.marks.clear();
        self.marks.extend(buds.iter().map(|(_, place)| grid.within(grid.voxel(*place))));
        self.marks.dedup();
    }

    /// Notes what has changed in a plant since it was counted; whether its leaves are not too large for it.
    fn count(&mut self, grid: &Grid, plant: &Plant, age: Option<Tick>, longest: f64) -> bool {
        self.changes.clear();
        self.leaves = [0; 2];
        let Some(age) = age else { return true };
        let (before, organs) = (self.age, &plant.organs);
        self.age = age;
        self.organs.resize(organs.len(), Share::Nothing);
        let fallen = plant.fallen_by(age);
        let mut fits = true;
        let Self { organs: shares, changes, leaves: [stand, taken], .. } = self;
        let lives = organs.birth.iter().zip(&organs.death).zip(&organs.kind);
        for (organ, (share, ((birth, death), kind))) in shares.iter_mut().zip(lives).enumerate() {
            let stands = *birth <= age && fallen < *death && kind.is_foliage();
            *stand += usize::from(stands);
            if stands == (*share != Share::Nothing) && *share != Share::Growing {
                continue;
            }
            let mut pieces = |age: Tick, sign: i64| {
                pieces_of_leaf(plant, OrganId(organ as u32), age, longest, &mut |piece: Piece| {
                    let (voxel, class, units) = grid.share(&piece);
                    fits &= units <= MOST_UNITS;
                    let units = sign * units.min(MOST_UNITS) as i64;
                    match changes.last_mut() {
                        // What comes one after the other mostly falls into one voxel.
                        Some((last, of_class, sum)) if (*last, *of_class) == (voxel, class as u8) => *sum += units,
                        _ if units != 0 => changes.push((voxel, class as u8, units)),
                        _ => {}
                    }
                });
            };
            if *share != Share::Nothing {
                *taken += 1;
                pieces(before, -1);
            }
            if stands {
                pieces(age, 1);
            }
            let is_grown = || {
                let look = plant.look_of_organ(OrganId(organ as u32));
                look.is_none_or(|look| look.is_grown(age - birth))
            };
            *share = match stands {
                false => Share::Nothing,
                true if is_grown() => Share::Grown,
                true => Share::Growing,
            };
        }
        fits
    }
}
