//! The flat leaves of parametric trees (Weber & Penn 1995 §4.5): plane shapes of few triangles, of unit length and
//! width, on no stalk.
//!
//! The oval is the hexagon of Figure 1, of four triangles. The paper names the other shapes and prints none; here a
//! lobe is a convex polygon. Absent: folded blades with stalks (`blade`).

use super::{Depth, FormMesh, along};

/// A hexagon, widest over the middle half of its length.
pub fn oval() -> FormMesh {
    plane(&[&[[0.0, 0.0], [0.25, -0.5], [0.75, -0.5], [1.0, 0.0], [0.75, 0.5], [0.25, 0.5]]])
}

/// Widest at its base.
pub fn triangle() -> FormMesh {
    plane(&[&[[0.0, -0.5], [1.0, 0.0], [0.0, 0.5]]])
}

/// A blunt lobe at the tip and one on either side, as of an oak.
pub fn three_lobe_oak() -> FormMesh {
    let side = [[0.0, 0.0], [0.36, -0.46], [0.52, -0.5], [0.62, -0.36], [0.5, 0.0]];
    lobed(&[[0.5, 0.0], [0.62, -0.2], [0.86, -0.24], [1.0, -0.08], [1.0, 0.08], [0.86, 0.24], [0.62, 0.2]], &side, &[])
}

/// Three pointed lobes from one place, as of a maple.
pub fn three_lobe_maple() -> FormMesh {
    lobed(
        &[[0.0, 0.0], [0.5, -0.2], [1.0, 0.0], [0.5, 0.2]],
        &[[0.0, 0.0], [0.24, -0.36], [0.72, -0.5], [0.5, -0.2]],
        &[],
    )
}

/// Five pointed lobes, as of a maple: three as of the leaf with three, and two that point outwards at its base.
pub fn five_lobe_maple() -> FormMesh {
    let middle = [[0.22, 0.0], [0.58, -0.18], [1.0, 0.0], [0.58, 0.18]];
    let side = [[0.22, 0.0], [0.38, -0.3], [0.8, -0.46], [0.58, -0.18]];
    lobed(&middle, &side, &[[0.0, 0.0], [0.1, -0.5], [0.22, 0.0], [0.1, 0.5]])
}

/// Three leaflets from one place: one along the leaf, one to each side.
pub fn three_leaflets() -> FormMesh {
    let side = [[0.0, 0.0], [0.12, -0.3], [0.42, -0.5], [0.36, -0.18]];
    lobed(&[[0.12, 0.0], [0.6, -0.17], [1.0, 0.0], [0.6, 0.17]], &side, &[])
}

/// A polygon in the middle, one on the right side and its mirror image on the left, and another in the middle.
fn lobed(middle: &[[f32; 2]], right: &[[f32; 2]], base: &[[f32; 2]]) -> FormMesh {
    let left: Vec<[f32; 2]> = right.iter().rev().map(|[x, y]| [*x, -y]).collect();
    plane(&[middle, right, &left, base])
}

/// Convex polygons in one plane, their corners counterclockwise as seen from above; fewer than three are none.
fn plane(polygons: &[&[[f32; 2]]]) -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    for polygon in polygons.iter().filter(|polygon| polygon.len() > 2) {
        let corners: Vec<[f32; 3]> = polygon.iter().map(|[x, y]| [*x, *y, 0.0]).collect();
        shape.polygon(&corners, along, false);
    }
    shape
}
