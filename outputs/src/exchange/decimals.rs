//! Numbers in plain decimals: without exponent, without zeros at their end, without the sign of a zero.
//!
//! Files of plants are for the most part numbers, so eight digits at a time are found by a few multiplications.

/// Adds a number, rounded to so many places; `0` where it is not finite.
///
/// What is read again and written again has the same characters, also where a factor went to and fro in between.
pub fn push(out: &mut String, number: f64, places: usize) {
    match POWERS.get(places).and_then(|power| units(number * power)) {
        Some(units) => push_units(out, units, places),
        None => push_slowly(out, number, places),
    }
}

/// Adds the shortest digits that are read as this number again, as `Display` has them; `0` where it is not finite.
pub fn push_shortest(out: &mut String, number: f64) {
    use std::fmt::Write;
    // Decimals of at most fifteen digits are all different in double precision. So one of them that is this number is
    // the shortest, and the division tells whether it is, since it is rounded as reading is.
    let short = units(number * POWERS[SHORT]).filter(|units| *units as f64 / POWERS[SHORT] == number);
    match short {
        Some(0) if number.is_sign_negative() => out.push_str("-0"),
        Some(units) => push_units(out, units, SHORT),
        None if number.is_finite() => _ = write!(out, "{number}"),
        None => out.push('0'),
    }
}

/// The same with a point or an exponent, which tells that it is no whole number by kind, as `Debug` has it.
pub fn push_real(out: &mut String, number: f64) {
    use std::fmt::Write;
    let (start, size) = (out.len(), number.abs());
    // Numbers of other sizes have an exponent.
    if size != 0.0 && !(1e-4..1e16).contains(&size) {
        let _ = write!(out, "{number:?}");
        return;
    }
    push_shortest(out, number);
    if !out[start..].contains('.') {
        out.push_str(".0");
    }
}

/// Adds a whole number.
pub fn push_whole(out: &mut String, number: impl Into<i64>) {
    push_units(out, number.into(), 0);
}

/// Powers of ten, up to as many places as fast numbers have.
const POWERS: [f64; 13] = [1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12];
/// The places of short numbers.
const SHORT: usize = 6;
/// So far from the limits of double precision, the whole number of units is the nearest one.
const MOST_UNITS: f64 = 1e14;

/// The nearest whole number, halves away from zero; `None` where it is large or no number. (`f64::round` is a call on
/// processors that are taken to have no instruction for it.)
fn units(of: f64) -> Option<i64> {
    if of.abs() < MOST_UNITS {
        let whole = of as i64;
        let rest = of - whole as f64;
        Some(whole + i64::from(rest >= 0.5) - i64::from(rest <= -0.5))
    } else {
        None
    }
}

/// Adds a number of units of its last place: sixteen digits at once.
fn push_units(out: &mut String, units: i64, places: usize) {
    use std::fmt::Write;
    let left = units.unsigned_abs();
    let (high, low) = (left / 100_000_000, left % 100_000_000);
    if high >= 100_000_000 {
        // Whole numbers alone are as large.
        let _ = write!(out, "{units}");
        return;
    }
    let mut digits = [0; 16];
    digits[..8].copy_from_slice(&eight(high as u32));
    digits[8..].copy_from_slice(&eight(low as u32));
    if units < 0 {
        out.push('-');
    }
    let text = std::str::from_utf8(&digits).unwrap_or_default();
    let (whole, fraction) = text.split_at(digits.len() - places);
    let first = whole.bytes().position(|digit| digit != b'0').unwrap_or(whole.len() - 1);
    out.push_str(&whole[first..]);
    let kept = fraction.bytes().rposition(|digit| digit != b'0').map_or(0, |last| last + 1);
    if kept > 0 {
        out.push('.');
        out.push_str(&fraction[..kept]);
    }
}

/// The eight digits of a number below 10⁸, as characters: halves, quarters and digits are parted in a word of eight
/// bytes, all parts of one size at once. Dividing by 100 and by 10 is multiplying by 5243 / 2¹⁹ and by 103 / 2¹⁰, exact
/// below 10⁴ and below 100.
fn eight(number: u32) -> [u8; 8] {
    let (high, low) = (u64::from(number / 10_000), u64::from(number % 10_000));
    let fours = high | low << 32;
    let hundreds = ((fours * 5_243) >> 19) & 0x0000_007f_0000_007f;
    let twos = hundreds | (fours - hundreds * 100) << 16;
    let tens = ((twos * 103) >> 10) & 0x000f_000f_000f_000f;
    let ones = tens | (twos - tens * 10) << 8;
    (ones + 0x3030_3030_3030_3030).to_le_bytes()
}

/// The same as [`push`] for any number.
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

    fn text(number: f64, places: usize) -> String {
        let mut out = String::from("x");
        push(&mut out, number, places);
        out[1..].to_owned()
    }

    /// Words that a linear congruence makes.
    fn words() -> impl Iterator<Item = u64> {
        let next = |word: &u64| Some(word.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f));
        std::iter::successors(Some(0x9e37_79b9_7f4a_7c15), next)
    }

    #[test]
    fn eight_digits_are_those_of_the_number() {
        let some = (0..100_000_000).step_by(997).chain(99_990_000..100_000_000).chain(0..10_000);
        for number in some {
            assert_eq!(eight(number).as_slice(), format!("{number:08}").as_bytes());
        }
    }

    #[test]
    fn numbers_are_short_and_stay() {
        assert_eq!(text(-0.000_000_01, 6), "0");
        assert_eq!(
            [text(-3.0, 6), text(0.1 + 0.2, 9), text(1e16, 2), text(f64::NAN, 2), text(1e5, 9), text(7.0, 0)],
            ["-3", "0.3", "10000000000000000", "0", "100000", "7"]
        );
        assert_eq!([text(-0.000_000_25, 9), text(1e15, 9)], ["-0.00000025", "1000000000000000"]);
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

    #[test]
    fn a_number_of_single_precision_is_written_the_same_again() {
        for word in words().take(200_000) {
            let number = f32::from_bits((word >> 32) as u32);
            if !number.is_finite() || number.abs() > 1e9 {
                continue;
            }
            for places in [6, 9, 12] {
                let once = text(f64::from(number), places);
                let read: f64 = once.parse().unwrap();
                assert!(
                    (read - f64::from(number)).abs() <= 0.6 / POWERS[places] + 1e-15 * read.abs(),
                    "{number} {once}"
                );
                assert_eq!(text(f64::from(read as f32), places), once);
            }
        }
    }

    #[test]
    fn the_shortest_digits_are_those_that_display_has() {
        let short = words().map(|word| ((word >> 40) as i32 - (1 << 23)) as f64 / POWERS[(word % 13) as usize]);
        let some = [
            0.0,
            -0.0,
            0.1 + 0.2,
            1e-7,
            5e-324,
            1e300,
            123_456_789.012_345,
            -99_999_999.999_999_9,
            0.5,
            1e-4,
            9.9e-5,
            1e15,
            1e16,
        ];
        for number in some.into_iter().chain(short.take(100_000)).chain(words().take(100_000).map(f64::from_bits)) {
            let mut out = String::new();
            push_shortest(&mut out, number);
            assert_eq!(out, if number.is_finite() { number.to_string() } else { "0".to_owned() });
            out.clear();
            push_real(&mut out, number);
            assert_eq!(out, format!("{number:?}"));
        }
        for number in [0, 7, -1, 10, -99_999_999, 100_000_000, i64::MAX, i64::MIN] {
            let mut out = String::new();
            push_whole(&mut out, number);
            assert_eq!(out, number.to_string());
        }
    }
}
