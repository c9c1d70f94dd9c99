//! The distance from a point to the triangles of a mesh, found through a grid of cells.
//!
//! Each triangle is entered in the cells that are within a reach of it; a point that is farther than the reach from
//! all triangles has an infinite distance. The distance to a single triangle follows Ericson 2004, Real-Time Collision
//! Detection, §5.1.5. It knows nothing of plants.

use phytomer::outputs::meshes::Mesh;
use std::collections::BTreeMap;

type Point = [f32; 3];

/// The triangles of a mesh in a grid.
pub struct Triangles {
    cell: f32,
    corners: Vec<[Point; 3]>,
    cells: BTreeMap<[i32; 3], Vec<u32>>,
}

impl Triangles {
    /// The triangles of a mesh, to be found from points within `reach` of them.
    pub fn of(mesh: &Mesh, reach: f32) -> Self {
        let cell = (2.0 * reach).max(0.02);
        let corners = mesh.faces.iter().map(|face| face.indices().map(|k| mesh.vertices[k as usize].position()));
        let mut grid = Self { cell, corners: corners.collect(), cells: BTreeMap::new() };
        for triangle in 0..grid.corners.len() {
            grid.enter(triangle as u32, grid.corners[triangle], reach);
        }
        grid
    }

    /// Enters a part of a triangle, halved until it is no larger than a cell.
    fn enter(&mut self, triangle: u32, part: [Point; 3], reach: f32) {
        let side = |k: usize| length(minus(part[(k + 1) % 3], part[k]));
        let longest = (0..3).max_by(|a, b| side(*a).total_cmp(&side(*b))).unwrap_or(0);
        if side(longest) > self.cell {
            let [a, b, c] = [part[longest], part[(longest + 1) % 3], part[(longest + 2) % 3]];
            let middle = [0, 1, 2].map(|k| 0.5 * (a[k] + b[k]));
            self.enter(triangle, [a, middle, c], reach);
            self.enter(triangle, [middle, b, c], reach);
            return;
        }
        let end = |k: usize, sign: f32| {
            let least = part.iter().map(|corner| sign * corner[k]).fold(f32::INFINITY, f32::min);
            ((sign * (least - reach)) / self.cell).floor() as i32
        };
        let [low, high] = [1.0, -1.0].map(|sign| [0, 1, 2].map(|k| end(k, sign)));
        for x in low[0]..=high[0] {
            for (y, z) in (low[1]..=high[1]).flat_map(|y| (low[2]..=high[2]).map(move |z| (y, z))) {
                let entered = self.cells.entry([x, y, z]).or_default();
                if entered.last() != Some(&triangle) {
                    entered.push(triangle);
                }
            }
        }
    }

    /// The distance from a point to the nearest triangle; infinite beyond the reach.
    pub fn distance(&self, point: Point) -> f32 {
        let cell = point.map(|x| (x / self.cell).floor() as i32);
        let near = self.cells.get(&cell).into_iter().flatten();
        near.map(|triangle| to_triangle(point, self.corners[*triangle as usize])).fold(f32::INFINITY, f32::min)
    }
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Point, b: Point) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn length(a: Point) -> f32 {
    dot(a, a).sqrt()
}

fn to_triangle(p: Point, [a, b, c]: [Point; 3]) -> f32 {
    let (ab, ac, ap) = (minus(b, a), minus(c, a), minus(p, a));
    let at = |v: f32, w: f32| length([0, 1, 2].map(|k| ap[k] - v * ab[k] - w * ac[k]));
    let (d1, d2) = (dot(ab, ap), dot(ac, ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return at(0.0, 0.0);
    }
    let bp = minus(p, b);
    let (d3, d4) = (dot(ab, bp), dot(ac, bp));
    if d3 >= 0.0 && d4 <= d3 {
        return at(1.0, 0.0);
    }
    let cp = minus(p, c);
    let (d5, d6) = (dot(ab, cp), dot(ac, cp));
    if d6 >= 0.0 && d5 <= d6 {
        return at(0.0, 1.0);
    }
    let (va, vb, vc) = (d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2);
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return at(d1 / (d1 - d3), 0.0);
    }
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return at(0.0, d2 / (d2 - d6));
    }
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return at(1.0 - w, w);
    }
    let over = 1.0 / (va + vb + vc);
    at(vb * over, vc * over)
}

#[test]
fn a_point_is_as_far_from_a_triangle_as_from_its_nearest_part() {
    let triangle = [[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
    let cases = [
        ([0.5, 0.5, 3.0], 3.0),
        ([-3.0, -4.0, 0.0], 5.0),
        ([1.0, -2.0, 0.0], 2.0),
        ([2.0, 2.0, 0.0], 2.0_f32.sqrt()),
        ([5.0, 0.0, 4.0], 5.0),
        ([-1.0, 1.0, 0.0], 1.0),
    ];
    for (point, expected) in cases {
        assert!((to_triangle(point, triangle) - expected).abs() < 1e-6, "{point:?}");
    }
}
