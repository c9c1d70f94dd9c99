//! The visible surface at each sample of some rows of a picture: its depth, colour, material and normal.
//!
//! Triangles come in any order, on any thread, in two passes. In the first pass each sample keeps the nearest depth; in
//! the second, the paint of the triangle with that depth. Of two triangles at one depth the paint with the larger bits
//! stays. A maximum does not depend on the order of its values, so the picture does not either. (This is a depth pass
//! with atomic maxima; no lock, no sorting, no merging of tiles.)

use super::raster::{Plane, Sample, Window, cover};
use glam::Vec3;
use rayon::prelude::*;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering::Relaxed};

/// The colour and material of a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Paint {
    /// Red, green and blue, as a screen shows them.
    pub colour: [u8; 3],
    /// Whether light passes through, as through leaves and petals.
    pub thin: bool,
    /// Whether the colour stands for a value; light then changes it little.
    pub stained: bool,
    /// The index in the picture of the stand that it belongs to.
    pub subject: u8,
}

/// The visible surface at a sample.
#[derive(Debug, Clone, Copy, Default)]
pub struct Seen {
    /// Its depth.
    pub depth: f32,
    /// Its colour and material.
    pub paint: Paint,
    /// Its normal, nearly a unit vector.
    pub normal: Vec3,
}

/// The samples of some rows of a picture.
#[derive(Debug, Default)]
pub struct Film {
    depths: Vec<AtomicU32>,
    paints: Vec<AtomicU64>,
}

const THIN: u64 = 1 << 63;
const STAINED: u64 = 1 << 62;

impl Film {
    /// Empties the film and makes room for the samples of a window.
    pub fn clear(&mut self, window: &Window) {
        let samples = window.len();
        self.depths.par_iter().take(samples).for_each(|depth| depth.store(0, Relaxed));
        self.paints.par_iter().take(samples).for_each(|paint| paint.store(0, Relaxed));
        self.depths.resize_with(samples, AtomicU32::default);
        self.paints.resize_with(samples, AtomicU64::default);
    }

    /// The first pass: keeps the nearest depth at each sample of a triangle.
    #[inline]
    pub fn deepen(&self, corners: &[Vec3; 3], window: &Window) {
        cover(corners, window, |sample| keep_nearest(&self.depths[sample.index], sample.depth));
    }

    /// The second pass: stores the paint where the triangle is the nearest; `of` tells the normals of its corners and
    /// its paint, and is asked if any of it is seen.
    #[inline]
    pub fn paint(&self, corners: &[Vec3; 3], window: &Window, of: impl Fn() -> ([Vec3; 3], Paint)) {
        let mut found = None;
        cover(corners, window, |Sample { index, x, y, depth }| {
            if self.depths[index].load(Relaxed) != depth.to_bits() {
                return;
            }
            let (planes, paint) = found.get_or_insert_with(|| {
                let (normals, paint) = of();
                ([0, 1, 2].map(|k| Plane::through(corners, normals.map(|normal| normal[k]))), paint)
            });
            let normal = Vec3::from_array([0, 1, 2].map(|k| planes[k].at(x, y)));
            self.paints[index].fetch_max(packed(paint, normal), Relaxed);
        });
    }

    /// Whether a sample shows anything but the background.
    #[inline]
    pub fn covers(&self, index: usize) -> bool {
        self.depths[index].load(Relaxed) > 0
    }

    /// The visible surface at a sample; `None` for the background.
    #[inline]
    pub fn seen(&self, index: usize) -> Option<Seen> {
        let depth = f32::from_bits(self.depths[index].load(Relaxed));
        (depth > 0.0).then(|| unpacked(self.paints[index].load(Relaxed), depth))
    }
}

/// Keeps the larger of two depths, as bits: those of positive floats sort as the floats do.
#[inline]
pub fn keep_nearest(kept: &AtomicU32, depth: f32) {
    let bits = depth.to_bits();
    // Most triangles lie behind others: a plain load avoids most of the slower exchanges.
    if depth > 0.0 && kept.load(Relaxed) < bits {
        kept.fetch_max(bits, Relaxed);
    }
}

/// Packs 1 bit each for thin and stained, 6 for the subject, 24 for the colour, and 3 times 10 for the normal.
#[inline]
fn packed(paint: &Paint, normal: Vec3) -> u64 {
    let ten = |x: f32| (x * 511.0 + 512.5).clamp(0.0, 1023.0) as u64;
    let [r, g, b] = paint.colour.map(u64::from);
    let bit = |is: bool, bit: u64| if is { bit } else { 0 };
    let stuff = bit(paint.thin, THIN) | bit(paint.stained, STAINED) | u64::from(paint.subject & 63) << 56;
    stuff | r << 48 | g << 40 | b << 32 | ten(normal.x) << 20 | ten(normal.y) << 10 | ten(normal.z)
}

#[inline]
fn unpacked(bits: u64, depth: f32) -> Seen {
    let byte = |shift: u32| (bits >> shift & 255) as u8;
    let ten = |shift: u32| ((bits >> shift & 1023) as f32 - 512.0) / 511.0;
    let paint = Paint {
        colour: [byte(48), byte(40), byte(32)],
        thin: bits & THIN != 0,
        stained: bits & STAINED != 0,
        subject: byte(56) & 63,
    };
    Seen { depth, paint, normal: Vec3::new(ten(20), ten(10), ten(0)) }
}
