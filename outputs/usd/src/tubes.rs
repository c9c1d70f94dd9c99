//! The wood of a life: a tube along each line, of rings that follow its points.
//!
//! A ring has as many sides as its largest radius asks within the tolerance (the polygon of the circle's area, as in
//! meshes within a tolerance), so that its number never changes. It stands across the mean of the two directions, and
//! is wider in the plane of the bend, so that a tube keeps its section where it turns. Quads join rings of equal sides,
//! triangles others; the two ends are closed by a polygon each, on the vertices of their rings.

use super::changing::{Changing, Faces, Tags};
use super::course::State;
use super::skeleton::Skeleton;
use glam::{Quat, Vec3, Vec4Swizzles};
use phytomer_life::{Life, Line, Member, between, stepped};
use phytomer_meshes::{corners_of_area, meeting, sides_within};

/// The most by which a ring is widened in the plane of a bend.
const WIDEST: f32 = 1.5;

/// A corner of a ring: cosine and sine, times the distance of a corner in radii of the circle.
type Corner = [f32; 2];

/// The tubes of several lives.
pub struct Tubes<'a> {
    skeletons: &'a [Skeleton<'a>],
    /// The number of sides of the ring at each point, life by life.
    sides: Vec<Vec<u16>>,
    polygons: Vec<Vec<Corner>>,
    members: &'a [Member],
}

impl<'a> Tubes<'a> {
    /// The tubes of some lives within a tolerance, metres, where they stand.
    pub fn of(skeletons: &'a [Skeleton<'a>], members: &'a [Member], tolerance: f32) -> Self {
        let sides: Vec<Vec<u16>> = skeletons.iter().map(|skeleton| sides(skeleton.life, tolerance)).collect();
        let mut polygons: Vec<Vec<Corner>> = Vec::new();
        for sides in sides.iter().flatten() {
            let place = usize::from(*sides);
            polygons.resize(polygons.len().max(place + 1), Vec::new());
            if polygons[place].is_empty() {
                polygons[place] = corners_of_area(*sides);
            }
        }
        Self { skeletons, sides, polygons, members }
    }

    /// Whether there is any wood.
    pub fn is_empty(&self) -> bool {
        self.skeletons.iter().all(|skeleton| skeleton.life.lines.is_empty())
    }

    /// Calls `see` with each line of a span and the places of its points.
    fn each_line(&self, span: usize, see: &mut dyn FnMut(&Member, &Line, &[usize])) {
        let mut points = Vec::new();
        for member in self.members {
            let Some(skeleton) = self.skeletons.get(member.life) else { continue };
            for line in &skeleton.life.lines {
                points.clear();
                points.extend(skeleton.members(line, span));
                if points.len() > 1 {
                    see(member, line, &points);
                }
            }
        }
    }
}

/// The number of sides of the ring at each point of a life.
fn sides(life: &Life, tolerance: f32) -> Vec<u16> {
    let largest = |point| life.places(point).iter().map(|(_, place)| place[3]).fold(0.0, f32::max);
    life.points.iter().map(|point| sides_within(largest(point), tolerance)).collect()
}

impl Changing for Tubes<'_> {
    fn faces(&self, span: usize, faces: &mut Faces) {
        let mut first = 0;
        self.each_line(span, &mut |member, _, points| {
            let sides = |k: usize| usize::from(self.sides[member.life][points[k]]);
            faces.add_all((0..sides(0)).rev().map(|corner| first + corner));
            for k in 1..points.len() {
                join([first, sides(k - 1)], [first + sides(k - 1), sides(k)], faces);
                first += sides(k - 1);
            }
            let last = sides(points.len() - 1);
            faces.add_all((0..last).map(|corner| first + corner));
            first += last;
        });
    }

    fn tags(&self, span: usize, tags: &mut Tags) {
        self.each_line(span, &mut |member, _, points| {
            let life = self.skeletons[member.life].life;
            for place in points {
                let (point, sides) = (&life.points[*place], usize::from(self.sides[member.life][*place]));
                tags.add(sides, point.component, point.birth, point.death - life.sown);
            }
        });
    }

    fn points(&self, state: State, out: &mut Vec<[f32; 3]>) {
        let mut centres = Vec::new();
        self.each_line(state.span, &mut |member, line, points| {
            let skeleton = &self.skeletons[member.life];
            let goes = skeleton.goes(line, state.span);
            centres.clear();
            centres.extend(points.iter().map(|place| skeleton.place(*place, state, goes)));
            let offset = Vec3::from_array(member.offset);
            let mut turned = Turned::default();
            for (k, place) in points.iter().enumerate() {
                let here = centres[k].xyz();
                let before = centres[..k].iter().rev().map(|at| at.xyz()).find(|at| *at != here);
                let after = centres[k + 1..].iter().map(|at| at.xyz()).find(|at| *at != here);
                turned.turn(before.map(|at| here - at), after.map(|at| at - here));
                let corners = &self.polygons[usize::from(self.sides[member.life][*place])];
                out.extend(corners.iter().map(|corner| (offset + here + turned.at(*corner, centres[k].w)).to_array()));
            }
        });
    }

    fn colours(&self, state: State, paint: &mut dyn FnMut(usize, [u8; 3])) {
        self.each_line(state.span, &mut |member, _, points| {
            let life = self.skeletons[member.life].life;
            for place in points {
                let tint = between(life.tints_of_point(&life.points[*place]), life.ages[state.age]);
                paint(usize::from(self.sides[member.life][*place]), stepped(tint));
            }
        });
    }
}

/// The frame of a ring, turned from ring to ring without a twist.
#[derive(Default)]
struct Turned {
    along: Option<Vec3>,
    up: Vec3,
    side: Vec3,
    /// The direction in which the tube bends, and how much wider the ring is along it.
    bend: (Vec3, f32),
}

impl Turned {
    /// Turns on to a ring between two directions.
    fn turn(&mut self, before: Option<Vec3>, after: Option<Vec3>) {
        let [before, after] = [before, after].map(|way| way.map(Vec3::normalize_or_zero));
        let (from, to) = (before.or(after).unwrap_or(Vec3::Z), after.or(before).unwrap_or(Vec3::Z));
        let along = (from + to).try_normalize().unwrap_or(from);
        self.up = match self.along {
            Some(last) => Quat::from_rotation_arc(last, along) * self.up,
            // Two references, so that an axis that stands and one that hangs both turn smoothly.
            None if along.z > -0.5 => Quat::from_rotation_arc(Vec3::Z, along) * Vec3::X,
            None => Quat::from_rotation_arc(Vec3::NEG_Z, along) * Vec3::X,
        };
        self.up = (self.up - along * self.up.dot(along)).try_normalize().unwrap_or(self.up);
        self.side = along.cross(self.up);
        self.along = Some(along);
        let cos = along.dot(to);
        let wider = if cos > 0.0 { (1.0 / cos).min(WIDEST) } else { WIDEST };
        self.bend = ((to - from).normalize_or_zero(), wider - 1.0);
    }

    fn at(&self, [cos, sin]: Corner, radius: f32) -> Vec3 {
        let out = (self.up * cos + self.side * sin) * radius;
        let (bend, wider) = self.bend;
        out + bend * (out.dot(bend) * wider)
    }
}

/// Joins two rings by quads where they have equal sides, else by triangles, corner to nearest corner.
fn join([a, n]: [usize; 2], [b, m]: [usize; 2], faces: &mut Faces) {
    if n == m {
        (0..n).for_each(|k| faces.add([a + k, a + (k + 1) % n, b + (k + 1) % n, b + k]));
        return;
    }
    for (lower, [i, j]) in meeting([n as u32, m as u32]) {
        let [i, j] = [i, j].map(|corner| corner as usize);
        let [low, high] = [a + i % n, b + j % m];
        faces.add([low, if lower { a + (i + 1) % n } else { b + (j + 1) % m }, high]);
    }
}
