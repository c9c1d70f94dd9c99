//! Tests of laws of the date: they have the values of the calendar at each age, are faults where it does not tell, and
//! leave words for every run.
//!
//! Absent: how a calendar is made, which `phytomer_sim::site::calendar` tests.

use std::sync::Arc;

use phytomer_sim::clock::Speed;
use phytomer_sim::site::calendar::{Calendar, CalendarTick, Dates, TickLength};
use phytomer_sim::site::date::Date;

use super::tests::root;
use super::*;
use crate::fault::Fault;

const ANY: ValueRange = ValueRange { min: f64::NEG_INFINITY, max: f64::INFINITY, what: "a number" };

/// Tick t is day t of 2001 with the sum 15 t, the day length 12 h and 10 t kg of nitrogen.
fn dates(sown: u32) -> Dates {
    let tick = |tick: u32| CalendarTick {
        date: Date::of_year(2001, 1 + tick).expect("a day"),
        days: 1,
        degree_days: Some(15.0),
        degree_day_sum: Some(15.0 * f64::from(tick)),
        day_length_h: Some(12.0),
        nitrogen_kg_ha: Some(10.0 * f64::from(tick)),
    };
    let calendar = Calendar::of_ticks(TickLength::Days(1), (0..=60).map(tick).collect()).expect("ticks");
    Dates { calendar: Arc::new(calendar), sown }
}

fn dated(sown: u32) -> Domain {
    Domain { order: 1, until: 40, max_cycle: 40, max_unit: 40, dates: Some(dates(sown)), ..Domain::default() }
}

fn expression(text: &str) -> Law {
    LawForm { expression: Some(text.to_owned()), ..LawForm::default() }.into()
}

fn told(text: &str, domain: &Domain) -> Vec<String> {
    let found = expression(text).compile_value(domain, &root(), ANY);
    found.expect_err("a fault").iter().map(Fault::to_string).collect()
}

#[test]
fn a_law_of_the_date_is_one_of_the_age() {
    let values = [
        ("nitrogen", 0.0, 10.0),
        ("degree_days", 0.0, 15.0),
        ("degree_days_per_day", 15.0, 0.0),
        ("day_length_h", 12.0, 0.0),
        ("date", 1.0, 1.0),
    ];
    for (name, at_sowing, a_tick) in values {
        for sown in [0, 7] {
            let table = expression(name).compile_value(&dated(sown), &root(), ANY).expect("compiles");
            for age in 1..=40_u32 {
                // Degree-days count from the sowing of the plant, the others are those of the plot.
                let ticks = if name == "degree_days" { age } else { sown + age };
                let expected = (at_sowing + a_tick * f64::from(ticks)) as f32;
                let found =
                    [0, 9].map(|other| table.value(At { age, dimension: other, cycle: other, ..At::default() }));
                assert_eq!(found, [expected; 2], "{name} at {age}, sown at {sown}");
            }
        }
    }
    let both = expression("nitrogen / 10 + dimension").compile_value(&dated(0), &root(), ANY).expect("compiles");
    assert_eq!(both.value(At { age: 9, dimension: 4, ..At::default() }), 13.0);
}

#[test]
fn curves_stand_over_the_date_as_over_the_age() {
    let step = StepLaw { over: Variable::Nitrogen, at: 95, before: 0.25, after: 0.5 };
    let table = TableLaw { over: Variable::DegreeDays, from: 0, values: vec![0.0, 1.0], beyond: Beyond::Last };
    let forms = [
        LawForm { step: Some(step), ..LawForm::default() },
        LawForm { table: Some(table.clone()), ..LawForm::default() },
    ];
    let [step, last] = forms.map(|form| Law::from(form).compile_value(&dated(0), &root(), ANY).expect("compiles"));
    let at = |age| At { age, ..At::default() };
    assert_eq!([9, 10].map(|age| step.value(at(age))), [0.25, 0.5]);
    assert_eq!(last.value(at(1)), 1.0);
    let short = Law::from(LawForm { table: Some(TableLaw { beyond: Beyond::Error, ..table }), ..LawForm::default() });
    let told = short.compile_value(&dated(0), &root(), ANY).expect_err("too short");
    assert_eq!(told[0].problem, "table too short: has 2 values, needs 601", "15 °Cd a tick for 40 ticks");
}

#[test]
fn what_the_scenario_does_not_tell_is_a_fault_that_says_what_to_add() {
    let undated = Domain { dates: None, ..dated(0) };
    assert_eq!(
        told("0.1 * nitrogen", &undated),
        ["law: the law depends on nitrogen, which is known only in a scenario with a calendar; expected \
             `planting_date` and `[calendar]` with `[soil]` in the scenario, or a law without nitrogen"]
    );
    assert!(told("date", &undated)[0].ends_with("`[calendar]` in the scenario, or a law without date"));
    let mut without = dates(0);
    let ticks = without.calendar.ticks().iter();
    let ticks =
        ticks.map(|tick| CalendarTick { day_length_h: None, nitrogen_kg_ha: None, degree_day_sum: None, ..*tick });
    without.calendar = Arc::new(Calendar::of_ticks(TickLength::Days(1), ticks.collect()).expect("ticks"));
    let bare = Domain { dates: Some(without), ..dated(0) };
    for (name, key) in
        [("nitrogen", "`[soil]`"), ("degree_days", "`[weather]`"), ("day_length_h", "`site.latitude_deg`")]
    {
        let told = told(name, &bare);
        assert!(told[0].contains("which the scenario does not tell") && told[0].contains(key), "{told:?}");
    }
    assert!(expression("date").compile_value(&bare, &root(), ANY).is_ok());
}

#[test]
fn a_law_that_does_not_know_the_age_does_not_know_the_date() {
    for (asked, known) in [(Asked::Birth, true), (Asked::Internode, true), (Asked::OwnAge, false), (Asked::Once, false)]
    {
        let domain = Domain { asked, ..dated(0) };
        let compiled = expression("nitrogen").compile_value(&domain, &root(), ANY);
        assert_eq!(compiled.is_ok(), known, "{asked:?}");
        if let Err(faults) = compiled {
            assert!(faults[0].problem.starts_with("the law depends on nitrogen, which "), "{faults:?}");
        }
    }
}

#[test]
fn a_value_outside_its_range_is_told_with_its_age_and_the_date() {
    let faults = expression("nitrogen / 100").compile_probability(&dated(0), &root()).expect_err("above 1");
    let told: Vec<String> = faults.iter().map(Fault::to_string).collect();
    assert_eq!(told, ["law: the law is 1.1 at age 11, nitrogen 110; expected a probability in [0, 1]"]);
}

/// Words and places follow what can be in a run of any length, whose nitrogen this run does not know.
#[test]
fn a_law_of_the_date_has_its_words_in_every_run() {
    let never = expression("0 * nitrogen").compile_probability(&dated(0), &root()).expect("compiles");
    assert!(never.constant() == Some(0.0) && !never.is_never());
    let plateau = LinearPlateauLaw { over: Variable::Nitrogen, start: 1.0, slope: 1.0, plateau_from: 6.0 };
    let laws = [
        (LawForm { linear_plateau: Some(plateau), ..LawForm::default() }.into(), 7),
        (expression("1 + min(6, nitrogen)"), u32::MAX),
    ];
    for (law, most) in laws {
        for until in [1, 40] {
            let domain = Domain { until, ..dated(0) };
            let count = CountForm { constant: Some(Law::clone(&law)), ..CountForm::default() };
            let table = Count::from(count).compile_places(&domain, &root()).expect("compiles");
            assert_eq!(table.at_most(u32::from(u16::MAX)).max_in_any_run(), most.min(u32::from(u16::MAX)));
        }
    }
}

#[test]
fn a_phyllochron_is_a_speed_where_ticks_are_sums_of_degree_days() {
    let of = |phyllochron: f64, tick: TickLength| {
        let mut dates = dates(0);
        dates.calendar = Arc::new(Calendar::of_ticks(tick, dates.calendar.ticks().to_vec()).expect("ticks"));
        let form = SpeedForm { phyllochron_degree_days: Some(phyllochron), ..SpeedForm::default() };
        let speeds = Speeds::from(form).compile_dated(&root(), Some(&dates));
        speeds.map(|table| table.into_parts().0[0]).map_err(|faults| faults[0].problem.clone())
    };
    for (phyllochron, steps, ticks) in [(110.0, 10, 11), (50.0, 2, 1), (33.3, 1000, 333), (1600.0, 1, 16)] {
        assert_eq!(of(phyllochron, TickLength::DegreeDays(100.0)).ok(), Speed::new(steps, ticks), "{phyllochron}");
    }
    let told = "a phyllochron of 1 °C d in ticks of 100 °C d is no speed";
    assert_eq!(of(1.0, TickLength::DegreeDays(100.0)), Err(told.to_owned()), "above 64 steps a tick");
    let told = "the speed is a phyllochron, and a tick is no sum of degree-days";
    assert_eq!(of(110.0, TickLength::Days(30)), Err(told.to_owned()));
}
