//! A catkin from near: a spindle of scales that overlap like tiles, each between two of the row below.
//!
//! The bracts of a willow's or a poplar's catkin stand in spirals around its axis and hide it; each rises towards its
//! tip and covers the base of those above. They are heights over one closed surface, whose triangles are thus as few as
//! the detail asks. Absent: the flowers within the bracts, and their hairs.

use super::super::{Depth, FormMesh};
use super::build::Build;
use phytomer_sim::math::sincosf;
use std::f32::consts::TAU;

// The numbers of scales and their shape are chosen by eye, so that an aspen's catkin of 7 cm looks as in nature.

/// The rows of scales, and the scales of a row.
const ROWS: u16 = 13;
const SCALES: u16 = 7;

/// How many rows a scale is long.
const LONG: f32 = 1.9;

/// The share of its radius by which the tip of a scale stands out, and the most in lengths of the catkin: on a broad
/// one scales are as flat as on a slim one.
const STANDS_OUT: f32 = 0.26;
const MOST_OUT: f32 = 0.018;

/// The radius at shares of the length, in halves of the width.
const OUTLINE: [[f32; 2]; 10] = [
    [0.0, 0.0],
    [0.02, 0.35],
    [0.08, 0.66],
    [0.2, 0.9],
    [0.45, 1.0],
    [0.7, 0.94],
    [0.86, 0.78],
    [0.95, 0.54],
    [0.985, 0.32],
    [1.0, 0.0],
];

/// A catkin of a width over its length.
pub fn catkin(aspect: f32, detail: u8) -> FormMesh {
    let detail = usize::from(detail.clamp(1, 3));
    let (around, along) = (SCALES * [2, 4, 6][detail - 1], ROWS * [1, 3, 5][detail - 1]);
    let stands_out = STANDS_OUT.min(MOST_OUT / (0.5 * aspect));
    let mut build = Build::default();
    let mut before: Vec<u32> = Vec::new();
    for row in 0..=along {
        let share = f32::from(row) / f32::from(along);
        let ring: Vec<u32> = (0..=around)
            .map(|side| {
                let turn = f32::from(side % around) / f32::from(around);
                let (sin, cos) = sincosf(TAU * turn);
                let radius = 0.5 * aspect * outline(share) * (1.0 - stands_out * (1.0 - height(share, turn)));
                let at = [share, radius * cos, radius * sin];
                build.corner(at, [0.0; 3], [f32::from(side) / f32::from(around), share])
            })
            .collect();
        for (from, to) in before.windows(2).zip(ring.windows(2)) {
            build.quad([from[0], from[1], to[1], to[0]]);
        }
        before = ring;
    }
    build.fit(0.5 * aspect);
    build.into_form(aspect, Depth::Width, false)
}

/// How far the scales stand out at a share of the length and of a turn, of the tip of a scale.
fn height(share: f32, turn: f32) -> f32 {
    let up = share * f32::from(ROWS);
    let top = (up as i32).min(i32::from(ROWS) - 1);
    // A scale begins in its row and ends nearly two rows above.
    (top - 1..=top)
        .map(|row| {
            let along = (up - row as f32) / LONG;
            let aside = turn * f32::from(SCALES) - if row % 2 == 0 { 0.0 } else { 0.5 };
            // From −1 to 1 across the scale, which is wider than its part of the turn, so that neighbours overlap.
            let across = (aside - (aside + 0.5).floor()) / 0.62;
            if (0.0..=1.0).contains(&along) { along * (1.0 - across * across) } else { 0.0 }
        })
        .fold(0.0, f32::max)
}

/// The radius at a share of the length.
fn outline(share: f32) -> f32 {
    let above = OUTLINE.iter().position(|[along, _]| *along >= share).unwrap_or(OUTLINE.len() - 1).max(1);
    let [[from, low], [to, high]] = [OUTLINE[above - 1], OUTLINE[above]];
    low + (high - low) * (share - from) / (to - from)
}
