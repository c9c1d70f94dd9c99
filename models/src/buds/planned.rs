//! An axis plans the nodes of its growth units, and makes them in blocks.
//!
//! Absent: how a block is made (`columns`), and which axes plan (`grow`).

use super::around::Lie;
use super::bud::ApicalBud;
use super::columns::Block;
use super::compile::Piece;
use super::grow::{Axis, Full};
use super::record::Words;
use crate::law::At;
use phytomer_sim::plant::NodeId;

/// The fewest nodes that are made at once: fewer are made faster one by one, as measured.
const FEWEST: u32 = 4;

impl Axis<'_> {
    /// Plans the nodes of a growth unit, and makes the block as soon as it is full.
    pub(super) fn plan_unit(&mut self, at: At, short: bool, [preformed, neoformed]: [u32; 2]) -> Result<(), Full> {
        let unit_nodes = preformed + neoformed;
        let mut first = 1;
        while first <= unit_nodes {
            let words = &mut *self.words;
            let (plan, most) = (&mut words.plan, self.laws.node.block);
            let before = plan.nodes();
            let more = (most - before).min(unit_nodes + 1 - first);
            let zones = plan.zones.len() as u32;
            plan.zones.extend_from_slice(&words.zones);
            let (nodes, zones) = ((before, before + more), (zones, plan.zones.len() as u32));
            plan.pieces.push(Piece { at, unit_nodes, first, nodes, preformed, short, zones });
            first += more;
            if before + more == most {
                self.make_planned()?;
            }
        }
        Ok(())
    }

    /// Makes the nodes that are planned, at once where they are not few. The plant has no room for them where it would
    /// be overgrown with them.
    #[inline]
    pub(super) fn make_planned(&mut self) -> Result<(), Full> {
        match self.words.plan.nodes() {
            0 => Ok(()),
            1..FEWEST => self.make_one_by_one(),
            _ => self.make_at_once(),
        }
    }

    /// Makes the nodes that are planned, one by one.
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
                self.node(rank, piece.unit_nodes, (piece.short, rank > piece.preformed), Lie::Free)?;
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

    /// Takes the bud back to the step at which it decided on a growth unit, as far as its nodes ask.
    fn decide_again(&mut self, at: At) {
        let (cycle, units, birth, state) = (at.cycle, at.unit, at.bud_birth, at.state);
        self.bud = ApicalBud { cycle, units, birth, state, ..self.bud };
        self.set_tick(at.age);
    }

    /// Makes the nodes that are planned, all at once.
    fn make_at_once(&mut self) -> Result<(), Full> {
        let Self { model, laws, plant, words, bud, .. } = self;
        let key = plant.axes.key[bud.axis.index()];
        let random = plant.random.clone();
        words.read_nodes(laws, &random, key, bud.rank);
        let Words { plan, columns, trends, nodes, .. } = &mut **words;
        let block = Block {
            model,
            laws,
            random: &random,
            pieces: &plan.pieces,
            zones: &plan.zones,
            trends,
            words: nodes,
            key,
            bud: *bud,
            first: NodeId(plant.nodes.len() as u32),
        };
        *bud = columns.make(&block, plant, plan).ok_or(Full)?;
        plan.clear();
        Ok(())
    }
}
