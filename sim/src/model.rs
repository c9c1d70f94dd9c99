//! What a growth model is to the loop: something that sows a plant and grows it to an age.
//!
//! The trait is called once a tick and plot, never once a node. Absent: parameters, species and files; a model's own
//! crate knows them.

use crate::clock::Tick;
use crate::expectation::Expectation;
use crate::plant::{Habit, Plant};
use crate::site::Site;
use std::sync::Arc;

/// How a model goes from one age to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Growth {
    /// It adds to the plant that stands there (buds, L-systems); many ticks at once, or one by one, with one result.
    Extends,
    /// It makes the plant anew at each age (geometric and parametric models).
    Rebuilds,
}

/// A plant came to its limit of components.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("plant {plant} came to its limit of {limit} components")]
pub struct Overgrown {
    /// The plant's number in the run.
    pub plant: u32,
    /// The limit.
    pub limit: u32,
}

/// A growth model with its parameters, compiled and checked.
pub trait GrowthModel: Send + Sync {
    /// Whether it extends or rebuilds.
    fn growth(&self) -> Growth;

    /// What its plants carry of their species.
    fn habit(&self) -> Arc<Habit>;

    /// Puts the first bud into an empty plant.
    fn sow(&self, plant: &mut Plant);

    /// Grows each plant from its age to `age`: topology, rest geometry, fates of buds and organs.
    ///
    /// # Errors
    /// [`Overgrown`] where a plant would pass its limit of components; the plant then holds part of its growth.
    fn grow_to(&self, age: Tick, plants: &mut [Plant], site: &Site) -> Result<(), Overgrown>;

    /// Writes the diameters of each internode as they are at `age`, by the model's law; where the species states
    /// another rule of secondary growth, the loop applies that one after it.
    fn thicken(&self, age: Tick, plant: &mut Plant);

    /// The means of what a plant makes up to `until`, or bounds or estimates of them, as it says; `None` where the
    /// model has none.
    fn expectation(&self, until: Tick) -> Option<Expectation> {
        let _ = until;
        None
    }
}
