//! Random draws without a shared generator: a draw is a function of (run seed, plant, lineage key, place in the axis's
//! life, purpose), with ChaCha8 as the counter-based generator.
//!
//! A plant's 256-bit key is a hash of the run's seed, the plant's replicate and its number within treatment and
//! replicate ([`draw_key`]). Each axis has streams of its own, named by its lineage key, one for each [`Purpose`];
//! within a stream the word position is the place in the axis's life. So a draw can be sought at any time, in any
//! order, on any thread, and a plant does not depend on its neighbours.
//!
//! The words are those of `rand_chacha`'s `ChaCha8Rng` with the same seed and stream, word for word, which a test
//! holds. That crate makes four blocks at each seek; growth by the clock needs a few words of each of many streams, so
//! the block is made here, one at a time.

use crate::key::{LineageKey, mix, scramble};

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

/// The words of one ChaCha block.
const BLOCK: u64 = 16;

/// Stands for no block: no stream is that long.
const NO_BLOCK: u64 = u64::MAX;

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
        let name = mix(axis.0, purpose as u64);
        Stream { key: self.key, name, position: 0, block: NO_BLOCK, words: [0; BLOCK as usize] }
    }
}

/// The 32-bit words of one axis for one purpose; sought by position, cheap to read forward.
#[derive(Debug, Clone)]
pub struct Stream {
    key: [u32; 8],
    name: u64,
    position: u64,
    block: u64,
    words: [u32; BLOCK as usize],
}

impl Stream {
    /// Goes to word `position`.
    #[inline]
    pub fn seek(&mut self, position: u64) {
        self.position = position;
    }

    /// The next word, uniform over all 2³² values.
    #[inline]
    pub fn word(&mut self) -> u32 {
        self.reach();
        let word = self.words[(self.position % BLOCK) as usize];
        self.position += 1;
        word
    }

    /// The next word as a number in (0, 1).
    #[inline]
    pub fn share(&mut self) -> f64 {
        share(self.word())
    }

    /// The next words, as many as `into` holds.
    #[inline]
    pub fn read(&mut self, into: &mut [u32]) {
        let mut left = into;
        while !left.is_empty() {
            self.reach();
            let ready = &self.words[(self.position % BLOCK) as usize..];
            let taken = left.len().min(ready.len());
            let (now, later) = left.split_at_mut(taken);
            now.iter_mut().zip(ready).for_each(|(word, ready)| *word = *ready);
            self.position += taken as u64;
            left = later;
        }
    }

    /// Makes the block in which the next word stands.
    #[inline]
    fn reach(&mut self) {
        let block = self.position / BLOCK;
        if block != self.block {
            self.words = chacha8(&self.key, block, self.name);
            self.block = block;
        }
    }
}

/// A row of the ChaCha state.
type Row = [u32; 4];

/// One block of ChaCha8 (Bernstein 2008, *ChaCha, a variant of Salsa20*), with a 64-bit counter and a 64-bit stream.
fn chacha8(key: &[u32; 8], counter: u64, stream: u64) -> [u32; BLOCK as usize] {
    let start: [Row; 4] = [
        [0x6170_7865, 0x3320_646e, 0x7962_2d32, 0x6b20_6574],
        [key[0], key[1], key[2], key[3]],
        [key[4], key[5], key[6], key[7]],
        [counter as u32, (counter >> 32) as u32, stream as u32, (stream >> 32) as u32],
    ];
    let [mut a, mut b, mut c, mut d] = start;
    for _ in 0..4 {
        quarter_rounds(&mut a, &mut b, &mut c, &mut d);
        (b, c, d) = (turned::<1>(b), turned::<2>(c), turned::<3>(d));
        quarter_rounds(&mut a, &mut b, &mut c, &mut d);
        (b, c, d) = (turned::<3>(b), turned::<2>(c), turned::<1>(d));
    }
    let mut words = [0; BLOCK as usize];
    for (row, (mixed, first)) in [a, b, c, d].into_iter().zip(start).enumerate() {
        for column in 0..4 {
            words[4 * row + column] = mixed[column].wrapping_add(first[column]);
        }
    }
    words
}

/// Four quarter rounds side by side, one a column.
#[inline(always)]
fn quarter_rounds(a: &mut Row, b: &mut Row, c: &mut Row, d: &mut Row) {
    mix_rows::<16>(a, b, d);
    mix_rows::<12>(c, d, b);
    mix_rows::<8>(a, b, d);
    mix_rows::<7>(c, d, b);
}

/// sum += addend; turning = (turning xor sum) rotated left.
#[inline(always)]
fn mix_rows<const BITS: u32>(sum: &mut Row, addend: &Row, turning: &mut Row) {
    for column in 0..4 {
        sum[column] = sum[column].wrapping_add(addend[column]);
        turning[column] = (turning[column] ^ sum[column]).rotate_left(BITS);
    }
}

#[inline(always)]
fn turned<const LEFT: usize>(row: Row) -> Row {
    [row[LEFT % 4], row[(LEFT + 1) % 4], row[(LEFT + 2) % 4], row[(LEFT + 3) % 4]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::Rng;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;

    #[test]
    fn the_words_are_those_of_rand_chacha() {
        let random = PlantRandom::new(1988, 23);
        let mut stream = random.stream(LineageKey(0xdead_beef_0123_4567), Purpose::Node);
        let mut seed = [0; 32];
        for (bytes, word) in seed.chunks_exact_mut(4).zip(random.key) {
            bytes.copy_from_slice(&word.to_le_bytes());
        }
        let mut reference = ChaCha8Rng::from_seed(seed);
        reference.set_stream(stream.name);
        assert!((0..1000).all(|_| stream.word() == reference.next_u32()));
        for position in [3_u64, 64, (1 << 36) + 5, 17] {
            stream.seek(position);
            reference.set_word_pos(u128::from(position));
            let mut words = [0; 40];
            stream.read(&mut words);
            assert!(words.iter().all(|&word| word == reference.next_u32()), "from {position}");
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
