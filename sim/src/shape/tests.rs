//! What holds for every shape: its field tells what is inside, its bounds hold it, its distance is one, and what is
//! placed is what it was elsewhere.
//!
//! Absent: volumes (`tests_volumes`) and meshes against what they were made of (`tests_mesh`).

use super::*;
use crate::rotation::Rotation;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Shapes of every form, each within 4 m of the origin.
pub(super) fn every() -> Vec<(&'static str, Shape)> {
    let sphere = Shape::Sphere(Sphere { centre: [0.5, 0.2, 0.3], radius: 1.1 });
    let ellipsoid = Ellipsoid { centre: [0.1, 0.2, 0.3], radii: [0.7, 1.5, 1.0] };
    let cuboid = Shape::Cuboid(Cuboid::on([0.3, -0.4, -1.0], [1.0, 2.0, 2.5]));
    let cone = Shape::Cone(Cone { base: [0.0, 0.5, -1.0], radius: 1.4, top_radius: 0.3, height: 2.0 });
    let line = vec![([-1.0, 0.0, 0.0], 0.3), ([0.5, 0.5, 0.5], 0.7), ([1.5, -1.0, 0.5], 0.2)];
    let shell = Shell { foot: [0.0, 0.0, -1.0], spiral: 1.2, height: 2.5, tube: 0.5, shrink: 0.6, turns: 2.3 };
    let soft = Soft::of(vec![
        (Skeleton::Line([0.0; 3], [1.0, 0.5, 0.0], 1.5), 1.0),
        (Skeleton::Ellipsoid(ellipsoid), 1.0),
        (Skeleton::Line([0.5; 3], [0.5; 3], 1.0), -0.5),
    ]);
    let turn = Rotation::about([1.0, -1.0, 0.5], 1.1);
    vec![
        ("sphere", sphere.clone()),
        ("ellipsoid", Shape::Ellipsoid(ellipsoid)),
        ("box", cuboid.clone()),
        ("cylinder", Shape::Cylinder(Cylinder { base: [0.2, 0.1, -0.7], radius: 0.8, height: 1.6 })),
        ("cone", cone.clone()),
        ("capsule", Shape::Capsule(Capsule { start: [-1.0, 0.0, 0.5], end: [1.0, 1.0, 0.0], radius: 0.6 })),
        ("torus", Shape::Torus(Torus { centre: [0.1; 3], ring: 1.4, tube: 0.5 })),
        ("half space", Shape::HalfSpace(HalfSpace { point: [0.2; 3], normal: [1.0, -2.0, 0.5] })),
        ("polyline", Shape::Polyline(Polyline::of(line))),
        ("shell", Shape::Shell(shell)),
        ("mesh", Shape::Mesh(Arc::new(tests_mesh::cube()))),
        ("soft", Shape::Soft(soft)),
        ("union", Shape::Union(Union::of(vec![sphere.clone(), cone.clone()]))),
        ("intersection", Shape::Intersection(Intersection::of(vec![sphere.clone(), cuboid.clone()]))),
        ("difference", Shape::Difference(Box::new(Difference::of(cuboid.clone(), vec![sphere.clone()])))),
        ("blend", Shape::Blend(Blend::of(vec![sphere, cuboid], 0.3))),
        ("placed", Shape::Placed(Box::new(Placed::of(cone, [0.5, 1.0, 1.5], turn, [0.3, 0.2, 0.1])))),
    ]
}

pub(super) fn points(number: usize, seed: u64) -> impl Iterator<Item = Point> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    (0..number).map(move |_| [0, 1, 2].map(|_| 8.0 * random.random::<f64>() - 4.0))
}

#[test]
fn the_field_is_at_least_a_half_inside_and_bounds_hold_the_shape() {
    for (name, shape) in every() {
        let (mut inside, mut outside) = (0, 0);
        for point in points(20_000, 7) {
            let field = shape.field(point);
            if shape.inside(point) {
                inside += 1;
                assert!(field >= SURFACE - 1e-9, "{name} at {point:?}: {field}");
                assert!(shape.bounds().holds(point), "{name} at {point:?}");
            } else {
                outside += 1;
                assert!(field <= SURFACE + 1e-9, "{name} at {point:?}: {field}");
            }
        }
        assert!(inside > 20 && outside > 1000, "{name}: {inside} inside, {outside} outside");
    }
}

/// An exact distance: the surface is met after it in the direction in which it falls fastest, and nowhere nearer.
#[test]
fn distances_lead_to_the_surface() {
    let exact = ["sphere", "box", "cylinder", "cone", "capsule", "torus", "half space", "mesh"];
    for (name, shape) in every().into_iter().filter(|(name, _)| exact.contains(name)) {
        let mut checked = 0;
        for point in points(3000, 3) {
            let distance = SURFACE - shape.field(point);
            let step = 1e-5;
            let slope = [0, 1, 2].map(|k| {
                let at = |by: f64| [0, 1, 2].map(|i| point[i] + if i == k { by } else { 0.0 });
                (shape.field(at(-step)) - shape.field(at(step))) / (2.0 * step)
            });
            // At an edge of the middle of the shape two directions are equally near.
            if (length(slope) - 1.0).abs() > 1e-6 {
                continue;
            }
            checked += 1;
            let met = [0, 1, 2].map(|k| point[k] - slope[k] * distance);
            assert!((shape.field(met) - SURFACE).abs() < 1e-4, "{name} at {point:?}: {distance}");
            assert!(shape.inside(point) == (distance <= 0.0), "{name} at {point:?}");
        }
        assert!(checked > 2500, "{name}: {checked}");
    }
}

#[test]
fn the_falloff_is_wyvills() {
    assert_eq!([falloff(0.0), falloff(1.0), falloff(9.0)], [1.0, 0.0, 0.0]);
    assert!((falloff(0.25) - 0.5).abs() < 1e-15, "½ at half the reach");
    let formula = |q: f64| 1.0 - 22.0 / 9.0 * q + 17.0 / 9.0 * q * q - 4.0 / 9.0 * q * q * q;
    for step in 0..=100 {
        let q = f64::from(step) / 100.0;
        assert!((falloff(q) - formula(q)).abs() < 1e-14, "{q}");
    }
}

/// A turned, scaled and moved shape is the shape where its points went.
#[test]
fn what_is_placed_is_what_it_was() {
    let turn = Rotation::about([0.3, 0.2, 1.0], 2.1);
    let (scale, to) = ([2.0; 3], [1.0, 2.0, -1.0]);
    for (name, shape) in every() {
        let placed = Shape::Placed(Box::new(Placed::of(shape.clone(), scale, turn, to)));
        for point in points(500, 5) {
            let turned = turn.turned(point.map(|x| 2.0 * x));
            let at = [0, 1, 2].map(|k| turned[k] + to[k]);
            let (before, after) = (shape.field(point), placed.field(at));
            let summed = ["soft", "blend"].contains(&name);
            let expected = if summed { before } else { SURFACE + 2.0 * (before - SURFACE) };
            assert!((after - expected).abs() < 1e-9, "{name} at {point:?}: {after}, not {expected}");
            let near = (before - SURFACE).abs() < 1e-9;
            assert!(near || shape.inside(point) == placed.inside(at), "{name} at {point:?}");
        }
    }
}

/// What has no size, no members or no number holds nothing, and nothing panics.
#[test]
fn what_is_nothing_holds_nothing() {
    let nothing = [
        Shape::Union(Union::of(Vec::new())),
        Shape::Blend(Blend::of(Vec::new(), 1.0)),
        Shape::Soft(Soft::of(Vec::new())),
        Shape::Polyline(Polyline::of(Vec::new())),
        Shape::Sphere(Sphere { centre: [f64::NAN; 3], radius: 1.0 }),
        Shape::Shell(Shell {
            foot: [0.0; 3],
            spiral: 1.0,
            height: 1.0,
            tube: 0.1,
            shrink: f64::NAN,
            turns: f64::INFINITY,
        }),
    ];
    let odd = [[f64::NAN; 3], [f64::INFINITY; 3], [f64::MAX, 0.0, f64::MIN]];
    for shape in &nothing {
        for point in points(100, 1).chain(odd) {
            assert!(!shape.inside(point), "{shape:?} at {point:?}");
            let _ = (shape.field(point), shape.bounds());
        }
    }
    for (_, shape) in every() {
        for point in odd {
            let _ = (shape.inside(point), shape.field(point));
        }
        let placed = Placed::of(shape, [f64::NAN, 0.0, 1.0], Rotation::NONE, [0.0; 3]);
        let _ = Shape::Placed(Box::new(placed)).bounds();
    }
    assert!(Shape::Intersection(Intersection::of(Vec::new())).inside([1.0; 3]), "nothing is asked");
}

/// Fifty primitives answer as they do one by one.
#[test]
fn a_union_of_fifty_is_any_of_fifty() {
    let centres: Vec<Point> = points(50, 11).collect();
    let solid = |(k, centre): (usize, &Point)| match k % 3 {
        0 => Shape::Sphere(Sphere { centre: *centre, radius: 0.7 }),
        1 => Shape::Cuboid(Cuboid::on(*centre, [0.8, 1.0, 1.2])),
        _ => Shape::Capsule(Capsule { start: *centre, end: [0.0; 3], radius: 0.2 }),
    };
    let members: Vec<Shape> = centres.iter().enumerate().map(solid).collect();
    let union = Shape::Union(Union::of(members.clone()));
    let mut inside = 0;
    for point in points(20_000, 13) {
        let any = members.iter().any(|member| member.inside(point));
        assert_eq!(union.inside(point), any, "{point:?}");
        inside += usize::from(any);
    }
    assert!(inside > 500 && inside < 19_000, "{inside}");
}
