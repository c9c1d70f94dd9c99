//! Contours (`.con`): the cross sections of generalised cylinders (`@Gs`, `@Gc`, `@Ge`), which `@#` names by number
//! (Měch & Prusinkiewicz, "Extensions to the graphical interpretation of L-systems based on turtle geometry").
//!
//! A contour is a uniform cubic B-spline through no but near all of its points, closed, or open and then without its
//! ends, where the file does not count these three times. Its x lies along the upper side of cpfg, which is −U, its y
//! along −L, and half the width of the line is 1. As in cpfg a closed contour is turned until it begins on the x axis.
//! It is drawn with sides of equal length. Files of before versions (`12 2 closed`) and with one (`cver 1 3`) are read.
//! Absent: a third coordinate, which is passed over, and contours that turn into one another along a cylinder.

use super::text::{Line, TextFault, bounded, full_lines};
use phytomer_looks::Section;

/// The fewest points: those of a cubic.
const FEWEST: usize = 4;
/// The most points, repeated ones included.
const MOST: usize = 4096;
/// The largest coordinate, in halves of the width.
const FARTHEST: f64 = 1e6;
/// Into so many parts each piece of the curve is cut to measure its length.
const PARTS: usize = 16;

/// A cross section.
#[derive(Debug, Clone, PartialEq)]
pub struct Contour {
    points: Vec<[f64; 2]>,
    closed: bool,
}

impl Contour {
    /// Reads a contour.
    ///
    /// # Errors
    /// The first word that is not as it should be.
    pub fn read(text: &str) -> Result<Self, TextFault> {
        bounded(text.len())?;
        let lines: Vec<Line<'_>> = full_lines(text).collect();
        let Some(first) = lines.first() else {
            let problem = "the file is empty".to_owned();
            return Err(TextFault { line: 1, column: 1, problem, expected: "a contour".to_owned() });
        };
        let versioned = first.text.trim_start().starts_with("cver");
        let head = if versioned { Head::labelled(&lines)? } else { Head::of_line(first)? };
        let mut points = Vec::new();
        for line in lines.iter().skip(head.lines).take(head.points) {
            let mut words = line.words();
            let mut coordinate = || {
                let (word, expected) = (words.next(), "a coordinate of a point, from -1000000 to 1000000");
                let number = word.number(expected)?;
                if number.abs() <= FARTHEST { Ok(number) } else { Err(word.fault(expected)) }
            };
            let point = [coordinate()?, coordinate()?];
            let [_, times] = [words.next(), words.next()];
            let often =
                if versioned && !times.text.is_empty() { times.number("how often the point counts")? } else { 1.0 };
            let often = often.clamp(0.0, 2.0 * MOST as f64) as usize;
            if points.len() + often > MOST {
                return Err(times.fault("at most 4096 points"));
            }
            points.extend(std::iter::repeat_n(point, often));
        }
        let end = lines.last().map_or_else(|| first.words().end(), |last| last.words().end());
        let there = lines.len().saturating_sub(head.lines) >= head.points && points.len() >= FEWEST;
        if there {
            Ok(Self { points, closed: head.closed })
        } else {
            Err(end.fault("as many points as the file says, at least four"))
        }
    }

    /// The contour with so many sides.
    pub fn section(&self, sides: u8) -> Section {
        let sides = usize::from(sides.max(3));
        let cuts = self.pieces() * PARTS;
        let at = |cut: usize| self.point(cut as f64 / PARTS as f64);
        let mut lengths = vec![0.0];
        for cut in 0..cuts {
            let ([x, y], [u, v]) = (at(cut), at(cut + 1));
            let so_far = lengths[cut];
            lengths.push(so_far + ((u - x) * (u - x) + (v - y) * (v - y)).sqrt());
        }
        let whole = lengths[cuts];
        let corners = if self.closed { sides } else { sides + 1 };
        let [x, y] = at(0);
        let far = (x * x + y * y).sqrt();
        let [cos, sin] = if self.closed && far > 1e-9 { [x / far, y / far] } else { [1.0, 0.0] };
        let corner = |number: usize| {
            let length = whole * number as f64 / sides as f64;
            let after = lengths.partition_point(|known| *known <= length).clamp(1, cuts);
            let (low, high) = (lengths[after - 1], lengths[after]);
            let share = if high > low { ((length - low) / (high - low)).min(1.0) } else { 0.0 };
            let [x, y] = self.point((after as f64 - 1.0 + share) / PARTS as f64);
            let [x, y] = [cos * x + sin * y, cos * y - sin * x];
            // Up is U, and to the side −L.
            [-x as f32, y as f32]
        };
        Section::of((0..corners).map(corner).collect(), self.closed)
    }

    fn pieces(&self) -> usize {
        if self.closed { self.points.len() } else { self.points.len() - FEWEST + 1 }
    }

    /// The point of the curve at the parameter `t`, a whole number where two pieces meet.
    fn point(&self, t: f64) -> [f64; 2] {
        let piece = (t as usize).min(self.pieces() - 1);
        let u = t - piece as f64;
        let v = 1.0 - u;
        let weights = [v * v * v, 3.0 * u * u * u - 6.0 * u * u + 4.0, 3.0 * v * v * v - 6.0 * v * v + 4.0, u * u * u];
        let of = |k: usize| self.points[(piece + k) % self.points.len()];
        [0, 1].map(|axis| (0..4).map(|k| weights[k] * of(k)[axis]).sum::<f64>() / 6.0)
    }
}

/// What stands before the points.
struct Head {
    /// How many lines it has.
    lines: usize,
    /// How many lines of points follow.
    points: usize,
    closed: bool,
}

impl Head {
    /// A line such as `12 2 closed`.
    fn of_line(line: &Line<'_>) -> Result<Self, TextFault> {
        let mut words = line.words();
        let points = words.whole(FEWEST as i32, MOST as i32, "the number of points, from 4 to 4096")?;
        words.whole(2, 3, "the number of coordinates, 2 or 3")?;
        let word = words.next();
        let closed = closed(word.text).ok_or_else(|| word.fault("`open` or `closed`"))?;
        Ok(Self { lines: 1, points: points as usize, closed })
    }

    /// Lines with labels, of which `points` and `type` are needed; the lines of markers that `markers` counts are
    /// passed over.
    fn labelled(lines: &[Line<'_>]) -> Result<Self, TextFault> {
        let (mut points, mut is_closed, mut at) = (None, None, 1);
        while let Some((label, values)) = lines.get(at).and_then(|line| line.split(':')) {
            let mut words = values.words();
            at += 1;
            match label {
                "points" => points = Some(words.whole(1, MOST as i32, "the number of points, at most 4096")? as usize),
                "type" => {
                    let word = words.next();
                    is_closed = Some(closed(word.text).ok_or_else(|| word.fault("`open` or `closed`"))?);
                }
                "markers" => at += words.whole(0, MOST as i32, "the number of markers")? as usize,
                _ => {}
            }
        }
        let end = lines.get(at).or(lines.last()).map(|line| line.words().next());
        match (points, is_closed, end) {
            (Some(points), Some(closed), _) => Ok(Self { lines: at, points, closed }),
            (_, _, Some(word)) => Err(word.fault("`points:` and `type:` before the points")),
            (_, _, None) => Err(lines[0].words().next().fault("`points:` and `type:`")),
        }
    }
}

/// Whether a word says `closed`, or in the later versions of the format begins with its letter.
fn closed(word: &str) -> Option<bool> {
    match word.chars().next()? {
        'c' => Some(true),
        'o' => Some(false),
        _ => None,
    }
}
