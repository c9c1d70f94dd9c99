//! Greene's model: no voxel holds two segments, none lies in the house, a vine covers what it climbs, a shoot leaves a
//! room by its window, and the contract.
//!
//! The voxels are found again from the pose of the plant, by points along each internode. Absent: the passage of a
//! segment through voxels by itself (`voxels`).

use super::voxels::{Lattice, Voxel};
use super::{Greene, GreeneModel};
use crate::contract;
use crate::fault::Path;
use phytomer_sim::plant::{NodeId, Plant};
use phytomer_sim::pose::{node_frame, pose};
use phytomer_sim::shape::{Cuboid, Difference, HalfSpace, Intersection, Shape, Solid, Union};
use phytomer_sim::site::{Manner, Obstacle, Side};
use phytomer_sim::{GrowthModel, Plot, Sowing};
use std::collections::BTreeMap;
use std::sync::Arc;

pub(super) const PLACE: [f64; 3] = [12.0, -7.0, 1.5];

pub(super) fn vine() -> Greene {
    let text = serde_json::json!({
        "voxel_m": 0.1, "segment_m": 0.25, "spread_deg": 50, "trials": 16, "branching": 0.12, "branching_deg": 110,
        "hold_m": 0.4, "cling_m": 0.12, "prefer": {"surface": 1.0, "upward": 0.4, "straight": 0.3},
    });
    serde_json::from_value(text).expect("parameters")
}

pub(super) fn compiled(greene: &Greene) -> GreeneModel {
    greene.compile(400, &Path::root()).expect("sound parameters")
}

/// A house of 4 by 3 by 2.5 m with a gable roof, beside the plant.
pub(super) fn house() -> Shape {
    let walls = Shape::Cuboid(Cuboid::on([2.25, 0.0, 0.0], [4.0, 3.0, 2.5]));
    let slope = |side: f64| Shape::HalfSpace(HalfSpace { point: [2.25, 0.0, 4.0], normal: [0.0, side, 1.0] });
    let under = Shape::Cuboid(Cuboid::on([2.25, 0.0, 2.5], [4.0, 3.0, 1.5]));
    let roof = Shape::Intersection(Intersection::of(vec![under, slope(1.0), slope(-1.0)]));
    Shape::Union(Union::of(vec![walls, roof]))
}

/// A plant at `PLACE` among an obstacle around it, grown by the clock.
fn among(model: &dyn GrowthModel, obstacle: &Shape, until: u32) -> Plant {
    let sowing = Sowing { species: 0, seed: contract::seed_of(4, 1), place: PLACE, sown: 0 };
    let mut plot = Plot::new(0, vec![model], &[sowing]);
    plot.site.obstacles =
        vec![Obstacle { shape: Arc::new(obstacle.moved(PLACE)), kills: Side::Inside, manner: Manner::Kills }];
    for tick in 1..=until {
        plot.site.begin(tick);
        plot.grow_to(tick).expect("room to grow");
    }
    let mut plant = plot.plants.remove(0);
    pose(&mut plant, until);
    plant
}

/// Points along each internode, metres from the seed.
pub(super) fn points(plant: &Plant) -> impl Iterator<Item = (NodeId, [f64; 3])> {
    (0..plant.nodes.len() as u32).map(NodeId).flat_map(|node| {
        let (start, end) = (plant.frames.at(node).base, node_frame(plant, node).base);
        let along = move |step: u32| {
            let share = (f64::from(step) + 0.5) / 40.0;
            [0, 1, 2].map(|k| f64::from(start[k]) + share * f64::from(end[k] - start[k]))
        };
        (0..40).map(move |step| (node, along(step)))
    })
}

/// Whether two internodes meet in a joint: one bears the other, or both stand on one.
pub(super) fn joined(plant: &Plant, one: NodeId, other: NodeId) -> bool {
    let parent = |node: NodeId| plant.nodes.parent[node.index()];
    parent(one) == other || parent(other) == one || parent(one) == parent(other)
}

/// Each voxel is passed by one internode, or by some that meet in a joint there.
fn passes_once(plant: &Plant) -> usize {
    let lattice = Lattice::of_one(0.1);
    let mut passed: BTreeMap<Voxel, Vec<NodeId>> = BTreeMap::new();
    for (node, at) in points(plant) {
        let of_voxel = passed.entry(lattice.voxel_of(at)).or_default();
        if !of_voxel.contains(&node) {
            of_voxel.push(node);
        }
    }
    for (voxel, nodes) in &passed {
        for (k, one) in nodes.iter().enumerate() {
            assert!(nodes[..k].iter().all(|other| joined(plant, *one, *other)), "{voxel:?} is passed by {nodes:?}");
        }
    }
    passed.len()
}

#[test]
fn a_vine_covers_a_house_and_never_enters_it() {
    let house = house();
    let plant = among(&compiled(&vine()), &house, 60);
    let voxels = passes_once(&plant);
    assert!(voxels > 500, "{voxels} voxels");
    let (mut highest, mut farthest) = (0.0_f64, 0.0_f64);
    for (node, at) in points(&plant) {
        assert!(!house.inside(at), "internode {node:?} at {at:?}");
        assert!(at[2] >= -1e-6, "none below the ground: {at:?}");
        (highest, farthest) = (highest.max(at[2]), farthest.max(0.5 - house.field(at)));
    }
    // A segment between two tips that hold stands out by no more than half its length beyond them.
    assert!(farthest < 0.4 + 0.125, "{farthest} m from the walls");
    assert!(highest > 2.6, "it reaches the roof: {highest} m");
}

/// A room of 2 m with walls of 0.2 m and one window to the right.
fn room() -> Shape {
    let walls = Shape::Cuboid(Cuboid { low: [-1.0, -1.0, -0.2], high: [1.4, 1.4, 2.2] });
    let inner = Shape::Cuboid(Cuboid { low: [-0.8, -0.8, -0.3], high: [1.2, 1.2, 2.0] });
    let window = Shape::Cuboid(Cuboid { low: [1.1, -0.3, 0.8], high: [1.5, 0.7, 1.7] });
    Shape::Difference(Box::new(Difference::of(walls, vec![inner, window])))
}

#[test]
fn a_shoot_leaves_a_room_by_its_window() {
    let text = serde_json::json!({
        "voxel_m": 0.1, "segment_m": 0.15, "spread_deg": 60, "trials": 16, "branching": 0.05, "sight_m": 4,
        "prefer": {"light": 20, "upward": 0.1, "straight": 0.3},
    });
    let shoot: Greene = serde_json::from_value(text).expect("parameters");
    let room = room();
    let plant = among(&compiled(&shoot), &room, 40);
    passes_once(&plant);
    let bounds = Cuboid { low: [-1.0, -1.0, -0.2], high: [1.4, 1.4, 2.2] };
    let (mut outside, mut first) = (0, None);
    for (node, at) in points(&plant) {
        assert!(!room.inside(at), "internode {node:?} at {at:?}");
        if !bounds.inside(at) {
            outside += 1;
            first.get_or_insert(at);
        }
    }
    assert!(outside > 40, "{outside} points of it are outside");
    assert!(first.is_some_and(|at| at[0] > 1.4), "it leaves by the window: {first:?}");
}

/// Without obstacles it grows in the open, and keeps the contract.
#[test]
fn it_keeps_the_contract_of_growth_models() {
    let text = serde_json::json!({
        "voxel_m": 0.1, "segment_m": 0.2, "spread_deg": 40, "branching": 0.3,
        "prefer": {"upward": 1, "light": 1}, "sight_m": 1,
    });
    let open: Greene = serde_json::from_value(text).expect("parameters");
    contract::check(&compiled(&open), 8, 3);
    let plant = contract::grown(&compiled(&open), 8, &contract::seed_of(3, 0));
    assert!(plant.axes.len() > 2, "it branches");
    contract::two_species_share_a_plot([&compiled(&open), &compiled(&vine())], 6, 5, 0.5);
}

#[test]
fn what_has_no_meaning_is_told() {
    let told = |greene: Greene| {
        let faults = greene.compile(9, &Path::root()).err().unwrap_or_default();
        faults.iter().map(|fault| fault.path.to_string()).collect::<Vec<_>>()
    };
    assert_eq!(told(Greene { segment_m: 0.05.into(), ..vine() }), ["segment_m"]);
    assert_eq!(told(Greene { sight_m: 50.0.into(), ..vine() }), ["sight_m"]);
    let mut wrong = vine();
    wrong.branching = 1.5.into();
    wrong.prefer.light = (-1.0).into();
    assert_eq!(told(wrong), ["branching", "prefer.light"]);
}
