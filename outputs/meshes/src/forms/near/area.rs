//! The fullness by which a form from near has an area, found by its triangles.
//!
//! Leaflets that arch and folds that grow with the width make the area another power of the fullness than the first;
//! steps by the power that the last step had find it. Nearly always the first guess serves, at the cost of one sum over
//! the triangles. Absent: that guess (`side`).

use super::super::{Depth, FormMesh};
use phytomer_sim::math::{log, pow};

/// How near the area must be, as a share.
const NEAR: f64 = 2e-3;

/// The most steps.
const STEPS: usize = 24;

/// The fullness of an organ of a length, width and area, from a first guess.
pub fn fullness(form: &FormMesh, size: [f32; 2], area: f32, first: f32) -> f32 {
    let wanted = f64::from(area);
    let (mut fullness, mut power) = (f64::from(first), 1.0);
    let mut before: Option<(f64, f64)> = None;
    for _ in 0..STEPS {
        let found = drawn(form, size, fullness as f32);
        if found <= 0.0 || !found.is_finite() || (found / wanted - 1.0).abs() < NEAR {
            break;
        }
        if let Some((fuller, larger)) = before.filter(|(fuller, _)| (fuller / fullness - 1.0).abs() > 1e-6) {
            power = (log(larger / found) / log(fuller / fullness)).clamp(0.25, 2.5);
        }
        before = Some((fullness, found));
        fullness = (fullness * pow(wanted / found, 1.0 / power)).clamp(1e-4, 1e3);
    }
    fullness as f32
}

/// The area of one side as it is drawn: of closed parts half of their surface.
fn drawn(form: &FormMesh, [length, width]: [f32; 2], fullness: f32) -> f64 {
    let (width, more) = if form.in_parts { (width, fullness - 1.0) } else { (width * fullness, 0.0) };
    let depth = if form.depth == Depth::Width { width } else { length };
    let at = |corner: u32| {
        let [x, y, z] = form.points[corner as usize].fuller(more);
        [x * length, y * width, z * depth].map(f64::from)
    };
    let of = |(face, closed): (&[u32; 3], &bool)| {
        let [a, b, c] = face.map(at);
        let (u, v) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
        let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        let twice = (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]).sqrt();
        twice * if *closed { 0.25 } else { 0.5 }
    };
    form.faces.iter().zip(&form.closed).map(of).sum()
}
