//! Binary USD, as a still and as a life, against a plain write of the same bytes.
//!
//! Nothing is grown within a bench: the plant stands, or its life is described. Aim: the bytes are written at half of
//! the rate of a plain write at least. Files lie in memory-backed storage where there is some.

use super::{Specimen, baseline, memory_backed};
use criterion::{Criterion, Throughput};
use phytomer::outputs::life::{Life, Maker, Nearness};
use phytomer::outputs::meshes::{MeshOptions, Scene, Tolerance};
use phytomer::outputs::usd::{self, Asked, Encoding, Member, Organs, Pace, Patched, Plants};
use phytomer::run::regrowth::Regrowth;
use phytomer::sim::Tick;
use std::fs::File;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::Path;

/// The tolerance, metres.
const NEAR: f32 = 1e-3;

/// A file that can be put right at its beginning.
struct Bulk(BufWriter<File>);

impl Bulk {
    fn create(path: &Path) -> Self {
        Self(BufWriter::with_capacity(1 << 20, File::create(path).expect("a file")))
    }
}

impl Write for Bulk {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

impl Patched for Bulk {
    fn patch(&mut self, at: u64, bytes: &[u8]) -> io::Result<()> {
        self.0.seek(SeekFrom::Start(at))?;
        self.0.write_all(bytes)?;
        self.0.seek(SeekFrom::End(0)).map(|_| ())
    }
}

impl Specimen {
    /// The first plant at an age, and its life up to there at so many ages, as binary USD within a millimetre.
    pub fn usd(&self, criterion: &mut Criterion, ages: &[Tick]) {
        let (mut maker, mut last) = (Maker::new(Nearness::of(NEAR), &MeshOptions::default()), None);
        let shown = Regrowth::of(&self.resolved).show(0, ages, &mut |age, plant| {
            maker.show(plant, age);
            if ages.last() == Some(&age) {
                last = Some((plant.clone(), age));
            }
            Ok(())
        });
        shown.expect("a plant");
        let (plant, age) = last.expect("a plant");
        let scene =
            Scene::new(&plant, age, &MeshOptions { tolerance: Some(Tolerance::of(NEAR)), ..MeshOptions::default() });
        let asked = Asked {
            encoding: Encoding::Binary,
            organs: Organs::Instances,
            words: String::new(),
            pictures: Default::default(),
        };
        self.against_a_plain_write(criterion, "USD of an age (bytes)", &|out| usd::write_plant(&asked, &scene, 0, out));
        let (lives, options): ([Life; 1], _) = ([maker.finish()], [MeshOptions::default()]);
        let members = [Member::default()];
        let plants = Plants::of(&lives, &options, &members);
        let pace = Pace { a_tick: 1.0, a_second: 24.0 };
        self.against_a_plain_write(criterion, &format!("USD of {} ages (bytes)", ages.len()), &|out| {
            usd::write_life(&asked, &plants, NEAR, &pace, out)
        });
    }

    fn against_a_plain_write(
        &self,
        criterion: &mut Criterion,
        what: &str,
        write: &dyn Fn(&mut dyn Patched) -> io::Result<()>,
    ) {
        let path = memory_backed(self.name);
        let written = || {
            let mut file = Bulk::create(&path);
            write(&mut file).and_then(|()| file.flush()).expect("a write");
        };
        written();
        let bytes = std::fs::read(&path).expect("the file");
        let mut group = self.group(criterion, what, Throughput::Bytes(bytes.len() as u64));
        group.bench_function("written", |bencher| bencher.iter(written));
        group.bench_function("plain bulk write of the same bytes (baseline)", |bencher| {
            bencher.iter(|| baseline::write_blocks(&path, &bytes));
        });
        group.finish();
        std::fs::remove_file(path).expect("the file goes");
    }
}
