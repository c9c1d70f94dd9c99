//! What of a plant at one tick lasts to the next: components are known again by their numbers, whether a model adds to
//! the columns or writes them anew.
//!
//! What has left the columns within the tick is put back into a copy of the later plant, at the end of each column and
//! on axes of their own, so that all that stood at either tick can be shown between them. Absent: where it is shown.

use super::partway::Former;
use super::{AxisId, NewAxis, NewNode, NewOrgan, NodeId, OrganId, Plant};
use crate::clock::Tick;

const NONE: u32 = u32::MAX;

/// The places in the columns of the earlier plant of what stood there, by the places in those of the later one.
#[derive(Debug, Clone, Default)]
pub(crate) struct Lasting {
    /// For each node of the later plant that of the earlier one; [`NodeId::NONE`] for what is new.
    pub nodes: Vec<NodeId>,
    /// The same of its organs.
    pub organs: Vec<Option<OrganId>>,
}

/// Handles by component numbers.
struct Known(Vec<u32>);

impl Known {
    fn of(components: &[u32], count: u32) -> Self {
        let mut places = vec![NONE; count as usize];
        for (place, component) in (0..).zip(components) {
            if let Some(known) = places.get_mut(*component as usize) {
                *known = place;
            }
        }
        Self(places)
    }

    fn at(&self, component: u32) -> Option<u32> {
        self.0.get(component as usize).copied().filter(|place| *place != NONE)
    }
}

impl Plant {
    /// Puts back what stood on `before`, which is this plant one tick before `age`, and is in the columns no more.
    pub(crate) fn put_back(&mut self, before: &Plant, age: Tick) -> Lasting {
        let count = self.components.max(before.components);
        let nodes = Known::of(&self.nodes.component, count);
        let mut back = PutBack { before, age, axes: vec![None; before.axes.len()], nodes: Vec::new() };
        for node in (0..before.nodes.len() as u32).map(NodeId) {
            let stood = before.stands(node, age - 1);
            let known = nodes.at(before.nodes.component[node.index()]).map(NodeId);
            let place = known.or_else(|| stood.then(|| back.node(self, node)));
            back.nodes.push(place.unwrap_or(NodeId::NONE));
        }
        let mut lasting = Lasting { nodes: vec![NodeId::NONE; self.nodes.len()], organs: Vec::new() };
        for (node, place) in (0..).map(NodeId).zip(&back.nodes) {
            if place.some().is_some() && before.stands(node, age - 1) {
                lasting.nodes[place.index()] = node;
            }
        }
        let organs = Known::of(&self.organs.component, count);
        let stood = (0..before.organs.len() as u32).map(OrganId).filter(|organ| before.organ_stands(*organ, age - 1));
        let places: Vec<(OrganId, OrganId)> = stood
            .filter_map(|organ| {
                let known = organs.at(before.organs.component[organ.index()]).map(OrganId);
                Some((known.or_else(|| back.organ(self, organ))?, organ))
            })
            .collect();
        lasting.organs = vec![None; self.organs.len()];
        places.into_iter().for_each(|(place, organ)| lasting.organs[place.index()] = Some(organ));
        lasting
    }
}

impl Lasting {
    /// The own looks that nodes and organs had on `before`, where they have others on `plant`.
    pub(crate) fn former_looks(&self, plant: &Plant, before: &Plant) -> Former {
        let (now, was) = (&plant.own_looks, &before.own_looks);
        if now.is_empty() && was.is_empty() {
            return Former::default();
        }
        let node = |(place, old): (u32, &NodeId)| {
            let (node, was) = (NodeId(place), was.of_node(old.some()?));
            (now.of_node(node) != was).then_some((node, was))
        };
        let organ = |(place, old): (u32, &Option<OrganId>)| {
            let (organ, was) = (OrganId(place), was.of_organ((*old)?));
            (now.of_organ(organ) != was).then_some((organ, was))
        };
        Former {
            nodes: (0..).zip(&self.nodes).filter_map(node).collect(),
            organs: (0..).zip(&self.organs).filter_map(organ).collect(),
        }
    }
}

/// What is put back, so far.
struct PutBack<'a> {
    before: &'a Plant,
    age: Tick,
    /// The axes that bear nodes that were put back, by those of the earlier plant.
    axes: Vec<Option<AxisId>>,
    /// The node of the later plant for each node of the earlier one.
    nodes: Vec<NodeId>,
}

impl PutBack<'_> {
    fn known(&self, node: NodeId) -> NodeId {
        node.some().and_then(|node| self.nodes.get(node.index())).copied().unwrap_or(NodeId::NONE)
    }

    fn axis(&mut self, plant: &mut Plant, axis: AxisId) -> AxisId {
        if let Some(known) = self.axes[axis.index()] {
            return known;
        }
        let (of, place) = (&self.before.axes, axis.index());
        let new = NewAxis {
            bearer: self.known(of.bearer[place]).some(),
            key: of.key[place],
            order: of.order[place],
            origin: of.origin[place],
            position: of.position[place],
            follows: of.follows[place],
            state: of.state[place],
            appearance: of.appearance[place],
            birth: of.birth[place],
            azimuth: of.azimuth[place],
            insertion: of.insertion[place],
            shed_after: of.shed_after[place],
        };
        let id = plant.axes.push(new, of.component[place]);
        if of.death[place] < self.age {
            plant.axes.death[id.index()] = of.death[place];
        }
        plant.axes.shed[id.index()] = self.age;
        self.axes[place] = Some(id);
        id
    }

    fn node(&mut self, plant: &mut Plant, node: NodeId) -> NodeId {
        let (of, place) = (&self.before.nodes, node.index());
        let new = NewNode {
            parent: self.known(of.parent[place]),
            axis: self.axis(plant, of.axis[place]),
            birth: of.birth[place],
            rank: of.rank[place],
            unit_rank: of.unit_rank[place],
            short: of.formation[place].is_short(),
            neoformed: of.formation[place].is_neoformed(),
            trend: of.trend[place],
            length: of.length[place],
            diameter: of.primary_diameter[place],
            azimuth: of.azimuth[place],
        };
        let id = plant.place_node(new, of.component[place]);
        plant.nodes.diameter[id.index()] = of.diameter[place];
        plant.nodes.diameter_tip[id.index()] = of.diameter_tip[place];
        if let Some(look) = self.before.own_looks.of_node(node) {
            plant.give_look(id, look as u16);
        }
        if let Some(section) = self.before.own_looks.section_of(node) {
            plant.give_section(id, section as u16);
        }
        id
    }

    /// Puts an organ back on its node; `None` where that stands no more.
    fn organ(&self, plant: &mut Plant, organ: OrganId) -> Option<OrganId> {
        let (of, place) = (&self.before.organs, organ.index());
        let new = NewOrgan {
            node: self.known(of.node[place]).some()?,
            kind: of.kind[place],
            position: of.position[place],
            birth: of.birth[place],
            death: self.age,
            cause: of.cause[place],
            form: of.form[place],
            length: of.length[place],
            width: of.width[place],
            area: of.area[place],
            azimuth: of.azimuth[place],
            insertion: of.insertion[place],
        };
        let id = plant.place_organ(new, of.component[place]);
        if let Some(look) = self.before.own_looks.of_organ(organ) {
            plant.give_organ_look(id, look as u16);
        }
        let stated = &self.before.stated_organs;
        if let Some((turn, start)) = stated.frame(organ) {
            plant.state_organ(id, turn, start);
        }
        if let Some((surface, scale)) = stated.surface(organ) {
            plant.state_surface(id, surface as u32, scale, of.area[place]);
        }
        if !self.before.outline_of(organ).is_empty() {
            plant.state_outline(id, self.before.outline_of(organ));
        }
        Some(id)
    }
}
