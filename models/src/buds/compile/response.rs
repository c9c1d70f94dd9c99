//! Responses compiled beside the laws that they act on: a value for each age of the plant.
//!
//! They act in the order in which the species states them: hazards join one after another, factors are multiplied one
//! after another. No response changes the width of a record of words, so that a plant at the reference of all its
//! responses has the same bytes as a plant without any. Absent: the joining itself (`change`).

use super::change::ByAge;
use super::{OrderLaws, order_of};
use crate::buds::params::{Buds, Response, Target};
use crate::fault::{Fault, Path};
use crate::law::{Asked, Domain, Responding, ValueRange};
use phytomer_sim::site::calendar::Dates;
use std::collections::BTreeMap;

/// The largest ratio of a response to its value at the reference.
const MOST: f64 = 100.0;

const RATIO: ValueRange = ValueRange { min: 0.0, max: 1e9, what: "a response" };

/// The values of all that acts on a target: by age, and by shade if something responds to light.
type Acting = BTreeMap<Target, [Vec<f64>; 2]>;

/// Compiles the responses of a species up to the age `until`, for a plant whose ages have these dates, and lets them
/// act on the laws of its orders.
pub fn compile(
    buds: &Buds,
    orders: &mut [OrderLaws],
    (until, dates): (u32, Option<&Dates>),
    path: &Path,
    faults: &mut Vec<Fault>,
) {
    let mut again = Vec::new();
    for (index, laws) in orders.iter_mut().enumerate() {
        let number = order_of(index);
        let mut acting = Acting::new();
        for (place, response) in buds.response.iter().enumerate() {
            let path = path.key("response").index(place);
            if response.orders.as_ref().is_none_or(|orders| orders.contains(&number)) {
                let domain =
                    Domain { order: number, until, asked: Asked::Response, dates: dates.cloned(), ..Domain::default() };
                act(response, &domain, &path, &mut acting, &mut again);
            }
        }
        laws.light_alone = true;
        for (target, [by_age, by_shade]) in acting {
            laws.asks_light |= !by_shade.is_empty();
            let of = if target.is_hazard() { ByAge::hazards } else { ByAge::factors };
            let values = of(by_age, by_shade);
            laws.light_alone &= values.is_of_light_alone();
            respond(laws, target, values);
        }
    }
    for (place, response) in buds.response.iter().enumerate() {
        check(response, orders.len(), &path.key("response").index(place), faults);
    }
    crate::fault::tell_once(faults, again);
}

/// Faults of what a response acts on.
fn check(response: &Response, orders: usize, path: &Path, faults: &mut Vec<Fault>) {
    if response.acts_on.is_empty() {
        faults.push(Fault::new(&path.key("acts_on"), "the response acts on nothing", "at least one of its targets"));
    }
    let of = response.orders.iter().flatten();
    if let Some(order) = of.copied().find(|order| !(1..=orders).contains(&usize::from(*order))) {
        let problem = format!("the species has no order {order}");
        faults.push(Fault::new(&path.key("orders"), problem, format!("orders from 1 to {orders}")));
    }
}

/// Adds one response to what acts on its targets.
fn act(response: &Response, domain: &Domain, path: &Path, acting: &mut Acting, faults: &mut Vec<Fault>) {
    let law = path.key("law");
    let (hazards, ratios): (Vec<Target>, Vec<Target>) = response.acts_on.iter().partition(|target| target.is_hazard());
    let range = if hazards.is_empty() { RATIO } else { ValueRange::PROBABILITY };
    let mut values = match response.law.respond(domain, response.reference, &law, range) {
        Ok(values) => values,
        Err(mut found) => return faults.append(&mut found),
    };
    values.by_age.resize(domain.until as usize + 1, values.at_reference);
    for target in hazards {
        let [by_age, by_shade] = both(acting, target, &values, 0.0);
        let join = |joined: &mut Vec<f64>, values_of: &[f64]| {
            let d = values_of.iter().map(|q| q - values.at_reference);
            joined.iter_mut().zip(d).for_each(|(joined, d)| *joined += d * (1.0 - *joined));
        };
        join(by_age, &values.by_age);
        join(by_shade, &values.by_shade);
    }
    if ratios.is_empty() {
        return;
    }
    if let Some(fault) = ratio_fault(&values, response.reference, &law) {
        return faults.push(fault);
    }
    for target in ratios {
        let [by_age, by_shade] = both(acting, target, &values, 1.0);
        let multiply = |product: &mut Vec<f64>, values_of: &[f64]| {
            let ratios = values_of.iter().map(|value| value / values.at_reference);
            product.iter_mut().zip(ratios).for_each(|(product, ratio)| *product *= ratio);
        };
        multiply(by_age, &values.by_age);
        multiply(by_shade, &values.by_shade);
    }
}

/// What acts on a target so far, with room for the values of one more response.
fn both<'a>(acting: &'a mut Acting, target: Target, values: &Responding, none: f64) -> &'a mut [Vec<f64>; 2] {
    let both = acting.entry(target).or_insert_with(|| [vec![none; values.by_age.len()], Vec::new()]);
    if both[1].len() < values.by_shade.len() {
        both[1].resize(values.by_shade.len(), none);
    }
    both
}

/// The fault of a response that has no ratio to its value at the reference, or a ratio that is too large.
fn ratio_fault(values: &Responding, reference: f64, path: &Path) -> Option<Fault> {
    if values.at_reference <= 0.0 {
        let problem =
            format!("the response is {} at the reference {reference}, by which it is divided", values.at_reference);
        return Some(Fault::new(path, problem, "a response above 0 at its reference"));
    }
    let most =
        values.by_age.iter().chain(&values.by_shade).fold(0.0_f64, |most, value| most.max(value / values.at_reference));
    let problem = format!("the response is {most} times its value at the reference {reference}");
    (most > MOST).then(|| Fault::new(path, problem, format!("at most {MOST} times")))
}

/// Lets values by age act on a target.
fn respond(laws: &mut OrderLaws, target: Target, values: ByAge) {
    let OrderLaws { step, node, .. } = laws;
    match target {
        Target::Death => step.endanger(values),
        Target::Pause => step.delay(values),
        Target::Ramification => node.ramification_times(&values),
        Target::Flowering => {
            step.flower_times(values.clone());
            node.flowers_times(values);
        }
        Target::FruitSet => node.fruits_times(values),
        Target::Nodes => step.nodes_times(&values),
        Target::InternodeLength => node.lengths_times(&values),
        Target::LeafArea => node.leaf_areas_times(&values),
    }
}
