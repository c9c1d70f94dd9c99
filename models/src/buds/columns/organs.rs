//! The leaves, flowers and fruits of a block of nodes, and the component numbers of the block.
//!
//! On a node the internode comes first, then its leaves, its flowers each with its fruit, and the axes of its buds.
//! What the organs of a node draw stands together in its record, so they are drawn node by node, by laws that are
//! looked up as often as they change, and written where they stay.

use super::block::Block;
use super::dress::{FlowerLaws, LeafLaws};
use super::dressing::{Borne, Dressing};
use phytomer_sim::plant::{NewAxis, OrganTile, Organs};

/// The component numbers of a block, and room for its organs.
#[derive(Debug, Default)]
pub struct Numbers {
    tile: OrganTile,
    /// The component numbers of nodes and of new axes.
    pub nodes: Vec<u32>,
    pub axes: Vec<u32>,
    /// The number behind the last.
    pub next: u32,
}

impl Numbers {
    /// Numbers nodes that bear no organs from `first` on: from one that bears an axis to the next their numbers follow
    /// one another.
    pub fn set_bare(&mut self, block: &Block<'_>, first: u32, axes: &[NewAxis]) {
        self.clear();
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
        self.next = next;
    }

    /// Draws the organs of nodes and adds them to those of their plant; numbers the components of the block from
    /// `first` on.
    pub fn draw(&mut self, block: &Block<'_>, first: u32, borne: &Borne<'_>, organs: &mut Organs) {
        let bears = |numbers: &[u32]| numbers.iter().any(|number| *number > 0);
        if !bears(borne.leaves) && !bears(borne.flowers) {
            return self.set_bare(block, first, borne.axes);
        }
        self.clear();
        let Self { tile, nodes, axes, next } = self;
        let mut dressing = Dressing { tile, organs, next: first };
        dress(&mut dressing, block, borne, (nodes, axes));
        *next = dressing.next;
        self.tile.empty(organs);
    }

    fn clear(&mut self) {
        self.nodes.clear();
        self.axes.clear();
    }
}

/// Writes the organs of each node, and the numbers of nodes and axes.
#[inline(always)]
fn dress(
    dressing: &mut Dressing<'_>,
    block: &Block<'_>,
    borne: &Borne<'_>,
    (nodes, axes): (&mut Vec<u32>, &mut Vec<u32>),
) {
    let Some(first) = block.pieces.first() else { return };
    let mut bearers = borne.axes.iter().map(|axis| bearer_of(axis, block)).peekable();
    let (mut leaf, mut flower) = (LeafLaws::of(block, first), FlowerLaws::of(block, first));
    nodes.reserve(block.nodes());
    for piece in block.pieces {
        leaf.go_to(piece);
        flower.go_to(piece);
        for node in piece.places() {
            nodes.push(dressing.number());
            let words = block.record(node);
            if borne.leaves[node] > 0 {
                leaf.stand_on(piece, node);
                let place = (block.id(node), borne.azimuth[node], borne.spacing[node]);
                leaf.dress(dressing, words, place, borne.leaves[node]);
            }
            if borne.flowers[node] > 0 {
                flower.dress(dressing, words, (piece, node), borne);
            }
            while bearers.next_if_eq(&(node as u32)).is_some() {
                axes.push(dressing.number());
            }
        }
    }
}

/// The place in the block of the node that bears a new axis.
#[inline]
fn bearer_of(axis: &NewAxis, block: &Block<'_>) -> u32 {
    axis.bearer.map_or(0, |bearer| bearer.0 - block.first.0)
}
