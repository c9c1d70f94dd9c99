//! Cohen's tips and the obstacles of the site: a tip goes along the surface that it meets, at the angle of a closed
//! form; none enters an obstacle; and one in a dead end grows no more.
//!
//! Absent: tips in the open (`tests_cohen`).

use super::Cohen;
use crate::contract;
use crate::fault::Path;
use phytomer_sim::plant::{NodeId, Plant};
use phytomer_sim::pose::{node_frame, pose};
use phytomer_sim::shape::{Cuboid, Cylinder, Difference, HalfSpace, Shape, Sphere, Union};
use phytomer_sim::site::{Manner, Obstacle, Side};
use phytomer_sim::{Plot, Sowing};
use std::sync::Arc;

const PLACE: [f64; 3] = [5.0, -3.0, 0.5];
const SEGMENT: f64 = 0.1;

/// A plant at `PLACE` among obstacles that are stated around it.
fn among(more: serde_json::Value, obstacles: Vec<(Shape, Side)>, seed: u32, until: u32) -> Plant {
    let mut text = serde_json::json!({"segment_m": SEGMENT, "reach_m": 0.3, "avoidance": 0.2});
    for (key, value) in more.as_object().into_iter().flatten() {
        text[key] = value.clone();
    }
    let cohen: Cohen = serde_json::from_value(text).expect("parameters");
    let model = cohen.compile(until, &Path::root()).expect("sound parameters");
    let sowing = Sowing { species: 0, seed: contract::seed_of(6, seed), place: PLACE, sown: 0 };
    let mut plot = Plot::new(0, vec![&model], &[sowing]);
    let felt =
        |(shape, kills): (Shape, Side)| Obstacle { shape: Arc::new(shape.moved(PLACE)), kills, manner: Manner::Kills };
    plot.site.obstacles = obstacles.into_iter().map(felt).collect();
    for tick in 1..=until {
        plot.site.begin(tick);
        plot.grow_to(tick).expect("room to grow");
    }
    let mut plant = plot.plants.remove(0);
    pose(&mut plant, until);
    plant
}

fn ends(plant: &Plant) -> Vec<[f64; 3]> {
    (0..plant.nodes.len() as u32).map(|node| node_frame(plant, NodeId(node)).base.map(f64::from)).collect()
}

fn headings(plant: &Plant) -> Vec<[f64; 3]> {
    plant.frames.heading.iter().map(|heading| heading.map(f64::from)).collect()
}

/// Under a roof that slopes by 3 : 4 an upright tip goes on in the direction (0.8, 0, 0.6), along it.
#[test]
fn a_tip_goes_along_a_sloping_roof() {
    let roof = || Shape::HalfSpace(HalfSpace { point: [0.0, 0.0, 1.03], normal: [3.0, 0.0, -4.0] });
    let plant = among(serde_json::json!({"avoidance": 0, "tropism": [0, 0, 1]}), vec![(roof(), Side::Inside)], 0, 30);
    assert_eq!(plant.nodes.len(), 30);
    let headings = headings(&plant);
    assert!(headings[..10].iter().all(|heading| (heading[2] - 1.0).abs() < 1e-6), "{headings:?}");
    for heading in &headings[10..] {
        let expected = [0.8, 0.0, 0.6];
        assert!((0..3).all(|k| (heading[k] - expected[k]).abs() < 1e-5), "{heading:?}");
    }
    // It keeps the distance at which it turned: 0.03 m below the roof, of which 4/5 are across it.
    for at in &ends(&plant)[9..] {
        assert!((roof().distance(*at) - 0.024).abs() < 1e-4, "{at:?}");
    }
}

/// A level roof that is met head-on turns a tip by a right angle, in a direction that each plant draws.
#[test]
fn a_tip_that_meets_a_roof_head_on_draws_its_way() {
    let ways = [0, 1, 2].map(|seed| {
        let roof = Shape::HalfSpace(HalfSpace { point: [0.0, 0.0, 0.55], normal: [0.0, 0.0, -1.0] });
        let plant = among(serde_json::json!({"avoidance": 0}), vec![(roof, Side::Inside)], seed, 9);
        let heading = headings(&plant)[8];
        assert!(heading[2].abs() < 1e-5, "{heading:?}");
        heading
    });
    let alike = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| a[k] * b[k]).sum::<f64>() > 0.999;
    assert!(!alike(ways[0], ways[1]) && !alike(ways[0], ways[2]), "{ways:?}");
}

/// In a ball with a house in it no tip leaves the ball or enters the house by more than the 32nd of a segment at which
/// segments are asked, though the plant fills the ball.
#[test]
fn no_tip_enters_an_obstacle() {
    let ball = || Shape::Sphere(Sphere { centre: [0.0, 0.0, 0.8], radius: 1.0 });
    let walls = || Shape::Cuboid(Cuboid::on([0.5, 0.0, 0.0], [0.5, 0.8, 0.9]));
    let door = || Shape::Cuboid(Cuboid::on([0.5, -0.4, 0.0], [0.2, 0.3, 0.5]));
    let house = || Shape::Difference(Box::new(Difference::of(walls(), vec![door()])));
    let grows = serde_json::json!({"branching": 0.4, "branching_deg": 40, "crowding": 4, "tropism": [0.1, 0, 0.1]});
    let plant = among(grows, vec![(house(), Side::Inside), (ball(), Side::Outside)], 1, 40);
    let shut = Union::of(vec![house()]);
    let (mut near, ends) = (0, ends(&plant));
    for (node, end) in ends.iter().enumerate() {
        let start = plant.frames.base[node].map(f64::from);
        for step in 1..=200 {
            let share = f64::from(step) / 200.0;
            let at = [0, 1, 2].map(|k| start[k] + share * (end[k] - start[k]));
            let (from_house, in_ball) = (Shape::Union(shut.clone()).distance(at), -ball().distance(at));
            assert!(from_house > -SEGMENT / 32.0 && in_ball > -SEGMENT / 32.0, "{node} at {at:?}");
        }
        near += usize::from(house().distance(*end) < 0.05 || ball().distance(*end) > -0.05);
    }
    assert!(ends.len() > 200 && near > 30, "{} segments, {near} at a surface", ends.len());
}

/// A tip in an upright tube goes to its end and no farther: it does not turn back.
#[test]
fn a_tip_in_a_dead_end_grows_no_more() {
    let tube = Shape::Cylinder(Cylinder { base: [0.0, 0.0, -0.1], radius: 0.02, height: 0.65 });
    let plant = among(serde_json::json!({"avoidance": 0}), vec![(tube, Side::Outside)], 0, 30);
    assert_eq!(plant.nodes.len(), 5);
}

/// A plant whose seed lies in an obstacle does not grow.
#[test]
fn nothing_grows_within_an_obstacle() {
    let ball = Shape::Sphere(Sphere { centre: [0.0; 3], radius: 2.0 });
    assert_eq!(among(serde_json::json!({}), vec![(ball, Side::Inside)], 0, 9).nodes.len(), 0);
}
