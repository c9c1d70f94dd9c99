//! Leaf blades as folded halves: a convex polygon on each side of the midrib, raised like an open book, and a stalk.
//!
//! At most four convex polygons a leaf (de Reffye 1988 §6), folded along the midrib. Absent: colours, which follow from
//! kind and age.

use super::{Depth, Shape, along};

/// Widest in the middle, on a short stalk: a coffee leaf.
pub fn elliptic() -> Shape {
    blade(&[[0.08, 0.0], [0.25, 0.34], [0.5, 0.5], [0.75, 0.36], [1.0, 0.0]], 0.3)
}

/// Widest below the middle, narrowing to the tip: a willow leaf.
pub fn lanceolate() -> Shape {
    blade(&[[0.05, 0.0], [0.15, 0.28], [0.35, 0.5], [0.65, 0.32], [1.0, 0.0]], 0.35)
}

/// As broad as long, nearly a triangle, on a long stalk: a poplar leaf.
pub fn deltoid() -> Shape {
    blade(&[[0.32, 0.0], [0.28, 0.22], [0.38, 0.46], [0.5, 0.5], [1.0, 0.0]], 0.15)
}

/// A narrow roof of two triangles.
pub fn needle() -> Shape {
    let mut shape = Shape::new(Depth::Width);
    halves(&mut shape, &[[0.0, 0.0], [0.12, 0.5], [1.0, 0.0]], 0.8);
    shape
}

/// A blade with the outline of its right half, from the end of the stalk to the tip, and the rise of its halves.
fn blade(outline: &[[f32; 2]], rise: f32) -> Shape {
    let mut shape = Shape::new(Depth::Width);
    let end = outline[0][0];
    let stalk = [[0.0, -0.02, 0.0], [end, -0.012, 0.0], [end, 0.012, 0.0], [0.0, 0.02, 0.0]];
    shape.polygon(&stalk, along, true);
    halves(&mut shape, outline, rise);
    shape
}

fn halves(shape: &mut Shape, outline: &[[f32; 2]], rise: f32) {
    let right: Vec<[f32; 3]> = outline.iter().map(|&[x, y]| [x, -y, rise * y]).collect();
    let left: Vec<[f32; 3]> = outline.iter().rev().map(|&[x, y]| [x, y, rise * y]).collect();
    shape.polygon(&right, along, false);
    shape.polygon(&left, along, false);
}
