//! A leaf: a stalk that goes on as the midrib, and a blade; or a rachis with leaflets.
//!
//! The midrib is a tube that narrows to the apex and stands out below. Leaflets stand in pairs, and the longest reach
//! half the width aside. Absent: the blade itself (`sheet`).

use super::super::{Depth, FormMesh};
use super::build::{Build, Vector, sum};
use super::sheet::{self, Place, arc};
use phytomer_looks::{Blade, Margin};
use phytomer_sim::math::sincosf;

/// Leaves with more pairs of leaflets than this have none at the end, and leaflets that are shorter to both ends.
const FEW_PAIRS: u8 = 12;

/// A leaf of a width over its length.
pub fn leaf(blade: &Blade, aspect: f32, detail: u8) -> FormMesh {
    let mut build = Build::default();
    if blade.leaflets > 0 {
        compound(&mut build, blade, aspect, detail);
        return build.into_form(aspect, Depth::Length, true);
    }
    let place = whole(blade, aspect);
    sheet::blade(&mut build, blade, &place, detail);
    if blade.stalk > 0.0 {
        midrib(&mut build, blade, &place, detail);
    }
    let straight = blade.arch_deg == 0.0 && blade.twist_deg == 0.0;
    build.into_form(aspect, if straight { Depth::Width } else { Depth::Length }, false)
}

/// The place of a blade on its stalk.
fn whole(blade: &Blade, aspect: f32) -> Place {
    Place {
        base: [blade.stalk, 0.0, 0.0],
        along: [1.0, 0.0, 0.0],
        left: [0.0, 1.0, 0.0],
        up: [0.0, 0.0, 1.0],
        length: 1.0 - blade.stalk,
        width: aspect,
        phase: 0.0,
    }
}

/// The sides of a stalk.
fn sides(detail: u8) -> u16 {
    [3, 3, 5, 8][usize::from(detail.min(3))]
}

/// The stalk, which goes on as the midrib, a little below the blade.
fn midrib(build: &mut Build, blade: &Blade, place: &Place, detail: u8) {
    let radius = (0.016 * place.width).clamp(0.003, 0.02).min(0.08 * place.width);
    let steps = [2_u16, 3, 6, 12][usize::from(detail.min(3))];
    let reach = if blade.margin == Margin::Palmate { 0.1 } else { 0.94 };
    let mut line: Vec<(Vector, f32)> = vec![([0.0; 3], 1.25 * radius), (place.base, radius)];
    line[1].0[2] -= 0.6 * radius;
    for step in 1..=steps {
        let u = reach * f32::from(step) / f32::from(steps);
        let (at, _, up) = arc(place, blade.arch_deg.to_radians(), u);
        let thin = radius * (1.0 - 0.85 * u / reach);
        line.push((sum(&[(1.0, at), (-0.6 * thin, up)]), thin));
    }
    build.stalk = true;
    sheet::tube(build, &line, place.up, sides(detail));
    build.stalk = false;
}

/// A rachis with its leaflets.
fn compound(build: &mut Build, blade: &Blade, aspect: f32, detail: u8) {
    let axis = Place { length: 1.0, base: [0.0; 3], ..whole(blade, aspect) };
    let bend = blade.arch_deg.to_radians();
    let many = blade.leaflets > FEW_PAIRS;
    let (sin, cos) = sincosf(blade.leaflet_deg.to_radians());
    let longest = 0.5 * aspect / sin.max(0.05);
    let last = if many { 0.97 } else { (1.0 - longest).max(blade.stalk + 0.3 * (1.0 - blade.stalk)) };
    let stem = if many { 1.0 } else { last };
    let steps = [3_u16, 4, 8, 14][usize::from(detail.min(3))];
    let radius = if many { 0.012 } else { (0.012 * aspect).clamp(0.003, 0.012) };
    let line = (0..=steps).map(|step| {
        let u = stem * f32::from(step) / f32::from(steps);
        (arc(&axis, bend, u).0, radius * (1.0 - 0.8 * u))
    });
    build.stalk = true;
    sheet::tube(build, &line.collect::<Vec<_>>(), axis.up, sides(detail));
    build.stalk = false;
    let leaflet = Blade { leaflets: 0, stalk: 0.0, arch_deg: if many { 30.0 } else { 0.5 * blade.arch_deg }, ..*blade };
    // Small leaflets have a coarser grid than whole leaves, and many of them one that is coarser still.
    let grid = if many { detail.saturating_sub(1) } else { detail };
    for pair in 0..blade.leaflets {
        let among = if blade.leaflets > 1 { f32::from(pair) / f32::from(blade.leaflets - 1) } else { 1.0 };
        let (at, along, up) = arc(&axis, bend, blade.stalk + (last - blade.stalk) * among);
        let share = if many {
            ((0.25 + 1.6 * among) * (1.0 - 0.93 * among) / 0.68).clamp(0.02, 1.0).sqrt()
        } else {
            sincosf(std::f32::consts::PI * (0.3 + 0.4 * among)).0
        };
        for side in [-1.0, 1.0] {
            let ahead = sum(&[(cos, along), (side * sin, axis.left)]);
            let place = Place {
                base: at,
                along: ahead,
                left: sum(&[(cos, axis.left), (-side * sin, along)]),
                up,
                length: longest * share,
                width: longest * share * blade.leaflet_width,
                phase: 0.37 * f32::from(pair) + 0.1 * side,
            };
            sheet::blade(build, &leaflet, &place, grid);
        }
    }
    if !many {
        let (at, along, up) = arc(&axis, bend, last);
        let length = 1.0 - last;
        let place = Place { base: at, along, up, length, width: length * blade.leaflet_width, ..axis };
        sheet::blade(build, &leaflet, &place, grid);
    }
}
