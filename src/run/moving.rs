//! A plant in moving air, for one frame: by the law of sway of its model, where that has one, else by mechanics.
//!
//! Absent: the laws (`phytomer_sim::mechanics::sway`, and the growth models).

use phytomer_sim::gusts::Gusts;
use phytomer_sim::mechanics::Scratch;
use phytomer_sim::mechanics::sway::sway;
use phytomer_sim::plant::Plant;
use phytomer_sim::pose::pose;
use phytomer_sim::site::Wind;
use phytomer_sim::{Plot, RecordError, Tick};

/// Air that moves a plant for one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Air {
    /// Its gusty wind.
    pub wind: Wind,
    /// By how much gusts are faster, m/s, where the model has a law of sway of its own.
    pub gust: f64,
    /// The length of a film that closes, seconds, where the model has such a law.
    pub closes: Option<f64>,
    /// The moment, seconds.
    pub time: f64,
}

/// Moves a plant of a plot in the air: by the law of its model, where that has one, else by mechanics.
pub(super) fn moved(plant: &mut Plant, age: Tick, plot: &Plot, species: usize, air: Air) -> Result<(), RecordError> {
    let model = plot.species[species];
    if !model.sways() {
        return Ok(sway(plant, age, &plot.site, air.wind, air.time, &mut Scratch::default())?);
    }
    model.sway(plant, &Gusts { speed: air.wind.speed, gust: air.gust, time: air.time, closes: air.closes });
    pose(plant, age);
    Ok(())
}
