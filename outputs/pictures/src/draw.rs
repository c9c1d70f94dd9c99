//! One picture: the samples of some rows at a time on a film, then their pixels.
//!
//! A pixel is the mean of [`FINE`]² samples, each shaded at its own place. Rows are drawn in pages, so that memory does
//! not grow with the picture; blocks of plants that a page does not show are skipped for it.

use super::camera::Camera;
use super::canvas::Canvas;
use super::film::Film;
use super::ground::{Behind, Footing, Ground};
use super::placed::PlacedStand;
use super::raster::Window;
use super::shade::{Light, shade};
use super::tone;
use glam::Vec3;
use rayon::prelude::*;

/// The number of samples of a pixel along each side.
pub const FINE: u32 = 4;
/// The number of samples of a page, at 12 bytes each.
const PAGE: u32 = 4 << 20;
/// The rows of samples of one pixel stand apart by a quarter of a sample.
const SHIFTS: &[f32] = &[-0.375, 0.125, -0.125, 0.375];

/// The content of a picture.
#[derive(Debug)]
pub struct Set<'a> {
    /// The stands, in their places in the picture.
    pub stands: &'a [PlacedStand<'a>],
    /// The light over each stand.
    pub lights: &'a [Light],
    /// The camera.
    pub camera: Camera,
    /// Whether ground is drawn.
    pub ground: bool,
    /// Whether the background is transparent.
    pub transparent: bool,
    /// The middle and the size of the ground around each stand.
    pub around: &'a [(Vec3, f32)],
}

/// Draws a picture of this size, pixels, without text.
pub fn draw(set: &Set, [width, height]: [u32; 2]) -> Canvas {
    let mut canvas = Canvas::new(width, height);
    let footings: Vec<Footing> = set
        .stands
        .iter()
        .zip(set.lights)
        .zip(set.around)
        .map(|((stand, light), around)| footing(stand, light, *around))
        .collect();
    let ground = Ground {
        camera: &set.camera,
        footings: &footings,
        height: height as f32,
        drawn: set.ground,
        transparent: set.transparent,
    };
    let rows = (PAGE / (width * FINE * FINE)).clamp(1, height);
    let mut film = Film::default();
    for (page, pixels) in canvas.pixels.chunks_mut((rows * width) as usize).enumerate() {
        let first = page as u32 * rows;
        let last = first + pixels.len() as u32 / width;
        let window = Window { width: width * FINE, rows: first * FINE..last * FINE, shifts: SHIFTS };
        film.clear(&window);
        for painting in [false, true] {
            set.stands.iter().for_each(|stand| stand.expose(&set.camera, &film, &window, FINE as f32, painting));
        }
        let developer = Developer { set, ground: &ground, film: &film, window: &window };
        pixels.par_chunks_mut(width as usize).enumerate().for_each(|(row, pixels)| {
            for (x, pixel) in pixels.iter_mut().enumerate() {
                *pixel = developer.pixel(x as u32, first + row as u32);
            }
        });
    }
    canvas
}

fn footing<'a>(stand: &PlacedStand, light: &'a Light, (foot, size): (Vec3, f32)) -> Footing<'a> {
    Footing { light, offset: stand.offset, foot, size }
}

/// The middle of a stand and its size, which are those of the ground around it.
pub fn ground_of(stand: &PlacedStand) -> (Vec3, f32) {
    let [low, high] = stand.bounds();
    (stand.offset + stand.middle(), (high - low).length())
}

/// Turns samples into pixels.
struct Developer<'a> {
    set: &'a Set<'a>,
    ground: &'a Ground<'a>,
    film: &'a Film,
    window: &'a Window,
}

impl Developer<'_> {
    fn pixel(&self, x: u32, y: u32) -> [u8; 4] {
        let behind = self.ground.behind(x as f32 + 0.5, y as f32 + 0.5);
        let (mut sum, mut opacity) = (Vec3::ZERO, 0.0);
        for part in 0..FINE * FINE {
            let (column, row) = (x * FINE + part % FINE, y * FINE + part / FINE);
            let (roots, share) = self.sample(column, row, part as usize, &behind);
            sum += roots * share;
            opacity += share;
        }
        if opacity <= 0.0 {
            return [0; 4];
        }
        let [r, g, b] = tone::colour(sum / opacity);
        [r, g, b, (opacity / (FINE * FINE) as f32 * 255.0 + 0.5) as u8]
    }

    /// The roots of the light of a sample, and its opacity.
    fn sample(&self, column: u32, row: u32, part: usize, behind: &Behind) -> (Vec3, f32) {
        let seen = self.film.seen(self.window.index(column, row)).filter(|seen| seen.depth >= behind.depth);
        let Some(seen) = seen else { return (behind.roots, behind.opacity) };
        let camera = &self.set.camera;
        let subject = usize::from(seen.paint.subject);
        let x = self.window.place(column, row) / FINE as f32;
        let y = (row as f32 + 0.5) / FINE as f32;
        let point = camera.unproject(x, y, seen.depth);
        let back = camera.back(point);
        let own = point - self.set.stands[subject].offset;
        let light = shade(&seen, own, back, &self.set.lights[subject], part);
        (tone::shown(light).map(f32::sqrt), 1.0)
    }
}
