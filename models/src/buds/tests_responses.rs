//! Responses: at their reference they leave every byte as it is; elsewhere they act as the closed forms say.
//!
//! The variable is the age of the plant, which needs no calendar: what matters is a value for each age. Bounds are four
//! standard errors. Absent: the shapes of responses (`law`).

use super::params::{Axillary, Flower, GrowthUnit, Internode, Leaf, Response, Target};
use super::tests::{chimera, hydra};
use super::{BudModel, Buds, Order};
use crate::contract;
use crate::fault::Path;
use crate::law::{Count, Law, Variate};
use phytomer_sim::expectation::Certainty;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::plant::{ApexFate, Class, Plant};
use phytomer_sim::site::calendar::{Calendar, Dates, Soil, Terms, TickLength};
use phytomer_sim::site::date::Date;
use serde_json::{Value, json};
use std::sync::Arc;

fn compiled(buds: &Buds, until: u32) -> BudModel {
    buds.compile(until, &Path::root()).unwrap_or_else(|faults| panic!("{faults:?}"))
}

fn response(acts_on: &[Target], law: Value, reference: f64) -> Response {
    let law = serde_json::from_value(law).expect("a law");
    Response { acts_on: acts_on.iter().copied().collect(), law, reference, orders: None }
}

/// 0.4 up to an age and `after` from it on; its reference is age 1.
fn step(acts_on: &[Target], at: u32, after: f64) -> Response {
    response(acts_on, json!({ "step": { "over": "age", "at": at, "before": 0.4, "after": after } }), 1.0)
}

fn responding(buds: &Buds, response: &[Response]) -> Buds {
    Buds { response: response.to_vec(), ..buds.clone() }
}

/// Everything in the columns of a plant, by which tables are written.
fn columns(plant: &Plant) -> String {
    format!("{:?} {:?} {:?} {:?}", plant.axes, plant.nodes, plant.organs, plant.events)
}

fn grown(model: &BudModel, until: u32, number: u32) -> Plant {
    contract::grown(model, until, &contract::seed_of(12, number))
}

#[test]
fn at_their_reference_all_responses_change_no_byte() {
    let always = response(&Target::ALL, json!(0.3), 120.0);
    let twice = [always.clone(), step(&Target::ALL, 1000, 0.9), always];
    for buds in [chimera(), hydra()] {
        let (plain, neutral) = (compiled(&buds, 14), compiled(&responding(&buds, &twice), 14));
        for number in 0..30 {
            assert!(columns(&grown(&plain, 14, number)) == columns(&grown(&neutral, 14, number)), "plant {number}");
        }
        assert_eq!(plain.expectation(14), neutral.expectation(14));
    }
}

/// What responds from an age on leaves all before it as it is, and each target changes something after it.
#[test]
fn responses_change_nothing_before_they_leave_their_reference() {
    let buds = chimera();
    for target in Target::ALL {
        let (plain, changed) = (compiled(&buds, 14), compiled(&responding(&buds, &[step(&[target], 8, 0.8)]), 14));
        let differs = |until| {
            let of = |model| (0..30).map(|number| columns(&grown(model, until, number))).collect::<Vec<_>>();
            of(&plain) != of(&changed)
        };
        assert!(!differs(7), "{target:?} acts before its time");
        assert!(differs(14), "{target:?} does not act");
    }
}

#[test]
fn plants_that_respond_keep_the_contract_of_growth_models() {
    let all = [step(&Target::ALL, 6, 0.7), step(&[Target::Nodes, Target::Pause], 3, 0.2)];
    for buds in [chimera(), hydra()] {
        contract::check(&compiled(&responding(&buds, &all), 12), 12, 5);
    }
}

/// The share of `happened` among `of` is `p`.
#[track_caller]
fn assert_share(happened: usize, of: usize, p: f64, what: &str) {
    let (share, error) = (happened as f64 / of as f64, (p * (1.0 - p) / of as f64).sqrt());
    assert!(of > 100 && (share - p).abs() <= 4.0 * error, "{what}: {share} of {of}, expected {p} ± {error}");
}

/// A bud that dies with p = .1 under a hazard .2 dies with .28; where the hazard is taken away that was at its
/// reference, .1 − .2 + .02 is below 0 and none dies. A bud without mortality of its own dies with .2.
#[test]
fn hazards_join_in_the_draw_of_the_bud() {
    let dead_of = |death: f64, law: Value, reference: f64| {
        let order = Order { death: Law::from(death), ..Order::default() };
        let buds = Buds { order: vec![order], ..Buds::default() };
        let model = compiled(&responding(&buds, &[response(&[Target::Death], law, reference)]), 2);
        let dies = |number: &u32| {
            let axes = grown(&model, 1, *number).axes;
            axes.apex_fate[0] == ApexFate::Died
        };
        (0..4000).filter(dies).collect::<Vec<_>>()
    };
    let from_age_1 = |hazard: f64| json!({ "step": { "over": "age", "at": 1, "before": 0, "after": hazard } });
    let plain = dead_of(0.1, json!(0.5), 0.0);
    let joined = dead_of(0.1, from_age_1(0.2), 0.0);
    assert_share(plain.len(), 4000, 0.1, "alone");
    assert_share(joined.len(), 4000, 0.28, "joined");
    assert!(plain.iter().all(|number| joined.contains(number)), "the draws are the same");
    assert_share(dead_of(0.0, from_age_1(0.2), 0.0).len(), 4000, 0.2, "a bud that does not die of itself");
    let before_age_1 = json!({ "step": { "over": "age", "at": 1, "before": 0.2, "after": 0 } });
    assert!(dead_of(0.1, before_age_1, 0.0).is_empty());
}

/// A plant on a soil with so much nitrogen, planted by a calendar of months.
fn on_soil(nitrogen: f64, buds: &Buds) -> BudModel {
    let planted = Date::new(2001, 7, 1).expect("a day");
    let soil = Some(Soil { own: nitrogen, applied: Vec::new(), season_begins: (7, 1) });
    let terms = Terms { planted, tick: TickLength::Days(30), degree_days: None, latitude: None, soil };
    let calendar = Calendar::of(&terms, 6, |_| None).expect("a calendar");
    let dates = Dates { calendar: Arc::new(calendar), sown: 0 };
    buds.compile_dated(6, Some(&dates), &Path::root()).unwrap_or_else(|faults| panic!("{faults:?}"))
}

/// Mitscherlich 1 − exp(−.02 (N + 20)) with the reference 120 is .351026, .849779, 1 and 1.058874 at 0, 60, 120 and
/// 240: by so much an internode of a metre is shorter or longer. At 120, and where no soil is told, nothing changes.
#[test]
fn nitrogen_acts_relative_to_its_reference() {
    let law = json!({ "mitscherlich": { "over": "nitrogen", "rate": 0.02, "offset": 20 } });
    let internode = Internode { length_cm: Variate::from(100.0), ..Internode::default() };
    let plain = Buds { order: vec![Order { internode, ..Order::default() }], ..Buds::default() };
    let buds = responding(&plain, &[response(&[Target::InternodeLength], law.clone(), 120.0)]);
    for (nitrogen, expected) in [(0.0, 0.351_026), (60.0, 0.849_779), (120.0, 1.0), (240.0, 1.058_874)] {
        let plant = grown(&on_soil(nitrogen, &buds), 6, 0);
        assert!(plant.nodes.length.iter().all(|length| (length - expected).abs() < 1e-6), "{nitrogen}");
        assert_eq!(plant.nodes.len(), 6);
    }
    let all = responding(&chimera(), &[response(&Target::ALL, law, 120.0)]);
    for number in 0..10 {
        let alone = columns(&grown(&compiled(&chimera(), 6), 6, number));
        assert!(alone == columns(&grown(&on_soil(120.0, &all), 6, number)));
        assert!(alone == columns(&grown(&compiled(&all, 6), 6, number)));
    }
}

/// A plant with constant laws under factors of .5 for nodes and 1.5 for the rest.
#[test]
fn what_is_multiplied_has_the_mean_of_the_product() {
    let trunk = Order {
        growth_unit: GrowthUnit { nodes: Count::from(5), ..GrowthUnit::default() },
        axillary: Axillary { buds: Count::from(2), ramification: Law::from(1.0), ..Axillary::default() },
        internode: Internode { length_cm: Variate::from(4.0), ..Internode::default() },
        leaf: Leaf { per_node: Count::from(1), length_cm: 6.0.into(), width_cm: 2.0.into(), ..Leaf::default() },
        flower: Flower { per_node: Count::from(1), lateral: Law::from(0.4), ..Flower::default() },
        ..Order::default()
    };
    let buds = Buds { order: vec![trunk, Order::default()], ..Buds::default() };
    let all = [
        step(&[Target::Nodes], 1, 0.2),
        step(&[Target::Ramification], 1, 0.1),
        step(&[Target::Flowering, Target::InternodeLength, Target::LeafArea], 1, 0.6),
    ];
    let all = all.map(|of| Response { reference: 0.0, orders: Some([1].into()), ..of });
    let model = compiled(&responding(&buds, &all), 8);
    // The law has the value of its first age at age 0 too: its reference is age 0.
    let plants: Vec<Plant> = (0..60).map(|number| grown(&model, 8, number)).collect();
    let of_trunk = |plant: &Plant| (0..plant.nodes.len()).filter(|&n| plant.nodes.axis[n].index() == 0).count();
    let nodes: usize = plants.iter().map(of_trunk).sum();
    let units = 60 * 8;
    // 2 or 3 nodes a unit, each with probability one half.
    assert_share(nodes - 2 * units, units, 0.5, "nodes above two");
    let laterals: usize = plants.iter().map(|plant| plant.axes.len() - 1).sum();
    assert_share(laterals, 2 * nodes, 0.25, "laterals of a certain ramification");
    let organs = |class: Class| {
        let mut areas = Vec::new();
        for plant in &plants {
            let on_trunk = |&organ: &usize| plant.nodes.axis[plant.organs.node[organ].index()].index() == 0;
            let of =
                (0..plant.organs.len()).filter(on_trunk).filter(|&organ| plant.organs.kind[organ].class() == class);
            areas.extend(of.map(|organ| plant.organs.area[organ]));
        }
        areas
    };
    assert_share(organs(Class::Flower).len(), nodes, 0.6, "flowers");
    let share = Leaf::default().form.area_share();
    assert!(organs(Class::Leaf).iter().all(|area| (area - 1.5 * 0.06 * 0.02 * share).abs() < 1e-7));
    let trunk = plants[0].nodes.length.iter().zip(&plants[0].nodes.axis).filter(|(_, axis)| axis.index() == 0);
    assert!(trunk.clone().count() > 10 && trunk.clone().all(|(length, _)| (length - 0.06).abs() < 1e-6));
}

/// The expectation of plants that respond is the mean of what grows.
#[test]
fn the_expectation_knows_the_responses() {
    let mut buds = chimera();
    buds.order[0].transition.clear();
    buds.order[0].traumatic.probability = Law::from(0.0);
    let rest = [Target::Ramification, Target::Flowering, Target::FruitSet, Target::Nodes];
    let all = [step(&rest, 4, 0.32), step(&[Target::Death], 5, 0.45), step(&[Target::Pause], 6, 0.3)];
    let (plain, model) = (compiled(&buds, 8), compiled(&responding(&buds, &all), 8));
    let (expected, other) = (model.expectation(8).unwrap(), plain.expectation(8).unwrap());
    assert_eq!(expected.certainty(), Certainty::Exact);
    let counts: Vec<f64> = (0..6000).map(|number| grown(&model, 8, number).lived_by(8) as f64).collect();
    let n = counts.len() as f64;
    let mean = counts.iter().sum::<f64>() / n;
    let error = (counts.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0) / n).sqrt();
    let (foretold, without) = (expected.components(8), other.components(8));
    assert!((mean - foretold).abs() < 4.0 * error, "{mean} ± {error}, expected {foretold}");
    assert!((mean - without).abs() > 20.0 * error, "{mean} ± {error} is that without responses, {without}");
}

#[test]
fn faults_of_responses() {
    let told = |response: Value| {
        let mut buds = chimera();
        buds.response = vec![serde_json::from_value(response).expect("a response")];
        let faults = buds.compile(9, &Path::root()).err().unwrap_or_default();
        faults.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
    };
    let of = |acts_on: &str, law: Value, reference: f64| {
        told(json!({ "acts_on": [acts_on], "law": law, "reference": reference }))
    };
    let line = |start: f64, slope: f64| json!({ "linear": { "over": "age", "start": start, "slope": slope } });
    let cases = [
        (
            of("nodes", line(0.0, 1.0), 0.0),
            "response[0].law: the response is 0 at the reference 0, by which it is divided",
        ),
        (of("nodes", line(-3.0, 1.0), 5.0), "response[0].law: the law is -2 at age 1"),
        (of("death", line(0.0, 0.2), 1.0), "response[0].law: the law is 1.2 at age 6"),
        (of("death", line(0.0, 0.1), 20.0), "response[0].law: the response is 2 at the reference 20"),
        (of("nodes", line(0.0, 0.0001), 0.0), "by which it is divided"),
        (of("nodes", json!({ "expression": "0.001 + age" }), 0.0), "times its value at the reference 0"),
        (
            of("pause", json!({ "expression": "0.1 * (age > dimension)" }), 1.0),
            "the law depends on dimension, on which no",
        ),
        (of("nodes", json!({ "expression": "nitrogen + age" }), 1.0), "the response depends on age and nitrogen"),
        (told(json!({ "acts_on": [], "law": 1, "reference": 1 })), "response[0].acts_on: the response acts on nothing"),
        (
            told(json!({ "acts_on": ["nodes"], "law": 1, "reference": 1, "orders": [1, 3] })),
            "response[0].orders: the species has no order 3",
        ),
    ];
    for (told, expected) in cases {
        assert!(told.contains(expected), "{told}\nexpected: {expected}");
        assert_eq!(told.matches(expected).count(), 1, "{told}");
    }
}
