//! Wind sway (Weber & Penn 1995 §4.7): each stem bends as a rod that is fixed at its base, and swings with two
//! frequencies about x and about y.
//!
//! The printed formulas, which the scan has lost, with Z along the stem: a₀ = 4 length (1 − Z) / radius_Z, a₁ = wind/50
//! a₀, a₂ = gust/50 a₀ + a₁/2, in degrees; b = offset + rate · time, in radians; sway = (a₁ sin b + a₂ sin 0.7 b) /
//! nCurveRes, in degrees, between two segments about x and about y, each with an offset of its own a stem. As in the
//! rest of the model the first segment of a stem is not turned against its parent. A segment is at the place of its
//! base. Absent: gusts that come and go, and leaves that flutter.

use phytomer_sim::gusts::{Gusts, Swing};
use phytomer_sim::math::{fmod, sin};
use phytomer_sim::plant::{AxisId, NodeId, Origin, Plant};
use phytomer_sim::random::Purpose;
use phytomer_sim::rotation::Rotation;
use std::f64::consts::{PI, TAU};

/// The paper's x and y in the coordinates of a frame.
const LEFT: [f64; 3] = [0.0, 1.0, 0.0];
const UP: [f64; 3] = [0.0, 0.0, 1.0];

/// The ratio of the second frequency to the first.
const SECOND: f64 = 0.7;

/// How fast a stem swings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Rate {
    /// b grows by length/radius a fifteenth of a second: slender stems swing fast, and the trunk of an aspen once in 1.4
    /// s.
    #[default]
    Slender,
    /// As it is printed, by radius/length: that trunk swings once in an hour and three quarters.
    Printed,
}

impl Rate {
    /// Radians a second.
    fn of(self, length: f64, radius: f64) -> f64 {
        let rate = match self {
            Self::Slender => length / radius / 15.0,
            Self::Printed => radius / length / 15.0,
        };
        if rate.is_finite() { rate } else { 0.0 }
    }
}

/// How each axis of a plant sways. A clone is a part of the stem from which it parts, with phases of its own.
pub(super) fn swings(plant: &Plant, law: Rate) -> Vec<Swing> {
    let mut swings = own_stems(plant);
    for axis in 0..swings.len() {
        let clone_of = plant.axes.bearer[axis].some().filter(|_| plant.axes.origin[axis] == Origin::Fork);
        if let Some(bearer) = clone_of {
            let twin = swings[plant.nodes.axis[bearer.index()].index()];
            let before = twin.before + plant.nodes.rank[bearer.index()];
            swings[axis] = Swing { before, ..twin };
        }
        let Swing { length, radius, .. } = swings[axis];
        let mut words = plant.random.stream(plant.axes.key[axis], Purpose::Sway);
        swings[axis].phases = [TAU * words.share(), TAU * words.share()];
        swings[axis].rate = law.of(length, radius);
    }
    swings
}

/// Each axis as a stem by itself.
fn own_stems(plant: &Plant) -> Vec<Swing> {
    let none = Swing { rate: 0.0, phases: [0.0; 2], length: 0.0, radius: 0.0, segments: 0, before: 0 };
    let mut stems = vec![none; plant.axes.len()];
    for node in 0..plant.nodes.len() {
        let stem = &mut stems[plant.nodes.axis[node].index()];
        if stem.segments == 0 {
            stem.radius = 0.5 * f64::from(plant.nodes.diameter[node]);
        }
        stem.segments += 1;
        stem.length += f64::from(plant.nodes.length[node]);
    }
    stems
}

/// Turns the segments of a plant to where they are in the gusts.
pub(super) fn sway(plant: &mut Plant, law: Rate, gusts: &Gusts) {
    if !(gusts.speed > 0.0 || gusts.gust > 0.0) {
        return;
    }
    let swings = swings(plant, law);
    for node in 0..plant.nodes.len() {
        let (axis, rank) = (plant.nodes.axis[node], plant.nodes.rank[node]);
        let swing = &swings[axis.index()];
        if rank == 1 && swing.before == 0 {
            continue;
        }
        let [x, y] = angles_deg(swing, rank, 0.5 * f64::from(plant.nodes.diameter[node]), gusts);
        let turn = Rotation::about(LEFT, x * (PI / 180.0)).then(Rotation::about(UP, y * (PI / 180.0)));
        match rank {
            1 => plant.turn_further(AxisId(axis.0), turn),
            _ => plant.turn_further(NodeId(node as u32), turn),
        }
    }
}

/// sway_x and sway_y of a segment, by its rank, from 1, and the radius at its base; degrees.
fn angles_deg(swing: &Swing, rank: u32, radius: f64, gusts: &Gusts) -> [f64; 2] {
    let segments = f64::from(swing.segments.max(1));
    let place = f64::from(swing.before + rank - 1) / segments;
    let a0 = 4.0 * swing.length * (1.0 - place) / radius;
    let a1 = gusts.speed / 50.0 * a0;
    let a2 = gusts.gust / 50.0 * a0 + a1 / 2.0;
    let (rates, time) = moving(swing.rate, gusts);
    swing.phases.map(|phase| {
        let sway = (a1 * sin(phase + rates[0] * time) + a2 * sin(SECOND * phase + rates[1] * time)) / segments;
        if sway.is_finite() { sway } else { 0.0 }
    })
}

/// The two rates, radians a second, and the time. In a film that closes each swing is made a whole number of times, at
/// least once, and the time begins again.
fn moving(rate: f64, gusts: &Gusts) -> ([f64; 2], f64) {
    let rates = [rate, SECOND * rate];
    let Some(length) = gusts.closes.filter(|length| *length > 0.0) else { return (rates, gusts.time) };
    let since = fmod(gusts.time, length);
    let rounded = rates.map(|rate| TAU * (rate * length / TAU).round().max(1.0) / length);
    (rounded, if since < 0.0 { since + length } else { since })
}
