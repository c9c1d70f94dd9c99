//! `mango_two_sites`: the weather files are what their headers say, ticks are sums of degree-days, and panicles come
//! with the cool.
//!
//! Degree-days are added up here from the lines of the files by the area under a sine wave of a thousand points, so
//! that neither the reader of weather nor the closed form of Baskerville & Emin 1969 takes part. Absent: the calendar
//! itself.

use super::read::Columns;
use super::weather_of_normals::{MONTHS, STATIONS, Station};
use super::{grown, mean};
use phytomer::sim::math::sin;
use std::fs;
use std::path::Path;

/// Degree-days of a tick, their base and their limit, as the scenario states them.
const TICK: f64 = 1500.0;
const BASE: f64 = 12.0;
const LIMIT: f64 = 32.0;
/// The plants at a site.
const PLANTS: usize = 8;

fn file_of(station: &Station) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("config/presets/weather");
    fs::read_to_string(folder.join(station.file)).expect("the weather file")
}

/// The highest and the lowest temperature of each day of a file.
fn days(text: &str) -> Vec<[f64; 2]> {
    let rows = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    let number = |cell: Option<&str>| cell.expect("a cell").parse::<f64>().expect("a number");
    rows.map(|row| row.split(',').skip(3)).map(|mut cells| [number(cells.next()), number(cells.next())]).collect()
}

/// The mean over a day of what a sine wave between its extremes has above the base, and not above the limit.
fn degree_days([high, low]: [f64; 2]) -> f64 {
    const POINTS: u32 = 1000;
    let at = |k: u32| {
        let wave = sin(2.0 * std::f64::consts::PI * (f64::from(k) + 0.5) / f64::from(POINTS));
        ((high + low) / 2.0 + (high - low) / 2.0 * wave).clamp(BASE, LIMIT) - BASE
    };
    (0..POINTS).map(at).sum::<f64>() / f64::from(POINTS)
}

#[test]
fn the_weather_files_are_made_of_their_normals() {
    for station in &STATIONS {
        let text = file_of(station);
        assert_eq!(text, station.csv(), "{}: `cargo run --example weather_of_normals` writes it", station.file);
        let days = days(&text);
        assert_eq!(days.len(), 365);
        let mut first = 0;
        for (month, length) in MONTHS.into_iter().enumerate() {
            for (extreme, normals) in [&station.highs, &station.lows].into_iter().enumerate() {
                let of_month = &days[first..first + length];
                let mean = of_month.iter().map(|day| day[extreme]).sum::<f64>() / length as f64;
                // Days are written to a tenth of a degree, each of which is off by .05 at most.
                assert!((mean - normals[month]).abs() <= 0.05, "{}, month {month}: {mean}", station.file);
            }
            first += length;
        }
        // A smooth curve: no step from a month to the next, nor from the last day to the first.
        let step = |k: usize| (0..2).map(|of| (days[k][of] - days[(k + 364) % 365][of]).abs()).fold(0.0, f64::max);
        assert!((0..365).all(|k| step(k) <= 0.25), "{}", station.file);
    }
}

#[test]
fn ticks_are_warmth_and_panicles_come_with_the_cool() {
    let (_home, run) = grown("mango_two_sites");
    let site = Columns::of(&run, "site");
    let summary = Columns::of(&run, "summary");
    let (ticks, dates, sums) = (site.numbers("tick"), site.numbers("date"), site.numbers("degree_day_sum"));
    let mut ends = Vec::new();
    for (place, station) in STATIONS.iter().enumerate() {
        let name = ["Humpty Doo", "Rockhampton"][place];
        let felt: Vec<f64> = days(&file_of(station)).into_iter().map(degree_days).collect();
        let warmest = felt.iter().copied().fold(0.0, f64::max);
        let year: f64 = felt.iter().sum();
        let rows: Vec<usize> = (0..ticks.len()).filter(|row| site.words("treatment")[*row] == name).collect();
        assert!(rows.len() >= 44, "{name}: {} rows", rows.len());
        for row in rows {
            let (tick, sum) = (ticks[row], sums[row]);
            assert!(sum >= TICK * tick && sum < TICK * tick + warmest + 0.01, "{name}, tick {tick}: {sum} °C d");
            if tick == 44.0 {
                // From 2001-11-01, day 11 627 since 1970.
                let days = dates[row] - 11_627.0;
                let expected = 44.0 * TICK / year * 365.0;
                // A year is not evenly warm: up to half of it may be counted with too many or too few degree-days.
                assert!((days - expected).abs() < 100.0, "{name}: {days} days, and {expected} of a mean year");
                ends.push(days / 365.25);
            }
        }
    }
    ends.dedup();
    assert!(ends.len() == 2 && ends[0] < 12.5 && ends[1] > 17.0, "years to the last tick: {ends:?}");
    let at_end = |name: &str, column: &str| -> Vec<f64> {
        let of = |row: &usize| summary.words("treatment")[*row] == name && summary.numbers("age")[*row] == 44.0;
        let rows = (0..summary.numbers("age").len()).filter(of);
        rows.map(|row| summary.numbers(column)[row]).collect()
    };
    let per_shoot = |name: &str| panicles(&run, name) / at_end(name, "internodes").iter().sum::<f64>();
    let (tropics, subtropics) = (per_shoot("Humpty Doo"), per_shoot("Rockhampton"));
    assert!(subtropics > 1.5 * tropics, "panicles an internode: {tropics} and {subtropics}");
    let heights = ["Humpty Doo", "Rockhampton"].map(|name| at_end(name, "height_m"));
    assert!(heights.iter().all(|heights| heights.len() == PLANTS), "{heights:?}");
    println!("heights {:?}, panicles an internode {tropics} and {subtropics}", heights.map(|heights| mean(&heights)));
}

/// The panicles that the plants of a site ever bore.
fn panicles(run: &Path, site: &str) -> f64 {
    let components = Columns::of(run, "components");
    let (treatments, kinds) = (components.words("treatment"), components.words("kind"));
    let rows = (0..kinds.len()).filter(|row| treatments[*row] == site);
    rows.filter(|row| matches!(kinds[*row].as_str(), "flower" | "inflorescence")).count() as f64
}
