//! Operations on a small plant of which every length and height is known: what each takes, and what protection keeps.
//!
//! The plant: a trunk of ten internodes of 0.1 m, upright; level branches of five internodes of 0.1 m from its nodes 2,
//! 5 and 8, and a twig on the third node of the lowest. Absent: growth after a cut, which models answer.

use super::*;
use crate::plant::{ApexFate, AxisId, Class, EventKind, NewOrgan, NodeId, Trend};
use crate::pose::pose;
use crate::pose::specimen::{Branch, Growth, Specimen};
use crate::shape::{Capsule, HalfSpace, Shape};
use crate::shed::shed;
use std::f32::consts::FRAC_PI_2;

const TICK: Tick = 40;

/// Whether a column is at least a number; the column itself without one.
#[derive(Debug)]
struct AtLeast(Column, Option<f64>);

impl Formula for AtLeast {
    fn value(&self, known: &mut dyn FnMut(Column) -> f64) -> f64 {
        let value = known(self.0);
        self.1.map_or(value, |least| f64::from(u8::from(value >= least)))
    }

    fn columns(&self) -> Vec<Column> {
        vec![self.0]
    }
}

fn at_least(column: Column, least: f64) -> Option<SharedFormula> {
    Some(Arc::new(AtLeast(column, Some(least))))
}

fn plant() -> Plant {
    let level = |rank| Branch { insertion: FRAC_PI_2, azimuth: 0.0, ..Branch::on(0, rank) };
    let twig = Branch { insertion: 0.3, ..Branch::on(1, 3) };
    let branches = [Branch::trunk(10, 0.1), level(2), level(5), level(8), twig];
    let mut plant = Specimen::grown(&branches, &[Trend::STRAIGHT], Growth::AxisByAxis).plant;
    plant.axes.order.copy_from_slice(&[1, 2, 2, 2, 3]);
    plant.events = Some(Vec::new());
    shed(&mut plant);
    pose(&mut plant, TICK - 1);
    plant
}

/// The last rank of each axis that an operation leaves.
fn left(act: Act, choice: Choice) -> Vec<u32> {
    let mut plant = plant();
    let operation = Operation { act, when: When::once(Start::Age(TICK)), plants: None, choice };
    operation.apply(&mut plant, TICK);
    shed(&mut plant);
    let mut left = vec![0; plant.axes.len()];
    plant.each_standing(TICK, |stretch| left[stretch.axis.index()] += stretch.nodes().len() as u32);
    left
}

fn all() -> Choice {
    Choice::default()
}

fn only(column: Column, least: f64) -> Choice {
    Choice { only: at_least(column, least), ..all() }
}

#[test]
fn heading_keeps_a_number_a_share_or_a_length() {
    assert_eq!(left(Act::Head(Kept::Nodes(4)), all()), [4, 4, 0, 0, 4]);
    assert_eq!(left(Act::Head(Kept::Nodes(4)), only(Column::Order, 2.0)), [10, 4, 4, 4, 4]);
    assert_eq!(left(Act::Head(Kept::Share(0.4)), only(Column::Order, 2.0)), [10, 2, 2, 2, 0]);
    assert_eq!(left(Act::Head(Kept::Share(0.0)), only(Column::Order, 2.0)), [10, 0, 0, 0, 0]);
    assert_eq!(left(Act::Head(Kept::Length(0.3)), only(Column::Order, 2.0)), [10, 3, 3, 3, 3], "0.3 are three of 0.1");
    assert_eq!(left(Act::Head(Kept::Length(0.29)), only(Column::Order, 2.0))[1], 2);
    assert_eq!(left(Act::Head(Kept::Share(1.0)), all()), [10, 5, 5, 5, 5], "the tips alone");
}

#[test]
fn topping_and_hedging_cut_where_an_axis_enters_a_region() {
    assert_eq!(left(Act::Clear(Region::Above(0.75), u8::MAX), all()), [7, 5, 5, 0, 5]);
    assert_eq!(left(Act::Clear(Region::Above(0.45), 1), all()), [4, 5, 0, 0, 5], "of the trunk alone");
    let outside = |shape: Shape| left(Act::Clear(Region::Outside(Arc::new(shape)), u8::MAX), all());
    let hedged = outside(Shape::HalfSpace(HalfSpace { point: [0.25, 0.0, 0.0], normal: [1.0, 0.0, 0.0] }));
    let boxed = left(Act::Clear(Region::outside_box([0.5, 0.5, 0.95]), u8::MAX), all());
    assert!(hedged[0] == 10 && boxed[0] == 9, "{hedged:?} {boxed:?}");
    assert!((1..4).all(|axis| boxed[axis] == 2), "{boxed:?}: branches of 0.5 m in a box of 0.25 m to each side");
    // Within a rod about the trunk that ends in half a ball: of branches at 0.2, 0.5 and 0.8 m the last is shorter.
    let rod = Capsule { start: [0.0; 3], end: [0.0, 0.0, 0.6], radius: 0.35 };
    let rounded = outside(Shape::Capsule(rod));
    assert!(rounded[..4] == [9, 3, 3, 2], "{rounded:?}");
}

#[test]
fn thinning_takes_branches_and_never_the_trunk() {
    assert_eq!(left(Act::Thin, all()), [10, 0, 0, 0, 0]);
    assert_eq!(left(Act::Thin, only(Column::Order, 3.0)), [10, 5, 5, 5, 0]);
    assert_eq!(left(Act::Thin, only(Column::Height, 0.45)), [10, 5, 0, 0, 5]);
    let highest: SharedFormula = Arc::new(AtLeast(Column::Height, None));
    let share = Choice { first: Some(highest), share: Some(0.5), ..all() };
    assert_eq!(left(Act::Thin, share), [10, 5, 0, 0, 5], "two of four, the highest first");
}

/// What is protected keeps its bearers: nothing below it is cut.
#[test]
fn protection_keeps_what_bears_the_protected() {
    let protect = |column, least| Choice { protect: at_least(column, least), ..all() };
    assert_eq!(left(Act::Thin, protect(Column::Order, 3.0)), [10, 5, 0, 0, 5], "the twig and its branch");
    assert_eq!(left(Act::Head(Kept::Nodes(2)), protect(Column::Order, 3.0)), [2, 5, 0, 0, 5]);
    assert_eq!(left(Act::Head(Kept::Nodes(3)), protect(Column::Order, 3.0)), [3, 3, 0, 0, 5], "above the twig");
    assert_eq!(left(Act::Clear(Region::Above(0.1), u8::MAX), protect(Column::Order, 1.0)), [10, 5, 5, 5, 5]);
}

#[test]
fn stumping_and_removal_take_the_trunk() {
    assert_eq!(left(Act::Stump(6), all()), [6, 5, 5, 0, 5]);
    assert_eq!(left(Act::Remove, all()), [0; 5]);
}

/// The events tell each axis once, and only cuts that are needed are made.
#[test]
fn what_goes_along_is_not_cut_itself() {
    let mut plant = plant();
    let operation = Operation {
        act: Act::Clear(Region::Above(0.05), u8::MAX),
        when: When::once(Start::Age(TICK)),
        plants: None,
        choice: all(),
    };
    operation.apply(&mut plant, TICK);
    assert_eq!(plant.cuts.all().len(), 1, "one cut of the trunk takes all");
    let events = plant.events.unwrap_or_default();
    assert!(events.len() == 5 && events.iter().all(|event| event.kind == EventKind::Pruned && event.tick == TICK));
}

fn fruit(node: u32, birth: u32, life: u32) -> NewOrgan {
    NewOrgan {
        node: NodeId(node),
        kind: crate::plant::Kind::ALL.into_iter().find(|kind| kind.class() == Class::Fruit).expect("a fruit"),
        birth,
        death: birth + life,
        cause: Cause::LifeLength,
        ..NewOrgan::LEAF
    }
}

/// Of two fruits of one life, the first ends a branch that dies when it falls, the second will be eaten at that tick.
/// The first is ripe and can still be picked; of the second it is not known when it would fall.
#[test]
fn the_last_fruit_of_a_branch_is_picked_and_a_fruit_that_pests_will_eat_is_not_ripe() {
    let mut plant = plant();
    let tip = plant.axes.last_node[4].some().expect("the last node of the twig");
    plant.axes.end_apex(AxisId(4), 30, ApexFate::Flowered);
    plant.axes.spent[4] = TICK;
    plant.add_organ(fruit(tip.0, 30, 10));
    plant.add_organ(NewOrgan { cause: Cause::Attacked, ..fruit(3, 30, 10) });
    shed(&mut plant);
    assert_eq!(plant.death_of(tip), TICK, "the branch dies with its fruit");
    let when = When::once(Start::Age(TICK));
    Operation { act: Act::Harvest(0.9), when, plants: None, choice: all() }.apply(&mut plant, TICK);
    shed(&mut plant);
    assert_eq!(plant.organs.cause, [Cause::Harvested, Cause::Attacked]);
}

/// Fruits of lives of ten ticks, born at 20, 25, 30 and 35: at tick 40 the first has fallen, the second would fall, the
/// third has all but its end behind it, the last the half.
#[test]
fn a_harvest_picks_what_is_ripe_and_thinning_what_is_chosen() {
    let picked = |act: Act, choice: Choice| {
        let mut plant = plant();
        for organ in [fruit(3, 20, 10), fruit(4, 30, 10), fruit(4, 31, 10), fruit(6, 35, 10)] {
            plant.add_organ(organ);
        }
        let cause = if act == Act::ThinFruits { Cause::Pruned } else { Cause::Harvested };
        let operation = Operation { act, when: When::once(Start::Age(TICK)), plants: None, choice };
        operation.apply(&mut plant, TICK);
        shed(&mut plant);
        let told: u32 = plant.events.iter().flatten().map(|event| event.count).sum();
        let picked: Vec<usize> = (0..4).filter(|organ| plant.organs.cause[*organ] == cause).collect();
        assert!(picked.iter().all(|organ| plant.organs.death[*organ] == TICK));
        assert_eq!(told as usize, picked.len(), "events count the fruits");
        picked
    };
    assert_eq!(picked(Act::Harvest(0.9), all()), [1, 2]);
    assert_eq!(picked(Act::Harvest(1.0), all()), [1], "at the tick at which it would fall");
    assert_eq!(picked(Act::Harvest(0.5), all()), [1, 2, 3]);
    assert_eq!(picked(Act::ThinFruits, only(Column::Rank, 6.0)), [3]);
    let oldest: SharedFormula = Arc::new(AtLeast(Column::Age, None));
    assert_eq!(picked(Act::ThinFruits, Choice { first: Some(oldest), most: Some(1), ..all() }), [1]);
}
