//! The turtle: it reads the modules of a string one by one, moves, turns, and says what each module draws.
//!
//! Prusinkiewicz & Lindenmayer 1990 (§1.5, ch. 2, §5.1, App. C), and what the files of cpfg use beyond it. Angles are
//! in degrees, lengths and widths in units of the turtle, in double precision; the frame is that of [`Frame`]. Absent:
//! which modules are components of a plant (`text`), and the meaning of colours and surfaces (`view`).
//!
//! Decided where the book and cpfg are silent or differ:
//! - The tropism turns after each `F` and `f` (`G`, `g`), by the angle e |H × T| about H × T, T as given; L and U turn
//!   with H. The numbered tropisms of cpfg (`tropism:`) turn before the line, as there.
//! - The lines `torque:` of cpfg are numbered with its tropisms, and roll the turtle after these have bent it. Its
//!   manual does not tell of them; what they do follows its source (`movements.c`).
//! - Between `{` and `}` lines are edges of the polygon, and are not drawn. Between `@Gs` and `@Ge` a line is drawn
//!   from each point to the next, at `@Gc` and `@Ge`, and `F` only moves. `{(1)` and `}(1)` are `@Gs` and `@Ge`.
//! - A parameter that is no number counts as 0, and none is larger than 10³⁰ in size, so that no position overflows.
//! - A bracket that closes nothing is passed over.

mod angles;
mod command;
mod frame;
mod settings;
#[cfg(test)]
mod tests;
mod tropism;

pub use super::vector::Vector;
pub use command::{Axis, Change, Command, Counter, Mark, Query, Spline};
pub use frame::Frame;

use super::vector::{dot, unit};
use super::view::View;
use angles::Angles;
use settings::{Settings, bounded};

/// Colours are counted around so many.
const COLOURS: i32 = 256;

/// What a turtle carries and a bracket gives back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Where it is.
    pub frame: Frame,
    /// The width of lines.
    pub width: f64,
    /// The colour of the front and of the back.
    pub colour: [i32; 2],
    /// The scale of lengths.
    pub scale: f64,
    /// The susceptibility e to the tropism.
    elasticity: f64,
    /// The place, among those of the turtle, of the frame and the width with which a generalised cylinder goes on.
    spline: Option<u32>,
    /// The number of the contour of generalised cylinders; 0 for a circle.
    contour: i32,
}

impl State {
    fn first(settings: &Settings) -> Self {
        Self {
            frame: Frame::START,
            width: settings.width,
            colour: settings.colour,
            scale: settings.scale,
            elasticity: settings.elasticity,
            spline: None,
            contour: 0,
        }
    }
}

/// What a module has drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Drawing<'t> {
    /// A line from the position of a frame along its heading.
    Line {
        /// Where it begins.
        from: Frame,
        /// Its length, at least 0.
        length: f64,
        /// Its width where it begins.
        width: f64,
        /// The number of its contour, if it is a part of a generalised cylinder; 0 for a circle.
        contour: i32,
    },
    /// A polygon, in the frame where it began.
    Polygon {
        /// Where it began.
        from: Frame,
        /// Its corners, in the coordinates of the turtle.
        corners: &'t [Vector],
    },
    /// A surface at the turtle, scaled across, along and above.
    Surface {
        /// Its symbol.
        symbol: char,
        /// Factors of its size along L, H and U.
        scale: [f64; 3],
    },
    /// A round mark at the turtle, of a diameter.
    Mark(Mark, f64),
    /// A query asks at the turtle.
    Query(Query),
}

/// What an open bracket gives back, and how many susceptibilities had changed and splines were kept before it.
#[derive(Debug, Clone, Copy)]
struct Saved {
    state: State,
    changed: usize,
    splines: usize,
}

/// A turtle.
#[derive(Debug, Clone)]
pub struct Turtle {
    state: State,
    /// What each open bracket gives back.
    stack: Vec<Saved>,
    /// The frames and the widths with which generalised cylinders go on, of the turtle and of open brackets: few states
    /// have one, and all are copied.
    splines: Vec<(Frame, f64)>,
    /// The corners of open polygons, all in one list; where the corners of each begin, and where the turtle was.
    corners: Vec<Vector>,
    polygons: Vec<(usize, Frame)>,
    /// The corners of the polygon that ended last.
    ended: Vec<Vector>,
    settings: Settings,
    angles: Angles,
    /// The susceptibilities to the numbered tropisms, and the values that changed within open brackets, with their
    /// numbers, as they were.
    elasticities: Vec<f64>,
    changed: Vec<(usize, f64)>,
}

impl Turtle {
    /// A turtle at its beginning.
    pub fn new(view: &View) -> Self {
        let settings = Settings::of(view);
        let state = State::first(&settings);
        let mut turtle = Self {
            state,
            stack: Vec::new(),
            splines: Vec::new(),
            corners: Vec::new(),
            polygons: Vec::new(),
            ended: Vec::new(),
            settings,
            angles: Angles::default(),
            elasticities: Vec::new(),
            changed: Vec::new(),
        };
        turtle.restart();
        turtle
    }

    /// Goes back to the beginning.
    pub fn restart(&mut self) {
        self.state = State::first(&self.settings);
        self.stack.clear();
        self.splines.clear();
        self.corners.clear();
        self.polygons.clear();
        self.ended.clear();
        self.elasticities.clear();
        self.elasticities.extend(self.settings.tropisms.iter().map(|tropism| tropism.elasticity));
        self.changed.clear();
    }

    /// Its state.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Whether a polygon is open.
    pub fn in_polygon(&self) -> bool {
        !self.polygons.is_empty()
    }

    /// Does what a module tells; what the module draws.
    #[inline]
    pub fn follow(&mut self, command: Command, parameters: &[f64]) -> Option<Drawing<'_>> {
        match command {
            Command::Turn { about, positive } => self.turn(about, positive, parameters),
            Command::Line { corner } => return self.line(corner, parameters),
            Command::Open => self.open(),
            Command::Close => self.close(),
            Command::Step { corner } => self.go(self.length(parameters), corner),
            Command::Nothing => {}
            other => return self.follow_rare(other, parameters),
        }
        None
    }

    /// The commands that are less frequent.
    fn follow_rare(&mut self, command: Command, parameters: &[f64]) -> Option<Drawing<'_>> {
        match command {
            Command::TurnAround => self.state.frame.turn_around(),
            Command::RollUpright => self.state.frame.roll_upright(),
            Command::Head => self.head(parameters),
            Command::Place => self.place(parameters),
            Command::Count { what, up } => self.count(what, up, parameters),
            Command::Scale => self.state.scale = first(parameters).unwrap_or(self.state.scale),
            Command::ScaleBy { multiplies } => self.scale_by(multiplies, parameters),
            Command::PolygonStart if of_spline(parameters) => self.spline(Spline::Start)?,
            Command::PolygonEnd if of_spline(parameters) => return self.cylinder(Spline::End),
            Command::PolygonStart => self.polygons.push((self.corners.len(), self.state.frame)),
            Command::PolygonEnd => return self.polygon(),
            Command::Corner => self.corner(),
            Command::Spline(part) => return self.cylinder(part),
            Command::Contour => self.state.contour = first(parameters).unwrap_or(0.0) as i32,
            Command::Elasticity => {
                let more = self.state.elasticity + self.settings.elasticity_increment;
                self.state.elasticity = first(parameters).unwrap_or(more);
            }
            Command::ElasticityOf(change) => self.elasticity_of(change, parameters),
            Command::Mark(mark) => return Some(self.mark(mark, parameters)),
            Command::Surface(symbol) => return Some(self.surface(symbol, parameters)),
            Command::Query(query) => return Some(Drawing::Query(query)),
            _ => {}
        }
        None
    }

    fn turn(&mut self, about: Axis, positive: bool, parameters: &[f64]) {
        let angle = first(parameters).map_or(self.settings.angle, f64::to_radians);
        let (sin, cos) = self.angles.sincos(if positive { angle } else { -angle });
        self.state.frame.turn(about, sin, cos);
    }

    /// The length of a step: its parameter, or 1, in the scale.
    fn length(&self, parameters: &[f64]) -> f64 {
        bounded(first(parameters).unwrap_or(1.0) * self.state.scale)
    }

    fn line(&mut self, corner: bool, parameters: &[f64]) -> Option<Drawing<'_>> {
        self.bend_by_numbers();
        let (from, length) = (self.state.frame, self.length(parameters));
        self.move_by(length, corner);
        let drawn = self.polygons.is_empty() && self.state.spline.is_none();
        drawn.then(|| line_of(from, length, self.state.width))
    }

    /// A step that draws nothing.
    fn go(&mut self, length: f64, corner: bool) {
        self.bend_by_numbers();
        self.move_by(length, corner);
    }

    fn move_by(&mut self, length: f64, corner: bool) {
        self.state.frame.go(length);
        let [x, y, z] = self.state.frame.position;
        self.state.frame.position = [bounded(x), bounded(y), bounded(z)];
        if corner && !self.polygons.is_empty() {
            self.corners.push(self.state.frame.position);
        }
        if self.state.elasticity != 0.0 {
            self.state.frame.bend(self.settings.tropism, self.state.elasticity);
        }
    }

    fn open(&mut self) {
        self.stack.push(Saved { state: self.state, changed: self.changed.len(), splines: self.splines.len() });
    }

    fn close(&mut self) {
        let Some(Saved { state, changed, splines }) = self.stack.pop() else { return };
        self.state = state;
        self.splines.truncate(splines);
        for (number, before) in self.changed.drain(changed..).rev() {
            self.elasticities[number] = before;
        }
    }

    fn head(&mut self, parameters: &[f64]) {
        let [x, y, rest @ ..] = parameters else { return };
        let heading = [*x, *y, rest.first().copied().unwrap_or(0.0)];
        self.state.frame.head(heading.map(bounded));
        if let [_, u, v, w, ..] = *rest {
            self.state.frame.roll_to([u, v, w].map(bounded));
        }
    }

    fn place(&mut self, parameters: &[f64]) {
        if let [x, y, rest @ ..] = parameters {
            self.state.frame.position = [*x, *y, rest.first().copied().unwrap_or(0.0)].map(bounded);
        }
    }

    fn count(&mut self, what: Counter, up: bool, parameters: &[f64]) {
        let sign = if up { 1 } else { -1 };
        let place = match what {
            Counter::Width => {
                let more = self.state.width + f64::from(sign) * self.settings.width_increment * self.state.scale;
                let width = first(parameters).map_or(more, |width| width * self.state.scale);
                self.state.width = bounded(width).max(0.0);
                return;
            }
            Counter::Colour => 0,
            Counter::BackColour => 1,
        };
        let more = self.state.colour[place].wrapping_add(sign * self.settings.colour_increment[place]);
        self.state.colour[place] = first(parameters).map_or(more, |colour| colour as i32).rem_euclid(COLOURS);
    }

    fn scale_by(&mut self, multiplies: bool, parameters: &[f64]) {
        let factor = first(parameters).unwrap_or(self.settings.scale_multiplier);
        if factor != 0.0 {
            let scale = if multiplies { self.state.scale * factor } else { self.state.scale / factor };
            self.state.scale = bounded(scale);
        }
    }

    fn corner(&mut self) {
        if !self.polygons.is_empty() {
            self.corners.push(self.state.frame.position);
        }
    }

    fn polygon(&mut self) -> Option<Drawing<'_>> {
        let (start, from) = self.polygons.pop()?;
        self.ended.clear();
        self.ended.extend(self.corners.drain(start..));
        Some(Drawing::Polygon { from, corners: &self.ended })
    }

    fn spline(&mut self, part: Spline) -> Option<()> {
        self.splines.truncate(self.stack.last().map_or(0, |saved| saved.splines));
        self.state.spline = (part != Spline::End).then_some(self.splines.len() as u32);
        if part != Spline::End {
            self.splines.push((self.state.frame, self.state.width));
        }
        Some(())
    }

    /// The line of a generalised cylinder from its last point to here.
    fn cylinder(&mut self, part: Spline) -> Option<Drawing<'_>> {
        let before = self.state.spline.filter(|_| part != Spline::Start);
        let before = before.and_then(|place| self.splines.get(place as usize)).copied();
        self.spline(part);
        let (before, width) = before?;
        let along = [0, 1, 2].map(|i| self.state.frame.position[i] - before.position[i]);
        unit(along)?;
        let untwisted = self.settings.untwisted;
        let mut from = if untwisted { before } else { Frame { position: before.position, ..self.state.frame } };
        from.head(along);
        let next = self.state.spline.filter(|_| untwisted);
        if let Some((next, _)) = next.and_then(|place| self.splines.get_mut(place as usize)) {
            // The next part goes on from the frame of this one.
            *next = Frame { position: next.position, ..from };
        }
        let length = dot(along, along).sqrt();
        Some(Drawing::Line { from, length, width, contour: self.state.contour })
    }

    fn mark(&self, mark: Mark, parameters: &[f64]) -> Drawing<'static> {
        let diameter = first(parameters).map_or(self.state.width, |diameter| diameter * self.state.scale);
        Drawing::Mark(mark, bounded(diameter).abs())
    }

    /// A surface without parameters has its size; of one or two the first scales it as a whole; of three each scales
    /// one axis: across, along, above.
    fn surface(&self, symbol: char, parameters: &[f64]) -> Drawing<'static> {
        let scale = match *parameters {
            [across, along, above, ..] => [across, along, above],
            [scale, ..] => [scale; 3],
            [] => [1.0; 3],
        };
        Drawing::Surface { symbol, scale: scale.map(|scale| bounded(bounded(scale) * self.state.scale)) }
    }
}

/// A line of a length, which may be negative: the turtle then goes backwards, and the line is told from its other end.
fn line_of(from: Frame, length: f64, width: f64) -> Drawing<'static> {
    if length >= 0.0 {
        return Drawing::Line { from, length, width, contour: 0 };
    }
    let mut end = from;
    end.turn_around();
    Drawing::Line { from: end, length: -length, width, contour: 0 }
}

/// Whether the parameter of a brace asks for a generalised cylinder.
fn of_spline(parameters: &[f64]) -> bool {
    parameters.first().is_some_and(|kind| *kind != 0.0)
}

/// The first parameter, if there is one.
#[inline]
fn first(parameters: &[f64]) -> Option<f64> {
    parameters.first().copied().map(bounded)
}
