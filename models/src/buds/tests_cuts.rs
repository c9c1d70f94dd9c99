//! What a cut releases: closed forms of repeated heading, the order of released axes, and one plant whether growth runs
//! from operation to operation or follows the clock, on any number of threads.
//!
//! Absent: the columns of cuts themselves and what stands after them (`sim::plant`).

use super::params::{Axillary, GrowthUnit, Traumatic};
use super::tests::{chimera, hydra};
use super::{BudModel, Buds, Order};
use crate::contract::{components, seed_of};
use crate::law::{Count, Law};
use phytomer_sim::management::{Act, Choice, Column, Formula, Kept, Management, Operation, Region, Start, When};
use phytomer_sim::plant::{Cause, EventKind, NodeId, Origin, Plant};
use phytomer_sim::plot::{Plot, Sowing};
use phytomer_sim::{Tick, grow};
use std::sync::Arc;

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

/// A node a tick with two axillary buds, which lie dormant and all of which a cut releases.
fn whips() -> Buds {
    let order = |ramification: f64| Order {
        growth_unit: GrowthUnit { nodes: Count::from(1), ..GrowthUnit::default() },
        axillary: Axillary { buds: Count::from(2), ramification: Law::from(ramification), ..Axillary::default() },
        traumatic: Traumatic { probability: Law::from(1.0), ..Traumatic::default() },
        ..Order::default()
    };
    Buds { order: vec![order(0.0), order(0.0)], ..Buds::default() }
}

fn compiled(buds: &Buds, until: Tick) -> BudModel {
    buds.compile(until, &crate::fault::Path::root()).unwrap_or_else(|faults| panic!("{faults:?}"))
}

fn every(act: Act, first: Tick, every: Option<Tick>) -> Operation {
    let when = When { every, ..When::once(Start::Age(first)) };
    Operation { act, when, plants: None, choice: Choice::default() }
}

fn managed<'m>(model: &'m BudModel, operations: &[Operation], numbers: &[u32]) -> Plot<'m> {
    let sowing =
        |number: &u32| Sowing { species: 0, seed: seed_of(7, *number), place: [0.0; 3], sown: 2 * (number % 2) };
    let mut plot = Plot::new(0, vec![model], &numbers.iter().map(sowing).collect::<Vec<_>>());
    plot.manage(Management::of(Arc::from(operations.to_vec())));
    plot
}

fn grown(model: &BudModel, operations: &[Operation], numbers: &[u32], until: Tick) -> Vec<Plant> {
    let mut plot = managed(model, operations, numbers);
    grow(&mut plot, until, &mut ()).expect("nothing is recorded");
    plot.plants
}

/// Each heading doubles the whips: after k of them 2ᵏ grow on 2ᵏ − 1 stumps of three internodes, all of order 1.
#[test]
fn headings_double_the_axes_at_their_own_order() {
    let model = compiled(&whips(), 40);
    let head = every(Act::Head(Kept::Nodes(3)), 6, Some(6));
    for (k, tick) in [(0, 5), (1, 6), (1, 11), (2, 12), (3, 18), (5, 30), (5, 35)] {
        let plant = &grown(&model, std::slice::from_ref(&head), &[0], tick)[0];
        let (stumps, whips) = ((1 << k) - 1, 1 << k);
        assert_eq!(plant.axes.len(), stumps + whips, "after {k} cuts");
        assert!(plant.axes.order.iter().all(|order| *order == 1), "released at the order of the axis that was cut");
        assert!(plant.axes.origin[1..].iter().all(|origin| *origin == Origin::Traumatic));
        let standing = (0..plant.nodes.len() as u32).filter(|node| plant.stands(NodeId(*node), tick)).count();
        // Whips that the cut of tick 6 k releases make their first internode at the next.
        assert_eq!(standing, 3 * stumps + whips * (tick as usize - 6 * k), "at tick {tick}");
        let fallen = plant.nodes.len() - standing;
        assert_eq!(fallen, (5 - 3) * stumps, "two internodes fall with each whip");
        let pruned = plant.events.iter().flatten().filter(|event| event.kind == EventKind::Pruned).count();
        assert_eq!(pruned, stumps, "an event for each axis that was cut");
    }
}

#[test]
fn thinning_releases_nothing_from_an_axis_that_goes_on() {
    let model = compiled(&whips(), 40);
    let head = every(Act::Head(Kept::Nodes(3)), 6, None);
    let thin = every(Act::Thin, 12, None);
    let plants = grown(&model, &[head.clone(), thin.clone()], &[0], 20);
    // Both shoots of the stump are taken where they arise, and the stump has no bud left: it is dead.
    assert_eq!((plants[0].axes.len(), plants[0].death), (3, 12));
    assert_eq!(plants[0].cause_of_death(plants[0].axes.last_node[1]), Cause::Pruned);
    // Where one stays, the tree lives on.
    let first = Choice { first: Some(Arc::new(AtLeast(Column::Position, None))), most: Some(1), ..Choice::default() };
    let plants = grown(&model, &[head, Operation { choice: first, ..thin }], &[0], 20);
    assert_eq!((plants[0].axes.len(), plants[0].axes.shed[1] > 20, plants[0].axes.shed[2]), (3, true, 12));
}

/// A bud that a first cut leaves dormant may answer a later one: with probability ½ a stump that is cut back again and
/// again ends with no dormant bud.
#[test]
fn what_stays_dormant_may_answer_a_later_cut() {
    let mut buds = whips();
    buds.order[0].traumatic.probability = Law::from(0.5);
    buds.order[0].axillary.buds = Count::from(20);
    let model = compiled(&buds, 200);
    let head = every(Act::Head(Kept::Nodes(2)), 4, None);
    let clear = every(Act::Thin, 10, Some(5));
    let numbers: Vec<u32> = (0..200).step_by(2).collect();
    let plants = grown(&model, &[head, clear], &numbers, 14);
    let released =
        |plant: &Plant, tick| (0..plant.axes.len()).filter(|axis| plant.axes.appearance[*axis] == tick).count();
    let [first, second] = [4, 10].map(|tick| plants.iter().map(|plant| released(plant, tick)).sum::<usize>() as f64);
    // Of 2000 dormant buds half answer, then half of the rest; five standard errors of the binomial.
    assert!((first - 1000.0).abs() < 5.0 * (2000.0_f64 * 0.25).sqrt(), "{first}");
    let left = 2000.0 - first;
    assert!((second - left / 2.0).abs() < 5.0 * (left * 0.25).sqrt(), "{second} of {left}");
    assert!(plants.iter().all(|plant| plant.axes.order.iter().all(|order| *order == 1)));
}

fn calendar() -> Vec<Operation> {
    let strongest = Choice {
        only: Some(Arc::new(AtLeast(Column::Order, Some(2.0)))),
        first: Some(Arc::new(AtLeast(Column::Length, None))),
        share: Some(0.3),
        ..Choice::default()
    };
    let head = Operation { choice: strongest, ..every(Act::Head(Kept::Share(0.5)), 5, Some(4)) };
    let top = every(Act::Clear(Region::Above(0.4), u8::MAX), 9, Some(7));
    let tall =
        When { condition: Some(Arc::new(AtLeast(Column::Components, Some(150.0)))), ..When::once(Start::Age(1)) };
    let pick = every(Act::Harvest(0.5), 3, Some(1));
    vec![head, top, Operation { when: tall, ..every(Act::Stump(2), 1, None) }, pick]
}

#[test]
fn growth_ahead_and_by_the_clock_give_one_plant_on_any_number_of_threads() {
    let mut cut = 0;
    for buds in [chimera(), hydra()] {
        let model = compiled(&buds, 30);
        let numbers: Vec<u32> = (0..16).collect();
        let ahead = [1, 2, 7].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
            pool.install(|| grown(&model, &calendar(), &numbers, 30))
        });
        let mut clock = managed(&model, &calendar(), &numbers);
        for tick in 1..=30 {
            clock.site.begin(tick);
            clock.operate(tick).expect("no limit");
            clock.grow_to(tick).expect("no limit");
        }
        for (k, plant) in clock.plants.iter().enumerate() {
            cut += plant.cuts.all().len();
            for other in &ahead {
                assert_eq!(components(plant), components(&other[k]), "cuts between ticks");
                assert_eq!(other[k].nodes.component, ahead[0][k].nodes.component, "threads do not show");
            }
            let gone_or_there = (0..plant.nodes.len() as u32).map(NodeId);
            let there = gone_or_there.clone().filter(|node| plant.stands(*node, 30)).count();
            let gone = gone_or_there.filter(|node| plant.shed_of(*node) <= 30).count();
            assert_eq!(there + gone, plant.nodes.len(), "every internode stands or has fallen");
        }
    }
    assert!(cut > 30, "the calendar cuts: {cut}");
}

#[test]
fn without_operations_nothing_is_remembered_and_nothing_changes() {
    let model = compiled(&chimera(), 30);
    let plain = &grown(&model, &[], &[4], 30)[0];
    let idle = &grown(&model, &[every(Act::Thin, 31, None)], &[4], 30)[0];
    assert_eq!(components(plain), components(idle));
    assert_eq!((plain.nodes.component.clone(), plain.axes.component.clone()), {
        (idle.nodes.component.clone(), idle.axes.component.clone())
    });
    assert!(!plain.dormant.are_kept() && idle.dormant.are_kept());
}
