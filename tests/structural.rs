//! Structures beyond trees: herbs on a rhizome, an inflorescence, a flower and a date palm (de Reffye 1988 §5, Fig.
//! 16), and a bamboo, grown like any plant and distinguished by the kinds of their components.
//!
//! Absent: the look of these plants (`docs/gallery.md`).

use phytomer_sim::plant::{ApexFate, AxisId, Class, Kind, NodeId, Origin, Plant, Seed};
use phytomer_sim::{Plot, Tick};
use std::collections::{BTreeMap, BTreeSet};

/// Plant number `number` of a shipped species, grown, shed and posed at `age`.
fn grown(name: &str, number: u32, age: Tick) -> Plant {
    let found = phytomer_config::validate_species(name, age).unwrap_or_else(|report| panic!("{name}: {report}"));
    let seed =
        Seed { plant: number, draws: number.into(), run_seed: 1988, component_limit: 5_000_000, keep_events: false };
    let mut plot = Plot::of_one(found.model.as_ref(), &seed);
    plot.grow_to(age).expect("within the limit");
    plot.site.gravity = 0.0;
    plot.stand(age);
    plot.plants.remove(0)
}

/// The number of standing components of each kind.
fn standing(plant: &Plant, age: Tick) -> BTreeMap<Kind, usize> {
    let mut kinds = BTreeMap::new();
    for node in stems(plant, age) {
        *kinds.entry(plant.kind_of(node)).or_default() += 1;
    }
    let organs = &plant.organs;
    for organ in (0..organs.len()).filter(|&organ| organs.birth[organ] <= age && age < organs.death[organ]) {
        *kinds.entry(organs.kind[organ]).or_default() += 1;
    }
    kinds
}

/// The internodes that stand.
fn stems(plant: &Plant, age: Tick) -> impl Iterator<Item = NodeId> {
    let stands =
        move |node: &usize| plant.nodes.birth[*node] <= age && age < plant.axes.shed[plant.nodes.axis[*node].index()];
    (0..plant.nodes.len()).filter(stands).map(|node| NodeId(node as u32))
}

fn bearing_kind(plant: &Plant, axis: usize) -> Option<Kind> {
    plant.axes.bearer[axis].some().map(|node| plant.kind_of(node))
}

#[test]
fn herbs_rise_from_the_nodes_of_a_rhizome_under_the_ground() {
    for number in 0..3 {
        let plant = grown("meadow_grass", number, 34);
        let kinds = standing(&plant, 34);
        for kind in
            [Kind::RhizomeInternode, Kind::TillerInternode, Kind::InflorescenceInternode, Kind::Leaf, Kind::Spikelet]
        {
            assert!(kinds.get(&kind).is_some_and(|count| *count > 5), "plant {number}: {kinds:?}");
        }
        for node in stems(&plant, 34) {
            let under = plant.frames.at(node).base[2] < 0.0;
            let of_rhizome = plant.kind_of(node) == Kind::RhizomeInternode;
            let rank = plant.nodes.rank[node.index()];
            assert!(!of_rhizome || under || rank == 1, "rhizome node {node:?} of rank {rank} stands above the ground");
        }
        for axis in 1..plant.axes.len() {
            let expected = match plant.axes.order[axis] {
                1 | 2 => Kind::RhizomeInternode,
                _ => Kind::TillerInternode,
            };
            assert_eq!(bearing_kind(&plant, axis), Some(expected), "axis {axis}");
        }
        let panicles = plant.axes.apex_fate.iter().zip(&plant.axes.order);
        assert!(panicles.filter(|(fate, order)| **fate == ApexFate::Flowered && **order == 2).count() > 0);
    }
}

/// "Very regular, the last node on every axis bearing a flower" (§5): of axes of order 3 at most.
#[test]
fn the_panicle_has_a_flower_at_the_end_of_every_axis() {
    let plant = grown("phlox", 0, 32);
    assert_eq!(plant.axes.order.iter().max(), Some(&3));
    let organs = &plant.organs;
    let flowers = organs.kind.iter().zip(&organs.node).filter(|(kind, _)| kind.class() == Class::Flower);
    let on: BTreeSet<NodeId> = flowers.map(|(_, node)| *node).collect();
    let mut ended = 0;
    for axis in 0..plant.axes.len() {
        let last = plant.axes.last_node[axis];
        if last.some().is_some() {
            assert_eq!(
                plant.axes.apex_fate[axis],
                ApexFate::Flowered,
                "axis {axis} of order {}",
                plant.axes.order[axis]
            );
            assert!(on.contains(&last), "axis {axis}");
            ended += 1;
        }
    }
    assert!(ended > 60, "{ended} flowers");
    // Branches stand two by two, in the axils of bracts.
    let pairs = plant.axes.bearer.iter().filter(|bearer| bearer.some().is_some());
    let mut on_node: BTreeMap<NodeId, usize> = BTreeMap::new();
    pairs.for_each(|node| *on_node.entry(*node).or_default() += 1);
    assert!(on_node.values().all(|count| *count == 2));
}

#[test]
fn a_flower_is_whorls_of_growth_units() {
    let plant = grown("dog_rose", 0, 4);
    let mut parts: BTreeMap<Kind, Vec<f32>> = BTreeMap::new();
    for axis in 1..plant.axes.len() {
        assert_eq!(bearing_kind(&plant, axis), Some(Kind::ReceptacleInternode));
        let own = plant.look_of(AxisId(axis as u32)).kind;
        parts.entry(own).or_default().push(plant.axes.azimuth[axis].to_degrees());
    }
    let counts: BTreeMap<Kind, usize> = parts.iter().map(|(kind, all)| (*kind, all.len())).collect();
    let expected =
        [(Kind::SepalInternode, 5), (Kind::PetalInternode, 5), (Kind::StamenInternode, 40), (Kind::StigmaInternode, 9)];
    assert_eq!(counts, BTreeMap::from(expected));
    // Each petal stands in the middle between two sepals: a tenth of a turn from the nearest.
    for petal in &parts[&Kind::PetalInternode] {
        let away = |sepal: &f32| {
            let between = (petal - sepal).rem_euclid(360.0);
            between.min(360.0 - between)
        };
        let nearest = parts[&Kind::SepalInternode].iter().map(away).fold(360.0, f32::min);
        assert!((nearest - 36.0).abs() < 0.01, "{nearest}");
    }
    assert_eq!(standing(&plant, 4)[&Kind::PetalInternode], 25);
    let faded = grown("dog_rose", 0, 14);
    let left = standing(&faded, 14);
    assert!(!left.contains_key(&Kind::PetalInternode) && left[&Kind::SepalInternode] == 20, "{left:?}");
}

/// Trunk, palm, bunch and strand: four structures (Fig. 16).
#[test]
fn a_date_palm_is_grown_of_four_structures() {
    let plant = grown("date_palm", 0, 360);
    let kinds = standing(&plant, 360);
    assert!(kinds[&Kind::Leaflet] > 3000 && kinds[&Kind::Fruit] > 100, "{kinds:?}");
    let axes = |order: u8| {
        let of = |axis: &usize| plant.axes.order[*axis] == order && plant.axes.shed[*axis] > 360;
        (0..plant.axes.len()).filter(of).filter(|axis| plant.axes.last_node[*axis].some().is_some()).collect::<Vec<_>>()
    };
    assert_eq!(axes(1).len(), 1, "one trunk");
    assert!((60..=130).contains(&axes(2).len()), "a crown of about a hundred palms: {}", axes(2).len());
    assert!(axes(3).iter().all(|&axis| plant.axes.origin[axis] == Origin::Adaptive) && axes(3).len() > 3, "bunches");
    assert!(axes(4).iter().all(|&axis| bearing_kind(&plant, axis) == Some(Kind::InflorescenceInternode)));
    assert!(axes(4).len() > 10 * axes(3).len(), "strands");
}

/// McClure's model: trunks joined below the ground, aerial branches plagiotropic.
#[test]
fn bamboo_culms_are_joined_below_the_ground() {
    let plant = grown("bamboo", 0, 72);
    let culms: Vec<usize> = (1..plant.axes.len()).filter(|&axis| plant.axes.order[axis] == 1).collect();
    assert!(culms.len() >= 5, "{} culms", culms.len());
    for &culm in &culms {
        let bearer = plant.axes.bearer[culm];
        let rank = plant.nodes.rank[bearer.index()];
        assert!(rank <= 9 && plant.frames.at(bearer).base[2] < 0.1, "culm {culm} on rank {rank}");
    }
    let kinds = standing(&plant, 72);
    assert!(kinds[&Kind::CulmInternode] > 300 && kinds[&Kind::Leaf] > 500, "{kinds:?}");
}
