//! The search for a level of detail: the tolerance and the share of organs with which a mesh has at most so many
//! triangles, or the fewest with which its outline holds.
//!
//! Of a plant and a step of the tolerance the wood is made once, and so is its outline; organs are drawn once for all
//! steps with the same forms. Absent: what levels a plant has (`levels`), and outlines themselves (`sides`).

use super::costs::Costs;
use super::sides::{Apart, MOST_PART, Outline, Sides};
use phytomer_meshes::{Keeping, MeshOptions, Scene, Tolerance};
use phytomer_sim::clock::Tick;
use phytomer_sim::math::{exp2, log2};
use phytomer_sim::plant::Plant;
use std::collections::BTreeMap;

/// The largest difference between the areas of outlines, as a share. What files promise is 3 %; the rest is for what
/// the samples miss.
const MOST_APART: f64 = 0.025;

/// The difference that is aimed at between a mesh that holds and one that does not.
const AIMED_APART: f64 = 0.02;

/// The most outlines that are drawn to find the widest tolerance.
const LOOKS: u32 = 5;

/// The samples along the longest side of an outline: at most a pixel of a picture of a plant at which levels change.
const SAMPLES: u32 = 480;

/// A plant of more triangles is tried on every so many rows of these: of the rows of a crown each has a difference of
/// its own, so that the mean of a few is near that of all. Twice its standard error counts as a part of the difference.
/// Where that is more than it may be, all rows are drawn.
const LARGE: u64 = 400_000;
const ROWS_APART: u32 = 2;
const MOST_APART_IN_ROWS: f64 = 0.0275;
const MOST_ERROR: f64 = 0.01;

/// The steps of an octave of tolerances, and the step of the largest.
const STEPS: u32 = 32;
const LAST: u32 = 24 * STEPS;

/// The least part of the triangles it may have that a level is content with, and the most trials to come there.
const ENOUGH: f64 = 0.8;
const TRIALS: u32 = 8;

/// The largest tolerance, in longest sides of the plant: stems that begin so far beside the one that they go on from
/// are joined within sixteen times the distance.
const OF_LONGEST: f32 = 16.0;

/// The share of its radius by which the radius of wood may be off.
const OF_RADIUS: f32 = 0.5;

/// A mesh that was tried.
#[derive(Debug, Clone)]
pub struct Tried {
    step: u32,
    share: f64,
    /// How it is drawn.
    pub options: MeshOptions,
    /// The number of its triangles.
    pub faces: u64,
    /// How far its outline is, where that was looked at.
    pub apart: Apart,
}

/// What was found for a number of triangles.
pub enum Found {
    /// A mesh that has at most so many triangles.
    Fits(Tried),
    /// The coarsest mesh whose outline holds, which has more triangles.
    Least(Tried),
}

/// The plant, and the outline of its first level.
pub struct Search<'p> {
    plant: &'p Plant,
    age: Tick,
    options: &'p MeshOptions,
    outline: Option<(Sides, Outline)>,
    /// Whether it has so many triangles that few outlines are drawn.
    pub is_large: bool,
    faces: u64,
    /// The distance of each step, metres.
    distances: Vec<f32>,
    /// The step of the tolerance of the first level, and that from which on all axes are straight.
    step: u32,
    last: u32,
    costs: Costs,
    /// The triangles of the wood at the steps that were looked at.
    wood_faces: BTreeMap<u32, u64>,
    /// The step that was looked at last.
    looked: Option<Looked<'p>>,
    /// The outline of all organs with so many triangles.
    organs: Option<(u64, Outline)>,
}

/// The plant at a step, and the outline of its wood where that was drawn.
struct Looked<'p> {
    step: u32,
    scene: Scene<'p>,
    wood: Option<Outline>,
}

impl<'p> Search<'p> {
    /// The search for levels of a plant whose first level has these options.
    pub fn of(plant: &'p Plant, age: Tick, options: &'p MeshOptions) -> Self {
        let distance = |step: u32| Tolerance::LEAST * exp2(f64::from(step) / f64::from(STEPS)) as f32;
        let distances: Vec<f32> = (0..=LAST).map(distance).collect();
        let scene = Scene::new(plant, age, &plain(options));
        let full = MeshOptions { tolerance: None, ..plain(options) };
        let costs = match options.tolerance {
            None => Costs::of(&scene, &distances),
            Some(_) => Costs::of(&Scene::new(plant, age, &full), &distances),
        };
        let sides = Sides::around(&scene, &costs, SAMPLES);
        let farthest = sides.as_ref().map_or(0.0, Sides::longest) * OF_LONGEST;
        let faces = scene.counts().faces;
        let outline = sides.map(|sides| {
            let sides = if faces > LARGE { sides.sparser(ROWS_APART) } else { sides };
            let outline = sides.of(&sides.of_wood(&scene), &scene, &costs);
            (sides, outline)
        });
        let last = distances.partition_point(|distance| *distance < farthest).clamp(1, LAST as usize) as u32;
        let octaves = options.tolerance.map_or(0.0, |own| log2(f64::from(own.distance / Tolerance::LEAST)));
        let step = (octaves * f64::from(STEPS)).clamp(0.0, f64::from(last)) as u32;
        Self {
            plant,
            age,
            options,
            outline,
            is_large: faces > LARGE,
            faces,
            distances,
            step,
            last,
            costs,
            wood_faces: BTreeMap::new(),
            looked: None,
            organs: None,
        }
    }

    /// The first level.
    pub fn first(&self) -> Tried {
        let (step, options) = (self.step, self.options.clone());
        Tried { step, share: 1.0, options, faces: self.faces, apart: Apart::default() }
    }

    /// The tolerance of a step.
    fn tolerance(&self, step: u32) -> Tolerance {
        // Wood is seen as wide as the first level draws it.
        let keeps = if self.options.tolerance.is_some() { Keeping::Section } else { Keeping::Tube(self.options.sides) };
        let distance = self.distances[step as usize];
        Tolerance { share: OF_RADIUS, keeps, organs: true, ..Tolerance::of(distance) }
    }

    /// The plant at a step.
    fn look(&mut self, step: u32) -> &mut Looked<'p> {
        let (plant, age) = (self.plant, self.age);
        let options = MeshOptions { tolerance: Some(self.tolerance(step)), ..plain(self.options) };
        let looked = self.looked.take().filter(|looked| looked.step == step);
        let new = || Looked { step, scene: Scene::new(plant, age, &options), wood: None };
        self.looked.insert(looked.unwrap_or_else(new))
    }

    fn count(&mut self, step: u32, share: f64) -> Tried {
        let of_wood = match self.wood_faces.get(&step) {
            Some(faces) => *faces,
            None => self.look(step).scene.wood_faces(),
        };
        self.wood_faces.insert(step, of_wood);
        let (tolerance, thinned) = (Some(self.tolerance(step)), self.costs.thinned(share));
        let options = MeshOptions { tolerance, thinned, ..self.options.clone() };
        Tried { step, share, options, faces: of_wood + self.costs.faces(step, share), apart: Apart::default() }
    }

    /// Looks at the outline of a mesh, and tells whether it holds. Wood is drawn once for each step, and all organs
    /// once for all steps with the same forms.
    fn holds(&mut self, tried: &mut Tried) -> bool {
        self.look(tried.step);
        let Self { outline: Some((sides, first)), looked: Some(looked), costs, organs, .. } = self else { return true };
        let Looked { scene, wood, .. } = looked;
        let wood = wood.get_or_insert_with(|| sides.of_wood(scene));
        scene.thin(tried.options.thinned);
        let outline = if tried.options.thinned.is_some() {
            sides.of(wood, scene, costs)
        } else {
            // Forms only become coarser, so that as many triangles are the same forms.
            let faces = costs.faces(tried.step, 1.0);
            let known = organs.take().filter(|known| known.0 == faces);
            let known = known.unwrap_or_else(|| (faces, sides.of(&Outline::default(), scene, costs)));
            organs.insert(known).1.with(wood)
        };
        tried.apart = outline.apart(first);
        if sides.share() >= 1.0 {
            return tried.apart.area <= MOST_APART;
        }
        let errors = outline.errors(first, sides.share()).map(|error| 2.0 * error);
        if errors.iter().any(|error| *error > MOST_ERROR) {
            self.look_at_all_rows();
            return self.holds(tried);
        }
        let by_side = tried.apart.by_side.iter().zip(errors).map(|(apart, error)| apart.abs() + error);
        tried.apart.area = by_side.fold(0.0, f64::max);
        tried.apart.area <= MOST_APART_IN_ROWS
    }

    /// Has outlines drawn on all rows from now on.
    fn look_at_all_rows(&mut self) {
        let scene = Scene::new(self.plant, self.age, &plain(self.options));
        let outline = |sides: Sides| {
            let outline = sides.of(&sides.of_wood(&scene), &scene, &self.costs);
            (sides, outline)
        };
        self.outline = Sides::around(&scene, &self.costs, SAMPLES).map(outline);
        (self.looked, self.organs) = (None, None);
    }

    /// The next level after one, of at most so many triangles.
    pub fn coarser(&mut self, before: &Tried, most: u64) -> Found {
        let mut widest = before.clone();
        if before.share >= 1.0 {
            let mut beyond = None;
            if let Some(mut fits) = self.fitting(before, most) {
                if self.holds(&mut fits) {
                    return Found::Fits(fits);
                }
                beyond = Some(fits);
            }
            widest = self.widest(before, beyond);
        }
        self.thinner(widest, most, before.share < 1.0)
    }

    /// A mesh of all organs that has at most so many triangles, and not many fewer; `None` where there is none.
    fn fitting(&mut self, before: &Tried, most: u64) -> Option<Tried> {
        let has_more = self.costs.least_faces() > most;
        // Of a large plant that of the widest tolerance tells it, which is looked at next.
        if has_more || self.is_large && before.step < self.last && self.count(self.last, 1.0).faces > most {
            return None;
        }
        let (mut low, mut high) = ((before.step, before.faces), None::<Tried>);
        for trial in 0..TRIALS {
            let step = match &high {
                // Two octaves of the tolerance for one of the triangles, to begin with.
                None => low.0 + (ratio(low.1, most) * f64::from(2 * STEPS)).max(f64::from(STEPS)) as u32,
                Some(high) => {
                    let part = ratio(low.1, most) / ratio(low.1, high.faces).max(1e-9);
                    // Now and then the middle, where a straight line would creep.
                    let part = if trial % 3 == 2 { 0.5 } else { part.clamp(0.05, 0.95) };
                    low.0 + (part * f64::from(high.step - low.0)) as u32
                }
            };
            if step >= self.last && low.0 >= self.last || high.as_ref().is_some_and(|high| high.step <= low.0 + 1) {
                break;
            }
            let tried = self.count(step.clamp(low.0 + 1, self.last), 1.0);
            if tried.faces > most {
                low = (tried.step, tried.faces);
            } else if tried.faces as f64 >= ENOUGH * most as f64 {
                return Some(tried);
            } else {
                high = Some(tried);
            }
        }
        high
    }

    /// The widest tolerance with which the outline of all organs holds, to an octave or so, between one that holds and
    /// one that does not; without that one the widest of all is tried first.
    fn widest(&mut self, before: &Tried, beyond: Option<Tried>) -> Tried {
        let mut widest = before.clone();
        let mut beyond = match beyond {
            Some(beyond) => beyond,
            None if before.step < self.last => {
                let mut tried = self.count(self.last, 1.0);
                if self.holds(&mut tried) {
                    return tried;
                }
                tried
            }
            None => return widest,
        };
        for _ in 0..LOOKS {
            if beyond.step <= widest.step + STEPS / 2 {
                break;
            }
            let mut tried = self.count(widest.step.midpoint(beyond.step), 1.0);
            if self.holds(&mut tried) { widest = tried } else { beyond = tried }
        }
        widest
    }

    /// A mesh of fewer organs that has at most so many triangles.
    fn thinner(&mut self, widest: Tried, most: u64, is_at_bound: bool) -> Found {
        let step = widest.step;
        let of_wood = widest.faces - self.costs.faces(widest.step, widest.share);
        let share = self.costs.share_of(step, most.saturating_sub(of_wood)).min(widest.share);
        let (mut low, mut least) = ((share, None), widest);
        if of_wood <= most {
            let mut tried = self.count(step, share);
            if tried.faces <= most && self.holds(&mut tried) {
                return Found::Fits(tried);
            }
            low.1 = Some(tried.apart);
        }
        // Where the level before was at its bound already there is hardly anything to find.
        let looks = match (self.is_large, is_at_bound) {
            (true, _) => 1,
            (_, true) => 2,
            _ => 3,
        };
        for look in 0..looks {
            // Of a large plant organs are not looked at once more for few triangles.
            if self.is_large && low.1.is_none_or(|apart| apart.part_that_holds(&least.apart, AIMED_APART) >= MOST_PART)
            {
                break;
            }
            // Differences may grow and then become less as organs are fewer, so that the middle is looked at too.
            let known = low.1.filter(|_| look == 0);
            let part = known.map_or(0.5, |apart| apart.part_that_holds(&least.apart, AIMED_APART));
            let share = Costs::in_parts(low.0 + part * (least.share - low.0));
            let mut tried = self.count(step, share);
            if self.holds(&mut tried) { least = tried } else { low = (tried.share, Some(tried.apart)) }
        }
        Found::Least(least)
    }
}

/// Options of a mesh without colours, wind and normals, which no outline shows.
fn plain(options: &MeshOptions) -> MeshOptions {
    MeshOptions { colours: None, swings: None, attributes: false, crown_normals: false, ..options.clone() }
}

/// How many octaves a number is above another.
fn ratio(above: u64, below: u64) -> f64 {
    log2(above.max(1) as f64 / below.max(1) as f64)
}
