//! The keyframes of all tracks, in the order in which they were made, and then track by track.
//!
//! One list takes the keys of every track while a life is made, so that a key costs its own size and no allocation.

use super::track::{Key, Track};
use std::ops::Range;

/// Keys with the number of their track.
#[derive(Debug, Clone)]
pub struct Kept<const N: usize>(Vec<(u32, Key<N>)>);

impl<const N: usize> Default for Kept<N> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<const N: usize> Kept<N> {
    /// Keeps a key of a track, if there is one.
    #[inline]
    pub fn keep(&mut self, track: u32, key: Option<Key<N>>) {
        if let Some(key) = key {
            self.0.push((track, key));
        }
    }

    /// Takes the values of a track at a later age, each within its tolerance.
    #[inline]
    pub fn take(&mut self, number: u32, track: &mut Track<N>, (age, values): Key<N>, tolerance: &[f32; N]) {
        if track.has(&values) {
            return track.hold(age);
        }
        self.keep(number, track.catch_up(tolerance));
        self.keep(number, track.add(age, values, tolerance));
    }

    /// The keys track by track, in the order of `tracks`, and the place of the keys of each. Takes O(n) for n keys.
    pub fn sorted(self, tracks: &[u32]) -> (Vec<Key<N>>, Vec<Range<u32>>) {
        let most = tracks.iter().max().map_or(0, |most| *most as usize + 1);
        let mut counts = vec![0_u32; most];
        self.0.iter().for_each(|(track, _)| counts[*track as usize] += 1);
        let mut ends = vec![0_u32; most];
        let mut end = 0;
        let ranges = tracks.iter().map(|track| {
            let start = end;
            end += counts[*track as usize];
            ends[*track as usize] = start;
            start..end
        });
        let ranges: Vec<Range<u32>> = ranges.collect();
        let mut keys = vec![(0.0, [0.0; N]); end as usize];
        for (track, key) in self.0 {
            let place = &mut ends[track as usize];
            keys[*place as usize] = key;
            *place += 1;
        }
        (keys, ranges)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_sorted_by_track_and_keep_their_order() {
        let mut kept = Kept::default();
        for (track, age) in [(0, 0.0), (2, 0.0), (0, 1.0), (1, 1.0), (2, 3.0), (0, 4.0)] {
            kept.keep(track, Some((age, [f32::from(track as u8)])));
        }
        kept.keep(1, None);
        let (keys, ranges) = kept.sorted(&[2, 0, 1]);
        assert_eq!(ranges, [0..2, 2..5, 5..6]);
        assert_eq!(keys.iter().map(|key| key.0).collect::<Vec<_>>(), [0.0, 3.0, 0.0, 1.0, 4.0, 1.0]);
    }
}
