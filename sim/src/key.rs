//! Lineage keys: a stable 64-bit name for each component, hashed from the path of ranks that leads to it from the seed.
//!
//! Equal at every age, on every machine and in every order of growth; they join ages in tables and seed the draws. Two
//! components of one plant share a key with probability n²/2⁶⁵: 7·10⁻⁷ for a plant of 5 million axes.

/// The lineage key of an axis, a node or an organ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LineageKey(pub u64);

impl LineageKey {
    /// The axis that grows out of the seed.
    pub const SEED: Self = Self(0x7068_7974_6f6d_6572);

    /// What stands at `place` on this component. A caller gives each kind of place a range of its own.
    #[inline]
    pub fn child(self, place: u64) -> Self {
        Self(mix(self.0, place))
    }
}

/// A place on an axis, for [`LineageKey::child`]: which component of the node at a rank. No two places of one axis have
/// the same number, so that lineage keys are unique by construction as far as a hash can be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// The node itself.
    Node,
    /// An axillary bud by its position among the node's, from 0.
    Axillary(u16),
    /// A relay bud after the end of the apex, by its position, from 0.
    Relay(u16),
    /// A dormant axillary bud that the death of the apex released, by its position, from 0.
    Released(u16),
    /// A reiteration bud by its position, from 0.
    Reiteration(u16),
    /// A relay bud of an axis that passed into another state when its last node was this one: how many passages had
    /// made relays there before, and the position of the bud, both from 0.
    Passage(u32, u16),
    /// One of the axes into which the apex divided, by its position, from 0.
    Fork(u16),
    /// An organ by its kind's number and its position.
    Organ(u8, u16),
    /// A component of a plant whose components are named by their numbers; the number stands for the rank.
    Numbered,
}

/// The most positions of relays, and of released buds, on a node: they share a class of places.
pub const MOST_POSITIONS: u16 = 64;
/// The class of the passages of an axis at a node after its first there: no other class has this bit.
const AGAIN: u64 = 1 << 31;

impl Place {
    /// One number for the place on the node of `rank` along its axis: the rank in the upper half; in the lower a class
    /// of 15 bits and a position of 16, or the bit of a passage that is not the first at its node, its number of 25
    /// bits (an axis makes at most 64 · 65,535 steps) and a position of 6.
    #[inline]
    pub fn on(self, rank: u32) -> u64 {
        let (class, position) = match self {
            Self::Node => (0, 0),
            Self::Axillary(position) => (1, position),
            Self::Relay(position) => (2, position),
            Self::Released(position) => (2, MOST_POSITIONS + position),
            Self::Reiteration(position) => (3, position),
            Self::Passage(0, position) => (4, position),
            Self::Passage(before, position) => {
                return u64::from(rank) << 32 | AGAIN | u64::from(before) << 6 | u64::from(position);
            }
            Self::Fork(position) => (5, position),
            Self::Numbered => (6, 0),
            Self::Organ(kind, position) => (16 + u64::from(kind), position),
        };
        u64::from(rank) << 32 | class << 16 | u64::from(position)
    }
}

/// Two words hashed into one; not symmetric.
#[inline]
pub fn mix(a: u64, b: u64) -> u64 {
    scramble(a.rotate_left(29) ^ scramble(b))
}

/// A bijection of 64-bit words in which every input bit reaches every output bit (the finaliser of splitmix64, Steele,
/// Lea & Flood 2014).
#[inline]
pub fn scramble(word: u64) -> u64 {
    let mut z = word.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn a_path_and_its_neighbours_have_keys_of_their_own() {
        let mut keys = BTreeSet::new();
        for rank in 1..=200 {
            for place in [Place::Node, Place::Axillary(0), Place::Axillary(1), Place::Relay(0), Place::Organ(0, 1)] {
                let child = LineageKey::SEED.child(place.on(rank));
                assert!(keys.insert(child));
                assert!((1..=50).all(|next| keys.insert(child.child(Place::Axillary(0).on(next)))));
            }
        }
    }

    /// The number of a place tells which it is, up to the ends of every range: the most positions, kinds and passages.
    #[test]
    fn no_two_places_of_an_axis_share_a_number() {
        const LAST_PASSAGE: u32 = 64 * 65_535;
        let mut numbers = BTreeSet::new();
        let mut distinct = |place: Place, rank: u32| {
            assert!(numbers.insert(place.on(rank)), "{place:?} on the node {rank} has the number of another");
        };
        for rank in [0, 1, 2, 63, 64, 65_536, (1 << 30) - 1, u32::MAX] {
            distinct(Place::Node, rank);
            distinct(Place::Numbered, rank);
            for position in 0..MOST_POSITIONS {
                let (relay, released) = (Place::Relay(position), Place::Released(position));
                let others = [Place::Axillary(position), Place::Reiteration(position), Place::Fork(position)];
                others.into_iter().chain([relay, released]).for_each(|place| distinct(place, rank));
                for before in [0, 1, 2, 3, 1023, 1024, 1025, 65_535, 65_536, LAST_PASSAGE] {
                    distinct(Place::Passage(before, position), rank);
                }
                (0..=u8::MAX).for_each(|kind| distinct(Place::Organ(kind, position), rank));
            }
            (0..=u8::MAX).for_each(|kind| distinct(Place::Organ(kind, u16::MAX), rank));
        }
    }

    #[test]
    fn the_order_of_the_path_matters() {
        let a = LineageKey::SEED.child(1).child(2);
        let b = LineageKey::SEED.child(2).child(1);
        assert_ne!(a, b);
    }
}
