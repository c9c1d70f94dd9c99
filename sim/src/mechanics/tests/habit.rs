//! Whole plants: gravity off, wind, righting, and forks in space.
//!
//! Results are compared with sums of torques, with symmetries and with tabled rods. Absent: rods by themselves
//! (`small`, `elastica`).

use super::*;
use crate::pose::pose;
use crate::site::Wind;

/// A trunk with a branch on every node, each turned on from the last, so that loads twist and bend in space.
fn bush() -> Plant {
    let rod = Rod { weight: 0.8, insertion: 0.2, ..Rod::level(12) };
    let mut plant = rod.plant();
    for rank in 0..10 {
        let axis = add_axis(&mut plant, Some(NodeId(rank)), 1.0);
        plant.axes.azimuth[axis.index()] = rank as f32 * 2.4;
        let nodes: Vec<_> = (0..6).map(|_| add_node(&mut plant, axis, 0.08, 0.012)).collect();
        add_leaf(&mut plant, nodes[5], 0.05);
    }
    plant
}

#[test]
fn without_gravity_every_frame_is_that_at_rest_bit_for_bit() {
    let (mut rest, mut still) = (bush(), bush());
    pose(&mut rest, 1);
    bend(&mut still, 1, &Site { gravity: 0.0, ..Site::default() }, &mut Scratch::default());
    assert_eq!(rest.frames.base, still.frames.base);
    assert_eq!(rest.frames.heading, still.frames.heading);
    assert_eq!(rest.frames.up, still.frames.up);
}

#[test]
fn in_equilibrium_the_moments_are_those_of_the_shape() {
    let mut plant = bush();
    let outcome = bend(&mut plant, 1, &unit_gravity(), &mut Scratch::default());
    assert!(outcome.settled && outcome.yields.is_none(), "{outcome:?}");
    let frame = crate::pose::node_frame(&plant, NodeId(0));
    let clamp = [0, 2].map(|k| f64::from(plant.frames.base[0][k] + frame.base[k]) * 0.5);
    // Every weight beyond the middle of the first internode, times its horizontal arm, across the heading.
    let mut torque = [0.0; 2];
    let mut pull = |x: f64, y: f64, weight: f64| {
        torque[0] += -y * weight;
        torque[1] += (x - clamp[0]) * weight;
    };
    for node in 0..plant.nodes.len() {
        let weight = 0.8 * wood_volume(&plant, NodeId(node as u32)) / (std::f64::consts::PI / 4.0 * 0.02 * 0.02);
        let (weight, arm) = if node == 0 { (weight * 0.5, 0.75) } else { (weight, 0.5) };
        let at = plant.frames.at(NodeId(node as u32)).advanced(plant.nodes.length[node] * arm);
        pull(f64::from(at.base[0]), f64::from(at.base[1]), weight);
    }
    for organ in 0..plant.organs.len() {
        let at = crate::pose::node_frame(&plant, plant.organs.node[organ]);
        pull(f64::from(at.base[0]), f64::from(at.base[1]), f64::from(plant.organs.area[organ]));
    }
    let heading = plant.frames.heading[0].map(f64::from);
    let along = torque[0] * heading[0] + torque[1] * heading[1];
    let across = (torque[0] * torque[0] + torque[1] * torque[1] - along * along).sqrt();
    let held = f64::from(plant.strain.moment_of(0));
    assert!((held / across - 1.0).abs() < 1e-3, "{held}, not {across}");
}

#[test]
fn growth_in_either_order_bends_alike() {
    // The same bush with its nodes in another order: the trunk's last nodes after the branches.
    let rod = Rod { weight: 0.8, insertion: 0.2, ..Rod::level(12) };
    let mut other = rod.plant();
    let (mut tips, mut plant) = (Vec::new(), bush());
    for rank in 0..10 {
        let axis = add_axis(&mut other, Some(NodeId(rank)), 1.0);
        other.axes.azimuth[axis.index()] = rank as f32 * 2.4;
        tips.push(axis);
    }
    let mut last = Vec::new();
    for _ in 0..6 {
        last = tips.iter().map(|&axis| add_node(&mut other, axis, 0.08, 0.012)).collect();
    }
    last.into_iter().for_each(|node| add_leaf(&mut other, node, 0.05));
    for plant in [&mut plant, &mut other] {
        assert!(bend(plant, 1, &unit_gravity(), &mut Scratch::default()).settled);
    }
    for axis in 0..plant.axes.len() {
        let at = |plant: &Plant| crate::pose::bud_frame(plant, AxisId(axis as u32)).base;
        let (one, two) = (at(&plant), at(&other));
        assert!((0..3).all(|k| (one[k] - two[k]).abs() < 1e-5), "axis {axis}: {one:?} {two:?}");
    }
}

#[test]
fn a_calm_day_is_a_day_without_wind() {
    let (mut calm, mut none) = (bush(), bush());
    let towards_somewhere = Site { wind: Wind { speed: 0.0, towards: 1.0 }, ..unit_gravity() };
    bend(&mut calm, 1, &towards_somewhere, &mut Scratch::default());
    bend(&mut none, 1, &unit_gravity(), &mut Scratch::default());
    assert_eq!(calm.frames.base, none.frames.base);
    assert_eq!(calm.strain.curvature, none.strain.curvature);
}

/// A level tip load and the same force as wind on an upright rod are one problem, turned by 90°.
#[test]
fn wind_bends_as_weight_does() {
    let drag = Drag { coefficient: 0.8, exponent: 0.5 };
    let mut rod = Rod { insertion: 0.0, diameter: 1e-6, ..Rod::level(200) };
    rod.tip = 1.0;
    let speed = 9.0;
    let force = 0.5 * crate::site::AIR_DENSITY * 0.8 / 3.0 * speed * speed;
    let mut plant = rod.plant();
    let wood = Wood { drag, ..rod.wood() };
    plant.habit = Arc::new(Habit { wood: Some(wood), ..(*plant.habit).clone() });
    let area = 2.0 / force;
    plant.organs.area[0] = area as f32;
    let site = Site { gravity: 0.0, wind: Wind { speed, towards: 0.0 }, ..Site::default() };
    assert!(bend(&mut plant, 1, &site, &mut Scratch::default()).settled);
    // The elastica under a tip load of 2: drop 0.4934574804, reach 0.8393582792.
    let (x, z) = tip(&plant);
    assert!((x - 0.4934574804).abs() < 1e-4 && (z - 0.8393582792).abs() < 1e-4, "{x} {z}");
}

#[test]
fn a_young_shoot_turns_to_its_direction_at_the_stated_rate() {
    let rod = Rod { insertion: 1.2, ..Rod::level(20) };
    let mut wood = rod.wood();
    wood.tissues[0].uprighting = Uprighting { rate: 0.01, young: u32::MAX, ..Uprighting::default() };
    let mut plant = rod.plant();
    plant.habit = Arc::new(Habit { wood: Some(wood), ..(*plant.habit).clone() });
    let mut scratch = Scratch::default();
    bend(&mut plant, 1, &unit_gravity(), &mut scratch);
    let expected = 0.01 * crate::math::sin(1.2);
    for node in 0..20 {
        assert!((f64::from(plant.strain.curvature_of(node)) - expected).abs() < 1e-6, "internode {node}");
    }
    assert!(tip(&plant).1 > crate::math::cos(1.2), "upwards");
}

#[test]
fn reaction_wood_rights_a_stem_by_the_strain_of_its_rings() {
    let rod = Rod { insertion: 0.5, ..Rod::level(20) };
    let mut wood = rod.wood();
    wood.tissues[0].uprighting = Uprighting { strain: 1e-4, ..Uprighting::default() };
    let mut plant = rod.plant();
    plant.habit = Arc::new(Habit { wood: Some(wood), ..(*plant.habit).clone() });
    let mut scratch = Scratch::default();
    scratch.remember(&plant);
    plant.nodes.diameter.fill(0.03);
    plant.nodes.diameter_tip.fill(0.03);
    bend(&mut plant, 2, &unit_gravity(), &mut scratch);
    let expected = 2.0 * 1e-4 * (1.0 / 0.01 - 1.0 / 0.015) * crate::math::sin(0.5);
    let curvature = f64::from(plant.strain.curvature_of(0));
    assert!((curvature / expected - 1.0).abs() < 1e-4, "{curvature}, not {expected}");
    assert!(tip(&plant).1 > crate::math::cos(0.5), "upwards");
}

/// The bush, windy.
fn windy() -> Plant {
    let mut plant = bush();
    let mut wood = plant.habit.wood.clone().expect("it has wood");
    wood.drag = Drag { coefficient: 0.8, exponent: 0.5 };
    plant.habit = Arc::new(Habit { wood: Some(wood), ..(*plant.habit).clone() });
    plant
}

#[test]
fn a_frame_of_calm_moves_nothing_and_one_of_wind_moves_about_its_steady_shape() {
    let (mut plant, mut scratch) = (windy(), Scratch::default());
    bend(&mut plant, 1, &unit_gravity(), &mut scratch);
    let stood = plant.clone();
    sway::sway(&mut plant, 1, &unit_gravity(), Wind::default(), 0.4, &mut scratch).expect("it can sway");
    assert_eq!(stood.frames.base, plant.frames.base);
    assert_eq!(stood.strain.curvature, plant.strain.curvature);

    let wind = Wind { speed: 4.0, towards: 0.0 };
    let mut leaning = stood.clone();
    bend(&mut leaning, 1, &Site { wind, ..unit_gravity() }, &mut scratch);
    let frames = 4000;
    let (mut mean, mut least, mut most) = (0.0, f64::MAX, f64::MIN);
    for frame in 0..frames / 100 {
        let mut swaying = stood.clone();
        let time = f64::from(frame) * sway::GUSTS_S * 100.0 / f64::from(frames);
        sway::sway(&mut swaying, 1, &unit_gravity(), wind, time, &mut scratch).expect("it can sway");
        let x = tip(&swaying).0;
        mean += x * 100.0 / f64::from(frames);
        (least, most) = (least.min(x), most.max(x));
    }
    let (still, steady) = (tip(&stood).0, tip(&leaning).0);
    assert!(steady > still + 1e-3, "the wind leans it over: {still} {steady}");
    assert!(most > least + 1e-4, "it moves: {least} {most}");
    assert!((mean - steady).abs() < (steady - still) * 0.5, "about its steady shape: {mean} {steady}");
}

#[test]
fn the_first_frequency_is_that_of_a_clamped_cylinder() {
    let rod = Rod { weight: 0.3, flexural: 7.0, ..Rod::level(30) };
    let plant = rod.plant();
    let wood = plant.habit.wood.as_ref().expect("it has wood");
    let (modulus, density) = (f64::from(wood.tissues[0].modulus[0]), f64::from(wood.tissues[0].density[0]));
    let expected = sway::CLAMPED_CYLINDER * 0.02 * (modulus / density).sqrt();
    let found = sway::frequencies(&plant, wood, 1)[0];
    assert!((found / expected - 1.0).abs() < 1e-5, "{found}, not {expected}");
}

#[test]
fn what_has_no_wood_or_no_drag_does_not_sway() {
    let (mut plant, wind) = (bush(), Wind { speed: 4.0, towards: 0.0 });
    let moved = sway::sway(&mut plant, 1, &unit_gravity(), wind, 0.0, &mut Scratch::default());
    assert_eq!(moved, Err(sway::Unmoved::NoDrag));
    plant.habit = Arc::new(Habit { wood: None, ..(*plant.habit).clone() });
    let moved = sway::sway(&mut plant, 1, &unit_gravity(), wind, 0.0, &mut Scratch::default());
    assert_eq!(moved, Err(sway::Unmoved::Stiff));
}

#[test]
fn a_settled_plant_stays_where_it_is() {
    let (mut plant, mut scratch) = (bush(), Scratch::default());
    let outcome = bend(&mut plant, 1, &unit_gravity(), &mut scratch);
    assert!(outcome.settled && (2..MOST_STEPS).contains(&outcome.steps), "{outcome:?}");
    let stood: Vec<_> =
        (0..plant.axes.len()).map(|axis| crate::pose::bud_frame(&plant, AxisId(axis as u32)).base).collect();
    let again = bend(&mut plant, 1, &unit_gravity(), &mut scratch);
    assert_eq!((again.steps, again.settled), (1, true), "{again:?}");
    // What the tolerance left is far below it: the steps converge faster than linearly.
    for (axis, stood) in stood.iter().enumerate() {
        let stands = crate::pose::bud_frame(&plant, AxisId(axis as u32)).base;
        let moved = (0..3).map(|k| f64::from((stands[k] - stood[k]).abs())).fold(0.0, f64::max);
        assert!(moved < SETTLED * 0.1, "axis {axis} moved by {moved} m");
    }
}

/// A fruit weighs as the ellipsoid of its length and width, bends its branch while it hangs, and lets it go when it
/// falls.
#[test]
fn a_branch_springs_back_when_its_fruit_falls() {
    let rod = Rod { flexural: 0.01, ..Rod::level(40) };
    let mut plant = rod.plant();
    let mut wood = rod.wood();
    wood.organs.fruit = 1000.0;
    plant.habit = Arc::new(Habit { wood: Some(wood), ..(*plant.habit).clone() });
    add_leaf(&mut plant, NodeId(39), 0.0);
    (plant.organs.kind[0], plant.organs.length[0], plant.organs.width[0]) = (Kind::Fruit, 0.03, 0.02);
    (plant.organs.birth[0], plant.organs.death[0]) = (2, 3);
    let weight = 1000.0 * std::f64::consts::PI / 6.0 * 0.03 * 0.02 * 0.02;
    let mut scratch = Scratch::default();
    bend(&mut plant, 1, &unit_gravity(), &mut scratch);
    assert!(tip(&plant).1.abs() < 1e-6, "not yet");
    bend(&mut plant, 2, &unit_gravity(), &mut scratch);
    let base = f64::from(plant.strain.moment_of(0)) / (tip(&plant).0 - 0.5 / 40.0);
    assert!((base / weight - 1.0).abs() < 1e-3, "{base}, not {weight}");
    assert!(tip(&plant).1 < -0.05, "it hangs");
    bend(&mut plant, 3, &unit_gravity(), &mut scratch);
    assert!(tip(&plant).1.abs() < 1e-5, "it springs back, for no wood was laid meanwhile");
}
