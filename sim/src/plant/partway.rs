//! What a plant that is shown between two ticks has beside its columns.
//!
//! Such a plant is made by [`crate::between`] and never grown on. It stands at the age of the later tick, at which all
//! that stood at the earlier one still stands, and each pass that asks for an age is given the later tick. Lengths,
//! diameters, curvatures and frames are those of the moment; sizes and places of organs follow from what is kept here.
//! A plant at a tick has none of this. Absent: how the values come about.

use super::Plant;
use super::handle::OrganId;
use super::placing::Placed;
use crate::clock::Tick;

/// The state between two ticks.
#[derive(Debug, Clone, Default)]
pub struct Partway {
    /// The share of the tick that has passed, between 0 and 1.
    pub(crate) share: f32,
    /// The share of its full size that each organ has.
    pub(crate) sizes: Vec<f32>,
    /// How far each organ has dropped on its way to the ground, from 0 to 1; empty where none drops.
    pub(crate) drops: Vec<f32>,
    /// How each organ stands in the frame of its node; empty where insertion and trend tell it.
    pub(crate) organs: Vec<Placed>,
}

impl Plant {
    /// The share of the tick that has passed, of a plant that is shown between two ticks.
    #[inline]
    pub fn partway(&self) -> Option<f32> {
        self.partway.as_ref().map(|partway| partway.share)
    }

    /// The age that a plant shows which stands at a tick: that of the tick, or less where it is shown before it; to a
    /// millionth.
    pub fn shown_age(&self, age: Tick) -> f64 {
        let age = f64::from(age);
        self.partway().map_or(age, |share| ((age - 1.0 + f64::from(share)) * 1e6).round() / 1e6)
    }

    /// The last tick by which what has fallen does not stand at `age` any more: of a plant that is shown between two
    /// ticks the one before.
    #[inline]
    pub fn fallen_by(&self, age: Tick) -> Tick {
        age - Tick::from(self.partway.is_some())
    }

    /// How far an organ has dropped.
    #[inline]
    pub(crate) fn dropped(&self, organ: OrganId) -> f32 {
        self.partway.as_ref().and_then(|partway| partway.drops.get(organ.index())).copied().unwrap_or(0.0)
    }
}
