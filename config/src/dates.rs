//! From the keys of a scenario to its calendar: the weather file read, and every tick of the run with its date.
//!
//! The weather file stands beside the scenario, or ships with it; all its faults are told at once, each at its line.
//! The calendar is kept in `run.json` too, so that plants can be grown again without the file. Absent: what a scenario
//! states (`scenario::calendar`), and what laws make of the dates (`phytomer_law`).

use std::sync::Arc;

use phytomer_law::fault::{Path, Segment};
use phytomer_sim::clock::Tick;
use phytomer_sim::site::calendar::{Calendar, CalendarError, CalendarTick, Dates, Terms, TickLength};
use phytomer_sim::site::date::Date;
use phytomer_weather::{Notes, Station, Weather};
use serde::{Deserialize, Serialize};
use serde_json::{Value as Json, json};

use crate::document::Node;
use crate::load::{Loader, path_of};
use crate::report::Fault;
use crate::scenario::Scenario;
use crate::source::Span;
use crate::treatments::Read;

/// The calendar of a run, and the weather that it was made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Dated {
    /// The ticks of the plots.
    pub calendar: Arc<Calendar>,
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
    /// The dates of a plant that is sown at a tick of its plot.
    pub fn of_sowing(&self, sown: Tick) -> Dates {
        Dates { calendar: Arc::clone(&self.calendar), sown }
    }

    /// The calendar and the weather as `run.json` keeps them.
    pub(crate) fn to_json(&self) -> Json {
        let mut json = json!({"calendar": Columns::of(&self.calendar)});
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

/// The calendar that `run.json` keeps; `None` where it has none.
///
/// # Errors
/// A calendar that this program cannot have written.
pub fn calendar_of_run(resolved: &Json) -> serde_json::Result<Option<Arc<Calendar>>> {
    let Some(kept) = resolved.get("calendar") else { return Ok(None) };
    let calendar = Columns::deserialize(kept)?.into_calendar();
    let unknown = "the calendar has columns of different lengths, or a date that is none";
    calendar.map(|calendar| Some(Arc::new(calendar))).ok_or_else(|| serde::de::Error::custom(unknown))
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
        }
    }

    fn into_calendar(self) -> Option<Calendar> {
        let length = self.tick_days.map(TickLength::Days).or(self.tick_degree_days.map(TickLength::DegreeDays))?;
        let columns = [&self.degree_day_sum, &self.day_length_h, &self.nitrogen_kg_ha];
        if columns.into_iter().flatten().any(|column| column.len() != self.date.len()) {
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
        Calendar::of_ticks(length, dates.iter().enumerate().map(tick).collect())
    }
}

/// The calendar of a scenario; `Ok(None)` where it states none. Where it cannot be made, its faults are added to those
/// of the loader.
pub(crate) fn of(loader: &mut Loader, node: &Node, scenario: &Scenario) -> Result<Option<Dated>, Refused> {
    let Some(calendar) = &scenario.calendar else { return Ok(None) };
    let read = match &scenario.weather {
        Some(_) => Some(read_weather(loader, node, scenario)?),
        None => None,
    };
    let (Some(planted), Some(tick)) = (scenario.planted(), calendar.tick.stated()) else { return Err(Refused) };
    let station = read.as_ref().map(|(_, read)| read.station.latitude);
    let latitude = scenario.site.latitude_deg.map(f64::to_radians).or(station.flatten());
    let degree_days = calendar.degree_days.map(|degree_days| degree_days.felt());
    let mut terms = Terms { planted, tick, degree_days, latitude, soil: None };
    let weather = read.as_ref().map(|(weather, _)| weather);
    let temperatures = |date: Date| weather?.day(date).map(|day| [day.maximum, day.minimum]);
    let until = scenario.ages.until;
    let made = Calendar::of(&terms, until, temperatures).and_then(|bare| {
        // How often fertilizer comes again depends on the last day.
        terms.soil = scenario.soil_until(planted, bare.at(until).date);
        if terms.soil.is_some() { Calendar::of(&terms, until, temperatures) } else { Ok(bare) }
    });
    match made {
        Ok(made) => {
            check_ends(loader, node, scenario, &made)?;
            Ok(Some(Dated { calendar: Arc::new(made), weather: read.map(|(_, read)| read) }))
        }
        Err(error) => {
            loader.faults.push(placed(node, &error, weather, scenario));
            Err(Refused)
        }
    }
}

/// The calendars of treatments, one for each; treatments with the same dates share one. A fault is told once, however
/// many treatments have it.
pub(crate) fn of_treatments(loader: &mut Loader, read: &[Read]) -> Result<Vec<Option<Dated>>, Refused> {
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
            let calendar = of(loader, &expanded.node, scenario);
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

/// Whether a fault is one of the keys that decide the dates, so that without them nothing can be said of laws of the
/// date.
pub(crate) fn is_of_dates(path: &Path) -> bool {
    const KEYS: [&str; 5] = ["planting_date", "calendar", "weather", "soil", "fertilizer"];
    match path.0.as_slice() {
        [Segment::Key(table), Segment::Key(key), ..] if table == "site" => key == "latitude_deg",
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

/// The fault of a calendar that cannot be made, at the key that decides it.
fn placed(node: &Node, error: &CalendarError, weather: Option<&Weather>, scenario: &Scenario) -> Fault {
    let (keys, problem, expected): (&[&str], String, String) = match (error, weather) {
        (CalendarError::NoWeather { tick, date }, Some(weather)) => {
            let (first, last) = (weather.first(), weather.last());
            let problem = format!("the weather goes from {first} to {last}, and tick {tick} needs that of {date}");
            let run = match date < &first {
                true => "a later `planting_date`",
                false => "an earlier `ages.until`",
            };
            (&["weather", "file"], problem, format!("weather for the whole run, {run}, or `beyond = \"repeat\"`"))
        }
        (CalendarError::Endless { .. }, _) => {
            let expected = "a lower `calendar.degree_days.base_celsius`, or a smaller sum".to_owned();
            (&["calendar", "tick", "degree_days"], error.to_string(), expected)
        }
        _ => {
            let until = scenario.ages.until;
            let expected = format!("an earlier `planting_date`, or shorter ticks: the run has {until}");
            (&["planting_date"], error.to_string(), expected)
        }
    };
    let path = path_of(keys);
    Fault::new(node.locate(&path), &path, problem, expected)
}

/// Fertilizer that is applied after the last tick would have no effect.
fn check_ends(loader: &mut Loader, node: &Node, scenario: &Scenario, calendar: &Calendar) -> Result<(), Refused> {
    let end = calendar.at(scenario.ages.until).date;
    let mut checked = Ok(());
    for (number, event) in scenario.fertilizer.iter().enumerate() {
        let late = Date::parse(&event.fertilization_date).is_some_and(|date| date >= end);
        if !late {
            continue;
        }
        let path = Path::root().key("fertilizer").index(number).key("fertilization_date");
        let problem = format!("the run ends with {}: what is applied later has no effect", end.plus(-1));
        loader.faults.push(Fault::new(node.locate(&path), &path, problem, format!("a day before {end}")));
        checked = Err(Refused);
    }
    checked
}
