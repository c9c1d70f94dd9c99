//! Surfaces of shapes against closed forms: volumes, closed edges, normals that agree with the triangles, and corners
//! that lie where the field is ½.

use super::turned::SIDES;
use super::*;
use crate::measure::{assert_closed, assert_unit_normals, outward_share, volume};
use phytomer_sim::math::sin;
use phytomer_sim::rotation::Rotation;
use phytomer_sim::shape::{
    Blend, Capsule, Cone, Cylinder, Difference, Ellipsoid, HalfSpace, Intersection, Mesh as ClosedMesh, Placed,
    Polyline, SURFACE, Shell, Skeleton, Soft, Sphere, Torus, Union,
};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

const TAG: Tag = Tag { colour: [1, 2, 3, 255], birth: 0.0, death: f32::INFINITY, component: -1, kind: 255 };

/// The volume of what is drawn of a shape, which is closed and faces outward everywhere.
fn drawn(name: &str, shape: &Shape) -> f64 {
    let solid = Solid::of(shape).unwrap_or_else(|why| panic!("{name}: {why}"));
    let mesh = solid.mesh(&TAG);
    assert_closed(&mesh.vertices, &mesh.faces);
    assert_unit_normals(&mesh.vertices);
    assert!(outward_share(&mesh.vertices, &mesh.faces) > 0.999, "{name}");
    let whole = solid.volume();
    assert!((volume(&mesh.vertices, &mesh.faces) / whole - 1.0).abs() < 1e-4, "{name}: {whole}");
    whole
}

/// That the volume is the expected one, to a share of it.
fn check(name: &str, shape: &Shape, expected: f64, share: f64) {
    let whole = drawn(name, shape);
    assert!((whole / expected - 1.0).abs() < share, "{name}: {whole} is not {expected}");
}

fn ball(radius: f64) -> f64 {
    4.0 / 3.0 * PI * radius * radius * radius
}

/// What a circle of these sides has of its area.
fn polygon() -> f64 {
    let part = TAU / f64::from(SIDES);
    sin(part) / part
}

#[test]
fn what_turns_about_an_axis_has_its_volume_in_polygons() {
    let base = [0.5, -1.0, 2.0];
    check("box", &Shape::Cuboid(Cuboid::on(base, [1.0, 2.0, 3.0])), 6.0, 1e-12);
    let cylinder = Shape::Cylinder(Cylinder { base, radius: 0.5, height: 2.0 });
    check("cylinder", &cylinder, 0.5 * PI * polygon(), 1e-12);
    let cone = Cone { base, radius: 1.0, top_radius: 0.0, height: 3.0 };
    check("cone", &Shape::Cone(cone), PI * polygon(), 1e-12);
    let part = Shape::Cone(Cone { top_radius: 0.5, ..cone });
    check("part of a cone", &part, PI * 1.75 * polygon(), 1e-12);
    // Frusta between rings at the polar angles θ: their volume is that of the ball within 1/120 at 24 parts.
    check("sphere", &Shape::Sphere(Sphere { centre: base, radius: 0.8 }), ball(0.8), 0.01);
    let ellipsoid = Shape::Ellipsoid(Ellipsoid { centre: base, radii: [0.5, 2.0, 1.0] });
    check("ellipsoid", &ellipsoid, ball(1.0), 0.01);
    let capsule = Capsule { start: base, end: [0.5, 1.0, 3.0], radius: 0.4 };
    check("capsule", &Shape::Capsule(capsule), PI * 0.16 * 5.0_f64.sqrt() + ball(0.4), 0.01);
    let point = Capsule { end: base, ..capsule };
    assert!(
        (Solid::of(&Shape::Capsule(point)).map(|solid| solid.volume()).unwrap_or(0.0) / ball(0.4) - 1.0).abs() < 0.01
    );
    // Two polygons: one of 48 sides about the axis, one of 24 about the tube.
    let tube = 12.0 / PI * sin(PI / 12.0);
    check("torus", &Shape::Torus(Torus { centre: base, ring: 2.0, tube: 0.5 }), PI * PI * polygon() * tube, 1e-12);
}

/// After λ of a turn all is λ times as large: by Pappus' theorem the volume is ∫ π c² λ³ᵗ · 2π r dt.
#[test]
fn a_shell_has_the_volume_of_its_discs() {
    let shell = Shell { foot: [0.1, 0.2, 0.3], spiral: 1.0, height: 2.0, tube: 0.3, shrink: 0.6, turns: 2.5 };
    let cubed: f64 = 0.6 * 0.6 * 0.6;
    let end = cubed * cubed * phytomer_sim::math::pow(cubed, 0.5);
    let sum = (1.0 - end) / -phytomer_sim::math::log(cubed);
    check("shell", &Shape::Shell(shell), TAU * PI * 0.09 * sum, 0.02);
}

#[test]
fn placed_shapes_and_closed_meshes_keep_their_triangles() {
    let cuboid = || Shape::Cuboid(Cuboid::on([0.0; 3], [1.0, 2.0, 3.0]));
    let turn = Rotation::about([1.0, 2.0, 0.5], 1.0);
    let placed = Shape::Placed(Box::new(Placed::of(cuboid(), [0.5, 1.0, 2.0], turn, [3.0, -1.0, 0.5])));
    check("placed", &placed, 6.0, 1e-12);
    for point in &Solid::of(&placed).expect("it has an end").points {
        assert!((placed.field(*point) - SURFACE).abs() < 1e-12, "{point:?}");
    }
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let inward = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
    let mesh = ClosedMesh::of(&corners, &inward).expect("it is closed");
    check("tetrahedron", &Shape::Mesh(Arc::new(mesh)), 1.0 / 6.0, 1e-12);
}

/// The room of `greene/shoot`: walls of 0.2 m about a room of 2 m, with a window; its edges stay sharp. And a roof, cut
/// out of a box by two slopes, which has no volume beside its prism.
#[test]
fn cut_shapes_have_sharp_edges_and_their_volume() {
    let cuboid = |at: Point, size: [f64; 3]| Shape::Cuboid(Cuboid::on(at, size));
    let [at, window] = [[0.2, 0.2, 0.0], [1.3, 0.2, 0.8]];
    let taken = vec![cuboid(at, [2.0; 3]), cuboid(window, [0.4, 1.0, 0.9])];
    let room = Shape::Difference(Box::new(Difference::of(cuboid(at, [2.4, 2.4, 2.2]), taken)));
    check("room", &room, 2.4 * 2.4 * 2.2 - 8.0 - 0.2 * 0.9, 2e-3);
    let slope = |y: f64| Shape::HalfSpace(HalfSpace { point: [2.25, 0.0, 4.0], normal: [0.0, y, 1.0] });
    let roof = vec![cuboid([2.25, 0.0, 2.5], [4.0, 3.0, 1.5]), slope(1.0), slope(-1.0)];
    let roof = Shape::Intersection(Intersection::of(roof));
    check("roof", &roof, 0.5 * 3.0 * 1.5 * 4.0, 2e-3);
    let top = Solid::of(&roof).expect("it has an end").bounds().high;
    assert!((top[2] - 4.0).abs() < 2e-3 && (top[0] - 4.25).abs() < 1e-3, "{top:?}");
    let house = Shape::Union(Union::of(vec![cuboid([2.25, 0.0, 0.0], [4.0, 3.0, 2.5]), roof]));
    assert!((Solid::of(&house).expect("it has an end").volume() / 39.0 - 1.0).abs() < 1e-3);
}

/// The field of a lone point is ½ at half its reach; of a blend of one member on that member's surface.
#[test]
fn soft_objects_blends_and_polylines_have_their_volumes() {
    let part = |x: f64| (Skeleton::Line([x, 0.1, 0.2], [x, 0.1, 0.2], 2.0), 1.0);
    check("soft", &Shape::Soft(Soft::of(vec![part(0.0)])), ball(1.0), 2e-3);
    let sphere = Shape::Sphere(Sphere { centre: [0.0; 3], radius: 1.0 });
    check("blend", &Shape::Blend(Blend::of(vec![sphere], 0.4)), ball(1.0), 2e-3);
    let polyline = Polyline::of(vec![([0.0; 3], 0.5), ([0.0, 2.0, 0.0], 0.5)]);
    check("polyline", &Shape::Polyline(polyline), PI * 0.25 * 2.0 + ball(0.5), 2e-3);
    // Two that run together are one surface; apart they are two balls.
    let near = drawn("near", &Shape::Soft(Soft::of(vec![part(0.0), part(1.9)])));
    let apart = drawn("apart", &Shape::Soft(Soft::of(vec![part(0.0), part(5.0)])));
    assert!(near > apart && (apart / ball(1.0) / 2.0 - 1.0).abs() < 0.01, "{near} {apart}");
}

#[test]
fn what_has_no_end_or_no_inside_is_not_drawn() {
    let half = || Shape::HalfSpace(HalfSpace { point: [0.0; 3], normal: [0.0, 0.0, 1.0] });
    assert_eq!(Solid::of(&half()), Err(Undrawn::Endless));
    assert_eq!(Solid::of(&Shape::Union(Union::of(Vec::new()))), Err(Undrawn::Empty));
    let ball = |x: f64| Shape::Sphere(Sphere { centre: [x, 0.0, 0.0], radius: 1.0 });
    assert_eq!(Solid::of(&Shape::Union(Union::of(vec![ball(0.0), half()]))), Err(Undrawn::Endless));
    let apart = Shape::Intersection(Intersection::of(vec![ball(0.0), ball(2.5)]));
    assert_eq!(Solid::of(&apart), Err(Undrawn::Empty));
    let none = Shape::Difference(Box::new(Difference::of(ball(0.0), vec![ball(0.0)])));
    assert_eq!(Solid::of(&none), Err(Undrawn::Empty));
}
