//! Texts of numbers: their words with their bytes, and numbers read and written.

/// The words of a text, each with its byte; `at` is the byte of the text itself.
pub fn words(text: &str, at: usize) -> impl Iterator<Item = (&str, usize)> {
    let start = text.as_ptr() as usize;
    text.split_ascii_whitespace().map(move |word| (word, at + (word.as_ptr() as usize - start)))
}

/// A finite number; `None` for any other word.
pub fn number(word: &str) -> Option<f64> {
    word.parse().ok().filter(|number: &f64| number.is_finite())
}

/// Whether a word stands for a value that is not known.
pub fn is_lacking(word: &str) -> bool {
    word.is_empty() || ["NA", "NaN", "null"].iter().any(|lacking| word.eq_ignore_ascii_case(lacking))
}

/// Adds a number in plain decimals, rounded to so many places, without zeros at its end; `0` where it is not finite.
///
/// What is read again and written again has the same characters, also where a factor went to and fro in between.
pub fn push(out: &mut String, number: f64, places: usize) {
    let units = (number * POWERS[places.min(POWERS.len() - 1)]).round();
    // So far from the limits of double precision, the whole number of units is the nearest one.
    if units.abs() < 1e14 && places < POWERS.len() {
        return push_units(out, units as i64, places);
    }
    push_slowly(out, number, places);
}

/// Powers of ten.
const POWERS: [f64; 13] = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12];

/// Adds a number of units of its last place.
fn push_units(out: &mut String, units: i64, mut places: usize) {
    let mut left = units.unsigned_abs();
    while places > 0 && left.is_multiple_of(10) {
        left /= 10;
        places -= 1;
    }
    // From the last digit to the first: at most fourteen, or a zero and all places, with a point and a sign.
    let mut digits = [b'0'; 20];
    let mut start = digits.len();
    let mut count = 0;
    while left > 0 || count <= places {
        if count == places && places > 0 {
            start -= 1;
            digits[start] = b'.';
        }
        start -= 1;
        digits[start] = b'0' + (left % 10) as u8;
        left /= 10;
        count += 1;
    }
    if units < 0 {
        start -= 1;
        digits[start] = b'-';
    }
    out.push_str(std::str::from_utf8(&digits[start..]).unwrap_or("0"));
}

/// The same for any number.
fn push_slowly(out: &mut String, number: f64, places: usize) {
    use std::fmt::Write;
    let start = out.len();
    let _ = if number.is_finite() { write!(out, "{number:.places$}") } else { write!(out, "0") };
    if out[start..].contains('.') {
        let kept = out[start..].trim_end_matches('0').trim_end_matches('.').len();
        out.truncate(start + kept);
    }
    if &out[start..] == "-0" {
        out.replace_range(start.., "0");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_know_their_bytes() {
        let found: Vec<_> = words(" 1\t-2.5 \n x ", 10).collect();
        assert_eq!(found, [("1", 11), ("-2.5", 13), ("x", 20)]);
        assert_eq!([number("1e-3"), number("inf"), number("NaN"), number("1,5")], [Some(1e-3), None, None, None]);
        assert!(is_lacking("na") && is_lacking("") && !is_lacking("0"));
    }

    #[test]
    fn numbers_are_short_and_stay() {
        let text = |number, places| {
            let mut out = String::from("x");
            push(&mut out, number, places);
            out[1..].to_owned()
        };
        assert_eq!(text(-0.000_000_01, 6), "0");
        assert_eq!(
            [text(-3.0, 6), text(0.1 + 0.2, 9), text(1e16, 2), text(f64::NAN, 2)],
            ["-3", "0.3", "10000000000000000", "0"]
        );
        for number in
            [0.0, 7.0, -7.5, 0.05, 1e-9, -123_456.000_000_001, 99_999.999_999_999_9, 100.0, 0.1, 5e-10, -4e-10]
        {
            for places in [0, 1, 6, 9, 12] {
                let mut slow = String::new();
                push_slowly(&mut slow, number, places);
                assert_eq!(text(number, places), slow, "{number} {places}");
            }
        }
        // A file in centimetres and a description in metres.
        for k in 1..2000 {
            let metres = f64::from(k) * 0.000_123_456_7;
            let once = text(metres * 100.0, 9);
            assert_eq!(text(once.parse::<f64>().unwrap() / 100.0 * 100.0, 9), once);
        }
    }
}
