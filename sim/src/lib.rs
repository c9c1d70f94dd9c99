//! The plant, its clock, its random draws, its pose and the loop that grows it.
//!
//! Absent on purpose: files, TOML, Arrow, triangles and species.

pub mod between;
pub mod cells;
pub mod clock;
pub mod expectation;
pub mod grow;
pub mod gusts;
pub mod key;
mod lit;
mod managed;
pub mod management;
pub mod math;
pub mod mechanics;
pub mod model;
pub mod plant;
pub mod plot;
pub mod pose;
pub mod random;
pub mod record;
pub mod rotation;
pub mod shape;
pub mod shed;
pub mod site;
mod vector;

pub use clock::{NEVER, Tick};
pub use grow::{Ending, grow, grow_and_look};
pub use model::{Grow, Growth, GrowthModel, Life, Overgrown};
pub use plant::Plant;
pub use plot::{Member, Plot, Sowing};
pub use record::{RecordError, Recorder};

#[cfg(test)]
mod tests_cells;
