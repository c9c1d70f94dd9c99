//! Whole numbers as runs and groups of bits: the hybrid encoding of levels and of places in dictionaries.
//!
//! Eight equal values in a row begin a run, which goes on as far as they are equal; any other eight are packed with as
//! many bits each as the width says, at most 63 groups of eight under one header (Apache Parquet, *Encodings*, "RLE /
//! Bit-Packing Hybrid"). Which of several allowed forms is written is that of the crate `parquet`, so that the bytes of
//! files are the same. Absent: the length before levels, and the width before places (`levels`, `dictionary`).

/// The values of a group.
const GROUP: usize = 8;

/// The most groups under one header: it is one byte long.
const MOST_GROUPS: usize = 63;

/// The number of bits that a number needs.
pub fn width_of(most: u64) -> u8 {
    (u64::BITS - most.leading_zeros()) as u8
}

/// Adds a number, seven bits a byte, the lowest first (ULEB128).
pub fn put_varint(mut number: u64, out: &mut Vec<u8>) {
    while number >= 0x80 {
        out.push(number as u8 | 0x80);
        number >>= 7;
    }
    out.push(number as u8);
}

/// Adds a run of so many equal values.
pub fn put_run(value: u32, count: usize, width: u8, out: &mut Vec<u8>) {
    put_varint((count as u64) << 1, out);
    out.extend_from_slice(&value.to_le_bytes()[..usize::from(width).div_ceil(8)]);
}

/// Adds values that need at most `width` bits each. Takes O(n).
pub fn put<T: Copy + PartialEq + Into<u32>>(values: &[T], width: u8, out: &mut Vec<u8>) {
    let (mut rest, mut groups) = (values, Groups::default());
    while rest.len() >= GROUP {
        let first = rest[0];
        let (eight, after) = rest.split_at(GROUP);
        if eight.iter().all(|value| *value == first) {
            groups.end(out);
            let count = GROUP + after.iter().take_while(|value| **value == first).count();
            put_run(first.into(), count, width, out);
            rest = &rest[count..];
        } else {
            groups.add(eight, width, out);
            rest = after;
        }
    }
    if !rest.is_empty() {
        if groups.count == 0 && rest.iter().all(|value| *value == rest[0]) {
            put_run(rest[0].into(), rest.len(), width, out);
        } else {
            groups.add(rest, width, out);
        }
    }
    groups.end(out);
}

/// The groups under the present header.
#[derive(Default)]
struct Groups {
    count: usize,
    /// The place of the header.
    header: usize,
}

impl Groups {
    /// Adds a group; where values are missing there are zeros.
    fn add<T: Copy + Into<u32>>(&mut self, values: &[T], width: u8, out: &mut Vec<u8>) {
        if self.count == 0 {
            self.header = out.len();
            out.push(0);
        }
        let mut eight = [0; GROUP];
        eight.iter_mut().zip(values).for_each(|(to, value)| *to = u64::from((*value).into()));
        pack(&eight, width, out);
        self.count += 1;
        if self.count == MOST_GROUPS {
            self.end(out);
        }
    }

    fn end(&mut self, out: &mut [u8]) {
        if self.count > 0 {
            out[self.header] = (self.count << 1) as u8 | 1;
            self.count = 0;
        }
    }
}

/// Adds values as so many bits each, the lowest first; a multiple of eight values fills whole bytes.
pub fn pack(values: &[u64], width: u8, out: &mut Vec<u8>) {
    let (mut bits, mut held) = (0_u128, 0_u32);
    for value in values {
        bits |= u128::from(*value) << held;
        held += u32::from(width);
        if held >= u64::BITS {
            out.extend_from_slice(&(bits as u64).to_le_bytes());
            bits >>= u64::BITS;
            held -= u64::BITS;
        }
    }
    out.extend_from_slice(&(bits as u64).to_le_bytes()[..held.div_ceil(8) as usize]);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(values: &[u32], width: u8) -> Vec<u8> {
        let mut out = Vec::new();
        put(values, width, &mut out);
        out
    }

    /// The example of the format's own description: 0 to 7 in three bits each.
    #[test]
    fn the_bits_are_those_of_the_format() {
        assert_eq!(of(&[0, 1, 2, 3, 4, 5, 6, 7], 3), [0b11, 0b1000_1000, 0b1100_0110, 0b1111_1010]);
        assert_eq!(of(&[5; 9], 3), [18, 5]);
        assert_eq!(of(&[300; 200], 9), [0x90, 0x03, 0x2c, 0x01]);
        assert_eq!(of(&[1, 1], 1), [4, 1], "a short tail of equal values is a run");
        assert_eq!(of(&[1, 0], 1), [3, 1], "any other is a group with zeros");
        assert!(of(&[], 1).is_empty());
        assert_eq!(of(&[0; 20], 0), [40], "no bits, no value");
    }
}
