//! Component numbers of a block, and its organs in their order.
//!
//! On a node the internode comes first, then its leaves, its flowers each with its fruit, and the axes of its buds.

use super::block::Block;
use super::leaves::Leaves;
use phytomer_sim::plant::{NewAxis, NewOrgan};

/// The component numbers of a block.
#[derive(Debug, Default)]
pub struct Numbers {
    pub nodes: Vec<u32>,
    pub organs: Vec<u32>,
    pub axes: Vec<u32>,
    /// Leaves, flowers and fruits in their order, where there are flowers.
    mixed: Vec<NewOrgan>,
}

impl Numbers {
    /// Numbers the components of a block from `first` on.
    pub fn set(&mut self, block: &Block<'_>, first: u32, leaves: &Leaves, flowers: &[NewOrgan], axes: &[NewAxis]) {
        [&mut self.nodes, &mut self.organs, &mut self.axes].into_iter().for_each(Vec::clear);
        self.mixed.clear();
        match (leaves.rows.is_empty(), flowers.is_empty()) {
            (true, true) => self.set_bare(block, first, axes),
            (false, true) => self.set_leafy(block, first, leaves, axes),
            (_, false) => self.set_mixed(block, first, leaves, flowers, axes),
        }
    }

    /// Nodes without organs: from one that bears an axis to the next their numbers follow one another.
    fn set_bare(&mut self, block: &Block<'_>, first: u32, axes: &[NewAxis]) {
        let (mut next, mut numbered) = (first, 0);
        let mut number_up_to = |node: u32, next: &mut u32| {
            let after = *next + (node - numbered);
            self.nodes.extend(*next..after);
            (*next, numbered) = (after, node);
        };
        for axis in axes {
            number_up_to(bearer_of(axis, block) + 1, &mut next);
            self.axes.push(next);
            next += 1;
        }
        number_up_to(block.nodes() as u32, &mut next);
    }

    /// Nodes with leaves and axes.
    fn set_leafy(&mut self, block: &Block<'_>, first: u32, leaves: &Leaves, axes: &[NewAxis]) {
        let Self { nodes, organs, axes: of_axes, .. } = self;
        organs.reserve(leaves.rows.len());
        let mut bearers = axes.iter().map(|axis| bearer_of(axis, block)).peekable();
        let (mut next, mut before) = (first, 0);
        nodes.extend(leaves.things.ends().iter().zip(0..).map(|(&end, node)| {
            let number = next;
            next += 1;
            for _ in before..end {
                organs.push(next);
                next += 1;
            }
            before = end;
            while bearers.next_if_eq(&node).is_some() {
                of_axes.push(next);
                next += 1;
            }
            number
        }));
    }

    /// Nodes with flowers, perhaps with leaves, and axes.
    fn set_mixed(&mut self, block: &Block<'_>, first: u32, leaves: &Leaves, flowers: &[NewOrgan], axes: &[NewAxis]) {
        let Self { nodes, organs, axes: of_axes, mixed } = self;
        organs.reserve(leaves.rows.len() + flowers.len());
        mixed.reserve(leaves.rows.len() + flowers.len());
        let mut bearers = axes.iter().map(|axis| bearer_of(axis, block)).peekable();
        let (mut next, mut flowers) = (first, flowers.iter().peekable());
        for node in 0..block.nodes() {
            let id = block.id(node);
            nodes.push(next);
            next += 1;
            let mut place = |organ: &NewOrgan| {
                mixed.push(*organ);
                organs.push(next);
                next += 1;
            };
            if !leaves.rows.is_empty() {
                leaves.rows[leaves.things.of(node)].iter().for_each(&mut place);
            }
            while let Some(flower) = flowers.next_if(|flower| flower.node == id) {
                place(flower);
            }
            while bearers.next_if_eq(&(node as u32)).is_some() {
                of_axes.push(next);
                next += 1;
            }
        }
    }

    /// The organs of the block in the order of their numbers.
    pub fn in_order<'a>(&'a self, leaves: &'a Leaves) -> &'a [NewOrgan] {
        if self.mixed.is_empty() { &leaves.rows } else { &self.mixed }
    }
}

/// The place in the block of the node that bears a new axis.
#[inline]
fn bearer_of(axis: &NewAxis, block: &Block<'_>) -> u32 {
    axis.bearer.map_or(0, |bearer| bearer.0 - block.first.0)
}
