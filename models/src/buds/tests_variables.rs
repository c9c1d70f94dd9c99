//! The variables of de Reffye 1988 §3 against small closed forms: the birth and the dimension of a bud stand still
//! while it pauses, and so does the number of growth units; the age and the dimension of the clock go on.
//!
//! Also tested is which laws may depend on a variable. Absent: the tables (`law`).

use super::params::{Apex, Axillary, GrowthUnit, Internode, Leaf, SpeedText, Speeds, Traumatic};
use super::{BudModel, Buds, Order};
use crate::contract;
use crate::fault::{Fault, Path};
use crate::law::{Count, CountForm, Law, LawForm, TableLaw, Variable, Variate, VariateForm};
use phytomer_sim::model::GrowthModel;
use phytomer_sim::plant::Plant;

fn expression(text: &str) -> Law {
    Law::from(LawForm { expression: Some(text.to_owned()), ..LawForm::default() })
}

fn length(text: &str) -> Internode {
    let law = VariateForm { value: Some(expression(text)), ..VariateForm::default() };
    Internode { length_cm: Variate::from(law), ..Internode::default() }
}

fn count(text: &str) -> Count {
    Count::from(CountForm { constant: Some(expression(text)), ..CountForm::default() })
}

fn try_compiled(order: Vec<Order>, until: u32) -> Result<BudModel, Vec<Fault>> {
    Buds { order, ..Buds::default() }.compile(until, &Path::root())
}

fn compiled(order: Vec<Order>, until: u32) -> BudModel {
    try_compiled(order, until).unwrap_or_else(|faults| panic!("{faults:?}"))
}

fn grown(model: &BudModel, until: u32, number: u32) -> Plant {
    contract::grown(model, until, &contract::seed_of(2, number))
}

/// The lengths of the internodes of the axis of the seed, cm, rounded.
fn lengths(plant: &Plant) -> Vec<u32> {
    let of_trunk = (0..plant.nodes.len()).filter(|&node| plant.nodes.axis[node].index() == 0);
    of_trunk.map(|node| (plant.nodes.length[node] * 100.0).round() as u32).collect()
}

/// A bud that came to be at tick 2 and rests then rests for ever: the age of the bud stays 2, while the age of the
/// clock increases.
#[test]
fn a_bud_that_pauses_by_its_date_of_birth_does_not_wake() {
    let of = |pause: &str| Order { pause: expression(pause), ..Order::default() };
    let nodes = |pause: &str| grown(&compiled(vec![of(pause)], 9), 9, 0).nodes.len();
    assert_eq!(nodes("bud_birth == 2"), 2);
    assert_eq!(nodes("age == 3"), 8);
    assert_eq!(nodes("bud_dimension == 2"), 2);
    assert_eq!(nodes("unit == 4"), 4);
    assert_eq!(nodes("dimension == 3"), 8);
}

/// Whatever pauses lie between, the unit-th growth unit is the unit-th; the bud that makes a growth unit was born with
/// the one before; `age` of a node is the tick at which it is born.
#[test]
fn a_growth_unit_knows_its_number_and_the_bud_that_makes_it() {
    for number in 0..20 {
        let of = |text: &str| {
            compiled(vec![Order { pause: Law::from(0.4), internode: length(text), ..Order::default() }], 30)
        };
        let births: Vec<u32> = grown(&of("age"), 30, number).nodes.birth;
        assert_eq!(lengths(&grown(&of("age"), 30, number)), births);
        assert_eq!(lengths(&grown(&of("unit"), 30, number)), (0..births.len() as u32).collect::<Vec<_>>());
        let made_by: Vec<u32> =
            std::iter::once(0).chain(births).take(lengths(&grown(&of("age"), 30, number)).len()).collect();
        assert_eq!(lengths(&grown(&of("bud_birth"), 30, number)), made_by);
    }
}

/// Two growth units a step are two buds: the second was born at this tick. Speeds count in ticks.
#[test]
fn growth_units_of_one_step_are_made_by_one_bud_after_another() {
    let unit = GrowthUnit { per_step: Count::from(2), ..GrowthUnit::default() };
    let of = |text: &str| Order { growth_unit: unit.clone(), internode: length(text), ..Order::default() };
    assert_eq!(lengths(&grown(&compiled(vec![of("unit")], 3), 3, 0)), [0, 1, 2, 3, 4, 5]);
    assert_eq!(lengths(&grown(&compiled(vec![of("bud_birth")], 3), 3, 0)), [0, 1, 1, 2, 2, 3]);
    let half = |text: &str| Order {
        speed: Speeds::from(SpeedText::Ratio("1/2".to_owned())),
        internode: length(text),
        ..Order::default()
    };
    assert_eq!(lengths(&grown(&compiled(vec![half("bud_birth")], 9), 9, 0)), [0, 2, 4, 6]);
}

/// On a lateral born at tick b the bud of its first growth unit has the birth b and the dimension 0.
#[test]
fn a_bud_counts_its_dimension_from_the_birth_of_its_axis() {
    let trunk = Order {
        axillary: Axillary {
            buds: Count::from(1),
            ramification: Law::from(1.0),
            delay: Count::from(3),
            ..Axillary::default()
        },
        ..Order::default()
    };
    let of = |text: &str| {
        let lateral = Order { internode: length(text), pause: Law::from(0.5), ..Order::default() };
        grown(&compiled(vec![trunk.clone(), lateral], 20), 20, 1)
    };
    let (births, dimensions) = (of("bud_birth"), of("bud_dimension"));
    let mut laterals = 0;
    for node in (0..births.nodes.len()).filter(|&node| births.nodes.axis[node].index() > 0) {
        let axis = births.nodes.axis[node].index();
        let before = match births.nodes.rank[node] {
            1 => births.axes.birth[axis],
            _ => births.nodes.birth[births.nodes.parent[node].index()],
        };
        let read = |plant: &Plant| (plant.nodes.length[node] * 100.0).round() as u32;
        assert_eq!((read(&births), read(&dimensions)), (before, before - births.axes.birth[axis]), "node {node}");
        laterals += 1;
    }
    assert!(laterals > 50, "{laterals}");
}

/// A bud born at tick b pauses with probability p(b) at each tick, so it waits a geometric time with mean 1/(1 − p(b)),
/// whatever its axis has lived through: here 1 for a bud of an even date, and 4 for one of an odd date.
#[test]
fn the_wait_of_a_bud_is_geometric_by_its_date_of_birth() {
    let order =
        Order { pause: expression("if(bud_birth - 2 * floor(bud_birth / 2) == 1, 0.75, 0)"), ..Order::default() };
    let model = compiled(vec![order], 400);
    let (mut n, mut sum) = (0.0, 0.0);
    for number in 0..40 {
        let plant = grown(&model, 400, number);
        // Buds born near the end may not have grown yet: a wait of more than 100 has probability 3e-13.
        for pair in plant.nodes.birth.windows(2).filter(|pair| pair[0] < 300) {
            let wait = f64::from(pair[1] - pair[0]);
            match pair[0] % 2 {
                0 => assert_eq!(wait, 1.0),
                _ => (n, sum) = (n + 1.0, sum + wait),
            }
        }
    }
    // The variance of the geometric distribution is p/(1 − p)² = 12.
    let (mean, bound) = (sum / n, 4.0 * (12.0_f64 / n).sqrt());
    assert!(n > 1000.0 && (mean - 4.0).abs() < bound, "the mean wait of {n} buds is {mean}, not 4 ± {bound}");
}

/// Tables over the number of growth units need as many numbers as an axis can make growth units, and no more.
#[test]
fn a_table_over_growth_units_reaches_as_far_as_they_do() {
    let table = |numbers: usize| {
        let law = TableLaw { over: Variable::Unit, from: 0, values: vec![0.0; numbers], beyond: Default::default() };
        Law::from(LawForm { table: Some(law), ..LawForm::default() })
    };
    let of = |numbers, units: Option<u32>, per_step: u32| {
        let order = Order {
            pause: table(numbers),
            growth_unit: GrowthUnit { per_step: Count::from(per_step), ..GrowthUnit::default() },
            apex: Apex { units: units.map(Count::from), ..Apex::default() },
            ..Order::default()
        };
        try_compiled(vec![order], 10).is_ok()
    };
    assert!(of(11, None, 1) && !of(10, None, 1), "0 to 10 growth units in 10 steps");
    assert!(of(21, None, 2) && !of(20, None, 2));
    assert!(of(5, Some(4), 2) && !of(4, Some(4), 2));
}

/// Points that cannot occur are not checked: a bud is no older than its axis, nor an axis than its plant.
#[test]
fn a_law_is_checked_where_its_variables_can_be_together() {
    for text in ["(age - bud_birth) / 20", "(dimension - bud_dimension) / 20", "(bud_birth - bud_dimension) / 20"] {
        let order = Order { pause: expression(text), ..Order::default() };
        assert!(try_compiled(vec![order], 10).is_ok(), "{text}");
    }
}

#[test]
fn the_contract_holds_for_laws_of_the_bud_and_the_forecast_knows_them_not() {
    let trunk = Order {
        death: expression("0.01 * unit"),
        pause: expression("min(0.8, 0.1 * bud_birth)"),
        growth_unit: GrowthUnit { nodes: count("1 + (unit > 2)"), ..GrowthUnit::default() },
        axillary: Axillary {
            buds: Count::from(1),
            ramification: expression("bud_dimension > 1"),
            ..Axillary::default()
        },
        traumatic: Traumatic { probability: expression("unit / (unit + 1)"), ..Traumatic::default() },
        leaf: Leaf { per_node: count("min(3, unit)"), ..Leaf::default() },
        ..Order::default()
    };
    let species = vec![trunk.clone(), Order { axillary: Axillary::default(), ..trunk.clone() }];
    contract::check(&compiled(species.clone(), 12), 12, 4);
    for number in 0..4 {
        let seed = contract::seed_of(4, number);
        let [short, long] = [12, 60].map(|until| compiled(species.clone(), until));
        contract::the_length_of_the_run_leaves_no_trace(&short, &long, 12, &seed);
    }
    assert!(compiled(species, 12).expectation(12).is_none());
    assert!(compiled(vec![Order::default()], 12).expectation(12).is_some());
}

/// A stream of words has a place for everything that a longer run could draw: here deaths, leaves and flowers that
/// begin late, relays that become fewer, and more nodes a growth unit than the young plant makes.
#[test]
fn what_a_longer_run_could_draw_has_its_words_in_a_shorter_one() {
    let late = |text: &str| Order {
        growth_unit: GrowthUnit { nodes: count("1 + floor(age / 20)"), ..GrowthUnit::default() },
        axillary: Axillary { buds: count("if(age < 30, 1, 3)"), ramification: Law::from(0.2), ..Axillary::default() },
        leaf: Leaf { per_node: count("floor(age / 15)"), life: Some(count("3 + cycle")), ..Leaf::default() },
        internode: Internode {
            diameter_mm: VariateForm {
                normal: Some(crate::law::Normal { mean: 5.0.into(), sd: 1.0.into() }),
                ..VariateForm::default()
            }
            .into(),
            ..length("1 + rank")
        },
        pause: Law::from(0.3),
        death: expression(text),
        ..Order::default()
    };
    for text in
        ["if(age < 40, 0, 0.1)", "if(cycle < 40, 0, 0.1)", "if(unit < 40, 0, 0.1)", "if(age + cycle < 60, 0, 0.1)"]
    {
        let species = vec![late(text), Order { pause: Law::from(0.4), ..late(text) }];
        let [short, long] = [16, 90].map(|until| compiled(species.clone(), until));
        for number in 0..3 {
            let seed = contract::seed_of(4, number);
            contract::the_length_of_the_run_leaves_no_trace(&short, &long, 16, &seed);
        }
    }
}

/// The laws of quantities drawn once, at the birth of an axis, may depend on the age of the plant; nothing has been
/// counted of the axis yet.
#[test]
fn what_is_drawn_at_the_birth_of_an_axis_knows_the_age_of_the_plant_alone() {
    let of = |text: &str| Order { shed_after: Some(count(text)), ..Order::default() };
    assert!(try_compiled(vec![of("1 + floor(age / 8)")], 12).is_ok());
    for name in ["dimension", "cycle", "rank", "bud_birth", "bud_dimension", "unit"] {
        let faults = try_compiled(vec![of(&format!("1 + {name}"))], 12).expect_err(name);
        let told = faults[0].to_string();
        assert!(told.contains(&format!("depends on {name}, which is not counted yet")), "{told}");
        assert!(told.contains("expected `age`"), "{told}");
    }
}
