//! Whole numbers by their differences, packed with LZ4 (integerCoding.cpp and fastCompression.cpp of OpenUSD).
//!
//! The commonest difference is written once. Each number has a code of two bits: its difference is the commonest, or it
//! follows in one of three sizes, 1, 2 and 4 bytes, or 2, 4 and 8 of numbers of 64 bits. First come the commonest
//! difference and all codes, four a byte from its low end, then the differences.

/// The most bytes of a block of LZ4; larger content is cut into several.
const LARGEST_BLOCK: usize = 0x7E00_0000;

/// How many differences are looked at for the commonest; any would be right, and another makes a larger file.
const SAMPLED: usize = 4096;

/// Packs numbers.
pub fn pack(numbers: &[i32]) -> Vec<u8> {
    let difference = |at: usize| numbers[at].wrapping_sub(if at == 0 { 0 } else { numbers[at - 1] });
    let common = commonest(|at| i64::from(difference(at)), numbers.len()) as i32;
    let code = |difference: i32| {
        let sizes = 1 + u8::from(i8::try_from(difference).is_err()) + u8::from(i16::try_from(difference).is_err());
        if difference == common { 0 } else { sizes }
    };
    let bytes = |at: usize| {
        let difference = difference(at);
        (code(difference), difference.to_le_bytes())
    };
    coded(&common.to_le_bytes(), numbers.len(), [0, 1, 2, 4], bytes)
}

/// Packs numbers of 64 bits.
pub fn pack_longs(numbers: &[i64]) -> Vec<u8> {
    let difference = |at: usize| numbers[at].wrapping_sub(if at == 0 { 0 } else { numbers[at - 1] });
    let common = commonest(difference, numbers.len());
    let code = |difference: i64| {
        let sizes = 1 + u8::from(i16::try_from(difference).is_err()) + u8::from(i32::try_from(difference).is_err());
        if difference == common { 0 } else { sizes }
    };
    let bytes = |at: usize| {
        let difference = difference(at);
        (code(difference), difference.to_le_bytes())
    };
    coded(&common.to_le_bytes(), numbers.len(), [0, 2, 4, 8], bytes)
}

/// The commonest of some numbers, the largest of equals.
fn commonest(number: impl Fn(usize) -> i64, count: usize) -> i64 {
    let mut sample: Vec<i64> = (0..count).step_by(count.div_ceil(SAMPLED).max(1) | 1).map(number).collect();
    if let Some(most) = majority(&sample) {
        return most;
    }
    sample.sort_unstable();
    let runs = sample.chunk_by(|a, b| a == b).map(|run| (run.len(), run[0]));
    runs.max().map_or(0, |(_, number)| number)
}

/// The number that more than half of some numbers are, if there is one (Boyer and Moore 1991).
fn majority(numbers: &[i64]) -> Option<i64> {
    let (mut most, mut lead) = (0, 0_usize);
    for number in numbers {
        if lead == 0 {
            most = *number;
        }
        lead = if most == *number { lead + 1 } else { lead - 1 };
    }
    (numbers.iter().filter(|number| **number == most).count() > numbers.len() / 2).then_some(most)
}

/// Packs the codes of so many differences and their first bytes, which are `sizes` of each code.
fn coded<const N: usize>(
    common: &[u8],
    count: usize,
    sizes: [usize; 4],
    difference: impl Fn(usize) -> (u8, [u8; N]),
) -> Vec<u8> {
    let codes = common.len();
    let mut end = codes + count.div_ceil(4);
    // All bytes of each difference are written, and the next one begins behind those that count.
    let mut bytes = vec![0; end + N * count];
    bytes[..codes].copy_from_slice(common);
    for first in (0..count).step_by(4) {
        let mut four = 0;
        for place in first..count.min(first + 4) {
            let (code, difference) = difference(place);
            four |= code << (2 * (place - first));
            bytes[end..end + N].copy_from_slice(&difference);
            end += sizes[usize::from(code)];
        }
        bytes[codes + first / 4] = four;
    }
    compress(&bytes[..end])
}

/// Packs bytes with LZ4: a zero and one block, or the number of blocks and each with its length.
pub fn compress(bytes: &[u8]) -> Vec<u8> {
    if bytes.len() <= LARGEST_BLOCK {
        let mut packed = vec![0; 1 + lz4_flex::block::get_maximum_output_size(bytes.len())];
        let length = lz4_flex::block::compress_into(bytes, &mut packed[1..]).unwrap_or(0);
        packed.truncate(1 + length);
        return packed;
    }
    let blocks = bytes.chunks(LARGEST_BLOCK);
    let mut packed = vec![blocks.len() as u8];
    for block in blocks {
        let block = lz4_flex::block::compress(block);
        packed.extend((block.len() as i32).to_le_bytes());
        packed.extend(block);
    }
    packed
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reads numbers as integerCoding.cpp does, of `size` bytes at most.
    fn unpack(packed: &[u8], count: usize, size: usize) -> Vec<i64> {
        assert_eq!(packed[0], 0, "one block");
        let bytes = lz4_flex::block::decompress(&packed[1..], (size + 1) * (count + 2)).expect("LZ4");
        let read = |at: usize, size: usize| {
            let bytes: Vec<u8> = bytes[at..at + size].to_vec();
            let sign = if bytes[size - 1] & 128 == 0 { 0 } else { 255 };
            let mut long = [sign; 8];
            long[..size].copy_from_slice(&bytes);
            i64::from_le_bytes(long)
        };
        let (common, mut at, mut last) = (read(0, size), size + count.div_ceil(4), 0_i64);
        let numbers = (0..count).map(|number| {
            let size = match bytes[size + number / 4] >> (2 * (number % 4)) & 3 {
                0 => 0,
                code => size >> (3 - code),
            };
            last = last.wrapping_add(if size == 0 { common } else { read(at, size) });
            at += size;
            last
        });
        numbers.collect()
    }

    #[test]
    fn the_commonest_is_the_largest_of_equals() {
        for (numbers, most) in [
            (&[][..], 0),
            (&[3, 3, -1][..], 3),
            (&[5, 7, 5, 7][..], 7),
            (&[-2, 9, -2, 4, -2, 9][..], -2),
            (&[1, 2][..], 2),
        ] {
            assert_eq!(commonest(|at| numbers[at], numbers.len()), most, "{numbers:?}");
        }
        assert_eq!((majority(&[4, 4, 1]), majority(&[4, 4, 1, 1]), majority(&[])), (Some(4), None, None));
    }

    #[test]
    fn numbers_come_back() {
        let courses: [Vec<i64>; 5] = [
            vec![3; 100],
            (0..1000).collect(),
            (0..777).map(|k| (k * 7919) % 1013 - 500).collect(),
            (0..64).map(|k| if k % 2 == 0 { i64::from(i32::MAX) } else { i64::from(i32::MIN) }).collect(),
            (0..20_000).map(|k| k / 7 + (k % 3) * 40_000).collect(),
        ];
        for course in courses {
            let short: Vec<i32> = course.iter().map(|number| *number as i32).collect();
            let of_short: Vec<i64> =
                unpack(&pack(&short), course.len(), 4).iter().map(|x| i64::from(*x as i32)).collect();
            assert_eq!(of_short, course);
            let long: Vec<i64> = course.iter().map(|number| number << 17).collect();
            assert_eq!(unpack(&pack_longs(&long), course.len(), 8), long);
        }
        assert!(pack(&vec![3; 1_000_000]).len() < 2000, "what is even is small");
    }
}
