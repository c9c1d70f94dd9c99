//! What the nodes of a block bear, and the organs that they are given one after another.

use phytomer_sim::plant::{NewAxis, NewOrgan, OrganTile, Organs};

/// What the nodes of a block bear.
#[derive(Clone, Copy)]
pub struct Borne<'a> {
    /// The numbers of leaves, of flowers and of axillary buds of each node.
    pub leaves: &'a [u32],
    pub flowers: &'a [u32],
    pub buds: &'a [u32],
    /// The azimuth of the first leaf of each node, and the angle between two neighbouring positions.
    pub azimuth: &'a [f32],
    pub spacing: &'a [f32],
    /// The new axes, in the order of their nodes.
    pub axes: &'a [NewAxis],
}

/// Nodes while they are given their organs.
pub struct Dressing<'a> {
    pub tile: &'a mut OrganTile,
    /// The organs of the plant.
    pub organs: &'a mut Organs,
    /// The next component number.
    pub next: u32,
}

impl Dressing<'_> {
    /// Takes the next component number.
    #[inline(always)]
    pub fn number(&mut self) -> u32 {
        let number = self.next;
        self.next += 1;
        number
    }

    /// Adds the next organ.
    #[inline(always)]
    pub fn put(&mut self, organ: NewOrgan) {
        let number = self.number();
        self.tile.push(organ, number, self.organs);
    }
}
