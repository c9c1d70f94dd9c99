//! What is written in a format is what is read: random days in random layouts, written by another rule than they are
//! read.
//!
//! Columns come in any order, some cells are blank, rows are shifted by up to four characters. Read back, each value is
//! the one that was written, or the file is told; where nothing is shifted or blank it must be read. Absent: slips of
//! values.

mod draw;

use draw::Draw;
use phytomer_weather::{Asked, Weather, read};
use std::fmt::Write as _;

impl Draw {
    /// Tenths between two bounds.
    fn tenths(&mut self, least: i32, most: i32) -> i32 {
        least + self.below((most - least + 1) as usize) as i32
    }

    fn shuffle(&mut self, columns: &mut [usize]) {
        (1..columns.len()).for_each(|at| columns.swap(at, self.below(at + 1)));
    }
}

/// Radiation, maximum, minimum, rain and humidity of a day, in tenths.
type Tenths = [i32; 5];

const CODES: [&str; 5] = ["SRAD", "TMAX", "TMIN", "RAIN", "RHUM"];
const DAYS: usize = 20;

fn days(draw: &mut Draw) -> Vec<Tenths> {
    let day = |_| {
        let minimum = draw.tenths(-300, 300);
        let maximum = minimum + draw.tenths(0, 150);
        [draw.tenths(0, 320), maximum, minimum, draw.tenths(0, 1500), draw.tenths(100, 1000)]
    };
    (0..DAYS).map(day).collect()
}

fn written(tenths: i32) -> String {
    format!("{}{}.{}", if tenths < 0 { "-" } else { "" }, tenths.abs() / 10, tenths.abs() % 10)
}

fn value(tenths: i32) -> f64 {
    written(tenths).parse().expect("a number")
}

/// Compares what was read with what was written; `may_lack` tells which cells may have been left out.
fn compare(weather: &Weather, days: &[Tenths], may_lack: impl Fn(usize, usize) -> bool, text: &str) {
    assert_eq!(weather.days().len(), days.len());
    for (number, (day, tenths)) in weather.days().zip(days).enumerate() {
        let humidity = day.humidity.map(|share| (share * 1000.0).round() / 10.0);
        let read = [day.radiation, Some(day.maximum), Some(day.minimum), day.rain, humidity];
        for (column, (read, tenths)) in read.into_iter().zip(tenths).enumerate() {
            let lacks = read.is_none() && may_lack(number, column);
            assert!(lacks || read == Some(value(*tenths)), "{} of day {number}: {read:?}\n{text}", CODES[column]);
        }
    }
}

#[test]
fn a_wth_is_read_right_or_told() {
    let (mut draw, mut in_place, mut read_shifted, mut told) = (Draw(7), 0, 0, 0);
    for _ in 0..2_000 {
        let days = days(&mut draw);
        let mut order: Vec<usize> = (0..CODES.len()).collect();
        draw.shuffle(&mut order);
        let shift = draw.below(9) as i32 - 4;
        let blanks: Vec<Vec<bool>> = (0..DAYS)
            .map(|_| (0..5).map(|column| column != 1 && column != 2 && draw.below(6) == 0).collect())
            .collect();
        let mut text = order.iter().fold("@DATE".to_owned(), |text, column| format!("{text}{:>7}", CODES[*column]));
        for (number, day) in days.iter().enumerate() {
            let mut row = format!("\n95{:03}", number + 1);
            let mut end = 5 + shift;
            for column in &order {
                end += 7;
                if !blanks[number][*column] {
                    let width = (end as usize + 1).saturating_sub(row.len());
                    // A value that is wider than its place pushes the rest to the right, as in no file: it is left out.
                    let _ = write!(row, "{:>width$}", written(day[*column]));
                }
            }
            text += &row;
        }
        text.push('\n');
        match read("a.WTH", text.as_bytes(), &Asked::default()) {
            Ok(weather) => {
                let may_lack = |day: usize, column: usize| blanks[day][column] || column == 4;
                compare(&weather, &days, may_lack, &text);
                in_place += u32::from(shift == 0);
                read_shifted += u32::from(shift != 0);
            }
            Err(refused) => {
                assert!(shift.abs() > 1, "{refused}\n{text}");
                told += 1;
            }
        }
    }
    assert!(in_place > 150 && read_shifted > 150 && told > 500, "{in_place} {read_shifted} {told}");
}

#[test]
fn a_csv_and_a_met_are_read_right() {
    let mut draw = Draw(8);
    for _ in 0..500 {
        let days = days(&mut draw);
        let mut order: Vec<usize> = (0..CODES.len()).collect();
        draw.shuffle(&mut order);
        let separator = [',', ';', '\t'][draw.below(3)];
        let mut csv =
            order.iter().fold("W_DATE".to_owned(), |text, column| format!("{text}{separator}{}", CODES[*column]));
        let apsim = ["radn", "maxt", "mint", "rain", "rh"];
        let mut met = order.iter().fold("year day".to_owned(), |text, column| format!("{text} {}", apsim[*column]));
        for (number, day) in days.iter().enumerate() {
            let _ = write!(csv, "\n1995-01-{:02}", number + 1);
            let _ = write!(met, "\n1995 {}", number + 1);
            for column in &order {
                let _ = write!(csv, "{separator}{}", written(day[*column]));
                let _ = write!(met, "{:>width$}", written(day[*column]), width = 6 + draw.below(5));
            }
        }
        for (name, text) in [("a.csv", csv), ("a.met", met)] {
            let weather = read(name, text.as_bytes(), &Asked::default()).unwrap_or_else(|refused| panic!("{refused}"));
            compare(&weather, &days, |_, _| false, &text);
        }
    }
}
