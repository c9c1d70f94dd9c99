//! The events of a plant that is rewritten: those that were noted keep their axes by the numbers of their buds, while
//! the columns are made anew.
//!
//! Absent: which modules are lost, and why (`model`).

use phytomer_sim::clock::Tick;
use phytomer_sim::plant::{AxisId, Event, EventKind, LineageKey, NO_STATE, NewAxis, NodeId, Plant};

/// What is to be noted of a tick, by the numbers of buds, and the buds of the axes in the columns before.
#[derive(Debug, Default)]
pub(super) struct Noted {
    /// Whether the plant keeps events.
    keeps: bool,
    buds: Vec<u32>,
    /// As they were noted: bud, kind and count.
    new: Vec<(u32, EventKind, u32)>,
    /// By the numbers of buds, their axes in the columns.
    places: Vec<AxisId>,
}

impl Noted {
    /// Forgets what was noted, before the columns of a plant are emptied.
    pub fn begin(&mut self, plant: &Plant) {
        self.keeps = plant.events.is_some();
        self.buds.clear();
        self.new.clear();
        if self.keeps {
            self.buds.extend_from_slice(&plant.axes.component);
        }
    }

    /// An event of the bud with a number; events of a kind add up.
    pub fn add(&mut self, bud: u32, kind: EventKind, count: u32) {
        if !self.keeps {
            return;
        }
        match self.new.last_mut() {
            Some(last) if (last.0, last.1) == (bud, kind) => last.2 += count,
            _ => self.new.push((bud, kind, count)),
        }
    }

    /// Sorts all that was noted by bud and kind, each pair once.
    fn sort(&mut self) {
        // Buds mostly rise along the string, so that few long runs are merged.
        self.new.sort_by_key(|&(bud, kind, _)| (u64::from(bud) << 8) | kind as u64);
        self.new.dedup_by(|next, kept| {
            let is_same = (next.0, next.1) == (kept.0, kept.1);
            kept.2 += if is_same { next.2 } else { 0 };
            is_same
        });
    }
}

/// Gives the events that were noted before the handles of their axes in the new columns, and adds those of the tick
/// `age`: what was noted, axes that have appeared, and their internodes.
pub(super) fn note(plant: &mut Plant, age: Tick, noted: &mut Noted) {
    let Some(mut events) = plant.events.take() else { return };
    if age > 0 {
        let Plant { axes, nodes, .. } = &*plant;
        let appeared = axes.appearance.iter().zip(&axes.component).filter(|(appearance, _)| **appearance == age);
        appeared.for_each(|(_, bud)| noted.add(*bud, EventKind::Branched, 1));
        let grown = nodes.birth.iter().zip(&nodes.axis).filter(|(birth, _)| **birth == age);
        grown.for_each(|(_, axis)| noted.add(axes.component[axis.index()], EventKind::Grew, 1));
    }
    noted.sort();
    let Noted { buds, new, places, .. } = noted;
    places.clear();
    places.resize(plant.components() as usize, AxisId::TRUNK);
    for (axis, number) in (0..).zip(&plant.axes.component) {
        places[*number as usize] = AxisId(axis);
    }
    for (nth, number) in plant.gone_buds().iter().enumerate() {
        places[*number as usize] = AxisId::gone(nth);
    }
    let place = |number: u32| places.get(number as usize).copied().unwrap_or(AxisId::TRUNK);
    for event in &mut events {
        if let Some(number) = buds.get(event.axis.index()) {
            event.axis = place(*number);
        }
    }
    events.extend(new.iter().map(|&(bud, kind, count)| Event {
        tick: age,
        axis: place(bud),
        kind,
        count,
        state: NO_STATE,
    }));
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
