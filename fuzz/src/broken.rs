//! Inputs by number: the same target, seed and number are the same bytes, so that a failure is seen again.
//!
//! One to four changes of a seed file: as somebody mistypes a text (`config/tests/mutate`), or, as a disk or a program
//! breaks bytes: flipped bits, extreme numbers, cuts, copies, and pieces of another seed. Crates that mutate on stable
//! were looked at (mutatis, bolero): they change single bytes, and know neither the tokens of the files nor two seeds.

use super::seeds::mutate::{Draw, broken};

/// Numbers at which sizes, counts and offsets go wrong.
const EXTREMES: [u64; 12] =
    [0, 1, 2, 0x7f, 0x80, 0xff, 0x7fff, 0xffff, 0x7fff_ffff, 0xffff_ffff, 0x7fff_ffff_ffff_ffff, 0xffff_ffff_ffff_ffff];

/// Input `number` of a target.
pub fn input(seeds: &[Vec<u8>], seed: u64, number: u64) -> Vec<u8> {
    let mut draw = Draw::of_mutation(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(number));
    let mut bytes = seeds[draw.below(seeds.len())].clone();
    let other = &seeds[draw.below(seeds.len())];
    for _ in 0..=draw.below(4) {
        match draw.below(2) {
            0 => bytes = broken(&bytes, &mut draw),
            _ => damage(&mut bytes, other, &mut draw),
        }
    }
    bytes
}

fn damage(bytes: &mut Vec<u8>, other: &[u8], draw: &mut Draw) {
    let at = draw.below(bytes.len());
    let end = (at + 1 + draw.below(64)).min(bytes.len());
    match draw.below(8) {
        0 => bytes.truncate(at),
        1 => _ = bytes.drain(at.min(end)..end),
        2 => {
            let copy = bytes[at.min(end)..end].to_vec();
            let to = draw.below(bytes.len() + 1);
            bytes.splice(to..to, copy);
        }
        3 => {
            let from = draw.below(other.len());
            let piece = other[from..(from + draw.below(256)).min(other.len())].to_vec();
            bytes.splice(at.min(end)..end, piece);
        }
        4 | 5 => {
            let value = EXTREMES[draw.below(EXTREMES.len())];
            let width = 1 << draw.below(4);
            let number = if draw.below(4) == 0 { value.to_be_bytes() } else { value.to_le_bytes() };
            bytes.iter_mut().skip(at).zip(number).take(width).for_each(|(byte, of)| *byte = of);
        }
        _ => {
            if let Some(byte) = bytes.get_mut(at) {
                *byte ^= 1 << draw.below(8);
            }
        }
    }
}
