//! Meshes of plants that state more than insertion and trend: rest frames, outlines, looks of single nodes, lengths by
//! age and cuts.
//!
//! Areas and heights are compared with closed forms. Absent: plants without such statements (`tests`).

use super::measure::{assert_unit_normals, surface};
use super::tests::specimen;
use super::*;
use phytomer_looks::{Bark, InternodePaint, OrganPaint, Paints};
use phytomer_sim::between::Between;
use phytomer_sim::model::Growth;
use phytomer_sim::plant::*;
use phytomer_sim::pose::{node_frame, pose};
use phytomer_sim::rotation::Rotation;
use phytomer_sim::shed::shed;
use std::sync::Arc;

const LAST: Tick = 100;

fn meshed(plant: &Plant) -> Mesh {
    let mesh = mesh_plant(plant, LAST, &MeshOptions::default());
    let counts = Scene::new(plant, LAST, &MeshOptions::default()).counts();
    assert_eq!((counts.vertices, counts.faces), (mesh.vertices.len() as u64, mesh.faces.len() as u64));
    assert_unit_normals(&mesh.vertices);
    mesh
}

/// A plant without falls.
fn standing() -> Plant {
    let mut plant = specimen();
    plant.axes.death.fill(phytomer_sim::NEVER);
    plant.axes.shed.fill(phytomer_sim::NEVER);
    plant.organs.death.fill(phytomer_sim::NEVER);
    plant
}

#[test]
fn a_plant_of_stated_frames_has_the_mesh_of_insertion_and_trend() {
    let plant = standing();
    let mut stated = plant.clone();
    for node in (0..plant.nodes.len() as u32).map(NodeId) {
        let ground = phytomer_sim::pose::Frame { base: [0.0; 3], heading: [0.0, 0.0, 1.0], up: [1.0, 0.0, 0.0] };
        let bearer = plant.nodes.parent[node.index()].some().map_or(ground, |parent| node_frame(&plant, parent));
        let left = super::tube::cross(bearer.up, bearer.heading);
        let local = |v: [f32; 3]| {
            [bearer.heading, left, bearer.up].map(|axis| (0..3).map(|k| f64::from(axis[k]) * f64::from(v[k])).sum())
        };
        let frame = plant.frames.at(node);
        stated.state_rest(node, Rest::Turned(Rotation::to(local(frame.heading), local(frame.up))));
    }
    stated.axes.insertion.fill(2.0);
    stated.nodes.trend.fill(0);
    stated.frames.clear();
    pose(&mut stated, LAST);
    let (one, other) = (meshed(&plant), meshed(&stated));
    assert_eq!(one.faces, other.faces);
    for (a, b) in one.vertices.iter().zip(&other.vertices) {
        let (a, b) = (a.position(), b.position());
        assert!((0..3).all(|k| (a[k] - b[k]).abs() < 1e-5), "{a:?} {b:?}");
    }
}

/// An L of three squares with sides of a decimetre, half expanded: a quarter of 0.03 m², in the polygon's own plane.
#[test]
fn an_outlined_organ_is_its_polygon() {
    let mut plant = standing();
    let expanding = OrganLook { expansion: vec![0.5], ..OrganLook::default() };
    let looks = Looks { organs_apart: vec![expanding], ..plant.habit.looks.clone() };
    plant.habit = Arc::new(Habit { looks, ..(*plant.habit).clone() });
    let organ = OrganId(0);
    let outline = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    plant.state_outline(organ, &outline.map(|[x, y]| [0.1 * x, 0.1 * y, 0.0]));
    plant.give_organ_look(organ, 0);
    let mesh = meshed(&plant);
    let component = plant.organs.component[0] as i32;
    let of = |vertex: &&Vertex| vertex.tag().component == component;
    let vertices: Vec<Vertex> = mesh.vertices.iter().filter(of).copied().collect();
    let faces = mesh.faces.iter().filter(|face| of(&&mesh.vertices[face.indices()[0] as usize]));
    let faces: Vec<Face> = faces.copied().collect();
    assert_eq!((vertices.len(), faces.len()), (6, 4));
    let area = surface(&mesh.vertices, &faces);
    assert!((area / 0.0075 - 1.0).abs() < 1e-4, "{area}");
    assert!((area / plant.organ_area::<f64>(organ, LAST) - 1.0).abs() < 1e-4);
    let mut block = Mesh::default();
    let scene = Scene::new(&plant, LAST, &MeshOptions::default());
    let mut all = Vec::new();
    (0..scene.blocks()).for_each(|number| {
        scene.block(number, &mut block);
        all.extend_from_slice(&block.vertices);
    });
    assert!(all == mesh.vertices, "blocks and chunks draw the same");
}

#[test]
fn single_nodes_are_drawn_with_their_own_look_and_kind() {
    let mut plant = standing();
    let petal = InternodeLook { kind: Kind::PetalInternode, ..InternodeLook::of_shape(Shape::Blade) };
    let looks = Looks { apart: vec![petal], ..plant.habit.looks.clone() };
    plant.habit = Arc::new(Habit { looks, ..(*plant.habit).clone() });
    let before = meshed(&plant);
    plant.give_look(NodeId(2), 0);
    let after = meshed(&plant);
    assert_eq!(before.vertices.len() - after.vertices.len(), 34 - 4);
    let petals = after.vertices.iter().filter(|vertex| vertex.tag().kind == Kind::PetalInternode as u8).count();
    assert_eq!(petals, 4);
}

#[test]
fn internodes_are_drawn_as_long_as_they_are_at_the_age_and_what_is_cut_is_not() {
    let mut plant = standing();
    let full = meshed(&plant);
    let mut looks = plant.habit.looks.clone();
    looks.internodes.iter_mut().for_each(|look| look.expansion = vec![0.5]);
    plant.habit = Arc::new(Habit { looks, ..(*plant.habit).clone() });
    plant.frames.clear();
    pose(&mut plant, LAST);
    let half = meshed(&plant);
    // The trunk is the first to be drawn: five tubes, straight up.
    let height = |mesh: &Mesh| mesh.vertices[..5 * 34].iter().map(|v| v.position()[2]).fold(0.0, f32::max);
    assert!((height(&full) - 0.5).abs() < 1e-6 && (height(&half) - 0.25).abs() < 1e-6);
    plant.cut(AxisId::TRUNK, 3, 50);
    shed(&mut plant);
    let topped = meshed(&plant);
    let drawn = |node: usize| {
        let component = plant.nodes.component[node] as i32;
        topped.vertices.iter().any(|vertex| vertex.tag().component == component)
    };
    let on_trunk = [0, 1, 2, 3, 4].map(drawn);
    assert_eq!(on_trunk, [true, true, true, false, false]);
    assert_eq!(topped.vertices.len(), 6 * 34, "the trunk's three, the branch's three, and no organ");
}

/// What a model gives another look at the next tick goes from the one colour to the other.
#[test]
fn colours_that_are_written_anew_go_linearly_from_tick_to_tick() {
    let mut paints = Paints::default();
    let colours = [[200, 0, 0], [0, 0, 100]];
    let apart = colours.map(|colour| {
        let bark = Bark { shoot: Some(colour), young: Some(colour), old: Some(colour), ..Bark::default() };
        let paint = paints.add_internode(InternodePaint { bark, ..InternodePaint::default() });
        InternodeLook { paint, ..InternodeLook::of_shape(Shape::Cone) }
    });
    let organs_apart = colours.map(|colour| {
        let paint = OrganPaint { young: Some(colour), old: Some(colour), ..OrganPaint::default() };
        OrganLook { paint: paints.add_organ(paint), ..OrganLook::default() }
    });
    let mut before = standing();
    let looks = Looks { apart: apart.to_vec(), organs_apart: organs_apart.to_vec(), ..before.habit.looks.clone() };
    before.habit = Arc::new(Habit { looks, for_drawing: paints.into_habit(), ..(*before.habit).clone() });
    let mut after = before.clone();
    for (place, plant) in (0..).zip([&mut before, &mut after]) {
        plant.give_look(NodeId(1), place);
        plant.give_organ_look(OrganId(2), place);
    }
    let mut between = Between::new(&before, &after, LAST, Growth::Rewrites, false);
    for (share, expected) in [(0.25, [150, 0, 25]), (0.5, [100, 0, 50]), (0.75, [50, 0, 75])] {
        let plant = between.at(share);
        let mesh = mesh_plant(plant, LAST, &MeshOptions::default());
        let of = |component: u32| {
            let own = mesh.vertices.iter().map(Vertex::tag).filter(|tag| tag.component == component as i32);
            own.map(|tag| [tag.colour[0], tag.colour[1], tag.colour[2]]).collect::<Vec<_>>()
        };
        let organ = of(plant.organs.component[2]);
        assert!(organ.contains(&expected), "{organ:?} at {share}");
        let wood = of(plant.nodes.component[1]);
        assert!(!wood.is_empty() && wood.iter().all(|colour| *colour == expected), "{wood:?} at {share}");
    }
}
