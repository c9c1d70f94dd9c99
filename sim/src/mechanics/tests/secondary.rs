//! Secondary growth: the quantities that each rule conserves.
//!
//! Sections and powers of diameters are summed over forks; rings are counted by hand. Absent: the model's law of age.

use super::*;
use crate::mechanics::secondary;
use std::f64::consts::PI;

/// A trunk with three branches on its middle node, and leaves.
fn fork(thickening: Thickening) -> Plant {
    let rod = Rod { diameter: 0.004, ..Rod::level(6) };
    let mut plant = rod.plant();
    let wood = Wood { thickening, ..rod.wood() };
    plant.habit = Arc::new(Habit { wood: Some(wood), ..(*plant.habit).clone() });
    for (branch, diameter) in [0.003, 0.005, 0.002].into_iter().enumerate() {
        let axis = add_axis(&mut plant, Some(NodeId(2)), 1.0);
        let nodes: Vec<_> = (0..3).map(|_| add_node(&mut plant, axis, 0.1, diameter)).collect();
        (0..=branch).for_each(|_| add_leaf(&mut plant, nodes[2], 0.01));
    }
    plant
}

fn grow_thick(plant: &mut Plant, age: u32, scratch: &mut Scratch) {
    secondary::thicken(plant, age, plant.habit.thickening(), scratch);
}

fn power(plant: &Plant, node: usize, exponent: f64) -> f64 {
    pow(f64::from(plant.nodes.diameter[node]), exponent)
}

#[test]
fn at_a_fork_the_powers_of_the_diameters_add_up() {
    for exponent in [2.0, 2.3, 3.0] {
        let mut plant = fork(Thickening::DaVinci { exponent });
        grow_thick(&mut plant, 1, &mut Scratch::default());
        let above: f64 = [3, 6, 9, 12].iter().map(|&node| power(&plant, node, exponent)).sum();
        let below = power(&plant, 2, exponent);
        assert!((below / above - 1.0).abs() < 1e-6, "Δ = {exponent}: {below}, not {above}");
        assert!(plant.nodes.diameter[0] == plant.nodes.diameter[2], "a stem without forks keeps its diameter");
    }
}

#[test]
fn with_an_exponent_of_2_the_sections_add_up() {
    let mut plant = fork(Thickening::DaVinci { exponent: 2.0 });
    grow_thick(&mut plant, 1, &mut Scratch::default());
    let expected = 0.004 * 0.004 + 0.003 * 0.003 + 0.005 * 0.005 + 0.002 * 0.002;
    assert!((power(&plant, 0, 2.0) / expected - 1.0).abs() < 1e-6);
}

#[test]
fn a_pipe_for_each_leaf_above() {
    let mut plant = fork(Thickening::Pipe { per_leaf: 1e-6, living: false });
    plant.organs.death[0] = 1;
    grow_thick(&mut plant, 1, &mut Scratch::default());
    let section = PI / 4.0 * power(&plant, 0, 2.0);
    assert!((section / (PI / 4.0 * 0.004 * 0.004 + 6e-6) - 1.0).abs() < 1e-6);

    let mut plant = fork(Thickening::Pipe { per_leaf: 1e-6, living: true });
    plant.organs.death[0] = 1;
    grow_thick(&mut plant, 1, &mut Scratch::default());
    let first = PI / 4.0 * power(&plant, 0, 2.0);
    assert!((first / (PI / 4.0 * 0.004 * 0.004 + 5e-6) - 1.0).abs() < 1e-6);
    plant.organs.death.fill(2);
    grow_thick(&mut plant, 2, &mut Scratch::default());
    assert_eq!(first, PI / 4.0 * power(&plant, 0, 2.0), "the pipes of fallen leaves stay");
}

#[test]
fn a_ring_a_tick_and_a_section_for_the_foliage() {
    let mut plant = fork(Thickening::Rings { width: 0.001, per_foliage: 1e-4 });
    let mut scratch = Scratch::default();
    for age in 1..=4 {
        grow_thick(&mut plant, age, &mut scratch);
    }
    // Born at 1: three ticks of rings on an axis that lives; leaves above the first internode: 6 of 0.01 m².
    let mut diameter = 0.004_f64;
    for _ in 0..3 {
        diameter = (diameter * diameter + 4.0 / PI * 0.06 * 1e-4).sqrt() + 0.002;
    }
    assert!((f64::from(plant.nodes.diameter[0]) / diameter - 1.0).abs() < 1e-6);
    assert!((plant.nodes.diameter[5] - 0.010).abs() < 1e-8, "no leaf above the tip");
}

/// A leaf counts as far as it has expanded: not at all at its birth, a quarter of its area when half as long and wide.
#[test]
fn rings_follow_the_area_that_leaves_have_at_their_age() {
    let mut plant = fork(Thickening::Rings { width: 0.0, per_foliage: 1e-4 });
    let leaf = OrganLook { expansion: vec![0.0, 0.0, 0.5, 1.0], ..OrganLook::default() };
    let organs = vec![OrganLooks { leaf, ..OrganLooks::default() }];
    let looks = Looks { organs, ..plant.habit.looks.clone() };
    plant.habit = Arc::new(Habit { looks, ..(*plant.habit).clone() });
    let mut scratch = Scratch::default();
    let mut squares = (2..=4).map(|age| {
        grow_thick(&mut plant, age, &mut scratch);
        power(&plant, 0, 2.0)
    });
    // Six leaves of 0.01 m², born at 1.
    let (unfolding, half, whole) = (squares.next(), squares.next(), squares.next());
    assert_eq!(unfolding, Some(f64::from(0.004_f32) * f64::from(0.004_f32)), "no leaf area, no wood");
    let ring = 4.0 / PI * 0.06 * 1e-4;
    let near = |found: Option<f64>, expected: f64| found.is_some_and(|found| (found / expected - 1.0).abs() < 1e-6);
    assert!(near(half, 0.004 * 0.004 + 0.25 * ring), "{half:?}");
    assert!(near(whole, 0.004 * 0.004 + 1.25 * ring), "{whole:?}");
}
