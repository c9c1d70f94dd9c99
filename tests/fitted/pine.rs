//! Annual shoots of Corsican pine (Meredieu & Caraglio): branches of each tier, double cycles and the drift of length
//! with age, against the trunk of the shipped species.
//!
//! Absent: the branches themselves.

use crate::chi2::homogeneity;
use crate::measured::{Row, Table, add, counted, moments};
use crate::simulated::{grown, shipped, units};
use phytomer_models::law::Count;
use phytomer_sim::plant::{AxisId, Plant};
use std::collections::BTreeMap;

/// The most years for which the young trees were followed.
const YEARS: u32 = 21;

/// The rows of the young trees, each with the age of its shoot in years from 1.
fn shoots(table: &Table) -> Vec<(u32, Row<'_>)> {
    let mut ages: BTreeMap<(&str, &str, &str), u32> = BTreeMap::new();
    let young = table.rows().filter(|row| row.text("dataset") != "pin_laricio_7x");
    let aged = young.map(|row| {
        let age = ages.entry((row.text("dataset"), row.text("plot"), row.text("tree_id"))).or_default();
        *age += 1;
        (*age, row)
    });
    aged.collect()
}

/// The branches around the tip of each year's last growth unit of the trunk, by age from 1.
fn tiers(plant: &Plant) -> Vec<usize> {
    let mut tips = vec![None; YEARS as usize];
    for node in (0..plant.nodes.len()).filter(|node| plant.nodes.axis[*node] == AxisId::TRUNK) {
        tips[plant.nodes.birth[node] as usize - 1] = Some(node);
    }
    let bearers = plant.axes.bearer.iter().filter_map(|bearer| bearer.some());
    let mut borne = vec![0; plant.nodes.len()];
    bearers.for_each(|bearer| borne[bearer.index()] += 1);
    tips.into_iter().flatten().map(|tip| borne[tip]).collect()
}

/// The drift from two branches to six, with a preference for five and eight.
#[test]
fn branches_of_a_tier_by_age() {
    let Some(table) = Table::read("corsican_pine_annual_shoots.csv") else { return };
    let measured = shoots(&table);
    let mut pine = shipped("corsican_pine", 2);
    // Only the number of branches is needed, not their growth.
    pine.order[1].growth_unit.nodes = Count::from(0);
    let simulated: Vec<Vec<usize>> = grown(&pine, 1000, YEARS).iter().map(tiers).collect();
    for (first, last) in [(1, 1), (2, 2), (3, 4), (5, 8), (9, 12), (13, 16), (17, 21)] {
        let of_age = measured.iter().filter(|(age, _)| (first..=last).contains(age));
        let counts = counted(of_age.map(|(_, row)| row.number("n_branches_whorl") as usize));
        let grown = counted(simulated.iter().flat_map(|tiers| tiers[first as usize - 1..last as usize].to_vec()));
        homogeneity(&counts, &grown, 1).assert_fits(&format!("Corsican pine, tiers of years {first} to {last}"));
    }
}

#[test]
fn years_with_two_growth_units() {
    let Some(table) = Table::read("corsican_pine_annual_shoots.csv") else { return };
    let cycles = shoots(&table).into_iter().filter_map(|(_, row)| row.maybe("n_cycles"));
    let measured = counted(cycles.map(|cycles| cycles as usize));
    let mut pine = shipped("corsican_pine", 1);
    pine.order[0].growth_unit.nodes = Count::from(1);
    let mut simulated = Vec::new();
    for plant in grown(&pine, 1000, YEARS) {
        let mut years = vec![0; YEARS as usize];
        plant.nodes.birth.iter().for_each(|birth| years[*birth as usize - 1] += 1);
        years.into_iter().for_each(|units| add(&mut simulated, units, 1.0));
    }
    assert!(units(&grown(&pine, 1, YEARS)[0]).len() >= YEARS as usize);
    // One parameter for two cells leaves no degree of freedom: the test is whether the estimate is in the file.
    homogeneity(&measured, &simulated, 0).assert_fits("Corsican pine, years of two growth units");
}

/// The mean length of the annual shoot within 4 standard errors of the measured one, year by year from 6 to 70 cm.
#[test]
fn shoots_lengthen_with_age() {
    let Some(table) = Table::read("corsican_pine_annual_shoots.csv") else { return };
    let measured = shoots(&table);
    let plants = grown(&shipped("corsican_pine", 1), 1000, YEARS);
    let mut worst: f64 = 0.0;
    for year in 1..=YEARS {
        let lengths: Vec<f64> = measured
            .iter()
            .filter(|(age, _)| *age == year)
            .map(|(_, row)| row.number("shoot_length_mm") / 1000.0)
            .collect();
        let (mean, variance) = moments(&lengths);
        let of_year = |plant: &Plant| {
            let nodes = (0..plant.nodes.len()).filter(|node| plant.nodes.birth[*node] == year);
            nodes.map(|node| f64::from(plant.nodes.length[node])).sum::<f64>()
        };
        let (grown, spread) = moments(&plants.iter().map(of_year).collect::<Vec<_>>());
        let error = (variance / lengths.len() as f64 + spread / plants.len() as f64).sqrt();
        worst = worst.max((grown - mean).abs() / error);
    }
    println!("| Corsican pine, length of shoots | worst year {worst:.1} standard errors |");
    assert!(worst < 4.0, "{worst}");
}
