//! Nodes per growth unit of beech and leaves per bud and shoot of Nothofagus antarctica (Puntieri 2002): laws that no
//! shipped species has, drawn as a species would draw them.
//!
//! Absent: grown plants of these species.

use crate::chi2::homogeneity;
use crate::measured::{Table, counted};
use crate::simulated::drawn;
use phytomer_fits::nodes;
use phytomer_models::law::{Binomial, Count, CountForm, Law, Poisson};

fn binomial(n: f64, p: f64) -> Count {
    let binomial = Some(Binomial { n: Law::from(n), p: Law::from(p) });
    Count::from(CountForm { binomial, ..CountForm::default() })
}

#[test]
fn growth_units_of_beech() {
    let Some(table) = Table::read("nodes_per_growth_unit_histograms.csv") else { return };
    let outcome = homogeneity(&table.histogram("fagus1"), &counted(drawn(binomial(10.0, 0.775))), 1);
    outcome.assert_fits("beech, B(10, .775)");
}

/// The published B(12, .74) does not fit: no bud had fewer than 8 nodes, and the law expects fewer in a sixth of the
/// buds.
#[test]
fn buds_of_nothofagus() {
    let Some(table) = Table::read("nodes_per_growth_unit_histograms.csv") else { return };
    let measured = table.histogram("nothofagus_antarctica_bud_2");
    homogeneity(&measured, &counted(drawn(binomial(12.0, 0.74))), 1).assert_misfit("Nothofagus, buds, B(12, .74)");
    // A Poisson number is added to 8 nodes.
    let poisson = Some(Poisson { mean: Law::from(0.84) });
    let shifted = Count::from(CountForm { poisson, shift: 8, ..CountForm::default() });
    homogeneity(&measured, &counted(drawn(shifted)), 1).assert_fits("Nothofagus, buds, 8 + Poisson(.84)");
}

#[test]
fn shoots_of_nothofagus() {
    let Some(table) = Table::read("nodes_per_growth_unit_histograms.csv") else { return };
    let poisson = Some(Poisson { mean: Law::from(12.22) });
    let law = Count::from(CountForm { poisson, ..CountForm::default() });
    let measured = table.histogram("nothofagus_antarctica_shoot_2");
    homogeneity(&measured, &counted(drawn(law)), 1).assert_fits("Nothofagus, shoots, P(12.22)");
    // One number is enough: by BIC no law with more is better.
    let (_, choice) = nodes::fit_all(&measured).expect("counts");
    let taken = choice.taken();
    assert_eq!(taken.law, "P(12.22)");
    assert!((taken.bic().expect("a BIC") - 440.3).abs() < 0.1, "{taken:?}");
}
