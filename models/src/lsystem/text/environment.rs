//! What answers the query `?E` of a string: whether anything is near, or the field of a shape.
//!
//! `collision` is 1 where no other `?E` and no node of the plant is within a distance, else 0; a node is the end of a
//! line, and that on which the query itself stands does not count. Decided where nothing is printed: what lies exactly
//! at the distance counts as near, the foot of a plant is no node, and other plants are not seen. Points are sorted
//! into cells of half the distance, so that all points of a cell are near one another: only a query that is alone in
//! its cell looks at other cells, and each point is looked at by no more queries than there are cells around it.
//! Absent: light.

use super::draft::Internode;
use super::shapes::in_metres;
use crate::lsystem::turtle::Vector;
use phytomer_rewriting::Slot;
use phytomer_sim::shape::Shape;
use std::cmp::Ordering;
use std::ops::Range;
use std::sync::Arc;

/// What answers `?E`.
#[derive(Debug, Clone, PartialEq)]
pub enum Environment {
    /// Whether nothing is within so many metres.
    Collision {
        /// The distance, metres.
        radius_m: f64,
    },
    /// The field of a shape.
    Field(Arc<Shape>),
}

/// A query that is to be answered.
#[derive(Debug, Clone, Copy)]
pub(super) struct Asked {
    pub query: Slot,
    pub at: Vector,
    /// The internode that bears it, by its place; none is that of the base.
    pub on: u32,
    /// Its parameters behind the first, which stay as they are.
    pub rest: [f64; 2],
}

impl Environment {
    /// The answer to each query, in their order, where a step is so many metres. `nodes` are the lines of the plant.
    pub(super) fn answers(&self, asked: &[Asked], nodes: &[Internode], step: f64) -> Vec<f64> {
        match self {
            Self::Collision { radius_m } => {
                let near = Near::of(asked, nodes, radius_m / step);
                asked.iter().enumerate().map(|(number, asked)| f64::from(!near.collides(number, asked))).collect()
            }
            Self::Field(shape) => asked.iter().map(|asked| shape.field(in_metres(asked.at, step))).collect(),
        }
    }
}

/// A cell of space, by whole numbers.
type Cell = [f64; 3];

/// A point: the end of a line, or a query, by its number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Owner {
    Node(u32),
    Query(usize),
}

/// All points of a plant, by their cells.
struct Near {
    points: Vec<(Cell, Vector, Owner)>,
    radius: f64,
}

impl Near {
    fn of(asked: &[Asked], nodes: &[Internode], radius: f64) -> Self {
        let nodes = nodes.iter().enumerate().map(|(number, node)| (node.tip(), Owner::Node(number as u32)));
        let queries = asked.iter().enumerate().map(|(number, asked)| (asked.at, Owner::Query(number)));
        let in_cell = |(point, owner)| (cell(point, radius), point, owner);
        let mut points: Vec<_> = nodes.chain(queries).map(in_cell).collect();
        points.sort_by(|one, other| compare(&one.0, &other.0));
        Self { points, radius }
    }

    fn collides(&self, number: usize, asked: &Asked) -> bool {
        let is_other = |owner: Owner| owner != Owner::Query(number) && owner != Owner::Node(asked.on);
        let own = cell(asked.at, self.radius);
        if self.points[self.between(own, own)].iter().any(|(_, _, owner)| is_other(*owner)) {
            return true;
        }
        let is_near = |(_, point, owner): &(Cell, Vector, Owner)| {
            let square: f64 = (0..3).map(|i| (point[i] - asked.at[i]) * (point[i] - asked.at[i])).sum();
            is_other(*owner) && square <= self.radius * self.radius
        };
        const AROUND: [f64; 5] = [-2.0, -1.0, 0.0, 1.0, 2.0];
        AROUND.iter().any(|x| {
            AROUND.iter().any(|y| {
                let [first, last] = [-2.0, 2.0].map(|z| [own[0] + x, own[1] + y, own[2] + z]);
                self.points[self.between(first, last)].iter().any(is_near)
            })
        })
    }

    /// The points in the cells from one to another.
    fn between(&self, first: Cell, last: Cell) -> Range<usize> {
        let start = self.points.partition_point(|(cell, ..)| compare(cell, &first) == Ordering::Less);
        let rest = &self.points[start..];
        start..start + rest.partition_point(|(cell, ..)| compare(cell, &last) != Ordering::Greater)
    }
}

/// The cell of a point: half the radius long, so that its diagonal is shorter than the radius. There is one 0.
fn cell(point: Vector, radius: f64) -> Cell {
    point.map(|x| (2.0 * x / radius).floor() + 0.0)
}

fn compare(one: &Cell, other: &Cell) -> Ordering {
    let parts = one.iter().zip(other).map(|(one, other)| one.total_cmp(other));
    parts.fold(Ordering::Equal, Ordering::then)
}
