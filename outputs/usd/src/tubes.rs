//! The wood of a life: a tube along each line, of rings that follow its points.
//!
//! A ring has as many sides as its largest radius asks within the tolerance (the polygon of the circle's area, as in
//! meshes within a tolerance), so that its number never changes. It stands across the mean of the two directions, and
//! is wider in the plane of the bend, so that a tube keeps its section where it turns. Quads join rings of equal sides,
//! triangles others; the two ends are closed by a polygon each, on the vertices of their rings.

use super::changing::{Changing, Faces, Tags};
use super::course::State;
use super::covers::Slotted;
use super::skeleton::Skeleton;
use glam::{Quat, Vec3, Vec4Swizzles};
use phytomer_life::{Life, Line, Member, between, stepped};
use phytomer_meshes::{bark_covers, corners_of_area, meeting, sides_within};

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
    /// Which lines of which lives these are; `None`: all.
    slot: Option<Slotted<'a>>,
    /// Of each life the texture coordinates along its points, and the repeats around them, where there is bark.
    bark: Vec<Vec<[f32; 2]>>,
}

impl<'a> Tubes<'a> {
    /// The tubes of some lives within a tolerance, metres, where they stand; of a slot of materials alone, where one is
    /// told.
    pub fn of(skeletons: &'a [Skeleton<'a>], members: &'a [Member], tolerance: f32, slot: Option<Slotted<'a>>) -> Self {
        let sides: Vec<Vec<u16>> = skeletons.iter().map(|skeleton| sides(skeleton.life, tolerance)).collect();
        let mut polygons: Vec<Vec<Corner>> = Vec::new();
        for sides in sides.iter().flatten() {
            let place = usize::from(*sides);
            polygons.resize(polygons.len().max(place + 1), Vec::new());
            if polygons[place].is_empty() {
                polygons[place] = corners_of_area(*sides);
            }
        }
        let barks = skeletons.iter().enumerate().map(|(life, skeleton)| {
            let size = |line: &Line| slot.as_ref().and_then(|slot| slot.bark(life, line));
            bark_along(skeleton.life, &size)
        });
        let bark = barks.collect();
        Self { skeletons, sides, polygons, members, slot, bark }
    }

    /// Whether there is any wood.
    pub fn is_empty(&self) -> bool {
        let has = |(life, skeleton): (usize, &Skeleton)| skeleton.life.lines.iter().any(|line| self.has(life, line));
        !self.skeletons.iter().enumerate().any(has)
    }

    fn has(&self, life: usize, line: &Line) -> bool {
        self.slot.as_ref().is_none_or(|slot| slot.has_line(life, line, self.skeletons[life].life))
    }

    /// Calls `see` with each line of a span and the places of its points.
    fn each_line(&self, span: usize, see: &mut dyn FnMut(&Member, &Line, &[usize])) {
        let mut points = Vec::new();
        for member in self.members {
            let Some(skeleton) = self.skeletons.get(member.life) else { continue };
            for line in skeleton.life.lines.iter().filter(|line| self.has(member.life, line)) {
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

impl Tubes<'_> {
    /// The numbers of sides of the rings at some points.
    fn sides_of(&self, member: &Member, points: &[usize], sides: &mut Vec<usize>) {
        sides.clear();
        sides.extend(points.iter().map(|point| usize::from(self.sides[member.life][*point])));
    }
}

impl Changing for Tubes<'_> {
    fn faces(&self, span: usize, faces: &mut Faces) {
        let (mut first, mut sides, mut starts) = (0, Vec::new(), Vec::new());
        self.each_line(span, &mut |member, _, points| {
            self.sides_of(member, points, &mut sides);
            starts.clear();
            for count in &sides {
                starts.push(first);
                first += count;
            }
            each_face(&sides, |corners| {
                faces.add_all(corners.iter().map(|[ring, around]| starts[*ring] + around % sides[*ring]));
            });
        });
    }

    fn textures(&self, span: usize) -> Option<Vec<[f32; 2]>> {
        self.slot.as_ref().filter(|slot| slot.has_texture())?;
        let (mut all, mut sides) = (Vec::new(), Vec::new());
        self.each_line(span, &mut |member, _, points| {
            self.sides_of(member, points, &mut sides);
            each_face(&sides, |corners| {
                all.extend(corners.iter().map(|[ring, around]| {
                    let [times, along] = self.bark[member.life][points[*ring]];
                    [times * *around as f32 / sides[*ring] as f32, along]
                }));
            });
        });
        Some(all)
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

/// Calls `see` with the corners of each face of a tube of rings of so many sides, each as its ring and its place around
/// it; the place after the last is the first again. Quads join two rings of equal sides, else triangles, corner to
/// nearest corner.
#[inline]
fn each_face(sides: &[usize], mut see: impl FnMut(&[[usize; 2]])) {
    let Some(last) = sides.len().checked_sub(1) else { return };
    see(&(0..sides[0]).rev().map(|around| [0, around]).collect::<Vec<_>>());
    for (ring, pair) in sides.windows(2).enumerate() {
        let (low, high) = (|around| [ring, around], |around| [ring + 1, around]);
        if pair[0] == pair[1] {
            (0..pair[0]).for_each(|k| see(&[low(k), low(k + 1), high(k + 1), high(k)]));
            continue;
        }
        for (lower, [i, j]) in meeting([pair[0] as u32, pair[1] as u32]) {
            let [i, j] = [i, j].map(|corner| corner as usize);
            see(&[low(i), if lower { low(i + 1) } else { high(j + 1) }, high(j)]);
        }
    }
    see(&(0..sides[last]).map(|around| [last, around]).collect::<Vec<_>>());
}

/// For each point of a life the repeats of bark around it, and its distance along its line in heights of the bark's
/// picture; 0 on lines whose bark has no size. Each point is taken as it stands when it is last shown, so that bark
/// keeps its place on wood that grows.
fn bark_along(life: &Life, size: &dyn Fn(&Line) -> Option<[f32; 2]>) -> Vec<[f32; 2]> {
    let mut all = vec![[0.0; 2]; life.points.len()];
    for line in &life.lines {
        let Some(size) = size(line) else { continue };
        let places: Vec<[f32; 4]> = (life.points[line.points.clone()].iter())
            .map(|point| life.places(point).last().map_or([0.0; 4], |(_, place)| *place))
            .collect();
        let apart = |pair: &[[f32; 4]]| {
            let way = [0, 1, 2].map(|k| f64::from(pair[1][k]) - f64::from(pair[0][k]));
            way.iter().map(|x| x * x).sum::<f64>().sqrt()
        };
        // The mean circumference, each part by its surface.
        let (mut surface, mut squares) = (0.0, 0.0);
        for pair in places.windows(2) {
            let wide = f64::from(pair[0][3]) + f64::from(pair[1][3]);
            surface += wide * apart(pair);
            squares += wide * wide * apart(pair);
        }
        let [around, long] =
            bark_covers(size, if surface > 0.0 { std::f64::consts::PI * squares / surface } else { 0.0 });
        let mut along = 0.0;
        for (k, point) in line.points.clone().enumerate() {
            along += if k > 0 { apart(&places[k - 1..=k]) } else { 0.0 };
            all[point] = [around, along as f32 / long];
        }
    }
    all
}
