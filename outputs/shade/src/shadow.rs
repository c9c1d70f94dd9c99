//! The points of a plan that lie in the shadow of a body at a moment.
//!
//! Each triangle is cut off at the ground and laid down along the rays of the sun; the points within what it covers are
//! marked. Which points a triangle may cover is read from the cells of their grids, row by row, so that the long thin
//! shadows of a low sun ask few of them. A point is within where it lies on no outer side of an edge, on an edge too,
//! so that no ray slips between two triangles. Leaves let no light through, and the sun is a point at its centre.

use crate::body::{Caster, Triangle};
use crate::polygon::{Point, bounds};
use crate::samples::{Grid, Samples};
use phytomer_sim::math::sincos;

/// A mark for each point of a plan.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Marks(Vec<u64>);

impl Marks {
    /// None of so many.
    pub fn none(points: usize) -> Self {
        Self(vec![0; points.div_ceil(64)])
    }

    /// Whether a point is marked.
    pub fn has(&self, point: usize) -> bool {
        self.0[point / 64] >> (point % 64) & 1 == 1
    }

    fn set(&mut self, point: usize) {
        self.0[point / 64] |= 1 << (point % 64);
    }

    /// The points that are marked here and not there, in their order.
    pub fn beyond<'a>(&'a self, other: Option<&'a Self>) -> impl Iterator<Item = usize> {
        let words = self.0.iter().enumerate().map(move |(k, word)| (k, word & !other.map_or(0, |other| other.0[k])));
        words
            .filter(|(_, word)| *word != 0)
            .flat_map(|(k, word)| (0..64).filter(move |bit| word >> bit & 1 == 1).map(move |bit| 64 * k + bit))
    }
}

/// Marks the points in the shadow of a caster in a month (from 0), where shadows shift by so much a metre of height.
pub fn cast(samples: &Samples, caster: &Caster<'_>, month: usize, shift: [f64; 2], marks: &mut Marks) {
    let (sin, cos) = sincos(caster.turn);
    let laid = |[x, y, z]: [f64; 3]| {
        [caster.place[0] + cos * x - sin * y + shift[0] * z, caster.place[1] + sin * x + cos * y + shift[1] * z]
    };
    for triangle in caster.body.triangles(caster.leafless[month]) {
        let (corners, count) = above_ground(triangle);
        let corners = corners.map(laid);
        for k in 2..count {
            cover(samples, [corners[0], corners[k - 1], corners[k]], marks);
        }
    }
}

/// What of a triangle lies above the ground: at most four corners, in their order, and their number.
fn above_ground(triangle: &Triangle) -> ([[f64; 3]; 4], usize) {
    let corners = triangle.map(|corner| corner.map(f64::from));
    let (mut kept, mut count) = ([[0.0; 3]; 4], 0);
    let mut keep = |corner: [f64; 3]| {
        kept[count] = corner;
        count += 1;
    };
    for k in 0..3 {
        let (from, to) = (corners[k], corners[(k + 1) % 3]);
        if from[2] >= 0.0 {
            keep(from);
        }
        if (from[2] >= 0.0) != (to[2] >= 0.0) {
            let share = from[2] / (from[2] - to[2]);
            keep([from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1]), 0.0]);
        }
    }
    (kept, count)
}

/// Marks the points within a triangle on the ground.
fn cover(samples: &Samples, corners: [Point; 3], marks: &mut Marks) {
    let turn = side(corners[0], corners[1], corners[2]);
    // Without an area it covers nothing, and a corner that is no number has no place.
    if turn == 0.0 || !turn.is_finite() {
        return;
    }
    let corners = if turn > 0.0 { corners } else { [corners[0], corners[2], corners[1]] };
    for grid in &samples.grids {
        let Some(local) = local(grid, &corners) else { continue };
        let [low, high] = bounds(&local);
        for row in cells(low[1], high[1], grid.size[1]) {
            let [from, to] = across(&local, row as f64);
            let first = row * grid.size[0];
            for column in cells(from, to, grid.size[0]) {
                let Some(point) = (grid.samples[first + column] as usize).checked_sub(1) else { continue };
                if within(&corners, samples.all[point].place) {
                    marks.set(point);
                }
            }
        }
    }
}

/// The triangle in units of the cells of a grid; `None` where it lies beside the grid.
fn local(grid: &Grid, corners: &[Point; 3]) -> Option<[Point; 3]> {
    let local = corners.map(|corner| [0, 1].map(|k| (corner[k] - grid.corner[k]) / grid.side[k]));
    let [low, high] = bounds(&local);
    let meets = (0..2).all(|k| high[k] >= 0.0 && low[k] <= grid.size[k] as f64);
    meets.then_some(local)
}

/// The cells from one coordinate to another, of so many. One more on either side makes good what rounding takes.
fn cells(from: f64, to: f64, count: usize) -> std::ops::Range<usize> {
    let last = count as f64;
    // Both are clamped to the grid first, and so fit an index.
    let first = (from - 1e-6).floor().clamp(0.0, last) as usize;
    first..(to + 1e-6).ceil().clamp(0.0, last) as usize
}

/// The least and the greatest x of a triangle within a row of cells.
fn across(corners: &[Point; 3], row: f64) -> [f64; 2] {
    let (low, high) = (row - 1e-6, row + 1.0 + 1e-6);
    let mut span = [f64::INFINITY, f64::NEG_INFINITY];
    let mut hold = |x: f64| span = [span[0].min(x), span[1].max(x)];
    for k in 0..3 {
        let ([ax, ay], [bx, by]) = (corners[k], corners[(k + 1) % 3]);
        if ay >= low && ay <= high {
            hold(ax);
        }
        for at in [low, high] {
            if (ay < at) != (by < at) {
                hold(ax + (at - ay) / (by - ay) * (bx - ax));
            }
        }
    }
    span
}

/// Twice the area of a triangle, positive where it goes counterclockwise.
fn side(a: Point, b: Point, c: Point) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn within(corners: &[Point; 3], point: Point) -> bool {
    (0..3).all(|k| side(corners[k], corners[(k + 1) % 3], point) >= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Body, Cause};
    use crate::polygon::Polygon;

    fn field() -> Samples {
        let corners = vec![[-20.0, -20.0], [20.0, -20.0], [20.0, 20.0], [-20.0, 20.0]];
        Samples::of(&[Polygon { corners }], 0.5).expect("few cells")
    }

    fn caster(body: &Body, turn: f64) -> Caster<'_> {
        Caster { body, place: [1.3, -0.7], turn, leafless: [false; 12], cause: Cause::Building }
    }

    /// A point lies in the shadow of a box where the ray to the sun meets it: slab by slab, in the frame of the box.
    fn meets(point: Point, caster: &Caster<'_>, size: [f64; 3], shift: [f64; 2]) -> bool {
        let (sin, cos) = sincos(caster.turn);
        let turned = |[x, y]: Point| [cos * x + sin * y, cos * y - sin * x];
        let from = turned([point[0] - caster.place[0], point[1] - caster.place[1]]);
        let along = turned([-shift[0], -shift[1]]);
        let mut span = [0.0, size[2]];
        for k in 0..2 {
            let [a, b] = [-1.0, 1.0].map(|end| (end * size[k] / 2.0 - from[k]) / along[k]);
            span = [a.min(b).max(span[0]), a.max(b).min(span[1])];
        }
        span[0] <= span[1]
    }

    #[test]
    fn the_shadow_of_a_box_is_where_rays_meet_it() {
        let (samples, body) = (field(), Body::cuboid([4.0, 3.0], [0.0, 5.0]));
        for (turn, shift) in [(0.0, [0.9, 0.4]), (0.5, [-2.0, 0.01]), (2.0, [0.3, -3.0]), (-1.0, [40.0, 25.0])] {
            let caster = caster(&body, turn);
            let mut marks = Marks::none(samples.all.len());
            cast(&samples, &caster, 0, shift, &mut marks);
            for (number, sample) in samples.all.iter().enumerate() {
                let known = meets(sample.place, &caster, [4.0, 3.0, 5.0], shift);
                assert_eq!(marks.has(number), known, "{:?}, turned by {turn}, {shift:?}", sample.place);
            }
            assert!(marks.beyond(None).count() > 40 && marks.beyond(Some(&marks)).count() == 0);
        }
    }

    #[test]
    fn what_is_under_the_ground_casts_nothing() {
        let samples = field();
        let (whole, deep) = (Body::cuboid([4.0, 3.0], [0.0, 5.0]), Body::cuboid([4.0, 3.0], [-4.0, 5.0]));
        let shadow = |body: &Body| {
            let mut marks = Marks::none(samples.all.len());
            cast(&samples, &caster(body, 0.4), 3, [1.1, 0.7], &mut marks);
            marks
        };
        assert_eq!(shadow(&whole), shadow(&deep), "a body that goes on below casts the same");
        assert_eq!(shadow(&Body::cuboid([4.0, 3.0], [-4.0, -1.0])), Marks::none(samples.all.len()));
        let odd = Body { lasting: vec![[[f32::NAN; 3]; 3], [[f32::MAX; 3]; 3]], seasonal: Vec::new() };
        assert_eq!(shadow(&odd), Marks::none(samples.all.len()), "and neither does what has no place");
    }

    #[test]
    fn a_month_without_leaves_has_no_seasonal_shade() {
        let samples = field();
        let Body { lasting, .. } = Body::cuboid([4.0, 3.0], [2.0, 5.0]);
        let body = Body { lasting: Vec::new(), seasonal: lasting };
        let mut leafless = [false; 12];
        leafless[11] = true;
        let tree = Caster { leafless, ..caster(&body, 0.0) };
        let count = |month: usize| {
            let mut marks = Marks::none(samples.all.len());
            cast(&samples, &tree, month, [0.2, 0.2], &mut marks);
            marks.beyond(None).count()
        };
        assert!(count(6) > 0 && count(11) == 0);
    }
}
