//! Nodes per growth unit of wild cherry (Fournier), order by order, against the shipped species.
//!
//! The first and the second growth units of shoots of order 3 are compared apart. Absent: branching.

use crate::chi2::homogeneity;
use crate::measured::{Table, counted};
use crate::simulated::{Unit, grown, shipped, units};

/// The place of the state in the species' list of states.
const LONG: u8 = 0;
const SHORT: u8 = 1;

fn simulated(orders: usize, plants: u32, years: u32, of: impl Fn(&Unit) -> bool) -> Vec<f64> {
    let plants = grown(&shipped("wild_cherry", orders), plants, 4 * years);
    counted(plants.iter().flat_map(units).filter(of).map(|unit| unit.nodes))
}

#[test]
fn growth_units_of_the_trunk_and_of_branches() {
    let Some(table) = Table::read("nodes_per_growth_unit_histograms.csv") else { return };
    let trunk = simulated(1, 300, 12, |unit| unit.order == 1);
    homogeneity(&table.histogram("meri1"), &trunk, 1).assert_fits("wild cherry, order 1");
    let branches = simulated(2, 40, 10, |unit| unit.order == 2 && unit.state == LONG);
    homogeneity(&table.histogram("meri2"), &branches, 4).assert_fits("wild cherry, order 2");
}

/// The share of units that are preformed alone changes from the first year of a shoot to the second.
#[test]
fn first_and_second_growth_units_of_order_three() {
    let Some(table) = Table::read("nodes_per_growth_unit_histograms.csv") else { return };
    for (number, dataset) in [(1, "meri3"), (2, "meri4")] {
        let of = |unit: &Unit| unit.order == 3 && unit.state == LONG && unit.number == number;
        let shoots = simulated(3, 20, 8, of);
        homogeneity(&table.histogram(dataset), &shoots, 3).assert_fits(&format!("wild cherry, order 3, unit {number}"));
    }
}

#[test]
fn short_shoots_of_every_order() {
    let Some(table) = Table::read("nodes_per_growth_unit_histograms.csv") else { return };
    for order in [2, 3, 4] {
        let short = simulated(4, 6, 8, |unit| unit.order == order && unit.state == SHORT);
        homogeneity(&table.histogram("meri5"), &short, 1)
            .assert_fits(&format!("wild cherry, short shoots of order {order}"));
    }
}
