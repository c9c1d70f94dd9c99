//! Training: wood is bent to a direction, and a support holds it there: spreaders and ties, stakes, wires.
//!
//! Orchard practice (Forshey, Elfving & Stebbins 1992, *Training and Pruning Apple and Pear Trees*): a spreader or a
//! tie brings a limb to a stated angle from the vertical; a stake keeps the trunk straight and upright; the arms of a
//! palmette or of an espalier are tied along horizontal wires. Decided here: a limb turns at its crotch and keeps its
//! form, and its angle is that of the straight line from its base to its tip; what is tied to a stake or a wire is
//! straight from tie to tie. Lengths stay. What trained wood bears goes along with it, and keeps its form too. The rest
//! frames change from the tick on ([`Plant::change_rests`]): what grows later leaves the tip and follows its trend.
//! Wood that bends is held as long as the support stays; a stake and a wire, which stand on the ground, also bear its
//! weight. Absent: the stress of the bending, so that wood which is let go sags and does not spring back; and breakage.

use crate::clock::Tick;
use crate::math::{acos, atan2, sincos};
use crate::plant::{AxisId, Frame, Hold, NodeId, Origin, Part, Plant, Rest};
use crate::rotation::Rotation;
use crate::vector::Vector;
use std::f64::consts::FRAC_1_SQRT_2;

/// The share of its length by which an internode that is led to its wire leaves the direction of the wire: it runs at
/// 45 degrees to it.
const LED: f64 = FRAC_1_SQRT_2;

/// A tip that lies at a height but for rounding lies within it.
const WITHIN: f64 = 1.0 + 1e-6;

/// What trained wood is held by.
#[derive(Debug, Clone, PartialEq)]
pub enum Support {
    /// A spreader, a tie or a weight: the branch stands at an angle to the upward vertical, or in a direction from
    /// north to east, radians. Where one of them is not stated, it stays as it was.
    Spreader {
        /// The angle to the upward vertical.
        inclination: Option<f64>,
        /// The direction from north to east.
        azimuth: Option<f64>,
    },
    /// A stake beside the trunk, of a height in metres: the trunk is straight and upright up to it.
    Stake(f64),
    /// Horizontal wires above one another, which pass over the seed: each branch is led to the wire nearest in height
    /// to its base, and lies along it on the side to which it points.
    Wires {
        /// The heights, metres.
        heights: Vec<f64>,
        /// The direction of the wires from north to east, radians.
        azimuth: f64,
    },
}

/// How wood is trained.
#[derive(Debug, Clone, PartialEq)]
pub struct Training {
    /// What it is held by.
    pub support: Support,
    /// The ticks for which the support stays; [`crate::NEVER`] where it is not taken away.
    pub stays: Tick,
}

impl Training {
    /// Trains the axes `chosen` of a plant, or its trunk, from its age `tick` on, as it stood at the end of the tick
    /// before. One forward scan of what stands.
    pub fn apply(&self, plant: &mut Plant, chosen: &[AxisId], tick: Tick) {
        let mut scan = Scan::new(self, plant, chosen, tick);
        plant.each_standing(tick, |stretch| stretch.nodes().for_each(|node| scan.pass(node)));
        let Scan { moves, .. } = scan;
        if moves.is_empty() {
            return;
        }
        let bends = plant.habit.wood.as_ref().is_some_and(|wood| wood.bends);
        let bears = !matches!(self.support, Support::Spreader { .. });
        let hold = Hold { until: tick.saturating_add(self.stays), bears };
        for Moved { node, frame, held, straight, .. } in &moves {
            (plant.frames.base[*node], plant.frames.heading[*node], plant.frames.up[*node]) =
                (frame.base, frame.heading, frame.up);
            if bends && *straight {
                plant.strain.straighten(*node);
            }
            if bends && *held {
                plant.strain.hold(*node, hold);
            }
        }
        let rest = |moved: &Moved| Some((Part::Node(NodeId(moved.node as u32)), moved.rest?));
        plant.change_rests(tick, moves.iter().filter_map(rest));
    }
}

/// The end of an internode: the frame that what it bears leaves, and its place.
#[derive(Debug, Clone, Copy)]
struct Tip {
    turned: Rotation,
    at: Vector,
}

/// How an axis is trained, from the node on that the scan has reached.
#[derive(Debug, Clone, Copy, Default)]
enum Guide {
    /// It is not: it goes along with its bearer.
    #[default]
    Free,
    /// It turns at its base by this rotation, and then goes along.
    Turned(Rotation),
    /// It stands upright up to a height.
    Upright(f64),
    /// It is led to a height and lies along a level direction there.
    Along(f64, Vector),
}

/// An internode that stands otherwise than before.
struct Moved {
    node: usize,
    frame: Frame,
    /// Its statement, where it needs one.
    rest: Option<Rest>,
    /// Whether the support holds it, and whether it has been straightened.
    held: bool,
    straight: bool,
}

/// The forward scan of what stands, from bearers to what they bear.
struct Scan<'a> {
    plant: &'a Plant,
    support: &'a Support,
    tick: Tick,
    chosen: Vec<bool>,
    /// For each axis how it is trained.
    guides: Vec<Guide>,
    /// For each axis whether it is trained.
    trained: Vec<bool>,
    /// For each axis the last of its nodes that stands.
    ends: Vec<usize>,
    /// For each node its new tip, where it has moved.
    tips: Vec<Option<Tip>>,
    moves: Vec<Moved>,
}

impl<'a> Scan<'a> {
    fn new(training: &'a Training, plant: &'a Plant, chosen: &[AxisId], tick: Tick) -> Self {
        let axes = plant.axes.len();
        let mut is_chosen = vec![false; axes];
        chosen.iter().for_each(|axis| is_chosen[axis.index()] = true);
        let mut ends = vec![0; axes];
        plant.each_standing(tick, |stretch| ends[stretch.axis.index()] = stretch.nodes().end - 1);
        let (guides, trained) = (vec![Guide::Free; axes], vec![false; axes]);
        let tips = vec![None; plant.nodes.len()];
        let support = &training.support;
        Self { plant, support, tick, chosen: is_chosen, guides, trained, ends, tips, moves: Vec::new() }
    }

    /// Goes on to a node; what bears it has been passed.
    fn pass(&mut self, node: usize) {
        let Plant { nodes, axes, .. } = self.plant;
        let (axis, parent) = (nodes.axis[node].index(), nodes.parent[node].some().map(NodeId::index));
        let begins = nodes.rank[node] == 1;
        let moved = parent.and_then(|parent| self.tips[parent]);
        if begins {
            let bearer = axes.bearer[axis].some().map(NodeId::index);
            self.begin(axis, node, bearer, moved);
        }
        if moved.is_none() && matches!(self.guides[axis], Guide::Free) {
            return;
        }
        let was = tip_of(self.plant, parent);
        let below = moved.unwrap_or(was);
        let half = half_turn(self.plant, node);
        let own = was.turned.inverse().then(frame_of(self.plant, node).by(half * -1.0));
        let base = below.at + below.turned.of(self.start(node, begins));
        let length = f64::from(self.plant.posed_length(NodeId(node as u32)));
        // As it would stand if it only went along.
        let along = below.turned.then(own);
        let (start, straight) = match self.next(axis, base, length) {
            Step::Along => (along, false),
            Step::Turned(turn) => (turn.then(along), false),
            Step::Straight(heading) => {
                let chord = along.by(half);
                (Rotation::between(chord.of(X), heading).then(chord), true)
            }
        };
        let half = if straight { Vector::default() } else { half };
        let chord = start.by(half);
        let heading = chord.of(X);
        self.tips[node] = Some(Tip { turned: chord.by(half), at: base + heading * length });
        let frame = Frame { base: base.single(), heading: heading.single(), up: chord.of(Z).single() };
        let turned = matches!(self.guides[axis], Guide::Turned(_));
        let states = straight || turned || self.must_be_stated(node, begins);
        let rest = states.then(|| below.turned.inverse().then(start).normalized());
        let rest = rest.filter(|rest| !self.is_stated(node, *rest)).map(Rest::Turned);
        if turned {
            self.guides[axis] = Guide::Free;
        }
        let held = straight || (self.trained[axis] && matches!(self.support, Support::Spreader { .. }));
        self.moves.push(Moved { node, frame, rest, held, straight });
    }

    /// Decides how an axis is trained, at its first node.
    fn begin(&mut self, axis: usize, node: usize, bearer: Option<usize>, moved: Option<Tip>) {
        let guide = match self.support {
            Support::Stake(height) => self.is_stem(axis, bearer).then_some(Guide::Upright(*height)),
            _ if !self.chosen[axis] => None,
            Support::Spreader { inclination, azimuth } => {
                let chord = self.chord(axis, node, bearer, moved);
                let direction = direction_of(chord, self.up_of(node), [*inclination, *azimuth]);
                Some(Guide::Turned(Rotation::between(chord, direction)))
            }
            Support::Wires { heights, azimuth } => {
                let base = moved.map_or_else(|| Vector::from(self.plant.frames.base[node]), |tip| tip.at);
                let near = |a: &&f64, b: &&f64| (**a - base.z).abs().total_cmp(&(**b - base.z).abs());
                let (sin, cos) = sincos(*azimuth);
                let wire = Vector::new(sin, cos, 0.0);
                let side = if self.chord(axis, node, bearer, moved).dot(wire) < 0.0 { -1.0 } else { 1.0 };
                heights.iter().min_by(near).map(|height| Guide::Along(*height, wire * side))
            }
        };
        self.trained[axis] = guide.is_some();
        self.guides[axis] = guide.unwrap_or_default();
    }

    /// Whether an axis is the trunk, or continues it as the leading relay of a trunk that is a chain of axes.
    fn is_stem(&self, axis: usize, bearer: Option<usize>) -> bool {
        let Plant { axes, nodes, .. } = self.plant;
        let Some(bearer) = bearer else { return true };
        let relays = axes.origin[axis] == Origin::Relay && axes.order[axis] == 1 && !axes.follows[axis];
        relays && self.trained[nodes.axis[bearer].index()]
    }

    /// From the base of an axis to its tip, after its bearer has moved.
    fn chord(&self, axis: usize, node: usize, bearer: Option<usize>, moved: Option<Tip>) -> Vector {
        let chord = tip_of(self.plant, Some(self.ends[axis])).at - Vector::from(self.plant.frames.base[node]);
        let Some(moved) = moved else { return chord };
        moved.turned.of(tip_of(self.plant, bearer).turned.inverse().of(chord))
    }

    fn up_of(&self, node: usize) -> Vector {
        Vector::from(self.plant.frames.up[node])
    }

    /// What an internode that begins at `base` does.
    fn next(&mut self, axis: usize, base: Vector, length: f64) -> Step {
        match self.guides[axis] {
            Guide::Free => Step::Along,
            Guide::Turned(turn) => Step::Turned(turn),
            Guide::Upright(height) if base.z + length <= height * WITHIN => Step::Straight(Z),
            Guide::Upright(_) => {
                self.guides[axis] = Guide::Free;
                Step::Along
            }
            Guide::Along(height, wire) => Step::Straight(led(base, length, height, wire)),
        }
    }

    /// The start of a node beside the tip of its parent, in the frame of that tip.
    fn start(&self, node: usize, begins: bool) -> Vector {
        let axis = self.plant.nodes.axis[node];
        let node = NodeId(node as u32);
        Vector::from(if begins { self.plant.start_of(axis) } else { self.plant.start_of(node) })
    }

    /// Whether this is how an internode is stated, but for rounding: what is tied again where it is tied takes no
    /// further memory.
    fn is_stated(&self, node: usize, rest: Rotation) -> bool {
        match self.plant.rest_of(NodeId(node as u32), self.tick) {
            Rest::Turned(stated) => stated.is_near(rest),
            _ => false,
        }
    }

    /// Whether an internode that goes along would not, unless its frame were stated: its direction follows a trend, or
    /// is stated in the frame of the plant.
    fn must_be_stated(&self, node: usize, begins: bool) -> bool {
        let plant = self.plant;
        match plant.rest_of(NodeId(node as u32), self.tick) {
            Rest::Turned(_) => false,
            Rest::Heading(_) => true,
            Rest::Follows => {
                let trends = plant.trends_of(plant.nodes.axis[node]);
                let trend = trends.get(usize::from(plant.nodes.trend[node]));
                !begins && trend.is_some_and(|trend| trend.share > 0.0)
            }
        }
    }
}

/// What the next internode of an axis does.
enum Step {
    /// It goes along with what bears it.
    Along,
    /// It turns from there.
    Turned(Rotation),
    /// It points in a direction and is straight.
    Straight(Vector),
}

/// Along the heading, and along the upper side, in the coordinates of a frame; upward in those of the plant.
const X: Vector = Vector { x: 1.0, y: 0.0, z: 0.0 };
const Z: Vector = Vector { x: 0.0, y: 0.0, z: 1.0 };

/// The direction of an internode that is led to a wire: towards it as far as [`LED`] allows, and along it with the
/// rest of its length.
fn led(base: Vector, length: f64, height: f64, wire: Vector) -> Vector {
    let level = wire.cross(Z);
    let away = level * -base.dot(level) + Z * (height - base.z);
    let distance = away.dot(away).sqrt();
    if !(distance > 0.0 && length > 0.0) {
        return wire;
    }
    let share = (distance / length).min(LED);
    away * (share / distance) + wire * (1.0 - share * share).sqrt()
}

/// The direction at an angle to the upward vertical and in a direction from north to east, each that of `chord` where
/// it is not stated; the direction of a chord that stands upright is that of the upper side `up`.
fn direction_of(chord: Vector, up: Vector, [inclination, azimuth]: [Option<f64>; 2]) -> Vector {
    let chord = chord.unit().unwrap_or(Z);
    let level = |of: Vector| of.x * of.x + of.y * of.y;
    let side = if level(chord) > 1e-12 { chord } else { up };
    let azimuth = azimuth.unwrap_or_else(|| atan2(side.x, side.y));
    let inclination = inclination.unwrap_or_else(|| acos(chord.z.clamp(-1.0, 1.0)));
    let ((sin, cos), (east, north)) = (sincos(inclination), sincos(azimuth));
    Vector::new(sin * east, sin * north, cos)
}

/// The frame of an internode as it stands, as a rotation of the frame of the plant.
fn frame_of(plant: &Plant, node: usize) -> Rotation {
    let Frame { heading, up, .. } = plant.frames.at(NodeId(node as u32));
    Rotation::to(heading.map(f64::from), up.map(f64::from))
}

/// The half of the turn of a bent internode, in its own frame: its frame is that in its middle.
fn half_turn(plant: &Plant, node: usize) -> Vector {
    let Some(curvature) = plant.strain.curvature.get(node) else { return Vector::default() };
    let half = 0.5 * f64::from(plant.posed_length(NodeId(node as u32)));
    // About `up`, and about heading × up, which is the right side.
    Vector::new(0.0, -half * f64::from(curvature[1]), half * f64::from(curvature[0]))
}

/// The tip of an internode as it stands; of none, the ground at the seed.
fn tip_of(plant: &Plant, node: Option<usize>) -> Tip {
    let Some(node) = node else {
        return Tip { turned: Rotation::to([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]), at: Vector::default() };
    };
    let Frame { base, heading, .. } = plant.frames.at(NodeId(node as u32));
    let length = f64::from(plant.posed_length(NodeId(node as u32)));
    let turned = frame_of(plant, node).by(half_turn(plant, node));
    Tip { turned, at: Vector::from(base) + Vector::from(heading) * length }
}

#[cfg(test)]
mod tests;
