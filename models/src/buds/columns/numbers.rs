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
        let Self { nodes, organs, axes: of_axes, mixed } = self;
        [&mut *nodes, &mut *organs, &mut *of_axes].into_iter().for_each(Vec::clear);
        mixed.clear();
        let mut next = first;
        let mut number = |into: &mut Vec<u32>, count: usize| {
            let after = next + count as u32;
            into.extend(next..after);
            next = after;
        };
        let (mut flowers_left, mut axes_left) = (flowers, axes);
        for node in 0..block.nodes() {
            let id = block.id(node);
            number(nodes, 1);
            if !leaves.rows.is_empty() {
                number(organs, leaves.things.of(node).len());
            }
            if !flowers.is_empty() {
                let (here, later) = parted(flowers_left, |organ| organ.node == id);
                number(organs, here.len());
                if !leaves.rows.is_empty() {
                    mixed.extend_from_slice(&leaves.rows[leaves.things.of(node)]);
                }
                mixed.extend_from_slice(here);
                flowers_left = later;
            }
            let (here, later) = parted(axes_left, |axis| axis.bearer == Some(id));
            number(of_axes, here.len());
            axes_left = later;
        }
    }

    /// The organs of the block in the order of their numbers.
    pub fn in_order<'a>(&'a self, leaves: &'a Leaves) -> &'a [NewOrgan] {
        if self.mixed.is_empty() { &leaves.rows } else { &self.mixed }
    }
}

/// Parts the first entries, which stand on one node, from the others.
#[inline]
fn parted<T>(entries: &[T], on_node: impl Fn(&T) -> bool) -> (&[T], &[T]) {
    let here = entries.iter().take_while(|entry| on_node(entry)).count();
    entries.split_at(here)
}
