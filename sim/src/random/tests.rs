//! `rand_chacha` as an independent reader: every word, by each kernel of this machine.

use super::block::{Block, WORDS};
use super::kernel::Kernel;
use super::*;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// The stream of an axis, and that crate's generator of the same key and stream.
fn both(seed: u64, plant: u64, axis: u64, purpose: Purpose) -> (Stream, Name, ChaCha8Rng) {
    let random = PlantRandom::new(seed, plant);
    let mut bytes = [0; 32];
    for (bytes, word) in bytes.chunks_exact_mut(4).zip(random.key) {
        bytes.copy_from_slice(&word.to_le_bytes());
    }
    let name = Name { key: random.key, stream: mix(axis, purpose as u64) };
    let mut reference = ChaCha8Rng::from_seed(bytes);
    reference.set_stream(name.stream);
    (random.stream(LineageKey(axis), purpose), name, reference)
}

/// Several streams: of plants, axes and purposes, one of them with the number 0 for its axis.
fn several() -> [(Stream, Name, ChaCha8Rng); 4] {
    [
        both(1988, 23, 0xdead_beef_0123_4567, Purpose::Node),
        both(0, 0, 0, Purpose::Bud),
        both(u64::MAX, u64::MAX, u64::MAX, Purpose::Place),
        both(7, draw_key(3, 9), 1 << 63, Purpose::Germination),
    ]
}

/// Counters of blocks: the first ones, around the carry of the lower half, and the last ones that a position can name.
fn counters() -> impl Iterator<Item = u64> {
    (0..20).chain((1 << 32) - 20..(1 << 32) + 3).chain((5 << 32) - 9..5 << 32).chain((1 << 60) - 17..(1 << 60) - 16)
}

#[test]
fn the_words_are_those_of_rand_chacha() {
    for (mut stream, _, mut reference) in several() {
        assert!((0..1000).all(|_| stream.word() == reference.next_u32()));
        for position in [3_u64, 64, (1 << 36) + 5, (1 << 36) - 1, 17] {
            stream.seek(position);
            reference.set_word_pos(u128::from(position));
            assert!((0..70).all(|_| stream.word() == reference.next_u32()), "from {position}");
        }
    }
}

/// Every kernel, and each number of blocks that it makes in another way.
#[test]
fn each_kernel_makes_the_blocks_of_rand_chacha() {
    let kernels = Kernel::all();
    for (_, name, mut reference) in several() {
        for counter in counters() {
            reference.set_word_pos(u128::from(counter) * WORDS as u128);
            let expected: [Block; 25] = std::array::from_fn(|_| std::array::from_fn(|_| reference.next_u32()));
            for number in 0..=expected.len() {
                for kernel in &kernels {
                    let mut blocks = [[7; WORDS]; 26];
                    kernel.fill(&name, counter, &mut blocks[..number]);
                    assert_eq!(blocks[..number], expected[..number], "{kernel:?}, {number} from {counter}");
                    assert!(blocks[number..].iter().all(|beyond| *beyond == [7; WORDS]), "{kernel:?} went on");
                }
            }
        }
    }
}

/// Blocks of two streams made side by side, by each kernel, at counters around the carry and far apart.
#[test]
fn two_streams_reached_together_have_the_words_of_each() {
    let random = PlantRandom::new(3, 5);
    for kernel in Kernel::all() {
        for (from, other) in [(0, 0), (7, 1 << 40), ((1 << 36) - 1, 1 << 36), (31, 16)] {
            let mut streams = [Purpose::Bud, Purpose::Node].map(|purpose| random.stream(LineageKey(9), purpose));
            let [one, two] = &mut streams;
            one.seek(from);
            two.seek(other);
            let expected = [one.clone().word(), two.clone().word()];
            Stream::reach_both_by(kernel, one, two);
            assert_eq!([one.clone().word(), two.clone().word()], expected, "{kernel:?} from {from} and {other}");
            let (mut words, mut apart) = ([0; 40], [0; 40]);
            let mut fresh = random.stream(LineageKey(9), Purpose::Node);
            fresh.seek(other);
            two.read(&mut words);
            fresh.read_by(Kernel::all()[0], &mut apart);
            assert_eq!(words, apart, "{kernel:?} read on from {other}");
        }
    }
}

/// Blocks of many streams made side by side, as many as each kernel makes in another way, at counters around the carry.
#[test]
fn blocks_of_many_streams_have_the_words_of_each() {
    let random = PlantRandom::new(3, 5);
    let counters: Vec<u64> = counters().collect();
    for kernel in Kernel::all() {
        for number in 0..=37 {
            for shift in [0, 11, counters.len() - 30] {
                let purpose = |nth: usize| if nth.is_multiple_of(3) { Purpose::Node } else { Purpose::Bud };
                let place = |nth: usize| {
                    let axis = LineageKey(scramble(nth as u64 / 2));
                    let stream = Sought::stream_of(axis, purpose(nth));
                    Sought { stream, block: counters[(nth + shift) % counters.len()] }
                };
                let of: Vec<Sought> = (0..number).map(place).collect();
                let mut blocks = vec![[7; WORDS]; number + 1];
                let name = Name { key: random.key, stream: 99 };
                kernel.fill_apart(&name, &of, &mut blocks[..number]);
                assert_eq!(blocks[number], [7; WORDS], "{kernel:?} went on");
                for (of, made) in of.iter().zip(&blocks) {
                    let expected = block::block(&Name { key: random.key, stream: of.stream }, of.block);
                    assert_eq!(*made, expected, "{kernel:?}, one of {number}: {of:?}");
                }
            }
        }
    }
}

/// Reads of each length from each place in a block, by each kernel, with what is at hand from the read before.
#[test]
fn reads_of_every_length_from_every_place_are_those_of_rand_chacha() {
    for (stream, _, mut reference) in several() {
        let begin = (1 << 36) - 4 * WORDS as u64;
        reference.set_word_pos(u128::from(begin));
        let expected = Vec::from_iter((0..2 * WORDS + 400).map(|_| reference.next_u32()));
        for kernel in Kernel::all() {
            for (from, length) in (0..2 * WORDS).flat_map(|from| (0..=200).map(move |length| (from, length))) {
                let mut stream = stream.clone();
                stream.seek(begin + from as u64);
                let mut words = [0; 400];
                stream.read_by(kernel, &mut words[..length]);
                assert_eq!(words[..length], expected[from..from + length], "{kernel:?}, {length} from {from}");
                assert_eq!(words[length..], [0; 400][length..], "{kernel:?} went on");
                stream.read_by(kernel, &mut words[length..length + 150]);
                assert_eq!(words[..length + 150], expected[from..from + length + 150], "{kernel:?}, read on");
                assert_eq!(stream.word(), expected[from + length + 150], "{kernel:?}, a word after it");
            }
        }
    }
}

/// Words, reads and seeks in any order give what the positions say.
#[test]
fn words_reads_and_seeks_in_any_order_agree() {
    let (mut stream, _, mut reference) = both(3, 1, 4, Purpose::Relay);
    let expected = Vec::from_iter((0..6_000).map(|_| reference.next_u32()));
    let mut turns = ChaCha8Rng::seed_from_u64(15);
    let (mut position, mut words) = (0, vec![0; 1_000]);
    for _ in 0..20_000 {
        let (turn, length) = (turns.next_u32() % 3, (turns.next_u32() % 1_000) as usize >> (turns.next_u32() % 10));
        if turn == 0 || position + length >= expected.len() {
            position = turns.next_u32() as usize % 5_000;
            stream.seek(position as u64);
        } else if turn == 1 {
            stream.read(&mut words[..length]);
            assert_eq!(words[..length], expected[position..position + length]);
            position += length;
        } else {
            assert_eq!(stream.word(), expected[position]);
            position += 1;
        }
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
