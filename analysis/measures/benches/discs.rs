//! The union of discs: exactly, for ten thousand, a hundred thousand and a million discs at the same density, and by
//! scan lines at a hundredth of the radius.
//!
//! Discs lie at random, twice as much area as ground, so that each meets eight others. `PHYTOMER_PAIRS=5 cargo bench -p
//! phytomer-measures --bench discs -- turns` tells the ratios by turns: ten times the discs are to take twelve times as
//! long at most, and a hundred thousand discs exactly less than by lines. Absent: plants.

#[path = "../../../benches/specimen/turns.rs"]
mod turns;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use phytomer_measures::cover::{Disc, area, area_by_lines};
use phytomer_sim::key::LineageKey;
use phytomer_sim::random::{PlantRandom, Purpose};
use std::f64::consts::PI;
use std::hint::black_box;
use turns::by_turns;

/// Leaf area over ground.
const INDEX: f64 = 2.0;

/// So many discs of radius 1.
fn discs(count: usize) -> Vec<Disc> {
    let side = (count as f64 * PI / INDEX).sqrt();
    let mut draws = PlantRandom::new(17, 1).stream(LineageKey(1), Purpose::Resampling);
    (0..count).map(|_| Disc { centre: [side * draws.share(), side * draws.share()], radius: 1.0 }).collect()
}

fn union(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("discs/union (discs)");
    group.sample_size(10);
    for count in [10_000, 100_000, 1_000_000] {
        let discs = discs(count);
        group.throughput(Throughput::Elements(count as u64));
        group.bench_with_input(BenchmarkId::new("exact", count), &discs, |bench, discs| {
            bench.iter(|| area(black_box(discs)));
        });
        if count == 100_000 {
            group.bench_with_input(BenchmarkId::new("lines at a hundredth", count), &discs, |bench, discs| {
                bench.iter(|| area_by_lines(black_box(discs), 0.01));
            });
        }
    }
    group.finish();
}

/// The ratios by turns.
fn turns(_: &mut Criterion) {
    let Some(pairs) = std::env::var("PHYTOMER_PAIRS").ok().and_then(|pairs| pairs.parse().ok()) else { return };
    let [few, more, many] = [10_000, 100_000, 1_000_000].map(discs);
    let exact = |discs: &[Disc]| {
        black_box(area(black_box(discs)));
    };
    by_turns("discs: 100,000 beside 10,000", pairs, || (), || exact(&more), || exact(&few));
    by_turns("discs: 1,000,000 beside 100,000", pairs, || (), || exact(&many), || exact(&more));
    let lines = || {
        black_box(area_by_lines(black_box(&more), 0.01));
    };
    by_turns("discs: 100,000 exactly beside lines", pairs, || (), || exact(&more), lines);
}

criterion_group!(benches, union, turns);
criterion_main!(benches);
