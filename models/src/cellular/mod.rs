//! Cellular branching (Prusinkiewicz & Lindenmayer 1990, *The Algorithmic Beauty of Plants*, ch. 2): plants that grow
//! into space and heed what already stands there.
//!
//! Three models, each its parameters and its rule: [`Ulam`] colours the cells of a plane grid, [`Greene`] grows a vine
//! by trials in voxels, [`Cohen`] sends tips through a field of density. Each adds internodes to the plant by `body`,
//! and keeps its own picture of space in the plant's life. They make their plants anew from the seed where an earlier
//! age is asked; what was cut off would leave its space to others, so that the rest would not grow on as it did, and
//! plants of these models are not cut. Greene's plants of one plot claim their voxels from one another. Absent:
//! secondary growth and organs.

mod around;
mod body;
mod card;
mod cohen;
mod colony;
mod density;
mod foretold;
mod greene;
mod grid;
mod sky;
mod space;
mod stated;
mod surface;
mod thicket;
mod ulam;
mod voxels;

pub use cohen::Cohen;
pub use colony::CohenModel;
pub use greene::{Greene, Preferences};
pub use thicket::GreeneModel;
pub use ulam::{Grid, Plane, Ulam, UlamModel};

#[cfg(test)]
mod tests_cohen;
#[cfg(test)]
mod tests_greene;
#[cfg(test)]
mod tests_shared;
#[cfg(test)]
mod tests_surface;
#[cfg(test)]
mod tests_ulam;
