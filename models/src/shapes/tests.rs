//! Shapes as they are stated: each form is the form that its keys say, names are followed, and what has no meaning is
//! told with its place.
//!
//! Absent: what is inside a form (`phytomer_sim::shape`), and the schema.

use super::*;
use crate::fault::{Fault, Path};
use phytomer_sim::shape::Shape;
use serde_json::{Value, json};

fn shapes(text: Value) -> Shapes {
    serde_json::from_value(text).expect("shapes")
}

fn compiled(text: Value) -> (Named, Vec<String>) {
    let mut faults = Vec::new();
    let named = Named::of(&shapes(text), &Path::root().key("shape"), &mut faults);
    (named, faults.iter().map(Fault::to_string).collect())
}

/// The bounds of each form are those of its keys.
#[test]
fn every_form_is_what_its_keys_say() {
    let (named, faults) = compiled(json!({
        "ball": {"form": "sphere", "at_m": [1, 2, 3], "radius_m": 1},
        "box": {"form": "box", "size_m": [2, 4, 6]},
        "capsule": {"form": "capsule", "from_m": [0, 0, 0], "to_m": [1, 0, 0], "radius_m": 0.5},
        "cone": {"form": "cone", "radius_m": 1, "height_m": 2},
        "cut": {"form": "difference", "of": "box", "less": ["ball"]},
        "cylinder": {"form": "cylinder", "radius_m": 1, "height_m": 2},
        "ellipsoid": {"form": "ellipsoid", "radii_m": [1, 2, 3]},
        "large": {"form": "placed", "of": "box", "scale": 2, "move_m": [0, 0, 1]},
        "line": {"form": "polyline", "points_m": [[0, 0, 0], [1, 0, 0]], "radii_m": [0.5, 1]},
        "lying": {"form": "placed", "of": "box", "turn": {"about": [0, 1e-9, 0], "angle_deg": 90}},
        "mesh": {"form": "mesh", "points_m": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
            "faces": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]},
        "near": {"form": "blend", "of": ["ball"], "reach_m": 0.25},
        "ring": {"form": "torus", "ring_radius_m": 2, "radius_m": 0.5},
        "roofed": {"form": "intersection", "of": ["box", {"form": "half_space", "point_m": [0, 0, 2], "normal": [0, 0, 1]}]},
        "shell": {"form": "shell", "spiral_radius_m": 1, "height_m": 3, "radius_m": 0.5, "shrink": 0.5, "turns": 2},
        "soft": {"form": "soft", "points": [{"at_m": [0, 0, 0], "reach_m": 1}],
            "lines": [{"from_m": [0, 0, 0], "to_m": [3, 0, 0], "reach_m": 1}],
            "ellipsoids": [{"at_m": [0, 0, 0], "reach_m": [1, 2, 3], "strength": -0.5}]},
        "two": {"form": "union", "of": ["ball", "ring"]},
    }));
    assert_eq!(faults, Vec::<String>::new());
    let expected = [
        ("ball", [0.0, 1.0, 2.0], [2.0, 3.0, 4.0]),
        ("box", [-1.0, -2.0, 0.0], [1.0, 2.0, 6.0]),
        ("capsule", [-0.5, -0.5, -0.5], [1.5, 0.5, 0.5]),
        ("cone", [-1.0, -1.0, 0.0], [1.0, 1.0, 2.0]),
        ("cut", [-1.0, -2.0, 0.0], [1.0, 2.0, 6.0]),
        ("cylinder", [-1.0, -1.0, 0.0], [1.0, 1.0, 2.0]),
        ("ellipsoid", [-1.0, -2.0, -3.0], [1.0, 2.0, 3.0]),
        ("large", [-2.0, -4.0, 1.0], [2.0, 4.0, 13.0]),
        ("line", [-0.5, -1.0, -1.0], [2.0, 1.0, 1.0]),
        ("lying", [0.0, -2.0, -1.0], [6.0, 2.0, 1.0]),
        ("mesh", [0.0; 3], [1.0; 3]),
        ("near", [-0.25, 0.75, 1.75], [2.25, 3.25, 4.25]),
        ("ring", [-2.5, -2.5, -0.5], [2.5, 2.5, 0.5]),
        ("roofed", [-1.0, -2.0, 0.0], [1.0, 2.0, 2.0]),
        ("shell", [-1.5, -1.5, -0.5], [1.5, 1.5, 2.375]),
        ("soft", [-1.0, -2.0, -3.0], [4.0, 2.0, 3.0]),
        ("two", [-2.5, -2.5, -0.5], [2.5, 3.0, 4.0]),
    ];
    assert_eq!(named.iter().map(|(name, _)| name).collect::<Vec<_>>(), expected.map(|(name, ..)| name));
    for (name, low, high) in expected {
        let bounds = named.get(name).expect("compiled").bounds();
        let near = |a: [f64; 3], b: [f64; 3]| (0..3).all(|k| (a[k] - b[k]).abs() < 1e-12);
        assert!(near(bounds.low, low) && near(bounds.high, high), "{name}: {bounds:?}");
    }
    assert!(!named.get("cut").expect("compiled").inside([0.5, 2.0, 3.0]), "the ball is taken away");
}

#[test]
fn what_has_no_meaning_is_told_with_its_place() {
    let (named, faults) = compiled(json!({
        "a": {"form": "union", "of": ["b"]},
        "b": {"form": "placed", "of": {"form": "union", "of": ["a"]}},
        "flat": {"form": "half_space", "point_m": [0, 0, 0], "normal": [0, 0, 0]},
        "good": {"form": "sphere", "radius_m": 1},
        "line": {"form": "polyline", "points_m": [[0, 0, 0], [1, 0, 0]], "radii_m": [1]},
        "none": {"form": "difference", "of": "god", "less": ["good"]},
        "open": {"form": "mesh", "points_m": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
            "faces": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 2, 3]]},
        "soft": {"form": "soft"},
        "short": {"form": "half_space", "point_m": [0, 0, 0], "normal": [0, 1e-170, 0]},
        "file": {"form": "mesh", "file": "house.ply"},
        "still": {"form": "placed", "of": "good", "turn": {"about": [0, 0, 0], "angle_deg": 9}},
    }));
    assert_eq!(
        faults,
        [
            "shape.b.of.of[0]: the shape `a` is made of itself; expected shapes that do not lead back to it",
            "shape.file.file: the mesh `house.ply` has not been read; expected `points_m` and `faces`, where no files are \
             read",
            "shape.flat.normal: the normal of the half space has the length 0; expected a direction, such as [0, 0, 1]",
            "shape.line.radii_m: there are 1 radii and 2 points; expected a radius for each point",
            "shape.none.of: there is no shape `god`; expected the name of a shape; the nearest is `good`",
            "shape.open.faces: the mesh is not closed at 3 of its edges, the first from [0.0, 0.0, 0.0] to \
             [0.0, 0.0, 1.0]; expected triangles that enclose space, each edge between two of them",
            "shape.short.normal: the normal of the half space has a length below 1e-100; expected a direction, such as \
             [0, 0, 1]",
            "shape.soft: the soft object has no skeleton; expected `points`, `lines` or `ellipsoids`",
            "shape.still.turn.about: the axis of the turn has the length 0; expected a direction, such as [0, 0, 1]",
        ]
    );
    assert_eq!(named.iter().map(|(name, _)| name).collect::<Vec<_>>(), ["good"]);
    let mut faults = Vec::new();
    let path = Path::root().key("event");
    let name = |name: &str| ShapeOrName::Name(name.to_owned());
    assert!(matches!(one(&name("good"), &named, &path, &mut faults).as_deref(), Some(Shape::Sphere(_))));
    assert_eq!(one(&name("flat"), &named, &path, &mut faults), None);
    assert_eq!(faults, [], "the fault of the shape is told where the shape is stated");
    assert_eq!(one(&name("x"), &named, &path, &mut faults), None);
    let inline: ShapeOrName = serde_json::from_value(json!({"form": "union", "of": ["good", "x"]})).expect("a shape");
    assert_eq!(one(&inline, &named, &path, &mut faults), None);
    let told: Vec<String> = faults.iter().map(|fault| fault.path.to_string()).collect();
    assert_eq!(told, ["event", "event.of[1]"]);
}

/// Names that double a shape again and again, and names that lead to names, end with a fault.
#[test]
fn shapes_without_end_are_refused() {
    let mut doubling = serde_json::Map::new();
    doubling.insert("s00".to_owned(), json!({"form": "sphere", "radius_m": 1}));
    for k in 1..40 {
        let before = format!("s{:02}", k - 1);
        doubling.insert(format!("s{k:02}"), json!({"form": "union", "of": [before, before]}));
    }
    let (_, faults) = compiled(Value::Object(doubling));
    assert_eq!(faults, ["shape.s16.of: the shape has more than 100000 parts; expected at most 100000"]);
    // The parts of a soft object and of a polyline are parts as well, and so is what a difference takes away.
    let points: Vec<Value> = (0..400).map(|k| json!([k, 0, 0])).collect();
    let line = json!({"form": "polyline", "points_m": points, "radii_m": vec![1; 400]});
    let (_, faults) = compiled(json!({"line": line, "many": {"form": "union", "of": vec!["line"; 300]}}));
    assert_eq!(faults, ["shape.many.of: the shape has more than 100000 parts; expected at most 100000"]);
    let half = json!({"form": "union", "of": vec!["line"; 150]});
    let less = json!({"form": "difference", "of": "half", "less": ["half"]});
    let (_, faults) = compiled(json!({"line": line, "half": half, "less": less}));
    assert_eq!(faults, ["shape.less: the shape has more than 100000 parts; expected at most 100000"]);
    let mut leading = serde_json::Map::new();
    for k in 0..200 {
        let next = format!("s{:03}", k + 1);
        leading.insert(format!("s{k:03}"), json!({"form": "placed", "of": next}));
    }
    leading.insert("s200".to_owned(), json!({"form": "sphere", "radius_m": 1}));
    let (_, faults) = compiled(Value::Object(leading));
    assert!(!faults.is_empty() && faults.iter().all(|fault| fault.contains("more than 50 shapes")), "{faults:?}");
    // The other way round each name is compiled before it is mentioned.
    let mut built = serde_json::Map::new();
    built.insert("s000".to_owned(), json!({"form": "sphere", "radius_m": 1}));
    for k in 1..200 {
        let before = format!("s{:03}", k - 1);
        built.insert(format!("s{k:03}"), json!({"form": "placed", "of": before}));
    }
    let (named, faults) = compiled(Value::Object(built));
    assert_eq!((named.iter().count(), faults.len()), (50, 1), "{faults:?}");
    // Each of these is small enough, and all together are not.
    let many = json!({"form": "union", "of": vec!["line"; 200]});
    let mut all: serde_json::Map<String, Value> = (0..40).map(|k| (format!("s{k:02}"), many.clone())).collect();
    all.insert("line".to_owned(), line);
    let (named, faults) = compiled(Value::Object(all));
    assert_eq!(
        faults,
        ["shape.s04: the named shapes up to `s04` have more than 400000 parts; expected at most 400000 of all \
             together, shapes within shapes counted anew"]
    );
    assert_eq!(named.iter().count(), 6, "no more are made");
}
