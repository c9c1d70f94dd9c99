//! The keyframes of tracks: those that a track has made so far, and those of all tracks that have ended.
//!
//! A track in the making has its own keys, of which the first takes no room of its own, since most organs have one or
//! two. When it ends its keys go into blocks that are never moved, so that no list is there twice while it grows, and
//! those of one track lie side by side.

use super::track::{Key, Track};
use std::ops::Range;

/// The keys of a block.
const BLOCK: usize = 4096;

/// A track in the making, with the keys that it has made.
#[derive(Debug, Clone)]
pub struct Keyed<const N: usize> {
    /// All keys but the last, which the track has.
    before: Vec<Key<N>>,
    track: Track<N>,
}

impl<const N: usize> Keyed<N> {
    /// A track that begins with this key.
    pub fn begin(key: Key<N>) -> Self {
        Self { before: Vec::new(), track: Track::begin(key) }
    }

    /// The last values hold at a later age too.
    #[inline]
    pub fn hold(&mut self, age: f32) {
        self.track.hold(age);
    }

    /// Takes the values of a later age, each within its tolerance.
    #[inline]
    pub fn take(&mut self, (age, values): Key<N>, tolerance: &[f32; N]) {
        if self.track.has(&values) {
            return self.track.hold(age);
        }
        let last = self.track.key();
        if self.track.catch_up(tolerance).is_some() {
            self.push(last);
        }
        let last = self.track.key();
        if self.track.add(age, values, tolerance).is_some() {
            self.push(last);
        }
    }

    /// Keeps a key. Keys are few, so the list grows by half of itself.
    fn push(&mut self, key: Key<N>) {
        if self.before.len() == self.before.capacity() {
            self.before.reserve_exact(1 + self.before.len() / 2);
        }
        self.before.push(key);
    }
}

/// The keys of tracks that have ended.
#[derive(Debug, Clone)]
pub struct Kept<const N: usize> {
    /// A block has [`BLOCK`] keys at most, or those of one track that has more. The place of a track is the number of
    /// its block, times [`BLOCK`], and what stands before it there.
    blocks: Vec<Vec<Key<N>>>,
    keys: usize,
}

impl<const N: usize> Default for Kept<N> {
    fn default() -> Self {
        Self { blocks: Vec::new(), keys: 0 }
    }
}

impl<const N: usize> Kept<N> {
    /// The number of keys.
    pub fn len(&self) -> usize {
        self.keys
    }

    /// The keys of a track, by the place that [`Kept::end`] gave it.
    #[inline]
    pub fn of(&self, place: &Range<u32>) -> &[Key<N>] {
        let [start, end] = [place.start, place.end].map(|key| key as usize);
        let first = start % BLOCK;
        self.blocks.get(start / BLOCK).and_then(|block| block.get(first..first + (end - start))).unwrap_or_default()
    }

    /// All keys.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = &mut Key<N>> {
        self.blocks.iter_mut().flatten()
    }

    /// Ends a track; the place of its keys.
    pub fn end(&mut self, Keyed { before, track }: Keyed<N>) -> Range<u32> {
        let end = track.end();
        let count = before.len() + 1 + usize::from(end.is_some());
        let start = self.room(count);
        if let Some(block) = self.blocks.get_mut(start / BLOCK) {
            block.extend(before.into_iter().chain([track.key()]).chain(end));
        }
        self.keys += count;
        start as u32..(start + count) as u32
    }

    /// Where so many keys have their place, in the last block or in a new one.
    fn room(&mut self, count: usize) -> usize {
        let filled = self.blocks.last().map_or(usize::MAX, Vec::len);
        let is_free = filled < BLOCK && filled + count <= BLOCK;
        if !is_free {
            self.blocks.push(Vec::new());
        }
        let (place, filled) = (self.blocks.len() - 1, if is_free { filled } else { 0 });
        let block = &mut self.blocks[place];
        if block.capacity() - filled < count {
            // The first block of a small plant has hardly more room than it needs.
            block.reserve_exact(if place == 0 { count.max(filled / 2) } else { count.max(BLOCK) });
        }
        place * BLOCK + filled
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A track whose values jump at each age has a key at each.
    fn jumping(keys: usize, from: f32) -> Keyed<1> {
        let mut keyed = Keyed::begin((0.0, [from]));
        for age in 1..keys {
            keyed.take((age as f32, [from + [0.0, 1e6][age % 2] + age as f32]), &[0.0]);
        }
        keyed
    }

    #[test]
    fn the_keys_of_a_track_lie_side_by_side_whatever_their_number() {
        let mut kept = Kept::default();
        let mut counts: Vec<usize> = (0..3000).map(|k| 1 + k * 7919 % 13).collect();
        let mut end = |(k, count): (usize, &usize)| kept.end(jumping(*count, k as f32));
        let mut places: Vec<_> = counts.iter().enumerate().map(&mut end).collect();
        let large = [BLOCK, 3, 3 * BLOCK + 1, 1, 5];
        places.extend(large.iter().enumerate().map(|(k, count)| end((counts.len() + k, count))));
        counts.extend(large);
        assert_eq!(kept.len(), counts.iter().sum::<usize>());
        assert_eq!(kept.iter_mut().count(), kept.len());
        for ((place, count), k) in places.iter().zip(&counts).zip(0..) {
            let keys = kept.of(place);
            assert_eq!((keys.len(), keys[0]), (*count, (0.0, [k as f32])));
            assert!(keys.iter().zip(0..).all(|((age, _), at)| *age == at as f32), "{keys:?}");
        }
    }

    /// A block is left with less room than a track would have needed, and a small plant has hardly more than it needs.
    #[test]
    fn blocks_are_filled() {
        for (tracks, spare) in [(3000, 2 * BLOCK), (3, 3), (100, 650)] {
            let mut kept = Kept::default();
            (0..tracks).for_each(|k| _ = kept.end(jumping(1 + k * 7919 % 13, k as f32)));
            let rooms: usize = kept.blocks.iter().map(Vec::capacity).sum();
            assert!(rooms <= kept.len() + kept.blocks.len() * 13 + spare, "{rooms} for {}", kept.len());
        }
    }

    /// As many keys as ages come back: those of a track of its own, whose values are taken as they come.
    #[test]
    fn a_track_keeps_the_keys_that_it_makes() {
        let course = |age: u32| [age % 7, 10, 10, age - age.min(60), 30][(age.min(99) / 25) as usize] as f32;
        let mut kept = Kept::default();
        let mut keyed = Keyed::begin((0.0, [course(0)]));
        let (mut track, mut keys) = (Track::begin((0.0, [course(0)])), vec![(0.0, [course(0)])]);
        for age in 1..125 {
            let values = [course(age)];
            keyed.take((age as f32, values), &[0.25]);
            if track.has(&values) {
                track.hold(age as f32);
            } else {
                keys.extend(track.catch_up(&[0.25]));
                keys.extend(track.add(age as f32, values, &[0.25]));
            }
        }
        keys.extend(track.end());
        let place = kept.end(keyed);
        assert_eq!(kept.of(&place), keys);
        assert!(keys.len() > 10, "{}", keys.len());
    }
}
