//! Plots of several plants for the tests of this crate: two species, sown at different ticks, with plant numbers in
//! another order than the places in the plot.
//!
//! The first species is the sapling (`specimen`). The second is a trunk that its model rewrites in the middle, so that
//! its columns are in another order than its component numbers.

use crate::specimen::{Sapling, grow_plots, plan};
use crate::{Mode, RunFolder, RunPlan, RunReport};
use phytomer_sim::model::Overgrown;
use phytomer_sim::plant::{AxisId, EventKind, Habit, LineageKey, NewAxis, NewNode, NodeId, Plant, Seed};
use phytomer_sim::site::View;
use phytomer_sim::{Grow, Growth, GrowthModel, Plot, Sowing, Tick};
use std::path::Path;
use std::sync::Arc;

/// The names of the species of the plots.
pub const SPECIES: [&str; 2] = ["sapling", "doubling"];

/// The members of each plot: the index of the species, the plant's number in the plot, and the tick of sowing.
pub const MEMBERS: [(usize, u32, Tick); 3] = [(0, 2, 0), (1, 0, 3), (0, 1, 5)];

/// A trunk in which each internode gets a new internode above it at each of its first four ticks, and keeps its number:
/// F → F F. So any internode may be new, and the rank of an old internode changes.
pub struct Doubling;

/// The last tick of doubling.
const DOUBLES_UNTIL: Tick = 4;

impl Grow for Doubling {
    /// The component number and the birth of each internode, from the base to the tip.
    type Life = Vec<(u32, Tick)>;

    fn growth(&self) -> Growth {
        Growth::Rewrites
    }

    fn habit(&self) -> Arc<Habit> {
        Grow::habit(&Sapling)
    }

    fn sow(&self, plant: &mut Plant) -> Self::Life {
        plant.name_by_number();
        plant.next_number();
        let life = vec![(plant.next_number(), 0)];
        draw(&life, plant);
        life
    }

    fn grow_to(&self, age: Tick, plant: &mut Plant, life: &mut Self::Life, _: &View<'_>) -> Result<(), Overgrown> {
        for tick in plant.age + 1..=age.min(DOUBLES_UNTIL) {
            if !plant.has_room_for(life.len() as u32) {
                return Err(Overgrown::of(plant));
            }
            plant.note(tick, AxisId::TRUNK, EventKind::Grew, life.len() as u32);
            *life = life.iter().flat_map(|&old| [old, (plant.next_number(), tick)]).collect();
        }
        plant.begin_rewriting();
        draw(life, plant);
        plant.age = age;
        Ok(())
    }

    fn thicken(&self, age: Tick, plant: &mut Plant) {
        Grow::thicken(&Sapling, age, plant);
    }
}

fn draw(life: &[(u32, Tick)], plant: &mut Plant) {
    let axis = plant.place_axis(NewAxis { key: LineageKey::SEED, ..NewAxis::OF_THE_SEED }, 0);
    let mut parent = NodeId::NONE;
    for (rank, &(number, birth)) in (1..).zip(life) {
        let (unit_rank, trend, length, diameter, azimuth) = (1, 0, 0.1, 0.01, 0.0);
        let (short, neoformed) = (false, false);
        let new = NewNode { parent, axis, birth, rank, unit_rank, short, neoformed, trend, length, diameter, azimuth };
        parent = plant.place_node(new, number);
    }
}

/// The growth model of a species, by its index.
pub fn model(species: usize) -> &'static dyn GrowthModel {
    if species == 0 { &Sapling } else { &Doubling }
}

/// The seed of the plant with the number `plant`.
pub fn seed(plant: u32, component_limit: u32) -> Seed {
    Seed { plant, draws: plant.into(), run_seed: 42, component_limit, keep_events: true }
}

/// The number of a plant of a plot. Numbers are dealt across plots: each plot has some of the first plants.
pub fn number_of(plot: u32, in_plot: u32, plots: u32) -> u32 {
    plot + plots * in_plot
}

/// A plot of three plants in a run of `plots` plots; the two treatments alternate from plot to plot.
pub fn mixed(id: u32, plots: u32, component_limit: u32) -> Plot<'static> {
    let sowings = MEMBERS.map(|(species, in_plot, sown)| Sowing {
        species,
        seed: seed(number_of(id, in_plot, plots), component_limit),
        place: [f64::from(in_plot), 0.0, 0.0],
        sown,
    });
    let mut plot = Plot::new(id, vec![model(0), model(1)], &sowings);
    (plot.treatment, plot.replicate) = (id % 2, id / 2);
    plot
}

/// A plan of `plots` such plots.
pub fn mixed_plan(plots: u32, plots_per_part: u32) -> RunPlan {
    let mut plan = plan(plots, plots_per_part);
    plan.recorded.insert(0, 0);
    plan.provenance.treatments = ["control", "shade"].map(str::to_owned).to_vec();
    plan.provenance.species = SPECIES.map(str::to_owned).to_vec();
    plan.provenance.states = vec![vec!["young".to_owned(), "old".to_owned()]; SPECIES.len()];
    plan.provenance.ticks_per_year = vec![Some(4.0); SPECIES.len()];
    plan
}

/// A whole run of such plots.
pub fn run_mixed(path: &Path, plan: RunPlan) -> RunReport {
    let folder = RunFolder::create(path, plan, Mode::New).unwrap();
    grow_missing(&folder);
    folder.finish(&[("growth", 0.5)]).unwrap()
}

/// Grows the missing shards of a run of such plots.
pub fn grow_missing(folder: &RunFolder) {
    let plots = folder.plan().plots;
    for shard in folder.missing_shards() {
        grow_plots(folder, shard, |id| mixed(id, plots, 100_000));
    }
}
