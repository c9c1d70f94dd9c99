//! Shapes made of shapes: unions, intersections, differences and blends.
//!
//! Of a union, an intersection and a difference the field is the greatest, the least, and the least with 1 less the
//! field of what is taken away (constructive solid geometry: Ricci 1973). A blend adds fields as soft objects do: each
//! member's goes from 1 to 0 by Wyvill's polynomial as its surface is passed from `reach` within to `reach` outside. So
//! two members that are nearer than twice that distance run together, and alone each keeps its surface.

use super::bounds::Bounds;
use super::soft::to_surface;
use super::tree::Tree;
use super::{Measure, Point, SURFACE, Shape};

/// What is in any of its members.
#[derive(Debug, Clone, PartialEq)]
pub struct Union {
    members: Vec<Shape>,
    tree: Tree,
}

impl Union {
    /// The union of members; of none it is empty.
    pub fn of(members: Vec<Shape>) -> Self {
        let tree = Tree::of(&members.iter().map(Shape::bounds).collect::<Vec<_>>());
        Self { members, tree }
    }

    /// Its members.
    pub fn members(&self) -> &[Shape] {
        &self.members
    }

    pub(super) fn inside(&self, point: Point) -> bool {
        self.tree.any(point, |member| self.members[member].inside(point))
    }

    pub(super) fn level(&self, point: Point, measure: Measure) -> f64 {
        self.members.iter().map(|member| member.level(point, measure)).fold(f64::NEG_INFINITY, f64::max)
    }

    pub(super) fn distance(&self, point: Point) -> f64 {
        self.members.iter().map(|member| member.distance(point)).fold(f64::INFINITY, f64::min)
    }

    pub(super) fn bounds(&self) -> Bounds {
        self.tree.bounds()
    }
}

/// What is in all of its members.
#[derive(Debug, Clone, PartialEq)]
pub struct Intersection {
    members: Vec<Shape>,
    bounds: Bounds,
}

impl Intersection {
    /// The intersection of members; of none it is all of space.
    pub fn of(members: Vec<Shape>) -> Self {
        let bounds = members.iter().fold(Bounds::EVERYWHERE, |all, member| all.common(&member.bounds()));
        Self { members, bounds }
    }

    pub(super) fn inside(&self, point: Point) -> bool {
        self.bounds.holds(point) && self.members.iter().all(|member| member.inside(point))
    }

    pub(super) fn level(&self, point: Point, measure: Measure) -> f64 {
        self.members.iter().map(|member| member.level(point, measure)).fold(f64::INFINITY, f64::min)
    }

    pub(super) fn distance(&self, point: Point) -> f64 {
        self.members.iter().map(|member| member.distance(point)).fold(f64::NEG_INFINITY, f64::max)
    }

    pub(super) fn members(&self) -> &[Shape] {
        &self.members
    }

    pub(super) fn bounds(&self) -> Bounds {
        self.bounds
    }
}

/// What is in a shape, and within none of those that are taken away. A point on the surface of a shape that is taken
/// away is outside, although the field is ½ there.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    whole: Shape,
    taken: Union,
}

impl Difference {
    /// `whole` without `taken`.
    pub fn of(whole: Shape, taken: Vec<Shape>) -> Self {
        Self { whole, taken: Union::of(taken) }
    }

    pub(super) fn inside(&self, point: Point) -> bool {
        self.whole.inside(point) && !self.taken.inside(point)
    }

    pub(super) fn level(&self, point: Point, measure: Measure) -> f64 {
        self.whole.level(point, measure).min(2.0 * SURFACE - self.taken.level(point, measure))
    }

    pub(super) fn distance(&self, point: Point) -> f64 {
        self.whole.distance(point).max(-self.taken.distance(point))
    }

    /// The number of its parts, without itself.
    pub(super) fn parts(&self) -> usize {
        self.whole.parts() + self.taken.members.iter().map(Shape::parts).sum::<usize>()
    }

    pub(super) fn bounds(&self) -> Bounds {
        self.whole.bounds()
    }
}

/// Members that run together where they are near one another.
#[derive(Debug, Clone, PartialEq)]
pub struct Blend {
    members: Vec<Shape>,
    /// The bounds of each member, which it may be farther from than its distance says.
    bounds: Vec<Bounds>,
    /// The distance from the surface of each member at which its field ends, metres.
    reach: f64,
    tree: Tree,
}

impl Blend {
    /// The blend of members, each reaching so many metres beyond its surface.
    pub fn of(members: Vec<Shape>, reach: f64) -> Self {
        let bounds: Vec<Bounds> = members.iter().map(Shape::bounds).collect();
        let tree = Tree::of(&bounds.iter().map(|bounds| bounds.with_margin(reach)).collect::<Vec<_>>());
        Self { members, bounds, reach, tree }
    }

    /// The sum of the fields of the members. A member whose distances are too small, as those of one that is scaled
    /// unequally, is as far away as its bounds at least: so its field ends where it is no longer asked.
    pub(super) fn level(&self, point: Point) -> f64 {
        let measure = Measure { factor: 1.0, reach: Some(self.reach) };
        let mut sum = 0.0;
        self.tree.any(point, |member| {
            let (square, level) =
                (self.bounds[member].square_distance(point), self.members[member].level(point, measure));
            sum += if square > 0.0 { level.min(measure.field(square.sqrt())) } else { level };
            false
        });
        sum
    }

    /// The distance to the surface, metres, negative inside, along the line to the nearest place of the nearest member.
    pub(super) fn distance(&self, point: Point) -> f64 {
        let distances = self.members.iter().map(|member| (member, member.distance(point)));
        let Some((member, distance)) = distances.min_by(|a, b| a.1.total_cmp(&b.1)) else { return f64::INFINITY };
        if !distance.is_finite() {
            return distance;
        }
        let step = 1e-4 * self.reach;
        let slope = [0, 1, 2].map(|axis| {
            let beside = |by: f64| [0, 1, 2].map(|k| point[k] + if k == axis { by } else { 0.0 });
            (member.distance(beside(step)) - member.distance(beside(-step))) / (2.0 * step)
        });
        // A little within the surface of the member, where the field of the blend is above that of the surface.
        let back = distance.abs() + 1e-6 * self.reach;
        let core = [0, 1, 2].map(|k| point[k] - back * slope[k]);
        to_surface(|at| self.level(at), core, point, &self.tree.bounds()).unwrap_or(distance)
    }

    pub(super) fn members(&self) -> &[Shape] {
        &self.members
    }

    pub(super) fn bounds(&self) -> Bounds {
        self.tree.bounds()
    }
}
