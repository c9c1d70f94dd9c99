//! Surfaces (`.s`) that a turtle draws by `~`: Bézier patches of 4 × 4 points (Prusinkiewicz & Lindenmayer 1990 §5.1).
//!
//! The file states the box of its points, how finely it is drawn, a contact point, the heading and the upper side at
//! which it sits on the turtle, and its size; then each patch by its name, its colours, its neighbours (`AL:` …) and 16
//! points. Here the points are told in the coordinates of the turtle (along H, L and U), from the contact point, with
//! the stated size as 1. The upper side of the file is that of cpfg, whose U is ours turned round: it comes to lie
//! along −U. A patch becomes a grid of cells of two triangles each, with the normals of the patch itself. Names,
//! colours and neighbours are not used.

use super::text::{Line, TextFault, bounded, full_lines};
use crate::lsystem::vector::{cross, dot};
use phytomer_looks::Surface as Form;

/// The farthest that a point of a surface is from the turtle, steps.
const FARTHEST: f64 = 1e12;

/// The most patches of a surface.
const MOST_PATCHES: usize = 256;
/// A direction that is shorter is no direction.
const NO_DIRECTION: f64 = 1e-3;
/// The most steps of a parameter, as in cpfg.
const MOST_STEPS: u8 = 10;
/// The steps of a parameter where neither the view file nor the surface states them.
const STEPS: u8 = 8;
/// The most triangles of a surface, since it is drawn thousands of times: of more patches each is drawn more coarsely.
const MOST_TRIANGLES: usize = 10_000;

/// The points of a patch: four rows of four.
pub type Patch = [[[f64; 3]; 4]; 4];

/// A surface in the coordinates of the turtle.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    /// Its patches, at least one.
    pub patches: Vec<Patch>,
    /// The steps of the parameters s and t in which it is drawn; 0 where the file does not state them.
    pub steps: [u8; 2],
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
        if patches.is_empty() { Err(lines.fault("a patch")) } else { Ok(Self { patches, steps: frame.steps }) }
    }

    /// The point of a patch at the parameters `s` along its rows and `t` along its columns, both in [0, 1].
    pub fn point(patch: &Patch, s: f64, t: f64) -> [f64; 3] {
        weighted(patch, weights(s), weights(t))
    }

    /// The surface in triangles, with a size as its largest dimension: `steps` of the parameters s and t in each patch,
    /// or where these are 0 as many as the file states, or 8.
    pub fn form(&self, size: f64, steps: [u8; 2]) -> Form {
        let steps = self.steps_of(steps);
        let (mut points, mut faces) = (Vec::new(), Vec::new());
        let row = u32::from(steps[0]) + 1;
        for patch in &self.patches {
            let first = points.len() as u32;
            for (t, s) in (0..=steps[1]).flat_map(|t| (0..=steps[0]).map(move |s| (t, s))) {
                let at = [f64::from(s) / f64::from(steps[0]), f64::from(t) / f64::from(steps[1])];
                points.push((Self::point(patch, at[0], at[1]).map(|x| near(x * size)), normal(patch, at), at));
            }
            for (t, s) in (0..u32::from(steps[1])).flat_map(|t| (0..u32::from(steps[0])).map(move |s| (t, s))) {
                let [a, b] = [first + t * row + s, first + (t + 1) * row + s];
                faces.extend([[a, a + 1, b + 1], [a, b + 1, b]]);
            }
        }
        Form::of(&points, &faces)
    }

    /// The steps in which it is drawn.
    fn steps_of(&self, asked: [u8; 2]) -> [u8; 2] {
        let stated = [0, 1].map(|k| if asked[k] > 0 { asked[k] } else { self.steps[k] });
        let mut steps = stated.map(|steps| if steps > 0 { steps.min(MOST_STEPS) } else { STEPS });
        let triangles = |steps: [u8; 2]| 2 * self.patches.len() * usize::from(steps[0]) * usize::from(steps[1]);
        while triangles(steps) > MOST_TRIANGLES && steps != [1; 2] {
            steps = steps.map(|steps| (steps - 1).max(1));
        }
        steps
    }
}

/// A coordinate no farther than [`FARTHEST`]; 0 where a text states numbers of which none can be made.
fn near(coordinate: f64) -> f64 {
    if coordinate.is_nan() { 0.0 } else { coordinate.clamp(-FARTHEST, FARTHEST) }
}

/// The vector across a patch on the side from which s and t run counterclockwise; 0 where it is drawn together.
fn normal(patch: &Patch, [s, t]: [f64; 2]) -> [f64; 3] {
    let [along_s, along_t] = [weighted(patch, slopes(s), weights(t)), weighted(patch, weights(s), slopes(t))];
    cross(along_s, along_t)
}

/// Bernstein's polynomials of the third degree.
fn weights(u: f64) -> [f64; 4] {
    let v = 1.0 - u;
    [v * v * v, 3.0 * u * v * v, 3.0 * u * u * v, u * u * u]
}

/// Their derivatives.
fn slopes(u: f64) -> [f64; 4] {
    let v = 1.0 - u;
    [-3.0 * v * v, 3.0 * v * (v - 2.0 * u), 3.0 * u * (2.0 * v - u), 3.0 * u * u]
}

/// The sum of the points of a patch with weights along its rows and along its columns.
fn weighted(patch: &Patch, along_rows: [f64; 4], along_columns: [f64; 4]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (row, weight) in patch.iter().zip(along_columns) {
        for (point, other) in row.iter().zip(along_rows) {
            (0..3).for_each(|axis| sum[axis] += weight * other * point[axis]);
        }
    }
    sum
}

/// The contact point, the axes of the turtle in the coordinates of the file, and the size of the file.
struct Frame {
    contact: [f64; 3],
    axes: [[f64; 3]; 3],
    size: f64,
    steps: [u8; 2],
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
    let steps = if lines.begins("PRECISION") { lines.precision() } else { [0; 2] };
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
        Ok(Frame { contact, axes: [heading, cross(heading, up), up.map(|x| -x)], size, steps })
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

    /// The two numbers of a line such as `PRECISION S: 5 T: 5`; 0 for what is no number.
    fn precision(&mut self) -> [u8; 2] {
        let Some(line) = self.left.get(self.at) else { return [0; 2] };
        self.at += 1;
        let words = line.words_between(|character: char| character.is_whitespace() || character == ':');
        let mut numbers = words.iter().filter_map(|word| word.text.parse().ok());
        [numbers.next().unwrap_or(0), numbers.next().unwrap_or(0)]
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
