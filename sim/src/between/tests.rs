//! Plants between two ticks that are written by hand; whole species are in `tests/between.rs` of the root.

use super::Between;
use crate::clock::Tick;
use crate::model::Growth;
use crate::plant::{Habit, NewAxis, NewNode, NewOrgan, NodeId, Plant, Seed, Trend};
use crate::pose::pose;
use std::sync::Arc;

/// A trunk of internodes by their component numbers, each a metre long and as thick as its number in millimetres.
fn trunk(numbers: &[u32], age: Tick) -> Plant {
    let seed = Seed { plant: 0, draws: 0, run_seed: 1, component_limit: 100, keep_events: false };
    let habit = Habit { trends: vec![Trend::STRAIGHT], ..Habit::default() };
    let mut plant = Plant::new(&seed, Arc::new(habit));
    (0..20).for_each(|_| assert!(plant.next_number() < 20));
    let axis = plant.place_axis(NewAxis::OF_THE_SEED, 0);
    let mut parent = NodeId::NONE;
    for (rank, number) in (1..).zip(numbers) {
        let diameter = *number as f32 * 1e-3;
        let node = NewNode { parent, axis, birth: 1, rank, length: 1.0, diameter, ..NewNode::OF_THE_TRUNK };
        parent = plant.place_node(node, *number);
    }
    plant.age = age;
    pose(&mut plant, age);
    plant
}

/// The base, the length and the diameter of the component with a number.
fn of(plant: &Plant, number: u32) -> [f32; 3] {
    let node = plant.nodes.component.iter().position(|component| *component == number).expect("it stands");
    let length = plant.posed_length(NodeId(node as u32));
    [plant.frames.base[node][2], length, plant.nodes.diameter[node]]
}

/// Internode 3 is put between 1 and 2, 4 grows at the end, and 5, which was there, goes.
#[test]
fn what_is_put_between_others_grows_and_what_has_gone_stands_to_the_end() {
    let (before, after) = (trunk(&[1, 2, 5], 1), trunk(&[1, 3, 2, 4], 2));
    let mut between = Between::new(&before, &after, 2, Growth::Rewrites, false);
    for share in [0.25_f32, 0.5, 0.75] {
        let plant = between.at(share);
        assert_eq!((plant.partway(), plant.shown_age(2)), (Some(share), 1.0 + f64::from(share)));
        let standing = (0..plant.nodes.len() as u32).filter(|node| plant.stands(NodeId(*node), 2)).count();
        assert_eq!(standing, 5);
        let near = |number: u32, expected: [f32; 3]| {
            let found = of(plant, number);
            assert!((0..3).all(|k| (found[k] - expected[k]).abs() < 1e-6), "{number} at {share}: {found:?}");
        };
        near(1, [0.0, 1.0, 0.001]);
        near(3, [1.0, share, 0.003]);
        near(2, [1.0 + share, 1.0, 0.002]);
        near(4, [2.0 + share, share, share * 0.004]);
        near(5, [2.0 + share, 1.0, 0.005]);
    }
}

/// Of a plant that its model extends the nodes follow one another.
#[test]
fn the_nodes_of_a_growth_unit_follow_one_another() {
    let (mut before, mut after) = (trunk(&[1, 2, 3, 4], 1), trunk(&[1, 2, 3, 4], 2));
    for plant in [&mut before, &mut after] {
        plant.nodes.birth[2..].fill(2);
        plant.frames.clear();
    }
    pose(&mut before, 1);
    pose(&mut after, 2);
    let mut between = Between::new(&before, &after, 2, Growth::Extends, false);
    for (share, lengths) in [(0.25, [0.5, 0.0]), (0.5, [1.0, 0.0]), (0.75, [1.0, 0.5])] {
        let plant = between.at(share);
        assert_eq!([3, 4].map(|number| of(plant, number)[1]), lengths, "{share}");
        assert_eq!(of(plant, 4)[0], 2.0 + lengths[0]);
        assert!((of(plant, 3)[2] - share * 0.003).abs() < 1e-9);
    }
}

#[test]
fn the_corners_of_an_outline_go_evenly() {
    let leafy = |side: f32, corners: usize, age: Tick| {
        let mut plant = trunk(&[1], age);
        let organ = plant.add_organ(NewOrgan { node: NodeId(0), ..NewOrgan::LEAF });
        let all = [[0.0; 3], [side, 0.0, 0.0], [side, side, 0.0], [0.0, side, 0.0]];
        plant.state_outline(organ, &all[..corners]);
        (plant, organ)
    };
    let (before, after) = (leafy(0.1, 4, 1), leafy(0.3, 4, 2));
    let mut way = Between::new(&before.0, &after.0, 2, Growth::Rewrites, false);
    for share in [0.25, 0.75, 0.5] {
        let (plant, side) = (way.at(share), 0.1 + 0.2 * share);
        let corners = plant.outline_of(after.1);
        assert!((corners[1][0] - side).abs() < 1e-6 && (corners[2][1] - side).abs() < 1e-6, "{corners:?}");
        assert!((plant.organs.area[after.1.index()] - side * side).abs() < 1e-6, "the area of the square");
    }
    // With another number of corners it is the later outline.
    let triangle = leafy(0.3, 3, 2);
    let mut way = Between::new(&before.0, &triangle.0, 2, Growth::Rewrites, false);
    assert_eq!(way.at(0.5).outline_of(triangle.1), triangle.0.outline_of(triangle.1));
}
