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

/// Lines up to so many bytes are read as masks, a bit a byte.
const MASKED: usize = 64;

/// What the bytes of a line are, a bit a byte, the first lowest.
#[derive(Default)]
struct Masks {
    filled: u64,
    minus: u64,
    points: u64,
    /// Not 0 where a tab, a delete or a `!` stands somewhere.
    rare: u64,
}

/// The same byte eight times.
const fn eight(byte: u8) -> u64 {
    u64::from_le_bytes([byte; 8])
}

/// The highest bit of each byte that is `byte`, exactly.
#[inline]
fn equal(word: u64, byte: u8) -> u64 {
    let differs = word ^ eight(byte);
    !(((differs & eight(0x7f)) + eight(0x7f)) | differs) & eight(0x80)
}

/// The highest bits of eight bytes as eight bits in a row.
#[inline]
fn gathered(highest: u64) -> u64 {
    ((highest >> 7).wrapping_mul(0x0102_0408_1020_4080)) >> 56
}

/// The masks of a line of at most [`MASKED`] bytes, eight bytes at a time and without a branch that depends on them.
#[inline]
fn masks(line: &[u8]) -> Masks {
    let mut masks = Masks::default();
    for (at, chunk) in (0..).step_by(8).zip(line.chunks(8)) {
        let mut bytes = [b' '; 8];
        bytes[..chunk.len()].copy_from_slice(chunk);
        let word = u64::from_le_bytes(bytes);
        // A byte is no blank where it is above the space, be it ASCII or not.
        let filled = (((word & eight(0x7f)) + eight(0x7f - b' ')) | word) & eight(0x80);
        masks.filled |= gathered(filled) << at;
        masks.minus |= gathered(equal(word, b'-')) << at;
        masks.points |= gathered(equal(word, b'.')) << at;
        masks.rare |= equal(word, b'\t') | equal(word, 0x7f) | equal(word, b'!');
    }
    masks
}

/// The values of a line; whether a tab stands between two of them.
#[inline]
pub(super) fn tokens(line: &[u8], found: &mut Vec<Token>) -> bool {
    if line.len() <= MASKED {
        let masks = masks(line);
        let is_parted = masks.minus & (masks.filled << 1) != 0;
        if masks.rare == 0 && !is_parted {
            between_blanks(&masks, found);
            return false;
        }
    }
    byte_by_byte(line, found)
}

/// The values of a line that blanks alone part.
#[inline]
fn between_blanks(masks: &Masks, found: &mut Vec<Token>) {
    found.clear();
    let mut rest = masks.filled;
    while rest != 0 {
        let start = rest.trailing_zeros();
        let length = (!(rest >> start)).trailing_zeros();
        let own = (u64::MAX >> (64 - length)) << start;
        found.push(Token { start, end: start + length, points: (masks.points & own).count_ones() });
        rest &= !own;
    }
}

/// The values of any line.
fn byte_by_byte(line: &[u8], found: &mut Vec<Token>) -> bool {
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

    /// Reading by masks finds what reading byte by byte finds, in lines of every length and of all bytes that matter.
    #[test]
    fn masks_find_the_same_values() {
        let bytes = b"  \t07.9.-!*\x7f\x01\x80\xe9e\n ";
        let mut state = 1988_u64;
        let mut draw = |below: usize| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as usize % below
        };
        for round in 0..20_000 {
            // Every second line has common bytes alone.
            let most = if round % 2 == 0 { bytes.len() } else { 8 };
            let line: Vec<u8> = (0..draw(70)).map(|_| bytes[draw(most)]).filter(|b| most > 8 || *b != b'\t').collect();
            let (mut by_masks, mut by_bytes) = (Vec::new(), Vec::new());
            let tabs = (tokens(&line, &mut by_masks), byte_by_byte(&line, &mut by_bytes));
            assert_eq!((tabs.0, &by_masks), (tabs.1, &by_bytes), "{line:?}");
        }
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
