//! Chains of zones: where zones begin, how long they are and which are skipped, rank by rank, in grown plants and in
//! the forecast.
//!
//! Seeds are fixed; a bound is 4 standard errors of the stated probability. Absent: chains that were fitted to plants.

use super::params::{Axillary, Chain, End, GrowthUnit, Link, Pattern};
use super::{BudModel, Buds, Order};
use crate::contract;
use crate::fault::Path;
use crate::law::{Count, CountForm, Law};
use phytomer_sim::model::Grow;

fn weights(weights: &[f64]) -> Count {
    Count::from(CountForm { empirical: Some(weights.to_vec()), ..CountForm::default() })
}

fn link(length: Option<Count>, next: &[f64], ramification: f64) -> Link {
    Link { name: None, length, next: next.to_vec(), ramification: Some(Law::from(ramification)), state: None }
}

/// A bare zone of one or two nodes, a zone of two branches that two fifths of the units skip and three tenths begin in,
/// and a bare end.
fn chain(from: End) -> Chain {
    let bare = link(Some(weights(&[0.0, 0.5, 0.5])), &[0.6, 0.4], 0.0);
    let links = vec![bare, link(Some(Count::from(2)), &[], 1.0), link(None, &[], 0.0)];
    Chain { from, begins: vec![0.7, 0.3], chain: links }
}

fn buds(chain: Chain) -> Buds {
    let trunk = Order {
        growth_unit: GrowthUnit { nodes: Count::from(7), ..GrowthUnit::default() },
        axillary: Axillary { buds: Count::from(1), pattern: Pattern::Chain(chain), ..Axillary::default() },
        ..Order::default()
    };
    Buds { order: vec![trunk, Order::default()], ..Buds::default() }
}

fn compiled(buds: &Buds, until: u32) -> BudModel {
    buds.compile(until, &Path::root()).unwrap_or_else(|faults| panic!("{faults:?}"))
}

#[test]
fn zones_follow_one_another_as_their_chain_says() {
    // Begun in the second zone: ranks 1 and 2. Else after one or two nodes, and only where it is not skipped.
    let expected = [0.3, 0.3 + 0.7 * 0.5 * 0.6, 0.7 * 0.6, 0.7 * 0.5 * 0.6, 0.0, 0.0, 0.0];
    const PLANTS: u32 = 4000;
    for from in [End::Base, End::Tip] {
        let model = compiled(&buds(chain(from)), 1);
        let mut branches = [0.0; 7];
        for number in 0..PLANTS {
            let plant = contract::grown(&model, 1, &contract::seed_of(16, number));
            let bearers = plant.axes.bearer[1..].iter().map(|bearer| plant.nodes.rank[bearer.index()] as usize);
            let ranks: Vec<usize> = bearers.map(|rank| if from == End::Base { rank } else { 8 - rank }).collect();
            assert!(ranks.is_empty() || ranks.len() == 2 && ranks[0].abs_diff(ranks[1]) == 1, "{ranks:?}");
            ranks.iter().for_each(|rank| branches[rank - 1] += 1.0);
        }
        for (rank, (found, p)) in branches.iter().zip(expected).enumerate() {
            let found = found / f64::from(PLANTS);
            let error = (p * (1.0 - p) / f64::from(PLANTS)).sqrt();
            assert!((found - p).abs() <= 4.0 * error + 1e-12, "rank {}: {found} {p}", rank + 1);
        }
        let forecast = model.expectation(1).expect("a forecast");
        let axes = expected.iter().sum::<f64>();
        let found = forecast.orders[1].axes[1];
        assert!((found - axes).abs() < 1e-6, "{found} {axes}");
    }
}

#[test]
fn a_chain_keeps_the_contract_of_growth_models() {
    contract::check(&compiled(&buds(chain(End::Tip)), 6), 6, 5);
}

#[test]
fn faults_of_a_chain_are_told_with_their_place() {
    let mut wrong = chain(End::Base);
    wrong.begins = vec![0.2, 0.3, 0.4, 0.1];
    wrong.chain[0].length = None;
    wrong.chain[1].next = vec![-1.0];
    let faults = buds(wrong).compile(3, &Path::root()).unwrap_err();
    let told: Vec<String> = faults.iter().map(ToString::to_string).collect();
    for (place, expected) in [
        ("pattern.begins", "4 weights that sum to 1"),
        ("pattern.chain[0]", "the zone has no length, and other zones follow"),
        ("pattern.chain[1].next", "1 weights that sum to -1"),
    ] {
        assert!(told.iter().any(|fault| fault.contains(place) && fault.contains(expected)), "{place}: {told:?}");
    }
}
