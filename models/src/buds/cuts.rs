//! What a plant makes of a cut: traumatic reiteration (de Reffye 1988 §2) from the node below it.
//!
//! The dormant axillary buds of the last node that a cut has left are released as they are by the death of an apex: by
//! the law of traumatic reiteration of the order of the stump, and as axes of that order, i and not i + 1. Of a branch
//! that was taken off as a whole the bearing node answers, where it is the end of its own axis. A bud that stays
//! dormant may be released by a later cut, so each cut draws anew: in a stream of the node, a record for each age of
//! the plant. Absent: the cuts, and the memory of dormant buds (`sim::plant`).

use super::birth::first_bud;
use super::bud::ApicalBud;
use super::compile::BudModel;
use super::grow::Axis;
use super::record::{Words, read};
use phytomer_sim::Tick;
use phytomer_sim::model::Overgrown;
use phytomer_sim::plant::key::Place;
use phytomer_sim::plant::{ApexFate, AxisId, NodeId, Plant};
use phytomer_sim::random::Purpose;

impl BudModel {
    /// Releases the dormant buds below each cut of the age `age`; they are living buds from that age on.
    pub(super) fn release_below_cuts(
        &self,
        age: Tick,
        plant: &mut Plant,
        living: &mut Vec<ApicalBud>,
    ) -> Result<(), Overgrown> {
        living.retain(|bud| plant.axes.apex_fate[bud.axis.index()] == ApexFate::Alive);
        let limit = Overgrown::of(plant);
        let mut words = Words::default();
        let first_new = plant.axes.len();
        for node in plant.stumps(age) {
            let bud = self.bud_at(plant, node);
            Axis::new(self, plant, &mut words, bud).wake(node, age);
            if plant.is_overgrown() {
                return Err(limit);
            }
        }
        living.extend((first_new..plant.axes.len()).map(|axis| first_bud(self, plant, AxisId(axis as u32))));
        Ok(())
    }

    /// The apical bud of an axis as it was when it had made `node`, as far as laws of its end ask.
    fn bud_at(&self, plant: &Plant, node: NodeId) -> ApicalBud {
        let nodes = &plant.nodes;
        let (axis, dormant) = (nodes.axis[node.index()], plant.dormant.of(node));
        ApicalBud {
            birth: nodes.birth[node.index()],
            units: units_by(plant, node),
            rank: nodes.rank[node.index()],
            last_node: node,
            state: dormant.state,
            dormant: dormant.buds,
            bud_spacing: dormant.spacing,
            ..first_bud(self, plant, axis)
        }
    }
}

/// The growth units that an axis had begun when it had made `node`.
fn units_by(plant: &Plant, node: NodeId) -> u32 {
    let axis = plant.nodes.axis[node.index()];
    let mut units = 0;
    let mut below = Some(node);
    while let Some(node) = below.filter(|node| plant.nodes.axis[node.index()] == axis) {
        units += u32::from(plant.nodes.unit_rank[node.index()] == 1);
        below = plant.nodes.parent[node.index()].some();
    }
    units
}

impl Axis<'_> {
    /// Releases the dormant buds of `node`, the end of this axis since a cut at `tick`.
    fn wake(mut self, node: NodeId, tick: Tick) {
        if self.bud.dormant == 0 || self.laws.end.traumatic.chance.is_never() {
            return;
        }
        self.begin_at(tick);
        let width = self.laws.end.width;
        if width > 0 {
            let key = self.plant.axes.key[self.bud.axis.index()].child(Place::Node.on(self.bud.rank));
            let mut stream = self.plant.random.stream(key, Purpose::Cut);
            read(&mut stream, 0, tick, width, &mut self.words.end);
        }
        self.release(node);
    }
}
