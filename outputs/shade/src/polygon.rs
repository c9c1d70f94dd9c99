//! Polygons on level ground: their area, and what of them lies in a rectangle.
//!
//! Absent: whether a polygon crosses itself, which is checked where its file is read.

/// A place on the ground: x to the east and y to the north, metres.
pub type Point = [f64; 2];

/// A polygon that does not cross itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon {
    /// Its corners in their order, either way around.
    pub corners: Vec<Point>,
}

impl Polygon {
    /// Its area, m².
    pub fn area_m2(&self) -> f64 {
        moments(&self.corners)[0].abs()
    }

    /// The least and the greatest corner of the rectangle around it.
    pub fn bounds(&self) -> [Point; 2] {
        bounds(&self.corners)
    }

    /// The area within a rectangle, m², and the centroid of that part; `None` where nothing of it lies there.
    ///
    /// The part is cut out edge by edge of the rectangle (Sutherland & Hodgman 1974). Of a polygon that is not convex
    /// the pieces hang together by edges without area, so area and centroid are right all the same.
    pub fn within(&self, low: Point, high: Point) -> Option<(f64, Point)> {
        let mut corners = self.corners.clone();
        for axis in 0..2 {
            corners = cut(&corners, axis, low[axis], 1.0);
            corners = cut(&corners, axis, high[axis], -1.0);
        }
        let [area, x, y] = moments(&corners);
        (area != 0.0).then(|| (area.abs(), [x / area, y / area]))
    }
}

/// The rectangle around some points.
pub fn bounds(corners: &[Point]) -> [Point; 2] {
    let none = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    corners
        .iter()
        .fold(none, |[low, high], [x, y]| [[low[0].min(*x), low[1].min(*y)], [high[0].max(*x), high[1].max(*y)]])
}

/// The area of a polygon with its sign, and the area times the centroid.
fn moments(corners: &[Point]) -> [f64; 3] {
    let Some(&origin) = corners.first() else { return [0.0; 3] };
    let local = |corner: Point| [corner[0] - origin[0], corner[1] - origin[1]];
    let mut sums = [0.0; 3];
    for (k, corner) in corners.iter().enumerate() {
        let ([ax, ay], [bx, by]) = (local(*corner), local(corners[(k + 1) % corners.len()]));
        let cross = ax * by - bx * ay;
        sums[0] += cross / 2.0;
        sums[1] += (ax + bx) * cross / 6.0;
        sums[2] += (ay + by) * cross / 6.0;
    }
    [sums[0], sums[1] + origin[0] * sums[0], sums[2] + origin[1] * sums[0]]
}

/// What of a polygon lies on the side of a line across an axis: above `at` for the sign 1, below it for −1.
fn cut(corners: &[Point], axis: usize, at: f64, sign: f64) -> Vec<Point> {
    let height = |corner: Point| (corner[axis] - at) * sign;
    let mut kept = Vec::with_capacity(corners.len() + 4);
    for (k, &from) in corners.iter().enumerate() {
        let to = corners[(k + 1) % corners.len()];
        let (a, b) = (height(from), height(to));
        if a >= 0.0 {
            kept.push(from);
        }
        if (a >= 0.0) != (b >= 0.0) {
            let share = a / (a - b);
            let mut met = [0, 1].map(|k| from[k] + share * (to[k] - from[k]));
            met[axis] = at;
            kept.push(met);
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square of 4 m without its upper right quarter, far from the origin.
    fn angle() -> Polygon {
        let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 2.0], [2.0, 4.0], [0.0, 4.0]];
        Polygon { corners: corners.map(|[x, y]| [x + 1e4, y - 1e4]).to_vec() }
    }

    #[test]
    fn parts_of_a_polygon_sum_to_it() {
        let angle = angle();
        assert!((angle.area_m2() - 12.0).abs() < 1e-9);
        let (mut area, mut first) = (0.0, [0.0; 2]);
        for column in 0..9 {
            for row in 0..9 {
                let low = [1e4 - 0.2 + 0.5 * f64::from(column), -1e4 - 0.2 + 0.5 * f64::from(row)];
                let Some((part, centroid)) = angle.within(low, [low[0] + 0.5, low[1] + 0.5]) else { continue };
                assert!(centroid[0] >= low[0] && centroid[1] <= low[1] + 0.5 && part <= 0.25 + 1e-9);
                area += part;
                [0, 1].into_iter().for_each(|k| first[k] += part * centroid[k]);
            }
        }
        assert!((area - 12.0).abs() < 1e-9, "{area}");
        // Two rectangles: 4 × 2 about (2, 1) and 2 × 2 about (1, 3).
        let [x, y] = [first[0] / area - 1e4, first[1] / area + 1e4];
        assert!((x - 20.0 / 12.0).abs() < 1e-6 && (y - 20.0 / 12.0).abs() < 1e-6, "{x} {y}");
    }

    #[test]
    fn a_part_in_two_pieces_has_the_area_of_both() {
        // A comb of two teeth, cut above its spine.
        let corners = [[0.0, 0.0], [5.0, 0.0], [5.0, 3.0], [4.0, 3.0], [4.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]];
        let comb = Polygon { corners: corners.to_vec() };
        let (area, centroid) = comb.within([-1.0, 2.0], [9.0, 9.0]).expect("the ends of the teeth");
        assert!((area - 2.0).abs() < 1e-12 && (centroid[0] - 2.5).abs() < 1e-12 && (centroid[1] - 2.5).abs() < 1e-12);
        assert_eq!(comb.within([9.0, 9.0], [10.0, 10.0]), None);
        assert_eq!(Polygon { corners: Vec::new() }.area_m2(), 0.0);
    }
}
