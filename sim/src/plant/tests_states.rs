//! The statements of plants beside their columns: lengths that change, looks of single nodes and organs, frames and
//! outlines of organs.
//!
//! Absent: rest frames of nodes and axes (`pose::tests_stated`).

use super::*;
use crate::mechanics::wood_volume;
use crate::pose::specimen::{Branch, Growth, Specimen};
use crate::pose::{bud_frame, node_frame, organ_frame, pose};
use crate::rotation::Rotation;
use std::f64::consts::{FRAC_PI_2, PI};

fn with_looks(branches: &[Branch], change: impl Fn(&mut Looks)) -> Plant {
    let mut plant = Specimen::grown(branches, &[Trend::STRAIGHT], Growth::AxisByAxis).plant;
    let mut habit = (*plant.habit).clone();
    change(&mut habit.looks);
    plant.habit = Arc::new(habit);
    plant
}

fn organ(plant: &mut Plant, node: u32) -> OrganId {
    plant.add_organ(NewOrgan {
        node: NodeId(node),
        length: 0.1,
        width: 0.1,
        area: 0.01,
        azimuth: 0.5,
        insertion: 1.0,
        ..NewOrgan::LEAF
    })
}

/// Node k appears at tick k and has a quarter, a half and then all of its length, in any order of ages.
#[test]
fn internodes_grow_by_their_own_age_and_the_pose_with_them() {
    let branches = [Branch::trunk(5, 1.0), Branch::on(0, 3)];
    let mut plant = with_looks(&branches, |looks| looks.internodes[0].expansion = vec![0.25, 0.5, 1.0]);
    let share = |age: u32, birth: u32| [0.25, 0.5, 1.0][(age - birth).min(2) as usize];
    for age in [1, 2, 3, 4, 5, 6, 7, 50, 6, 3, 5] {
        pose(&mut plant, age);
        let height: f64 = (1..=age.min(5)).map(|birth| share(age, birth)).sum();
        let tip = node_frame(&plant, NodeId(age.min(5) - 1)).base;
        assert!((f64::from(tip[2]) - height).abs() < 1e-6, "{age}: {tip:?} {height}");
        assert_eq!(plant.length(NodeId(0), age), share(age, 1) as f32);
        let volume = PI / 4.0 * 1e-4 * share(age, 1);
        assert!((wood_volume(&plant, NodeId(0)) / volume - 1.0).abs() < 1e-6);
    }
    assert_eq!(plant.nodes.length[0], 1.0, "the column keeps the full length");
}

#[test]
fn a_length_that_is_rewritten_holds_from_its_tick_on() {
    let mut plant = with_looks(&[Branch::trunk(4, 0.5)], |_| {});
    plant.rewrite_length(NodeId(1), 12, 2.0);
    plant.rewrite_length(NodeId(1), 9, 1.0);
    plant.rewrite_length(NodeId(3), 9, 0.0);
    for order in [[5, 8, 9, 11, 12, 40], [40, 12, 11, 9, 8, 5]] {
        for age in order {
            pose(&mut plant, age);
            let second = if age < 9 { 0.5 } else { [1.0, 2.0][usize::from(age >= 12)] };
            assert_eq!(plant.length(NodeId(1), age), second);
            let height = 1.0 + second + if age < 9 { 0.5 } else { 0.0 };
            let tip = bud_frame(&plant, AxisId::TRUNK).base[2];
            assert!((tip - height).abs() < 1e-6, "{age}: {tip} {height}");
        }
    }
    plant.clear();
    assert_eq!(plant.rewritten, Rewritten::default());
}

/// A plant without changing lengths stores no lengths beside its column.
#[test]
fn lengths_that_do_not_change_are_read_from_their_column() {
    let mut plant = with_looks(&[Branch::trunk(4, 0.5)], |_| {});
    pose(&mut plant, 9);
    assert!(std::ptr::eq(plant.posed_lengths(), plant.nodes.length.as_slice()));
}

#[test]
fn single_nodes_and_organs_have_looks_of_their_own() {
    let petal = InternodeLook { kind: Kind::PetalInternode, ..InternodeLook::of_shape(Shape::Blade) };
    let red = OrganLook { paint: PaintNumber::nth(1), expansion: vec![0.5] };
    let mut plant = with_looks(&[Branch::trunk(3, 0.5)], |looks| {
        looks.apart = vec![InternodeLook::of_shape(Shape::Cylinder), petal.clone()];
        looks.organs_apart = vec![red.clone()];
    });
    let leaves = [0, 1].map(|node| organ(&mut plant, node));
    plant.give_look(NodeId(1), 1);
    plant.give_look(NodeId(2), 7);
    plant.give_organ_look(leaves[1], 0);
    let kinds = [0, 1, 2].map(|node| plant.kind_of(NodeId(node)));
    assert_eq!(kinds, [Kind::Internode, Kind::PetalInternode, Kind::Internode], "a look that is not there is none");
    assert_eq!(plant.look_of_organ(leaves[0]), None);
    assert_eq!(plant.look_of_organ(leaves[1]), Some(&red));
    assert_eq!(leaves.map(|leaf| plant.organ_area::<f64>(leaf, 3)), [f64::from(0.01_f32), f64::from(0.01_f32) / 4.0]);
    let slab = wood_volume(&plant, NodeId(1)) / (0.5 * 0.01 * f64::from(InternodeLook::BLADE_THICKNESS));
    assert!((slab - 1.0).abs() < 1e-6, "{slab}");
}

#[test]
fn organs_state_their_frames_and_keep_them() {
    let mut plant = with_looks(&[Branch { insertion: 1.1, ..Branch::trunk(2, 0.5) }], |_| {});
    let sinking = OrganTrend { inclination: PI, shares: vec![0.5, 1.0] };
    let of_trunk = OrganTrends { leaf: Some(sinking), ..OrganTrends::default() };
    plant.habit = Arc::new(Habit { organ_trends: vec![of_trunk], ..(*plant.habit).clone() });
    let [free, stated] = [organ(&mut plant, 1), organ(&mut plant, 1)];
    plant.state_organ(stated, Rotation::about([0.0, 0.0, 1.0], FRAC_PI_2), [-0.1, 0.02, 0.0]);
    pose(&mut plant, 5);
    let node = node_frame(&plant, NodeId(1));
    let left = [0, 1, 2].map(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        node.up[i] * node.heading[j] - node.up[j] * node.heading[i]
    });
    let found = organ_frame(&plant, stated, 40);
    let near = |a: [f32; 3], b: [f32; 3]| assert!((0..3).all(|k| (a[k] - b[k]).abs() < 1e-6), "{a:?} {b:?}");
    near(found.heading, left);
    near(found.up, node.up);
    near(found.base, [0, 1, 2].map(|k| node.base[k] - 0.1 * node.heading[k] + 0.02 * left[k]));
    near(organ_frame(&plant, free, 40).heading, [0.0, 0.0, -1.0]);
}

/// The polygon of an L of three unit squares, in a plane that leans, seen from either side.
#[test]
fn the_area_of_an_outlined_organ_is_that_of_its_polygon() {
    let mut plant = with_looks(&[Branch::trunk(2, 0.5)], |_| {});
    let [one, other] = [organ(&mut plant, 0), organ(&mut plant, 1)];
    let turn = Rotation::about([1.0, 2.0, 0.5], 1.0);
    let mut outline = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]]
        .map(|[x, y]: [f64; 2]| turn.turned([x + 5.0, y, 0.0]).map(|x| x as f32));
    plant.state_outline(one, &outline);
    outline.reverse();
    plant.state_outline(other, &outline);
    for organ in [one, other] {
        assert!((plant.organ_area::<f64>(organ, 3) - 3.0).abs() < 1e-5);
    }
    assert_eq!(plant.outline_of(other), outline);
    plant.state_outline(one, &outline[..2]);
    assert!(plant.outline_of(one).is_empty() && plant.organs.area[0] == 0.0);
}

/// Statements of a fragment are the whole plant's after joining, under the numbers that its nodes and organs then have.
#[test]
fn a_fragment_brings_what_it_states() {
    let add = |plant: &mut Plant, axis: AxisId| {
        let last = plant.axes.last_node[axis.index()];
        let parent = last.some().unwrap_or(plant.axes.bearer[axis.index()]);
        let rank = if last == NodeId::NONE { 1 } else { 2 };
        plant.add_node(NewNode { parent, axis, rank, length: 0.1, diameter: 0.01, ..NewNode::OF_THE_TRUNK })
    };
    let work = |plant: &mut Plant, axis: AxisId| {
        let [first, second] = [add(plant, axis), add(plant, axis)];
        let leaf = organ(plant, second.0);
        plant.state_rest(first, Rest::Turned(Rotation::about([0.0, 0.0, 1.0], 0.3)));
        plant.state_rest(second, Rest::Heading([0.0, 1.0, 0.0]));
        plant.change_rest(second, 4, Rest::Turned(Rotation::NONE));
        plant.state_start(second, [0.1, 0.0, 0.0]);
        plant.rewrite_length(second, 3, 0.7);
        plant.give_look(second, 2);
        plant.give_organ_look(leaf, 1);
        plant.state_organ(leaf, Rotation::about([0.0, 0.0, 1.0], 0.5), [0.0, 0.1, 0.0]);
        plant.state_outline(leaf, &[[0.0; 3], [1.0, 0.0, 0.0], [1.0, axis.0 as f32, 0.0]]);
    };
    let start = || {
        let mut plant = with_looks(&[Branch::trunk(3, 0.5)], |_| {});
        let axis = |rank: u32| NewAxis { bearer: Some(NodeId(rank)), order: 2, ..NewAxis::OF_THE_SEED };
        let axes = [0, 1, 2].map(|rank| plant.add_axis(axis(rank)));
        (plant, axes)
    };
    let (mut whole, axes) = start();
    axes.iter().for_each(|&axis| work(&mut whole, axis));
    let (mut parted, axes) = start();
    work(&mut parted, axes[0]);
    let mut fragment = parted.fragment(2..4);
    // The outlines identify the axes of the whole.
    for (own, of_whole) in [(AxisId(0), axes[1]), (AxisId(1), axes[2])] {
        work(&mut fragment.plant, own);
        let last = OrganId(fragment.plant.organs.len() as u32 - 1);
        fragment.plant.state_outline(last, &[[0.0; 3], [1.0, 0.0, 0.0], [1.0, of_whole.0 as f32, 0.0]]);
    }
    parted.join(fragment);
    assert_eq!(parted.stated, whole.stated);
    assert_eq!((&parted.rewritten, &parted.own_looks), (&whole.rewritten, &whole.own_looks));
    for organ in (0..3).map(OrganId) {
        assert_eq!(parted.outline_of(organ), whole.outline_of(organ));
        assert_eq!(parted.organs.area[organ.index()], whole.organs.area[organ.index()]);
        assert_eq!(parted.stated_organs.frame(organ), whole.stated_organs.frame(organ));
    }
}
