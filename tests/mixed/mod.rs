//! A run of plots of several plants, written by the library as a run writes it: bushes of the bud model, and trunks of
//! a D0L-system that is rewritten in mid-axis (F → F F), so that columns are in another order than component numbers.
//!
//! The plants of a plot are sown at three ticks, and their numbers are in another order than their places in the plot.

use phytomer::config::{Resolved, validate_texts};
use phytomer::outputs::{Mode, RunFolder};
use phytomer::run::{Program, plan_of};
use phytomer::sim::plant::Seed;
use phytomer::sim::{GrowthModel, Plot, Sowing, Tick, grow};
use std::path::Path;

/// The plots of the run.
pub const PLOTS: u32 = 3;

/// The names of the species, by their places.
pub const SPECIES: [&str; 2] = ["bush", "doubling"];

/// The members of each plot: species, the plant's number in the plot, sowing tick.
pub const MEMBERS: [(usize, u32, Tick); 3] = [(0, 2, 0), (1, 0, 3), (0, 1, 5)];

/// The treatments of the plots, by turns.
pub const TREATMENTS: [&str; 2] = ["control", "shade"];

const BUSH: &str = include_str!("../data/runs/bush.toml");

const DOUBLING: &str = "name = \"doubling\"\nmodel = \"lsystem\"\ntick = \"a step\"\naxiom = \"F\"\n\
                        production = { F = \"FF\" }\nbranching_deg = 45\n[cell.F]\nlength_m = 0.01\n";

fn resolved(species: &str) -> Resolved {
    let scenario = format!(
        "name = \"mixed\"\nspecies = \"{species}\"\nplants = {PLOTS}\nseed = 7\n\
         ages = {{ until = 12, record = [0, 2, 3, 4, 8, 12] }}\noutput = {{ plants_per_part = 2 }}\n"
    );
    let texts = [("mixed", scenario.as_str()), ("bush", BUSH), ("doubling", DOUBLING)];
    validate_texts("mixed", &texts).unwrap_or_else(|report| panic!("{}", report.render(false)))
}

/// A plot with its number, of these models.
fn sown<'m>(id: u32, models: [&'m dyn GrowthModel; 2]) -> Plot<'m> {
    let sowings = MEMBERS.map(|(species, in_plot, sown)| {
        let plant = id * MEMBERS.len() as u32 + in_plot;
        let seed = Seed { plant, draws: plant.into(), run_seed: 7, component_limit: 1_000_000, keep_events: true };
        Sowing { species, seed, place: [f64::from(plant), 0.0, 0.0], sown }
    });
    let mut plot = Plot::new(id, models.to_vec(), &sowings);
    (plot.treatment, plot.replicate) = (id % 2, id / 2);
    plot
}

/// Writes the run folder.
pub fn write(path: &Path) {
    let [bush, doubling] = SPECIES.map(resolved);
    let mut plan = plan_of(&bush, &Program::default()).expect("a plan");
    plan.provenance.species = SPECIES.map(str::to_owned).to_vec();
    plan.provenance.ticks_per_year = [&bush, &doubling].map(|of| of.species.ticks_per_year()).to_vec();
    plan.provenance.treatments = TREATMENTS.map(str::to_owned).to_vec();
    let folder = RunFolder::create(path, plan, Mode::New).expect("a run folder");
    for shard in folder.missing_shards() {
        let mut open = folder.shard(shard).expect("a shard");
        for id in folder.plan().plots_of(shard) {
            let mut plot = sown(id, [bush.model.as_ref(), doubling.model.as_ref()]);
            let ending = grow(&mut plot, folder.plan().until, &mut open).expect("a plot that is written");
            open.end_plot(&plot, ending).expect("its end");
        }
        open.commit().expect("a shard that is whole");
    }
    folder.finish(&[]).expect("a run that is whole");
}
