//! Shapes made of shapes: unions, intersections, differences and blends.
//!
//! Of a union, an intersection and a difference the field is the greatest, the least, and the least with 1 less the
//! field of what is taken away (constructive solid geometry: Ricci 1973). A blend adds fields as soft objects do: each
//! member's goes from 1 to 0 by Wyvill's polynomial as its surface is passed from `reach` within to `reach` outside. So
//! two members that are nearer than twice that distance run together, and alone each keeps its surface.

use super::bounds::Bounds;
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

    pub(super) fn bounds(&self) -> Bounds {
        self.whole.bounds()
    }
}

/// Members that run together where they are near one another.
#[derive(Debug, Clone, PartialEq)]
pub struct Blend {
    members: Vec<Shape>,
    /// The distance from the surface of each member at which its field ends, metres.
    reach: f64,
    tree: Tree,
}

impl Blend {
    /// The blend of members, each reaching so many metres beyond its surface.
    pub fn of(members: Vec<Shape>, reach: f64) -> Self {
        let tree = Tree::of(&members.iter().map(|member| member.bounds().with_margin(reach)).collect::<Vec<_>>());
        Self { members, reach, tree }
    }

    /// The sum of the fields of the members.
    pub(super) fn level(&self, point: Point) -> f64 {
        let measure = Measure { factor: 1.0, reach: Some(self.reach) };
        let mut sum = 0.0;
        self.tree.any(point, |member| {
            sum += self.members[member].level(point, measure);
            false
        });
        sum
    }

    pub(super) fn bounds(&self) -> Bounds {
        self.tree.bounds()
    }
}
