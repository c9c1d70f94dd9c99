//! CSV: a line of names, then a row a day; the separator is the one that the names have most of.
//!
//! Commas, semicolons and tabs separate; with semicolons a comma is the decimal point, as tables of half of Europe have
//! it. Lines that begin with `#` or `!` are comments. A value may stand in quotes, which hold separators and no end of
//! a line. An empty cell is a day on which nothing was measured. Absent: units, which are those of the ICASA
//! dictionary.

use crate::asked::Format;
use crate::fault::{Kind, Place};
use crate::named::{Cells, Name, Named};
use crate::rows::Rows;
use crate::text::{Line, Lines, is_blank};
use crate::weather::Station;

/// Reads the lines of a file into rows; what it says of its station, and the columns that are not read.
pub(crate) fn read(text: &str, rows: &mut Rows<'_>) -> (Station, Vec<String>) {
    let (mut named, mut separator, mut cells, mut end) = (None, b',', Cells::new(), Place::default());
    for line in Lines::of(text) {
        end = Place::of(&line, 0, 0);
        if matches!(line.text.as_bytes().first(), None | Some(b'#' | b'!')) || line.is_blank() {
            continue;
        }
        let Some(named) = &mut named else {
            separator = most(line.text);
            cut(line.text.as_bytes(), separator, &mut cells);
            let names: Vec<Name> = cells.iter().map(|cell| name(&line, *cell)).collect();
            let mut columns = Named::new(Format::Csv, &names, &[], text, rows, &line);
            columns.point = if separator == b';' && !has_points(text) { b',' } else { b'.' };
            named = Some(columns);
            continue;
        };
        cut(line.text.as_bytes(), separator, &mut cells);
        // Spreadsheets end rows with separators for cells that nobody filled.
        while cells.len() > named.len() && cells.last().is_some_and(|(start, end)| start == end) {
            cells.pop();
        }
        match cells.len() == named.len() {
            true => named.row(&line, &cells, rows),
            false => named.wrong_length(&line, cells.len(), rows),
        }
    }
    let Some(named) = named else {
        rows.faults.tell(Kind::Layout, end, "no line names the columns", "a line such as `W_DATE,SRAD,TMAX,TMIN,RAIN`");
        return (Station::default(), Vec::new());
    };
    (named.station, named.unused)
}

/// The separator that a line has most of.
fn most(names: &str) -> u8 {
    let count = |separator: &u8| names.bytes().filter(|byte| byte == separator).count();
    [b'\t', b';', b','].into_iter().max_by_key(count).unwrap_or(b',')
}

/// Whether a digit follows a point anywhere: then the point is the decimal point.
fn has_points(text: &str) -> bool {
    let decimal = |line: &str| {
        let cells = line.split(';').map(str::trim);
        cells.clone().any(|cell| cell.parse::<f64>().is_ok() && cell.contains('.'))
    };
    text.lines().filter(|line| !line.starts_with(['#', '!'])).take(1000).any(decimal)
}

fn name(line: &Line<'_>, (start, end): (u32, u32)) -> Name {
    let (start, end) = (start as usize, end as usize);
    Name { text: line.text.get(start..end).unwrap_or("").to_owned(), place: Place::of(line, start, end) }
}

/// The cells of a line, without the blanks and quotes around them.
#[inline]
fn cut(line: &[u8], separator: u8, cells: &mut Cells) {
    cells.clear();
    let (mut start, mut is_quoted) = (0, false);
    for (at, byte) in line.iter().enumerate() {
        if *byte == b'"' {
            is_quoted = !is_quoted;
        } else if *byte == separator && !is_quoted {
            cells.push(bare(line, start, at));
            start = at + 1;
        }
    }
    cells.push(bare(line, start, line.len()));
}

#[inline]
fn bare(line: &[u8], mut start: usize, mut end: usize) -> (u32, u32) {
    let is_around = |byte: u8| is_blank(byte) || byte == b'"';
    while start < end && is_around(line[start]) {
        start += 1;
    }
    while end > start && is_around(line[end - 1]) {
        end -= 1;
    }
    (start as u32, end as u32)
}
