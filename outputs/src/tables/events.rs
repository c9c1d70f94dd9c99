//! The rows of `events`: what became of buds and branches, sorted by age and component.
//!
//! A plant that grew ahead notes its events axis by axis and one that followed the clock age by age; sorted, both are
//! the same rows.

use super::buffers::columns;
use phytomer_sim::plant::{Event, Plant};
use phytomer_sim::{Plot, Tick};

columns! {
    /// The buffers of `events`.
    EventColumns {
        treatment: Word(i8), plot: Int(i32), plant: Int(i32), age: Int(i32), component: Int(i32), axis: Int(i32),
        event: Word(i8), count: Int(i32),
    }
}

impl EventColumns {
    /// Adds the row of one event.
    #[inline]
    pub fn add(&mut self, plot: &Plot, plant: &Plant, event: &Event) {
        let bud = plant.axes.component[event.axis.index()] as i32;
        self.treatment.push(0);
        self.plot.push(plot.id as i32);
        self.plant.push(plant.id as i32);
        self.age.push(event.tick as i32);
        self.component.push(bud);
        self.axis.push(bud);
        self.event.push(event.kind as i8);
        self.count.push(event.count as i32);
    }
}

/// Puts the events of `plant` up to the age `last` into `sorted`. Axes climb with the numbers of their buds, and events
/// of one kind on one axis and tick keep the order in which they were noted.
pub fn sort(plant: &Plant, last: Tick, sorted: &mut Vec<Event>) {
    sorted.clear();
    sorted.extend(plant.events.iter().flatten().filter(|event| event.tick <= last));
    sorted.sort_by_key(|event| (event.tick, event.axis, event.kind));
}
