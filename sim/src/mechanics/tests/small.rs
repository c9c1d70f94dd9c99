//! Small deflections: the closed forms of Euler–Bernoulli beams, uniform and tapered, and second-order convergence.
//!
//! Absent: large deflections (`elastica`).

use super::*;

/// A load small enough for the linear theory, which leaves out the square of the deflection, and large enough for the
/// single precision of the clamp's angle, 4e-8 rad.
const SMALL: f64 = 1e-2;

/// The tolerance, with the number of internodes.
const TOLERANCE: f64 = 1e-3;
const INTERNODES: u32 = 200;

fn drop_of(rod: &Rod) -> f64 {
    -tip(&rod.bent().0).1
}

fn check(name: &str, rod: &Rod, expected: f64) {
    let drop = drop_of(rod);
    assert!((drop / expected - 1.0).abs() < TOLERANCE, "{name}: {drop}, not {expected}");
}

#[test]
fn uniform_rods() {
    check("w L⁴ / 8 E I", &Rod { weight: SMALL, ..Rod::level(INTERNODES) }, SMALL / 8.0);
    check("P L³ / 3 E I", &Rod { tip: SMALL, ..Rod::level(INTERNODES) }, SMALL / 3.0);
}

#[test]
fn rods_of_linear_taper() {
    let tapers: [(f64, Taper); 3] = [(0.25, |s| 1.0 - 0.75 * s), (0.5, |s| 1.0 - 0.5 * s), (0.8, |s| 1.0 - 0.2 * s)];
    for (tau, taper) in tapers {
        let own = (1.0 + 2.0 * tau) / 24.0 * SMALL;
        check("own weight", &Rod { weight: SMALL, taper, ..Rod::level(INTERNODES) }, own);
        check("tip load", &Rod { tip: SMALL, taper, ..Rod::level(INTERNODES) }, SMALL / (3.0 * tau));
    }
}

#[test]
fn rods_whose_radius_is_a_power_of_the_distance_to_the_tip() {
    let powers: [(f64, Taper); 4] = [
        (0.25, |s| pow(1.0 - s, 0.25)),
        (0.5, |s| pow(1.0 - s, 0.5)),
        (0.75, |s| pow(1.0 - s, 0.75)),
        (1.0, |s| 1.0 - s),
    ];
    for (n, taper) in powers {
        let expected = SMALL / ((2.0 * n + 1.0) * (2.0 * n + 2.0) * (4.0 - 2.0 * n));
        check("own weight", &Rod { weight: SMALL, taper, ..Rod::level(INTERNODES) }, expected);
    }
}

#[test]
fn the_error_falls_with_the_square_of_the_number_of_internodes() {
    // Large deflections, so that the order is that of the whole scheme; drop of the elastica for a load of 2.
    let error = |internodes| (drop_of(&Rod { tip: 2.0, ..Rod::level(internodes) }) - 0.4934574804).abs();
    for (few, many) in [(5, 10), (10, 20), (20, 40)] {
        let order = crate::math::log2(error(few) / error(many));
        assert!((1.8..2.2).contains(&order), "{few} to {many} internodes: order {order}");
    }
}
