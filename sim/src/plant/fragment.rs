//! Fragments: axes of a plant that have yet to grow, taken apart so that another thread can grow them meanwhile.
//!
//! Axes that wait have no nodes, and grow independently of one another. A fragment is a plant that starts with copies
//! of some of them; once it is joined, the whole plant is as if they had grown after the axes before them: the numbers
//! of axes, nodes, organs and components are consecutive. Until then handles and component numbers are the fragment's
//! own, except for the bearing nodes of the axes that it took: these are numbered as in the whole plant, and must not
//! be read in the fragment.

use super::columns::Columns;
use super::{Appeared, Event, Frames, Joint, OwnTrends, Plant, Strain};
use crate::clock::NEVER;
use std::ops::Range;

/// Thread budget: the number of threads that may grow one plant at once. It never changes the result.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ThreadBudget {
    /// The number of threads: more than 1 where other threads would have nothing to do.
    pub threads: usize,
    /// The fewest axes of which another thread is given half. Growing the default number takes some 5 ms in a poplar,
    /// far more than waking a thread and joining the fragment.
    pub least_axes: usize,
}

impl Default for ThreadBudget {
    fn default() -> Self {
        Self { threads: 1, least_axes: 4096 }
    }
}

impl ThreadBudget {
    /// Whether this number of axes is to be shared out.
    pub fn share(self, axes: usize) -> bool {
        self.threads > 1 && axes >= self.least_axes.max(2)
    }

    /// The budgets of the two halves.
    pub fn parted(self) -> (Self, Self) {
        let first = self.threads / 2;
        (Self { threads: first, ..self }, Self { threads: self.threads - first, ..self })
    }
}

/// Some of the axes of a plant that wait to grow.
#[derive(Debug)]
pub struct Fragment {
    /// The fragment as a plant.
    pub plant: Plant,
    joint: Joint,
}

impl Fragment {
    /// The axes that are to grow, in the fragment's numbers.
    pub fn waiting(&self) -> Range<usize> {
        0..self.joint.taken.len()
    }
}

impl Plant {
    /// A fragment of the axes `waiting`, which have no nodes; the axis of the seed is not among them.
    pub fn fragment(&self, waiting: Range<usize>) -> Fragment {
        let taken = waiting;
        let plant = Self {
            id: self.id,
            age: self.age,
            death: NEVER,
            axes: self.axes.copied(taken.clone()),
            nodes: Default::default(),
            appeared: Appeared::default(),
            organs: Default::default(),
            frames: Frames::default(),
            strain: Strain::default(),
            events: self.events.as_ref().map(|_| Vec::new()),
            habit: self.habit.clone(),
            own_trends: OwnTrends::default(),
            exposure: self.exposure.clone(),
            height: self.height,
            shade: super::Shade::default(),
            random: self.random.clone(),
            place: self.place,
            stated: Default::default(),
            stated_organs: Default::default(),
            rewritten: Default::default(),
            own_looks: Default::default(),
            cuts: Default::default(),
            ledger: Vec::new(),
            gone_buds: Vec::new(),
            gone_orders: Vec::new(),
            bearers: Vec::new(),
            dormant: self.dormant.begun(),
            budget: self.budget,
            partway: None,
            components: 0,
            component_limit: self.component_limit.saturating_sub(self.components),
            named_by_number: self.named_by_number,
        };
        Fragment { plant, joint: Joint { taken, axes: 0, nodes: 0, components: 0 } }
    }

    /// Joins a fragment that has grown: its parts follow all parts of the plant. Returns the map from the fragment's
    /// handles to the plant's. Linear in the fragment.
    pub fn join(&mut self, fragment: Fragment) -> Joint {
        let Fragment { mut plant, joint } = fragment;
        let (axes, nodes, components) = (self.axes.len(), self.nodes.len(), self.components);
        let joint = Joint { axes, nodes, components, ..joint };
        self.own_trends.join(std::mem::take(&mut plant.own_trends), |axis| joint.axis(axis));
        self.stated.join(&plant.stated, &joint);
        self.stated_organs.join(&plant.stated_organs, self.organs.len());
        self.rewritten.join(&plant.rewritten, &joint);
        self.own_looks.join(&plant.own_looks, [nodes, self.organs.len()]);
        self.dormant.join(&plant.dormant, nodes);
        self.nodes.join_runs(&plant.nodes, &joint);
        self.axes.take_back(&plant.axes, &joint);
        self.join_columns(&plant, &joint);
        if let (Some(events), Some(more)) = (&mut self.events, plant.events.take()) {
            events.extend(more.into_iter().map(|event| Event { axis: joint.axis(event.axis), ..event }));
        }
        self.components += plant.components;
        joint
    }

    /// Adds the axes that arose in a fragment, its nodes and its organs; columns are copied in parallel.
    fn join_columns(&mut self, grown: &Self, joint: &Joint) {
        let arose = joint.taken.len()..grown.axes.len();
        let Self { axes, nodes, organs, .. } = self;
        rayon::in_place_scope(|scope| {
            nodes.join_columns(&grown.nodes, &(0..grown.nodes.len()), joint, scope);
            organs.join_columns(&grown.organs, &(0..grown.organs.len()), joint, scope);
            axes.join_columns(&grown.axes, &arose, joint, scope);
        });
    }
}
