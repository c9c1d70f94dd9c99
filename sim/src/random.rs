//! Random draws without a shared generator: a draw is a function of (run seed, plant, lineage key, place in the axis's
//! life, purpose), with ChaCha8 as the counter-based generator.
//!
//! A plant's 256-bit key is a hash of the run's seed and the plant's number. Each axis has streams of its own, named by
//! its lineage key, one for each [`Purpose`]; within a stream the word position is the place in the axis's life. So a
//! draw can be sought at any time, in any order, on any thread, and a plant does not depend on its neighbours.

use crate::plant::key::{LineageKey, mix, scramble};
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// What the words of a stream decide.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// The fate of an apical bud at each of its clock steps.
    Bud = 0,
    /// What a node bears: ramification, reiteration, flowers, angles.
    Node = 1,
    /// What follows the end of an apex: relays and traumatic reiterations.
    Relay = 2,
}

/// The source of every draw of one plant.
#[derive(Debug, Clone)]
pub struct PlantRandom {
    seed: [u8; 32],
}

impl PlantRandom {
    /// The draws of plant number `plant` in a run seeded with `seed`.
    pub fn new(seed: u64, plant: u64) -> Self {
        let mut bytes = [0; 32];
        let mut state = mix(scramble(seed), plant);
        for chunk in bytes.chunks_exact_mut(8) {
            state = scramble(state);
            chunk.copy_from_slice(&state.to_le_bytes());
        }
        Self { seed: bytes }
    }

    /// The stream of the axis with lineage key `axis`, standing at its first word.
    pub fn stream(&self, axis: LineageKey, purpose: Purpose) -> Stream {
        let mut words = ChaCha8Rng::from_seed(self.seed);
        words.set_stream(mix(axis.0, purpose as u64));
        Stream { words, position: 0 }
    }
}

/// The 32-bit words of one axis for one purpose; sought by position, cheap to read forward.
#[derive(Debug, Clone)]
pub struct Stream {
    words: ChaCha8Rng,
    position: u64,
}

impl Stream {
    /// Goes to word `position`; free where the stream stands there already.
    #[inline]
    pub fn seek(&mut self, position: u64) {
        if position != self.position {
            self.words.set_word_pos(u128::from(position));
            self.position = position;
        }
    }

    /// The next word, uniform over all 2³² values.
    #[inline]
    pub fn word(&mut self) -> u32 {
        self.position += 1;
        self.words.next_u32()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sought_word_equals_the_word_read_in_sequence() {
        let random = PlantRandom::new(7, 3);
        let mut forward = random.stream(LineageKey(42), Purpose::Bud);
        let sequence: Vec<u32> = (0..200).map(|_| forward.word()).collect();
        let mut sought = random.stream(LineageKey(42), Purpose::Bud);
        for position in [199_u64, 0, 63, 64, 65, 4, 128] {
            sought.seek(position);
            assert_eq!(sought.word(), sequence[position as usize]);
        }
    }

    #[test]
    fn seeds_plants_axes_and_purposes_have_streams_of_their_own() {
        let first = |seed, plant, axis, purpose| PlantRandom::new(seed, plant).stream(LineageKey(axis), purpose).word();
        let base = first(1, 1, 1, Purpose::Bud);
        let others = [first(2, 1, 1, Purpose::Bud), first(1, 2, 1, Purpose::Bud), first(1, 1, 2, Purpose::Bud)];
        assert!(others.iter().all(|&word| word != base));
        assert_ne!(first(1, 1, 1, Purpose::Node), base);
    }
}
