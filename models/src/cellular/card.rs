//! The cards of the models of cellular branching: their names and their sources.
//!
//! Absent: their parameters, which stand with each model.

use super::{Cohen, Greene, Ulam};
use crate::fault::{Fault, Path};
use crate::parameters::{Card, Keys, Parameters};
use phytomer_sim::Tick;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::site::calendar::Dates;
use std::sync::Arc;

impl Ulam {
    /// The card of this model.
    pub const CARD: Card = Card {
        word: "ulam",
        about: "cells of a plane grid, each coloured when one coloured cell alone faces it (Ulam 1962)",
        keys: Keys::PLAIN,
    };
}

impl Greene {
    /// The card of this model.
    pub const CARD: Card = Card {
        word: "greene",
        about: "segments by trials in voxels, around obstacles and towards the light (Greene 1989)",
        keys: Keys::PLAIN,
    };
}

impl Cohen {
    /// The card of this model.
    pub const CARD: Card = Card {
        word: "cohen",
        about: "tips that keep their way and turn from what has grown (Cohen 1967)",
        keys: Keys::PLAIN,
    };
}

macro_rules! parameters {
    ($($model:ty),+) => {
        $(impl Parameters for $model {
            fn card(&self) -> &'static Card {
                &Self::CARD
            }

            fn model(&self, until: Tick, _: Option<&Dates>, top: &Path) -> Result<Arc<dyn GrowthModel>, Vec<Fault>> {
                Ok(Arc::new(self.compile(until, top)?))
            }
        })+
    };
}

parameters!(Ulam, Greene, Cohen);
