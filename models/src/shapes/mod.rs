//! Shapes as people state them in files: a form with its sizes, or other shapes combined, blended or placed.
//!
//! A shape is a table with the key `form`, or the name of a shape that stands beside it. Shapes by their names are
//! compiled together (`compile`), with faults for what the schema cannot state. The forms themselves stand in
//! `phytomer_sim::shape`. Absent: what shapes are for.

mod compile;

pub use compile::{MOST_PARTS, Named, length_of, one};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

#[cfg(test)]
mod tests;

/// Shapes by their names.
pub type Shapes = BTreeMap<String, StatedShape>;

/// A shape, or the name of one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum ShapeOrName {
    /// The name of a shape.
    Name(String),
    /// A shape of its own.
    Shape(Box<StatedShape>),
}

/// A shape, by its `form`. Lengths are metres, z is upward.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "form", rename_all = "snake_case", deny_unknown_fields)]
pub enum StatedShape {
    /// A ball.
    Sphere {
        /// Its centre; the origin if not given.
        #[serde(default)]
        #[schemars(inner(range(min = -1e6, max = 1e6)))]
        at_m: [f64; 3],
        /// Its radius.
        #[schemars(range(min = 1e-6, max = 1e6))]
        radius_m: f64,
    },
    /// An ellipsoid along the axes.
    Ellipsoid {
        /// Its centre; the origin if not given.
        #[serde(default)]
        #[schemars(inner(range(min = -1e6, max = 1e6)))]
        at_m: [f64; 3],
        /// Its half axes in x, y and z.
        #[schemars(inner(range(min = 1e-6, max = 1e6)))]
        radii_m: [f64; 3],
    },
    /// A box along the axes.
    Box {
        /// The middle of its base; the origin if not given.
        #[serde(default)]
        #[schemars(inner(range(min = -1e6, max = 1e6)))]
        at_m: [f64; 3],
        /// Its extents in x, y and z.
        #[schemars(inner(range(min = 1e-6, max = 1e6)))]
        size_m: [f64; 3],
    },
    /// An upright cylinder.
    Cylinder {
        /// The middle of its base; the origin if not given.
        #[serde(default)]
        #[schemars(inner(range(min = -1e6, max = 1e6)))]
        at_m: [f64; 3],
        /// Its radius.
        #[schemars(range(min = 1e-6, max = 1e6))]
        radius_m: f64,
        /// Its height.
        #[schemars(range(min = 1e-6, max = 1e6))]
        height_m: f64,
    },
    /// An upright cone, or a part of one.
    Cone {
        /// The middle of its base; the origin if not given.
        #[serde(default)]
        #[schemars(inner(range(min = -1e6, max = 1e6)))]
        at_m: [f64; 3],
        /// The radius of its base.
        #[schemars(range(min = 0, max = 1e6))]
        radius_m: f64,
        /// The radius of its top; 0, a point, if not given.
        #[serde(default)]
        #[schemars(range(min = 0, max = 1e6))]
        top_radius_m: f64,
        /// Its height.
        #[schemars(range(min = 1e-6, max = 1e6))]
        height_m: f64,
    },
    /// All that is not farther than a radius from a line.
    Capsule {
        /// One end of the line.
        #[schemars(inner(range(min = -1e6, max = 1e6)))]
        from_m: [f64; 3],
        /// The other end.
        #[schemars(inner(range(min = -1e6, max = 1e6)))]
        to_m: [f64; 3],
        /// The radius.
        #[schemars(range(min = 1e-6, max = 1e6))]
        radius_m: f64,
    },
    /// A level ring.
    Torus {
        /// Its middle; the origin if not given.
        #[serde(default)]
        #[schemars(inner(range(min = -1e6, max = 1e6)))]
        at_m: [f64; 3],
        /// The radius of the ring, to the middle of the tube.
        #[schemars(range(min = 1e-6, max = 1e6))]
        ring_radius_m: f64,
        /// The radius of the tube.
        #[schemars(range(min = 1e-6, max = 1e6))]
        radius_m: f64,
    },
    /// All that lies on one side of a plane.
    HalfSpace {
        /// A point on the plane.
        #[schemars(inner(range(min = -1e6, max = 1e6)))]
        point_m: [f64; 3],
        /// The direction out of the half space; any length but 0.
        #[schemars(inner(range(min = -1e6, max = 1e6)))]
        normal: [f64; 3],
    },
    /// A line through points, as thick as is stated at each.
    Polyline {
        /// The points.
        #[schemars(length(min = 1, max = 10_000), inner(inner(range(min = -1e6, max = 1e6))))]
        points_m: Vec<[f64; 3]>,
        /// The radius at each point.
        #[schemars(length(min = 1, max = 10_000), inner(range(min = 0, max = 1e6)))]
        radii_m: Vec<f64>,
    },
    /// A sea shell: a circle swept on a helico-spiral, smaller with each turn (Fowler, Meinhardt & Prusinkiewicz 1992).
    Shell {
        /// The foot of its axis, at the height of the middle of the first circle; the origin if not given.
        #[serde(default)]
        #[schemars(inner(range(min = -1e6, max = 1e6)))]
        at_m: [f64; 3],
        /// The distance of the middle of the first circle from the axis.
        #[schemars(range(min = 1e-6, max = 1e6))]
        spiral_radius_m: f64,
        /// The height above the foot of the point towards which it winds.
        #[schemars(range(min = -1e6, max = 1e6))]
        height_m: f64,
        /// The radius of the first circle.
        #[schemars(range(min = 1e-6, max = 1e6))]
        radius_m: f64,
        /// The size of each turn, of that of the turn before.
        #[schemars(range(min = 0.01, max = 0.999))]
        shrink: f64,
        /// The number of turns.
        #[schemars(range(min = 0.01, max = 100))]
        turns: f64,
    },
    /// A soft object: fields about a skeleton, with the surface where they add up to ½ (Wyvill et al. 1986).
    Soft {
        /// The points of the skeleton.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        #[schemars(length(max = 10_000))]
        points: Vec<SoftPoint>,
        /// Its lines.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        #[schemars(length(max = 10_000))]
        lines: Vec<SoftLine>,
        /// Its ellipsoids.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        #[schemars(length(max = 10_000))]
        ellipsoids: Vec<SoftEllipsoid>,
    },
    /// A closed mesh of triangles: of a file, or stated by its points and triangles.
    Mesh {
        /// The PLY, OBJ or GLB file that has it, in metres, z upward (of a GLB y): a file in the folder of the file
        /// that names it.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[schemars(length(min = 1))]
        file: Option<String>,
        /// Its points, where no file has them.
        #[serde(default)]
        #[schemars(length(min = 4, max = 1_000_000), inner(inner(range(min = -1e6, max = 1e6))))]
        points_m: Vec<[f64; 3]>,
        /// Its triangles, each by the numbers of its points, from 0. All face outward, or all inward.
        #[serde(default)]
        #[schemars(length(min = 4, max = 1_000_000))]
        faces: Vec<[u32; 3]>,
    },
    /// What is in any of several shapes.
    Union {
        /// The shapes.
        #[schemars(length(min = 1, max = 10_000))]
        of: Vec<ShapeOrName>,
    },
    /// What is in all of several shapes.
    Intersection {
        /// The shapes.
        #[schemars(length(min = 1, max = 10_000))]
        of: Vec<ShapeOrName>,
    },
    /// A shape without others.
    Difference {
        /// The shape.
        of: ShapeOrName,
        /// What is taken away from it.
        #[schemars(length(min = 1, max = 10_000))]
        less: Vec<ShapeOrName>,
    },
    /// Shapes that run together where they are near one another.
    Blend {
        /// The shapes.
        #[schemars(length(min = 1, max = 10_000))]
        of: Vec<ShapeOrName>,
        /// The distance from each surface up to which a shape is felt: what is nearer than twice this runs together.
        #[schemars(range(min = 1e-6, max = 1e6))]
        reach_m: f64,
    },
    /// A shape that is scaled, then turned, then moved.
    Placed {
        /// The shape.
        of: ShapeOrName,
        /// How far it is moved; not at all if not given.
        #[serde(default)]
        #[schemars(inner(range(min = -1e6, max = 1e6)))]
        move_m: [f64; 3],
        /// How it is turned about the origin; not at all if not given.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        turn: Option<Turn>,
        /// What its sizes are multiplied with; 1 if not given.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        scale: Option<Scale>,
    },
}

/// A point of the skeleton of a soft object.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SoftPoint {
    /// Where it is.
    #[schemars(inner(range(min = -1e6, max = 1e6)))]
    pub at_m: [f64; 3],
    /// The distance at which its field ends; a lone point has its surface at half of it.
    #[schemars(range(min = 1e-6, max = 1e6))]
    pub reach_m: f64,
    /// What its field is multiplied with: 1 if not given; negative where it takes away.
    #[serde(default = "one_time")]
    #[schemars(range(min = -100, max = 100))]
    pub strength: f64,
}

/// A line of the skeleton of a soft object.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SoftLine {
    /// One end.
    #[schemars(inner(range(min = -1e6, max = 1e6)))]
    pub from_m: [f64; 3],
    /// The other end.
    #[schemars(inner(range(min = -1e6, max = 1e6)))]
    pub to_m: [f64; 3],
    /// The distance at which its field ends.
    #[schemars(range(min = 1e-6, max = 1e6))]
    pub reach_m: f64,
    /// What its field is multiplied with: 1 if not given.
    #[serde(default = "one_time")]
    #[schemars(range(min = -100, max = 100))]
    pub strength: f64,
}

/// An ellipsoid of the skeleton of a soft object, along the axes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SoftEllipsoid {
    /// Its centre.
    #[schemars(inner(range(min = -1e6, max = 1e6)))]
    pub at_m: [f64; 3],
    /// The distances in x, y and z at which its field ends; a lone ellipsoid has its surface at half of them.
    #[schemars(inner(range(min = 1e-6, max = 1e6)))]
    pub reach_m: [f64; 3],
    /// What its field is multiplied with: 1 if not given.
    #[serde(default = "one_time")]
    #[schemars(range(min = -100, max = 100))]
    pub strength: f64,
}

fn one_time() -> f64 {
    1.0
}

/// A turn about an axis through the origin, by the rule of the right hand.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Turn {
    /// The direction of the axis; any length but 0.
    #[schemars(inner(range(min = -1e6, max = 1e6)))]
    pub about: [f64; 3],
    /// The angle, degrees.
    #[schemars(range(min = -360, max = 360))]
    pub angle_deg: f64,
}

/// What sizes are multiplied with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Scale {
    /// All by the same number.
    All(#[schemars(range(min = 1e-6, max = 1e6))] f64),
    /// Those in x, y and z by numbers of their own.
    Axes(#[schemars(inner(range(min = 1e-6, max = 1e6)))] [f64; 3]),
}
