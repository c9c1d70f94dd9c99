//! Leaf blades as folded halves: a convex polygon on each side of the midrib, raised like an open book, and a stalk.
//!
//! At most four convex polygons a leaf (de Reffye 1988 §6). Lobes and pleats are polygons of their own. Absent: blades
//! that arch along their length (`arch`), compound leaves (`palm`), and colours, which follow from kind and age.

use super::{Depth, FormMesh, along};
use phytomer_sim::math::sincosf;

/// Widest in the middle, on a short stalk: a coffee leaf.
pub fn elliptic() -> FormMesh {
    blade(&[[0.08, 0.0], [0.25, 0.34], [0.5, 0.5], [0.75, 0.36], [1.0, 0.0]], 0.3)
}

/// Widest below the middle, narrowing to the tip: a willow leaf.
pub fn lanceolate() -> FormMesh {
    blade(&[[0.05, 0.0], [0.15, 0.28], [0.35, 0.5], [0.65, 0.32], [1.0, 0.0]], 0.35)
}

/// As broad as long, nearly a triangle, on a long stalk: a poplar leaf.
pub fn deltoid() -> FormMesh {
    blade(&[[0.32, 0.0], [0.28, 0.22], [0.38, 0.46], [0.5, 0.5], [1.0, 0.0]], 0.15)
}

/// Widest above the middle, on a short stalk: an oak leaf without its lobes.
pub fn obovate() -> FormMesh {
    blade(&[[0.06, 0.0], [0.3, 0.24], [0.65, 0.5], [0.88, 0.38], [1.0, 0.0]], 0.25)
}

/// A heart, its lobes behind the end of a long stalk: a lime leaf.
pub fn cordate() -> FormMesh {
    blade(&[[0.3, 0.0], [0.2, 0.2], [0.24, 0.42], [0.4, 0.5], [0.65, 0.36], [1.0, 0.0]], 0.2)
}

/// Long and narrow, its edges nearly parallel, on a very short stalk: a bamboo leaf.
pub fn linear() -> FormMesh {
    blade(&[[0.04, 0.0], [0.12, 0.4], [0.3, 0.5], [0.65, 0.4], [1.0, 0.0]], 0.3)
}

/// Three pointed lobes from the end of a long stalk: a maple leaf.
pub fn palmate() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    stalk(&mut shape, 0.3);
    let middle = [[0.3, 0.0], [0.56, -0.18], [1.0, 0.0], [0.56, 0.18]];
    shape.polygon(&middle.map(|[x, y]| [x, y, 0.0]), along, false);
    let lobe = [[0.3, 0.0], [0.56, 0.18], [0.74, 0.5], [0.3, 0.42], [0.18, 0.12]];
    let raised = |side: f32| lobe.map(|[x, y]: [f32; 2]| [x, side * y, 0.2 * y]);
    shape.polygon(&raised(1.0), along, false);
    let mut right = raised(-1.0);
    right.reverse();
    shape.polygon(&right, along, false);
    shape
}

/// Three pleats of a fan at the end of a long stalk: a fan palm's leaf.
pub fn fan() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    stalk(&mut shape, 0.42);
    // Corners of the rim by their angles, degrees; the outer pleats rise from the edges of the middle one.
    for (edges, side) in [([-90.0, -60.0, -30.0], -1.0), ([-30.0, 0.0, 30.0], 0.0), ([30.0, 60.0, 90.0], 1.0)] {
        let rim = edges.map(|degrees: f32| {
            let (sin, cos) = sincosf(degrees.to_radians());
            let (sin_edge, cos_edge) = sincosf(30_f32.to_radians());
            let beyond = (side * sin * cos_edge - cos * sin_edge).max(0.0) * side.abs();
            [0.42 + 0.58 * cos, 0.5 * sin, 0.3 * beyond]
        });
        shape.polygon(&[[0.42, 0.0, 0.0], rim[0], rim[1], rim[2]], along, false);
    }
    shape
}

/// Folded along its middle, on no stalk: a palm's leaflet.
pub fn leaflet() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    halves(&mut shape, &[[0.0, 0.0], [0.08, 0.4], [0.4, 0.5], [0.7, 0.34], [1.0, 0.0]], 0.5);
    shape
}

/// A pointed scale, hollow towards its stem.
pub fn scale() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    halves(&mut shape, &[[0.0, 0.0], [0.05, 0.3], [0.35, 0.5], [1.0, 0.0]], 0.5);
    shape
}

/// A narrow roof of two triangles.
pub fn needle() -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    halves(&mut shape, &[[0.0, 0.0], [0.12, 0.5], [1.0, 0.0]], 0.8);
    shape
}

/// Two needles that diverge: a pine's fascicle. Its width is the distance between both tips.
pub fn fascicle() -> FormMesh {
    const HALF_WIDTH: f32 = 0.14;
    let mut shape = FormMesh::new(Depth::Width);
    for side in [-1.0, 1.0] {
        let (base, tip) = ([[0.0; 3], [0.0; 3]], [[1.0, side * 0.4, 0.0], [0.0; 3]]);
        let edge = |out: f32| [[0.12, side * 0.048, 0.0], [0.0, out * HALF_WIDTH, 0.8 * HALF_WIDTH]];
        shape.part(&[base, edge(-1.0), tip], false);
        shape.part(&[tip, edge(1.0), base], false);
    }
    shape
}

/// A blade from the outline of its right half, from the end of the stalk to the tip, and the rise of its halves.
fn blade(outline: &[[f32; 2]], rise: f32) -> FormMesh {
    let mut shape = FormMesh::new(Depth::Width);
    stalk(&mut shape, outline[0][0]);
    halves(&mut shape, outline, rise);
    shape
}

/// A stalk from the base to `end`.
fn stalk(shape: &mut FormMesh, end: f32) {
    let stalk = [[0.0, -0.02, 0.0], [end, -0.012, 0.0], [end, 0.012, 0.0], [0.0, 0.02, 0.0]];
    shape.polygon(&stalk, along, true);
}

fn halves(shape: &mut FormMesh, outline: &[[f32; 2]], rise: f32) {
    let right: Vec<[f32; 3]> = outline.iter().map(|&[x, y]| [x, -y, rise * y]).collect();
    let left: Vec<[f32; 3]> = outline.iter().rev().map(|&[x, y]| [x, y, rise * y]).collect();
    shape.polygon(&right, along, false);
    shape.polygon(&left, along, false);
}
