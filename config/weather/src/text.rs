//! The text of a weather file: its bytes as characters, and its lines.
//!
//! Stations write what their machine writes. Bytes that are no UTF-8 are taken for Latin-1, of which every byte is a
//! character; lines end with LF, CR LF, or CR alone; a byte order mark is passed over; ^Z ends the text, as CP/M and
//! DOS had it, and only blanks may follow it. Every control character is a blank. Absent: UTF-16, which is told.

use memchr::memchr;
use std::borrow::Cow;

/// The characters of a file: UTF-8 where it is that, else Latin-1.
pub fn decode(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|byte| char::from(*byte)).collect()),
    }
}

/// A line without its end.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Line<'t> {
    /// From 1.
    pub number: u32,
    /// Where it begins in the text.
    pub start: usize,
    /// Its characters.
    pub text: &'t str,
}

impl Line<'_> {
    /// Whether nothing stands in it.
    pub fn is_blank(&self) -> bool {
        self.text.bytes().all(is_blank)
    }
}

/// Whether a byte is a blank: a space, a tab, or any other control character.
#[inline]
pub(crate) fn is_blank(byte: u8) -> bool {
    byte <= b' ' || byte == 0x7f
}

/// A text without what is blank at either end.
pub(crate) fn trimmed(text: &str) -> &str {
    text.trim_matches(|c: char| c.is_ascii() && is_blank(c as u8))
}

/// The lines of a text.
pub(crate) struct Lines<'t> {
    text: &'t str,
    at: usize,
    number: u32,
    end: u8,
}

impl<'t> Lines<'t> {
    /// Those of a text.
    pub fn of(text: &'t str) -> Self {
        let at = if text.starts_with('\u{feff}') { '\u{feff}'.len_utf8() } else { 0 };
        Self { text, at, number: 0, end: if text.contains('\n') { b'\n' } else { b'\r' } }
    }
}

impl<'t> Iterator for Lines<'t> {
    type Item = Line<'t>;

    #[inline]
    fn next(&mut self) -> Option<Line<'t>> {
        let rest = self.text.get(self.at..).filter(|rest| !rest.is_empty())?;
        let end = memchr(self.end, rest.as_bytes());
        let (line, taken) = end.map_or((rest, rest.len()), |end| (&rest[..end], end + 1));
        let start = self.at;
        self.at += taken;
        self.number = self.number.saturating_add(1);
        Some(Line { number: self.number, start, text: line.strip_suffix('\r').unwrap_or(line) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &str) -> Vec<(u32, usize, &str)> {
        Lines::of(text).map(|line| (line.number, line.start, line.text)).collect()
    }

    #[test]
    fn lines_end_as_any_machine_ends_them() {
        assert_eq!(lines("a\r\n\nb"), [(1, 0, "a"), (2, 3, ""), (3, 4, "b")]);
        assert_eq!(lines("a\rb\r"), [(1, 0, "a"), (2, 2, "b")]);
        assert_eq!(lines("\u{feff}a\n"), [(1, 3, "a")]);
        assert!(lines("").is_empty());
    }

    #[test]
    fn bytes_that_are_no_utf_8_are_latin_1() {
        assert_eq!(decode("Estação".as_bytes()), "Estação");
        assert_eq!(decode(b"Esta\xe7\xe3o"), "Estação");
    }
}
