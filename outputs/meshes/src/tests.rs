//! Meshes of a small plant with every form: drawn, written to files and read back by ply-rs-bw.
//!
//! Sizes, volumes and areas are compared with closed forms. Absent: plants that state frames or outlines
//! (`tests_stated`).

use super::measure::{assert_unit_normals, volume};
use super::*;
use phytomer_looks::FormName;
use phytomer_sim::plant::*;
use phytomer_sim::pose::pose;
use ply_rs_bw::parser::Parser;
use ply_rs_bw::ply::{DefaultElement, Property};
use sha2::{Digest, Sha256};
use std::sync::Arc;

const FORMS: [(FormName, Kind); 8] = [
    (FormName::Elliptic, Kind::Leaf),
    (FormName::Lanceolate, Kind::Leaf),
    (FormName::Deltoid, Kind::Leaf),
    (FormName::Needle, Kind::Leaf),
    (FormName::Palm, Kind::Leaf),
    (FormName::Corolla, Kind::Flower),
    (FormName::Berry, Kind::Fruit),
    (FormName::Cone, Kind::Fruit),
];

fn add_axis(plant: &mut Plant, bearer: Option<NodeId>, nodes: u32) -> Vec<NodeId> {
    let (azimuth, insertion) = if bearer.is_some() { (1.0, 1.1) } else { (0.0, 0.0) };
    let axis = plant.add_axis(NewAxis {
        bearer,
        order: 1 + u8::from(bearer.is_some()),
        origin: Origin::Axillary,
        azimuth,
        insertion,
        ..NewAxis::OF_THE_SEED
    });
    let mut parent = bearer.unwrap_or(NodeId::NONE);
    let mut add = |rank: u32| {
        parent = plant.add_node(NewNode {
            parent,
            axis,
            birth: rank,
            rank,
            short: rank.is_multiple_of(3),
            length: 0.1,
            diameter: 0.03,
            ..NewNode::OF_THE_TRUNK
        });
        plant.nodes.diameter_tip[parent.index()] = 0.02;
        parent
    };
    (1..=nodes).map(&mut add).collect()
}

/// An age at which every node of a specimen exists.
pub const LAST: Tick = 20_000;

fn add_organ(plant: &mut Plant, node: NodeId, position: u16) {
    let (form, kind) = FORMS[usize::from(position) % FORMS.len()];
    plant.add_organ(NewOrgan {
        node,
        kind,
        position,
        birth: 2,
        death: if form == FormName::Deltoid { 4 } else { 30 },
        cause: Cause::LifeLength,
        form: form.form(),
        length: 0.12,
        width: 0.05,
        area: 0.004,
        azimuth: 0.8 * f32::from(position),
        insertion: 1.0,
    });
}

/// A trunk of 5 nodes with a branch that dies at 4 and falls at 8, and an organ of each form at its top.
pub fn specimen() -> Plant {
    let trend = Trend { inclination: 0.0, share: 0.1 };
    let habit = Habit { trends: vec![trend], looks: Looks::of_shape(Shape::Cone), ..Habit::default() };
    let seed = Seed { plant: 7, draws: 7, run_seed: 42, component_limit: 1000, keep_events: false };
    let mut plant = Plant::new(&seed, Arc::new(habit));
    let trunk = add_axis(&mut plant, None, 5);
    add_axis(&mut plant, Some(trunk[2]), 3);
    plant.axes.death[1] = 4;
    plant.axes.shed[1] = 8;
    (0..8).for_each(|position| add_organ(&mut plant, trunk[4], position));
    pose(&mut plant, LAST);
    plant
}

fn written(plant: &Plant, age: Tick, options: &MeshOptions) -> Vec<u8> {
    let scene = Scene::new(plant, age, options);
    let mut bytes = Vec::new();
    Ply.write(&scene, &scene.about(42), &mut bytes).unwrap();
    bytes
}

fn read(bytes: &[u8]) -> (Vec<DefaultElement>, Vec<DefaultElement>) {
    let mut ply = Parser::<DefaultElement>::new().read_ply(&mut &bytes[..]).unwrap();
    (ply.payload.swap_remove("vertex").unwrap(), ply.payload.swap_remove("face").unwrap())
}

fn floats(element: &DefaultElement, names: &[&str]) -> Vec<f32> {
    let float = |name: &&str| match element[*name] {
        Property::Float(x) => x,
        ref other => panic!("{name} is {other:?}"),
    };
    names.iter().map(float).collect()
}

/// Wherever a plant stands, its vertices are relative to its seed. Only the header states the place, in decimals that
/// read back as the same numbers.
#[test]
fn a_place_is_a_comment_and_nothing_else() {
    let mut plant = specimen();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let home = written(&plant, 6, &MeshOptions::default());
    assert!(text(&home).contains("\ncomment place_m 0.0 0.0 0.0\n"));
    plant.place = [999_000.0, 0.1 + 0.2, -1e-300];
    pose(&mut plant, LAST);
    let away = written(&plant, 6, &MeshOptions::default());
    let told = "comment place_m 999000.0 0.30000000000000004 -1e-300\n";
    let at = text(&away[..1000]).find(told).expect("the place");
    let rest = at + told.len();
    assert_eq!(away[..at], home[..at]);
    assert_eq!(away[rest..], home[at + "comment place_m 0.0 0.0 0.0\n".len()..]);
}

#[test]
fn ply_rs_reads_back_every_value() {
    let plant = specimen();
    let mesh = mesh_plant(&plant, 6, &MeshOptions::default());
    let (vertices, faces) = read(&written(&plant, 6, &MeshOptions::default()));
    assert_eq!((vertices.len(), faces.len()), (mesh.vertices.len(), mesh.faces.len()));
    for (element, vertex) in vertices.iter().zip(&mesh.vertices) {
        let Tag { colour, birth, death, component, kind } = vertex.tag();
        assert_eq!(floats(element, &["x", "y", "z"]), vertex.position());
        assert_eq!(floats(element, &["nx", "ny", "nz"]), vertex.normal());
        assert_eq!(floats(element, &["s", "t"]), vertex.texture());
        assert_eq!(floats(element, &["birth_age", "death_age"]), [birth, death]);
        let channels = ["red", "green", "blue", "alpha"].map(|name| element[name].clone());
        assert_eq!(channels, colour.map(Property::UChar));
        assert_eq!(element["component_id"], Property::Int(component));
        assert_eq!(element["kind"], Property::UChar(kind));
    }
    for (element, face) in faces.iter().zip(&mesh.faces) {
        assert_eq!(element["vertex_indices"], Property::ListInt(face.indices().map(|i| i as i32).to_vec()));
    }
}

/// Each vertex has the colour that is stated for its component; those without one keep theirs.
#[test]
fn stated_colours_replace_those_of_kind_and_age() {
    let plant = specimen();
    let plain = mesh_plant(&plant, 6, &MeshOptions::default());
    let colours: Vec<[u8; 3]> = (0..plant.components() as u8 - 1).map(|component| [component, 0, 7]).collect();
    let stated = MeshOptions { colours: Some(Arc::new(colours.clone())), ..MeshOptions::default() };
    let coloured = mesh_plant(&plant, 6, &stated);
    assert_eq!(plain.faces, coloured.faces);
    for (before, after) in plain.vertices.iter().zip(&coloured.vertices) {
        let (before, after) = (before.tag(), after.tag());
        let own = colours.get(after.component as usize).map_or(before.colour, |[r, g, b]| [*r, *g, *b, 255]);
        assert_eq!((after.component, after.colour), (before.component, own));
    }
}

#[test]
fn a_component_is_drawn_while_it_stands() {
    let plant = specimen();
    let standing = |age| {
        let mesh = mesh_plant(&plant, age, &MeshOptions::default());
        let counts = Scene::new(&plant, age, &MeshOptions::default()).counts();
        assert_eq!((counts.vertices, counts.faces), (mesh.vertices.len() as u64, mesh.faces.len() as u64));
        assert!(mesh.faces.iter().flat_map(Face::indices).all(|index| (index as usize) < mesh.vertices.len()));
        assert_unit_normals(&mesh.vertices);
        let mut components: Vec<Tag> = mesh.vertices.iter().map(Vertex::tag).collect();
        components.dedup_by_key(|tag| tag.component);
        assert_eq!(components.len() as u64, counts.components);
        components
    };
    let count = [0, 1, 2, 3, 6, 8, 30].map(|age| standing(age).len());
    assert_eq!(count, [0, 2, 12, 14, 15, 12, 5]);
    let dead: Vec<f32> = standing(6).iter().map(|tag| tag.death).filter(|death| death.is_finite()).collect();
    assert_eq!(dead, [4.0, 4.0, 4.0], "the dead branch that still stands");
    assert!(standing(3).iter().all(|tag| tag.death == f32::INFINITY), "no future is told");
}

#[test]
fn kinds_can_be_left_out_and_the_wood_is_closed() {
    let plant = specimen();
    let mut kinds = [false; Kind::ALL.len()];
    kinds[Kind::Internode as usize] = true;
    kinds[Kind::ShortInternode as usize] = true;
    let wood = mesh_plant(&plant, 9, &MeshOptions { sides: 6, kinds, ..MeshOptions::default() });
    assert_eq!((wood.vertices.len(), wood.faces.len()), (5 * 26, 5 * 20));
    super::measure::assert_closed(&wood.vertices[..26], &wood.faces[..20]);
    // Round frusta of 3 and 2 cm, whatever the sides.
    let expected = 5.0 * 0.1 * std::f64::consts::PI / 12.0 * (0.03 * 0.03 + 0.02 * 0.02 + 0.03 * 0.02);
    assert!((volume(&wood.vertices, &wood.faces) / expected - 1.0).abs() < 1e-5);
}

#[test]
fn an_organ_stands_on_the_surface_of_its_stem() {
    let plant = specimen();
    let mesh = mesh_plant(&plant, 9, &MeshOptions::default());
    let leaf = plant.organs.component[0] as i32;
    let at = mesh.vertices.iter().filter(|vertex| vertex.tag().component == leaf).map(Vertex::position);
    let near = at.map(|[x, y, z]| ((x * x + y * y).sqrt() - 0.01).abs() + (z - 0.5).abs()).fold(f32::MAX, f32::min);
    assert!(near < 0.003, "half the width of its stalk: {near}");
}

#[test]
fn the_bytes_are_those_that_were_looked_at() {
    let plant = specimen();
    let bytes = written(&plant, 6, &MeshOptions::default());
    assert_eq!(bytes, written(&plant.clone(), 6, &MeshOptions::default()));
    let payload = bytes.windows(11).position(|window| window == b"end_header\n").unwrap() + 11;
    let hash: String = Sha256::digest(&bytes[payload..]).iter().take(8).map(|byte| format!("{byte:02x}")).collect();
    assert_eq!(hash, "ba7ef9a2d21bcb87");
}

#[test]
fn a_large_mesh_is_the_same_drawn_ahead_of_its_writing() {
    let mut plant = specimen();
    let mut tip = NodeId(4);
    for _ in 0..10 {
        tip = *add_axis(&mut plant, Some(tip), 1000).last().unwrap();
    }
    plant.frames.clear();
    pose(&mut plant, LAST);
    let bytes = written(&plant, 2000, &MeshOptions::default());
    let mesh = mesh_plant(&plant, 2000, &MeshOptions::default());
    let payload: Vec<u8> = [bytemuck::cast_slice(&mesh.vertices), bytemuck::cast_slice(&mesh.faces)].concat();
    assert!(payload.len() > 16 << 20);
    assert!(bytes.ends_with(&payload));
}

struct Full(usize);

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0 = self.0.checked_sub(bytes.len()).ok_or(io::ErrorKind::StorageFull)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_failed_write_is_reported_as_it_was() {
    let mut plant = specimen();
    add_axis(&mut plant, Some(NodeId(4)), 10_000);
    plant.frames.clear();
    pose(&mut plant, LAST);
    let scene = Scene::new(&plant, LAST, &MeshOptions::default());
    for room in [100, 5000, 3 << 20, 15 << 20] {
        let fault = Ply.write(&scene, &scene.about(1), &mut Full(room)).unwrap_err();
        assert_eq!(fault.kind(), io::ErrorKind::StorageFull, "{room}");
    }
}

#[test]
fn files_are_named_by_plant_and_age_and_nothing_is_left_beside_them() {
    let folder = tempfile::tempdir().unwrap();
    let plant = specimen();
    let write = |age| write_mesh(&Ply, &plant, age, 42, &MeshOptions::default(), folder.path()).unwrap();
    let files = [3, 6].map(write);
    let names: Vec<String> = files.iter().map(|file| file.path.file_name().unwrap().display().to_string()).collect();
    assert_eq!(names, ["plant-00007_age-0003.ply", "plant-00007_age-0006.ply"]);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
    let bytes = std::fs::read(&files[1].path).unwrap();
    assert_eq!(bytes, written(&plant, 6, &MeshOptions::default()));
    assert_eq!(files[1].bytes, bytes.len() as u64);
    let missing = write_mesh(&Ply, &plant, 6, 42, &MeshOptions::default(), &folder.path().join("none"));
    assert!(missing.unwrap_err().to_string().starts_with("cannot write "));
}
