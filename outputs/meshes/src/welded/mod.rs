//! Wood as one closed surface: each axis leaves its bearer through a hole in the bearer's skin, whose border both
//! share.
//!
//! The surface is a sphere by the way in which it hangs together, whatever lengths, radii and angles are: limbs
//! (`limbs`) have skins of rings (`course`, `outline`), some of which have holes (`bands`) where other limbs begin
//! (`foot`), and `skin` joins them. Where branches cross in space the surface goes through itself. A limb that stays
//! within its bearer is left out. Points that would have one place are moved apart by steps of a grid, so
//! that readers that merge points by their places find the same surface. The whole mesh of the wood is in memory, 49
//! bytes a vertex and 13 a triangle, with 200 bytes a station of its limbs while it is made. Absent: organs, and
//! internodes that are no tubes, which are drawn by themselves as ever.

mod bands;
mod collar;
mod course;
mod flare;
mod foot;
mod fork;
mod limbs;
mod outline;
mod points;
mod skin;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_feet;

use super::chunk::{Face, Vertex};
use super::dress::bark_covers;
use super::reduced::chain::Sample;
use super::reduced::{sides, simplify::simplify};
use super::stem::Stems;
use super::{Counts, Tolerance};
use course::{Course, Station};
pub(super) use flare::{corners_of, most_of_trunk, shares};
use foot::{Foot, Out};
use fork::Fork;
use glam::{DVec3, Vec3};
use limbs::{Limbs, Outlines};
use outline::Outline;
use phytomer_sim::plant::NodeId;
use points::{normals, part};
use skin::Skin;
use std::f32::consts::TAU;

/// How far from one another limbs leave their bearer of which one may run along in the other, in radii.
const NEIGHBOURS: f64 = 6.0;
/// How often a limb is sought in others.
const MOST_LEFT: usize = 8;

/// The welded wood of a plant at an age.
#[derive(Debug, Default)]
pub struct Welded {
    /// Its vertices.
    pub vertices: Vec<Vertex>,
    /// Its triangles.
    pub faces: Vec<Face>,
    /// The internodes that are drawn by themselves.
    pub apart: Vec<NodeId>,
    /// The number of internodes in the surface.
    internodes: u64,
}

/// The limbs of a plant with their courses and feet.
struct Stand<'s> {
    stems: &'s Stems<'s>,
    outlines: Outlines,
    limbs: Limbs,
    courses: Vec<Option<Course>>,
    feet: Vec<Vec<Foot>>,
    /// For each limb those that it bears, and the lengths along it near which they begin, metres.
    borne: Vec<Vec<(u32, f64)>>,
    /// For each node the limb in whose skin it is, and the length along that limb at its base and its tip, metres.
    places: Vec<(u32, [f32; 2])>,
    /// For each limb the one that bears it, and the length along that one near which it begins, metres; none of those
    /// on the ground.
    bearers: Vec<Option<(usize, f64)>>,
    /// For each limb the forks along it.
    forks: Vec<Vec<Fork>>,
    /// The length along the trunk at which its flare ends, metres.
    flare_ends: f64,
}

impl Welded {
    /// The wood of `stems`, within a tolerance where one is stated.
    pub fn of(stems: &Stems, tolerance: Option<&Tolerance>) -> Self {
        let mut stand = Stand::of(stems);
        stand.grow(tolerance);
        stand.welded()
    }

    /// The flare around the foot of a trunk beside open wood; `None` where there is none. It ends within the trunk.
    pub fn flare(stems: &Stems, tolerance: Option<&Tolerance>) -> Option<Self> {
        stems.flare.as_ref()?;
        let mut stand = Stand::of(stems);
        (stand.limbs.len() > 0).then_some(())?;
        let mut skin = Skin::of(stand.limbs.len(), stems.bark.is_some());
        stand.courses.resize_with(stand.limbs.len(), || None);
        let mut course = stand.course(0, tolerance);
        let foot = course.stations().iter().filter(|station| station.z <= stand.flare_ends);
        let mut foot: Vec<Station> = foot.copied().collect();
        if foot.len() < 2 {
            return None;
        }
        foot.extend(foot.last().map(|last| flare::within(last, &course)));
        course = Course::through(foot, false);
        let up = stems.frustum(stand.limbs.limb(0).0[0]).up;
        course.turn(DVec3::from_array(up.map(f64::from)));
        skin.add(0, &course, &bands::rows(&course, &mut []), &[], &stand.outlines.list);
        stand.courses[0] = Some(course);
        let mut flare = Self::default();
        let ends = vec![skin.points.len(); stand.limbs.len()];
        stand.write(&skin, &ends, &normals(&skin), &mut flare.vertices);
        flare.faces = skin.faces.iter().map(|face| Face::new(*face)).collect();
        Some(flare)
    }

    /// The same with what another one has.
    pub fn with(mut self, other: Self) -> Self {
        let first = self.vertices.len() as u32;
        self.vertices.extend(other.vertices);
        self.faces.extend(other.faces.iter().map(|face| Face::new(face.indices().map(|corner| corner + first))));
        self
    }

    /// Collars around the feet of the limbs, for wood that is drawn by itself.
    pub fn collars(stems: &Stems) -> Self {
        let mut stand = Stand::of(stems);
        stand.grow(None);
        let mut skin = Skin::of(0, stems.bark.is_some());
        let mut found: Vec<Option<(usize, &Foot)>> = vec![None; stand.limbs.len()];
        for (bearer, feet) in stand.feet.iter().enumerate() {
            feet.iter().for_each(|foot| found[foot.limb as usize] = Some((bearer, foot)));
        }
        let mut ends = Vec::with_capacity(stand.limbs.len());
        for (limb, found) in found.into_iter().enumerate() {
            let course = stand.courses.get(limb).and_then(Option::as_ref);
            let below = found.and_then(|(bearer, foot)| Some((stand.courses[bearer].as_ref()?, foot)));
            if let (Some(course), Some(on)) = (course, below) {
                collar::add(&mut skin, on, course, &stand.outlines.list);
            }
            if let (Some(course), Some(forks)) = (course, stand.forks.get(limb)) {
                let seen = forks.iter().filter(|fork| fork.z > course.ends()[0]);
                seen.for_each(|fork| fork::skirt(&mut skin, fork, course, &stand.outlines.list));
            }
            ends.push(skin.points.len());
        }
        let mut collars = Self::default();
        stand.write(&skin, &ends, &normals(&skin), &mut collars.vertices);
        collars.faces = skin.faces.iter().map(|face| Face::new(*face)).collect();
        collars
    }

    /// The size of the surface.
    pub fn counts(&self) -> Counts {
        Counts { components: self.internodes, vertices: self.vertices.len() as u64, faces: self.faces.len() as u64 }
    }
}

impl<'s> Stand<'s> {
    fn of(stems: &'s Stems<'s>) -> Self {
        let outlines = Outlines::of(stems);
        let limbs = Limbs::of(stems, &outlines);
        let places = vec![(u32::MAX, [0.0; 2]); stems.plant.nodes.len()];
        let (feet, borne, bearers) =
            (vec![Vec::new(); limbs.len()], vec![Vec::new(); limbs.len()], vec![None; limbs.len()]);
        Self {
            stems,
            outlines,
            courses: Vec::with_capacity(limbs.len()),
            limbs,
            feet,
            borne,
            places,
            bearers,
            forks: Vec::new(),
            flare_ends: 0.0,
        }
    }

    /// Finds the course of each limb and where it stands on its bearer.
    fn grow(&mut self, tolerance: Option<&Tolerance>) {
        for limb in 0..self.limbs.len() {
            let mut course = self.course(limb, tolerance);
            let (nodes, bearer) = self.limbs.limb(limb);
            let first = self.stems.frustum(nodes[0]);
            let up = DVec3::from_array(first.up.map(f64::from));
            let borne = bearer.map(|bearer| self.on(bearer, first.base)).or((limb > 0).then_some((0, 0.0)));
            let Some((on, near)) = borne else {
                course.turn(up);
                self.courses.push(Some(course));
                continue;
            };
            let (bearer, at) = (on, near);
            let (on, near, out) = self.leaves((on, near), &course);
            let Some(out) = out else {
                for node in self.limbs.limb(limb).0 {
                    self.places[node.index()] = (on as u32, [near as f32; 2]);
                }
                self.courses.push(None);
                continue;
            };
            let (Some(below), list) = (&self.courses[on], &self.outlines.list) else { continue };
            let foot = Foot::of(limb as u32, below, out, &course, list);
            let up = if course.is_turned() { up } else { foot.up(below, &course, list) };
            course.begin(foot.begins);
            course.turn(up);
            self.bearers[limb] = Some((bearer, at));
            self.feet[on].push(foot);
            self.borne[bearer].push((limb as u32, at));
            self.courses.push(Some(course));
        }
    }

    /// The limb out of which another one comes last, a length along it near by, and where it comes out; nothing where
    /// it stays within. Mostly that is the bearer; it is another limb where this one runs along in it for a while
    /// after both have left the bearer near one another.
    fn leaves(&self, (bearer, near): (usize, f64), own: &Course) -> (usize, f64, Option<Out>) {
        let Some(below) = &self.courses[bearer] else { return (bearer, near, None) };
        let mut found = (bearer, near, Out::of(below, near, own, own.ends()[0]));
        let reach = NEIGHBOURS * below.radius(near).max(own.radius(own.ends()[0]));
        let others = self.borne[bearer].iter().filter(|(_, at)| (at - near).abs() <= reach);
        let others: Vec<usize> = others.map(|(other, _)| *other as usize).collect();
        let mut left = MOST_LEFT;
        while let Some(out) = found.2.filter(|_| left > 0) {
            left -= 1;
            let next = others.iter().filter(|other| **other != found.0).find_map(|&other| {
                let course = self.courses[other].as_ref()?;
                let within = Out::within(course, own, out.own)?;
                let out = Out::of(course, course.ends()[0], own, within);
                Some((other, out.map_or(course.ends()[0], |out| out.bearer), out))
            });
            match next {
                Some(next) => found = next,
                None => break,
            }
        }
        found
    }

    /// The limb in whose skin an internode is, and the length along it that is nearest to a place beside the internode.
    fn on(&self, node: NodeId, place: [f32; 3]) -> (usize, f64) {
        let (limb, [low, high]) = self.places[node.index()];
        let of = self.stems.frustum(node);
        let along: f32 = (0..3).map(|k| (place[k] - of.base[k]) * of.heading[k]).sum();
        let share = if of.length > 0.0 { (along / of.length).clamp(0.0, 1.0) } else { 1.0 };
        (limb as usize, f64::from(low + share * (high - low)))
    }

    /// The course of a limb, from the base of its first internode on.
    fn course(&mut self, limb: usize, tolerance: Option<&Tolerance>) -> Course {
        let mut stations: Vec<Station> = Vec::new();
        let (nodes, _) = self.limbs.limb(limb);
        let mut is_turned = false;
        for &node in nodes {
            let (frustum, skin) = (self.stems.frustum(node), self.outlines.skin(self.stems, node));
            let outline = match skin {
                Some(limbs::Skin::Section(place)) => {
                    is_turned = true;
                    place as u32
                }
                Some(limbs::Skin::Tube(sides, _)) => self.outlines.regular(sides),
                None => self.outlines.regular(3),
            };
            let [base, heading] = [frustum.base, frustum.heading].map(|v| DVec3::from_array(v.map(f64::from)));
            let [low, high] = frustum.radii.map(f64::from);
            let length = f64::from(frustum.length);
            let low_z = put(&mut stations, Station::new(0.0, base, low, outline, node));
            if let Some(limbs::Skin::Section(place)) = skin
                && let Some(section) = self.stems.sections().nth(place)
            {
                for &[share, bulge] in section.rings() {
                    let (share, bulge) = (f64::from(share), f64::from(bulge));
                    let radius = (low + share * (high - low) + bulge * length).max(0.0);
                    put(&mut stations, Station::new(0.0, base + heading * (share * length), radius, outline, node));
                }
            }
            let high_z = put(&mut stations, Station::new(0.0, base + heading * length, high, outline, node));
            self.places[node.index()] = (limb as u32, [low_z as f32, high_z as f32]);
        }
        if stations.len() < 2 {
            // An internode without a length: a disc, which gets the least thickness.
            let only = stations[0];
            let at = only.at + DVec3::Z * f64::from(Tolerance::LEAST);
            let z = only.z + f64::from(Tolerance::LEAST);
            stations.push(Station::new(z, at, only.radius, only.outline, only.node));
        }
        let axis = |station: &Station| self.stems.plant.nodes.axis[station.node.index()];
        let (mut stations, forks) = fork::evened(stations, |below, above| axis(below) != axis(above));
        self.forks.resize_with(self.forks.len().max(limb + 1), Vec::new);
        self.forks[limb] = forks;
        let own = |node: &NodeId| matches!(self.outlines.skin(self.stems, *node), Some(limbs::Skin::Tube(_, true)));
        match tolerance {
            Some(tolerance) if !is_turned && !nodes.iter().any(own) => stations = self.kept(stations, tolerance),
            _ => {}
        }
        // The first limb is the trunk.
        if let Some(flare) = self.stems.flare.as_ref().filter(|_| limb == 0 && !is_turned) {
            (stations, self.flare_ends) = flare::flared(flare, stations, &mut self.outlines);
        }
        Course::through(stations, is_turned)
    }

    /// The stations that a tolerance asks for, each with as many sides as it asks for.
    fn kept(&mut self, stations: Vec<Station>, tolerance: &Tolerance) -> Vec<Station> {
        let sample = |(k, station): (usize, &Station)| {
            let next = stations.get(k + 1).map_or(DVec3::ZERO, |next| next.at - station.at);
            Sample {
                at: station.at.as_vec3(),
                radius: station.radius as f32,
                heading: next.as_vec3().try_normalize().unwrap_or(Vec3::ZERO),
                node: station.node,
                end: k + 1 == stations.len(),
                colour: self.stems.colour(station.node),
            }
        };
        let samples: Vec<Sample> = stations.iter().enumerate().map(sample).collect();
        let mut kept = Vec::new();
        simplify(&samples, tolerance, &mut kept);
        let mut found: Vec<Station> = kept.into_iter().map(|k| stations[k as usize]).collect();
        for station in &mut found {
            station.outline = self.outlines.regular(sides(station.radius as f32, tolerance.distance));
        }
        found
    }

    fn welded(mut self) -> Welded {
        let seams = self.stems.bark.is_some();
        let mut skin = Skin::of(self.limbs.len(), seams);
        let mut welded = Welded { apart: std::mem::take(&mut self.limbs.apart), ..Welded::default() };
        let mut points = Vec::new();
        for limb in 0..self.limbs.len() {
            let (nodes, _) = self.limbs.limb(limb);
            welded.internodes += nodes.len() as u64;
            if let Some(course) = &self.courses[limb] {
                let rows = bands::rows(course, &mut self.feet[limb]);
                skin.add(limb, course, &rows, &self.feet[limb], &self.outlines.list);
            }
            points.push(skin.points.len());
        }
        part(&mut skin);
        let normals = normals(&skin);
        self.write(&skin, &points, &normals, &mut welded.vertices);
        welded.faces = skin.faces.iter().map(|face| Face::new(*face)).collect();
        welded
    }

    /// For each limb how often a texture goes around it, the metres that it covers along it, and how often it stands
    /// below where the length along the limb counts from: it goes on from the bearer. Once a metre, and once around,
    /// where no bark is asked for.
    fn textures(&self) -> Vec<([f32; 2], f64)> {
        let mut all: Vec<([f32; 2], f64)> = Vec::with_capacity(self.limbs.len());
        for (limb, bearer) in self.bearers.iter().enumerate() {
            let size =
                self.stems.bark.as_ref().and_then(|bark| bark.size(self.stems.plant, self.limbs.limb(limb).0[0]));
            let around = self.courses[limb].as_ref().map_or(0.0, Course::circumference);
            let below = bearer.map_or(0.0, |(bearer, at)| {
                let ([_, over], below) = all[bearer];
                below + at / f64::from(over)
            });
            all.push((size.map_or([1.0; 2], |size| bark_covers(size, around)), below));
        }
        all
    }

    /// The vertices of the points; `ends` has the number of points up to the end of each limb.
    fn write(&self, skin: &Skin, ends: &[usize], normals: &[Vec3], out: &mut Vec<Vertex>) {
        out.reserve_exact(skin.points.len());
        let (mut last, mut tag) = (NodeId::NONE, None);
        let mut first = 0;
        for (&end, ([times, over], below)) in ends.iter().zip(self.textures()) {
            for point in &skin.points[first..end] {
                let tag = match &tag {
                    Some(tag) if point.node == last => tag,
                    _ => tag.insert(self.stems.tag(point.node)),
                };
                last = point.node;
                let one = point.one as usize;
                let texture = [point.angle / TAU * times, below as f32 + point.z / over];
                out.push(Vertex::new(skin.points[one].at, normals[one].to_array(), texture, tag));
            }
            first = end;
        }
    }
}

/// Adds a station where the last one is not the same, and returns its length along the limb.
fn put(stations: &mut Vec<Station>, mut station: Station) -> f64 {
    if let Some(last) = stations.last_mut() {
        let apart = (station.at - last.at).length();
        let [near, alike] = [1e-6 + 1e-3 * station.radius.min(last.radius), 1e-3 * station.radius.max(last.radius)];
        if apart <= near && (station.radius - last.radius).abs() <= alike && station.outline == last.outline {
            last.node = station.node;
            return last.z;
        }
        // Where only the radius steps, both rings are at one place: a rounding has no direction.
        (station.at, station.z) = if apart <= near { (last.at, last.z) } else { (station.at, last.z + apart) };
    }
    stations.push(station);
    station.z
}
