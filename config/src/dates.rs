//! From the keys of a scenario to its calendar: the weather file read, and every tick of the run with its date.
//!
//! The weather file stands beside the scenario, or ships with it; all its faults are told at once, each at its line.
//! The calendar is kept in `run.json` too, so that plants can be grown again without the file. Absent: what a scenario
//! states (`scenario::calendar`), and what laws make of the dates (`phytomer_law`).

use std::sync::Arc;

use phytomer_law::fault::{Path, Segment};
use phytomer_sim::site::calendar::{Calendar, CalendarTick, Skylight, TickLength};
use phytomer_sim::site::calendars::Calendars;
use phytomer_sim::site::date::Date;
use phytomer_weather::{Notes, Station, Weather};
use serde::{Deserialize, Serialize};
use serde_json::{Value as Json, json};

use crate::document::Node;
use crate::load::{Loader, path_of};
use crate::making::Making;
use crate::report::Fault;
use crate::scenario::Scenario;
use crate::source::Span;
use crate::treatments::Read;

/// The calendars of a treatment, and the weather that they were made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Dated {
    /// The ticks of the plots: for all replicates, or for each one where they grow in different years. What blocks and
    /// field plots shift is not in them.
    pub calendars: Calendars,
    /// The weather file; `None` where the scenario names none.
    pub weather: Option<WeatherRead>,
}

/// What was read of a weather file.
#[derive(Debug, Clone, PartialEq)]
pub struct WeatherRead {
    /// The file, as messages call it.
    pub name: String,
    /// The first and the last day of the file.
    pub days: [Date; 2],
    /// Where it was measured, as the file or the scenario says.
    pub station: Station,
    /// What had to be noted, such as days that were filled.
    pub notes: Notes,
}

impl Dated {
    /// The calendar, or those of the replicates, and the weather as `run.json` keeps them.
    pub(crate) fn to_json(&self) -> Json {
        let columns: Vec<Columns> = self.calendars.all().iter().map(|calendar| Columns::of(calendar)).collect();
        let mut json = match columns.as_slice() {
            [of_all] => json!({"calendar": of_all}),
            of_replicates => json!({"calendars": of_replicates}),
        };
        if let Some(weather) = &self.weather {
            let [first, last] = weather.days.map(|day| day.to_string());
            let Station { name, latitude, longitude, elevation_m } = &weather.station;
            let station =
                json!({"name": name, "latitude_rad": latitude, "longitude_rad": longitude, "elevation_m": elevation_m});
            let notes = &weather.notes;
            json["weather"] =
                json!({"file": weather.name, "first": first, "last": last, "station": station, "notes": notes});
        }
        json
    }
}

/// The calendars that `run.json` keeps of a treatment, or of a run without treatments.
///
/// # Errors
/// A calendar that this program cannot have written.
pub fn calendars_of_run(resolved: &Json) -> serde_json::Result<Calendars> {
    let of_replicates = resolved.get("calendars").and_then(Json::as_array).map(Vec::as_slice).unwrap_or_default();
    let calendar = |kept: &Json| {
        let unknown = "the calendar has columns of different lengths, or a date that is none";
        let calendar = Columns::deserialize(kept)?.into_calendar();
        calendar.map(Arc::new).ok_or_else(|| serde::de::Error::custom(unknown))
    };
    let kept = resolved.get("calendar").into_iter().chain(of_replicates);
    Ok(Calendars::new(kept.map(calendar).collect::<serde_json::Result<_>>()?))
}

/// A calendar by its columns, one entry a tick.
#[derive(Serialize, Deserialize)]
struct Columns {
    #[serde(skip_serializing_if = "Option::is_none")]
    tick_days: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tick_degree_days: Option<f64>,
    date: Vec<String>,
    degree_day_sum: Option<Vec<f64>>,
    day_length_h: Option<Vec<f64>>,
    nitrogen_kg_ha: Option<Vec<f64>>,
    /// The latitude, radians, and the share of the sky in the radiation of each tick, where light asks for them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    skylight: Option<(f64, Vec<f64>)>,
    #[serde(default, skip_serializing_if = "is_zero")]
    years_later: i32,
}

fn is_zero(years: &i32) -> bool {
    *years == 0
}

impl Columns {
    fn of(calendar: &Calendar) -> Self {
        let ticks = calendar.ticks();
        let column = |of: fn(&CalendarTick) -> Option<f64>| ticks.iter().map(of).collect();
        let (tick_days, tick_degree_days) = match calendar.tick_length() {
            TickLength::Days(days) => (Some(days), None),
            TickLength::DegreeDays(sum) => (None, Some(sum)),
        };
        Self {
            tick_days,
            tick_degree_days,
            date: ticks.iter().map(|tick| tick.date.to_string()).collect(),
            degree_day_sum: column(|tick| tick.degree_day_sum),
            day_length_h: column(|tick| tick.day_length_h),
            nitrogen_kg_ha: column(|tick| tick.nitrogen_kg_ha),
            skylight: calendar.skylight().map(|of| (of.latitude, of.of_sky.clone())),
            years_later: calendar.years_later(),
        }
    }

    fn into_calendar(self) -> Option<Calendar> {
        let length = self.tick_days.map(TickLength::Days).or(self.tick_degree_days.map(TickLength::DegreeDays))?;
        let columns = [&self.degree_day_sum, &self.day_length_h, &self.nitrogen_kg_ha];
        if columns.into_iter().flatten().any(|column| column.len() != self.date.len()) {
            return None;
        }
        if self.skylight.as_ref().is_some_and(|(_, of_sky)| of_sky.len() != self.date.len()) {
            return None;
        }
        let dates: Vec<Date> = self.date.iter().map(|date| Date::parse(date)).collect::<Option<_>>()?;
        let tick = |(place, &date): (usize, &Date)| {
            let before = place.saturating_sub(1);
            let at = |column: &Option<Vec<f64>>| column.as_ref().map(|column| column[place]);
            CalendarTick {
                date,
                days: date.since(dates[before]).unsigned_abs(),
                degree_days: self.degree_day_sum.as_ref().map(|sums| sums[place] - sums[before]),
                degree_day_sum: at(&self.degree_day_sum),
                day_length_h: at(&self.day_length_h),
                nitrogen_kg_ha: at(&self.nitrogen_kg_ha),
            }
        };
        let calendar = Calendar::of_ticks(length, dates.iter().enumerate().map(tick).collect());
        let skylight = self.skylight.map(|(latitude, of_sky)| Skylight { latitude, of_sky });
        calendar.map(|calendar| calendar.lying_later(self.years_later).lit(skylight))
    }
}

/// The calendars of a scenario whose experiment has so many replicates; `Ok(None)` where it states none. Where they
/// cannot be made, the faults are added to those of the loader.
fn of(loader: &mut Loader, node: &Node, scenario: &Scenario, replicates: u32) -> Result<Option<Dated>, Refused> {
    if scenario.calendar.is_none() {
        return Ok(None);
    }
    let (weather, read) = match &scenario.weather {
        Some(_) => read_weather(loader, node, scenario).map(|(weather, read)| (Some(weather), Some(read)))?,
        None => (None, None),
    };
    let station = read.as_ref().and_then(|read| read.station.latitude);
    let latitude = scenario.site.latitude_deg.map(f64::to_radians).or(station);
    let made = Making { scenario, weather: weather.as_ref(), latitude }.all(replicates);
    made.map(|calendars| Some(Dated { calendars, weather: read })).map_err(|faults| {
        let placed = faults
            .into_iter()
            .map(|fault| Fault::new(node.locate(&fault.path), &fault.path, fault.problem, fault.expected));
        loader.faults.extend(placed);
        Refused
    })
}

/// The calendars of treatments, one for each; treatments with the same dates share one. A fault is told once, however
/// many treatments have it.
pub(crate) fn of_treatments(
    loader: &mut Loader,
    read: &[Read],
    replicates: u32,
) -> Result<Vec<Option<Dated>>, Refused> {
    let mut made: Vec<(&Scenario, Result<Option<Dated>, Refused>)> = Vec::new();
    let mut calendars = Vec::with_capacity(read.len());
    for Read { scenario, expanded, .. } in read {
        let Some(scenario) = scenario else {
            calendars.push(Ok(None));
            continue;
        };
        let known = made.iter().find(|(other, _)| other.has_the_dates_of(scenario)).map(|(_, known)| known.clone());
        let calendar = known.unwrap_or_else(|| {
            let told = loader.faults.len();
            let calendar = of(loader, &expanded.node, scenario, replicates);
            let new = loader.faults.split_off(told);
            let is_told = |fault: &Fault| loader.faults.iter().any(|other| other == fault);
            let new: Vec<Fault> = new.into_iter().filter(|fault| !is_told(fault)).collect();
            loader.faults.extend(new);
            made.push((scenario, calendar.clone()));
            calendar
        });
        calendars.push(calendar);
    }
    calendars.into_iter().collect()
}

/// The calendars of treatments, before what blocks and field plots shift.
pub(crate) fn calendars_of(dated: &[Option<Dated>]) -> Vec<Calendars> {
    dated.iter().map(|dated| dated.as_ref().map(|dated| dated.calendars.clone()).unwrap_or_default()).collect()
}

/// Whether a fault is one of the keys that decide the dates, so that without them nothing can be said of laws of the
/// date.
pub(crate) fn is_of_dates(path: &Path) -> bool {
    const KEYS: [&str; 5] = ["planting_date", "calendar", "weather", "soil", "fertilizer"];
    match path.0.as_slice() {
        [Segment::Key(table), Segment::Key(key), ..] if table == "site" => key == "latitude_deg",
        [Segment::Key(table), Segment::Key(key), ..] if table == "light" => key == "sun",
        [Segment::Key(key), ..] => KEYS.contains(&key.as_str()),
        _ => false,
    }
}

/// The calendar could not be made, and why was told.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Refused;

/// Reads the weather file of a scenario.
fn read_weather(loader: &mut Loader, node: &Node, scenario: &Scenario) -> Result<(Weather, WeatherRead), Refused> {
    let path = path_of(&["weather", "file"]);
    let (asked, span) = (scenario.weather.as_ref().ok_or(Refused)?, node.locate(&path));
    let beside = loader.sources.get(span.source).origin.clone();
    let source = match loader.library.weather(&asked.file, &beside) {
        Ok(source) => source,
        Err(missing) => {
            let fault = Fault::new(span, &path, missing.problem, missing.expected).suggest(missing.suggestion);
            loader.faults.push(fault);
            return Err(Refused);
        }
    };
    let (name, text) = (source.name.clone(), Arc::clone(&source.text));
    let id = loader.sources.add(source);
    match phytomer_weather::read_text(&asked.file, &text, &asked.asked()) {
        Ok(weather) => {
            let station = asked.placed(weather.station.clone());
            let days = [weather.first(), weather.last()];
            let read = WeatherRead { name, days, station, notes: weather.notes.clone() };
            Ok((weather, read))
        }
        Err(refused) => {
            for fault in refused.faults {
                let span = Span { source: id, start: fault.bytes.start, end: fault.bytes.end };
                let told = Fault::new(span, &Path::root(), fault.problem, fault.expected);
                loader.faults.push(told.suggest(fault.suggestion));
            }
            if refused.more > 0 {
                let problem = format!("the weather file has {} faults more than are told", refused.more);
                loader.faults.push(Fault::new(span, &path, problem, "a file with few slips in it"));
            }
            Err(Refused)
        }
    }
}
