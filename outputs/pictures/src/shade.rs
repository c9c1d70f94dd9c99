//! The light that leaves a face towards the eye: from sun, sky and ground, and through leaves.
//!
//! Leaves are seen and lit on both sides: sunlight on the far side shines through, yellower than reflected light. A
//! pale petal hardly tints the light that it transmits, and pale neighbours pass light on that does not reach the shade
//! of dark leaves: so a tree in blossom is white in its own shadow. Strengths and tints are by eye, chosen so that a
//! leaf in full light shows its stated colour. Absent: textures, gloss beyond a faint sheen of leaves, and light that
//! is scattered twice, for which there is a small constant.

use super::film::{Paint, Seen};
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

/// The light that leaves the surface `seen` at `point` in the direction `back`; `tap` chooses a point of the sun's
/// disc.
#[inline]
pub fn shade(seen: &Seen, point: Vec3, back: Vec3, light: &Light, tap: usize) -> Vec3 {
    let Paint { colour, thin, stained, .. } = seen.paint;
    let normal = seen.normal.normalize_or(back);
    let normal = if thin && normal.dot(back) < 0.0 { -normal } else { normal };
    let towards_sun = normal.dot(light.shadow.sun);
    let sky = light.sky.at(point);
    let (near, far) = (falling_on(sky, normal), falling_on(sky, -normal));
    let open = (2.0 * sky[0]).min(1.0);
    let from_ground = GROUND * ((0.5 - 0.5 * normal.z) * (0.25 + 0.75 * open));
    let around = from_ground + LEAST;
    let base = tone::light(colour);
    let facing = if thin || towards_sun > 0.0 { light.shadow.lit(point, normal, tap) } else { false };
    let sun = if facing { SUN } else { Vec3::ZERO };
    if stained {
        let lit = if facing { STAIN_SUN * towards_sun.abs() } else { 0.0 };
        return base * (STAIN + STAIN_SKY * near.max(far) + lit);
    }
    if !thin {
        return base * (sun * towards_sun.max(0.0) + SKY * near + around);
    }
    let pale = base.min_element();
    let passed = SKY * (PASSED_SKY * pale * (1.0 - near).max(0.0)) + (SUN - sun) * (PASSED_SUN * pale);
    let thrown = sun * (BACK * towards_sun.max(0.0)) + SKY * (BACK * near) + around + passed;
    let tint = THROUGH_TINT.lerp(Vec3::ONE, pale);
    let through = (sun * (-towards_sun).max(0.0) + SKY * far) * THROUGH * tint;
    let half = (light.shadow.sun + back).normalize_or_zero().dot(normal).max(0.0);
    let gloss = half * half * half * half;
    let sheen = (sun * (gloss * gloss * gloss) + SKY * (0.5 * near)) * SHEEN * 0.5;
    base * (thrown + through) + sheen
}
