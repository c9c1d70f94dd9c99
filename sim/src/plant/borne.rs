//! The axes and organs on each node, visited in the order of the nodes: axes by their bearing node, organs by theirs.
//!
//! Models append axes and organs nearly in the order of the nodes that bear them. Where the order is exact, as it is
//! after growth ahead, nothing is stored; otherwise the places are sorted once a tick.

use super::NodeId;

/// Things on nodes, in the order of their nodes.
#[derive(Debug, Clone, Default)]
pub(crate) struct Borne {
    /// The places in the order of their nodes; empty where the things already are in that order.
    sorted: Vec<u32>,
    in_order: bool,
}

impl Borne {
    /// Finds the order of the things whose bearing nodes are `bearers`; a thing without a node comes first. Linear
    /// where the things are in order already, else n log n.
    pub fn arrange(&mut self, bearers: &[NodeId]) {
        // NONE is the largest number: plus one it wraps to 0, so that things without a node come first.
        let key = |place: usize| bearers[place].0.wrapping_add(1);
        self.sorted.clear();
        self.in_order = (1..bearers.len()).all(|place| key(place - 1) <= key(place));
        if !self.in_order {
            self.sorted.extend(0..bearers.len() as u32);
            self.sorted.sort_unstable_by_key(|&place| (key(place as usize), place));
        }
    }

    /// The thing at `place` in the order of the nodes.
    #[inline]
    pub fn at(&self, place: usize) -> usize {
        if self.in_order { place } else { self.sorted[place] as usize }
    }
}

/// Visits the things node by node from the last node down.
pub(crate) struct Down<'a> {
    borne: &'a Borne,
    bearers: &'a [NodeId],
    next: usize,
}

impl<'a> Down<'a> {
    pub fn new(borne: &'a Borne, bearers: &'a [NodeId]) -> Self {
        Self { borne, bearers, next: bearers.len() }
    }

    /// The next thing on `node`. Calls must go down the nodes.
    #[inline]
    pub fn on(&mut self, node: usize) -> Option<usize> {
        while self.next > 0 {
            let thing = self.borne.at(self.next - 1);
            let bearer = self.bearers[thing];
            if bearer == NodeId::NONE || bearer.index() < node {
                return None;
            }
            self.next -= 1;
            if bearer.index() == node {
                return Some(thing);
            }
        }
        None
    }
}

/// Visits the things node by node from the first node up.
pub(crate) struct Up<'a> {
    borne: &'a Borne,
    bearers: &'a [NodeId],
    next: usize,
}

impl<'a> Up<'a> {
    pub fn new(borne: &'a Borne, bearers: &'a [NodeId]) -> Self {
        Self { borne, bearers, next: 0 }
    }

    /// The next thing on `node`. Calls must go up the nodes.
    #[inline]
    pub fn on(&mut self, node: usize) -> Option<usize> {
        while self.next < self.bearers.len() {
            let thing = self.borne.at(self.next);
            let bearer = self.bearers[thing];
            if bearer != NodeId::NONE && bearer.index() > node {
                return None;
            }
            self.next += 1;
            if bearer != NodeId::NONE && bearer.index() == node {
                return Some(thing);
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ways_meet_everything_once_in_any_order() {
        for bearers in [vec![9, 0, 0, 2, 5], vec![5, 2, 0, 2], vec![]] {
            let bearers: Vec<_> = bearers.into_iter().map(|b| if b == 9 { NodeId::NONE } else { NodeId(b) }).collect();
            let mut borne = Borne::default();
            borne.arrange(&bearers);
            let (mut up, mut down) = (Up::new(&borne, &bearers), Down::new(&borne, &bearers));
            let mut met = Vec::new();
            for node in 0..7 {
                while let Some(thing) = up.on(node) {
                    assert_eq!(bearers[thing].index(), node);
                    met.push(thing);
                }
            }
            for node in (0..7).rev() {
                while let Some(thing) = down.on(node) {
                    assert_eq!(bearers[thing].index(), node);
                    met.push(thing);
                }
            }
            met.sort_unstable();
            let on_nodes = (0..bearers.len()).filter(|&thing| bearers[thing] != NodeId::NONE);
            assert_eq!(met, on_nodes.flat_map(|thing| [thing, thing]).collect::<Vec<_>>());
        }
    }
}
