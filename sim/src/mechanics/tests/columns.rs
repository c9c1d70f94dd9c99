//! Greenhill 1881: the height at which a column buckles under its own weight, for radii that fall as a power of the
//! distance to the top. λ = ρ g A₀ L³ / (E I₀) at the limit.
//!
//! Absent: the deflection of rods that hold (`small`, `elastica`).

use super::*;

const INTERNODES: u32 = 400;

fn holds(taper: fn(f64) -> f64, load: f64) -> bool {
    Rod { weight: load, insertion: 0.0, taper, ..Rod::level(INTERNODES) }.bent().1.yields.is_none()
}

/// The load at which the column buckles, by bisection.
fn limit(taper: fn(f64) -> f64) -> f64 {
    let (mut stands, mut falls) = (1.0, 100.0);
    assert!(holds(taper, stands) && !holds(taper, falls));
    while falls - stands > 1e-3 {
        let load = 0.5 * (stands + falls);
        if holds(taper, load) { stands = load } else { falls = load }
    }
    stands
}

#[test]
fn columns_buckle_at_greenhills_height() {
    let columns: [(&str, Taper, f64); 5] = [
        ("0", |_| 1.0, 7.837347),
        ("1/4", |s| pow(1.0 - s, 0.25), 13.554342),
        ("1/2", |s| pow(1.0 - s, 0.5), 19.739209),
        ("2/3", |s| pow(1.0 - s, 2.0 / 3.0), 23.790230),
        ("1", |s| 1.0 - s, 30.529849),
    ];
    for (n, taper, lambda) in columns {
        // The critical length is as the cube root of λ; the bound is 1 % of the length.
        let ratio = crate::math::cbrt(limit(taper) / lambda);
        assert!((ratio - 1.0).abs() < 0.01, "n = {n}: {ratio} of the critical length");
    }
}

#[test]
fn a_column_that_buckles_is_reported_and_finds_a_shape_that_holds() {
    let slightly_off = Rod { weight: 12.0, insertion: 1e-3, ..Rod::level(100) };
    let (plant, outcome) = slightly_off.bent();
    assert!(outcome.yields.is_some() && outcome.settled, "{outcome:?}");
    let events = plant.events.as_ref().expect("events are kept");
    assert!(events.iter().any(|event| event.kind == EventKind::Buckled && event.tick == 1));
    let (x, z) = tip(&plant);
    assert!(x > 0.3 && z < 0.9, "it hangs over: {x} {z}");
    assert!(plant.frames.base.iter().flatten().all(|x| x.is_finite()));
}

#[test]
fn an_absurd_load_is_reported_and_never_nan() {
    for (weight, insertion) in [(1e6, 0.3), (1e12, 1.5), (1e6, 0.0), (1e30, 1.0)] {
        let (plant, outcome) = Rod { weight, insertion, ..Rod::level(30) }.bent();
        let events = plant.events.as_ref().expect("events are kept");
        assert!(outcome.settled || events.iter().any(|event| event.kind == EventKind::Unsettled), "{weight}");
        assert!(plant.frames.base.iter().flatten().all(|x| x.is_finite()), "{weight} {insertion}");
        assert!(plant.strain.curvature.iter().flatten().all(|x| x.is_finite()), "{weight} {insertion}");
        assert!(plant.strain.moment.iter().flatten().all(|x| x.is_finite()), "{weight} {insertion}");
    }
}
