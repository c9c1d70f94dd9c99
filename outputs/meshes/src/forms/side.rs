//! One side of a form: its area as a share of length × width, and how a form is drawn slimmer or fuller to hold an
//! area.
//!
//! The area of a sheet is the sum of its triangles, of folded and hollow ones too; of a closed part half its surface,
//! as for needles (Chen & Black 1992, "one half the total intercepting area"). With a triangle's area vector a in the
//! unit box and r = width / length its area in place is length × width × √((r aₓ)² + a_y² + a_z²) where the width
//! scales the depth, and length × width × √(aₓ² + (a_y / r)² + a_z²) where the length does. So the share of a form that
//! is folded along its length does not depend on r, and that of any other does a little. Absent: flowers and fruits,
//! whose tables state no area.

use super::{Depth, Point};
use std::collections::BTreeMap;

/// The number of classes of lean in which triangles are summed; at most 10⁻⁴ of an area is lost by it.
const LEANS: usize = 64;

/// A triangle that leans by a smaller share counts as upright.
const UPRIGHT: f64 = 1e-5;

/// The most Newton steps to the width with the stated area; three suffice for every form of the library.
const STEPS: usize = 12;

/// The largest factor by which an organ is drawn fuller than its form.
const FULLEST: f32 = 1e3;

/// The triangles of a form, summed for the computation of its area.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Side {
    /// Pairs of areas by their ratio: the part that does not change with r, and the part that does.
    leans: Vec<[f64; 2]>,
    depth: Depth,
    /// The share, where it does not depend on the aspect.
    constant: Option<f32>,
}

impl Side {
    /// `nominal` is what the leaning parts are scaled by in most organs: the classes of lean are finest around it.
    pub fn of(points: &[Point], faces: &[[u32; 3]], depth: Depth, nominal: f64) -> Self {
        let at: Vec<[f32; 3]> = points.iter().map(|point| point.at).collect();
        let weights = closed(&at, faces);
        let mut leans = vec![[0.0; 2]; LEANS + 1];
        for (face, closed) in faces.iter().zip(weights) {
            let [x, y, z] =
                vector(face.map(|corner| at[corner as usize])).map(|a| if closed { 0.25 * a } else { 0.5 * a });
            let [flat, lean] = match depth {
                Depth::Width => [(y * y + z * z).sqrt(), x.abs()],
                Depth::Length => [(x * x + z * z).sqrt(), y.abs()],
            };
            let share = nominal * lean / (flat + nominal * lean).max(f64::MIN_POSITIVE);
            let place = if share < UPRIGHT { 0 } else { 1 + ((share * LEANS as f64) as usize).min(LEANS - 1) };
            leans[place][0] += flat;
            leans[place][1] += if place == 0 { 0.0 } else { lean };
        }
        leans.retain(|[flat, lean]| flat + lean > 0.0);
        let constant = match leans.as_slice() {
            [[flat, 0.0]] => Some(*flat as f32),
            _ => None,
        };
        Self { leans, depth, constant }
    }

    /// The area of one side as a share of length × width, for `aspect` = width / length.
    pub fn share(&self, aspect: f64) -> f64 {
        self.share_and_slope(aspect).0
    }

    /// The share, and its derivative by the logarithm of the aspect.
    fn share_and_slope(&self, aspect: f64) -> (f64, f64) {
        let (scale, sign) = match self.depth {
            Depth::Width => (aspect, 1.0),
            Depth::Length => (1.0 / aspect, -1.0),
        };
        self.leans.iter().fold((0.0, 0.0), |(share, slope), [flat, lean]| {
            let lean = lean * scale;
            let area = (flat * flat + lean * lean).sqrt();
            (share + area, slope + if area > 0.0 { sign * lean * lean / area } else { 0.0 })
        })
    }

    /// The factor by which an organ of this length and width is drawn fuller, so that one side has the area `area`:
    /// each of its parts about its own middle line where it is `in_parts`, else its width. 1 where no area is stated.
    #[inline]
    pub fn fullness(&self, [length, width]: [f32; 2], area: f32, in_parts: bool) -> f32 {
        let box_area = length * width;
        if !(area > 0.0 && box_area > 0.0) {
            return 1.0;
        }
        if let Some(share) = self.constant {
            return (area / (box_area * share)).min(FULLEST);
        }
        let wanted = f64::from(area) / f64::from(box_area);
        let aspect = f64::from(width) / f64::from(length);
        let first = wanted / self.share(aspect);
        let fullness = if in_parts { first } else { self.widened(aspect, wanted, first) };
        if fullness.is_finite() { (fullness as f32).clamp(0.0, FULLEST) } else { 1.0 }
    }

    /// The factor k for which k times the share of a k times wider organ equals `wanted`, by Newton's method.
    fn widened(&self, aspect: f64, wanted: f64, first: f64) -> f64 {
        let mut fullness = first;
        for _ in 0..STEPS {
            let (share, slope) = self.share_and_slope(aspect * fullness);
            let step = (fullness * share - wanted) / (share + slope);
            fullness = (fullness - step).max(0.25 * fullness);
            if step.abs() < 1e-6 * fullness {
                break;
            }
        }
        fullness
    }
}

/// For each triangle of a form whether its part is closed.
pub(super) fn closed_parts(form: &super::FormMesh) -> Vec<bool> {
    closed(&form.points.iter().map(|point| point.at).collect::<Vec<_>>(), &form.faces)
}

/// Twice the area of a triangle, along its normal.
fn vector([a, b, c]: [[f32; 3]; 3]) -> [f64; 3] {
    let edge = |to: [f32; 3]| [0, 1, 2].map(|k| f64::from(to[k]) - f64::from(a[k]));
    let ([ux, uy, uz], [vx, vy, vz]) = (edge(b), edge(c));
    [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx]
}

/// For each triangle whether its part is closed: at each edge of the part triangles meet in pairs of opposite
/// direction. A part is a set of triangles joined by edges; corners at equal positions count as one corner.
fn closed(points: &[[f32; 3]], faces: &[[u32; 3]]) -> Vec<bool> {
    let mut edges: BTreeMap<[[u32; 3]; 2], (usize, i64)> = BTreeMap::new();
    let mut parts = Parts { parents: (0..faces.len()).collect() };
    for (face, corners) in faces.iter().enumerate() {
        // Adding zero turns −0 into 0.
        let at = corners.map(|corner| points[corner as usize].map(|x| (x + 0.0).to_bits()));
        for k in 0..3 {
            let (from, to) = (at[k], at[(k + 1) % 3]);
            let (edge, direction) = if from < to { ([from, to], 1) } else { ([to, from], -1) };
            let (first, balance) = edges.entry(edge).or_insert((face, 0));
            parts.join(*first, face);
            *balance += direction;
        }
    }
    let mut open = vec![false; faces.len()];
    for (face, _) in edges.into_values().filter(|(_, balance)| *balance != 0) {
        open[parts.part(face)] = true;
    }
    (0..faces.len()).map(|face| !open[parts.part(face)]).collect()
}

/// The parts of a mesh: each triangle points to another triangle of its part, the last one to itself.
struct Parts {
    parents: Vec<usize>,
}

impl Parts {
    fn part(&mut self, mut face: usize) -> usize {
        while self.parents[face] != face {
            self.parents[face] = self.parents[self.parents[face]];
            face = self.parents[face];
        }
        face
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.part(a), self.part(b));
        self.parents[a.max(b)] = a.min(b);
    }
}
