//! A picture of a million triangles: the time of drawing, beside the meshing that is repeated for it, and beside a
//! plain encoding of the finished pixels.
//!
//! The plant is the specimen's at the first age at which its mesh has a million triangles.

use super::Specimen;
use criterion::{Criterion, Throughput};
use phytomer::outputs::meshes::{Mesh, MeshOptions, Scene};
use phytomer::outputs::pictures::{Canvas, Compression, Picture, Subject, draw, write_png};
use phytomer::run::regrowth::Regrowth;
use phytomer::sim::Tick;
use phytomer::sim::plant::Plant;
use rayon::prelude::*;
use std::hint::black_box;

const TRIANGLES: u64 = 1_000_000;

/// The first plant of a specimen, at the first age at which it is large enough.
fn large(specimen: &Specimen) -> (Plant, Tick) {
    let resolved = &specimen.resolved;
    let regrowth = Regrowth::of(resolved);
    let ages: Vec<Tick> = (1..=resolved.scenario.ages.until).collect();
    let mut large = None;
    let shown = regrowth.show(0, &ages, &mut |age, plant| {
        let triangles = Scene::new(plant, age, &MeshOptions::default()).counts().faces;
        if large.is_none() && triangles >= TRIANGLES {
            large = Some((plant.clone(), age));
        }
        Ok(())
    });
    shown.expect("a plant");
    large.expect("a million triangles")
}

/// Drawing at 1920 × 1080, in triangles a second.
pub fn picture(specimen: &Specimen, criterion: &mut Criterion) {
    let (plant, age) = large(specimen);
    let scene = Scene::new(&plant, age, &MeshOptions::default());
    let mut group = specimen.group(criterion, "picture (triangles)", Throughput::Elements(scene.counts().faces));
    let style = Picture { size: [1920, 1080], ..Picture::default() };
    let drawn = || draw(&[Subject { plant: &plant, age, label: format!("age {age}") }], "", &style);
    let encoded =
        |canvas: &Canvas| write_png(canvas, "", Compression::Balanced, Vec::new()).expect("memory does not fail");
    group.bench_function("drawn and encoded", |bencher| bencher.iter(|| encoded(&drawn())));
    group.bench_function("the meshing alone, once (baseline)", |bencher| {
        bencher.iter(|| {
            (0..scene.blocks()).into_par_iter().for_each_init(Mesh::default, |mesh, block| {
                scene.block(block, mesh);
                black_box(&mesh.vertices);
            });
        });
    });
    let canvas = drawn();
    group.bench_function("plain PNG encode of the same image", |bencher| bencher.iter(|| encoded(&canvas)));
    group.finish();
}
