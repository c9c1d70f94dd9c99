//! What recorded runs say: measures of populations of simulated plants, one a file, from the tables alone.
//!
//! Nothing here runs a model; the same measures hold for any tables of the same schema.

pub mod architecture;
mod population;

pub use population::{AgeOfPopulation, Moments, population};
