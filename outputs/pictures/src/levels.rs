//! Levels of detail: coarser and coarser meshes of a plant whose outlines from eight sides are nearly that of the
//! first.
//!
//! A level has at most so many triangles. First the tolerance of its wood and of the forms of its organs grows, as long
//! as the outline holds; where that is not enough, organs become fewer and larger ([`Thinned`]). Each level keeps some
//! of the organs of the level before. An outline holds where its area differs by at most [`MOST_APART`] from that of
//! the first level, from each of eight sides (`sides`). Tolerances are tried on the grid of `budget`, thirty-two steps
//! an octave; the number of triangles falls with them nearly as a power, so that a few trials find one that fits, and
//! the same wherever it is asked. Absent: how levels are written, and cards, which stand for the last.

use super::sides::{Apart, Outline, Sides};
use phytomer_meshes::{Keeping, MeshOptions, Scene, Thinned, Tolerance, organ_number};
use phytomer_sim::clock::Tick;
use phytomer_sim::math::{exp2, log2};
use phytomer_sim::plant::Plant;

/// The largest difference between the areas of outlines, as a share. What files promise is 3 %; the rest is for what
/// the samples miss.
pub const MOST_APART: f64 = 0.025;

/// The samples along the longest side of an outline: at most a pixel of a picture of a plant at which levels change.
const SAMPLES: u32 = 480;

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

/// The share of its radius by which the radius of wood may be off.
const OF_RADIUS: f32 = 0.5;

/// The part of the screen that the plant covers where the second level takes over.
const SCREEN: f64 = 0.25;

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
    let search = Search::of(plant, age, first);
    let mut found = vec![search.first()];
    for (level, most) in (1..).zip(most) {
        let before = &found[level - 1];
        let coarser = search.coarser(before, most.unwrap_or((before.faces as f64 * AIM) as u64));
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
    faces: u64,
    /// The step of the tolerance of the first level.
    step: u32,
}

impl<'p> Search<'p> {
    fn of(plant: &'p Plant, age: Tick, options: &'p MeshOptions) -> Self {
        let scene = Scene::new(plant, age, options);
        let sides = Sides::around(&scene, SAMPLES);
        let outline = sides.map(|sides| (sides.clone(), sides.of(&scene)));
        let octaves = options.tolerance.map_or(0.0, |own| log2(f64::from(own.distance / Tolerance::LEAST)));
        let step = (octaves * f64::from(STEPS)).clamp(0.0, f64::from(LAST)) as u32;
        Self { plant, age, options, outline, faces: scene.counts().faces, step }
    }

    fn first(&self) -> Tried {
        let (step, options) = (self.step, self.options.clone());
        Tried { step, share: 1.0, options, faces: self.faces, apart: Apart::default() }
    }

    /// The options of a step with a share of the organs.
    fn options(&self, step: u32, share: f64) -> MeshOptions {
        let distance = Tolerance::LEAST * exp2(f64::from(step) / f64::from(STEPS)) as f32;
        // Wood is seen as wide as the first level draws it.
        let keeps = if self.options.tolerance.is_some() { Keeping::Section } else { Keeping::Tube(self.options.sides) };
        let tolerance = Tolerance { share: OF_RADIUS, keeps, organs: true, ..Tolerance::of(distance) };
        let thinned = Thinned::of(self.plant, self.age, share);
        MeshOptions { tolerance: Some(tolerance), thinned, ..self.options.clone() }
    }

    fn count(&self, step: u32, share: f64) -> Tried {
        let options = self.options(step, share);
        let faces = Scene::new(self.plant, self.age, &options).counts().faces;
        Tried { step, share, options, faces, apart: Apart::default() }
    }

    /// Looks at the outline of a mesh, and tells whether it holds.
    fn holds(&self, tried: &mut Tried) -> bool {
        if let Some((sides, first)) = &self.outline {
            tried.apart = sides.of(&Scene::new(self.plant, self.age, &tried.options)).apart(first);
        }
        tried.apart.area <= MOST_APART
    }

    /// The next level after one, of at most so many triangles.
    fn coarser(&self, before: &Tried, most: u64) -> Found {
        let mut widest = before.clone();
        if before.share >= 1.0 {
            let mut beyond = LAST;
            if let Some(mut fits) = self.fitting(before, most) {
                if self.holds(&mut fits) {
                    return Found::Fits(fits);
                }
                beyond = fits.step;
            }
            widest = self.widest(before, beyond);
        }
        self.thinner(widest, most)
    }

    /// A mesh of all organs that has at most so many triangles, and not many fewer; `None` where there is none.
    fn fitting(&self, before: &Tried, most: u64) -> Option<Tried> {
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
            if step >= LAST && low.0 >= LAST || high.as_ref().is_some_and(|high| high.step <= low.0 + 1) {
                break;
            }
            let tried = self.count(step.clamp(low.0 + 1, LAST), 1.0);
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

    /// The widest tolerance below a step with which the outline of all organs holds, to an octave or so.
    fn widest(&self, before: &Tried, beyond: u32) -> Tried {
        let mut widest = before.clone();
        let (mut low, mut high) = (before.step, beyond);
        while high > low + STEPS / 2 {
            let step = low.midpoint(high);
            let mut tried = self.count(step, 1.0);
            if self.holds(&mut tried) {
                (low, widest) = (step, tried);
            } else {
                high = step;
            }
        }
        widest
    }

    /// A mesh of fewer organs that has at most so many triangles.
    fn thinner(&self, widest: Tried, most: u64) -> Found {
        let scene = Scene::new(self.plant, self.age, &widest.options);
        let mut organs: Vec<(f64, u64)> =
            scene.organs().map(|organ| (organ_number(self.plant, organ), scene.faces_of(organ))).collect();
        organs.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let of_organs: u64 = organs.iter().map(|organ| organ.1).sum();
        let mut room = most.saturating_sub(widest.faces - of_organs);
        let first_left_out = organs.iter().find(|(_, faces)| {
            let fits = *faces <= room;
            room = room.saturating_sub(*faces);
            !fits
        });
        let share = first_left_out.map_or(widest.share, |(number, _)| *number);
        if widest.faces - of_organs <= most {
            let mut tried = self.count(widest.step, share);
            if tried.faces <= most && self.holds(&mut tried) {
                return Found::Fits(tried);
            }
        }
        let (mut low, mut least) = (share, widest);
        for _ in 0..4 {
            let mut tried = self.count(least.step, 0.5 * (low + least.share));
            if self.holds(&mut tried) { least = tried } else { low = tried.share }
        }
        Found::Least(least)
    }
}

/// How many octaves a number is above another.
fn ratio(above: u64, below: u64) -> f64 {
    log2(above.max(1) as f64 / below.max(1) as f64)
}
