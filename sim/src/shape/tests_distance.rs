//! Distances in metres of what is stated by a field, soft objects and blends, against closed forms and a cloud of
//! points; and blends whose field ends nowhere at once.
//!
//! Absent: distances of solids (`tests`).

use super::tests::{every, points};
use super::*;

#[test]
fn a_distance_is_a_half_less_the_field_where_shapes_are_solids() {
    for (name, shape) in every().into_iter().filter(|(name, _)| !["soft", "blend"].contains(name)) {
        for point in points(2000, 13) {
            let (distance, field) = (shape.distance(point), shape.field(point));
            assert!((SURFACE - field - distance).abs() < 1e-9, "{name} at {point:?}: {distance}");
        }
    }
}

/// The surface of a lone point, line or member is at the distance of a ball, of a capsule or of the member, however far
/// away, within and outside.
#[test]
fn lone_parts_have_the_distances_of_their_solids() {
    let (start, end) = ([-1.0, 0.0, 0.5], [1.0, 1.0, 0.0]);
    let line = |start, end| Shape::Soft(Soft::of(vec![(Skeleton::Line(start, end, 1.2), 1.0)]));
    let ball = Shape::Sphere(Sphere { centre: start, radius: 0.6 });
    let capsule = Shape::Capsule(Capsule { start, end, radius: 0.6 });
    let cone = Shape::Cone(Cone { base: [0.0, 0.5, -1.0], radius: 1.4, top_radius: 0.3, height: 2.0 });
    let alone = |member: &Shape| Shape::Blend(Blend::of(vec![member.clone()], 0.3));
    let pairs = [
        (line(start, start), ball.clone()),
        (line(start, end), capsule.clone()),
        (alone(&ball), ball),
        (alone(&capsule), capsule),
        (alone(&cone), cone),
    ];
    let (mut inside, mut outside) = (0, 0);
    for (shape, solid) in &pairs {
        for point in points(2000, 21).map(|point| point.map(|x| 0.6 * x)) {
            let (distance, expected) = (shape.distance(point), solid.distance(point));
            // Deep in a member several places of its surface are equally near.
            let tolerance = if expected < -0.1 { 0.4 } else { 1e-5 };
            assert!((distance - expected).abs() < tolerance, "{shape:?} at {point:?}: {distance}, not {expected}");
            *(if expected < 0.0 { &mut inside } else { &mut outside }) += 1;
        }
    }
    assert!(inside > 200 && outside > 5000, "{inside}, {outside}");
}

/// Of several parts the distance is never much below that to the nearest of many points of the shape, nor far above.
#[test]
fn distances_of_several_parts_are_near_those_to_points_of_the_shape() {
    for (name, shape) in every().into_iter().filter(|(name, _)| ["soft", "blend"].contains(name)) {
        let within: Vec<Point> = points(30_000, 2).filter(|point| shape.inside(*point)).collect();
        assert!(within.len() > 150, "{name}");
        for point in points(200, 8) {
            let distance = shape.distance(point);
            assert_eq!(distance < 0.0, shape.inside(point), "{name} at {point:?}");
            let nearest = within.iter().map(|other| length(from(point, *other))).fold(f64::INFINITY, f64::min);
            if distance > 0.0 {
                assert!(distance > nearest - 0.35, "{name} at {point:?}: {distance}, and {nearest} to a point");
                assert!(distance < 1.6 * nearest + 0.05, "{name} at {point:?}: {distance}, and {nearest} to a point");
            }
        }
    }
}

/// Members that are scaled unequally have distances that are too small: the field of a blend of them must end where it
/// is no longer asked, not be cut there.
#[test]
fn the_field_of_a_blend_has_no_jump() {
    let ball = Shape::Sphere(Sphere { centre: [0.0; 3], radius: 0.5 });
    let long = Shape::Placed(Box::new(Placed::of(ball.clone(), [1.0, 1.0, 5.0], Rotation::NONE, [0.0; 3])));
    let flat = Placed::of(ball.clone(), [4.0, 4.0, 0.5], Rotation::about([1.0, 0.0, 0.0], 0.4), [2.0, 0.0, 1.0]);
    let blend = Shape::Blend(Blend::of(vec![long, Shape::Placed(Box::new(flat)), ball], 0.6));
    let mut largest = 0.0_f64;
    for (start, end) in points(40, 4).zip(points(40, 5)) {
        let at = |step: u32| [0, 1, 2].map(|k| start[k] + (end[k] - start[k]) * f64::from(step) / 8000.0);
        let fields: Vec<f64> = (0..=8000).map(|step| blend.field(at(step))).collect();
        let jump = fields.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
        // No member's field has a slope above 1.73 / (2 · 0.6) a metre in its own coordinates; a step is below 1.8 mm.
        assert!(jump < 0.01, "from {start:?} to {end:?}: {jump}");
        largest = fields.into_iter().fold(largest, f64::max);
    }
    assert!(largest > 1.0, "the lines meet the blend: {largest}");
}

/// Where nothing adds to a field there is no surface; and a number of parts is told of every form.
#[test]
fn odd_shapes_have_distances_and_parts() {
    let taking = Shape::Soft(Soft::of(vec![(Skeleton::Line([0.0; 3], [0.0; 3], 1.0), -1.0)]));
    let weak = Shape::Soft(Soft::of(vec![(Skeleton::Line([0.0; 3], [0.0; 3], 1.0), 0.3)]));
    let none = Shape::Blend(Blend::of(Vec::new(), 1.0));
    for shape in [&taking, &weak, &none] {
        assert_eq!(shape.distance([0.3, 0.2, 0.1]), f64::INFINITY);
    }
    for (name, shape) in every() {
        for point in [[f64::NAN; 3], [f64::INFINITY; 3], [f64::MAX, 0.0, f64::MIN]] {
            let _ = shape.distance(point);
        }
        let parts = match name {
            "polyline" | "soft" => 4,
            "union" | "intersection" | "difference" | "blend" => 3,
            "placed" => 2,
            _ => 1,
        };
        assert_eq!(shape.parts(), parts, "{name}");
    }
}
