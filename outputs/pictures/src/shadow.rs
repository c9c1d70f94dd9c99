//! The shadow of a plant: its nearest depths as seen from the sun, over a grid of texels.
//!
//! This is a shadow map under parallel light, filled by atomic maxima as [`super::film`] is. A point is in shadow where
//! a surface lies nearer to the sun. The taps of a penumbra spread with the distance to that surface, as the sun's disc
//! makes them do.

use super::camera::Camera;
use super::extent::{Extent, corners};
use super::film::keep_nearest;
use super::gaze::Gaze;
use super::raster::{UPRIGHT, Window, cover};
use glam::Vec3;
use phytomer_sim::math::sincosf;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// The number of texels along the longer side.
const TEXELS: f32 = 2048.0;
/// The half-width of the penumbra, metres per metre between the surface that throws the shadow and the surface that
/// shows it. The sun's disc gives 0.0047; a hazy sky is softer and looks better.
const SOFTNESS: f32 = 0.016;

/// How far points are lifted off their surface at least, and towards the sun, texels.
const OFF_SURFACE: f32 = 1.2;
const TOWARDS_SUN: f32 = 1.8;
/// The farthest that a tap of a surface lies from the middle of the texel that it asks, texels, with a margin.
const FARTHEST_TAP: f32 = 1.5 + 0.75 + 0.1;

/// The number of taps of a penumbra; each sample of a pixel takes one tap.
pub const TAPS: usize = 16;

/// The number of taps of a penumbra on the ground, which is shaded once per pixel.
const GROUND_TAPS: usize = 64;

static DISC: LazyLock<[[f32; 2]; TAPS]> = LazyLock::new(disc);
static GROUND_DISC: LazyLock<[[f32; 2]; GROUND_TAPS]> = LazyLock::new(disc);

/// Points spread over the unit disc: Vogel's sunflower spiral.
fn disc<const N: usize>() -> [[f32; 2]; N] {
    std::array::from_fn(|k| {
        let radius = ((k as f32 + 0.5) / N as f32).sqrt();
        // The golden angle, 137.508 degrees.
        let (sin, cos) = sincosf(2.399_963 * k as f32);
        [radius * cos, radius * sin]
    })
}

/// The sunlight over one plant or stand.
#[derive(Debug)]
pub struct Shadow {
    /// The direction towards the sun, a unit vector.
    pub sun: Vec3,
    camera: Camera,
    window: Window,
    depths: Vec<AtomicU32>,
    /// The depth of the map from front to back, metres.
    reach: f32,
    /// The size of a texel, metres.
    texel: f32,
}

impl Shadow {
    /// An empty shadow map over a box, for a sun at an azimuth and an elevation, radians.
    pub fn over(low: Vec3, high: Vec3, [azimuth, elevation]: [f32; 2]) -> Self {
        let gaze = Gaze::towards(azimuth + std::f32::consts::PI, elevation);
        let mut seen = Extent::new(gaze, [0.0; 4]);
        corners([low, high]).for_each(|corner| seen.add(corner));
        let [west, east, north, south] = seen.most;
        let (wide, tall) = ((west + east).max(1e-3), (north + south).max(1e-3));
        let scale = TEXELS / wide.max(tall);
        // A margin of texels all around, so that taps beyond the map are in the light.
        let size = [wide, tall].map(|side| (side * scale).ceil() + 4.0);
        let middle = [0.5 * (east - west), 0.5 * (north - south)];
        let camera = Camera::parallel(gaze, middle, seen.depths, scale, size.map(|side| 0.5 * side));
        let window = Window { columns: 0..size[0] as u32, rows: 0..size[1] as u32, shifts: UPRIGHT };
        let mut depths = Vec::new();
        depths.resize_with(window.len(), AtomicU32::default);
        let reach = match camera.lens {
            super::camera::Lens::Parallel { reach, .. } => reach,
            super::camera::Lens::Perspective { .. } => 1.0,
        };
        Self { sun: -gaze.forward, camera, window, depths, reach, texel: 1.0 / scale }
    }

    /// Adds the shadow of a triangle.
    #[inline]
    pub fn cast(&self, corners: &[Vec3; 3]) {
        let [Some(a), Some(b), Some(c)] = corners.map(|corner| self.camera.project(corner)) else { return };
        cover(&[a, b, c], &self.window, |sample| keep_nearest(&self.depths[sample.index], sample.depth));
    }

    /// The distance from a tap to the nearest surface towards the sun, metres; `None` in the light.
    #[inline]
    fn above(&self, seen: Vec3, tap: [f32; 2], radius: f32) -> Option<f32> {
        let (x, y) = (seen.x + radius * tap[0], seen.y + radius * tap[1]);
        let inside = x >= 0.0 && y >= 0.0 && x < self.window.columns.end as f32 && y < self.window.rows.end as f32;
        if !inside {
            return None;
        }
        let depth = f32::from_bits(self.depths[self.window.index(x as u32, y as u32)].load(Relaxed));
        let above = (depth - seen.z) * self.reach;
        // The depth is 0 where no triangle was added; the ground may lie beyond the reach of the map.
        (depth > 0.0 && above > 0.0).then_some(above)
    }

    /// A point of a surface in the coordinates of the map, lifted off the surface so that it does not shade itself.
    #[inline]
    fn lifted(&self, point: Vec3, normal: Vec3) -> Vec3 {
        let side = if normal.dot(self.sun) < 0.0 { -normal } else { normal };
        let lifted = point + side * (self.clearance(side) * self.texel) + self.sun * (TOWARDS_SUN * self.texel);
        self.camera.project(lifted).unwrap_or(Vec3::ZERO)
    }

    /// How far off a surface a point is lifted, texels. A tap is up to 1.5 texels aside and asks a depth of the middle
    /// of a texel: on a plane at an angle to the rays what it finds lies nearer to the sun by as much as the sine of
    /// that angle times both. A plane that lies along the rays needs the most; less would draw the rows of the map on
    /// it as waves.
    #[inline]
    fn clearance(&self, side: Vec3) -> f32 {
        let cosine = side.dot(self.sun).clamp(0.0, 1.0);
        let sine = (1.0 - cosine * cosine).sqrt();
        OFF_SURFACE.max(FARTHEST_TAP * sine - TOWARDS_SUN * cosine)
    }

    /// Whether a point on a surface is in the light, by one of its taps.
    #[inline]
    pub fn lit(&self, point: Vec3, normal: Vec3, tap: usize) -> bool {
        let seen = self.lifted(point, normal);
        self.above(seen, DISC[tap % TAPS], 1.5).is_none()
    }

    /// The share of the sun that reaches a point of the ground.
    pub fn share(&self, point: Vec3) -> f32 {
        let seen = self.lifted(point, Vec3::Z);
        let width = self.window.columns.end.max(self.window.rows.end) as f32;
        let search = 0.5 * SOFTNESS * self.reach / self.texel;
        let nearby = |seen: Vec3| seen.x < -search || seen.y < -search || seen.x.max(seen.y) > width + search;
        if nearby(seen) {
            return 1.0;
        }
        let blockers = DISC.iter().filter_map(|tap| self.above(seen, *tap, search));
        let (count, sum) = blockers.fold((0.0, 0.0), |(count, sum), above| (count + 1.0, sum + above));
        if count == 0.0 {
            return 1.0;
        }
        let radius = (SOFTNESS * sum / count / self.texel).clamp(1.0, search.max(1.0));
        let dark = GROUND_DISC.iter().filter(|tap| self.above(seen, **tap, radius).is_some()).count();
        1.0 - dark as f32 / GROUND_TAPS as f32
    }
}
