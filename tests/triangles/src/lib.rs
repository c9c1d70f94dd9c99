//! Areas and volumes of triangles, and the triangles of PLY files, as the tests measure them.
//!
//! Nothing here knows how a mesh is made, so that the tests compare two ways of finding a number. Absent: readers of
//! other formats, which are libraries of their own.

use std::collections::BTreeMap;

/// A place, m.
pub type Point = [f64; 3];

/// Three corners, counterclockwise as seen from outside.
pub type Triangle = [Point; 3];

/// Bytes of a vertex and of a triangle in the PLY files of plants, and where in a vertex its component's number stands.
const VERTEX: usize = 49;
const FACE: usize = 13;
const COMPONENT: usize = 44;

/// The triangles of each component in a binary PLY file of a plant.
///
/// # Panics
///
/// Where the bytes are no such file.
pub fn of_components(ply: &[u8]) -> BTreeMap<i32, Vec<Triangle>> {
    let end = b"end_header\n";
    let start = ply.windows(end.len()).position(|window| window == end).expect("a header") + end.len();
    let header = String::from_utf8_lossy(&ply[..start]);
    let count = |of: &str| {
        let line = header.lines().find_map(|line| line.strip_prefix(of)).expect("a count");
        line.trim().parse::<usize>().expect("a number")
    };
    let (vertices, faces) = ply[start..].split_at(count("element vertex ") * VERTEX);
    let four = |of: &[u8], at: usize| [of[at], of[at + 1], of[at + 2], of[at + 3]];
    let corner = |face: &[u8], at: usize| {
        let vertex = &vertices[i32::from_le_bytes(four(face, at)) as usize * VERTEX..][..VERTEX];
        let place = [0, 4, 8].map(|at| f64::from(f32::from_le_bytes(four(vertex, at))));
        (i32::from_le_bytes(four(vertex, COMPONENT)), place)
    };
    let mut of_components: BTreeMap<i32, Vec<Triangle>> = BTreeMap::new();
    for face in faces.chunks_exact(FACE).take(count("element face ")) {
        let (component, first) = corner(face, 1);
        of_components.entry(component).or_default().push([first, corner(face, 5).1, corner(face, 9).1]);
    }
    of_components
}

/// The vector from the second place to the first.
fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The area of a triangle, m².
fn area_of([a, b, c]: &Triangle) -> f64 {
    let across = cross(minus(*b, *a), minus(*c, *a));
    0.5 * dot(across, across).sqrt()
}

/// The area of all triangles, m²: of a closed body both sides of what it is.
pub fn area(triangles: &[Triangle]) -> f64 {
    triangles.iter().map(area_of).sum()
}

/// The volume that closed triangles hold, m³: the sum of the cones from one place to each.
pub fn volume(triangles: &[Triangle]) -> f64 {
    let Some([origin, ..]) = triangles.first() else {
        return 0.0;
    };
    let cone = |triangle: &Triangle| {
        let [a, b, c] = triangle.map(|point| minus(point, *origin));
        dot(a, cross(b, c)) / 6.0
    };
    triangles.iter().map(cone).sum()
}

/// One side of an edge: its ends by their bits, in their order; the number of its triangle; whether the triangle runs
/// along it in that order.
type Side = ([[u64; 3]; 2], usize, bool);

/// The sides of all triangles, those of one edge after one another.
fn sides(triangles: &[Triangle]) -> Vec<Side> {
    // Adding 0 makes −0 and 0 one place.
    let bits = |point: Point| point.map(|x| (x + 0.0).to_bits());
    let mut sides = Vec::with_capacity(3 * triangles.len());
    for (number, triangle) in triangles.iter().enumerate() {
        let corners = triangle.map(bits);
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            sides.push(if a < b { ([a, b], number, true) } else { ([b, a], number, false) });
        }
    }
    sides.sort_unstable();
    sides
}

/// Whether as many triangles run along the edge in one order as in the other.
fn is_paired(of_edge: &[Side]) -> bool {
    2 * of_edge.iter().filter(|side| side.2).count() == of_edge.len()
}

/// Whether triangles meet in pairs of either direction at every edge.
pub fn is_closed(triangles: &[Triangle]) -> bool {
    sides(triangles).chunk_by(|a, b| a.0 == b.0).all(is_paired)
}

/// The area of one side, m²: all of open sheets and half of closed parts (Chen & Black 1992). Triangles that have an
/// edge in common are of one part.
pub fn one_side(triangles: &[Triangle]) -> f64 {
    let mut parents: Vec<usize> = (0..triangles.len()).collect();
    let sides = sides(triangles);
    for of_edge in sides.chunk_by(|a, b| a.0 == b.0) {
        for side in &of_edge[1..] {
            let (a, b) = (root(&mut parents, of_edge[0].1), root(&mut parents, side.1));
            parents[a.max(b)] = a.min(b);
        }
    }
    let mut open = vec![false; triangles.len()];
    for of_edge in sides.chunk_by(|a, b| a.0 == b.0).filter(|of_edge| !is_paired(of_edge)) {
        open[root(&mut parents, of_edge[0].1)] = true;
    }
    let share = |number: usize, parents: &mut [usize]| if open[root(parents, number)] { 1.0 } else { 0.5 };
    triangles.iter().enumerate().map(|(number, triangle)| share(number, &mut parents) * area_of(triangle)).sum()
}

/// The first triangle of a triangle's part.
fn root(parents: &mut [usize], mut number: usize) -> usize {
    while parents[number] != number {
        parents[number] = parents[parents[number]];
        number = parents[number];
    }
    number
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The box from 0 to the given corner.
    fn cuboid([x, y, z]: Point) -> Vec<Triangle> {
        let corner = |k: usize| [[0.0, x][k & 1], [0.0, y][k >> 1 & 1], [0.0, z][k >> 2]];
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).map(|three| three.map(corner)).collect()
    }

    #[test]
    fn a_box_is_closed_until_a_triangle_is_missing() {
        let mut triangles = cuboid([2.0, 3.0, 5.0]);
        assert!(is_closed(&triangles));
        assert!((area(&triangles) - 62.0).abs() < 1e-12 && (volume(&triangles) - 30.0).abs() < 1e-12);
        assert!((one_side(&triangles) - 31.0).abs() < 1e-12);
        triangles.pop();
        assert!(!is_closed(&triangles));
        assert!((one_side(&triangles) - 54.5).abs() < 1e-12);
    }

    /// A closed box counts by half, a sheet apart from it as a whole.
    #[test]
    fn parts_are_closed_or_open_each_by_itself() {
        let mut triangles = cuboid([1.0, 1.0, 1.0]);
        triangles.push([[9.0, 0.0, 0.0], [9.0, 2.0, 0.0], [9.0, 0.0, 2.0]]);
        assert!(!is_closed(&triangles));
        assert!((one_side(&triangles) - 5.0).abs() < 1e-12);
    }
}
