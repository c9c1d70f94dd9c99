//! Shapes as functions of an L-system: of a shape with the name `crown` `inside_crown(x, y, z)` and
//! `field_crown(x, y, z)`, and of the shape with the name `prune` also `prune(x, y, z)`.
//!
//! `inside_NAME` is 1 within the shape and on its surface and 0 outside, `field_NAME` the field (½ on the surface, of
//! solids ½ less the distance in metres). `prune` is 1 outside and 0 inside, as in *Synthetic Topiary* §4 (L-system 4:
//! prune(x, y) = (x < −L/2) ‖ (x > L/2) ‖ (y < 0) ‖ (y > L)): the surface itself is not pruned. The coordinates are
//! those of the turtle, of which (x, −z, y) times the length of a step is the place in the plant in metres; without z
//! it is 0. Shapes stand around the seed of each plant. Absent: what a file calls besides (`curves`).

use crate::lsystem::turtle::Vector;
use crate::shapes::Named;
use phytomer_sim::shape::Shape;
use std::sync::Arc;

/// The function that asks whether a point is outside the shape of that name.
const PRUNE: &str = "prune";
/// What the names of functions that ask whether a point is inside, and of fields, begin with.
const INSIDE: &str = "inside_";
const FIELD: &str = "field_";

/// A question to a shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Question {
    Outside,
    Inside,
    Field,
}

impl Question {
    /// The question and the name of the shape of a function.
    fn of(function: &str) -> Option<(Self, &str)> {
        let begins = |start, question| function.strip_prefix(start).map(|name| (question, name));
        match function {
            PRUNE => Some((Self::Outside, PRUNE)),
            _ => begins(INSIDE, Self::Inside).or_else(|| begins(FIELD, Self::Field)),
        }
    }
}

/// A shape that a file may call.
#[derive(Debug, Clone)]
struct Called {
    name: String,
    shape: Arc<Shape>,
    /// The number of its parts.
    parts: usize,
}

/// The shapes that a file may call.
#[derive(Debug, Clone, Default)]
pub(super) struct ShapeFunctions {
    shapes: Vec<Called>,
    step: f64,
}

impl ShapeFunctions {
    /// The functions of shapes, where a step is so many metres.
    pub fn of(shapes: &Named, step: f64) -> Self {
        let called = |(name, shape): (&str, &Arc<Shape>)| Called {
            name: name.to_owned(),
            shape: Arc::clone(shape),
            parts: shapes.parts(name),
        };
        Self { shapes: shapes.iter().map(called).collect(), step }
    }

    /// The number of a function of two or three arguments: a shape and a question to it.
    pub fn function(&self, name: &str, arguments: usize) -> Option<u32> {
        let (question, shape) = Question::of(name).filter(|_| matches!(arguments, 2 | 3))?;
        let place = self.shapes.iter().position(|called| called.name == shape)?;
        Some(3 * place as u32 + question as u32)
    }

    /// How many parts the shape of a function has.
    pub fn parts(&self, function: u32) -> usize {
        self.shapes.get(function as usize / 3).map_or(0, |called| called.parts)
    }

    /// The value of a function at a point of the turtle.
    pub fn call(&self, function: u32, arguments: &[f64]) -> f64 {
        let Some(form) = self.shapes.get(function as usize / 3) else { return 0.0 };
        let at = |axis: usize| arguments.get(axis).copied().unwrap_or(0.0);
        let point = in_metres([at(0), at(1), at(2)], self.step);
        match function % 3 {
            0 => f64::from(!form.shape.inside(point)),
            1 => f64::from(form.shape.inside(point)),
            _ => form.shape.field(point),
        }
    }

    /// The names of all functions.
    pub fn names(&self) -> impl Iterator<Item = String> {
        let is_prune = self.shapes.iter().any(|called| called.name == PRUNE);
        let of_shape = |called: &Called| [INSIDE, FIELD].map(|start| format!("{start}{}", called.name));
        is_prune.then(|| PRUNE.to_owned()).into_iter().chain(self.shapes.iter().flat_map(of_shape))
    }

    /// What is missing where a file calls a function of a shape that nothing states.
    pub fn missing(&self, function: &str) -> Option<String> {
        let (_, name) = Question::of(function)?;
        if self.shapes.iter().any(|called| called.name == name) {
            return Some(format!("`{function}(x, y, z)`, or `{function}(x, y)`"));
        }
        let known: Vec<&str> = self.shapes.iter().map(|called| called.name.as_str()).collect();
        let known = if known.is_empty() { String::new() } else { format!("; there is {}", known.join(", ")) };
        Some(format!("the shape `{name}`: `[shape.{name}]` of the species, or `[site.shape.{name}]`{known}"))
    }
}

/// A place in the plant, metres, of a point of the turtle.
pub(super) fn in_metres([x, y, z]: Vector, step: f64) -> [f64; 3] {
    [x * step, -z * step, y * step]
}
