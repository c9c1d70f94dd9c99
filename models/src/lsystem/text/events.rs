//! The events of a plant that is rewritten: those that were noted keep their axes by the numbers of their buds, while
//! the columns are made anew.
//!
//! Absent: which modules are lost, and why (`model`).

use phytomer_sim::clock::Tick;
use phytomer_sim::plant::{AxisId, Event, EventKind, LineageKey, NewAxis, NodeId, Plant};
use std::collections::BTreeMap;

/// What is to be noted of a tick, by the numbers of buds, and the buds of the axes in the columns before.
pub(super) struct Noted {
    /// Whether the plant keeps events.
    keeps: bool,
    buds: Vec<u32>,
    new: BTreeMap<(u32, EventKind), u32>,
}

impl Noted {
    /// Nothing yet, before the columns of a plant are emptied.
    pub fn before(plant: &Plant) -> Self {
        let keeps = plant.events.is_some();
        let buds = if keeps { plant.axes.component.clone() } else { Vec::new() };
        Self { keeps, buds, new: BTreeMap::new() }
    }

    /// An event of the bud with a number; events of a kind add up.
    pub fn add(&mut self, bud: u32, kind: EventKind, count: u32) {
        if self.keeps {
            *self.new.entry((bud, kind)).or_default() += count;
        }
    }
}

/// Gives the events that were noted before the handles of their axes in the new columns, and adds those of the tick
/// `age`: what was noted, axes that have appeared, and their internodes.
pub(super) fn note(plant: &mut Plant, age: Tick, mut noted: Noted) {
    let Some(mut events) = plant.events.take() else { return };
    let appeared = (0..plant.axes.len()).filter(|axis| plant.axes.appearance[*axis] == age && age > 0);
    appeared.for_each(|axis| noted.add(plant.axes.component[axis], EventKind::Branched, 1));
    let grown = (0..plant.nodes.len()).filter(|node| plant.nodes.birth[*node] == age && age > 0);
    grown.for_each(|node| noted.add(plant.axes.component[plant.nodes.axis[node].index()], EventKind::Grew, 1));
    let mut places = vec![None; plant.components() as usize];
    for (axis, number) in plant.axes.component.iter().enumerate() {
        places[*number as usize] = Some(AxisId(axis as u32));
    }
    for (nth, number) in plant.gone_buds().iter().enumerate() {
        places[*number as usize] = Some(AxisId::gone(nth));
    }
    let place = |number: u32| places.get(number as usize).copied().flatten().unwrap_or(AxisId::TRUNK);
    for event in &mut events {
        if let Some(number) = noted.buds.get(event.axis.index()) {
            event.axis = place(*number);
        }
    }
    let new = noted.new.into_iter().map(|((bud, kind), count)| Event { tick: age, axis: place(bud), kind, count });
    events.extend(new);
    plant.events = Some(events);
}

/// A seed of which nothing can be drawn: its axis alone.
pub(super) fn sow_alone(plant: &mut Plant) {
    if plant.components() == 0 {
        plant.next_number_on(None);
    }
    plant.place_axis(NewAxis { key: LineageKey::SEED, ..NewAxis::OF_THE_SEED }, 0);
    debug_assert_eq!(plant.axes.last_node[0], NodeId::NONE);
}
