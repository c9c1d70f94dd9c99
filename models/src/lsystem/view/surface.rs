//! Surfaces (`.s`) that a turtle draws by `~`: Bézier patches of 4 × 4 points (Prusinkiewicz & Lindenmayer 1990 §5.1).
//!
//! The file states the box of its points, a contact point, the heading and the upper side at which it sits on the
//! turtle, and its size; then each patch by its name, its colours, its neighbours (`AL:` …) and 16 points. Here the
//! points are told in the coordinates of the turtle (along the heading, to the left, along the upper side), from the
//! contact point, with the stated size as 1. Names, colours and neighbours are not used. Absent: drawing.

use super::text::{Line, TextFault, bounded, full_lines};
use crate::lsystem::vector::{cross, dot};

/// The most patches of a surface.
const MOST_PATCHES: usize = 256;
/// A direction that is shorter is no direction.
const NO_DIRECTION: f64 = 1e-3;
/// How many steps of a parameter the area of a patch is summed over.
const STEPS: usize = 12;

/// The points of a patch: four rows of four.
pub type Patch = [[[f64; 3]; 4]; 4];

/// A surface in the coordinates of the turtle.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    /// Its patches, at least one.
    pub patches: Vec<Patch>,
}

impl Surface {
    /// Reads a surface.
    ///
    /// # Errors
    /// The first word that is not as it should be: what follows it cannot be judged.
    pub fn read(text: &str) -> Result<Self, TextFault> {
        bounded(text.len())?;
        let mut lines = Lines { left: full_lines(text).collect(), at: 0 };
        let frame = frame(&mut lines)?;
        let mut patches = Vec::new();
        while lines.at < lines.left.len() {
            if patches.len() == MOST_PATCHES {
                return Err(lines.fault(&format!("at most {MOST_PATCHES} patches")));
            }
            patches.push(patch(&mut lines, &frame)?);
        }
        if patches.is_empty() { Err(lines.fault("a patch")) } else { Ok(Self { patches }) }
    }

    /// The point of a patch at the parameters `s` along its rows and `t` along its columns, both in [0, 1].
    pub fn point(patch: &Patch, s: f64, t: f64) -> [f64; 3] {
        let weights = |u: f64| {
            let v = 1.0 - u;
            [v * v * v, 3.0 * u * v * v, 3.0 * u * u * v, u * u * u]
        };
        let (along, across) = (weights(t), weights(s));
        let mut sum = [0.0; 3];
        for (row, weight) in patch.iter().zip(along) {
            for (point, other) in row.iter().zip(across) {
                (0..3).for_each(|axis| sum[axis] += weight * other * point[axis]);
            }
        }
        sum
    }

    /// The area of one side, in squares of the size: that of two triangles in each cell of a grid over each patch.
    pub fn area(&self) -> f64 {
        let at = |step: usize| step as f64 / STEPS as f64;
        let of = |patch: &Patch, s: usize, t: usize| Self::point(patch, at(s), at(t));
        let cells = (0..STEPS).flat_map(|s| (0..STEPS).map(move |t| (s, t)));
        let cell = |patch: &Patch, (s, t): (usize, usize)| {
            let (a, b) = (of(patch, s, t), of(patch, s + 1, t + 1));
            triangle(a, of(patch, s + 1, t), b) + triangle(a, b, of(patch, s, t + 1))
        };
        self.patches.iter().flat_map(|patch| cells.clone().map(move |place| cell(patch, place))).sum()
    }

    /// The border of the largest patch, `steps` points a side, once around: the outline that a flat drawing has.
    pub fn outline(&self, steps: usize) -> Vec<[f64; 3]> {
        let of_one = |patch: &Patch| Self { patches: vec![*patch] }.area();
        let areas = self.patches.iter().map(of_one);
        let largest = areas.enumerate().fold((0, 0.0), |best, (i, area)| if area > best.1 { (i, area) } else { best });
        let Some(patch) = self.patches.get(largest.0) else { return Vec::new() };
        let steps = steps.max(1);
        let at = |step: usize| step as f64 / steps as f64;
        let sides = [0, 1, 2, 3].into_iter().flat_map(|side| (0..steps).map(move |step| (side, step)));
        let place = |(side, step): (u8, usize)| match side {
            0 => (at(step), 0.0),
            1 => (1.0, at(step)),
            2 => (1.0 - at(step), 1.0),
            _ => (0.0, 1.0 - at(step)),
        };
        sides.map(place).map(|(s, t)| Self::point(patch, s, t)).collect()
    }
}

/// The contact point, the axes of the turtle in the coordinates of the file, and the size of the file.
struct Frame {
    contact: [f64; 3],
    axes: [[f64; 3]; 3],
    size: f64,
}

impl Frame {
    fn turned(&self, point: [f64; 3]) -> [f64; 3] {
        let from = [0, 1, 2].map(|axis| (point[axis] - self.contact[axis]) / self.size);
        self.axes.map(|axis| dot(axis, from))
    }
}

fn frame(lines: &mut Lines<'_>) -> Result<Frame, TextFault> {
    let mut bounds = lines.next("the box of the points: six numbers")?.words();
    for _ in 0..6 {
        bounds.number("the box of the points: six numbers")?;
    }
    if lines.begins("PRECISION") {
        lines.at += 1;
    }
    let contact = lines.triple("CONTACT POINT")?.0;
    lines.triple("END POINT")?;
    let heading = direction(lines.triple("HEADING")?)?;
    let (up, line) = lines.triple("UP")?;
    let along = dot(up, heading);
    let up = direction(([0, 1, 2].map(|axis| up[axis] - along * heading[axis]), line))?;
    let line = lines.next("`SIZE:` and a number")?;
    let Some(("SIZE", size)) = line.split(':') else { return Err(at(&line, "`SIZE:` and a number")) };
    let word = size.words().next();
    let size = word.number("a size above 0")?;
    if size > 0.0 {
        Ok(Frame { contact, axes: [heading, cross(up, heading), up], size })
    } else {
        Err(word.fault("a size above 0"))
    }
}

/// A patch: its name, the lines with colons, and 16 points over as many lines as there are.
fn patch(lines: &mut Lines<'_>, frame: &Frame) -> Result<Patch, TextFault> {
    lines.next("the name of a patch")?;
    while lines.left.get(lines.at).is_some_and(|line| line.text.contains(':')) {
        lines.at += 1;
    }
    let mut numbers = Vec::with_capacity(48);
    while numbers.len() < 48 {
        let mut words = lines.next("16 points of three numbers each")?.words();
        loop {
            let word = words.next();
            if word.text.is_empty() {
                break;
            }
            numbers.push(word.number("a number of a point")?);
            if numbers.len() > 48 {
                return Err(word.fault("the end of the patch, behind 16 points"));
            }
        }
    }
    let point = |row: usize, column: usize| {
        let first = 12 * row + 3 * column;
        frame.turned([numbers[first], numbers[first + 1], numbers[first + 2]])
    };
    Ok([0, 1, 2, 3].map(|row| [0, 1, 2, 3].map(|column| point(row, column))))
}

fn direction((vector, line): ([f64; 3], Line<'_>)) -> Result<[f64; 3], TextFault> {
    let length = dot(vector, vector).sqrt();
    if length >= NO_DIRECTION {
        Ok(vector.map(|along| along / length))
    } else {
        Err(at(&line, "a vector that is not 0, and an upper side that is not along the heading"))
    }
}

/// The lines that are still to be read.
struct Lines<'t> {
    left: Vec<Line<'t>>,
    at: usize,
}

impl<'t> Lines<'t> {
    fn next(&mut self, expected: &str) -> Result<Line<'t>, TextFault> {
        let line = self.left.get(self.at).copied().ok_or_else(|| self.fault(expected))?;
        self.at += 1;
        Ok(line)
    }

    fn begins(&self, word: &str) -> bool {
        self.left.get(self.at).is_some_and(|line| line.text.trim_start().starts_with(word))
    }

    /// The numbers of a line such as `END POINT  X: 0 Y: 1 Z: 0`.
    fn triple(&mut self, name: &str) -> Result<([f64; 3], Line<'t>), TextFault> {
        let expected = format!("`{name}  X: … Y: … Z: …`");
        let begins = self.begins(name);
        let line = self.next(&expected)?;
        if !begins {
            return Err(at(&line, &expected));
        }
        let parts = |character: char| character.is_whitespace() || character == ':';
        let words = line.words_between(parts).into_iter().skip(name.split(' ').count());
        let mut numbers = words.filter(|word| !["X", "Y", "Z"].contains(&word.text));
        let end = line.words().end();
        let mut number = || numbers.next().unwrap_or(end).number("a number");
        Ok(([number()?, number()?, number()?], line))
    }

    /// A fault at the line that is to be read next, or at the end.
    fn fault(&self, expected: &str) -> TextFault {
        match (self.left.get(self.at), self.left.last()) {
            (Some(line), _) => at(line, expected),
            (None, Some(last)) => last.words().end().fault(expected),
            (None, None) => {
                let problem = "the file is empty".to_owned();
                TextFault { line: 1, column: 1, problem, expected: expected.to_owned() }
            }
        }
    }
}

/// A fault at the first word of a line.
fn at(line: &Line<'_>, expected: &str) -> TextFault {
    line.words().next().fault(expected)
}

fn triangle(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    let from = |point: [f64; 3]| [0, 1, 2].map(|axis| point[axis] - a[axis]);
    let normal = cross(from(b), from(c));
    0.5 * dot(normal, normal).sqrt()
}
