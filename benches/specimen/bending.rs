//! Bending: what a step and a converged tick cost beside the pose at rest, and a whole life with bending at every tick.
//!
//! A specimen without wood of its own is given that of a birch. Absent: whether it bends rightly.

use super::Specimen;
use criterion::{BatchSize, Criterion, Throughput};
use phytomer::config::Model;
use phytomer::models::buds::BudModel;
use phytomer::models::buds::params::Wood;
use phytomer::models::fault::Path;
use phytomer::run::seed_of;
use phytomer::sim::mechanics::bend;
use phytomer::sim::pose::pose;
use phytomer::sim::{GrowthModel, Plot, RecordError, Recorder, Tick, grow};
use std::cell::RefCell;
use std::hint::black_box;

/// Wants no age.
struct Nobody;

impl Recorder for Nobody {
    fn wants(&self, _: Tick) -> bool {
        false
    }

    fn record(&mut self, _: Tick, _: &Plot) -> Result<(), RecordError> {
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

    /// One step of a plant that is in equilibrium already, and a tick that bends it from rest until it is, against the
    /// pose at rest. Both find what stands and freeze the curvature first.
    pub fn bending(&self, criterion: &mut Criterion) {
        let model = self.wooden();
        let mut plot = Plot::of_one(&model, &seed_of(&self.resolved.scenario, 0));
        model.grow_to(self.until(), &mut plot.plants, &plot.site).expect("room to grow");
        model.thicken(self.until(), &mut plot.plants[0]);
        let mut rest = plot.plants[0].clone();
        let first = bend(&mut plot.plants[0], self.until(), &plot.site, &mut plot.bench);
        let again = bend(&mut plot.plants[0], self.until(), &plot.site, &mut plot.bench);
        assert!(first.settled && again.steps == 1, "{first:?}, then {again:?}");
        let internodes = rest.nodes.len() as u64;
        let mut group = self.group(criterion, "bending (internodes)", Throughput::Elements(internodes));
        group.bench_function("the pose at rest (baseline)", |bencher| {
            bencher.iter(|| {
                rest.frames.clear();
                pose(&mut rest);
            });
        });
        group.bench_function("one step, in equilibrium", |bencher| {
            bencher.iter(|| black_box(bend(&mut plot.plants[0], self.until(), &plot.site, &mut plot.bench)));
        });
        let plot = RefCell::new(plot);
        let unbend = || plot.borrow_mut().plants[0].strain.clear();
        group.bench_function(format!("a converged tick from rest, {} steps", first.steps), |bencher| {
            bencher.iter_batched(
                unbend,
                |()| {
                    let Plot { plants, site, bench, .. } = &mut *plot.borrow_mut();
                    black_box(bend(&mut plants[0], self.until(), site, bench))
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
        grow(&model, &mut plot, until, &mut Nobody).expect("nothing is written");
        let internodes = plot.plants[0].nodes.len() as u64;
        let what = format!("{until} ticks of life (internodes)");
        let mut group = self.group(criterion, &what, Throughput::Elements(internodes));
        group.bench_function(format!("growth of {internodes} with bending at every tick"), |bencher| {
            bencher.iter(|| {
                plot.resow(&model, &seed);
                grow(&model, &mut plot, until, &mut Nobody).expect("nothing is written");
                black_box(&plot);
            });
        });
        group.bench_function("growth alone (baseline)", |bencher| {
            bencher.iter(|| {
                plot.resow(&model, &seed);
                model.grow_to(until, &mut plot.plants, &plot.site).expect("room to grow");
                black_box(&plot);
            });
        });
        group.finish();
    }
}
