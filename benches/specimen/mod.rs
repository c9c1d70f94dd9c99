//! The parts common to all benches: a shipped scenario as a specimen, its plant, and the baselines beside it.
//!
//! A baseline does the same work without the code of this project: the same columns or vertices written to memory, the
//! parquet crate fed with ready batches, a plain write of the same bytes. Rates are elements a second: internodes,
//! vertices, rows or bytes, as the group says.

#![allow(dead_code)]

pub mod baseline;
pub mod bending;
pub mod budget;
pub mod columns;
pub mod files;
pub mod levels;
pub mod picture;
pub mod turns;

use criterion::measurement::WallTime;
use criterion::{BatchSize, BenchmarkGroup, Criterion, SamplingMode, Throughput};
use phytomer::config::{Resolved, validate, validate_texts};
use phytomer::outputs::meshes::{Chunk, MeshOptions, MeshWriter, Ply, Scene, Vertex};
use phytomer::run::{self, Program, Progress, Settings, plan_of, seed_of};
use phytomer::sim::plant::Plant;
use phytomer::sim::pose::pose;
use phytomer::sim::site::View;
use phytomer::sim::{GrowthModel, Plot, Tick};
use std::fs::File;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The name of the baseline of benches that work in memory.
pub const PLAIN_WRITE: &str = "plain memory write of the same columns (baseline)";

/// A shipped scenario, and the first of its plants.
pub struct Specimen {
    pub name: &'static str,
    pub resolved: Resolved,
}

impl Specimen {
    pub fn of(name: &'static str) -> Self {
        let resolved = validate(name).unwrap_or_else(|report| panic!("{}", report.render(false)));
        Self { name, resolved }
    }

    /// A scenario stated in a text.
    pub fn of_text(name: &'static str, scenario: &str) -> Self {
        let resolved =
            validate_texts(name, &[(name, scenario)]).unwrap_or_else(|report| panic!("{}", report.render(false)));
        Self { name, resolved }
    }

    fn model(&self) -> &dyn GrowthModel {
        self.resolved.model.as_ref()
    }

    fn until(&self) -> Tick {
        self.resolved.scenario.ages.until
    }

    /// The plot of the plant, before it has grown.
    pub fn sown(&self) -> Plot<'_> {
        Plot::of_one(self.model(), &seed_of(&self.resolved.scenario, 0))
    }

    /// The plant at its last age, shed, thickened and posed.
    pub fn grown(&self) -> Plot<'_> {
        let mut plot = self.sown();
        plot.grow_to(self.until()).expect("room to grow");
        plot.site.gravity = 0.0;
        plot.stand(self.until());
        plot
    }

    /// A group of benches of this specimen, whose rates count `elements` elements.
    pub fn group<'a>(
        &self,
        criterion: &'a mut Criterion,
        what: &str,
        rate: Throughput,
    ) -> BenchmarkGroup<'a, WallTime> {
        let mut group = criterion.benchmark_group(format!("{}/{what}", self.name));
        group.throughput(rate).sample_size(10).sampling_mode(SamplingMode::Flat);
        group.measurement_time(Duration::from_secs(3)).warm_up_time(Duration::from_millis(500));
        group
    }

    /// Growth from the seed to the last age, axis by axis and tick by tick, in internodes a second, against a plain
    /// write of the columns that growth makes.
    pub fn growth(&self, criterion: &mut Criterion, by_the_clock: bool) {
        let grown = self.grown();
        let internodes = grown.plants[0].nodes.len() as u64;
        let mut group = self.group(criterion, "growth (internodes)", Throughput::Elements(internodes));
        let mut plot = self.sown();
        let seed = seed_of(&self.resolved.scenario, 0);
        group.bench_function("axis by axis", |bencher| {
            bencher.iter(|| {
                plot.resow(&seed);
                grow_alone(&mut plot, self.until());
                black_box(&plot);
            });
        });
        if by_the_clock {
            group.bench_function("tick by tick", |bencher| {
                bencher.iter(|| {
                    plot.resow(&seed);
                    for age in 1..=self.until() {
                        grow_alone(&mut plot, age);
                    }
                    black_box(&plot);
                });
            });
        }
        plain_write_of_growth(&mut group, &grown.plants[0]);
        group.finish();
    }

    /// The pose of every internode, against a plain write of its columns.
    pub fn frames(&self, criterion: &mut Criterion) {
        let mut plot = self.grown();
        let internodes = plot.plants[0].nodes.len();
        let mut group = self.group(criterion, "frames (internodes)", Throughput::Elements(internodes as u64));
        group.bench_function("pose", |bencher| {
            bencher.iter(|| {
                plot.plants[0].frames.clear();
                pose(&mut plot.plants[0], self.until());
            });
        });
        plain_write_of_frames(&mut group, &plot.plants[0]);
        group.finish();
    }

    /// The vertices of a mesh, into reused chunks, against a plain write of as many vertices into such a chunk.
    pub fn meshing(&self, criterion: &mut Criterion) {
        let plot = self.grown();
        let scene = Scene::new(&plot.plants[0], self.until(), &MeshOptions::default());
        let mut group = self.group(criterion, "meshing (vertices)", Throughput::Elements(scene.counts().vertices));
        let mut chunk = Chunk::new();
        group.bench_function("into reused chunks", |bencher| {
            bencher.iter(|| {
                let mut sink = |chunk: &mut Chunk| {
                    black_box(chunk.filled());
                    chunk.clear();
                    Ok(())
                };
                scene.vertices(&mut chunk, &mut sink).expect("memory does not fail");
            });
        });
        let bytes = scene.counts().vertices as usize * Vertex::BYTES;
        let (ready, mut kept) = (vec![1_u8; Chunk::BYTES], vec![0_u8; Chunk::BYTES]);
        group.bench_function("plain memory write of as many vertices (baseline)", |bencher| {
            bencher.iter(|| baseline::write_chunks(&ready, &mut kept, bytes));
        });
        group.finish();
    }

    /// Grows the plant once more in a plot that has grown before; dead parts are not shed.
    pub fn grow_again(&self, plot: &mut Plot<'_>) {
        plot.resow(&seed_of(&self.resolved.scenario, 0));
        grow_alone(plot, self.until());
    }

    /// Meshes a grown plant and writes it as PLY into memory-backed storage.
    pub fn write_mesh(&self, plot: &Plot<'_>) {
        let scene = Scene::new(&plot.plants[0], self.until(), &MeshOptions::default());
        let path = memory_backed(self.name);
        let mut file = File::create(&path).expect("a file");
        Ply.write(&scene, &scene.about(self.resolved.scenario.seed), &mut file).expect("a write");
        std::fs::remove_file(path).expect("the file goes");
    }

    /// A PLY file in memory-backed storage, against a plain bulk write of the same bytes.
    pub fn ply(&self, criterion: &mut Criterion) {
        let plot = self.grown();
        let scene = Scene::new(&plot.plants[0], self.until(), &MeshOptions::default());
        let about = scene.about(self.resolved.scenario.seed);
        let path = memory_backed(self.name);
        let write = || {
            let mut file = File::create(&path).expect("a file");
            Ply.write(&scene, &about, &mut file).expect("a write");
        };
        write();
        let bytes = std::fs::read(&path).expect("the file");
        let mut group = self.group(criterion, "PLY (bytes)", Throughput::Bytes(bytes.len() as u64));
        group.bench_function("mesh and write", |bencher| bencher.iter(write));
        group.bench_function("plain bulk write of the same bytes (baseline)", |bencher| {
            bencher.iter(|| baseline::write_blocks(&path, &bytes));
        });
        group.finish();
        std::fs::remove_file(path).expect("the file goes");
    }

    /// The whole `grow` of a scenario into its run folder, against the parquet crate alone on ready batches of the same
    /// rows, with the same settings and threads. Both write into an empty folder: the removal of earlier files is not
    /// measured.
    pub fn records(&self, criterion: &mut Criterion) {
        let home = tempfile::tempdir().expect("a folder");
        let (ours, theirs) = (home.path().join("run"), home.path().join("alone"));
        let settings = Settings::in_folder(&ours);
        let grow = || run::run(&self.resolved, &settings, &Progress::default()).expect("a run");
        let outcome = grow();
        let rows = outcome.report.rows.values().sum();
        let ready = self.ready(&ours);
        let mut group = self.group(criterion, "records (rows)", Throughput::Elements(rows));
        group.bench_function("whole grow", |bencher| {
            bencher.iter_batched(|| empty(&ours), |()| grow(), BatchSize::PerIteration);
        });
        group.bench_function("the parquet crate alone on ready batches (baseline)", |bencher| {
            bencher.iter_batched(|| empty(&theirs), |()| ready.write(&theirs), BatchSize::PerIteration);
        });
        group.bench_function("plain memory write of the same columns", |bencher| bencher.iter(|| ready.copy()));
        group.finish();
    }

    /// The same two sides by turns, so many pairs of them: their ratio also where the machine does other work.
    pub fn records_by_turns(&self, pairs: usize) {
        let home = tempfile::tempdir().expect("a folder");
        let (ours, theirs) = (home.path().join("run"), home.path().join("alone"));
        let settings = Settings::in_folder(&ours);
        let grow = || drop(run::run(&self.resolved, &settings, &Progress::default()).expect("a run"));
        grow();
        let ready = self.ready(&ours);
        let before = || [&ours, &theirs].into_iter().for_each(|folder| empty(folder));
        let name = format!("{}: whole grow beside the parquet crate alone", self.name);
        turns::by_turns(&name, pairs, before, grow, || ready.write(&theirs));
    }

    fn ready(&self, run: &Path) -> baseline::Ready {
        baseline::ready_batches(run, &plan_of(&self.resolved, &Program::default()).expect("a plan"))
    }
}

/// Makes a folder empty, on the disk too.
fn empty(folder: &Path) {
    let _ = std::fs::remove_dir_all(folder);
    std::fs::create_dir(folder).expect("a folder");
    File::open(folder).and_then(|folder| folder.sync_all()).expect("a folder on the disk");
}

/// Grows the one plant of a plot to an age; dead parts are not shed.
pub fn grow_alone(plot: &mut Plot<'_>, age: Tick) {
    let Plot { species, plants, lives, site, .. } = plot;
    species[0].grow_to(age, &mut plants[0], &mut lives[0], &View::of(site)).expect("room to grow");
}

/// The baseline of growth: the columns of a grown plant, written again.
pub fn plain_write_of_growth(group: &mut BenchmarkGroup<'_, WallTime>, grown: &Plant) {
    let mut copy = grown.clone();
    group.bench_function(PLAIN_WRITE, |bencher| {
        bencher.iter(|| {
            columns::write_growth(black_box(grown), &mut copy);
            black_box(&copy);
        });
    });
}

/// The baseline of the pose: the frames of a posed plant, written again.
pub fn plain_write_of_frames(group: &mut BenchmarkGroup<'_, WallTime>, posed: &Plant) {
    let mut copy = posed.frames.clone();
    group.bench_function(PLAIN_WRITE, |bencher| {
        bencher.iter(|| {
            columns::write_frames(black_box(&posed.frames), &mut copy);
            black_box(&copy);
        });
    });
}

/// A file name in memory-backed storage where there is some, else in the temporary folder.
fn memory_backed(name: &str) -> PathBuf {
    let memory = PathBuf::from("/dev/shm");
    let folder = if memory.is_dir() { memory } else { std::env::temp_dir() };
    folder.join(format!("phytomer-bench-{name}-{}.ply", std::process::id()))
}
