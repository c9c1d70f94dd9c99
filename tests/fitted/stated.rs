//! What shipped species state beside their fitted laws: `n` and `interval` are those of the fit, as are the numbers.
//!
//! The laws are fitted again here, from the counts. Absent: whether plants grown by them are as measured, which the
//! file of each data set has.

use crate::measured::Table;
use crate::simulated::shipped;
use phytomer_fits::Fit;
use phytomer_fits::activity::counts::Moments;
use phytomer_fits::mortality::{Hazard, Observed, SeenOnce, fit};
use phytomer_fits::nodes;
use phytomer_models::law::{Count, CountForm, Law, LawForm};
use std::collections::BTreeMap;

/// Numbers are stated with three digits or more.
fn is(what: &str, stated: f64, fitted: f64) {
    assert!((stated - fitted).abs() <= 6e-4_f64.max(2e-3 * fitted.abs()), "{what}: {stated}, fitted {fitted}");
}

/// Each stated interval is that of the estimate of its name, and no estimate with an interval is without.
fn intervals(what: &str, stated: &BTreeMap<String, [f64; 2]>, fit: &Fit) {
    for estimate in &fit.estimates {
        let (Some(low), Some(high)) = (estimate.low, estimate.high) else { continue };
        let own = stated.get(&estimate.name).unwrap_or_else(|| panic!("{what}: no interval of {}", estimate.name));
        is(&format!("{what}, {}, low", estimate.name), own[0], low);
        is(&format!("{what}, {}, high", estimate.name), own[1], high);
    }
}

fn nodes_of(species: &str, order: usize) -> CountForm {
    let order = shipped(species, order).order.remove(order - 1);
    let Count::Form(form) = order.growth_unit.nodes else { panic!("a law with its source") };
    *form
}

fn number(law: &Law) -> f64 {
    let Law::Number(number) = law else { panic!("a bare number: {law:?}") };
    *number
}

#[test]
fn poplars_state_what_was_fitted() {
    let Some(table) = Table::read("nodes_per_growth_unit_histograms.csv") else { return };
    let orders = [
        ("poplar", 2, "peup1"),
        ("poplar", 3, "peup2"),
        ("poplar", 4, "peup3"),
        ("poplar", 5, "peup4"),
        ("aspen", 2, "peup3"),
        ("aspen", 3, "peup4"),
    ];
    for (species, order, dataset) in orders {
        let counts = table.histogram(dataset);
        let (laws, choice) = nodes::fit_all(&counts).expect("counts");
        let (law, fit, form) = (&laws[choice.taken], choice.taken(), nodes_of(species, order));
        let what = format!("{species}, order {order}");
        println!("| {what} | {} | n {} |", fit.law, fit.n);
        assert_eq!((form.n, form.shift), (Some(counts.iter().sum::<f64>() as u32), law.shift), "{what}");
        intervals(&what, &form.interval, fit);
        let parts = form.mixture.clone().unwrap_or_default();
        assert_eq!(parts.len().max(1), law.parts.len(), "{what}");
        for ((weight, part), stated) in law.parts.iter().zip(&parts) {
            is(&what, stated.weight, *weight);
            same(&what, *part, (&stated.poisson, &stated.binomial, &stated.negative_binomial));
        }
        if parts.is_empty() {
            same(&what, law.parts[0].1, (&form.poisson, &form.binomial, &form.negative_binomial));
        }
    }
}

type Stated<'a> = (
    &'a Option<phytomer_models::law::Poisson>,
    &'a Option<phytomer_models::law::Binomial>,
    &'a Option<phytomer_models::law::NegativeBinomial>,
);

fn same(what: &str, part: nodes::Part, stated: Stated) {
    match (part, stated) {
        (nodes::Part::Poisson { mean }, (Some(own), ..)) => is(what, number(&own.mean), mean),
        (nodes::Part::Binomial { n, p }, (_, Some(own), _)) => {
            assert_eq!(number(&own.n), f64::from(n), "{what}");
            is(what, number(&own.p), p);
        }
        (nodes::Part::NegativeBinomial { r, p }, (.., Some(own))) => {
            is(what, number(&own.r), r);
            is(what, number(&own.p), p);
        }
        other => panic!("{what}: {other:?}"),
    }
}

#[test]
fn coffee_states_the_mortality_that_was_fitted() {
    let Some(table) = Table::read("greenlab_published_tables.csv") else { return };
    let rows = table.rows().filter(|row| row.text("table") == "coffee_branch_mortality" && row.number("x") > 0.0);
    let seen = |age: f64, fraction: f64| SeenOnce { age, axes: 600.0, dead: (600.0 * fraction).round() };
    let seen = rows.map(|row| seen(row.number("x"), row.number("y"))).collect();
    let fit = fit(&Observed::SeenOnce(seen), Hazard::Gompertz).expect("a fit");
    let Law::Form(form) = shipped("coffee", 2).order.remove(1).death else { panic!("a law with its source") };
    let LawForm { gompertz: Some(gompertz), interval, n, .. } = *form else { panic!("Gompertz") };
    is("c", gompertz.c, fit.value("c"));
    is("g", gompertz.g, fit.value("g"));
    assert_eq!(n, Some(2400));
    intervals("coffee, branches", &interval, &fit);
}

/// The interval of the activity of cotton is that of the last date, which alone has seen all the growth.
#[test]
fn cotton_states_the_interval_of_its_activity() {
    let Some(table) = Table::read("greenlab_published_tables.csv") else { return };
    let rows = table.rows().filter(|row| row.text("table") == "cotton_main_stem");
    let (mean, variance) = rows.map(|row| (row.number("x"), row.number("y"))).last().expect("dates");
    let fit = Moments { n: 50, mean, variance }.activity(None).expect("a fit");
    let Law::Form(form) = shipped("cotton", 1).order.remove(0).pause else { panic!("a law with its source") };
    assert_eq!(form.n, Some(50));
    let [low, high] = form.interval["b"];
    let b = fit.estimate("b").expect("b");
    is("low", low, b.low.expect("a limit"));
    is("high", high, b.high.expect("a limit"));
    assert!((low..=high).contains(&0.82));
}
