//! Volumes of shapes against closed forms: points drawn evenly in the bounds, counted where they are inside.
//!
//! With n points in a box of volume B, a shape of volume V has the standard error B √(p (1 − p) / n) with p = V / B;
//! the bound is four of these. Sources: Archimedes for balls, Pappus for what turns about an axis. Absent: fields.

use super::*;
use crate::rotation::Rotation;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::{FRAC_PI_3, PI};

const POINTS: u32 = 200_000;

/// The volume of a shape by points in its bounds, and four standard errors of a shape of the volume `expected`.
fn measured(shape: &Shape, expected: f64) -> (f64, f64) {
    let Bounds { low, high } = shape.bounds();
    let size = [0, 1, 2].map(|k| high[k] - low[k]);
    let whole = size[0] * size[1] * size[2];
    let mut random = ChaCha8Rng::seed_from_u64(1986);
    let mut inside = || {
        let point = [0, 1, 2].map(|k| low[k] + size[k] * random.random::<f64>());
        shape.inside(point)
    };
    let hits = (0..POINTS).filter(|_| inside()).count() as f64;
    let share = expected / whole;
    (whole * hits / f64::from(POINTS), 4.0 * whole * (share * (1.0 - share) / f64::from(POINTS)).sqrt())
}

fn check(name: &str, shape: &Shape, expected: f64) {
    let (volume, bound) = measured(shape, expected);
    assert!((volume - expected).abs() <= bound.max(1e-12), "{name}: {volume}, not {expected} ± {bound}");
}

fn ball(radius: f64) -> f64 {
    4.0 / 3.0 * PI * radius * radius * radius
}

fn sphere(x: f64, radius: f64) -> Shape {
    Shape::Sphere(Sphere { centre: [x, 0.2, 0.3], radius })
}

/// What two balls of the radii a and b, d apart, have in common (Weisstein, "Sphere-sphere intersection").
fn lens(a: f64, b: f64, d: f64) -> f64 {
    PI * (a + b - d) * (a + b - d) * (d * d + 2.0 * d * (a + b) - 3.0 * (a - b) * (a - b)) / (12.0 * d)
}

#[test]
fn solids_have_their_volumes() {
    let base = [0.5, -1.0, 2.0];
    check("sphere", &sphere(1.0, 0.8), ball(0.8));
    let ellipsoid = Ellipsoid { centre: base, radii: [0.5, 2.0, 1.0] };
    check("ellipsoid", &Shape::Ellipsoid(ellipsoid), ball(1.0));
    check("box", &Shape::Cuboid(Cuboid::on(base, [1.0, 2.0, 3.0])), 6.0);
    check("cylinder", &Shape::Cylinder(Cylinder { base, radius: 0.5, height: 2.0 }), 0.5 * PI);
    let cone = Cone { base, radius: 1.0, top_radius: 0.0, height: 3.0 };
    check("cone", &Shape::Cone(cone), PI);
    let part = Cone { top_radius: 0.5, ..cone };
    check("part of a cone", &Shape::Cone(part), PI * (1.0 + 0.5 + 0.25));
    let grows = Cone { radius: 0.5, top_radius: 1.0, ..cone };
    check("cone on its top", &Shape::Cone(grows), PI * (1.0 + 0.5 + 0.25));
    let capsule = Capsule { start: base, end: [0.5, 1.0, 3.0], radius: 0.4 };
    check("capsule", &Shape::Capsule(capsule), PI * 0.16 * 5.0_f64.sqrt() + ball(0.4));
    let torus = Torus { centre: base, ring: 2.0, tube: 0.5 };
    check("torus", &Shape::Torus(torus), 2.0 * PI * PI * 2.0 * 0.25);
}

/// A part of a cone with half a ball at either end; and two pieces that meet in a straight line in the point between.
#[test]
fn polylines_have_the_volume_of_their_pieces() {
    let piece = |a: f64, b: f64, long: f64| FRAC_PI_3 * long * (a * a + a * b + b * b);
    let one = Polyline::of(vec![([0.0; 3], 0.6), ([0.0, 2.0, 0.0], 0.3)]);
    check("one piece", &Shape::Polyline(one), piece(0.6, 0.3, 2.0) + 0.5 * ball(0.6) + 0.5 * ball(0.3));
    let point = Polyline::of(vec![([1.0; 3], 0.6)]);
    check("one point", &Shape::Polyline(point), ball(0.6));
    let two = Polyline::of(vec![([0.0; 3], 0.2), ([1.0, 0.0, 0.0], 0.4), ([3.0, 0.0, 0.0], 0.4)]);
    let ends = 0.5 * ball(0.2) + 0.5 * ball(0.4);
    // Half a ball of the middle point lies within the second piece; the other half stands out of the first.
    let (volume, bound) = measured(&Shape::Polyline(two), piece(0.2, 0.4, 1.0) + piece(0.4, 0.4, 2.0) + ends);
    let pieces = piece(0.2, 0.4, 1.0) + piece(0.4, 0.4, 2.0) + ends;
    assert!(volume > pieces - bound && volume < pieces + 0.5 * ball(0.4) + bound, "{volume} {pieces}");
}

/// Each half plane through the axis cuts a shell into discs; V = ∫ π c² r dθ = 2π² c² r (1 − λ³ⁿ) / (−3 ln λ).
#[test]
fn shells_have_the_volume_of_their_discs() {
    for (shrink, turns) in [(0.6_f64, 3.0), (0.5, 0.4), (0.45, 1.7)] {
        let shell = Shell { foot: [1.0, 2.0, 3.0], spiral: 1.0, height: 4.0, tube: 0.35, shrink, turns };
        let expected = 2.0 * PI * PI * 0.35 * 0.35 * (1.0 - crate::math::pow(shrink, 3.0 * turns))
            / (-3.0 * crate::math::log(shrink));
        check(&format!("shell of {turns} turns"), &Shape::Shell(shell), expected);
    }
}

#[test]
fn lone_parts_of_soft_objects_end_at_half_their_reach() {
    let soft = |part| Shape::Soft(Soft::of(vec![(part, 1.0)]));
    let (start, end) = ([0.0; 3], [2.0, 0.0, 1.0]);
    check("point", &soft(Skeleton::Line(start, start, 1.0)), ball(0.5));
    check("line", &soft(Skeleton::Line(start, end, 1.0)), PI * 0.25 * 5.0_f64.sqrt() + ball(0.5));
    let reach = Ellipsoid { centre: end, radii: [1.0, 2.0, 4.0] };
    check("ellipsoid", &soft(Skeleton::Ellipsoid(reach)), ball(1.0));
    let twice = Soft::of(vec![(Skeleton::Line(start, start, 1.0), 1.0), (Skeleton::Line(start, start, 1.0), 1.0)]);
    // 2 C(q) = ½ where C = ¼: the root of the polynomial by bisection.
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    for _ in 0..60 {
        let q = 0.5 * (low + high);
        if 1.0 - 22.0 / 9.0 * q + 17.0 / 9.0 * q * q - 4.0 / 9.0 * q * q * q > 0.25 { low = q } else { high = q }
    }
    check("two in one place", &Shape::Soft(twice), ball(low.sqrt()));
}

#[test]
fn what_is_combined_has_its_volume() {
    let (a, b) = (sphere(0.0, 1.0), sphere(1.2, 0.7));
    let common = lens(1.0, 0.7, 1.2);
    check("union", &Shape::Union(Union::of(vec![a.clone(), b.clone()])), ball(1.0) + ball(0.7) - common);
    check("intersection", &Shape::Intersection(Intersection::of(vec![a.clone(), b.clone()])), common);
    let rest = Difference::of(a.clone(), vec![b.clone()]);
    check("difference", &Shape::Difference(Box::new(rest)), ball(1.0) - common);
    let apart = vec![sphere(0.0, 0.5), sphere(2.0, 0.5)];
    check("a blend of what lies apart", &Shape::Blend(Blend::of(apart, 0.4)), 2.0 * ball(0.5));
    let near = vec![sphere(0.0, 0.5), sphere(1.1, 0.5)];
    let (volume, bound) = measured(&Shape::Blend(Blend::of(near, 0.4)), 2.0 * ball(0.5));
    assert!(volume > 2.0 * ball(0.5) + bound, "{volume}: what lies near runs together");
    let plane = HalfSpace { point: [0.0, 0.2, 0.3], normal: [1.0, 2.0, -1.0] };
    let half = Intersection::of(vec![a, Shape::HalfSpace(plane)]);
    check("half a ball", &Shape::Intersection(half), 0.5 * ball(1.0));
}

#[test]
fn what_is_placed_has_its_volume_times_its_scales() {
    let solid = Shape::Cone(Cone { base: [1.0, 0.0, 0.0], radius: 1.0, top_radius: 0.2, height: 2.0 });
    let volume = FRAC_PI_3 * 2.0 * (1.0 + 0.2 + 0.04);
    let turn = Rotation::about([1.0, 2.0, 3.0], 0.7);
    for (scale, factor) in [([1.0; 3], 1.0), ([2.0; 3], 8.0), ([0.5, 2.0, 3.0], 3.0)] {
        let placed = Placed::of(solid.clone(), scale, turn, [4.0, -5.0, 6.0]);
        check(&format!("{scale:?}"), &Shape::Placed(Box::new(placed)), factor * volume);
    }
}
