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
    use std::fmt::Write;
    if number.fract() == 0.0 && number.abs() < 1e15 {
        let _ = write!(out, "{}", number as i64);
        return;
    }
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
        // A file in centimetres and a description in metres.
        for k in 1..2000 {
            let metres = f64::from(k) * 0.000_123_456_7;
            let once = text(metres * 100.0, 9);
            assert_eq!(text(once.parse::<f64>().unwrap() / 100.0 * 100.0, 9), once);
        }
    }
}
