//! Analysis of recorded runs: population statistics by age, and the architectural models that plants qualify for.
//!
//! Everything is computed from the tables of a run, or from rows of the same schema made in memory. Nothing here grows
//! a plant.

pub mod architecture;
mod population;

pub use population::{AgeOfPopulation, Moments, population};
