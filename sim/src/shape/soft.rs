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

    /// Of a lone part, the point towards which its field rises, and the distance to its surface on the way there.
    fn core(&self, point: Point) -> (Point, f64) {
        match self {
            Self::Line(start, end, reach) => {
                let core = along_line(*start, *end, point).1;
                (core, length(from(core, point)) - 0.5 * reach)
            }
            Self::Ellipsoid(reach) => {
                let far = length(from(reach.centre, point));
                let share = self.q(point).sqrt();
                let surface = if share > 0.0 { 0.5 * far / share } else { 0.0 };
                (reach.centre, far - surface)
            }
        }
    }

    fn bounds(&self) -> Bounds {
        match self {
            Self::Line(start, end, reach) => Bounds::of_points([start, end]).with_margin(*reach),
            Self::Ellipsoid(reach) => reach.bounds(),
        }
    }
}

/// The steps in which a surface is looked for along a line, and how often the step that meets it is halved.
const STEPS: u32 = 64;
const HALVINGS: u32 = 40;

/// The distance from a point to where a field passes the surface, metres, negative inside: on the line towards a point
/// in the core of the shape, or from there outward to the bounds. `None` where the line meets no surface.
pub(super) fn to_surface(field: impl Fn(Point) -> f64, core: Point, point: Point, bounds: &Bounds) -> Option<f64> {
    let way = from(core, point);
    let far = length(way);
    let toward = if far > 1e-9 { way.map(|x| x / far) } else { [0.0, 0.0, 1.0] };
    let is_inside = |along: f64| field([0, 1, 2].map(|k| core[k] + along * toward[k])) >= SURFACE;
    let inside = is_inside(far);
    let end = if inside { far + length(from(bounds.low, bounds.high)) } else { 0.0 };
    let along = |step: u32| far + (end - far) * (f64::from(step) / f64::from(STEPS));
    let step = (1..=STEPS).find(|step| is_inside(along(*step)) != inside)?;
    let (mut before, mut behind) = (along(step - 1), along(step));
    for _ in 0..HALVINGS {
        let middle = 0.5 * (before + behind);
        *(if is_inside(middle) == inside { &mut before } else { &mut behind }) = middle;
    }
    Some(if inside { far - behind } else { far - before })
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

    /// The number of parts of its skeleton.
    pub fn len(&self) -> usize {
        self.parts.len()
    }

    /// Whether its skeleton has no parts.
    pub fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// The distance to the surface, metres, negative inside, along the line to the nearest part of the skeleton.
    pub(super) fn distance(&self, point: Point) -> f64 {
        let adding = self.parts.iter().filter(|(_, strength)| *strength > 0.0);
        let nearest = adding.map(|(part, _)| part.core(point)).min_by(|a, b| a.1.total_cmp(&b.1));
        let Some((core, _)) = nearest else { return f64::INFINITY };
        to_surface(|at| self.field(at), core, point, &self.bounds()).unwrap_or(f64::INFINITY)
    }

    /// The bounds of its reach, within which its surface lies.
    pub fn bounds(&self) -> Bounds {
        self.tree.bounds()
    }
}
