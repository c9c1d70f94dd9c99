//! From the bytes of a file to its weather: the format, the text, its rows, their order.
//!
//! Absent: everything that a format has of its own.

use crate::asked::{Asked, Format};
use crate::fault::{Kind, Place, Refused};
use crate::rows::Rows;
use crate::text::{decode, is_blank};
use crate::weather::Weather;
use crate::{csv, dssat, met, series};

/// The end of a text in files of CP/M and DOS.
const END: char = '\u{1a}';

/// Reads a file of this name, which is not opened: its ending tells the format where `asked` does not.
///
/// # Errors
/// Every fault of the file, with its place in the text that [`decode`] makes of the bytes.
pub fn read(name: &str, bytes: &[u8], asked: &Asked) -> Result<Weather, Refused> {
    if let [0xff, 0xfe, ..] | [0xfe, 0xff, ..] = bytes {
        let mut rows = Rows::of("");
        rows.faults.tell(Kind::Unreadable, Place::default(), "this text is in UTF-16", "UTF-8, or Latin-1");
        return Err(rows.faults.into_refused(name));
    }
    read_text(name, &decode(bytes), asked)
}

/// Reads a text as [`read`] reads bytes.
///
/// # Errors
/// Every fault, with its place in the text.
pub fn read_text(name: &str, text: &str, asked: &Asked) -> Result<Weather, Refused> {
    let mut rows = Rows::of(text);
    let Some(format) = asked.format.or_else(|| Format::of_name(name)) else {
        let problem = format!("the ending of `{name}` is of no weather file");
        let expected = ".WTH (DSSAT), .AgMIP, .met (APSIM), .csv or .tsv, or a `format`";
        rows.faults.tell(Kind::Layout, Place::default(), problem, expected);
        return Err(rows.faults.into_refused(name));
    };
    let (content, rest) = text.split_once(END).unwrap_or((text, ""));
    let (station, unused) = match format {
        Format::Dssat | Format::Agmip => dssat::read(content, format, &mut rows),
        Format::Apsim => met::read(content, &mut rows),
        Format::Csv => csv::read(content, &mut rows),
    };
    if !rest.chars().all(|c| c.is_whitespace() || (c.is_ascii() && is_blank(c as u8))) {
        let end = if text.contains('\n') { '\n' } else { '\r' };
        let line = content.matches(end).count() as u32 + 1;
        let line_start = content.rfind(end).map_or(0, |end| end + 1);
        let start = (content.len() - line_start) as u32;
        let place = Place { line, line_start, start, end: start + 1 };
        rows.faults.tell(Kind::Layout, place, "^Z ends the text, and more follows", "nothing but blanks behind it");
    }
    series::weather(rows, station, unused, name, asked)
}
