//! Growth by the date: laws of the calendar against closed forms, and the same plant in a longer run.
//!
//! Absent: the calendar itself (`sim::site::calendar`), and the tables (`law`).

use std::sync::Arc;

use super::params::{Axillary, GrowthUnit, Leaf, Quantity, Season, SpeedForm, Speeds};
use super::{BudModel, Buds, Order};
use crate::contract;
use crate::fault::Path;
use crate::law::{Count, CountForm, Law, LawForm, MitscherlichLaw, Variable};
use phytomer_sim::clock::{NEVER, Tick};
use phytomer_sim::plant::{Cause, Plant};
use phytomer_sim::site::calendar::{Calendar, Dates, Soil, Terms, TickLength};
use phytomer_sim::site::date::Date;
use phytomer_sim::site::degree_days::{DegreeDays, Method};

fn expression(text: &str) -> Law {
    Law::from(LawForm { expression: Some(text.to_owned()), ..LawForm::default() })
}

fn date(year: i32, month: u32, day: u32) -> Date {
    Date::new(year, month, day).expect("a day")
}

/// At 20° S, planted on 1 July 2001 at a steady 25 °C, base 10 °C; the soil gives 20 kg of nitrogen a season and is
/// given 60 more each year in October.
fn dates(tick: TickLength, until: u32) -> Dates {
    let applied = (0..20).map(|year| (date(2001 + year, 10, 15), 60.0)).collect();
    let terms = Terms {
        planted: date(2001, 7, 1),
        tick,
        degree_days: Some(DegreeDays { method: Method::Average, base: 10.0, upper: None }),
        latitude: Some((-20.0_f64).to_radians()),
        soil: Some(Soil { own: 20.0, applied, season_begins: (7, 1) }),
    };
    let calendar = Calendar::of(&terms, until, |_| Some([25.0, 25.0])).expect("a calendar");
    Dates { calendar: Arc::new(calendar), sown: 0 }
}

fn compiled(order: Vec<Order>, until: u32, tick: TickLength) -> BudModel {
    let dates = dates(tick, until);
    let compiled = Buds { order, ..Buds::default() }.compile_dated(until, Some(&dates), &Path::root());
    compiled.unwrap_or_else(|faults| panic!("{faults:?}"))
}

fn grown(model: &BudModel, until: u32) -> Plant {
    contract::grown(model, until, &contract::seed_of(2, 0))
}

fn leaves_at(plant: &Plant, age: u32) -> usize {
    let stands = |organ: &usize| (plant.organs.birth[*organ]..plant.organs.death[*organ]).contains(&age);
    (0..plant.organs.len()).filter(stands).count()
}

/// n ticks after the sowing an axis that makes a node a tick bears min(n, L) × leaves a node, where a leaf lives L
/// ticks; in ticks of days and of degree-days alike.
#[test]
fn leaves_of_a_steadily_growing_axis() {
    let (life, a_node, until) = (5, 3, 20);
    for tick in [TickLength::Days(10), TickLength::DegreeDays(150.0)] {
        let leaf = Leaf { per_node: Count::from(a_node), life: Some(Count::from(life)), ..Leaf::default() };
        let plant = grown(&compiled(vec![Order { leaf, ..Order::default() }], until, tick), until);
        for n in 1..=until {
            assert_eq!(leaves_at(&plant, n), (n.min(life) * a_node) as usize, "{n} ticks of {tick:?}");
        }
    }
}

/// The same by the phyllochron: by t ticks of 150 °C d an axis with a phyllochron of P has made ⌊150 t/P⌋ nodes, and
/// laid down as many leaves.
#[test]
fn nodes_follow_the_phyllochron_of_their_order() {
    let until = 20;
    for (phyllochron, steps, ticks) in [(75.0, 2, 1), (150.0, 1, 1), (400.0, 3, 8)] {
        let speed = SpeedForm { phyllochron_degree_days: Some(phyllochron), ..SpeedForm::default() };
        let leaf = Leaf { per_node: Count::from(2), life: None, ..Leaf::default() };
        let order = Order { speed: Speeds::from(speed), leaf, ..Order::default() };
        let plant = grown(&compiled(vec![order], until, TickLength::DegreeDays(150.0)), until);
        for t in 1..=until {
            let nodes = plant.nodes.birth.iter().filter(|birth| **birth <= t).count();
            assert_eq!(
                (nodes, leaves_at(&plant, t)),
                ((t * steps / ticks) as usize, (2 * (t * steps / ticks)) as usize)
            );
        }
    }
}

/// A bud that wakes by its degree-days makes its first node at the tick that reaches them: 450 °C d a tick of 30 days.
#[test]
fn buds_burst_by_degree_days_and_by_the_date() {
    let births = |pause: &str| {
        let order = Order { pause: expression(pause), ..Order::default() };
        grown(&compiled(vec![order], 24, TickLength::Days(30)), 24).nodes.birth
    };
    assert_eq!(births("degree_days < 4000"), (9..=24).collect::<Vec<_>>(), "8 × 450 < 4000 ≤ 9 × 450");
    // Ticks end on 31 July, 30 August, 29 September and so on; September to November are days 244 to 334.
    assert_eq!(births("not (date >= 244 and date <= 334)"), [3, 4, 5, 15, 16, 17]);
    // Days are longer than 12 hours at 20° S from the equinox of September to that of March.
    assert_eq!(births("day_length_h < 12"), [3, 4, 5, 6, 7, 8, 15, 16, 17, 18, 19, 20]);
}

/// The nitrogen of each tick is a number of the calendar: the law of nitrogen and the table of the age with the same
/// numbers are the same table, so they draw the same words.
#[test]
fn a_law_of_nitrogen_draws_what_its_table_by_age_draws() {
    let until = 30;
    let tick = TickLength::Days(30);
    let law = MitscherlichLaw { over: Variable::Nitrogen, max: 0.8, rate: 0.02, offset: 0.0 };
    let calendar = dates(tick, until).calendar;
    let terms: Vec<String> = (1..=until)
        .map(|age| {
            let nitrogen = calendar.at(age).nitrogen_kg_ha.expect("nitrogen");
            format!("(age == {age}) * 0.8 * (1 - exp(-0.02 * {nitrogen}))")
        })
        .collect();
    let of = |ramification: Law| {
        let axillary = Axillary { buds: Count::from(2), ramification, ..Axillary::default() };
        let orders = vec![Order { axillary, ..Order::default() }, Order { death: Law::from(0.1), ..Order::default() }];
        grown(&compiled(orders, until, tick), until)
    };
    let by_nitrogen = of(Law::from(LawForm { mitscherlich: Some(law), ..LawForm::default() }));
    let by_age = of(expression(&terms.join(" + ")));
    assert_eq!(contract::components(&by_nitrogen), contract::components(&by_age));
    assert!(by_nitrogen.axes.len() > 20, "{}", by_nitrogen.axes.len());
}

/// What the date decides in a longer run leaves no trace: neither a law that never acts in the short one, nor places
/// for things that it may make.
#[test]
fn a_longer_run_has_other_dates_and_the_same_plants() {
    let wide = |text: &str| Count::from(CountForm { constant: Some(expression(text)), ..CountForm::default() });
    let orders = || {
        let unit = GrowthUnit { nodes: wide("1 + floor(nitrogen / 40)"), ..GrowthUnit::default() };
        let trunk = Order {
            death: expression("if(degree_days > 9000, 0.1, 0)"),
            pause: expression("0.5 * (day_length_h < 12)"),
            growth_unit: unit,
            axillary: Axillary { buds: wide("1 + (date > 200)"), ramification: Law::from(0.4), ..Axillary::default() },
            ..Order::default()
        };
        vec![trunk, Order { pause: Law::from(0.3), ..Order::default() }]
    };
    for tick in [TickLength::Days(30), TickLength::DegreeDays(400.0)] {
        let (short, long) = (compiled(orders(), 10, tick), compiled(orders(), 40, tick));
        contract::the_length_of_the_run_leaves_no_trace(&short, &long, 10, &contract::seed_of(3, 1));
        contract::check(&compiled(orders(), 8, tick), 8, 3);
    }
}

/// Leaves fall at the first tick after their birth that ends in November: at tick 5 (28 November 2001), at tick 17 (23
/// November 2002), and later than the run.
#[test]
fn leaves_fall_by_the_date() {
    let until = 24;
    let season = Season {
        ticks_per_year: Quantity::from(12),
        leaf_fall: None,
        leaf_fall_when: Some(expression("date >= 305 and date < 335")),
    };
    let compiled = |season: Season| {
        let buds = Buds { order: vec![Order::default()], season: Some(season), ..Buds::default() };
        buds.compile_dated(until, Some(&dates(TickLength::Days(30), until)), &Path::root())
    };
    let plant = grown(&compiled(season.clone()).unwrap_or_else(|faults| panic!("{faults:?}")), until);
    let falls: Vec<(Tick, Cause)> =
        plant.organs.death.iter().copied().zip(plant.organs.cause.iter().copied()).collect();
    let expected = (1..=until).map(|birth| match birth {
        ..5 => (5, Cause::Season),
        5..17 => (17, Cause::Season),
        _ => (NEVER, Cause::None),
    });
    assert_eq!(falls, expected.collect::<Vec<_>>());
    for leaf_fall in [None, Some(Count::from(3))] {
        let when = season.leaf_fall_when.clone().filter(|_| leaf_fall.is_some());
        let faults = compiled(Season { leaf_fall, leaf_fall_when: when, ..season.clone() }).expect_err("none or both");
        assert_eq!(faults[0].expected, "either `leaf_fall` or `leaf_fall_when`");
    }
}
