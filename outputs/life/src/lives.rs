//! The lives of all plants of a plot, recorded while it grows.
//!
//! A plant's life begins when it is sown, and its ages are its own. Lives are told from each plant's seed; a
//! [`Life`](super::Life) has the place of it. Between two ticks plants may be shown too, so that what appears grows
//! instead of standing there at once.

use super::{Life, Maker, Nearness};
use phytomer_meshes::MeshOptions;
use phytomer_sim::between::Passage;
use phytomer_sim::plant::Plant;
use phytomer_sim::{Plot, RecordError, Recorder, Tick};

/// The first moment that is shown after a tick, as a share of the next: what appears has its first key there, next to
/// nothing.
const BEGINS: f32 = 1.0 / 1024.0;

/// Records the lives of a plot.
#[derive(Debug)]
pub struct Lives {
    nearness: Nearness,
    /// The options of each species, in the order of the plot's.
    options: Vec<MeshOptions>,
    /// The ticks that are shown, in their order; all where there are none.
    ticks: Vec<Tick>,
    /// The shares of a tick at which plants are shown.
    shares: Vec<f32>,
    passage: Passage,
    makers: Vec<Option<Maker>>,
}

impl Lives {
    /// Lives this near to the plants, at some ticks of the plot in their order, or at all where none are named. Species
    /// without options have the default.
    pub fn new(nearness: Nearness, options: Vec<MeshOptions>, ticks: Vec<Tick>) -> Self {
        let (shares, passage, makers) = (Vec::new(), Passage::default(), Vec::new());
        Self { nearness, options, ticks, shares, passage, makers }
    }

    /// Shows the plants in so many steps, at least 1, from each tick to the next where both are shown: what appears
    /// grows, and what falls goes at the end of its tick. With `falls`, leaves, petals and fruits drop to the ground
    /// before they go. In one step a growth unit grows evenly; in more its nodes follow one another.
    #[must_use]
    pub fn between(mut self, steps: u32, falls: bool) -> Self {
        let step = |k: u32| k as f32 / steps as f32;
        self.shares = [BEGINS].into_iter().chain((1..steps).map(step).filter(|share| *share > BEGINS)).collect();
        self.passage = Passage::new(falls);
        self
    }

    /// The life of each member of the plot, in its order; `None` for a member that was never sown.
    pub fn finish(self) -> Vec<Option<Life>> {
        self.makers.into_iter().map(|maker| maker.map(Maker::finish)).collect()
    }

    fn show(&mut self, member: usize, species: usize, plant: &Plant, age: Tick) {
        let options = || self.options.get(species).cloned().unwrap_or_default();
        self.makers[member].get_or_insert_with(|| Maker::new(self.nearness, &options())).show(plant, age);
    }

    /// Shows the plants on their way to a tick.
    fn show_ways(&mut self, tick: Tick, plot: &Plot) {
        let mut passage = std::mem::take(&mut self.passage);
        passage.arrive(tick, plot);
        for share in self.shares.clone() {
            for (member, way) in passage.at(share).into_iter().enumerate() {
                if let Some((plant, age)) = way {
                    self.show(member, plot.members[member].species, plant, age);
                }
            }
        }
        passage.keep(tick, plot);
        self.passage = passage;
    }
}

impl Recorder for Lives {
    fn wants(&self, tick: Tick) -> bool {
        self.ticks.is_empty() || self.ticks.binary_search(&tick).is_ok()
    }

    fn record(&mut self, tick: Tick, plot: &Plot) -> Result<(), RecordError> {
        self.makers.resize(plot.plants.len(), None);
        if !self.shares.is_empty() {
            self.show_ways(tick, plot);
        }
        for (number, (plant, member)) in plot.plants.iter().zip(&plot.members).enumerate() {
            if let Some(age) = member.age_at(tick) {
                self.show(number, member.species, plant, age);
            }
        }
        Ok(())
    }
}
