//! The columns of files that have one value for each name: APSIM's and CSV.
//!
//! A day is told by a column for the date, or by a year with a day of the year, or with a month and a day. A value that
//! is the same in all rows may stand above them (APSIM). Absent: how a line is cut into its values.

use crate::asked::Format;
use crate::dates::{Order, date, of_numbers, whole_number};
use crate::fault::{Kind, Place};
use crate::names::{Column, MOST_COLUMNS, column, lacking};
use crate::number::{Cell, cell};
use crate::quantity::{Quantity, Values};
use crate::rows::{Rows, Written};
use crate::station::locate;
use crate::text::Line;
use crate::weather::Station;

/// A name of a column and where it stands.
#[derive(Debug, Clone)]
pub(crate) struct Name {
    /// As it is written.
    pub text: String,
    /// Where it stands.
    pub place: Place,
}

/// A row's cells, each with where it begins and ends in its line.
pub(crate) type Cells = Vec<(u32, u32)>;

/// The columns of a file.
pub(crate) struct Named {
    format: Format,
    columns: Vec<Column>,
    /// What holds in every row.
    constants: Values,
    /// Year, month, day of the month and day of the year that hold in every row.
    parts: [Option<i32>; 4],
    /// How dates are written.
    pub order: Order,
    /// The decimal point.
    pub point: u8,
    /// Columns that are not read.
    pub unused: Vec<String>,
    /// The station, as the first row has it.
    pub station: Station,
    /// What was said of the station.
    said: Vec<(usize, String)>,
}

const ALL_PARTS: [Column; 4] = [Column::Year, Column::Month, Column::DayOfMonth, Column::DayOfYear];

impl Named {
    /// The columns of the names, with `constants` (names and values) that stand above; `line` is theirs.
    pub fn new(
        format: Format,
        names: &[Name],
        constants: &[(Name, Place)],
        text: &str,
        rows: &mut Rows<'_>,
        line: &Line<'_>,
    ) -> Self {
        let names = &names[..names.len().min(MOST_COLUMNS + 1)];
        if names.len() > MOST_COLUMNS {
            let expected = format!("at most {MOST_COLUMNS}");
            rows.faults.tell(Kind::Layout, Place::whole(line), format!("more than {MOST_COLUMNS} columns"), expected);
        }
        let columns: Vec<Column> = names.iter().map(|name| column(format, &name.text)).collect();
        let mut named = Self {
            format,
            columns,
            constants: Values::default(),
            parts: [None; 4],
            order: Order::YearFirst,
            point: b'.',
            unused: Vec::new(),
            station: Station::default(),
            said: Vec::new(),
        };
        for (name, place) in constants {
            named.constant(name, *place, text, rows);
        }
        named.check(names, rows, line);
        named
    }

    /// Takes a value that stands for a column.
    fn constant(&mut self, name: &Name, place: Place, text: &str, rows: &mut Rows<'_>) {
        let start = place.line_start + place.start as usize;
        let token = text.get(start..place.line_start + place.end as usize).unwrap_or("");
        let column = column(self.format, &name.text);
        let stands_twice = column != Column::Unused && self.columns.contains(&column);
        if stands_twice {
            let problem = format!("`{}` stands above the rows and is a column of them too", name.text);
            return rows.faults.tell(Kind::Layout, name.place, problem, "one of them");
        }
        match column {
            Column::Of(measure) => {
                rows.open(&self.constants);
                rows.take(&measure, Written { token: token.as_bytes(), place, point: b'.' });
                self.constants = rows.values();
            }
            Column::Station => self.station.name = Some(token.to_owned()),
            Column::Latitude | Column::Longitude | Column::Elevation => {
                locate(&mut self.station, column, token.as_bytes(), place, &mut rows.faults);
            }
            column => {
                if let Some(part) = ALL_PARTS.iter().position(|part| *part == column) {
                    self.parts[part] = whole_number(token.as_bytes());
                }
            }
        }
    }

    /// Whether the names make a table of days.
    fn check(&mut self, names: &[Name], rows: &mut Rows<'_>, line: &Line<'_>) {
        let is_there = |quantity| {
            let is_column = self.columns.iter().any(|c| matches!(c, Column::Of(m) if m.quantity == quantity));
            is_column || self.constants.get(quantity).is_some()
        };
        let unused = names.iter().zip(&self.columns).filter(|(_, column)| **column == Column::Unused);
        for (problem, expected) in lacking(self.format, is_there, unused.map(|(name, _)| name.text.as_str())) {
            rows.faults.tell(Kind::Layout, Place::whole(line), problem, expected);
        }
        let has = |part: usize| self.parts[part].is_some() || self.columns.contains(&ALL_PARTS[part]);
        if !self.columns.contains(&Column::Date) && !(has(0) && (has(3) || (has(1) && has(2)))) {
            let expected = match self.format {
                Format::Apsim => "columns `year` and `day`, or `date`",
                _ => "a column `W_DATE`, or columns for the year and the day of the year",
            };
            rows.faults.tell(Kind::Layout, Place::whole(line), "no column tells the date", expected);
        }
        for (at, column) in self.columns.iter().enumerate() {
            if *column == Column::Unused {
                self.unused.push(names[at].text.clone());
            } else if self.columns[..at].contains(column) {
                let problem = format!("a second column `{}`", names[at].text);
                rows.faults.tell(Kind::Layout, names[at].place, problem, "each column once");
            }
        }
    }

    /// How many columns there are.
    pub fn len(&self) -> usize {
        self.columns.len()
    }

    /// Takes a row, which has as many cells as there are columns.
    #[inline]
    pub fn row(&mut self, line: &Line<'_>, cells: &Cells, rows: &mut Rows<'_>) {
        rows.open(&self.constants);
        let (mut whole, mut parts, mut bad) = (None, self.parts, None);
        let bytes = line.text.as_bytes();
        for (at, (start, end)) in cells.iter().enumerate() {
            let token = bytes.get(*start as usize..*end as usize).unwrap_or_default();
            let place = Place::of(line, *start as usize, *end as usize);
            match self.columns[at] {
                Column::Of(measure) => rows.take(&measure, Written { token, place, point: self.point }),
                Column::Date => whole = Some((place, date(token, self.order))),
                Column::Year => parts[0] = number(token, place, &mut bad),
                Column::Month => parts[1] = number(token, place, &mut bad),
                Column::DayOfMonth => parts[2] = number(token, place, &mut bad),
                Column::DayOfYear => parts[3] = number(token, place, &mut bad),
                Column::Unused => {}
                column => self.place(column, at, token, place, rows),
            }
        }
        let expected = "a date of the calendar, as in 2001-05-30";
        if let Some((place, date)) = whole {
            return match date {
                Some((day, flagged)) => {
                    if flagged {
                        rows.flag();
                    }
                    rows.close(day, place);
                }
                None => rows.no_date(place, expected),
            };
        }
        let place = bad.unwrap_or(Place::whole(line));
        let day = match parts {
            [Some(year), _, _, Some(day)] => of_numbers(year, None, day),
            [Some(year), month @ Some(_), Some(day), None] => of_numbers(year, month, day),
            _ => None,
        };
        match day.filter(|_| bad.is_none()) {
            Some(day) => rows.close(day, place),
            None => rows.no_date(place, "a year and a day of it"),
        }
    }

    /// A cell that tells of the station: it must say the same in all rows.
    fn place(&mut self, column: Column, at: usize, token: &[u8], place: Place, rows: &mut Rows<'_>) {
        let said = rows.faults.said(place);
        match self.said.iter().find(|(column, _)| *column == at) {
            Some((_, known)) if *known == said => {}
            Some((_, known)) => {
                let problem = format!("a second station: `{said}` after `{known}`");
                rows.faults.tell(Kind::Layout, place, problem, "the weather of one station a file");
                self.said.retain(|(column, _)| *column != at);
                self.said.push((at, said));
            }
            None if column == Column::Station => {
                self.station.name = Some(said.clone());
                self.said.push((at, said));
            }
            None => {
                locate(&mut self.station, column, token, place, &mut rows.faults);
                self.said.push((at, said));
            }
        }
    }

    /// Tells of a row with another number of cells.
    #[cold]
    pub fn wrong_length(&self, line: &Line<'_>, cells: usize, rows: &mut Rows<'_>) {
        let columns = self.len();
        let problem = format!("this row has {cells} value{}", if cells == 1 { "" } else { "s" });
        let expected = format!("{columns}, one for each column");
        rows.faults.tell(Kind::Layout, Place::whole(line), problem, expected);
        rows.leave_out();
    }
}

/// A whole number, also as `12.0` writes it; where it is none, its place is kept.
#[inline]
fn number(token: &[u8], place: Place, bad: &mut Option<Place>) -> Option<i32> {
    let number = whole_number(token).or_else(|| match cell(token, b'.').0 {
        Cell::Value(value) if value.abs() < 1e6 && value == value.trunc() => Some(value as i32),
        _ => None,
    });
    if number.is_none() && bad.is_none() {
        *bad = Some(place);
    }
    number
}

/// The unit of a quantity, for a message.
pub(crate) fn unit_of(column: Column) -> Option<(Quantity, &'static str)> {
    match column {
        Column::Of(measure) => Some((measure.quantity, measure.unit)),
        _ => None,
    }
}
