//! The pose of a plant between two ticks where no rule of growth tells it: each component goes from its place on its
//! bearer at the one tick to that at the other, and carries along what it bears.
//!
//! The bearer is that of the later tick. A component that was not there yet begins at the tip of its bearer, or at the
//! same share of its length, with no length of its own; so what another has been put under goes evenly from the place
//! where it was. What has gone keeps its place on its bearer. The seed is the bearer of what has none.

use crate::clock::Tick;
use crate::plant::placing::Placed;
use crate::plant::{Frame, Lasting, NodeId, OrganId, Plant};
use crate::pose::{node_frame, organ_frame};

/// The places at both ticks.
#[derive(Debug)]
pub(super) struct Carried {
    nodes: Vec<[Placed; 2]>,
    organs: Vec<[Placed; 2]>,
}

/// The frames of all nodes at the earlier tick, as they were or as they begin.
struct Was {
    frames: Vec<Frame>,
    lengths: Vec<f32>,
}

impl Was {
    fn tip(&self, node: NodeId) -> Frame {
        node.some().map_or(Frame::GROUND, |node| self.frames[node.index()].advanced(self.lengths[node.index()]))
    }
}

impl Carried {
    /// The places of a plant in which what has gone was put back.
    pub fn of(plant: &Plant, lasting: &Lasting, (before, after): (&Plant, &Plant), age: Tick) -> Self {
        let count = plant.nodes.len();
        let mut was = Was { frames: Vec::with_capacity(count), lengths: Vec::with_capacity(count) };
        let mut nodes = Vec::with_capacity(count);
        for node in (0..count as u32).map(NodeId) {
            let parent = plant.nodes.parent[node.index()];
            let tip = was.tip(parent);
            let old = lasting.nodes[node.index()].some();
            let stood = old.map(|old| Placed::of(&before.frames.at(old), &tip));
            let will = (node.index() < after.nodes.len()).then(|| {
                let bearer = parent.some().map_or(Frame::GROUND, |parent| node_frame(after, parent));
                Placed::of(&after.frames.at(node), &bearer)
            });
            let will = will.or(stood).unwrap_or_else(|| Placed::of(&tip, &tip));
            let stood = stood.unwrap_or_else(|| {
                let known = parent.some().filter(|parent| parent.index() < after.nodes.len());
                let lengths = known.map(|parent| [was.lengths[parent.index()], after.posed_length(parent)]);
                let share = lengths.map_or(1.0, |[was, will]| if will > 0.0 { was / will } else { 0.0 });
                Placed { offset: will.offset * f64::from(share), ..will }
            });
            was.frames.push(stood.on(&tip));
            was.lengths.push(old.map_or(0.0, |old| before.posed_length(old)));
            nodes.push([stood, will]);
        }
        let organ = |(place, old): (usize, &Option<OrganId>)| {
            let node = plant.organs.node[place];
            let organ = OrganId(place as u32);
            let will = (place < after.organs.len() && after.organ_stands(organ, age))
                .then(|| Placed::of(&organ_frame(after, organ, age), &node_frame(after, node)));
            let stood = old.map(|old| Placed::of(&organ_frame(before, old, age - 1), &was.tip(node)));
            let none = Placed::of(&Frame::GROUND, &Frame::GROUND);
            [stood.or(will).unwrap_or(none), will.or(stood).unwrap_or(none)]
        };
        let organs = lasting.organs.iter().enumerate().map(organ).collect();
        Self { nodes, organs }
    }

    /// The places of organs on their nodes.
    pub fn organs(&self, share: f32) -> Vec<Placed> {
        self.organs.iter().map(|[was, will]| was.toward(will, f64::from(share))).collect()
    }

    /// Poses a plant that has its lengths.
    pub fn pose(&self, plant: &mut Plant, share: f32) {
        let count = plant.nodes.len();
        let frames = &mut plant.frames;
        [&mut frames.base, &mut frames.heading, &mut frames.up].into_iter().for_each(|of| of.resize(count, [0.0; 3]));
        for (node, [was, will]) in self.nodes.iter().enumerate() {
            let parent = plant.nodes.parent[node].some();
            let bearer = parent.map_or(Frame::GROUND, |parent| node_frame(plant, parent));
            let frame = was.toward(will, f64::from(share)).on(&bearer);
            let frames = &mut plant.frames;
            (frames.base[node], frames.heading[node], frames.up[node]) = (frame.base, frame.heading, frame.up);
        }
    }
}
