//! The willow of eleven years within a tolerance: triangles, the time of writing, the farthest corner of the full mesh
//! from the reduced one, and the time of its picture with tubes of single internodes and within half a pixel.
//!
//! `cargo run --release --example budget` prints a table; it takes a few minutes. The tests have younger plants
//! (`tests/budget.rs`).

#[path = "../tests/near/mod.rs"]
mod near;

use near::Triangles;
use phytomer::config::validate;
use phytomer::outputs::meshes::{MeshOptions, MeshWriter, Ply, Scene, Tolerance, mesh_plant};
use phytomer::outputs::pictures::{Picture, Subject, draw};
use phytomer::run::regrowth::Regrowth;
use phytomer::sim::Tick;
use phytomer::sim::plant::{Class, Kind, Plant};
use std::time::Instant;

const AGE: Tick = 92;
const SIDES: u8 = 64;

fn options(tolerance: Option<f32>, sides: u8, organs: bool) -> MeshOptions {
    let kinds = Kind::ALL.map(|kind| organs || kind.class() == Class::Internode);
    MeshOptions { sides, kinds, tolerance: tolerance.map(Tolerance::of), ..MeshOptions::default() }
}

/// The shortest of five times of writing the whole mesh into memory, ms.
fn time(plant: &Plant, tolerance: Option<f32>) -> f64 {
    let write = |_| {
        let begun = Instant::now();
        let scene = Scene::new(plant, AGE, &options(tolerance, 8, true));
        let mut bytes = Vec::with_capacity(300 << 20);
        Ply.write(&scene, &scene.about(0), &mut bytes).expect("memory does not fail");
        begun.elapsed().as_secs_f64() * 1e3
    };
    (0..5).map(write).fold(f64::INFINITY, f64::min)
}

/// The shortest of three times of a picture of 1280 × 720, ms.
fn drawing(plant: &Plant, sides: Option<u8>) -> f64 {
    let style = Picture { size: [1280, 720], sides, ..Picture::default() };
    let time = |_| {
        let begun = Instant::now();
        draw(&[Subject { plant, age: AGE, label: String::new() }], "", &style);
        begun.elapsed().as_secs_f64() * 1e3
    };
    (0..3).map(time).fold(f64::INFINITY, f64::min)
}

fn farthest(plant: &Plant, tolerance: f32) -> f32 {
    let near = Triangles::of(&mesh_plant(plant, AGE, &options(Some(tolerance), 8, false)), 2.5 * tolerance);
    let full = mesh_plant(plant, AGE, &options(None, SIDES, false));
    let tube = 4 * usize::from(SIDES) + 2;
    let corners = full.vertices.chunks(tube).flat_map(|tube| tube[..2 * usize::from(SIDES) + 2].iter().step_by(7));
    corners.map(|corner| near.distance(corner.position()) / tolerance).fold(0.0, f32::max)
}

fn main() {
    let resolved = validate("willow").unwrap_or_else(|report| panic!("{}", report.render(false)));
    let shown = Regrowth::of(&resolved).show(0, &[AGE], &mut |_, plant| {
        let count = |tolerance| Scene::new(plant, AGE, &options(tolerance, 8, false)).counts().faces;
        println!("tolerance, triangles of wood, ms to write all, farthest corner in tolerances");
        println!("none, {}, {:.1},", count(None), time(plant, None));
        for tolerance in [5e-4, 1e-3, 2e-3, 5e-3] {
            let (count, time) = (count(Some(tolerance)), time(plant, Some(tolerance)));
            println!("{tolerance}, {count}, {time:.1}, {:.2}", farthest(plant, tolerance));
        }
        println!(
            "picture, ms: {:.0} in full, {:.0} within half a pixel",
            drawing(plant, Some(8)),
            drawing(plant, None)
        );
        Ok(())
    });
    shown.expect("a plant");
}
