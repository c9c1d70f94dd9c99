//! Coffee: the activity of 200 orthotropic axes (Cilas), and the branch mortality of robusta (GreenLab course, CIRAD),
//! against the shipped species.
//!
//! The published activity is tested too. Absent: sizes of organs.

use crate::chi2::{Outcome, homogeneity, tail};
use crate::measured::{Table, counted, moments};
use crate::simulated::{grown, shipped};
use phytomer_models::buds::{Buds, Order};
use phytomer_models::law::Law;
use phytomer_sim::math;

const GROUPS: u32 = 6;
const LAST_DAY: f64 = 167.0;

/// The nodes that each axis of a group made after its first, in the 167 days; axes lost before are left out.
fn emitted(table: &Table, group: u32) -> Vec<f64> {
    let of_group = table.rows().filter(|row| row.number("group") == f64::from(group));
    of_group.filter(|row| row.number("day") == LAST_DAY).map(|row| row.number("nodes_emitted") - 1.0).collect()
}

/// b = 1 − V / X, and its standard error: that of a variance, V √(2 / (n − 1)), over the mean.
fn activity(nodes: &[f64]) -> (f64, f64) {
    let (mean, variance) = moments(nodes);
    (1.0 - variance / mean, variance / mean * (2.0 / (nodes.len() as f64 - 1.0)).sqrt())
}

/// Nodes made by `plants` axes in a number of cycles, in each of which an axis grows with probability `b`.
fn made(b: f64, plants: u32, cycles: u32) -> Vec<usize> {
    let order = Order { pause: Law::from(1.0 - b), ..Order::default() };
    let buds = Buds { order: vec![order], ..Buds::default() };
    grown(&buds, plants, cycles).iter().map(|plant| plant.nodes.len()).collect()
}

/// The published b = 0.92 of a robusta stem is within the interval of two of the six groups, and above that of all axes
/// together.
#[test]
fn the_activity_of_each_group_with_its_interval() {
    let Some(table) = Table::read("coffee_orthotropic_nodes_cilas.csv") else { return };
    let mut holds = 0;
    for group in 1..=GROUPS {
        let nodes = emitted(&table, group);
        let (b, error) = activity(&nodes);
        println!("| coffee, group {group} | n {} | b {b:.3} ± {:.3} |", nodes.len(), 1.96 * error);
        assert!((0.7..0.95).contains(&b));
        holds += usize::from((b - 0.92).abs() <= 1.96 * error);
    }
    assert_eq!(holds, 2);
    let all: Vec<f64> = (1..=GROUPS).flat_map(|group| emitted(&table, group)).collect();
    let (b, error) = activity(&all);
    println!("| coffee, all | n {} | b {b:.3} ± {:.3} |", all.len(), 1.96 * error);
    assert!((b - 0.814).abs() < 0.001 && b + 4.0 * error < 0.92);
}

/// The trunk of the shipped species, b = 0.92, makes the mean number of nodes, and spreads less than these axes do; a
/// bud of the activity of these axes, 0.814, over 6 or 7 cycles, spreads less than they do, too.
#[test]
fn nodes_of_an_axis_in_half_a_year() {
    let Some(table) = Table::read("coffee_orthotropic_nodes_cilas.csv") else { return };
    let all: Vec<usize> = (1..=GROUPS).flat_map(|group| emitted(&table, group)).map(|nodes| nodes as usize).collect();
    let measured = counted(all.iter().copied());
    // A month has 30.4 days: 167 are five cycles for one half of the axes and six for the other.
    let shipped = |cycles| grown(&shipped("coffee", 1), 2000, cycles).into_iter().map(|plant| plant.nodes.len());
    let trunks: Vec<usize> = shipped(5).chain(shipped(6)).collect();
    let mean = |nodes: &[usize]| nodes.iter().sum::<usize>() as f64 / nodes.len() as f64;
    assert!((mean(&trunks) / mean(&all) - 1.0).abs() < 0.05, "{} and {}", mean(&trunks), mean(&all));
    homogeneity(&measured, &counted(trunks), 0).assert_misfit("coffee, nodes in 167 days, b = .92 as shipped");
    let own: Vec<usize> = made(0.814, 2320, 6).into_iter().chain(made(0.814, 1680, 7)).collect();
    homogeneity(&measured, &counted(own), 2).assert_misfit("coffee, nodes in 167 days, b = .814");
}

/// The measured dead fractions: cycles and fraction, of 600 axes a point.
fn dead_fractions() -> Option<Vec<(f64, f64)>> {
    let table = Table::read("greenlab_published_tables.csv")?;
    let of_coffee = table.rows().filter(|row| row.text("table") == "coffee_branch_mortality");
    Some(of_coffee.map(|row| (row.number("x"), row.number("y"))).collect())
}

/// α and β of 1 − exp(−α iᵝ) by least squares: Gauss-Newton in (ln α, β) with halved steps.
fn least_squares(points: &[(f64, f64)]) -> (f64, f64) {
    let law = |a: f64, beta: f64, i: f64| -math::expm1(-math::exp(a + beta * math::log(i)));
    let points: Vec<_> = points.iter().copied().filter(|(i, _)| *i > 0.0).collect();
    let sum = |a, beta| points.iter().map(|&(i, y)| (y - law(a, beta, i)) * (y - law(a, beta, i))).sum::<f64>();
    let (mut a, mut beta) = (-15.0, 4.0);
    for _ in 0..200 {
        let (mut normal, mut right) = ([0.0; 3], [0.0; 2]);
        for &(i, y) in &points {
            let hazard = math::exp(a + beta * math::log(i));
            let slope = math::exp(-hazard) * hazard;
            let (by_a, by_beta, off) = (slope, slope * math::log(i), y - law(a, beta, i));
            normal = [normal[0] + by_a * by_a, normal[1] + by_a * by_beta, normal[2] + by_beta * by_beta];
            right = [right[0] + by_a * off, right[1] + by_beta * off];
        }
        let det = normal[0] * normal[2] - normal[1] * normal[1];
        let step =
            [(normal[2] * right[0] - normal[1] * right[1]) / det, (normal[0] * right[1] - normal[1] * right[0]) / det];
        let halved = std::iter::successors(Some(1.0), |k| Some(k / 2.0)).take(40);
        let better = halved.into_iter().find(|k| sum(a + k * step[0], beta + k * step[1]) < sum(a, beta));
        let Some(k) = better else { break };
        (a, beta) = (a + k * step[0], beta + k * step[1]);
    }
    (math::exp(a), beta)
}

#[test]
fn least_squares_give_the_published_mortality() {
    let Some(points) = dead_fractions() else { return };
    let (alpha, beta) = least_squares(&points);
    println!("| robusta branches | α {alpha:.3e} | β {beta:.4} |");
    assert!((alpha / 8.89e-8 - 1.0).abs() < 1e-3 && (beta - 4.418).abs() < 1e-3, "{alpha} {beta}");
}

/// From 22 cycles on the branches of the shipped species die as measured. At 14 the law has a third of the measured
/// deaths: least squares give the few early ones no weight.
#[test]
fn branches_of_the_shipped_species_die_as_measured() {
    let Some(points) = dead_fractions() else { return };
    let branch = shipped("coffee", 2).order.remove(1);
    let plants =
        grown(&Buds { order: vec![Order { relay: Default::default(), ..branch }], ..Buds::default() }, 12_000, 47);
    let (mut late, mut early) = (0.0, 0.0);
    for &(cycles, fraction) in points.iter().filter(|(cycles, _)| *cycles > 0.0) {
        let dead = plants.iter().filter(|plant| f64::from(plant.axes.apex_end[0]) <= cycles).count() as f64;
        let measured = [600.0 * fraction, 600.0 * (1.0 - fraction)];
        let outcome = homogeneity(&measured, &[dead, plants.len() as f64 - dead], 0);
        if cycles > 20.0 { late += outcome.statistic } else { early = outcome.statistic }
    }
    Outcome { statistic: late, df: 1, p: tail(late, 1) }.assert_fits("robusta branches dead by 22, 32 and 47 cycles");
    Outcome { statistic: early, df: 1, p: tail(early, 1) }.assert_misfit("robusta branches dead by 14 cycles");
}
