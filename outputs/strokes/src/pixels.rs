//! A sheet as pixels: each polygon is filled over a grid of samples, four by four a pixel, and a pixel is their mean.
//!
//! Polygons are filled row by row between the crossings of their sides, by the even-odd rule. A page of rows is drawn
//! at a time, so that memory does not grow with the sheet.

use super::flat::Flat;
use super::{Port, Sheet};
use phytomer_pictures::Canvas;

/// The samples of a pixel along each side.
const FINE: usize = 4;
/// The rows of pixels of a page.
const PAGE: usize = 64;

/// The pixels of a sheet.
pub fn drawn(sheet: &Sheet, ports: &[(Port, Vec<Flat>)]) -> Canvas {
    let [width, height] = sheet.size;
    let mut canvas = Canvas::new(width, height);
    let wide = width as usize * FINE;
    let mut samples = vec![[0_u8; 3]; wide * PAGE * FINE];
    for (page, pixels) in canvas.pixels.chunks_mut(width.max(1) as usize * PAGE).enumerate() {
        samples.fill(sheet.background);
        let rows = page * PAGE * FINE..(page * PAGE + pixels.len() / width.max(1) as usize) * FINE;
        for (port, shapes) in ports {
            let clip = port.pixels(sheet.size).map(|side| side * FINE as f64);
            shapes.iter().for_each(|shape| fill(shape, clip, rows.clone(), wide, &mut samples));
        }
        for (k, pixel) in pixels.iter_mut().enumerate() {
            let (x, y) = (k % width as usize, k / width as usize);
            *pixel = mean(&samples, x, y, wide);
        }
    }
    canvas
}

fn mean(samples: &[[u8; 3]], x: usize, y: usize, wide: usize) -> [u8; 4] {
    let mut sum = [0_u32; 3];
    for row in 0..FINE {
        for sample in &samples[(y * FINE + row) * wide + x * FINE..][..FINE] {
            (0..3).for_each(|k| sum[k] += u32::from(sample[k]));
        }
    }
    let of = (FINE * FINE) as u32;
    let [r, g, b] = sum.map(|sum| ((sum + of / 2) / of) as u8);
    [r, g, b, 255]
}

/// Fills a polygon on some rows of samples, within left, top, right and bottom of a port.
fn fill(shape: &Flat, clip: [f64; 4], rows: std::ops::Range<usize>, wide: usize, samples: &mut [[u8; 3]]) {
    let corners: Vec<[f64; 2]> = shape.corners.iter().map(|corner| corner.map(|x| x * FINE as f64)).collect();
    if corners.iter().flatten().any(|x| !x.is_finite()) {
        return;
    }
    let [left, top, right, bottom] = clip;
    let ends = corners.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], [_, y]| [a.min(*y), b.max(*y)]);
    // Casts of numbers beyond their type stop at its ends.
    let first = ((ends[0].max(top) - 0.5).ceil().max(0.0) as usize).max(rows.start);
    let last = ((ends[1].min(bottom) + 0.5).floor().max(0.0) as usize).min(rows.end);
    let mut crossings = Vec::new();
    for row in first..last {
        let y = row as f64 + 0.5;
        crossings.clear();
        for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            if (a[1] <= y) != (b[1] <= y) {
                crossings.push(a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]));
            }
        }
        crossings.sort_by(f64::total_cmp);
        for pair in crossings.chunks_exact(2) {
            let from = (pair[0].max(left) - 0.5).ceil().max(0.0) as usize;
            let to = ((pair[1].min(right) - 0.5).ceil().max(0.0) as usize).min(wide);
            let line = &mut samples[(row - rows.start) * wide..][..wide];
            line.get_mut(from..to).into_iter().flatten().for_each(|sample| lay(sample, shape));
        }
    }
}

fn lay(sample: &mut [u8; 3], shape: &Flat) {
    if shape.opacity >= 1.0 {
        *sample = shape.colour;
    } else {
        let mix = |under: u8, over: u8| f64::from(under) + (f64::from(over) - f64::from(under)) * shape.opacity;
        *sample = [0, 1, 2].map(|k| (mix(sample[k], shape.colour[k]) + 0.5) as u8);
    }
}
