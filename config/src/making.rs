//! The calendars of a treatment, made of its weather: one for all replicates, or one for each where they grow in years
//! of their own.
//!
//! A replicate that grows some years later is planted on the same day of its year, and its fertilizer is applied as
//! much later, as are the days of events and pests: so replicates differ in their weather alone. Absent: reading the
//! weather, and what `run.json` keeps (`dates`).

use std::collections::BTreeMap;
use std::sync::Arc;

use phytomer_law::fault::{Fault, Path};
use phytomer_sim::site::calendar::{Calendar, CalendarError, Terms};
use phytomer_sim::site::calendars::Calendars;
use phytomer_sim::site::date::Date;
use phytomer_weather::{Beyond, Weather};

use crate::load::path_of;
use crate::scenario::Scenario;
use crate::skylight;

/// What calendars are made of.
pub(crate) struct Making<'a> {
    pub scenario: &'a Scenario,
    pub weather: Option<&'a Weather>,
    /// The latitude of the site, radians.
    pub latitude: Option<f64>,
}

/// A replicate with a year of its own.
#[derive(Clone, Copy)]
struct OwnYear {
    replicate: usize,
    planted: Date,
}

impl Making<'_> {
    /// The calendars of so many replicates. No fault comes back where it is told elsewhere.
    pub fn all(&self, replicates: u32) -> Result<Calendars, Vec<Fault>> {
        let planted = self.scenario.planted().ok_or_else(Vec::new)?;
        let Some(years) = self.scenario.years_later(replicates) else {
            let made = self.made(planted, 0, None)?;
            self.check_ends(&[(0, &made)])?;
            return Ok(Calendars::from(made));
        };
        self.check_years(&years)?;
        let mut known: BTreeMap<i32, Arc<Calendar>> = BTreeMap::new();
        let mut made = Vec::with_capacity(years.len());
        for (replicate, later) in years.into_iter().enumerate() {
            let own = OwnYear { replicate, planted: planted.years_later(later) };
            let calendar = match known.get(&later) {
                Some(calendar) => Arc::clone(calendar),
                None => Arc::new(self.made(own.planted, later, Some(own))?),
            };
            made.push(Arc::clone(known.entry(later).or_insert(calendar)));
        }
        let known: Vec<(i32, &Calendar)> = known.iter().map(|(later, calendar)| (*later, calendar.as_ref())).collect();
        self.check_ends(&known)?;
        Ok(Calendars::new(made))
    }

    /// The calendar of plants that are planted on a day, so many years after the day that the scenario states.
    fn made(&self, planted: Date, later: i32, own: Option<OwnYear>) -> Result<Calendar, Vec<Fault>> {
        let scenario = self.scenario;
        let calendar = scenario.calendar.as_ref().ok_or_else(Vec::new)?;
        let tick = calendar.tick.stated().ok_or_else(Vec::new)?;
        let degree_days = calendar.degree_days.map(|degree_days| degree_days.felt());
        let mut terms = Terms { planted, tick, degree_days, latitude: self.latitude, soil: None };
        let temperatures = |date: Date| self.weather?.day(date).map(|day| [day.maximum, day.minimum]);
        let until = scenario.ages.until;
        let made = Calendar::of(&terms, until, temperatures).and_then(|bare| {
            // How often fertilizer comes again depends on the last day.
            terms.soil = scenario.soil_until(planted, bare.at(until).date, later);
            if terms.soil.is_some() { Calendar::of(&terms, until, temperatures) } else { Ok(bare) }
        });
        let made = made.map_err(|error| vec![self.fault_of(&error, own)])?;
        let skylight = match scenario.asks_for_radiation() {
            true => Some(skylight::of(self.weather, self.latitude, &made).map_err(|fault| vec![fault])?),
            false => None,
        };
        Ok(made.lying_later(later).lit(skylight))
    }

    /// Weather that comes again gives replicates that are a multiple of its whole years apart the same weather.
    fn check_years(&self, later: &[i32]) -> Result<(), Vec<Fault>> {
        let Some(weather) = self.weather.filter(|_| self.scenario.weather.as_ref().is_some_and(repeats)) else {
            return Ok(());
        };
        let years = weather.whole_years().max(1);
        let mut known: BTreeMap<i32, (usize, i32)> = BTreeMap::new();
        for (replicate, later) in later.iter().enumerate() {
            let (first, of_first) = *known.entry(later.rem_euclid(years)).or_insert((replicate, *later));
            if of_first == *later {
                continue;
            }
            let noun = if years == 1 { "year" } else { "years" };
            let problem = format!(
                "the weather has {years} whole {noun}, so the replicates {first} and {replicate}, which are to grow in \
                 different years, would have the same weather"
            );
            let expected = format!("replicates in at most {years} {noun}, or a longer file");
            return Err(vec![Fault::new(&path_of(&["weather", "years"]), problem, expected)]);
        }
        Ok(())
    }

    /// The fault of a calendar that cannot be made, at the key that decides it.
    fn fault_of(&self, error: &CalendarError, own: Option<OwnYear>) -> Fault {
        let of = |own: OwnYear| format!(" of replicate {}, which is planted on {},", own.replicate, own.planted);
        let of_replicate = own.map(of).unwrap_or_default();
        let (keys, problem, expected): (&[&str], String, String) = match (error, self.weather) {
            (CalendarError::NoWeather { tick, date }, Some(weather)) => {
                let (first, last) = (weather.first(), weather.last());
                let problem = format!(
                    "the weather goes from {first} to {last}, and tick {tick}{of_replicate} needs that of {date}"
                );
                let expected = match (own, date < &first) {
                    (Some(_), true) => "weather for the years of all replicates, or later years".to_owned(),
                    (Some(_), false) => "weather for the years of all replicates, or fewer replicates".to_owned(),
                    (None, true) => whole_run("a later `planting_date`"),
                    (None, false) => whole_run("an earlier `ages.until`"),
                };
                (if own.is_some() { &["weather", "years"] } else { &["weather", "file"] }, problem, expected)
            }
            (CalendarError::Endless { .. }, _) => {
                let expected = "a lower `calendar.degree_days.base_celsius`, or a smaller sum".to_owned();
                (&["calendar", "tick", "degree_days"], error.to_string(), expected)
            }
            _ => {
                let until = self.scenario.ages.until;
                let expected = format!("an earlier `planting_date`, or shorter ticks: the run has {until}");
                (&["planting_date"], error.to_string(), expected)
            }
        };
        Fault::new(&path_of(keys), problem, expected)
    }

    /// Fertilizer that is applied after the last tick of all replicates would have no effect. Calendars stand with the
    /// years by which they are later.
    fn check_ends(&self, calendars: &[(i32, &Calendar)]) -> Result<(), Vec<Fault>> {
        let until = self.scenario.ages.until;
        let mut faults = Vec::new();
        for (number, event) in self.scenario.fertilizer.iter().enumerate() {
            let Some(date) = Date::parse(&event.fertilization_date) else { continue };
            let is_late = |(later, calendar): &(i32, &Calendar)| date.years_later(*later) >= calendar.at(until).date;
            let Some((_, last)) = calendars.last().filter(|_| calendars.iter().all(is_late)) else { continue };
            let end = last.at(until).date;
            let path = Path::root().key("fertilizer").index(number).key("fertilization_date");
            let problem = format!("the run ends with {}: what is applied later has no effect", end.plus(-1));
            faults.push(Fault::new(&path, problem, format!("a day before {end}")));
        }
        if faults.is_empty() { Ok(()) } else { Err(faults) }
    }
}

/// What is expected of weather that all replicates share.
fn whole_run(run: &str) -> String {
    format!("weather for the whole run, {run}, or `beyond = \"repeat\"`")
}

/// Whether the weather comes again beyond its file.
fn repeats(weather: &phytomer_weather::WeatherFile) -> bool {
    weather.beyond == Beyond::Repeat
}
