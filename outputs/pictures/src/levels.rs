//! Levels of detail: coarser and coarser meshes of a plant whose outlines from eight sides are nearly that of the
//! first.
//!
//! A level has at most so many triangles. First the tolerance of its wood and of the forms of its organs grows, as long
//! as the outline holds; where that is not enough, organs become fewer and larger ([`phytomer_meshes::Thinned`]). Each
//! level keeps some of the organs of the level before. An outline holds where its area differs by at most 2.5 % from
//! that of the first level, from each of eight sides (`sides`). Tolerances are tried on the grid of
//! `budget`, thirty-two steps an octave; the number of triangles falls with them nearly as a power, so that a few
//! trials find one that fits, and the same wherever it is asked. Absent: the search (`search`), how levels are
//! written, and cards, which stand for the last.

use super::search::{Found, Search, Tried};
use super::sides::Apart;
use phytomer_meshes::MeshOptions;
use phytomer_sim::clock::Tick;
use phytomer_sim::plant::Plant;

/// The part of the triangles of the level before that a level aims at where nothing is said.
const AIM: f64 = 0.25;
/// The part of them that it has at most, else it is none.
const WORTH: f64 = 0.8;

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
    each_level(plant, age, first, most, &mut |_| ())
}

/// The levels of a plant, as [`levels`] finds them; calls `told` with the options of each level after the first as soon
/// as it is found, so that it can be written while the next is sought.
///
/// # Errors
/// Those of [`levels`].
pub fn each_level(
    plant: &Plant,
    age: Tick,
    first: &MeshOptions,
    most: &[Option<u64>],
    told: &mut dyn FnMut(&MeshOptions),
) -> Result<Vec<Level>, TooCoarse> {
    let mut search = Search::of(plant, age, first);
    let mut found = vec![search.first()];
    let mut is_least = false;
    for (level, most) in (1..).zip(most) {
        let before = &found[level - 1];
        // After the fewest triangles with which the outline of a large plant holds none far fewer are sought.
        if is_least && search.is_large && most.is_none() {
            break;
        }
        let coarser = search.coarser(before, most.unwrap_or((before.faces as f64 * AIM) as u64));
        is_least = matches!(coarser, Found::Least(_));
        let tried = match (coarser, most) {
            (Found::Fits(tried), _) => tried,
            (Found::Least(tried), Some(most)) => return Err(TooCoarse { level, most: *most, least: tried.faces }),
            (Found::Least(tried), None) if tried.faces as f64 <= WORTH * before.faces as f64 => tried,
            (Found::Least(_), None) => break,
        };
        told(&tried.options);
        found.push(tried);
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
