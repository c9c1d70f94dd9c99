//! An index of the components of one plant by their numbers, from which the standing components at an age are selected.
//!
//! Nodes, organs and axes, with the ledger, fill the numbers from 0 without a gap, but each has an order of its own.
//! So the index lays them out by number: the component, and the first and the last tick at which it stands. Selecting
//! an age is then one scan in order. An index holds one plant; the next plant reuses its memory.

use super::TableError;
use phytomer_sim::plant::{AxisId, NodeId, OrganId, Plant, Trend};
use phytomer_sim::{NEVER, Tick};
use std::ops::Range;

/// The number of components in one step of the scan, small enough for their rows to stay in a core's cache.
const SELECTION: usize = 512;

/// The two highest bits of an entry are the class of the component, the other bits its index.
const CLASS_SHIFT: u32 = 30;
const INDEX: u32 = (1 << CLASS_SHIFT) - 1;

/// A component, by its class and its index in the columns of that class.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Component {
    /// An internode with its node.
    Node(NodeId),
    /// A leaf, a flower or a fruit.
    Organ(OrganId),
    /// The apical bud of an axis.
    Bud(AxisId),
    /// A component that a model that rewrites has taken out of the plant: its place in the ledger.
    Departed(usize),
}

/// The components of one plant by their numbers.
#[derive(Debug, Default)]
pub struct ComponentIndex {
    of: Option<(u32, Tick, u32)>,
    places: Vec<u32>,
    from: Vec<Tick>,
    until: Vec<Tick>,
    /// For each block of [`SELECTION`] components, the first tick at which any of them stands.
    first: Vec<Tick>,
    tips: Vec<NodeId>,
    /// The inclinations of the trends of the habit, degrees; NaN for a trend without inclination.
    trends: Vec<f32>,
}

impl ComponentIndex {
    /// Lays out `plant` in O(n) for n components. Does nothing where it is laid out already, since the columns of a
    /// plant change only with its age.
    ///
    /// # Errors
    /// [`TableError::PlantTooLarge`].
    pub fn read(&mut self, plant: &Plant) -> Result<(), TableError> {
        let components = plant.components();
        if components > INDEX {
            return Err(TableError::PlantTooLarge { plant: plant.id, components, most: INDEX });
        }
        let now = Some((plant.id, plant.age, components));
        if self.of != now {
            self.of = now;
            self.lay_out(plant);
        }
        Ok(())
    }

    /// Empties the index.
    pub fn forget(&mut self) {
        self.of = None;
    }

    fn lay_out(&mut self, plant: &Plant) {
        self.trends.clear();
        self.trends.extend(plant.habit.trends.iter().map(inclination));
        let components = plant.components() as usize;
        for column in [&mut self.places, &mut self.from, &mut self.until] {
            column.resize(components, 0);
        }
        let Plant { axes, nodes, organs, .. } = plant;
        for node in 0..nodes.len() {
            self.put(nodes.component[node], 0, node, nodes.birth[node], plant.shed_of(NodeId(node as u32)));
        }
        for organ in 0..organs.len() {
            self.put(organs.component[organ], 1, organ, organs.birth[organ], plant.organ_end(OrganId(organ as u32)));
        }
        for axis in 0..axes.len() {
            self.put(axes.component[axis], 2, axis, axes.appearance[axis], plant.bud_end(AxisId(axis as u32)));
        }
        for (place, departed) in plant.ledger.iter().enumerate() {
            self.put(departed.component, 3, place, departed.birth, departed.death);
        }
        let first = |from: &[Tick]| from.iter().copied().min().unwrap_or(NEVER);
        self.first.clear();
        self.first.extend(self.from.chunks(SELECTION).map(first));
    }

    #[inline]
    fn put(&mut self, component: u32, class: u32, index: usize, from: Tick, until: Tick) {
        let component = component as usize;
        self.places[component] = class << CLASS_SHIFT | index as u32;
        self.from[component] = from;
        self.until[component] = until;
    }

    /// The component with a number.
    #[inline]
    pub fn component(&self, number: u32) -> Component {
        let place = self.places[number as usize];
        let index = place & INDEX;
        match place >> CLASS_SHIFT {
            0 => Component::Node(NodeId(index)),
            1 => Component::Organ(OrganId(index)),
            2 => Component::Bud(AxisId(index)),
            _ => Component::Departed(index as usize),
        }
    }

    /// The inclination of an internode's trend, degrees from the upward vertical; NaN without a trend.
    #[inline]
    pub fn trend(&self, plant: &Plant, node: NodeId) -> f32 {
        let place = usize::from(plant.nodes.trend[node.index()]);
        match plant.own_trends.of(plant.nodes.axis[node.index()]) {
            Some(own) => own.get(place).map_or(f32::NAN, inclination),
            None => self.trends.get(place).copied().unwrap_or(f32::NAN),
        }
    }

    /// Replaces `numbers` by the numbers of the next components that stand at `age`, in rising order from `next` on: at
    /// most [`SELECTION`] and at most `room`. All are selected when `next` has reached [`ComponentIndex::len`]. Takes
    /// O(1) per component looked at.
    pub fn select(&self, age: Tick, room: usize, next: &mut u32, numbers: &mut Vec<u32>) {
        numbers.clear();
        let mut start = *next as usize;
        // The many components that an old plant bears last do not stand while it is young: whole blocks are skipped.
        while self.first.get(start / SELECTION).is_some_and(|&first| age < first) {
            start = (start / SELECTION + 1) * SELECTION;
        }
        let start = start.min(self.places.len());
        let end = (start + SELECTION.min(room)).min(self.places.len());
        numbers.resize(end - start, 0);
        let mut found = 0;
        for (number, (from, until)) in (start as u32..).zip(self.from[start..end].iter().zip(&self.until[start..end])) {
            // The number is always written and only kept if its component stands, so that no branch is mispredicted.
            numbers[found] = number;
            found += usize::from(*from <= age && age < *until);
        }
        numbers.truncate(found);
        *next = end as u32;
    }

    /// The numbers of the next components from `next` on, standing or not: at most [`SELECTION`] and at most `room`.
    pub fn following(&self, room: usize, next: &mut u32) -> Range<u32> {
        let start = *next;
        *next = self.len().min(start + SELECTION.min(room) as u32);
        start..*next
    }

    /// The number of components of the plant.
    pub fn len(&self) -> u32 {
        self.places.len() as u32
    }

    /// Finds the last internode of each axis at `age`, for [`ComponentIndex::tip`], in one pass over the nodes.
    pub fn find_tips(&mut self, plant: &Plant, age: Tick) {
        self.tips.clear();
        self.tips.resize(plant.axes.len(), NodeId::NONE);
        plant.each_standing(age, |stretch| {
            self.tips[stretch.axis.index()] = NodeId(stretch.nodes().end as u32 - 1);
        });
    }

    /// The last internode of an axis at the age of the last call of [`ComponentIndex::find_tips`]; [`NodeId::NONE`] for
    /// an axis without internodes.
    #[inline]
    pub fn tip(&self, axis: AxisId) -> NodeId {
        self.tips[axis.index()]
    }
}

/// The inclination of a trend, degrees from the upward vertical; NaN for a trend without inclination.
pub fn inclination(trend: &Trend) -> f32 {
    trend.inclination_deg().unwrap_or(f32::NAN)
}
