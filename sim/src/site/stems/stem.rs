//! One internode as a straight piece of wood, and the same as a bud knows it that is near.
//!
//! Its radius goes evenly from its base to its tip. A bud first asks the ball about it, which spares most stems the
//! exact distance. Absent: which stems there are (`of_plant`), and what a bud does beside them (`beside`).

use super::segments::Segment;
use crate::plant::{NodeId, Plant};
use crate::shape::{Bounds, Point};
use crate::vector::Vector;

/// What a coarse test allows for rounding, metres.
pub(super) const ROUNDING: f64 = 1e-4;

/// One internode.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stem {
    pub(super) start: [f32; 3],
    pub(super) end: [f32; 3],
    /// At its base and at its tip.
    pub(super) radii: [f32; 2],
    pub(super) axis: u32,
    /// The radius with which it is entered in the cells; negative where it is not.
    pub(super) entered: f32,
    /// That of its plant when it stood last.
    pub(super) turn: bool,
}

/// A stem near a bud, metres in the plot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Near {
    pub(super) middle: Segment,
    pub(super) radii: [f64; 2],
    pub(super) plant: u32,
    pub(super) axis: u32,
}

impl Stem {
    /// That of a node that does not stand.
    pub(super) const NONE: Self =
        Self { start: [0.0; 3], end: [0.0; 3], radii: [0.0; 2], axis: u32::MAX, entered: -1.0, turn: false };

    pub(super) fn of(plant: &Plant, axis: u32, node: usize) -> Self {
        let frame = plant.frames.at(NodeId(node as u32));
        let end = frame.advanced(plant.posed_length(NodeId(node as u32))).base;
        let radii = [plant.nodes.diameter[node], plant.nodes.diameter_tip[node]].map(|diameter| 0.5 * diameter);
        Self { start: frame.base, end, radii, axis, ..Self::NONE }
    }

    pub(super) fn bounds(&self) -> Bounds {
        let ends = [self.start, self.end].map(|end| end.map(f64::from));
        Bounds::of_points(&ends).with_margin(f64::from(self.radii[0].max(self.radii[1])))
    }

    /// A box about all of it, with the radius that it is entered with, in the plot.
    pub(super) fn entered_bounds(&self, place: Point) -> Bounds {
        let ends = [self.start, self.end].map(|end| [0, 1, 2].map(|k| place[k] + f64::from(end[k])));
        Bounds::of_points(&ends).with_margin(f64::from(self.entered) + ROUNDING)
    }

    /// The larger of its radii, metres.
    pub(super) fn radius(&self) -> f32 {
        self.radii[0].max(self.radii[1])
    }

    /// Its length along the three axes of space together, metres.
    pub(super) fn extent(&self) -> f64 {
        f64::from((0..3).map(|k| (self.end[k] - self.start[k]).abs()).sum::<f32>())
    }

    /// Whether it lies where another one was entered, and within what it was entered for.
    pub(super) fn is_entered_as(&self, was: &Self) -> bool {
        self.start == was.start && self.end == was.end && self.radius() <= was.entered
    }

    /// Whether it is nearer than `reach` to a point, metres from the seed.
    pub(super) fn is_near(&self, at: Point, reach: f64) -> bool {
        // All of it lies in the ball about its middle; a coarse test that spares most stems the exact one.
        let [start, end] = [self.start, self.end].map(Vector::from);
        let (along, out) = (end - start, (start + end) * 0.5 - Vector::of(at));
        let most = reach.max(0.0) + f64::from(self.radius()) + ROUNDING;
        let (between, half) = (out.dot(out), 0.25 * along.dot(along));
        if between > 2.0 * (most * most + half) {
            return false;
        }
        self.distance(at) < reach
    }

    /// The distance from a point to its bark, metres, negative within.
    pub(super) fn distance(&self, at: Point) -> f64 {
        Near::of(self, [0.0; 3], 0).distance(Vector::of(at))
    }
}

impl Near {
    pub(super) fn of(stem: &Stem, place: Point, plant: u32) -> Self {
        let [start, end] = [stem.start, stem.end].map(|end| Vector::of(place) + Vector::from(end));
        Self { middle: Segment { start, along: end - start }, radii: stem.radii.map(f64::from), plant, axis: stem.axis }
    }

    pub(super) fn radius(&self, share: f64) -> f64 {
        self.radii[0] + (self.radii[1] - self.radii[0]) * share
    }

    /// The distance from a point to the bark: that to the nearest point of the middle line, less the radius there.
    pub(super) fn distance(&self, point: Vector) -> f64 {
        let share = self.middle.share_near(point);
        length(point - self.middle.at(share)) - self.radius(share)
    }
}

pub(super) fn length(vector: Vector) -> f64 {
    vector.dot(vector).sqrt()
}
