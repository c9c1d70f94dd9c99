//! DSSAT's `.WTH` and AgMIP's `.AgMIP`: sections, headers that begin with `@`, rows below them.
//!
//! Jones et al. 2003 (*European Journal of Agronomy* 18: 235–265), and DSSAT's reader `IPWTH`. `*` or `$` opens a
//! section, `!` a comment; the table with a date holds the days, that with a latitude the station, and the rows of
//! others are passed over. `.AgMIP` files differ in two units and repeat the date as year, month and day. Absent: where
//! a value stands, which `layout` knows, and what a table of days must have beside temperatures.

mod layout;
mod token;

use crate::asked::Format;
use crate::dates::{Order, date, of_numbers, whole_number};
use crate::fault::{Kind, Place};
use crate::names::{Column, MOST_COLUMNS, column, lacking};
use crate::number::{Cell, cell};
use crate::quantity::Values;
use crate::rows::{Rows, Written};
use crate::station::locate;
use crate::text::{Line, Lines, trimmed};
use crate::weather::Station;
use layout::{Head, Layout, Misfit};
use phytomer_sim::site::date::Date;
use token::{Token, tokens, without_note};

/// What the rows below a header are.
enum Table {
    Days(Layout),
    Station(Layout),
    Other,
}

/// A file while it is read.
struct Reader<'r, 't> {
    format: Format,
    rows: &'r mut Rows<'t>,
    table: Table,
    station: Option<Station>,
    name: Option<String>,
    unused: Vec<String>,
    has_days: bool,
    tokens: Vec<Token>,
    heads: Vec<usize>,
}

const A_DATE: &str = "a date: two or four digits of the year and three of the day";

/// Reads the lines of a file into rows; what it says of its station, and the columns that are not read.
pub(crate) fn read(text: &str, format: Format, rows: &mut Rows<'_>) -> (Station, Vec<String>) {
    let mut reader = Reader {
        format,
        rows,
        table: Table::Other,
        station: None,
        name: None,
        unused: Vec::new(),
        has_days: false,
        tokens: Vec::new(),
        heads: Vec::new(),
    };
    let mut end = Place::default();
    for line in Lines::of(text) {
        end = Place::of(&line, 0, 0);
        reader.line(&line);
    }
    if !reader.has_days {
        let problem = "no table of days: no line begins with `@` and names a date";
        let expected = "a line such as `@DATE  SRAD  TMAX  TMIN  RAIN`";
        reader.rows.faults.tell(Kind::Layout, end, problem, expected);
    }
    let mut station = reader.station.unwrap_or_default();
    station.name = station.name.or(reader.name);
    (station, reader.unused)
}

impl Reader<'_, '_> {
    #[inline]
    fn line(&mut self, line: &Line<'_>) {
        match line.text.as_bytes().first() {
            Some(b'0'..=b'9') => {}
            Some(b'!') | None => return,
            Some(b'@') => return self.header(line),
            Some(b'*' | b'$') if is_title(line.text) => return self.section(line),
            Some(_) if line.is_blank() => return,
            Some(_) => {}
        }
        match &self.table {
            Table::Days(_) => self.day(line),
            Table::Station(_) => self.place(line),
            Table::Other if self.has_days => self.stray(line),
            Table::Other => {}
        }
    }

    /// Tells of a row that looks like a day behind the table of days.
    #[cold]
    fn stray(&mut self, line: &Line<'_>) {
        tokens(line.text.as_bytes(), &mut self.tokens);
        if let [first, _, ..] = self.tokens.as_slice()
            && date(first.of(line.text.as_bytes()), Order::YearFirst).is_some()
        {
            let problem = "this row stands below no header of days: a section has ended their table";
            self.rows.faults.tell(Kind::Layout, Place::whole(line), problem, "a line with `@DATE` before it");
        }
    }

    fn section(&mut self, line: &Line<'_>) {
        let title = line.text.trim_start_matches(['*', '$']);
        self.table = Table::Other;
        if title.get(..7).is_some_and(|word| word.eq_ignore_ascii_case("weather")) {
            let name = title.split_once(':').map_or("", |(_, name)| trimmed(name));
            self.name = self.name.take().or((!name.is_empty()).then(|| name.to_owned()));
        }
    }

    fn header(&mut self, line: &Line<'_>) {
        let mut text = line.text.to_owned();
        // The sign is no part of the first name, and is kept as a blank so that places stay.
        text.replace_range(..1, " ");
        let tabs = tokens(text.as_bytes(), &mut self.tokens);
        if self.tokens.len() > MOST_COLUMNS {
            self.table = Table::Other;
            let problem = format!("{} columns", self.tokens.len());
            let expected = format!("at most {MOST_COLUMNS}");
            return self.rows.faults.tell(Kind::Layout, Place::whole(line), problem, expected);
        }
        let names: Vec<&str> =
            self.tokens.iter().map(|token| text.get(token.start as usize..token.end as usize).unwrap_or("")).collect();
        let head = |(token, name): (&Token, &&str)| Head {
            column: column(self.format, name),
            start: token.start,
            end: token.end,
        };
        let layout = Layout { heads: self.tokens.iter().zip(&names).map(head).collect(), tabs };
        let has = |column| layout.heads.iter().any(|head| head.column == column);
        self.table = if has(Column::Date) {
            let names: Vec<String> = names.into_iter().map(str::to_owned).collect();
            self.days(line, &layout, &names);
            Table::Days(layout)
        } else if has(Column::Latitude) {
            Table::Station(layout)
        } else {
            Table::Other
        };
    }

    /// Checks the headers of a table of days.
    fn days(&mut self, line: &Line<'_>, layout: &Layout, names: &[String]) {
        self.has_days = true;
        let has = |wanted| layout.heads.iter().any(|head| matches!(head.column, Column::Of(m) if m.quantity == wanted));
        let unused = names.iter().zip(&layout.heads).filter(|(_, head)| head.column == Column::Unused);
        for (problem, expected) in lacking(self.format, has, unused.map(|(name, _)| name.as_str())) {
            self.rows.faults.tell(Kind::Layout, Place::whole(line), problem, expected);
        }
        for (at, head) in layout.heads.iter().enumerate() {
            let is_twice = head.column != Column::Unused && layout.heads[..at].iter().any(|h| h.column == head.column);
            if is_twice {
                let place = Place::of(line, head.start as usize, head.end as usize);
                let problem = format!("a second column `{}`", names[at]);
                self.rows.faults.tell(Kind::Layout, place, problem, "each column once");
            }
            if head.column == Column::Unused && !self.unused.contains(&names[at]) {
                self.unused.push(names[at].clone());
            }
        }
    }

    #[inline]
    fn day(&mut self, line: &Line<'_>) {
        let Table::Days(layout) = &self.table else { return };
        let bytes = line.text.as_bytes();
        let tabs = tokens(bytes, &mut self.tokens);
        without_note(bytes, &mut self.tokens, layout.heads.last().map_or(0, |head| head.end));
        if self.tokens.iter().any(|token| token.points > 1) {
            part(layout, bytes, &mut self.tokens);
        }
        if self.tokens.is_empty() {
            return;
        }
        if let Err(misfit) = layout.assign(bytes, &self.tokens, tabs, &mut self.heads) {
            return self.misfit(line, misfit);
        }
        self.rows.open(&Values::default());
        let (mut day, mut parts) = (None, [None; 3]);
        for (token, head) in self.tokens.iter().zip(&self.heads) {
            let (place, bytes) = (Place::of(line, token.start as usize, token.end as usize), token.of(bytes));
            let Some(head) = layout.heads.get(*head) else {
                self.rows.left_out(line.number);
                continue;
            };
            match head.column {
                Column::Date => day = Some((place, date(bytes, Order::YearFirst))),
                Column::Of(measure) => self.rows.take(&measure, Written { token: bytes, place, point: b'.' }),
                Column::Year => parts[0] = whole_number(bytes),
                Column::Month => parts[1] = whole_number(bytes),
                Column::DayOfMonth => parts[2] = whole_number(bytes),
                _ => {}
            }
        }
        match day {
            Some((place, Some((day, flagged)))) if agree(day, parts) => {
                if flagged {
                    self.rows.flag();
                }
                self.rows.close(day, place);
            }
            Some((place, Some((day, _)))) => {
                let problem = format!("the columns for year, month and day do not say {day}");
                self.rows.faults.tell(Kind::Unreadable, place, problem, "the same day in both");
                self.rows.leave_out();
            }
            Some((place, None)) => self.rows.no_date(place, A_DATE),
            None => self.rows.no_date(Place::whole(line), A_DATE),
        }
    }

    #[cold]
    fn misfit(&mut self, line: &Line<'_>, misfit: Misfit) {
        let at = match misfit {
            Misfit::NoDate => 0,
            Misfit::Astray(at) | Misfit::Wide(at) => at,
        };
        let token = self.tokens[at.min(self.tokens.len() - 1)];
        let place = Place::of(line, token.start as usize, token.end as usize);
        let said = self.rows.faults.said(place);
        let (problem, expected) = match misfit {
            Misfit::NoDate => return self.rows.no_date(place, A_DATE),
            Misfit::Wide(_) => (
                format!("`{said}` begins below the header before its own: it may be two values"),
                "blanks between values",
            ),
            Misfit::Astray(_) if token.points == 0 && cell(token.of(line.text.as_bytes()), b'.').0 == Cell::Text => {
                (format!("`{said}` is no number"), "a number, or -99 where nothing was measured")
            }
            Misfit::Astray(_) => (
                format!("it cannot be known which column `{said}` stands in"),
                "values that end below the end of their header, or one for each header",
            ),
        };
        self.rows.faults.tell(Kind::Layout, place, problem, expected);
        self.rows.leave_out();
    }

    /// The row of the station.
    fn place(&mut self, line: &Line<'_>) {
        let Table::Station(layout) = std::mem::replace(&mut self.table, Table::Other) else { return };
        let bytes = line.text.as_bytes();
        tokens(bytes, &mut self.tokens);
        let mut station = Station::default();
        for (at, head) in layout.heads.iter().enumerate() {
            let Some(token) = layout.below(&self.tokens, at).map(|found| self.tokens[found]) else { continue };
            let place = Place::of(line, token.start as usize, token.end as usize);
            match head.column {
                Column::Station => station.name = Some(self.rows.faults.said(place)),
                column => locate(&mut station, column, token.of(bytes), place, &mut self.rows.faults),
            }
        }
        // Years that were joined to one file say their station again.
        if self.station.get_or_insert_with(|| station.clone()) != &station {
            let expected = "the weather of one station a file";
            self.rows.faults.tell(Kind::Layout, Place::whole(line), "a second station", expected);
        }
    }
}

/// Whether a line opens a section: a word behind its stars, or nothing; a number behind them is a row that is broken.
fn is_title(text: &str) -> bool {
    let title = trimmed(text.trim_start_matches(['*', '$']));
    title.is_empty() || title.starts_with(char::is_alphabetic)
}

/// Parts values that touch without a minus.
#[cold]
fn part(layout: &Layout, line: &[u8], tokens: &mut Vec<Token>) {
    let mut at = 0;
    while at < tokens.len() {
        let token = tokens[at];
        match (token.points > 1).then(|| layout.seam(line, &token)).flatten() {
            Some(seam) => {
                tokens[at] = Token { end: seam, points: token.points - 1, ..token };
                tokens.insert(at + 1, Token { start: seam, points: 1, ..token });
            }
            None => at += 1,
        }
    }
}

/// Whether the columns for year, month and day, where there are all three, say the same day.
#[inline]
fn agree(day: Date, parts: [Option<i32>; 3]) -> bool {
    match parts {
        [Some(year), month @ Some(_), Some(day_of_month)] => of_numbers(year, month, day_of_month) == Some(day),
        _ => true,
    }
}
