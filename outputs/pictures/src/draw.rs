//! One picture: the samples of some rows at a time on a film, then their pixels.
//!
//! A pixel is the mean of [`FINE`]² samples (`develop`). Rows are drawn in pages, so that memory does not grow with the
//! picture; blocks of plants that a page does not show are skipped for it, and so are columns that no plant reaches.

use super::canvas::Canvas;
use super::develop::{Developer, FINE, Set, Spots};
use super::film::Film;
use super::ground::{Footing, Ground, Tones};
use super::placed::PlacedStand;
use super::raster::Window;
use super::shade::Light;
use glam::Vec3;
use rayon::prelude::*;
use std::ops::Range;

/// The number of samples of a page, at 12 bytes each.
const PAGE: u32 = 1 << 20;
/// The rows of samples of one pixel stand apart by a quarter of a sample.
const SHIFTS: [f32; FINE as usize] = [-0.375, 0.125, -0.125, 0.375];

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
        tones: Tones::default(),
        camera: &set.camera,
        footings: &footings,
        height: height as f32,
        drawn: set.ground,
        transparent: set.transparent,
    };
    let columns = columns(set, width);
    let rows = (PAGE / (columns.len() as u32).max(1) / FINE).clamp(1, height);
    let mut film = Film::default();
    for (page, pixels) in canvas.pixels.chunks_mut((rows * width) as usize).enumerate() {
        let first = page as u32 * rows;
        let last = first + pixels.len() as u32 / width;
        let window = Window { columns: columns.clone(), rows: first * FINE..last * FINE, shifts: SHIFTS };
        film.clear(&window);
        for painting in [false, true] {
            set.stands.iter().for_each(|stand| stand.expose(&set.camera, &film, &window, FINE as f32, painting));
        }
        let developer = Developer { set, ground: &ground, film: &film, window: &window };
        pixels.par_chunks_mut(width as usize).enumerate().for_each(|(row, pixels)| {
            let mut room = Spots::default();
            for (x, pixel) in pixels.iter_mut().enumerate() {
                *pixel = developer.pixel(x as u32, first + row as u32, &mut room);
            }
        });
    }
    canvas
}

/// The columns of samples of a picture of this width, pixels, that plants may reach: of whole pixels.
fn columns(set: &Set, width: u32) -> Range<u32> {
    let reached = set.stands.iter().filter_map(|stand| stand.columns(&set.camera));
    let all = reached.reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]);
    let Some([first, last]) = all else { return 0..0 };
    // Casts of numbers beyond their type stop at its ends.
    let (first, last) = ((first.floor() as u32).min(width), (last.ceil() as u32).min(width));
    first * FINE..last.max(first) * FINE
}

fn footing<'a>(stand: &PlacedStand, light: &'a Light, (foot, size): (Vec3, f32)) -> Footing<'a> {
    Footing { light, offset: stand.offset, foot, size }
}

/// The middle of a stand and its size, which are those of the ground around it.
pub fn ground_of(stand: &PlacedStand) -> (Vec3, f32) {
    let [low, high] = stand.bounds();
    (stand.offset + stand.middle(), (high - low).length())
}
