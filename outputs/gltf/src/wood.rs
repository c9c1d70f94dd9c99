//! Wood that grows: a tube for each line of a life, with the same rings at every key.
//!
//! All rings of a line have the sides that its thickest point ever needs within the tolerance; a polygon keeps the area
//! of its circle. A point that does not stand at a key is where the next point of its line stands, so that new rings
//! come out of the tip; one whose internode stands, though the line had no need of the point, is where the internode
//! begins, with a radius between those of its neighbours. A line that does not stand is a point. Rings are turned
//! without a twist from the base on, and from the last key to the first. The tip is closed.

use super::keys::Keyed;
use glam::Vec3;
use phytomer_life::{Line, between};
use phytomer_meshes::{Tag, bark_covers, corners_of_area, sides_within};
use std::ops::Range;

/// A ring: x, y, z of its middle and its radius, metres.
pub type Ring = [f32; 4];

/// What no vertex has.
const NO_TAG: Tag = Tag { colour: [0, 0, 0, 255], birth: 0.0, death: f32::MAX, component: -1, kind: 0 };

/// The tube of a line.
#[derive(Debug, Clone)]
pub struct Tube {
    /// The line among those of the life.
    pub line: usize,
    /// Cosine and sine of each corner, times the reach of a polygon of the circle's area; where the bark has a picture
    /// the first corner is there twice, for the seam.
    polygon: Vec<[f32; 2]>,
    /// The size of the picture of the bark.
    bark: Option<[f32; 2]>,
    /// The keys at which it stands.
    pub keys: Range<usize>,
    /// The direction of the first corner of the first ring at each of these keys.
    ups: Vec<Vec3>,
    /// The component that bears the line.
    first: u32,
}

impl Tube {
    /// The tubes of all lines that stand at a key.
    pub fn all(keyed: &Keyed, tolerance: f32) -> Vec<Self> {
        (0..keyed.life.lines.len()).filter_map(|line| Self::of(keyed, line, tolerance)).collect()
    }

    fn of(keyed: &Keyed, line: usize, tolerance: f32) -> Option<Self> {
        let of = &keyed.life.lines[line];
        let stands = |key: &usize| keyed.age(*key).is_some_and(|age| keyed.life.line_at(of, age).nth(1).is_some());
        let first = (0..keyed.keys()).find(stands)?;
        let last = (first..keyed.keys()).take_while(stands).last()?;
        let ages = (first..=last).filter_map(|key| keyed.age(key));
        let radii = ages.flat_map(|age| keyed.life.line_at(of, age).map(|(_, place)| place[3]));
        let mut polygon = corners_of_area(sides_within(radii.fold(0.0, f32::max), tolerance));
        let bark = keyed.bark(of.order);
        if bark.is_some() {
            polygon.extend(polygon.first().copied());
        }
        let base = keyed.life.points[of.points.clone()].first().map_or(u32::MAX, |point| point.component);
        let mut tube = Self { line, polygon, bark, keys: first..last + 1, ups: Vec::new(), first: base };
        let mut rings = Vec::new();
        let mut up = Vec3::Y;
        for key in (first..=last).rev() {
            tube.rings(keyed, key, &mut rings);
            let along = directions(&rings).first().copied().unwrap_or(Vec3::Z);
            up = across(up, along);
            tube.ups.insert(0, up);
        }
        Some(tube)
    }

    /// The vertices of a ring.
    fn corners(&self) -> usize {
        self.polygon.len()
    }

    /// The component that begins the line.
    pub fn first(&self) -> u32 {
        self.first
    }

    /// The number of its vertices.
    pub fn vertices(&self, keyed: &Keyed) -> usize {
        self.corners() * self.line_of(keyed).points.len()
    }

    /// The texture coordinates of its vertices, as the tube stands at its last key: whole repeats of the picture around
    /// it, and along it its own length. Bark keeps its place on the wood while that grows.
    pub fn textures(&self, keyed: &Keyed, rings: &mut Vec<Ring>) -> Vec<[f32; 2]> {
        let Some(bark) = self.bark else { return vec![[0.0; 2]; self.vertices(keyed)] };
        self.rings(keyed, self.keys.end - 1, rings);
        let apart = |pair: &[Ring]| {
            let way = [0, 1, 2].map(|k| f64::from(pair[1][k]) - f64::from(pair[0][k]));
            way.iter().map(|x| x * x).sum::<f64>().sqrt()
        };
        // The mean circumference, each part by its surface, as of bark at one age.
        let (mut surface, mut squares) = (0.0, 0.0);
        for pair in rings.windows(2) {
            let wide = f64::from(pair[0][3]) + f64::from(pair[1][3]);
            surface += wide * apart(pair);
            squares += wide * wide * apart(pair);
        }
        let mean = if surface > 0.0 { std::f64::consts::PI * squares / surface } else { 0.0 };
        let [around, long] = bark_covers(bark, mean);
        let (mut along, mut below, sides) = (0.0, None::<Ring>, (self.corners() - 1) as f32);
        let mut all = Vec::with_capacity(self.vertices(keyed));
        for ring in rings.iter() {
            along += below.map_or(0.0, |below| apart(&[below, *ring]));
            below = Some(*ring);
            all.extend((0..self.corners()).map(|k| [around * k as f32 / sides, along as f32 / long]));
        }
        all
    }

    fn line_of<'k>(&self, keyed: &'k Keyed) -> &'k Line {
        &keyed.life.lines[self.line]
    }

    /// The rings at a key.
    fn rings(&self, keyed: &Keyed, key: usize, rings: &mut Vec<Ring>) {
        rings.clear();
        let points = &keyed.life.points[self.line_of(keyed).points.clone()];
        let Some(age) = keyed.age(key).filter(|_| self.keys.contains(&key)) else {
            let near = key.clamp(self.keys.start.saturating_sub(1), self.keys.end.min(keyed.keys() - 1));
            let [x, y, z] = keyed.base(self.first, near);
            rings.resize(points.len(), [x, y, z, 0.0]);
            return;
        };
        let mut next = [0.0; 4];
        // From the tip down, since what does not stand is where the next point stands.
        for point in points.iter().rev() {
            let place = if point.stands(age) {
                between(keyed.life.places(point), age)
            } else if point.birth <= age && age < point.from {
                let [x, y, z] =
                    if point.end { keyed.origin(point.component, key) } else { keyed.base(point.component, key) };
                [x, y, z, f32::NAN]
            } else {
                next
            };
            next = place;
            rings.push(place);
        }
        rings.reverse();
        fill_radii(rings);
    }

    /// Calls `put` with each vertex at a key, ring by ring: its place and the normal of its side.
    pub fn skin(&self, keyed: &Keyed, key: usize, rings: &mut Vec<Ring>, put: &mut dyn FnMut(Vec3, Vec3)) {
        self.rings(keyed, key, rings);
        let near = key.clamp(self.keys.start, self.keys.end - 1);
        let mut up = self.ups[near - self.keys.start];
        for (ring, along) in rings.iter().zip(directions(rings)) {
            up = across(up, along);
            let side = along.cross(up);
            let middle = Vec3::new(ring[0], ring[1], ring[2]);
            for [cos, sin] in &self.polygon {
                let radial = up * *cos + side * *sin;
                // Normals are made unit vectors where they are written.
                put(middle + radial * ring[3], radial);
            }
        }
    }

    /// What a vertex has of the internode that begins at its ring.
    pub fn tag(&self, keyed: &Keyed, vertex: usize) -> Tag {
        let points = &keyed.life.points[self.line_of(keyed).points.clone()];
        let Some(point) = points.get(vertex / self.corners()) else { return NO_TAG };
        let tints = keyed.life.tints_of_point(point).last().map_or([0.0; 3], |(_, colour)| *colour);
        let [red, green, blue] = tints.map(|channel| channel.round().clamp(0.0, 255.0) as u8);
        Tag {
            colour: [red, green, blue, u8::MAX],
            birth: point.birth,
            death: point.death,
            component: i32::try_from(point.component).unwrap_or(i32::MAX),
            kind: point.kind as u8,
        }
    }

    /// Its triangles, by the indices of its own vertices.
    pub fn faces(&self, keyed: &Keyed, out: &mut Vec<[u32; 3]>) {
        out.clear();
        let (n, rings) = (self.corners() as u32, self.line_of(keyed).points.len() as u32);
        let sides = n - u32::from(self.bark.is_some());
        for low in (0..rings.saturating_sub(1)).map(|ring| ring * n) {
            for k in 0..sides {
                let [a, b] = [low + k, low + (k + 1) % n];
                out.extend([[a, b, a + n], [b, b + n, a + n]]);
            }
        }
        let tip = rings.saturating_sub(1) * n;
        out.extend((1..sides - 1).map(|k| [tip, tip + k, tip + k + 1]));
    }
}

/// Gives each ring without a radius one between those of its neighbours, by the distance along the line.
fn fill_radii(rings: &mut [Ring]) {
    let distance = |a: Ring, b: Ring| (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f32>().sqrt();
    for place in 0..rings.len() {
        if !rings[place][3].is_nan() {
            continue;
        }
        let before = place.checked_sub(1).map(|before| rings[before]);
        let after = rings[place..].iter().find(|ring| !ring[3].is_nan()).copied();
        rings[place][3] = match (before, after) {
            (Some(before), Some(after)) => {
                let [to, on] = [distance(before, rings[place]), distance(rings[place], after)];
                let share = if to + on > 0.0 { to / (to + on) } else { 0.5 };
                before[3] + share * (after[3] - before[3])
            }
            (one, other) => one.or(other).map_or(0.0, |ring| ring[3]),
        };
    }
}

/// The direction of the line at each ring, the mean of those of its two neighbours at other places.
fn directions(rings: &[Ring]) -> Vec<Vec3> {
    let at = |k: usize| Vec3::new(rings[k][0], rings[k][1], rings[k][2]);
    let count = rings.len();
    let mut before = vec![Vec3::ZERO; count];
    for k in 1..count {
        before[k] = (at(k) - at(k - 1)).try_normalize().unwrap_or(before[k - 1]);
    }
    let mut after = vec![Vec3::ZERO; count];
    for k in (0..count.saturating_sub(1)).rev() {
        after[k] = (at(k + 1) - at(k)).try_normalize().unwrap_or(after[k + 1]);
    }
    let mean = |k: usize| (before[k] + after[k]).try_normalize().or_else(|| before[k].try_normalize());
    (0..count).map(|k| mean(k).unwrap_or(Vec3::Z)).collect()
}

/// The unit vector across a direction that is nearest to `up`.
fn across(up: Vec3, along: Vec3) -> Vec3 {
    (up - up.dot(along) * along).try_normalize().unwrap_or_else(|| along.any_orthonormal_vector())
}
