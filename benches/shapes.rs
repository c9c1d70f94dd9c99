//! What it costs to ask whether a point is inside a shape: a box, fifty primitives in a bounding tree, a soft object of
//! fifty parts and a closed mesh, each a thousand points that lie evenly about the shape.
//!
//! The box is the measure: fifty primitives are to cost ten times as much at most (`docs/performance.md`), also where a
//! production calls them as `prune`.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use phytomer::models::fault::Path;
use phytomer::models::lsystem::text::{TextModel, TextSystem};
use phytomer::models::shapes::{Named, Shapes};
use phytomer::sim::math::sincos;
use phytomer::sim::random::PlantRandom;
use phytomer::sim::shape::{Capsule, Cuboid, Mesh, Point, Shape, Skeleton, Soft, Sphere, Torus, Union};
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::hint::black_box;
use std::sync::Arc;

/// Points that lie evenly in a cube of 8 m about the origin (Roberts 2018, the sequence R3).
fn points(number: u32) -> Vec<Point> {
    const STEPS: [f64; 3] = [0.819_172_513_396_164_5, 0.671_043_606_703_789_3, 0.549_700_477_901_970_3];
    let share = |k: u32, axis: usize| {
        let x = f64::from(k) * STEPS[axis];
        8.0 * (x - x.floor()) - 4.0
    };
    (0..number).map(|k| [0, 1, 2].map(|axis| share(k, axis))).collect()
}

fn fifty() -> Shape {
    let member = |(k, centre): (usize, Point)| match k % 3 {
        0 => Shape::Sphere(Sphere { centre, radius: 0.7 }),
        1 => Shape::Cuboid(Cuboid::on(centre, [0.8, 1.0, 1.2])),
        _ => Shape::Capsule(Capsule { start: centre, end: centre.map(|x| 0.8 * x), radius: 0.3 }),
    };
    Shape::Union(Union::of(points(50).into_iter().enumerate().map(member).collect()))
}

fn ring(n: u32) -> Shape {
    let Torus { ring, tube, .. } = Torus { centre: [0.0; 3], ring: 2.5, tube: 1.0 };
    let at = |k: u32| sincos(TAU * f64::from(k % n) / f64::from(n));
    let point = |k: u32| {
        let ((around_sin, around_cos), (sin, cos)) = (at(k / n), at(k % n));
        [(ring + tube * cos) * around_cos, (ring + tube * cos) * around_sin, tube * sin]
    };
    let corner = |i: u32, j: u32| (i % n) * n + j % n;
    let square = |k: u32| {
        let (i, j) = (k / n, k % n);
        let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    let faces: Vec<[u32; 3]> = (0..n * n).flat_map(square).collect();
    let mesh = Mesh::of(&(0..n * n).map(point).collect::<Vec<_>>(), &faces).expect("a torus is closed");
    Shape::Mesh(Arc::new(mesh))
}

fn soft() -> Shape {
    Shape::Soft(Soft::of(points(50).into_iter().map(|at| (Skeleton::Line(at, at, 1.4), 1.0)).collect()))
}

fn inside(criterion: &mut Criterion) {
    let asked = points(1000);
    let mut group = criterion.benchmark_group("inside (points)");
    group.throughput(Throughput::Elements(asked.len() as u64));
    let cuboid = Shape::Cuboid(Cuboid::on([0.0, 0.0, -2.0], [4.0; 3]));
    for (name, shape) in [
        ("one box", cuboid),
        ("fifty primitives", fifty()),
        ("a soft object of fifty parts", soft()),
        ("a mesh of 5,000 triangles", ring(50)),
    ] {
        group.bench_function(name, |bencher| {
            bencher.iter(|| black_box(&asked).iter().filter(|point| shape.inside(**point)).count());
        });
    }
    group.finish();
}

/// An L-system of a thousand modules, each of which asks at every step whether its point is pruned.
fn asking(prune: &Value) -> TextModel {
    let shapes: Shapes = serde_json::from_value(json!({"prune": prune})).expect("shapes");
    let mut faults = Vec::new();
    let shapes = Named::of(&shapes, &Path::root(), &mut faults);
    assert_eq!(faults.len(), 0, "{faults:?}");
    let modules = points(1000).iter().map(|[x, y, z]| format!("V({x},{z},{y},0)")).collect::<String>();
    let text = format!("Lsystem: 1\nAxiom: {modules}\nV(x,y,z,n) --> V(x,y,z,n+prune(x,y,z))\nendlsystem\n");
    let texts = [("plant.l".to_owned(), text)].into();
    let system = TextSystem { file: "plant.l".to_owned(), texts, shapes, step_m: 1.0, ..TextSystem::default() };
    system.compile().unwrap_or_else(|wrong| panic!("{wrong:?}"))
}

/// The fifty primitives as a species states them.
fn fifty_stated() -> Value {
    let member = |(k, at): (usize, Point)| match k % 3 {
        0 => json!({"form": "sphere", "at_m": at, "radius_m": 0.7}),
        1 => json!({"form": "placed", "of": {"form": "box", "size_m": [0.8, 1.0, 1.2]}, "move_m": at}),
        _ => json!({"form": "capsule", "from_m": at, "to_m": at.map(|x| 0.8 * x), "radius_m": 0.3}),
    };
    json!({"form": "union", "of": points(50).into_iter().enumerate().map(member).collect::<Vec<_>>()})
}

fn through_the_language(criterion: &mut Criterion) {
    const STEPS: u32 = 20;
    let mut group = criterion.benchmark_group("prune of a production (calls)");
    group.throughput(Throughput::Elements(1000 * u64::from(STEPS)));
    for (name, shape) in
        [("one box", json!({"form": "box", "size_m": [4, 4, 4]})), ("fifty primitives", fifty_stated())]
    {
        let model = asking(&shape);
        group.bench_function(name, |bencher| {
            bencher.iter(|| black_box(model.derive(PlantRandom::new(1, 0), STEPS)).expect("a string"));
        });
    }
    group.finish();
}

criterion_group!(benches, inside, through_the_language);
criterion_main!(benches);
