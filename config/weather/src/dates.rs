//! Dates as weather files write them.
//!
//! Five digits are a year of the century and the day of the year, where years up to 35 are 20xx and the others 19xx, as
//! in DSSAT; seven a year and the day of the year, eight a year, a month and a day. Signs between the parts make
//! year-month-day, or day/month/year where the file says that this is its order: `03/04/2001` alone is two days, and is
//! told. One letter behind the digits is a flag. Absent: years before 1700 and after 2200, which are slips.

use phytomer_sim::site::date::Date;

/// The last year of the century that DSSAT takes for 20xx.
const LAST_OF_20XX: i32 = 35;
/// The years that a station can have measured.
const YEARS: std::ops::RangeInclusive<i32> = 1700..=2200;

/// The order of the parts of a date.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Order {
    /// Year, month, day, or digits alone.
    YearFirst,
    /// Day, month, year.
    DayFirst,
}

/// A date, and whether it bears a flag.
#[inline]
pub(crate) fn date(token: &[u8], order: Order) -> Option<(Date, bool)> {
    let (digits, flagged) = match token {
        [digits @ .., letter] if letter.is_ascii_alphabetic() => (digits, true),
        digits => (digits, false),
    };
    let date = match whole_number(digits) {
        Some(number) => of_digits(number, digits.len())?,
        None => of_parts(digits, order)?,
    };
    Some((date, flagged))
}

fn of_digits(number: i32, digits: usize) -> Option<Date> {
    match digits {
        5 => of_numbers(full_year(number / 1000), None, number % 1000),
        7 => of_numbers(number / 1000, None, number % 1000),
        8 => of_numbers(number / 10_000, Some(number / 100 % 100), number % 100),
        _ => None,
    }
}

/// The year of two digits.
fn full_year(of_century: i32) -> i32 {
    if of_century <= LAST_OF_20XX { 2000 + of_century } else { 1900 + of_century }
}

fn of_parts(digits: &[u8], order: Order) -> Option<Date> {
    let sign = *digits.iter().find(|byte| !byte.is_ascii_digit()).filter(|byte| b"-/.".contains(byte))?;
    let mut parts = digits.split(|byte| *byte == sign);
    let mut part = || parts.next();
    let (first, month, last) = (part()?, part()?, part()?);
    let (year, day) = if order == Order::YearFirst { (first, last) } else { (last, first) };
    let sound = part().is_none() && year.len() == 4 && month.len() <= 2 && day.len() <= 2;
    sound.then(|| of_numbers(whole_number(year)?, Some(whole_number(month)?), whole_number(day)?)).flatten()
}

/// A number of at most nine digits and nothing else.
#[inline]
pub(crate) fn whole_number(digits: &[u8]) -> Option<i32> {
    if digits.is_empty() || digits.len() > 9 {
        return None;
    }
    let mut number = 0;
    for byte in digits {
        if !byte.is_ascii_digit() {
            return None;
        }
        number = number * 10 + i32::from(byte - b'0');
    }
    Some(number)
}

/// A day by a year and a day of it, or by a year, a month and a day.
#[inline]
pub(crate) fn of_numbers(year: i32, month: Option<i32>, day: i32) -> Option<Date> {
    let day = u32::try_from(day).ok().filter(|_| YEARS.contains(&year))?;
    match month {
        Some(month) => Date::new(year, u32::try_from(month).ok()?, day),
        None => Date::of_year(year, day),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Option<String> {
        date(text.as_bytes(), Order::YearFirst)
            .map(|(date, flagged)| format!("{date}{}", if flagged { "e" } else { "" }))
    }

    #[test]
    fn the_forms_of_dates() {
        for (text, meant) in [
            ("35366", None),
            ("35365", Some("2035-12-31")),
            ("36366", Some("1936-12-31")),
            ("00060", Some("2000-02-29")),
            ("01060", Some("2001-03-01")),
            ("90221e", Some("1990-08-09e")),
            ("1988001", Some("1988-01-01")),
            ("1988367", None),
            ("20010530", Some("2001-05-30")),
            ("2001-05-30", Some("2001-05-30")),
            ("2001/5/3", Some("2001-05-03")),
            ("03/04/2001", None),
            ("1600001", None),
            ("9500112", None),
            ("950", None),
            ("", None),
            ("e", None),
            ("2001-05/30", None),
            ("2001-05-30-1", None),
        ] {
            assert_eq!(read(text).as_deref(), meant, "{text}");
        }
        let day_first = date(b"03/04/2001", Order::DayFirst).map(|(date, _)| date.to_string());
        assert_eq!(day_first.as_deref(), Some("2001-04-03"));
    }
}
