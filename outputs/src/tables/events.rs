//! The rows of `events`: fates of buds and branches, sorted by tick, plant and component.
//!
//! A plant that is grown ahead notes its events axis by axis, a plant that is grown tick by tick notes them age by age;
//! sorted, both give equal rows. The events of a plot are first dealt to its ticks, plant by plant, then sorted within
//! each tick and plant. This holds a second copy of the events of one plot in memory.

use super::buffers::{NULL, columns};
use super::membership::{Membership, by_number, name_of};
use phytomer_sim::plant::{AxisId, Event, EventKind, NO_STATE, Plant};
use phytomer_sim::{Plot, Tick};

columns! {
    /// The buffers of `events`.
    EventColumns of event: Event, of: (Membership, &Plant, &[i32]) {
        treatment: Name(i32) = of.0.treatment as i32,
        plot: Int(i32) = of.0.plot as i32,
        plant: Int(i32) = of.1.id as i32,
        tick: Int(i32) = of.0.tick_at(event.tick) as i32,
        age: Int(i32) = event.tick as i32,
        component: Int(i32) = of.1.bud_number(event.axis) as i32,
        axis: Int(i32),
        order: Int(i32) = i32::from(of.1.order_of(event.axis)),
        state: Int(i32) = if event.state == NO_STATE { NULL } else { i32::from(event.state) },
        state_name: Name(i32) = name_of(of.2, event.state),
        event: Word(i8) = event.kind as i8,
        count: Int(i32) = event.count as i32,
    }
}

impl EventColumns {
    /// Adds a row for each of the events of one plant. `states` are the names of the states of its model.
    pub fn fill(&mut self, of: Membership, (plant, states): (&Plant, &[i32]), events: &[Event]) {
        let before = self.component.len();
        self.extend(events, (of, plant, states));
        self.axis.extend_from_slice(&self.component[before..]);
    }
}

/// The events of a plot in the order of their rows.
#[derive(Debug, Default)]
pub struct SortedEvents {
    events: Vec<Event>,
    stretches: Vec<Stretch>,
}

/// Consecutive events of one plant.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    start: usize,
    end: usize,
    /// The index of the plant in the plot.
    at: usize,
}

impl SortedEvents {
    /// Sorts the events of a plot up to its tick `last` and replaces the previous content. Takes at most O(n log n + p
    /// t) for n events, p plants and t ticks; less where events are noted nearly in order.
    pub fn sort(&mut self, plot: &Plot, last: Tick) {
        let order = by_number(plot);
        // `next` holds for each tick first the number of its events, then the place of its next event.
        let mut next = vec![0; last as usize + 1];
        for &at in &order {
            events_of(plot, at, last).for_each(|(tick, _)| next[tick] += 1);
        }
        let mut before = 0;
        next.iter_mut().for_each(|next| before += std::mem::replace(next, before));
        self.events.clear();
        self.events
            .resize(before, Event { tick: 0, axis: AxisId::TRUNK, kind: EventKind::Grew, count: 0, state: NO_STATE });
        self.stretches.clear();
        for at in order {
            self.deal(plot, at, last, &mut next);
        }
        self.stretches.sort_unstable_by_key(|stretch| stretch.start);
        self.stretches.dedup_by(|next, stretch| {
            let goes_on = next.at == stretch.at;
            stretch.end = if goes_on { next.end } else { stretch.end };
            goes_on
        });
    }

    /// Deals the events of one plant to their ticks. Events noted axis by axis are then nearly in order, and one pass
    /// sorts them; events of one kind on one axis and tick keep the order in which they were noted.
    fn deal(&mut self, plot: &Plot, at: usize, last: Tick, next: &mut [usize]) {
        let starts = next.to_vec();
        for (tick, event) in events_of(plot, at, last) {
            self.events[next[tick]] = *event;
            next[tick] += 1;
        }
        let plant = &plot.plants[at];
        // Where axes are in the order of the numbers of their buds, the numbers need not be looked up.
        let climb = plant.axes.component.is_sorted() && plant.ledger.is_empty();
        for (start, end) in starts.into_iter().zip(&*next).filter(|(start, end)| start < *end) {
            let number = |axis: AxisId| if climb { axis.0 } else { plant.bud_number(axis) };
            self.events[start..*end].sort_by_key(|event| (number(event.axis), event.kind));
            self.stretches.push(Stretch { start, end: *end, at });
        }
    }

    /// The sorted events in stretches of one plant, each with the index of the plant in the plot.
    pub fn stretches(&self) -> impl Iterator<Item = (usize, &[Event])> {
        self.stretches.iter().map(|stretch| (stretch.at, &self.events[stretch.start..stretch.end]))
    }
}

/// The events of a plant up to a tick of its plot, each with its tick.
fn events_of<'a>(plot: &'a Plot<'_>, at: usize, last: Tick) -> impl Iterator<Item = (usize, &'a Event)> {
    let of = Membership::of(plot, at);
    let noted = plot.plants[at].events.iter().flatten();
    let dated = noted.map(move |event| (of.tick_at(event.tick), event));
    dated.filter(move |(tick, _)| *tick <= last).map(|(tick, event)| (tick as usize, event))
}
