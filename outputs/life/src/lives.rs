//! The lives of all plants of a plot, recorded while it grows.
//!
//! A plant's life begins when it is sown, and its ages are its own. Lives are told from each plant's seed; a
//! [`Life`](super::Life) has the place of it.

use super::{Life, Maker, Nearness};
use phytomer_meshes::MeshOptions;
use phytomer_sim::{Plot, RecordError, Recorder, Tick};

/// Records the lives of a plot.
#[derive(Debug)]
pub struct Lives {
    nearness: Nearness,
    /// The options of each species, in the order of the plot's.
    options: Vec<MeshOptions>,
    /// The ticks that are shown, in their order; all where there are none.
    ticks: Vec<Tick>,
    makers: Vec<Option<Maker>>,
}

impl Lives {
    /// Lives this near to the plants, at some ticks of the plot in their order, or at all where none are named. Species
    /// without options have the default.
    pub fn new(nearness: Nearness, options: Vec<MeshOptions>, ticks: Vec<Tick>) -> Self {
        Self { nearness, options, ticks, makers: Vec::new() }
    }

    /// The life of each member of the plot, in its order; `None` for a member that was never sown.
    pub fn finish(self) -> Vec<Option<Life>> {
        self.makers.into_iter().map(|maker| maker.map(Maker::finish)).collect()
    }
}

impl Recorder for Lives {
    fn wants(&self, tick: Tick) -> bool {
        self.ticks.is_empty() || self.ticks.binary_search(&tick).is_ok()
    }

    fn record(&mut self, tick: Tick, plot: &Plot) -> Result<(), RecordError> {
        self.makers.resize(plot.plants.len(), None);
        for ((plant, member), maker) in plot.plants.iter().zip(&plot.members).zip(&mut self.makers) {
            let Some(age) = member.age_at(tick) else { continue };
            let options = || self.options.get(member.species).cloned().unwrap_or_default();
            maker.get_or_insert_with(|| Maker::new(self.nearness, &options())).show(plant, age);
        }
        Ok(())
    }
}
