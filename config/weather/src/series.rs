//! From the rows of a file to days without a gap, or to what is wrong with their order.
//!
//! Rows must go forward. Days without a row and days without a temperature are one thing to a sum of degree-days: a
//! run of them is filled where that is asked for and it is short enough and lies between days that have both; else it
//! is told once, with its length. A fill is the straight line between the days around it, for all that both of them
//! have, but for rain, which is then not known; what is filled never crosses the other extreme of its day. Absent: values of a row.

use crate::asked::{Asked, Beyond};
use crate::fault::{Faults, Kind, Place, Refused};
use crate::quantity::{Quantity, Values};
use crate::rows::{Row, Rows};
use crate::weather::{Absent, Day, Filled, Notes, Station, Weather};

const MAXIMUM: usize = Quantity::Maximum as usize;
const MINIMUM: usize = Quantity::Minimum as usize;
const RAIN: usize = Quantity::Rain as usize;

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
    let Rows { mut faults, found, flagged, left_out, .. } = rows;
    let found = in_order(found, &mut faults);
    let filled = check_runs(&found, &mut faults, asked.interpolate_days);
    if found.is_empty() && faults.is_empty() {
        faults.tell(Kind::Layout, Place::default(), "this file has no day", "a row for each day");
    }
    let (Some(first), Some(end), true) = (found.first(), found.last(), faults.is_empty()) else {
        return Err(faults.into_refused(name));
    };
    let (first, end) = (first.day, end.place);
    let mut notes = Notes { filled, flagged_rows: flagged, left_out, unused, absent: Vec::new() };
    let values = spread(&found);
    notes.absent = absent(&values);
    let weather = Weather::new(station, notes, first, values.iter().map(day).collect());
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

/// The rows that go forward; the others are told.
fn in_order(rows: Vec<Row>, faults: &mut Faults<'_>) -> Vec<Row> {
    let mut kept: Vec<Row> = Vec::with_capacity(rows.len());
    for row in rows {
        let before = kept.last().map(|last| last.day);
        match before.filter(|before| row.day <= *before) {
            None => kept.push(row),
            Some(before) => {
                let problem = if row.day == before {
                    format!("{before} was there before")
                } else {
                    format!("{} comes after {before}", row.day)
                };
                faults.tell(Kind::Order, row.place, problem, format!("the day after {before}, {}", before.plus(1)));
            }
        }
    }
    kept
}

/// Goes through the runs of days without a temperature: those that may be filled are given back, the others told.
fn check_runs(rows: &[Row], faults: &mut Faults<'_>, most: u32) -> Vec<Filled> {
    let (mut filled, mut run) = (Vec::new(), Run::default());
    for (at, row) in rows.iter().enumerate() {
        let gap = at.checked_sub(1).map_or(0, |before| (row.day.since(rows[before].day) - 1) as u32);
        if gap > 0 && !row.after_broken {
            run.gaps.push((at, gap));
            run.days += gap;
        }
        if row.values[MAXIMUM].is_none() || row.values[MINIMUM].is_none() {
            run.bare.push(at);
            run.days += 1;
        } else if run.days > 0 {
            let run = std::mem::take(&mut run);
            let is_inside = run.bare.first() != Some(&0);
            if is_inside && run.days <= most {
                filled.push(Filled { from: row.day.plus(-(run.days as i32)).to_string(), days: run.days });
            } else {
                tell(&run, rows, faults, is_inside);
            }
        }
    }
    tell(&run, rows, faults, false);
    filled
}

/// Tells a run that is not filled: its gaps, and its rows without a temperature.
fn tell(run: &Run, rows: &[Row], faults: &mut Faults<'_>, is_inside: bool) {
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
        let (first, last, days) = (&rows[*first], &rows[*last], bare.len() as u32);
        let which = match (first.values[MAXIMUM].is_none(), first.values[MINIMUM].is_none()) {
            (true, true) => "temperature",
            (true, false) => "maximum temperature",
            _ => "minimum temperature",
        };
        let problem = match days {
            1 => format!("{} has no {which}", first.day),
            _ => format!("{days} days have no temperature, {} to {}", first.day, last.day),
        };
        let expected = format!("a maximum and a minimum for each day{or}");
        faults.tell(Kind::Missing { days }, first.place, problem, expected);
    }
}

/// The values of each day, what lies between two rows filled.
fn spread(rows: &[Row]) -> Vec<Values> {
    let days = rows.first().zip(rows.last()).map_or(0, |(first, last)| last.day.since(first.day) + 1);
    let mut spread: Vec<Values> = Vec::with_capacity(usize::try_from(days).unwrap_or(0));
    let (mut whole, mut pending) = (None, false);
    for row in rows {
        let at = row.day.since(rows[0].day) as usize;
        pending |= spread.len() < at;
        spread.resize(at, Values::default());
        spread.push(row.values);
        if row.values[MAXIMUM].is_none() || row.values[MINIMUM].is_none() {
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
        // A row that lacks one temperature keeps all that it has.
        let had_row = values.iter().any(Option::is_some);
        let had_minimum = values[MINIMUM].is_some();
        for (at, value) in values.iter_mut().enumerate() {
            let is_asked = at != RAIN && (!had_row || at == MAXIMUM || at == MINIMUM);
            if let (None, true, Some(from), Some(to)) = (*value, is_asked, first[at], last[at]) {
                *value = Some(from + share * (to - from));
            }
        }
        if let (Some(maximum), Some(minimum)) = (values[MAXIMUM], values[MINIMUM]) {
            let filled = if had_minimum { MAXIMUM } else { MINIMUM };
            values[filled] = Some(if had_minimum { maximum.max(minimum) } else { minimum.min(maximum) });
        }
    }
}

/// The quantities that were measured on some days and not on all.
fn absent(values: &[Values]) -> Vec<Absent> {
    let count = |quantity: Quantity| values.iter().filter(|values| values[quantity as usize].is_none()).count();
    let counted = Quantity::ALL.into_iter().map(|quantity| (quantity, count(quantity)));
    let some = counted.filter(|(_, days)| *days > 0 && *days < values.len());
    some.map(|(quantity, days)| Absent { quantity: quantity.words(), days: days as u32 }).collect()
}

fn day(values: &Values) -> Day {
    let [maximum, minimum, rain, radiation, wind, dew_point, vapour_pressure, humidity] = *values;
    Day {
        maximum: maximum.unwrap_or_default(),
        minimum: minimum.unwrap_or_default(),
        rain,
        radiation,
        wind,
        dew_point,
        vapour_pressure,
        humidity: humidity.map(|share| share.min(1.0)),
    }
}
