//! The frames that an axis is about to take at rest, before its nodes are there: for growth that looks where it goes.
//!
//! [`Ahead`] starts at the bud as it was posed last, turns node by node towards the trend as the pose does (`course`),
//! and says by what rotation a node has another heading. So an internode can be tried, and turned where it would meet
//! something. The pose keeps more digits of the slope than a frame does: the two agree to some micrometres. Absent:
//! what is met (`crate::site::solids`), and bending, which turns what is tried here with all that was there before.

use super::course::{self, VERTICAL};
use super::{bearing_frame, node_frame, start_frame};
use crate::plant::frames::{Directions, Frame, Plane, Slope};
use crate::plant::{AxisId, NodeId, OrganId, Plant, Trend};
use crate::rotation::Rotation;
use crate::vector::Vector;

/// Below this sine of the angle to the vertical the plane is found anew from node to node, as [`Ahead`] does.
const NEARLY_VERTICAL: f64 = 10.0 * VERTICAL;
/// What the digits of a slope may lack.
const DIGITS: f64 = 1e-9;

/// The end of an axis from which its next node grows.
#[derive(Debug, Clone, Copy)]
pub struct Ahead {
    base: Vector,
    /// The directions of the next node, if nothing turns it.
    directions: Directions,
    /// The directions of the node before, in whose frame a turn is stated.
    before: Directions,
    /// Whether the next node is the first of its axis.
    begins: bool,
}

/// The end of an axis on its way: as [`Ahead`], whose steps it takes to some nanometres a metre with less work a node,
/// since the plane and the slope of the axis are kept. Nothing turns it.
#[derive(Debug, Clone, Copy)]
pub struct Onward {
    base: Vector,
    directions: Directions,
    /// The plane and the slope of the directions, once it has turned towards a trend.
    course: Option<(Plane, Slope)>,
    begins: bool,
}

impl Ahead {
    /// The bud of an axis whose last node is `last`, or that has none yet; this node, or the bearer, must be posed.
    pub fn of_bud(plant: &Plant, axis: AxisId, last: Option<NodeId>) -> Self {
        let frame = last.map_or_else(|| start_frame(plant, axis), |last| node_frame(plant, last));
        let before = if last.is_none() { bearing_frame(plant, axis) } else { frame };
        let directions = [&frame, &before].map(directions);
        Self {
            base: Vector::from(frame.base),
            directions: directions[0],
            before: directions[1],
            begins: last.is_none(),
        }
    }

    /// As [`Ahead::of_bud`] at the last node of an axis, of which the nodes above `posed` are not posed yet.
    pub fn of_growing(plant: &Plant, axis: AxisId, posed: Option<NodeId>) -> Self {
        let mut ahead = Self::of_bud(plant, axis, posed);
        let nodes = &plant.nodes;
        let mut new = Vec::new();
        let mut last = plant.axes.last_node[axis.index()].some();
        while let Some(node) = last.filter(|node| Some(*node) != posed && nodes.axis[node.index()] == axis) {
            new.push(node.index());
            last = nodes.parent[node.index()].some();
        }
        for node in new.into_iter().rev() {
            ahead.tend(plant, axis, nodes.trend[node]);
            ahead.grow(f64::from(nodes.length[node]));
        }
        ahead
    }

    /// The end of the axis, metres from the seed.
    pub fn base(&self) -> [f64; 3] {
        point(self.base)
    }

    /// The heading, and the upper side.
    pub fn directions(&self) -> [[f64; 3]; 2] {
        self.directions.map(point)
    }

    /// Turns towards the trend that the next node names; the first node of an axis goes straight on.
    pub fn tend(&mut self, plant: &Plant, axis: AxisId, trend: u8) {
        let Some(trend) = trend_of(plant, axis, trend).filter(|_| !self.begins) else { return };
        let [heading, up] = self.directions;
        let (plane, slope) = Plane::through(heading, up);
        let slope = slope.turned(trend);
        self.directions = [plane.heading(slope), plane.up(slope)];
    }

    /// Gives the next node another heading, a unit vector. Returns its rotation in the frame of the node before.
    pub fn turn(&mut self, heading: [f64; 3]) -> Rotation {
        let heading = Vector::of(heading);
        let [was, up] = self.directions;
        let turn = Rotation::between(was, heading);
        self.directions = [heading, turn.of(up)];
        let [along, above] = self.before;
        within([along, above], self.directions)
    }

    /// The headings that an organ of the last node has in its life, if nothing turns it: at its birth, and half and all
    /// of the way that the trend of its kind turns it.
    pub fn headings_of(&self, plant: &Plant, organ: OrganId) -> [[f64; 3]; 3] {
        let Plant { organs, nodes, axes, habit, .. } = plant;
        let place = organ.index();
        let [heading, up] = self.directions.map(Vector::single);
        let frame = Frame { base: [0.0; 3], heading, up };
        let inserted = frame.inserted(organs.azimuth[place], organs.insertion[place]);
        let order = axes.order[nodes.axis[organs.node[place].index()].index()];
        let trend = habit.organ_trend(order, organs.kind[place]).map(|trend| trend.at(crate::clock::Tick::MAX));
        let turned = |share: f64| {
            let frame = trend.map_or(inserted, |trend| {
                course::turned(inserted, &crate::plant::Trend { share: share * trend.share, ..trend })
            });
            frame.heading.map(f64::from)
        };
        [turned(0.0), turned(0.5), turned(1.0)]
    }

    /// The rotation in the frame of the last node after which an organ has a heading, a unit vector, and its
    /// upper side towards `up` as far as the heading lets it.
    pub fn organ_turn(&self, heading: [f64; 3], up: [f64; 3]) -> Rotation {
        within(self.directions, [heading, up].map(Vector::of))
    }

    /// Goes on to the tip of the next node, of this length.
    pub fn grow(&mut self, length: f64) {
        self.base = self.base + self.directions[0] * length;
        self.before = self.directions;
        self.begins = false;
    }
}

impl Onward {
    /// The way of an axis from its end on.
    pub fn from(ahead: &Ahead) -> Self {
        let Ahead { base, directions, begins, .. } = *ahead;
        Self { base, directions, course: None, begins }
    }

    /// Goes on by the next node, which names a trend, to its tip. Whether its way is known: that of an axis which is
    /// just so upright that it has no horizontal direction any more depends on the last digit.
    #[inline]
    pub fn go_on(&mut self, plant: &Plant, axis: AxisId, trend: u8, length: f64) -> bool {
        let trend = if self.begins { None } else { trend_of(plant, axis, trend) };
        let mut is_known = true;
        if let Some(trend) = trend {
            let (plane, slope) = match self.course {
                Some(course) if course.1.r > NEARLY_VERTICAL => course,
                Some((plane, slope)) => {
                    is_known = (slope.r - VERTICAL).abs() > DIGITS;
                    Plane::through(plane.heading(slope), plane.up(slope))
                }
                None => Plane::through(self.directions[0], self.directions[1]),
            };
            let slope = slope.turned(trend);
            self.directions[0] = plane.heading(slope);
            self.course = Some((plane, slope));
        }
        self.base = self.base + self.directions[0] * length;
        self.begins = false;
        is_known
    }

    /// The end of the axis, metres from the seed.
    pub fn base(&self) -> [f64; 3] {
        point(self.base)
    }
}

/// The trend that a node of an axis names, where it turns the axis.
#[inline]
fn trend_of(plant: &Plant, axis: AxisId, trend: u8) -> Option<&Trend> {
    let trends = plant.own_trends.of(axis).unwrap_or(&plant.habit.trends);
    trends.get(usize::from(trend)).filter(|trend| trend.share > 0.0)
}

/// The rotation in the frame of some directions that leads to others.
fn within([along, above]: Directions, to: Directions) -> Rotation {
    let left = above.cross(along);
    let [heading, up] = to.map(|vector| [vector.dot(along), vector.dot(left), vector.dot(above)]);
    Rotation::to(heading, up)
}

fn directions(frame: &Frame) -> Directions {
    [frame.heading, frame.up].map(Vector::from)
}

fn point(Vector { x, y, z }: Vector) -> [f64; 3] {
    [x, y, z]
}
