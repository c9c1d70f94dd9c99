//! GLB files of a small plant that is written by hand, read back by a reader of accessors that knows nothing of the
//! writers.
//!
//! A trunk of six internodes, one a tick, has a leaf from tick 2 to 5 and bends at tick 5. Whole species, and readers
//! that are not ours, are in `tests/glb.rs` of the root.

#[path = "../../life/src/specimen.rs"]
mod specimen;

use super::{Body, Growth, KeyMaker, Keyed, write_growth, write_plant_instanced, write_still};
use glam::{Quat, Vec3};
use phytomer_meshes::{
    Counts, Drawing, Face, Flare, Mesh, MeshOptions, OwnForms, PlantDrawing, Scene, Take, Textures, Tolerance, Vertex,
    mesh_plant,
};
use phytomer_sim::Tick;
use phytomer_sim::plant::Plant;
use serde_json::Value;
use specimen::plant;
use std::sync::Arc;

const KEYS: [Tick; 5] = [0, 1, 3, 4, 6];

/// A file in its parts.
struct File {
    json: Value,
    binary: Vec<u8>,
}

impl File {
    fn read(bytes: &[u8]) -> Self {
        let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("a word")) as usize;
        assert_eq!((&bytes[..4], word(4), word(8), &bytes[16..20]), (&b"glTF"[..], 2, bytes.len(), &b"JSON"[..]));
        let end = 20 + word(12);
        assert_eq!(end % 4, 0);
        let json = serde_json::from_slice(&bytes[20..end]).expect("JSON");
        if end == bytes.len() {
            return Self { json, binary: Vec::new() };
        }
        assert_eq!((&bytes[end + 4..end + 8], word(end)), (&b"BIN\0"[..], bytes.len() - end - 8));
        Self { json, binary: bytes[end + 8..].to_vec() }
    }

    fn view(&self, view: &Value) -> (&[u8], Option<usize>) {
        let view = &self.json["bufferViews"][view.as_u64().expect("a view") as usize];
        let number = |name: &str| view[name].as_u64().map(|x| x as usize);
        let from = number("byteOffset").unwrap_or(0);
        assert_eq!(from % 4, 0);
        (&self.binary[from..from + number("byteLength").expect("a length")], number("byteStride"))
    }

    /// The numbers of an accessor, entry by entry.
    fn numbers(&self, accessor: &Value) -> Vec<Vec<f64>> {
        let of = &self.json["accessors"][accessor.as_u64().expect("an accessor") as usize];
        let count = of["count"].as_u64().expect("a count") as usize;
        let width =
            ["SCALAR", "VEC2", "VEC3", "VEC4"].iter().position(|shape| *shape == of["type"]).map_or(16, |k| k + 1);
        let kind = of["componentType"].as_u64().expect("a type");
        let mut all = vec![vec![0.0; width]; count];
        if let Some(view) = of.get("bufferView") {
            let ((bytes, stride), offset) = (self.view(view), of["byteOffset"].as_u64().unwrap_or(0) as usize);
            let stride = stride.unwrap_or(width * size_of(kind));
            all = (0..count).map(|k| scalars(&bytes[offset + k * stride..], kind, width)).collect();
        }
        if let Some(sparse) = of.get("sparse") {
            let kind_of_places = sparse["indices"]["componentType"].as_u64().expect("a type");
            let (places, _) = self.view(&sparse["indices"]["bufferView"]);
            let (values, _) = self.view(&sparse["values"]["bufferView"]);
            for k in 0..sparse["count"].as_u64().expect("a count") as usize {
                let place = scalars(&places[k * size_of(kind_of_places)..], kind_of_places, 1)[0];
                all[place as usize] = scalars(&values[k * width * size_of(kind)..], kind, width);
            }
        }
        if let Some(bounds) = of.get("min").zip(of.get("max")) {
            for k in 0..width {
                let of = |bound: &Value| bound[k].as_f64().expect("a bound");
                let (low, high) = all.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), entry| {
                    (low.min(entry[k]), high.max(entry[k]))
                });
                assert_eq!((of(bounds.0), of(bounds.1)), (low, high), "the bounds of {of:?}", of = accessor);
            }
        }
        all
    }
}

fn size_of(kind: u64) -> usize {
    match kind {
        5120 | 5121 => 1,
        5122 | 5123 => 2,
        _ => 4,
    }
}

fn scalars(bytes: &[u8], kind: u64, width: usize) -> Vec<f64> {
    let size = size_of(kind);
    let one = |bytes: &[u8]| match kind {
        5120 => f64::from(bytes[0] as i8),
        5121 => f64::from(bytes[0]),
        5122 => f64::from(i16::from_le_bytes([bytes[0], bytes[1]])),
        5123 => f64::from(u16::from_le_bytes([bytes[0], bytes[1]])),
        5125 => f64::from(u32::from_le_bytes(bytes[..4].try_into().expect("a word"))),
        _ => f64::from(f32::from_le_bytes(bytes[..4].try_into().expect("a word"))),
    };
    (0..width).map(|k| one(&bytes[k * size..])).collect()
}

fn still(plant: &Plant, age: Tick) -> (File, Mesh) {
    let scene = Scene::new(plant, age, &MeshOptions::default());
    let mut bytes = Vec::new();
    write_still(&PlantDrawing { scene: &scene, about: scene.about(7) }, &mut bytes).expect("written");
    (File::read(&bytes), mesh_plant(plant, age, &MeshOptions::default()))
}

/// Every vertex and triangle of the mesh is there, in the order of the classes, with Y up and its ages and number.
#[test]
fn a_still_has_the_mesh() {
    let plant = plant();
    let (file, mesh) = still(&plant, 4);
    let primitives = file.json["meshes"][0]["primitives"].as_array().expect("primitives");
    assert_eq!(primitives.len(), 2, "wood and leaves");
    let leaf = plant.organs.component[0] as i32;
    let is_leaf = |vertex: &&Vertex| vertex.tag().component == leaf;
    let (leaves, wood): (Vec<&Vertex>, Vec<&Vertex>) = mesh.vertices.iter().partition(is_leaf);
    let mut faces = Vec::new();
    for (primitive, vertices) in primitives.iter().zip([&wood, &leaves]) {
        let numbers = |name: &str| file.numbers(&primitive["attributes"][name]);
        let places: Vec<[f64; 3]> =
            vertices.iter().map(|vertex| vertex.position().map(f64::from)).map(|[x, y, z]| [x, z, -y]).collect();
        assert_eq!(numbers("POSITION"), places.iter().map(|place| place.to_vec()).collect::<Vec<_>>());
        let tags = vertices.iter().map(|vertex| vertex.tag());
        let ages = tags.clone().map(|tag| vec![f64::from(tag.birth)]).collect::<Vec<_>>();
        assert_eq!(numbers("_BIRTH_AGE"), ages);
        assert!(numbers("_DEATH_AGE").iter().all(|age| age[0] == f64::from(f32::MAX)), "all of it lives");
        assert_eq!(numbers("_COMPONENT_ID"), tags.map(|tag| vec![f64::from(tag.component)]).collect::<Vec<_>>());
        let unit = |normal: &Vec<f64>| (normal.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-5;
        assert!(numbers("NORMAL").iter().all(unit));
        let corners: Vec<usize> = file.numbers(&primitive["indices"]).iter().map(|corner| corner[0] as usize).collect();
        faces.extend(corners.chunks_exact(3).map(|face| [0, 1, 2].map(|k| places[face[k]])));
    }
    let of = |face: &phytomer_meshes::Face| {
        face.indices()
            .map(|corner| mesh.vertices[corner as usize].position().map(f64::from))
            .map(|[x, y, z]| [x, z, -y])
    };
    assert_eq!(faces, mesh.faces.iter().map(of).collect::<Vec<_>>(), "wood comes before leaves in the mesh too");
}

/// The leaf is one instance, whose vertices are where the mesh has them; its wood is a mesh as ever.
#[test]
fn a_leaf_is_an_instance_with_its_number_and_its_ages() {
    let plant = plant();
    let scene = Scene::new(&plant, 4, &MeshOptions::default());
    let mut bytes = Vec::new();
    write_plant_instanced(&scene, 1, &mut bytes).expect("memory");
    let file = File::read(&bytes);
    let name = "EXT_mesh_gpu_instancing";
    assert_eq!((&file.json["extensionsUsed"][0], &file.json["extensionsRequired"][0]), (&name.into(), &name.into()));
    let nodes = file.json["nodes"].as_array().expect("nodes");
    let instanced: Vec<&Value> = nodes.iter().filter(|node| node.get("extensions").is_some()).collect();
    assert_eq!((instanced.len(), nodes.len()), (1, 3), "a model, the plant, and the wood");
    let of = |attribute: &str| file.numbers(&instanced[0]["extensions"][name]["attributes"][attribute]);
    let component = plant.organs.component[0];
    assert_eq!((of("_COMPONENT_ID"), of("_BIRTH_AGE")), (vec![vec![f64::from(component)]], vec![vec![2.0]]));
    assert_eq!(of("_DEATH_AGE"), [[f64::from(f32::MAX)]]);
    let vec3 = |of: &[f64]| Vec3::new(of[0] as f32, of[1] as f32, of[2] as f32);
    let (place, turn, scale) = (of("TRANSLATION"), of("ROTATION"), of("SCALE"));
    let turn = Quat::from_xyzw(turn[0][0] as f32, turn[0][1] as f32, turn[0][2] as f32, turn[0][3] as f32);
    let mesh = instanced[0]["mesh"].as_u64().expect("a mesh") as usize;
    let model = file.numbers(&file.json["meshes"][mesh]["primitives"][0]["attributes"]["POSITION"]);
    let whole = mesh_plant(&plant, 4, &MeshOptions::default());
    let leaf: Vec<&Vertex> = whole.vertices.iter().filter(|at| at.tag().component == component as i32).collect();
    assert_eq!(model.len(), leaf.len());
    for (at, vertex) in model.iter().zip(leaf) {
        let there = turn * (vec3(at) * vec3(&scale[0])) + vec3(&place[0]);
        let [x, y, z] = vertex.position();
        assert!((there - Vec3::new(x, z, -y)).length() < 1e-6, "{there} {vertex:?}");
    }
}

#[test]
fn a_seed_is_a_file_without_a_mesh() {
    let (file, _) = still(&plant(), 0);
    assert!(file.json.get("meshes").is_none() && file.json.get("buffers").is_none() && file.binary.is_empty());
}

fn growth(plant: &Plant, bent: &Plant) -> Growth {
    let mut maker = KeyMaker::new(Tolerance::of(1e-3), &MeshOptions::default(), KEYS.len());
    KEYS.iter().enumerate().for_each(|(key, age)| maker.show(key, if *age > 4 { bent } else { plant }, *age));
    Growth {
        bodies: vec![Body { name: "plant".to_owned(), place: [10.0, 20.0, 0.5], keyed: maker.finish() }],
        ages: KEYS.iter().map(|age| *age as f32).collect(),
        seconds: 6.0,
        tolerance: 1e-3,
        note: "a test".to_owned(),
        origin: [0.0; 3],
    }
}

/// The places of a primitive at a key, metres, Z up: those of the mesh and of the target of the key together.
fn places(file: &File, primitive: &Value, key: usize) -> Vec<[f64; 3]> {
    let base = file.numbers(&primitive["attributes"]["POSITION"]);
    let moved = file.numbers(&primitive["targets"][key]["POSITION"]);
    let node = &file.json["nodes"][0];
    let of = |name: &str, k: usize| node[name][k].as_f64().expect("a number");
    let place = |(base, moved): (&Vec<f64>, &Vec<f64>)| {
        let [x, y, z] = [0, 1, 2].map(|k| (base[k] + moved[k]) * of("scale", k) + of("translation", k));
        [x - 10.0, -z - 20.0, y - 0.5]
    };
    base.iter().zip(&moved).map(place).collect()
}

/// At each key a leaf stands as in the mesh of that age, to half a step; before and after it is a point at the tip of
/// its internode, and the wood reaches as high as the plant has grown.
#[test]
fn a_life_stands_at_its_keys_as_the_plant_does() {
    let plant = plant();
    let mut bent = plant.clone();
    for node in 0..6 {
        bent.frames.base[node] = [0.1 * node as f32, 0.0, 0.0];
        (bent.frames.heading[node], bent.frames.up[node]) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
    }
    let mut bytes = Vec::new();
    let written = write_growth(&growth(&plant, &bent), &mut bytes).expect("written");
    let file = File::read(&bytes);
    let [wood, leaves] = [0, 1].map(|k| &file.json["meshes"][0]["primitives"][k]);
    let near = |a: [f64; 3], b: [f64; 3]| (0..3).all(|k| (a[k] - b[k]).abs() <= 0.51 * written.step);
    for (key, age) in KEYS.iter().enumerate() {
        let (leaf, trunk) = (places(&file, leaves, key), places(&file, wood, key));
        let shown = mesh_plant(&plant, *age, &MeshOptions::default());
        let number = plant.organs.component[0] as i32;
        let of_leaf = shown.vertices.iter().filter(|vertex| vertex.tag().component == number);
        let true_leaf: Vec<[f64; 3]> = of_leaf.map(|vertex| vertex.position().map(f64::from)).collect();
        match age {
            3 | 4 => assert!(leaf.len() == true_leaf.len() && leaf.iter().zip(&true_leaf).all(|(a, b)| near(*a, *b))),
            6 => assert!(leaf.iter().all(|at| near(*at, [0.1, 0.0, 0.0])), "it went into the bent stem: {leaf:?}"),
            // A point is not seen: before the key from which it grows it need not follow its stem.
            _ => assert!(leaf.iter().all(|at| near(*at, [0.0, 0.0, 0.1])), "at {age} it is a point: {leaf:?}"),
        }
        let along = if *age > 4 { 0 } else { 2 };
        let top = trunk.iter().map(|at| at[along]).fold(0.0, f64::max);
        assert!((top - 0.1 * f64::from(*age)).abs() <= 0.51 * written.step, "{top} at {age}");
    }
    assert_eq!(file.numbers(&leaves["attributes"]["_BIRTH_AGE"])[0], [2.0]);
    assert_eq!(file.numbers(&leaves["attributes"]["_DEATH_AGE"])[0], [6.0], "the first key without it");
    let animation = &file.json["animations"][0]["samplers"][0];
    assert_eq!(file.numbers(&animation["input"]).concat(), [0.0, 1.0, 3.0, 4.0, 6.0]);
    let weights = file.numbers(&animation["output"]).concat();
    assert!((0..25).all(|k| weights[k] == f64::from(u8::from(k / 5 == k % 5))));
    assert_eq!(file.json["meshes"][0]["weights"], serde_json::json!([0, 0, 0, 0, 1]), "at rest it is the last");
}

/// The flare of a trunk has the same vertices at all keys, and at each is as wide at the ground and ends as high as the
/// species states; tables and wood do not change.
#[test]
fn a_flare_grows_with_its_trunk() {
    let flare = Flare { width: 0.75, height: Some(4.0), lobes: 0, depth: 0.0 };
    let own = Arc::new(OwnForms::default().with(Textures::default(), Some(flare)));
    let options = MeshOptions { own, ..MeshOptions::default() };
    let mut maker = KeyMaker::new(Tolerance::of(1e-4), &options, KEYS.len());
    let mut plant = plant();
    for (key, age) in KEYS.iter().enumerate() {
        plant.nodes.diameter.fill(0.01 * *age as f32);
        plant.nodes.diameter_tip.fill(0.01 * *age as f32);
        maker.show(key, &plant, *age);
    }
    let bodies = vec![Body { name: "plant".to_owned(), place: [10.0, 20.0, 0.5], keyed: maker.finish() }];
    let ages = KEYS.map(|age| age as f32).to_vec();
    let (note, origin) = (String::new(), [0.0; 3]);
    let growth = Growth { bodies, ages, seconds: 2.0, tolerance: 1e-4, note, origin };
    let mut bytes = Vec::new();
    let written = write_growth(&growth, &mut bytes).expect("written");
    let file = File::read(&bytes);
    let wood = &file.json["meshes"][0]["primitives"][0];
    let numbers = file.numbers(&wood["attributes"]["_COMPONENT_ID"]).concat();
    for (key, age) in KEYS.iter().enumerate().skip(1) {
        let radius = 0.005 * f64::from(*age);
        // Half of the trunk at most.
        let high = (8.0 * radius).min(0.05 * f64::from(*age));
        let at = places(&file, wood, key);
        let out = |[x, y, _]: &[f64; 3]| (x * x + y * y).sqrt();
        let widest = at.iter().map(out).fold(0.0, f64::max);
        assert!((widest / (2.5 * radius) - 1.0).abs() < 0.01, "{widest} at {age}");
        let flared = at.iter().filter(|at| out(at) > 1.02 * radius + written.step);
        let top = flared.clone().map(|at| at[2]).fold(0.0, f64::max);
        assert!(top <= high + written.step && top > 0.4 * high && flared.count() > 100, "{top} of {high} at {age}");
    }
    let first = f64::from(plant.nodes.component[0]);
    assert!(
        numbers.iter().filter(|number| **number == first).count() > 200,
        "it has the number of the lowest internode"
    );
}

/// What stands still is moved by no target and is not animated; a body without anything is a node without a mesh.
#[test]
fn obstacles_stand_still() {
    use phytomer_meshes::Solid;
    use phytomer_sim::shape::{Cuboid, Shape};
    let house = Shape::Cuboid(Cuboid::on([5.0, 0.0, 0.0], [2.0, 3.0, 4.0]));
    let mesh = Arc::new(Solid::of(&house).expect("it has an end").obstacle(None));
    let body = |name: &str, keyed| Body { name: name.to_owned(), place: [0.0; 3], keyed };
    let nothing = KeyMaker::new(Tolerance::of(1e-3), &MeshOptions::default(), 5).finish();
    let plant = plant();
    let bodies = vec![body("house", Keyed::still(&[mesh], 5)), body("nothing", nothing)];
    let mut bytes = Vec::new();
    write_growth(&Growth { bodies, ..growth(&plant, &plant) }, &mut bytes).expect("written");
    let file = File::read(&bytes);
    assert!(file.json.get("animations").is_none() && file.json["nodes"][1].get("mesh").is_none());
    let primitive = &file.json["meshes"][0]["primitives"][0];
    assert_eq!(file.numbers(&primitive["attributes"]["POSITION"]).len(), 24);
    for target in primitive["targets"].as_array().expect("targets") {
        assert!(file.json["accessors"][target["POSITION"].as_u64().expect("one") as usize].get("sparse").is_none());
    }
}

/// A sink that is full ends the writing with its error.
#[test]
fn a_full_disk_is_told() {
    struct Full(usize);
    impl std::io::Write for Full {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            self.0 = self.0.checked_sub(bytes.len()).ok_or(std::io::ErrorKind::StorageFull)?;
            Ok(bytes.len())
        }
        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }
    let plant = plant();
    let growth = growth(&plant, &plant);
    let mut whole = Vec::new();
    write_growth(&growth, &mut whole).expect("written");
    for room in [0, 15, 300, whole.len() / 2, whole.len() - 1] {
        let told = write_growth(&growth, &mut Full(room)).expect_err("it is full");
        assert_eq!(told.kind(), std::io::ErrorKind::StorageFull, "{room}");
    }
    assert!(write_growth(&growth, &mut Full(whole.len())).is_ok());
}

/// A file of more than 4 GiB is refused by its counts, before anything is drawn or written.
#[test]
fn a_mesh_that_is_too_large_is_refused_at_once() {
    struct Huge(u64);
    impl Drawing for Huge {
        fn counts(&self) -> Counts {
            Counts { components: 1, vertices: self.0, faces: self.0 }
        }
        fn tolerance(&self) -> Option<Tolerance> {
            None
        }
        fn notes(&self) -> Vec<String> {
            Vec::new()
        }
        fn place(&self) -> [f64; 3] {
            [0.0; 3]
        }
        fn vertices(&self, _: &mut Take<'_, Vertex>) -> std::io::Result<()> {
            panic!("nothing is drawn")
        }
        fn faces(&self, _: &mut Take<'_, Face>) -> std::io::Result<()> {
            panic!("nothing is drawn")
        }
    }
    for vertices in [1 << 27, 1 << 31, 1 << 32, 1 << 40] {
        let mut bytes = Vec::new();
        let told = write_still(&Huge(vertices), &mut bytes).expect_err("too large").to_string();
        assert!(told.contains(&format!("{} bytes, and its format holds at most 4294967295", vertices * 64)), "{told}");
        assert!(bytes.is_empty());
    }
    for vertices in [1_u64 << 31, 1 << 32] {
        let mut bytes = Vec::new();
        let told = phytomer_meshes::write_stl(&Huge(vertices), &mut bytes).expect_err("too large").to_string();
        assert!(told.contains("an STL file holds at most 4294967295 and 2147483647") && bytes.is_empty(), "{told}");
    }
}
