//! Two bare plants of constant laws, the upper bounds of the engine: a bushy one, four orders with a lateral at nearly
//! every node, and one of long axes, ten nodes a growth unit and few laterals.
//!
//! The shipped species draw lengths, angles, leaves and fruits at random on top of this. The baselines are plain writes
//! of the columns that growth and pose make; the rates are internodes a second of one core.

mod specimen;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use phytomer::models::buds::params::{Axillary, GrowthUnit, Leaf};
use phytomer::models::buds::{Buds, Order};
use phytomer::models::fault::Path;
use phytomer::models::law::{Count, Law};
use phytomer::sim::plant::{MOST_COMPONENTS, Seed};
use phytomer::sim::pose::pose;
use phytomer::sim::{Plot, Tick};
use specimen::{grow_alone, plain_write_of_frames, plain_write_of_growth};
use std::hint::black_box;

struct Bare {
    name: &'static str,
    until: Tick,
    orders: usize,
    nodes: u32,
    ramification: f64,
    death: f64,
    pause: f64,
}

const BUSHY: Bare = Bare { name: "bushy", until: 50, orders: 4, nodes: 1, ramification: 0.9, death: 0.05, pause: 0.2 };
const LONG_AXES: Bare =
    Bare { name: "long_axes", until: 60, orders: 3, nodes: 10, ramification: 0.05, death: 0.01, pause: 0.1 };

impl Bare {
    fn species(&self) -> Buds {
        let order = |number| Order {
            death: Law::from(self.death),
            pause: Law::from(self.pause),
            growth_unit: GrowthUnit { nodes: Count::from(self.nodes), ..GrowthUnit::default() },
            axillary: Axillary {
                buds: Count::from(u32::from(number < self.orders)),
                ramification: Law::from(self.ramification),
                ..Axillary::default()
            },
            leaf: Leaf { per_node: Count::from(0), ..Leaf::default() },
            ..Order::default()
        };
        Buds { order: (1..=self.orders).map(order).collect(), ..Buds::default() }
    }

    fn bench(&self, criterion: &mut Criterion) {
        let model = self.species().compile(self.until, &Path::root()).expect("sound laws");
        let seed = Seed { plant: 1, draws: 1, run_seed: 1, component_limit: MOST_COMPONENTS, keep_events: false };
        let mut plot = Plot::of_one(&model, &seed);
        plot.grow_to(self.until).expect("room to grow");
        let internodes = plot.plants[0].nodes.len() as u64;
        let grown = plot.clone();
        let mut group = self.group(criterion, "growth (internodes)", internodes);
        group.bench_function("axis by axis", |bencher| {
            bencher.iter(|| {
                plot.resow(&seed);
                grow_alone(&mut plot, self.until);
                black_box(&plot);
            });
        });
        group.bench_function("tick by tick", |bencher| {
            bencher.iter(|| {
                plot.resow(&seed);
                for age in 1..=self.until {
                    grow_alone(&mut plot, age);
                }
                black_box(&plot);
            });
        });
        plain_write_of_growth(&mut group, &grown.plants[0]);
        group.finish();
        pose(&mut plot.plants[0], self.until);
        let mut group = self.group(criterion, "frames (internodes)", internodes);
        group.bench_function("pose", |bencher| {
            bencher.iter(|| {
                plot.plants[0].frames.clear();
                pose(&mut plot.plants[0], self.until);
            });
        });
        plain_write_of_frames(&mut group, &plot.plants[0]);
        group.finish();
    }

    fn group<'a>(&self, criterion: &'a mut Criterion, what: &str, internodes: u64) -> BenchmarkGroup<'a, WallTime> {
        let mut group = criterion.benchmark_group(format!("{}/{what}", self.name));
        group.throughput(Throughput::Elements(internodes)).sampling_mode(SamplingMode::Flat).sample_size(40);
        group
    }
}

fn bare(criterion: &mut Criterion) {
    BUSHY.bench(criterion);
    LONG_AXES.bench(criterion);
}

criterion_group!(benches, bare);
criterion_main!(benches);
