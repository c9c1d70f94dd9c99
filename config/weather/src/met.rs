//! APSIM's `.met`: constants `name = value (unit)`, a line of names, a line of units, and rows between blanks.
//!
//! Keating et al. 2003 (*European Journal of Agronomy* 18: 267–288), and the weather component of APSIM next
//! generation. A constant may stand for a column: it then holds in every row. `!` begins a comment. A unit must be the
//! one that APSIM has for its column, since APSIM converts none; a date with the unit `(dd/mm/yyyy)` is read in that
//! order. Absent: the codes that tell where a value comes from, which are no quantities.

use crate::asked::Format;
use crate::dates::Order;
use crate::fault::{Kind, Place};
use crate::named::{Cells, Name, Named, unit_of};
use crate::names::{Column, column, unit_is_known};
use crate::rows::Rows;
use crate::text::{Line, Lines, is_blank, trimmed};
use crate::weather::Station;

/// Reads the lines of a file into rows; what it says of its station, and the columns that are not read.
pub(crate) fn read(text: &str, rows: &mut Rows<'_>) -> (Station, Vec<String>) {
    let (mut constants, mut names, mut named) = (Vec::new(), Vec::new(), None);
    let (mut cells, mut end, mut has_units) = (Cells::new(), Place::default(), false);
    for line in Lines::of(text) {
        end = Place::of(&line, 0, 0);
        let content = uncommented(line.text);
        let first = content.bytes().find(|byte| !is_blank(*byte));
        match (&mut named, first) {
            (_, None) => {}
            (None, Some(b'[')) => {}
            (None, Some(_)) if content.contains('=') => constants.extend(constant(&line, content, rows)),
            (None, Some(_)) => {
                cut(content, &mut cells);
                names = cells.iter().map(|cell| name(&line, content, *cell)).collect();
                named = Some(Named::new(Format::Apsim, &names, &constants, text, rows, &line));
            }
            (Some(named), Some(b'(')) if !has_units => {
                has_units = true;
                units(&line, content, &names, named, rows);
            }
            (Some(named), Some(_)) => {
                has_units = true;
                cut(content, &mut cells);
                if cells.len() == named.len() {
                    named.row(&line, &cells, rows);
                } else {
                    named.wrong_length(&line, cells.len(), rows);
                }
            }
        }
    }
    let Some(named) = named else {
        let expected = "a line of names such as `year day radn maxt mint rain`";
        rows.faults.tell(Kind::Layout, end, "no line names the columns", expected);
        return (Station::default(), Vec::new());
    };
    (named.station, named.unused)
}

/// A line without the comment at its end.
#[inline]
fn uncommented(text: &str) -> &str {
    text.split_once('!').map_or(text, |(content, _)| content)
}

/// What stands between blanks.
#[inline]
fn cut(content: &str, cells: &mut Cells) {
    cells.clear();
    let (bytes, mut at) = (content.as_bytes(), 0);
    while at < bytes.len() {
        if is_blank(bytes[at]) {
            at += 1;
            continue;
        }
        let start = at;
        while bytes.get(at).is_some_and(|byte| !is_blank(*byte)) {
            at += 1;
        }
        cells.push((start as u32, at as u32));
    }
}

fn name(line: &Line<'_>, content: &str, (start, end): (u32, u32)) -> Name {
    let (start, end) = (start as usize, end as usize);
    Name { text: content.get(start..end).unwrap_or("").to_owned(), place: Place::of(line, start, end) }
}

/// `name = value (unit)`: the name, and where the value stands.
fn constant(line: &Line<'_>, content: &str, rows: &mut Rows<'_>) -> Option<(Name, Place)> {
    let (key, rest) = content.split_once('=')?;
    let (value, unit) = rest.split_once('(').map_or((rest, ""), |(value, unit)| (value, unit.trim_end()));
    let offset = key.len() + 1 + value.len() - value.trim_start().len();
    let key_start = key.len() - key.trim_start().len();
    let name =
        Name { text: trimmed(key).to_owned(), place: Place::of(line, key_start, key.trim_end().len().max(key_start)) };
    let place = Place::of(line, offset, offset + value.trim().len());
    let column = column(Format::Apsim, &name.text);
    let unit = unit.trim_end_matches(')');
    if let Some((quantity, expected)) = unit_of(column).filter(|_| !unit_is_known(column, unit)) {
        let problem = format!("the {} is in `{}`", quantity.words(), unit.escape_default());
        rows.faults.tell(Kind::Layout, Place::whole(line), problem, format!("({expected}), as APSIM has it"));
    }
    Some((name, place))
}

/// Checks the line of units, one for each name.
fn units(line: &Line<'_>, content: &str, names: &[Name], named: &mut Named, rows: &mut Rows<'_>) {
    let mut at = 0;
    for name in names {
        let Some(open) = content.get(at..).and_then(|rest| rest.find('(')).map(|open| at + open) else { return };
        let close = content[open..].find(')').map_or(content.len(), |close| open + close);
        let (unit, place) = (content.get(open + 1..close).unwrap_or(""), Place::of(line, open, close));
        at = close;
        let column = column(Format::Apsim, &name.text);
        if column == Column::Date && unit.to_lowercase().starts_with('d') {
            named.order = Order::DayFirst;
        }
        if let Some((quantity, expected)) = unit_of(column).filter(|_| !unit_is_known(column, unit)) {
            let problem = format!("the {} is in `{}`", quantity.words(), unit.escape_default());
            rows.faults.tell(Kind::Layout, place, problem, format!("({expected}), as APSIM has it"));
        }
    }
}
