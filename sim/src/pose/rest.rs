//! The directions of an axis at rest, internode by internode: the only part that differs between the two ways to state
//! rest geometry. The scans of the pose (`scan`, `bent`) are generic over both.
//!
//! [`Trended`] is the course of plants whose directions follow from insertion, phyllotaxis and trend. [`Stated`] is the
//! course of plants in which some frames are stated: each node, and each axis, by its statement or by insertion and
//! trend. Heading and upper side are carried in double precision, so that a stated axis of many nodes does not drift.

use crate::clock::Tick;
use crate::plant::frames::{Along, Directions, Frame, Frames, LastInsertion, Leaving, Plane, Stated, Trended};
use crate::plant::stated::{Part, Rest, StatedFrames};
use crate::plant::{Axes, AxisId, NodeId, Trend};
use crate::rotation::Rotation;
use crate::vector::Vector;

/// Below this square of its length a vector has no direction.
const NOTHING: f64 = 1e-12;

/// The inputs of a course on its way along one axis.
pub(crate) struct Way<'a> {
    pub axes: &'a Axes,
    pub axis: AxisId,
    /// The trends that its internodes name by place.
    pub trends: &'a [Trend],
    pub stated: &'a StatedFrames,
    /// The lengths of the internodes of the plant at the age.
    pub lengths: &'a [f32],
    pub age: Tick,
}

/// The directions at rest of one axis, at the node that a scan has reached.
pub(crate) trait Course: Copy {
    /// Whether the directions at the start of an axis are computed with its first node, and nodes may begin beside
    /// their bearer.
    const STATED: bool;

    /// The course of an axis, which leaves an internode of these directions and this length. `leaving` computes the
    /// direction of insertion and is called only where it is needed.
    fn leaving(bearing: Directions, length: f64, leaving: impl FnOnce() -> Leaving) -> Self;

    /// The start of the next node: an offset in the frame that the course has reached, where one is stated. `begins`
    /// tells whether the node is the first of its axis.
    fn start(&self, way: &Way<'_>, node: usize, begins: bool) -> Option<[f64; 3]>;

    /// Continues to `node`, which names `trend`. Returns whether the directions have changed. The first node of an
    /// axis, and a node whose trend is not among those of the way, continues straight on.
    fn next(&mut self, way: &Way<'_>, node: usize, trend: u8, begins: bool) -> bool;

    /// The directions that the course has reached.
    fn directions(&self) -> Directions;

    /// The length of the internode that the course has reached; called only where it is [`Course::STATED`].
    fn length(&self) -> f64;

    /// The course of an axis that grows on; `left` is the course at its start.
    fn resumed(frames: &Frames, axis: usize, left: Self) -> Self;

    /// Stores the course for [`Course::resumed`].
    fn keep(self, frames: &mut Frames, axis: usize);
}

impl Trended {
    #[inline(always)]
    fn inserted([heading, up]: Directions, leaving: Leaving) -> Self {
        let rest = Frame { base: [0.0; 3], heading: heading.single(), up: up.single() };
        let (plane, slope) = Plane::of(&rest.left_at(leaving));
        Self { plane, slope }
    }
}

impl Course for Trended {
    const STATED: bool = false;

    #[inline]
    fn leaving(bearing: Directions, _: f64, leaving: impl FnOnce() -> Leaving) -> Self {
        Self::inserted(bearing, leaving())
    }

    #[inline(always)]
    fn start(&self, _: &Way<'_>, _: usize, _: bool) -> Option<[f64; 3]> {
        None
    }

    #[inline(always)]
    fn next(&mut self, way: &Way<'_>, _: usize, trend: u8, begins: bool) -> bool {
        let turn = way.trends.get(usize::from(trend)).filter(|trend| trend.share > 0.0 && !begins);
        if let Some(trend) = turn {
            self.slope = self.slope.turned(trend);
        }
        turn.is_some()
    }

    #[inline(always)]
    fn directions(&self) -> Directions {
        [self.plane.heading(self.slope), self.plane.up(self.slope)]
    }

    #[inline(always)]
    fn length(&self) -> f64 {
        0.0
    }

    #[inline]
    fn resumed(frames: &Frames, axis: usize, left: Self) -> Self {
        Self { slope: frames.tips[axis].slope, ..left }
    }

    #[inline]
    fn keep(self, frames: &mut Frames, axis: usize) {
        frames.tips[axis].slope = self.slope;
    }
}

impl Stated {
    /// The first internode of an axis that leaves a bearer of these directions.
    fn begun(bearing: Directions, way: &Way<'_>) -> Along {
        match way.stated.rest(Part::Axis(way.axis), way.age) {
            Rest::Follows => {
                let axis = way.axis.index();
                let leaving = LastInsertion::default().leaving(way.axes.azimuth[axis], way.axes.insertion[axis]);
                Along::Trended(Trended::inserted(bearing, leaving))
            }
            rest => Along::Turned(turned(bearing, rest)),
        }
    }

    /// A course that turns these directions towards a trend.
    fn tending(&self) -> Trended {
        match self.along {
            Along::Trended(trended) => trended,
            Along::Turned([heading, up]) => {
                let (plane, slope) = Plane::through(heading, up);
                Trended { plane, slope }
            }
        }
    }
}

impl Course for Stated {
    const STATED: bool = true;

    fn leaving(bearing: Directions, length: f64, _: impl FnOnce() -> Leaving) -> Self {
        Self { along: Along::Turned(bearing), length }
    }

    fn start(&self, way: &Way<'_>, node: usize, begins: bool) -> Option<[f64; 3]> {
        let part = if begins { Part::Axis(way.axis) } else { Part::Node(NodeId(node as u32)) };
        let start = way.stated.start(part);
        (begins || start != [0.0; 3]).then(|| start.map(f64::from))
    }

    fn next(&mut self, way: &Way<'_>, node: usize, trend: u8, begins: bool) -> bool {
        self.length = f64::from(way.lengths[node]);
        if begins {
            self.along = Self::begun(self.directions(), way);
            return true;
        }
        match way.stated.rest(Part::Node(NodeId(node as u32)), way.age) {
            Rest::Follows => {
                if let Along::Trended(trended) = &mut self.along {
                    return trended.next(way, node, trend, begins);
                }
                let mut trended = self.tending();
                let turns = trended.next(way, node, trend, begins);
                if turns {
                    self.along = Along::Trended(trended);
                }
                turns
            }
            rest => {
                self.along = Along::Turned(turned(self.directions(), rest));
                true
            }
        }
    }

    fn directions(&self) -> Directions {
        match &self.along {
            Along::Trended(trended) => trended.directions(),
            Along::Turned(directions) => *directions,
        }
    }

    fn length(&self) -> f64 {
        self.length
    }

    fn resumed(frames: &Frames, axis: usize, left: Self) -> Self {
        frames.courses.get(axis).copied().unwrap_or(left)
    }

    fn keep(self, frames: &mut Frames, axis: usize) {
        if frames.courses.len() <= axis {
            frames.courses.resize(frames.tips.len().max(axis + 1), self);
        }
        frames.courses[axis] = self;
    }
}

/// The directions of a part with the statement `rest` on a bearer of the directions `bearing`.
pub(super) fn turned(bearing: Directions, rest: Rest) -> Directions {
    match rest {
        Rest::Follows => bearing,
        Rest::Turned(rotation) => within(bearing, rotation),
        Rest::Heading(heading) => {
            // Computed from the bearer's stored directions, in single precision.
            let [was, up] = bearing.map(|direction| Vector::from(direction.single()));
            let heading = direction_of(heading).unwrap_or(was);
            [heading, carried(up, was, heading)]
        }
    }
}

/// The directions after a rotation within a frame.
pub(super) fn within(bearing: Directions, rotation: Rotation) -> Directions {
    let [x, z] = [Vector::new(1.0, 0.0, 0.0), Vector::new(0.0, 0.0, 1.0)].map(|axis| rotation.of(axis));
    [placed(bearing, [x.x, x.y, x.z]), placed(bearing, [z.x, z.y, z.z])]
}

/// Coordinates in a frame as a vector of the plant.
pub(crate) fn placed([heading, up]: Directions, [x, y, z]: [f64; 3]) -> Vector {
    heading * x + up.cross(heading) * y + up * z
}

/// A stated heading as a unit vector, where it is not 0.
fn direction_of(heading: [f32; 3]) -> Option<Vector> {
    let heading = Vector::from(heading);
    let square = heading.dot(heading);
    (square > NOTHING && square.is_finite()).then(|| heading * (1.0 / square.sqrt()))
}

/// The `up` of a bearer with heading `was`, carried to a child with `heading` by projection, so that it turns no more
/// than the heading does. Where the heading turns into `up` itself, the result is made of the bearer's heading instead.
fn carried(up: Vector, was: Vector, heading: Vector) -> Vector {
    let along = up.dot(heading);
    let across = up - heading * along;
    let across = if across.dot(across) > NOTHING { across } else { was * -along.signum() };
    let across = across - heading * across.dot(heading);
    across * (1.0 / across.dot(across).sqrt())
}
