//! The days of a weather file, one after the other without a gap, and what had to be noted of them.
//!
//! Where the weather repeats itself, a day beyond the file has that of the same day of the year, whole years earlier or
//! later: the fewest times as many years as the file holds whole ones, so that years come again in their order. 29
//! February takes the weather of the 28th where its year in the file has none. Absent: what is between the days.

use crate::quantity::{Quantity, Values};
use phytomer_sim::site::date::Date;
use phytomer_sim::site::degree_days::DegreeDays;
use serde::Serialize;

/// The weather of a station, day by day.
#[derive(Debug, Clone)]
pub struct Weather {
    /// Where it was measured.
    pub station: Station,
    /// What had to be noted.
    pub notes: Notes,
    first: Date,
    days: Vec<Values>,
    /// The whole years after which the weather comes again; `None` where it ends.
    period: Option<i32>,
}

/// Where weather was measured, as far as its file says.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Station {
    /// Its name or code.
    pub name: Option<String>,
    /// Radians, north positive.
    pub latitude: Option<f64>,
    /// Radians, east positive.
    pub longitude: Option<f64>,
    /// Metres above the sea.
    pub elevation_m: Option<f64>,
}

/// The weather of a day.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Day {
    /// The highest temperature of the air, °C.
    pub maximum: f64,
    /// The lowest, °C; never above the highest.
    pub minimum: f64,
    /// Rain, mm.
    pub rain: Option<f64>,
    /// Solar radiation on level ground, MJ/m².
    pub radiation: Option<f64>,
    /// The mean speed of the wind, m/s.
    pub wind: Option<f64>,
    /// The dew point, °C.
    pub dew_point: Option<f64>,
    /// The pressure of water vapour, Pa.
    pub vapour_pressure: Option<f64>,
    /// The relative humidity, from 0 to 1.
    pub humidity: Option<f64>,
}

/// What had to be noted while a file was read, for the record of a run.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Notes {
    /// Days that were filled because that was asked for.
    pub filled: Vec<Filled>,
    /// Rows with a flag of the station at their date or at a value that is kept.
    pub flagged_rows: u32,
    /// Values whose column cannot be known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left_out: Option<LeftOut>,
    /// Columns that are not read.
    pub unused: Vec<String>,
    /// Quantities that a column has, and that were not measured on some days.
    pub absent: Vec<Absent>,
}

/// Values that were left out, because it cannot be known which of several columns they stand in: none is a temperature,
/// radiation or rain.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct LeftOut {
    /// The line of the first.
    pub first_line: u32,
    /// How many.
    pub values: u32,
}

/// Days in a row that were filled.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Filled {
    /// The first, as ISO 8601 writes it.
    pub from: String,
    /// How many.
    pub days: u32,
}

/// A quantity that was not measured on some days.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Absent {
    /// The quantity, in words.
    pub quantity: &'static str,
    /// How many days.
    pub days: u32,
}

impl Day {
    /// What was measured on a day, which has both temperatures.
    fn of(values: &Values) -> Self {
        Self {
            maximum: values.get(Quantity::Maximum).unwrap_or_default(),
            minimum: values.get(Quantity::Minimum).unwrap_or_default(),
            rain: values.get(Quantity::Rain),
            radiation: values.get(Quantity::Radiation),
            wind: values.get(Quantity::Wind),
            dew_point: values.get(Quantity::DewPoint),
            vapour_pressure: values.get(Quantity::VapourPressure),
            humidity: values.get(Quantity::Humidity).map(|share| share.min(1.0)),
        }
    }
}

impl Weather {
    /// Days that follow one another from the first on; at least one.
    pub(crate) fn new(station: Station, notes: Notes, first: Date, days: Vec<Values>) -> Self {
        Self { station, notes, first, days, period: None }
    }

    /// The same weather, again and again; `None` where its file holds no whole year.
    pub(crate) fn repeated(mut self) -> Option<Self> {
        self.period = Some(self.whole_years()).filter(|years| *years > 0);
        self.period.is_some().then_some(self)
    }

    /// The first day of the file.
    pub fn first(&self) -> Date {
        self.first
    }

    /// The last day of the file.
    pub fn last(&self) -> Date {
        self.first.plus(self.days.len() as i32 - 1)
    }

    /// All days of the file.
    pub fn days(&self) -> impl ExactSizeIterator<Item = Day> + '_ {
        self.days.iter().map(Day::of)
    }

    /// The weather of a day; `None` beyond the file, unless it repeats itself.
    pub fn day(&self, date: Date) -> Option<Day> {
        let place = |date: Date| {
            let days = usize::try_from(date.since(self.first)).ok().and_then(|place| self.days.get(place));
            days.map(Day::of)
        };
        if let Some(day) = place(date) {
            return Some(day);
        }
        let period = self.period?;
        let (is_later, apart) = match date > self.first {
            true => (true, date.year() - self.last().year()),
            false => (false, self.first.year() - date.year()),
        };
        // The fewest periods that lead into the file.
        let fewest = (apart / period - 1).max(1);
        let away = (fewest..=fewest + 3).map(|periods| periods.saturating_mul(period));
        away.map(|years| date.years_later(if is_later { -years } else { years })).find_map(place)
    }

    /// The degree-days of each day of the file.
    pub fn degree_days(&self, how: DegreeDays) -> impl Iterator<Item = f64> + '_ {
        self.days().map(move |day| how.of_day(day.maximum, day.minimum))
    }

    /// Whole years that the file holds.
    pub fn whole_years(&self) -> i32 {
        let end = self.last().plus(1);
        let years = end.year() - self.first.year();
        let anniversary = self.first.years_later(years);
        let is_moved = anniversary.month_and_day() != self.first.month_and_day();
        if anniversary.plus(i32::from(is_moved)) <= end { years } else { years - 1 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn date(year: i32, month: u32, day: u32) -> Date {
        Date::new(year, month, day).expect("a day")
    }

    /// Days whose maximum is their number from the first.
    fn weather(first: Date, last: Date) -> Weather {
        let day = |number| {
            let mut values = Values::default();
            values.set(Quantity::Maximum, Some(f64::from(number)));
            values
        };
        Weather::new(Station::default(), Notes::default(), first, (0..=last.since(first)).map(day).collect())
    }

    #[test]
    fn weather_ends_with_its_file_or_comes_again() {
        let (first, last) = (date(2001, 3, 1), date(2003, 6, 1));
        let plain = weather(first, last);
        assert_eq!((plain.first(), plain.last(), plain.days().len()), (first, last, 823));
        assert!(plain.day(first).is_some() && plain.day(last).is_some());
        assert!(plain.day(first.plus(-1)).is_none() && plain.day(last.plus(1)).is_none());
        let again = plain.repeated().expect("two years");
        for (asked, had) in [
            (date(2003, 6, 2), date(2001, 6, 2)),
            (date(2004, 2, 29), date(2002, 2, 28)),
            (date(2004, 3, 1), date(2002, 3, 1)),
            (date(2005, 3, 1), date(2003, 3, 1)),
            (date(2050, 7, 9), date(2002, 7, 9)),
            (date(2051, 7, 9), date(2001, 7, 9)),
            (date(2001, 2, 28), date(2003, 2, 28)),
            (date(1990, 12, 1), date(2002, 12, 1)),
            (date(2000, 12, 1), date(2002, 12, 1)),
        ] {
            let day = again.day(asked).map(|day| day.maximum);
            assert_eq!(day, Some(f64::from(had.since(first))), "{asked}");
        }
        // Every day of three centuries has its weather, and it is that of a day of the same season.
        for number in 0..110_000 {
            let asked = date(1850, 1, 1).plus(number);
            let had = first.plus(again.day(asked).expect("a day").maximum as i32);
            let (asked, had) = (asked.month_and_day(), had.month_and_day());
            assert!(asked == had || (asked, had) == ((2, 29), (2, 28)), "{asked:?} {had:?}");
        }
    }

    #[test]
    fn a_year_must_be_whole_to_come_again() {
        assert!(weather(date(1988, 1, 1), date(1988, 12, 30)).repeated().is_none());
        assert!(weather(date(1988, 1, 1), date(1988, 12, 31)).repeated().is_some());
        assert!(weather(date(1987, 7, 3), date(1988, 7, 2)).repeated().is_some());
        assert!(weather(date(1988, 2, 29), date(1989, 2, 27)).repeated().is_none());
        let from_leap_day = weather(date(1988, 2, 29), date(1989, 2, 28)).repeated().expect("a year");
        assert!((0..3_000).all(|number| from_leap_day.day(date(1985, 1, 1).plus(number)).is_some()));
        let last = weather(Date::LAST, Date::LAST);
        assert!(last.day(Date::FIRST).is_none() && last.repeated().is_none());
    }
}
