//! Levels of detail: coarser and coarser meshes of a plant whose outlines from eight sides are nearly that of the
//! first.
//!
//! A level has at most so many triangles. First the tolerance of its wood and of the forms of its organs grows, as long
//! as the outline holds; where that is not enough, organs become fewer and larger ([`phytomer_meshes::Thinned`]). Each
//! level keeps some of the organs of the level before. An outline holds where its area differs by at most
//! [`MOST_APART`] from that of the first level, from each of eight sides (`sides`). Tolerances are tried on the grid of
//! `budget`, thirty-two steps an octave; the number of triangles falls with them nearly as a power, so that a few
//! trials find one that fits, and the same wherever it is asked. Absent: how levels are written, and cards, which stand
//! for the last.

use super::costs::Costs;
use super::sides::{Apart, Outline, Sides};
use phytomer_meshes::{Keeping, MeshOptions, Scene, Tolerance};
use phytomer_sim::clock::Tick;
use phytomer_sim::math::{exp2, log2};
use phytomer_sim::plant::Plant;
use std::collections::BTreeMap;

/// The largest difference between the areas of outlines, as a share. What files promise is 3 %; the rest is for what
/// the samples miss.
pub const MOST_APART: f64 = 0.025;

/// The difference that is aimed at between a mesh that holds and one that does not.
const AIMED_APART: f64 = 0.02;

/// The most outlines that are drawn to find the widest tolerance.
const LOOKS: u32 = 5;

/// The samples along the longest side of an outline: at most a pixel of a picture of a plant at which levels change.
const SAMPLES: u32 = 480;

/// A plant of more triangles is tried on every so many rows of these, within a little less, and what is found is looked
/// at on all of them: of the rows of a crown each has a difference of its own, so that the mean of a few is near that
/// of all. Where that does not hold, it is sought on all rows.
const LARGE: u64 = 400_000;
const ROWS_APART: u32 = 6;
const MOST_APART_IN_ROWS: f64 = 0.0225;

/// The steps of an octave of tolerances, and the step of the largest.
const STEPS: u32 = 32;
const LAST: u32 = 24 * STEPS;

/// The least part of the triangles it may have that a level is content with, and the most trials to come there.
const ENOUGH: f64 = 0.8;
const TRIALS: u32 = 8;

/// The part of the triangles of the level before that a level aims at where nothing is said.
const AIM: f64 = 0.25;
/// The part of them that it has at most, else it is none.
const WORTH: f64 = 0.8;

/// The largest tolerance, in longest sides of the plant: stems that begin so far beside the one that they go on from
/// are joined within sixteen times the distance.
const OF_LONGEST: f32 = 16.0;

/// The share of its radius by which the radius of wood may be off.
const OF_RADIUS: f32 = 0.5;

/// The part of the screen that the plant covers where the second level takes over.
pub const SCREEN: f64 = 0.25;

/// A level.
#[derive(Debug, Clone)]
pub struct Level {
    /// How it is drawn.
    pub options: MeshOptions,
    /// The number of its triangles.
    pub faces: u64,
    /// How far its outline is from that of the first level.
    pub apart: Apart,
    /// The part of the area of the screen that the plant covers, down to which the level is shown.
    pub screen: f64,
}

/// A level cannot have so few triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("level {level} would have at least {least} triangles, and may have {most}")]
pub struct TooCoarse {
    /// The level.
    pub level: usize,
    /// What it may have.
    pub most: u64,
    /// The fewest with which its outline holds, as far as the search sees.
    pub least: u64,
}

/// The first level of a plant, drawn with these options, and further ones: each of at most so many triangles, or where
/// nothing is said of a quarter of those of the level before, or of the fewest with which the outline holds. Where that
/// is hardly fewer the levels end.
///
/// # Errors
/// Where a level cannot have as few triangles as it may have.
pub fn levels(plant: &Plant, age: Tick, first: &MeshOptions, most: &[Option<u64>]) -> Result<Vec<Level>, TooCoarse> {
    let mut search = Search::of(plant, age, first);
    let mut found = vec![search.first()];
    for (level, most) in (1..).zip(most) {
        let before = &found[level - 1];
        let coarser = search.checked(before, *most);
        match (coarser, most) {
            (Found::Fits(tried), _) => found.push(tried),
            (Found::Least(tried), Some(most)) => return Err(TooCoarse { level, most: *most, least: tried.faces }),
            (Found::Least(tried), None) if tried.faces as f64 <= WORTH * before.faces as f64 => found.push(tried),
            (Found::Least(_), None) => break,
        }
    }
    let faces: Vec<u64> = found.iter().map(|tried| tried.faces).collect();
    let screen = |level: usize| match faces.get(level + 1) {
        Some(_) => SCREEN * faces[level] as f64 / faces[0].max(1) as f64,
        None => 0.0,
    };
    let level = |(level, tried): (usize, Tried)| Level {
        options: tried.options,
        faces: tried.faces,
        apart: tried.apart,
        screen: screen(level),
    };
    Ok(found.into_iter().enumerate().map(level).collect())
}

/// A mesh that was tried.
#[derive(Debug, Clone)]
struct Tried {
    step: u32,
    share: f64,
    options: MeshOptions,
    faces: u64,
    /// How far its outline is, where that was looked at.
    apart: Apart,
}

/// What was found for a number of triangles.
enum Found {
    Fits(Tried),
    /// The coarsest whose outline holds, which has too many.
    Least(Tried),
}

/// The plant, and the outline of its first level.
struct Search<'p> {
    plant: &'p Plant,
    age: Tick,
    options: &'p MeshOptions,
    outline: Option<(Sides, Outline)>,
    /// All rows and what the first level covers of them, where outlines are tried on some of them.
    all_rows: Option<(Sides, Outline)>,
    /// The largest difference on the rows that are tried.
    bound: f64,
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
    fn of(plant: &'p Plant, age: Tick, options: &'p MeshOptions) -> Self {
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
        let with_outline = |sides: Sides| {
            let outline = sides.of(&sides.of_wood(&scene), &scene, &costs);
            (sides, outline)
        };
        let is_large = faces > LARGE;
        let some_rows = sides.as_ref().filter(|_| is_large).map(|sides| with_outline(sides.sparser(ROWS_APART)));
        let all = sides.map(with_outline);
        let (outline, all_rows) = if some_rows.is_some() { (some_rows, all) } else { (all, None) };
        let last = distances.partition_point(|distance| *distance < farthest).clamp(1, LAST as usize) as u32;
        let octaves = options.tolerance.map_or(0.0, |own| log2(f64::from(own.distance / Tolerance::LEAST)));
        let step = (octaves * f64::from(STEPS)).clamp(0.0, f64::from(last)) as u32;
        Self {
            plant,
            age,
            options,
            outline,
            all_rows,
            bound: if is_large { MOST_APART_IN_ROWS } else { MOST_APART },
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

    fn first(&self) -> Tried {
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
        let (tolerance, thinned) = (Some(self.tolerance(step)), self.costs.thinned((self.plant, self.age), share));
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
        tried.apart.area <= self.bound
    }

    /// Looks at the outline of a mesh on all rows, and tells whether it holds.
    fn holds_on_all_rows(&mut self, tried: &mut Tried) -> bool {
        self.look(tried.step);
        let Self { all_rows: Some((sides, first)), looked: Some(looked), costs, .. } = self else { return true };
        looked.scene.thin(tried.options.thinned);
        tried.apart = sides.of(&sides.of_wood(&looked.scene), &looked.scene, costs).apart(first);
        tried.apart.area <= MOST_APART
    }

    /// The next level after one, looked at on all rows.
    fn checked(&mut self, before: &Tried, stated: Option<u64>) -> Found {
        let most = stated.unwrap_or((before.faces as f64 * AIM) as u64);
        let mut found = self.coarser(before, most);
        let (Found::Fits(tried) | Found::Least(tried)) = &mut found;
        let ends = stated.is_none() && tried.faces as f64 > WORTH * before.faces as f64;
        if ends || self.holds_on_all_rows(tried) {
            return found;
        }
        self.bound = MOST_APART;
        (self.outline, self.looked, self.organs) = (self.all_rows.take(), None, None);
        self.coarser(before, most)
    }

    /// The next level after one, of at most so many triangles.
    fn coarser(&mut self, before: &Tried, most: u64) -> Found {
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
        let looks = if is_at_bound { 2 } else { 3 };
        for look in 0..looks {
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

/// The same without what no outline shows.
fn plain(options: &MeshOptions) -> MeshOptions {
    MeshOptions { colours: None, swings: None, attributes: false, crown_normals: false, ..options.clone() }
}

/// How many octaves a number is above another.
fn ratio(above: u64, below: u64) -> f64 {
    log2(above.max(1) as f64 / below.max(1) as f64)
}
