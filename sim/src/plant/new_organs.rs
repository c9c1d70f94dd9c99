//! Organs that are added to a plant one after another.
//!
//! Organs come one by one, each with all its values; columns grow by slices. So organs are written into a tile of a
//! fixed number, where no place need be tested, and the columns grow by tiles.

use super::form::Form;
use super::handle::NodeId;
use super::kind::{Cause, Kind};
use super::{NewOrgan, Organs};
use crate::clock::Tick;

/// The organs of a tile: some kilobytes.
const TILE: usize = 64;

/// Organs that are added to a plant one after another; its memory is kept for other plants.
#[derive(Debug)]
pub struct OrganTile {
    tile: Tile,
    filled: usize,
}

impl Default for OrganTile {
    fn default() -> Self {
        Self { tile: Tile::BLANK, filled: 0 }
    }
}

impl OrganTile {
    /// Adds an organ with its component number to those of a plant, which may get it later.
    #[inline(always)]
    pub fn push(&mut self, organ: NewOrgan, component: u32, organs: &mut Organs) {
        self.tile.set(self.filled, organ, component);
        self.filled += 1;
        if self.filled == TILE {
            self.empty(organs);
        }
    }

    /// Gives the plant the organs that it has not got yet.
    #[inline(never)]
    pub fn empty(&mut self, organs: &mut Organs) {
        self.tile.add_to(self.filled, organs);
        self.filled = 0;
    }
}

/// The values of some organs.
macro_rules! tile {
    ($($column:ident: $type:ty = $blank:expr),*) => {
        #[derive(Debug)]
        struct Tile {
            component: [u32; TILE],
            $($column: [$type; TILE],)*
        }

        impl Tile {
            const BLANK: Self = Self { component: [0; TILE], $($column: [$blank; TILE],)* };

            /// Writes an organ at a place, which is within the tile.
            #[inline(always)]
            fn set(&mut self, place: usize, organ: NewOrgan, component: u32) {
                let place = place % TILE;
                self.component[place] = component;
                $(self.$column[place] = organ.$column;)*
            }

            /// Adds the first organs to columns.
            fn add_to(&self, number: usize, organs: &mut Organs) {
                organs.component.extend_from_slice(&self.component[..number]);
                $(organs.$column.extend_from_slice(&self.$column[..number]);)*
            }
        }
    };
}

tile! {
    node: NodeId = NodeId::NONE,
    kind: Kind = Kind::Leaf,
    position: u16 = 0,
    birth: Tick = 0,
    death: Tick = 0,
    cause: Cause = Cause::None,
    form: Form = Form(0),
    length: f32 = 0.0,
    width: f32 = 0.0,
    area: f32 = 0.0,
    azimuth: f32 = 0.0,
    insertion: f32 = 0.0
}
