//! Plants for the tests of the pose, stated axis by axis and built in either order of growth: one axis after another,
//! as growth runs ahead, or a node of each axis in turn, as growth follows the clock.
//!
//! Absent: plants with stated frames (`tests_stated`).

use crate::clock::Tick;
use crate::plant::*;
use std::sync::Arc;

/// One axis of a specimen.
#[derive(Debug, Clone)]
pub struct Branch {
    /// The bearing axis by its place in the specimen, and the rank of the bearing node, from 1.
    pub bearer: Option<(usize, u32)>,
    pub azimuth: f32,
    pub insertion: f32,
    /// The nodes.
    pub nodes: u32,
    /// The length of each internode, metres.
    pub length: f32,
    /// The trend of the first half of its nodes, and of the second.
    pub trends: [u8; 2],
}

impl Branch {
    pub fn trunk(nodes: u32, length: f32) -> Self {
        Self { bearer: None, azimuth: 0.0, insertion: 0.0, nodes, length, trends: [0, 0] }
    }

    pub fn on(axis: usize, rank: u32) -> Self {
        Self { bearer: Some((axis, rank)), azimuth: 0.7, insertion: 1.1, ..Self::trunk(5, 0.1) }
    }
}

/// The order in which the axes grow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Growth {
    AxisByAxis,
    TickByTick,
}

/// An age at which every node of a specimen has appeared.
pub const LAST: Tick = 1_000_000;

/// A specimen under construction; `node_at[axis][rank - 1]` is the handle of a node.
pub struct Specimen {
    pub plant: Plant,
    pub node_at: Vec<Vec<NodeId>>,
    branches: Vec<Branch>,
    axis_at: Vec<Option<AxisId>>,
}

impl Specimen {
    pub fn new(branches: &[Branch], trends: &[Trend]) -> Self {
        let habit = Habit { trends: trends.to_vec(), looks: Looks::of_shape(Shape::Cylinder), ..Habit::default() };
        let seed = Seed { plant: 0, draws: 0, run_seed: 1, component_limit: u32::MAX, keep_events: false };
        let plant = Plant::new(&seed, Arc::new(habit));
        let (node_at, axis_at) = (vec![Vec::new(); branches.len()], vec![None; branches.len()]);
        Self { plant, node_at, branches: branches.to_vec(), axis_at }
    }

    pub fn grown(branches: &[Branch], trends: &[Trend], growth: Growth) -> Self {
        let mut specimen = Self::new(branches, trends);
        match growth {
            Growth::AxisByAxis => {
                (0..branches.len()).for_each(|axis| while specimen.add_node(axis) {});
            }
            Growth::TickByTick => while specimen.tick() {},
        }
        specimen
    }

    /// Adds a node to every axis whose bearing node exists. Returns whether any was added.
    pub fn tick(&mut self) -> bool {
        self.plant.age += 1;
        (0..self.branches.len()).fold(false, |grew, axis| self.add_node(axis) | grew)
    }

    fn add_node(&mut self, place: usize) -> bool {
        let rank = self.node_at[place].len() as u32 + 1;
        if rank > self.branches[place].nodes {
            return false;
        }
        let Some(axis) = self.axis(place) else { return false };
        let Branch { nodes, length, trends, .. } = self.branches[place];
        let parent = self.plant.axes.last_node[axis.index()].some().unwrap_or(self.plant.axes.bearer[axis.index()]);
        let node = self.plant.add_node(NewNode {
            parent,
            axis,
            birth: rank.max(self.plant.age),
            rank,
            trend: trends[usize::from(rank > nodes / 2)],
            length,
            diameter: 0.01,
            ..NewNode::OF_THE_TRUNK
        });
        self.node_at[place].push(node);
        true
    }

    fn axis(&mut self, place: usize) -> Option<AxisId> {
        if self.axis_at[place].is_none() {
            let Branch { bearer, azimuth, insertion, .. } = self.branches[place];
            let bearer = match bearer {
                Some((axis, rank)) => Some(*self.node_at[axis].get(rank as usize - 1)?),
                None => None,
            };
            self.axis_at[place] = Some(self.plant.add_axis(NewAxis {
                bearer,
                key: LineageKey(place as u64),
                origin: Origin::Axillary,
                azimuth,
                insertion,
                ..NewAxis::OF_THE_SEED
            }));
        }
        self.axis_at[place]
    }
}
