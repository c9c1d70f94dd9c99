//! The properties of the pose: the directions of insertion, the way to the trend, unit and orthogonal frames at all
//! angles, and the same bits in either order of growth.
//!
//! Absent: precision (`tests_precision`) and stated frames (`tests_stated`).

use super::specimen::{Branch, Growth, LAST, Specimen};
use super::*;
use crate::math::{acos, cosf, sinf};
use crate::plant::{Cause, Habit, Kind, LineageKey, NewAxis, NewOrgan, OrganTrend, OrganTrends, Origin, Trend};
use crate::random::{PlantRandom, Purpose};
use std::f32::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

/// A leaf that stands straight out from its axis, on the second node of the plant.
const LEAF: NewOrgan = NewOrgan {
    node: NodeId(1),
    death: 9,
    cause: Cause::LifeLength,
    length: 0.1,
    width: 0.05,
    area: 0.004,
    azimuth: PI,
    insertion: FRAC_PI_2,
    ..NewOrgan::LEAF
};

fn trend(inclination: f32, share: f64) -> Trend {
    Trend { inclination: f64::from(inclination), share }
}

fn posed(branches: &[Branch], trends: &[Trend], growth: Growth) -> Specimen {
    let mut specimen = Specimen::grown(branches, trends, growth);
    pose(&mut specimen.plant, LAST);
    specimen
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f64 {
    (0..3).map(|k| f64::from(a[k]) * f64::from(b[k])).sum()
}

fn assert_near(a: [f32; 3], b: [f32; 3]) {
    assert!((0..3).all(|k| (a[k] - b[k]).abs() < 1e-6), "{a:?} {b:?}");
}

#[test]
fn the_trunk_of_insertion_zero_is_vertical_and_stands_on_the_seed_wherever_that_lies() {
    let mut specimen = Specimen::grown(&[Branch::trunk(4, 0.25)], &[trend(0.0, 0.2)], Growth::AxisByAxis);
    specimen.plant.place = [3.0, -2.0, 1e9];
    pose(&mut specimen.plant, LAST);
    let last = specimen.plant.frames.at(NodeId(3));
    assert_eq!(last, Frame { base: [0.0, 0.0, 0.75], heading: [0.0, 0.0, 1.0], up: [-1.0, 0.0, 0.0] });
    assert_eq!(bud_frame(&specimen.plant, AxisId::TRUNK).base, [0.0, 0.0, 1.0]);
}

#[test]
fn a_branch_leaves_at_its_insertion_angle_and_azimuth() {
    let branch = Branch { azimuth: 0.6, insertion: 1.2, ..Branch::on(0, 2) };
    let plant = posed(&[Branch::trunk(2, 0.5), branch], &[Trend::STRAIGHT], Growth::AxisByAxis).plant;
    let bearing = plant.frames.at(NodeId(1));
    let first = plant.frames.at(NodeId(2));
    assert_near(first.base, [0.0, 0.0, 1.0]);
    assert!((acos(dot(first.heading, bearing.heading)) - 1.2).abs() < 1e-6);
    let side = [0.0, -1.0, 0.0];
    let outward = [0, 1, 2].map(|k| cosf(0.6) * bearing.up[k] + sinf(0.6) * side[k]);
    assert_near(first.heading, [0, 1, 2].map(|k| cosf(1.2) * bearing.heading[k] + sinf(1.2) * outward[k]));
    assert_near(first.up, [0, 1, 2].map(|k| sinf(1.2) * bearing.heading[k] - cosf(1.2) * outward[k]));
    assert!((3..7).all(|node| plant.frames.heading[node] == first.heading), "share 0 keeps the direction");
}

/// Figure 15: a branch of insertion 1.1 goes up if orthotropic and level if plagiotropic, ever nearer, in one plane.
#[test]
fn an_axis_turns_to_its_trend_without_ever_turning_back() {
    for inclination in [0.0, FRAC_PI_2, 2.2] {
        let branch = Branch { nodes: 200, ..Branch::on(0, 1) };
        let plant = posed(&[Branch::trunk(1, 0.5), branch], &[trend(inclination, 0.08)], Growth::AxisByAxis).plant;
        let angle = |node: usize| acos(f64::from(plant.frames.heading[node][2]).clamp(-1.0, 1.0));
        let gap = |node: usize| (angle(node) - f64::from(inclination)).abs();
        assert!((1..200).all(|node| gap(node + 1) <= gap(node) + 1e-7), "inclination {inclination}");
        assert!(gap(200) < 1e-3);
        let plane = |node: usize| plant.frames.heading[node];
        let across = |node: usize| plane(1)[0] * plane(node)[1] - plane(1)[1] * plane(node)[0];
        assert!((1..=200).all(|node| across(node).abs() < 1e-6));
    }
}

/// An upright axis that tends to hang turns by its share, as any other axis does.
/// The way that growth follows before nodes are there, beside that which it takes node by node: from a bud and from the
/// last node of axes that stand upright, nearly upright, aside and hang, to trends that turn them, some through the
/// vertical.
#[test]
fn an_axis_that_is_followed_onward_goes_where_it_goes_node_by_node() {
    let trends = [trend(0.0, 0.08), trend(FRAC_PI_2, 0.1), trend(PI, 0.5), trend(0.3, 0.0), trend(2.2, 1.0)];
    let mut followed = 0;
    for insertion in [0.0, 1e-7, 1e-5, 0.4, 1.1, 3.0, PI] {
        let branch = Branch { nodes: 3, insertion, ..Branch::on(0, 1) };
        let plant = posed(&[Branch::trunk(1, 0.5), branch], &trends, Growth::AxisByAxis).plant;
        let axis = AxisId(1);
        let lasts = [None, plant.axes.last_node[axis.index()].some()];
        for (last, named) in lasts.into_iter().flat_map(|last| (0..5).map(move |named| (last, named))) {
            let mut ahead = Ahead::of_bud(&plant, axis, last);
            let mut onward = Onward::from(&ahead);
            for node in 0..300 {
                let trend = if node < 20 { 1 } else { named };
                ahead.tend(&plant, axis, trend);
                ahead.grow(0.01);
                if !onward.go_on(&plant, axis, trend, 0.01) {
                    break;
                }
                let apart = (0..3).map(|k| (ahead.base()[k] - onward.base()[k]).abs()).fold(0.0, f64::max);
                assert!(apart < 1e-8, "insertion {insertion}, trend {named}, node {node}: {apart} m");
                followed += 1;
            }
        }
    }
    assert!(followed > 20_000, "{followed} of 21,000 nodes are known");
}

#[test]
fn an_upright_axis_that_tends_to_hang_keeps_its_share_of_the_angle() {
    for share in [0.1, 0.3, 0.5, 0.51] {
        let plant = posed(&[Branch::trunk(9, 0.1)], &[trend(PI, share)], Growth::AxisByAxis).plant;
        for node in 0..9 {
            let left = std::f64::consts::PI * crate::math::pow(1.0 - share, node as f64);
            let [x, y, z] = plant.frames.heading[node].map(f64::from);
            let found = std::f64::consts::PI - crate::math::atan2((x * x + y * y).sqrt(), z);
            assert!((found - left).abs() < 1e-6, "share {share}, internode {node}: {found} left, not {left}");
        }
    }
}

#[test]
fn frames_are_unit_and_orthogonal_whatever_the_angles() {
    let mut words = PlantRandom::new(5, 8).stream(LineageKey(1), Purpose::Node);
    let angles = [0.0, 1e-7, 1e-4, 0.8, FRAC_PI_2, PI, -PI, 2.0 * PI, 1e4, -3.0];
    let shares = [0.0, 1e-6, 0.1, 0.5, 0.999, 1.0];
    let lengths = [0.0, 1e-9, 0.05, 3.0];
    for _ in 0..400 {
        let mut any = |n: usize| words.word() as usize % n;
        let trends: Vec<Trend> =
            (0..3).map(|_| trend([0.0, 1e-4, 0.8, FRAC_PI_2, PI][any(5)], shares[any(6)])).collect();
        let branches: Vec<Branch> = (0..12)
            .map(|axis| Branch {
                bearer: (axis > 0).then(|| (any(axis), 1 + any(9) as u32)),
                azimuth: angles[any(10)],
                insertion: angles[any(10)],
                nodes: 9,
                length: lengths[any(4)],
                trends: [any(3) as u8, any(3) as u8],
            })
            .collect();
        assert_sound(&posed(&branches, &trends, Growth::TickByTick).plant);
    }
}

fn assert_sound(plant: &Plant) {
    assert_eq!(plant.frames.base.len(), plant.nodes.len());
    for (node, (&heading, &up)) in plant.frames.heading.iter().zip(&plant.frames.up).enumerate() {
        assert!(plant.frames.base[node].iter().all(|x| x.is_finite()));
        assert!((dot(heading, heading) - 1.0).abs() < 1e-5, "node {node}: {heading:?}");
        assert!((dot(up, up) - 1.0).abs() < 1e-5, "node {node}: {up:?}");
        assert!(dot(heading, up).abs() < 1e-5, "node {node}: {heading:?} {up:?}");
    }
}

#[test]
fn the_order_of_growth_does_not_change_a_bit() {
    let composite = [trend(0.0, 0.3), trend(FRAC_PI_2, 0.05)];
    let branches: Vec<Branch> = (0..30)
        .map(|axis| Branch {
            bearer: (axis > 0).then(|| (axis / 3, 3 + axis as u32 % 7)),
            azimuth: 2.4 * axis as f32,
            trends: [0, 1],
            nodes: 20,
            ..Branch::on(0, 1)
        })
        .collect();
    let ahead = posed(&branches, &composite, Growth::AxisByAxis);
    let mut ticked = Specimen::new(&branches, &composite);
    while ticked.tick() {
        let age = ticked.plant.age;
        pose(&mut ticked.plant, age);
    }
    assert_eq!(ahead.plant.nodes.len(), 600);
    for (a, b) in ahead.node_at.iter().flatten().zip(ticked.node_at.iter().flatten()) {
        assert_eq!(ahead.plant.frames.at(*a), ticked.plant.frames.at(*b));
    }
}

#[test]
fn stated_headings_are_kept_and_up_turns_no_more_than_it_must() {
    let mut specimen = Specimen::grown(&[Branch::trunk(5, 1.0)], &[], Growth::AxisByAxis);
    let slant = [0.6, 0.0, 0.8];
    let headings = [[0.0, 0.0, 1.0], slant, [1.0, 0.0, 0.0], [0.0, 0.0, -2.0], [f32::NAN; 3]];
    for (node, heading) in headings.into_iter().enumerate() {
        specimen.plant.state_rest(NodeId(node as u32), Rest::Heading(heading));
    }
    pose(&mut specimen.plant, LAST);
    let frames = &specimen.plant.frames;
    assert_eq!(frames.up[0], [1.0, 0.0, 0.0]);
    assert_near(frames.up[1], [0.8, 0.0, -0.6]);
    assert_near(frames.base[2], [0.6, 0.0, 1.8]);
    assert_near(frames.up[2], [0.0, 0.0, -1.0]);
    assert_near(frames.heading[3], [0.0, 0.0, -1.0]);
    assert_near(frames.heading[4], [0.0, 0.0, -1.0]);
    assert_sound(&specimen.plant);
}

#[test]
fn organs_and_buds_stand_at_the_tip_of_their_node() {
    let mut specimen = Specimen::grown(&[Branch::trunk(2, 0.5)], &[], Growth::AxisByAxis);
    let plant = &mut specimen.plant;
    let waiting = plant.add_axis(NewAxis {
        bearer: Some(NodeId(0)),
        key: LineageKey(1),
        order: 2,
        origin: Origin::Axillary,
        appearance: 1,
        birth: 3,
        insertion: FRAC_PI_2,
        ..NewAxis::OF_THE_SEED
    });
    let leaf = plant.add_organ(LEAF);
    pose(plant, LAST);
    assert_near(bud_frame(plant, AxisId::TRUNK).base, [0.0, 0.0, 1.0]);
    let bud = bud_frame(plant, waiting);
    assert_near(bud.base, [0.0, 0.0, 0.5]);
    assert_near(bud.heading, [-1.0, 0.0, 0.0]);
    assert_near(bud.up, [0.0, 0.0, 1.0]);
    let leaf = organ_frame(plant, leaf, 1);
    assert_near(leaf.base, [0.0, 0.0, 1.0]);
    assert_near(leaf.heading, [1.0, 0.0, 0.0]);
}

#[test]
fn a_leaf_sinks_with_its_age_and_a_fruit_hangs() {
    let mut specimen = Specimen::grown(&[Branch::trunk(2, 0.5)], &[], Growth::AxisByAxis);
    let plant = &mut specimen.plant;
    let sinking = OrganTrend { inclination: std::f64::consts::PI, shares: vec![0.0, 0.5, 1.0] };
    let of_trunk = OrganTrends { leaf: Some(sinking), ..OrganTrends::default() };
    plant.habit = Arc::new(Habit { organ_trends: vec![of_trunk], ..(*plant.habit).clone() });
    let organ = |kind| NewOrgan { kind, birth: 3, ..LEAF };
    let (leaf, flower) = (plant.add_organ(organ(Kind::Leaf)), plant.add_organ(organ(Kind::Flower)));
    pose(plant, LAST);
    let heading = |age| organ_frame(plant, leaf, age).heading;
    assert_near(heading(3), [1.0, 0.0, 0.0]);
    let halfway = std::f32::consts::FRAC_1_SQRT_2;
    assert_near(heading(4), [halfway, 0.0, -halfway]);
    assert_near(organ_frame(plant, leaf, 4).up, [halfway, 0.0, halfway]);
    assert_near(heading(5), [0.0, 0.0, -1.0]);
    assert_eq!(heading(8), heading(5));
    assert_near(organ_frame(plant, flower, 8).heading, [1.0, 0.0, 0.0]);
}

/// On an axis that lies along X a leaf to the side stands on edge, until its stalk twists; its heading stays.
#[test]
fn leaves_that_face_the_sky_turn_their_upper_side_up() {
    let mut specimen = Specimen::grown(&[Branch::trunk(2, 0.5)], &[], Growth::AxisByAxis);
    let plant = &mut specimen.plant;
    plant.axes.insertion[0] = FRAC_PI_2;
    let leaf = |azimuth, insertion| NewOrgan { azimuth, insertion, ..LEAF };
    let leaves = [plant.add_organ(leaf(FRAC_PI_2, FRAC_PI_2)), plant.add_organ(leaf(0.4, 1.1))];
    pose(plant, LAST);
    let before = leaves.map(|leaf| organ_frame(plant, leaf, 5));
    assert!(before[0].up[2].abs() < 1e-6, "on edge: {:?}", before[0]);
    let of_trunk = OrganTrends { leaves_face_the_sky: true, ..OrganTrends::default() };
    plant.habit = Arc::new(Habit { organ_trends: vec![of_trunk], ..(*plant.habit).clone() });
    for (leaf, before) in leaves.into_iter().zip(before) {
        let after = organ_frame(plant, leaf, 5);
        assert_eq!(after.heading, before.heading);
        let highest = (1.0 - after.heading[2] * after.heading[2]).sqrt();
        assert!((after.up[2] - highest).abs() < 1e-6, "as high as it can: {after:?}");
        assert!(dot(after.up, after.heading).abs() < 1e-6 && (dot(after.up, after.up) - 1.0).abs() < 1e-6);
    }
}
