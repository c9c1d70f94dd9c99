//! How an internode is turned about its own direction, as one whole number that holds while the internode only bends.
//!
//! A page knows where an internode points from the line that it lies on. Its upper side is told as an angle from a
//! direction that follows from where it points: the axis x, turned as the vertical is turned into the internode along
//! the shorter arc. For internodes that hang the downward vertical is taken, since near the opposite of the vertical
//! that direction is hardly fixed; which one is part of the number. What bends in a vertical plane, as under its
//! weight, keeps its angle, and an error of the direction makes one of at most twice as much of the upper side.

use std::f64::consts::TAU;

/// The steps of a full turn.
pub const STEPS: i32 = 720;
/// The sine of half of the angle by which the upper side may be off before the number changes: one degree.
const HALF: f64 = 0.008_726_5;
/// The height of a unit vector, seen from either vertical, from which that vertical is taken, and until which it stays.
const TAKEN: f64 = 0.0;
const STAYS: f64 = -0.5;

type Vector = [f64; 3];

/// The number of an internode that points along a unit vector and has its upper side along another, where `last` was
/// its number before.
pub fn number(heading: Vector, up: Vector, last: Option<i32>) -> i32 {
    let stays = |number: &i32| pole(*number) * heading[2] > STAYS;
    let last = last.filter(stays);
    let off = |number: i32| {
        let found = upper(heading, number);
        [0, 1, 2].map(|k| found[k] - up[k]).iter().map(|x| x * x).sum::<f64>().sqrt()
    };
    if let Some(last) = last.filter(|last| off(*last) <= 2.0 * HALF) {
        return last;
    }
    let hangs = last.map_or(heading[2] < TAKEN, |last| last >= STEPS);
    let first = if hangs { STEPS } else { 0 };
    let [across, beside] = directions(heading, pole(first));
    let dot = |a: Vector| [0, 1, 2].map(|k| a[k] * up[k]).iter().sum::<f64>();
    let turn = phytomer_sim::math::atan2(dot(beside), dot(across)) / TAU * f64::from(STEPS);
    first + ((turn + 0.5).floor() as i32).rem_euclid(STEPS)
}

/// The upper side of an internode that points along a unit vector and has a number.
pub fn upper(heading: Vector, number: i32) -> Vector {
    let [across, beside] = directions(heading, pole(number));
    let turn = f64::from(number % STEPS) / f64::from(STEPS) * TAU;
    let (sin, cos) = (phytomer_sim::math::sin(turn), phytomer_sim::math::cos(turn));
    [0, 1, 2].map(|k| cos * across[k] + sin * beside[k])
}

/// 1 for the upward vertical, −1 for the downward one.
fn pole(number: i32) -> f64 {
    if number < STEPS { 1.0 } else { -1.0 }
}

/// The axis x, turned as a vertical is turned into a unit vector along the shorter arc, and what is across both.
fn directions([x, y, z]: Vector, pole: f64) -> [Vector; 2] {
    let near = (1.0 + pole * z).max(f64::MIN_POSITIVE);
    let a = [1.0 - x * x / near, -x * y / near, -pole * x];
    [a, [y * a[2] - z * a[1], z * a[0] - x * a[2], x * a[1] - y * a[0]]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use phytomer_sim::math::{cos, sin};

    fn dot(a: Vector, b: Vector) -> f64 {
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    }

    fn cross(a: Vector, b: Vector) -> Vector {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    }

    /// A unit vector at an angle from the vertical, in the direction of an azimuth, and the horizontal across it.
    fn pointing(off: f64, azimuth: f64) -> [Vector; 2] {
        [[sin(off) * cos(azimuth), sin(off) * sin(azimuth), cos(off)], [-sin(azimuth), cos(azimuth), 0.0]]
    }

    /// All directions, all turns: unit vectors across, within half a step of what was told.
    #[test]
    fn a_number_gives_the_upper_side_back() {
        for k in 0..4000 {
            let [off, azimuth, turn] = [0.61, 2.399_963, 1.7].map(|step| f64::from(k) * step);
            let [heading, across] = pointing(off % std::f64::consts::PI, azimuth);
            let beside = cross(heading, across);
            let up = [0, 1, 2].map(|k| cos(turn) * across[k] + sin(turn) * beside[k]);
            let number = number(heading, up, None);
            let found = upper(heading, number);
            assert!((0..2 * STEPS).contains(&number), "{number}");
            assert!(
                (dot(found, found) - 1.0).abs() < 1e-9 && dot(found, heading).abs() < 1e-9,
                "{heading:?} {found:?}"
            );
            assert!(dot(found, up) >= cos(TAU / f64::from(STEPS) / 2.0) - 1e-9, "{heading:?} {up:?} {found:?}");
        }
    }

    /// A branch that bends in its vertical plane, from the vertical until it hangs, changes its number once: where the
    /// other vertical is taken.
    #[test]
    fn what_bends_in_a_vertical_plane_keeps_its_number() {
        for azimuth in [0.3, 1.9, 4.0] {
            let (mut last, mut changes) = (None, 0);
            for step in 0..=300 {
                let [heading, across] = pointing(f64::from(step) * 0.01, azimuth);
                let up = cross(heading, across);
                let now = number(heading, up, last);
                changes += i32::from(last.is_some_and(|last| last != now));
                last = Some(now);
                // Within a degree.
                let found = upper(heading, now);
                assert!(dot(found, up) > cos(TAU / 360.0) - 1e-6, "{heading:?} {found:?} {up:?}");
            }
            assert_eq!(changes, 1, "{azimuth}");
        }
    }

    /// An error of the direction makes at most twice that error of the upper side, wherever an internode points.
    #[test]
    fn an_error_of_the_direction_is_not_enlarged_much() {
        let error = 1e-4;
        for k in 0..2000_i32 {
            let [heading, across] = pointing(f64::from(k) * 0.61 % std::f64::consts::PI, f64::from(k) * 2.4);
            let other = cross(heading, across);
            let far = |way: Vector, number: i32| {
                let off = [0, 1, 2].map(|k| cos(error) * heading[k] + sin(error) * way[k]);
                let [a, b] = [heading, off].map(|heading| upper(heading, number));
                let apart = [0, 1, 2].map(|k| a[k] - b[k]);
                dot(apart, apart).sqrt() / error
            };
            for number in [k * 7 % STEPS, k * 7 % STEPS + STEPS] {
                if pole(number) * heading[2] > STAYS {
                    let most = [across, other].map(|way| far(way, number)).into_iter().fold(0.0, f64::max);
                    assert!(most < 2.001, "{heading:?}: {most}");
                }
            }
        }
    }
}
