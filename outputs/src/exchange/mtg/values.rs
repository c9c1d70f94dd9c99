//! Cells of features: numbers, texts, truths, and dates in all forms of the format.
//!
//! A cell that is not of its declared type is kept as what it is, with a warning. A year of two digits is one of
//! 1970 to 2069.

use crate::exchange::description::{Date, FeatureType, Value};

/// A declared type: what values are, and for dates the order of their parts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Declared {
    /// What values are.
    pub kind: FeatureType,
    form: DateForm,
}

/// Which parts a date has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct DateForm {
    day: bool,
    year: bool,
    /// Whether the month stands before the day.
    month_first: bool,
}

/// What a cell is.
pub enum Cell {
    /// A value of the declared type.
    Fits(Value),
    /// A value that is kept, though it is not of the declared type.
    Kept(Value),
    /// The word for a value that is missing.
    Missing,
}

impl Declared {
    /// A type that is not one of dates.
    pub const fn of(kind: FeatureType) -> Self {
        Self { kind, form: DateForm { day: true, year: true, month_first: false } }
    }

    /// The type of a word of the section FEATURES; `None` where it is none of the format.
    pub fn of_word(word: &str) -> Option<Self> {
        let upper = word.to_ascii_uppercase();
        Some(Self::of(match upper.as_str() {
            "INT" | "INTEGER" => FeatureType::Int,
            "REAL" | "FLOAT" | "DOUBLE" => FeatureType::Real,
            "ALPHA" | "STRING" => FeatureType::Text,
            "BOOLEAN" | "BOOL" => FeatureType::Truth,
            "DATE" => FeatureType::Date,
            date if date.contains("MM") => {
                let day = date.find("DD");
                let month_first = day.is_some_and(|day| date.find("MM") < Some(day));
                let form = DateForm { day: day.is_some(), year: date.contains("YY"), month_first };
                return Some(Self { kind: FeatureType::Date, form });
            }
            _ => return None,
        }))
    }

    /// What a cell that is not empty is.
    pub fn cell(self, text: &str) -> Cell {
        let fitting = match self.kind {
            FeatureType::Int => text.parse().ok().map(Value::Int),
            FeatureType::Real => real(text).map(Value::Real),
            FeatureType::Text => Some(Value::Text(text.into())),
            FeatureType::Truth => truth(text).map(Value::Truth),
            FeatureType::Date => date(text, self.form).map(Value::Date),
        };
        match fitting {
            Some(value) => Cell::Fits(value),
            None if ["NA", "NAN", "NULL", "?"].contains(&text.to_ascii_uppercase().as_str()) => Cell::Missing,
            None => Cell::Kept(kept(text)),
        }
    }
}

/// A value of no declared type: a number where it is one.
pub fn kept(text: &str) -> Value {
    match real(&text.replace(',', ".")) {
        Some(number) => Value::Real(number),
        None => Value::Text(text.into()),
    }
}

fn real(text: &str) -> Option<f64> {
    text.parse::<f64>().ok().filter(|number| number.is_finite())
}

fn truth(text: &str) -> Option<bool> {
    match text.to_ascii_lowercase().as_str() {
        "true" | "1" | "t" | "yes" => Some(true),
        "false" | "0" | "f" | "no" => Some(false),
        _ => None,
    }
}

/// A date such as `16/07/2007`, `07/07`, `16/07/07-14:30`; without a year it is of the year 0.
fn date(text: &str, form: DateForm) -> Option<Date> {
    let (day_text, time) = match text.split_once(['-', ' ', 'T']) {
        Some((day, time)) if text.contains('/') => (day, Some(time)),
        _ => (text, None),
    };
    let mut numbers = [0_u32; 3];
    let mut found = 0;
    for part in day_text.split(['/', '-', '.']) {
        let wide = part.len() <= 4 && !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
        *numbers.get_mut(found).filter(|_| wide)? = part.parse().ok()?;
        found += 1;
    }
    let parts = 1 + usize::from(form.day) + usize::from(form.year);
    let (mut day, mut month, mut year) = (1, numbers[0], None);
    match (found, form.day) {
        // Dates as calendars of today have them: the year first.
        (3, _) if numbers[0] > 31 => (year, month, day) = (Some(numbers[0]), numbers[1], numbers[2]),
        (3, _) => (day, month, year) = (numbers[0], numbers[1], Some(numbers[2])),
        (2, true) if parts == 2 => (day, month) = (numbers[0], numbers[1]),
        (2, false) => year = Some(numbers[1]),
        _ => return None,
    }
    if form.month_first && form.day && numbers[0] <= 31 {
        (day, month) = (month, day);
    }
    let minute = time.map_or(Some(None), |time| minutes(time).map(Some))?;
    let year = year.map_or(0, |year| {
        if year < 70 {
            year + 2000
        } else if year < 100 {
            year + 1900
        } else {
            year
        }
    });
    let date = Date { year: year as i32, month: month as u8, day: day as u8, minute };
    ((1..=12).contains(&month) && (1..=days_of(date.year, date.month)).contains(&day)).then_some(date)
}

/// The minute of the day of `14:30` or `14h30`.
fn minutes(time: &str) -> Option<u16> {
    let (hour, minute) = time.split_once([':', 'h', 'H']).unwrap_or((time, "0"));
    let minute = minute.split(':').next().filter(|minute| !minute.is_empty()).unwrap_or("0");
    let (hour, minute): (u16, u16) = (hour.parse().ok()?, minute.parse().ok()?);
    (hour < 24 && minute < 60).then_some(hour * 60 + minute)
}

fn days_of(year: i32, month: u8) -> u32 {
    match month {
        4 | 6 | 9 | 11 => 30,
        2 if year % 4 == 0 && (year % 100 != 0 || year % 400 == 0) => 29,
        2 => 28,
        _ => 31,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(kind: &str, text: &str) -> String {
        match Declared::of_word(kind).unwrap().cell(text) {
            Cell::Fits(Value::Date(date)) => date.to_string(),
            Cell::Fits(other) => format!("{other:?}"),
            Cell::Kept(other) => format!("kept {other:?}"),
            Cell::Missing => "missing".to_owned(),
        }
    }

    #[test]
    fn dates_have_many_forms() {
        assert_eq!(told("DD/MM/YY", "16/07/2007"), "2007-07-16");
        assert_eq!(told("DD/MM/YY", "16/07/95"), "1995-07-16");
        assert_eq!(told("DD/MM/YY", "2007-07-16"), "2007-07-16");
        assert_eq!(told("DD/MM", "16/07"), "0000-07-16");
        assert_eq!(told("MM/YY", "07/69"), "2069-07-01");
        assert_eq!(told("MM/DD/YY", "07/16/07"), "2007-07-16");
        assert_eq!(told("DD/MM/YY-TIME", "16/07/07-14:30"), "2007-07-16T14:30");
        assert_eq!(told("DD/MM-TIME", "16/07-4h05"), "0000-07-16T04:05");
        assert_eq!(told("DD/MM/YY", "31/02/2007"), "kept Text(\"31/02/2007\")");
        assert_eq!(told("DD/MM/YY", "29/02/2008"), "2008-02-29");
    }

    #[test]
    fn numbers_are_kept_as_they_are() {
        assert_eq!(told("INT", "7"), "Int(7)");
        assert_eq!(told("INT", "7.5"), "kept Real(7.5)");
        assert_eq!(told("REAL", "3,5"), "kept Real(3.5)");
        assert_eq!(told("REAL", "tall"), "kept Text(\"tall\")");
        assert_eq!(told("REAL", "NA"), "missing");
        assert_eq!(told("REAL", "inf"), "kept Text(\"inf\")");
        assert_eq!(told("BOOLEAN", "true"), "Truth(true)");
    }
}
