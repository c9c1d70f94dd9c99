//! Numbers of a vertex beside the properties that every mesh has: until which range its component is drawn, and what a
//! shader needs to sway it.
//!
//! They are read by the component number of a vertex, and the place along the stem by its position, so that a vertex
//! need not carry them while it is drawn. Formats ask for their names and for the numbers of each vertex. Absent: the
//! ranges (`detail`), and the rates and phases, which are the growth model's.

use super::attributes::{Attributes, NAMES};
use super::chunk::Vertex;
use super::detail::{Detail, level};
use phytomer_sim::gusts::Swing;
use phytomer_sim::plant::{NodeId, OrganId, Plant};
use std::sync::Arc;

/// The columns of wind: the level, the place along the stem, b of §4.7 a second, and b at the time 0 about x and y.
const OF_WIND: [&str; 5] = ["level", "stem_place", "sway_rate", "sway_phase_x", "sway_phase_y"];

/// The column of ranges.
pub const UNTIL: &str = "until_m";

/// The columns of the vertices of a plant.
#[derive(Debug, Clone)]
pub struct Columns<'a> {
    plant: &'a Plant,
    names: Vec<&'static str>,
    /// The internode of each component: its own, or that which bears the organ.
    nodes: Vec<NodeId>,
    /// The range of each component.
    until: Option<Vec<f32>>,
    /// How each axis sways.
    swings: Option<Arc<Vec<Swing>>>,
    /// What shaders of any plant ask for.
    attributes: Option<Attributes>,
}

impl<'a> Columns<'a> {
    /// The columns of a plant; `None` where there is none.
    pub fn of(
        plant: &'a Plant,
        detail: Option<&Detail>,
        swings: Option<&Arc<Vec<Swing>>>,
        attributes: bool,
    ) -> Option<Self> {
        let detail = detail.filter(|detail| detail.has_ranges());
        if detail.is_none() && swings.is_none() && !attributes {
            return None;
        }
        let mut nodes = vec![NodeId::NONE; plant.components() as usize];
        let mut until = detail.map(|_| vec![f32::INFINITY; nodes.len()]);
        let components = (0..plant.nodes.len()).map(|node| (plant.nodes.component[node], NodeId(node as u32), None));
        let organs = (0..plant.organs.len())
            .map(|organ| (plant.organs.component[organ], plant.organs.node[organ], Some(OrganId(organ as u32))));
        for (component, node, organ) in components.chain(organs) {
            nodes[component as usize] = node;
            if let (Some(detail), Some(until)) = (detail, &mut until) {
                let range = organ.map_or_else(|| detail.until_of_stem(node), |organ| detail.until_of_leaf(organ));
                until[component as usize] = range;
            }
        }
        let names = detail.map(|_| UNTIL).into_iter().chain(swings.iter().flat_map(|_| OF_WIND));
        let names = names.chain(attributes.then_some(NAMES).into_iter().flatten());
        let attributes = attributes.then(|| Attributes::of(plant));
        Some(Self { plant, names: names.collect(), nodes, until, swings: swings.cloned(), attributes })
    }

    /// The range until which a component is drawn, metres; +∞ where no range is asked for.
    pub fn until_of(&self, component: u32) -> f32 {
        self.until.as_ref().and_then(|until| until.get(component as usize)).copied().unwrap_or(f32::INFINITY)
    }

    /// Their names, in their order.
    pub fn names(&self) -> &[&'static str] {
        &self.names
    }

    /// What they mean, a line each.
    pub fn in_words(&self) -> Vec<String> {
        let until = self
            .until
            .as_ref()
            .map(|_| "until_m: the range beyond which the component is no longer drawn (docs/range.md), inf for ever");
        let wind = self.swings.as_ref().map(|_| {
            "sway: b = sway_phase + sway_rate t in radians, at stem_place from 0 to 1 along a stem of the level (docs/range.md)"
        });
        let attributes = self.attributes.as_ref().map(|_| {
            "order, radius_m, path_m from the ground, phase from 0 to 1 by lineage: of a branch, or of an organ (docs/meshes.md)"
        });
        until.into_iter().chain(wind).chain(attributes).map(str::to_owned).collect()
    }

    /// Appends the numbers of a vertex, one a column.
    pub fn put(&self, vertex: &Vertex, out: &mut Vec<f32>) {
        let component = vertex.tag().component as usize;
        if let Some(until) = &self.until {
            out.push(until.get(component).copied().unwrap_or(f32::INFINITY));
        }
        if let Some(swings) = &self.swings {
            out.extend(self.wind(swings, component, vertex));
        }
        if let Some(attributes) = &self.attributes {
            out.extend(self.attributes(attributes, component, vertex));
        }
    }

    fn attributes(&self, attributes: &Attributes, component: usize, vertex: &Vertex) -> [f32; NAMES.len()] {
        let node = self.nodes.get(component).copied().unwrap_or(NodeId::NONE);
        let Some(node) = node.some() else { return [0.0; NAMES.len()] };
        let (frame, place) = (self.plant.frames.at(node), vertex.position());
        let along: f32 = (0..3).map(|k| (place[k] - frame.base[k]) * frame.heading[k]).sum();
        attributes.at(self.plant, (component, node), (along, place))
    }

    fn wind(&self, swings: &[Swing], component: usize, vertex: &Vertex) -> [f32; OF_WIND.len()] {
        let node = self.nodes.get(component).copied().unwrap_or(NodeId::NONE);
        let Some(node) = node.some() else { return [0.0; OF_WIND.len()] };
        let axis = self.plant.nodes.axis[node.index()].index();
        let Some(swing) = swings.get(axis) else { return [0.0; OF_WIND.len()] };
        let frame = self.plant.frames.at(node);
        let at = vertex.position();
        let along: f32 = (0..3).map(|k| (at[k] - frame.base[k]) * frame.heading[k]).sum();
        let place = swing.place(self.plant.nodes.rank[node.index()], along / self.plant.posed_length(node));
        [f32::from(level(self.plant, node)), place, swing.rate as f32, swing.phases[0] as f32, swing.phases[1] as f32]
    }
}
