//! Solids of a profile that turns about an axis: balls, ellipsoids, cylinders, cones, capsules and rings.
//!
//! A profile runs from below to above on the right of its axis, as distances from the axis and heights; a point on the
//! axis is one point, any other a ring of [`SIDES`] points. Absent: profiles that cross the axis.

use super::Solid;
use phytomer_sim::math::sincos;
use phytomer_sim::shape::{Capsule, Cone, Cylinder, Ellipsoid, Point, Sphere, Torus};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The sides of a circle.
pub(super) const SIDES: u32 = 48;
/// The parts of half a circle from pole to pole.
const PARTS: u32 = 24;
/// The sides of the tube of a ring.
const TUBE: u32 = 24;

pub(super) fn sphere(of: &Sphere) -> Solid {
    ellipsoid(&Ellipsoid { centre: of.centre, radii: [of.radius; 3] })
}

pub(super) fn ellipsoid(of: &Ellipsoid) -> Solid {
    let profile: Vec<[f64; 2]> = (0..=PARTS).map(|part| on_circle(part, PARTS)).collect();
    open(&profile).moved(|point| [0, 1, 2].map(|k| of.centre[k] + of.radii[k] * point[k]))
}

pub(super) fn cylinder(of: &Cylinder) -> Solid {
    let Cylinder { base, radius, height } = *of;
    cone(&Cone { base, radius, top_radius: radius, height })
}

pub(super) fn cone(of: &Cone) -> Solid {
    let profile = [[0.0, 0.0], [of.radius, 0.0], [of.top_radius, of.height], [0.0, of.height]];
    open(&profile).moved(|point| [0, 1, 2].map(|k| of.base[k] + point[k]))
}

/// Upright between two half balls, then turned to its axis.
pub(super) fn capsule(of: &Capsule) -> Solid {
    let way = [0, 1, 2].map(|k| of.end[k] - of.start[k]);
    let long = length(way);
    let half = PARTS / 2;
    let ball = |part: u32| on_circle(part, PARTS).map(|x| of.radius * x);
    let below = (0..=half).map(ball);
    let above = (half..=PARTS).map(ball).map(|[across, z]| [across, z + long]);
    let profile: Vec<[f64; 2]> = below.chain(above).collect();
    let [x, y, z] = axes(way, long);
    let placed = |[a, b, c]: Point| [0, 1, 2].map(|k| of.start[k] + a * x[k] + b * y[k] + c * z[k]);
    open(&profile).moved(placed)
}

pub(super) fn torus(of: &Torus) -> Solid {
    let mut solid = Solid::default();
    let ring = |part: u32| {
        let (sin, cos) = sincos(TAU * f64::from(part) / f64::from(TUBE));
        [of.ring + of.tube * cos, of.tube * sin]
    };
    let rings: Vec<Ring> = (0..TUBE).map(|part| solid.ring_of(ring(part), SIDES)).collect();
    for part in 0..TUBE as usize {
        solid.join(rings[part], rings[(part + 1) % TUBE as usize]);
    }
    solid.moved(|point| [0, 1, 2].map(|k| of.centre[k] + point[k]))
}

/// A point of half a circle of radius 1 about the origin, from the lower pole to the upper.
fn on_circle(part: u32, parts: u32) -> [f64; 2] {
    if part == 0 || part == parts {
        return [0.0, if part == 0 { -1.0 } else { 1.0 }];
    }
    let (sin, cos) = sincos(PI * f64::from(part) / f64::from(parts) - FRAC_PI_2);
    [cos, sin]
}

/// Where the points of a ring begin; a ring on the axis is a single point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ring {
    first: u32,
    sides: u32,
}

impl Ring {
    /// A ring of so many points from one on.
    pub fn of(first: u32, sides: u32) -> Self {
        Self { first, sides }
    }

    fn point(self, side: u32) -> u32 {
        if self.sides == 1 { self.first } else { self.first + side % self.sides }
    }
}

impl Solid {
    /// Adds the points of a profile's point.
    fn ring(&mut self, [across, height]: [f64; 2]) -> Ring {
        self.ring_of([across, height], if across > 0.0 { SIDES } else { 1 })
    }

    fn ring_of(&mut self, [across, height]: [f64; 2], sides: u32) -> Ring {
        let ring = Ring::of(self.points.len() as u32, sides);
        for side in 0..sides {
            let (sin, cos) = sincos(TAU * f64::from(side) / f64::from(SIDES));
            self.points.push([across * cos, across * sin, height]);
        }
        ring
    }

    /// Adds the band between a ring and that above it.
    pub(super) fn join(&mut self, low: Ring, high: Ring) {
        for side in 0..low.sides.max(high.sides) {
            let [a, b] = [side, side + 1].map(|side| low.point(side));
            let [c, d] = [side + 1, side].map(|side| high.point(side));
            self.quadrangle([a, b, c, d]);
        }
    }
}

/// What a profile that begins and ends on the axis encloses.
fn open(profile: &[[f64; 2]]) -> Solid {
    let mut solid = Solid::default();
    let rings: Vec<Ring> = profile.iter().map(|point| solid.ring(*point)).collect();
    rings.windows(2).for_each(|pair| solid.join(pair[0], pair[1]));
    solid
}

fn length(of: Point) -> f64 {
    (of[0] * of[0] + of[1] * of[1] + of[2] * of[2]).sqrt()
}

/// Three directions at right angles, the last along a vector of a length; upright where it has none.
fn axes(way: Point, long: f64) -> [Point; 3] {
    if long <= 0.0 {
        return [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    }
    let z = way.map(|x| x / long);
    // The coordinate axis that is farthest from the way.
    let least = (0..3).fold(0, |least, k| if z[k].abs() < z[least].abs() { k } else { least });
    let across: Point = [0, 1, 2].map(|k| f64::from(u8::from(k == least)) - z[least] * z[k]);
    let size = length(across);
    let x = across.map(|along| along / size);
    [x, [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]], z]
}
