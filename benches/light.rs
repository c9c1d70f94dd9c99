//! The light in a stand: a direction through its voxels, beside one plain pass over them, which asks of each voxel
//! alone what it keeps of a beam.
//!
//! The stand is 25 crowns of leaves, 282,000 voxels in bricks. Absent: growth in light (`poplar_30y` grows without).

use criterion::{Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use phytomer::sim::math::exp;
use phytomer::sim::site::light::grid::{Grid, UNITS};
use phytomer::sim::site::light::{Field, Lighting, Piece, Sky};
use std::hint::black_box;
use std::time::Duration;

/// 25 crowns of 2 m radius, 3.4 m apart, with 3 m² of leaves in each m³, in voxels of 0.125 m.
fn stand() -> (Lighting, Grid) {
    let lighting = Lighting { voxel_m: 0.125, ..Lighting::default() };
    let mut grid = Grid::of(&lighting);
    let edge = 36;
    for crown in 0..25 {
        let middle = [f64::from(crown % 5) * 3.4, f64::from(crown / 5) * 3.4, 4.0];
        for k in 0..edge * edge * edge {
            let at = [k % edge, k / edge % edge, k / edge / edge].map(|k| f64::from(k) * 4.0 / f64::from(edge) - 1.95);
            if at.iter().map(|x| x * x).sum::<f64>() <= 4.0 {
                let place = [0, 1, 2].map(|k| middle[k] + at[k]);
                let area = 3.0 * (64.0 / f64::from(edge * edge * edge));
                grid.add(&Piece { place, normal: [0.0, 0.0, 1.0], area });
            }
        }
    }
    grid.sort();
    (lighting, grid)
}

fn light(criterion: &mut Criterion) {
    let (lighting, grid) = stand();
    let sources = Sky::default().sources();
    let voxels = grid.area.len() as u64;
    let mut group = criterion.benchmark_group(format!("light/{voxels} voxels, {} of them with leaves", filled(&grid)));
    group.sample_size(10).sampling_mode(SamplingMode::Flat).measurement_time(Duration::from_secs(3));
    group.throughput(Throughput::Elements(voxels));
    let g = 0.5 / UNITS / grid.volume() * lighting.voxel_m;
    group.bench_function("one plain pass (baseline)", |bencher| {
        bencher.iter(|| {
            let kept: Vec<f64> = grid.area.iter().map(|units| 1.0 - exp(-g * *units as f64)).collect();
            black_box(kept)
        });
    });
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    group.throughput(Throughput::Elements(voxels * sources.len() as u64));
    group.bench_function("40 directions, one thread", |bencher| {
        bencher.iter(|| one.install(|| black_box(Field::in_grid(&lighting, grid.clone(), &sources))));
    });
    group.finish();
}

fn filled(grid: &Grid) -> usize {
    grid.area.iter().filter(|units| **units > 0).count()
}

criterion_group!(benches, light);
criterion_main!(benches);
