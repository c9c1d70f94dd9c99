//! A block of nodes that are made at once, of axes of one order: what is known of them before anything is drawn.
//!
//! Absent: the columns themselves (`nodes`, `axes`), and the organs (`organs`).

use crate::buds::compile::{BudModel, Draws, OrderLaws, Piece, Ranks};
use crate::buds::plan::Shoot;
use crate::law::At;
use phytomer_sim::plant::NodeId;
use phytomer_sim::random::PlantRandom;

/// A block of nodes.
#[derive(Clone, Copy)]
pub struct Block<'a> {
    pub model: &'a BudModel,
    pub laws: &'a OrderLaws,
    /// The draws of the plant.
    pub random: &'a PlantRandom,
    /// The growth units of the nodes.
    pub pieces: &'a [Piece],
    /// The axes of the nodes.
    pub shoots: &'a [Shoot],
    /// The ranks of the zones that growth units have drawn.
    pub zones: &'a [Ranks],
    /// The ranks from which the trends of axes hold, where they draw them.
    pub trends: &'a [(u32, u8)],
    /// The words in which the records of the nodes stand. Behind them stand as many more as there can be things of one
    /// kind on a node.
    pub words: &'a [u32],
    /// The place of the record of each node.
    pub records: &'a [u32],
    /// The handle of the first node.
    pub first: NodeId,
}

impl<'a> Block<'a> {
    /// The number of nodes.
    pub fn nodes(&self) -> usize {
        self.pieces.last().map_or(0, |piece| piece.nodes.1 as usize)
    }

    /// The handle of the node at a place of the block.
    #[inline]
    pub fn id(&self, node: usize) -> NodeId {
        NodeId(self.first.0 + node as u32)
    }

    /// The ranks from which the trends of an axis hold, where it draws them.
    #[inline]
    pub fn trends_of(&self, shoot: &Shoot) -> &'a [(u32, u8)] {
        &self.trends[shoot.trends.0 as usize..shoot.trends.1 as usize]
    }

    /// The record of the node at a place of the block.
    #[inline]
    pub fn record(&self, node: usize) -> &'a [u32] {
        &self.words[self.records[node] as usize..]
    }

    /// The draws of all nodes.
    pub fn draws(&self) -> Draws<'a> {
        Draws { words: self.words, pieces: self.pieces, records: self.records }
    }

    /// Every node with its growth unit and the point of its laws, in their order.
    pub fn each(&self, mut told: impl FnMut(usize, &Piece, At)) {
        for piece in self.pieces {
            piece.places().for_each(|node| told(node, piece, piece.at(node)));
        }
    }

    /// The ranks of the zones that the growth unit of a piece has drawn, if any.
    #[inline]
    pub fn zones_of(&self, piece: &Piece) -> &'a [Ranks] {
        &self.zones[piece.zones.0 as usize..piece.zones.1 as usize]
    }
}
