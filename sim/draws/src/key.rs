//! The name of a random event of a site, and the stream of words that belongs to it.
//!
//! An event is named by the seed of the run, the replicate, the plot, what happens, the plant and the season. The
//! treatment is no part of the name, and plots and plants are counted within their treatment and replicate: so
//! treatments are compared under the same chance. The 256-bit key of the stream is a hash of the name, apart from the
//! keys of the plants' own draws.

use phytomer_sim::key::{mix, scramble};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// Stands for the plot, plant or season of an event that belongs to none.
pub const NONE: u32 = u32::MAX;

/// Keeps the keys of sites apart from those of plants, which are hashed from fewer words.
const SITE: u64 = 0x7369_7465_2064_7261;

/// What happens: a pest, a block effect, the emergence of a seedling.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Event(u64);

impl Event {
    /// The event of a kind with a name of its own, as `("pest", "berry borer")`. A name and not a place in a list, so
    /// that an event keeps its draws when another is added to the scenario.
    pub fn named(kind: &str, name: &str) -> Self {
        let words = |hash: u64, text: &str| text.bytes().fold(mix(hash, text.len() as u64), |h, b| mix(h, b.into()));
        Self(words(words(SITE, kind), name))
    }

    /// The part of the event that falls into a cell of the field.
    pub fn in_cell(self, [x, y]: [i64; 2]) -> Self {
        Self(mix(mix(self.0, x as u64), y as u64))
    }
}

/// The name of one random event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Key {
    /// The seed of the run.
    pub seed: u64,
    /// The replicate, from 0.
    pub replicate: u32,
    /// The plot or the block, counted within its treatment and replicate; [`NONE`] for the whole field.
    pub plot: u32,
    /// What happens.
    pub event: Event,
    /// The plant, counted within its treatment and replicate; [`NONE`] where the event is not of a plant.
    pub plant: u32,
    /// The season, from 0; [`NONE`] where the event is not of a season.
    pub season: u32,
}

impl Key {
    /// The event of the whole field.
    pub fn of_field(seed: u64, replicate: u32, event: Event) -> Self {
        Self { seed, replicate, plot: NONE, event, plant: NONE, season: NONE }
    }

    /// The generator of this event, at its first word.
    pub fn generator(&self) -> ChaCha8Rng {
        let Self { seed, replicate, plot, event, plant, season } = *self;
        let name = [u64::from(replicate), u64::from(plot), event.0, u64::from(plant), u64::from(season)];
        let mut state = name.into_iter().fold(mix(scramble(seed), SITE), mix);
        let mut key = [0; 32];
        for bytes in key.chunks_exact_mut(8) {
            state = scramble(state);
            bytes.copy_from_slice(&state.to_le_bytes());
        }
        ChaCha8Rng::from_seed(key)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::Rng;
    use std::collections::BTreeSet;

    /// Each part of the name moves the first word; a change of two parts that cancels in a sum does too.
    #[test]
    fn every_part_of_a_name_has_a_stream_of_its_own() {
        let event = Event::named("pest", "borer");
        let base = Key { seed: 1988, replicate: 0, plot: 3, event, plant: 7, season: 1 };
        let keys = [
            base,
            Key { seed: 1989, ..base },
            Key { replicate: 1, ..base },
            Key { plot: 4, ..base },
            Key { event: Event::named("pest", "borers"), ..base },
            Key { event: Event::named("pestb", "orer"), ..base },
            Key { event: event.in_cell([0, 0]), ..base },
            Key { event: event.in_cell([-1, 0]), ..base },
            Key { event: event.in_cell([0, -1]), ..base },
            Key { plant: 8, ..base },
            Key { season: 2, ..base },
            Key { plant: 1, season: 7, ..base },
            Key { plot: 7, plant: 3, ..base },
        ];
        let first: BTreeSet<u64> = keys.iter().map(|key| key.generator().next_u64()).collect();
        assert_eq!(first.len(), keys.len());
        assert_eq!(base.generator().next_u64(), base.generator().next_u64());
    }
}
