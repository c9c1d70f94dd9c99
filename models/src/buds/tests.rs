//! The bud model under the contract of growth models: two species that between them use every feature of the model, and
//! small rules that no closed form covers.
//!
//! Absent: distributions of drawn numbers (`tests_drawn`), lineage keys (`tests_sets`), variables of laws
//! (`tests_variables`).

use super::params::{
    Apex, ApexEnd, Axillary, CountedLeaves, DragLaw, Facing, Flower, Fork, Fruit, GrowthUnit, Leaf, OrganTrend,
    Pattern, Phase, Phyllotaxis, Quantity, Reiteration, Relay, Rhythmic, Season, ShortUnit, Sibling, SpeedText, Speeds,
    StateTrends, Tended, ThickeningRule, Transition, Traumatic, Trend, UprightingLaw, Wood, Zone,
};
use super::params::{End, Internode};
use super::{Buds, Order};
use crate::contract;
use crate::fault::Path;
use crate::law::{Count, CountForm, Law, LawForm, Normal, Poisson, Variate, VariateForm};
use phytomer_sim::model::GrowthModel;
use phytomer_sim::plant::{ApexFate, Kind, NodeId, Origin};
use std::collections::BTreeMap;

fn poisson(mean: f64) -> Count {
    Count::from(CountForm { poisson: Some(Poisson { mean: Law::from(mean) }), ..CountForm::default() })
}

fn normal(mean: f64, sd: f64) -> Variate {
    let normal = Normal { mean: Law::from(mean), sd: Law::from(sd) };
    Variate::from(VariateForm { normal: Some(normal), min: Some(0.0), ..VariateForm::default() })
}

fn expression(text: &str) -> Law {
    Law::from(LawForm { expression: Some(text.to_owned()), ..LawForm::default() })
}

fn turning(inclination: f64, share: &str) -> OrganTrend {
    OrganTrend { inclination_deg: inclination.into(), share: expression(share) }
}

/// Random counts, polycyclism, short units, delays, states, reiteration both ways, terminal flowers and relays below.
pub(super) fn chimera() -> Buds {
    let short = ShortUnit { probability: Law::from(0.3), nodes: Count::from(1), length_cm: Variate::from(0.2) };
    let unit =
        GrowthUnit { nodes: poisson(1.5), neoformed: poisson(0.5), per_step: Count::from(2), short: Some(short) };
    let axillary = Axillary {
        buds: Count::from(2),
        ramification: Law::from(0.4),
        delay: poisson(0.7),
        state: Some("branch".to_owned()),
        ..Axillary::default()
    };
    let growing_up = Transition {
        from: "juvenile".to_owned(),
        to: "adult".to_owned(),
        probability: Law::from(0.2),
        sibling: None,
        relayed: false,
    };
    let trunk = Order {
        death: Law::from(0.05),
        pause: Law::from(0.2),
        growth_unit: unit,
        axillary,
        reiteration: Reiteration { buds: Count::from(1), probability: Law::from(0.01), ..Reiteration::default() },
        traumatic: Traumatic { probability: Law::from(0.5), delay: Count::from(1), ..Traumatic::default() },
        relay: Relay { on: vec![ApexEnd::Flower], count: Count::from(2), below: Count::from(1), ..Relay::default() },
        flower: Flower {
            terminal: Law::from(0.05),
            fruit_set: Law::from(0.5),
            life: poisson(1.0),
            ..Flower::default()
        },
        transition: vec![growing_up],
        insertion_deg: normal(3.0, 1.0),
        shed_after: Some(Count::from(5)),
        ..Order::default()
    };
    let branch = Order {
        speed: Speeds::from(SpeedText::Ratio("3/2".to_owned())),
        death: Law::from(0.15),
        insertion_deg: normal(60.0, 8.0),
        phyllotaxis: Phyllotaxis::Named("2/5".to_owned()),
        flower: Flower { lateral: Law::from(0.4), delay: poisson(1.0), fruit_set: Law::from(0.5), ..Flower::default() },
        leaf: Leaf { per_node: poisson(1.0), life: Some(poisson(3.0)), length_cm: normal(5.0, 1.0), ..Leaf::default() },
        shed_after: Some(Count::from(2)),
        ..Order::default()
    };
    let states = ["juvenile", "adult", "branch"].map(str::to_owned).to_vec();
    let season =
        Some(Season { ticks_per_year: Quantity::from(4), leaf_fall: Some(Count::from(3)), leaf_fall_when: None });
    Buds { states, season, order: vec![trunk, branch], ..Buds::default() }
}

/// Zones from both ends, laws of rank and of state, determinate axes, relays on death and completion, composite trends.
pub(super) fn hydra() -> Buds {
    let zone = |from, first: u32, last: Option<u32>, ramification: Option<Law>| {
        let (first, last) = (Count::from(first), last.map(Count::from));
        Zone { name: None, from, first, last, ramification, state: None }
    };
    let zones = vec![zone(End::Tip, 1, Some(2), None), zone(End::Base, 1, Some(1), Some(expression("0.2 * rank")))];
    let by_state = BTreeMap::from([("long".to_owned(), Law::from(0.1)), ("short".to_owned(), Law::from(0.6))]);
    let pauses = Law::from(LawForm { by_state: Some(by_state), ..LawForm::default() });
    let phase = |from_rank: u32, inclination: f64, share: f64| {
        let (inclination_deg, share) = (Variate::from(inclination), Variate::from(share));
        Phase { from_rank: Count::from(from_rank), inclination_deg, share }
    };
    let phases = vec![phase(1, 80.0, 0.2), phase(4, 10.0, 0.1)];
    let order = Order {
        death: Law::from(0.1),
        pause: pauses,
        growth_unit: GrowthUnit { nodes: Count::from(4), ..GrowthUnit::default() },
        axillary: Axillary {
            buds: Count::from(1),
            ramification: expression("0.2 + 0.1 * rank"),
            pattern: Pattern::Rhythmic(Rhythmic { zones }),
            ..Axillary::default()
        },
        apex: Apex { units: Some(poisson(3.0)), ..Apex::default() },
        relay: Relay { on: vec![ApexEnd::Death, ApexEnd::Completed], probability: Law::from(0.4), ..Relay::default() },
        transition: vec![Transition {
            from: "long".to_owned(),
            to: "short".to_owned(),
            probability: Law::from(0.3),
            sibling: None,
            relayed: false,
        }],
        internode: Internode { length_cm: normal(4.0, 1.0), ..Internode::default() },
        insertion_deg: Variate::from(45.0),
        trend: Trend::Composite(phases),
        leaf: Leaf {
            per_node: Count::from(3),
            facing: Facing::Sky,
            trend: Some(turning(150.0, "min(1, 0.25 * dimension)")),
            ..Leaf::default()
        },
        fruit: Fruit { trend: Some(turning(180.0, "1")), ..Fruit::default() },
        flower: Flower { lateral: Law::from(0.2), fruit_set: expression("0.25 * rank"), ..Flower::default() },
        ..Order::default()
    };
    let leafless = Order { leaf: Leaf { per_node: Count::from(0), ..Leaf::default() }, ..order.clone() };
    Buds {
        states: vec!["long".to_owned(), "short".to_owned()],
        season: None,
        order: vec![order, leafless],
        ..Buds::default()
    }
}

/// Sets of equal axes: relays at passages and at ends, of which the leaders pass on and the others do not, trends by
/// state; branches that divide, or persist when they are complete.
fn candelabrum() -> Buds {
    let tended = |inclination: f64| Tended { inclination_deg: inclination.into(), share: normal(0.2, 0.05) };
    let by_state = [("up", 0.0), ("out", 80.0)].map(|(state, inclination)| (state.to_owned(), tended(inclination)));
    let passage = |from: &str, to: &str, sibling, relayed| Transition {
        from: from.to_owned(),
        to: to.to_owned(),
        probability: Law::from(0.35),
        sibling,
        relayed,
    };
    let trunk = Order {
        death: Law::from(0.05),
        axillary: Axillary { buds: Count::from(1), ramification: Law::from(0.2), ..Axillary::default() },
        relay: Relay {
            on: vec![ApexEnd::Completed],
            count: Count::from(3),
            probability: Law::from(0.6),
            below: Count::from(1),
            ..Relay::default()
        },
        apex: Apex { units: Some(Count::from(4)), ..Apex::default() },
        transition: vec![
            passage("up", "out", Some(Sibling::Others), true),
            passage("up", "out", None, false),
            passage("out", "up", Some(Sibling::Leader), true),
        ],
        trend: Trend::ByState(StateTrends { by_state: by_state.into() }),
        ..Order::default()
    };
    let fork = Fork {
        axes: CountForm { empirical: Some(vec![1.0, 0.0, 1.0, 1.0]), ..CountForm::default() }.into(),
        insertion_deg: normal(30.0, 5.0),
    };
    let branch = Order {
        apex: Apex { units: Some(Count::from(3)), persists: Some(poisson(2.0)), fork: Some(fork) },
        shed_after: Some(Count::from(1)),
        insertion_deg: normal(50.0, 5.0),
        ..Order::default()
    };
    Buds {
        states: vec!["up".to_owned(), "out".to_owned()],
        season: None,
        order: vec![trunk, branch],
        ..Buds::default()
    }
}

/// In each set of relays one relay leads, and it alone passes into another state; a passage is relayed while the apex
/// lives; the branch of a completed apex lives as long as it persists, and the axes into which it divides are of its
/// order.
#[test]
fn sets_of_equal_axes_are_told_apart_by_their_leaders() {
    let model = candelabrum().compile(12, &Path::root()).unwrap();
    let (mut passages, mut forks, mut persisting) = (0, 0, 0);
    for number in 0..30 {
        let plant = contract::grown(&model, 12, &contract::seed_of(4, number));
        let axes = &plant.axes;
        for axis in 1..axes.len() {
            let bearing = plant.nodes.axis[axes.bearer[axis].index()].index();
            let ended = axes.apex_end[bearing] == axes.appearance[axis];
            passages += u32::from(axes.origin[axis] == Origin::Relay && !ended);
            if axes.origin[axis] == Origin::Fork {
                assert!(ended && axes.apex_fate[bearing] == ApexFate::Completed && axes.order[axis] == 2);
                assert_eq!(axes.bearer[axis], axes.last_node[bearing], "an apex divides at its tip");
                forks += 1;
            }
        }
        let completed = |&axis: &usize| axes.order[axis] == 2 && axes.apex_fate[axis] == ApexFate::Completed;
        persisting += (0..axes.len()).filter(completed).filter(|&axis| axes.spent[axis] > axes.apex_end[axis]).count();
    }
    assert!(passages > 20 && forks > 20 && persisting > 20, "{passages} {forks} {persisting}");
}

#[test]
fn the_bud_model_keeps_the_contract_of_growth_models() {
    let simple = Buds { order: vec![Order::default()], ..Buds::default() };
    for (species, until) in [(chimera(), 14), (hydra(), 9), (candelabrum(), 10), (simple, 6)] {
        contract::check(&species.compile(until, &Path::root()).unwrap(), until, 4);
    }
}

/// The chimera in wood that bends, thickens by pipes or rings and rights itself.
#[test]
fn species_that_bend_keep_it_too() {
    let pipe = ThickeningRule::Pipe { mm2_per_leaf: 1.0.into(), leaves: CountedLeaves::Living, source: None };
    let rings = ThickeningRule::Rings { width_mm: 0.2.into(), mm2_per_leaf_m2: 100.0.into(), source: None };
    for thickening in [pipe, rings] {
        let mut species = chimera();
        species.wood = Some(Wood {
            modulus_gpa: Some(expression("1 + 0.2 * dimension")),
            density_kg_m3: Some(Law::from(900.0)),
            drag: Some(DragLaw { c: 2.0.into(), n: 0.5.into(), source: None, assumed: true }),
            thickening: Some(thickening),
            ..Wood::default()
        });
        let uprighting = UprightingLaw { strain: 0.002.into(), rate_deg_per_m: 5.0.into(), ..UprightingLaw::default() };
        species.order[1].wood.uprighting = Some(uprighting);
        contract::check(&species.compile(14, &Path::root()).unwrap(), 14, 4);
    }
}

/// A relay stands on the node of its rank, below the tip by as many nodes as stated, at the order of the ended axis.
/// Two species of buds, and one of buds beside a tree that is rebuilt at each age, in one plot.
#[test]
fn species_share_a_plot() {
    let [trunk, hydra] = [chimera(), hydra()].map(|species| species.compile(14, &Path::root()).unwrap());
    contract::two_species_share_a_plot([&trunk, &hydra], 14, 6, 0.12);
    let tree = contract::sound();
    contract::two_species_share_a_plot([&tree, &hydra], 12, 6, 0.12);
}

#[test]
fn relays_and_traumatic_reiterations_keep_the_order_of_the_ended_axis() {
    let model = chimera().compile(14, &Path::root()).unwrap();
    let mut seen = [0, 0];
    for number in 0..40 {
        let plant = contract::grown(&model, 14, &contract::seed_of(9, number));
        for axis in 0..plant.axes.len() {
            let origin = plant.axes.origin[axis];
            if !matches!(origin, Origin::Relay | Origin::Traumatic) {
                continue;
            }
            let bearer = plant.axes.bearer[axis];
            let ended = plant.nodes.axis[bearer.index()].index();
            let last = plant.axes.last_node[ended];
            let below = plant.nodes.rank[last.index()] - plant.nodes.rank[bearer.index()];
            assert_eq!(plant.axes.order[axis], plant.axes.order[ended]);
            assert_eq!(plant.axes.appearance[axis], plant.axes.apex_end[ended], "it appears where the apex ends");
            let (fate, nodes_below) = match origin {
                Origin::Relay => (ApexFate::Flowered, 1),
                _ => (ApexFate::Died, 0),
            };
            assert_eq!((plant.axes.apex_fate[ended], below), (fate, nodes_below));
            seen[usize::from(origin == Origin::Relay)] += 1;
        }
    }
    assert!(seen.iter().all(|&count| count > 10), "{seen:?}");
}

/// A bud released by the death of its apex stands where it lay dormant, in the axil of its leaf.
#[test]
fn a_released_bud_stands_in_the_axil_of_its_leaf() {
    let trunk = Order {
        death: Law::from(0.3),
        leaf: Leaf { per_node: Count::from(3), ..Leaf::default() },
        axillary: Axillary { buds: Count::from(2), ..Axillary::default() },
        traumatic: Traumatic { probability: Law::from(1.0), ..Traumatic::default() },
        ..Order::default()
    };
    let model = Buds { order: vec![trunk], ..Buds::default() }.compile(12, &Path::root()).unwrap();
    let plant = contract::grown(&model, 12, &contract::seed_of(3, 1));
    let leaf_azimuth = |node: NodeId, position: u16| {
        let organs = &plant.organs;
        let on_node = (0..organs.len()).find(|&organ| {
            organs.node[organ] == node && organs.kind[organ] == Kind::Leaf && organs.position[organ] == position
        });
        organs.azimuth[on_node.expect("a leaf at each position")]
    };
    let released = (0..plant.axes.len()).filter(|&axis| plant.axes.origin[axis] == Origin::Traumatic);
    let mut count = 0;
    for axis in released {
        let leaf = leaf_azimuth(plant.axes.bearer[axis], plant.axes.position[axis]);
        assert!((plant.axes.azimuth[axis] - leaf).abs() < 1e-5, "axis {axis}");
        count += 1;
    }
    assert!(count > 4, "{count} buds were released");
}

/// The laws of a lateral flower are evaluated at the rank of its node.
#[test]
fn a_flower_asks_its_laws_at_the_rank_of_its_node() {
    let order = Order {
        growth_unit: GrowthUnit { nodes: Count::from(3), ..GrowthUnit::default() },
        flower: Flower { lateral: Law::from(1.0), fruit_set: expression("rank == 2"), ..Flower::default() },
        ..Order::default()
    };
    // A fruit comes a tick after its flower: of the nodes of tick 5 at age 6.
    let model = Buds { order: vec![order], ..Buds::default() }.compile(6, &Path::root()).unwrap();
    let plant = contract::grown(&model, 5, &contract::seed_of(1, 0));
    let of_fruits = (0..plant.organs.len()).filter(|&organ| plant.organs.kind[organ] == Kind::Fruit);
    let ranks: Vec<u16> = of_fruits.map(|organ| plant.nodes.unit_rank[plant.organs.node[organ].index()]).collect();
    assert_eq!(ranks, [2; 5]);
}

/// A law of a variable that does not apply at its place is a fault, and is never silently ignored.
#[test]
fn a_law_of_rank_where_no_rank_applies_is_refused() {
    let ranked = |change: fn(&mut Order, Law)| {
        let mut order = Order { relay: Relay { on: vec![ApexEnd::Death], ..Relay::default() }, ..Order::default() };
        change(&mut order, expression("0.1 * rank"));
        Buds { order: vec![order], ..Buds::default() }.compile(5, &Path::root()).is_err()
    };
    assert!(ranked(|order, law| order.relay.probability = law));
    assert!(ranked(|order, law| order.traumatic.probability = law));
    assert!(ranked(|order, law| order.internode.thickening_mm = law));
    assert!(ranked(|order, law| order.death = law));
    assert!(!ranked(|order, law| order.axillary.ramification = law));
}

#[test]
fn organs_turn_by_their_own_age_and_others_do_not() {
    let habit = hydra().compile(9, &Path::root()).unwrap().habit();
    let leaf = habit.organ_trend(1, Kind::Leaf).unwrap();
    assert_eq!(leaf.shares, [0.0, 0.25, 0.5, 0.75, 1.0], "ages past the last are as the last");
    assert!((leaf.inclination.to_degrees() - 150.0).abs() < 1e-6);
    assert_eq!(habit.organ_trend(2, Kind::Fruit).unwrap().shares, [1.0]);
    assert_eq!(habit.organ_trend(1, Kind::Flower), None);
    assert!(habit.faces_the_sky(1, Kind::Leaf) && !habit.faces_the_sky(1, Kind::Fruit));
    assert!(habit.faces_the_sky(1, Kind::Leaf) && !habit.faces_the_sky(1, Kind::Fruit));
    assert!(chimera().compile(9, &Path::root()).unwrap().habit().organ_trends.is_empty());
}
