//! Numbers that may be bare, have a source, or be drawn: once an axis, a growth unit, a set of relays or a leaf.
//!
//! A constant is the same plant however it is written and takes no random word; a drawn number has the distribution
//! that is stated. Seeds are fixed; a bound is 4 standard errors of the stated distribution. Absent: the expectation of
//! drawn speeds and zones, which stands with the literature tests.

use super::params::{
    Apex, ApexEnd, Axillary, Divergence, End, GrowthUnit, Leaf, NamedPhyllotaxis, Pattern, Phase, Phyllotaxis,
    Reiteration, Relay, Rhythmic, Season, SpeedText, Tended, Trend, Zone,
};
use super::{BudModel, Buds, Order};
use crate::contract;
use crate::fault::Path;
use crate::law::{
    Count, CountForm, Law, LawForm, Quantity, QuantityForm, SpeedForm, Speeds, Uniform, Variate, VariateForm,
};
use phytomer_sim::Plant;
use phytomer_sim::plant::{AxisId, Kind, Origin};

fn weights(weights: &[f64]) -> Count {
    Count::from(CountForm { empirical: Some(weights.to_vec()), ..CountForm::default() })
}

fn uniform(min: f64, max: f64) -> Variate {
    let uniform = Uniform { min: Law::from(min), max: Law::from(max) };
    Variate::from(VariateForm { uniform: Some(uniform), ..VariateForm::default() })
}

fn ratio(text: &str) -> SpeedText {
    SpeedText::Ratio(text.to_owned())
}

fn speeds(texts: &[&str], weights: Option<&[f64]>) -> Speeds {
    let empirical = Some(texts.iter().map(|text| ratio(text)).collect());
    Speeds::from(SpeedForm { empirical, weights: weights.map(<[f64]>::to_vec), ..SpeedForm::default() })
}

fn zones(first: Count, last: Count) -> Pattern {
    let zone = Zone { name: None, from: End::Base, first, last: Some(last), ramification: None, state: None };
    Pattern::Rhythmic(Rhythmic { zones: vec![zone] })
}

fn compiled(buds: &Buds, until: u32) -> BudModel {
    buds.compile(until, &Path::root()).unwrap_or_else(|faults| panic!("{faults:?}"))
}

/// The ways in which the numbers of [`species`] are written.
struct Numbers {
    count: fn(u32) -> Count,
    measure: fn(f64) -> Variate,
    quantity: fn(u32) -> Quantity,
    speed: fn(&str) -> Speeds,
}

/// A species in which each of the numbers is written as `n` says.
fn species(n: &Numbers) -> Buds {
    let leaf = Leaf { area_share: Some((n.measure)(0.65)), ..Leaf::default() };
    let divergence = Divergence { divergence_deg: (n.measure)(100.0), first_deg: (n.measure)(-20.7) };
    let phase = |rank, inclination| Phase {
        from_rank: (n.count)(rank),
        inclination_deg: (n.measure)(inclination),
        share: (n.measure)(0.13),
    };
    let trunk = Order {
        speed: (n.speed)("3/2"),
        shed_after: Some((n.count)(3)),
        phyllotaxis: Phyllotaxis::Divergence(divergence),
        trend: Trend::Composite(vec![phase(1, 12.3), phase(4, 45.1)]),
        leaf,
        growth_unit: GrowthUnit { nodes: weights(&[0.0, 1.0, 1.0, 2.0]), ..GrowthUnit::default() },
        apex: Apex { units: Some(weights(&[0.0, 0.0, 1.0, 1.0, 1.0])), ..Apex::default() },
        relay: Relay { on: vec![ApexEnd::Completed], below: (n.count)(1), ..Relay::default() },
        axillary: Axillary {
            buds: Count::from(1),
            ramification: Law::from(0.6),
            pattern: zones((n.count)(1), (n.count)(2)),
            ..Axillary::default()
        },
        reiteration: Reiteration {
            buds: Count::from(1),
            probability: Law::from(0.1),
            order: (n.quantity)(2),
            ..Reiteration::default()
        },
        ..Order::default()
    };
    let tended = Tended { inclination_deg: (n.measure)(75.3), share: (n.measure)(0.1) };
    let branch = Order {
        death: Law::from(0.2),
        speed: (n.speed)("2/3"),
        shed_after: Some((n.count)(1)),
        phyllotaxis: Phyllotaxis::Degrees((n.measure)(144.0)),
        trend: Trend::Tended(tended),
        ..Order::default()
    };
    let season = Some(Season { ticks_per_year: (n.quantity)(5), leaf_fall: Some((n.count)(2)), leaf_fall_when: None });
    Buds { states: Vec::new(), season, order: vec![trunk, branch], ..Buds::default() }
}

fn bare() -> Numbers {
    Numbers {
        count: Count::from,
        measure: Variate::from,
        quantity: Quantity::from,
        speed: |text| Speeds::from(ratio(text)),
    }
}

fn sourced() -> Numbers {
    Numbers {
        count: |n| {
            let constant = Some(Law::from(f64::from(n)));
            Count::from(CountForm { constant, source: Some("a field book".to_owned()), ..CountForm::default() })
        },
        measure: |x| {
            let value = Some(Law::from(LawForm { value: Some(x), ..LawForm::default() }));
            Variate::from(VariateForm { value, assumed: true, ..VariateForm::default() })
        },
        quantity: |value| {
            Quantity::from(QuantityForm { value, source: Some("a field book".to_owned()), ..QuantityForm::default() })
        },
        speed: |text| Speeds::from(SpeedForm { value: Some(ratio(text)), assumed: true, ..SpeedForm::default() }),
    }
}

fn degenerate() -> Numbers {
    Numbers {
        count: |n| weights(&[vec![0.0; n as usize], vec![2.0]].concat()),
        measure: |x| uniform(x, x),
        quantity: Quantity::from,
        speed: |text| speeds(&[text, "7"], Some(&[3.0, 0.0])),
    }
}

#[test]
fn a_constant_is_one_plant_however_it_is_written() {
    let until = 16;
    let model = compiled(&species(&bare()), until);
    for (way, numbers) in [("with its source", sourced()), ("as a distribution", degenerate())] {
        let other = compiled(&species(&numbers), until);
        assert_eq!(model.habit, other.habit, "{way}");
        for number in 0..20 {
            let seed = contract::seed_of(4, number);
            let (one, two) = (contract::grown(&model, until, &seed), contract::grown(&other, until, &seed));
            assert!(one.components() > 30, "plant {number} has {} components", one.components());
            assert!(contract::components(&one) == contract::components(&two), "plant {number} {way}");
            assert!(two.own_trends.of(AxisId::TRUNK).is_none(), "{way}: constant trends are the habit's");
        }
        for (laws, others) in model.orders.iter().zip(&other.orders) {
            let words =
                |laws: &super::compile::OrderLaws| [laws.head.width, laws.step.width, laws.node.width, laws.end.width];
            assert_eq!(words(laws), words(others), "{way}: a constant takes no word");
        }
        assert_eq!(model.expectation_from(2, until), other.expectation_from(2, until), "{way}");
    }
}

/// A trunk of one node a tick. Each node has one branch, which draws everything that a branch can draw.
fn drawn() -> Buds {
    let axillary = Axillary { buds: Count::from(1), ramification: Law::from(1.0), ..Axillary::default() };
    let trunk = Order { axillary, ..Order::default() };
    let phase = |from_rank, inclination_deg, share| Phase { from_rank, inclination_deg, share };
    let branch = Order {
        speed: speeds(&["1/2", "2/3", "2"], Some(&[1.0, 2.0, 1.0])),
        shed_after: Some(weights(&[1.0, 0.0, 1.0, 2.0])),
        phyllotaxis: Phyllotaxis::Divergence(Divergence {
            divergence_deg: Variate::from(180.0),
            first_deg: uniform(-30.0, 60.0),
        }),
        trend: Trend::Composite(vec![
            phase(Count::from(1), uniform(40.0, 80.0), Variate::from(0.1)),
            phase(weights(&[0.0, 0.0, 1.0, 0.0, 3.0]), Variate::from(90.0), uniform(0.1, 0.3)),
        ]),
        leaf: Leaf { area_share: Some(uniform(0.5, 0.9)), ..Leaf::default() },
        ..Order::default()
    };
    let leaf_fall = Some(weights(&[0.0, 1.0, 0.0, 0.0, 3.0]));
    let season = Some(Season { ticks_per_year: Quantity::from(6), leaf_fall, leaf_fall_when: None });
    Buds { season, order: vec![trunk, branch], ..Buds::default() }
}

/// The mean of a sample whose members have the stated mean and variance.
fn assert_mean(sample: &[f64], mean: f64, variance: f64, what: &str) {
    let found = sample.iter().sum::<f64>() / sample.len() as f64;
    let error = (variance / sample.len() as f64).sqrt();
    assert!(sample.len() >= 1000, "{what}: {} draws", sample.len());
    assert!((found - mean).abs() <= 4.0 * error, "{what}: mean {found}, expected {mean} ± 4 × {error}");
}

fn branches(plant: &Plant) -> impl Iterator<Item = usize> {
    (0..plant.axes.len()).filter(|&axis| plant.axes.order[axis] == 2)
}

#[test]
fn an_axis_draws_once_what_is_its_own() {
    let until = 24;
    let model = compiled(&drawn(), until);
    let plants: Vec<Plant> =
        (0..150).map(|number| contract::grown(&model, until, &contract::seed_of(7, number))).collect();
    let of_axes = |of: &dyn Fn(&Plant, usize) -> Option<f64>| -> Vec<f64> {
        plants.iter().flat_map(|plant| branches(plant).filter_map(|axis| of(plant, axis)).collect::<Vec<_>>()).collect()
    };
    let falls = of_axes(&|plant, axis| Some(f64::from(plant.axes.shed_after[axis])));
    assert_mean(&falls, 2.0, 1.5, "ticks to the fall");
    assert!(falls.iter().all(|&ticks| [0.0, 2.0, 3.0].contains(&ticks)));

    let first =
        |plant: &Plant, axis: usize| (0..plant.nodes.len()).find(|&node| plant.nodes.axis[node].index() == axis);
    let azimuths =
        of_axes(&|plant, axis| first(plant, axis).map(|node| f64::from(plant.nodes.azimuth[node]).to_degrees()));
    assert_mean(&azimuths, 15.0, 90.0 * 90.0 / 12.0, "azimuth of the first leaf");

    let trends = |plant: &Plant, axis: usize| plant.own_trends.of(AxisId(axis as u32)).expect("it has drawn").to_vec();
    let inclinations = of_axes(&|plant, axis| Some(trends(plant, axis)[0].inclination.to_degrees()));
    assert_mean(&inclinations, 60.0, 40.0 * 40.0 / 12.0, "inclination of the first phase");
    let shares = of_axes(&|plant, axis| Some(trends(plant, axis)[1].share));
    assert_mean(&shares, 0.2, 0.2 * 0.2 / 12.0, "share of the second phase");

    // Steps of a branch of 12 ticks: 6, 8 or 24; at each age those of its own speed.
    let nodes_at = |plant: &Plant, axis: usize, ticks: u32| {
        let birth = plant.axes.birth[axis];
        let by = |node: &usize| plant.nodes.axis[*node].index() == axis && plant.nodes.birth[*node] <= birth + ticks;
        (birth + ticks <= until).then(|| (0..plant.nodes.len()).filter(by).count())
    };
    let steps = of_axes(&|plant, axis| nodes_at(plant, axis, 12).map(|nodes| nodes as f64));
    assert_mean(&steps, 11.5, (30.25 + 2.0 * 12.25 + 156.25) / 4.0, "steps in 12 ticks");
    for (plant, axis) in plants.iter().take(5).flat_map(|plant| branches(plant).map(move |axis| (plant, axis))) {
        let by_three =
            nodes_at(plant, axis, 3).and_then(|three| nodes_at(plant, axis, 12).map(|twelve| (three, twelve)));
        assert!(by_three.is_none_or(|steps| [(1, 6), (2, 8), (6, 24)].contains(&steps)), "{by_three:?}");
    }

    let turns = of_axes(&|plant, axis| {
        let of_second = |node: &usize| plant.nodes.axis[*node].index() == axis && plant.nodes.trend[*node] == 1;
        let rank = (0..plant.nodes.len()).find(of_second).map(|node| f64::from(plant.nodes.rank[node]));
        rank.filter(|_| nodes_at(plant, axis, 8).is_some())
    });
    assert_mean(&turns, 3.5, 0.75, "rank from which the second phase holds");
}

#[test]
fn a_leaf_draws_its_share_and_its_fall() {
    let until = 20;
    let model = compiled(&drawn(), until);
    let (mut shares, mut falls) = (Vec::new(), Vec::new());
    for number in 0..20 {
        let plant = contract::grown(&model, until, &contract::seed_of(11, number));
        let organs = &plant.organs;
        for organ in (0..organs.len()).filter(|&organ| organs.kind[organ] == Kind::Leaf) {
            let axis = plant.nodes.axis[organs.node[organ].index()].index();
            let (birth, death) = (organs.birth[organ], organs.death[organ]);
            assert!((birth + 1..=birth + 6).contains(&death), "a leaf of tick {birth} falls within a year: {death}");
            falls.push(f64::from(death % 6));
            if plant.axes.order[axis] == 2 {
                shares.push(f64::from(organs.area[organ]) / f64::from(organs.length[organ] * organs.width[organ]));
            }
        }
    }
    assert!(falls.iter().all(|&fall| fall == 1.0 || fall == 4.0));
    assert_mean(&falls, 3.25, 27.0 / 16.0, "the tick of the year of the fall");
    assert_mean(&shares, 0.7, 0.4 * 0.4 / 12.0, "the share of its area");
}

/// Units of five nodes; the branches of each stand on its first ranks, up to the one that the unit drew; the relays of
/// an axis stand together, on the node that it drew.
#[test]
fn a_unit_draws_its_zones_and_a_set_of_relays_its_node() {
    let order = Order {
        growth_unit: GrowthUnit { nodes: Count::from(5), ..GrowthUnit::default() },
        apex: Apex { units: Some(Count::from(2)), ..Apex::default() },
        relay: Relay {
            on: vec![ApexEnd::Completed],
            count: Count::from(2),
            below: weights(&[1.0, 1.0, 0.0, 2.0]),
            ..Relay::default()
        },
        axillary: Axillary {
            buds: Count::from(1),
            ramification: Law::from(1.0),
            pattern: zones(Count::from(1), weights(&[0.0, 1.0, 0.0, 1.0, 2.0])),
            ..Axillary::default()
        },
        ..Order::default()
    };
    let until = 22;
    let model = compiled(&Buds { order: vec![order, Order::default()], ..Buds::default() }, until);
    let plant = contract::grown(&model, until, &contract::seed_of(2, 0));
    let (axes, nodes) = (&plant.axes, &plant.nodes);
    let mut branched = vec![0_u32; nodes.len()];
    let mut relays: Vec<Vec<u32>> = vec![Vec::new(); axes.len()];
    for axis in 1..axes.len() {
        let bearer = axes.bearer[axis].index();
        let bearing = nodes.axis[bearer].index();
        match axes.origin[axis] {
            Origin::Axillary => branched[bearer] += 1,
            Origin::Relay => relays[bearing].push(10 - nodes.rank[bearer]),
            other => panic!("{other:?}"),
        }
    }
    let of_units =
        (0..nodes.len()).filter(|&node| axes.order[nodes.axis[node].index()] == 1 && nodes.unit_rank[node] == 1);
    let drawn: Vec<f64> = of_units.map(|node| (node..node + 5).map(|node| f64::from(branched[node])).sum()).collect();
    assert_mean(&drawn, 3.0, 1.5, "the last rank of the zone");
    let ended: Vec<_> = relays.iter().filter(|relays| !relays.is_empty()).collect();
    assert!(ended.iter().all(|relays| relays.len() == 2 && relays[0] == relays[1]), "relays stand together");
    let below: Vec<f64> = ended.iter().map(|relays| f64::from(relays[0])).collect();
    assert_mean(&below, 1.75, 1.6875, "nodes below the last");
}

#[test]
fn drawn_numbers_keep_the_contract_of_growth_models() {
    let mut all = drawn();
    all.order[0].speed = speeds(&["1", "1/2"], None);
    all.order[0].apex = Apex { units: Some(weights(&[0.0, 0.0, 0.0, 1.0, 1.0])), ..Apex::default() };
    all.order[0].relay = Relay { on: vec![ApexEnd::Completed], below: weights(&[1.0, 1.0, 1.0]), ..Relay::default() };
    all.order[0].growth_unit = GrowthUnit { nodes: weights(&[0.0, 1.0, 1.0, 1.0]), ..GrowthUnit::default() };
    all.order[0].axillary.pattern = zones(weights(&[0.0, 1.0, 1.0]), weights(&[0.0, 1.0, 2.0]));
    all.order[1].death = Law::from(0.15);
    all.order[1].trend = Trend::Tended(Tended { inclination_deg: uniform(40.0, 80.0), share: uniform(0.0, 0.2) });
    contract::check(&compiled(&all, 12), 12, 5);
    contract::check(&compiled(&drawn(), 12), 12, 6);
}

#[test]
fn a_named_phyllotaxis_with_its_source_is_the_name_alone() {
    for name in ["2/5", "distichous", "whorled", "spiral"] {
        let way = |phyllotaxis| {
            let leaf = Leaf { per_node: Count::from(3), ..Leaf::default() };
            Buds { order: vec![Order { phyllotaxis, leaf, ..Order::default() }], ..Buds::default() }
        };
        let named = name.to_owned();
        let sourced = NamedPhyllotaxis { named, source: Some("ten shoots".to_owned()), assumed: false };
        let [alone, sourced] = [Phyllotaxis::Named(name.to_owned()), Phyllotaxis::Sourced(sourced)]
            .map(|phyllotaxis| contract::grown(&compiled(&way(phyllotaxis), 6), 6, &contract::seed_of(1, 0)));
        assert_eq!(alone.nodes.azimuth, sourced.nodes.azimuth, "{name}");
        assert!(contract::components(&alone) == contract::components(&sourced), "{name}");
    }
}
