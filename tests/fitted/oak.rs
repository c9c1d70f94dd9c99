//! Annual shoots of sessile oak (Heuret): three years of 46 trees. The published means and F, and polycyclism as a law.
//!
//! No shipped species has these laws: the number of growth units of a year is drawn as a species would draw it.

use crate::chi2::homogeneity;
use crate::measured::{Table, add, counted};
use crate::simulated::{grown, units};
use phytomer_models::buds::params::GrowthUnit;
use phytomer_models::buds::{Buds, Order};
use phytomer_models::law::{Count, CountForm};

const YEARS: [f64; 3] = [1995.0, 1996.0, 1997.0];

fn of_year(table: &Table, year: f64, column: &str) -> Vec<f64> {
    table.rows().filter(|row| row.number("year") == year).map(|row| row.number(column)).collect()
}

#[test]
fn means_and_the_analysis_of_variance_are_those_published() {
    let Some(table) = Table::read("sessile_oak_annual_shoots.csv") else { return };
    let groups = YEARS.map(|year| of_year(&table, year, "length_cm"));
    let mean = |sample: &[f64]| sample.iter().sum::<f64>() / sample.len() as f64;
    for (group, published) in groups.iter().zip([58.4348, 24.2174, 45.7609]) {
        assert!((mean(group) - published).abs() < 5e-5, "{}", mean(group));
    }
    let all: Vec<f64> = groups.concat();
    let grand = mean(&all);
    let between: f64 = groups.iter().map(|g| g.len() as f64 * (mean(g) - grand) * (mean(g) - grand)).sum();
    let within: f64 = groups.iter().flat_map(|g| g.iter().map(|x| (x - mean(g)) * (x - mean(g)))).sum();
    let f = (between / 2.0) / (within / (all.len() as f64 - 3.0));
    assert!((f - 40.1219).abs() < 5e-5, "{f}");
}

/// One growth unit a year, or two, seldom more: a law for each year. The three years are compared apart, since in 1995
/// all but five trees had two.
#[test]
fn growth_units_of_a_year() {
    let Some(table) = Table::read("sessile_oak_annual_shoots.csv") else { return };
    let (mut measured, mut simulated) = (Vec::new(), Vec::new());
    for (place, year) in YEARS.into_iter().enumerate() {
        let counts = counted(of_year(&table, year, "n_cycles").into_iter().map(|cycles| cycles as usize));
        let per_step = Count::from(CountForm { empirical: Some(counts.clone()), ..CountForm::default() });
        let growth_unit = GrowthUnit { per_step, ..GrowthUnit::default() };
        let buds = Buds { order: vec![Order { growth_unit, ..Order::default() }], ..Buds::default() };
        let grown = counted(grown(&buds, 5000, 1).iter().map(|plant| units(plant).len()));
        for (counts, all) in [(counts, &mut measured), (grown, &mut simulated)] {
            counts.into_iter().enumerate().for_each(|(cycles, count)| add(all, 8 * place + cycles, count));
        }
    }
    homogeneity(&measured, &simulated, 0).assert_fits("sessile oak, growth units of three years, as counted");
}
