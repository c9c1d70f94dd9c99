//! The cells of space in which the stems of a plant lie, so that a bud asks those beside it alone.
//!
//! Cells are cubes of one edge, four times as long as the stems are on average; they stand in bricks of 4 × 4 × 4 that
//! are made where stems come, so memory follows the wood. A stem is entered in the cell of its middle, with the radius
//! that it was entered for, and stays there from tick to tick as long as it stands where it stood; who asks looks as
//! much farther as the widest of them reaches. One that is wider than a cell is entered once in each cell that the box
//! about a part of it touches. Bits tell which cells of a brick hold anything, so that most of a box of cells is passed
//! over by 64. Found are all that may be near, some of them more than once and in no order that means anything. Places
//! are metres from the seed. Absent: the stems themselves.

use super::Stem;
use crate::shape::Point;

/// The edge of a cell beside the stems, which are so long on average. Most of the longest then lie in the cell of their
/// middle: of twice the average a sixth were entered in eight cells and more each.
const STEMS: f64 = 4.0;
/// The cells along an edge of a brick, as a power of 2.
const BITS: u32 = 2;
/// The last cell along an edge of a brick.
const LAST: i32 = (1 << BITS) - 1;
/// The cells of a brick.
const CELLS: usize = 1 << (3 * BITS);
/// The farthest cell along each axis.
const FARTHEST: f64 = (1 << 20) as f64;
/// The most cells that a stem is entered in; those that pass through more are always asked.
const MOST_CELLS: i64 = 4_096;
/// The most cells that a bud asks: beyond it all stems are asked.
const MOST_ASKED: i64 = 32_768;
/// The least and the largest edge of cells, metres.
const SHORTEST: f64 = 0.01;
const LONGEST: f64 = 100.0;
/// No entry, and no brick.
const NONE: u32 = u32::MAX;
/// What places may lack in digits, metres.
const ROUNDING: f64 = 1e-4;
/// No axis.
pub(super) const NO_AXIS: u32 = u32::MAX;

/// A box of cells, both corners included.
pub(super) type Range = [[i32; 3]; 2];

/// The cells of a plant.
#[derive(Debug, Clone, Default)]
pub(super) struct Cells {
    /// The edge of a cell, metres; 0 before any stem is known.
    edge: f64,
    /// The cells in a metre.
    per_metre: f64,
    /// How far a stem reaches beyond its middle along an axis, of those that are entered by it, metres.
    widest: f64,
    /// The bricks by their places, in a table of open addresses.
    table: Vec<u32>,
    bricks: Vec<Brick>,
    entries: Vec<Entry>,
    /// The first entry that has been given back.
    free: u32,
    /// The stems that pass through too many cells.
    long: Vec<u32>,
}

/// Cells beside one another.
#[derive(Debug, Clone, Copy)]
struct Brick {
    place: [i32; 3],
    /// Which cells hold anything, a bit each.
    full: u64,
    /// The first entry of each cell.
    first: [u32; CELLS],
}

#[derive(Debug, Clone, Copy)]
struct Entry {
    node: u32,
    axis: u32,
    next: u32,
}

/// Where a stem is entered.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Place {
    /// In the cell of its middle.
    Middle([i32; 3]),
    /// In the cells of each of so many parts.
    Parts(u32),
    /// Among those that pass through too many cells.
    Long,
}

impl Cells {
    /// Empty cells for stems that are so long on average, metres.
    pub fn of(length: f64) -> Self {
        let edge = (STEMS * length).clamp(SHORTEST, LONGEST);
        Self { edge, per_metre: 1.0 / edge, table: vec![NONE; 64], free: NONE, ..Self::default() }
    }

    /// Whether stems that are so long on average, metres, would still be entered in such cells.
    pub fn suit(&self, length: f64) -> bool {
        (0.5 * self.edge..=2.0 * self.edge).contains(&(STEMS * length).clamp(SHORTEST, LONGEST))
    }

    /// The cells to be asked about a ball; `None` where they are too many.
    pub fn about(&self, point: Point, reach: f64) -> Option<Range> {
        self.around([point.map(|x| x - reach), point.map(|x| x + reach)])
    }

    /// The cells to be asked about a box; `None` where they are too many.
    pub fn around(&self, [low, high]: [Point; 2]) -> Option<Range> {
        let range = range_of(self.per_metre, [low.map(|x| x - self.widest), high.map(|x| x + self.widest)]);
        (count(&range) <= MOST_ASKED).then_some(range)
    }

    /// Where a stem is entered.
    fn place_of(&self, stem: &Stem) -> Place {
        let wide = wide(stem);
        if wide <= 0.5 * self.edge {
            let middle = [0, 1, 2].map(|k| 0.5 * (f64::from(stem.start[k]) + f64::from(stem.end[k])));
            return Place::Middle(middle.map(|x| cell_of(self.per_metre, x)));
        }
        let longest = 2.0 * (wide - f64::from(stem.entered));
        let parts = (longest / self.edge).ceil().max(1.0);
        let across = 2.0 * f64::from(stem.entered) / self.edge + 3.0;
        if !parts.is_finite() || parts * (across * across * across) > MOST_CELLS as f64 {
            return Place::Long;
        }
        Place::Parts(parts as u32)
    }

    /// The cells of each part of a stem.
    fn parts(&self, stem: &Stem, parts: u32) -> impl Iterator<Item = Range> + use<> {
        let [start, end] = [stem.start, stem.end].map(|end| end.map(f64::from));
        let margin = f64::from(stem.entered);
        let along = [0, 1, 2].map(|k| end[k] - start[k]);
        let per_metre = self.per_metre;
        (0..parts).map(move |part| {
            let at = |share: f64| [0, 1, 2].map(|k| start[k] + along[k] * share);
            let [from, to] = [part, part + 1].map(|part| at(f64::from(part) / f64::from(parts)));
            let low = [0, 1, 2].map(|k| from[k].min(to[k]) - margin);
            range_of(per_metre, [low, [0, 1, 2].map(|k| from[k].max(to[k]) + margin)])
        })
    }

    /// Whether a stem may stay where another one was entered.
    pub fn same(&self, one: &Stem, other: &Stem) -> bool {
        match (self.place_of(one), self.place_of(other)) {
            (Place::Middle(one), Place::Middle(at)) => one == at && wide(other) <= self.widest,
            (Place::Parts(few), Place::Parts(many)) => self.parts(one, few).eq(self.parts(other, many)),
            (one, other) => one == other,
        }
    }

    /// Enters a stem.
    pub fn enter(&mut self, node: u32, stem: &Stem) {
        match self.place_of(stem) {
            Place::Middle(cell) => {
                self.widest = self.widest.max(wide(stem));
                self.enter_in(cell, node, stem.axis);
            }
            Place::Parts(parts) => {
                for range in self.parts(stem, parts) {
                    each_cell(&range, |cell| self.enter_in(cell, node, stem.axis));
                }
            }
            Place::Long => self.long.push(node),
        }
    }

    fn enter_in(&mut self, cell: [i32; 3], node: u32, axis: u32) {
        let (brick, inner) = (self.make(cell), inner(cell));
        let next = self.bricks[brick].first[inner];
        // The part before may have been entered here.
        if next == NONE || self.entries[next as usize].node != node {
            let entry = self.entry(Entry { node, axis, next });
            let brick = &mut self.bricks[brick];
            brick.first[inner] = entry;
            brick.full |= 1 << inner;
        }
    }

    /// Takes a stem out again, as it was entered.
    pub fn remove(&mut self, node: u32, stem: &Stem) {
        match self.place_of(stem) {
            Place::Middle(cell) => self.remove_from(cell, node),
            Place::Parts(parts) => {
                for range in self.parts(stem, parts) {
                    each_cell(&range, |cell| self.remove_from(cell, node));
                }
            }
            Place::Long => self.long.retain(|long| *long != node),
        }
    }

    fn remove_from(&mut self, cell: [i32; 3], node: u32) {
        let (brick, inner) = (self.brick(cell.map(|x| x >> BITS)), inner(cell));
        let Some(brick) = self.bricks.get_mut(brick as usize) else { return };
        let (mut before, mut entry) = (NONE, brick.first[inner]);
        while entry != NONE {
            let Entry { node: found, next, .. } = self.entries[entry as usize];
            if found == node {
                match before {
                    NONE => brick.first[inner] = next,
                    before => self.entries[before as usize].next = next,
                }
                self.entries[entry as usize].next = self.free;
                self.free = entry;
                break;
            }
            (before, entry) = (entry, next);
        }
        if brick.first[inner] == NONE {
            brick.full &= !(1 << inner);
        }
    }

    /// Shows the stems of a box of cells, but for most of an axis that is spared, until one of them is enough.
    pub fn each_in(&self, [low, high]: &Range, spared: u32, mut is_enough: impl FnMut(u32) -> bool) {
        for long in &self.long {
            if is_enough(*long) {
                return;
            }
        }
        let [first, last] = [low, high].map(|corner| corner.map(|x| x >> BITS));
        for z in first[2]..=last[2] {
            for y in first[1]..=last[1] {
                for x in first[0]..=last[0] {
                    let place = [x, y, z];
                    let Some(brick) = self.bricks.get(self.brick(place) as usize) else { continue };
                    if self.each_in_brick(brick, within(place, low, high), spared, &mut is_enough) {
                        return;
                    }
                }
            }
        }
    }

    /// Shows the stems of a box of cells within a brick; whether one of them was enough.
    fn each_in_brick(
        &self,
        brick: &Brick,
        [low, high]: Range,
        spared: u32,
        is_enough: &mut impl FnMut(u32) -> bool,
    ) -> bool {
        // Four bits are a row along x, and four rows a layer.
        let row = (0xf_u64 << low[0]) & (0xf >> (LAST - high[0]));
        let layer = (row * 0x1111) & (0xffff << (4 * low[1])) & (0xffff >> (4 * (LAST - high[1])));
        let layers = (u64::MAX << (16 * low[2])) & (u64::MAX >> (16 * (LAST - high[2])));
        let mut full = brick.full & (layer * 0x0001_0001_0001_0001) & layers;
        while full != 0 {
            let mut entry = brick.first[full.trailing_zeros() as usize];
            full &= full - 1;
            while let Some(Entry { node, axis, next }) = self.entries.get(entry as usize) {
                if *axis != spared && is_enough(*node) {
                    return true;
                }
                entry = *next;
            }
        }
        false
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

    fn brick(&self, place: [i32; 3]) -> u32 {
        self.table.get(self.address(place)).copied().unwrap_or(NONE)
    }

    /// Where a brick is in the table, or where there is room for it.
    fn address(&self, [x, y, z]: [i32; 3]) -> usize {
        let packed = (x as u32 as u64) ^ ((y as u32 as u64) << 21) ^ ((z as u32 as u64) << 42);
        let mask = self.table.len().wrapping_sub(1);
        let mut slot = (packed.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32) as usize & mask;
        while self
            .table
            .get(slot)
            .is_some_and(|brick| *brick != NONE && self.bricks[*brick as usize].place != [x, y, z])
        {
            slot = (slot + 1) & mask;
        }
        slot
    }

    /// The brick of a cell, which is made if need be.
    fn make(&mut self, cell: [i32; 3]) -> usize {
        let place = cell.map(|x| x >> BITS);
        let known = self.brick(place);
        if known != NONE {
            return known as usize;
        }
        let brick = self.bricks.len() as u32;
        self.bricks.push(Brick { place, full: 0, first: [NONE; CELLS] });
        if self.bricks.len() * 2 > self.table.len() {
            self.table = vec![NONE; self.table.len() * 4];
            (0..=brick).for_each(|brick| self.place_in_table(brick));
        } else {
            self.place_in_table(brick);
        }
        brick as usize
    }

    fn place_in_table(&mut self, brick: u32) {
        let address = self.address(self.bricks[brick as usize].place);
        self.table[address] = brick;
    }
}

/// How far a stem reaches from its middle along an axis of space, as it is entered, metres.
fn wide(stem: &Stem) -> f64 {
    let longest = (0..3).map(|k| (f64::from(stem.end[k]) - f64::from(stem.start[k])).abs()).fold(0.0, f64::max);
    0.5 * longest + f64::from(stem.entered)
}

/// The part of a box of cells that lies in a brick, counted from its first cell.
fn within(brick: [i32; 3], low: &[i32; 3], high: &[i32; 3]) -> Range {
    let inner = |k: usize, cell: i32| (cell - (brick[k] << BITS)).clamp(0, LAST);
    [[inner(0, low[0]), inner(1, low[1]), inner(2, low[2])], [inner(0, high[0]), inner(1, high[1]), inner(2, high[2])]]
}

/// The cell of a place along an axis, of so many cells in a metre.
fn cell_of(per_metre: f64, at: f64) -> i32 {
    let at = (at * per_metre).clamp(-FARTHEST, FARTHEST);
    // Rounded down, without the call that `floor` is on machines that have no instruction for it.
    let whole = at as i32;
    whole - i32::from(at < f64::from(whole))
}

/// The cells that a box touches.
fn range_of(per_metre: f64, [low, high]: [Point; 2]) -> Range {
    [low.map(|x| cell_of(per_metre, x - ROUNDING)), high.map(|x| cell_of(per_metre, x + ROUNDING))]
}

/// The place of a cell in its brick.
fn inner([x, y, z]: [i32; 3]) -> usize {
    let inner = |x: i32| (x & LAST) as usize;
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
