//! Cuts: the remaining part is the part that can be reached from the ground, by a walk written apart from the tested
//! code; every component stands or is gone; and the order in which cuts are made does not matter.
//!
//! Absent: growth after a cut, which the contract of models tests.

use super::*;
use crate::mechanics::{Scratch, Tissue, Uprighting, Wood, bend};
use crate::pose::specimen::{Branch, Growth, Specimen};
use crate::random::Purpose;
use crate::shed::{note_falls, shed};
use crate::site::Site;

const LAST: Tick = 30;

fn leaf(node: NodeId) -> NewOrgan {
    NewOrgan { node, length: 0.1, width: 0.1, area: 0.01, insertion: 1.0, ..NewOrgan::LEAF }
}

/// Axes with their bearing axis and rank, of five nodes each, with a leaf on each node.
fn plant_of(bearers: &[Option<(usize, u32)>]) -> Plant {
    let branches: Vec<Branch> = bearers.iter().map(|&bearer| Branch { bearer, ..Branch::on(0, 1) }).collect();
    let mut plant = Specimen::grown(&branches, &[Trend::STRAIGHT], Growth::AxisByAxis).plant;
    plant.events = Some(Vec::new());
    (0..plant.nodes.len() as u32).for_each(|node| {
        plant.add_organ(leaf(NodeId(node)));
    });
    plant
}

/// Whether no cut by `age` lies between an internode and the ground.
fn reached(plant: &Plant, cuts: &[Cut], node: NodeId, age: Tick) -> bool {
    let (axis, rank) = (plant.nodes.axis[node.index()], plant.nodes.rank[node.index()]);
    let cut = cuts.iter().any(|cut| cut.axis == axis && cut.rank < rank && cut.tick <= age);
    !cut && plant.nodes.parent[node.index()].some().is_none_or(|parent| reached(plant, cuts, parent, age))
}

/// The first of all cuts between an internode and the ground.
fn first_below(plant: &Plant, cuts: &[Cut], node: NodeId) -> Cut {
    let mut below = Some(node);
    let mut found: Option<Cut> = None;
    while let Some(node) = below {
        let (axis, rank) = (plant.nodes.axis[node.index()], plant.nodes.rank[node.index()]);
        let of = cuts.iter().filter(|cut| cut.axis == axis && cut.rank < rank);
        found = of.copied().chain(found).min_by_key(|cut| (cut.tick, cut.by));
        below = plant.nodes.parent[node.index()].some();
    }
    found.expect("a cut below")
}

fn assert_reached(plant: &Plant, cuts: &[Cut]) {
    for age in 5..LAST {
        let (mut standing, mut gone) = (0, 0);
        let mut shown = vec![false; plant.nodes.len()];
        plant.each_standing(age, |stretch| stretch.nodes().for_each(|node| shown[node] = true));
        for node in (0..plant.nodes.len() as u32).map(NodeId) {
            let stands = reached(plant, cuts, node, age);
            assert_eq!((plant.stands(node, age), shown[node.index()]), (stands, stands), "{node:?} at {age}: {cuts:?}");
            // A branch of which every bud was cut is dead: it stands, and its leaves have ended with it.
            let branch = plant.axes.death[plant.nodes.axis[node.index()].index()];
            let (organ, foliate) = (node.index(), stands && age < branch);
            assert_eq!(plant.organ_stands(OrganId(node.0), age), foliate, "the leaf of {node:?} at {age}");
            if !stands && plant.shed_of(node) <= branch {
                let cause = first_below(plant, cuts, node).by.cause();
                assert_eq!((plant.organs.cause[organ], plant.cause_of_death(node)), (cause, cause));
                assert_eq!(plant.organs.death[organ], plant.shed_of(node));
            }
            *(if stands { &mut standing } else { &mut gone }) += 1;
            *(if foliate { &mut standing } else { &mut gone }) += 1;
        }
        for axis in (0..plant.axes.len() as u32).map(AxisId) {
            let of = |cut: &&Cut| cut.axis == axis && cut.tick <= age;
            let bearer = plant.axes.bearer[axis.index()].some();
            let lives = !cuts.iter().any(|cut| of(&cut)) && bearer.is_none_or(|node| reached(plant, cuts, node, age));
            assert_eq!(plant.bud_lives(axis, age), lives, "the bud of {axis:?} at {age}: {cuts:?}");
            let taken = matches!(plant.axes.apex_fate[axis.index()], ApexFate::Pruned | ApexFate::Harvested);
            assert_eq!(taken, plant.bud_end(axis) < NEVER);
            *(if lives { &mut standing } else { &mut gone }) += 1;
        }
        assert_eq!(standing + gone, plant.lived_by(age), "every component stands or is gone");
    }
}

#[test]
fn what_stands_is_what_can_be_reached_whatever_is_cut_and_in_whatever_order() {
    let mut words = PlantRandom::new(3, 1).stream(LineageKey(5), Purpose::Node);
    for _ in 0..300 {
        let mut any = |n: usize| words.word() as usize % n;
        let bearers: Vec<_> = (0..8).map(|axis| (axis > 0).then(|| (any(axis), 1 + any(5) as u32))).collect();
        let cut = |any: &mut dyn FnMut(usize) -> usize| {
            let (axis, rank, tick) = (AxisId(any(8) as u32), any(6) as u32, 5 + any(20) as u32);
            Cut { axis, rank, tick, by: [Taking::Pruning, Taking::Harvest][tick as usize % 2] }
        };
        let mut cuts: Vec<Cut> = (0..any(5)).map(|_| cut(&mut any)).collect();
        let mut plant = plant_of(&bearers);
        plant.cut_all(&cuts);
        shed(&mut plant);
        assert_reached(&plant, &cuts);
        cuts.reverse();
        let mut other = plant_of(&bearers);
        for at in &cuts {
            other.cut_all(&[*at]);
            shed(&mut other);
        }
        assert!((&plant.axes, &plant.organs, &plant.cuts) == (&other.axes, &other.organs, &other.cuts), "{cuts:?}");
        assert_eq!(plant.death, other.death);
    }
}

#[test]
fn a_cut_at_rank_0_takes_the_axis_and_of_the_trunk_the_plant() {
    let mut plant = plant_of(&[None, Some((0, 2)), Some((1, 3))]);
    plant.cut(AxisId(1), 0, 8);
    shed(&mut plant);
    assert_eq!((plant.axes.death[1], plant.axes.shed[1], plant.axes.shed[2]), (8, 8, 8));
    assert_eq!(plant.death, NEVER);
    plant.cut(AxisId::TRUNK, 0, 12);
    shed(&mut plant);
    assert_eq!((plant.death, plant.axes.shed[0]), (12, 12));
    assert!(plant.lives(11) && !plant.lives(12));
    note_falls(&mut plant, LAST);
    let events = plant.events.clone().unwrap();
    let told: Vec<_> = events.iter().map(|event| (event.tick, event.axis.0, event.kind)).collect();
    assert_eq!(told, [(8, 1, EventKind::Pruned), (8, 2, EventKind::Pruned), (12, 0, EventKind::Pruned)]);
}

/// A stump lives with what it still bears; without a bud it is dead wood that falls in its own time.
#[test]
fn a_stump_lives_with_its_last_bud() {
    for (bearer, death) in [(1, NEVER), (4, 10)] {
        let mut plant = plant_of(&[None, Some((0, bearer))]);
        plant.axes.shed_after[0] = 4;
        plant.cut(AxisId::TRUNK, 2, 10);
        shed(&mut plant);
        assert_eq!((plant.axes.death[0], plant.death), (death, death));
        assert_eq!(plant.shed_of(NodeId(1)), if death == NEVER { NEVER } else { 14 });
        assert_eq!((plant.shed_of(NodeId(2)), plant.death_of(NodeId(2))), (10, 10));
        assert_eq!(plant.cause_of_death(NodeId(1)), Cause::Branch);
        assert_eq!(plant.cause_of_death(NodeId(2)), Cause::Pruned);
    }
}

#[test]
fn dead_wood_that_is_cut_has_died_before() {
    let mut plant = plant_of(&[None, Some((0, 4))]);
    plant.axes.end_apex(AxisId(1), 6, ApexFate::Died);
    plant.cut(AxisId(1), 3, 9);
    shed(&mut plant);
    let above = NodeId(8);
    assert_eq!((plant.axes.apex_fate[1], plant.axes.death[1]), (ApexFate::Died, 6));
    assert_eq!((plant.death_of(above), plant.shed_of(above)), (6, 9));
    assert_eq!((plant.cause_of_death(above), plant.organs.cause[above.index()]), (Cause::Branch, Cause::Branch));
    assert_eq!(plant.shed_of(NodeId(7)), NEVER);
    // An apex that has become a flower is spent when the flower is cut off with it.
    plant.axes.end_apex(AxisId(0), 7, ApexFate::Flowered);
    plant.axes.spent[0] = 20;
    plant.cut(AxisId(0), 2, 12);
    shed(&mut plant);
    assert_eq!((plant.axes.apex_fate[0], plant.axes.death[0]), (ApexFate::Flowered, 12));
}

#[test]
fn a_lateral_that_was_cut_earlier_is_gone_earlier() {
    let mut plant = plant_of(&[None, Some((0, 4)), Some((1, 2))]);
    plant.cut(AxisId::TRUNK, 3, 15);
    plant.cut(AxisId(1), 1, 7);
    shed(&mut plant);
    let of = |axis: usize, rank: usize| plant.shed_of(NodeId((5 * axis + rank - 1) as u32));
    assert_eq!([of(0, 3), of(0, 4), of(1, 1), of(1, 2), of(2, 1)], [NEVER, 15, 15, 7, 7]);
    assert_eq!(plant.axes.apex_end, [15, 7, 7]);
}

#[test]
fn a_topped_rod_bends_as_one_that_was_never_longer() {
    let rod = |nodes: u32| {
        let branch = Branch { insertion: 1.5, nodes, length: 0.5, ..Branch::trunk(5, 0.5) };
        let mut plant = Specimen::grown(&[branch], &[Trend::STRAIGHT], Growth::AxisByAxis).plant;
        let tissue = Tissue { modulus: vec![1e8], density: vec![900.0], uprighting: Uprighting::default() };
        let wood = Wood { tissues: vec![tissue], bends: true, ..Wood::default() };
        plant.habit = Arc::new(Habit { wood: Some(wood), ..(*plant.habit).clone() });
        plant.nodes.diameter.fill(0.02);
        plant.nodes.diameter_tip.fill(0.02);
        plant
    };
    let (mut topped, mut short) = (rod(5), rod(3));
    topped.cut(AxisId::TRUNK, 3, 8);
    for plant in [&mut topped, &mut short] {
        shed(plant);
        bend(plant, 8, &Site::default(), &mut Scratch::default());
    }
    assert_eq!(topped.strain.curvature[..3], short.strain.curvature[..]);
    assert_eq!(topped.frames.base[..3], short.frames.base[..]);
    assert!(short.strain.curvature[0] != [0.0; 2]);
}
