//! The path of a stem and of its clones (Weber & Penn 1995 §4.1, §4.2, §4.8): how each segment is turned, and where it
//! is, in lengths of a segment.
//!
//! Turns do not depend on lengths, so that a stem can be shortened after its path is known. A stem's frame in the paper
//! has z along it, y on its upper side and x = y × z; here these are heading, upper side and left, so that a turn by a
//! positive angle about the paper's x bends a stem away from its upper side. All frames are told in that of the ground,
//! whose heading is the vertical. A stem is followed from its base to its tip, then its clones in the order in which
//! they leave it, then their clones: this order is that of creation, in which splits are counted. Absent: lengths and
//! places on the parent (`tree`), radii (`radius`).

use super::draws::{self, signed, unit};
use super::equations::{curve_up, diffused, give_back_deg, helix_deg, split_deg, spread_deg, turn_deg};
use super::numbers::{Level, Numbers};
use phytomer_sim::math::atan2;
use phytomer_sim::plant::{LineageKey, key};
use phytomer_sim::random::{PlantRandom, Purpose, Stream};
use phytomer_sim::rotation::Rotation;
use std::f64::consts::PI;

/// The paper's z, x and y in the coordinates of a frame.
pub(super) const ALONG: [f64; 3] = [1.0, 0.0, 0.0];
pub(super) const LEFT: [f64; 3] = [0.0, 1.0, 0.0];
pub(super) const UP: [f64; 3] = [0.0, 0.0, 1.0];

/// The splits of a level so far, in the order of creation.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Splits {
    segments: u64,
}

/// A segment on a path.
#[derive(Debug, Clone, Copy)]
pub(super) struct Segment {
    pub frame: Rotation,
    /// Where it begins, from the base of the stem, in lengths of a segment.
    pub start: [f64; 3],
}

/// A stem on a path: the first one, or a clone.
#[derive(Debug, Clone, Copy)]
pub(super) struct Member {
    pub key: LineageKey,
    /// The place of the stem from which it was cloned among the members; of the first stem its own.
    pub twin: u32,
    /// How many segments come before its own: those of the stems from which it was cloned.
    pub before: u32,
    /// The place of its first segment on the path.
    pub from: u32,
    /// Its number among the clones that leave its twin with it, from 0.
    pub position: u16,
    /// By how much its first segment is turned about the vertical and away from its twin, degrees: of a clone.
    pub spread: f64,
    pub split: f64,
}

/// Where a stem leaves its parent and how.
#[derive(Debug, Clone, Copy)]
pub(super) struct Base {
    pub key: LineageKey,
    pub level: u8,
    /// The frame of the first segment.
    pub frame: Rotation,
}

/// A stem that is followed: the frame of its axis, which is that of its segments but in a helix, and its end so far.
#[derive(Debug, Clone)]
struct Walk {
    member: u32,
    stream: Stream,
    axis: Rotation,
    at: [f64; 3],
    /// By how much each further segment gives back of earlier splits, degrees.
    back: f64,
    /// Where the helix begins around its axis, degrees.
    helix: f64,
    /// The turn of the split that comes before the next segment, degrees.
    split: f64,
    spread: f64,
}

/// The path of a stem with its clones; made anew for each stem in the same memory.
#[derive(Debug, Default)]
pub(super) struct Path {
    pub members: Vec<Member>,
    pub segments: Vec<Segment>,
    waiting: std::collections::VecDeque<Walk>,
}

impl Path {
    /// Follows a stem with all its clones. Stops where it has more than `room` segments or clones, which the caller
    /// finds by their number.
    pub fn follow(&mut self, tree: &Numbers, base: &Base, random: &PlantRandom, splits: &mut Splits, room: u64) {
        self.members.clear();
        self.segments.clear();
        self.waiting.clear();
        let mut stream = random.stream(base.key, Purpose::Node);
        let helix = if tree.of(base.level).curve_v < 0.0 { 360.0 * unit(&mut stream, draws::HELIX) } else { 0.0 };
        let first =
            Walk { member: 0, stream, axis: base.frame, at: [0.0; 3], back: 0.0, helix, split: 0.0, spread: 0.0 };
        let root = Member { key: base.key, twin: 0, before: 0, from: 0, position: 0, spread: 0.0, split: 0.0 };
        self.members.push(root);
        self.waiting.push_back(first);
        while let Some(walk) = self.waiting.pop_front() {
            if self.segments.len().max(self.members.len()) as u64 > room {
                return;
            }
            self.stem(tree, base.level, walk, random, splits);
        }
    }

    /// Follows one stem from where it begins to its tip; its clones wait.
    fn stem(&mut self, tree: &Numbers, of: u8, mut walk: Walk, random: &PlantRandom, splits: &mut Splits) {
        let level = tree.of(of);
        let before = self.members[walk.member as usize].before;
        self.members[walk.member as usize].from = self.segments.len() as u32;
        for nth in before + 1..=level.curve_res {
            walk.turn(tree, of, nth);
            let frame = walk.frame(level, nth);
            self.segments.push(Segment { frame, start: walk.at });
            let heading = frame.turned(ALONG);
            (0..3).for_each(|k| walk.at[k] += heading[k]);
            if nth < level.curve_res {
                self.split(tree, of, nth, &mut walk, random, splits);
            }
        }
    }

    /// Splits a stem at the end of a segment, if the segment is one that splits.
    fn split(&mut self, tree: &Numbers, of: u8, nth: u32, walk: &mut Walk, random: &PlantRandom, splits: &mut Splits) {
        let level = tree.of(of);
        let clones = if of == 0 && nth == 1 && tree.base_splits > 0 { tree.base_splits } else { splits.next(level) };
        if clones == 0 {
            return;
        }
        let declination = declination(walk.axis).to_degrees();
        let twin = self.members[walk.member as usize];
        for clone in 1..=clones {
            let key = twin.key.child(key::Place::Fork((clone - 1) as u16).on(nth));
            let stream = random.stream(key, Purpose::Node);
            let mut cloned = Walk { stream, member: self.members.len() as u32, ..walk.clone() };
            cloned.turn_away(level, nth, [clone, clones], declination);
            self.members.push(Member {
                key,
                twin: walk.member,
                before: nth,
                from: 0,
                position: (clone - 1) as u16,
                spread: cloned.spread,
                split: cloned.split,
            });
            self.waiting.push_back(cloned);
        }
        walk.turn_away(level, nth, [0, clones], declination);
    }

    /// The segments of a member.
    pub fn segments_of(&self, member: usize, curve_res: u32) -> &[Segment] {
        let Member { from, before, .. } = self.members[member];
        &self.segments[from as usize..(from + curve_res - before) as usize]
    }
}

impl Splits {
    fn next(&mut self, level: &Level) -> u32 {
        if level.seg_splits == 0.0 {
            return 0;
        }
        self.segments += 1;
        diffused(level.seg_splits, self.segments)
    }
}

impl Walk {
    /// Turns the axis into the direction of segment `nth`.
    fn turn(&mut self, tree: &Numbers, of: u8, nth: u32) {
        if nth <= 1 {
            return;
        }
        let level = tree.of(of);
        let draw =
            if level.curve_v > 0.0 { signed(&mut self.stream, draws::of_segment(nth, draws::CURVE)) } else { 0.0 };
        if self.spread != 0.0 {
            self.axis = self.axis.then(Rotation::about(vertical_in(self.axis), radians(self.spread)));
        }
        let bend = turn_deg(level, nth, draw) + self.split - self.back;
        self.axis = self.axis.then(Rotation::about(LEFT, radians(bend)));
        if self.split > 0.0 {
            self.back += give_back_deg(self.split, nth, level.curve_res);
        }
        (self.split, self.spread) = (0.0, 0.0);
        if of >= 2 && tree.attraction_up != 0.0 {
            let up = curve_up(tree.attraction_up, declination(self.axis), self.axis.turned(UP)[0], level.curve_res);
            self.axis = self.axis.then(Rotation::about(LEFT, -up));
        }
        self.axis = self.axis.normalized();
    }

    /// The frame of segment `nth`: that of the axis, in a helix tilted away from it.
    fn frame(&self, level: &Level, nth: u32) -> Rotation {
        if level.curve_v >= 0.0 {
            return self.axis;
        }
        let around = radians(helix_deg(level.curve_res, nth, self.helix));
        let tilted = Rotation::about(ALONG, around).then(Rotation::about(LEFT, radians(-level.curve_v)));
        self.axis.then(tilted.then(Rotation::about(ALONG, -around))).normalized()
    }

    /// The turns of a split at the end of segment `nth`, which come before the next segment.
    fn turn_away(&mut self, level: &Level, nth: u32, [stem, clones]: [u32; 2], declination: f64) {
        let place = |what| draws::of_segment(nth + 1, what);
        let angle = level.split_angle + level.split_angle_v * signed(&mut self.stream, place(draws::SPLIT));
        self.split = split_deg(angle, declination);
        let (share, side) =
            (unit(&mut self.stream, place(draws::SPREAD)), signed(&mut self.stream, place(draws::SIDE)));
        self.spread = spread_deg(stem, clones, declination, share, side);
    }
}

/// The angle of a frame to the vertical, radians.
pub(super) fn declination(frame: Rotation) -> f64 {
    let [up, y, z] = frame.turned(ALONG);
    atan2((y * y + z * z).sqrt(), up)
}

/// The vertical in the coordinates of a frame.
fn vertical_in(frame: Rotation) -> [f64; 3] {
    frame.inverse().turned(ALONG)
}

pub(super) fn radians(deg: f64) -> f64 {
    deg * (PI / 180.0)
}

/// How a child is turned in the frame of its parent.
pub(super) fn leaving(rotate: f64, fan: Option<f64>, down: f64) -> Rotation {
    let around = match fan {
        Some(fan) => Rotation::about(UP, radians(fan)),
        None => Rotation::about(ALONG, radians(rotate)),
    };
    around.then(Rotation::about(LEFT, radians(down)))
}
