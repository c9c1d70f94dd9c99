//! What casts a shadow, as triangles, and where it stands.
//!
//! A plant has two parts: what stands in every month, and what the months without leaves do not have. Places of
//! triangles are relative to the body, single precision, and a caster puts a body into the plan in double precision.

use crate::polygon::Point;
use phytomer_sim::math::{atan2, sincos};
use std::f64::consts::TAU;

/// Three corners: x to the east, y to the north and z up, metres from where the body stands.
pub type Triangle = [[f32; 3]; 3];

/// The directions of an outline.
const DIRECTIONS: usize = 72;

/// The triangles of a body.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Body {
    /// What stands in every month: walls, wood, and all of a plant that keeps its leaves.
    pub lasting: Vec<Triangle>,
    /// What the months without leaves do not have.
    pub seasonal: Vec<Triangle>,
}

/// Why there is shade.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cause {
    /// A building.
    Building,
    /// A plant.
    Plant,
}

/// A body in its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Caster<'a> {
    /// What it is made of.
    pub body: &'a Body,
    /// Where it stands, metres.
    pub place: Point,
    /// By how much it is turned about the vertical, radians from the east to the north.
    pub turn: f64,
    /// The months from January without what is seasonal.
    pub leafless: [bool; 12],
    /// What it is.
    pub cause: Cause,
}

impl Body {
    /// A box around the vertical axis: its sides along x and y, and the heights of its underside and its top, metres.
    pub fn cuboid([width, depth]: [f64; 2], [from, to]: [f64; 2]) -> Self {
        let corner = |x: f64, y: f64, z: f64| [(x * width / 2.0) as f32, (y * depth / 2.0) as f32, z as f32];
        let around = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let low = around.map(|[x, y]| corner(x, y, from));
        let high = around.map(|[x, y]| corner(x, y, to));
        let mut lasting = vec![[high[0], high[1], high[2]], [high[0], high[2], high[3]]];
        lasting.extend([[low[0], low[2], low[1]], [low[0], low[3], low[2]]]);
        for k in 0..4 {
            let next = (k + 1) % 4;
            lasting.extend([[low[k], low[next], high[next]], [low[k], high[next], high[k]]]);
        }
        Self { lasting, seasonal: Vec::new() }
    }

    /// The triangles that cast a shadow in a month.
    pub fn triangles(&self, leafless: bool) -> impl Iterator<Item = &Triangle> {
        self.lasting.iter().chain(if leafless { &[] } else { self.seasonal.as_slice() })
    }

    /// The number of its triangles.
    pub fn len(&self) -> usize {
        self.lasting.len() + self.seasonal.len()
    }

    /// Whether it casts no shadow at all.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// How high it reaches above the ground, metres.
    pub fn height_m(&self) -> f64 {
        self.triangles(false).flatten().fold(0.0, |most, corner| f64::from(corner[2]).max(most))
    }

    /// Its outline from above: in each of 72 sectors the farthest point of it that stands above the ground.
    pub fn outline(&self) -> Vec<Point> {
        let mut far = [0.0_f64; DIRECTIONS];
        for [x, y, z] in self.triangles(false).flatten() {
            let (x, y) = (f64::from(*x), f64::from(*y));
            let turned = atan2(y, x) / TAU;
            let sector = ((turned + 1.0) * DIRECTIONS as f64).round() as usize % DIRECTIONS;
            if *z > 0.0 {
                far[sector] = far[sector].max((x * x + y * y).sqrt());
            }
        }
        let corner = |(sector, far): (usize, &f64)| {
            let (sin, cos) = sincos(sector as f64 / DIRECTIONS as f64 * TAU);
            [far * cos, far * sin]
        };
        far.iter().enumerate().map(corner).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_is_closed() {
        let body = Body::cuboid([4.0, 2.0], [0.5, 3.0]);
        // The volume that the triangles enclose, by the divergence theorem: it is right where all face outwards.
        let volume: f64 = body.triangles(false).map(|[a, b, c]| determinant(*a, *b, *c) / 6.0).sum();
        assert!((volume - 4.0 * 2.0 * 2.5).abs() < 1e-6, "{volume}");
        assert_eq!((body.height_m(), body.len(), body.is_empty()), (3.0, 12, false));
        assert_eq!(Body::default().height_m(), 0.0);
    }

    fn determinant(a: [f32; 3], b: [f32; 3], c: [f32; 3]) -> f64 {
        let [a, b, c] = [a, b, c].map(|corner| corner.map(f64::from));
        let cross = [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
        (0..3).map(|k| a[k] * cross[k]).sum()
    }

    #[test]
    fn an_outline_holds_what_stands_above_the_ground() {
        let triangle = |z: f32| [[3.0, 0.0, z], [0.0, 2.0, z], [-1.0, 0.0, z]];
        let body =
            Body { lasting: vec![triangle(-1.0).map(|[x, y, z]| [9.0 * x, y, z])], seasonal: vec![triangle(1.0)] };
        let outline = body.outline();
        assert_eq!(outline.len(), 72);
        assert!((outline[0][0] - 3.0).abs() < 1e-9 && (outline[18][1] - 2.0).abs() < 1e-9);
        assert!((outline[36][0] + 1.0).abs() < 1e-9 && outline[9] == [0.0, 0.0]);
        assert_eq!(body.triangles(true).count(), 1);
    }
}
