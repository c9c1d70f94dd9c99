//! What texts of all formats need: characters of bytes, places of bytes, and numbers in plain decimals.

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

/// A number in plain decimals with at most so many places, without zeros at its end, sign of zero or exponent; `None`
/// where it is no finite number.
pub fn plain(number: f64, places: usize) -> Option<String> {
    if !number.is_finite() {
        return None;
    }
    // Most numbers fit into a whole number of the last place, which is written much faster than any number is.
    let whole = POWERS.get(places).map(|power| (number * power).round());
    if let Some(whole) = whole.filter(|whole| whole.abs() < MOST_WHOLE) {
        return Some(of_whole(whole as i64, places));
    }
    let mut text = format!("{number:.places$}");
    if text.contains('.') {
        text.truncate(text.trim_end_matches('0').trim_end_matches('.').len());
    }
    Some(if text == "-0" { "0".to_owned() } else { text })
}

/// The powers of ten, up to as many places as fast numbers have.
const POWERS: [f64; 13] = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12];

/// Whole numbers below this are exact in double precision, with a bit to spare.
const MOST_WHOLE: f64 = 4e15;

/// A whole number of units of the last of so many places.
fn of_whole(number: i64, places: usize) -> String {
    let mut digits = [b'0'; 24];
    let (mut rest, mut at) = (number.unsigned_abs(), digits.len());
    while rest > 0 || digits.len() - at <= places {
        at -= 1;
        digits[at] = b'0' + (rest % 10) as u8;
        rest /= 10;
    }
    let (whole, fraction) = digits[at..].split_at(digits.len() - at - places);
    let kept = fraction.iter().rposition(|digit| *digit != b'0').map_or(0, |last| last + 1);
    let mut text = String::with_capacity(whole.len() + kept + 2);
    if number < 0 {
        text.push('-');
    }
    text.extend(whole.iter().map(|digit| char::from(*digit)));
    if kept > 0 {
        text.push('.');
        text.extend(fraction[..kept].iter().map(|digit| char::from(*digit)));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_no_exponent() {
        let plain = |number| plain(number, 9).unwrap();
        assert_eq!(plain(1e5), "100000");
        assert_eq!(plain(-0.000_000_000_1), "0");
        assert_eq!(plain(0.125), "0.125");
        assert_eq!(plain(100.0), "100");
        assert_eq!(plain(0.0), "0");
        assert_eq!(plain(-1.5), "-1.5");
        assert_eq!(plain(-0.000_000_25), "-0.00000025");
        assert_eq!(plain(12_345.678_901_234_5), "12345.678901235");
        assert_eq!(plain(1e15), "1000000000000000");
        assert_eq!(super::plain(7.0, 0).as_deref(), Some("7"));
        assert_eq!(super::plain(f64::NAN, 3), None);
    }

    #[test]
    fn a_number_of_single_precision_is_written_the_same_again() {
        let mut word = 0x9e37_79b9_7f4a_7c15_u64;
        for _ in 0..200_000 {
            word = word.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
            let number = f32::from_bits((word >> 32) as u32);
            if !number.is_finite() || number.abs() > 1e9 {
                continue;
            }
            for places in [6, 9, 12] {
                let once = super::plain(f64::from(number), places).unwrap();
                let read: f64 = once.parse().unwrap();
                assert!(
                    (read - f64::from(number)).abs() <= 0.6 / POWERS[places] + 1e-15 * read.abs(),
                    "{number} {once}"
                );
                assert_eq!(super::plain(f64::from(read as f32), places).unwrap(), once);
            }
        }
    }

    #[test]
    fn bytes_that_are_no_utf_8_are_latin_1() {
        let mut report = Report::new("x");
        assert_eq!(decoded(b"ann\xe9e", &mut report), "ann\u{e9}e");
        assert_eq!(report.warnings().len(), 1);
        assert_eq!(decoded(b"\xef\xbb\xbfa", &mut Report::new("x")), "a");
    }
}
