//! Compound leaves drawn whole: a pinnate palm leaf with an arching rachis of four sides and leaflets in pairs along
//! it, narrow kites that hang a little; and a pinnate leaf of nine leaflets.
//!
//! De Reffye 1988 §5 (Fig. 16) grows a palm as a growth unit of its own, as species files can; here it is one organ.

use super::{Depth, FormMesh, Point};
use phytomer_sim::math::sincosf;

/// The angle through which the rachis bends from base to tip, radians.
const ARCH: f32 = 1.25;
const STEPS: u16 = 6;
const PAIRS: u16 = 18;
/// The share of the length that is a bare stalk.
const STALK: f32 = 0.18;
/// The corners of the rachis across it, on the axes of the box, so that its normals point outward after scaling.
const CORNERS: [[f32; 2]; 5] = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0], [1.0, 0.0]];
const RACHIS_RADIUS: f32 = 0.012;
/// How far a leaflet points ahead and how far it hangs, per length that it reaches out.
const AHEAD: f32 = 0.16;
const HANG: f32 = 0.05;

/// A rachis with its leaflets.
pub fn palm() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Length);
    rachis(&mut shape);
    for pair in 0..PAIRS {
        let place = STALK + (0.97 - STALK) * f32::from(pair) / f32::from(PAIRS - 1);
        leaflet(&mut shape, place, 1.0);
        leaflet(&mut shape, place, -1.0);
    }
    shape
}

/// The position and direction of the rachis at a share of its length, in the plane of x and z.
fn arch(share: f32) -> ([f32; 2], [f32; 2]) {
    let bend = ARCH * share;
    let (sin, cos) = sincosf(bend);
    ([sin / ARCH, (cos - 1.0) / ARCH], [cos, -sin])
}

fn rachis(shape: &mut FormMesh) {
    let first = shape.points.len() as u32;
    for step in 0..=STEPS {
        let share = f32::from(step) / f32::from(STEPS);
        let ([x, z], [along_x, along_z]) = arch(share);
        let radius = RACHIS_RADIUS * (1.0 - 0.9 * share);
        for (side, [cos, sin]) in CORNERS.into_iter().enumerate() {
            let normal = [-along_z * sin, cos, along_x * sin];
            let across = normal.map(|n| radius * n);
            let at = [x + across[0], across[1], z + across[2]];
            shape.points.push(Point {
                at,
                across,
                normal,
                texture: [side as f32 / 4.0, share],
                stalk: true,
                tint: [0; 4],
            });
        }
    }
    for step in 0..u32::from(STEPS) {
        for side in 0..4 {
            let (low, high) = (first + 5 * step + side, first + 5 * (step + 1) + side);
            shape.faces.extend([[low, low + 1, high + 1], [low, high + 1, high]]);
        }
    }
}

/// A leaflet at a share of the rachis, to the left (1) or the right (−1); leaflets are longest below the middle.
fn leaflet(shape: &mut FormMesh, place: f32, side: f32) {
    let ([x, z], [along_x, along_z]) = arch(place);
    let among = (place - STALK) / (1.0 - STALK);
    let reach = 0.5 * ((0.25 + 1.6 * among) * (1.0 - 0.93 * among) / 0.68).min(1.0).sqrt();
    let at = |out: f32, aside: f32| {
        let ahead = AHEAD * out / 0.5;
        let on = [x + along_x * ahead, side * out, z + along_z * ahead - HANG * out / 0.5];
        [on, [along_x * aside, 0.0, along_z * aside]]
    };
    let wide = 0.016;
    let kite = [at(0.0, 0.0), at(0.35 * reach, -wide), at(reach, 0.0), at(0.35 * reach, wide)];
    let [base, behind, tip, before] = kite;
    let counterclockwise = if side > 0.0 { [base, before, tip, behind] } else { kite };
    shape.part(&counterclockwise, false);
}

/// Four pairs of leaflets and one terminal leaflet, each a plane polygon, on a thin rachis: an ash leaf.
pub fn pinnate() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    let rachis = [[0.0, -0.02], [0.75, -0.01], [0.75, 0.01], [0.0, 0.02]];
    shape.part(&rachis.map(|[x, y]| [[x, 0.0, 0.0], [0.0, y, 0.0]]), true);
    let place = |foot: f32, [cos, sin]: [f32; 2], long: f32, rise: f32| {
        // Points along the leaflet and across it, which are turned by its angle to the rachis.
        let outline = [[0.04, 0.0], [0.3, -0.16], [0.6, -0.15], [1.0, 0.0], [0.6, 0.15], [0.3, 0.16]];
        outline.map(|[out, aside]: [f32; 2]| {
            let [out, aside] = [out * long, aside * long];
            let rise = rise * sin.signum();
            [[foot + out * cos, out * sin, rise * out * sin], [-aside * sin, aside * cos, rise * aside * cos]]
        })
    };
    for (foot, long) in [(0.22, 0.4), (0.38, 0.46), (0.54, 0.44), (0.68, 0.38)] {
        for side in [1.0, -1.0] {
            shape.part(&place(foot, [0.42, 0.907 * side], long, 0.15), false);
        }
    }
    shape.part(&place(0.72, [1.0, 0.0], 0.28, 0.0), false);
    shape
}
