//! The light that leaves a face towards the eye: from sun, sky and ground, and through leaves.
//!
//! Leaves are seen and lit on both sides: sunlight on the far side shines through, yellower than reflected light. A
//! pale petal hardly tints the light that it transmits, and pale neighbours pass light on that does not reach the shade
//! of dark leaves: so a tree in blossom is white in its own shadow. Strengths and tints are by eye, chosen so that a
//! leaf in full light shows its stated colour. Absent: textures, gloss beyond a faint sheen of leaves, and light that
//! is scattered twice, for which there is a small constant.

use super::film::Paint;
use super::shadow::Shadow;
use super::sky::{Sky, falling_on};
use super::tone;
use glam::Vec3;

/// The light of the sun on a face perpendicular to its rays.
pub const SUN: Vec3 = Vec3::new(1.62, 1.48, 1.24);
/// The light of the whole sky on level ground.
pub const SKY: Vec3 = Vec3::new(0.62, 0.69, 0.78);
/// The light that the ground reflects upwards.
const GROUND: Vec3 = Vec3::new(0.33, 0.305, 0.245);
/// The light in the deepest shade.
const LEAST: Vec3 = Vec3::new(0.095, 0.1, 0.088);
/// The shares of light that leaves reflect and transmit.
const BACK: f32 = 0.78;
const THROUGH: f32 = 0.5;
const THROUGH_TINT: Vec3 = Vec3::new(1.15, 1.12, 0.5);
const SHEEN: f32 = 0.07;
/// The shares of the hidden sky and of the blocked sun that white neighbours pass on to a white face.
const PASSED_SKY: f32 = 0.5;
const PASSED_SUN: f32 = 0.25;
/// The light of colours that stand for values: a constant part, the part of the sky, the part of the sun.
const STAIN: f32 = 0.5;
const STAIN_SKY: f32 = 0.45;
const STAIN_SUN: f32 = 0.4;

/// The light over one plant or stand.
#[derive(Debug)]
pub struct Light {
    /// The light of the sun.
    pub shadow: Shadow,
    /// The light of the sky.
    pub sky: Sky,
}

/// The light that leaves a surface towards the eye.
#[derive(Debug, Clone, Copy)]
pub struct Shaded {
    /// The light where the sun does not reach it.
    pub shade: Vec3,
    /// The light in the sun; `None` for a surface that the sun never reaches.
    pub sunlit: Option<Vec3>,
    /// Its normal on the side that is seen.
    pub normal: Vec3,
}

/// The light that leaves a surface of this paint and unit normal at a point, in the unit direction `back`.
pub fn shade(paint: Paint, normal: Vec3, (point, back): (Vec3, Vec3), light: &Light) -> Shaded {
    let Paint { colour, thin, stained, .. } = paint;
    let normal = if thin && normal.dot(back) < 0.0 { -normal } else { normal };
    let towards_sun = normal.dot(light.shadow.sun);
    let faces_sun = thin || towards_sun > 0.0;
    let sky = light.sky.at(point);
    let (near, far) = (falling_on(sky, normal), falling_on(sky, -normal));
    let open = (2.0 * sky[0]).min(1.0);
    let from_ground = GROUND * ((0.5 - 0.5 * normal.z) * (0.25 + 0.75 * open));
    let around = from_ground + LEAST;
    let base = tone::light(colour);
    let (shade, sun) = if stained {
        (base * (STAIN + STAIN_SKY * near.max(far)), base * (STAIN_SUN * towards_sun.abs()))
    } else if thin {
        let pale = base.min_element();
        let passed = SKY * (PASSED_SKY * pale * (1.0 - near).max(0.0)) + SUN * (PASSED_SUN * pale);
        let tint = THROUGH_TINT.lerp(Vec3::ONE, pale);
        let half = (light.shadow.sun + back).normalize_or_zero().dot(normal).max(0.0);
        let gloss = half * half * half * half;
        let thrown = SKY * (BACK * near) + around + passed;
        let through = SKY * far * THROUGH * tint;
        let shade = base * (thrown + through) + SKY * (0.5 * near * SHEEN * 0.5);
        // What the sun adds where it reaches the face itself; then its neighbours pass on none of it.
        let thrown = BACK * towards_sun.max(0.0) - PASSED_SUN * pale;
        let through = tint * ((-towards_sun).max(0.0) * THROUGH);
        (shade, SUN * (base * (through + thrown) + gloss * gloss * gloss * SHEEN * 0.5))
    } else {
        (base * (SKY * near + around), base * SUN * towards_sun.max(0.0))
    };
    Shaded { shade, sunlit: faces_sun.then(|| shade + sun), normal }
}
