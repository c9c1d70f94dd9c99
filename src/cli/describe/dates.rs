//! What a scenario says of its dates: the calendar of its plots, and what its weather file holds.
//!
//! Absent: the days of the file themselves.

use super::super::amounts;
use phytomer_config::{Dated, WeatherRead};
use phytomer_sim::site::calendar::{Calendar, CalendarTick, TickLength};
use phytomer_sim::site::calendars::Calendars;
use std::sync::Arc;

/// The most replicates whose days are told.
const SHOWN: usize = 4;

/// A value of a tick, where it is known.
type OfTick = fn(&CalendarTick) -> Option<f64>;

/// The lines that tell the dates of a scenario: a name and its value each.
pub fn lines(dated: &Dated) -> Vec<(&'static str, String)> {
    let mut lines = vec![("calendar", calendars_in_words(&dated.calendars))];
    if let Some(weather) = &dated.weather {
        lines.push(("weather", weather_in_words(weather)));
        lines.extend(notes_in_words(weather).map(|notes| ("noted", notes)));
    }
    let ranges: [(_, _, OfTick); 3] = [
        ("degree-days", "°C d a tick", |tick| tick.degree_days),
        ("day length", "h", |tick| tick.day_length_h),
        ("nitrogen", "kg/ha in a season", |tick| tick.nitrogen_kg_ha),
    ];
    let told = ranges.into_iter().filter_map(|(name, unit, of)| Some((name, range_in_words(dated, of, unit)?)));
    lines.extend(told);
    lines
}

/// The days of the run, or of each replicate where they grow in years of their own, and the length of a tick.
fn calendars_in_words(calendars: &Calendars) -> String {
    let length = match calendars.of(0).map(|calendar| calendar.tick_length()) {
        Some(TickLength::Days(days)) => amounts::of(days.into(), "day"),
        Some(TickLength::DegreeDays(sum)) => format!("{sum} °C d"),
        None => String::new(),
    };
    let days = |calendar: &Arc<Calendar>| {
        let last = calendar.ticks().last().map_or_else(String::new, |tick| format!(" to {}", tick.date));
        format!("{}{last}", calendar.at(0).date)
    };
    let each: Vec<String> = calendars.all().iter().take(SHOWN).map(days).collect();
    let more = calendars.all().len().saturating_sub(SHOWN);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    let replicates = if each.len() > 1 { "replicates " } else { "" };
    format!("{replicates}from {}{more}, in ticks of {length}", each.join(", "))
}

fn weather_in_words(weather: &WeatherRead) -> String {
    let [first, last] = weather.days;
    let station = &weather.station;
    let degrees = |radians: f64, side: [&str; 2]| {
        format!("{:.2}° {}", radians.to_degrees().abs(), side[usize::from(radians < 0.0)])
    };
    let parts = [
        Some(format!("{}, {first} to {last}", weather.name)),
        station.name.clone(),
        station.latitude.map(|latitude| degrees(latitude, ["N", "S"])),
        station.longitude.map(|longitude| degrees(longitude, ["E", "W"])),
        station.elevation_m.map(|height| format!("{height} m")),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

/// What had to be noted while the file was read; `None` where nothing had.
fn notes_in_words(weather: &WeatherRead) -> Option<String> {
    let notes = &weather.notes;
    let filled: u32 = notes.filled.iter().map(|filled| filled.days).sum();
    let first = notes.filled.first().map_or("", |filled| filled.from.as_str());
    let some = |number: u32, words: String| (number > 0).then_some(words);
    let absent = notes.absent.iter().map(|absent| format!("{} not measured on {} days", absent.quantity, absent.days));
    let parts = [
        some(filled, format!("{} filled, the first {first}", amounts::of(filled.into(), "day"))),
        some(notes.flagged_rows, format!("{} with a flag", amounts::of(notes.flagged_rows.into(), "row"))),
        notes.left_out.map(|left| format!("{} left out", amounts::of(left.values.into(), "value"))),
        (!notes.unused.is_empty()).then(|| format!("not read: {}", notes.unused.join(", "))),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().chain(absent).collect();
    (!parts.is_empty()).then(|| parts.join("; "))
}

/// The least and the largest value over the ticks from 1 on; `None` where it is not known.
fn range_in_words(dated: &Dated, of: OfTick, unit: &str) -> Option<String> {
    let ticks = dated.calendars.all().iter().flat_map(|calendar| calendar.ticks().iter().skip(1));
    let values: Option<Vec<f64>> = ticks.map(of).collect();
    let values = values.filter(|values| !values.is_empty())?;
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let rounded = |value: f64| (value * 100.0).round() / 100.0;
    Some(match low == high {
        true => format!("{} {unit}", rounded(low)),
        false => format!("{} to {} {unit}", rounded(low), rounded(high)),
    })
}
