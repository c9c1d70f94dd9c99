//! The equations against the numbers that Weber & Penn 1995 print: the ends of their ranges, the values of their four
//! trees, and the results of our decisions where the paper is silent.
//!
//! Absent: whole plants (`tests`, `tests_plant`).

use super::envelope::{beyond, shape_8};
use super::equations::*;
use super::numbers::{Envelope, Level};
use super::radius::{branch_radius, lobe};
use phytomer_sim::math::{exp, log, pow};

const ROUND: Envelope = Envelope { width: 0.5, peak: 0.5, low: 0.5, high: 0.5 };

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-12, "{found} is not {expected}");
}

fn curve(curve_res: u32, curve: f64, curve_back: f64, curve_v: f64) -> Level {
    Level { curve_res, curve, curve_back, curve_v, ..Level::default() }
}

/// The sum of the turns of a stem without variation: nCurve of each segment but the first, which has none before it.
#[test]
fn the_segments_of_a_curved_stem_add_up() {
    let sum = |level: Level| (1..=level.curve_res).map(|nth| turn_deg(&level, nth, 0.7)).sum::<f64>();
    near(sum(curve(5, -40.0, 0.0, 0.0)), -40.0 * 4.0 / 5.0);
    near(sum(curve(1, 90.0, 0.0, 0.0)), 0.0);
    // The black oak's branches curve up by 40 degrees and back by 70: ten segments, five a half.
    near(sum(curve(10, 40.0, -70.0, 0.0)), 40.0 * 4.0 / 5.0 - 70.0);
    // Of five segments the third begins in the first half.
    let turns: Vec<f64> = (1..=5).map(|nth| turn_deg(&curve(5, 10.0, 20.0, 0.0), nth, 0.0)).collect();
    assert_eq!(turns, [0.0, 4.0, 4.0, 8.0, 8.0]);
}

/// CurveV adds to the same turn; below 0 it is no variation.
#[test]
fn a_segment_varies_by_its_share_of_the_variation() {
    near(turn_deg(&curve(8, 16.0, 0.0, 120.0), 2, 1.0), 2.0 + 15.0);
    near(turn_deg(&curve(8, 16.0, 0.0, 120.0), 8, -1.0), 2.0 - 15.0);
    near(turn_deg(&curve(8, 16.0, 0.0, -30.0), 8, -1.0), 2.0);
    let around: Vec<f64> = (1..=3).map(|nth| helix_deg(3, nth, 40.0)).collect();
    assert_eq!(around, [40.0, 160.0, 280.0], "a whole turn a stem");
}

#[test]
fn a_split_is_limited_by_the_declination_and_given_back() {
    near(split_deg(30.0, 0.0), 30.0);
    near(split_deg(30.0, 20.0), 10.0);
    near(split_deg(30.0, 80.0), 0.0);
    // Behind the second of eight segments six remain.
    near(give_back_deg(30.0, 2, 8), 5.0);
    near(give_back_deg(30.0, 2, 2), 0.0);
}

/// The formula of §4.2 at its ends, which its own words give as 20, 50 and 140 degrees; and equal angles for several.
#[test]
fn a_stem_and_its_clones_are_spread() {
    near(spread_deg(0, 1, 90.0, 0.0, 1.0), 20.0);
    near(spread_deg(0, 1, 90.0, 1.0, 1.0), 42.5);
    near(spread_deg(0, 1, 0.0, 1.0, 1.0), 110.0);
    near(spread_deg(0, 1, 0.0, 0.5, -1.0), -(20.0 + 0.75 * 120.0 * 0.25));
    near(spread_deg(1, 1, 0.0, 0.5, -1.0), 0.0);
    near(spread_deg(0, 0, 0.0, 0.5, -1.0), 0.0);
    let three: Vec<f64> = (0..=2).map(|stem| spread_deg(stem, 2, 0.0, 0.9, -1.0)).collect();
    assert_eq!(three, [0.0, 120.0, 240.0]);
}

/// The table of §4.3 at its ends and between them.
#[test]
fn the_forms_of_crowns_are_those_of_the_table() {
    let table = [
        [0.2, 0.6, 1.0],
        [0.2, 1.0, 0.2],
        [0.2, 0.2 + 0.8 * 0.5_f64.sqrt(), 1.0],
        [1.0, 1.0, 1.0],
        [0.5, 0.75, 1.0],
        [0.0, 0.5 / 0.7, 0.0],
        [1.0, 0.6, 0.2],
        [0.5, 0.5 + 0.25 / 0.7, 0.5],
        [0.0, 1.0, 0.0],
    ];
    for (shape, values) in (0..).zip(table) {
        for (ratio, value) in [0.0, 0.5, 1.0].into_iter().zip(values) {
            near(shape_ratio(shape, ratio, &ROUND), value);
        }
    }
    // At 0.7 the two lines of shapes 5 and 7 meet.
    for (shape, after) in [(5, 0.5), (7, 0.75)] {
        near(shape_ratio(shape, 0.7, &ROUND), 1.0);
        near(shape_ratio(shape, 0.85, &ROUND), after);
    }
}

/// The envelope is whole at its peak from both sides, wherever the peak is, and nothing beyond its ends.
#[test]
fn the_envelope_has_no_step_at_its_peak() {
    for peak in [0.2, 0.5, 0.6, 0.9] {
        for (low, high) in [(0.5, 0.5), (1.0, 2.0), (0.001, 0.5)] {
            let envelope = Envelope { width: 0.4, peak, low, high };
            near(shape_8(&envelope, 1.0 - peak), 1.0);
            assert!(shape_8(&envelope, 1.0 - peak - 1e-9) > 1.0 - 1e-7);
            for (ratio, value) in [(0.0, 0.0), (1.0, 0.0), (-0.1, 0.0), (1.1, 0.0)] {
                near(shape_8(&envelope, ratio), value);
            }
        }
    }
    // A power of 1 is a cone: half way up above the peak it is half as wide.
    let cone = Envelope { width: 0.4, peak: 0.6, low: 1.0, high: 1.0 };
    near(shape_8(&cone, 0.2), 0.5);
    near(shape_8(&cone, 0.7), 0.5);
    // The width is a radius. At the peak of a tree without a bare part: 0.6 of its height.
    near(beyond(&cone, 0.0, 0.6, 0.4), 0.0);
    near(beyond(&cone, 0.0, 0.6, 0.5), 0.1);
    near(beyond(&cone, 0.0, 0.8, 0.0), -0.2);
    near(beyond(&cone, 0.0, 1.25, 0.0), 0.25);
    near(beyond(&cone, 0.2, 0.1, 0.0), 0.1);
}

/// The Black Tupelo of Plate 2b has 60 and −40: its branches point downwards at the base of the crown, by 10 degrees,
/// and upwards at its top, 36 degrees from the vertical. The aspen's go from 110 to 30, the oak's from 60 to 12.
#[test]
fn a_down_angle_falls_along_the_crown_where_its_variation_is_below_0() {
    let at = |down_angle, down_angle_v, ratio, draw| {
        down_angle_deg(&Level { down_angle, down_angle_v, ..Level::default() }, ratio, draw)
    };
    for (angle, v, base, tip) in [(60.0, -40.0, 100.0, 36.0), (60.0, -50.0, 110.0, 30.0), (30.0, -30.0, 60.0, 12.0)] {
        near(at(angle, v, 1.0, 0.9), base);
        near(at(angle, v, 0.0, -0.9), tip);
    }
    near(at(60.0, -40.0, 0.375, 0.9), 60.0);
    near(at(30.0, 10.0, 0.375, 0.5), 35.0);
}

/// In a helix of 140 degrees; and by turns 60 degrees from the y-axis of the parent with the willow's −120.
#[test]
fn branches_stand_in_a_helix_or_on_two_sides_or_in_a_fan() {
    let helix = |nth| (0..=nth).fold(0.0, |last, nth| rotate_deg(140.0, 140.0, nth, last));
    assert_eq!([0, 1, 2, 3].map(helix), [140.0, 280.0, 60.0, 200.0]);
    assert_eq!([0, 1, 2].map(|nth| rotate_deg(-120.0, -120.0, nth, 33.0)), [60.0, -60.0, 60.0]);
    near(rotate_deg(-120.0, -110.0, 1, 33.0), -70.0);
    assert_eq!([0, 1, 2, 3, 4].map(|nth| fan_deg(180.0, nth, 5)), [-90.0, -45.0, 0.0, 45.0, 90.0]);
    near(fan_deg(180.0, 0, 1), 0.0);
}

/// The aspen's branch of 0.3 of the trunk with RatioPower 1.2; and no branch thicker than its parent where it leaves.
#[test]
fn a_branch_is_thinner_than_its_parent() {
    near(branch_radius(0.195, 0.3, 1.2, 1.0), 0.195 * exp(1.2 * log(0.3)));
    near(branch_radius(0.195, 0.9, 1.2, 0.05), 0.05);
}

/// Numbers are rounded up for stems and down for leaves, and an error of rounding changes none.
#[test]
fn real_numbers_of_children_become_whole() {
    assert_eq!([3.0, 3.0 + 1e-12, 3.1, 0.0, -2.0].map(stems), [3, 3, 4, 0, 0]);
    assert_eq!([3.0, 3.0 - 1e-12, 3.9, 0.0, -2.0].map(leaves), [3, 3, 3, 0, 0]);
    near(children(0, 50.0, 1.0, 1.0, 0.0), 50.0);
    near(children(1, 30.0, 0.15, 0.3, 0.7), 30.0 * 0.6);
    near(children(2, 12.0, 0.15, 0.3, 0.5), 9.0);
    near(leaves_on(2, 25.0, 1.0, 1.0), 25.0);
    near(leaves_on(3, 25.0, 0.0, 2.0), 25.0);
    near(leaves_on(0, 25.0, 0.0, 0.5), 12.5);
}

/// At 1 each of n − 1 turns takes 1/n of what is left, whatever the number of segments: never past the vertical.
#[test]
fn attraction_takes_a_share_of_the_declination() {
    for segments in [1, 3, 10, 40] {
        let mut left = 1.2;
        for _ in 1..segments {
            left -= curve_up(1.0, left, 1.0, segments);
        }
        near(left / 1.2, pow(1.0 - 1.0 / f64::from(segments), f64::from(segments) - 1.0));
    }
    assert!(curve_up(-3.0, 0.5, 1.0, 12) < 0.0, "below 0 stems droop");
    near(curve_up(1.0, 0.5, 0.0, 12), 0.0);
}

/// Five ridges and five furrows around the trunk, of 7 % of the radius.
#[test]
fn lobes_are_sines() {
    let quarter = 0.25 * std::f64::consts::TAU / 5.0;
    for k in 0..5 {
        let turn = 4.0 * quarter * f64::from(k);
        near(lobe(5, 0.07, turn + quarter), 1.07);
        near(lobe(5, 0.07, turn + 3.0 * quarter), 0.93);
    }
    near(lobe(0, 0.07, 1.0), 1.0);
}
