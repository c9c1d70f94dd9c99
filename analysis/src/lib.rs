//! Analysis of recorded runs: measures, population statistics by age, and the architectural models that plants qualify
//! for.
//!
//! Everything is computed from the tables of a run, or from rows of the same schema made in memory. Nothing here grows
//! a plant.

pub mod architecture;
pub mod measure;
mod population;

pub use phytomer_measures::Moments;
pub use population::{AgeOfPopulation, population};
