//! Numbers as bytes: plain, split by the place of their bytes, and packed by differences; and truth values as bits.
//!
//! The encodings PLAIN, BYTE_STREAM_SPLIT and DELTA_BINARY_PACKED of Apache Parquet (*Encodings*), with the sizes of
//! blocks that the crate `parquet` chooses. Absent: dictionaries.

use super::hybrid::{pack, put_varint, width_of};

/// A number of a column.
pub trait Number: Copy + PartialOrd {
    /// Its bytes, the lowest first.
    type Bytes: AsRef<[u8]>;
    /// Its size in bytes.
    const SIZE: usize;
    /// The values of a miniblock of differences.
    const MINIBLOCK: usize;

    /// Its bytes, the lowest first.
    fn bytes(self) -> Self::Bytes;
    /// Its bits.
    fn bits(self) -> u64;
    /// It as a whole number, where it is one.
    fn whole(self) -> i64;
    /// `left` − `right` of two whole numbers; what overflows the width of the type wraps around.
    fn less(left: i64, right: i64) -> i64;
    /// `left` − `right` of two differences, without a sign, in the width of the type.
    fn above(left: i64, right: i64) -> u64;
    /// Zero with the sign that statistics have: −0 as a least value, +0 as a greatest one. Other numbers stay as they
    /// are.
    fn with_sign_of_zero(self, negative: bool) -> Self;
}

macro_rules! whole {
    ($type:ty, $unsigned:ty, $miniblock:expr) => {
        impl Number for $type {
            type Bytes = [u8; size_of::<$type>()];
            const SIZE: usize = size_of::<$type>();
            const MINIBLOCK: usize = $miniblock;

            #[inline]
            fn bytes(self) -> Self::Bytes {
                self.to_le_bytes()
            }

            #[inline]
            fn bits(self) -> u64 {
                u64::from(self as $unsigned)
            }

            #[inline]
            fn whole(self) -> i64 {
                i64::from(self)
            }

            #[inline]
            fn less(left: i64, right: i64) -> i64 {
                i64::from((left as $type).wrapping_sub(right as $type))
            }

            #[inline]
            fn above(left: i64, right: i64) -> u64 {
                u64::from((left as $type).wrapping_sub(right as $type) as $unsigned)
            }

            #[inline]
            fn with_sign_of_zero(self, _: bool) -> Self {
                self
            }
        }
    };
}

macro_rules! real {
    ($type:ty) => {
        impl Number for $type {
            type Bytes = [u8; size_of::<$type>()];
            const SIZE: usize = size_of::<$type>();
            const MINIBLOCK: usize = 0;

            #[inline]
            fn bytes(self) -> Self::Bytes {
                self.to_le_bytes()
            }

            #[inline]
            fn bits(self) -> u64 {
                u64::from(self.to_bits())
            }

            #[inline]
            fn whole(self) -> i64 {
                0
            }

            #[inline]
            fn less(_: i64, _: i64) -> i64 {
                0
            }

            #[inline]
            fn above(_: i64, _: i64) -> u64 {
                0
            }

            #[inline]
            fn with_sign_of_zero(self, negative: bool) -> Self {
                match self {
                    zero if zero == 0.0 && negative => -0.0,
                    zero if zero == 0.0 => 0.0,
                    other => other,
                }
            }
        }
    };
}

whole!(i32, u32, 32);
whole!(i64, u64, 64);
real!(f32);
real!(f64);

/// Adds numbers byte by byte.
pub fn put_plain<T: Number>(values: &[T], out: &mut Vec<u8>) {
    out.reserve(values.len() * T::SIZE);
    values.iter().for_each(|value| out.extend_from_slice(value.bytes().as_ref()));
}

/// Adds the first bytes of all numbers, then their second bytes, and so on.
pub fn put_split<T: Number>(values: &[T], out: &mut Vec<u8>) {
    let from = out.len();
    out.resize(from + values.len() * T::SIZE, 0);
    for (place, column) in out[from..].chunks_exact_mut(values.len().max(1)).enumerate() {
        let shift = 8 * place as u32;
        column.iter_mut().zip(values).for_each(|(byte, value)| *byte = (value.bits() >> shift) as u8);
    }
}

/// Adds truth values, eight a byte, the first the lowest.
pub fn put_truths(values: &[i8], out: &mut Vec<u8>) {
    let byte = |eight: &[i8]| eight.iter().rev().fold(0, |byte, truth| byte << 1 | u8::from(*truth > 0));
    out.extend(values.chunks(8).map(byte));
}

/// The miniblocks of a block of differences.
const MINIBLOCKS: usize = 4;

/// Adds whole numbers by their differences: a header with the first, then blocks of four miniblocks, each with as many
/// bits a difference above the least of its block as its greatest one needs.
pub fn put_delta<T: Number>(values: &[T], out: &mut Vec<u8>) {
    let block = T::MINIBLOCK * MINIBLOCKS;
    put_varint(block as u64, out);
    put_varint(MINIBLOCKS as u64, out);
    put_varint(values.len() as u64, out);
    put_varint(zigzag(values.first().map_or(0, |first| first.whole())), out);
    let mut differences = Vec::with_capacity(block);
    let mut above = vec![0; T::MINIBLOCK];
    for start in (1..values.len()).step_by(block) {
        let pairs = values[start - 1..].windows(2).take(block);
        differences.clear();
        differences.extend(pairs.map(|pair| T::less(pair[1].whole(), pair[0].whole())));
        let least = differences.iter().copied().min().unwrap_or(0);
        put_varint(zigzag(least), out);
        let widths = out.len();
        out.resize(widths + MINIBLOCKS, 0);
        for (place, few) in differences.chunks(T::MINIBLOCK).enumerate() {
            above.fill(0);
            above.iter_mut().zip(few).for_each(|(above, difference)| *above = T::above(*difference, least));
            let width = width_of(above.iter().copied().max().unwrap_or(0));
            out[widths + place] = width;
            pack(&above, width, out);
        }
    }
}

/// A number whose small values of either sign are small.
fn zigzag(number: i64) -> u64 {
    (number << 1 ^ number >> 63) as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn delta(values: &[i32]) -> Vec<u8> {
        let mut out = Vec::new();
        put_delta(values, &mut out);
        out
    }

    /// The second example of the format's own description: 7, 5, 3, 1, 2, 3, 4, 5, whose differences from −2 are 0, 0,
    /// 0, 3, 3, 3, 3 in two bits each.
    #[test]
    fn differences_are_those_of_the_format() {
        let header = [0x80, 0x01, 4, 8, 14];
        let block = [3, 2, 0, 0, 0, 0b1100_0000, 0b0011_1111, 0, 0, 0, 0, 0, 0];
        assert_eq!(delta(&[7, 5, 3, 1, 2, 3, 4, 5]), [&header[..], &block].concat());
        assert_eq!(delta(&[]), [0x80, 0x01, 4, 0, 0]);
        assert_eq!(delta(&[-1]), [0x80, 0x01, 4, 1, 1]);
    }

    #[test]
    fn bytes_of_numbers_are_split_and_truths_are_bits() {
        let mut out = Vec::new();
        put_split(&[0x0403_0201_i32, 0x0807_0605], &mut out);
        assert_eq!(out, [1, 5, 2, 6, 3, 7, 4, 8]);
        out.clear();
        put_split::<f32>(&[], &mut out);
        put_truths(&[1, 0, 0, 1, 0, 0, 0, 0, 1], &mut out);
        assert_eq!(out, [0b1001, 1]);
    }
}
