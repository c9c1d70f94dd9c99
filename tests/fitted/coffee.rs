//! Coffee: the activity of 200 orthotropic axes (Cilas), and the branch mortality of robusta (GreenLab course, CIRAD),
//! against the shipped species.
//!
//! The published activity and the published mortality are tested too. Absent: sizes of organs.

use crate::chi2::{Outcome, homogeneity, tail};
use crate::measured::{Table, counted, moments};
use crate::simulated::{grown, shipped};
use phytomer_fits::activity::waiting::{Wait, waiting};
use phytomer_models::buds::{Buds, Order};
use phytomer_models::law::{Law, LawForm, RobustaLaw};
use phytomer_sim::math;
use std::collections::BTreeMap;

const GROUPS: u32 = 6;
const LAST_DAY: u32 = 167;
/// Days of a growth cycle while growth is steady.
const CYCLE: f64 = 20.0;

/// The cumulative nodes of each axis by day, group by group.
fn axes(table: &Table) -> Vec<Vec<BTreeMap<u32, f64>>> {
    let mut groups = vec![BTreeMap::<u32, BTreeMap<u32, f64>>::new(); GROUPS as usize];
    for row in table.rows() {
        let group = &mut groups[row.number("group") as usize - 1];
        let days = group.entry(row.number("axis_id") as u32).or_default();
        days.insert(row.number("day") as u32, row.number("nodes_emitted"));
    }
    groups.into_iter().map(|group| group.into_values().collect()).collect()
}

/// What each axis made between two days, of those seen on both.
fn made_between(axes: &[BTreeMap<u32, f64>], from: u32, to: u32) -> Vec<f64> {
    axes.iter().filter_map(|days| Some(days.get(&to)? - days.get(&from)?)).collect()
}

/// The days between the nodes of each axis, of waits begun before day 60; whether each ended.
fn waits(axes: &[BTreeMap<u32, f64>]) -> Vec<Wait> {
    let mut waits = Vec::new();
    for days in axes {
        let last = f64::from(*days.keys().next_back().expect("a day"));
        let nodes = days.iter().zip(days.iter().skip(1));
        let emitted: Vec<f64> = nodes.filter(|(a, b)| b.1 > a.1).map(|(_, b)| f64::from(*b.0)).collect();
        for (place, day) in emitted.iter().enumerate().filter(|(_, day)| **day < 60.0) {
            let next = emitted.get(place + 1);
            waits.push(Wait { days: next.unwrap_or(&last) - day, ended: next.is_some() });
        }
    }
    waits
}

/// b = 1 − V / X, and its standard error: that of a variance, V √(2 / (n − 1)), over the mean.
fn activity(nodes: &[f64]) -> (f64, f64) {
    let (mean, variance) = moments(nodes);
    (1.0 - variance / mean, variance / mean * (2.0 / (nodes.len() as f64 - 1.0)).sqrt())
}

/// The probability of a pause of the shipped trunk, and its interval.
fn pause() -> (f64, [f64; 2]) {
    let Law::Form(form) = shipped("coffee", 1).order.remove(0).pause else { panic!("a law with its source") };
    (form.value.expect("a number"), form.interval["value"])
}

/// Whole days hold a stop of growth: 1 − V/X of all 167 tells less of pauses than of the stop. The published b = 0.92
/// of a robusta stem is within the interval of two of the six groups then, and above that of all axes together.
#[test]
fn the_activity_of_each_group_with_its_interval() {
    let Some(table) = Table::read("coffee_orthotropic_nodes_cilas.csv") else { return };
    let groups = axes(&table);
    let mut holds = 0;
    for (group, axes) in (1..).zip(&groups) {
        let (b, error) = activity(&made_between(axes, 0, LAST_DAY));
        println!("| coffee, group {group} | b {b:.3} ± {:.3} |", 1.96 * error);
        assert!((0.7..0.95).contains(&b));
        holds += usize::from((b - 0.92).abs() <= 1.96 * error);
    }
    assert_eq!(holds, 2);
    let (b, error) = activity(&made_between(&groups.concat(), 0, LAST_DAY));
    println!("| coffee, all | b {b:.3} ± {:.3} |", 1.96 * error);
    assert!((b - 0.814).abs() < 0.001 && b + 4.0 * error < 0.92);
}

/// The activity of the shipped trunk is that of the waiting times of the steady months, with its interval; .92 is
/// outside.
#[test]
fn the_trunk_has_the_activity_of_the_steady_months() {
    let Some(table) = Table::read("coffee_orthotropic_nodes_cilas.csv") else { return };
    let waits = waits(&axes(&table).concat());
    let fit = waiting(&waits).expect("waits");
    let b = fit.estimate("b").expect("b");
    let (low, high) = (b.low.expect("a limit"), b.high.expect("a limit"));
    let (pause, interval) = pause();
    println!(
        "| coffee, waits | n {} | b {:.3} ({low:.3}–{high:.3}) | shipped {:.3} |",
        waits.len(),
        b.value,
        1.0 - pause
    );
    assert!((1.0 - pause - b.value).abs() < 1e-3, "{pause} {b:?}");
    assert!((1.0 - interval[1] - low).abs() < 1e-3 && (1.0 - interval[0] - high).abs() < 1e-3, "{interval:?} {b:?}");
    assert!(high < 0.92 && (fit.value("days_per_tick") - CYCLE).abs() < 0.1, "{fit:?}");
}

/// Waits of one cycle, two, and more: a bud without a memory, as the shipped trunk has, pauses twice in a row too
/// seldom. The axes that stall go on stalling.
#[test]
fn waits_are_longer_than_those_of_a_bud_without_memory() {
    let Some(table) = Table::read("coffee_orthotropic_nodes_cilas.csv") else { return };
    let class = |cycles: f64| cycles.clamp(1.0, 3.0) as usize - 1;
    let ended = waits(&axes(&table).concat()).into_iter().filter(|wait| wait.ended);
    let measured = counted(ended.map(|wait| class((wait.days / CYCLE).round())));
    // A trunk's nodes by the cycles at which it made them: the gaps between these.
    let trunks = grown(&shipped("coffee", 1), 2000, 60);
    let gaps = trunks.iter().flat_map(|plant| {
        let births: Vec<u32> = (0..plant.nodes.len()).map(|node| plant.nodes.birth[node]).collect();
        births.windows(2).map(|pair| class(f64::from(pair[1] - pair[0]))).collect::<Vec<_>>()
    });
    let simulated = counted(gaps);
    println!("| waits of 1, 2 and more cycles | {measured:?} |");
    homogeneity(&measured, &simulated, 1).assert_misfit("coffee, waits in cycles, as shipped");
}

/// The trunk of the shipped species makes about as many nodes as these axes in half a year: 5.4 cycles of steady
/// growth in 167 days, with the stop.
#[test]
fn nodes_of_an_axis_in_half_a_year() {
    let Some(table) = Table::read("coffee_orthotropic_nodes_cilas.csv") else { return };
    let (measured, _) = moments(&made_between(&axes(&table).concat(), 0, LAST_DAY));
    // A month has 30.4 days: 167 are five cycles for one half of the axes and six for the other.
    let shipped = |cycles| grown(&shipped("coffee", 1), 2000, cycles).into_iter().map(|plant| plant.nodes.len() as f64);
    let (mean, _) = moments(&shipped(5).chain(shipped(6)).collect::<Vec<_>>());
    println!("| coffee, nodes in 167 days | {measured:.2} | shipped {mean:.2} |");
    assert!((mean / measured - 1.0).abs() < 0.1, "{mean} and {measured}");
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

/// χ² of the branches of a species dead by each age.
fn dead(points: &[(f64, f64)], death: Option<Law>) -> Vec<f64> {
    let branch = shipped("coffee", 2).order.remove(1);
    let death = death.unwrap_or_else(|| branch.death.clone());
    let order = vec![Order { relay: Default::default(), death, ..branch }];
    let plants = grown(&Buds { order, ..Buds::default() }, 12_000, 47);
    let statistic = |&(cycles, fraction): &(f64, f64)| {
        let dead = plants.iter().filter(|plant| f64::from(plant.axes.apex_end[0]) <= cycles).count() as f64;
        let measured = [600.0 * fraction, 600.0 * (1.0 - fraction)];
        homogeneity(&measured, &[dead, plants.len() as f64 - dead], 0).statistic
    };
    points.iter().filter(|(cycles, _)| *cycles > 0.0).map(statistic).collect()
}

/// Branches of the shipped species die as counted, at all four ages, with two numbers that were estimated.
#[test]
fn branches_of_the_shipped_species_die_as_measured() {
    let Some(points) = dead_fractions() else { return };
    let all: f64 = dead(&points, None).iter().sum();
    Outcome { statistic: all, df: 2, p: tail(all, 2) }.assert_fits("robusta branches, as shipped");
}

/// From 22 cycles on branches with the published mortality die as measured. At 14 the law has a third of the measured
/// deaths: least squares give the few early ones no weight.
#[test]
fn the_published_mortality_has_too_few_early_deaths() {
    let Some(points) = dead_fractions() else { return };
    let law = LawForm { robusta: Some(published()), ..LawForm::default() };
    let [early, late @ ..] = &dead(&points, Some(Law::from(law)))[..] else { panic!("ages") };
    let late: f64 = late.iter().sum();
    Outcome { statistic: late, df: 1, p: tail(late, 1) }.assert_fits("published mortality, by 22, 32 and 47 cycles");
    Outcome { statistic: *early, df: 1, p: tail(*early, 1) }.assert_misfit("published mortality, by 14 cycles");
}

fn published() -> RobustaLaw {
    RobustaLaw { over: phytomer_models::law::Variable::Cycle, alpha: 8.89e-8, beta: 4.418 }
}
