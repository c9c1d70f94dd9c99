//! The light of one source on open ground, voxel by voxel as the light meets them: what lies between costs nothing.
//!
//! The beams are those of `lattice`: an edge of a voxel apart across their way, each row shifted by the golden ratio.
//! So of a voxel, which is at most √3 edges wide, at most two rows of them are met and two beams of each row. These
//! four are asked at once for their ways in the voxel, the longest common stretch of its three pairs of faces (Kay &
//! Kajiya 1986, "Ray tracing complex scenes"); one that passes beside it has none. Voxels are taken in an order in
//! which no beam comes to one before those that lie in front of it, and beams keep what is left of them from voxel to
//! voxel. Machines that hold four numbers in a register ask the four beams at once (`four`).
//! Absent: plots that repeat and opaque shapes, for which beams are followed one by one (`beam`).

use super::beam::{Along, Shone};
#[cfg(target_arch = "x86_64")]
use super::four;
use super::grid::{BITS, EDGE, Grid};
use super::lattice::{across, shift_of};
use super::loss::{Pair, larger_of, lost_of_each, plus, smaller_of, times};
#[cfg(target_arch = "x86_64")]
use super::spot::rounded_by_instruction;
use super::spot::{FINE, rounded};
use super::tiles::{TILE, Tiles};
use super::wanted::{Brick, Wanted};
use super::{Balance, Source};
use crate::shape::Point;

/// The beams along an edge of a tile.
const SIDE: usize = 1 << TILE;
/// The tiles along an edge about a brick: it is at most 8 √3 edges wide and meets three; a power of 2.
const ABOUT: usize = 4;
/// The beams along an edge about a brick.
const BEAMS: usize = ABOUT * SIDE;
/// The voxels of which all is found that does not depend on the light of beams, before any keeps of it.
#[cfg(target_arch = "x86_64")]
const AT_ONCE: usize = 64;
/// A number so small that what is divided by it lies beyond all voxels.
const LEVEL: f64 = 1e-12;

/// The places of voxels along an edge of a brick, and of beams along that of a tile.
const PLACES: [f64; EDGE as usize] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

/// One beam.
#[derive(Debug, Clone, Copy)]
struct Ray {
    /// Its place across the light, less the numbers of its column and its row.
    at: Pair,
    /// The share of its light that is not absorbed yet; a beam begins with 1.
    light: f64,
}

/// How a source looks at voxels, in edges of a voxel.
struct View {
    /// Two unit vectors across the beams; the first is level.
    axes: [Point; 2],
    /// Half the width of a voxel along each of the two.
    half: [f64; 2],
    /// By how much a beam comes later to the middle between each pair of faces for each edge that it lies aside, and
    /// above; and half the way between each pair of faces; metres.
    faces: [[f64; 3]; 3],
}

/// The beams of a source that may meet leaves, tile by tile. The beams of the first tile have no light and lie beyond
/// all voxels: it stands where a brick needs no tile.
struct Beams {
    view: View,
    rays: Vec<Ray>,
    tiles: Tiles,
}

/// Two beams of a row that may meet a voxel.
#[derive(Clone, Copy)]
struct Row {
    /// Their places among all beams.
    places: [usize; 2],
    /// The share of the light of each that is not absorbed yet.
    light: Pair,
    /// Their ways in the voxel, metres.
    ways: Pair,
}

/// A voxel and the four beams that may cross it.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy, Default)]
struct Met {
    number: usize,
    /// The extinction in it, 1/m.
    k: f64,
    /// The places of the beams among all.
    places: [usize; 4],
    /// Their ways in it, metres.
    ways: [f64; 4],
    /// The shares of them that are lost there, if any are.
    lost: [f64; 4],
}

/// The beams about the voxels of one brick.
struct About {
    /// The first beam of each tile, in rows.
    tiles: [u32; ABOUT * ABOUT],
    /// The middle of the first voxel of the brick, in beams from the first of the first tile.
    middle: [f64; 2],
    /// What each row is shifted by.
    shifts: [f64; BEAMS],
}

/// Sends the beams of a source through the wanted voxels of a grid on open ground, which have these extinctions, 1/m.
/// `room` is memory for the result.
#[allow(unsafe_code, reason = "the call of a function whose instructions not every machine has")]
pub fn shine(grid: &Grid, wanted: &Wanted, extinction: &[f64], source: &Source, room: Along) -> Shone {
    #[cfg(target_arch = "x86_64")]
    if is_x86_feature_detected!("avx2") {
        // SAFETY: safe code without a pointer; the call asks only that the machine has its instructions, as it says.
        return unsafe { shine_by_fours(grid, wanted, extinction, source, room) };
    }
    shine_by_pairs(grid, wanted, extinction, source, room)
}

/// By the registers of any machine.
pub(super) fn shine_by_pairs(grid: &Grid, wanted: &Wanted, extinction: &[f64], source: &Source, room: Along) -> Shone {
    let through = |beams: &mut Beams, about: &About, brick: Brick, along: &mut Along, kept: &mut f64| {
        for &entry in brick.voxels {
            let (voxel, number) = brick.voxel(entry);
            let (sums, lost) = beams.cross(about, voxel, extinction[number]);
            along[number] = sums;
            *kept += lost;
        }
    };
    shine_by((grid, wanted, extinction), source, room, (through, rounded))
}

/// The same, by registers of four numbers.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn shine_by_fours(grid: &Grid, wanted: &Wanted, extinction: &[f64], source: &Source, room: Along) -> Shone {
    let mut met = [Met::default(); AT_ONCE];
    let through = |beams: &mut Beams, about: &About, brick: Brick, along: &mut Along, kept: &mut f64| {
        beams.go_through(about, (brick, extinction), &mut met, along, kept);
    };
    shine_by((grid, wanted, extinction), source, room, (through, rounded_by_instruction))
}

#[inline(always)]
fn shine_by(
    (grid, wanted, extinction): (&Grid, &Wanted, &[f64]),
    source: &Source,
    mut along: Along,
    (mut through, whole): (impl FnMut(&mut Beams, &About, Brick, &mut Along, &mut f64), impl Fn(f64) -> f64 + Copy),
) -> Shone {
    let edge = grid.edges[0];
    let mut beams = Beams::of(source, grid);
    // Each wanted voxel is written below.
    along.resize(extinction.len(), [0.0; 2]);
    let way = source.towards.map(|x| -x);
    let mut kept = 0.0;
    for &brick in wanted.order(way) {
        let Some(filled) = wanted.box_of(brick as usize) else { continue };
        let about = beams.about(grid.bricks[brick as usize], filled, whole);
        through(&mut beams, &about, wanted.brick(brick as usize, way), &mut along, &mut kept);
    }
    let section = edge * edge;
    let (sent, passed) = beams.sent_and_passed();
    let [sent, kept, passed] = [sent, kept, passed].map(|of| of * section);
    Shone { along, balance: Balance { sent, kept, stopped: 0.0, passed }, section }
}

impl View {
    fn of(source: &Source, edge: f64) -> Self {
        let axes = across(source.towards);
        let half = axes.map(|axis| 0.5 * axis.iter().map(|share| share.abs()).sum::<f64>());
        // Along a level axis a beam is between the faces everywhere or nowhere.
        let way = source.towards.map(|x| if x.abs() < LEVEL { LEVEL } else { -x });
        let face = |k: usize| [-axes[0][k] / way[k], -axes[1][k] / way[k], 0.5 / way[k].abs()].map(|of| of * edge);
        let faces = [0, 1, 2].map(face);
        Self { axes, half, faces }
    }

    /// The least and the largest column and row of tiles whose beams may meet the voxels of a box, whose corners are
    /// edges of a voxel from a middle that is seen there.
    fn tiles(&self, seen: [f64; 2], corners: [Point; 2]) -> [[i64; 2]; 2] {
        let mut ends = [[0_i64; 2]; 2];
        for (k, axis) in self.axes.into_iter().enumerate() {
            let (mut below, mut above) = (0.0, 0.0);
            for of in 0..3 {
                let [one, other] = corners.map(|corner| axis[of] * corner[of]);
                (below, above) = (below + one.min(other), above + one.max(other));
            }
            // Rows are shifted by up to 1 in the direction of the first axis.
            let shift = [1.0, 0.0][k];
            let low = seen[k] + below - self.half[k] - 0.5 - shift;
            let high = seen[k] + above + self.half[k] - 0.5;
            (ends[0][k], ends[1][k]) = (low.floor() as i64 >> TILE, high.floor() as i64 >> TILE);
        }
        ends
    }

    /// A place, in edges of a voxel, as the light sees it.
    fn seen(&self, place: Point) -> [f64; 2] {
        self.axes.map(|axis| axis[0] * place[0] + axis[1] * place[1] + axis[2] * place[2])
    }
}

impl Beams {
    fn of(source: &Source, grid: &Grid) -> Self {
        let view = View::of(source, grid.edges[0]);
        // The bricks of a grid as one box; rounding may add a tile on each side.
        let [least, most] = grid.span().map(|place| place.map(f64::from));
        let voxels = [0, 1, 2].map(|k| (most[k] - least[k] + 1.0) * f64::from(EDGE) - 1.0);
        let seen = view.seen(least.map(|place| place * f64::from(EDGE) + 0.5));
        let [least, most] = view.tiles(seen, [[0.0; 3], voxels]);
        let tiles = Tiles::of([least.map(|of| of - 1), most.map(|of| of + 1)], grid.bricks.len());
        let beyond = Ray { at: [1e9; 2], light: 0.0 };
        Self { view, rays: vec![beyond; SIDE * SIDE], tiles }
    }

    /// All beams that were sent, and what is left of them.
    fn sent_and_passed(&self) -> (f64, f64) {
        let sent = &self.rays[SIDE * SIDE..];
        (sent.len() as f64, sent.iter().map(|ray| ray.light).sum())
    }

    /// The beams about the voxels of a brick in a box. `whole` is the nearest whole number.
    #[inline(always)]
    fn about(&mut self, brick: [i32; 3], filled: [[u8; 3]; 2], whole: impl Fn(f64) -> f64 + Copy) -> About {
        let first = brick.map(|place| f64::from(place << BITS) + 0.5);
        let seen = self.view.seen(first);
        let [[left, low], [right, high]] = self.view.tiles(seen, filled.map(|corner| corner.map(f64::from)));
        let (mut tiles, mut shifts) = ([0; ABOUT * ABOUT], [0.0; BEAMS]);
        for (row, tiles) in (low..=high).zip(tiles.chunks_exact_mut(ABOUT)) {
            (left..=right).zip(tiles).for_each(|(column, tile)| {
                let (number, is_new) = self.tiles.number([column, row]);
                if is_new {
                    self.add_tile([column, row], whole);
                }
                *tile = number << (2 * TILE);
            });
        }
        let rows = ((high - low + 1) << TILE) as usize;
        self.tiles.shifts(low, &mut shifts[..rows.min(BEAMS)]);
        let middle = [seen[0] - (left << TILE) as f64, seen[1] - (low << TILE) as f64];
        About { tiles, middle, shifts }
    }

    /// The beams of a tile of the lattice, eight of a row at once. They begin at places that are rounded as all places
    /// are.
    #[inline(always)]
    fn add_tile(&mut self, place: [i64; 2], whole: impl Fn(f64) -> f64) {
        let [left, low] = place.map(|place| place << TILE);
        let [level, upward] = self.view.axes;
        for row in low..low + SIDE as i64 {
            let (v, shift) = (row as f64 + 0.5, 0.5 + shift_of(row));
            // Loops in place of closures, so that registers of many numbers are used where the caller has them.
            let (mut aside, mut above) = ([0.0; SIDE], [0.0; SIDE]);
            for (along_level, along_upward) in level.into_iter().zip(upward) {
                for ((aside, above), column) in aside.iter_mut().zip(&mut above).zip(PLACES) {
                    let begins = along_level * ((left as f64 + column) + shift) + along_upward * v;
                    let off = whole(begins * FINE) / FINE - begins;
                    *aside += along_level * off;
                    *above += along_upward * off;
                }
            }
            let mut rays = [Ray { at: [0.0; 2], light: 1.0 }; SIDE];
            for (ray, (aside, above)) in rays.iter_mut().zip(aside.into_iter().zip(above)) {
                ray.at = [shift + aside, 0.5 + above];
            }
            self.rays.extend_from_slice(&rays);
        }
    }

    /// Lets a voxel, by its place in the brick, with this extinction keep of the beams that cross it: the intensity
    /// along their ways, summed over the ways, and the ways, metres; and what they lose.
    #[inline(always)]
    fn cross(&mut self, about: &About, voxel: [usize; 3], k: f64) -> (Pair, f64) {
        let View { axes: [level, upward], half, .. } = &self.view;
        let [x, y, z] = voxel.map(|place| PLACES[place % PLACES.len()]);
        let u = (about.middle[0] + (level[1] * y + level[2] * z)) + level[0] * x;
        let v = (about.middle[1] + (upward[1] * y + upward[2] * z)) + upward[0] * x;
        // The first row that may meet it.
        let (above, row) = nearest(v - half[1]);
        let first = self.row(about, row, [u, above - v]);
        let second = self.row(about, row + 1, [u, above + 1.0 - v]);
        let ways = plus(first.ways, second.ways);
        let of_ways = ways[0] + ways[1];
        if k <= 0.0 {
            let sums = plus(times(first.ways, first.light), times(second.ways, second.light));
            return ([sums[0] + sums[1], of_ways], 0.0);
        }
        let [one, other] = lost_of_each([first, second].map(|row| times(row.ways, [k; 2])));
        let (one, other) = (times(first.light, one), times(second.light, other));
        for (row, lost) in [(first, one), (second, other)] {
            self.rays[row.places[0]].light = row.light[0] - lost[0];
            self.rays[row.places[1]].light = row.light[1] - lost[1];
        }
        let lost = plus(one, other);
        let lost = lost[0] + lost[1];
        ([lost / k, of_ways], lost)
    }

    /// Lets the voxels of a brick keep of the beams as [`Beams::cross`] does, by registers of four numbers. What does
    /// not depend on the light of beams is found before, for many voxels: none waits for the one before it.
    #[cfg(target_arch = "x86_64")]
    #[inline]
    #[target_feature(enable = "avx2")]
    fn go_through(
        &mut self,
        about: &About,
        (brick, extinction): (Brick, &[f64]),
        met: &mut [Met; AT_ONCE],
        along: &mut Along,
        kept: &mut f64,
    ) {
        for entries in brick.voxels.chunks(AT_ONCE) {
            let met = &mut met[..entries.len()];
            for (met, &entry) in met.iter_mut().zip(entries) {
                let (voxel, number) = brick.voxel(entry);
                let (places, aside) = self.places(about, voxel);
                let at = |lane: usize| self.rays[places[lane]].at;
                let ways = four::ways(&self.view.faces, [at(0), at(1), at(2), at(3)], aside);
                *met = Met { number, k: extinction[number], places, ways, lost: ways };
            }
            for met in &mut *met {
                met.lost = four::lost_on(met.ways, met.k);
            }
            for Met { number, k, places, ways, lost } in &*met {
                let light = |lane: usize| self.rays[places[lane]].light;
                let light = [light(0), light(1), light(2), light(3)];
                let (sums, lost, left) = four::leave(light, *ways, *lost, *k);
                if *k > 0.0 {
                    (0..4).for_each(|lane| self.rays[places[lane]].light = left[lane]);
                }
                along[*number] = sums;
                *kept += lost;
            }
        }
    }

    /// The places of the four beams that may meet a voxel; how far their rows lie aside from its middle, and above it.
    #[cfg(target_arch = "x86_64")]
    #[inline(always)]
    fn places(&self, about: &About, voxel: [usize; 3]) -> ([usize; 4], [Pair; 2]) {
        let View { axes: [level, upward], half, .. } = &self.view;
        let [x, y, z] = voxel.map(|place| PLACES[place % PLACES.len()]);
        let u = (about.middle[0] + (level[1] * y + level[2] * z)) + level[0] * x;
        let v = (about.middle[1] + (upward[1] * y + upward[2] * z)) + upward[0] * x;
        let (above, row) = nearest(v - half[1]);
        let (first, one) = nearest(u - half[0] - about.shifts[row % BEAMS]);
        let (second, other) = nearest(u - half[0] - about.shifts[(row + 1) % BEAMS]);
        let places = [(row, one), (row, one + 1), (row + 1, other), (row + 1, other + 1)];
        let places = places.map(|(row, column)| about.place(row, column));
        (places, [[first - u, second - u], [above - v, above + 1.0 - v]])
    }

    /// The two beams of a row that may meet the voxel whose middle is seen at `u`, so far below the row.
    #[inline(always)]
    fn row(&self, about: &About, row: usize, [u, above]: [f64; 2]) -> Row {
        let (aside, column) = nearest(u - self.view.half[0] - about.shifts[row % BEAMS]);
        let aside = aside - u;
        let places = [about.place(row, column), about.place(row, column + 1)];
        let [one, other] = [&self.rays[places[0]], &self.rays[places[1]]];
        let light = [one.light, other.light];
        let aside = plus([one.at[0], other.at[0]], [aside, aside + 1.0]);
        let above = plus([one.at[1], other.at[1]], [above, above]);
        Row { places, light, ways: self.view.ways(aside, above) }
    }
}

impl View {
    /// The ways in a voxel, metres, of two beams that lie so far aside from its middle and above it.
    #[inline(always)]
    fn ways(&self, aside: Pair, above: Pair) -> Pair {
        let stretch = |[by_aside, by_above, half]: [f64; 3]| {
            let middle = plus(times(aside, [by_aside; 2]), times(above, [by_above; 2]));
            (plus(middle, [-half; 2]), plus(middle, [half; 2]))
        };
        let [(a, d), (b, e), (c, f)] = self.faces.map(stretch);
        let (enters, leaves) = (larger_of(larger_of(a, b), c), smaller_of(smaller_of(d, e), f));
        larger_of([leaves[0] - enters[0], leaves[1] - enters[1]], [0.0; 2])
    }
}

impl About {
    /// The place of a beam among all.
    #[inline(always)]
    fn place(&self, row: usize, column: usize) -> usize {
        let mask = SIDE - 1;
        let tile = self.tiles[((row >> TILE) * ABOUT + (column >> TILE)) % (ABOUT * ABOUT)];
        tile as usize | ((row & mask) << TILE) | (column & mask)
    }
}

/// The nearest whole number, of numbers that are not below 0 nor above those beside a brick.
#[inline(always)]
fn nearest(number: f64) -> (f64, usize) {
    // From 2⁵² on numbers are whole, so that the sum is rounded to one; its lowest bits are the number.
    const WHOLE: f64 = 4_503_599_627_370_496.0;
    let sum = number + WHOLE;
    (sum - WHOLE, sum.to_bits() as usize & (2 * BEAMS - 1))
}
