//! What one camera holds over several pictures of a stand, and the side from which a flat plant is seen.
//!
//! The largest extent, the largest size of the ground around the plants, and the widest label: nothing but the plants
//! moves from picture to picture. Absent: how it is found (`survey`).

use super::View;
use super::extent::Extent;
use super::placed::PlacedStand;
use glam::Vec3;
use std::f32::consts::FRAC_PI_2;

/// A plant is flat if from some side it is this many times as wide as from another.
const FLAT: f32 = 1.4;

/// The number of sides from which a plant may be seen wide.
const SIDES: u8 = 4;

/// What a camera holds over several pictures of a stand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Framing {
    /// The angle, radians, by which the viewer has moved around the plants in the first picture.
    pub turn: f32,
    pub(super) extent: Extent,
    pub(super) pivot: Option<Vec3>,
    /// The size of the stand, metres: the diagonal of its box.
    pub(super) size: f32,
    /// The middle of the places of the plants.
    pub(super) middle: Vec3,
    /// The width of the widest label, pixels.
    pub(super) label: f32,
}

/// A side from which plants are seen: the angle around them, their width, and their extent.
pub type Side = (f32, f32, Extent);

/// The angles around a plant, radians, from which it may be seen wide.
pub fn angles() -> impl Iterator<Item = f32> {
    (0..SIDES).map(|step| f32::from(step) * FRAC_PI_2 / 2.0)
}

/// The side from which a flat plant is wide; the first for any other plant.
pub fn widest(sides: &[Side]) -> usize {
    let straight = sides.first().map_or(0.0, |side| side.1);
    let best = sides
        .iter()
        .enumerate()
        .skip(1)
        .fold((0, straight), |best, (number, side)| if side.1 > 1.02 * best.1 { (number, side.1) } else { best });
    if best.1 > FLAT * straight { best.0 } else { 0 }
}

/// The side from which a stand is seen wide, as an angle around it; 0 for one that is not flat.
pub fn wide_side(stand: &PlacedStand, view: View) -> f32 {
    let side = |turn: f32| {
        let gaze = view.gaze(turn);
        (turn, stand.width(gaze.right), Extent::new(gaze, [0.0; 4]))
    };
    let sides: Vec<Side> = angles().map(side).collect();
    sides[widest(&sides)].0
}
