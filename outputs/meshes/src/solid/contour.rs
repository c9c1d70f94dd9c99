//! The surface of any shape by its field: dual contouring (Ju, Losasso, Schaefer & Warren 2002, "Dual contouring of
//! Hermite data", §3).
//!
//! A grid of cubes lies about the shape. Along each edge of the grid whose ends lie on either side of the surface the
//! place of the surface is found by halving, and its normal from the slope of the field. A cube with such edges has one
//! point: that nearest to the planes through those places, and a little drawn to their middle; so flat faces stay flat
//! and edges sharp. Each such edge is a quadrangle between the points of the four cubes about it, which closes the
//! surface. What is thinner than a cube may be missed. Absent: cubes of different sizes.

use super::Solid;
use phytomer_sim::shape::{Bounds, Point, Shape};

/// The cubes along the longest side.
const CUBES: f64 = 72.0;
/// The halvings of an edge: the place is then known to 10⁻⁶ of it.
const HALVINGS: usize = 20;
/// How far from a place the field is asked for its slope, in cubes.
const NEAR: f64 = 1e-3;
/// How much the middle of the places weighs beside a plane.
const TO_MIDDLE: f64 = 1e-3;
/// No point.
const NONE: u32 = u32::MAX;

pub(super) fn of(shape: &Shape, bounds: &Bounds) -> Solid {
    let size = [0, 1, 2].map(|k| bounds.high[k] - bounds.low[k]);
    let longest = size[0].max(size[1]).max(size[2]);
    if longest <= 0.0 {
        return Solid::default();
    }
    let cube = longest / CUBES;
    // Faces of the bounds lie within cubes, not on their sides.
    let low = bounds.low.map(|x| x - 1.37 * cube);
    let counts = size.map(|side| (side / cube).ceil() as usize + 3);
    let grid = Grid { shape, low, cube, counts };
    grid.surface()
}

struct Grid<'g> {
    shape: &'g Shape,
    low: Point,
    cube: f64,
    /// The cubes along x, y and z.
    counts: [usize; 3],
}

/// The places of the surface on the edges of a cube.
#[derive(Clone, Copy, Default)]
struct Places {
    count: f64,
    sum: Point,
    /// Σ n nᵀ: xx, xy, xz, yy, yz, zz.
    matrix: [f64; 6],
    /// Σ n (n · p).
    right: Point,
}

impl Grid<'_> {
    fn surface(&self) -> Solid {
        let inside: Vec<bool> = self.corners().map(|corner| self.is_inside(self.at(corner))).collect();
        let mut places: Vec<Places> = vec![Places::default(); self.counts.iter().product()];
        let mut quadrangles = Vec::new();
        for corner in self.corners() {
            for axis in 0..3 {
                let next = moved(corner, axis, 1);
                let inner = corner
                    .iter()
                    .zip(self.counts)
                    .enumerate()
                    .all(|(k, (x, count))| k == axis || (1..count).contains(x));
                if corner[axis] >= self.counts[axis] || !inner {
                    continue;
                }
                let ends = [inside[self.corner(corner)], inside[self.corner(next)]];
                if ends[0] == ends[1] {
                    continue;
                }
                let place = self.crossing(self.at(corner), axis, ends[0]);
                let normal = self.slope(place);
                let around = self.cubes_about(corner, axis);
                around.iter().for_each(|cube| places[*cube].add(place, normal));
                // The cubes run counterclockwise as seen against the axis, where the inside lies behind.
                quadrangles.push(if ends[0] { around } else { [around[3], around[2], around[1], around[0]] });
            }
        }
        self.joined(&places, &quadrangles)
    }

    /// A point for each cube that the surface passes, and two triangles for each quadrangle.
    fn joined(&self, places: &[Places], quadrangles: &[[usize; 4]]) -> Solid {
        let mut solid = Solid::default();
        let mut numbers = vec![NONE; places.len()];
        for (cube, of) in places.iter().enumerate().filter(|(_, of)| of.count > 0.0) {
            numbers[cube] = solid.points.len() as u32;
            solid.points.push(self.within(cube, of.point()));
        }
        for around in quadrangles {
            let [a, b, c, d] = around.map(|cube| numbers[cube]);
            let far = |one: u32, other: u32| {
                let [p, q] = [one, other].map(|number| solid.points[number as usize]);
                (0..3).map(|k| (p[k] - q[k]) * (p[k] - q[k])).sum::<f64>()
            };
            // Along the shorter diagonal.
            let way = if far(a, c) <= far(b, d) { [a, b, c, d] } else { [b, c, d, a] };
            solid.quadrangle(way);
        }
        solid
    }

    fn corners(&self) -> impl Iterator<Item = [usize; 3]> + use<> {
        let [x, y, z] = self.counts.map(|count| count + 1);
        (0..z).flat_map(move |k| (0..y).flat_map(move |j| (0..x).map(move |i| [i, j, k])))
    }

    fn corner(&self, [i, j, k]: [usize; 3]) -> usize {
        (k * (self.counts[1] + 1) + j) * (self.counts[0] + 1) + i
    }

    fn at(&self, corner: [usize; 3]) -> Point {
        [0, 1, 2].map(|k| self.low[k] + self.cube * corner[k] as f64)
    }

    /// The four cubes about the edge from a corner along an axis, counterclockwise as seen against the axis.
    fn cubes_about(&self, corner: [usize; 3], axis: usize) -> [usize; 4] {
        let [first, second] = [(axis + 1) % 3, (axis + 2) % 3];
        [(1, 1), (0, 1), (0, 0), (1, 0)].map(|(a, b)| {
            let mut cube = corner;
            cube[first] -= a;
            cube[second] -= b;
            (cube[2] * self.counts[1] + cube[1]) * self.counts[0] + cube[0]
        })
    }

    fn is_inside(&self, point: Point) -> bool {
        self.shape.inside(point)
    }

    /// Where the surface crosses the edge from a corner along an axis, of which the corner is inside or is not.
    fn crossing(&self, from: Point, axis: usize, inside: bool) -> Point {
        let (mut near, mut far) = (0.0, self.cube);
        let at = |along: f64| [0, 1, 2].map(|k| from[k] + if k == axis { along } else { 0.0 });
        for _ in 0..HALVINGS {
            let middle = 0.5 * (near + far);
            if self.is_inside(at(middle)) == inside { near = middle } else { far = middle }
        }
        at(0.5 * (near + far))
    }

    /// The direction in which the field falls: out of the shape.
    fn slope(&self, at: Point) -> Point {
        let step = NEAR * self.cube;
        let field =
            |axis: usize, by: f64| self.shape.field([0, 1, 2].map(|k| at[k] + if k == axis { by } else { 0.0 }));
        let slope = [0, 1, 2].map(|axis| field(axis, -step) - field(axis, step));
        let size = slope.iter().map(|x| x * x).sum::<f64>().sqrt();
        if size > 0.0 && size.is_finite() { slope.map(|x| x / size) } else { [0.0; 3] }
    }

    /// A point moved into its cube.
    fn within(&self, cube: usize, point: Point) -> Point {
        let [x, y] = [self.counts[0], self.counts[1]];
        let low = self.at([cube % x, cube / x % y, cube / (x * y)]);
        [0, 1, 2].map(|k| point[k].clamp(low[k], low[k] + self.cube))
    }
}

impl Places {
    fn add(&mut self, place: Point, n: Point) {
        self.count += 1.0;
        let far: f64 = (0..3).map(|k| n[k] * place[k]).sum();
        let products = [n[0] * n[0], n[0] * n[1], n[0] * n[2], n[1] * n[1], n[1] * n[2], n[2] * n[2]];
        (0..6).for_each(|k| self.matrix[k] += products[k]);
        (0..3).for_each(|k| {
            self.sum[k] += place[k];
            self.right[k] += n[k] * far;
        });
    }

    /// The point x of least Σ (n · (x − p))² + w |x − m|², m being the middle of the places: (Σ n nᵀ + w) (x − m) =
    /// Σ n (n · (p − m)).
    fn point(&self) -> Point {
        let middle = self.sum.map(|x| x / self.count);
        let [xx, xy, xz, yy, yz, zz] = self.matrix;
        let weight = TO_MIDDLE * self.count;
        let rows = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        let right = [0, 1, 2].map(|k| self.right[k] - (0..3).map(|j| rows[k][j] * middle[j]).sum::<f64>());
        let rows = [[xx + weight, xy, xz], [xy, yy + weight, yz], [xz, yz, zz + weight]];
        let whole = determinant(rows);
        let solved = |column: usize| {
            let replaced = [0, 1, 2].map(|k| [0, 1, 2].map(|j| if j == column { right[k] } else { rows[k][j] }));
            determinant(replaced) / whole
        };
        [0, 1, 2].map(|k| middle[k] + if whole > 0.0 { solved(k) } else { 0.0 })
    }
}

fn determinant([a, b, c]: [[f64; 3]; 3]) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
}

fn moved(mut corner: [usize; 3], axis: usize, by: usize) -> [usize; 3] {
    corner[axis] += by;
    corner
}
