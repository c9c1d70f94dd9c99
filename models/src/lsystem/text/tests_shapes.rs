//! Shapes as functions of a file: against closed forms, and L-system 4 of *Synthetic Topiary* with its box as a shape
//! against the text with its formula.

use super::tests::{BOX, grown, model};
use super::{TextModel, TextSystem};
use crate::fault::Path;
use crate::shapes::{Named, Shapes};
use phytomer_sim::plant::Kind;
use phytomer_sim::random::PlantRandom;
use serde_json::{Value, json};

fn named(shapes: Value) -> Named {
    let shapes: Shapes = serde_json::from_value(shapes).expect("shapes");
    let mut faults = Vec::new();
    let named = Named::of(&shapes, &Path::root(), &mut faults);
    assert_eq!(faults.len(), 0, "{faults:?}");
    named
}

fn system(text: &str, shapes: Value, step_m: f64) -> TextSystem {
    let texts = [("plant.l", text), ("plant.v", "angle increment: 32")];
    TextSystem {
        file: "plant.l".to_owned(),
        view: Some("plant.v".to_owned()),
        texts: texts.map(|(name, text)| (name.to_owned(), text.to_owned())).into(),
        kinds: [("A".to_owned(), Kind::ApicalBud), ("@o".to_owned(), Kind::AxillaryBud)].into(),
        shapes: named(shapes),
        step_m,
        ..TextSystem::default()
    }
}

fn compiled(system: &TextSystem) -> TextModel {
    system.compile().unwrap_or_else(|wrong| panic!("{wrong:?}"))
}

/// The parameters of the module V after a step.
fn values(system: &TextSystem) -> Vec<f64> {
    let model = compiled(&TextSystem { kinds: Default::default(), ..system.clone() });
    let derived = model.derive(PlantRandom::new(1, 0), 1).expect("a step");
    let symbols = model.program().symbols();
    let of = derived.string().modules().find(|module| symbols.name(module.symbol) == "V").expect("the module V");
    of.parameters.to_vec()
}

/// The turtle's (x, y, z) is (x, −z, y) times the length of a step: an ellipsoid with other axes in x, y and z, and a
/// box that stands on the ground.
#[test]
fn shapes_are_asked_in_the_coordinates_of_the_turtle() {
    let shapes = json!({
        "egg": {"form": "sphere", "at_m": [1, 2, 3], "radius_m": 0.5},
        "prune": {"form": "box", "size_m": [2, 4, 6]},
    });
    let calls = "field_egg(2, 6, -4), inside_egg(2.9, 6, -4), inside_egg(3.1, 6, -4), \
                 prune(2, 12, 4), prune(2.01, 12, 4), prune(2, 12, 4.01), inside_prune(0, -0.01, 0), field_prune(0, 2)";
    let text = format!("Lsystem: 1\nAxiom: W\nW --> V({calls})\nendlsystem\n");
    let expected = [1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 1.5];
    let found = values(&system(&text, shapes, 0.5));
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
    assert_eq!(found.len(), expected.len());
}

/// L-system 4 with the box as a shape is, step for step, that with the printed formula; a point on the surface is not
/// pruned, whether stated so or so.
#[test]
fn l_system_4_prunes_to_a_shape() {
    let without = BOX.lines().filter(|line| !line.starts_with("#define prune")).collect::<Vec<_>>().join("\n");
    let shape = json!({"prune": {"form": "box", "size_m": [5.2, 5.2, 5.2]}});
    let pruned = compiled(&system(&format!("{without}\n"), shape, 1.0));
    let printed = model(BOX, "angle increment: 32", &[("A", Kind::ApicalBud), ("@o", Kind::AxillaryBud)]);
    for step in [6, 7, 10, 20, 75, 94] {
        let (one, other) = (grown(&pruned, step), grown(&printed, step));
        assert_eq!(one.nodes.component, other.nodes.component, "step {step}");
        assert_eq!(one.frames.base, other.frames.base, "step {step}");
    }
    assert_eq!(grown(&pruned, 94).nodes.len(), 20);
}

/// What the file itself defines comes first.
#[test]
fn a_function_of_the_file_hides_a_shape() {
    let shapes = json!({"prune": {"form": "sphere", "radius_m": 1}});
    let text = "prune(x, y) = x + 10y\nω : W\np1 : W → V(prune(1, 2), prune(0, 0))\n";
    assert_eq!(values(&system(text, shapes, 1.0)), [21.0, 0.0]);
}

#[test]
fn what_is_wrong_with_a_call_is_told_at_its_place() {
    let told = |call: &str| {
        let text = format!("Lsystem: 1\nAxiom: W\nW --> V({call})\nendlsystem\n");
        let wrong = system(&text, json!({"egg": {"form": "sphere", "radius_m": 1}}), 1.0).compile();
        wrong.expect_err("it is wrong").iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
    };
    let missing = told("prune(1, 2, 3)");
    assert!(missing.contains("plant.l:3:9") && missing.contains("`[shape.prune]` of the species"), "{missing}");
    assert!(missing.ends_with("there is egg"), "{missing}");
    let many = told("inside_egg(1, 2, 3, 4)");
    assert!(many.contains("`inside_egg(x, y, z)`, or `inside_egg(x, y)`"), "{many}");
}
