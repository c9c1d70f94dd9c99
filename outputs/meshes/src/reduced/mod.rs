//! Wood within a tolerance: tubes that run along the internodes of an axis, with as few rings as the tolerance allows.
//!
//! A tube is a list of rings, each at the base of an internode or at the tip of the last one; it has the age of birth
//! and death, the number, the kind and the colour of the internode that begins there. Neighbouring rings share their
//! vertices, the two ends are closed. A tube ends, and another begins, where its axis turns so sharply that a shared
//! ring would be off by more than the tolerance. The texture runs once along each internode (t counts internodes).
//! Internodes that are no plain tubes, or whose species states the number of their sides, are drawn as ever. The plan
//! takes 8 bytes a ring; vertices and triangles are made of it ring by ring. Absent: joints between axes.

pub mod chain;
pub mod ring;
pub mod simplify;
#[cfg(test)]
mod tests;

use super::chunk::{Face, Vertex};
use super::stem::Stems;
use super::tube::lean;
use super::{Counts, Keeping, Tolerance};
use chain::{Found, Sample, chains};
use glam::Vec3;
use phytomer_sim::plant::NodeId;
use ring::{Place, Polygon, close, join};
pub use ring::{corners_of_area, meeting, sides};
use simplify::simplify;
use std::io;
use std::ops::Range;

/// The number of rings of a block.
const BLOCK: usize = 256;

/// The part of the tolerance by which an internode may begin beside the tip of the internode before.
const GAP: f32 = 1.0 / 16.0;

/// How many rings before and after a ring are looked at for one at another place: where a radius steps, two rings are
/// at one place.
const BESIDE: usize = 2;

/// A function that takes a number of vertices and a function that writes them.
pub type Put<'p> = dyn FnMut(usize, &dyn Fn(&mut [Vertex])) -> io::Result<()> + 'p;

/// A ring of a tube.
#[derive(Debug, Clone, Copy)]
struct Ring {
    node: NodeId,
    sides: u16,
    /// Whether the ring is at the tip of its internode, not at its base.
    end: bool,
}

/// The tubes of a plant at an age.
#[derive(Debug, Default)]
pub struct Reduced {
    rings: Vec<Ring>,
    /// The first ring of each tube, and one past the last ring.
    tubes: Vec<u32>,
    /// The internodes that are drawn by themselves, axis by axis.
    apart: Vec<NodeId>,
    /// The number of internodes along which the tubes run.
    internodes: u64,
    /// The polygons by their number of sides; those that no ring has are empty.
    polygons: Vec<Polygon>,
    /// The tubes of each block.
    blocks: Vec<Range<usize>>,
}

/// Triangles of a tube that are written at once.
#[derive(Debug, Clone, Copy)]
pub enum Skin {
    /// Between two rings, by their first vertices and numbers of sides.
    Between([u32; 2], [u32; 2]),
    /// A cap; the flag tells the lower end.
    Cap([u32; 2], bool),
}

impl Skin {
    /// The number of its triangles.
    pub fn faces(&self) -> usize {
        match self {
            Self::Between([_, n], [_, m]) => (n + m) as usize,
            Self::Cap([_, n], _) => *n as usize - 2,
        }
    }

    /// Writes them; `out` must have as many places.
    pub fn write(&self, out: &mut [Face]) {
        match *self {
            Self::Between(low, high) => join(low, high, out),
            Self::Cap(ring, lower) => close(ring, lower, out),
        }
    }
}

impl Reduced {
    /// The tubes of these internodes within a tolerance.
    pub fn of(stems: &Stems, tolerance: &Tolerance) -> Self {
        let mut planner = Planner { tolerance: *tolerance, kept: Vec::new(), plan: Self::default() };
        chains(stems, tolerance.distance * GAP, &mut planner);
        let mut plan = planner.plan;
        plan.end_tube();
        plan.make_polygons(tolerance.keeps);
        plan.make_blocks();
        plan
    }

    /// The internodes that are drawn by themselves.
    pub fn apart(&self) -> &[NodeId] {
        &self.apart
    }

    /// The number of tubes.
    pub fn tubes(&self) -> usize {
        self.tubes.len() - 1
    }

    /// The tubes of each block of about equal work.
    pub fn blocks(&self) -> &[Range<usize>] {
        &self.blocks
    }

    /// The size of all tubes.
    pub fn counts(&self) -> Counts {
        let mut counts = Counts { components: self.internodes, ..Counts::default() };
        for tube in 0..self.tubes() {
            counts.vertices += self.vertices(tube);
            counts.faces += self.faces(tube);
        }
        counts
    }

    /// The number of vertices of a tube.
    pub fn vertices(&self, tube: usize) -> u64 {
        let rings = self.rings_of(tube);
        let sides: u64 = rings.iter().map(|ring| u64::from(ring.sides) + 1).sum();
        sides + ends(rings).map(|ring| u64::from(ring.sides)).iter().sum::<u64>()
    }

    fn faces(&self, tube: usize) -> u64 {
        let rings = self.rings_of(tube);
        let between = rings.windows(2).map(|pair| u64::from(pair[0].sides) + u64::from(pair[1].sides));
        between.sum::<u64>() + ends(rings).map(|ring| u64::from(ring.sides) - 2).iter().sum::<u64>()
    }

    fn rings_of(&self, tube: usize) -> &[Ring] {
        &self.rings[self.tubes[tube] as usize..self.tubes[tube + 1] as usize]
    }

    /// Calls `put` with each part of a tube, in the order of its vertices, with the number of its vertices and a
    /// function that writes them. `places` is working memory.
    ///
    /// # Errors
    /// Those of `put`.
    pub fn each_part(&self, stems: &Stems, tube: usize, places: &mut Vec<Place>, put: &mut Put) -> io::Result<()> {
        let rings = self.rings_of(tube);
        place(rings, stems, places);
        let polygon = |ring: &Ring| &self.polygons[usize::from(ring.sides)];
        for (ring, place) in rings.iter().zip(&*places) {
            let tag = stems.tag(ring.node);
            put(usize::from(ring.sides) + 1, &|out| {
                place.write_side(polygon(ring), &tag, out);
                if let Some(bark) = &stems.bark {
                    bark.dress_ring(stems.plant, ring.node, ring.end, out);
                }
            })?;
        }
        let both = ends(rings).into_iter().zip([places.first(), places.last()]).zip([-1.0, 1.0]);
        for ((ring, place), outward) in both {
            let Some(place) = place else { continue };
            let tag = stems.tag(ring.node);
            put(usize::from(ring.sides), &|out| place.write_cap(polygon(&ring), outward, &tag, out))?;
        }
        Ok(())
    }

    /// Calls `take` with the places of the corners of each ring of a tube but the first, and of the ring before it;
    /// the lists are working memory.
    pub fn each_piece(
        &self,
        stems: &Stems,
        tube: usize,
        (places, corners): (&mut Vec<Place>, &mut [Vec<Vec3>; 2]),
        take: &mut dyn FnMut([&[Vec3]; 2]),
    ) {
        let rings = self.rings_of(tube);
        place(rings, stems, places);
        for (number, (ring, place)) in rings.iter().zip(&*places).enumerate() {
            corners.swap(0, 1);
            place.corners(&self.polygons[usize::from(ring.sides)], &mut corners[1]);
            if number > 0 {
                take([&corners[0], &corners[1]]);
            }
        }
    }

    /// Calls `put` with all triangles of a tube; `first` is the index of its first vertex.
    ///
    /// # Errors
    /// Those of `put`.
    pub fn each_skin(&self, tube: usize, first: u32, put: &mut dyn FnMut(Skin) -> io::Result<()>) -> io::Result<()> {
        let rings = self.rings_of(tube);
        let mut low = first;
        for pair in rings.windows(2) {
            let [n, m] = [0, 1].map(|k| u32::from(pair[k].sides));
            put(Skin::Between([low, n], [low + n + 1, m]))?;
            low += n + 1;
        }
        let [lower, upper] = ends(rings).map(|ring| u32::from(ring.sides));
        let caps = low + upper + 1;
        put(Skin::Cap([caps, lower], true))?;
        put(Skin::Cap([caps + lower, upper], false))
    }

    fn end_tube(&mut self) {
        let end = self.rings.len() as u32;
        if self.tubes.last() != Some(&end) {
            self.tubes.push(end);
        }
    }

    fn make_polygons(&mut self, keeps: Keeping) {
        for ring in &self.rings {
            let sides = usize::from(ring.sides);
            if self.polygons.len() <= sides {
                self.polygons.resize(sides + 1, Polygon::default());
            }
            if self.polygons[sides].is_empty() {
                self.polygons[sides] = Polygon::of(ring.sides, keeps);
            }
        }
    }

    fn make_blocks(&mut self) {
        let mut start = 0;
        for tube in 0..self.tubes() {
            let rings = self.tubes[tube + 1] - self.tubes[start];
            if rings as usize >= BLOCK || tube + 1 == self.tubes() {
                self.blocks.push(start..tube + 1);
                start = tube + 1;
            }
        }
    }
}

/// The rings at both ends of a tube.
fn ends(rings: &[Ring]) -> [Ring; 2] {
    let none = Ring { node: NodeId::NONE, sides: 3, end: false };
    [rings.first(), rings.last()].map(|ring| ring.copied().unwrap_or(none))
}

/// Makes a plan out of chains.
struct Planner {
    tolerance: Tolerance,
    kept: Vec<u32>,
    plan: Reduced,
}

impl Found for Planner {
    fn chain(&mut self, samples: &[Sample], internodes: usize) {
        simplify(samples, &self.tolerance, &mut self.kept);
        self.plan.end_tube();
        self.plan.internodes += internodes as u64;
        let mut begun = None;
        for place in 0..self.kept.len() {
            let at = self.kept[place] as usize;
            if begun == Some(at) {
                continue;
            }
            if place > 0 && place + 1 < self.kept.len() && self.turns_sharply(samples, place) {
                begun = Some(self.split(samples, at));
            } else {
                self.ring(&samples[at]);
            }
        }
    }

    fn apart(&mut self, node: NodeId) {
        self.plan.apart.push(node);
    }

    fn asks_colours(&self) -> bool {
        self.tolerance.colour < u8::MAX
    }
}

impl Planner {
    fn ring(&mut self, sample: &Sample) {
        let sides = sides(sample.radius, self.tolerance.distance);
        self.plan.rings.push(Ring { node: sample.node, sides, end: sample.end });
    }

    /// Whether the tube turns so sharply at a kept sample that a ring between its two directions would be off by more
    /// than the tolerance.
    fn turns_sharply(&self, samples: &[Sample], place: usize) -> bool {
        let at = |place: &u32| samples[*place as usize].at;
        let here = &samples[self.kept[place] as usize];
        let apart = |other: &Vec3| *other != here.at;
        let before = self.kept[..place].iter().rev().take(BESIDE).map(at).find(apart);
        let after = self.kept[place + 1..].iter().take(BESIDE).map(at).find(apart);
        let (Some(before), Some(after)) = (before, after) else { return true };
        let turned = (here.at - before).normalize_or_zero().dot((after - here.at).normalize_or_zero());
        here.radius * (1.0 - turned) > self.tolerance.distance
    }

    /// Ends a tube at a sample with the internode that ends there, and begins the next with the internode that begins
    /// there; the sample with which it begins.
    fn split(&mut self, samples: &[Sample], at: usize) -> usize {
        let sample = &samples[at];
        // The sample before the base of an internode belongs to the internode that ends there.
        let ending = if sample.end { *sample } else { Sample { node: samples[at - 1].node, end: true, ..*sample } };
        let begins = at + usize::from(sample.end);
        self.ring(&ending);
        self.plan.end_tube();
        self.ring(&samples[begins]);
        begins
    }
}

/// Fills `places` with the place of each ring of a tube, turned from the first on without a twist. The rings at the
/// ends stand across their internodes, the others across the mean of the two directions.
fn place(rings: &[Ring], stems: &Stems, places: &mut Vec<Place>) {
    places.clear();
    let first_rank = rings.first().map_or(0, |ring| stems.plant.nodes.rank[ring.node.index()]);
    for ring in rings {
        let frustum = stems.frustum(ring.node);
        let along = Vec3::from_array(frustum.heading);
        let (distance, radius) = if ring.end { (frustum.length, frustum.radii[1]) } else { (0.0, frustum.radii[0]) };
        let below = stems.plant.nodes.rank[ring.node.index()].saturating_sub(first_rank) + u32::from(ring.end);
        places.push(Place {
            at: Vec3::from_array(frustum.base) + distance * along,
            along,
            up: Vec3::from_array(frustum.up),
            radius,
            lean: [1.0, 0.0],
            below: below as f32,
        });
    }
    turn(places);
}

fn turn(places: &mut [Place]) {
    let Some(last) = places.len().checked_sub(1) else { return };
    for k in 0..=last {
        let (before, after) = (distinct(places, k, true), distinct(places, k, false));
        let [from, to] = [before, after].map(|at| at.unwrap_or(places[k]));
        if before.is_some() && after.is_some() {
            let [low, high] = [(places[k].at - from.at), (to.at - places[k].at)].map(Vec3::normalize_or_zero);
            places[k].along = (low + high).try_normalize().unwrap_or(places[k].along);
        }
        places[k].lean =
            lean((places[k].at - from.at).length() + (to.at - places[k].at).length(), from.radius - to.radius);
        let up = if k == 0 { places[k].up } else { places[k - 1].up };
        let across = |up: Vec3| (up - up.dot(places[k].along) * places[k].along).try_normalize();
        places[k].up =
            across(up).or_else(|| across(places[k].up)).unwrap_or_else(|| places[k].along.any_orthonormal_vector());
    }
}

/// The nearest ring before or after another that is at another place.
fn distinct(places: &[Place], of: usize, before: bool) -> Option<Place> {
    let apart = |place: &&Place| place.at != places[of].at;
    if before {
        places[..of].iter().rev().take(BESIDE).find(apart).copied()
    } else {
        places[of + 1..].iter().take(BESIDE).find(apart).copied()
    }
}
