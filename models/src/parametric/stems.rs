//! The stems of one tree (Weber & Penn 1995 §4.1 to §4.4): their draws, their lengths, their places on their parents,
//! the turns of their segments, and their radii.
//!
//! A stem's frame in the paper has z along it, y on its upper side and x = y × z; in the plant's frames these are
//! heading, upper side and left, so that a turn by a positive angle about the paper's x bends a stem away from its
//! upper side. A clone equals its twin from the split on (§3): in its segments, its radii, and branches of its own at
//! the places of its twin's. Draws are keyed by stem, and each quantity has a place of its own in the stem's stream.
//! Absent: the equations (`equations`), the plant's columns (`model`).

use super::equations::{
    Curve, Place, branch_radius, down_angle_deg, give_back_deg, places, rotate_deg, shape_ratio, split_deg, spread_deg,
    tapered,
};
use super::tree::{Branches, Tree, Trunk};
use phytomer_sim::math;
use phytomer_sim::plant::{LineageKey, key};
use phytomer_sim::random::{PlantRandom, Purpose, Stream};
use phytomer_sim::rotation::Rotation;
use std::cmp::Ordering;
use std::f64::consts::PI;

/// The paper's z and x in the coordinates of a frame.
const ALONG: [f64; 3] = [1.0, 0.0, 0.0];
const LEFT: [f64; 3] = [0.0, 1.0, 0.0];

/// The segment, from 1, at whose end the trunk splits (nBaseSplits, §4.2).
const SPLITS_AFTER: u32 = 1;

/// A stem; of a clone, the segments from the split on.
#[derive(Debug, Clone)]
pub(super) struct Stem {
    pub key: LineageKey,
    /// 0 for the trunk and its clones, 1 for branches.
    pub level: u8,
    /// The number among the clones, or among the branches on the bearing segment, from 0.
    pub position: u16,
    /// The rank of the bearing segment, from 1, and how far behind the tip of that segment the stem begins, metres. For
    /// the trunk both are 0.
    pub rank: u32,
    pub behind: f64,
    /// How each segment is turned in the frame of the one before, the first in that of the bearing segment.
    pub turns: Vec<Rotation>,
    /// The length of each segment, metres.
    pub segment: f64,
    /// The radius at the base of each segment, metres.
    pub radii: Vec<f64>,
    /// The azimuth around the bearing stem, and the angle between the bearing stem and this stem, radians.
    pub azimuth: f64,
    pub insertion: f64,
}

/// A tree whose size is drawn.
#[derive(Debug)]
pub(super) struct Drawn<'a> {
    tree: &'a Tree,
    random: &'a PlantRandom,
    /// length_trunk, metres.
    length: f64,
    /// length_base over length_trunk.
    base: f64,
}

/// The places of the draws of a plant, and of a stem, in their streams. The draws of segments begin at `SEGMENTS`, with
/// `A_SEGMENT` places each.
mod word {
    pub const SCALE: u64 = 0;
    pub const TRUNK_LENGTH: u64 = 1;

    pub const SPLIT: u64 = 0;
    pub const SPREAD: u64 = 1;
    pub const SIDE: u64 = 2;
    pub const DOWN_ANGLE: u64 = 3;
    pub const ROTATE: u64 = 4;
    pub const LENGTH: u64 = 5;
    pub const SEGMENTS: u64 = 16;
    pub const A_SEGMENT: u64 = 4;
}

impl<'a> Drawn<'a> {
    /// Draws scale_tree and length_trunk (§4.3).
    pub fn new(tree: &'a Tree, random: &'a PlantRandom) -> Self {
        let mut words = random.stream(LineageKey::SEED, Purpose::Plant);
        let scale = tree.scale_m.value() + tree.scale_v_m.value() * signed(&mut words, word::SCALE);
        let share = tree.trunk.length.value() + tree.trunk.length_v.value() * signed(&mut words, word::TRUNK_LENGTH);
        Self { tree, random, length: share * scale, base: tree.base_size.value() / share }
    }

    /// The trunk, followed by its clones.
    pub fn trunks(&self) -> Vec<Stem> {
        (0..=clones(&self.tree.trunk)).map(|stem| self.trunk(stem)).collect()
    }

    /// The trunk, number 0, or a clone of it.
    fn trunk(&self, stem: u32) -> Stem {
        let trunk = &self.tree.trunk;
        let key = match stem.checked_sub(1) {
            None => LineageKey::SEED,
            Some(position) => LineageKey::SEED.child(key::Place::Fork(position as u16).on(SPLITS_AFTER)),
        };
        let mut words = self.random.stream(key, Purpose::Node);
        let (turns, spread, split) = self.split(stem, &mut words);
        let segments = trunk.curve_res.value();
        let radius = self.length * self.tree.ratio.value();
        let cloned = if stem == 0 { 0 } else { SPLITS_AFTER };
        Stem {
            key,
            level: 0,
            position: stem.saturating_sub(1) as u16,
            rank: cloned,
            behind: 0.0,
            turns: turns[cloned as usize..].to_vec(),
            segment: self.length / f64::from(segments),
            radii: radii(radius, trunk.taper.value(), segments).skip(cloned as usize).collect(),
            azimuth: if stem == 0 { 0.0 } else { azimuth(spread) },
            insertion: if stem == 0 { 0.0 } else { radians(split) },
        }
    }

    /// How each segment of the trunk, or of a clone of it from its twin's base, is turned (§4.2); and the angles in
    /// degrees by which the stem is turned about the vertical and away from it at the split. The first segment stands
    /// upright: its declination is 0, and a turn about the vertical is a turn about its own axis.
    fn split(&self, stem: u32, words: &mut Stream) -> (Vec<Rotation>, f64, f64) {
        let trunk = &self.tree.trunk;
        let (curve, clones) = (curve_of_trunk(trunk), clones(trunk));
        let angle = trunk.split_angle_deg.value() + trunk.split_angle_v_deg.value() * signed(words, word::SPLIT);
        let split = if clones > 0 { split_deg(angle, 0.0) } else { 0.0 };
        let spread = spread_deg(stem, clones, 0.0, unit(words, word::SPREAD), signed(words, word::SIDE));
        let turned = SPLITS_AFTER + 1;
        let back = give_back_deg(split, turned, curve.segments);
        let turns = bends(&curve, words).map(|(nth, bend)| match nth.cmp(&turned) {
            Ordering::Less => bent(bend),
            Ordering::Equal => rolled(spread).then(bent(split + bend)),
            Ordering::Greater => bent(bend - back),
        });
        (turns.collect(), spread, split)
    }

    /// The branches of the trunk or of one of its clones, from the base to the top (§4.3): of the places of the whole
    /// stem, those on the clone's own segments.
    pub fn branches(&self, parent: &Stem) -> impl Iterator<Item = Stem> {
        let segments = self.tree.trunk.curve_res.value();
        let before = segments - parent.turns.len() as u32;
        let of_level = move |level: &'a Branches| {
            places(level.number.value(), self.base, segments).map(move |place| (level, place))
        };
        let all = self.tree.branches.first().into_iter().flat_map(of_level);
        let mut last = 0.0;
        all.filter(move |(_, place)| place.segment >= before).zip(0..).map(move |((level, place), nth)| {
            let rank = place.segment - before + 1;
            let key = parent.key.child(key::Place::Axillary(place.position).on(rank));
            let mut words = self.random.stream(key, Purpose::Node);
            let rotate = level.rotate_deg.value() + level.rotate_v_deg.value() * signed(&mut words, word::ROTATE);
            last = rotate_deg(level.rotate_deg.value(), rotate, nth, last);
            self.branch(level, place, (rank, key), last, &mut words)
        })
    }

    /// A branch at a place of its parent, on the segment of rank `rank`, turned by `rotate` degrees about the parent.
    fn branch(
        &self,
        level: &Branches,
        place: Place,
        (rank, key): (u32, LineageKey),
        rotate: f64,
        words: &mut Stream,
    ) -> Stem {
        let Tree { ratio, ratio_power, trunk, shape, .. } = self.tree;
        let (angle, angle_v) = (level.down_angle_deg.value(), level.down_angle_v_deg.value());
        let down = down_angle_deg(angle, angle_v, place.ratio, signed(words, word::DOWN_ANGLE));
        let greatest = level.length.value() + level.length_v.value() * signed(words, word::LENGTH);
        let share = greatest * shape_ratio(*shape, place.ratio);
        let trunk_radius = self.length * ratio.value();
        let there = tapered(trunk_radius, trunk.taper.value(), place.share);
        let radius = branch_radius(trunk_radius, share, ratio_power.value(), there);
        let curve = curve_of_branches(level);
        let turns = bends(&curve, words).map(|(nth, bend)| match nth {
            1 => rolled(rotate).then(bent(down)),
            _ => bent(bend),
        });
        let segments = f64::from(trunk.curve_res.value());
        Stem {
            key,
            level: 1,
            position: place.position,
            rank,
            behind: (f64::from(place.segment + 1) - place.share * segments) * (self.length / segments),
            turns: turns.collect(),
            segment: share * self.length / f64::from(curve.segments),
            radii: radii(radius, level.taper.value(), curve.segments).collect(),
            azimuth: azimuth(rotate),
            insertion: radians(down),
        }
    }
}

/// How many clones the trunk has: 0 where it has one segment, after which nothing could split.
pub(super) fn clones(trunk: &Trunk) -> u32 {
    if trunk.curve_res.value() > SPLITS_AFTER { trunk.base_splits.value() } else { 0 }
}

/// The numbers of stems on a tree whose bare part is the share `base` of the trunk: for each level its axes and its
/// internodes.
pub(super) fn counts(tree: &Tree, base: f64) -> Vec<[u64; 2]> {
    let (clones, segments) = (u64::from(clones(&tree.trunk)), tree.trunk.curve_res.value());
    let mut counts = vec![[1 + clones, u64::from(segments) + clones * u64::from(segments - SPLITS_AFTER)]];
    if let Some(level) = tree.branches.first() {
        let number = level.number.value();
        let cloned = places(number, base, segments).filter(|place| place.segment >= SPLITS_AFTER).count() as u64;
        let axes = u64::from(number) + clones * cloned;
        counts.push([axes, axes * u64::from(level.curve_res.value())]);
    }
    counts
}

fn curve_of_trunk(trunk: &Trunk) -> Curve {
    let Trunk { curve_res, curve_deg, curve_back_deg, curve_v_deg, .. } = trunk;
    curve([curve_deg, curve_back_deg, curve_v_deg].map(|number| number.value()), curve_res.value())
}

fn curve_of_branches(level: &Branches) -> Curve {
    let Branches { curve_res, curve_deg, curve_back_deg, curve_v_deg, .. } = level;
    curve([curve_deg, curve_back_deg, curve_v_deg].map(|number| number.value()), curve_res.value())
}

fn curve([deg, back_deg, v_deg]: [f64; 3], segments: u32) -> Curve {
    Curve { segments, deg, back_deg, v_deg }
}

/// For each segment of a stem, with its number from 1, by how many degrees it turns away from the segment before.
fn bends(curve: &Curve, words: &mut Stream) -> impl Iterator<Item = (u32, f64)> {
    (1..=curve.segments).map(move |nth| {
        let place = word::SEGMENTS + word::A_SEGMENT * u64::from(nth - 1);
        (nth, curve.turn_deg(nth, signed(words, place)))
    })
}

/// The radius at the base of each segment.
fn radii(radius: f64, taper: f64, segments: u32) -> impl Iterator<Item = f64> {
    (0..segments).map(move |nth| tapered(radius, taper, f64::from(nth) / f64::from(segments)))
}

fn rolled(deg: f64) -> Rotation {
    Rotation::about(ALONG, radians(deg))
}

fn bent(deg: f64) -> Rotation {
    Rotation::about(LEFT, radians(deg))
}

/// The azimuth in [0, 2π) of a stem that is turned about its parent by `rotate` degrees. The stem leans away from its
/// y-axis, and azimuths count from the direction of the parent's y-axis.
fn azimuth(rotate: f64) -> f64 {
    let around = math::fmod(rotate + 180.0, 360.0);
    radians(if around < 0.0 { around + 360.0 } else { around })
}

/// Uniform in (0, 1), and in (−1, 1): the word at a place of a stream.
fn unit(words: &mut Stream, place: u64) -> f64 {
    words.seek(place);
    words.share()
}

fn signed(words: &mut Stream, place: u64) -> f64 {
    2.0 * unit(words, place) - 1.0
}

fn radians(deg: f64) -> f64 {
    deg * (PI / 180.0)
}
