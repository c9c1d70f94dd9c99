//! The site around the plants of a plot: what its date brings, and whether it feeds anything back to the buds.
//!
//! Today a site is open ground under gravity alone. Light, obstacles, events of the date and wind belong here.

use crate::clock::Tick;

/// The ground that the plants of one plot share.
#[derive(Debug, Clone, Default)]
pub struct Site {
    /// The age of the plot: the last tick that has begun.
    pub age: Tick,
}

impl Site {
    /// Opens a tick.
    pub fn begin(&mut self, age: Tick) {
        self.age = age;
    }

    /// Whether the buds feel what stands around them, so that growth must follow the clock. Nothing does so yet.
    pub fn feeds_back(&self) -> bool {
        false
    }
}
