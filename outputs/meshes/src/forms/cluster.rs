//! Clusters that are many organs in nature and drawn as a single form: needles of a shoot, and inflorescences of many
//! flowers.
//!
//! Conifers have hundreds of thousands of needles and a panicle a thousand flowers; each as an organ would cost a
//! component (de Reffye 1988 §6 likewise draws small fruits as a few vectors). Needles are triangles, flowers plane
//! polygons. Absent: inflorescences with axes of their own (§5), which species files grow.

use super::{Depth, FormMesh, along};
use phytomer_sim::math::sincosf;
use std::f32::consts::TAU;

/// A rosette of needles on a short shoot, as of a cedar or a larch. Its width is measured across the outer tips.
pub fn tuft() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    // Each ring: the number of needles, how far along and out their tips are, and the turn of the ring.
    for (needles, tip, turn) in [(8_u8, [0.42, 0.5], 0.0), (6, [0.8, 0.36], 0.5), (3, [1.0, 0.12], 0.25)] {
        for number in 0..needles {
            let (sin, cos) = sincosf(TAU * (f32::from(number) + turn) / f32::from(needles));
            let at = |[x, r]: [f32; 2], aside: f32| [[x, r * cos, r * sin], [0.0, -aside * sin, aside * cos]];
            let half = 0.045;
            shape.part(&[at([0.0, 0.0], -half), at(tip, 0.0), at([0.0, 0.0], half)], false);
        }
    }
    shape
}

/// A piece of shoot with a row of needles on either side, as of a fir or a yew. Its length includes the last needles,
/// its width is measured across two needles.
pub fn spray() -> FormMesh {
    const PAIRS: u8 = 6;
    let mut shape = FormMesh::new(Depth::Width);
    for pair in 0..PAIRS {
        let from = 0.82 * f32::from(pair) / f32::from(PAIRS);
        let (tip, lift) = (from + 0.3, if pair % 2 == 0 { 0.05 } else { 0.16 });
        let base = |along: f32| [[from + 0.045, 0.0, 0.0], [along, 0.0, 0.0]];
        let tip = |side: f32| [[tip, side, lift], [0.0; 3]];
        shape.part(&[base(-0.045), tip(-0.5), base(0.045)], false);
        shape.part(&[base(0.045), tip(0.5), base(-0.045)], false);
    }
    shape
}

/// A pyramid of side branches full of small flowers: a mango's panicle.
pub fn panicle() -> FormMesh {
    const WHORLS: u8 = 6;
    const BRANCHES: u8 = 5;
    let mut shape = FormMesh::new(Depth::Width);
    stem(&mut shape, [0.0, 0.0, 0.0], [0.94, 0.0, 0.0], 0.025);
    for whorl in 0..WHORLS {
        let share = f32::from(whorl) / f32::from(WHORLS);
        let (x, reach) = (0.2 + 0.72 * share, 0.4 * (1.0 - 0.75 * share));
        for number in 0..BRANCHES {
            let (sin, cos) = sincosf(TAU * (f32::from(number) + 0.5 * f32::from(whorl % 2)) / f32::from(BRANCHES));
            let at = |along: f32, out: f32| [x + along, reach * out * cos, reach * out * sin];
            stem(&mut shape, at(0.0, 0.0), at(0.07, 0.9), 0.012);
            for out in [0.45, 0.7, 0.94] {
                flower(&mut shape, at(0.055 * out + 0.02, out), [sin, cos], 0.08 * (1.35 - 0.5 * out));
            }
        }
    }
    shape
}

/// Seven flowers of five petals on a dome of stalks: a frangipani's cyme.
pub fn cyme() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    blossom(&mut shape, [0.0, 0.0]);
    for number in 0..6_u8 {
        let (sin, cos) = sincosf(TAU * f32::from(number) / 6.0);
        blossom(&mut shape, [0.3 * cos, 0.3 * sin]);
    }
    shape
}

/// A five-petalled flower on its stalk, `out` from the axis.
fn blossom(shape: &mut FormMesh, [y, z]: [f32; 2]) {
    let height = 0.76 - 1.2 * (y * y + z * z);
    stem(shape, [0.0, 0.0, 0.0], [height, y, z], 0.02);
    for petal in 0..5_u8 {
        // Each corner is turned from the middle of the petal. All four corners rise by the same slope, so the petal is
        // plane.
        let at = |turn: f32, out: f32| {
            let (sin, cos) = sincosf(TAU * (f32::from(petal) + turn) / 5.0);
            let (_, within) = sincosf(TAU * turn / 5.0);
            [height + 1.1 * out * within, y + out * cos, z + out * sin]
        };
        shape.polygon(&[[height, y, z], at(-0.55, 0.13), at(0.0, 0.2), at(0.55, 0.13)], along, false);
    }
}

/// A small flat flower that faces away from the axis, in the direction around it with this sine and cosine.
fn flower(shape: &mut FormMesh, [x, y, z]: [f32; 3], [sin, cos]: [f32; 2], half: f32) {
    let (aside, across) = (half * sin, half * cos);
    let corners = [[x - half, y, z], [x, y - aside, z + across], [x + half, y, z], [x, y + aside, z - across]];
    shape.polygon(&corners, along, false);
}

/// A stalk as two narrow triangles across one another.
fn stem(shape: &mut FormMesh, from: [f32; 3], to: [f32; 3], half: f32) {
    let [x, y, z] = from;
    shape.polygon(&[[x, y - half, z], to, [x, y + half, z]], along, true);
    shape.polygon(&[[x, y, z - half], to, [x, y, z + half]], along, true);
}
