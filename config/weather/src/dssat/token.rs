//! The values of a line of a DSSAT file: what stands between blanks, and what a minus parts.
//!
//! A minus behind a digit, a point or a star begins a new value: `-0.20-10.40` are two. What follows the values is a
//! note, from the first text behind the last header on, or from a `!` anywhere. Absent: where the headers are.

/// Bytes of a line without a blank.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Token {
    /// Where it begins.
    pub start: u32,
    /// Where it ends.
    pub end: u32,
    /// How many points are in it.
    pub points: u32,
}

impl Token {
    /// Its bytes.
    #[inline]
    pub fn of<'l>(&self, line: &'l [u8]) -> &'l [u8] {
        line.get(self.start as usize..self.end as usize).unwrap_or_default()
    }
}

/// Whether a byte is a blank.
#[inline]
fn is_blank(byte: u8) -> bool {
    byte <= b' ' || byte == 0x7f
}

/// The values of a line; whether a tab stands between two of them.
#[inline]
pub(super) fn tokens(line: &[u8], found: &mut Vec<Token>) -> bool {
    found.clear();
    let (mut tabs, mut tab, mut at) = (false, false, 0);
    while at < line.len() {
        let byte = line[at];
        if is_blank(byte) {
            tab |= byte == b'\t';
            at += 1;
            continue;
        }
        if byte == b'!' {
            break;
        }
        tabs |= tab && !found.is_empty();
        let (start, mut points) = (at, 0);
        while let Some(&byte) = line.get(at).filter(|byte| !is_blank(**byte)) {
            if byte == b'-' && at > start && matches!(line[at - 1], b'0'..=b'9' | b'.' | b'*') {
                break;
            }
            points += u32::from(byte == b'.');
            at += 1;
        }
        tab = false;
        found.push(Token { start: start as u32, end: at as u32, points });
    }
    tabs
}

/// Takes the note behind the values away: what follows the first text that begins behind `end`.
#[inline]
pub(super) fn without_note(line: &[u8], found: &mut Vec<Token>, end: u32) {
    let is_note = |token: &Token| {
        token.start > end && !matches!(line[token.start as usize], b'0'..=b'9' | b'-' | b'+' | b'.' | b'*')
    };
    if found.last().is_some_and(|last| last.end > end)
        && let Some(note) = found.iter().position(is_note)
    {
        found.truncate(note);
    }
}

/// Whether it is a mark that nothing was measured: −99, with or without what follows.
pub(super) fn is_mark(token: &[u8]) -> bool {
    crate::number::cell(token, b'.').0 == crate::number::Cell::Missing
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(line: &str) -> Vec<String> {
        let mut found = Vec::new();
        tokens(line.as_bytes(), &mut found);
        without_note(line.as_bytes(), &mut found, 20);
        found.iter().map(|token| String::from_utf8_lossy(token.of(line.as_bytes())).into_owned()).collect()
    }

    #[test]
    fn a_minus_parts_values_and_notes_follow_them() {
        assert_eq!(split("95001 -0.20-10.40  1e-2"), ["95001", "-0.20", "-10.40", "1e-2"]);
        assert_eq!(split("95001 *****-10.4"), ["95001", "*****", "-10.4"]);
        assert_eq!(split("95001  5.0  6.0       Ames 8 WSW"), ["95001", "5.0", "6.0"]);
        assert_eq!(split("95001  5.0 text"), ["95001", "5.0", "text"]);
        assert_eq!(split("95001  5.0 ! 7.0"), ["95001", "5.0"]);
        assert!(split(" \t\0").is_empty());
    }
}
