//! Words of streams, in time a block of 16: one by one, in records as nodes read them, and many at once; beside
//! `rand_chacha`, which makes four blocks at a time, and a plain copy of as many words.
//!
//! A draw of one word, as germination takes it, is a key and one block. `docs/performance.md` has the table.

use criterion::{Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use phytomer_sim::key::LineageKey;
use phytomer_sim::random::{PlantRandom, Purpose, Stream};
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use std::hint::black_box;
use std::time::Duration;

/// The blocks of a run, and the words of a block.
const BLOCKS: usize = 512;
const WORDS: usize = 16;

fn stream(axis: u64) -> Stream {
    PlantRandom::new(1988, 23).stream(LineageKey(axis), Purpose::Node)
}

fn words(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("words (blocks of 16)");
    group.throughput(Throughput::Elements(BLOCKS as u64)).sample_size(30).sampling_mode(SamplingMode::Flat);
    group.measurement_time(Duration::from_secs(2)).warm_up_time(Duration::from_millis(500));
    let mut into = vec![0; BLOCKS * WORDS];
    group.bench_function("word by word", |bencher| {
        bencher.iter(|| {
            let mut stream = stream(black_box(1));
            (0..BLOCKS * WORDS).fold(0_u32, |sum, _| sum.wrapping_add(stream.word()))
        });
    });
    for record in [16, 32, 48, 64, 128] {
        group.bench_function(format!("records of {record} words"), |bencher| {
            bencher.iter(|| {
                let mut stream = stream(black_box(1));
                into.chunks_mut(record).for_each(|record| stream.read(record));
                black_box(&mut into);
            });
        });
    }
    group.bench_function("one read", |bencher| {
        bencher.iter(|| {
            stream(black_box(1)).read(&mut into);
            black_box(&mut into);
        });
    });
    group.bench_function("rand_chacha, word by word", |bencher| {
        bencher.iter(|| {
            let mut reference = ChaCha8Rng::from_seed(black_box([1; 32]));
            into.iter_mut().for_each(|word| *word = reference.next_u32());
            black_box(&mut into);
        });
    });
    let from = vec![1_u32; BLOCKS * WORDS];
    group.bench_function("plain copy of as many words (baseline)", |bencher| {
        bencher.iter(|| {
            into.copy_from_slice(black_box(&from));
            black_box(&mut into);
        });
    });
    group.finish();
}

fn single(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("single words (draws)");
    group.throughput(Throughput::Elements(BLOCKS as u64)).sample_size(30).sampling_mode(SamplingMode::Flat);
    group.measurement_time(Duration::from_secs(2)).warm_up_time(Duration::from_millis(500));
    group.bench_function("germinates, a plant each", |bencher| {
        let plants = 0..black_box(BLOCKS as u64);
        bencher.iter(|| plants.clone().filter(|&plant| PlantRandom::new(1988, plant).germinates(0.5)).count());
    });
    group.bench_function("a word of a stream each", |bencher| {
        let axes = 0..black_box(BLOCKS as u64);
        bencher.iter(|| axes.clone().fold(0_u32, |sum, axis| sum.wrapping_add(stream(axis).word())));
    });
    group.bench_function("a word of one stream each, sought", |bencher| {
        let mut stream = stream(1);
        bencher.iter(|| {
            (0..black_box(BLOCKS as u64)).fold(0_u32, |sum, place| {
                stream.seek(37 * place);
                sum.wrapping_add(stream.word())
            })
        });
    });
    group.finish();
}

criterion_group!(benches, words, single);
criterion_main!(benches);
