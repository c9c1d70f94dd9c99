//! Large deflections: rods under a dead load at the tip, and under their own weight, clamped level and at 45° (the
//! elastica, solved as boundary-value problems to a tolerance of 1e-13). Each row: load, x of the tip, drop, base
//! curvature, for length and stiffness 1.

use super::*;

const TIP_LOAD: [[f64; 4]; 9] = [
    [0.1, 0.9993346, 0.0332953193, 0.09993346],
    [0.2, 0.9973534517, 0.0663644821, 0.1994706903],
    [0.5, 0.9840810375, 0.1621435757, 0.4920405188],
    [1.0, 0.9435667637, 0.3017207738, 0.9435667637],
    [2.0, 0.8393582792, 0.4934574804, 1.6787165583],
    [3.0, 0.7455798154, 0.6032534411, 2.2367394463],
    [5.0, 0.6123716393, 0.7137915236, 3.0618581964],
    [7.5, 0.5104257515, 0.7767020004, 3.8281931361],
    [10.0, 0.4450044022, 0.8106090249, 4.4500440225],
];

const OWN_WEIGHT: [[f64; 4]; 8] = [
    [0.1, 0.9999107322, 0.0124984378, 0.0499968756],
    [0.5, 0.9977790003, 0.0623057682, 0.249611234],
    [1.0, 0.9912463953, 0.123471402, 0.4969333999],
    [2.0, 0.9668929469, 0.2385065829, 0.9767427151],
    [5.0, 0.84665718, 0.4959050446, 2.2268925538],
    [8.0, 0.7244247341, 0.6406307174, 3.2015764053],
    [10.0, 0.6563537612, 0.7001997155, 3.7421911109],
    [20.0, 0.4452320522, 0.8298814434, 5.7615325858],
];

const OWN_WEIGHT_FROM_45_DEGREES: [[f64; 4]; 5] = [
    [0.5, 0.7389232329, -0.6735611785, 0.1831545868],
    [1.0, 0.7715465063, -0.6351074806, 0.3794714761],
    [2.0, 0.8363930704, -0.5422093676, 0.8121512509],
    [5.0, 0.9582151389, -0.1705368586, 2.3163978989],
    [10.0, 0.8667767126, 0.3056145131, 4.5004917383],
];

const INTERNODES: u32 = 400;

/// The tolerance, in parts of the length.
const TOLERANCE: f64 = 1e-4;

fn check(rod: &Rod, [load, x, drop, curvature]: [f64; 4]) {
    let (plant, outcome) = rod.bent();
    assert!(outcome.settled, "load {load}: {outcome:?}");
    let (tip_x, tip_z) = tip(&plant);
    assert!((tip_x - x).abs() < TOLERANCE, "load {load}: x {tip_x}, not {x}, after {outcome:?}");
    assert!((-tip_z - drop).abs() < TOLERANCE, "load {load}: drop {}, not {drop}", -tip_z);
    let base = base_curvature(&plant);
    assert!(
        (base - curvature).abs() < TOLERANCE * curvature.max(1.0),
        "load {load}: curvature {base}, not {curvature}"
    );
}

/// The curvature at the clamp, from those in the middles of the first three internodes.
fn base_curvature(plant: &Plant) -> f64 {
    let at = |node| f64::from(plant.strain.curvature_of(node));
    (15.0 * at(0) - 10.0 * at(1) + 3.0 * at(2)) / 8.0
}

#[test]
fn a_weight_at_the_tip_of_a_level_rod() {
    for row in TIP_LOAD {
        check(&Rod { tip: row[0], ..Rod::level(INTERNODES) }, row);
    }
}

#[test]
fn a_level_rod_under_its_own_weight() {
    for row in OWN_WEIGHT {
        check(&Rod { weight: row[0], ..Rod::level(INTERNODES) }, row);
    }
}

#[test]
fn a_rod_at_45_degrees_under_its_own_weight() {
    for row in OWN_WEIGHT_FROM_45_DEGREES {
        check(&Rod { weight: row[0], insertion: std::f64::consts::FRAC_PI_4, ..Rod::level(INTERNODES) }, row);
    }
}

#[test]
fn the_moment_at_the_clamp_is_the_load_times_its_arm() {
    for [load, ..] in TIP_LOAD {
        let (plant, _) = Rod { tip: load, ..Rod::level(INTERNODES) }.bent();
        let arm = tip(&plant).0;
        assert!((base_curvature(&plant) - load * arm).abs() < TOLERANCE * load.max(1.0), "load {load}");
    }
}

#[test]
fn the_shape_does_not_depend_on_how_the_load_came() {
    let at_once = Rod { tip: 5.0, ..Rod::level(100) };
    let (whole, _) = at_once.bent();
    let mut plant = Rod { tip: 0.5, ..Rod::level(100) }.plant();
    let mut scratch = Scratch::default();
    for step in 1..=10 {
        plant.organs.area[0] = 0.5 * step as f32;
        assert!(bend(&mut plant, 1, &unit_gravity(), &mut scratch).settled);
    }
    let ((x, z), (slow_x, slow_z)) = (tip(&whole), tip(&plant));
    assert!((x - slow_x).abs() < 1e-5 && (z - slow_z).abs() < 1e-5, "{x} {z}, {slow_x} {slow_z}");
}
