//! Plants of other programs, where they stand beside the project.

use super::{again, measured, read_with, text, written};
use crate::exchange::{Description, Entity, Incoming, Report, Role, Units, Value, by_word};
use std::collections::BTreeMap;

/// A measured file; `None`, with a word, where measured data are left out.
fn file(name: &str) -> Option<Vec<u8>> {
    let Some(folder) = measured() else {
        eprintln!("skipped: there are no measured plants here");
        return None;
    };
    Some(std::fs::read(folder.join(name)).unwrap())
}

fn opf(name: &str) -> Option<Description> {
    let (description, report) = read_with("opf", &file(name)?, &BTreeMap::new());
    assert!(report.faults().is_empty() && report.warnings().is_empty(), "{report:?}");
    Some(description)
}

fn count(of: &Description, role: Role) -> usize {
    of.individuals.iter().flat_map(|plant| &plant.entities).filter(|entity| of.role_of(entity) == role).count()
}

/// The sums of the areas and of the lengths of all entities.
fn sums(of: &Description) -> (f64, f64) {
    let seen = of.individuals.iter().flat_map(|plant| &plant.entities).filter_map(Entity::latest);
    seen.fold((0.0, 0.0), |(area, length), seen| (area + seen.area.unwrap_or(0.0), length + seen.length.unwrap_or(0.0)))
}

#[test]
fn the_coffee_has_its_axes_metamers_and_leaves() {
    let Some(coffee) = opf("coffee.opf") else { return };
    for of in [&coffee, &again("opf", &coffee)] {
        assert_eq!([Role::Axis, Role::Internode, Role::Leaf].map(|role| count(of, role)), [158, 1853, 2179]);
        let (area, length) = sums(of);
        // Square centimetres and centimetres, as the file has them.
        assert!((area * 1e4 - 77_961.477).abs() < 5e-4 && (length * 1e2 - 43_020.86).abs() < 5e-3, "{area} {length}");
    }
    let (out, losses) = written("opf", &coffee);
    assert!(losses.is_empty(), "{losses:?}");
    let found = again("opf", &coffee);
    assert_eq!(written("opf", &found).0, out);
    for (a, b) in coffee.individuals[0].entities.iter().zip(&found.individuals[0].entities) {
        assert_eq!((a.bearer, a.link, a.complex), (b.bearer, b.link, b.complex));
        assert_eq!(values(&coffee, a), values(&found, b));
        let (Some(a), Some(b)) = (a.latest(), b.latest()) else { continue };
        let far = |a: Option<[f64; 3]>, b: Option<[f64; 3]>| {
            (0..3).map(|k| (a.unwrap_or_default()[k] - b.unwrap_or_default()[k]).abs()).fold(0.0, f64::max)
        };
        assert!(far(a.place, b.place) < 1e-6 && far(a.direction, b.direction) < 1e-6);
    }
}

#[test]
fn the_coffee_is_the_same_plant_in_both_of_its_files() {
    let (Some(opf), Some(bytes)) = (opf("coffee.opf"), file("coffee.mtg")) else { return };
    let mut report = Report::new("coffee.mtg");
    let beside = |_: &str| Err(std::io::Error::other("no other file"));
    let units = Some(Units { length_m: 0.01, diameter_m: 0.01 });
    let mtg = by_word("mtg")
        .unwrap()
        .read(&Incoming { name: "coffee.mtg", bytes: &bytes, units, beside: &beside }, &mut report);
    assert!(report.faults().is_empty(), "{:?}", report.faults());
    let (a, b) = (&mtg.individuals[0].entities, &opf.individuals[0].entities);
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        assert_eq!((a.bearer, a.link, a.complex), (b.bearer, b.link, b.complex));
        assert_eq!(mtg.class_of(a), opf.class_of(b));
        let (Some(x), Some(y)) = (a.latest(), b.latest()) else { continue };
        let near = |a: Option<f64>, b: Option<f64>| {
            a.zip(b).is_none_or(|(a, b)| (a - b).abs() < 1e-9) && a.is_some() <= b.is_some()
        };
        assert!(
            near(x.length, y.length) && near(x.base_diameter, y.base_diameter) && near(x.area, y.area),
            "{x:?} {y:?}"
        );
        assert_eq!(values(&mtg, a), values(&opf, b));
    }
}

/// The features of an entity by name, as texts. `FileName` is left out, since the MTG and the OPF of the coffee tree
/// name other files there.
fn values(of: &Description, entity: &Entity) -> BTreeMap<String, String> {
    let values = entity.latest().map_or(&[][..], |seen| &seen.values).iter();
    let text = |value: &Value| match value {
        Value::Int(number) => number.to_string(),
        Value::Real(number) => number.to_string(),
        Value::Text(text) => text.to_string(),
        Value::Truth(truth) => truth.to_string(),
        Value::Date(date) => date.to_string(),
    };
    let named = values.map(|(feature, value)| (of.features[*feature as usize].name.clone(), text(value)));
    named.filter(|(name, _)| name != "FileName").collect()
}

#[test]
fn a_simple_plant_and_a_scene_of_both() {
    let Some(simple) = opf("simple_plant.opf") else { return };
    assert_eq!([Role::Axis, Role::Internode, Role::Leaf].map(|role| count(&simple, role)), [1, 2, 2]);
    let Some(folder) = measured() else { return };
    let mut others = BTreeMap::new();
    for name in ["coffee.opf", "simple_plant.opf"] {
        others.insert(name.to_owned(), std::fs::read(folder.join(name)).unwrap());
    }
    let (scene, report) = read_with("ops", &file("scene.ops").unwrap(), &others);
    assert!(report.faults().is_empty() && report.warnings().is_empty(), "{report:?}");
    assert_eq!((scene.individuals.len(), count(&scene, Role::Leaf)), (6, 2179 + 5 * 2));
    assert_eq!(scene.individuals[0].species.as_deref(), Some("coffee"));
    let standing = scene.individuals[4].standing.unwrap();
    assert_eq!((standing.place, standing.scale, standing.twist), ([1.0, 1.0, 0.0], 1.5, 1.57));
    let (out, _) = written("ops", &scene);
    let (found, _) = read_with("ops", &out.main, &out.beside);
    assert_eq!(written("ops", &found).0, out);
    assert!(text(&out).contains("1\t5\tplant_5.opf\t1\t1\t0\t1.5\t0\t0\t1.57\n"));
}

#[test]
fn measured_trees_pass_through_every_format_that_holds_them() {
    for name in ["walnut_noylum2.mtg", "agraf.mtg", "boutdenoylum2.mtg", "mtg_dynamic.mtg"] {
        let Some(bytes) = file(name) else { return };
        let (tree, report) = read_with("mtg", &bytes, &BTreeMap::new());
        assert!(report.faults().is_empty(), "{name}: {:?}", report.faults());
        let found = again("opf", &tree);
        assert_eq!(found.entities(), tree.entities(), "{name}");
        assert_eq!(written("opf", &found).0, written("opf", &tree).0, "{name}");
    }
}
