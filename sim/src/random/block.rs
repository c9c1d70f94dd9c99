//! One block of ChaCha8 (Bernstein 2008, *ChaCha, a variant of Salsa20*), in code for any machine.
//!
//! The state is four rows of four words; its counter has 64 bits, and so has the number of its stream. Absent: blocks
//! side by side in the registers of one machine (`x86`), and which of the two makes a block (`kernel`).

/// The words of one block.
pub(super) const WORDS: usize = 16;

/// One block of words.
pub(super) type Block = [u32; WORDS];

/// A row of the state.
pub(super) type Row = [u32; 4];

/// What tells the blocks of one stream from those of all others.
#[derive(Debug, Clone)]
pub(super) struct Name {
    /// The key of the plant.
    pub key: [u32; 8],
    /// The number of the stream.
    pub stream: u64,
}

impl Name {
    /// The first three rows of the state, which all blocks of the stream share: the constants and the key.
    #[inline(always)]
    pub fn rows(&self) -> [Row; 3] {
        let [a, b, c, d, e, f, g, h] = self.key;
        [[0x6170_7865, 0x3320_646e, 0x7962_2d32, 0x6b20_6574], [a, b, c, d], [e, f, g, h]]
    }

    /// The last row of the state of block `counter`.
    #[inline(always)]
    pub fn last_row(&self, counter: u64) -> Row {
        last_row(self.stream, counter)
    }
}

/// The last row of the state of block `counter` of the stream `stream`: all that blocks of one plant differ in.
#[inline(always)]
pub(super) fn last_row(stream: u64, counter: u64) -> Row {
    [counter as u32, (counter >> 32) as u32, stream as u32, (stream >> 32) as u32]
}

/// Block `counter` of a stream.
pub(super) fn block(name: &Name, counter: u64) -> Block {
    let [constants, left, right] = name.rows();
    let start = [constants, left, right, name.last_row(counter)];
    let [mut a, mut b, mut c, mut d] = start;
    for _ in 0..4 {
        quarter_rounds(&mut a, &mut b, &mut c, &mut d);
        (b, c, d) = (turned::<1>(b), turned::<2>(c), turned::<3>(d));
        quarter_rounds(&mut a, &mut b, &mut c, &mut d);
        (b, c, d) = (turned::<3>(b), turned::<2>(c), turned::<1>(d));
    }
    let mut words = [0; WORDS];
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
