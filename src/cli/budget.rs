//! How fine a mesh is: `--tolerance`, a length with its unit, or `--triangles`, a count of which k and M are thousands
//! and millions.
//!
//! A bare length is refused, since metres, centimetres and millimetres are all meant by some. Absent: how wood is
//! simplified, and the search for the tolerance, which are `phytomer_outputs::meshes`'.

use super::{Misuse, amounts};
use clap::Args;
use phytomer_outputs::meshes::{Tolerance, TooFew};

/// The units of lengths, in metres.
const UNITS: [(&str, f64); 5] = [("mm", 1e-3), ("cm", 1e-2), ("µm", 1e-6), ("um", 1e-6), ("m", 1.0)];

/// The largest tolerance, metres: larger than any plant.
const MOST_TOLERANCE: f64 = 100.0;

/// The triangles that a mesh may have.
#[derive(Debug, Clone, Args)]
pub struct Budget {
    /// Draw the wood with as few triangles as a distance allows, such as 1mm: internodes of an axis become one tube
    /// while its line and its radius stay within it.
    #[arg(long, value_name = "LENGTH", value_parser = tolerance, allow_hyphen_values = true, conflicts_with_all = ["triangles", "sides"])]
    tolerance: Option<f32>,
    /// At most so many triangles, such as 200k: the wood is drawn as finely as they allow. Leaves, flowers and fruits
    /// keep theirs.
    #[arg(long, value_name = "COUNT", value_parser = triangles, allow_hyphen_values = true, conflicts_with = "sides")]
    triangles: Option<u64>,
}

/// What is asked of the wood of a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Asked {
    /// Each internode by itself.
    Full,
    /// Within a tolerance.
    Within(Tolerance),
    /// At most so many triangles.
    Triangles(u64),
}

impl Budget {
    /// What is asked for.
    pub fn asked(&self) -> Asked {
        let within = self.tolerance.map(|distance| Asked::Within(Tolerance::of(distance)));
        within.or(self.triangles.map(Asked::Triangles)).unwrap_or(Asked::Full)
    }
}

/// That a mesh needs more triangles than it may have.
pub fn too_few(most: u64, what: &str, TooFew { least }: TooFew) -> Misuse {
    let [most, least] = [most, least].map(amounts::count);
    Misuse(format!("--triangles {most}: {what} has at least {least} triangles, with leaves, flowers and fruits"))
}

/// The tolerance of a mesh, to be told.
pub fn in_words(tolerance: Option<&Tolerance>) -> String {
    tolerance.map(|within| format!(", wood within {}", length(f64::from(within.distance)))).unwrap_or_default()
}

/// A length with three digits in the unit that people would take.
pub fn length(metres: f64) -> String {
    let (number, unit) = match metres {
        m if m >= 0.9995 => (m, "m"),
        m if m >= 0.099_95 => (m * 100.0, "cm"),
        m if m >= 0.000_999_5 => (m * 1000.0, "mm"),
        m => (m * 1e6, "µm"),
    };
    let places = if number < 9.995 { 2 } else { usize::from(number < 99.95) };
    let digits = format!("{number:.places$}");
    let short = if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { &digits };
    format!("{short} {unit}")
}

/// A tolerance in metres.
///
/// # Errors
/// What is expected.
pub fn tolerance(text: &str) -> Result<f32, String> {
    let metres = metres(text)?;
    let within = f64::from(Tolerance::LEAST)..=MOST_TOLERANCE;
    // A bound of single precision is a little above the number that it is written as.
    if !within.contains(&(metres * (1.0 + 1e-6))) {
        return Err(format!("a length from {} to {} is expected", length(*within.start()), length(*within.end())));
    }
    Ok(metres as f32)
}

fn metres(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let end =
        text.find(|letter: char| letter.is_alphabetic() && !letter.eq_ignore_ascii_case(&'e')).unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    let expected = "a number with its unit is expected, such as 1mm or 0.5cm";
    let number: f64 = number.trim().parse().map_err(|_| expected.to_owned())?;
    let known = || UNITS.map(|(name, _)| name).join(", ");
    match UNITS.iter().find(|(name, _)| *name == unit) {
        Some((_, scale)) => Ok(number * scale),
        None if unit.is_empty() => Err(format!("its unit is missing; {expected}")),
        None => Err(format!("`{unit}` is no unit of length; the units that there are: {}", known())),
    }
}

/// A count, also in thousands (k) and millions (M).
///
/// # Errors
/// What is expected.
pub fn triangles(text: &str) -> Result<u64, String> {
    let expected = "a count from 1 on is expected, such as 200000, 200k or 1.5M";
    let scales = [('k', 1e3), ('K', 1e3), ('M', 1e6)];
    let scaled = scales.iter().find_map(|(letter, scale)| Some((text.strip_suffix(*letter)?, *scale)));
    let (number, scale) = scaled.unwrap_or((text, 1.0));
    let count = number.trim().parse::<f64>().map_err(|_| expected.to_owned())? * scale;
    if (1.0..=1e15).contains(&count) && count.fract() == 0.0 { Ok(count as u64) } else { Err(expected.to_owned()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_have_units() {
        for (text, metres) in
            [("1mm", 1e-3), ("0.5 cm", 5e-3), ("2e-3m", 2e-3), ("10µm", 1e-5), ("20um", 2e-5), (".5mm", 5e-4)]
        {
            let found = tolerance(text).unwrap_or_else(|fault| panic!("{text}: {fault}"));
            assert!((f64::from(found) / metres - 1.0).abs() < 1e-6, "{text}: {found}");
        }
        for (text, told) in [
            ("1", "its unit is missing"),
            ("1 furlong", "`furlong` is no unit of length; the units that there are: mm, cm, µm, um, m"),
            ("1MM", "`MM` is no unit"),
            ("mm", "a number with its unit is expected"),
            ("", "a number with its unit is expected"),
            ("1,5mm", "a number with its unit is expected"),
            ("0mm", "a length from 10 µm to 100 m is expected"),
            ("-1mm", "a length from 10 µm to 100 m is expected"),
            ("1um", "a length from 10 µm to 100 m is expected"),
            ("101m", "a length from 10 µm to 100 m is expected"),
            ("NaN mm", "a number with its unit is expected"),
            ("inf", "a number with its unit is expected"),
            ("1e999mm", "a length from 10 µm to 100 m is expected"),
        ] {
            let fault = tolerance(text).expect_err(text);
            assert!(fault.contains(told), "{text}: {fault}");
        }
    }

    #[test]
    fn counts_are_whole() {
        for (text, count) in
            [("1", 1), ("200k", 200_000), ("1.5M", 1_500_000), ("0.25K", 250), ("3000000000", 3_000_000_000)]
        {
            assert_eq!(triangles(text), Ok(count), "{text}");
        }
        for text in ["0", "-5", "1.5", "NaN", "inf", "200 000", "k", "", "1e30", "0.0001k", "2G"] {
            assert!(triangles(text).is_err(), "{text}");
        }
    }

    #[test]
    fn lengths_are_told_with_three_digits() {
        let told = [1e-5, 0.000_999, 0.001, 0.0137, 0.1, 0.255, 0.9999, 12.34].map(length);
        assert_eq!(told, ["10 µm", "999 µm", "1 mm", "13.7 mm", "10 cm", "25.5 cm", "1 m", "12.3 m"]);
    }
}
