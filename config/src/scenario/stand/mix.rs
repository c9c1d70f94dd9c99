//! The species of a stand: which of them stands at which place.

use super::{Spot, Stand};
use phytomer_sim::plant::LineageKey;
use phytomer_sim::random::{PlantRandom, Purpose, Stream};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A species of a stand.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SownSpecies {
    /// A shipped species by its name, or a species file by its path. The scenario's species if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1))]
    pub species: Option<String>,
    /// The tick of the plot at which its plants are sown. Tick 0 if not given.
    #[serde(default, skip_serializing_if = "super::is_default")]
    #[schemars(range(min = 0, max = 65_534))]
    pub sown: u32,
    /// Its share of the places: of rows and of plants in turn so many follow one another, and by chance it is drawn in
    /// this ratio. A whole number unless they are mixed by chance; 1 if not given.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    #[schemars(range(max = 1e6), extend("exclusiveMinimum" = 0))]
    pub share: f64,
}

fn one() -> f64 {
    1.0
}

fn is_one(share: &f64) -> bool {
    *share == 1.0
}

/// How the species of a stand share its places.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Mixed {
    /// Whole rows in turn, of a fan whole spokes.
    #[default]
    Rows,
    /// Plants in turn, in each row one place farther: two species stand like the squares of a chessboard.
    Plants,
    /// By chance, in the ratio of the shares; the same in all plots.
    Chance,
}

/// The stream of what is drawn for a member of a stand.
fn stream(seed: u64, number: u64) -> Stream {
    PlantRandom::new(seed, number).stream(LineageKey(0), Purpose::Member)
}

/// The place of a share in (0, 1) among the parts of a whole.
fn place_of(share: f64, parts: &[f64]) -> usize {
    let all: f64 = parts.iter().sum();
    let mut left = share * all;
    let within = parts.iter().position(|part| {
        left -= part;
        left < 0.0
    });
    within.unwrap_or_else(|| parts.iter().rposition(|part| *part > 0.0).unwrap_or(0))
}

impl Stand {
    /// The species that stands at a place; `None` where the stand has none of its own.
    pub(super) fn part_of(&self, spot: &Spot, number: u64) -> Option<&SownSpecies> {
        let parts: Vec<f64> = self.plant.iter().map(|part| part.share).collect();
        if let Some(name) = &spot.species {
            return self.plant.iter().find(|part| part.species.as_ref() == Some(name));
        }
        let turns: u64 = parts.iter().map(|part| *part as u64).sum();
        let [row, rank] = spot.cell.map(u64::from);
        // The cell of a fan is its arc and its spoke.
        let turn = match (self.mixed, &self.layout) {
            (Mixed::Chance, _) => return self.plant.get(place_of(stream(self.seed, number).share(), &parts)),
            (Mixed::Plants, _) => row + rank,
            (Mixed::Rows, super::Layout::Nelder(_) | super::Layout::Places(_) | super::Layout::Random(_)) => rank,
            (Mixed::Rows, _) => row,
        };
        let place = (turn % turns.max(1)) as f64 + 0.5;
        self.plant.get(place_of(place / turns.max(1) as f64, &parts))
    }

    /// The ticks from the sowing of a plant until it begins to grow.
    pub(super) fn late(&self, number: u64) -> u32 {
        if self.emergence.len() < 2 {
            return 0;
        }
        let mut stream = stream(self.seed, number);
        stream.seek(1);
        place_of(stream.share(), &self.emergence) as u32
    }
}
