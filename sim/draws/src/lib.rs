//! Draws of a site: what chance brings to a field beyond the growth of its plants, such as which plants are susceptible
//! to a pest, where its clusters stand, and how the soil differs between blocks.
//!
//! The samplers of Beta, Gamma, Poisson and Normal are those of `rand_distr`. They reject, and so take a number of
//! words that depends on the draw: each event has a stream of its own ([`Key`]), and no draw moves another. They are
//! given a float of ours ([`Real`]), because those for `f64` call the system's `ln` and `exp` where any crate of the
//! build switches on `num-traits/std`, and then draw other bits on other machines. Absent: the draws of growth
//! (`phytomer_sim::random`), and the keys of scenarios.

mod aggregation;
mod clusters;
mod draws;
mod key;
mod real;

pub use aggregation::Aggregation;
pub use clusters::Clusters;
pub use draws::Draws;
pub use key::{Event, Key, NONE};
pub use real::Real;

/// Why a distribution cannot be drawn from.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum DrawError {
    /// A parameter lies outside the range in which the sampler is used.
    #[error("{name} is {value}, and must be from {least} to {most}")]
    Outside {
        /// The parameter.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The least value that it may have.
        least: f64,
        /// The largest value that it may have.
        most: f64,
    },
    /// Clusters overlap so much that their parents are too many to draw.
    #[error("{parents} clusters are expected within {across_m} m, at most 10000 can be drawn")]
    Crowded {
        /// The expected number of clusters in a cell.
        parents: f64,
        /// The side of the cell, metres.
        across_m: f64,
    },
}

/// The value of a parameter, if it is within `least..=most`; NaN is not.
fn within(name: &'static str, value: f64, least: f64, most: f64) -> Result<f64, DrawError> {
    if (least..=most).contains(&value) { Ok(value) } else { Err(DrawError::Outside { name, value, least, most }) }
}
