//! The background behind and below the plants: a light sky, and ground that shows their shadows.
//!
//! Near a plant the ground has a tone of its own; farther off it fades into the background, so that no horizon cuts the
//! picture. Shadows darken the ground by the shares of sun and sky that are left; on a transparent picture they are the
//! opacity of a dark blue. In a level gaze the ground is a line.

use super::camera::Camera;
use super::shade::{Light, SKY, SUN};
use super::sky::falling_on;
use super::tone;
use glam::Vec3;

const ZENITH: [u8; 3] = [222, 231, 239];
const HORIZON: [u8; 3] = [248, 247, 243];
const EARTH: [u8; 3] = [229, 224, 211];
/// The colour below the line of the ground, in a level gaze.
const SECTION: [u8; 3] = [236, 231, 221];
const LINE: [u8; 3] = [139, 130, 116];
/// The colour of a shadow on a transparent picture.
const SHADE: [u8; 3] = [38, 44, 58];

/// The effect of a plant, or of a stand, on the ground.
#[derive(Debug, Clone, Copy)]
pub struct Footing<'a> {
    /// Its light.
    pub light: &'a Light,
    /// The offset from the place where its light was computed to its place in the picture.
    pub offset: Vec3,
    /// Its place in the picture.
    pub foot: Vec3,
    /// Its size, metres.
    pub size: f32,
}

/// The background of a pixel.
#[derive(Debug, Clone, Copy)]
pub struct Behind {
    /// The roots of its light.
    pub roots: Vec3,
    /// Its opacity.
    pub opacity: f32,
    /// The depth of the ground; 0 where there is none.
    pub depth: f32,
}

/// The roots of the light of the colours of a background.
#[derive(Debug)]
pub struct Tones {
    zenith: Vec3,
    horizon: Vec3,
    earth: Vec3,
}

impl Default for Tones {
    fn default() -> Self {
        let [zenith, horizon, earth] = [ZENITH, HORIZON, EARTH].map(tone::roots);
        Self { zenith, horizon, earth }
    }
}

/// The background of one picture.
#[derive(Debug)]
pub struct Ground<'a> {
    /// Its colours.
    pub tones: Tones,
    /// Its camera.
    pub camera: &'a Camera,
    /// The plants that stand on it.
    pub footings: &'a [Footing<'a>],
    /// The height of the picture, pixels.
    pub height: f32,
    /// Whether ground is drawn.
    pub drawn: bool,
    /// Whether the background is transparent.
    pub transparent: bool,
}

impl Ground<'_> {
    /// The background of the pixel around a place.
    pub fn behind(&self, x: f32, y: f32) -> Behind {
        let paper = self.paper(y);
        let none = Behind { roots: paper, opacity: if self.transparent { 0.0 } else { 1.0 }, depth: 0.0 };
        if !self.drawn {
            return none;
        }
        if !self.camera.sees_ground() {
            return self.section(y, none);
        }
        let Some(point) = self.camera.ground(x, y) else { return none };
        let depth = self.camera.project(point).map_or(0.0, |seen| seen.z);
        let left = self.left(point);
        if self.transparent {
            let opacity = 1.0 - (left.x + left.y + left.z) / 3.0;
            return Behind { roots: tone::roots(SHADE), opacity, depth };
        }
        let earth = paper.lerp(self.tones.earth, self.nearness(point));
        Behind { roots: earth * left.map(f32::sqrt), opacity: 1.0, depth }
    }

    fn paper(&self, y: f32) -> Vec3 {
        self.tones.zenith.lerp(self.tones.horizon, smooth(y / self.height / 0.85))
    }

    /// The background in a level gaze: the ground as a line one pixel wide, and the section below it.
    fn section(&self, y: f32, none: Behind) -> Behind {
        let line = self.camera.project(Vec3::ZERO).map_or(f32::MAX, |seen| seen.y);
        let below = (y + 0.5 - line).clamp(0.0, 1.0);
        let width = (self.height / 700.0).max(1.0);
        let on = (0.5 * width + 0.5 - (y - line).abs()).clamp(0.0, 1.0);
        if self.transparent {
            return Behind { roots: tone::roots(LINE), opacity: on, depth: 0.0 };
        }
        let roots = none.roots.lerp(tone::roots(SECTION), 0.7 * below).lerp(tone::roots(LINE), on);
        Behind { roots, ..none }
    }

    /// How near a point is to the plants on the ground, from 0 (far away) to 1 (below a plant).
    fn nearness(&self, point: Vec3) -> f32 {
        let of = |footing: &Footing| {
            let far = (point - footing.foot).length() / footing.size.max(1e-6);
            1.0 - smooth((far - 0.15) / 1.35)
        };
        self.footings.iter().map(of).fold(0.0, f32::max)
    }

    /// The share of the light on open ground that reaches a point under the plants, by colour.
    fn left(&self, point: Vec3) -> Vec3 {
        self.footings.iter().fold(Vec3::ONE, |left, footing| {
            let light = footing.light;
            let point = point - footing.offset;
            let high = light.shadow.sun.z;
            let holds = light.sky.holds(point);
            let open = if holds > 0.0 { falling_on(light.sky.at(point), Vec3::Z).min(1.0) } else { 1.0 };
            let sky = 1.0 - (1.0 - open) * holds;
            let gets = SUN * (high * light.shadow.share(point)) + SKY * sky;
            left * (gets / (SUN * high + SKY))
        })
    }
}

fn smooth(x: f32) -> f32 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}
