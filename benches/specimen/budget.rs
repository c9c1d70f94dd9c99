//! A mesh with a tolerance, a picture and a life, beside the full mesh, the picture of it, and growing and standing at
//! all ages.
//!
//! All are asked of the plant as it is recorded, bent at each tick. Aims: a mesh within 1 mm is written in at most half
//! of the time of the full one; a picture is drawn in at most two fifths; a life takes at most twice the time of
//! growing and standing at every age.

use super::turns::by_turns;
use super::{Specimen, memory_backed};
use criterion::{Criterion, Throughput};
use phytomer::outputs::life::{Lives, Nearness};
use phytomer::outputs::meshes::{Joints, MeshOptions, MeshWriter, Ply, Scene, Tolerance};
use phytomer::outputs::pictures::{Picture, Subject, draw};
use phytomer::run::regrowth::Regrowth;
use phytomer::run::seed_of;
use phytomer::sim::{Plot, RecordError, Recorder, Tick, grow};
use std::fs::File;
use std::hint::black_box;

/// The size of a picture, pixels.
const SIZE: [u32; 2] = [1280, 720];

/// The tolerance, metres.
const NEAR: f32 = 1e-3;

/// Looks at every tick and keeps nothing.
struct EveryTick;

impl Recorder for EveryTick {
    fn wants(&self, _: Tick) -> bool {
        true
    }

    fn record(&mut self, _: Tick, plot: &Plot) -> Result<(), RecordError> {
        black_box(plot);
        Ok(())
    }
}

impl Specimen {
    /// The PLY file of the first plant at an age, in full and within a millimetre, and its picture, with tubes of
    /// single internodes and within half a pixel.
    pub fn within_a_millimetre(&self, criterion: &mut Criterion, age: Tick) {
        let mut plant = None;
        let shown = Regrowth::of(&self.resolved).show(0, &[age], &mut |_, shown| {
            plant = Some(shown.clone());
            Ok(())
        });
        shown.expect("a plant");
        let plant = plant.expect("a plant");
        let path = memory_backed(self.name);
        let write = |tolerance: Option<Tolerance>| {
            let scene = Scene::new(&plant, age, &MeshOptions { tolerance, ..MeshOptions::default() });
            let mut file = File::create(&path).expect("a file");
            Ply.write(&scene, &scene.about(0), &mut file).expect("a write");
        };
        let joined = |joints: Joints| {
            let scene = Scene::new(&plant, age, &MeshOptions { joints, ..MeshOptions::default() });
            let mut file = File::create(&path).expect("a file");
            Ply.write(&scene, &scene.about(0), &mut file).expect("a write");
        };
        // Aim: at most four times the open mesh.
        let name = format!("{}: welded beside open", self.name);
        by_turns(&name, 9, || (), || joined(Joints::Welded), || joined(Joints::Open));
        let internodes = plant.nodes.len() as u64;
        let mut group = self.group(criterion, "mesh within 1 mm (internodes)", Throughput::Elements(internodes));
        group.bench_function("within 1 mm", |bencher| bencher.iter(|| write(Some(Tolerance::of(NEAR)))));
        group.bench_function("in full (baseline)", |bencher| bencher.iter(|| write(None)));
        let drawn = |sides: Option<u8>| {
            let subject = Subject { plant: &plant, age, label: String::new() };
            black_box(draw(&[subject], "", &Picture { size: SIZE, sides, ..Picture::default() }));
        };
        group.bench_function("picture within half a pixel", |bencher| bencher.iter(|| drawn(None)));
        group.bench_function("picture in full (its baseline)", |bencher| bencher.iter(|| drawn(Some(8))));
        group.finish();
        std::fs::remove_file(path).expect("the file goes");
    }

    /// The life of the first plant within a millimetre at all ages.
    pub fn keyframes(&self, criterion: &mut Criterion) {
        let (seed, until) = (seed_of(&self.resolved.scenario, 0), self.until());
        let mut plot = Plot::of_one(self.model(), &seed);
        grow(&mut plot, until, &mut ()).expect("nothing is written");
        let internodes = plot.plants[0].nodes.len() as u64;
        let what = format!("life of {until} ages (internodes)");
        let mut group = self.group(criterion, &what, Throughput::Elements(internodes));
        group.bench_function("grown, and described within 1 mm", |bencher| {
            bencher.iter(|| {
                plot.resow(&seed);
                let mut lives = Lives::new(Nearness::of(NEAR), Vec::new(), Vec::new());
                grow(&mut plot, until, &mut lives).expect("nothing is written");
                black_box(lives.finish());
            });
        });
        group.bench_function("grown, and standing at every age (baseline)", |bencher| {
            bencher.iter(|| {
                plot.resow(&seed);
                grow(&mut plot, until, &mut EveryTick).expect("nothing is written");
                black_box(&plot);
            });
        });
        group.finish();
    }
}
