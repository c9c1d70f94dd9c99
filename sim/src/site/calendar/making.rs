//! How the ticks of a calendar are made, day after day.
//!
//! Absent: what a tick holds and what is asked of a calendar (`calendar`).

use super::{CalendarError, CalendarTick, Terms, TickLength};
use crate::clock::Tick;
use crate::site::date::Date;
use crate::site::sun;

/// A tick that is a sum of degree-days and needs more days than ten years is refused.
const MOST_DAYS_OF_A_TICK: u32 = 3_660;

/// The ticks of a calendar from 0 to `until`.
pub fn ticks(
    terms: &Terms,
    until: Tick,
    weather: &mut impl FnMut(Date) -> Option<[f64; 2]>,
) -> Result<Vec<CalendarTick>, CalendarError> {
    let mut applied = terms.soil.as_ref().map_or_else(Vec::new, |soil| soil.applied.clone());
    applied.sort_by_key(|(day, _)| *day);
    let mut days = Days { terms, applied, weather, date: terms.planted, sum: 0.0 };
    let mut ticks = vec![days.end_of_tick(terms.planted, 0.0)];
    for tick in 1..=until {
        let (from, before) = (days.date, days.sum);
        days.go_through(tick)?;
        ticks.push(days.end_of_tick(from, before));
    }
    Ok(ticks)
}

/// The days of a calendar while it is made.
struct Days<'a, W> {
    terms: &'a Terms,
    /// What is applied to the soil, day after day.
    applied: Vec<(Date, f64)>,
    weather: &'a mut W,
    /// The day that begins.
    date: Date,
    /// The degree-days since planting.
    sum: f64,
}

impl<W: FnMut(Date) -> Option<[f64; 2]>> Days<'_, W> {
    /// Goes to the midnight at which a tick ends.
    fn go_through(&mut self, tick: Tick) -> Result<(), CalendarError> {
        let from = self.date;
        match self.terms.tick {
            TickLength::Days(days) => (0..days.max(1)).try_for_each(|_| self.pass_day(tick)),
            TickLength::DegreeDays(wanted) => {
                // A product and not a sum, so that ticks do not drift.
                let end = wanted * f64::from(tick);
                while self.sum < end {
                    if self.date.since(from) >= MOST_DAYS_OF_A_TICK as i32 {
                        return Err(CalendarError::Endless { tick, from });
                    }
                    self.pass_day(tick)?;
                }
                Ok(())
            }
        }
    }

    fn pass_day(&mut self, tick: Tick) -> Result<(), CalendarError> {
        let date = self.date;
        if date == Date::LAST {
            return Err(CalendarError::BeyondDates { tick });
        }
        if let Some(how) = self.terms.degree_days {
            let [maximum, minimum] = (self.weather)(date).ok_or(CalendarError::NoWeather { tick, date })?;
            self.sum += how.of_day(maximum, minimum);
        }
        self.date = date.plus(1);
        Ok(())
    }

    /// The tick that began with the day `from`, at the sum `before`, and ends now.
    fn end_of_tick(&self, from: Date, before: f64) -> CalendarTick {
        let (terms, date) = (self.terms, self.date);
        let is_known = terms.degree_days.is_some();
        CalendarTick {
            date,
            days: date.since(from).unsigned_abs(),
            degree_days: is_known.then_some(self.sum - before),
            degree_day_sum: is_known.then_some(self.sum),
            day_length_h: terms.latitude.map(|latitude| sun::day_length_h(latitude, date.day_of_year())),
            nitrogen_kg_ha: terms.soil.as_ref().map(|soil| soil.own + self.applied_by(soil.season_begins)),
        }
    }

    /// What was applied up to the last day that has passed, since the beginning of its season, kg N/ha.
    fn applied_by(&self, season_begins: (u32, u32)) -> f64 {
        let last = self.date.plus(-1);
        let begins = season_of(last, season_begins);
        let from = self.applied.partition_point(|(day, _)| *day < begins);
        self.applied[from..].iter().take_while(|(day, _)| *day <= last).map(|(_, amount)| amount).sum()
    }
}

/// The first day of the season to which a day belongs, where seasons begin on this month and day of each year; 29
/// February is 28 February in a year without it.
pub fn season_of(day: Date, (month, of_month): (u32, u32)) -> Date {
    let beginning = |year| Date::new(year, month, of_month).or_else(|| Date::new(year, month, of_month.min(28)));
    let this_year = beginning(day.year()).filter(|first| *first <= day);
    this_year.or_else(|| beginning(day.year() - 1)).unwrap_or(Date::FIRST)
}
