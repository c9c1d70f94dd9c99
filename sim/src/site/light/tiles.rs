//! Where the beams about a brick are found: tiles of 8 × 8 beams by their columns and rows, numbered as they are met.
//!
//! Where the bricks of a grid lie close together, a table has an entry for each tile that they can be seen in, and
//! what each row of beams is shifted by; bricks that lie far apart have a table of the tiles that are met (Knuth, The
//! Art of Computer Programming 3, §6.4, open addressing). Absent: the beams themselves (`sweep`).

use super::lattice::shift_of;

/// The beams along an edge of a tile, as a power of 2.
pub const TILE: u32 = 3;
/// The entries a brick that a table of all tiles may have.
const A_BRICK: u64 = 64;
/// The entries that any table of all tiles may have.
const FEW: u64 = 4_096;

/// The tiles of a source, by their columns and rows. Number 0 is none of them.
#[derive(Debug)]
pub struct Tiles {
    /// The number of each tile by its place, or 0.
    table: Vec<u32>,
    /// The tiles in the order of their numbers; where all have an entry, none is kept.
    places: Vec<[i64; 2]>,
    /// How many there are, and number 0.
    count: u32,
    /// The least column and row, and the columns of a row, where all have an entry.
    within: Option<([i64; 2], usize)>,
    /// What each row of beams is shifted by, from the least row on, where all have an entry.
    shifts: Vec<f64>,
}

impl Tiles {
    /// The tiles about so many bricks, in the columns and rows from `least` to `most`; none is met yet.
    pub fn of([least, most]: [[i64; 2]; 2], bricks: usize) -> Self {
        let [columns, rows] = [0, 1].map(|k| most[k].abs_diff(least[k]).saturating_add(1));
        let all = columns.saturating_mul(rows);
        let (mut table, mut within, mut shifts) = (vec![0; 64], None, Vec::new());
        if all <= A_BRICK.saturating_mul(bricks as u64).max(FEW) {
            (table, within) = (vec![0; all as usize], Some((least, columns as usize)));
            shifts = (least[1] << TILE..(most[1] + 1) << TILE).map(shift_of).collect();
        }
        Self { table, places: vec![[i64::MIN; 2]], count: 1, within, shifts }
    }

    /// The number of a tile, and whether it is met for the first time.
    #[inline]
    pub fn number(&mut self, place: [i64; 2]) -> (u32, bool) {
        let slot = match self.within {
            Some((least, columns)) => (place[1] - least[1]) as usize * columns + (place[0] - least[0]) as usize,
            None => self.slot_of(place),
        };
        let known = self.table[slot];
        if known != 0 {
            return (known, false);
        }
        self.table[slot] = self.count;
        self.count += 1;
        (self.count - 1, true)
    }

    /// Where a tile is in the table of those that are met, or where it has been given room.
    fn slot_of(&mut self, place: [i64; 2]) -> usize {
        let slot = self.look(place);
        if self.table[slot] != 0 {
            return slot;
        }
        self.places.push(place);
        if self.places.len() * 2 <= self.table.len() {
            return slot;
        }
        self.table = vec![0; self.table.len() * 4];
        for tile in 1..self.count {
            let slot = self.look(self.places[tile as usize]);
            self.table[slot] = tile;
        }
        self.look(place)
    }

    fn look(&self, [column, row]: [i64; 2]) -> usize {
        let mask = self.table.len() - 1;
        let packed = u64::from(column as u32) ^ (u64::from(row as u32) << 32);
        let mut slot = (packed.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32) as usize & mask;
        while self.table[slot] != 0 && self.places[self.table[slot] as usize] != [column, row] {
            slot = (slot + 1) & mask;
        }
        slot
    }

    /// What the rows of beams from the first of a tile on are shifted by.
    #[inline]
    pub fn shifts(&self, row: i64, shifts: &mut [f64]) {
        match self.within {
            Some((least, _)) => {
                let known = &self.shifts[((row - least[1]) << TILE) as usize..];
                let known = &known[..known.len().min(shifts.len())];
                shifts[..known.len()].copy_from_slice(known);
            }
            None => {
                for (shift, row) in shifts.iter_mut().zip(row << TILE..) {
                    *shift = shift_of(row);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both tables number tiles alike and know the same shifts.
    #[test]
    fn tables_of_all_tiles_and_of_those_that_are_met_agree() {
        let range = [[-40, -90], [60, 30]];
        let (mut all, mut met) = (Tiles::of(range, 1_000), Tiles::of(range, 0));
        assert!(all.within.is_some() && met.within.is_none());
        let mut new = 0;
        for k in 0..30_000_i64 {
            let place = [-40 + k * 7_919 % 101, -90 + k * k % 121];
            let (one, other) = (all.number(place), met.number(place));
            assert_eq!(one, other, "{place:?}");
            assert!(one.0 > 0);
            new += u32::from(one.1);
            let (mut one, mut other) = ([0.0; 24], [0.0; 24]);
            let row = place[1].min(28);
            all.shifts(row, &mut one);
            met.shifts(row, &mut other);
            assert_eq!(one.map(f64::to_bits), other.map(f64::to_bits));
        }
        assert_eq!(new + 1, all.count);
        assert!(new > 2_000, "{new} tiles are met");
        // Even a million bricks get no table of all tiles where they lie too far apart.
        let far = [[i64::from(i32::MIN); 2], [i64::from(i32::MAX); 2]];
        assert!(Tiles::of(far, 1 << 20).within.is_none());
    }
}
