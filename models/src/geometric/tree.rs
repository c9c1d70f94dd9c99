//! One drawn tree: its branches, each from its mother's vector and diameter (Aono & Kunii 1984, rules of GMT1 to GMT4).
//!
//! The paper has no axes and no orders. Here the centre child of three continues its mother's axis, of two children
//! that with the smaller |h|, the left child where both are equal; the other children begin axes of the next order.
//! That is the paper's own reading of a monopodial tree (h1 ≈ 0), extended to all other trees; in a pure dichotomy it
//! is a convention that cannot be seen. A child that deviators move to nothing is a bud that dies as it appears. Absent
//! on purpose: levels and ages (`model`), and the draws of the numbers of a tree (`plan`).

use super::branching::{Spread, length};
use super::level::{Level, Way, around, radians, turn_deg};
use super::plan::{DrawnNumbers, Leaves, Plan, SMALLEST_M};
use crate::law::At;
use phytomer_sim::clock::{NEVER, Tick};
use phytomer_sim::math;
use phytomer_sim::model::Overgrown;
use phytomer_sim::plant::key::Place;
use phytomer_sim::plant::{
    ApexFate, AxisId, Cause, EventKind, Kind, NewAxis, NewNode, NewOrgan, NodeId, Origin, Plant, Rest,
};
use phytomer_sim::random::Purpose;
use std::f64::consts::PI;

/// The tree of one plant.
pub(super) struct Tree<'a> {
    plan: &'a Plan,
    numbers: DrawnNumbers,
    /// From level 1.
    levels: Vec<Level<'a>>,
    /// The azimuths of nodes, radians, by growth level and rank from 1.
    azimuths: Vec<Vec<f32>>,
}

/// A growth level on its way.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moment {
    pub level: u32,
    /// How much of it has grown, in (0, 1].
    pub share: f64,
    /// The tick of its birth.
    pub birth: Tick,
}

/// A branch of the last level, on which the next one stands.
#[derive(Debug, Clone, Copy)]
pub(super) struct Branch {
    node: NodeId,
    axis: AxisId,
    /// Its rank along the axis, from 1.
    rank: u32,
    /// From root to tip, metres: (u, v, w).
    vector: [f64; 3],
    /// Its tip, metres from the root of the tree.
    tip: [f64; 3],
    diameter: f64,
    /// The last growth level that grows on it.
    reach: u32,
    /// Whether it is of the main axis.
    is_main: bool,
}

/// A child before it has a place in the plant.
struct Child<'a> {
    way: &'a Way,
    vector: [f64; 3],
    /// Whether its tip was moved.
    is_moved: bool,
    turn_deg: f64,
    reach: u32,
}

impl<'a> Tree<'a> {
    /// The tree of a plant with these numbers.
    pub fn new(plan: &'a Plan, numbers: DrawnNumbers) -> Self {
        let levels = (1..=plan.last()).map(|number| Level::of(plan, number, &numbers.rules, 1.0)).collect();
        // That of a node is the turn of the branching above it; above the last level, that of its own rule.
        let azimuths = (0..=plan.last()).map(|level| {
            let above = plan.levels.get(level as usize).or(plan.levels.last()).map_or(0, |planned| planned.rule);
            let azimuth = |rank| radians(around(turn_deg(rank, &numbers.rules[above]))) as f32;
            (1..=level + 1).map(azimuth).collect()
        });
        Self { plan, azimuths: azimuths.collect(), numbers, levels }
    }

    /// The base section: "the first two child branches lie on the plane parallel to the direction of gravity", so it
    /// stands upright where no direction is stated. A tree that is glued to another begins a fork of the trunk at the
    /// root.
    pub fn first_branch(&self, now: &Moment, plant: &mut Plant) -> Branch {
        let [long, diameter] = self.numbers.first_m.map(|metres| metres * now.share);
        let vector = self.plan.direction.map(|x| x * long);
        let seed = Branch {
            node: NodeId::NONE,
            axis: AxisId::TRUNK,
            rank: 0,
            vector,
            tip: [0.0; 3],
            diameter,
            reach: self.plan.main_until,
            is_main: true,
        };
        if self.plan.place == 0 {
            return self.add(&seed, AxisId::TRUNK, vector, diameter, now, plant);
        }
        let root = NodeId(0);
        let position = self.plan.place as u16 - 1;
        let axis = plant.add_axis(NewAxis {
            bearer: Some(root),
            key: plant.axes.key[0].child(Place::Fork(position).on(1)),
            origin: Origin::Fork,
            position,
            follows: true,
            appearance: now.birth,
            birth: now.birth,
            ..NewAxis::OF_THE_SEED
        });
        plant.note(now.birth, axis, EventKind::Forked, 1);
        let branch = self.add(&Branch { node: root, ..seed }, axis, vector, diameter, now, plant);
        plant.state_start(branch.node, [-plant.nodes.length[0], 0.0, 0.0]);
        branch
    }

    /// Adds the children of all mothers, one after the other, left to right. The children are told where the next level
    /// stands on them.
    ///
    /// # Errors
    /// Where the plant has outgrown its limit; it then holds part of the level.
    pub fn branch(
        &self,
        mothers: &[Branch],
        now: &Moment,
        told: bool,
        plant: &mut Plant,
    ) -> Result<Vec<Branch>, Overgrown> {
        let partly = (now.share < 1.0).then(|| Level::of(self.plan, now.level, &self.numbers.rules, now.share));
        let level = partly.as_ref().unwrap_or(&self.levels[now.level as usize - 1]);
        let mut children = Vec::with_capacity(if told { mothers.len() * level.ways.len() } else { 0 });
        for mother in mothers.iter().filter(|mother| mother.is_main || now.level <= mother.reach) {
            let drawn = scattered(mother, level, plant);
            let fork = Spread::of(mother.vector, level.turn(mother.rank).sincos);
            for (place, way) in level.ways.iter().enumerate() {
                let is_main = mother.is_main && way.continues;
                let reach = if mother.is_main && !is_main { level.planned.reach } else { mother.reach };
                if now.level > reach {
                    continue;
                }
                let way = &spread(way, &drawn, level.share);
                let vector = self.moved(mother, fork.child(way.ratio, way.sincos), level);
                let is_moved = !level.planned.deviators.is_none();
                let child = Child { way, vector, is_moved, turn_deg: level.turn(mother.rank).deg, reach };
                if is_moved && self.is_lost(mother, level, place, &drawn, vector) {
                    end(mother, &child, now, plant);
                    continue;
                }
                let axis = if way.continues { mother.axis } else { new_axis(mother, &child, now, plant) };
                let diameter = mother.diameter * level.diameter_ratio;
                let bearer = Branch { reach: child.reach, is_main, ..*mother };
                let branch = self.add(&bearer, axis, child.vector, diameter, now, plant);
                if told {
                    children.push(branch);
                }
            }
            if plant.is_overgrown() {
                return Err(Overgrown::of(plant));
            }
        }
        Ok(children)
    }

    /// The vector of a child whose tip is moved by what the deviators of a level do, as far as the level has grown.
    #[inline]
    fn moved(&self, mother: &Branch, vector: [f64; 3], level: &Level<'_>) -> [f64; 3] {
        if level.planned.deviators.is_none() {
            return vector;
        }
        let by = level.planned.deviators.of([0, 1, 2].map(|i| mother.tip[i] + vector[i]));
        [0, 1, 2].map(|i| vector[i] + by[i] * level.share)
    }

    /// Whether a child is moved to nothing when its level has grown; `vector` is the child's as it is now.
    fn is_lost(&self, mother: &Branch, now: &Level<'_>, place: usize, drawn: &[f64; 2], vector: [f64; 3]) -> bool {
        if now.share == 1.0 {
            return length(vector) < SMALLEST_M;
        }
        let whole = &self.levels[now.number as usize - 1];
        let way = spread(&whole.ways[place], drawn, 1.0);
        let fork = Spread::of(mother.vector, whole.turn(mother.rank).sincos);
        length(self.moved(mother, fork.child(way.ratio, way.sincos), whole)) < SMALLEST_M
    }

    /// Adds a branch on `mother`, whose last growth level and whose place on the main axis it has.
    fn add(
        &self,
        mother: &Branch,
        axis: AxisId,
        vector: [f64; 3],
        diameter: f64,
        now: &Moment,
        plant: &mut Plant,
    ) -> Branch {
        let rank = if axis == mother.axis { mother.rank + 1 } else { 1 };
        let long = length(vector);
        // A branch that has no direction yet has that of its mother.
        let (vector, long) = if long < SMALLEST_M { (mother.vector, 0.0) } else { (vector, long) };
        let scale = length(vector);
        let node = plant.add_node(NewNode {
            parent: mother.node,
            axis,
            birth: now.birth,
            rank,
            unit_rank: 1,
            short: false,
            neoformed: false,
            trend: 0,
            length: long as f32,
            diameter: diameter as f32,
            azimuth: self.azimuths[now.level as usize][rank as usize - 1],
        });
        plant.state_rest(node, Rest::Heading(vector.map(|x| (x / scale) as f32)));
        plant.note(now.birth, axis, EventKind::Grew, 1);
        if let Some(leaves) = self.plan.leaves.as_ref().filter(|leaves| leaves.levels.contains(&now.level)) {
            add_leaves(leaves, node, now, plant);
        }
        let tip = [0, 1, 2].map(|i| mother.tip[i] + vector[i]);
        Branch { node, axis, rank, vector, tip, diameter, ..*mother }
    }
}

impl Child<'_> {
    /// The angle between the child and its mother, and its azimuth about her, radians.
    fn angles(&self, mother: &Branch) -> (f64, f64) {
        if self.is_moved {
            return Spread::of(mother.vector, (0.0, 1.0)).angles(self.vector);
        }
        let opposite = if self.way.angle_deg < 0.0 { 0.0 } else { 180.0 };
        (radians(self.way.angle_deg).abs(), radians(around(self.turn_deg + opposite)))
    }
}

/// The angles that a branching draws, left and right, degrees: words of the mother's axis, two a branch.
#[inline]
fn scattered(mother: &Branch, level: &Level<'_>, plant: &Plant) -> [f64; 2] {
    if level.scatter == [None, None] {
        return [0.0; 2];
    }
    let mut stream = plant.random.stream(plant.axes.key[mother.axis.index()], Purpose::Node);
    stream.seek(2 * u64::from(mother.rank - 1));
    let mut words = [0; 2];
    stream.read(&mut words);
    [0, 1].map(|side| level.scatter[side].map_or(0.0, |law| law.draw_f64(words[side], At::default())))
}

/// A way with what its branching has drawn.
#[inline]
fn spread(way: &Way, drawn: &[f64; 2], share: f64) -> Way {
    let by = way.side.map_or(0.0, |side| drawn[side]) * share;
    if by == 0.0 {
        return *way;
    }
    let angle_deg = way.angle_deg + by;
    Way { angle_deg, sincos: math::sincos(radians(angle_deg)), ..*way }
}

/// A child that is moved to nothing: its bud dies as it appears.
fn end(mother: &Branch, child: &Child<'_>, now: &Moment, plant: &mut Plant) {
    let axis = if child.way.continues { mother.axis } else { new_axis(mother, child, now, plant) };
    plant.axes.end_apex(axis, now.birth, ApexFate::Died);
    plant.note(now.birth, axis, EventKind::Died, 1);
}

/// The axis that a child begins. Its azimuth counts from the horizontal on the right of its mother, counter-clockwise
/// seen from her tip backwards: on an upright trunk from +x, where the pose's azimuths begin too.
fn new_axis(mother: &Branch, child: &Child<'_>, now: &Moment, plant: &mut Plant) -> AxisId {
    let bearing = mother.axis.index();
    // Of the two lateral children beside a centre child the right one has the second place.
    let position = u16::from(child.way.side == Some(1) && child.way.beside_centre);
    let (angle, azimuth) = child.angles(mother);
    let axis = plant.add_axis(NewAxis {
        bearer: Some(mother.node),
        key: plant.axes.key[bearing].child(Place::Axillary(position).on(mother.rank)),
        order: plant.axes.order[bearing] + 1,
        origin: Origin::Axillary,
        position,
        follows: false,
        state: 0,
        appearance: now.birth,
        birth: now.birth,
        azimuth: azimuth as f32,
        insertion: angle as f32,
        shed_after: NEVER,
    });
    plant.note(now.birth, axis, EventKind::Branched, 1);
    axis
}

/// The leaves of a branch, evenly around its tip.
fn add_leaves(leaves: &Leaves, node: NodeId, now: &Moment, plant: &mut Plant) {
    let [long, wide] = leaves.size_m.map(|metres| metres * now.share);
    for position in 0..leaves.number {
        let organ = plant.add_organ(NewOrgan {
            node,
            kind: Kind::Leaf,
            position: position as u16,
            birth: now.birth,
            death: leaves.life.map_or(NEVER, |life| now.birth.saturating_add(life)),
            cause: if leaves.life.is_some() { Cause::LifeLength } else { Cause::None },
            form: leaves.form,
            length: long as f32,
            width: wide as f32,
            area: (leaves.area_m2 * now.share * now.share) as f32,
            azimuth: (2.0 * PI * f64::from(position) / f64::from(leaves.number)) as f32,
            insertion: leaves.insertion as f32,
        });
        if let Some(look) = leaves.look {
            plant.give_organ_look(organ, look);
        }
    }
}
