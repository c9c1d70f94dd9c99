//! The stand of a plot: many plants in a layout, of one or several species, with guard rows and borders.
//!
//! A stand takes the place of the list of members: each place of its layout is a member, so plots, events, tables and
//! pictures know nothing of layouts. What is drawn for a member, its emergence and its species where these are mixed by
//! chance, is the same in each plot; what is drawn for a plant, its place in a random layout and its distance from the
//! marked place (`shift`), differs from plot to plot and from replicate to replicate. Absent: where plots stand beside
//! one another (`run::field`), and places of a file (`crate::places`).

mod check;
mod layout;
mod mix;
mod shift;
#[cfg(test)]
mod tests;

pub use layout::{Hills, Lattice, Layout, Nelder, Place, Places, RandomPlaces, Spot};
pub use mix::{Mixed, SownSpecies};

use super::member::Member;
use super::{DEFAULT_SEED, MOST_SEED};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The most plants of a stand.
pub(crate) const MOST_PLANTS: u64 = 1_000_000;

/// Many plants in one plot.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stand {
    /// Where the plants stand.
    pub layout: Layout,
    /// The species that share the stand. Plants of the scenario's species alone if not given.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 100))]
    pub plant: Vec<SownSpecies>,
    /// How the species share the places.
    #[serde(default, skip_serializing_if = "is_default")]
    pub mixed: Mixed,
    /// What stands beyond the ground of the stand.
    #[serde(default, skip_serializing_if = "is_default")]
    pub borders: Borders,
    /// The number of outer rows on each side whose plants are guards: they grow, shade and are recorded, and `summary`
    /// leaves them out. In a Nelder fan the number of inner and of outer arcs, and of outer spokes where it is no whole
    /// circle.
    #[serde(default, skip_serializing_if = "is_default")]
    #[schemars(range(max = 1000))]
    pub guard_rows: u32,
    /// How far from its marked place a plant stands at most, metres: anywhere in the disc of this radius, drawn for
    /// each plant. 0 if not given.
    #[serde(default, skip_serializing_if = "is_default")]
    #[schemars(range(min = 0, max = 1000))]
    pub jitter_m: f64,
    /// The spread of emergence: the shares of the plants that begin to grow 0, 1, 2 … ticks after sowing, as counted in
    /// the field; only their ratios count. All at once if not given. Which plant is late is the same in all plots.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 1000), inner(range(min = 0, max = 1e9)))]
    pub emergence: Vec<f64>,
    /// The seed of what is drawn once for all plots: which plants are late, and which species stands where if they are
    /// mixed by chance. 1988 if not given.
    #[serde(default = "default_seed", skip_serializing_if = "is_default_seed")]
    #[schemars(range(min = 0, max = MOST_SEED))]
    pub seed: u64,
}

fn default_seed() -> u64 {
    DEFAULT_SEED
}

fn is_default_seed(seed: &u64) -> bool {
    *seed == DEFAULT_SEED
}

/// What stands beyond the ground of a stand.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Borders {
    /// Nothing: the outer plants are those of an edge.
    #[default]
    Open,
    /// The same stand again, on all sides without end: what leaves the ground on one side enters it on the other.
    Periodic,
}

/// A rectangle of ground, metres from the place of the plot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ground {
    /// Its south-west corner.
    pub least: [f64; 2],
    /// Its north-east corner.
    pub most: [f64; 2],
}

impl Ground {
    /// The ground around some places, which it touches.
    fn around(places: impl Iterator<Item = [f64; 2]>) -> Self {
        let none = Self { least: [f64::INFINITY; 2], most: [f64::NEG_INFINITY; 2] };
        places.fold(none, |ground, place| Self {
            least: [0, 1].map(|axis| ground.least[axis].min(place[axis])),
            most: [0, 1].map(|axis| ground.most[axis].max(place[axis])),
        })
    }

    /// Its sides, metres eastward and northward.
    pub fn sides(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.most[axis] - self.least[axis])
    }
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

impl Stand {
    /// The number of plants.
    pub fn plants(&self) -> u64 {
        self.layout.spots()
    }

    /// The plants as members of a plot, in the order of the layout. Those of a random
    /// layout have the place of the plot, which `shift` moves.
    pub(super) fn members(&self) -> Vec<Member> {
        let spots = self.layout.all();
        let member = |(number, spot): (u64, Spot)| {
            let part = self.part_of(&spot, number);
            Member {
                species: spot.species.clone().or_else(|| part.and_then(|part| part.species.clone())),
                at_m: spot.at.to_vec(),
                sown: spot.sown.unwrap_or_else(|| part.map_or(0, |part| part.sown)) + self.late(number),
                replaces: None,
                guard: spot.guard || self.layout.is_outer(number, self.guard_rows),
            }
        };
        (0..).zip(spots).map(member).collect()
    }

    /// The names of the species that the stand states, in the order of the file.
    pub(super) fn species(&self) -> impl Iterator<Item = &str> {
        let of_places = match &self.layout {
            Layout::Places(places) => places.at.as_slice(),
            _ => &[],
        };
        let of_parts = self.plant.iter().filter_map(|part| part.species.as_deref());
        of_parts.chain(of_places.iter().filter_map(|place| place.species.as_deref()))
    }

    /// The ground of the stand.
    pub fn ground(&self) -> Ground {
        self.layout.ground()
    }

    /// The ground that belongs to a plant, m²; `None` where the layout does not say.
    pub fn ground_area_m2(&self, number: u64) -> Option<f64> {
        self.layout.area(number)
    }

    /// Whether the places of plants differ from plot to plot.
    pub(super) fn is_drawn(&self) -> bool {
        self.jitter_m > 0.0 || matches!(self.layout, Layout::Random(_))
    }
}
