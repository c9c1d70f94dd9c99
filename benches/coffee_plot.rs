//! A plot of a thousand coffee trees, grown tick by tick, as plants of a plot that interact through their site must be:
//! by one thread, and by two.
//!
//! Absent: the cost of a site with effects; the ground is open.

use criterion::{BatchSize, Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use phytomer::config::{Resolved, validate};
use phytomer::run::seed_of;
use phytomer::sim::{Plot, Sowing, Tick};
use std::time::Duration;

const TREES: u32 = 1000;
const UNTIL: Tick = 60;

fn sown(resolved: &Resolved) -> Plot<'_> {
    let sowing = |tree: u32| {
        let place = [f64::from(tree % 40) * 2.5, f64::from(tree / 40) * 2.5, 0.0];
        Sowing { species: 0, seed: seed_of(&resolved.scenario, tree), place, sown: 0 }
    };
    Plot::new(0, vec![resolved.model.as_ref()], &(0..TREES).map(sowing).collect::<Vec<_>>())
}

fn grown<'m>(mut plot: Plot<'m>) -> Plot<'m> {
    for tick in 1..=UNTIL {
        plot.site.begin(tick);
        plot.grow_to(tick).expect("room to grow");
    }
    plot
}

fn coffee_plot(criterion: &mut Criterion) {
    let coffee = validate("coffee").unwrap_or_else(|report| panic!("{}", report.render(false)));
    let components: u64 = grown(sown(&coffee)).plants.iter().map(|tree| u64::from(tree.components())).sum();
    let mut group = criterion.benchmark_group("coffee_plot/growth of 1,000 trees by the clock (components)");
    group.throughput(Throughput::Elements(components)).sample_size(10).sampling_mode(SamplingMode::Flat);
    group.measurement_time(Duration::from_secs(5)).warm_up_time(Duration::from_millis(500));
    for (threads, name) in [(1, "one thread (baseline)"), (2, "two threads")] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        group.bench_function(name, |bencher| {
            bencher.iter_batched(|| sown(&coffee), |plot| pool.install(|| grown(plot)), BatchSize::PerIteration);
        });
    }
    group.finish();
}

criterion_group!(benches, coffee_plot);
criterion_main!(benches);
