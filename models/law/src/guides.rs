//! Guides to the thresholds of counts: where the search for a word begins and ends (Chen and Asau 1974).
//!
//! Absent: the thresholds themselves (`count_table`).

/// The most distributions of a table that are guided, so that all guides together take a few kilobytes.
pub(super) const MOST_GUIDED: usize = 64;
/// The high bits of a word that its guide asks.
const GUIDE_BITS: u32 = 6;
const GUIDED: usize = 1 << GUIDE_BITS;

/// Where in each distribution the search begins and ends, by the high bits of a word (Chen and Asau 1974).
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Guides(Vec<Guide>);

/// For each value of the high bits, and for the end, how many thresholds lie below all words that begin so.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Guide([u16; GUIDED + 1]);

impl Guides {
    /// Guides to distributions with these thresholds.
    pub fn to<'a>(distributions: impl Iterator<Item = &'a [u32]>) -> Self {
        let guide = |thresholds: &[u32]| {
            Guide(std::array::from_fn(|high| {
                let first = (high as u64) << (32 - GUIDE_BITS);
                thresholds.partition_point(|&threshold| u64::from(threshold) <= first) as u16
            }))
        };
        Self(distributions.map(guide).collect())
    }

    #[inline]
    pub fn of(&self, distribution: usize) -> Option<&Guide> {
        self.0.get(distribution)
    }
}

impl Guide {
    /// How many thresholds are certainly not above a word, and how many may be.
    #[inline]
    pub fn ends(&self, word: u32) -> (usize, usize) {
        let high = (word >> (32 - GUIDE_BITS)) as usize;
        (self.0[high].into(), self.0[high + 1].into())
    }
}

/// How many thresholds are not above a word.
#[inline]
pub(super) fn not_above(thresholds: &[u32], word: u32) -> u32 {
    thresholds.partition_point(|&threshold| threshold <= word) as u32
}
