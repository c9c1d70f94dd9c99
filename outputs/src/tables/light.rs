//! The values of light in `summary` and `site`, from the light that a plot has when it is recorded.
//!
//! Absent: light itself (`phytomer_sim::site::light`).

use super::site::GroundLight;
use super::summary::SummaryColumns;
use phytomer_sim::site::light::Borders;
use phytomer_sim::{Plot, Tick};

/// The places along each side of the ground from which rays go to the light.
const RAYS: u32 = 16;

impl GroundLight {
    /// That of a plot as it stands at `tick`, whose plants have so much ground each, m².
    pub fn of(plot: &Plot, tick: Tick, ground_of_plant: Option<f64>) -> Self {
        let none = Self { leaf_area: 0.0, ground: f64::NAN, share: f64::NAN, plots: 1 };
        let Some(light) = &plot.site.light else { return none };
        let Some(field) = light.found.as_deref() else { return none };
        let of_members = ground_of_plant.map(|of_plant| of_plant * plot.members.len() as f64);
        let origin = light.lighting.origin;
        let (ground, rectangle) = match light.lighting.borders {
            Borders::Periodic([x, y]) => (Some(x * y), Some([[origin[0], origin[1]], [origin[0] + x, origin[1] + y]])),
            Borders::Open => (of_members, field.grid.bounds().map(|corners| corners.map(|[x, y, _]| [x, y]))),
        };
        let share = rectangle.map_or(1.0, |rectangle| field.share_of_ground(rectangle, origin[2], RAYS));
        Self { leaf_area: plot.leaf_area(tick), ground: ground.unwrap_or(f64::NAN), share, plots: 1 }
    }
}

impl SummaryColumns {
    /// Adds the light of the plant with the index `at` in a plot at its present tick.
    pub fn add_light(&mut self, plot: &Plot, (at, tick): (usize, Tick)) {
        let (together, alone) = plot.intercepted(at, tick).unwrap_or((f64::NAN, f64::NAN));
        self.intercepted_light.push(together);
        self.light_competition.push(if alone > 0.0 { together / alone } else { f64::NAN });
    }
}
