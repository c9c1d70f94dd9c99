//! Soft objects (Wyvill, McPheeters & Wyvill 1986, "Data structure for soft objects"): a field about a skeleton of
//! points, lines and ellipsoids, with the surface where it is ½.
//!
//! Each part of the skeleton adds 1 − 22/9 q + 17/9 q² − 4/9 q³ with q = r²/R², r being the distance to it and R its
//! reach, beyond which it adds nothing. The field of a lone part is ½ at R/2. Absent: other falloffs.

use super::bounds::Bounds;
use super::round::Ellipsoid;
use super::tree::Tree;
use super::{Point, Solid, along_line, from, length};

/// The field on the surface.
pub const SURFACE: f64 = 0.5;

/// The field at q = r²/R².
#[inline]
pub fn falloff(q: f64) -> f64 {
    if q < 1.0 { 1.0 - q * (22.0 / 9.0 - q * (17.0 / 9.0 - q * (4.0 / 9.0))) } else { 0.0 }
}

/// A part of a skeleton.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Skeleton {
    /// All points within the reach of a line, metres; of a point where both ends are one.
    Line(Point, Point, f64),
    /// An ellipsoid along the axes, to which its field reaches: r²/R² is Σ (xₖ / Rₖ)².
    Ellipsoid(Ellipsoid),
}

impl Skeleton {
    fn q(&self, point: Point) -> f64 {
        match self {
            Self::Line(start, end, reach) => {
                let far = length(from(along_line(*start, *end, point).1, point)) / reach;
                far * far
            }
            Self::Ellipsoid(reach) => reach.square(point),
        }
    }

    fn bounds(&self) -> Bounds {
        match self {
            Self::Line(start, end, reach) => Bounds::of_points([start, end]).with_margin(*reach),
            Self::Ellipsoid(reach) => reach.bounds(),
        }
    }
}

/// The sum of the fields about a skeleton.
#[derive(Debug, Clone, PartialEq)]
pub struct Soft {
    /// Each part, and what its field is multiplied with; a negative one takes away.
    parts: Vec<(Skeleton, f64)>,
    tree: Tree,
}

impl Soft {
    /// The soft object about parts with their strengths.
    pub fn of(parts: Vec<(Skeleton, f64)>) -> Self {
        let bounds: Vec<Bounds> = parts.iter().map(|(part, _)| part.bounds()).collect();
        let tree = Tree::of(&bounds);
        Self { parts, tree }
    }

    /// The field at a point.
    pub fn field(&self, point: Point) -> f64 {
        let mut sum = 0.0;
        self.tree.any(point, |part| {
            let (skeleton, strength) = &self.parts[part];
            sum += strength * falloff(skeleton.q(point));
            false
        });
        sum
    }

    /// The bounds of its reach, within which its surface lies.
    pub fn bounds(&self) -> Bounds {
        self.tree.bounds()
    }
}
