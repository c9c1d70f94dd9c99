//! The internodes of each axis that one tube can run along, as samples of place and radius.
//!
//! An internode has a sample at its base and at its tip; where the next internode begins at that tip with that radius,
//! the two are one sample, which is the base of the next. A chain ends where an internode does not stand, is not drawn,
//! is no plain tube, or begins beside the tip of the internode before. Absent: which samples are kept (`simplify`).

use super::super::stem::{Drawn, Stems};
use glam::Vec3;
use phytomer_sim::plant::{NodeId, Stretch};

/// A place along an axis, with the radius there.
#[derive(Debug, Clone, Copy)]
pub struct Sample {
    /// The place, metres.
    pub at: Vec3,
    /// The radius, metres.
    pub radius: f32,
    /// The direction of the internode from here to the next sample; zero where the radius steps and at the end.
    pub heading: Vec3,
    /// The internode that begins here, or that ends here where `end` is set.
    pub node: NodeId,
    /// Whether this is the tip of its internode.
    pub end: bool,
    /// The colour of the internode.
    pub colour: [u8; 3],
}

/// What is told of each chain, and of each internode that is in none.
pub trait Found {
    /// A chain of so many internodes, by its samples.
    fn chain(&mut self, samples: &[Sample], internodes: usize);
    /// An internode that is drawn by itself.
    fn apart(&mut self, node: NodeId);
    /// Whether the colours of samples are asked for; else they are black.
    fn asks_colours(&self) -> bool {
        true
    }
    /// Whether the chains of an axis, of which these are the stretches that stand, are known and need not be told.
    fn is_known(&mut self, axis: &[Stretch]) -> bool {
        let _ = axis;
        false
    }
}

/// Finds every chain, axis by axis in the order of the axes. An internode may begin so far from the tip before, metres.
/// Takes O(n) for n internodes of a plant whose nodes are in the order of its axes, else O(n + s log s) for s
/// stretches.
pub fn chains(stems: &Stems, gap: f32, found: &mut dyn Found) {
    let mut stretches: Vec<Stretch> = Vec::new();
    stems.plant.each_standing(stems.age, |stretch| stretches.push(stretch));
    let place = |stretch: &Stretch| (stretch.axis.index(), stretch.nodes().start);
    if !stretches.is_sorted_by_key(place) {
        stretches.sort_unstable_by_key(place);
    }
    let mut chain = Chain::default();
    for axis in stretches.chunk_by(|one, next| one.axis == next.axis) {
        if found.is_known(axis) {
            continue;
        }
        for node in axis.iter().flat_map(Stretch::nodes).map(|node| NodeId(node as u32)) {
            chain.add(node, stems, gap, found);
        }
        chain.finish(found);
    }
}

/// The chain that is being followed.
#[derive(Default)]
struct Chain {
    samples: Vec<Sample>,
    internodes: usize,
    rank: u32,
}

impl Chain {
    fn add(&mut self, node: NodeId, stems: &Stems, gap: f32, found: &mut dyn Found) {
        let shown = stems.shows(node);
        if !shown || !matches!(stems.form(node), Drawn::Tube(_, false)) {
            self.finish(found);
            if shown {
                found.apart(node);
            }
            return;
        }
        let frustum = stems.frustum(node);
        let [base, heading] = [frustum.base, frustum.heading].map(Vec3::from_array);
        let rank = stems.plant.nodes.rank[node.index()];
        let follows = self.samples.last().is_some_and(|last| (last.at - base).length() <= gap);
        if !follows || rank != self.rank + 1 {
            self.finish(found);
        }
        // A tip from which the next internode goes on as it is becomes the base of that one.
        if self.samples.last().is_some_and(|last| last.radius.to_bits() == frustum.radii[0].to_bits()) {
            self.samples.pop();
        }
        let colour = if found.asks_colours() { stems.colour(node) } else { [0; 3] };
        let begin = Sample { at: base, radius: frustum.radii[0], heading, node, end: false, colour };
        let tip = base + frustum.length * heading;
        self.samples
            .extend([begin, Sample { at: tip, radius: frustum.radii[1], heading: Vec3::ZERO, end: true, ..begin }]);
        self.internodes += 1;
        self.rank = rank;
    }

    fn finish(&mut self, found: &mut dyn Found) {
        if !self.samples.is_empty() {
            found.chain(&self.samples, self.internodes);
        }
        self.samples.clear();
        self.internodes = 0;
    }
}
