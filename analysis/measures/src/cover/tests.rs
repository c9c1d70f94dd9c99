//! The union of discs against closed forms, against lines, and against counts of a plain grid of points.
//!
//! Absent: plants, which `measure` reads.

use super::{Direction, Disc, area, area_by_lines};
use phytomer_sim::key::LineageKey;
use phytomer_sim::math::acos;
use phytomer_sim::random::{PlantRandom, Purpose};
use std::f64::consts::PI;

fn disc(x: f64, y: f64, radius: f64) -> Disc {
    Disc { centre: [x, y], radius }
}

#[track_caller]
fn is(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-12 * expected.abs().max(1.0), "{found} {expected}");
}

/// Discs drawn in a square of this side.
fn drawn(count: usize, side: f64, radius: impl Fn(f64) -> f64, seed: u64) -> Vec<Disc> {
    let mut draws = PlantRandom::new(17, seed).stream(LineageKey(1), Purpose::Resampling);
    let mut share = || draws.share();
    (0..count).map(|_| disc(side * share(), side * share(), radius(share()))).collect()
}

/// Two unit discs at a distance d have 2π − 2 acos(d/2) + d √(1 − d²/4) together.
#[test]
fn two_unit_discs() {
    is(area(&[disc(0.0, 0.0, 1.0), disc(1.0, 0.0, 1.0)]), 5.054_815_608_570_83);
    for d in [1e-9, 0.1, 0.5, 1.0, 1.7, 2.0 - 1e-12, 2.0, 2.1, 9.0] {
        let expected = match d {
            d if d < 2.0 => 2.0 * PI - 2.0 * acos(d / 2.0) + d * (1.0 - d * d / 4.0_f64).sqrt(),
            _ => 2.0 * PI,
        };
        for [x, y] in [[1.0, 0.0], [0.0, 1.0], [-0.6, 0.8], [-1.0, 0.0], [0.28, -0.96]] {
            let found = area(&[disc(3.0, -2.0, 1.0), disc(3.0 + d * x, d * y - 2.0, 1.0)]);
            assert!((found - expected).abs() < 1e-7, "{d} along {x}, {y}: {found} {expected}");
        }
    }
}

/// A disc within another, equal discs, discs that touch, a ring of discs with a hole, and nothing at all.
#[test]
fn discs_within_others_equal_discs_and_holes() {
    is(area(&[]), 0.0);
    is(area(&[disc(0.0, 0.0, 2.0), disc(0.5, 0.5, 1.0), disc(-1.0, 0.0, 1.0), disc(1.0, 0.0, 0.3)]), 4.0 * PI);
    is(area(&[disc(1.0, 1.0, 1.0); 7]), PI);
    is(area(&[disc(0.0, 0.0, 1.0), disc(3.0, 0.0, 2.0)]), 5.0 * PI);
    // Four unit discs at the corners of a square of side √2 meet in its middle alone: beside each side two of them
    // share a lens of π/2 − 1.
    let half = 0.5_f64.sqrt();
    let corners = [[half, half], [half, -half], [-half, -half], [-half, half]].map(|[x, y]| disc(x, y, 1.0));
    is(area(&corners), 4.0 * PI - 4.0 * (PI / 2.0 - 1.0));
    // Further apart they leave a hole: four lenses of discs that are 1.8 apart.
    let apart = [[0.9, 0.9], [0.9, -0.9], [-0.9, -0.9], [-0.9, 0.9]].map(|[x, y]| disc(x, y, 1.0));
    let lens = 2.0 * acos(0.9) - 1.8 * (1.0 - 0.81_f64).sqrt();
    is(area(&apart), 4.0 * PI - 4.0 * lens);
    for nothing in [disc(0.0, 0.0, 0.0), disc(0.0, 0.0, -1.0), disc(f64::NAN, 0.0, 1.0), disc(0.0, 0.0, f64::INFINITY)]
    {
        is(area(&[nothing, disc(9.0, 0.0, 1.0)]), PI);
        is(area_by_lines(&[nothing], 0.1), 0.0);
    }
    is(area(&[disc(1e308, 0.0, 1.0), disc(0.0, 0.0, f64::MAX)]), 0.0);
}

/// Where the discs lie and in which order they come tells nothing; all of it larger is larger by the square.
#[test]
fn places_order_and_size() {
    let discs = drawn(400, 10.0, |share| 0.05 + share, 1);
    let whole = area(&discs);
    let reversed: Vec<Disc> = discs.iter().rev().copied().collect();
    let far: Vec<Disc> = discs.iter().map(|d| disc(d.centre[0] + 4e5, d.centre[1] - 7e5, d.radius)).collect();
    let wide: Vec<Disc> = discs.iter().map(|d| disc(1e3 * d.centre[0], 1e3 * d.centre[1], 1e3 * d.radius)).collect();
    assert!((area(&reversed) - whole).abs() < 1e-11 * whole);
    assert!((area(&far) - whole).abs() < 1e-7 * whole, "{} {whole}", area(&far));
    assert!((area(&wide) - 1e6 * whole).abs() < 1e-11 * 1e6 * whole);
}

/// Radii that differ by factors of a million: a fine dust beside wide discs, and within them.
#[test]
fn radii_that_differ() {
    let mut discs = drawn(2000, 40.0, |share| phytomer_sim::math::pow(10.0, -5.0 + 6.0 * share), 2);
    let whole = area(&discs);
    assert!((area_by_lines(&discs, 1e-3) - whole).abs() < 1e-4 * whole, "{whole}");
    discs.push(disc(20.0, 20.0, 500.0));
    is(area(&discs), PI * 500.0 * 500.0);
}

/// The tips of Aucuba as the printed equations of GMT1 place them without a divergence, h 27° and −37°, ratio .786,
/// level 6.
fn aucuba() -> Vec<[f64; 3]> {
    let mut branches = vec![([0.0; 3], [0.0, 0.0, 1.0])];
    for _ in 0..6 {
        let children = branches.iter().flat_map(|(from, to): &([f64; 3], [f64; 3])| {
            let [u, v, w] = [0, 1, 2].map(|i| to[i] - from[i]);
            let (flat, t) = ((u * u + v * v).sqrt(), (u * u + v * v + w * w).sqrt());
            // The first two lie in the plane of x and z.
            let left = if flat < 1e-12 { [-1.0, 0.0] } else { [-v / flat, u / flat] };
            let tip = move |h: f64| {
                let (sin, cos) = phytomer_sim::math::sincos(h.to_radians());
                let across = [t * left[0] * sin, t * left[1] * sin, 0.0];
                let along = [u * cos, v * cos, w * cos];
                (*to, [0, 1, 2].map(|i| to[i] + 0.786 * (along[i] + across[i])))
            };
            [tip(27.0), tip(-37.0)]
        });
        branches = children.collect();
    }
    branches.into_iter().map(|(_, tip)| tip).collect()
}

/// 64 discs of radius .2, from above; the figure is that of an independent program at steps of 10⁻⁴ and less.
#[test]
fn the_leaves_of_aucuba() {
    let discs: Vec<Disc> = aucuba().into_iter().map(|tip| Direction::ABOVE.disc(tip, 0.2)).collect();
    assert_eq!(discs.len(), 64);
    assert!((area(&discs) - 5.322_764).abs() < 5e-7, "{}", area(&discs));
    let errors = [0.04, 0.01, 0.001, 1e-4].map(|step| (area_by_lines(&discs, step) - area(&discs)).abs());
    assert!(errors[1] < 1e-3 && errors.windows(2).all(|pair| pair[1] < pair[0]), "{errors:?}");
}

/// A count of points of a grid is an independent reading; its error is about that of the edge.
#[test]
fn points_of_a_grid_and_lines_say_the_same() {
    for seed in 0..20 {
        let discs = drawn(30, 3.0, |share| 0.1 + 0.4 * share, 10 + seed);
        let exact = area(&discs);
        let side = 5e-3;
        let inside = |x: f64, y: f64| {
            discs.iter().any(|d| {
                (x - d.centre[0]) * (x - d.centre[0]) + (y - d.centre[1]) * (y - d.centre[1]) < d.radius * d.radius
            })
        };
        let points = (-100..700).flat_map(|i| (-100..700).map(move |j| [i, j]));
        let counted = points.filter(|[i, j]| inside(f64::from(*i) * side, f64::from(*j) * side)).count() as f64;
        assert!((counted * side * side - exact).abs() < 0.02, "{counted} {exact}");
        let errors = [0.08, 0.02, 0.005].map(|step| (area_by_lines(&discs, step) - exact).abs());
        assert!(errors[2] < 5e-3 && errors[2] < errors[0], "{errors:?}");
    }
}

/// Lines over one disc: the middle sum of a half circle, whose error falls as the power 3/2 of the step.
#[test]
fn the_error_of_lines_falls_with_the_step() {
    let errors = [0.1, 0.01, 0.001, 1e-4].map(|step| (area_by_lines(&[disc(2.0, 3.0, 1.0)], step) - PI).abs());
    for pair in errors.windows(2) {
        let fall = pair[0] / pair[1];
        assert!((20.0..50.0).contains(&fall), "{errors:?}");
    }
    assert_eq!(area_by_lines(&[disc(0.0, 0.0, 1.0)], 0.0), 0.0);
    assert_eq!(area_by_lines(&[disc(0.0, 0.0, 1.0)], f64::NAN), 0.0);
}

/// From above places are those of the plan; along the sun, heights count by its altitude.
#[test]
fn directions() {
    let leaf = Direction::ABOVE.leaf([1.0, 2.0, 3.0], PI);
    assert_eq!((leaf.centre, leaf.radius), ([1.0, 2.0], 1.0));
    let near = |a: [f64; 2], b: [f64; 2]| assert!((a[0] - b[0]).abs() + (a[1] - b[1]).abs() < 1e-12, "{a:?} {b:?}");
    // In the south at noon: east is to the right, and what is higher or farther north is up.
    let noon = Direction::of_sun(PI / 6.0, PI);
    near(noon.disc([1.0, 0.0, 0.0], 1.0).centre, [1.0, 0.0]);
    near(noon.disc([0.0, 0.0, 1.0], 1.0).centre, [0.0, 0.75_f64.sqrt()]);
    near(noon.disc([0.0, 1.0, 0.0], 1.0).centre, [0.0, 0.5]);
    // What lies along the light is one point.
    let east = Direction::of_sun(PI / 4.0, PI / 2.0);
    near(east.disc([1.0, 0.0, 1.0], 1.0).centre, [0.0, 0.0]);
    let below = [Direction::ABOVE, Direction::of_sun(PI / 2.0, 0.3)].map(|direction| {
        let discs: Vec<Disc> = drawn(50, 2.0, |share| share, 3)
            .iter()
            .map(|d| direction.disc([d.centre[0], d.centre[1], d.radius], 0.2))
            .collect();
        area(&discs)
    });
    assert!((below[0] - below[1]).abs() < 1e-9, "{below:?}");
}
