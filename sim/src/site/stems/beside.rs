//! The stems beside a bud, and whether its next internode comes too near to one.
//!
//! Only an approach counts: an internode may come as near to an axis as it began, so a lateral leaves its bearer, from
//! within, and siblings leave one node, without any exception for them. Distances are those of the bark from the middle
//! line of the new internode, in metres, negative within the wood.

use super::segments::Segment;
use super::stem::{Near, length};
use super::{Stems, Which};
use crate::shape::Point;
use crate::site::solids::{Cone, along};
use crate::vector::Vector;

/// What frames in single precision may lack of a distance, metres.
pub(super) const ROUNDING: f64 = 1e-6;
/// The halvings by which the place is found at which a cone meets a stem.
const HALVINGS: usize = 40;

/// Whose bud it is: its own axis is never met.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Spared {
    /// The number of the plant.
    pub plant: u32,
    /// The place of the axis in the columns of the plant.
    pub axis: u32,
}

/// The stems near a bud.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Beside {
    stems: Vec<Near>,
    /// The ball of which it knows, or will know when it is asked, all stems.
    middle: Point,
    reach: f64,
    /// Whether it knows them.
    known: bool,
    /// All stems of a ball, of which those beside the bud are found as the shoot grows through it.
    about: Vec<Which>,
    /// The middle and the radius of that ball, metres; a radius of 0 before stems are asked.
    asked: (Point, f64),
}

/// Where an internode comes too near to a stem.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// The share of its length.
    pub share: f64,
    /// The direction from the stem to it, a unit vector.
    pub outward: Point,
    /// What lacks of the distance that it must keep, metres.
    pub lacks: f64,
}

impl Near {
    /// The distance of a segment, with the shares of both lengths at which they are nearest.
    pub(super) fn distance_of(&self, way: &Segment) -> (f64, [f64; 2]) {
        let shares = way.shares_near(&self.middle);
        (length(way.at(shares[0]) - self.middle.at(shares[1])) - self.radius(shares[1]), shares)
    }
}

impl Beside {
    /// No stems at all.
    pub const NONE: &'static Self = &Self {
        stems: Vec::new(),
        middle: [0.0; 3],
        reach: 0.0,
        known: true,
        about: Vec::new(),
        asked: ([0.0; 3], 0.0),
    };

    /// Whether no stem is known.
    pub fn is_none(&self) -> bool {
        self.stems.is_empty()
    }

    /// Makes sure that all stems nearer than `reach` to a point are known. Whether there are any near it.
    pub fn look(&mut self, all: &Stems, point: Point, reach: f64, spared: Spared) -> bool {
        self.move_to(point, reach);
        if !self.known {
            self.known = true;
            self.stems.clear();
            all.each_around(self.middle, self.reach, spared, &mut |plant, stem| {
                self.stems.push(Near::of(stem, plant.place, plant.number));
            });
        }
        !self.stems.is_empty()
    }

    /// Lays the ball about a point where it does not hold all that is nearer than `reach` to it.
    fn move_to(&mut self, point: Point, reach: f64) {
        let moved = length(Vector::of(point) - Vector::of(self.middle));
        // A not so small ball, since the shoot grows on.
        if self.reach == 0.0 || moved + reach > self.reach {
            (self.middle, self.reach, self.known) = (point, 2.0 * reach, false);
            self.stems.clear();
        }
    }

    /// Makes sure that the stems are known that are nearer than `reach` and `more` to a point, of those that
    /// [`Beside::look`] makes known. Whether there are any; most buds have none so near, which is soon found. The shoot
    /// is to grow on by about `further`: so far about it stems are asked once.
    pub fn glance(&mut self, all: &Stems, point: Point, [reach, more, further]: [f64; 3], spared: Spared) -> bool {
        self.move_to(point, reach);
        let (at, reach) = (Vector::of(point), reach + more);
        if !self.known {
            let ball = (self.middle, self.reach);
            self.ask(all, point, [reach + ROUNDING, further], spared);
            let Self { stems, about, .. } = self;
            stems.clear();
            for (plant, stem) in about.iter().map(|which| all.get(*which)) {
                let is_near = |(point, reach): (Point, f64)| stem.is_near(plant.seen_from_seed(point), reach);
                if is_near((point, reach + ROUNDING)) && is_near(ball) {
                    stems.push(Near::of(stem, plant.place, plant.number));
                }
            }
        }
        self.stems.iter().any(|stem| stem.distance(at) < reach)
    }

    /// Makes sure that all stems nearer than `reach` to a point are among those that were asked; if they must be asked,
    /// then `further` about it.
    fn ask(&mut self, all: &Stems, point: Point, [reach, further]: [f64; 2], spared: Spared) {
        let moved = length(Vector::of(point) - Vector::of(self.asked.0));
        if self.asked.1 == 0.0 || moved + reach + ROUNDING > self.asked.1 {
            self.asked = (point, reach + ROUNDING + further.max(0.0));
            all.gather(point, self.asked.1, spared, &mut self.about);
        }
    }

    /// Where the internode from one point to another comes nearer to a stem than `room` and than it began, by the most;
    /// `None` where it does not. `left` tells the side of a stem that it meets in its middle.
    pub fn touched(&self, [from, end]: [Point; 2], room: f64, left: bool) -> Option<Touch> {
        if self.stems.is_empty() {
            return None;
        }
        let start = Vector::of(from);
        let way = Segment { start, along: Vector::of(end) - start };
        let mut most: Option<(f64, usize, [f64; 2])> = None;
        for (number, stem) in self.stems.iter().enumerate() {
            let (distance, shares) = stem.distance_of(&way);
            let least = most.map_or(ROUNDING, |(lacks, ..)| lacks);
            if room - distance <= least {
                continue;
            }
            let lacks = room.min(self.distance_to_axis(stem, start)) - distance;
            if lacks > least {
                most = Some((lacks, number, shares));
            }
        }
        let (lacks, number, shares) = most?;
        let outward = self.stems[number].outward(&way, shares, left);
        Some(Touch { share: shares[0], outward, lacks })
    }

    /// The distance from a point to the axis of a stem, as far as it is near.
    fn distance_to_axis(&self, of: &Near, point: Vector) -> f64 {
        let same = self.stems.iter().filter(|stem| (stem.plant, stem.axis) == (of.plant, of.axis));
        same.map(|stem| stem.distance(point)).fold(f64::INFINITY, f64::min)
    }

    /// The direction out of the stem that a cone ahead of a point meets first: one that is nearer to the middle of a
    /// ball of the cone than the radius of the ball, and nearer than to the point itself.
    pub fn met(&self, from: Point, heading: Point, cone: Cone) -> Option<Point> {
        let end = cone.length / (1.0 + cone.sine);
        let start = Vector::of(from);
        let way = Segment { start, along: Vector::of(along(from, heading, end)) - start };
        let mut first: Option<(f64, usize)> = None;
        for (number, stem) in self.stems.iter().enumerate() {
            let Some(share) = stem.share_met(&way, cone.sine * end) else { continue };
            let is_ahead = || stem.distance(way.at(share)) < self.distance_to_axis(stem, start) - ROUNDING;
            if first.is_none_or(|(earlier, _)| share < earlier) && is_ahead() {
                first = Some((share, number));
            }
        }
        let (share, number) = first?;
        let stem = &self.stems[number];
        let at = stem.middle.share_near(way.at(share));
        Some(stem.outward(&way, [share, at], true))
    }

    /// The distance from a point to the nearest wood of other plants that is at least so thick, metres, with the
    /// direction out of it; `None` where none is known.
    pub fn support(&self, point: Point, spared: Spared, least_radius: f64) -> Option<(f64, Point)> {
        let at = Vector::of(point);
        let mut nearest: Option<(f64, Point)> = None;
        for stem in self.stems.iter().filter(|stem| stem.plant != spared.plant) {
            let share = stem.middle.share_near(at);
            let radius = stem.radius(share);
            let out = at - stem.middle.at(share);
            let distance = length(out) - radius;
            if radius >= least_radius && nearest.is_none_or(|(known, _)| distance < known) {
                let outward = out.unit().map_or([0.0, 0.0, 1.0], point_of);
                nearest = Some((distance, outward));
            }
        }
        nearest
    }
}

impl Near {
    /// The first share of a way at which the stem is within a ball whose radius grows evenly to `last` at its end.
    /// `None` where it never is. What a ball lacks to the stem is a convex function of the way, since the distance from
    /// a segment is, if the radius of the stem is even.
    fn share_met(&self, way: &Segment, last: f64) -> Option<f64> {
        let (_, [nearest, _]) = self.distance_of(way);
        let lacks = |share: f64| self.distance(way.at(share)) - share * last;
        if lacks(nearest) < 0.0 {
            return Some(nearest);
        }
        let (mut low, mut high) = (nearest, 1.0);
        for _ in 0..HALVINGS {
            let thirds = [low + (high - low) / 3.0, high - (high - low) / 3.0];
            if lacks(thirds[0]) <= lacks(thirds[1]) { high = thirds[1] } else { low = thirds[0] }
        }
        if lacks(high) >= 0.0 {
            return None;
        }
        let (mut before, mut met) = (nearest, high);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (before + met);
            if lacks(middle) < 0.0 { met = middle } else { before = middle }
        }
        Some(met)
    }

    /// The direction from the stem to a way at their nearest points; across both where the two meet.
    fn outward(&self, way: &Segment, [own, its]: [f64; 2], left: bool) -> Point {
        let between = way.at(own) - self.middle.at(its);
        let side = if left { 1.0 } else { -1.0 };
        let across = || (way.along.cross(self.middle.along) * side).unit();
        let any = || {
            [Vector::new(0.0, 0.0, 1.0), Vector::new(1.0, 0.0, 0.0)]
                .into_iter()
                .find_map(|axis| way.along.cross(axis).unit())
        };
        let outward = if length(between) > ROUNDING { between.unit() } else { None };
        outward.or_else(across).or_else(any).map_or([0.0, 0.0, 1.0], point_of)
    }
}

fn point_of(Vector { x, y, z }: Vector) -> Point {
    [x, y, z]
}
