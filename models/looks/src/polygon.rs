//! Triangles from a polygon: a face of a mesh file, or the outline of an organ.
//!
//! A fan from the first corner is used where it covers the polygon, as it does every convex polygon. Else ears are cut
//! off one after another (Meisters 1975, "Polygons have ears"), in the coordinate plane in which the polygon is
//! largest. Takes at most n² tests of a corner against a triangle. A polygon that is not plane is bent along the sides
//! of its triangles. Absent: holes; a polygon that crosses itself stays a fan.

/// The share of a polygon that a fan may cover twice: 32-bit corners in a line are never exactly so.
const FLAT: f64 = 1e-6;

/// The distance of a corner from the mean plane, in sizes of the polygon, above which it is not plane: corners in
/// single precision are never exactly so.
const PLANE: f64 = 1e-4;

/// A point of the polygon in the plane.
type Flat = [f64; 2];

/// The triangles of a polygon, by the indices of its corners.
pub fn triangles(points: &[[f32; 3]]) -> Vec<[usize; 3]> {
    let fan = || (2..points.len()).map(|corner| [0, corner - 1, corner]).collect();
    if points.len() < 4 {
        return fan();
    }
    let flat = flattened(points);
    let turns: Vec<f64> = (2..flat.len()).map(|corner| turn([flat[0], flat[corner - 1], flat[corner]])).collect();
    let least = -FLAT * turns.iter().sum::<f64>();
    if turns.iter().all(|turn| *turn >= least) { fan() } else { ears(&flat).unwrap_or_else(fan) }
}

/// Whether all corners lie in the plane across their mean normal (Newell's sum over the edges).
pub fn is_plane(points: &[[f32; 3]]) -> bool {
    let Some(&first) = points.first() else { return true };
    let from: Vec<[f64; 3]> =
        points.iter().map(|at| [0, 1, 2].map(|k| f64::from(at[k]) - f64::from(first[k]))).collect();
    let mut normal = [0.0; 3];
    for edge in from.windows(2) {
        let across = cross(edge[0], edge[1]);
        (0..3).for_each(|k| normal[k] += across[k]);
    }
    let size = from.iter().map(|at| dot(*at, *at)).fold(0.0, f64::max).sqrt();
    let length = dot(normal, normal).sqrt();
    from.iter().all(|at| dot(*at, normal).abs() <= PLANE * size * length)
}

/// The area of the triangles of a polygon.
pub fn area(points: &[[f32; 3]]) -> f64 {
    let of = |triangle: &[usize; 3]| {
        let [a, b, c] = triangle.map(|corner| points[corner].map(f64::from));
        let from_a = |to: [f64; 3]| [0, 1, 2].map(|k| to[k] - a[k]);
        let across = cross(from_a(b), from_a(c));
        0.5 * dot(across, across).sqrt()
    };
    triangles(points).iter().map(of).sum()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The corners in the plane, seen from the side on which the polygon runs counterclockwise.
fn flattened(points: &[[f32; 3]]) -> Vec<Flat> {
    let points: Vec<[f64; 3]> = points.iter().map(|point| point.map(f64::from)).collect();
    let next = |corner: usize| points[(corner + 1) % points.len()];
    // Twice the area in a plane, by the sums over the edges.
    let area = |[a, b]: [usize; 2]| -> f64 {
        points.iter().enumerate().map(|(corner, p)| (p[a] - next(corner)[a]) * (p[b] + next(corner)[b])).sum()
    };
    let planes = [[1, 2], [2, 0], [0, 1]];
    let largest = planes.into_iter().fold(
        planes[2],
        |best, plane| {
            if area(plane).abs() > area(best).abs() { plane } else { best }
        },
    );
    let [a, b] = if area(largest) < 0.0 { [largest[1], largest[0]] } else { largest };
    points.iter().map(|point| [point[a], point[b]]).collect()
}

/// Twice the area of a triangle; negative where it is clockwise.
fn turn([a, b, c]: [Flat; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Cuts off ears until a triangle is left; `None` where no ear is found.
fn ears(flat: &[Flat]) -> Option<Vec<[usize; 3]>> {
    let mut left: Vec<usize> = (0..flat.len()).collect();
    let mut is_ear: Vec<bool> = (0..left.len()).map(|place| ear(flat, &left, place)).collect();
    let mut triangles = Vec::with_capacity(flat.len() - 2);
    while left.len() > 3 {
        let place = is_ear.iter().position(|is| *is)?;
        triangles.push(around(&left, place));
        left.remove(place);
        is_ear.remove(place);
        for neighbour in [place + left.len() - 1, place] {
            let neighbour = neighbour % left.len();
            is_ear[neighbour] = ear(flat, &left, neighbour);
        }
    }
    triangles.push([left[0], left[1], left[2]]);
    Some(triangles)
}

/// The corner at a place, with the corners before and after it.
fn around(left: &[usize], place: usize) -> [usize; 3] {
    let count = left.len();
    [left[(place + count - 1) % count], left[place], left[(place + 1) % count]]
}

/// Whether the triangle at a place lies inside the polygon and contains none of its other corners.
fn ear(flat: &[Flat], left: &[usize], place: usize) -> bool {
    let corners = around(left, place);
    let [a, b, c] = corners.map(|corner| flat[corner]);
    if turn([a, b, c]) < 0.0 {
        return false;
    }
    let outside = |p: Flat| {
        let is_corner = [a, b, c].contains(&p);
        is_corner || turn([a, b, p]) < 0.0 || turn([b, c, p]) < 0.0 || turn([c, a, p]) < 0.0
    };
    left.iter().filter(|corner| !corners.contains(corner)).all(|corner| outside(flat[*corner]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn covered(points: &[[f32; 3]]) -> f64 {
        triangles(points)
            .iter()
            .map(|triangle| turn(triangle.map(|k| points[k].map(f64::from)).map(|[x, y, _]| [x, y])).abs() / 2.0)
            .sum()
    }

    /// A square of 2 × 2 that is bent by a right angle along a diagonal, or along a side of its triangles: the
    /// triangles keep their area of 4, of which the mean plane shows less.
    #[test]
    fn a_bent_polygon_has_the_area_of_its_triangles() {
        let flat = [[0.0, 0.0, 0.5], [2.0, 0.0, 0.5], [2.0, 2.0, 0.5], [0.0, 2.0, 0.5]];
        assert!(is_plane(&flat) && (area(&flat) - 4.0).abs() < 1e-12);
        // The corner (0, 2) is turned about the diagonal y = x until it stands above its middle.
        let bent = [flat[0], flat[1], flat[2], [1.0, 1.0, 0.5 + 2.0_f32.sqrt()]];
        assert!(!is_plane(&bent) && (area(&bent) - 4.0).abs() < 1e-6, "{}", area(&bent));
        assert!(is_plane(&bent[..3]) && is_plane(&[]) && area(&[]) == 0.0);
    }

    #[test]
    fn a_convex_polygon_is_a_fan() {
        let hexagon =
            [[2.0, 0.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0], [-2.0, 0.0, 0.0], [-1.0, -1.0, 0.0], [1.0, -1.0, 0.0]];
        assert_eq!(triangles(&hexagon), [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]);
        let back: Vec<_> = hexagon.into_iter().rev().collect();
        assert_eq!(triangles(&back), [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]);
    }

    #[test]
    fn corners_in_a_line_leave_a_convex_polygon_a_fan() {
        // A square with a corner in the middle of each side, turned by an angle that 32 bits round.
        let (sin, cos) = phytomer_sim::math::sincos(0.3);
        let turned = |[x, y]: [f64; 2]| [(x * cos - y * sin) as f32, (x * sin + y * cos) as f32, 0.0];
        let square = [[0.0, 0.0], [1.5, 0.0], [3.0, 0.0], [3.0, 1.5], [3.0, 3.0], [1.5, 3.0], [0.0, 3.0], [0.0, 1.5]]
            .map(turned);
        assert_eq!(triangles(&square), (2..8).map(|corner| [0, corner - 1, corner]).collect::<Vec<_>>());
    }

    #[test]
    fn a_concave_polygon_is_covered_once_from_either_side() {
        // A lobed leaf of the area 7, an arrow head, and a comb whose teeth a fan would bridge.
        let lobed = [
            [0.0, 0.0, 0.0],
            [3.0, 0.0, 0.0],
            [3.0, 1.0, 0.0],
            [1.0, 1.0, 0.0],
            [1.0, 2.0, 0.0],
            [3.0, 2.0, 0.0],
            [3.0, 3.0, 0.0],
            [0.0, 3.0, 0.0],
        ];
        let arrow = [[0.0, 0.0, 0.0], [4.0, 2.0, 0.0], [0.0, 4.0, 0.0], [1.0, 2.0, 0.0]];
        let mut comb = vec![[0.0, -1.0, 0.0], [20.0, -1.0, 0.0]];
        comb.extend((0..=20).rev().map(|x| [x as f32, if x % 2 == 0 { 5.0 } else { 0.0 }, 0.0]));
        for (points, area) in [(lobed.to_vec(), 7.0), (arrow.to_vec(), 6.0), (comb, 20.0 * 3.5)] {
            for first in 0..points.len() {
                let turned: Vec<_> = (0..points.len()).map(|k| points[(first + k) % points.len()]).collect();
                let back: Vec<_> = turned.iter().rev().copied().collect();
                for points in [turned, back] {
                    assert!((covered(&points) - area).abs() < 1e-9, "{first}: {}", covered(&points));
                    assert_eq!(triangles(&points).len(), points.len() - 2);
                }
            }
        }
    }

    #[test]
    fn a_large_and_a_crossing_polygon_come_to_an_end() {
        let star: Vec<[f32; 3]> = (0..2000)
            .map(|k| {
                let (sin, cos) = phytomer_sim::math::sincos(f64::from(k) * std::f64::consts::PI / 1000.0);
                let radius = if k % 2 == 0 { 2.0 } else { 1.0 };
                [(radius * cos) as f32, (radius * sin) as f32, 0.0]
            })
            .collect();
        assert_eq!(triangles(&star).len(), 1998);
        let bow = [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [f32::NAN, 0.5, 0.0]];
        assert_eq!(triangles(&bow).len(), 3);
    }
}
