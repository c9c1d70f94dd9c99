//! Bending: the cost of a step and of a converged tick beside the pose at rest, and a whole life with bending at every
//! tick.
//!
//! A specimen without wood of its own is given that of a birch. Absent: whether the bending is correct.

use super::{Specimen, grow_alone};
use criterion::{BatchSize, Criterion, Throughput};
use phytomer::config::Model;
use phytomer::models::buds::BudModel;
use phytomer::models::buds::params::Wood;
use phytomer::models::fault::Path;
use phytomer::run::seed_of;
use phytomer::sim::mechanics::{Scratch, Strain, bend};
use phytomer::sim::plant::NodeId;
use phytomer::sim::pose::pose;
use phytomer::sim::{Plot, RecordError, Recorder, Tick, grow};
use std::cell::RefCell;
use std::hint::black_box;

/// The state of bending before the last tick.
#[derive(Default)]
struct Before {
    strain: Strain,
    last: Strain,
}

impl Recorder for Before {
    fn wants(&self, _: Tick) -> bool {
        true
    }

    fn record(&mut self, _: Tick, plot: &Plot) -> Result<(), RecordError> {
        std::mem::swap(&mut self.strain, &mut self.last);
        self.last.clone_from(&plot.plants[0].strain);
        Ok(())
    }
}

impl Specimen {
    /// The species with wood that bends.
    fn wooden(&self) -> BudModel {
        let Model::Buds(mut buds) = self.resolved.species.model.clone() else { panic!("{} has no wood", self.name) };
        let wood = buds.wood.get_or_insert_with(Wood::default);
        wood.modulus_gpa.get_or_insert_with(|| 9.9.into());
        wood.density_kg_m3.get_or_insert_with(|| 900.0.into());
        buds.compile(self.until(), &Path::root()).expect("sound laws")
    }

    /// The last tick of a life: one step of the plant in equilibrium, and the whole tick that brought it there, against
    /// the pose at rest. Both bending benches first find the standing parts and freeze the curvature.
    pub fn bending(&self, criterion: &mut Criterion) {
        let model = self.wooden();
        let until = self.until();
        let mut plot = Plot::of_one(&model, &seed_of(&self.resolved.scenario, 0));
        let mut before = Before::default();
        grow(&mut plot, until, &mut before).expect("nothing is written");
        let plant = &plot.plants[0];
        let stood = (0..plant.nodes.len() as u32).filter(|&node| plant.stands(NodeId(node), until)).count() as u64;
        let (mut rest, mut scratch) = (plot.plants[0].clone(), Scratch::default());
        let mut group = self.group(criterion, "bending (internodes)", Throughput::Elements(stood));
        group.bench_function("the pose at rest (baseline)", |bencher| {
            bencher.iter(|| {
                rest.frames.clear();
                pose(&mut rest, until);
            });
        });
        group.bench_function("one step, in equilibrium", |bencher| {
            bencher.iter(|| black_box(bend(&mut plot.plants[0], self.until(), &plot.site, &mut scratch)));
        });
        plot.plants[0].strain.clone_from(&before.strain);
        let tick = bend(&mut plot.plants[0], until, &plot.site, &mut scratch);
        assert!(tick.settled, "{tick:?}");
        let plot = RefCell::new(plot);
        let unbend = || plot.borrow_mut().plants[0].strain.clone_from(&before.strain);
        group.bench_function(format!("the converged tick, {} steps", tick.steps), |bencher| {
            bencher.iter_batched(
                unbend,
                |()| {
                    let Plot { plants, site, .. } = &mut *plot.borrow_mut();
                    black_box(bend(&mut plants[0], self.until(), site, &mut scratch))
                },
                BatchSize::PerIteration,
            );
        });
        group.finish();
    }

    /// From the seed to `until`, bending at every tick, against the same growth alone.
    pub fn life(&self, criterion: &mut Criterion, until: Tick) {
        let model = self.wooden();
        let seed = seed_of(&self.resolved.scenario, 0);
        let mut plot = Plot::of_one(&model, &seed);
        grow(&mut plot, until, &mut ()).expect("nothing is written");
        let internodes = plot.plants[0].nodes.len() as u64;
        let what = format!("{until} ticks of life (internodes)");
        let mut group = self.group(criterion, &what, Throughput::Elements(internodes));
        group.bench_function(format!("growth of {internodes} with bending at every tick"), |bencher| {
            bencher.iter(|| {
                plot.resow(&seed);
                grow(&mut plot, until, &mut ()).expect("nothing is written");
                black_box(&plot);
            });
        });
        group.bench_function("growth alone (baseline)", |bencher| {
            bencher.iter(|| {
                plot.resow(&seed);
                grow_alone(&mut plot, until);
                black_box(&plot);
            });
        });
        group.finish();
    }
}
