//! The random words of a tree: which place in the stream of a stem decides what.
//!
//! A stem has one stream, by its lineage key, and its leaves have another, so that more or fewer leaves move no stem. A
//! quantity has a place of its own in the stream. Absent: what the draws are for.

use phytomer_sim::random::Stream;

/// In the stream of the plant: its size, the length of its trunk, the factor of the trunk's radius; further draws of
/// the size follow from `AGAIN` on.
pub(super) const TRUNK_LENGTH: u64 = 1;
pub(super) const RADIUS: u64 = 2;
pub(super) const AGAIN: u64 = 16;

/// In the stream of a stem: how it leaves its parent, and its length.
pub(super) const DOWN_ANGLE: u64 = 0;
pub(super) const ROTATE: u64 = 1;
pub(super) const LENGTH: u64 = 2;
pub(super) const HELIX: u64 = 3;
/// Its segments, of which each has as many places.
const SEGMENTS: u64 = 16;
const A_SEGMENT: u64 = 4;
pub(super) const CURVE: u64 = 0;
pub(super) const SPLIT: u64 = 1;
pub(super) const SPREAD: u64 = 2;
pub(super) const SIDE: u64 = 3;

/// In the stream of the leaves of a stem: each leaf has as many places.
pub(super) const A_LEAF: u64 = 2;

/// The place of a quantity of segment `nth` of a stem, from 1.
pub(super) fn of_segment(nth: u32, what: u64) -> u64 {
    SEGMENTS + A_SEGMENT * u64::from(nth - 1) + what
}

/// Uniform in (0, 1): the word at a place of a stream.
pub(super) fn unit(words: &mut Stream, place: u64) -> f64 {
    words.seek(place);
    words.share()
}

/// Uniform in (−1, 1).
pub(super) fn signed(words: &mut Stream, place: u64) -> f64 {
    2.0 * unit(words, place) - 1.0
}
