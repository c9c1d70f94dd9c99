//! The equations against the numbers that Weber & Penn 1995 print: the ends of their ranges, the values of their four
//! trees, and the results of our decisions where the paper is silent.
//!
//! Absent: whole plants (`tests_plant`).

use super::equations::*;
use super::tree::Crown;
use phytomer_sim::math::{exp, log};

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-12, "{found} is not {expected}");
}

/// The sum of the turns of a stem without variation: nCurve of each segment but the first, which has none before it.
#[test]
fn the_segments_of_a_curved_stem_add_up() {
    let curve = |segments, deg, back_deg| Curve { segments, deg, back_deg, v_deg: 0.0 };
    let sum = |curve: Curve| (1..=curve.segments).map(|nth| curve.turn_deg(nth, 0.7)).sum::<f64>();
    near(sum(curve(5, -40.0, 0.0)), -40.0 * 4.0 / 5.0);
    near(sum(curve(1, 90.0, 0.0)), 0.0);
    // The black oak's branches curve up by 40 degrees and back by 70: ten segments, five a half.
    near(sum(curve(10, 40.0, -70.0)), 40.0 * 4.0 / 5.0 - 70.0);
    // Of five segments the third begins in the first half.
    let turns: Vec<f64> = (1..=5).map(|nth| curve(5, 10.0, 20.0).turn_deg(nth, 0.0)).collect();
    assert_eq!(turns, [0.0, 4.0, 4.0, 8.0, 8.0]);
}

#[test]
fn a_segment_varies_by_its_share_of_the_variation() {
    let curve = Curve { segments: 8, deg: 16.0, back_deg: 0.0, v_deg: 120.0 };
    near(curve.turn_deg(2, 1.0), 2.0 + 15.0);
    near(curve.turn_deg(8, -1.0), 2.0 - 15.0);
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
        (Crown::Conical, [0.2, 0.6, 1.0]),
        (Crown::Spherical, [0.2, 1.0, 0.2]),
        (Crown::Hemispherical, [0.2, 0.2 + 0.8 * 0.5_f64.sqrt(), 1.0]),
        (Crown::Cylindrical, [1.0, 1.0, 1.0]),
        (Crown::TaperedCylindrical, [0.5, 0.75, 1.0]),
        (Crown::Flame, [0.0, 0.5 / 0.7, 0.0]),
        (Crown::InverseConical, [1.0, 0.6, 0.2]),
        (Crown::TendFlame, [0.5, 0.5 + 0.25 / 0.7, 0.5]),
    ];
    for (shape, values) in table {
        for (ratio, value) in [0.0, 0.5, 1.0].into_iter().zip(values) {
            near(shape_ratio(shape, ratio), value);
        }
    }
    // At 0.7 the two lines of shapes 5 and 7 meet.
    for shape in [Crown::Flame, Crown::TendFlame] {
        near(shape_ratio(shape, 0.7), 1.0);
        near(shape_ratio(shape, 0.85), if shape == Crown::Flame { 0.5 } else { 0.75 });
    }
}

/// Each in the middle of its part of the stem above the bare base.
#[test]
fn branches_are_spaced_evenly_above_the_base() {
    let found: Vec<Place> = places(4, 0.2, 5).collect();
    for (place, (share, segment)) in found.iter().zip([(0.3, 1), (0.5, 2), (0.7, 3), (0.9, 4)]) {
        near(place.share, share);
        assert_eq!(place.segment, segment);
        near(place.ratio, (1.0 - share) / 0.8);
    }
    let positions: Vec<u16> = places(7, 0.0, 3).map(|place| place.position).collect();
    assert_eq!(positions, [0, 1, 0, 1, 2, 0, 1], "two, three and two on three segments");
    assert_eq!(places(0, 0.2, 5).count(), 0);
    assert!(places(10_000, 0.0, 1).all(|place| place.segment == 0 && place.share < 1.0));
}

/// The Black Tupelo of Plate 2b has 60 and −40: its branches point downwards at the base of the crown, by 10 degrees,
/// and upwards at its top, 36 degrees from the vertical.
#[test]
fn a_down_angle_falls_along_the_crown_where_its_variation_is_below_0() {
    near(down_angle_deg(60.0, -40.0, 1.0, 0.9), 100.0);
    near(down_angle_deg(60.0, -40.0, 0.0, 0.9), 36.0);
    near(down_angle_deg(60.0, -40.0, 0.375, 0.9), 60.0);
    near(down_angle_deg(30.0, 10.0, 0.375, 0.5), 35.0);
}

/// In a helix of 140 degrees; and by turns 60 degrees from the y-axis of the parent with the willow's −120.
#[test]
fn branches_stand_in_a_helix_or_on_two_sides() {
    let helix = |nth| (0..=nth).fold(0.0, |last, nth| rotate_deg(140.0, 140.0, nth, last));
    assert_eq!([0, 1, 2, 3].map(helix), [140.0, 280.0, 60.0, 200.0]);
    assert_eq!([0, 1, 2].map(|nth| rotate_deg(-120.0, -120.0, nth, 33.0)), [60.0, -60.0, 60.0]);
    near(rotate_deg(-120.0, -110.0, 1, 33.0), -70.0);
}

/// The aspen's branch of 0.3 of the trunk with RatioPower 1.2; and no branch thicker than its parent where it leaves.
#[test]
fn a_branch_is_thinner_than_its_parent() {
    near(branch_radius(0.195, 0.3, 1.2, 1.0), 0.195 * exp(1.2 * log(0.3)));
    near(branch_radius(0.195, 0.9, 1.2, 0.05), 0.05);
    near(tapered(0.2, 1.0, 0.75), 0.05);
    near(tapered(0.2, 0.0, 0.75), 0.2);
    near(tapered(0.2, 0.5, 1.0), 0.1);
}
