//! Streams of whole numbers, the form in which all data of a page are stored.
//!
//! A number is zigzagged (0, −1, 1, −2 become 0, 1, 2, 3) and written in groups of seven bits, the lowest first, of
//! which all but the last have their eighth bit set. What is alike stands in one stream, as differences where
//! neighbours are near each other, so that the compression of the page finds it. Measures become whole numbers on
//! a linear scale, or on a logarithmic one, whose steps are two hundredths of the measure.

use phytomer_sim::math::log2;

/// The steps of the logarithmic scale in an octave.
pub const OCTAVE: f64 = 32.0;
/// The least measure of the logarithmic scale, in units of its column: smaller ones count as nothing.
pub const LEAST: f64 = 1e-12;

/// A stream of whole numbers.
#[derive(Debug, Clone, Default)]
pub struct Stream(Vec<u8>);

impl Stream {
    /// Adds a number.
    #[inline]
    pub fn put(&mut self, number: i64) {
        let mut rest = ((number << 1) ^ (number >> 63)) as u64;
        while rest >= 0x80 {
            self.0.push(rest as u8 | 0x80);
            rest >>= 7;
        }
        self.0.push(rest as u8);
    }
}

/// Streams by their names.
#[derive(Debug, Default)]
pub struct Streams(Vec<(String, Vec<u8>)>);

impl Streams {
    /// Adds some streams under a common name.
    pub fn add<const N: usize>(&mut self, of: &str, streams: [(&str, Stream); N]) {
        self.0.extend(streams.into_iter().map(|(name, Stream(bytes))| (format!("{of}.{name}"), bytes)));
    }

    /// The name and the length of each stream, bytes, in their order.
    pub fn lengths(&self) -> impl Iterator<Item = (&str, usize)> {
        self.0.iter().map(|(name, bytes)| (name.as_str(), bytes.len()))
    }

    /// All streams, one after another.
    pub fn bytes(&self) -> impl Iterator<Item = &[u8]> {
        self.0.iter().map(|(_, bytes)| bytes.as_slice())
    }
}

/// A number that was put, and the difference to the next.
#[derive(Debug, Clone, Copy, Default)]
pub struct Last(i64);

impl Last {
    /// The difference of a number to the one before, which it replaces.
    #[inline]
    pub fn step(&mut self, number: i64) -> i64 {
        number.wrapping_sub(std::mem::replace(&mut self.0, number))
    }
}

/// A place on a linear scale of this step; what is no number is 0.
#[inline]
pub fn linear(value: f64, step: f64) -> i64 {
    let places = value / step;
    (places + if places < 0.0 { -0.5 } else { 0.5 }) as i64
}

/// A measure on the logarithmic scale: 0 for nothing, else 1 and more.
#[inline]
pub fn logarithmic(value: f64) -> i64 {
    if value > LEAST { 1 + linear(OCTAVE * log2(value / LEAST), 1.0) } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_any_size_have_their_bytes() {
        let mut stream = Stream::default();
        for number in [0, -1, 1, -64, 64, i64::MAX, i64::MIN] {
            stream.put(number);
        }
        assert_eq!(stream.0[..6], [0, 1, 2, 127, 0x80, 1]);
        assert_eq!(stream.0.len(), 6 + 10 + 10);
    }

    #[test]
    fn measures_come_back_within_a_step() {
        for value in [1e-9, 3.7e-4, 0.02, 1.0, 812.5] {
            let code = logarithmic(value);
            let back = LEAST * phytomer_sim::math::exp((code - 1) as f64 / OCTAVE * std::f64::consts::LN_2);
            assert!((back / value - 1.0).abs() < 0.011, "{value} {back}");
        }
        assert_eq!([0.0, -1.0, f64::NAN, 1e-13].map(logarithmic), [0; 4]);
        assert_eq!([0.26, -0.26, 0.24].map(|x| linear(x, 0.5)), [1, -1, 0]);
        assert_eq!([f64::NAN, f64::INFINITY].map(|x| linear(x, 0.5)), [0, i64::MAX]);
    }

    #[test]
    fn steps_add_up() {
        let mut last = Last::default();
        assert_eq!([5, 3, 3, -9].map(|number| last.step(number)), [5, -2, 0, -12]);
    }
}
