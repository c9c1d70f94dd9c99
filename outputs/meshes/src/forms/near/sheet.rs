//! A blade as a grid of triangles: rows along the midrib, columns from it to the margin.
//!
//! The grid follows the detail: at detail 1 six rows and two columns a half, at detail 3 enough rows for every tooth
//! and for the bulges between side veins. A blade whose lobes stand around the end of its stalk is a fan of rays.
//! Absent: where a blade stands, which its place tells, and its outline, which `phytomer_looks` has.

use super::build::{Build, Vector, cross, minus, sum};
use phytomer_looks::{Blade, Margin};
use phytomer_sim::math::sincosf;
use std::f32::consts::TAU;

/// Where a blade stands, and how large it is, in lengths of the organ.
#[derive(Debug, Clone, Copy)]
pub struct Place {
    /// The end of its stalk.
    pub base: Vector,
    /// Along it.
    pub along: Vector,
    /// To its left.
    pub left: Vector,
    /// To its upper side.
    pub up: Vector,
    /// Its length without a stalk.
    pub length: f32,
    /// Its width.
    pub width: f32,
    /// The share of its half width that waves and tears are moved by, another one for each leaflet.
    pub phase: f32,
}

/// A place on the spine of a blade, with its directions.
struct Spine {
    at: Vector,
    along: Vector,
    left: Vector,
    up: Vector,
}

impl Place {
    /// The spine at a share of its length: an arc that turns down, and a twist.
    fn spine(&self, blade: &Blade, u: f32) -> Spine {
        let (at, along, up) = arc(self, blade.arch_deg.to_radians(), u);
        let (sin, cos) = sincosf(blade.twist_deg.to_radians() * u);
        let left = sum(&[(cos, self.left), (sin, up)]);
        Spine { at, along, left, up: sum(&[(cos, up), (-sin, self.left)]) }
    }
}

/// A place on an arc from a base, its direction and its upper side.
pub fn arc(place: &Place, bend: f32, u: f32) -> (Vector, Vector, Vector) {
    let (sin, cos) = sincosf(bend * u);
    let (along, down) = if bend.abs() > 1e-4 { (sin / bend, (1.0 - cos) / bend) } else { (u, 0.0) };
    let at = sum(&[(1.0, place.base), (place.length * along, place.along), (-place.length * down, place.up)]);
    (at, sum(&[(cos, place.along), (-sin, place.up)]), sum(&[(sin, place.along), (cos, place.up)]))
}

/// Adds a blade.
pub fn blade(build: &mut Build, blade: &Blade, place: &Place, detail: u8) {
    if blade.margin == Margin::Palmate {
        fan(build, blade, place, detail);
    } else {
        for side in [-1.0, 1.0] {
            half(build, blade, place, (side, detail));
        }
    }
}

/// The shares of a blade at which it has rows.
fn rows(blade: &Blade, detail: u8) -> Vec<f32> {
    let plain: u16 = [4, 6, 14, 28][usize::from(detail.min(3))];
    let of_margin = match blade.margin {
        Margin::Toothed if detail > 1 => u16::from(blade.divisions) * (u16::from(detail) + 1),
        Margin::Lobed => u16::from(blade.divisions) * [3, 4, 6, 10][usize::from(detail.min(3))],
        _ => 0,
    };
    let of_veins = if detail > 2 { 4 * u16::from(blade.veins) } else { 0 };
    let count = if detail < 2 { plain.max(of_margin).min(20) } else { plain.max(of_margin).max(of_veins) };
    let at = |row: u16| {
        let even = f32::from(row) / f32::from(count);
        // Closer together at both ends, where outlines are round.
        if row == count { 1.0 } else { even - 0.8 * sincosf(TAU * even).0 / TAU }
    };
    (0..=count).map(at).collect()
}

/// The columns of a half.
fn columns(detail: u8) -> u16 {
    [1, 2, 3, 6][usize::from(detail.min(3))]
}

/// One half of a blade; `side` is 1 for its left.
fn half(build: &mut Build, blade: &Blade, place: &Place, (side, detail): (f32, u8)) {
    let columns = columns(detail);
    let mut before: Vec<u32> = Vec::new();
    for (u, hang, torn) in torn(blade, side, rows(blade, detail)) {
        let row = row(build, blade, place, (u, side, detail), (columns, hang));
        if torn {
            before.clear();
        }
        for (from, to) in before.windows(2).zip(row.windows(2)) {
            let quad = [from[0], to[0], to[1], from[1]];
            build.quad(if side < 0.0 { [from[1], to[1], to[0], from[0]] } else { quad });
        }
        before = row;
    }
}

/// Rows with how far the piece of the blade that they are in hangs lower, degrees, and whether a tear lies before the
/// row: there are two rows then at one place. A blade tears along its side veins, each half for itself.
fn torn(blade: &Blade, side: f32, rows: Vec<f32>) -> Vec<(f32, f32, bool)> {
    let veins = f32::from(blade.veins);
    // Neither the base nor the apex is torn off; which veins are torn is a low-discrepancy sequence.
    let chance = |vein: u8| (0.754_877_7 * f32::from(vein) + 0.3 * side + 0.5).rem_euclid(1.0);
    let at = |vein: &u8| (f32::from(*vein) + 0.5) / veins;
    let tears: Vec<u8> = (2..blade.veins.saturating_sub(2)).filter(|vein| chance(*vein) < 0.5 * blade.tears).collect();
    let hang = |piece: usize| if tears.is_empty() { 0.0 } else { 60.0 * blade.tears * (chance(piece as u8 * 7) - 0.3) };
    let mut all = Vec::new();
    let mut piece = 0;
    for u in rows {
        while piece < tears.len() && at(&tears[piece]) <= u {
            let tear = at(&tears[piece]);
            all.push((tear, hang(piece), false));
            piece += 1;
            all.push((tear, hang(piece), true));
        }
        all.push((u, hang(piece), false));
    }
    all
}

/// The corners of a row of a half, from the midrib to the margin.
fn row(
    build: &mut Build,
    blade: &Blade,
    place: &Place,
    (u, side, detail): (f32, f32, u8),
    (columns, hang): (u16, f32),
) -> Vec<u32> {
    let (spine, rim) = (place.spine(blade, u), blade.rim(u));
    let tooth = if detail > 1 { blade.tooth(u) } else { 0.0 };
    let step = rim.aside * place.width / f32::from(columns);
    let [mut aside, mut high] = [0.0, 0.0];
    let corner = |column: u16| {
        let v = f32::from(column) / f32::from(columns);
        if column > 0 {
            // The angle of the strip of this column, so that the row is as long as half the blade is wide.
            let middle = v - 0.5 / f32::from(columns);
            let cut = if column == columns { 1.0 - tooth * f32::from(columns) * 0.5 } else { 1.0 };
            let (sin, cos) = sincosf(
                (blade.fold_deg + (115.0 * blade.cup - blade.droop_deg) * middle - hang * (middle - 0.1).max(0.0))
                    .to_radians(),
            );
            aside += step * cut * cos;
            high += step * cut * sin;
        }
        let lift = high + place.width * 2.0 * rim.aside * relief(blade, (u, v), (side, place.phase, detail));
        let across = sum(&[(rim.along * v * place.length, spine.along), (side * aside, spine.left), (lift, spine.up)]);
        let at = sum(&[(1.0, spine.at), (1.0, across)]);
        build.corner(at, across, [0.5 + side * v * rim.aside, u])
    };
    (0..=columns).map(corner).collect()
}

/// How high waves of the margin and the bulges between side veins stand, as a share of the width.
fn relief(blade: &Blade, (u, v): (f32, f32), (side, phase, detail): (f32, f32, u8)) -> f32 {
    let wave = |waves: f32, turn: f32| sincosf(TAU * (waves * u + turn)).0;
    let margin = blade.wave * v * v * wave(3.5, 0.2 * side + phase);
    let bulges = if detail > 2 && blade.veins > 0 {
        let place = f32::from(blade.veins) * (u - 0.16 * v);
        let (_, cos) = sincosf(TAU * place);
        0.014 * (0.5 - 0.5 * cos) * v * (1.0 - v) * 4.0 * (8.0 / f32::from(blade.veins)).min(1.0)
    } else {
        0.0
    };
    margin + bulges
}

/// A blade whose lobes stand around the end of its stalk: rays from there, fitted to the width.
fn fan(build: &mut Build, blade: &Blade, place: &Place, detail: u8) {
    let lobes = u16::from(blade.divisions.max(1));
    let most: u16 = if lobes > 12 { [2, 2, 4, 6] } else { [4, 4, 8, 16] }[usize::from(detail.min(3))];
    let rays = lobes * most;
    let rings = [1_u16, 2, 4, 7][usize::from(detail.min(3))];
    let turn = |ray: u16| 2.0 * f32::from(ray) / f32::from(rays) - 1.0;
    let spread = 0.5 * blade.spread_deg.to_radians();
    let reach = |ray: u16| {
        let (sin, cos) = sincosf(spread * turn(ray));
        let reach = blade.reach(turn(ray).clamp(-0.999_99, 0.999_99));
        [reach * cos, reach * sin]
    };
    let widest = (0..=rays).map(|ray| reach(ray)[1].abs()).fold(1e-6, f32::max);
    let far = (0..=rays).map(|ray| reach(ray)[0]).fold(1e-6, f32::max);
    let across = 0.5 * place.width / (place.length * widest);
    let (rise, _) = sincosf(blade.fold_deg.to_radians());
    let pleat = if lobes > 12 { 0.5 * f32::from(lobes).recip() } else { 0.012 };
    let mut before: Vec<u32> = Vec::new();
    for ray in 0..=rays {
        let [x, y] = reach(ray);
        let [x, y] = [x / far, y * across];
        let within = f32::from(ray % most) / f32::from(most);
        // Ridges between lobes, valleys along their middles.
        let ridge = pleat * (2.0 * within - 1.0).abs();
        let mut corners = Vec::new();
        for ring in 0..=rings {
            let out = f32::from(ring) / f32::from(rings);
            let [along, aside] = [x * out, y * out];
            let bend = blade.arch_deg.to_radians();
            let way = (along * along + aside * aside).sqrt();
            let down = 0.5 * bend * way * way * (1.0 - bend * bend * way * way / 12.0);
            let lift = rise * aside.abs() + ridge * way - down + blade.wave * out * out * sincosf(TAU * within).0;
            let from = [along, aside, lift].map(|part| part * place.length);
            let offset = sum(&[(from[0], place.along), (from[1], place.left), (from[2], place.up)]);
            let at = sum(&[(1.0, place.base), (1.0, offset)]);
            corners.push(build.corner(at, offset, [0.5 + aside * place.length / place.width.max(1e-6), along]));
        }
        for (from, to) in before.windows(2).zip(corners.windows(2)) {
            build.quad([from[0], from[1], to[1], to[0]]);
        }
        before = corners;
    }
}

/// Adds a closed tube through some places with radii: a stalk, a rachis, a filament.
pub fn tube(build: &mut Build, line: &[(Vector, f32)], up: Vector, sides: u16) {
    let mut before: Option<Vec<u32>> = None;
    let last = line.len().saturating_sub(1);
    let ends = [0, last];
    for (k, (middle, radius)) in line.iter().enumerate() {
        let along = super::build::unit(minus(line[(k + 1).min(last)].0, line[k.saturating_sub(1)].0));
        let left = super::build::unit(cross(up, along));
        let above = cross(along, left);
        let share = k as f32 / last.max(1) as f32;
        let mut ring = Vec::new();
        for side in 0..=sides {
            let (sin, cos) = sincosf(TAU * f32::from(side % sides) / f32::from(sides));
            let across = sum(&[(radius * cos, left), (radius * sin, above)]);
            let at = sum(&[(1.0, *middle), (1.0, across)]);
            ring.push(build.corner(at, across, [f32::from(side) / f32::from(sides), share]));
        }
        if let Some(before) = &before {
            for (from, to) in before.windows(2).zip(ring.windows(2)) {
                build.quad([from[0], from[1], to[1], to[0]]);
            }
        }
        if ends.contains(&k) {
            // The cap has corners of its own, so that the tube is smooth up to its edge.
            let cap = build.corner(*middle, [0.0; 3], [0.5, share]);
            let edge: Vec<u32> = ring.iter().map(|corner| build.again(*corner)).collect();
            for pair in edge.windows(2) {
                build.face(if k == 0 { [cap, pair[1], pair[0]] } else { [cap, pair[0], pair[1]] });
            }
        }
        before = Some(ring);
    }
}
