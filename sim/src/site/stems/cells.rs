//! The cells of space through which the stems of a plant pass, so that a bud asks those beside it alone.
//!
//! Cells are cubes of one edge, twice as long as the stems are on average; they stand in bricks of 8 × 8 × 8 that
//! are made where stems come, so memory follows the wood. A stem is entered once in each cell that the box about a part
//! of it touches, with the radius that it was entered for, and stays there from tick to tick as long as it stands where
//! it stood. Found are all that may be near, some of them more than once and in no order that means anything. Places
//! are metres from the seed. Absent: the stems themselves.

use super::Stem;
use crate::shape::Point;

/// The cells along an edge of a brick, as a power of 2.
const BITS: u32 = 3;
/// The cells of a brick.
const CELLS: usize = 1 << (3 * BITS);
/// The farthest cell along each axis.
const FARTHEST: f64 = (1 << 20) as f64;
/// The most cells that a stem is entered in, or that a bud asks: beyond it all stems are asked.
const MOST_CELLS: i64 = 4_096;
/// The least and the largest edge of cells, metres.
const SHORTEST: f64 = 0.01;
const LONGEST: f64 = 100.0;
/// No entry, and no brick.
const NONE: u32 = u32::MAX;
/// What places may lack in digits, metres.
const ROUNDING: f64 = 1e-4;

/// A box of cells, both corners included.
pub(super) type Range = [[i32; 3]; 2];

/// The cells of a plant.
#[derive(Debug, Clone, Default)]
pub(super) struct Cells {
    /// The edge of a cell, metres; 0 before any stem is known.
    edge: f64,
    /// The bricks by their places, in a table of open addresses.
    table: Vec<u32>,
    bricks: Vec<[i32; 3]>,
    /// The first entry of each cell, brick by brick.
    first: Vec<u32>,
    entries: Vec<Entry>,
    /// The first entry that has been given back.
    free: u32,
    /// The stems that pass through too many cells.
    long: Vec<u32>,
}

#[derive(Debug, Clone, Copy)]
struct Entry {
    node: u32,
    next: u32,
}

impl Cells {
    /// Empty cells for stems that are so long on average, metres.
    pub fn of(length: f64) -> Self {
        let edge = (2.0 * length).clamp(SHORTEST, LONGEST);
        Self { edge, table: vec![NONE; 64], free: NONE, ..Self::default() }
    }

    /// Whether stems that are so long on average, metres, would still be entered in such cells.
    pub fn suit(&self, length: f64) -> bool {
        (0.5 * self.edge..=2.0 * self.edge).contains(&(2.0 * length).clamp(SHORTEST, LONGEST))
    }

    /// The cells of the box about a ball; `None` where they are too many to be asked.
    pub fn about(&self, point: Point, reach: f64) -> Option<Range> {
        let range = range_of(self.edge, [point.map(|x| x - reach), point.map(|x| x + reach)]);
        (count(&range) <= MOST_CELLS).then_some(range)
    }

    /// The cells of each part of a stem; `None` where they are too many.
    fn parts(&self, stem: &Stem) -> Option<impl Iterator<Item = Range> + use<>> {
        let [start, end] = [stem.start, stem.end].map(|end| end.map(f64::from));
        let margin = f64::from(stem.entered);
        let along = [0, 1, 2].map(|k| end[k] - start[k]);
        let longest = along.iter().fold(0.0_f64, |longest, x| longest.max(x.abs()));
        let parts = (longest / self.edge).ceil().max(1.0);
        let across = 2.0 * margin / self.edge + 3.0;
        if !parts.is_finite() || parts * (across * across * across) > MOST_CELLS as f64 {
            return None;
        }
        let edge = self.edge;
        Some((0..parts as u32).map(move |part| {
            let at = |share: f64| [0, 1, 2].map(|k| start[k] + along[k] * share);
            let [from, to] = [at(f64::from(part) / parts), at(f64::from(part + 1) / parts)];
            let low = [0, 1, 2].map(|k| from[k].min(to[k]) - margin);
            range_of(edge, [low, [0, 1, 2].map(|k| from[k].max(to[k]) + margin)])
        }))
    }

    /// Whether two stems are entered in the same cells.
    pub fn same(&self, one: &Stem, other: &Stem) -> bool {
        match (self.parts(one), self.parts(other)) {
            (Some(one), Some(other)) => one.eq(other),
            (one, other) => one.is_none() && other.is_none(),
        }
    }

    /// Enters a stem.
    pub fn enter(&mut self, node: u32, stem: &Stem) {
        let Some(parts) = self.parts(stem) else { return self.long.push(node) };
        for range in parts {
            each_cell(&range, |cell| {
                let slot = self.make(cell);
                let first = self.first[slot];
                // The part before may have been entered here.
                if first == NONE || self.entries[first as usize].node != node {
                    self.first[slot] = self.entry(Entry { node, next: first });
                }
            });
        }
    }

    /// Takes a stem out again, as it was entered.
    pub fn remove(&mut self, node: u32, stem: &Stem) {
        let Some(parts) = self.parts(stem) else { return self.long.retain(|long| *long != node) };
        for range in parts {
            each_cell(&range, |cell| {
                let Some(slot) = self.slot(cell) else { return };
                let (mut before, mut entry) = (NONE, self.first[slot]);
                while entry != NONE {
                    let Entry { node: found, next } = self.entries[entry as usize];
                    if found == node {
                        match before {
                            NONE => self.first[slot] = next,
                            before => self.entries[before as usize].next = next,
                        }
                        self.entries[entry as usize].next = self.free;
                        self.free = entry;
                        return;
                    }
                    (before, entry) = (entry, next);
                }
            });
        }
    }

    /// Shows the stems of a box of cells.
    pub fn each_in(&self, range: &Range, mut show: impl FnMut(u32)) {
        let mut brick = (NONE, [i32::MIN; 3]);
        each_cell(range, |cell| {
            let place = cell.map(|x| x >> BITS);
            if brick.1 != place {
                brick = (self.brick(place), place);
            }
            if brick.0 == NONE {
                return;
            }
            let mut entry = self.first[brick.0 as usize * CELLS + inner(cell)];
            while let Some(Entry { node, next }) = self.entries.get(entry as usize) {
                show(*node);
                entry = *next;
            }
        });
        self.long.iter().for_each(|node| show(*node));
    }

    fn entry(&mut self, entry: Entry) -> u32 {
        if self.free == NONE {
            self.entries.push(entry);
            return self.entries.len() as u32 - 1;
        }
        let place = self.free;
        self.free = self.entries[place as usize].next;
        self.entries[place as usize] = entry;
        place
    }

    fn slot(&self, cell: [i32; 3]) -> Option<usize> {
        let brick = self.brick(cell.map(|x| x >> BITS));
        (brick != NONE).then(|| brick as usize * CELLS + inner(cell))
    }

    fn brick(&self, place: [i32; 3]) -> u32 {
        self.table.get(self.address(place)).copied().unwrap_or(NONE)
    }

    /// Where a brick is in the table, or where there is room for it.
    fn address(&self, [x, y, z]: [i32; 3]) -> usize {
        let packed = (x as u32 as u64) ^ ((y as u32 as u64) << 21) ^ ((z as u32 as u64) << 42);
        let mask = self.table.len().wrapping_sub(1);
        let mut slot = (packed.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32) as usize & mask;
        while self.table.get(slot).is_some_and(|brick| *brick != NONE && self.bricks[*brick as usize] != [x, y, z]) {
            slot = (slot + 1) & mask;
        }
        slot
    }

    /// The place of a cell, whose brick is made if need be.
    fn make(&mut self, cell: [i32; 3]) -> usize {
        if let Some(slot) = self.slot(cell) {
            return slot;
        }
        let brick = self.bricks.len() as u32;
        self.bricks.push(cell.map(|x| x >> BITS));
        self.first.resize(self.first.len() + CELLS, NONE);
        if self.bricks.len() * 2 > self.table.len() {
            self.table = vec![NONE; self.table.len() * 4];
            (0..=brick).for_each(|brick| self.place_in_table(brick));
        } else {
            self.place_in_table(brick);
        }
        brick as usize * CELLS + inner(cell)
    }

    fn place_in_table(&mut self, brick: u32) {
        let address = self.address(self.bricks[brick as usize]);
        self.table[address] = brick;
    }
}

/// The cells that a box touches.
fn range_of(edge: f64, [low, high]: [Point; 2]) -> Range {
    let cell = |at: f64| {
        let at = (at / edge).clamp(-FARTHEST, FARTHEST);
        // Rounded down, without the call that `floor` is on machines that have no instruction for it.
        let whole = at as i32;
        whole - i32::from(at < f64::from(whole))
    };
    [low.map(|x| cell(x - ROUNDING)), high.map(|x| cell(x + ROUNDING))]
}

/// The place of a cell in its brick.
fn inner([x, y, z]: [i32; 3]) -> usize {
    let inner = |x: i32| (x & ((1 << BITS) - 1)) as usize;
    (inner(z) << (2 * BITS)) | (inner(y) << BITS) | inner(x)
}

fn count([low, high]: &Range) -> i64 {
    (0..3).map(|k| (i64::from(high[k]) - i64::from(low[k]) + 1).max(0)).fold(1, i64::saturating_mul)
}

fn each_cell([low, high]: &Range, mut show: impl FnMut([i32; 3])) {
    for z in low[2]..=high[2] {
        for y in low[1]..=high[1] {
            (low[0]..=high[0]).for_each(|x| show([x, y, z]));
        }
    }
}
