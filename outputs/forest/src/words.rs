//! The words of a text with their places, one after another.
//!
//! Absent: what they mean.

use crate::fault::Where;

/// Goes through the words of a text of bytes.
pub(crate) struct Words<'b> {
    bytes: &'b [u8],
    /// The next byte.
    pub at: usize,
    line: usize,
    line_start: usize,
    comments: bool,
}

impl<'b> Words<'b> {
    /// The words from the beginning; with comments from `#` to the end of a line, or without.
    pub fn of(bytes: &'b [u8], comments: bool) -> Self {
        Self { bytes, at: 0, line: 1, line_start: 0, comments }
    }

    /// The next word and its place; the place of the end where there is none.
    pub fn next(&mut self) -> (Where, Option<&'b [u8]>) {
        let mut comment = false;
        while let Some(&byte) = self.bytes.get(self.at) {
            comment = (comment || (self.comments && byte == b'#')) && byte != b'\n';
            if byte == b'\n' {
                self.line += 1;
                self.line_start = self.at + 1;
            } else if !comment && !byte.is_ascii_whitespace() {
                break;
            }
            self.at += 1;
        }
        let (start, place) = (self.at, Where::Text(self.line, self.at - self.line_start + 1));
        let rest = self.bytes.get(start..).unwrap_or_default();
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        self.at += length;
        (place, Some(&rest[..length]).filter(|word| !word.is_empty()))
    }

    /// The same text from an earlier byte on.
    pub fn back_to(&self, at: usize) -> Self {
        let passed = self.bytes.get(..at).unwrap_or_default();
        let line = passed.iter().filter(|byte| **byte == b'\n').count() + 1;
        let line_start = passed.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1);
        Self { bytes: self.bytes, at, line, line_start, comments: self.comments }
    }

    /// The next word as a number.
    pub fn number(&mut self) -> (Where, Option<f64>) {
        let (place, word) = self.next();
        (place, word.and_then(number))
    }
}

/// A finite number.
pub(crate) fn number(word: &[u8]) -> Option<f64> {
    let number = std::str::from_utf8(word).ok()?.parse::<f64>().ok()?;
    number.is_finite().then_some(number)
}

/// A word for a message.
pub(crate) fn said(word: Option<&[u8]>) -> String {
    match word {
        None => "the end of the file".to_owned(),
        Some(word) => {
            let text: String = String::from_utf8_lossy(&word[..word.len().min(40)]).into_owned();
            format!("`{}`", text.chars().filter(|c| !c.is_control()).collect::<String>())
        }
    }
}
