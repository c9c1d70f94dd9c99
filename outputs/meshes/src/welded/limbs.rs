//! Limbs: the internodes along which one skin runs, over several axes.
//!
//! An internode goes on in the next of its axis, and where its axis ends, in the thickest of those that its node bears,
//! so that a relay or the stronger arm of a fork continues what bears it. Any other internode begins a limb, which is
//! borne by the nearest internode below that has a skin. Absent: where on the bearer a limb begins (`foot`).

use super::super::stem::{Drawn, Stems};
use super::super::tube::Frustum;
use super::outline::Outline;
use phytomer_sim::plant::NodeId;
use std::ops::Range;

/// The cosine of the sharpest turn with which an internode goes on in the next of its axis, and in one of another axis.
const ON_AXIS: f32 = -0.5;
const ON_ANOTHER: f32 = 0.0;
/// How far beside a tip an internode of another axis may begin to continue it, in radii.
const BESIDE: f32 = 1.0;

/// The outlines of a plant's internodes: of its sections, then of regular polygons by the number of their sides.
#[derive(Debug, Default)]
pub struct Outlines {
    /// The outlines.
    pub list: Vec<Outline>,
    /// For each section whether it is an outline.
    sections: Vec<bool>,
}

/// What the skin of an internode is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Skin {
    /// A tube; of so many sides where its species states them.
    Tube(u16, bool),
    /// A section, by its place.
    Section(usize),
}

impl Outlines {
    /// Those of the sections of a plant.
    pub fn of(stems: &Stems) -> Self {
        let found: Vec<Option<Outline>> = stems.sections().map(Outline::of_section).collect();
        let sections = found.iter().map(Option::is_some).collect();
        Self { list: found.into_iter().map(Option::unwrap_or_default).collect(), sections }
    }

    /// The place of a regular outline, which is made where it is not there yet.
    pub fn regular(&mut self, sides: u16) -> u32 {
        let place = self.sections.len() + usize::from(sides.max(3));
        if self.list.len() <= place {
            self.list.resize_with(place + 1, Outline::default);
        }
        if self.list[place].corners().is_empty() {
            self.list[place] = Outline::regular(sides.max(3));
        }
        place as u32
    }

    /// The place of another outline, behind all regular ones.
    pub fn add(&mut self, outline: Outline) -> u32 {
        let first = self.sections.len() + usize::from(u16::MAX) + 1;
        if self.list.len() < first {
            self.list.resize_with(first, Outline::default);
        }
        self.list.push(outline);
        self.list.len() as u32 - 1
    }

    /// What the skin of an internode is made of; `None` where it is drawn by itself.
    pub fn skin(&self, stems: &Stems, node: NodeId) -> Option<Skin> {
        let frustum = stems.frustum(node);
        let wide = frustum.radii[0].max(frustum.radii[1]);
        let is_there =
            wide > 0.0 && wide.is_finite() && frustum.length.is_finite() && frustum.base.iter().all(|x| x.is_finite());
        match stems.form(node) {
            _ if !is_there => None,
            Drawn::Tube(tube, own) => Some(Skin::Tube(tube.sides(), *own)),
            Drawn::Prism(_) => {
                stems.section_of(node).filter(|section| self.sections.get(*section) == Some(&true)).map(Skin::Section)
            }
            Drawn::Strip | Drawn::Form(_) | Drawn::Lamina(_) | Drawn::Turned(_) | Drawn::Near(..) => None,
        }
    }
}

/// The limbs of a plant, in the order of their first internodes: a limb comes after its bearer.
#[derive(Debug, Default)]
pub struct Limbs {
    nodes: Vec<NodeId>,
    spans: Vec<Range<usize>>,
    /// The internode that bears each limb; none where it stands on the ground.
    bearers: Vec<NodeId>,
    /// The internodes that are drawn by themselves.
    pub apart: Vec<NodeId>,
}

impl Limbs {
    /// The limbs of what is drawn. Takes O(n) for n nodes.
    pub fn of(stems: &Stems, outlines: &Outlines) -> Self {
        let nodes = &stems.plant.nodes;
        let mut limbs = Self::default();
        // For each node the nearest with a skin, itself or below, and for each with a skin the one in which it goes on.
        let mut nearest = vec![NodeId::NONE; nodes.len()];
        let mut next = vec![(NodeId::NONE, 0.0_f32); nodes.len()];
        let mut with_skin = Vec::new();
        for place in 0..nodes.len() {
            let node = NodeId(place as u32);
            let bearer = nodes.parent[place].some().map_or(NodeId::NONE, |parent| nearest[parent.index()]);
            let drawn = stems.plant.stands(node, stems.age) && stems.shows(node);
            if !drawn || outlines.skin(stems, node).is_none() {
                nearest[place] = bearer;
                limbs.apart.extend(drawn.then_some(node));
                continue;
            }
            nearest[place] = node;
            with_skin.push((node, bearer));
            if let Some(bearer) = bearer.some()
                && let Some(claim) = claim(stems, bearer, node)
                && claim > next[bearer.index()].1
            {
                next[bearer.index()] = (node, claim);
            }
        }
        for (node, bearer) in with_skin {
            if bearer.some().is_none_or(|bearer| next[bearer.index()].0 != node) {
                limbs.begin(node, bearer, &next);
            }
        }
        limbs
    }

    fn begin(&mut self, first: NodeId, bearer: NodeId, next: &[(NodeId, f32)]) {
        let from = self.nodes.len();
        let mut node = Some(first);
        while let Some(at) = node {
            self.nodes.push(at);
            node = next[at.index()].0.some();
        }
        self.spans.push(from..self.nodes.len());
        self.bearers.push(bearer);
    }

    /// The number of limbs.
    pub fn len(&self) -> usize {
        self.spans.len()
    }

    /// The internodes of a limb, and the one that bears it.
    pub fn limb(&self, limb: usize) -> (&[NodeId], Option<NodeId>) {
        (&self.nodes[self.spans[limb].clone()], self.bearers[limb].some())
    }
}

/// How much an internode has a claim to continue another one: its radius, or more than any radius where it is the next
/// of its axis; `None` where it does not begin at the tip, or turns too sharply.
fn claim(stems: &Stems, bearer: NodeId, node: NodeId) -> Option<f32> {
    let nodes = &stems.plant.nodes;
    let [below, above] = [bearer, node].map(|node| stems.frustum(node));
    let on_axis = nodes.axis[bearer.index()] == nodes.axis[node.index()] && nodes.parent[node.index()] == bearer;
    let turned: f32 = (0..3).map(|k| below.heading[k] * above.heading[k]).sum();
    let apart = distance(tip(&below), above.base);
    let reach = BESIDE * below.radii[1].max(above.radii[0]);
    match on_axis {
        true => (turned >= ON_AXIS && apart <= 2.0 * reach).then_some(f32::INFINITY),
        false => (turned >= ON_ANOTHER && apart <= reach).then_some(above.radii[0]),
    }
}

fn tip(of: &Frustum) -> [f32; 3] {
    [0, 1, 2].map(|k| of.base[k] + of.length * of.heading[k])
}

fn distance(a: [f32; 3], b: [f32; 3]) -> f32 {
    (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f32>().sqrt()
}
