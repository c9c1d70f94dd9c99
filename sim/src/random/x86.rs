//! Several blocks of ChaCha8 at once, in the registers of x86-64: four with SSE2, eight with AVX2, twelve with AVX-512.
//!
//! A register holds a row of the state as in `block`: of one block with SSE2, of two with the others, which differ in
//! their rotations and in the number of their registers. So a step of the rounds is one instruction for a row, and
//! while it lasts the processor goes on with the rows of other blocks. The words come out in their order: nothing is
//! transposed, whatever the number of blocks.
//!
//! No pointer is used: registers become words by `bytemuck`, and slices are cut by their lengths. A function here may
//! be called only where the machine has the instructions that it names, which `kernel` asks.

use super::Sought;
use super::block::{Block, Name, WORDS};
use bytemuck::cast;

/// Turns of the words of a row to the left, as the shuffles of x86 state them: the sources of words 3 to 0, two bits
/// each.
const LEFT_1: i32 = 0b00_11_10_01;
const LEFT_2: i32 = 0b01_00_11_10;
const LEFT_3: i32 = 0b10_01_00_11;

/// Where the bytes of two rows come from where each word is rotated left by `bits`, a multiple of 8.
const fn bytes_rotated(bits: usize) -> [u8; 32] {
    let mut from = [0; 32];
    let mut byte = 0;
    while byte < 32 {
        let (word, within) = (byte % 16 / 4, byte % 4);
        from[byte] = (4 * word + (within + 4 - bits / 8) % 4) as u8;
        byte += 1;
    }
    from
}

/// The eight rounds on the rows `a` to `d` of each group, by the operations of the module where this stands.
macro_rules! rounds {
    ($a:ident, $b:ident, $c:ident, $d:ident) => {
        for _ in 0..4 {
            quarter_rounds!($a, $b, $c, $d);
            turn_rows!($b: LEFT_1, $c: LEFT_2, $d: LEFT_3);
            quarter_rounds!($a, $b, $c, $d);
            turn_rows!($b: LEFT_3, $c: LEFT_2, $d: LEFT_1);
        }
    };
}

/// Four quarter rounds of each block of each group.
macro_rules! quarter_rounds {
    ($a:ident, $b:ident, $c:ident, $d:ident) => {
        mix_rows!($a, $b, $d, left_16);
        mix_rows!($c, $d, $b, left_12);
        mix_rows!($a, $b, $d, left_8);
        mix_rows!($c, $d, $b, left_7);
    };
}

/// sum += addend; turning = (turning xor sum) rotated left.
macro_rules! mix_rows {
    ($sum:ident, $addend:ident, $turning:ident, $rotated:ident) => {
        for group in 0..GROUPS {
            $sum[group] = add($sum[group], $addend[group]);
            $turning[group] = $rotated(xor($turning[group], $sum[group]));
        }
    };
}

macro_rules! turn_rows {
    ($($row:ident: $turn:ident),*) => {
        for group in 0..GROUPS {
            $($row[group] = turned::<$turn>($row[group]);)*
        }
    };
}

/// A row of one block a register, four blocks at once.
pub(super) mod sse2 {
    use super::*;
    use std::arch::x86_64::{
        __m128i, _mm_add_epi32 as add, _mm_or_si128 as or, _mm_shuffle_epi32 as turned, _mm_shufflehi_epi16,
        _mm_shufflelo_epi16, _mm_slli_epi32, _mm_srli_epi32, _mm_xor_si128 as xor,
    };

    /// Block `counter` of a stream.
    #[inline]
    #[target_feature(enable = "sse2")]
    pub fn one(name: &Name, counter: u64, block: &mut Block) {
        make(name, counter, std::array::from_mut(block));
    }

    /// Makes the blocks of a stream from `counter` on.
    #[target_feature(enable = "sse2")]
    pub fn fill(name: &Name, mut counter: u64, blocks: &mut [Block]) {
        let (fours, rest) = blocks.as_chunks_mut::<4>();
        for four in fours {
            make(name, counter, four);
            counter += 4;
        }
        if let Some((two, last)) = rest.split_first_chunk_mut::<2>() {
            make(name, counter, two);
            last.iter_mut().for_each(|block| one(name, counter + 2, block));
        } else {
            rest.iter_mut().for_each(|block| one(name, counter, block));
        }
    }

    #[inline]
    #[target_feature(enable = "sse2")]
    fn make<const GROUPS: usize>(name: &Name, counter: u64, blocks: &mut [Block; GROUPS]) {
        let start: [__m128i; 3] = name.rows().map(cast);
        let last: [__m128i; GROUPS] =
            std::array::from_fn(|group| cast(name.last_row(counter.wrapping_add(group as u64))));
        let ([mut a, mut b, mut c], mut d) = (start.map(|row| [row; GROUPS]), last);
        rounds!(a, b, c, d);
        for group in 0..GROUPS {
            let rows = [add(a[group], start[0]), add(b[group], start[1]), add(c[group], start[2])];
            blocks[group] = cast([rows[0], rows[1], rows[2], add(d[group], last[group])]);
        }
    }

    #[inline]
    #[target_feature(enable = "sse2")]
    fn left_16(row: __m128i) -> __m128i {
        _mm_shufflehi_epi16::<0b10_11_00_01>(_mm_shufflelo_epi16::<0b10_11_00_01>(row))
    }

    #[inline]
    #[target_feature(enable = "sse2")]
    fn left_12(row: __m128i) -> __m128i {
        or(_mm_slli_epi32::<12>(row), _mm_srli_epi32::<20>(row))
    }

    #[inline]
    #[target_feature(enable = "sse2")]
    fn left_8(row: __m128i) -> __m128i {
        or(_mm_slli_epi32::<8>(row), _mm_srli_epi32::<24>(row))
    }

    #[inline]
    #[target_feature(enable = "sse2")]
    fn left_7(row: __m128i) -> __m128i {
        or(_mm_slli_epi32::<7>(row), _mm_srli_epi32::<25>(row))
    }
}

/// The functions of a module with a row of two blocks a register: its instructions, the registers of a row that are
/// made side by side, and fewer of them for the last blocks.
macro_rules! two_blocks_a_register {
    ($features:literal, $groups:literal, $($few:literal),*) => {
        use std::arch::x86_64::{
            __m256i, _mm256_add_epi32 as add, _mm256_permute2x128_si256 as halves, _mm256_shuffle_epi32 as turned,
            _mm256_xor_si256 as xor,
        };

        /// Makes the blocks of a stream from `counter` on. The last few are made aside, perhaps with some that are
        /// thrown away: two blocks take as long as one.
        #[target_feature(enable = $features)]
        pub fn fill(name: &Name, mut counter: u64, blocks: &mut [Block]) {
            let (whole, rest) = blocks.split_at_mut(blocks.len() / (2 * $groups) * (2 * $groups));
            let (pairs, _) = whole.as_chunks_mut::<2>();
            for many in pairs.as_chunks_mut::<$groups>().0 {
                make(name, last_rows(name, counter), many);
                counter += 2 * $groups;
            }
            match rest.len().div_ceil(2) {
                0 => {}
                $(..=$few => aside::<$few>(name, counter, rest),)*
                _ => aside::<$groups>(name, counter, rest),
            }
        }

        #[inline]
        #[target_feature(enable = $features)]
        fn aside<const GROUPS: usize>(name: &Name, counter: u64, blocks: &mut [Block]) {
            let mut made = [[[0; WORDS]; 2]; GROUPS];
            make(name, last_rows(name, counter), &mut made);
            blocks.copy_from_slice(&made.as_flattened()[..blocks.len()]);
        }

        /// One block each of two streams of one plant.
        #[target_feature(enable = $features)]
        pub fn two([(one, counter), (other, count)]: [(&Name, u64); 2], blocks: [&mut Block; 2]) {
            let mut made = [[[0; WORDS]; 2]];
            make(one, [cast([one.last_row(counter), other.last_row(count)])], &mut made);
            let [[first, second]] = made;
            [*blocks[0], *blocks[1]] = [first, second];
        }

        /// Blocks of many streams of the plant of `name`, as many as `blocks` holds. Those that fill no group are made
        /// with some that are thrown away.
        #[target_feature(enable = $features)]
        pub fn apart(name: &Name, of: &[Sought], blocks: &mut [Block]) {
            let (pairs, rest) = blocks.as_chunks_mut::<2>();
            let (many, few) = pairs.as_chunks_mut::<$groups>();
            let (of_many, of_rest) = of.split_at(many.len() * 2 * $groups);
            for (blocks, of) in many.iter_mut().zip(of_many.as_chunks::<2>().0.as_chunks::<$groups>().0) {
                make(name, rows_apart(of), blocks);
            }
            if of_rest.is_empty() {
                return;
            }
            let places = few.as_flattened_mut().iter_mut().chain(rest);
            match of_rest.len().div_ceil(2) {
                $(..=$few => apart_aside::<$few>(name, of_rest, places),)*
                _ => apart_aside::<$groups>(name, of_rest, places),
            }
        }

        /// Few blocks of many streams: at most two a group.
        #[inline]
        #[target_feature(enable = $features)]
        fn apart_aside<'a, const GROUPS: usize>(
            name: &Name,
            of: &[Sought],
            places: impl Iterator<Item = &'a mut Block>,
        ) {
            let mut pairs = [[Sought { block: 0, stream: 0 }; 2]; GROUPS];
            pairs.as_flattened_mut()[..of.len()].copy_from_slice(of);
            let mut made = [[[0; WORDS]; 2]; GROUPS];
            make(name, rows_apart(&pairs), &mut made);
            places.zip(made.as_flattened()).for_each(|(place, block)| *place = *block);
        }

        /// The last rows of blocks of many streams.
        #[inline]
        #[target_feature(enable = $features)]
        fn rows_apart<const GROUPS: usize>(of: &[[Sought; 2]; GROUPS]) -> [__m256i; GROUPS] {
            // A loop, since a closure that a function without these instructions calls is not compiled into it.
            let mut rows = [cast([0_u64; 4]); GROUPS];
            for group in 0..GROUPS {
                let [one, other] = of[group];
                rows[group] = cast([one.block, one.stream, other.block, other.stream]);
            }
            rows
        }

        /// The last rows of the blocks of a stream from `counter` on.
        #[inline]
        #[target_feature(enable = $features)]
        fn last_rows<const GROUPS: usize>(name: &Name, counter: u64) -> [__m256i; GROUPS] {
            let mut rows = [cast([0_u64; 4]); GROUPS];
            for group in 0..GROUPS {
                let first = counter.wrapping_add(2 * group as u64);
                rows[group] = cast([first, name.stream, first.wrapping_add(1), name.stream]);
            }
            rows
        }

        #[inline]
        #[target_feature(enable = $features)]
        fn make<const GROUPS: usize>(name: &Name, last: [__m256i; GROUPS], blocks: &mut [[Block; 2]; GROUPS]) {
            let [one, two, three] = name.rows();
            let start: [__m256i; 3] = [cast([one, one]), cast([two, two]), cast([three, three])];
            let [mut a, mut b, mut c] = [[start[0]; GROUPS], [start[1]; GROUPS], [start[2]; GROUPS]];
            let mut d = last;
            rounds!(a, b, c, d);
            for group in 0..GROUPS {
                let [a, b] = [add(a[group], start[0]), add(b[group], start[1])];
                let [c, d] = [add(c[group], start[2]), add(d[group], last[group])];
                let first = [halves::<LOWER>(a, b), halves::<LOWER>(c, d)];
                let second = [halves::<UPPER>(a, b), halves::<UPPER>(c, d)];
                blocks[group] = [cast(first), cast(second)];
            }
        }
    };
}

/// The lower halves of two registers, and the upper ones.
const LOWER: i32 = 0x20;
const UPPER: i32 = 0x31;

/// Eight blocks at once.
pub(super) mod avx2 {
    use super::*;
    use std::arch::x86_64::{_mm256_or_si256 as or, _mm256_shuffle_epi8, _mm256_slli_epi32, _mm256_srli_epi32};

    two_blocks_a_register!("avx2", 4, 1, 2);

    #[inline]
    #[target_feature(enable = "avx2")]
    fn left_16(row: __m256i) -> __m256i {
        _mm256_shuffle_epi8(row, cast(const { bytes_rotated(16) }))
    }

    #[inline]
    #[target_feature(enable = "avx2")]
    fn left_12(row: __m256i) -> __m256i {
        or(_mm256_slli_epi32::<12>(row), _mm256_srli_epi32::<20>(row))
    }

    #[inline]
    #[target_feature(enable = "avx2")]
    fn left_8(row: __m256i) -> __m256i {
        _mm256_shuffle_epi8(row, cast(const { bytes_rotated(8) }))
    }

    #[inline]
    #[target_feature(enable = "avx2")]
    fn left_7(row: __m256i) -> __m256i {
        or(_mm256_slli_epi32::<7>(row), _mm256_srli_epi32::<25>(row))
    }
}

/// Twelve blocks at once: AVX-512 rotates in one instruction, and has twice as many registers, of which half a one is
/// used.
pub(super) mod avx512 {
    use super::*;
    use std::arch::x86_64::_mm256_rol_epi32;

    two_blocks_a_register!("avx512f,avx512vl", 6, 1, 2, 3);

    /// Block `counter` of a stream.
    #[target_feature(enable = "avx512f,avx512vl")]
    pub fn one(name: &Name, counter: u64, block: &mut Block) {
        let mut made = [[[0; WORDS]; 2]];
        make(name, last_rows(name, counter), &mut made);
        let [[first, _]] = made;
        *block = first;
    }

    #[inline]
    #[target_feature(enable = "avx512f,avx512vl")]
    fn left_16(row: __m256i) -> __m256i {
        _mm256_rol_epi32::<16>(row)
    }

    #[inline]
    #[target_feature(enable = "avx512f,avx512vl")]
    fn left_12(row: __m256i) -> __m256i {
        _mm256_rol_epi32::<12>(row)
    }

    #[inline]
    #[target_feature(enable = "avx512f,avx512vl")]
    fn left_8(row: __m256i) -> __m256i {
        _mm256_rol_epi32::<8>(row)
    }

    #[inline]
    #[target_feature(enable = "avx512f,avx512vl")]
    fn left_7(row: __m256i) -> __m256i {
        _mm256_rol_epi32::<7>(row)
    }
}
