//! The order-specific recursion M(o,q)(n) = s_o [M(o,q)(n − 1) + g_o (1{o = q} + k_o a_o M(o+1,q)(n − 1))], M(0) = 0,
//! for three random sets of laws, against the cohorts that `--dry-run` sums and against grown plants; and the cohorts
//! against grown plants where laws are richer than the recursion.

use crate::grown::{PLANTS, Sample, compiled, plant, units_by_order};
use phytomer_models::buds::params::{
    Apex, ApexEnd, Axillary, End, Flower, Fork, GrowthUnit, Pattern, Relay, Rhythmic, Sibling, SpeedForm, SpeedText,
    Speeds, Transition, Traumatic, Zone, ZoneState,
};
use phytomer_models::buds::{Buds, Order};
use phytomer_models::law::{Count, CountForm, Law, LawForm, Poisson};
use phytomer_sim::GrowthModel as _;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng as _, SeedableRng as _};
use std::collections::BTreeMap;

#[derive(Debug, Clone, Copy)]
struct Constant {
    death: f64,
    pause: f64,
    buds: u32,
    ramification: f64,
}

fn random_laws(seed: u64) -> [Constant; 3] {
    let mut words = ChaCha8Rng::seed_from_u64(seed);
    let mut share = |most: f64| most * f64::from(words.next_u32()) / 4_294_967_296.0;
    [0; 3].map(|_| Constant {
        death: share(0.2),
        pause: share(0.6),
        buds: 1 + share(3.0) as u32,
        ramification: share(1.0),
    })
}

/// The recursion, as in the documentation of `BudModel::expectation_from`; orders from 0.
fn recursion(laws: &[Constant; 3], order: usize, counted: usize, ticks: u32) -> f64 {
    if order > 2 || ticks == 0 {
        return 0.0;
    }
    let Constant { death, pause, buds, ramification } = laws[order];
    let own = f64::from(u8::from(order == counted));
    let lateral = f64::from(buds) * ramification * recursion(laws, order + 1, counted, ticks - 1);
    (1.0 - death) * (recursion(laws, order, counted, ticks - 1) + (1.0 - pause) * (own + lateral))
}

fn species(laws: &[Constant; 3]) -> Buds {
    let order = |law: &Constant| Order {
        death: Law::from(law.death),
        pause: Law::from(law.pause),
        axillary: Axillary {
            buds: Count::from(law.buds),
            ramification: Law::from(law.ramification),
            ..Axillary::default()
        },
        ..Order::default()
    };
    Buds { order: laws.iter().map(order).collect(), ..Buds::default() }
}

#[test]
fn cohorts_equal_the_recursion_and_plants_follow_both() {
    for seed in [1, 2, 3] {
        let laws = random_laws(seed);
        let until = 8;
        let model = compiled(&species(&laws), until);
        for from in 0..3_usize {
            let summed = model.expectation_from(from as u8 + 1, until).unwrap();
            for counted in 0..3 {
                for age in 0..=until {
                    let (cohorts, closed) =
                        (summed.orders[counted].units[age as usize], recursion(&laws, from, counted, age));
                    assert!(
                        (cohorts - closed).abs() <= 1e-9 * closed.max(1.0),
                        "set {seed}, M({from},{counted})({age})"
                    );
                }
            }
        }
        let plants: Vec<_> = (0..PLANTS).map(|number| units_by_order(&plant(&model, number, until), until)).collect();
        for counted in 0..3 {
            let sample = Sample::of(plants.iter().map(|units| units[counted] as f64));
            sample.assert_mean(recursion(&laws, 0, counted, until), &format!("set {seed}, order {}", counted + 1));
        }
    }
}

/// Ages, ranks, speeds, relays, traumatic reiteration, random nodes and delays: the recursion does not cover these
/// laws, the cohorts do.
#[test]
fn cohorts_follow_laws_of_age_and_random_counts() {
    let trunk = Order {
        death: expression("0.004 * dimension"),
        pause: expression("min(0.5, 0.03 * age)"),
        growth_unit: GrowthUnit { nodes: poisson(1.6), per_step: Count::from(2), ..GrowthUnit::default() },
        axillary: Axillary {
            buds: Count::from(2),
            ramification: expression("0.2 * rank / (1 + rank)"),
            delay: poisson(1.0),
            ..Axillary::default()
        },
        relay: Relay {
            on: vec![ApexEnd::Death],
            count: Count::from(2),
            probability: Law::from(0.7),
            ..Relay::default()
        },
        flower: Flower {
            lateral: Law::from(0.3),
            fruit_set: expression("0.1 * rank / (1 + rank)"),
            ..Flower::default()
        },
        traumatic: Traumatic { probability: Law::from(0.3), ..Traumatic::default() },
        ..Order::default()
    };
    let branch = Order {
        speed: Speeds::from(SpeedText::Ratio("2/3".to_owned())),
        death: Law::from(0.05),
        apex: Apex {
            units: Some(Count::from(CountForm { empirical: Some(vec![0.0, 1.0, 2.0, 1.0]), ..CountForm::default() })),
            ..Apex::default()
        },
        ..Order::default()
    };
    let until = 12;
    let model = compiled(&Buds { order: vec![trunk, branch], ..Buds::default() }, until);
    let expected = model.expectation(until).unwrap();
    let plants: Vec<_> = (0..PLANTS).map(|number| plant(&model, number, until)).collect();
    for order in [1_u8, 2] {
        let of_order = |axis: usize, plant: &phytomer_sim::Plant| plant.axes.order[axis] == order;
        let nodes = Sample::of(plants.iter().map(|plant| {
            (0..plant.nodes.len()).filter(|&node| of_order(plant.nodes.axis[node].index(), plant)).count() as f64
        }));
        let axes = Sample::of(
            plants.iter().map(|plant| (0..plant.axes.len()).filter(|&axis| of_order(axis, plant)).count() as f64),
        );
        let organs = Sample::of(plants.iter().map(|plant| {
            let of = |organ: usize| plant.nodes.axis[plant.organs.node[organ].index()].index();
            (0..plant.organs.len()).filter(|&organ| of_order(of(organ), plant)).count() as f64
        }));
        let means = &expected.orders[usize::from(order) - 1];
        organs.assert_mean(means.organs[until as usize], &format!("organs of order {order}"));
        nodes.assert_mean(means.nodes[until as usize], &format!("nodes of order {order}"));
        axes.assert_mean(means.axes[until as usize], &format!("axes of order {order}"));
    }
}

/// Passages that are relayed, of the leaders of sets or of the others, and apices that divide: cohorts of leaders and
/// of other axes are followed apart.
#[test]
fn cohorts_follow_leaders_passages_and_forks() {
    let until = 9;
    let weights =
        |weights: &[f64]| Count::from(CountForm { empirical: Some(weights.to_vec()), ..CountForm::default() });
    let passage = |from: &str, to: &str, sibling, relayed| Transition {
        from: from.to_owned(),
        to: to.to_owned(),
        probability: expression("0.25 + 0.01 * cycle"),
        sibling,
        relayed,
    };
    let trunk = Order {
        death: Law::from(0.08),
        axillary: Axillary { buds: Count::from(1), ramification: Law::from(0.3), ..Axillary::default() },
        relay: Relay {
            on: vec![ApexEnd::Death],
            count: weights(&[0.0, 1.0, 1.0, 2.0]),
            probability: Law::from(0.6),
            delay: poisson(0.5),
            ..Relay::default()
        },
        transition: vec![
            passage("up", "out", Some(Sibling::Others), true),
            passage("up", "flat", Some(Sibling::Leader), false),
            passage("out", "up", None, true),
        ],
        pause: by_state(&[("up", 0.1), ("out", 0.5), ("flat", 0.8)]),
        ..Order::default()
    };
    let fork = Fork { axes: weights(&[1.0, 0.0, 3.0]), insertion_deg: 30.0.into() };
    let branch = Order {
        apex: Apex { units: Some(weights(&[0.0, 0.0, 1.0, 1.0])), persists: Some(Count::from(3)), fork: Some(fork) },
        ..Order::default()
    };
    let states = ["up", "out", "flat"].map(str::to_owned).to_vec();
    let model = compiled(&Buds { states, order: vec![trunk, branch], ..Buds::default() }, until);
    let expected = model.expectation(until).unwrap();
    let plants: Vec<_> = (0..PLANTS).map(|number| plant(&model, number, until)).collect();
    for order in [1_u8, 2] {
        let axes = plants.iter().map(|plant| plant.axes.order.iter().filter(|of| **of == order).count() as f64);
        let of_order =
            |plant: &phytomer_sim::Plant, node: usize| plant.axes.order[plant.nodes.axis[node].index()] == order;
        let nodes =
            plants.iter().map(|plant| (0..plant.nodes.len()).filter(|&node| of_order(plant, node)).count() as f64);
        let means = &expected.orders[usize::from(order) - 1];
        Sample::of(axes).assert_mean(means.axes[until as usize], &format!("axes of order {order}"));
        Sample::of(nodes).assert_mean(means.nodes[until as usize], &format!("nodes of order {order}"));
    }
}

fn expression(text: &str) -> Law {
    Law::from(LawForm { expression: Some(text.to_owned()), ..LawForm::default() })
}

fn poisson(mean: f64) -> Count {
    Count::from(CountForm { poisson: Some(Poisson { mean: Law::from(mean) }), ..CountForm::default() })
}

fn by_state(laws: &[(&str, f64)]) -> Law {
    let by_state = laws.iter().map(|(state, law)| ((*state).to_owned(), Law::from(*law))).collect();
    Law::from(LawForm { by_state: Some(by_state), ..LawForm::default() })
}

/// Speeds drawn once an axis and zones drawn once a growth unit: cohorts split by speed, and the mean over the zones.
#[test]
fn cohorts_follow_drawn_speeds_and_zones() {
    let until = 10;
    let model = compiled(&drawn_species(), until);
    let expected = model.expectation(until).unwrap();
    let plants: Vec<_> = (0..PLANTS).map(|number| plant(&model, number, until)).collect();
    for order in [1_u8, 2] {
        let means = &expected.orders[usize::from(order) - 1];
        for age in [until / 2, until] {
            let nodes = Sample::of(plants.iter().map(|plant| {
                let of = |&node: &usize| plant.axes.order[plant.nodes.axis[node].index()] == order;
                (0..plant.nodes.len()).filter(|node| of(node) && plant.nodes.birth[*node] <= age).count() as f64
            }));
            nodes.assert_mean(means.nodes[age as usize], &format!("nodes of order {order} at age {age}"));
            let axes = Sample::of(plants.iter().map(|plant| {
                let of = |&axis: &usize| plant.axes.order[axis] == order && plant.axes.appearance[axis] <= age;
                (0..plant.axes.len()).filter(of).count() as f64
            }));
            axes.assert_mean(means.axes[age as usize], &format!("axes of order {order} at age {age}"));
        }
    }
}

/// Three speeds; two zones that may overlap, of which the first has a state and the second a law of its own; released
/// dormant buds.
fn drawn_species() -> Buds {
    let weights =
        |weights: &[f64]| Count::from(CountForm { empirical: Some(weights.to_vec()), ..CountForm::default() });
    let speeds = |texts: &[&str], weights: &[f64]| {
        let empirical = Some(texts.iter().map(|&text| SpeedText::Ratio(text.to_owned())).collect());
        Speeds::from(SpeedForm { empirical, weights: Some(weights.to_vec()), ..SpeedForm::default() })
    };
    let of_rank = Law::from(LawForm { expression: Some("0.2 * rank / (1 + rank)".to_owned()), ..LawForm::default() });
    let zones = vec![
        Zone {
            name: None,
            from: End::Tip,
            first: weights(&[0.0, 2.0, 1.0]),
            last: Some(weights(&[0.0, 1.0, 1.0, 2.0])),
            ramification: None,
            state: Some(ZoneState::Shares(BTreeMap::from([("slender".to_owned(), 3.0), ("stout".to_owned(), 1.0)]))),
        },
        Zone {
            name: None,
            from: End::Base,
            first: weights(&[0.0, 1.0, 1.0, 1.0]),
            last: None,
            ramification: Some(of_rank),
            state: None,
        },
    ];
    let trunk = Order {
        speed: speeds(&["1/2", "1", "4/3"], &[1.0, 2.0, 1.0]),
        death: Law::from(0.04),
        growth_unit: GrowthUnit { nodes: weights(&[1.0, 1.0, 2.0, 3.0, 1.0]), ..GrowthUnit::default() },
        axillary: Axillary {
            buds: Count::from(2),
            ramification: Law::from(0.4),
            pattern: Pattern::Rhythmic(Rhythmic { zones }),
            ..Axillary::default()
        },
        traumatic: Traumatic { probability: Law::from(0.5), ..Traumatic::default() },
        ..Order::default()
    };
    let units = Some(weights(&[0.0, 0.0, 1.0, 1.0, 1.0]));
    let by_state = BTreeMap::from([("stout".to_owned(), Law::from(3.0)), ("slender".to_owned(), Law::from(1.0))]);
    let nodes = Law::from(LawForm { by_state: Some(by_state), ..LawForm::default() });
    let nodes = Count::from(CountForm { constant: Some(nodes), ..CountForm::default() });
    let branch = Order {
        speed: speeds(&["2/3", "3"], &[3.0, 1.0]),
        apex: Apex { units, ..Apex::default() },
        growth_unit: GrowthUnit { nodes, ..GrowthUnit::default() },
        ..Order::default()
    };
    let states = ["stout", "slender"].map(str::to_owned).to_vec();
    Buds { states, order: vec![trunk, branch], ..Buds::default() }
}
