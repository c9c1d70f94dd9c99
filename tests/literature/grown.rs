//! Plants for the literature tests: grown, counted, averaged.
//!
//! A bound is 4 standard errors of the tested sample, never a guess. Absent: the claims, which are in the other files.

use phytomer_models::buds::{BudModel, Buds};
use phytomer_models::fault::Path;
use phytomer_sim::plant::Seed;
use phytomer_sim::{Plant, Plot, Tick};

/// Plants of each statistical test.
pub const PLANTS: u32 = 20_000;

/// The bud model of a shipped species.
pub fn shipped(name: &str, until: Tick) -> BudModel {
    let species = phytomer_config::validate_species(name, until).unwrap_or_else(|report| panic!("{name}: {report}"));
    match species.species.model {
        phytomer_config::Model::Buds(buds) => compiled(&buds, until),
        other => panic!("{name} is not of the bud model: {other:?}"),
    }
}

/// A species, compiled.
pub fn compiled(buds: &Buds, until: Tick) -> BudModel {
    buds.compile(until, &Path::root()).unwrap_or_else(|faults| panic!("{faults:?}"))
}

/// Plant number `plant`, grown to `until` and shed.
pub fn plant(model: &BudModel, plant: u32, until: Tick) -> Plant {
    let seed = Seed { plant, draws: plant.into(), run_seed: 1988, component_limit: 10_000_000, keep_events: false };
    let mut plot = Plot::of_one(model, &seed);
    plot.grow_to(until).expect("within the limit");
    plot.plants.remove(0)
}

/// The growth units of each order by the age `age`: nodes, where a growth unit has one.
pub fn units_by_order(plant: &Plant, age: Tick) -> Vec<u64> {
    let mut units = vec![0; 3];
    for node in 0..plant.nodes.len() {
        if plant.nodes.birth[node] <= age {
            let order = plant.axes.order[plant.nodes.axis[node].index()];
            units[usize::from(order) - 1] += 1;
        }
    }
    units
}

/// The moments of a sample.
#[derive(Debug, Default, Clone)]
pub struct Sample {
    values: Vec<f64>,
}

impl Sample {
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        Self { values: values.into_iter().collect() }
    }

    pub fn n(&self) -> f64 {
        self.values.len() as f64
    }

    pub fn mean(&self) -> f64 {
        self.values.iter().sum::<f64>() / self.n()
    }

    fn central(&self, power: i32) -> f64 {
        let mean = self.mean();
        let powered = |x: &f64| (0..power).fold(1.0, |product, _| product * (x - mean));
        self.values.iter().map(powered).sum::<f64>() / self.n()
    }

    pub fn variance(&self) -> f64 {
        self.central(2) * self.n() / (self.n() - 1.0)
    }

    /// Within 4 standard errors of the mean.
    pub fn assert_mean(&self, expected: f64, what: &str) {
        let error = (self.variance() / self.n()).sqrt();
        let found = self.mean();
        assert!((found - expected).abs() <= 4.0 * error, "{what}: mean {found}, expected {expected} ± 4 × {error}");
    }

    /// Within 4 standard errors of the variance: its own variance is (μ₄ − σ⁴)/n.
    pub fn assert_variance(&self, expected: f64, what: &str) {
        let (found, fourth) = (self.variance(), self.central(4));
        let error = ((fourth - found * found) / self.n()).sqrt();
        assert!((found - expected).abs() <= 4.0 * error, "{what}: variance {found}, expected {expected} ± 4 × {error}");
    }
}
