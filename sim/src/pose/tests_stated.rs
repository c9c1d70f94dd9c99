//! A plant whose rest frames are stated stands as the same plant made by insertion and trend: at rest and bent, to 10⁻⁵
//! m. Also tested are the features of stated frames alone: starts beside the bearer, stems out of the ground, frames
//! that change.
//!
//! Absent: frames of organs (`plant::tests_states`).

use super::specimen::{Branch, Growth, LAST, Specimen};
use super::*;
use crate::mechanics::{OrganMass, Scratch, Tissue, Uprighting, Wood, bend};
use crate::plant::{Habit, NewOrgan, OrganId, Origin, Rest, Trend};
use crate::rotation::Rotation;
use crate::site::{Site, Wind};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

/// The tolerance of a place, metres, and of a component of a unit direction.
const ALIKE: f64 = 1e-5;

fn trends() -> Vec<Trend> {
    [(0.0, 0.0), (0.0, 0.02), (1.4, 0.05), (PI, 0.01)].map(|(inclination, share)| Trend { inclination, share }).to_vec()
}

/// A tree of four orders that leans far from the vertical; the third branch goes on from the tip of the first as a
/// relay does.
fn tree() -> Vec<Branch> {
    let on = |bearer, azimuth, insertion, nodes, length, trends| Branch {
        bearer: Some(bearer),
        azimuth,
        insertion,
        nodes,
        length,
        trends,
    };
    vec![
        Branch { insertion: 1.2, azimuth: 0.4, trends: [1, 3], ..Branch::trunk(300, 0.03) },
        on((0, 120), 1.3, 1.2, 150, 0.02, [2, 1]),
        on((0, 300), 2.0, 0.3, 60, 0.03, [1, 2]),
        on((1, 150), 0.0, 0.0, 40, 0.02, [0, 1]),
        on((1, 40), 4.0, 2.9, 50, 0.01, [3, 3]),
        on((4, 20), 0.7, 0.8, 30, 0.01, [0, 2]),
    ]
}

fn wood() -> Wood {
    let uprighting = Uprighting { strain: 0.0, rate: 0.02, young: 3, ..Uprighting::default() };
    let tissue = Tissue { modulus: vec![9e9], density: vec![900.0], uprighting };
    let organs = OrganMass { leaf: 0.3, ..OrganMass::default() };
    Wood { tissues: vec![tissue], bends: true, organs, ..Wood::default() }
}

fn specimen(growth: Growth, bends: bool) -> Specimen {
    let mut specimen = Specimen::grown(&tree(), &trends(), growth);
    let plant = &mut specimen.plant;
    plant.habit = Arc::new(Habit { wood: bends.then(wood), ..(*plant.habit).clone() });
    for node in 0..plant.nodes.len() {
        let at = NodeId(node as u32);
        (plant.nodes.diameter[node], plant.nodes.diameter_tip[node]) = (0.05, 0.049);
        plant.add_organ(NewOrgan {
            node: at,
            birth: plant.nodes.birth[node],
            length: 0.1,
            width: 0.05,
            area: 0.004,
            azimuth: 1.0,
            insertion: 1.0,
            ..NewOrgan::LEAF
        });
    }
    specimen
}

/// The frame that a node leaves.
fn bearer_of(plant: &Plant, node: usize) -> Frame {
    plant.nodes.parent[node].some().map_or(Frame::GROUND, |parent| node_frame(plant, parent))
}

/// How a frame is turned in that of its bearer.
fn within(bearer: &Frame, frame: &Frame) -> Rotation {
    let [h, up] = [bearer.heading, bearer.up].map(Vector::from);
    let left = up.cross(h);
    let local = |v: [f32; 3]| [h, left, up].map(|axis| axis.dot(Vector::from(v)));
    Rotation::to(local(frame.heading), local(frame.up))
}

/// The same plant, with the frames of `posed` stated for the nodes for which `chosen` returns true.
fn stating(plant: &Plant, posed: &Plant, chosen: impl Fn(usize) -> bool) -> Plant {
    let mut stating = plant.clone();
    for node in (0..plant.nodes.len()).filter(|&node| chosen(node)) {
        let rotation = within(&bearer_of(posed, node), &posed.frames.at(NodeId(node as u32)));
        stating.state_rest(NodeId(node as u32), Rest::Turned(rotation));
        let axis = plant.nodes.axis[node].index();
        // Columns that are not read any more must have no effect.
        if plant.axes.last_node.iter().all(|last| last.index() != node) {
            stating.nodes.trend[node] = 3;
        }
        if plant.nodes.rank[node] == 1 {
            (stating.axes.azimuth[axis], stating.axes.insertion[axis]) = (9.0, 9.0);
        }
    }
    stating
}

fn assert_alike(one: &Plant, other: &Plant) {
    let far = |a: [f32; 3], b: [f32; 3]| (0..3).map(|k| (f64::from(a[k]) - f64::from(b[k])).abs()).fold(0.0, f64::max);
    for node in 0..one.nodes.len() {
        let (a, b) = (one.frames.at(NodeId(node as u32)), other.frames.at(NodeId(node as u32)));
        let apart = far(a.base, b.base).max(far(a.heading, b.heading)).max(far(a.up, b.up));
        assert!(apart < ALIKE, "node {node}: {a:?} {b:?}");
    }
    for organ in (0..one.organs.len() as u32).map(OrganId) {
        let (a, b) = (organ_frame(one, organ, LAST), organ_frame(other, organ, LAST));
        assert!(far(a.base, b.base).max(far(a.heading, b.heading)) < ALIKE, "{organ:?}: {a:?} {b:?}");
    }
}

#[test]
fn stated_frames_stand_as_insertion_and_trend_do() {
    let chosen: [fn(usize) -> bool; 3] = [|_| true, |node| node % 3 == 0, |node| (100..140).contains(&node)];
    for growth in [Growth::AxisByAxis, Growth::TickByTick] {
        let plant = specimen(growth, false).plant;
        let mut posed = plant.clone();
        pose(&mut posed, LAST);
        for chosen in chosen {
            let mut stated = stating(&plant, &posed, chosen);
            // Some nodes keep their own trend where the bearer's frame is stated.
            (0..plant.nodes.len()).filter(|&node| !chosen(node)).for_each(|node| {
                stated.nodes.trend[node] = plant.nodes.trend[node];
            });
            pose(&mut stated, LAST);
            assert_alike(&posed, &stated);
        }
    }
}

#[test]
fn a_plant_of_stated_frames_posed_tick_by_tick_has_the_same_bits() {
    let plant = specimen(Growth::TickByTick, false).plant;
    let mut posed = plant.clone();
    pose(&mut posed, LAST);
    let (mut at_once, mut in_turn) =
        (stating(&plant, &posed, |node| node % 2 == 0), stating(&plant, &posed, |node| node % 2 == 0));
    pose(&mut at_once, LAST);
    let last = plant.nodes.birth.iter().copied().max().unwrap();
    (1..=last).for_each(|age| pose(&mut in_turn, age));
    assert_eq!(at_once.frames.base, in_turn.frames.base);
    assert_eq!(at_once.frames.up, in_turn.frames.up);
}

/// Loads and curvatures with it: bent in gravity and wind, over several ages.
#[test]
fn stated_frames_bend_as_insertion_and_trend_do() {
    let plant = specimen(Growth::TickByTick, true).plant;
    let mut rest = plant.clone();
    pose(&mut rest, LAST);
    let mut stated = stating(&plant, &rest, |_| true);
    let mut trended = plant;
    let (mut scratch, mut other) = (Scratch::default(), Scratch::default());
    let site = Site { wind: Wind { speed: 6.0, towards: 0.5 }, ..Site::default() };
    let mut moved = 0.0_f64;
    for age in [200, 350, 351, LAST] {
        let one = bend(&mut trended, age, &site, &mut scratch);
        assert_eq!(one, bend(&mut stated, age, &site, &mut other));
    }
    assert_alike(&trended, &stated);
    for (a, b) in trended.strain.moment.iter().zip(&stated.strain.moment) {
        (0..2).for_each(|k| assert!((a[k] - b[k]).abs() <= 1e-4 * a[k].abs().max(1.0), "{a:?} {b:?}"));
    }
    for (a, b) in trended.frames.base.iter().zip(&rest.frames.base) {
        moved = moved.max(Vector::from(*a).z - Vector::from(*b).z).max(Vector::from(*b).z - Vector::from(*a).z);
    }
    assert!(moved > 0.05, "it does bend: by {moved} m");
}

/// A chain of 2,000 internodes that turns by the same small rotation each: the closed form of a circle.
#[test]
fn a_long_stated_axis_does_not_drift() {
    let (count, length) = (2000, 0.02);
    let mut plant = Specimen::grown(&[Branch::trunk(count, length as f32)], &[], Growth::AxisByAxis).plant;
    let turn = PI / f64::from(count);
    for node in 0..count {
        let rotation = Rotation::about([0.0, 1.0, 0.0], if node == 0 { 0.0 } else { turn });
        plant.state_rest(NodeId(node), Rest::Turned(rotation));
    }
    pose(&mut plant, LAST);
    let length = f64::from(length as f32);
    let (mut x, mut z) = (0.0, 0.0);
    for node in 0..count {
        let found = plant.frames.base[node as usize].map(f64::from);
        assert!((found[0] + x).abs() < ALIKE && (found[2] - z).abs() < ALIKE, "node {node}: {found:?} {x} {z}");
        let (sin, cos) = crate::math::sincos(turn * f64::from(node));
        (x, z) = (x + sin * length, z + cos * length);
    }
    assert!(x > 12.0);
}

#[test]
fn a_part_begins_where_it_states() {
    let branches = [Branch::trunk(4, 0.5), Branch::on(0, 2), Branch::trunk(3, 0.2)];
    let mut plant = Specimen::grown(&branches, &trends(), Growth::AxisByAxis).plant;
    let (branch, stem) = (AxisId(1), AxisId(2));
    // In the middle of its bearer and out on its surface; a gap in the trunk; a second stem out of the ground.
    plant.state_start(branch, [-0.25, 0.1, 0.0]);
    plant.state_start(NodeId(2), [0.3, 0.0, 0.0]);
    plant.state_start(stem, [0.0, 1.0, 2.0]);
    plant.state_rest(stem, Rest::Turned(Rotation::about([0.0, 1.0, 0.0], FRAC_PI_2)));
    pose(&mut plant, LAST);
    let base = |node: usize| plant.frames.base[node];
    let near = |a: [f32; 3], b: [f32; 3]| assert!((0..3).all(|k| (a[k] - b[k]).abs() < 1e-6), "{a:?} {b:?}");
    let trunk = plant.frames.at(NodeId(1));
    near(trunk.up, [-1.0, 0.0, 0.0]);
    // To the left of a heading along Z with its upper side along −X lies −X × Z = Y.
    near(base(4), [0.0, 0.1, 0.75]);
    near(base(2), [0.0, 0.0, 1.3]);
    near(base(9), [2.0, -1.0, 0.0]);
    // Turned about its left, which is −Y: from Z to −X.
    near(plant.frames.heading[9], [-1.0, 0.0, 0.0]);
    near(start_frame(&plant, stem).base, base(9));
    near(start_frame(&plant, branch).base, base(4));
    near(start_frame(&plant, branch).heading, plant.frames.heading[4]);
}

/// A load on a branch from the middle of the first internode of a rod weighs on the wood below it alone.
#[test]
fn what_begins_low_on_its_bearer_does_not_weigh_on_its_middle() {
    let moment = |along: f32| {
        let branches =
            [Branch { insertion: 1.5, ..Branch::trunk(2, 1.0) }, Branch { nodes: 3, length: 0.5, ..Branch::on(0, 1) }];
        let mut plant = Specimen::grown(&branches, &trends(), Growth::AxisByAxis).plant;
        plant.habit = Arc::new(Habit { wood: Some(wood()), ..(*plant.habit).clone() });
        plant.nodes.diameter.fill(0.2);
        plant.nodes.diameter_tip.fill(0.2);
        plant.state_start(AxisId(1), [along, 0.0, 0.0]);
        bend(&mut plant, LAST, &Site::default(), &mut Scratch::default());
        let [a, b] = plant.strain.moment[0].map(f64::from);
        (a * a + b * b).sqrt()
    };
    let bare = {
        let mut plant =
            Specimen::grown(&[Branch { insertion: 1.5, ..Branch::trunk(2, 1.0) }], &trends(), Growth::AxisByAxis).plant;
        plant.habit = Arc::new(Habit { wood: Some(wood()), ..(*plant.habit).clone() });
        plant.nodes.diameter.fill(0.2);
        plant.nodes.diameter_tip.fill(0.2);
        bend(&mut plant, LAST, &Site::default(), &mut Scratch::default());
        let [a, b] = plant.strain.moment[0].map(f64::from);
        (a * a + b * b).sqrt()
    };
    assert!((moment(-0.9) / bare - 1.0).abs() < 1e-3, "{} {bare}", moment(-0.9));
    assert!(moment(0.0) > 1.2 * moment(-0.3) && moment(-0.3) > 1.2 * bare, "{} {} {bare}", moment(0.0), moment(-0.3));
}

/// A branch from the middle of a bent internode stands where it does on two internodes of half the length: on the
/// chord, turned by half of what the internode turns.
#[test]
fn a_branch_from_the_middle_of_a_bent_internode_stands_between_its_ends() {
    let bent = |branches: &[Branch], start: f32| {
        let mut plant = Specimen::grown(branches, &trends(), Growth::AxisByAxis).plant;
        plant.habit = Arc::new(Habit { wood: Some(wood()), ..(*plant.habit).clone() });
        plant.nodes.diameter.fill(0.03);
        plant.nodes.diameter_tip.fill(0.03);
        plant.state_start(AxisId(1), [start, 0.0, 0.0]);
        bend(&mut plant, LAST, &Site::default(), &mut Scratch::default());
        plant
    };
    let rod = |nodes: u32, length: f32| Branch { insertion: 1.4, ..Branch::trunk(nodes, length) };
    let branch = |rank| Branch { nodes: 1, length: 0.01, ..Branch::on(0, rank) };
    let whole = bent(&[rod(10, 0.4), branch(3)], -0.2);
    let halves = bent(&[rod(20, 0.2), branch(5)], 0.0);
    let (found, expected) = (whole.frames.at(NodeId(10)), halves.frames.at(NodeId(20)));
    let apart = |a: [f32; 3], b: [f32; 3]| (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f32::max);
    let bearer = whole.frames.at(NodeId(2));
    let turn = apart(whole.frames.at(NodeId(3)).heading, bearer.heading);
    assert!(turn > 0.02, "it bends: by {turn} an internode");
    assert!(apart(found.base, bearer.advanced(0.2).base) < 1e-6, "on the chord");
    assert!(apart(found.heading, expected.heading) < 0.1 * turn, "{found:?} {expected:?}");
    assert!(apart(found.base, expected.base) < 0.1 * turn, "{found:?} {expected:?}");
}

#[test]
fn a_frame_changes_at_its_tick_and_earlier_ages_keep_the_old_one() {
    let mut plant = Specimen::grown(&[Branch::trunk(6, 1.0), Branch::on(0, 3)], &trends(), Growth::AxisByAxis).plant;
    let mut before = plant.clone();
    let level = Rotation::about([0.0, 1.0, 0.0], FRAC_PI_2);
    plant.change_rest(NodeId(1), 20, Rest::Turned(level));
    plant.change_rest(NodeId(1), 30, Rest::Follows);
    plant.change_rest(AxisId(1), 25, Rest::Turned(Rotation::NONE));
    let bases = |plant: &mut Plant, age| {
        pose(plant, age);
        plant.frames.base.clone()
    };
    let old = bases(&mut before, 19);
    for order in [[19, 20, 24, 25, 29, 30, 90], [90, 30, 29, 25, 24, 20, 19]] {
        for age in order {
            let found = bases(&mut plant, age);
            assert_eq!(found[..6] == old[..6], !(20..30).contains(&age), "age {age}");
            assert_eq!(found[7..] == old[7..], age < 20, "age {age}");
            let [trunk, branch] = [NodeId(2), NodeId(7)].map(|node| plant.frames.at(node).heading);
            assert_eq!(trunk == branch, age >= 25, "age {age}: a branch that goes on as its bearer");
        }
    }
    assert_eq!(plant.axes.origin[0], Origin::Axillary);
}

/// Frames may be stated after a plant was posed, of parts that stand and of later parts.
#[test]
fn frames_that_are_stated_late_are_those_that_were_stated_at_once() {
    let plant = Specimen::grown(&tree()[..2], &trends(), Growth::TickByTick).plant;
    let state = |plant: &mut Plant, node: u32| {
        plant.state_rest(NodeId(node), Rest::Turned(Rotation::about([0.3, 1.0, 0.2], 0.4)));
    };
    let of_birth = |birth: u32| (0..plant.nodes.len()).find(|&node| plant.nodes.birth[node] == birth).unwrap() as u32;
    let (early, late) = (of_birth(30), of_birth(90));
    for order in [[late, late], [late, early], [early, late]] {
        let (mut at_once, mut in_turn) = (plant.clone(), plant.clone());
        for (age, node) in [50, 60].into_iter().zip(order) {
            state(&mut at_once, node);
            pose(&mut in_turn, age);
            state(&mut in_turn, node);
        }
        pose(&mut at_once, LAST);
        pose(&mut in_turn, 70);
        pose(&mut in_turn, LAST);
        assert_eq!(in_turn.frames.base, at_once.frames.base);
    }
}
