//! From shapes as they are stated to the shapes of `phytomer_sim`, with the faults that the schema cannot state.
//!
//! Faults: names of no shape, shapes that lead back to themselves, directions without length, radii that do not fit the
//! points, skeletons without parts, meshes that are not closed, and shapes of too many parts. Absent: sizes, which the
//! schema bounds.

use super::{Scale, ShapeOrName, Shapes, StatedShape, Turn};
use crate::fault::{Fault, Path};
use crate::law::spelling::nearest;
use phytomer_sim::rotation::Rotation;
use phytomer_sim::shape::{
    Blend, Capsule, Cone, Cuboid, Cylinder, Difference, Ellipsoid, HalfSpace, Intersection, Mesh, Placed, Polyline,
    Shape, Shell, Skeleton, Soft, Sphere, Torus, Union,
};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// The most parts of a shape: names are replaced by their shapes, so that a few lines could state a shape without end.
/// Also the most parts that the shapes of obstacles have together where they are stated without a name, and those of
/// events.
pub const MOST_PARTS: usize = 100_000;
/// The most parts of all shapes that have names together.
const MOST_PARTS_OF_NAMES: usize = 400_000;
/// The most shapes within one another.
const DEEPEST: usize = 50;

/// Shapes by their names, compiled. A name whose shape is at fault has none.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Named {
    shapes: BTreeMap<String, Option<Made>>,
}

/// A compiled shape.
#[derive(Debug, Clone, PartialEq)]
struct Made {
    shape: Arc<Shape>,
    /// The number of its parts.
    parts: usize,
    /// The number of shapes within one another, itself among them.
    height: usize,
}

impl Named {
    /// The shapes of a table that stands at `path`, and their faults.
    pub fn of(stated: &Shapes, path: &Path, faults: &mut Vec<Fault>) -> Self {
        let mut compiler =
            Compiler { stated, path, done: Self::default(), parts: 0, open: Vec::new(), depth: 0, faults };
        for name in stated.keys() {
            compiler.named(name, path);
            if compiler.parts > MOST_PARTS_OF_NAMES {
                let problem = format!("the named shapes up to `{name}` have more than {MOST_PARTS_OF_NAMES} parts");
                let expected =
                    format!("at most {MOST_PARTS_OF_NAMES} of all together, shapes within shapes counted anew");
                compiler.faults.push(Fault::new(&path.key(name), problem, expected));
                break;
            }
        }
        compiler.done
    }

    /// The shape of a name.
    pub fn get(&self, name: &str) -> Option<&Arc<Shape>> {
        self.shapes.get(name)?.as_ref().map(|made| &made.shape)
    }

    /// The number of parts of the shape of a name, which is the work of asking it; 0 where there is none.
    pub fn parts(&self, name: &str) -> usize {
        self.shapes.get(name).and_then(Option::as_ref).map_or(0, |made| made.parts)
    }

    /// Each name whose shape has no fault, with the shape.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Arc<Shape>)> {
        self.shapes.iter().filter_map(|(name, shape)| Some((name.as_str(), &shape.as_ref()?.shape)))
    }
}

/// One shape, or one by its name, stated at `path`; `None` where it has faults, which are added, or where the named
/// shape has.
pub fn one(shape: &ShapeOrName, named: &Named, path: &Path, faults: &mut Vec<Fault>) -> Option<Arc<Shape>> {
    match shape {
        ShapeOrName::Name(name) => match named.shapes.get(name) {
            Some(known) => known.as_ref().map(|made| Arc::clone(&made.shape)),
            None => {
                faults.push(unknown(name, named.shapes.keys(), path));
                None
            }
        },
        ShapeOrName::Shape(stated) => {
            let none = Shapes::new();
            let mut compiler =
                Compiler { stated: &none, path, done: named.clone(), parts: 0, open: Vec::new(), depth: 0, faults };
            compiler.shape(stated, path).map(|made| made.shape)
        }
    }
}

fn unknown<'a>(name: &str, known: impl Iterator<Item = &'a String> + Clone, path: &Path) -> Fault {
    let list: Vec<String> = known.clone().map(|known| format!("`{known}`")).collect();
    let expected = match nearest(name, known.map(String::as_str)) {
        Some(near) => format!("the name of a shape; the nearest is `{near}`"),
        None if list.is_empty() => "a shape: a table with the key `form`; no shape has a name here".to_owned(),
        None => format!("a shape: one of {}, or a table with the key `form`", list.join(", ")),
    };
    Fault::new(path, format!("there is no shape `{name}`"), expected)
}

struct Compiler<'a> {
    stated: &'a Shapes,
    /// Where the table of names stands.
    path: &'a Path,
    done: Named,
    /// The parts of all shapes that are done.
    parts: usize,
    /// The names whose shapes are being compiled, each within the one before.
    open: Vec<String>,
    /// The shapes that are being compiled, each within the one before.
    depth: usize,
    faults: &'a mut Vec<Fault>,
}

/// Members of a shape: they themselves, the number of their parts and the greatest of their heights.
#[derive(Default)]
struct Members {
    shapes: Vec<Shape>,
    parts: usize,
    height: usize,
}

impl Compiler<'_> {
    /// Adds a fault; there is no shape then.
    fn fault<T>(&mut self, path: &Path, problem: impl Into<String>, expected: impl Into<String>) -> Option<T> {
        self.faults.push(Fault::new(path, problem, expected));
        None
    }

    /// The shape of a name that is mentioned at `path`.
    fn named(&mut self, name: &str, path: &Path) -> Option<Made> {
        if let Some(done) = self.done.shapes.get(name) {
            return done.clone();
        }
        let Some(stated) = self.stated.get(name) else {
            let known: BTreeSet<&String> = self.stated.keys().chain(self.done.shapes.keys()).collect();
            self.faults.push(unknown(name, known.iter().copied(), path));
            return None;
        };
        if self.open.iter().any(|open| open == name) {
            let problem = format!("the shape `{name}` is made of itself");
            return self.fault(path, problem, "shapes that do not lead back to it");
        }
        self.open.push(name.to_owned());
        let compiled = self.shape(stated, &self.path.key(name));
        self.open.pop();
        self.parts += compiled.as_ref().map_or(0, |made| made.parts);
        self.done.shapes.insert(name.to_owned(), compiled.clone());
        compiled
    }

    fn member(&mut self, member: &ShapeOrName, path: &Path) -> Option<Made> {
        match member {
            ShapeOrName::Name(name) => self.named(name, path),
            ShapeOrName::Shape(stated) => self.shape(stated, path),
        }
    }

    /// All members of a list; `None` if any is at fault.
    fn members(&mut self, list: &[ShapeOrName], path: &Path) -> Option<Members> {
        let mut all = Some(Members::default());
        for (number, member) in list.iter().enumerate() {
            let member = self.member(member, &path.index(number));
            let (Some(members), Some(Made { shape, parts, height })) = (&mut all, member) else {
                all = None;
                continue;
            };
            members.parts += parts;
            members.height = members.height.max(height);
            if members.parts > MOST_PARTS {
                let problem = format!("the shape has more than {MOST_PARTS} parts");
                return self.fault(path, problem, format!("at most {MOST_PARTS}"));
            }
            members.shapes.push(Arc::unwrap_or_clone(shape));
        }
        all
    }

    /// A shape that stands at `path`.
    fn shape(&mut self, stated: &StatedShape, path: &Path) -> Option<Made> {
        self.depth += 1;
        let made = if self.depth > DEEPEST { None } else { Some(self.within(stated, path)) };
        self.depth -= 1;
        match made {
            Some(made) if made.as_ref().is_none_or(|made| made.height <= DEEPEST) => made,
            _ => {
                let problem = format!("there are more than {DEEPEST} shapes within one another");
                self.fault(path, problem, format!("at most {DEEPEST}"))
            }
        }
    }

    fn within(&mut self, stated: &StatedShape, path: &Path) -> Option<Made> {
        let of = path.key("of");
        let made = |shape: Shape, parts: usize, height: usize| {
            Some(Made { shape: Arc::new(shape), parts: parts + 1, height: height + 1 })
        };
        match stated {
            StatedShape::Union { of: list } => {
                let Members { shapes, parts, height } = self.members(list, &of)?;
                made(Shape::Union(Union::of(shapes)), parts, height)
            }
            StatedShape::Intersection { of: list } => {
                let Members { shapes, parts, height } = self.members(list, &of)?;
                made(Shape::Intersection(Intersection::of(shapes)), parts, height)
            }
            StatedShape::Blend { of: list, reach_m } => {
                let Members { shapes, parts, height } = self.members(list, &of)?;
                made(Shape::Blend(Blend::of(shapes, *reach_m)), parts, height)
            }
            StatedShape::Difference { of: whole, less } => {
                let whole = self.member(whole, &of);
                let Members { shapes, parts, height } = self.members(less, &path.key("less"))?;
                let whole = whole?;
                let (parts, height) = (parts + whole.parts, height.max(whole.height));
                if parts > MOST_PARTS {
                    let problem = format!("the shape has more than {MOST_PARTS} parts");
                    return self.fault(path, problem, format!("at most {MOST_PARTS}"));
                }
                let rest = Difference::of(Arc::unwrap_or_clone(whole.shape), shapes);
                made(Shape::Difference(Box::new(rest)), parts, height)
            }
            StatedShape::Placed { of: shape, move_m, turn, scale } => {
                let shape = self.member(shape, &of);
                let turn = self.turn(turn.as_ref(), &path.key("turn"))?;
                let scale = match scale {
                    None => [1.0; 3],
                    Some(Scale::All(all)) => [*all; 3],
                    Some(Scale::Axes(axes)) => *axes,
                };
                let Made { shape, parts, height } = shape?;
                let placed = Placed::of(Arc::unwrap_or_clone(shape), scale, turn, *move_m);
                made(Shape::Placed(Box::new(placed)), parts, height)
            }
            solid => made(self.solid(solid, path)?, own_parts(solid), 0),
        }
    }

    /// A shape that is made of no other.
    fn solid(&mut self, stated: &StatedShape, path: &Path) -> Option<Shape> {
        match stated {
            StatedShape::Polyline { points_m, radii_m } if points_m.len() != radii_m.len() => {
                let problem = format!("there are {} radii and {} points", radii_m.len(), points_m.len());
                self.fault(&path.key("radii_m"), problem, "a radius for each point")
            }
            StatedShape::Polyline { points_m, radii_m } => {
                let points = points_m.iter().copied().zip(radii_m.iter().copied()).collect();
                Some(Shape::Polyline(Polyline::of(points)))
            }
            StatedShape::Mesh { file: Some(file), .. } => {
                let problem = format!("the mesh `{file}` has not been read");
                self.fault(&path.key("file"), problem, "`points_m` and `faces`, where no files are read")
            }
            StatedShape::Mesh { file: None, points_m, faces } => match Mesh::of(points_m, faces) {
                Ok(mesh) => Some(Shape::Mesh(Arc::new(mesh))),
                Err(fault) => {
                    let expected = "triangles that enclose space, each edge between two of them";
                    self.fault(&path.key("faces"), fault.to_string(), expected)
                }
            },
            StatedShape::Soft { .. } => {
                let parts = skeleton(stated);
                if parts.is_empty() {
                    return self.fault(path, "the soft object has no skeleton", "`points`, `lines` or `ellipsoids`");
                }
                Some(Shape::Soft(Soft::of(parts)))
            }
            StatedShape::HalfSpace { normal, .. } if HalfSpace::is_too_short(*normal) => {
                let problem = format!("the normal of the half space has {}", length_of(*normal));
                self.fault(&path.key("normal"), problem, "a direction, such as [0, 0, 1]")
            }
            plainly => plain(plainly),
        }
    }

    fn turn(&mut self, turn: Option<&Turn>, path: &Path) -> Option<Rotation> {
        let Some(Turn { about, angle_deg }) = turn else { return Some(Rotation::NONE) };
        if *about == [0.0; 3] {
            let problem = "the axis of the turn has the length 0";
            return self.fault(&path.key("about"), problem, "a direction, such as [0, 0, 1]");
        }
        // The length of the axis is of no account, but a tiny one would count as none.
        let most = about.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        Some(Rotation::about(about.map(|x| x / most), angle_deg.to_radians()))
    }
}

/// What is told of the length of a normal that is too short.
pub fn length_of(normal: [f64; 3]) -> String {
    match normal == [0.0; 3] {
        true => "the length 0".to_owned(),
        false => format!("a length below {:e}", HalfSpace::SHORTEST),
    }
}

/// A form that is stated by its sizes alone; `None` for any other.
fn plain(stated: &StatedShape) -> Option<Shape> {
    Some(match *stated {
        StatedShape::Sphere { at_m: centre, radius_m: radius } => Shape::Sphere(Sphere { centre, radius }),
        StatedShape::Ellipsoid { at_m: centre, radii_m: radii } => Shape::Ellipsoid(Ellipsoid { centre, radii }),
        StatedShape::Box { at_m, size_m } => Shape::Cuboid(Cuboid::on(at_m, size_m)),
        StatedShape::Cylinder { at_m: base, radius_m: radius, height_m: height } => {
            Shape::Cylinder(Cylinder { base, radius, height })
        }
        StatedShape::Cone { at_m: base, radius_m: radius, top_radius_m: top_radius, height_m: height } => {
            Shape::Cone(Cone { base, radius, top_radius, height })
        }
        StatedShape::Capsule { from_m: start, to_m: end, radius_m: radius } => {
            Shape::Capsule(Capsule { start, end, radius })
        }
        StatedShape::Torus { at_m: centre, ring_radius_m: ring, radius_m: tube } => {
            Shape::Torus(Torus { centre, ring, tube })
        }
        StatedShape::HalfSpace { point_m: point, normal } => Shape::HalfSpace(HalfSpace { point, normal }),
        StatedShape::Shell { at_m: foot, spiral_radius_m: spiral, height_m: height, radius_m: tube, shrink, turns } => {
            Shape::Shell(Shell { foot, spiral, height, tube, shrink, turns })
        }
        _ => return None,
    })
}

/// The parts of the skeleton of a soft object; none of any other shape.
fn skeleton(stated: &StatedShape) -> Vec<(Skeleton, f64)> {
    let StatedShape::Soft { points, lines, ellipsoids } = stated else { return Vec::new() };
    let points = points.iter().map(|point| (Skeleton::Line(point.at_m, point.at_m, point.reach_m), point.strength));
    let lines = lines.iter().map(|line| (Skeleton::Line(line.from_m, line.to_m, line.reach_m), line.strength));
    let ellipsoids = ellipsoids.iter().map(|part| {
        let reach = Ellipsoid { centre: part.at_m, radii: part.reach_m };
        (Skeleton::Ellipsoid(reach), part.strength)
    });
    points.chain(lines).chain(ellipsoids).collect()
}

/// The parts of a shape that is made of no other, which are copied with it, beside the shape itself.
fn own_parts(stated: &StatedShape) -> usize {
    match stated {
        StatedShape::Polyline { points_m, .. } => points_m.len(),
        StatedShape::Soft { points, lines, ellipsoids } => points.len() + lines.len() + ellipsoids.len(),
        _ => 0,
    }
}
