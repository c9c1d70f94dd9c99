//! A small plant that is written by hand: what its files say.

#[path = "../../life/src/specimen.rs"]
mod specimen;

use super::*;
use crate::course::State;
use glam::Vec3;
use phytomer_life::{Life, Maker, Model, Nearness, What};
use phytomer_meshes::{MeshOptions, Scene};
use phytomer_sim::Tick;
use phytomer_sim::plant::{NewAxis, NewNode, NodeId, Plant};
use phytomer_sim::pose::pose;
pub use specimen::plant;
use specimen::unposed;

/// Its life.
pub fn life(plant: &Plant, ages: impl IntoIterator<Item = Tick>) -> Life {
    let mut maker = Maker::new(Nearness::of(1e-3), &MeshOptions::default());
    ages.into_iter().for_each(|age| maker.show(plant, age));
    maker.finish()
}

fn written(encoding: Encoding, organs: Organs) -> Vec<u8> {
    let plant = plant();
    let asked = Asked { encoding, organs, words: "a \"plant\"".to_owned(), pictures: Default::default() };
    let mut out = Vec::new();
    let lives = [life(&plant, 0..=6)];
    let (options, members) = ([MeshOptions::default()], [Member::default()]);
    let plants = Plants::of(&lives, &options, &members);
    write_life(&asked, &plants, 1e-3, &Pace { a_tick: 1.0, a_second: 24.0 }, &mut out).expect("memory");
    out
}

#[test]
fn a_life_as_text_says_what_it_is() {
    let text = String::from_utf8(written(Encoding::Text, Organs::Instances)).expect("a text");
    for line in [
        "#usda 1.0",
        "    defaultPrim = \"plant\"",
        "    doc = \"a \\\"plant\\\"\"",
        "    endTimeCode = 6",
        "    upAxis = \"Z\"",
        "def Xform \"plant\"",
        "        rel prototypes = [</plant/organs/models/leaf_0>, </plant/organs/models/leaf_1>, </plant/organs/models/leaf_2>]",
        "            0.999: [0],",
        "        rel material:binding = </plant/materials/wood>",
    ] {
        assert!(text.lines().any(|found| found == line), "{line}\n{text}");
    }
    assert_eq!(text.matches('{').count(), text.matches('}').count());
    let merged = String::from_utf8(written(Encoding::Text, Organs::Merged)).expect("a text");
    assert!(!merged.contains("PointInstancer") && merged.contains("def Mesh \"organs\""));
}

/// The header of the zip is filled so that the layer begins at 64; the sum is that of the layer.
#[test]
fn a_package_is_a_zip_of_one_binary_layer() {
    let (package, layer) =
        (written(Encoding::Package, Organs::Instances), written(Encoding::Binary, Organs::Instances));
    assert_eq!((&package[..4], &layer[..8]), (&b"PK\x03\x04"[..], &b"PXR-USDC"[..]));
    assert_eq!(package[64..64 + layer.len()], layer);
    let number = |at: usize| u32::from_le_bytes([0, 1, 2, 3].map(|k| package[at + k]));
    assert_eq!((number(14), number(18), number(22)), (crc32fast::hash(&layer), layer.len() as u32, layer.len() as u32));
    let end = package.len() - 22;
    assert_eq!((&package[end..end + 4], number(end + 16) as usize), (&b"PK\x05\x06"[..], 64 + layer.len()));
    assert_eq!(package[64 + layer.len()..][..4], *b"PK\x01\x02");
    let contents = u64::from_le_bytes(layer[16..24].try_into().expect("eight bytes")) as usize;
    assert_eq!((layer[contents], &layer[contents + 8..contents + 14]), (6, &b"TOKENS"[..]));
}

/// A model that is placed has the vertices of the scene.
#[test]
fn a_placed_model_is_the_organ_of_the_mesh() {
    let plant = plant();
    let life = life(&plant, 3..=3);
    let part = &life.parts[0];
    let What::Organ(form) = part.what else { panic!("a leaf") };
    let model = Model::of_form(&MeshOptions::default(), form, part.fullness, [[0; 3]; 2]);
    let pose = life.pose_at(part, 3.0);
    let [h, up] = [pose.heading, pose.up].map(Vec3::from_array);
    let mut mesh = phytomer_meshes::Mesh::default();
    let scene = Scene::new(&plant, 3, &MeshOptions::default());
    scene.block(scene.blocks() - 1, &mut mesh);
    assert_eq!(mesh.vertices.len(), model.mesh.vertices.len());
    for (expected, vertex) in mesh.vertices.iter().zip(&model.mesh.vertices) {
        let [x, y, z] = model.at(vertex.position(), pose.size, part.fullness);
        let at = Vec3::from_array(pose.base) + x * h + y * up.cross(h) + z * up;
        assert!((at - Vec3::from_array(expected.position())).length() < 1e-6);
    }
}

/// A shoot of the trunk's last node grows out of its end, and a leaf with it.
#[test]
fn what_is_to_come_waits_at_the_end_of_what_bears_it() {
    let mut plant = unposed();
    let bearer = NodeId(5);
    let axis = plant.add_axis(NewAxis {
        bearer: Some(bearer),
        order: 2,
        insertion: 1.2,
        appearance: 6,
        birth: 6,
        ..NewAxis::OF_THE_SEED
    });
    let node =
        NewNode { parent: bearer, axis, birth: 6, rank: 1, length: 0.2, diameter: 0.01, ..NewNode::OF_THE_TRUNK };
    plant.add_node(node);
    pose(&mut plant, 6);
    let lives = [life(&plant, 1..=6)];
    let course = Course::of(&lives[0].ages, &lives, &Pace { a_tick: 1.0, a_second: 24.0 });
    let skeleton = Skeleton::of(&lives[0], &course);
    let shoot = lives[0].lines.iter().find(|line| line.order == 2).expect("a shoot");
    let state = course.states.iter().find(|state| state.age == 4 && course.spans[state.span].last == 5);
    let state = *state.expect("the last span begins at 5");
    let places: Vec<_> = skeleton.members(shoot, state.span).map(|at| skeleton.place(at, state, false)).collect();
    // At 5 the trunk has five internodes of 0.1 m.
    assert!(places.len() == 2 && places.iter().all(|at| (at.z - 0.5).abs() < 1e-5 && at.w == 0.0), "{places:?}");
    let later = State { age: 5, ..state };
    let tip = skeleton.members(shoot, state.span).map(|at| skeleton.place(at, later, false)).last().expect("a tip");
    assert!((tip.truncate() - Vec3::Z * 0.6).length() > 0.19, "{tip}");
}
