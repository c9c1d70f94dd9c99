//! Letters with places; line ends, continued lines and comments.
//!
//! A backslash at the end of a line joins the next line to it. `/* … */` is a blank, and nothing where it opens a line,
//! so that a line that begins with a comment does not seem to begin with a blank. `//` is a comment at a line's start
//! or after a blank only: *The Algorithmic Beauty of Plants* writes `]/////[`.

use crate::fault::{Fault, Place};

/// A character, and where it comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Letter {
    /// The character; the end of a line is `\n`.
    pub c: char,
    /// Its place in a file; that of the macro's name where a macro made it.
    pub place: Place,
}

/// The letters of a text without comments and with continued lines joined.
pub(crate) fn letters(text: &str, file: u32, faults: &mut Vec<Fault>) -> Vec<Letter> {
    let raw = joined(text, file);
    let mut kept = Vec::with_capacity(raw.len());
    let mut at = 0;
    while let Some(&letter) = raw.get(at) {
        at = match (letter.c, raw.get(at + 1).map(|next| next.c)) {
            ('/', Some('*')) => block_comment(&raw, at, &mut kept, faults),
            ('/', Some('/')) if may_be_comment(&raw, at) => line_end(&raw, at),
            ('"', _) => string(&raw, at, &mut kept),
            _ => {
                kept.push(letter);
                at + 1
            }
        };
    }
    kept
}

/// The letters of a text, with its continued lines joined and the minus of typesetters told as that of keyboards.
fn joined(text: &str, file: u32) -> Vec<Letter> {
    let mut letters: Vec<Letter> = Vec::with_capacity(text.len());
    let (mut line, mut column) = (1, 1);
    let mut characters = text.trim_start_matches('\u{feff}').chars().peekable();
    while let Some(c) = characters.next() {
        let place = Place { file, line, column };
        column += 1;
        if c == '\r' && characters.peek() == Some(&'\n') {
            continue;
        }
        let c = match c {
            '\r' => '\n',
            '\u{2212}' => '-',
            '\u{2227}' => '^',
            c => c,
        };
        if c == '\n' {
            (line, column) = (line.saturating_add(1), 1);
            if letters.last().is_some_and(|last| last.c == '\\') {
                letters.pop();
                continue;
            }
        }
        letters.push(Letter { c, place });
    }
    letters
}

/// Whether two strokes begin a comment here.
fn may_be_comment(raw: &[Letter], at: usize) -> bool {
    at.checked_sub(1).and_then(|before| raw.get(before)).is_none_or(|before| before.c.is_whitespace())
}

fn line_end(raw: &[Letter], at: usize) -> usize {
    raw[at..].iter().position(|letter| letter.c == '\n').map_or(raw.len(), |length| at + length)
}

/// Passes over a comment that begins at `at`; returns where it ends.
fn block_comment(raw: &[Letter], at: usize, kept: &mut Vec<Letter>, faults: &mut Vec<Fault>) -> usize {
    let opens_line = kept.iter().rev().take_while(|letter| letter.c != '\n').next().is_none();
    let inside = at + 2;
    let Some(length) = raw[inside..].windows(2).position(|pair| pair[0].c == '*' && pair[1].c == '/') else {
        faults.push(Fault::new(raw[at].place, "a comment begins and does not end", "`*/` at its end"));
        return raw.len();
    };
    if !opens_line {
        kept.push(Letter { c: ' ', place: raw[at].place });
    }
    inside + length + 2
}

/// Keeps a text in quotation marks as it is, if it ends in its line; returns where to go on.
fn string(raw: &[Letter], at: usize, kept: &mut Vec<Letter>) -> usize {
    // The search ends with the line, so that many marks in one text are not searched to its end each.
    let close = raw[at + 1..].iter().position(|letter| matches!(letter.c, '"' | '\n'));
    let close = close.filter(|length| raw[at + 1 + length].c == '"');
    let next = close.map_or(at + 1, |length| at + length + 2);
    kept.extend_from_slice(&raw[at..next]);
    next
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(text: &str) -> String {
        letters(text, 0, &mut Vec::new()).iter().map(|letter| letter.c).collect()
    }

    #[test]
    fn strokes_are_a_comment_after_a_blank_alone() {
        assert_eq!(told("A --> [B]/////[C] // told\n// all\nB"), "A --> [B]/////[C] \n\nB");
        assert_eq!(told("/* a\n * b */A/* c */B\r\nC"), "A B\nC");
        assert_eq!(told("printf(\"/* // %f\\n\"); // x"), "printf(\"/* // %f\\n\"); ");
    }

    #[test]
    fn a_backslash_joins_lines_and_places_stay_true() {
        let mut faults = Vec::new();
        let kept = letters("#define X a\\\n\tb\nC /* never", 0, &mut faults);
        let last = kept.iter().find(|letter| letter.c == 'C').map(|letter| letter.place);
        assert_eq!(last, Some(Place { file: 0, line: 3, column: 1 }));
        assert_eq!(kept.iter().filter(|letter| letter.c == '\n').count(), 1);
        assert_eq!(faults[0].place, Place { file: 0, line: 3, column: 3 });
    }
}
