//! New wood is laid free of stress on the bent shape, so that the shape is frozen in as the wood thickens.
//!
//! A rod is loaded, thickens and is unloaded; the curvature that remains has a closed form. Absent: righting (`habit`).

use super::*;
use std::f64::consts::PI;

fn set_diameter(plant: &mut Plant, diameter: f64) {
    plant.nodes.diameter.fill(diameter as f32);
    plant.nodes.diameter_tip.fill(diameter as f32);
}

#[test]
fn a_load_taken_off_twice_as_thick_wood_leaves_15_16_of_its_curvature() {
    let rod = Rod { tip: 1e-3, ..Rod::level(50) };
    let (mut plant, mut scratch) = (rod.plant(), Scratch::default());
    bend(&mut plant, 1, &unit_gravity(), &mut scratch);
    let loaded = plant.strain.curvature.clone();
    set_diameter(&mut plant, 2.0 * rod.diameter);
    bend(&mut plant, 2, &unit_gravity(), &mut scratch);
    plant.organs.death[0] = 3;
    bend(&mut plant, 3, &unit_gravity(), &mut scratch);
    for (node, (before, after)) in loaded.iter().zip(&plant.strain.curvature).enumerate() {
        let share = f64::from(after[1]) / f64::from(before[1]);
        assert!((share - 15.0 / 16.0).abs() < 1e-5, "internode {node}: {share}");
        assert!(plant.strain.moment_of(node) < 1e-9);
    }
}

#[test]
fn a_load_that_falls_from_wood_that_did_not_thicken_leaves_nothing() {
    let (mut plant, mut scratch) = (Rod { tip: 2.0, ..Rod::level(50) }.plant(), Scratch::default());
    bend(&mut plant, 1, &unit_gravity(), &mut scratch);
    assert!(tip(&plant).1 < -0.4);
    plant.organs.death[0] = 2;
    bend(&mut plant, 2, &unit_gravity(), &mut scratch);
    assert!(tip(&plant).1.abs() < 1e-5, "{:?}", tip(&plant));
}

/// With the moment c r² of wood that thickens under its own weight, dκ = dM / (E I) sums to (4 c / π E) (1/r₀² − 1/r²).
#[test]
fn wood_that_thickens_under_its_own_weight() {
    let (weight, grown) = (1e-4, 3.0);
    let error = |ticks: u32| {
        let rod = Rod { weight, ..Rod::level(20) };
        let (mut plant, mut scratch) = (rod.plant(), Scratch::default());
        bend(&mut plant, 1, &unit_gravity(), &mut scratch);
        let first = f64::from(plant.strain.curvature_of(0));
        for tick in 1..=ticks {
            set_diameter(&mut plant, rod.diameter * (1.0 + (grown - 1.0) * f64::from(tick) / f64::from(ticks)));
            bend(&mut plant, 1 + tick, &unit_gravity(), &mut scratch);
        }
        let modulus = rod.flexural / (PI / 64.0 * pow(rod.diameter, 4.0));
        let radius = rod.diameter / 2.0;
        let per_square = first * rod.flexural / (radius * radius);
        let gained = 4.0 * per_square / (PI * modulus) * (1.0 - 1.0 / (grown * grown)) / (radius * radius);
        (f64::from(plant.strain.curvature_of(0)) - first) / gained - 1.0
    };
    let (coarse, fine) = (error(200), error(400));
    assert!(fine.abs() < 1e-2, "{fine}");
    // The rule dκ = dM / (E I(t)) takes the stiffness at the end of the tick: first order in the tick.
    assert!((1.8..2.2).contains(&(coarse / fine)), "{coarse} {fine}");
}
