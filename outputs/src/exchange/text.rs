//! What texts of all formats need: characters of bytes, and places of bytes.

use super::report::Report;
use std::borrow::Cow;

/// The characters of a file: UTF-8, with or without its mark, else Latin-1 with a warning. Never fails.
pub fn decoded<'a>(bytes: &'a [u8], report: &mut Report) -> Cow<'a, str> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(error) => {
            let line = bytes[..error.valid_up_to()].iter().filter(|byte| **byte == b'\n').count() + 1;
            report.warn((line, 0), "latin-1", "the file is not UTF-8 and is read as Latin-1");
            Cow::Owned(bytes.iter().map(|byte| char::from(*byte)).collect())
        }
    }
}

/// Line and column of a byte, both from 1; the column in characters. In time of the bytes before it.
pub fn place_of(text: &str, byte: usize) -> (usize, usize) {
    let before = &text[..text.floor_char_boundary(byte)];
    let start = before.rfind('\n').map_or(0, |end| end + 1);
    (before.matches('\n').count() + 1, before[start..].chars().count() + 1)
}

/// What stands in a text, for a message: at most 40 characters, none of which steers a terminal.
pub fn said(text: &str) -> String {
    let clipped: String = text.chars().filter(|c| !c.is_control()).take(40).collect();
    if text.chars().nth(40).is_some() { format!("{clipped}…") } else { clipped }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_that_are_no_utf_8_are_latin_1() {
        let mut report = Report::new("x");
        assert_eq!(decoded(b"ann\xe9e", &mut report), "ann\u{e9}e");
        assert_eq!(report.warnings().len(), 1);
        assert_eq!(decoded(b"\xef\xbb\xbfa", &mut Report::new("x")), "a");
    }
}
