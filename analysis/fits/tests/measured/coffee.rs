//! Activity of 200 orthotropic coffee axes (Cilas): counts of two windows, waiting times, steadiness.

use crate::table::{Table, is};
use phytomer_fits::activity::counts::Moments;
use phytomer_fits::activity::stationarity::{Window, stationarity};
use phytomer_fits::activity::waiting::{Wait, waiting};
use std::collections::BTreeMap;

/// The cumulative nodes of each axis, day by day.
fn axes() -> Option<Vec<BTreeMap<u32, f64>>> {
    let table = Table::read("coffee_orthotropic_nodes_cilas.csv")?;
    let mut axes: BTreeMap<(u32, u32), BTreeMap<u32, f64>> = BTreeMap::new();
    for [group, axis, day, nodes] in table.numbers(["group", "axis_id", "day", "nodes_emitted"]) {
        axes.entry((group as u32, axis as u32)).or_default().insert(day as u32, nodes);
    }
    Some(axes.into_values().collect())
}

/// What each axis made between two days, of those seen on both.
fn made(axes: &[BTreeMap<u32, f64>], from: u32, to: u32) -> Vec<u32> {
    axes.iter().filter_map(|days| Some((days.get(&to)? - days.get(&from)?) as u32)).collect()
}

#[test]
fn activity_of_two_windows_of_39_days() {
    let Some(axes) = axes() else { return };
    let fit = Moments::of(&made(&axes, 0, 39)).activity(Some(39.0)).unwrap();
    assert_eq!(fit.n, 200);
    let b = fit.estimate("b").unwrap();
    is("b", b.value, 0.868, 3);
    is("low", b.low.unwrap(), 0.825, 3);
    is("high", b.high.unwrap(), 0.900, 3);
    is("days a tick", fit.value("days_per_tick"), 17.8, 1);
    let fit = Moments::of(&made(&axes, 40, 79)).activity(Some(39.0)).unwrap();
    assert_eq!(fit.n, 199);
    let b = fit.estimate("b").unwrap();
    is("b", b.value, 0.796, 3);
    is("low", b.low.unwrap(), 0.742, 3);
    is("high", b.high.unwrap(), 0.839, 3);
}

#[test]
fn waiting_times_begun_before_day_60() {
    let Some(axes) = axes() else { return };
    let mut waits = Vec::new();
    for days in &axes {
        let last = f64::from(*days.keys().last().unwrap());
        let nodes = days.iter().zip(days.iter().skip(1));
        let emitted: Vec<f64> = nodes.flat_map(|(a, b)| vec![f64::from(*b.0); (b.1 - a.1) as usize]).collect();
        for (place, day) in emitted.iter().enumerate().filter(|(_, day)| **day < 60.0) {
            let next = emitted.get(place + 1);
            waits.push(Wait { days: next.unwrap_or(&last) - day, ended: next.is_some() });
        }
    }
    assert_eq!((waits.len(), waits.iter().filter(|wait| !wait.ended).count()), (562, 2));
    let fit = waiting(&waits).unwrap();
    let b = fit.estimate("b").unwrap();
    is("b", b.value, 0.880, 3);
    // The profile's limits, which scipy gives too; the independent program had .853 and .903.
    is("low", b.low.unwrap(), 0.851, 3);
    is("high", b.high.unwrap(), 0.905, 3);
    is("tick", fit.value("days_per_tick"), 20.0, 1);
    is("sd", fit.value("sd"), 3.5, 1);
    is("log L", fit.log_likelihood.unwrap(), -1740.1, 1);
}

/// The figures take all axes as seen over every window. Three axes were lost; with the axes of each window the
/// statistics are 6.24 and 337.4.
#[test]
fn growth_was_steady_for_84_days_and_not_for_156() {
    let Some(axes) = axes() else { return };
    let tested = |from: u32, to: u32, equal: bool| {
        let window = |start: u32| {
            let made = made(&axes, start, start + 12);
            let seen = if equal { 1.0 } else { made.len() as f64 };
            Window { axes: seen, nodes: f64::from(made.iter().sum::<u32>()) }
        };
        stationarity(&(from..to).step_by(12).map(window).collect::<Vec<_>>()).unwrap()
    };
    for (from, to, df, plain, weighted, holds) in [(12, 84, 5.0, 6.4, 6.2, true), (0, 156, 12.0, 342.6, 337.4, false)] {
        let test = tested(from, to, true);
        is("χ²", test.statistic, plain, 1);
        is("χ², by axes", tested(from, to, false).statistic, weighted, 1);
        assert_eq!((test.df, test.p > 0.01), (df, holds));
    }
}
