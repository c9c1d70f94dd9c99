//! Twenty weather files of DSSAT and one of APSIM, as people have them, against an independent reader of them.
//!
//! The files and the table of what the other reader found stand outside the project (`absent`): without them these
//! tests fail in CI and are skipped elsewhere. A clean file must give the other reader's days and degree-days to its
//! digits, a faulty one must be told at its lines, and at no others. Two files have values that touch: they may be read
//! right or told. Absent: the traps one by one, which `traps` has in files of its own.

#[path = "../../../tests/program/absent.rs"]
mod absent;

use phytomer_sim::math::pow;
use phytomer_sim::site::degree_days::{DegreeDays, Method};
use phytomer_weather::{Asked, Kind, Refused, Weather, read};
use std::collections::{BTreeMap, BTreeSet};

/// A row of the table, its cells by column.
type Row = BTreeMap<String, String>;

fn oracle() -> Option<Vec<Row>> {
    let text = absent::measured("weather/oracle.tsv")?;
    let mut lines = text.lines().map(|line| line.split('\t').map(str::to_owned).collect::<Vec<_>>());
    let names = lines.next().expect("a line of names");
    Some(lines.map(|cells| names.iter().cloned().zip(cells).collect()).collect())
}

fn file(name: &str, asked: &Asked) -> Option<Result<Weather, Refused>> {
    Some(read(name, absent::measured(&format!("weather/{name}"))?.as_bytes(), asked))
}

fn lines(row: &Row, column: &str) -> BTreeSet<usize> {
    row[column].split(',').filter(|cell| !cell.is_empty()).map(|cell| cell.parse().expect("a line")).collect()
}

fn told(refused: &Refused, is: impl Fn(Kind) -> bool) -> BTreeSet<usize> {
    refused.faults.iter().filter(|fault| is(fault.kind)).map(|fault| fault.line).collect()
}

fn sum(weather: &Weather, method: Method) -> f64 {
    weather.degree_days(DegreeDays { method, base: 10.0, upper: None }).sum()
}

#[test]
fn clean_files_have_the_days_and_degree_days_of_another_reader() {
    let Some(oracle) = oracle() else { return };
    let clean: Vec<&Row> = oracle.iter().filter(|row| !row["dd10_sine"].is_empty()).collect();
    assert_eq!(clean.len(), 11);
    for row in clean {
        let name = &row["file"];
        let weather = file(name, &Asked::default()).expect("the file").unwrap_or_else(|refused| panic!("{refused}"));
        assert_eq!(weather.days().len().to_string(), row["rows"], "{name}");
        assert_eq!(
            [weather.first(), weather.last()].map(|day| day.to_string()),
            [&row["first"], &row["last"]].map(String::clone)
        );
        assert_eq!(weather.notes.flagged_rows.to_string(), row["flagged_rows"], "{name}");
        for (column, method) in
            [("average", Method::Average), ("thresholded", Method::Thresholded), ("sine", Method::Sine)]
        {
            let known = &row[&format!("dd10_{column}")];
            let sum = sum(&weather, method);
            let digits = known.split_once('.').map_or(0, |(_, decimals)| decimals.len()).max(2);
            let known: f64 = known.parse().expect("degree-days");
            let half = 0.5 / pow(10.0, digits as f64) + 1e-9;
            assert!((sum - known).abs() <= half, "{name}, {column}: {sum}, not {known}");
        }
    }
}

#[test]
fn faulty_files_are_told_at_the_lines_of_another_reader() {
    let Some(oracle) = oracle() else { return };
    for row in oracle.iter().filter(|row| row["dd10_sine"].is_empty()) {
        let name = &row["file"];
        let read = file(name, &Asked::default()).expect("the file");
        let refused = match read {
            Ok(weather) => {
                assert_eq!(name, "MSKB9501.WTH", "only values that touch may be read: {}", weather.days().len());
                continue;
            }
            Err(refused) => refused,
        };
        for (column, kind) in [
            ("tmin_above_tmax_lines", Kind::Crossed),
            ("impossible_lines", Kind::Impossible),
            ("unreadable_lines", Kind::Unreadable),
            ("repeated_or_backward_lines", Kind::Order),
        ] {
            let missed: Vec<_> = lines(row, column).difference(&told(&refused, |k| k == kind)).copied().collect();
            let more: Vec<_> = told(&refused, |k| k == kind).difference(&lines(row, column)).copied().collect();
            assert!(
                missed.is_empty() && more.is_empty(),
                "{name}, {column}: missed {missed:?}, more {more:?}\n{refused}"
            );
        }
        let gaps = told(&refused, |kind| matches!(kind, Kind::Gap { .. }));
        assert_eq!(gaps, lines(row, "gap_before_lines"), "{name}");
        let missing = |fault: &phytomer_weather::Fault| match fault.kind {
            Kind::Missing { days } => days,
            _ => 0,
        };
        let days: u32 = refused.faults.iter().map(missing).sum();
        assert_eq!(days.to_string(), row["missing_temperature_rows"], "{name}");
        assert!(!refused.faults.iter().any(|fault| fault.kind == Kind::Layout), "{refused}");
    }
}

#[test]
fn the_file_of_apsim_has_all_its_days() {
    let name = "Ames_2000_2001.met";
    let Some(text) = absent::measured(&format!("weather/{name}")) else { return };
    let weather = read(name, text.as_bytes(), &Asked::default()).unwrap_or_else(|refused| panic!("{refused}"));
    assert_eq!([weather.first(), weather.last()].map(|day| day.to_string()), ["2000-01-01", "2001-08-14"]);
    assert_eq!(weather.station.latitude, Some(42.03_f64.to_radians()));
    let rows = text.lines().filter(|line| line.starts_with("200"));
    let cells = rows.map(|row| row.split(' ').map(|cell| cell.parse().expect("a number")).collect::<Vec<f64>>());
    let read = weather.days().map(|day| [day.radiation, Some(day.maximum), Some(day.minimum), day.rain]);
    assert!(
        read.eq(cells.map(|cells| [cells[2], cells[3], cells[4], cells[5]].map(Some))),
        "another value than is written"
    );
}

/// Values of the one file are parted by blanks and minuses, those of the other stand in columns of six characters.
#[test]
fn values_that_touch_are_those_of_their_columns() {
    let of_minuses =
        |row: &str| row.replace('-', " -").split_whitespace().skip(1).map(str::to_owned).collect::<Vec<_>>();
    let of_columns = |row: &str| [5, 11, 17, 23].map(|at| row[at..at + 6].trim().to_owned()).to_vec();
    let cuts: [fn(&str) -> Vec<String>; 2] = [of_minuses, of_columns];
    for ((name, year), cut) in [("MSKB9501.WTH", "95"), ("CNCH8401.WTH", "84")].into_iter().zip(cuts) {
        let Some(text) = absent::measured(&format!("weather/{name}")) else { return };
        let weather = read(name, text.as_bytes(), &Asked::default()).unwrap_or_else(|refused| panic!("{refused}"));
        let rows = text.lines().filter(|line| line.starts_with(year)).map(cut);
        let known = rows.map(|cells| cells.iter().map(|cell| cell.parse().ok()).collect::<Vec<Option<f64>>>());
        let read = weather.days().map(|day| vec![day.radiation, Some(day.maximum), Some(day.minimum), day.rain]);
        assert!(read.eq(known), "{name}: another value than stands in its column");
    }
}
