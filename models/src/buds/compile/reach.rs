//! How far a growth unit can reach, whatever is drawn for its nodes: for axes that need not ask what is beyond it.

use super::node::NodeLaws;

/// What rounding to single precision may add to a sum of lengths, a share of it.
const ROUNDING: f64 = 1e-5;

/// The largest internodes of an order, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// The longest internode of a long growth unit, and of a short one.
    longest: [f64; 2],
    /// The largest radius of an internode at its birth.
    pub radius: f64,
    /// The longest leaf, metres.
    pub leaf: f64,
}

impl Reach {
    /// That of laws on which responses have yet to act.
    pub const UNKNOWN: Self = Self { longest: [f64::INFINITY; 2], radius: f64::INFINITY, leaf: f64::INFINITY };

    /// That of laws on which responses act already.
    pub fn of(laws: &NodeLaws) -> Self {
        let longest = [&laws.long_length, &laws.short_length].map(|length| length.most().max(0.0));
        let [radius, leaf] = [0.5 * laws.diameter.most(), laws.leaf.length.most()].map(|most| most.max(0.0));
        Self { longest, radius, leaf }
    }

    /// No growth unit of so many nodes is longer, metres.
    #[inline]
    pub fn length(&self, short: bool, nodes: u32) -> f64 {
        f64::from(nodes) * self.longest[usize::from(short)] * (1.0 + ROUNDING)
    }
}
