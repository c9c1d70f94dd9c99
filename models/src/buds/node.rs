//! One node of a growth unit: its internode, leaves, flowers and buds, and the axes that arise from buds.
//!
//! Order of a node's components: internode, leaves, lateral flowers, then axillary and reiteration buds; the positions
//! of a node are spread evenly around it, the first at the node's azimuth, each axillary bud in the axil of its leaf.

use super::around::Lie;
use super::birth::add_axis;
use super::bud::ApicalBud;
use super::compile::Branching;
use super::grow::{Axis, Full};
use super::params::ApexEnd;
use super::record::read;
use super::site::{Bearing, BudSite, TURN, spacing, turned};
use crate::law::At;
use phytomer_sim::plant::key::Place;
use phytomer_sim::plant::{Dormant, EventKind, NewNode, NodeId, Origin};
use phytomer_sim::random::Purpose;

/// The axillary buds of one node.
#[derive(Debug, Clone, Copy)]
struct AxillaryBuds {
    node: NodeId,
    rank: u32,
    nodes: u32,
    buds: u32,
    /// The angle between two neighbouring positions around the node, radians.
    spacing: f32,
}

/// An internode as it is drawn, before it is made.
#[derive(Debug, Clone, Copy)]
pub(super) struct Drawn {
    /// Its rank in its growth unit.
    pub rank: u32,
    /// Whether its growth unit is short.
    pub short: bool,
    pub neoformed: bool,
    /// Its length, metres.
    pub length: f32,
    /// Its diameter at its birth, metres.
    pub diameter: f32,
    /// The trend that it names.
    pub trend: u8,
}

impl Axis<'_> {
    /// Adds a node to a growth unit of `nodes` nodes.
    pub(super) fn node(&mut self, drawn: Drawn, nodes: u32, lie: Lie) -> Result<(), Full> {
        let rank = drawn.rank;
        let azimuth = self.bud.azimuth;
        let node = self.internode(drawn);
        self.turn(node, lie);
        let buds = if self.laws.node.is_bare {
            self.bud.dormant = 0;
            0
        } else {
            self.dress(node, rank, nodes, azimuth)
        };
        self.plant.nodes.state_making(node, self.bud.units + 1, self.bud.cycle, buds);
        if self.plant.is_overgrown() { Err(Full) } else { Ok(()) }
    }

    /// Adds leaves, lateral flowers, and the axes that buds become. Returns the number of axillary buds.
    fn dress(&mut self, node: NodeId, rank: u32, nodes: u32, azimuth: f32) -> u32 {
        let at = self.at(rank);
        let laws = &self.laws.node;
        let words = &self.words.on_node;
        let leaves = laws.leaves.draw(words, 0, at);
        let flowers = laws.flowers.draw(words, 0, at);
        let buds = laws.axillary.count.draw(words, 0, at);
        let reiterations = laws.reiteration.count.draw(words, 0, at);
        let spacing = spacing(leaves.max(buds));
        for nth in 0..leaves {
            self.leaf(node, nth, azimuth + spacing * nth as f32, at);
        }
        let between_flowers = super::site::spacing(flowers.max(leaves).max(buds));
        for nth in 0..flowers {
            self.lateral_flower(node, nth, azimuth + between_flowers * nth as f32, at);
        }
        self.axillary(AxillaryBuds { node, rank, nodes, buds, spacing }, azimuth);
        self.reiterations(node, reiterations, azimuth + spacing / 2.0, at);
        buds
    }

    /// Draws the next internode, of this rank in its growth unit.
    #[inline]
    pub(super) fn draw_internode(&self, rank: u32, [short, neoformed]: [bool; 2]) -> Drawn {
        let (laws, words, at) = (&self.laws.node, &self.words.on_node, self.at(rank));
        let length = if short { &laws.short_length } else { &laws.long_length };
        let trend = self.laws.head.trends.at(self.bud.rank + 1, self.bud.state, &self.words.trends);
        let (length, diameter) = (length.draw(words, 0, at), laws.diameter.draw(words, 0, at));
        Drawn { rank, short, neoformed, length, diameter, trend }
    }

    #[inline]
    fn internode(&mut self, drawn: Drawn) -> NodeId {
        let Drawn { rank, short, neoformed, length, diameter, trend } = drawn;
        let at = self.at(rank);
        let along = self.bud.rank + 1;
        let new = NewNode {
            parent: self.bud.last_node,
            axis: self.bud.axis,
            birth: self.tick,
            rank: along,
            unit_rank: u16::try_from(rank).unwrap_or(u16::MAX),
            short,
            neoformed,
            trend,
            length,
            diameter,
            azimuth: self.bud.azimuth,
        };
        self.bud.azimuth = turned(self.bud.azimuth, self.laws.node.divergence.draw(&self.words.on_node, 0, at));
        self.bud.rank = along;
        self.bud.passages = 0;
        self.bud.last_node = self.plant.add_node(new);
        self.bud.last_node
    }

    /// Adds the axes of the axillary buds: each bud ramifies by its law, or lies dormant.
    fn axillary(&mut self, of: AxillaryBuds, azimuth: f32) {
        let AxillaryBuds { node, rank, nodes, buds, spacing } = of;
        let at = self.at(rank);
        let model = self.model;
        let laws = self.laws;
        let order = laws.number + 1;
        let ramification = laws.node.ramification(rank, nodes, &self.words.zones).filter(|_| model.has_order(order));
        self.bud.dormant = 0;
        self.bud.bud_spacing = spacing;
        for position in 0..buds {
            let words = &self.words.on_node;
            let Some(of) = ramification.filter(|of| of.chance.happens(words, position, at)) else {
                self.bud.dormant |= 1 << position;
                continue;
            };
            let site = BudSite::axillary(node, (order, self.bud.rank), position, (azimuth, spacing));
            let site = BudSite { state: of.state(words, position, at), ..site };
            self.branch(site, &laws.node.axillary, EventKind::Branched, false, at);
        }
        if buds > 0 {
            self.remember_dormant(node);
        }
    }

    fn reiterations(&mut self, node: NodeId, buds: u32, azimuth: f32, at: At) {
        let laws = self.laws;
        let (order, spacing) = (laws.node.reiteration_order, spacing(buds));
        for position in 0..buds {
            if laws.node.reiteration.chance.happens(&self.words.on_node, position, at) {
                let site = BudSite::reiteration(node, (order, self.bud.rank), position, (azimuth, spacing));
                self.branch(site, &laws.node.reiteration, EventKind::Reiterated, false, at);
            }
        }
    }

    /// Whether relays follow this end of an apex, traumatic reiteration, forks or the time for which it persists.
    fn followers(&self, end: ApexEnd) -> [bool; 3] {
        let laws = &self.laws.end;
        let released = end == ApexEnd::Death && !laws.traumatic.chance.is_never();
        let completed = end == ApexEnd::Completed && (laws.fork.is_some() || laws.persists.is_some());
        [laws.is_relayed(end), released, completed]
    }

    /// Whether anything follows this end of an apex.
    pub(super) fn is_followed(&self, end: ApexEnd) -> bool {
        self.followers(end).contains(&true)
    }

    /// Adds the axes that follow the end of an apex: relays from the last node or below, and traumatic reiteration
    /// where it died.
    pub(super) fn follow_end(&mut self, end: ApexEnd) -> Result<(), Full> {
        let laws = &self.laws.end;
        let [relayed, released, _] = self.followers(end);
        let Some(node) = self.own_last_node().filter(|_| self.is_followed(end)) else {
            return Ok(());
        };
        self.read_end(0);
        let (rank, below) = (self.bud.rank, laws.below.draw(&self.words.end, 0, self.at(0)));
        if relayed && self.bud.rank > below {
            self.relays(node, below, |position| Place::Relay(position).on(rank - below));
        }
        if released {
            self.release(node);
        }
        if end == ApexEnd::Completed {
            self.fork(node);
        }
        if self.plant.is_overgrown() { Err(Full) } else { Ok(()) }
    }

    /// Adds the relays of an axis that passes into another state and lives on.
    pub(super) fn follow_passage(&mut self) -> Result<(), Full> {
        let laws = &self.laws.end;
        let Some(node) = self.own_last_node() else {
            return Ok(());
        };
        // The record of the end is the first in the stream; then comes one record a clock step.
        self.read_end(self.bud.cycle);
        let (rank, below) = (self.bud.rank, laws.below.draw(&self.words.end, 0, self.at(0)));
        if rank > below {
            // The place in the key names the node at which the axis passed, since relays of two passages may stand on
            // one node; and the number of earlier passages at that node, since a step need not make a node.
            let before = self.bud.passages;
            let some = self.relays(node, below, |position| Place::Passage(before, position).on(rank));
            self.bud.passages += u32::from(some);
        }
        if self.plant.is_overgrown() { Err(Full) } else { Ok(()) }
    }

    fn read_end(&mut self, record: u32) {
        let width = self.laws.end.width;
        if width > 0 {
            let key = self.plant.axes.key[self.bud.axis.index()];
            let mut stream = self.plant.random.stream(key, Purpose::Relay);
            read(&mut stream, 0, record, width, &mut self.words.end);
        }
    }

    /// Adds the equal axes into which a completed apex divides.
    fn fork(&mut self, node: NodeId) {
        let laws = self.laws;
        let at = self.at(0);
        let persists = laws.end.persists.as_ref().map_or(0, |ticks| ticks.draw(&self.words.end, 0, at));
        self.plant.axes.spent[self.bud.axis.index()] = self.tick.saturating_add(persists);
        let Some(fork) = &laws.end.fork else {
            return;
        };
        let count = fork.count.draw(&self.words.end, 0, at);
        for position in 0..count {
            let site = BudSite {
                node,
                order: laws.number,
                origin: Origin::Fork,
                place: Place::Fork(position as u16).on(self.bud.rank),
                position,
                azimuth: self.bud.azimuth + TURN / count as f32 * position as f32,
                follows: position > 0,
                state: None,
            };
            self.branch(site, fork, EventKind::Forked, true, at);
        }
    }

    /// Adds relays at the node that stands `below` nodes below the last one. Returns whether there are any.
    fn relays(&mut self, last: NodeId, below: u32, place: impl Fn(u16) -> u64) -> bool {
        let laws = self.laws;
        let at = self.at(0);
        // The first relay stands where the first leaf of the next node would stand: phyllotaxis continues.
        let (mut node, mut first) = (last, self.bud.azimuth);
        for _ in 0..below {
            first = self.plant.nodes.azimuth[node.index()];
            node = self.plant.nodes.parent[node.index()];
        }
        let count = laws.end.relay.count.draw(&self.words.end, 0, at);
        let mut follows = false;
        for position in 0..count {
            let azimuth = first + TURN / count as f32 * position as f32;
            let (order, place) = (laws.number, place(position as u16));
            let site = BudSite { node, order, origin: Origin::Relay, place, position, azimuth, follows, state: None };
            if laws.end.relay.chance.happens(&self.words.end, position, at) {
                follows = true;
                self.branch(site, &laws.end.relay, EventKind::Relayed, true, at);
            }
        }
        follows
    }

    /// Traumatic reiteration: releases the dormant axillary buds of the last node, at this axis's order. Those that
    /// stay dormant may be released by a later cut.
    pub(super) fn release(&mut self, node: NodeId) {
        let laws = self.laws;
        let at = self.at(0);
        let first = self.plant.nodes.azimuth[node.index()];
        let (dormant, spacing) = (self.bud.dormant, self.bud.bud_spacing);
        for position in (0..32).filter(|position| dormant >> position & 1 == 1) {
            if laws.end.traumatic.chance.happens(&self.words.end, position, at) {
                let azimuth = first + spacing * position as f32;
                let place = Place::Released(position as u16).on(self.bud.rank);
                let (order, origin) = (laws.number, Origin::Traumatic);
                let site = BudSite { node, order, origin, place, position, azimuth, follows: false, state: None };
                self.branch(site, &laws.end.traumatic, EventKind::Reiterated, true, at);
                self.bud.dormant &= !(1 << position);
            }
        }
        self.remember_dormant(node);
    }

    /// Writes down the buds of a node that lie dormant, where a cut may release them.
    fn remember_dormant(&mut self, node: NodeId) {
        if self.plant.dormant.are_kept() {
            let ApicalBud { dormant: buds, bud_spacing: spacing, state, .. } = self.bud;
            self.plant.dormant.set(node, Dormant { buds, spacing, state });
        }
    }

    /// A new axis from a bud; `end` tells whether its draws stand in the record of the end or of the node.
    fn branch(&mut self, site: BudSite, laws: &Branching, event: EventKind, end: bool, at: At) {
        let words = if end { &self.words.end } else { &self.words.on_node };
        let key = self.plant.axes.key[self.bud.axis.index()];
        let new = site.axis(laws, words, Bearing { key, state: self.bud.state }, at);
        let axis = add_axis(self.model, self.plant, new);
        self.plant.note_in_state(new.state, self.tick, axis, event, 1);
    }
}
