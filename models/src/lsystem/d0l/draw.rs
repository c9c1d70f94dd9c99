//! The plant of a string, by the drawing rules of Aono & Kunii 1984 ("L-system model").
//!
//! Each cell is a straight internode (rule 1), of the length of its kind (3); the first stands upright (2); a pair of
//! parentheses is a branch (4). The branches along an axis stand on opposite sides by turns, the first of each axis on
//! the left (5), also where several stand at one cell (6), at one angle in one plane: x–z, with x to the right. Where
//! an axis divides its apex ends, and the branches are of its order. Internodes stand in the columns in the order of
//! the string, axes in the order of their numbers, which never change.
//! Absent: rewriting (`string`).

use super::string::{Born, Living, Module};
use phytomer_sim::clock::{NEVER, Tick};
use phytomer_sim::plant::{
    ApexFate, AxisId, Event, EventKind, LineageKey, NO_STATE, NewAxis, NewNode, NodeId, Origin, Plant,
};
use std::collections::BTreeMap;
use std::f32::consts::PI;

/// The length and the diameter of the cells of a kind, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Size {
    pub length: f32,
    pub diameter: f32,
}

/// An axis of the string: its bud, its bearing axis, and the state from which it continues.
#[derive(Debug, Clone)]
struct Axis {
    born: Born,
    bearer: NodeId,
    /// The number of cells so far.
    rank: u32,
    last: NodeId,
    /// The number of branches so far, and since the last cell.
    branches: u16,
    at_last: u16,
    /// The azimuth of its left side.
    left: f32,
    azimuth: f32,
    position: u16,
    /// Whether the axis is a fork, which its bearing axis has divided into.
    fork: bool,
    /// The tick at which the axis divided.
    divided: Tick,
    /// The place of the axis that bears it, in the order of the string.
    bearing: usize,
}

/// A cell with its place in the columns.
struct Cell {
    letter: u8,
    born: Born,
    axis: usize,
    parent: NodeId,
    rank: u32,
}

/// Writes the columns of `plant`, which are empty, from its string.
pub(super) fn draw(living: &Living, trunk: Born, sizes: &[Size], angle: f32, plant: &mut Plant) {
    let mut axes = vec![Axis::new(trunk, NodeId::NONE, usize::MAX)];
    let (mut cells, mut at) = (Vec::new(), 0);
    for module in &living.modules {
        match *module {
            Module::Cell(letter, born) => {
                let node = NodeId(cells.len() as u32);
                let axis = &mut axes[at];
                axis.rank += 1;
                axis.at_last = 0;
                cells.push(Cell { letter, born, axis: at, parent: axis.last, rank: axis.rank });
                axis.last = node;
            }
            Module::Open(born, fork) => {
                let branch = axes[at].branch(born, fork, at);
                at = axes.len();
                axes.push(branch);
            }
            Module::Close => at = axes[at].bearing,
        }
    }
    let places = place_axes(&axes, angle, plant);
    for cell in cells {
        let Size { length, diameter } = sizes[usize::from(cell.letter)];
        let new = NewNode {
            parent: cell.parent,
            axis: places[cell.axis],
            birth: cell.born.at,
            rank: cell.rank,
            unit_rank: 1,
            short: false,
            neoformed: false,
            trend: 0,
            length,
            diameter,
            azimuth: 0.0,
        };
        plant.place_node(new, cell.born.number);
    }
}

impl Axis {
    fn new(born: Born, bearer: NodeId, bearing: usize) -> Self {
        Self {
            born,
            bearer,
            rank: 0,
            last: bearer,
            branches: 0,
            at_last: 0,
            // The reference direction of the axis of the seed is −x, on its left.
            left: 0.0,
            azimuth: 0.0,
            position: 0,
            fork: false,
            divided: NEVER,
            bearing,
        }
    }

    /// The next branch, borne by the last cell; `place` is the place of this axis. The reference direction of a branch
    /// lies on the side of its bearing axis, so its left is opposite to that of the bearing axis where the branch
    /// stands on the left, and along it elsewhere.
    fn branch(&mut self, born: Born, fork: bool, place: usize) -> Self {
        let on_left = self.branches.is_multiple_of(2);
        self.divided = if fork { self.divided.min(born.at) } else { self.divided };
        let opposite = if self.left == 0.0 { PI } else { 0.0 };
        let azimuth = if on_left { self.left } else { opposite };
        let branch = Self {
            azimuth,
            left: if on_left { PI } else { 0.0 },
            position: self.at_last,
            fork,
            ..Self::new(born, self.last, place)
        };
        self.branches = self.branches.wrapping_add(1);
        self.at_last = self.at_last.saturating_add(1);
        branch
    }
}

/// Adds the axes in the order of their numbers. Returns their handles in the order of the string.
fn place_axes(axes: &[Axis], angle: f32, plant: &mut Plant) -> Vec<AxisId> {
    let mut by_number: Vec<usize> = (0..axes.len()).collect();
    by_number.sort_unstable_by_key(|&place| axes[place].born.number);
    let mut places = vec![AxisId::TRUNK; axes.len()];
    for place in by_number {
        let axis = &axes[place];
        let bearing = axes.get(axis.bearing);
        let order = bearing.map_or(0, |_| plant.axes.order[places[axis.bearing].index()]);
        let origin = match bearing {
            None => Origin::Seed,
            Some(_) if axis.fork => Origin::Fork,
            Some(_) => Origin::Axillary,
        };
        let new = NewAxis {
            bearer: axis.bearer.some(),
            key: LineageKey::SEED,
            order: if origin == Origin::Fork { order } else { order.saturating_add(1) },
            origin,
            position: axis.position,
            follows: origin == Origin::Fork && axis.position > 0,
            appearance: axis.born.at,
            birth: axis.born.at,
            azimuth: axis.azimuth,
            insertion: if bearing.is_some() { angle } else { 0.0 },
            ..NewAxis::OF_THE_SEED
        };
        places[place] = plant.place_axis(new, axis.born.number);
        if axis.divided != NEVER {
            plant.axes.end_apex(places[place], axis.divided.max(1), ApexFate::Completed);
        }
    }
    places
}

/// Adds to the events of `plant` what is new since the age `last`: axes, their nodes, and axes that have divided; tick
/// by tick, and axis by axis.
pub(super) fn note_new(plant: &mut Plant, last: Tick) {
    let Plant { axes, nodes, events: Some(events), .. } = plant else { return };
    let mut new: BTreeMap<(Tick, AxisId, EventKind), u32> = BTreeMap::new();
    for (node, &axis) in nodes.axis.iter().enumerate().filter(|(node, _)| nodes.birth[*node] > last) {
        *new.entry((nodes.birth[node], axis, EventKind::Grew)).or_default() += 1;
    }
    for axis in 0..axes.len() {
        let appears = if axes.origin[axis] == Origin::Fork { EventKind::Forked } else { EventKind::Branched };
        for (tick, kind) in [(axes.appearance[axis], appears), (axes.apex_end[axis], EventKind::Completed)] {
            if tick > last && tick != NEVER {
                new.insert((tick, AxisId(axis as u32), kind), 1);
            }
        }
    }
    events.extend(new.into_iter().map(|((tick, axis, kind), count)| Event {
        tick,
        axis,
        kind,
        count,
        state: NO_STATE,
    }));
}
