//! The rows of `events`: what became of buds and branches, sorted by age and component.
//!
//! A plant that grew ahead notes its events axis by axis and one that followed the clock age by age; sorted, both are
//! the same rows.

use super::buffers::columns;
use phytomer_sim::plant::{AxisId, Event, EventKind, Plant};
use phytomer_sim::{Plot, Tick};

columns! {
    /// The buffers of `events`.
    EventColumns of event: Event, of: (&Plot, &Plant) {
        treatment: Word(i8) = 0,
        plot: Int(i32) = of.0.id as i32,
        plant: Int(i32) = of.1.id as i32,
        age: Int(i32) = event.tick as i32,
        component: Int(i32) = of.1.axes.component[event.axis.index()] as i32,
        axis: Int(i32),
        event: Word(i8) = event.kind as i8,
        count: Int(i32) = event.count as i32,
    }
}

impl EventColumns {
    /// Adds a row for each of the events of a plant, column by column.
    pub fn fill(&mut self, plot: &Plot, plant: &Plant, events: &[Event]) {
        let before = self.component.len();
        self.extend(events, (plot, plant));
        self.axis.extend_from_slice(&self.component[before..]);
    }
}

/// Puts the events of `plant` up to the age `last` into `sorted`. Axes climb with the numbers of their buds, and events
/// of one kind on one axis and tick keep the order in which they were noted.
pub fn sort(plant: &Plant, last: Tick, sorted: &mut Vec<Event>) {
    let events = || plant.events.iter().flatten().filter(|event| event.tick <= last);
    let mut ends = vec![0; last as usize + 1];
    events().for_each(|event| ends[event.tick as usize] += 1);
    let mut before = 0;
    ends.iter_mut().for_each(|end| before += std::mem::replace(end, before));
    // Dealt to their ticks first: what is noted axis by axis is then nearly in order, and sorted in one pass.
    sorted.clear();
    sorted.resize(before, Event { tick: 0, axis: AxisId::TRUNK, kind: EventKind::Grew, count: 0 });
    for event in events() {
        let end = &mut ends[event.tick as usize];
        sorted[*end] = *event;
        *end += 1;
    }
    sorted.chunk_by_mut(|a, b| a.tick == b.tick).for_each(|tick| tick.sort_by_key(|event| (event.axis, event.kind)));
}
