//! Wood within a tolerance: how far the full mesh is from the reduced one, and how many triangles that takes.
//!
//! Each corner of the round tubes of single internodes, which are drawn with 64 sides, is compared with the triangles
//! of the reduced mesh, by the distance from a point to a triangle. Absent: how the command line asks for it.

mod near;

use near::Triangles;
use phytomer::config::validate;
use phytomer::outputs::meshes::{Boxing, Mesh, MeshOptions, Scene, Tolerance, Vertex, fitting, mesh_plant};
use phytomer::run::regrowth::Regrowth;
use phytomer::sim::Tick;
use phytomer::sim::plant::{Class, Kind, Plant};

/// The wood of a mesh alone.
fn wood(sides: u8, tolerance: Option<f32>) -> MeshOptions {
    let kinds = Kind::ALL.map(|kind| kind.class() == Class::Internode);
    MeshOptions { sides, kinds, tolerance: tolerance.map(Tolerance::of), ..MeshOptions::default() }
}

/// Shows the first plant of a scenario at an age.
fn show(name: &str, age: Tick, see: &mut dyn FnMut(&Plant)) {
    let resolved = validate(name).unwrap_or_else(|report| panic!("{}", report.render(false)));
    let shown = Regrowth::of(&resolved).show(0, &[age], &mut |_, plant| {
        see(plant);
        Ok(())
    });
    shown.expect("a plant");
}

/// The largest distance of a corner of the full mesh from the reduced one, in tolerances. Of the corners of each ring
/// every sixteenth is looked at.
fn farthest(plant: &Plant, age: Tick, tolerance: f32) -> f32 {
    const SIDES: u8 = 64;
    let reduced = mesh_plant(plant, age, &wood(8, Some(tolerance)));
    let near = Triangles::of(&reduced, 2.5 * tolerance);
    let full = mesh_plant(plant, age, &wood(SIDES, None));
    let ring = usize::from(SIDES) + 1;
    let tube = 4 * usize::from(SIDES) + 2;
    assert_eq!(full.vertices.len() % tube, 0, "tubes alone are expected");
    let corners = full.vertices.chunks(tube).flat_map(|tube| tube[..2 * ring].iter().step_by(16));
    corners.map(|corner| near.distance(corner.position()) / tolerance).fold(0.0, f32::max)
}

#[test]
fn no_corner_of_the_full_mesh_is_farther_than_twice_the_tolerance() {
    for (name, age, tolerance) in [
        ("willow", 12, 5e-4),
        ("willow", 20, 5e-3),
        ("coffee", 10, 1e-3),
        ("fir", 5, 5e-4),
        ("fir", 7, 2e-3),
        ("apple", 6, 1e-3),
        ("cotton", 30, 1e-3),
    ] {
        show(name, age, &mut |plant| {
            let farthest = farthest(plant, age, tolerance);
            assert!(farthest <= 2.0, "{name} at {age} within {tolerance} m: {farthest} tolerances");
            assert!(farthest > 0.3, "{name} at {age} within {tolerance} m: {farthest}, the tolerance is not used");
        });
    }
}

/// The trial: line and radius of each axis simplified by themselves, and as many sides as its thickest point asks for.
#[test]
fn the_willow_of_eleven_years_has_at_most_the_triangles_of_a_plain_trial() {
    show("willow", 92, &mut |plant| {
        let full = Scene::new(plant, 92, &wood(8, None)).counts();
        assert_eq!(full.faces, 2_960_776, "the plant of the trial");
        for (tolerance, most) in [(5e-4, 494_805), (1e-3, 247_990), (2e-3, 122_526), (5e-3, 65_587)] {
            let reduced = Scene::new(plant, 92, &wood(8, Some(tolerance))).counts();
            assert!(reduced.faces <= most, "within {tolerance} m: {} triangles of {most}", reduced.faces);
            assert_eq!(reduced.components, full.components);
        }
        let found = fitting(100_000, |tolerance| {
            let options = MeshOptions { tolerance: Some(*tolerance), ..wood(8, None) };
            Scene::new(plant, 92, &options).counts().faces
        });
        let found = found.expect("it fits").distance;
        assert!((1e-3..3e-3).contains(&found), "100 000 triangles: within {found} m");
    });
}

/// The box of a block is told from few of its vertices, and holds all of them to the bit.
#[test]
fn boxes_of_blocks_are_those_of_their_vertices() {
    for (name, age) in [("willow", 36), ("coffee", 30), ("fir", 6), ("cotton", 40), ("meadow_grass", 9)] {
        show(name, age, &mut |plant| {
            for tolerance in [None, Some(2e-3)] {
                let options = MeshOptions { tolerance: tolerance.map(Tolerance::of), ..MeshOptions::default() };
                let scene = Scene::new(plant, age, &options);
                let (mut boxing, mut mesh) = (Boxing::default(), Mesh::default());
                for block in 0..scene.blocks() {
                    scene.block(block, &mut mesh);
                    let mut all = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
                    for position in mesh.vertices.iter().map(Vertex::position) {
                        all[0] = [0, 1, 2].map(|k| all[0][k].min(position[k]));
                        all[1] = [0, 1, 2].map(|k| all[1][k].max(position[k]));
                    }
                    let told = scene.block_box(block, &mut boxing).map(|corner| corner.to_array());
                    assert_eq!(told, all, "{name} at {age}, block {block}");
                }
            }
        });
    }
}
