//! The plant as columns: axes, nodes and organs in structures of arrays with typed handles.
//!
//! Invariants: a parent's index is smaller than its child's in each column, and its component number too, except in
//! models that rewrite in mid-axis; death is a tick in a column, and a model that extends its plants removes nothing.
//! So poses are one forward scan, loads one reverse scan, and nothing recurses. Each column has one writer: models
//! write topology, rest geometry and the fates of buds and organs; [`crate::shed`] the death and fall of branches, the
//! model's `thicken` or secondary growth the diameters, [`crate::mechanics`] the curvature, [`crate::pose`] the frames.

mod appeared;
mod axis;
pub(crate) mod borne;
mod columns;
mod cut;
mod dormant;
mod event;
mod exposure;
mod first;
mod for_drawing;
mod form;
mod fragment;
pub(crate) mod frames;
mod habit;
mod handle;
mod joint;
mod kind;
mod lasting;
mod ledger;
mod length;
mod look;
mod many;
mod new_organs;
mod node;
mod organ;
mod outline;
mod own_look;
mod paged;
mod partway;
mod placed;
pub(crate) mod placing;
mod rare;
mod shade;
pub(crate) mod standing;
pub(crate) mod stated;
mod strain;
mod wood;

pub use appeared::{Appeared, Stretch};
pub use axis::{ApexFate, Axes, NewAxis, Origin};
pub use cut::{Cut, Cuts, Taking};
pub use dormant::{Dormant, DormantBuds};
pub use event::{Event, EventKind, NO_STATE};
pub use exposure::{Exposure, Hazard, Survival};
pub use for_drawing::{Carried, ForDrawing};
pub use form::Form;
pub use fragment::{Fragment, ThreadBudget};
pub use frames::{Frame, Frames};
pub use habit::{Habit, OrganTrend, OrganTrends, OwnTrends, Trend};
pub use handle::{AxisId, NodeId, OrganId};
pub use joint::Joint;
pub use kind::{Cause, Class, Kind, PartOfPlant};
pub(crate) use lasting::Lasting;
pub use ledger::Departed;
pub use length::Rewritten;
pub use look::{InternodeLook, Looks, OrganLook, OrganLooks, PaintNumber, Shape};
pub use many::{NewNodes, OfAxis, OfUnit, OrganTile};
pub use node::{BUDS_NOT_TOLD, NOT_TOLD, NewNode, Nodes};
pub use organ::{NewOrgan, Organs};
pub use outline::StatedOrgans;
pub use own_look::OwnLooks;
pub(crate) use partway::Former;
pub use partway::Partway;
pub use shade::Shade;
pub use stated::{Part, Rest, StatedFrames};
pub use strain::{Hold, Strain};
pub use wood::{Drag, OrganMass, Thickening, Tissue, Uprighting, Wood};

pub use crate::key::{self, LineageKey};

use crate::clock::{NEVER, Tick};
use crate::random::PlantRandom;
use std::ops::Mul;
use std::sync::Arc;

/// The most components that one plant may have: tables give two bits of 32 to the class of a component.
pub const MOST_COMPONENTS: u32 = (1 << 30) - 1;

/// One plant, from seed to death.
#[derive(Debug, Clone)]
pub struct Plant {
    /// Its number in the run, from 0.
    pub id: u32,
    /// The age up to which it has grown, in ticks.
    pub age: Tick,
    /// The tick from which nothing of the plant lives: every apex has ended and is spent; [`NEVER`] before. Written by
    /// [`crate::shed`].
    pub death: Tick,
    /// Its axes; the first one grew out of the seed.
    pub axes: Axes,
    /// Its internodes with their nodes.
    pub nodes: Nodes,
    /// The internodes that have appeared by the age of the last pass along them.
    pub appeared: Appeared,
    /// Its leaves, flowers and fruits.
    pub organs: Organs,
    /// The frame of each internode, written by the pose.
    pub frames: Frames,
    /// The curvature and the moment of each internode, written by mechanics; empty where the plant does not bend.
    pub strain: Strain,
    /// The events of its buds, where a run records them.
    pub events: Option<Vec<Event>>,
    /// The rules of its species for pose, shedding and drawing.
    pub habit: Arc<Habit>,
    /// The trends of axes that have drawn their own.
    pub own_trends: OwnTrends,
    /// What pests do to it; `None` where no pest is.
    pub exposure: Option<Arc<Exposure>>,
    /// Its height at the end of the last tick, metres above the seed, where its model asks
    /// ([`crate::Grow::sees_height`]); else 0.
    pub height: f32,
    /// What its buds lacked of full light at the end of the last tick, where its model asks
    /// ([`crate::Grow::sees_light`]); else nothing.
    pub shade: Shade,
    /// The source of its random words.
    pub random: PlantRandom,
    /// The place of its seed in the plot, metres. All other positions of a plant are relative to its seed, so that a
    /// plant is the same to the bit at every place.
    pub place: [f64; 3],
    /// The rest frames that a model or an event has stated; empty where insertion, phyllotaxis and trend determine all.
    pub stated: StatedFrames,
    /// The frames and outlines that single organs state.
    pub stated_organs: StatedOrgans,
    /// The lengths that a model has rewritten.
    pub rewritten: Rewritten,
    /// The looks that single nodes and organs have instead of those of their order.
    pub own_looks: OwnLooks,
    /// The cuts.
    pub cuts: Cuts,
    /// What a model that rewrites has taken out of the columns, in the order of departure; empty for other models.
    pub ledger: Vec<Departed>,
    /// The apical buds of axes that have left the columns, by their numbers, in the order of departure.
    gone_buds: Vec<u32>,
    /// The orders of their axes.
    gone_orders: Vec<u8>,
    /// The component that bore each component at its birth; empty where nothing ever changes its bearer.
    bearers: Vec<u32>,
    /// The axillary buds that lie dormant, where a cut may release them.
    pub dormant: DormantBuds,
    /// Thread budget of its growth; never changes the result.
    pub budget: ThreadBudget,
    /// What it has beside its columns where it is shown between two ticks.
    pub(crate) partway: Option<Box<Partway>>,
    components: u32,
    component_limit: u32,
    /// Whether lineage keys follow from the numbers of components instead of their places on the axes.
    named_by_number: bool,
}

/// The values of a new plant.
#[derive(Debug, Clone)]
pub struct Seed {
    /// The plant's number in the run, from 0.
    pub plant: u32,
    /// The key of its draws: [`draw_key`](crate::random::draw_key) of its replicate and its number there, not of its
    /// treatment.
    pub draws: u64,
    /// The seed of the run's draws.
    pub run_seed: u64,
    /// The most components that it may have.
    pub component_limit: u32,
    /// Whether the events of its buds are kept.
    pub keep_events: bool,
}

impl Plant {
    /// A plant without any axis yet; a model's `sow` adds the first.
    pub fn new(seed: &Seed, habit: Arc<Habit>) -> Self {
        Self {
            id: seed.plant,
            age: 0,
            death: NEVER,
            axes: Axes::default(),
            nodes: Nodes::default(),
            appeared: Appeared::default(),
            organs: Organs::default(),
            frames: Frames::default(),
            strain: Strain::default(),
            events: seed.keep_events.then(Vec::new),
            habit,
            own_trends: OwnTrends::default(),
            exposure: None,
            height: 0.0,
            shade: Shade::default(),
            random: PlantRandom::new(seed.run_seed, seed.draws),
            place: [0.0; 3],
            stated: StatedFrames::default(),
            stated_organs: StatedOrgans::default(),
            rewritten: Rewritten::default(),
            own_looks: OwnLooks::default(),
            cuts: Cuts::default(),
            ledger: Vec::new(),
            gone_buds: Vec::new(),
            gone_orders: Vec::new(),
            bearers: Vec::new(),
            dormant: DormantBuds::default(),
            budget: ThreadBudget::default(),
            partway: None,
            components: 0,
            component_limit: seed.component_limit.min(MOST_COMPONENTS),
            named_by_number: false,
        }
    }

    /// Makes this the plant of another seed and keeps the memory of its columns.
    pub fn resow(&mut self, seed: &Seed) {
        self.clear();
        self.id = seed.plant;
        self.exposure = None;
        self.random = PlantRandom::new(seed.run_seed, seed.draws);
        self.component_limit = seed.component_limit.min(MOST_COMPONENTS);
        self.events = seed.keep_events.then(|| self.events.take().unwrap_or_default());
    }

    /// Removes all components, for a model that rebuilds the plant.
    pub fn clear(&mut self) {
        self.begin_rewriting();
        self.ledger.clear();
        self.gone_buds.clear();
        self.gone_orders.clear();
        self.bearers.clear();
        self.age = 0;
        self.height = 0.0;
        self.shade.clear();
        self.components = 0;
        if let Some(events) = &mut self.events {
            events.clear();
        }
    }

    /// Empties the columns, for a model that writes them anew; component numbers, events and the ledger continue.
    pub fn begin_rewriting(&mut self) {
        self.death = NEVER;
        self.partway = None;
        self.axes.clear();
        self.nodes.clear();
        self.appeared.clear();
        self.organs.clear();
        self.frames.clear();
        self.strain.clear();
        self.own_trends.clear();
        self.stated.clear();
        self.stated_organs.clear();
        self.rewritten.clear();
        self.own_looks.clear();
        self.cuts.clear();
        self.dormant.clear();
    }

    /// Whether `more` components still fit under the plant's limit.
    #[inline]
    pub fn has_room_for(&self, more: u32) -> bool {
        self.components.saturating_add(more) <= self.component_limit
    }

    /// Whether the plant has more components than its limit: its model then stops and returns the limit.
    #[inline]
    pub fn is_overgrown(&self) -> bool {
        self.components > self.component_limit
    }

    /// The most components that the plant may have.
    pub fn component_limit(&self) -> u32 {
        self.component_limit
    }

    /// The number of components that ever were: internodes, organs and apical buds.
    pub fn components(&self) -> u32 {
        self.components
    }

    /// The number of components that have lived by `age`. A flower planned for a branch that died before it opened is
    /// not counted; what is in the ledger is. Linear in the components.
    pub fn lived_by(&self, age: Tick) -> u64 {
        let by = |births: &[Tick]| births.iter().filter(|&&birth| birth <= age).count() as u64;
        let organs = self.organs.birth.iter().zip(&self.organs.death);
        let opened = organs.filter(|&(&birth, &death)| birth <= age && birth < death).count() as u64;
        let departed = self.ledger.iter().filter(|departed| departed.birth <= age).count() as u64;
        by(&self.axes.appearance) + by(&self.nodes.birth) + opened + departed
    }

    /// Adds an axis, standing as a bud; its bearing node comes before it.
    #[inline]
    pub fn add_axis(&mut self, axis: NewAxis) -> AxisId {
        let component = self.number();
        self.axes.push(axis, component)
    }

    /// Adds an internode with its node at the tip of its axis.
    #[inline]
    pub fn add_node(&mut self, node: NewNode) -> NodeId {
        let component = self.number();
        let id = self.nodes.push(node, component);
        self.axes.grown(node.axis, id);
        id
    }

    /// Adds a leaf, a flower or a fruit to a node.
    #[inline]
    pub fn add_organ(&mut self, organ: NewOrgan) -> OrganId {
        let component = self.number();
        self.organs.push(organ, component)
    }

    /// Adds an event, where the run keeps events.
    #[inline]
    pub fn note(&mut self, tick: Tick, axis: AxisId, kind: EventKind, count: u32) {
        self.note_in_state(NO_STATE, tick, axis, kind, count);
    }

    /// As [`Plant::note`], with the state of the bud.
    #[inline]
    pub fn note_in_state(&mut self, state: u8, tick: Tick, axis: AxisId, kind: EventKind, count: u32) {
        if let Some(events) = &mut self.events {
            events.push(Event { tick, axis, kind, count, state });
        }
    }

    /// The lineage key of a node: it depends on its axis and its rank alone, or on its number.
    pub fn node_key(&self, node: NodeId) -> LineageKey {
        if self.named_by_number {
            return numbered(self.nodes.component[node.index()]);
        }
        self.axes.key[self.nodes.axis[node.index()].index()].child(key::Place::Node.on(self.nodes.rank[node.index()]))
    }

    /// The lineage key of an organ: it depends on its node, its kind and its position alone, or on its number.
    pub fn organ_key(&self, organ: OrganId) -> LineageKey {
        if self.named_by_number {
            return numbered(self.organs.component[organ.index()]);
        }
        let node = self.organs.node[organ.index()];
        let axis = self.nodes.axis[node.index()];
        let place = key::Place::Organ(self.organs.kind[organ.index()] as u8, self.organs.position[organ.index()]);
        self.axes.key[axis.index()].child(place.on(self.nodes.rank[node.index()]))
    }

    /// The trends that the internodes of an axis name by place.
    #[inline]
    pub fn trends_of(&self, axis: AxisId) -> &[Trend] {
        self.own_trends.of(axis).unwrap_or(&self.habit.trends)
    }

    /// The look of the internodes of an axis.
    #[inline]
    pub fn look_of(&self, axis: AxisId) -> &InternodeLook {
        self.habit.looks.internode(self.axes.order[axis.index()], self.axes.state[axis.index()])
    }

    /// The kind of an internode.
    #[inline]
    pub fn kind_of(&self, node: NodeId) -> Kind {
        self.look_of_node(node).kind(self.nodes.formation[node.index()].is_short())
    }

    /// The share of its full length and width that an organ has at `age`; its area is [`Plant::organ_area`].
    #[inline]
    pub fn expanded(&self, organ: OrganId, age: Tick) -> f32 {
        if let Some(partway) = &self.partway {
            return partway.sizes[organ.index()];
        }
        let own_age = age.saturating_sub(self.organs.birth[organ.index()]);
        self.look_of_organ(organ).map_or(1.0, |look| look.share(own_age))
    }

    /// The area of one side of an organ at `age`, m²: its full area times the square of the share to which it has
    /// expanded. In double precision for sums, in single precision for tables. Every use of the area at an age calls
    /// this instead of reading the column `area`.
    #[inline]
    pub fn organ_area<T: From<f32> + Copy + Mul<Output = T>>(&self, organ: OrganId, age: Tick) -> T {
        let share = T::from(self.expanded(organ, age));
        T::from(self.organs.area[organ.index()]) * share * share
    }

    #[inline]
    fn number(&mut self) -> u32 {
        let component = self.components;
        self.components += 1;
        component
    }
}

/// The lineage key of a component that is named by its number.
#[inline]
fn numbered(component: u32) -> LineageKey {
    LineageKey::SEED.child(key::Place::Numbered.on(component))
}

#[cfg(test)]
mod tests_cuts;
#[cfg(test)]
mod tests_states;
