//! Wind sway (Weber & Penn 1995 §4.7): each stem bends as a rod that is fixed at its base, and swings with two
//! frequencies about x and about y.
//!
//! The printed formulas, which the scan has lost, with Z along the stem: a₀ = 4 length (1 − Z) / radius_Z, a₁ = wind/50
//! a₀, a₂ = gust/50 a₀ + a₁/2, in degrees; b = offset + rate · time, in radians; sway = (a₁ sin b + a₂ sin 0.7 b) /
//! nCurveRes, in degrees, between two segments about x and about y, each with an offset of its own a stem. As in the
//! rest of the model the first segment of a stem is not turned against its parent. A segment is at the place of its
//! base. By default the rate is length/radius over 15 a second, and not radius/length as printed, by which a trunk
//! would need hours. Absent: gusts that come and go, and leaves that flutter.

use super::numbers::Numbers;
use super::params::Sway;
use super::radius::flare;
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

impl Sway {
    /// By how much b grows, radians a second, of a stem of a length and a radius.
    fn rate(self, length: f64, radius: f64) -> f64 {
        let rate = match self {
            Self::LengthOverRadius => length / radius / 15.0,
            Self::Printed => radius / length / 15.0,
        };
        if rate.is_finite() { rate } else { 0.0 }
    }
}

/// How each axis of a plant sways. A clone is a part of the stem from which it parts, with phases of its own. The
/// radius of the trunk is that without its flare.
pub(super) fn swings(plant: &Plant, tree: &Numbers) -> Vec<Swing> {
    let mut swings = own_stems(plant);
    swings.iter_mut().take(1).for_each(|trunk| trunk.radius /= flare(tree.flare, 0.0));
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
        swings[axis].rate = tree.sway.rate(length, radius);
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
pub(super) fn sway(plant: &mut Plant, tree: &Numbers, gusts: &Gusts) {
    if !(gusts.speed > 0.0 || gusts.gust > 0.0) {
        return;
    }
    let swings = swings(plant, tree);
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

#[cfg(test)]
mod tests {
    use super::*;

    const SWING: Swing = Swing { rate: 4.4, phases: [1.0, 2.5], length: 13.0, radius: 0.195, segments: 5, before: 0 };

    fn gusts(speed: f64, gust: f64, time: f64) -> Gusts {
        Gusts { speed, gust, time, closes: None }
    }

    /// a₀ = 4 · 13 · 0.8 / 0.1 = 416 degrees at the second of five segments of a radius of 0.1 m there; in a wind of 5
    /// m/s with gusts of 3 m/s more a₁ = 41.6 and a₂ = 24.96 + 20.8.
    #[test]
    fn the_angles_are_those_of_the_paper() {
        let found = angles_deg(&SWING, 2, 0.1, &gusts(5.0, 3.0, 0.25));
        for (angle, phase) in found.into_iter().zip(SWING.phases) {
            let b = phase + 4.4 * 0.25;
            // The second frequency moves the phase too: 0.7 b is of the whole angle.
            let expected = (41.6 * sin(b) + 45.76 * sin(0.7 * b)) / 5.0;
            assert!((angle - expected).abs() < 1e-9, "{angle} {expected}");
        }
    }

    /// The trunk of the aspen, 13 m with a radius of 0.195 m: once in 1.4 s, or once in 1 h 45 min.
    #[test]
    fn the_rates_are_those_that_the_names_say() {
        let slender = TAU / Sway::LengthOverRadius.rate(13.0, 0.195);
        let printed = TAU / Sway::Printed.rate(13.0, 0.195);
        assert!((slender - 1.414).abs() < 1e-3, "{slender}");
        assert!((printed / 60.0 - 104.72).abs() < 0.01, "{printed}");
        assert_eq!(Sway::LengthOverRadius.rate(1.0, 0.0), 0.0, "a stem without a radius stands still");
    }

    /// b goes 20 π: sin b by 10 turns and sin 0.7 b by 7.
    #[test]
    fn a_stem_repeats_after_20_pi_and_not_before() {
        let at = |time: f64| angles_deg(&SWING, 3, 0.1, &gusts(8.0, 4.0, time));
        let period = 20.0 * PI / SWING.rate;
        for time in [0.0, 0.3, 2.0, 7.7] {
            let [now, then] = [at(time), at(time + period)];
            assert!((0..2).all(|k| (now[k] - then[k]).abs() < 1e-9), "{now:?} {then:?}");
        }
        let apart = |share: u32| {
            let [now, then] = [at(0.0), at(period * f64::from(share) / 10.0)];
            (0..2).any(|k| (now[k] - then[k]).abs() > 1e-3)
        };
        assert!((1..10).all(apart));
    }

    /// The change in a hundredth of a second is at most that of the greatest speed, (a₁ + 0.7 a₂) rate.
    #[test]
    fn sway_is_continuous_in_time() {
        let at = |time: f64| angles_deg(&SWING, 2, 0.1, &gusts(5.0, 3.0, time))[0];
        let fastest = (41.6 + 0.7 * 45.76) / 5.0 * SWING.rate;
        for step in 0..4000 {
            let time = f64::from(step) * 0.01;
            assert!((at(time + 0.01) - at(time)).abs() <= 0.01 * fastest * (1.0 + 1e-9), "{time}");
        }
    }

    /// A film of 8 s: the angles are the same to the bit at its two ends, and each swing has the rate that is nearest.
    #[test]
    fn a_film_that_closes_ends_as_it_begins() {
        let closing = |time| Gusts { closes: Some(8.0), ..gusts(5.0, 3.0, time) };
        for time in [0.0, 0.5, 3.875] {
            let at = |time| angles_deg(&SWING, 2, 0.1, &closing(time)).map(f64::to_bits);
            assert_eq!(at(time), at(time + 8.0));
            assert_eq!(at(time), at(time - 8.0));
        }
        let (rates, _) = moving(SWING.rate, &closing(0.0));
        // 4.4 · 8 / 2π = 5.60 and 3.92 swings.
        assert!((rates[0] - TAU * 6.0 / 8.0).abs() < 1e-12 && (rates[1] - TAU * 4.0 / 8.0).abs() < 1e-12);
        assert!((moving(1e-3, &closing(0.0)).0[0] - TAU / 8.0).abs() < 1e-12, "each swings once at least");
    }
}
