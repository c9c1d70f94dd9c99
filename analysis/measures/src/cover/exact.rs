//! The union of discs exactly: by Green's theorem its area is ½ ∮ (x dy − y dx) along the arcs that no other disc
//! covers.
//!
//! The arc of a circle of radius r about (a, b) from the angle s to t gives ½ r (r (t − s) + a (sin t − sin s) − b (cos
//! t − cos s)). A disc within another has no arc, and of equal discs the first alone. Holes are counted right, since
//! their arcs run the other way round as seen from them. The time is linear in the pairs that meet but for the sort of
//! the arcs of each disc; memory too. Error: that of rounding, relative to the whole. Absent: anything but discs.

use super::Disc;
use super::neighbours::Grid;
use phytomer_sim::math::{acos, atan2, cos, sin};
use std::f64::consts::{PI, TAU};

/// The area that discs cover together. Discs without a radius, or with a number that is none, cover nothing.
pub fn area(discs: &[Disc]) -> f64 {
    let grid = Grid::of(discs);
    let Some(first) = grid.discs.first() else { return 0.0 };
    let mut covered: Vec<Covered> = vec![Covered::Arcs(Vec::new()); grid.discs.len()];
    grid.each_pair(|a, b| meet(&grid.discs, &mut covered, a, b));
    // Places are taken from one of the discs, so that plants far from the origin lose no digits.
    let of = |(disc, covered): (&Disc, &mut Covered)| match covered {
        Covered::Whole => 0.0,
        Covered::Arcs(arcs) => bare(disc, first.centre, arcs),
    };
    grid.discs.iter().zip(&mut covered).map(of).sum()
}

/// What other discs cover of a circle.
#[derive(Clone)]
enum Covered {
    Whole,
    /// Arcs by the angles of their ends, in [0, 2π].
    Arcs(Vec<[f64; 2]>),
}

impl Covered {
    /// An arc from an angle in [−π, π] by half its width to either side.
    fn add(&mut self, middle: f64, half: f64) {
        let Self::Arcs(arcs) = self else { return };
        let from = middle - half;
        let from = if from < 0.0 { from + TAU } else { from };
        let to = from + 2.0 * half;
        if to <= TAU {
            arcs.push([from, to]);
        } else {
            arcs.extend([[from, TAU], [0.0, to - TAU]]);
        }
    }
}

/// What two discs cover of each other's circles.
fn meet(discs: &[Disc], covered: &mut [Covered], a: usize, b: usize) {
    let (one, other) = (discs[a], discs[b]);
    let [dx, dy] = [other.centre[0] - one.centre[0], other.centre[1] - one.centre[1]];
    let reach = one.radius + other.radius;
    let squared = dx * dx + dy * dy;
    if squared >= reach * reach {
        return;
    }
    let distance = squared.sqrt();
    if distance <= (one.radius - other.radius).abs() {
        // The smaller one, of equal ones the later.
        let inner = match one.radius.total_cmp(&other.radius) {
            std::cmp::Ordering::Less => a,
            std::cmp::Ordering::Greater => b,
            std::cmp::Ordering::Equal => a.max(b),
        };
        covered[inner] = Covered::Whole;
        return;
    }
    let towards = atan2(dy, dx);
    covered[a].add(towards, half(one.radius, other.radius, distance));
    covered[b].add(if towards > 0.0 { towards - PI } else { towards + PI }, half(other.radius, one.radius, distance));
}

/// Half of the arc of a circle of radius `own` that one of radius `other` covers at a distance: the law of cosines.
fn half(own: f64, other: f64, distance: f64) -> f64 {
    let cosine = (own * own - other * other + distance * distance) / (2.0 * own * distance);
    acos(cosine.clamp(-1.0, 1.0))
}

/// What the arcs of a circle that nothing covers give.
fn bare(disc: &Disc, origin: [f64; 2], arcs: &mut [[f64; 2]]) -> f64 {
    let [a, b] = [disc.centre[0] - origin[0], disc.centre[1] - origin[1]];
    let arc = |from: f64, to: f64| {
        let turned = a * (sin(to) - sin(from)) - b * (cos(to) - cos(from));
        0.5 * disc.radius * (disc.radius * (to - from) + turned)
    };
    arcs.sort_unstable_by(|one, other| one[0].total_cmp(&other[0]));
    let (mut area, mut end) = (0.0, 0.0_f64);
    for [from, to] in arcs.iter().copied() {
        if from > end {
            area += arc(end, from);
        }
        end = end.max(to);
    }
    if end < TAU { area + arc(end, TAU) } else { area }
}
