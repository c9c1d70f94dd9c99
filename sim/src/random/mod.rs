//! Random draws without a shared generator: a draw is a function of (run seed, plant, lineage key, place in the axis's
//! life, purpose), with ChaCha8 as the counter-based generator.
//!
//! A plant's 256-bit key is a hash of the run's seed, the plant's replicate and its number within treatment and
//! replicate ([`draw_key`]). Each axis has streams of its own, named by its lineage key, one for each [`Purpose`];
//! within a stream the word position is the place in the axis's life. So a draw can be sought at any time, in any
//! order, on any thread, and a plant does not depend on its neighbours.
//!
//! The words are those of `rand_chacha`'s `ChaCha8Rng` with the same seed and stream, word for word, which tests hold.
//! That crate makes four blocks at each seek. Growth by the clock needs a few words of each of many streams, so one
//! block is made at a time there; a long read makes many at once ([`Stream::read`]).

mod block;
mod kernel;
mod stream;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use stream::Stream;

use crate::key::{LineageKey, mix, scramble};
use block::Name;
use kernel::Kernel;

/// The words of one block, as [`PlantRandom::make_blocks`] makes them: words 16 n to 16 n + 15 of a stream, where n is
/// the number of the block.
pub type WordBlock = [u32; WORDS_OF_BLOCK];

/// How many words a block has.
pub const WORDS_OF_BLOCK: usize = block::WORDS;

/// A block of words of one stream.
// In this order the two are the last row of the state of the block, as they stand in memory on x86.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(C)]
pub struct Sought {
    /// The number of the block, from 0.
    pub block: u64,
    /// The number of the stream, by [`Sought::stream_of`].
    pub stream: u64,
}

impl Sought {
    /// The number of the stream of an axis for a purpose.
    #[inline]
    pub fn stream_of(axis: LineageKey, purpose: Purpose) -> u64 {
        mix(axis.0, purpose as u64)
    }
}

/// What the words of a stream decide.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// The fate of an apical bud at each of its clock steps.
    Bud = 0,
    /// What a node bears: ramification, reiteration, flowers, angles.
    Node = 1,
    /// What follows the end of an apex: relays and traumatic reiterations.
    Relay = 2,
    /// What a plant draws once for its whole life, in the stream of the seed's axis.
    Plant = 3,
    /// What responses and pests change in the fate of an apical bud.
    StepResponse = 4,
    /// What a cut releases at a node, in a stream of the node.
    Cut = 5,
    /// What responses and pests change in what a node bears.
    NodeResponse = 6,
    /// The places of field plots, which a run draws once; the axis is the number of the block.
    Field = 7,
    /// Whether the seed of a plant germinates, in the stream of the seed's axis.
    Germination = 8,
    /// What the productions of an L-system decide, in a stream of the module and the step.
    Rewriting = 9,
    /// The phases of an axis in the wind, by a growth model's own law of sway.
    Sway = 10,
    /// The plants of a cell of a forest, in a stream of the cell.
    Forest = 11,
    /// Which plants a bootstrap draws again, in a stream of the repetition.
    Resampling = 12,
    /// What a stand draws once for a member of all its plots: its emergence, its species.
    Member = 13,
    /// Where in its stand a plant stands.
    Place = 14,
}

/// The number in (0, 1) that a uniform word stands for: the middle of its interval.
#[inline]
pub fn share(word: u32) -> f64 {
    (f64::from(word) + 0.5) / 4_294_967_296.0
}

/// The key of the draws of a plant: its replicate, and its number within its treatment and replicate.
///
/// The treatment is no part of it. So treatments are compared on common random numbers: plant k of replicate r draws
/// the same in each of them, and what differs comes of the treatment. In the first replicate the key is the number.
pub fn draw_key(replicate: u32, number: u32) -> u64 {
    u64::from(replicate) << 32 | u64::from(number)
}

/// The source of every draw of one plant.
#[derive(Debug, Clone)]
pub struct PlantRandom {
    key: [u32; 8],
}

impl PlantRandom {
    /// The draws of the plant with the key `plant`, a [`draw_key`], in a run seeded with `seed`.
    pub fn new(seed: u64, plant: u64) -> Self {
        let mut key = [0; 8];
        let mut state = mix(scramble(seed), plant);
        for pair in key.chunks_exact_mut(2) {
            state = scramble(state);
            pair.copy_from_slice(&[state as u32, (state >> 32) as u32]);
        }
        Self { key }
    }

    /// Whether the seed germinates, of which a share of all does: u < share for one word u/2³².
    pub fn germinates(&self, share: f64) -> bool {
        let mut stream = self.stream(LineageKey(0), Purpose::Germination);
        f64::from(stream.word()) < share * 4_294_967_296.0
    }

    /// The stream of the axis with lineage key `axis`, standing at its first word.
    pub fn stream(&self, axis: LineageKey, purpose: Purpose) -> Stream {
        Stream::new(Name { key: self.key, stream: Sought::stream_of(axis, purpose) })
    }

    /// Makes blocks of many streams, each where it stands in `into`; there are as many places as blocks.
    ///
    /// Up to twelve are made side by side where the processor can, in a quarter of the time that each takes alone. So
    /// whoever begins many axes makes the first words of all of them together.
    pub fn make_blocks(&self, of: &[Sought], into: &mut [WordBlock]) {
        Kernel::fastest().fill_apart(&Name { key: self.key, stream: 0 }, of, into);
    }
}

#[cfg(test)]
mod tests;
