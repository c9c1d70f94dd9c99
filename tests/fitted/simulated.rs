//! Plants of the shipped species, or draws of a law alone, and the growth units that they make.
//!
//! Seeds are fixed. Orders that a data set does not need are cut off, since no axis depends on the axes that it bears;
//! and so are responses, since each has its reference.

use phytomer_config::{Model, validate_species};
use phytomer_models::buds::params::GrowthUnit;
use phytomer_models::buds::{Buds, Order};
use phytomer_models::fault::Path;
use phytomer_models::law::Count;
use phytomer_sim::plant::{Plant, Seed};
use phytomer_sim::{Plot, Tick};

/// A shipped species with only its first orders.
pub fn shipped(name: &str, orders: usize) -> Buds {
    let species = validate_species(name, 1).unwrap_or_else(|report| panic!("{}", report.render(false))).species;
    let Model::Buds(mut buds) = species.model else { panic!("{name} is not of the bud model") };
    buds.order.truncate(orders);
    // In the light and on the ground of the measured trees responses change nothing, and they name orders that are cut.
    buds.response.clear();
    buds
}

/// Plants 0, 1, 2 … of a species, grown to `until`.
pub fn grown(buds: &Buds, plants: u32, until: Tick) -> Vec<Plant> {
    let model = buds.compile(until, &Path::root()).unwrap_or_else(|faults| panic!("{faults:?}"));
    let grow = |plant| {
        let seed = Seed { plant, draws: plant.into(), run_seed: 1988, component_limit: 20_000_000, keep_events: false };
        let mut plot = Plot::of_one(&model, &seed);
        plot.grow_to(until).expect("within the limit");
        plot.plants.remove(0)
    };
    (0..plants).map(grow).collect()
}

/// A growth unit: the order of its axis, its number on the axis from 1, and its number of nodes.
#[derive(Debug, Clone, Copy)]
pub struct Unit {
    pub order: u8,
    /// The state in which its axis started.
    pub state: u8,
    pub number: u32,
    pub nodes: usize,
}

/// The growth units of a plant that have nodes, in the order of the columns.
pub fn units(plant: &Plant) -> Vec<Unit> {
    let mut made = vec![0; plant.axes.len()];
    let mut units: Vec<Unit> = Vec::new();
    let mut last = vec![0; plant.axes.len()];
    for node in 0..plant.nodes.len() {
        let axis = plant.nodes.axis[node];
        let place = axis.index();
        if plant.nodes.unit_rank[node] == 1 {
            made[place] += 1;
            last[place] = units.len();
            let (order, state) = (plant.axes.order[place], plant.axes.state[place]);
            units.push(Unit { order, state, number: made[place], nodes: 0 });
        }
        units[last[place]].nodes += 1;
    }
    units
}

/// The nodes of a hundred thousand growth units of a law.
pub fn drawn(nodes: Count) -> Vec<usize> {
    let growth_unit = GrowthUnit { nodes, ..GrowthUnit::default() };
    let buds = Buds { order: vec![Order { growth_unit, ..Order::default() }], ..Buds::default() };
    grown(&buds, 1000, 100).iter().flat_map(units).map(|unit| unit.nodes).collect()
}
