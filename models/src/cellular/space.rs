//! Space as a plant meets it that grows in voxels: their lattice, the site, and what its neighbours in the plot have.
//!
//! A plant by itself has a lattice of its own, from its seed. The plants of a plot that share cells have one lattice,
//! from the place of the plot, so that a voxel is one cell of `phytomer_sim::cells`. Absent: what the plant itself has.

use super::around::Around;
use super::voxels::{Lattice, Voxel};
use phytomer_sim::plant::Plant;
use phytomer_sim::site::Site;

/// Space as a plant meets it.
pub(super) struct Space<'a> {
    pub lattice: Lattice,
    pub around: Around<'a>,
    /// The number of the plant.
    plant: u32,
    /// The lowest voxels that are not below the seed.
    ground: i32,
}

impl<'a> Space<'a> {
    /// The space around a plant, in voxels of an edge in metres.
    pub fn of(edge: f64, plant: &Plant, site: &'a Site) -> Self {
        let lattice = if site.cells.shared {
            Lattice::shared(edge, [0, 1, 2].map(|k| plant.place[k] - site.cells.origin[k]))
        } else {
            Lattice::of_one(edge)
        };
        let around = Around { site, place: plant.place };
        Self { lattice, around, plant: plant.id, ground: lattice.seed()[2] }
    }

    /// Whether another plant of the plot has a voxel.
    pub fn is_anothers(&self, voxel: Voxel) -> bool {
        let cells = &self.around.site.cells;
        cells.shared && cells.holder(voxel).is_some_and(|holder| holder != self.plant)
    }

    /// Whether a voxel reaches below the seed or touches what nothing can grow in: by its middle and its corners.
    pub fn is_shut(&self, voxel: Voxel) -> bool {
        let middle = self.lattice.middle_of(voxel);
        let half = 0.5 * self.lattice.edge;
        let corner = |k: u32| {
            let side = |bit: u32| if k >> bit & 1 == 0 { -half } else { half };
            [middle[0] + side(0), middle[1] + side(1), middle[2] + side(2)]
        };
        voxel[2] < self.ground || self.around.is_shut(middle) || (0..8).any(|k| self.around.is_shut(corner(k)))
    }
}
