//! Grown plants in files of other programs and back: OPF and scenes with all that they hold, cylinders with length and
//! volume, meshes as other programs read them.
//!
//! Absent: MTG (`exchange`), and each rule of a format, which is tested beside it (`outputs/src/exchange`).

mod program;
mod trips;

use phytomer::outputs::exchange::{Description, Entity, InMemory, Individual, Link, Role, Value};
use program::run;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::tempdir;
use trips::{near, plant_at, plant_of, read, species, written};

/// The number of a component.
fn number(entity: &Entity) -> Option<i64> {
    entity.latest()?.values.iter().find_map(|(_, value)| match value {
        Value::Int(number) => Some(*number),
        _ => None,
    })
}

/// What an entity is called: its role, its number, and its index, which tells growth units of an axis apart.
fn name(of: &Description, plant: &Individual, place: u32) -> (Role, Option<i64>, Option<f64>) {
    let entity = &plant.entities[place as usize];
    (of.role_of(entity), number(entity), entity.index)
}

/// The entity that one springs from: of the same scale, where it goes on from a part of such.
fn bearer(of: &Description, plant: &Individual, place: u32) -> Option<(Role, Option<i64>, Option<f64>)> {
    let entity = &plant.entities[place as usize];
    let scale = of.class_of(entity).scale;
    let bearer = entity.bearer?;
    let like = plant.within(bearer, |known| entity.link == Some(Link::Branches) || of.class_of(known).scale <= scale);
    Some(name(of, plant, like.unwrap_or(bearer)))
}

/// Holds two descriptions of a plant against each other: topology, ranks and ages, and places and sizes to a millionth
/// of a metre.
fn same(told: &str, one: &Description, other: &Description) {
    let (a, b) = (&one.individuals[0], &other.individuals[0]);
    assert_eq!((a.entities.len(), a.age, &a.species), (b.entities.len(), b.age, &b.species), "{told}");
    // Entities come back in the order of the file. Those without a number are growth units: by index within their axis.
    let key = |of: &Description, plant: &Individual, place: u32| {
        let entity = &plant.entities[place as usize];
        let whole = entity.complex.map(|whole| number(&plant.entities[whole as usize]));
        (of.role_of(entity), number(entity), entity.index.map(f64::to_bits), whole)
    };
    let places: BTreeMap<_, u32> = (0..b.entities.len() as u32).map(|place| (key(other, b, place), place)).collect();
    assert_eq!(places.len(), b.entities.len(), "{told}: entities are told apart");
    for place in 0..a.entities.len() as u32 {
        let back_place = places[&key(one, a, place)];
        let (entity, back) = (&a.entities[place as usize], &b.entities[back_place as usize]);
        let ages = |entity: &Entity| (entity.birth, entity.death, entity.dead, entity.index, entity.link);
        assert_eq!(ages(entity), ages(back), "{told} {place}");
        assert_eq!(bearer(one, a, place), bearer(other, b, back_place), "{told} {place}: bearer");
        let whole =
            |of: &Description, plant: &Individual, entity: &Entity| entity.complex.map(|at| name(of, plant, at));
        assert_eq!(whole(one, a, entity), whole(other, b, back), "{told} {place}: whole");
        let (Some(seen), Some(again)) = (entity.latest(), back.latest()) else {
            assert!(entity.latest().is_none() && back.latest().is_none(), "{told} {place}");
            continue;
        };
        near(&format!("{told} {place}"), seen, again);
        assert_eq!(kinds(one, entity), kinds(other, back), "{told} {place}");
    }
}

/// The features of an entity, by name.
fn kinds(of: &Description, entity: &Entity) -> BTreeMap<String, String> {
    let values = entity.latest().map_or(&[][..], |seen| &seen.values).iter();
    values.map(|(feature, value)| (of.features[*feature as usize].name.clone(), format!("{value:?}"))).collect()
}

/// Total length of the wood of a plant and its volume, of truncated cones.
fn sums(of: &Description) -> (f64, f64) {
    let wood = of.individuals[0].entities.iter().filter(|entity| of.role_of(entity) == Role::Internode);
    wood.filter_map(Entity::latest).fold((0.0, 0.0), |(length, volume), seen| {
        let (l, a) = (seen.length.unwrap(), seen.base_diameter.unwrap() / 2.0);
        let b = seen.tip_diameter.unwrap() / 2.0;
        (length + l, volume + std::f64::consts::PI * l * (a * a + a * b + b * b) / 3.0)
    })
}

#[test]
fn plants_come_back_from_opf_and_from_cylinders() {
    for name in species() {
        let plant = plant_of(name);
        let (file, losses) = written(&plant, "opf");
        assert!(losses.told().is_empty(), "{name}: {losses:?}");
        let back = read(&file, "opf");
        same(name, &plant, &back);
        assert!(written(&back, "opf").0 == file, "{name}: a second trip gives other bytes");
        let (length, volume) = sums(&plant);
        for format in ["treeqsm", "treeqsm15", "rtwig"] {
            let (file, _) = written(&plant, format);
            let back = read(&file, format);
            let (l, v) = sums(&back);
            assert!((l / length - 1.0).abs() < 1e-9 && (v / volume - 1.0).abs() < 1e-9, "{name} {format}: {l} {v}");
            assert!(written(&back, format).0 == file, "{name} {format}: a second trip gives other bytes");
            orders(name, &plant, &back);
        }
    }
}

/// Orders of internodes by their length, as the topology of each description tells them.
fn orders(told: &str, one: &Description, other: &Description) {
    let of = |of: &Description| {
        let plant = &of.individuals[0];
        let axis = |place: u32| plant.within(place, |known| of.role_of(known) == Role::Axis);
        let mut orders: Vec<(u64, u32)> = Vec::new();
        for place in (0..plant.entities.len() as u32)
            .filter(|place| of.role_of(&plant.entities[*place as usize]) == Role::Internode)
        {
            let (mut order, mut at) = (0, axis(place));
            while let Some(bearer) = at.and_then(|axis| plant.entities[axis as usize].bearer) {
                order += 1;
                at = axis(bearer);
            }
            let length = plant.entities[place as usize].latest().and_then(|seen| seen.length).unwrap_or_default();
            orders.push((length.to_bits(), order));
        }
        orders.sort_unstable();
        orders
    };
    assert_eq!(of(one), of(other), "{told}");
}

#[test]
fn a_plot_becomes_a_scene_and_comes_back() {
    let folder = tempdir().unwrap();
    let said = run(folder.path(), &["convert", "wall", "scene.ops", "--plot", "--age", "20"]).ending(0).stdout;
    assert!(said.contains("scene.ops"), "{said}");
    let mut files = InMemory { main: fs::read(folder.path().join("scene.ops")).unwrap(), ..InMemory::default() };
    for entry in fs::read_dir(folder.path()).unwrap().flatten() {
        files.beside.insert(entry.file_name().into_string().unwrap(), fs::read(entry.path()).unwrap());
    }
    let plot = read(&files, "ops");
    assert!(plot.individuals.len() > 1);
    assert_eq!(files.beside.len(), plot.individuals.len() + 1, "an OPF file a plant");
    let places: Vec<[f64; 3]> = plot.individuals.iter().filter_map(|plant| plant.standing).map(|at| at.place).collect();
    assert!(places.len() == plot.individuals.len() && places.windows(2).all(|two| two[0] != two[1]), "{places:?}");
    let (mut again, _) = written(&plot, "ops");
    for (name, bytes) in std::mem::take(&mut again.beside) {
        assert!(files.beside[&name.replace("plant_", "scene_")] == bytes, "{name}");
    }
    // A mesh of the plot holds its plants where they stand.
    run(folder.path(), &["convert", "scene.ops", "plot.obj"]).ending(0);
    let mesh = fs::read_to_string(folder.path().join("plot.obj")).unwrap();
    assert_eq!(mesh.lines().filter(|line| line.starts_with("o ")).count(), plot.individuals.len());
    assert!(folder.path().join("plot.mtl").exists());
}

/// Python with the independent readers; `None` where it is not there.
fn python() -> Option<PathBuf> {
    let python = Path::new(env!("CARGO_MANIFEST_DIR")).join(".venv/bin/python");
    if python.exists() {
        return Some(python);
    }
    assert!(std::env::var_os("CI").is_none(), "{} is missing", python.display());
    eprintln!("skipped: no {}", python.display());
    None
}

fn told_by(python: &Path, script: &str, file: &Path) -> serde_json::Value {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/readers").join(script);
    let done = Command::new(python).arg(script).arg(file).output().expect("python runs");
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    serde_json::from_slice(&done.stdout).unwrap()
}

/// The largest difference between two boxes.
fn apart(a: &serde_json::Value, b: &serde_json::Value) -> f64 {
    let number = |of: &serde_json::Value, end: &str, k: usize| of[end][k].as_f64().unwrap();
    let ends = [("low", 0), ("low", 1), ("low", 2), ("high", 0), ("high", 1), ("high", 2)];
    ends.into_iter().map(|(end, k)| (number(a, end, k) - number(b, end, k)).abs()).fold(0.0, f64::max)
}

#[test]
fn other_readers_find_what_was_written() {
    let Some(python) = python() else { return };
    let folder = tempdir().unwrap();
    // Young plants, since the readers take minutes for a hundred thousand meshes.
    for (name, age) in [("coffee", 30), ("bamboo", 12), ("oil_palm", 96), ("halle/leeuwenberg", 8)] {
        let plant = plant_at(name, Some(age));
        let (opf, obj) = (folder.path().join("plant.opf"), folder.path().join("plant.obj"));
        fs::write(&opf, written(&plant, "opf").0.main).unwrap();
        let (mesh, _) = written(&plant, "obj");
        fs::write(&obj, &mesh.main).unwrap();
        fs::write(folder.path().join("plant.mtl"), &mesh.beside["plant.mtl"]).unwrap();
        let told = told_by(&python, "opf.py", &opf);
        let count =
            |role: Role| plant.individuals[0].entities.iter().filter(|entity| plant.role_of(entity) == role).count();
        for (class, role) in
            [("Individual", Role::Plant), ("Axis", Role::Axis), ("Internode", Role::Internode), ("Leaf", Role::Leaf)]
        {
            assert_eq!(told["classes"][class].as_u64().unwrap_or(0), count(role) as u64, "{name} {class}");
        }
        let seen = || plant.individuals[0].entities.iter().filter_map(Entity::latest);
        let length: f64 = seen().filter_map(|seen| seen.length).sum();
        let area: f64 = seen().filter_map(|seen| seen.area).sum();
        let sum = |what: &str| told["sums"][what].as_f64().unwrap_or(0.0);
        assert!((sum("Length") / 100.0 / length - 1.0).abs() < 1e-9, "{name}");
        assert!((sum("Area") / 10_000.0 - area).abs() <= 1e-9 * area, "{name}");
        let meshes = told_by(&python, "obj.py", &obj);
        let triangles = mesh.main.split(|byte| *byte == b'\n').filter(|line| line.starts_with(b"f ")).count() as u64;
        for reader in ["trimesh", "open3d"] {
            assert_eq!(meshes[reader]["triangles"].as_u64(), Some(triangles), "{name} {reader}");
            assert!(apart(&meshes[reader], &told) < 2e-6, "{name} {reader}: {} {told}", meshes[reader]);
        }
        let areas = ["trimesh", "open3d"].map(|reader| meshes[reader]["area"].as_f64().unwrap());
        assert!((areas[0] / areas[1] - 1.0).abs() < 1e-5, "{name}: {areas:?}");
    }
}
