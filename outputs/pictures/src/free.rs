//! From where an organ is seen freely: which of some organs, and from which of some directions, so that little of the
//! plant stands between it and the eye.
//!
//! Lines go from points spread over an organ to the eye. A triangle of another component that a line meets hides its
//! point (Möller & Trumbore 1997). The plant has the few polygons of detail 1 here. Absent: the camera (`camera`), and
//! light.

use glam::Vec3;
use phytomer_meshes::{Mesh, MeshOptions, Scene};
use phytomer_sim::plant::OrganId;
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
use std::sync::{Mutex, PoisonError};

/// The points of an organ from which lines go to the eye, at most the bits of a word.
const POINTS: usize = 48;
/// The distance of the eye over half the size of the organ: that of the field of view of pictures.
const DISTANCE: f32 = 4.4;
/// The share of its points that must be seen of an organ that is taken at once.
const ENOUGH: f32 = 0.92;
/// The angles by which the direction of view is turned away, degrees.
const AWAY: [f32; 2] = [28.0, 52.0];

/// The lowest direction, by its upward part.
const LOWEST: f32 = -0.35;

/// An organ as it is seen from one direction.
struct Sight {
    /// Its place among the organs.
    organ: usize,
    component: i32,
    from: Vec3,
    eye: Vec3,
    middle: Vec3,
    /// Half its size.
    half: f32,
    points: Vec<Vec3>,
    /// A bit for each point that is hidden.
    hidden: AtomicU64,
}

/// The share of the points of an organ of which, where fewer are seen from any side, what hides them is left out.
const HIDDEN: f32 = 0.7;

/// An organ that is seen as freely as there is one.
#[derive(Debug, Clone, PartialEq)]
pub struct Freest {
    /// The organ.
    pub organ: OrganId,
    /// The direction from which it is seen.
    pub from: Vec3,
    /// The numbers of the components that hide it, in their order; none where most of it is seen.
    pub hiding: Vec<u32>,
}

/// The first of some organs, the most wanted first, that is seen freely from its own direction or from one near it, and
/// that direction; else the one that is seen best. Where that is still hidden for a large part, as a bunch between the
/// stalks of a palm's leaves, it is seen from its own direction, and what hides it is told.
pub fn freest(scene: &Scene, organs: &[(OrganId, Vec3)]) -> Option<Freest> {
    let sights: Vec<Sight> =
        organs.iter().enumerate().flat_map(|(place, organ)| sights(scene, place, *organ)).collect();
    // The parts that may hide an organ are drawn at detail 1 at most: few polygons, but leaves have their stalks.
    let detail = scene.options().detail.min(1);
    let plain = Scene::new(scene.plant(), scene.age(), &MeshOptions { detail, ..scene.options().clone() });
    each_face(&plain, &|component, corners| {
        sights.iter().filter(|sight| sight.component != component).for_each(|sight| _ = sight.hide(corners));
    });
    let seen: Vec<f32> = sights.iter().map(Sight::seen).collect();
    let first = seen.iter().position(|seen| *seen >= ENOUGH);
    // Of equal ones the first.
    let best = (0..seen.len()).reduce(|a, b| if seen[b] > seen[a] { b } else { a });
    let mut found = first.or(best)?;
    let mut hiding = Vec::new();
    if seen[found] < HIDDEN {
        let organ = sights[found].organ;
        found = sights.iter().position(|sight| sight.organ == organ).unwrap_or(found);
        let sight = &sights[found];
        let before = Mutex::new(BTreeSet::new());
        each_face(&plain, &|component, corners| {
            if sight.component != component && sight.hide(corners) {
                before.lock().unwrap_or_else(PoisonError::into_inner).insert(component.unsigned_abs());
            }
        });
        hiding = before.into_inner().unwrap_or_else(PoisonError::into_inner).into_iter().collect();
    }
    Some(Freest { organ: organs[sights[found].organ].0, from: sights[found].from, hiding })
}

/// Calls a function with every triangle of a scene and the number of its component, on all threads.
fn each_face(scene: &Scene, take: &(dyn Fn(i32, &[Vec3; 3]) + Sync)) {
    (0..scene.blocks()).into_par_iter().for_each_init(Mesh::default, |mesh, block| {
        scene.block(block, mesh);
        for face in &mesh.faces {
            let vertices = face.indices().map(|index| &mesh.vertices[index as usize]);
            take(vertices[0].tag().component, &vertices.map(|vertex| Vec3::from_array(vertex.position())));
        }
    });
}

/// An organ from its own direction, and from others near it.
fn sights(scene: &Scene, place: usize, (organ, from): (OrganId, Vec3)) -> Vec<Sight> {
    let mesh = scene.mesh_of(organ);
    let step = (mesh.vertices.len() / POINTS).max(1);
    let all = mesh.vertices.iter().map(|vertex| Vec3::from_array(vertex.position()));
    let [low, high] = all.clone().fold([Vec3::INFINITY, Vec3::NEG_INFINITY], |[a, b], p| [a.min(p), b.max(p)]);
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low).length());
    let points: Vec<Vec3> = all.step_by(step).take(POINTS).collect();
    let component = scene.plant().organs.component[organ.index()] as i32;
    let sight = |from: Vec3| Sight {
        organ: place,
        component,
        from,
        eye: middle + DISTANCE * half * from,
        middle,
        half,
        points: points.clone(),
        hidden: AtomicU64::new(0),
    };
    let aside = from.cross(Vec3::Z).normalize_or(Vec3::X);
    let axes = [Vec3::Z, -Vec3::Z, aside, -aside];
    let turned = AWAY.iter().flat_map(|away| axes.map(|axis| turned(from, axis, *away)));
    // Views from far below are left out, unless the organ itself faces down.
    std::iter::once(from).chain(turned.filter(|from| from.z > LOWEST)).map(sight).collect()
}

/// A vector turned around an axis by an angle, degrees (Rodrigues).
fn turned(vector: Vec3, axis: Vec3, degrees: f32) -> Vec3 {
    let (sin, cos) = phytomer_sim::math::sincosf(degrees.to_radians());
    cos * vector + sin * axis.cross(vector) + (1.0 - cos) * axis.dot(vector) * axis
}

impl Sight {
    /// Hides the points whose lines to the eye meet a triangle; whether there are any.
    fn hide(&self, corners: &[Vec3; 3]) -> bool {
        let away = (corners[0] - self.middle).dot(self.from);
        let across = (corners[0] - self.middle - away * self.from).length();
        let size = (corners[1] - corners[0]).length().max((corners[2] - corners[0]).length());
        // All lines lie in the cylinder around the organ.
        if across - size > self.half || away + size < -self.half || away - size > DISTANCE * self.half {
            return false;
        }
        let mut hides = false;
        for (bit, point) in self.points.iter().enumerate() {
            if meets(*point, self.eye - *point, corners) {
                self.hidden.fetch_or(1 << bit, Relaxed);
                hides = true;
            }
        }
        hides
    }

    /// The share of its points that are seen.
    fn seen(&self) -> f32 {
        1.0 - self.hidden.load(Relaxed).count_ones() as f32 / self.points.len().max(1) as f32
    }
}

/// Whether the way from a point meets a triangle before its end, but not where it begins.
fn meets(from: Vec3, way: Vec3, [a, b, c]: &[Vec3; 3]) -> bool {
    let (ab, ac) = (*b - *a, *c - *a);
    let across = way.cross(ac);
    let det = ab.dot(across);
    let to = from - *a;
    let turned = to.cross(ab);
    let [u, v, t] = [to.dot(across), way.dot(turned), ac.dot(turned)].map(|x| x / det);
    // Without an area all three are NaN, and nothing is met.
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 1e-3 && t < 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_meets_what_lies_across_it_between_its_ends() {
        let triangle = |z: f32| [Vec3::new(-1.0, -1.0, z), Vec3::new(2.0, -1.0, z), Vec3::new(-1.0, 2.0, z)];
        let meets = |z: f32, way: Vec3| meets(Vec3::ZERO, way, &triangle(z));
        assert!(meets(0.5, Vec3::Z) && meets(0.99, Vec3::Z));
        assert!(!meets(1.5, Vec3::Z) && !meets(-0.5, Vec3::Z) && !meets(0.0, Vec3::Z), "beyond, behind, at its begin");
        assert!(!meets(0.5, Vec3::new(3.0, 3.0, 1.0)), "past it");
        assert!(!super::meets(Vec3::ZERO, Vec3::Z, &[Vec3::ONE; 3]), "no triangle");
    }
}
