//! A parametric tree as a growth model: written anew at each age, whole from age 1 on.
//!
//! A segment of a stem is an internode that states how it is turned in the frame of the one before; a branch states how
//! far behind the tip of its bearing internode it begins. Clones of the trunk are forks of its order, borne by the tip
//! of its first segment. Absent: the equations (`equations`) and the draws of a plant (`stems`).

use super::equations::tapered;
use super::stems::{Drawn, Stem, clones, counts};
use super::sway::{self, Rate};
use super::tree::Tree;
use phytomer_sim::clock::Tick;
use phytomer_sim::expectation::{Certainty, Expectation, OrderExpectation};
use phytomer_sim::gusts::{Gusts, Swing};
use phytomer_sim::model::{Grow, Growth, Overgrown};
use phytomer_sim::plant::{
    AxisId, EventKind, Habit, Looks, NewAxis, NewNode, NodeId, Origin, Plant, Rest, Shape, Trend,
};
use phytomer_sim::site::View;
use std::sync::Arc;

/// A parametric tree with its parameters checked.
#[derive(Debug, Clone)]
pub struct TreeModel {
    tree: Tree,
    habit: Arc<Habit>,
}

/// The tick at which the whole tree appears.
pub(super) const BIRTH: Tick = 1;

impl TreeModel {
    pub(super) fn new(tree: &Tree) -> Self {
        let looks = Looks::of_shape(Shape::Cone);
        let habit = Habit { trends: vec![Trend::STRAIGHT], looks, ..Habit::default() };
        Self { tree: tree.clone(), habit: Arc::new(habit) }
    }

    fn write(&self, plant: &mut Plant) -> Result<(), Overgrown> {
        let random = plant.random.clone();
        let drawn = Drawn::new(&self.tree, &random);
        let trunks = drawn.trunks();
        let mut first: Vec<NodeId> = Vec::with_capacity(trunks.len());
        for trunk in &trunks {
            first.push(add(trunk, first.first().copied(), plant)?);
        }
        for (trunk, &first) in trunks.iter().zip(&first) {
            for branch in drawn.branches(trunk) {
                add(&branch, Some(first), plant)?;
            }
        }
        Ok(())
    }

    /// nTaper of the stems of an order.
    fn taper(&self, order: u8) -> f64 {
        let Tree { trunk, branches, .. } = &self.tree;
        let level = usize::from(order).checked_sub(2).and_then(|level| branches.get(level));
        level.map_or(&trunk.taper, |level| &level.taper).value()
    }

    /// nCurveRes of the stems of an order.
    fn segments(&self, order: u8) -> u32 {
        let Tree { trunk, branches, .. } = &self.tree;
        let level = usize::from(order).checked_sub(2).and_then(|level| branches.get(level));
        level.map_or(&trunk.curve_res, |level| &level.curve_res).value()
    }
}

/// Adds a stem to the plant; `parent` is the first internode of the stem that bears it. Returns the first internode of
/// the stem.
fn add(stem: &Stem, parent: Option<NodeId>, plant: &mut Plant) -> Result<NodeId, Overgrown> {
    let (limit, new) = (plant.component_limit(), stem.turns.len() as u64 + u64::from(parent.is_some()));
    if u64::from(plant.components()) + new > u64::from(limit) {
        return Err(Overgrown::of(plant));
    }
    let bearer = parent.map(|first| NodeId(first.0 + stem.rank - 1));
    let axis = bearer.map_or(AxisId::TRUNK, |bearer| add_axis(stem, bearer, plant));
    let first = NodeId(plant.nodes.len() as u32);
    let mut below = bearer.unwrap_or(NodeId::NONE);
    for (rank, (turn, radius)) in (1..).zip(stem.turns.iter().zip(&stem.radii)) {
        let node = plant.add_node(NewNode {
            parent: below,
            axis,
            birth: BIRTH,
            rank,
            unit_rank: 1,
            short: false,
            neoformed: false,
            trend: 0,
            length: stem.segment as f32,
            diameter: (2.0 * radius) as f32,
            azimuth: 0.0,
        });
        plant.state_rest(node, Rest::Turned(*turn));
        below = node;
    }
    if stem.behind > 0.0 {
        plant.state_start(first, [-stem.behind as f32, 0.0, 0.0]);
    }
    plant.note(BIRTH, axis, EventKind::Grew, stem.turns.len() as u32);
    Ok(first)
}

fn add_axis(stem: &Stem, bearer: NodeId, plant: &mut Plant) -> AxisId {
    let clone = stem.level == 0;
    let axis = plant.add_axis(NewAxis {
        bearer: Some(bearer),
        key: stem.key,
        order: stem.level + 1,
        origin: if clone { Origin::Fork } else { Origin::Axillary },
        position: stem.position,
        follows: clone && stem.position > 0,
        appearance: BIRTH,
        birth: BIRTH,
        azimuth: stem.azimuth as f32,
        insertion: stem.insertion as f32,
        ..NewAxis::OF_THE_SEED
    });
    plant.note(BIRTH, axis, if clone { EventKind::Forked } else { EventKind::Branched }, 1);
    axis
}

impl Grow for TreeModel {
    type Life = ();

    fn growth(&self) -> Growth {
        Growth::Rebuilds
    }

    fn habit(&self) -> Arc<Habit> {
        Arc::clone(&self.habit)
    }

    fn sow(&self, plant: &mut Plant) {
        plant.add_axis(NewAxis::OF_THE_SEED);
    }

    fn grow_to(&self, age: Tick, plant: &mut Plant, (): &mut (), _view: &View<'_>) -> Result<(), Overgrown> {
        plant.clear();
        self.sow(plant);
        if age >= BIRTH {
            self.write(plant)?;
        }
        plant.age = age;
        Ok(())
    }

    /// A segment is as thick at its tip as the next segment at its base. The tip of the last of n segments, whose base
    /// is at the share (n − 1)/n of the stem, follows the stem's taper (§4.4).
    fn thicken(&self, _age: Tick, plant: &mut Plant) {
        let Plant { axes, nodes, .. } = plant;
        nodes.diameter.copy_from_slice(&nodes.primary_diameter);
        for node in 0..nodes.len() {
            let axis = nodes.axis[node].index();
            nodes.diameter_tip[node] = if axes.last_node[axis].index() == node {
                let (taper, segments) = (self.taper(axes.order[axis]), self.segments(axes.order[axis]));
                let at_base = tapered(1.0, taper, 1.0 - 1.0 / f64::from(segments));
                (f64::from(nodes.diameter[node]) / at_base * tapered(1.0, taper, 1.0)) as f32
            } else {
                nodes.diameter[node + 1]
            };
        }
    }

    fn sways(&self) -> bool {
        true
    }

    fn swings(&self, plant: &Plant) -> Vec<Swing> {
        sway::swings(plant, Rate::default())
    }

    fn sway(&self, plant: &mut Plant, gusts: &Gusts) {
        sway::sway(plant, Rate::default(), gusts);
    }

    /// The numbers themselves, where the length of the trunk is not drawn. Where it is drawn, so is the number of
    /// branches below the split, of which clones have no copy; it is smallest on the shortest trunk, whose bare part is
    /// its greatest share.
    fn expectation(&self, until: Tick) -> Option<Expectation> {
        let Tree { trunk, base_size, .. } = &self.tree;
        let shortest = trunk.length.value() - trunk.length_v.value();
        let level = |(level, [axes, nodes]): (usize, [u64; 2])| {
            let mut order = OrderExpectation::zero(until);
            let seed = if level == 0 { 1.0 } else { 0.0 };
            order.axes[0] = seed;
            if until >= BIRTH {
                order.axes[BIRTH as usize] = axes as f64 - seed;
                order.nodes[BIRTH as usize] = nodes as f64;
                order.units[BIRTH as usize] = nodes as f64;
            }
            order.accumulate();
            order
        };
        let orders = counts(&self.tree, base_size.value() / shortest).into_iter().enumerate().map(level).collect();
        let axes = if trunk.length_v.value() > 0.0 && clones(trunk) > 0 { Certainty::AtMost } else { Certainty::Exact };
        Some(Expectation { orders, axes, organs: Certainty::Exact })
    }
}
