//! What a bud does where it meets an obstacle that blocks, the ground, or the stem of a plant.
//!
//! De Reffye et al. 1988 §4 name the obstruction "due to fixed obstacles or to part of the plant against another part"
//! as what their traversal could not do. A bud is asked at each clock step whether its cone meets a surface or a stem,
//! from where it stands; then it pauses, dies, or makes its growth unit, of which each internode that would enter a
//! solid or touch a stem is turned along it. A node for which there is no way is not made: the unit ends before it.
//! Turns are stated as rest frames of the nodes, and those of leaves as theirs, so the pose, bending and all tables
//! follow; a plant that meets nothing states none and is to the byte the plant of an open site. Absent: the tip and its
//! way (`around`).

use super::around::{Around, Lie, Next};
use super::bud::ApicalBud;
use super::compile::BudModel;
use super::grow::{Axis, Full};
use super::node::Drawn;
use super::params::{Answer, ApexEnd};
use super::start::Start;
use crate::law::At;
use phytomer_sim::plant::{ApexFate, EventKind, NodeId, OrganId, Plant, Rest};
use phytomer_sim::site::Site;
use phytomer_sim::site::solids::CLEARANCE;
use phytomer_sim::site::stems::{Beside, Spared, Stems, Whose};
use phytomer_sim::site::way::Step;

impl<'a> Axis<'a> {
    /// Lets its shoots meet the solids and stems of a site.
    pub fn look_around(&mut self, site: Option<&'a Site>) {
        self.met = site.filter(|site| Around::meets(site));
        if let Some(site) = self.met.filter(|_| !Around::feels(&self.model.contact)) {
            self.start = Start::of(self.plant, self.bud.axis).among(site.solids());
        }
    }

    /// Whether its growth units are made as in the open, unless something turns out to be within their reach.
    pub(super) fn begins_free(&self) -> bool {
        self.met.is_none() || self.start.is_some()
    }

    /// Whether a growth unit of so many nodes, which is decided on at a point of the laws, meets nothing, so that none
    /// of its nodes asks. From the first unit that may meet something, each node of the axis asks until the end of the
    /// tick; what was planned is made before.
    #[inline(always)]
    pub(super) fn is_free(&mut self, at: &At, short: bool, nodes: u32) -> Result<bool, Full> {
        if self.met.is_none() { Ok(true) } else { self.asks_whether_free(at, short, nodes) }
    }

    #[inline(never)]
    fn asks_whether_free(&mut self, at: &At, short: bool, nodes: u32) -> Result<bool, Full> {
        let (Some(site), Some(start)) = (self.met, self.start) else { return Ok(false) };
        if nodes == 0 {
            return Ok(true);
        }
        let (plant, axis, reach) = (self.plant.id, self.bud.axis, &self.laws.reach);
        let spared = Spared { plant, axis: axis.0 };
        let length = reach.length(short, nodes);
        let past = |stems: &Stems| {
            // Wood of its own is beside nearly every bud.
            let has_own = stems.whose() == Whose::All && start.grown == 0.0;
            let is_far = !has_own && start.is_far(stems, length + reach.radius, spared);
            if is_far { nodes } else { self.nodes_past(at, (short, nodes), stems, spared) }
        };
        let is_clear = start.is_clear_of(site.solids(), length + reach.radius.max(reach.leaf));
        let stems = site.stems.as_deref().filter(|stems| !stems.is_empty());
        let past = if is_clear { stems.map_or(nodes, past) } else { 0 };
        if past == nodes {
            self.start = Some(start.behind(length));
            return Ok(true);
        }
        let start = start.before(length - reach.length(short, 1), past);
        (self.start, self.plans) = (None, false);
        self.make_planned()?;
        self.around = Some(Box::new(Around::of(site, self.model.contact, self.plant, axis, start)));
        Ok(false)
    }

    /// Asks at a clock step whether the bud meets something.
    #[inline]
    pub(super) fn feel(&mut self) {
        let Some(site) = self.met else { return };
        if self.around.is_some() || self.start.is_none() {
            let plant = &*self.plant;
            let around = self.around.get_or_insert_with(|| around(site, self.model, plant, self.bud));
            self.contact = u32::from(around.feel(plant));
        }
    }

    /// What a bud that is about to grow does where it meets something: `None` where it grows on, else whether it lives.
    pub(super) fn answer_contact(&mut self) -> Result<Option<bool>, Full> {
        if self.contact == 0 {
            return Ok(None);
        }
        match self.model.contact.answer {
            Answer::Pause => {
                self.note(EventKind::Paused, 1);
                Ok(Some(true))
            }
            Answer::Die => self.obstruct().map(Some),
            Answer::Deflect | Answer::Fasten => Ok(None),
        }
    }

    /// How the next internode lies; `None` where there is no way for it.
    #[inline]
    pub(super) fn lie(&mut self, drawn: &Drawn) -> Option<Lie> {
        let Some(site) = self.met else { return Some(Lie::Free) };
        let left = self.plant.axes.key[self.bud.axis.index()].0 & 1 == 1;
        let radius = 0.5 * f64::from(drawn.diameter);
        let next = Next { length: f64::from(drawn.length), radius, trend: drawn.trend, left };
        let plant = &*self.plant;
        let around = self.around.get_or_insert_with(|| around(site, self.model, plant, self.bud));
        around.try_next(plant, next)
    }

    /// Turns a leaf of the node that is being dressed whose tip would enter a solid at its birth or as it turns with
    /// age: it then lies along the solid for all its life, its upper side away from it. One for which there is no room
    /// stays as it is.
    #[inline]
    pub(super) fn lay_leaf(&mut self, leaf: OrganId) {
        let Self { around: Some(around), plant, .. } = self else { return };
        let length = f64::from(plant.organs.length[leaf.index()]);
        if around.is_far(plant, length + CLEARANCE) {
            return;
        }
        let headings = around.end(plant).headings_of(plant, leaf);
        let (from, up) = (around.tip(), [0.0, 0.0, 1.0]);
        // A blade has no thickness, and meets surfaces alone.
        let stems = Beside::NONE;
        let step = |heading| Step { from, heading, up, length, radius: 0.0, hold: None, left: true, stems };
        let found = headings.map(|heading| around.solids.way(&step(heading)));
        if (0..3).any(|k| found[k] != Some(headings[k]))
            && let Some(heading) = found[2].or(found[0])
        {
            let outward = around.outward(length);
            let turn = around.end(plant).organ_turn(heading, outward);
            plant.state_organ(leaf, turn, [0.0; 3]);
        }
    }

    /// States the turn of a node that was made.
    pub(super) fn turn(&mut self, node: NodeId, lie: Lie) {
        if let Lie::Turned(rotation) = lie {
            self.plant.state_rest(node, Rest::Turned(rotation));
        }
    }

    /// After a growth unit: whether the bud has died since there was no way on.
    pub(super) fn ends_stuck(&mut self) -> Result<bool, Full> {
        let stuck = self.around.as_ref().is_some_and(|around| around.stuck);
        if stuck && self.model.contact.answer == Answer::Die {
            self.obstruct()?;
            return Ok(true);
        }
        Ok(false)
    }

    pub(super) fn is_stuck(&self) -> bool {
        self.around.as_ref().is_some_and(|around| around.stuck)
    }

    fn obstruct(&mut self) -> Result<bool, Full> {
        self.end(ApexFate::Obstructed, EventKind::Obstructed, ApexEnd::Death)
    }
}

/// What is around a bud, found when it is first asked in a tick: before the axis has grown in it.
fn around<'a>(site: &'a Site, model: &BudModel, plant: &Plant, bud: ApicalBud) -> Box<Around<'a>> {
    Box::new(Around::of(site, model.contact, plant, bud.axis, Start::of(plant, bud.axis)))
}
