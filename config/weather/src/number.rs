//! A cell of a weather file: a value, a mark that nothing was measured, or neither.
//!
//! −99, −999 and −9999, with or without a further nine behind the point, and the words of other programs (`NA`, `nan`,
//! `?`) mean that nothing was measured: no quantity can have such a value. One letter behind a number (`-99m`, `12.5e`)
//! is a flag of the station and says that the value was estimated or is missing. Stars are a number that did not fit
//! its column, as Fortran writes it. Absent: dates and units.

/// What stands in a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Cell {
    /// A value.
    Value(f64),
    /// Nothing was measured.
    Missing,
    /// A number that did not fit.
    Stars,
    /// Something else.
    Text,
}

/// Powers of ten that a double holds exactly.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20,
    1e21, 1e22,
];

/// Digits that a double holds exactly, whatever they are.
const EXACT_DIGITS: usize = 15;

/// Reads a cell, without blanks around it, and whether it bears a flag. `point` is the decimal point.
#[inline]
pub(crate) fn cell(token: &[u8], point: u8) -> (Cell, bool) {
    let (sign, digits) = match token {
        [b'-', rest @ ..] => (-1.0, rest),
        [b'+', rest @ ..] => (1.0, rest),
        _ => (1.0, token),
    };
    let (mut mantissa, mut count, mut decimals, mut at, mut behind) = (0_u64, 0, 0, 0, false);
    while let Some(&byte) = digits.get(at) {
        if byte.is_ascii_digit() {
            mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(byte - b'0'));
            count += 1;
            decimals += usize::from(behind);
        } else if byte == point && !behind {
            behind = true;
        } else {
            break;
        }
        at += 1;
    }
    if count == 0 {
        return (without_digits(token), false);
    }
    let flagged = match &digits[at..] {
        [] => false,
        [letter] if letter.is_ascii_alphabetic() => true,
        _ => return (with_exponent(token, point), false),
    };
    if count > EXACT_DIGITS || decimals >= POWERS.len() {
        let number = &token[..token.len() - usize::from(flagged)];
        return (with_exponent(number, point), flagged);
    }
    // Both are exact, so the quotient is the double nearest to what is written.
    (measured(sign * (mantissa as f64 / POWERS[decimals])), flagged)
}

#[inline]
fn measured(value: f64) -> Cell {
    if value <= -99.0 && is_mark(value) { Cell::Missing } else { Cell::Value(value) }
}

fn is_mark(value: f64) -> bool {
    [-99.0, -99.9, -999.0, -999.9, -9999.0, -9999.9].contains(&value)
}

/// A number in all its forms; what the fast path leaves.
#[cold]
fn with_exponent(token: &[u8], point: u8) -> Cell {
    let plain = |byte: &u8| byte.is_ascii_digit() || b"+-.eE".contains(byte) || *byte == point;
    if token.len() > 64 || !token.iter().all(plain) {
        return Cell::Text;
    }
    let text: String = token.iter().map(|byte| char::from(if *byte == point { b'.' } else { *byte })).collect();
    text.parse().ok().filter(|value: &f64| value.is_finite()).map_or(Cell::Text, measured)
}

#[cold]
fn without_digits(token: &[u8]) -> Cell {
    if !token.is_empty() && token.iter().all(|byte| *byte == b'*') {
        return Cell::Stars;
    }
    let marks: [&[u8]; 7] = [b"", b"na", b"n/a", b"nan", b"null", b"?", b"."];
    if marks.iter().any(|mark| token.eq_ignore_ascii_case(mark)) { Cell::Missing } else { Cell::Text }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> (Cell, bool) {
        cell(text.as_bytes(), b'.')
    }

    #[test]
    fn numbers_are_what_the_standard_library_makes_of_them() {
        for text in
            ["0", "-0.0", ".5", "5.", "12.3", "-10.40", "+7", "113.60", "0.1", "123456789012345", "1e1", "2.5E-1"]
        {
            assert_eq!(read(text), (Cell::Value(text.parse().expect("a number")), false), "{text}");
        }
        for tenths in -9_000..=6_000_i32 {
            let (sign, size) = (if tenths < 0 { "-" } else { "" }, tenths.abs());
            let text = format!("{sign}{}.{}", size / 10, size % 10);
            let value: f64 = text.parse().expect("a number");
            if !is_mark(value) {
                assert_eq!(read(&text), (Cell::Value(value), false), "{text}");
            }
        }
        let long = "0.123456789012345678901234567890";
        assert_eq!(read(long).0, Cell::Value(long.parse().expect("a number")));
    }

    #[test]
    fn marks_flags_and_stars() {
        for text in ["-99", "-99.0", "-99.9", "-999", "-9999.0", "NA", "nan", "", "?"] {
            assert_eq!(read(text), (Cell::Missing, false), "{text}");
        }
        assert_eq!(read("-99m"), (Cell::Missing, true));
        assert_eq!(read("12.5e"), (Cell::Value(12.5), true));
        assert_eq!((read("*****"), read("-98.9")), ((Cell::Stars, false), (Cell::Value(-98.9), false)));
        for text in ["a", "-", "1.2.3", "13.00113.60", "1-2", "12ab", "1e999", "*12", "12*", "--1", "1,2", "1e", "inf"]
        {
            let (cell, flagged) = read(text);
            assert!(cell == Cell::Text || flagged, "{text}: {cell:?}");
        }
        assert_eq!(cell(b"12,5", b','), (Cell::Value(12.5), false));
    }
}
