//! De Reffye 1988 §3, Examples 1–4, as shipped species. A lateral's first tick is the one after its node's, as in the
//! pseudo-code of §4.
//!
//! Absent: means in closed form for other laws (`expectation`).

use crate::grown::{PLANTS, Sample, plant, shipped, units_by_order};
use phytomer_sim::GrowthModel as _;

/// Example 1: no break, no death. Growth units of order k at age n: C(n, k).
#[test]
fn example_1_grows_by_binomial_coefficients() {
    let model = shipped("example1", 6);
    let totals = [1, 3, 7, 14, 25, 41];
    let grown = plant(&model, 0, 6);
    for age in 1..=6_u32 {
        let n = u64::from(age);
        let binomials = vec![n, n * (n - 1) / 2, n * (n - 1) * n.saturating_sub(2) / 6];
        let units = units_by_order(&grown, age);
        assert_eq!(units, binomials, "age {age}");
        assert_eq!(units.iter().sum::<u64>(), totals[age as usize - 1], "age {age}");
        let expected = model.expectation(6).unwrap();
        for (order, count) in units.iter().enumerate() {
            assert!((expected.orders[order].units[age as usize] - *count as f64).abs() < 1e-12);
        }
    }
}

/// Example 2: no break, equal death d at every order.
#[test]
fn example_2_loses_buds() {
    let tables =
        [("example2", [0.9, 2.52, 5.436, 10.0287, 16.52409]), ("example2_d20", [0.8, 2.08, 4.128, 6.9952, 10.59968])];
    for (name, totals) in tables {
        assert_totals(name, &totals);
    }
}

/// Example 3: no death, break .5 on orders 2 and 3.
#[test]
fn example_3_makes_pauses() {
    assert_totals("example3", &[1.0, 2.5, 4.75, 8.0, 12.5, 18.5]);
}

fn assert_totals(name: &str, totals: &[f64]) {
    let until = totals.len() as u32;
    let model = shipped(name, until);
    let expected = model.expectation(until).unwrap();
    let plants: Vec<_> = (0..PLANTS).map(|number| plant(&model, number, until)).collect();
    for (age, &total) in (1..).zip(totals) {
        let closed: f64 = expected.orders.iter().map(|order| order.units[age as usize]).sum();
        assert!((closed - total).abs() < 1e-9, "{name} at age {age}: closed form {closed}, by hand {total}");
        let sample = Sample::of(plants.iter().map(|plant| units_by_order(plant, age).iter().sum::<u64>() as f64));
        sample.assert_mean(total, &format!("{name} at age {age}"));
    }
}

/// Example 4: n = 20, two laterals a node, break p = .2 on order 2, growth ratio r of order 1 over order 2. Each of the
/// N steps of the laterals grows with probability 1 − p: mean N (1 − p), variance p times the mean.
#[test]
fn example_4_grows_at_the_ratio_of_figure_14() {
    let figures = [
        ("example4_r05", 608.0),
        ("example4", 304.0),
        ("example4_r15", 192.0),
        ("example4_r2", 144.0),
        ("example4_r3", 91.2),
    ];
    for (name, mean) in figures {
        let model = shipped(name, 20);
        let closed = model.expectation(20).unwrap().orders[1].units[20];
        assert!((closed - mean).abs() < 1e-9, "{name}: closed form {closed}, by hand {mean}");
        let units = (0..PLANTS).map(|number| units_by_order(&plant(&model, number, 20), 20)[1] as f64);
        let sample = Sample::of(units);
        sample.assert_mean(mean, name);
        sample.assert_variance(0.2 * mean, name);
    }
}
