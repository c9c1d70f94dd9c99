//! Reduced wood of small plants: closed, of the right volume, in the right order, with the tags of its internodes.
//!
//! The trunk of the specimen steps from 2 cm to 3 cm at each node, its branch has fallen at age 9. How far the mesh of
//! a grown plant is from the full one is tested with whole species (`tests/budget.rs`).

use crate::measure::{assert_closed, assert_unit_normals, outward_share, volume};
use crate::tests::{LAST, specimen};
use crate::{Chunk, Counts, Mesh, MeshOptions, Scene, Tolerance, Vertex, mesh_plant};
use phytomer_sim::plant::{Class, Kind, NodeId, Plant};
use phytomer_sim::pose::pose;

fn within(distance: f32) -> MeshOptions {
    MeshOptions { tolerance: Some(Tolerance::of(distance)), ..MeshOptions::default() }
}

fn wood(distance: f32) -> MeshOptions {
    MeshOptions { kinds: Kind::ALL.map(|kind| kind.class() == Class::Internode), ..within(distance) }
}

/// A trunk of five internodes that narrows from 3 cm to 2 cm, as a straight cone.
fn straight() -> Plant {
    let mut plant = specimen();
    for node in 0..5 {
        let diameter = |place: usize| 0.03 - 0.002 * place as f32;
        plant.nodes.diameter[node] = diameter(node);
        plant.nodes.diameter_tip[node] = diameter(node + 1);
    }
    plant
}

#[test]
fn a_straight_trunk_is_one_closed_tube() {
    let plant = straight();
    let mesh = mesh_plant(&plant, 9, &wood(1e-4));
    let sides = usize::from(super::sides(0.015, 1e-4));
    let upper = usize::from(super::sides(0.010, 1e-4));
    assert!(upper < sides, "fewer towards the tip");
    assert_eq!((mesh.faces.len(), mesh.vertices.len()), (2 * (sides + upper) - 4, 2 * (sides + upper) + 2));
    assert_closed(&mesh.vertices, &mesh.faces);
    assert_unit_normals(&mesh.vertices);
    assert_eq!(outward_share(&mesh.vertices, &mesh.faces), 1.0);
    let expected = 0.5 * std::f64::consts::PI / 12.0 * (0.03 * 0.03 + 0.02 * 0.02 + 0.03 * 0.02);
    // Within the tolerance of the surface the volume is off by at most 2 e/r.
    assert!((volume(&mesh.vertices, &mesh.faces) / expected - 1.0).abs() < 0.02);
    let (first, last) = (mesh.vertices[0], mesh.vertices[sides + 1]);
    assert_eq!([first, last].map(|vertex| vertex.texture()[1]), [0.0, 5.0], "the texture runs once an internode");
    let number = |node: usize| plant.nodes.component[node] as i32;
    assert_eq!([first, last].map(|vertex| vertex.tag().component), [number(0), number(4)]);
}

#[test]
fn steps_of_the_radius_stay_where_they_are_larger_than_the_tolerance() {
    let plant = specimen();
    let mesh = mesh_plant(&plant, 9, &wood(1e-4));
    assert_closed(&mesh.vertices, &mesh.faces);
    let expected = 5.0 * 0.1 * std::f64::consts::PI / 12.0 * (0.03 * 0.03 + 0.02 * 0.02 + 0.03 * 0.02);
    assert!((volume(&mesh.vertices, &mesh.faces) / expected - 1.0).abs() < 0.02);
    let mut tags: Vec<_> =
        mesh.vertices.iter().map(|vertex| (vertex.tag().component, vertex.tag().birth as u32)).collect();
    tags.dedup();
    let nodes = &plant.nodes;
    let expected: Vec<_> = [0, 1, 2, 3, 4, 0, 4].map(|node| (nodes.component[node] as i32, nodes.birth[node])).to_vec();
    assert_eq!(tags, expected, "ring by ring, then the two caps");
    let coarse = mesh_plant(&plant, 9, &wood(6e-3));
    assert!(coarse.faces.len() < mesh.faces.len() / 3, "{} of {}", coarse.faces.len(), mesh.faces.len());
}

/// Counts, what a sink is given and the blocks are one mesh at each tolerance and age; and organs are as ever.
#[test]
fn a_reduced_scene_is_what_it_counts_and_its_blocks_are_the_whole() {
    let plant = specimen();
    for (age, distance) in [0, 1, 3, 6, 9].into_iter().flat_map(|age| [1e-5, 1e-3, 1.0].map(|distance| (age, distance)))
    {
        let scene = Scene::new(&plant, age, &within(distance));
        let mesh = mesh_plant(&plant, age, &within(distance));
        let full = Scene::new(&plant, age, &MeshOptions::default()).counts();
        let counts = scene.counts();
        assert_eq!((counts.vertices, counts.faces), (mesh.vertices.len() as u64, mesh.faces.len() as u64));
        assert_eq!(counts.components, full.components);
        assert!(mesh.faces.iter().flat_map(|face| face.indices()).all(|index| u64::from(index) < counts.vertices));
        assert_unit_normals(&mesh.vertices);
        let (mut vertices, mut faces, mut block) = (Vec::new(), Vec::new(), Mesh::default());
        for number in 0..scene.blocks() {
            scene.block(number, &mut block);
            let first = vertices.len() as u32;
            faces.extend(block.faces.iter().map(|face| face.indices().map(|index| index + first)));
            vertices.extend_from_slice(&block.vertices);
        }
        assert_eq!(vertices, mesh.vertices);
        assert_eq!(faces, mesh.faces.iter().map(|face| face.indices()).collect::<Vec<_>>());
        let organs = |mesh: &Mesh| -> Vec<Vertex> {
            let organ = |vertex: &&Vertex| Kind::ALL[usize::from(vertex.tag().kind)].class() != Class::Internode;
            mesh.vertices.iter().filter(organ).copied().collect()
        };
        assert_eq!(organs(&mesh), organs(&mesh_plant(&plant, age, &MeshOptions::default())));
    }
}

/// What stands in the way of one tube: an internode of another form, a gap, and a turn too sharp for a shared ring.
#[test]
fn a_tube_ends_where_the_next_internode_does_not_go_on() {
    let plain = straight();
    let tubes = |plant: &Plant| {
        let scene = Scene::new(plant, 9, &wood(1e-3));
        let mut chunk = Chunk::new();
        let drawn = scene.vertices(&mut chunk, &mut |_| Ok(()));
        assert!(drawn.is_ok());
        let sides = |radius: f32| u64::from(super::sides(radius, 1e-3));
        (scene.counts(), sides(0.015))
    };
    let (one, sides) = tubes(&plain);
    let mut apart = plain.clone();
    apart.frames.base[2..5].iter_mut().for_each(|base| base[0] += 0.01);
    assert!(tubes(&apart).0.faces > one.faces + 2 * (sides - 4), "a gap");
    let mut turned = plain.clone();
    let base = turned.frames.base[2];
    for (k, node) in (2..5).enumerate() {
        turned.frames.base[node] = [base[0] + 0.1 * k as f32, base[1], base[2]];
        turned.frames.heading[node] = [1.0, 0.0, 0.0];
        turned.frames.up[node] = [0.0, 0.0, 1.0];
    }
    let counts: Counts = tubes(&turned).0;
    assert!(counts.faces > one.faces + 2 * (sides - 4), "a right angle of thick wood");
    let mesh = mesh_plant(&turned, 9, &wood(1e-3));
    assert_closed(&mesh.vertices, &mesh.faces);
    let mut thin = turned.clone();
    thin.nodes.diameter.iter_mut().chain(&mut thin.nodes.diameter_tip).for_each(|diameter| *diameter *= 0.01);
    assert_eq!(tubes(&thin).0.faces, 3 * 4 + 2, "a right angle of thin wood shares its ring");
}

/// Internodes without length or diameter, and a plant of which nothing stands, are no trouble.
#[test]
fn wood_of_no_size_has_unit_normals() {
    let mut plant = specimen();
    plant.nodes.length.fill(0.0);
    pose(&mut plant, LAST);
    assert_unit_normals(&mesh_plant(&plant, 9, &wood(1e-3)).vertices);
    plant.nodes.diameter.fill(0.0);
    plant.nodes.diameter_tip.fill(0.0);
    assert_unit_normals(&mesh_plant(&plant, 9, &wood(1e-3)).vertices);
    assert_eq!(Scene::new(&plant, 0, &wood(1e-3)).counts(), Counts::default());
    assert_eq!(plant.nodes.birth[NodeId(0).index()], 1);
}
