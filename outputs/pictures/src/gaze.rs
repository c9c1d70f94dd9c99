//! The direction in which a camera looks: three perpendicular directions, in the coordinates of the plants.
//!
//! The gaze alone determines how far plants extend in a picture; the place of the camera follows from that. Absent: the
//! camera itself (`camera`).

use glam::Vec3;
use phytomer_sim::math::sincosf;

/// Three perpendicular unit vectors: the direction in which a camera looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gaze {
    /// To the right of the picture, level.
    pub right: Vec3,
    /// Up the picture.
    pub up: Vec3,
    /// Away from the eye.
    pub forward: Vec3,
}

impl Gaze {
    /// A gaze towards `azimuth`, from the X axis to the Y axis, and down by `decline`; radians.
    pub fn towards(azimuth: f32, decline: f32) -> Self {
        let ((sin_a, cos_a), (sin_d, cos_d)) = (sincosf(azimuth), sincosf(decline));
        Self {
            right: Vec3::new(sin_a, -cos_a, 0.0),
            up: Vec3::new(cos_a * sin_d, sin_a * sin_d, cos_d),
            forward: Vec3::new(cos_a * cos_d, sin_a * cos_d, -sin_d),
        }
    }

    /// A gaze straight down, with the Y axis up the picture, turned to the left by an angle, radians.
    pub fn down(turn: f32) -> Self {
        let (sin, cos) = sincosf(turn);
        Self { right: Vec3::new(cos, sin, 0.0), up: Vec3::new(-sin, cos, 0.0), forward: Vec3::NEG_Z }
    }
}
