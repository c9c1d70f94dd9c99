//! From the rows of a file to days without a gap, or to what is wrong with their order.
//!
//! Rows must go forward. Days without a row and days without a temperature are one thing to a sum of degree-days: a run
//! of them is filled where that is asked for and it is short enough and lies between days that have both; else it is
//! told once, with its length. A fill is the straight line between the days around it, for all that both of them have,
//! but for rain, which is then not known; what is filled never crosses the other extreme of its day. Absent: values of
//! a row.

use crate::asked::{Asked, Beyond};
use crate::fault::{Faults, Kind, Place, Refused};
use crate::quantity::{QUANTITIES, Quantity, Values};
use crate::rows::{Row, Rows};
use crate::weather::{Absent, Filled, Notes, Station, Weather};

/// Days in a row without a temperature.
#[derive(Default)]
struct Run {
    /// How many.
    days: u32,
    /// The rows before which days are missing, and how many.
    gaps: Vec<(usize, u32)>,
    /// The rows that lack a temperature.
    bare: Vec<usize>,
}

/// The days of a file, or all that is wrong with it.
pub(crate) fn weather(
    rows: Rows<'_>,
    station: Station,
    unused: Vec<String>,
    name: &str,
    asked: &Asked,
) -> Result<Weather, Refused> {
    let Rows { mut faults, mut found, mut measured, flagged, left_out, .. } = rows;
    keep_in_order(&mut found, &mut measured, &mut faults);
    let filled = check_runs(&found, &measured, &mut faults, asked.interpolate_days);
    if found.is_empty() && faults.is_empty() {
        faults.tell(Kind::Layout, Place::default(), "this file has no day", "a row for each day");
    }
    let (Some(first), Some(end), true) = (found.first(), found.last(), faults.is_empty()) else {
        return Err(faults.into_refused(name));
    };
    let (first, end) = (first.day, end.place);
    let mut notes = Notes { filled, flagged_rows: flagged, left_out, unused, absent: Vec::new() };
    let values = if notes.filled.is_empty() { measured } else { spread(&found, &measured) };
    notes.absent = absent(&values);
    let weather = Weather::new(station, notes, first, values);
    if asked.beyond == Beyond::Refuse {
        return Ok(weather);
    }
    let days = weather.days().len();
    weather.repeated().ok_or_else(|| {
        let problem = format!("this weather cannot be repeated: its {days} days are no whole year");
        faults.tell(Kind::Short, end, problem, "at least a whole year, or no `beyond`");
        faults.into_refused(name)
    })
}

/// Keeps the rows that go forward; the others are told.
fn keep_in_order(rows: &mut Vec<Row>, measured: &mut Vec<Values>, faults: &mut Faults<'_>) {
    if rows.is_sorted_by(|a, b| a.day < b.day) {
        return;
    }
    let mut last = None;
    let kept: Vec<bool> = rows
        .iter()
        .map(|row| {
            let Some(before) = last.filter(|before| row.day <= *before) else {
                last = Some(row.day);
                return true;
            };
            let problem = match row.day == before {
                true => format!("{before} was there before"),
                false => format!("{} comes after {before}", row.day),
            };
            faults.tell(Kind::Order, row.place, problem, format!("the day after {before}, {}", before.plus(1)));
            false
        })
        .collect();
    let mut kept_rows = kept.iter();
    rows.retain(|_| kept_rows.next() == Some(&true));
    let mut kept_values = kept.iter();
    measured.retain(|_| kept_values.next() == Some(&true));
}

/// Goes through the runs of days without a temperature: those that may be filled are given back, the others told.
fn check_runs(rows: &[Row], measured: &[Values], faults: &mut Faults<'_>, most: u32) -> Vec<Filled> {
    let (mut filled, mut run, mut before) = (Vec::new(), Run::default(), None);
    for (at, (row, values)) in rows.iter().zip(measured).enumerate() {
        let gap = before.replace(row.day).map_or(0, |before| (row.day.since(before) - 1) as u32);
        if gap > 0 && !row.after_broken {
            run.gaps.push((at, gap));
            run.days += gap;
        }
        if !values.are_whole() {
            run.bare.push(at);
            run.days += 1;
        } else if run.days > 0 {
            let run = std::mem::take(&mut run);
            let is_inside = run.bare.first() != Some(&0);
            if is_inside && run.days <= most {
                filled.push(Filled { from: row.day.plus(-(run.days as i32)).to_string(), days: run.days });
            } else {
                tell(&run, rows, measured, faults, is_inside);
            }
        }
    }
    tell(&run, rows, measured, faults, false);
    filled
}

/// Tells a run that is not filled: its gaps, and its rows without a temperature.
fn tell(run: &Run, rows: &[Row], measured: &[Values], faults: &mut Faults<'_>, is_inside: bool) {
    let or = match run.days {
        days @ 1..=31 if is_inside => format!(", or `gaps = {{ interpolate_days = {days} }}`"),
        _ => String::new(),
    };
    for (at, days) in &run.gaps {
        let (from, to) = (rows[*at].day.plus(-(*days as i32)), rows[*at].day.plus(-1));
        let problem = match days {
            1 => format!("{from} is missing before this row"),
            _ => format!("{days} days are missing before this row, {from} to {to}"),
        };
        faults.tell(Kind::Gap { days: *days }, rows[*at].place, problem, format!("a row for each day{or}"));
    }
    for bare in run.bare.chunk_by(|a, b| *b == a + 1) {
        let (Some(first), Some(last)) = (bare.first(), bare.last()) else { continue };
        let values = &measured[*first];
        let which = match (values.get(Quantity::Maximum), values.get(Quantity::Minimum)) {
            (None, None) => "temperature",
            (None, Some(_)) => "maximum temperature",
            _ => "minimum temperature",
        };
        let (first, last, days) = (&rows[*first], &rows[*last], bare.len() as u32);
        let problem = match days {
            1 => format!("{} has no {which}", first.day),
            _ => format!("{days} days have no temperature, {} to {}", first.day, last.day),
        };
        let expected = format!("a maximum and a minimum for each day{or}");
        faults.tell(Kind::Missing { days }, first.place, problem, expected);
    }
}

/// The values of each day, what lies between two rows filled.
fn spread(rows: &[Row], measured: &[Values]) -> Vec<Values> {
    let mut spread: Vec<Values> = Vec::with_capacity(rows.len());
    let (mut whole, mut pending) = (None, false);
    for (row, values) in rows.iter().zip(measured) {
        let at = row.day.since(rows[0].day) as usize;
        pending |= spread.len() < at;
        spread.resize(at, Values::default());
        spread.push(*values);
        if !values.are_whole() {
            pending = true;
            continue;
        }
        if let Some(before) = whole.replace(at).filter(|_| pending) {
            fill(&mut spread[before..=at]);
        }
        pending = false;
    }
    spread
}

/// Fills the days between the first and the last of a run, which have both temperatures.
fn fill(run: &mut [Values]) {
    let [first, between @ .., last] = run else { return };
    let steps = between.len() as f64 + 1.0;
    for (step, values) in (1..).zip(between.iter_mut()) {
        let share = f64::from(step) / steps;
        let had = *values;
        // A row that lacks one temperature keeps all that it has.
        let had_row = Quantity::ALL.into_iter().any(|quantity| had.get(quantity).is_some());
        for quantity in Quantity::ALL {
            let is_temperature = matches!(quantity, Quantity::Maximum | Quantity::Minimum);
            let is_asked = quantity != Quantity::Rain && (!had_row || is_temperature);
            let ends = first.get(quantity).zip(last.get(quantity));
            if let (None, true, Some((from, to))) = (had.get(quantity), is_asked, ends) {
                values.set(quantity, Some(from + share * (to - from)));
            }
        }
        if let Some((maximum, minimum)) = values.get(Quantity::Maximum).zip(values.get(Quantity::Minimum)) {
            match had.get(Quantity::Minimum) {
                Some(_) => values.set(Quantity::Maximum, Some(maximum.max(minimum))),
                None => values.set(Quantity::Minimum, Some(minimum.min(maximum))),
            }
        }
    }
}

/// The quantities that were measured on some days and not on all.
fn absent(values: &[Values]) -> Vec<Absent> {
    let mut counts = [0_u32; QUANTITIES];
    for values in values {
        for (count, quantity) in counts.iter_mut().zip(Quantity::ALL) {
            *count += u32::from(values.get(quantity).is_none());
        }
    }
    let some = Quantity::ALL.into_iter().zip(counts).filter(|(_, days)| *days > 0 && (*days as usize) < values.len());
    some.map(|(quantity, days)| Absent { quantity: quantity.words(), days }).collect()
}
