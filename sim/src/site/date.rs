//! Civil dates: days of the proleptic Gregorian calendar, counted from 1970-01-01.
//!
//! Weather, calendars and the sun ask for whole days and for nothing that a crate of dates has beyond them: no clocks,
//! zones or locales. So this is one number and two formulas (H. Hinnant, *chrono-Compatible Low-Level Date
//! Algorithms*, 2013: years that begin in March, eras of 400 years); a test walks every day of two centuries by the
//! lengths of the months. No function panics; a sum beyond the years −9999 to 9999 stays at the last day there.
//! Absent: hours, which [`sun`](super::sun) takes beside a date, and how files write dates.

use std::fmt;

/// A day of the calendar.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Date {
    /// Days since 1970-01-01.
    number: i32,
}

/// Days of an era of 400 years.
const DAYS_OF_ERA: i32 = 146_097;
/// The days of a year, on the average of an era.
pub const DAYS_OF_A_YEAR: f64 = DAYS_OF_ERA as f64 / 400.0;
/// Days from 0000-03-01 to 1970-01-01.
const TO_EPOCH: i32 = 719_468;
/// The years that a date may have.
const YEARS: std::ops::RangeInclusive<i32> = -9999..=9999;

impl Date {
    /// The first day that there is, −9999-01-01.
    pub const FIRST: Self = Self { number: -4_371_587 };
    /// 1970-01-01, from which tables and other programs count days.
    pub const EPOCH: Self = Self { number: 0 };
    /// The last one, 9999-12-31.
    pub const LAST: Self = Self { number: 2_932_896 };

    /// A day by its year, month (1 to 12) and day of the month (from 1); `None` where the calendar has no such day.
    pub fn new(year: i32, month: u32, day: u32) -> Option<Self> {
        let sound = YEARS.contains(&year) && (1..=12).contains(&month) && day >= 1 && day <= days_of_month(year, month);
        sound.then(|| Self { number: number(year, month, day) })
    }

    /// A day by its year and its number there, from 1 (1 January) to 365 or 366.
    pub fn of_year(year: i32, day_of_year: u32) -> Option<Self> {
        let sound = YEARS.contains(&year) && day_of_year >= 1 && day_of_year <= days_of_year(year);
        sound.then(|| Self { number: number(year, 1, 1) + day_of_year as i32 - 1 })
    }

    /// A day as ISO 8601 writes it: `2001-05-30`.
    pub fn parse(text: &str) -> Option<Self> {
        let mut parts = text.splitn(3, '-');
        let mut part = |digits: usize| {
            let part = parts.next().filter(|part| part.len() == digits && part.bytes().all(|b| b.is_ascii_digit()));
            part?.parse::<u32>().ok()
        };
        let (year, month, day) = (part(4)?, part(2)?, part(2)?);
        Self::new(i32::try_from(year).ok()?, month, day)
    }

    /// The year.
    pub fn year(self) -> i32 {
        self.parts().0
    }

    /// Month (1 to 12) and day of the month (from 1).
    pub fn month_and_day(self) -> (u32, u32) {
        let (_, month, day) = self.parts();
        (month, day)
    }

    /// The number of the day in its year, from 1.
    pub fn day_of_year(self) -> u32 {
        (self.number - number(self.year(), 1, 1) + 1) as u32
    }

    /// So many days later, or earlier where the number is negative.
    pub fn plus(self, days: i32) -> Self {
        Self { number: self.number.saturating_add(days).clamp(Self::FIRST.number, Self::LAST.number) }
    }

    /// The days from another day to this one; negative where this one is earlier.
    pub fn since(self, earlier: Self) -> i32 {
        self.number - earlier.number
    }

    /// The same day of so many years later, or earlier; of 29 February, 28 February where that year has no other.
    pub fn years_later(self, years: i32) -> Self {
        let (year, month, day) = self.parts();
        let year = year.saturating_add(years).clamp(*YEARS.start(), *YEARS.end());
        Self { number: number(year, month, day.min(days_of_month(year, month))) }
    }

    /// Days since the noon (UT) of 2000-01-01, at the midnight (UT) with which the day begins.
    pub(super) fn since_j2000(self) -> f64 {
        const J2000: i32 = 10_957;
        f64::from(self.number - J2000) - 0.5
    }

    /// Year, month and day of the month.
    fn parts(self) -> (i32, u32, u32) {
        let shifted = self.number + TO_EPOCH;
        let (era, day_of_era) = (shifted.div_euclid(DAYS_OF_ERA), shifted.rem_euclid(DAYS_OF_ERA));
        let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
        let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
        let from_march = (5 * day_of_year + 2) / 153;
        let day = day_of_year - (153 * from_march + 2) / 5 + 1;
        let month = if from_march < 10 { from_march + 3 } else { from_march - 9 };
        (era * 400 + year_of_era + i32::from(month <= 2), month as u32, day as u32)
    }
}

impl fmt::Display for Date {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (year, month, day) = self.parts();
        write!(f, "{year:04}-{month:02}-{day:02}")
    }
}

/// Whether a year has a 29 February.
pub fn is_leap(year: i32) -> bool {
    year % 4 == 0 && (year % 100 != 0 || year % 400 == 0)
}

/// 365 or 366.
pub fn days_of_year(year: i32) -> u32 {
    365 + u32::from(is_leap(year))
}

fn days_of_month(year: i32, month: u32) -> u32 {
    match month {
        2 => 28 + u32::from(is_leap(year)),
        4 | 6 | 9 | 11 => 30,
        _ => 31,
    }
}

/// Days since 1970-01-01.
fn number(year: i32, month: u32, day: u32) -> i32 {
    let year = if month <= 2 { year - 1 } else { year };
    let (era, year_of_era) = (year.div_euclid(400), year.rem_euclid(400));
    let from_march = (month as i32 + 9) % 12;
    let day_of_year = (153 * from_march + 2) / 5 + day as i32 - 1;
    era * DAYS_OF_ERA + year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year - TO_EPOCH
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The lengths of the months of a year, by the rhyme and not by the code above.
    fn months(year: i32) -> [u32; 12] {
        let is_leap = (year % 4 == 0) != (year % 100 == 0) || year % 400 == 0;
        [31, if is_leap { 29 } else { 28 }, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31]
    }

    #[test]
    fn every_day_of_two_centuries_follows_the_lengths_of_the_months() {
        // 1900-01-01 is 25,567 days before 1970-01-01: 70 years with 17 leap days.
        let (mut number, mut of_year) = (-25_567, 0);
        for year in 1900..=2100 {
            for (month, days) in (1..).zip(months(year)) {
                for day in 1..=days {
                    of_year += 1;
                    let date = Date::new(year, month, day).expect("a day");
                    assert_eq!((date.number, date.year(), date.month_and_day()), (number, year, (month, day)));
                    assert_eq!(date.day_of_year(), of_year);
                    assert_eq!(Date::of_year(year, of_year), Some(date));
                    assert_eq!(Date::parse(&date.to_string()), Some(date));
                    assert_eq!(Date::new(1970, 1, 1).map(|epoch| epoch.plus(number)), Some(date));
                    number += 1;
                }
                assert_eq!(Date::new(year, month, days + 1), None);
            }
            assert_eq!((Date::of_year(year, of_year + 1), days_of_year(year)), (None, of_year));
            of_year = 0;
        }
    }

    #[test]
    fn the_calendar_ends_and_nothing_panics() {
        assert_eq!((Date::new(-9999, 1, 1), Date::new(9999, 12, 31)), (Some(Date::FIRST), Some(Date::LAST)));
        assert_eq!(Date::LAST.plus(i32::MAX), Date::LAST);
        assert_eq!(Date::FIRST.plus(i32::MIN), Date::FIRST);
        assert_eq!(Date::LAST.years_later(i32::MAX), Date::LAST);
        for (year, month, day) in [(10_000, 1, 1), (i32::MIN, 1, 1), (2000, 0, 1), (2000, 13, 1), (2000, 1, 0)] {
            assert_eq!(Date::new(year, month, day), None);
        }
        assert_eq!((Date::of_year(2000, 0), Date::of_year(2000, u32::MAX)), (None, None));
        for text in ["", "2001", "2001-5-30", "2001-02-29", "2001-05-30x", "+201-05-30", "2001/05/30", "-001-01-01"] {
            assert_eq!(Date::parse(text), None, "{text}");
        }
    }

    #[test]
    fn the_same_day_of_another_year() {
        let leap_day = Date::new(2000, 2, 29).expect("a leap day");
        assert_eq!(leap_day.years_later(1), Date::new(2001, 2, 28).expect("a day"));
        assert_eq!(leap_day.years_later(-4), Date::new(1996, 2, 29).expect("a day"));
        assert_eq!(leap_day.since(Date::new(1999, 12, 31).expect("a day")), 60);
    }
}
