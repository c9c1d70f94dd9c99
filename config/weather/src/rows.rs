//! The rows of a weather file as they are read: each value checked by itself and against its day.
//!
//! A reader opens a row, hands over its cells and closes it with its date. What is wrong within the row is told at
//! once; a row whose date or columns cannot be known is left out, and then the next is not told to follow a gap.
//! Absent: how rows follow one another, which `series` checks when all are there.

use crate::fault::{Faults, Kind, Place};
use crate::number::{Cell, cell};
use crate::quantity::{Measure, Quantity, Values};
use crate::weather::LeftOut;
use phytomer_sim::site::date::Date;

/// A row with a date.
pub(crate) struct Row {
    /// The day.
    pub day: Date,
    /// Where its date stands.
    pub place: Place,
    /// Whether the row before it was left out, so that nothing is known of what lies between.
    pub after_broken: bool,
}

/// A cell of a row.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Written<'a> {
    /// Its bytes, without blanks around them.
    pub token: &'a [u8],
    /// Where it stands.
    pub place: Place,
    /// The decimal point of the file.
    pub point: u8,
}

/// All rows so far, and what was wrong with them.
pub(crate) struct Rows<'t> {
    /// What was told.
    pub faults: Faults<'t>,
    /// The rows with a date, in the order of the file.
    pub found: Vec<Row>,
    /// What was measured in each of them.
    pub measured: Vec<Values>,
    /// Rows with a flag.
    pub flagged: u32,
    /// Values whose column cannot be known, and that are no temperature, radiation or rain.
    pub left_out: Option<LeftOut>,
    values: Values,
    is_flagged: bool,
    is_broken: bool,
    /// Where the minimum of the row stands.
    minimum: Place,
}

/// A row takes at least so many bytes in most files.
const BYTES_OF_ROW: usize = 24;
/// Room for more rows than this, two centuries, is made as they come.
const MOST_ROOM: usize = 73_049;

impl<'t> Rows<'t> {
    /// None yet.
    pub fn of(text: &'t str) -> Self {
        let rows = (text.len() / BYTES_OF_ROW).min(MOST_ROOM);
        Self {
            faults: Faults::of(text),
            found: Vec::with_capacity(rows),
            measured: Vec::with_capacity(rows),
            flagged: 0,
            left_out: None,
            values: Values::default(),
            is_flagged: false,
            is_broken: false,
            minimum: Place::default(),
        }
    }

    /// Opens a row, with the values that hold for all of them.
    #[inline]
    pub fn open(&mut self, values: &Values) {
        self.values = *values;
        self.is_flagged = false;
    }

    /// The values of the row so far.
    pub fn values(&self) -> Values {
        self.values
    }

    /// Says that the row, or its date, bears a flag.
    pub fn flag(&mut self) {
        self.is_flagged = true;
    }

    /// Counts a value that is left out.
    #[cold]
    pub fn left_out(&mut self, line: u32) {
        self.left_out.get_or_insert(LeftOut { first_line: line, values: 0 }).values += 1;
    }

    /// Takes a cell of the row.
    #[inline]
    pub fn take(&mut self, measure: &Measure, written: Written<'_>) {
        let (cell, is_flagged) = cell(written.token, written.point);
        self.is_flagged |= is_flagged;
        if measure.quantity == Quantity::Minimum {
            self.minimum = written.place;
        }
        match cell {
            Cell::Value(value) => match measure.kept(value) {
                Some(kept) => self.values.set(measure.quantity, Some(kept)),
                None => self.impossible(measure, written.place),
            },
            Cell::Missing => self.values.set(measure.quantity, None),
            Cell::Stars | Cell::Text => self.unreadable(measure, cell, written),
        }
    }

    #[cold]
    fn impossible(&mut self, measure: &Measure, place: Place) {
        let said = self.faults.said(place);
        let problem = format!("no station measures a {} of {said} {}", measure.quantity.words(), measure.unit);
        self.faults.tell(Kind::Impossible, place, problem.trim_end(), format!("a value in {}", measure.range()));
        self.stand_in(measure.quantity);
    }

    #[cold]
    fn unreadable(&mut self, measure: &Measure, cell: Cell, written: Written<'_>) {
        let (said, words) = (self.faults.said(written.place), measure.quantity.words());
        let (problem, expected) = if cell == Cell::Stars {
            (format!("the {words} did not fit its column when it was written: `{said}`"), "a number, or -99")
        } else if written.token.contains(&b',') && written.point == b'.' {
            (format!("the {words} `{said}` has a comma"), "a decimal point, as in `12.5`")
        } else {
            (format!("the {words} is no number: `{said}`"), "a number, or -99 where nothing was measured")
        };
        self.faults.tell(Kind::Unreadable, written.place, problem, expected);
        self.stand_in(measure.quantity);
    }

    /// What was told of a temperature is not told again as a temperature that is missing.
    fn stand_in(&mut self, quantity: Quantity) {
        let value = match quantity {
            Quantity::Maximum => Some(f64::INFINITY),
            Quantity::Minimum => Some(f64::NEG_INFINITY),
            _ => None,
        };
        self.values.set(quantity, value);
    }

    /// Closes the row with its date.
    #[inline]
    pub fn close(&mut self, day: Date, place: Place) {
        let (maximum, minimum) = (self.values.get(Quantity::Maximum), self.values.get(Quantity::Minimum));
        if let (Some(maximum), Some(minimum)) = (maximum, minimum)
            && minimum > maximum
        {
            self.crossed(maximum, minimum, place);
        }
        self.flagged += u32::from(self.is_flagged);
        let after_broken = std::mem::take(&mut self.is_broken);
        self.found.push(Row { day, place, after_broken });
        self.measured.push(self.values);
    }

    #[cold]
    fn crossed(&mut self, maximum: f64, minimum: f64, date: Place) {
        let problem = format!("the minimum of {minimum} °C is above the maximum of {maximum} °C");
        let place = if self.minimum.line == date.line { self.minimum } else { date };
        self.faults.tell(Kind::Crossed, place, problem, "a minimum that is at most the maximum of its day");
    }

    /// Leaves the row out, of which something was told.
    pub fn leave_out(&mut self) {
        self.is_broken = true;
    }

    /// Tells of a date that is none.
    #[cold]
    pub fn no_date(&mut self, place: Place, expected: &str) {
        let said = self.faults.said(place);
        let problem = if said.is_empty() { "this row has no date".to_owned() } else { format!("`{said}` is no date") };
        self.faults.tell(Kind::Unreadable, place, problem, expected);
        self.leave_out();
    }
}
