//! What a turtle takes from a view file, and the bounds of the numbers that it is told.
//!
//! Absent: how it draws by them.

use super::Vector;
use crate::lsystem::view::{Tropism, View};

/// The largest number that a parameter or a length is taken for.
const MOST: f64 = 1e30;

/// What a turtle takes from a view file.
#[derive(Debug, Clone)]
pub(super) struct Settings {
    pub angle: f64,
    pub width: f64,
    pub width_increment: f64,
    pub colour: [i32; 2],
    pub colour_increment: [i32; 2],
    pub tropism: Vector,
    pub elasticity: f64,
    pub elasticity_increment: f64,
    pub tropisms: Vec<Tropism>,
    pub scale: f64,
    pub scale_multiplier: f64,
    /// Whether generalised cylinders twist no more than they bend.
    pub untwisted: bool,
}

impl Settings {
    /// Those of a view, its angles in radians.
    pub fn of(view: &View) -> Self {
        Self {
            angle: bounded(view.angle_deg).to_radians(),
            width: bounded(view.line_width).max(0.0),
            width_increment: bounded(view.line_width_increment),
            colour: view.colour,
            colour_increment: view.colour_increment,
            tropism: view.tropism.map(bounded),
            elasticity: bounded(view.elasticity),
            elasticity_increment: bounded(view.elasticity_increment),
            tropisms: view.tropisms.iter().map(within).collect(),
            scale: bounded(view.scale),
            scale_multiplier: bounded(view.scale_multiplier),
            // Of round cylinders a twist is not seen.
            untwisted: !view.contours.is_empty() && !view.cylinders_twist,
        }
    }
}

/// A tropism of a view file with its numbers within bounds.
fn within(of: &Tropism) -> Tropism {
    Tropism {
        angle_deg: bounded(of.angle_deg),
        elasticity: bounded(of.elasticity),
        elasticity_increment: bounded(of.elasticity_increment),
        ..*of
    }
}

/// A finite number of a size that leaves room for sums.
#[inline]
pub(super) fn bounded(number: f64) -> f64 {
    if number.abs() <= MOST {
        number
    } else if number.is_nan() {
        0.0
    } else {
        number.clamp(-MOST, MOST)
    }
}
