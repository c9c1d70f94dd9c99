//! Axes plan the nodes of their growth units, and make them in blocks.
//!
//! Absent: how a block is made (`columns`), and which axes plan (`grow`).

use super::around::Lie;
use super::bud::ApicalBud;
use super::columns::Block;
use super::compile::{BudModel, Piece};
use super::grow::{Axis, Full};
use super::plan::{Plan, Shoot};
use super::record::Words;
use crate::law::At;
use phytomer_sim::plant::{NodeId, Plant};

/// The fewest nodes that are made at once: fewer of one axis are made faster one by one, as measured.
const FEWEST: u32 = 4;

/// The fewest nodes that axes which grow by the clock make at once, as measured: bare ones and others.
const MANY_BY_THE_CLOCK: [u32; 2] = [8, 2];

impl Axis<'_> {
    /// Plans the nodes of a growth unit, and makes the block as soon as it is full.
    #[inline]
    pub(super) fn plan_unit(&mut self, at: At, short: bool, [preformed, neoformed]: [u32; 2]) -> Result<(), Full> {
        let unit_nodes = preformed + neoformed;
        let mut first = 1;
        while first <= unit_nodes {
            let most = self.laws.node.block;
            let before = self.words.plan.nodes;
            let more = (most - before).min(unit_nodes + 1 - first);
            self.shoot(before + more);
            let Words { plan, zones, .. } = &mut *self.words;
            let drawn = plan.zones.len() as u32;
            if !zones.is_empty() {
                plan.zones.extend_from_slice(zones);
            }
            let (nodes, zones) = ((before, before + more), (drawn, plan.zones.len() as u32));
            plan.pieces.push(Piece { at, unit_nodes, first, nodes, preformed, short, zones });
            plan.nodes = before + more;
            first += more;
            if before + more == most {
                self.make_planned()?;
            }
        }
        Ok(())
    }

    /// Lets the planned nodes of the axis reach up to the place `end`.
    #[inline]
    pub(super) fn shoot(&mut self, end: u32) {
        let Words { plan, trends, .. } = &mut *self.words;
        if let Some(shoot) = plan.shoots.last_mut().filter(|shoot| shoot.bud.axis == self.bud.axis) {
            shoot.nodes.1 = end;
            return;
        }
        let key = self.plant.axes.key[self.bud.axis.index()];
        let before = plan.trends.len() as u32;
        plan.trends.extend_from_slice(trends);
        let trends = (before, plan.trends.len() as u32);
        plan.shoots.push(Shoot { bud: self.bud, key, nodes: (plan.nodes, end), trends, living: None });
    }

    /// Whether its nodes can be planned beside those that other axes have planned: laws of one order, and of buds in
    /// full light or of buds in shade, are looked up together.
    pub(super) fn joins_plan(&self) -> bool {
        let plan = &self.words.plan;
        let (Some(shoot), Some(piece)) = (plan.shoots.last(), plan.pieces.last()) else { return true };
        let order = self.plant.axes.order[shoot.bud.axis.index()];
        order == self.laws.number && (piece.at.shade > 0) == self.words.shaded
    }

    /// Makes the nodes that are planned, those of other axes too; at once where they are not few. The plant has no room
    /// for them where it would be overgrown with them.
    #[inline]
    pub(super) fn make_planned(&mut self) -> Result<(), Full> {
        match self.words.plan.shoots.as_slice() {
            [] => Ok(()),
            [shoot] if shoot.nodes.1 < FEWEST && shoot.bud.axis == self.bud.axis => self.make_one_by_one(),
            _ => self.make_at_once(),
        }
    }

    /// Makes the nodes that are planned, all of this axis, one by one.
    fn make_one_by_one(&mut self) -> Result<(), Full> {
        let mut plan = std::mem::take(&mut self.words.plan);
        let (tick, bud) = (self.tick, self.bud);
        let mut events = plan.events.iter().peekable();
        for piece in &plan.pieces {
            self.decide_again(piece.at);
            self.words.zones.clear();
            self.words.zones.extend_from_slice(&plan.zones[piece.zones.0 as usize..piece.zones.1 as usize]);
            for node in piece.places() {
                while let Some((_, event)) = events.next_if(|(nodes, _)| *nodes as usize <= node) {
                    self.plant.events.as_mut().into_iter().for_each(|events| events.push(*event));
                }
                let rank = piece.rank(node);
                self.read_node();
                let drawn = self.draw_internode(rank, [piece.short, rank > piece.preformed]);
                self.node(drawn, piece.unit_nodes, Lie::Free)?;
            }
        }
        self.plant.events.as_mut().into_iter().for_each(|all| all.extend(events.by_ref().map(|(_, event)| *event)));
        let ApicalBud { cycle, units, birth, state, .. } = bud;
        self.bud = ApicalBud { cycle, units, birth, state, ..self.bud };
        self.set_tick(tick);
        plan.clear();
        self.words.plan = plan;
        Ok(())
    }

    /// Makes the nodes that are planned of this axis and of others of its order behind it, one by one, with the records
    /// that have been read for all of them.
    fn make_in_turn(&mut self, plan: &Plan) -> Result<(), Full> {
        let mut events = plan.events.iter().peekable();
        let mut pieces = plan.pieces.iter().peekable();
        for (nth, shoot) in plan.shoots.iter().enumerate() {
            if nth > 0 {
                self.stand_on(shoot.bud);
            }
            while let Some(piece) = pieces.next_if(|piece| piece.nodes.0 < shoot.nodes.1) {
                self.decide_again(piece.at);
                let zones = piece.zones.0 as usize..piece.zones.1 as usize;
                self.words.zones.clear();
                self.words.zones.extend_from_slice(&plan.zones[zones]);
                for node in piece.places() {
                    while let Some((_, event)) = events.next_if(|(nodes, _)| *nodes as usize <= node) {
                        self.plant.events.as_mut().into_iter().for_each(|events| events.push(*event));
                    }
                    self.words.take_planned(node, self.laws.node.width);
                    let rank = piece.rank(node);
                    let drawn = self.draw_internode(rank, [piece.short, rank > piece.preformed]);
                    self.node(drawn, piece.unit_nodes, Lie::Free)?;
                }
            }
            let made = self.bud;
            if let Some(bud) = shoot.living.and_then(|place| self.words.living.get_mut(place)) {
                *bud = bud.behind(&made);
            }
        }
        self.plant.events.as_mut().into_iter().for_each(|all| all.extend(events.by_ref().map(|(_, event)| *event)));
        Ok(())
    }

    /// Takes the bud back to the step at which it decided on a growth unit, as far as its nodes ask.
    pub(super) fn decide_again(&mut self, at: At) {
        let (cycle, units, birth, state) = (at.cycle, at.unit, at.bud_birth, at.state);
        self.bud = ApicalBud { cycle, units, birth, state, ..self.bud };
        self.set_tick(at.age);
    }

    /// Makes the nodes that are planned, all at once.
    fn make_at_once(&mut self) -> Result<(), Full> {
        make_at_once(self.model, self.plant, self.words)?;
        let Words { plan, columns, .. } = &mut *self.words;
        if let (Some(shoot), Some(made)) = (plan.shoots.last(), columns.buds.last())
            && shoot.bud.axis == self.bud.axis
        {
            self.bud = self.bud.behind(made);
        }
        plan.clear();
        Ok(())
    }
}

/// Makes the nodes that axes which have grown to their age have planned, if any: at once, or one by one where they are
/// few of buds that grow by the clock.
pub(super) fn make_last(model: &BudModel, plant: &mut Plant, words: &mut Words) -> Result<(), Full> {
    let Some(shoot) = words.plan.shoots.first() else { return Ok(()) };
    let bud = shoot.bud;
    let laws = model.laws(plant.axes.order[bud.axis.index()]);
    if words.many_begin || words.plan.nodes >= MANY_BY_THE_CLOCK[usize::from(!laws.node.is_bare)] {
        make_at_once(model, plant, words)?;
        words.plan.clear();
        return Ok(());
    }
    words.read_nodes(laws, &plant.random);
    let mut plan = std::mem::take(&mut words.plan);
    Axis::of(model, plant, words, bud).make_in_turn(&plan)?;
    plan.clear();
    words.plan = plan;
    Ok(())
}

/// Makes the nodes that are planned, all at once, and tells the living buds among them what they bear.
fn make_at_once(model: &BudModel, plant: &mut Plant, words: &mut Words) -> Result<(), Full> {
    let Some(shoot) = words.plan.shoots.first() else { return Ok(()) };
    let laws = model.laws(plant.axes.order[shoot.bud.axis.index()]);
    let random = plant.random.clone();
    words.read_nodes(laws, &random);
    let Words { plan, columns, nodes, living, .. } = words;
    let block = Block {
        model,
        laws,
        random: &random,
        pieces: &plan.pieces,
        shoots: &plan.shoots,
        zones: &plan.zones,
        trends: &plan.trends,
        words: nodes.words(),
        records: &nodes.records,
        first: NodeId(plant.nodes.len() as u32),
    };
    if !columns.make(&block, plant, &plan.events) {
        return Err(Full);
    }
    for (shoot, made) in plan.shoots.iter().zip(&columns.buds) {
        if let Some(bud) = shoot.living.and_then(|place| living.get_mut(place)) {
            *bud = bud.behind(made);
        }
    }
    Ok(())
}
