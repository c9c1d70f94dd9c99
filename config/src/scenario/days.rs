//! Days of a scenario that become ticks of its calendar: those of events and of pests.
//!
//! A day belongs to the tick that spans it ([`Calendar::tick_of`]); in a replicate that grows some years later it is as
//! many years later. A day that comes again each year belongs to a tick of each year; 29 February is 28 February in a
//! year without it. Absent: how a calendar is made.

use phytomer_law::fault::{Fault, Path};
use phytomer_sim::clock::Tick;
use phytomer_sim::site::calendar::Calendar;
use phytomer_sim::site::date::Date;

/// What a day needs.
pub(super) const CALENDAR: &str = "`planting_date` and `[calendar]` with the length of a tick";

/// The ticks that span a day, and the same day of each later year where it comes again; none where no such day lies in
/// the run.
pub(super) fn ticks(day: Date, yearly: bool, calendar: &Calendar) -> Vec<Tick> {
    let mut ticks: Vec<Tick> = years(day, yearly, calendar).filter_map(|day| calendar.tick_of(day)).collect();
    ticks.dedup();
    ticks
}

/// A day, and the same day of each later year up to the end of the calendar where it comes again.
pub(super) fn years(day: Date, yearly: bool, calendar: &Calendar) -> impl Iterator<Item = Date> {
    let ([_, last], day) = (span(calendar), lying_in(day, calendar));
    let later = if yearly { last.year().saturating_sub(day.year()).max(0) } else { 0 };
    years_on(day).take(later as usize + 1)
}

/// The day of a calendar that is meant by a day of the scenario.
pub(super) fn lying_in(day: Date, calendar: &Calendar) -> Date {
    day.years_later(calendar.years_later())
}

/// A day, and the same day of each later year.
pub(super) fn years_on(day: Date) -> impl Iterator<Item = Date> {
    (0..).map(move |years| day.years_later(years))
}

/// The first and the last day of a run.
fn span(calendar: &Calendar) -> [Date; 2] {
    let ticks = calendar.ticks();
    [calendar.at(0).date, calendar.at(ticks.len() as Tick - 1).date.plus(-1)]
}

/// The fault of a text that is no day, or that stands in a scenario whose ticks have no dates.
pub(super) fn fault_of_text(day: &str, has_calendar: bool, path: &Path) -> Option<Fault> {
    if Date::parse(day).is_none() {
        let expected = "a day as YYYY-MM-DD, such as \"2024-08-14\"";
        return Some(Fault::new(path, format!("`{day}` is no day"), expected));
    }
    let problem = "a day is given, and the ticks of the scenario have no dates";
    (!has_calendar).then(|| Fault::new(path, problem, CALENDAR))
}

/// The fault of a day that does not lie in the run, nor the same day of a later year where it comes again.
pub(super) fn fault_of(day: Date, yearly: bool, calendar: &Calendar, path: &Path) -> Option<Fault> {
    if !ticks(day, yearly, calendar).is_empty() {
        return None;
    }
    let ([first, last], day) = (span(calendar), lying_in(day, calendar));
    let problem = match (yearly, day < first) {
        (true, _) => format!("the day {day} and the same day of later years lie outside the run"),
        (_, true) => format!("the day {day} lies before the run, which begins with {first}"),
        (_, false) => format!("the day {day} lies after the run, which ends with {last}"),
    };
    Some(Fault::new(path, problem, format!("a day from {first} to {last}")))
}
