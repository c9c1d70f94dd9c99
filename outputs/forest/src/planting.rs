//! The plants of each cell, of one tree or one grass.
//!
//! A cell of area A with the density d has ⌊d A + u⌋ plants, u uniform, so that the mean is d A; or one, where one a
//! cell is asked for. Each stands at a uniform place in its cell, is a variant by chance, turned and scaled by chance.
//! The draws are keyed by seed, tree or grass, row and column: what stands in other cells, or of other trees, changes
//! nothing. Nothing is kept, and every pass makes the same plants again. Absent: distances between neighbours.

use crate::cover::Cover;
use crate::height::Heights;
use phytomer_sim::key::{LineageKey, mix};
use phytomer_sim::random::{PlantRandom, Purpose};

/// What stands where a cell says so.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum What {
    /// The tree of a bit, from 0.
    Tree(u8),
    /// The grass of a number, from 1.
    Grass(u8),
}

impl What {
    /// Whether it stands in a cell.
    pub fn stands_in(self, cell: u16) -> bool {
        match self {
            Self::Tree(bit) => cell >> bit & 1 == 1,
            Self::Grass(number) => cell >> crate::cover::TREES == u16::from(number),
        }
    }

    /// The key of its draws.
    fn key(self) -> u64 {
        match self {
            Self::Tree(bit) => u64::from(bit),
            Self::Grass(number) => 0x100 + u64::from(number),
        }
    }
}

/// How many stand in a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Count {
    /// One.
    One,
    /// So many a square metre, in the mean.
    PerSquareMetre(f64),
}

/// How one tree or one grass is planted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Planting {
    /// What.
    pub what: What,
    /// How many.
    pub count: Count,
    /// The number of its variants, at least 1.
    pub variants: u32,
    /// The least and the greatest scale.
    pub scale: [f64; 2],
    /// The seed of all draws.
    pub seed: u64,
}

/// A plant in its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instance {
    /// Its variant, from 0.
    pub variant: u32,
    /// Its place, metres: to the east, to the north and up.
    pub place_m: [f64; 3],
    /// By how much it is turned about the vertical, radians.
    pub turn_rad: f64,
    /// Its size over that of its variant.
    pub scale: f64,
}

impl Planting {
    /// Hands on each plant, row by row from the north and cell by cell from the west.
    ///
    /// # Errors
    /// Those of `hand`.
    pub fn each<E>(
        &self,
        cover: &Cover,
        heights: Option<&Heights>,
        mut hand: impl FnMut(Instance) -> Result<(), E>,
    ) -> Result<(), E> {
        let random = PlantRandom::new(self.seed, self.what.key());
        let cell_m = cover.place().cell_m;
        let north = cover.far_edges()[1];
        for (row, cells) in (0_u32..).zip(cover.rows()) {
            for (column, _) in (0_u32..).zip(cells).filter(|(_, cell)| self.what.stands_in(**cell)) {
                let key = mix(u64::from(row) << 32 | u64::from(column), 0x666f_7265_7374);
                let mut draws = random.stream(LineageKey(key), Purpose::Forest);
                for _ in 0..self.number(cell_m * cell_m, draws.share()) {
                    let x_m = cover.place().west_m + (f64::from(column) + draws.share()) * cell_m;
                    let y_m = north - (f64::from(row) + draws.share()) * cell_m;
                    let variant = (draws.share() * f64::from(self.variants)) as u32;
                    let turn_rad = draws.share() * std::f64::consts::TAU;
                    let [least, most] = self.scale;
                    let scale = least + (most - least) * draws.share();
                    let place_m = [x_m, y_m, heights.map_or(0.0, |heights| heights.at(x_m, y_m))];
                    hand(Instance { variant: variant.min(self.variants - 1), place_m, turn_rad, scale })?;
                }
            }
        }
        Ok(())
    }

    /// How many stand in a cell of an area.
    fn number(&self, area_m2: f64, share: f64) -> u64 {
        match self.count {
            Count::One => 1,
            Count::PerSquareMetre(density) => (density * area_m2 + share) as u64,
        }
    }

    /// How many there are at most.
    pub fn at_most(&self, cover: &Cover) -> f64 {
        let cell_m = cover.place().cell_m;
        let cells = cover.rows().flatten().filter(|cell| self.what.stands_in(**cell)).count() as f64;
        match self.count {
            Count::One => cells,
            Count::PerSquareMetre(density) => cells * (density * cell_m * cell_m).ceil(),
        }
    }
}
