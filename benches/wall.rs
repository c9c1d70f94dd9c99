//! The price of obstacles in a tick: ivies by a wall with a window, against the same ivies in the open that grow and
//! stand tick by tick; and coffee trees among two hundred boxes that are far from every bud but the nearest.
//!
//! Absent: a site without feedback, whose plants grow ahead and need no tick.

use criterion::{BatchSize, Criterion, SamplingMode, criterion_group, criterion_main};
use phytomer::config::{Resolved, validate};
use phytomer::run::seed_of;
use phytomer::sim::shape::{Cuboid, Shape};
use phytomer::sim::site::{Manner, Obstacle, Side};
use phytomer::sim::{Plot, Sowing, Tick};
use std::sync::Arc;
use std::time::Duration;

fn blocks(low: [f64; 3], size: [f64; 3]) -> Obstacle {
    let high = [0, 1, 2].map(|k| low[k] + size[k]);
    let shape = Arc::new(Shape::Cuboid(Cuboid { low, high }));
    Obstacle { shape, kills: Side::Inside, manner: Manner::Blocks { holds: true } }
}

fn sown(resolved: &Resolved, obstacles: Vec<Obstacle>) -> Plot<'_> {
    let sowing = |plant: u32| {
        let place = [f64::from(plant % 4) * 1.2 - 1.8, 0.12 + 1.5 * f64::from(plant / 4), 0.0];
        Sowing { species: 0, seed: seed_of(&resolved.scenario, plant), place, sown: 0 }
    };
    let mut plot = Plot::new(0, vec![resolved.model.as_ref()], &(0..12).map(sowing).collect::<Vec<_>>());
    plot.site.ground = (!obstacles.is_empty()).then_some(0.0);
    plot.site.obstacles = obstacles;
    plot
}

/// Growth that follows the clock and stands at each tick, with or without anything to meet.
fn grown(mut plot: Plot<'_>, until: Tick) -> Plot<'_> {
    for tick in 1..=until {
        plot.site.begin(tick);
        plot.grow_to(tick).expect("room to grow");
        plot.stand(tick);
    }
    plot
}

fn wall(criterion: &mut Criterion) {
    let far = |k: u32| blocks([f64::from(k % 20) * 3.0 - 30.0, 8.0 + f64::from(k / 20) * 3.0, 0.0], [2.0, 2.0, 3.0]);
    let many = (0..200).map(far).collect::<Vec<_>>();
    let front = vec![blocks([-2.3, -0.2, 0.0], [4.6, 0.2, 4.0]), blocks([-0.55, -0.06, 1.2], [1.1, 0.12, 1.3])];
    for (name, until, obstacles, what) in
        [("wall", 30, front, "a wall and a window"), ("coffee", 60, many, "two hundred boxes")]
    {
        let species = validate(name).unwrap_or_else(|report| panic!("{}", report.render(false)));
        let mut group = criterion.benchmark_group(format!("wall/{name}, {until} ticks"));
        group.sample_size(10).sampling_mode(SamplingMode::Flat);
        group.measurement_time(Duration::from_secs(5)).warm_up_time(Duration::from_millis(500));
        for (word, obstacles) in [("in the open (baseline)", Vec::new()), (what, obstacles)] {
            group.bench_function(word, |bencher| {
                let begin = || sown(&species, obstacles.clone());
                bencher.iter_batched(begin, |plot| grown(plot, until), BatchSize::PerIteration);
            });
        }
        group.finish();
    }
}

criterion_group!(benches, wall);
criterion_main!(benches);
