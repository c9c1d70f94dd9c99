//! Functions (`.func`, and sets of them, `.fset`) that `func(1, x)` or their names call: the graph of a cubic B-spline
//! in the plane, over [0, 1].
//!
//! The knots are uniform and clamped, so that the curve begins at its first point and ends at its last: for n points of
//! a parameter u in [0, n − 3]. The value at x is that of the curve where its first coordinate is x, found by halving
//! u; cpfg instead interpolates between the values at `samples` places. Where a curve turns back it has several values
//! at one x, and the halving finds the same one always. What lies outside [0, 1] has the value of the nearer end.
//! Points may be repeated by a third number in their line. Absent: what calls a function.

use super::text::{Line, TextFault, Words, bounded, full_lines};

/// The fewest points: those of a cubic.
const FEWEST_POINTS: usize = 4;
/// The most points, repeated ones included.
const MOST_POINTS: usize = 4096;
/// The most functions of a set.
const MOST_FUNCTIONS: usize = 1024;
/// As often as this an interval of u is halved, after which it has the length of a rounding.
const HALVINGS: usize = 54;

/// A function.
#[derive(Debug, Clone, PartialEq)]
pub struct Function {
    /// Its name; empty where the file has none.
    pub name: String,
    points: Vec<[f64; 2]>,
}

impl Function {
    /// Reads a file of one function.
    ///
    /// # Errors
    /// The first word that is not as it should be.
    pub fn read(text: &str) -> Result<Self, TextFault> {
        bounded(text.len())?;
        Lines::of(text).function()
    }

    /// Reads a set of functions.
    ///
    /// # Errors
    /// As [`Function::read`].
    pub fn read_set(text: &str) -> Result<Vec<Self>, TextFault> {
        bounded(text.len())?;
        let mut lines = Lines::of(text);
        let first = lines.next("`funcgalleryver` and its version")?;
        if !first.text.trim_start().starts_with("funcgalleryver") {
            return Err(first.words().next().fault("`funcgalleryver` and its version"));
        }
        let (mut words, _) = lines.labelled("items")?;
        let items = words.whole(0, MOST_FUNCTIONS as i32, "the number of functions, at most 1024")?;
        (0..items).map(|_| lines.function()).collect()
    }

    /// The value at `x`.
    pub fn at(&self, x: f64) -> f64 {
        let spans = self.points.len() - FEWEST_POINTS + 1;
        if x.is_nan() || x <= self.points[0][0] {
            return self.points[0][1];
        }
        let [end, value] = self.points[self.points.len() - 1];
        if x >= end {
            return value;
        }
        let (mut low, mut high) = (0.0, spans as f64);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if self.curve(middle)[0] > x { high = middle } else { low = middle }
        }
        self.curve(0.5 * (low + high))[1]
    }

    /// The point of the curve at the parameter `u`, by de Boor's recurrence.
    fn curve(&self, u: f64) -> [f64; 2] {
        let spans = self.points.len() - FEWEST_POINTS + 1;
        let knot = |j: usize| j.saturating_sub(3).min(spans) as f64;
        let span = (u as usize).min(spans - 1);
        let mut points = [0, 1, 2, 3].map(|i| self.points[span + i]);
        for level in 1..=3 {
            for i in (level..=3).rev() {
                let (from, to) = (knot(span + i), knot(span + i + 4 - level));
                let share = (u - from) / (to - from);
                let of = |axis: usize| points[i - 1][axis] * (1.0 - share) + points[i][axis] * share;
                points[i] = [of(0), of(1)];
            }
        }
        points[3]
    }
}

/// The lines that are still to be read.
struct Lines<'t> {
    left: std::vec::IntoIter<Line<'t>>,
    last: Option<Line<'t>>,
}

impl<'t> Lines<'t> {
    fn of(text: &'t str) -> Self {
        Self { left: full_lines(text).collect::<Vec<_>>().into_iter(), last: None }
    }

    fn next(&mut self, expected: &str) -> Result<Line<'t>, TextFault> {
        let line = self.left.next();
        self.last = line.or(self.last);
        line.ok_or_else(|| self.at_end(expected))
    }

    /// A fault at the end of the line that was read last.
    fn at_end(&self, expected: &str) -> TextFault {
        let problem = "the file is empty".to_owned();
        let empty = || TextFault { line: 1, column: 1, problem, expected: expected.to_owned() };
        self.last.map_or_else(empty, |last| last.words().end().fault(expected))
    }

    /// The values of the next line with a label, which must be `label`.
    fn labelled(&mut self, label: &str) -> Result<(Words<'t>, Line<'t>), TextFault> {
        let expected = format!("`{label}:` and its value");
        let line = self.next(&expected)?;
        match line.split(':') {
            Some((found, values)) if found == label => Ok((values.words(), line)),
            _ => Err(line.words().next().fault(&expected)),
        }
    }

    /// A function. Before the format had versions it had a range, which was read as [0, 1], and no name; now it has a
    /// name, and other labels whose values no function needs.
    fn function(&mut self) -> Result<Function, TextFault> {
        let expected = "`fver` and its version, or `range:`";
        let first = self.next(expected)?;
        let begins = |word: &str| first.text.trim_start().starts_with(word);
        let mut name = String::new();
        let mut points = if begins("range") {
            self.labelled("points")?.0
        } else if begins("fver") {
            name = self.labelled("name")?.0.text("a name")?.text.to_owned();
            self.label_after_others("points")?
        } else {
            return Err(first.words().next().fault(expected));
        };
        let count = points.whole(FEWEST_POINTS as i32, MOST_POINTS as i32, "the number of points, from 4 to 4096")?;
        Ok(Function { name, points: self.points(count)? })
    }

    /// The values of the next line with the label, past any other lines.
    fn label_after_others(&mut self, label: &str) -> Result<Words<'t>, TextFault> {
        let expected = format!("`{label}:` and its value");
        loop {
            let line = self.next(&expected)?;
            if let Some((found, values)) = line.split(':')
                && found == label
            {
                return Ok(values.words());
            }
        }
    }

    fn points(&mut self, count: i32) -> Result<Vec<[f64; 2]>, TextFault> {
        let mut points = Vec::new();
        for _ in 0..count {
            let mut words = self.next("a point: two numbers")?.words();
            let point = [words.number("two numbers")?, words.number("two numbers")?];
            let times = words.next();
            let often = if times.text.is_empty() { 1.0 } else { times.number("how often the point counts")? };
            let often = often.clamp(0.0, 2.0 * MOST_POINTS as f64) as usize;
            if points.len() + often > MOST_POINTS {
                return Err(times.fault("at most 4096 points"));
            }
            points.extend(std::iter::repeat_n(point, often));
        }
        if points.len() < FEWEST_POINTS {
            return Err(self.at_end("four points, repeated ones included"));
        }
        Ok(points)
    }
}
