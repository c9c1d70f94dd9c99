//! Which components of a plant stand at an age, in the order of their numbers.
//!
//! Nodes, organs and axes together fill the numbers from 0 without a gap, in whatever order they stand in the columns.
//! So the columns of a plant are laid out once by number: which component it is, from when and until when it stands. An
//! age is then one straight scan. An index is of one plant at a time; the next plant takes its memory.

use super::TableError;
use phytomer_sim::plant::{AxisId, NodeId, OrganId, Plant, Trend};
use phytomer_sim::{NEVER, Tick};
use std::ops::Range;

/// Components that are looked at in one step of the scan: few enough for their rows to stay in a core's cache.
const SELECTION: usize = 512;

/// The two high bits of a place tell the class, the others the index.
const CLASS_SHIFT: u32 = 30;
const INDEX: u32 = (1 << CLASS_SHIFT) - 1;

/// A component, by the columns it is in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Component {
    /// An internode with its node.
    Node(NodeId),
    /// A leaf, a flower or a fruit.
    Organ(OrganId),
    /// The apical bud of an axis.
    Bud(AxisId),
}

/// The components of one plant by their numbers.
#[derive(Debug, Default)]
pub struct ComponentIndex {
    of: Option<(u32, Tick, u32)>,
    places: Vec<u32>,
    from: Vec<Tick>,
    until: Vec<Tick>,
    /// Of each [`SELECTION`] components, the tick from which the first of them stands.
    first: Vec<Tick>,
    tips: Vec<NodeId>,
    /// The inclinations of the habit's trends, degrees; NaN where a trend tends nowhere.
    trends: Vec<f32>,
}

impl ComponentIndex {
    /// Lays out `plant`, unless it is laid out already: a plant changes its columns only with its age.
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

    /// Forgets the plant.
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

    /// The component of a number.
    #[inline]
    pub fn component(&self, number: u32) -> Component {
        let place = self.places[number as usize];
        let index = place & INDEX;
        match place >> CLASS_SHIFT {
            0 => Component::Node(NodeId(index)),
            1 => Component::Organ(OrganId(index)),
            _ => Component::Bud(AxisId(index)),
        }
    }

    /// The inclination that an internode tends to, degrees; NaN where it tends nowhere.
    #[inline]
    pub fn trend(&self, plant: &Plant, node: NodeId) -> f32 {
        let place = usize::from(plant.nodes.trend[node.index()]);
        match plant.own_trends.of(plant.nodes.axis[node.index()]) {
            Some(own) => own.get(place).map_or(f32::NAN, inclination),
            None => self.trends.get(place).copied().unwrap_or(f32::NAN),
        }
    }

    /// Puts into `numbers` the next components that stand at `age`, at most [`SELECTION`] and at most `room`, going on
    /// from `next`. None is left when `next` has come to the plant's number of components.
    pub fn select(&self, age: Tick, room: usize, next: &mut u32, numbers: &mut Vec<u32>) {
        numbers.clear();
        let mut start = *next as usize;
        // What an old plant bears last is many, and not there yet when it is young.
        while self.first.get(start / SELECTION).is_some_and(|&first| age < first) {
            start = (start / SELECTION + 1) * SELECTION;
        }
        let start = start.min(self.places.len());
        let end = (start + SELECTION.min(room)).min(self.places.len());
        numbers.resize(end - start, 0);
        let mut found = 0;
        for (number, (from, until)) in (start as u32..).zip(self.from[start..end].iter().zip(&self.until[start..end])) {
            // Written always, kept where it stands: no branch to mispredict.
            numbers[found] = number;
            found += usize::from(*from <= age && age < *until);
        }
        numbers.truncate(found);
        *next = end as u32;
    }

    /// The next components from `next` on, whether they stand or not: at most [`SELECTION`] and at most `room`.
    pub fn following(&self, room: usize, next: &mut u32) -> Range<u32> {
        let start = *next;
        *next = self.len().min(start + SELECTION.min(room) as u32);
        start..*next
    }

    /// The components of the plant.
    pub fn len(&self) -> u32 {
        self.places.len() as u32
    }

    /// Finds the last internode of each axis at `age`, for [`ComponentIndex::tip`].
    pub fn find_tips(&mut self, plant: &Plant, age: Tick) {
        self.tips.clear();
        self.tips.resize(plant.axes.len(), NodeId::NONE);
        plant.each_standing(age, |stretch| {
            self.tips[stretch.axis.index()] = NodeId(stretch.nodes().end as u32 - 1);
        });
    }

    /// The last internode of an axis at the age of [`ComponentIndex::find_tips`]; [`NodeId::NONE`] before the first.
    #[inline]
    pub fn tip(&self, axis: AxisId) -> NodeId {
        self.tips[axis.index()]
    }
}

fn inclination(trend: &Trend) -> f32 {
    trend.inclination_deg().unwrap_or(f32::NAN)
}
