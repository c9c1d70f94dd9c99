//! The plants that stand together in a picture, at their places, with the obstacles among them, and the passes over
//! their triangles: a single plant, or all plants of a plot.
//!
//! Meshes are those of [`phytomer_meshes`], made block by block on any free thread, used and dropped: a picture of ten
//! million triangles needs no more memory than one of a million. A plant that stands at several places is made once and
//! kept, and so are a stand's first plants, up to half a million vertices.
//! Triangles only add to sums of whole numbers and to maxima, so their order has no effect. Absent: the plants and
//! obstacles one by one (`body`).

use super::body::{Body, at};
use super::camera::Camera;
use super::extent::{Extent, corners};
use super::film::Film;
use super::gaze::Gaze;
use super::raster::Window;
use super::shade::Light;
use super::shadow::Shadow;
use super::sky::Crown;
use glam::Vec3;
use phytomer_meshes::{Mesh, Vertex};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Arc;

/// The visible place of a plant of which nothing is left: one metre up from its seed.
const EMPTY: Vec3 = Vec3::Z;

/// Rounding of places, as a share of their distance from the origin: far more than single precision makes.
const ROUNDING: f32 = 1e-6;

/// The most vertices of a stand that are made once for a picture and kept; each is some 60 bytes with its triangles.
const ROOM: u64 = 1 << 19;

/// The number of places of one plant that a thread handles with one block.
const PLACES_AT_ONCE: usize = 16;

/// The plants that stand together, at their place in the picture.
#[derive(Debug)]
pub struct PlacedStand<'a> {
    bodies: Vec<Body<'a>>,
    /// How many of the bodies are plants; obstacles follow them.
    plants: usize,
    looks: Vec<Look>,
    /// The offset from their origin to their place in the picture.
    pub offset: Vec3,
    /// The index of the stand in the picture.
    pub number: u8,
}

/// A block of a body at some of its places: the unit of work of a thread.
#[derive(Debug, Clone)]
struct Look {
    body: usize,
    block: usize,
    places: Range<usize>,
}

/// The working memory of a thread.
#[derive(Default)]
struct Scratch {
    mesh: Mesh,
    corners: Vec<Vec3>,
}

/// How points are added to an extent.
struct Measured {
    /// What is held already.
    known: Extent,
    /// The point around which the viewer walks, if so.
    pivot: Option<Vec3>,
    /// The height below which points are not seen.
    lowest: f32,
}

impl Measured {
    #[inline]
    fn add(&self, extent: &mut Extent, point: Vec3) {
        match self.pivot {
            Some(pivot) => extent.sweep(point - pivot),
            None => extent.add(point),
        }
    }
}

impl<'a> PlacedStand<'a> {
    /// A stand of these plants and obstacles, with its index in the picture.
    pub fn new(mut bodies: Vec<Body<'a>>, obstacles: &[Arc<Mesh>], number: u8) -> Self {
        let (plants, mut looks) = (bodies.len(), Vec::new());
        bodies.extend(obstacles.iter().map(Body::obstacle));
        for (body, of) in bodies.iter().enumerate() {
            for block in 0..of.boxes.len() {
                let starts = (0..of.places.len()).step_by(PLACES_AT_ONCE);
                looks.extend(starts.map(|start| {
                    let places = start..(start + PLACES_AT_ONCE).min(of.places.len());
                    Look { body, block, places }
                }));
            }
        }
        Self { bodies, plants, looks, offset: Vec3::ZERO, number }
    }

    /// The same stand with its plants within half a pixel of a camera, in natural colours: trunks are round from near,
    /// and twigs and leaves have few faces from afar. Obstacles stay as they are.
    pub fn near(&self, camera: &Camera) -> Self {
        let (plants, obstacles) = self.bodies.split_at(self.plants);
        let mut room = ROOM;
        let plants = plants.iter().filter_map(|body| body.near(camera, self.offset, &mut room)).collect();
        let obstacles: Vec<Arc<Mesh>> = obstacles.iter().flat_map(|body| body.meshes().iter().cloned()).collect();
        Self { offset: self.offset, ..Self::new(plants, &obstacles, self.number) }
    }

    /// The places of its plants.
    fn places(&self) -> impl Iterator<Item = Vec3> {
        self.bodies[..self.plants].iter().flat_map(|body| body.places.iter().copied())
    }

    /// The middle of the places of its plants, in its own coordinates.
    pub fn middle(&self) -> Vec3 {
        let ends = self.places().map(|place| [place, place]).reduce(|[a, b], [c, d]| [a.min(c), b.max(d)]);
        ends.map_or(Vec3::ZERO, |[low, high]| 0.5 * (low + high))
    }

    /// The box around it, with the feet of its plants, in its own coordinates.
    pub fn bounds(&self) -> [Vec3; 2] {
        let feet = self.places().map(|place| [place; 2]);
        let boxes = feet.chain(self.bodies.iter().flat_map(Body::placed_boxes));
        boxes.reduce(|[low, high], [a, b]| [low.min(a), high.max(b)]).unwrap_or_default()
    }

    /// The box around the feet of its plants, in its own coordinates; `None` without plants.
    pub fn feet(&self) -> Option<[Vec3; 2]> {
        self.places().map(|place| [place; 2]).reduce(|[low, high], [a, b]| [low.min(a), high.max(b)])
    }

    /// Its width along a direction, about: from the boxes of its blocks.
    pub fn width(&self, right: Vec3) -> f32 {
        let feet = self.places().map(|place| [place; 2]);
        let boxes = feet.chain(self.bodies.iter().flat_map(Body::placed_boxes));
        let ends = boxes.map(|[low, high]| {
            let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
            let (at, reach) = (middle.dot(right), half.dot(right.abs()));
            [at - reach, at + reach]
        });
        ends.reduce(|[least, most], [a, b]| [least.min(a), most.max(b)]).map_or(0.0, |[least, most]| most - least)
    }

    /// Its extent in its own coordinates, for a gaze and the tangents of a frame. With `buried`, the parts below its
    /// foot count too.
    pub fn extent(&self, gaze: Gaze, tangents: [f32; 4], buried: bool) -> Extent {
        self.extent_beyond(&Extent::new(gaze, tangents), None, buried)
    }

    /// The extent of the points of `known` and its own. With a pivot its points count, relative to the pivot, at every
    /// place to which a turn around the vertical axis there brings them. The boxes of blocks tell which may count:
    /// first those that reach farthest are made, and then those that reach beyond what was found.
    pub fn extent_beyond(&self, known: &Extent, pivot: Option<Vec3>, buried: bool) -> Extent {
        let measured = Measured { known: *known, pivot, lowest: if buried { f32::NEG_INFINITY } else { 0.0 } };
        let outer = |look| self.outer(look, &measured).filter(|outer| !known.holds(outer)).map(|outer| (look, outer));
        let beyond: Vec<(&Look, Extent)> = self.looks.par_iter().filter_map(outer).collect();
        let mut extent = self.inner(&farthest(&beyond), &measured);
        let rest = beyond.iter().filter(|(_, outer)| !extent.holds(outer));
        let rest: Vec<&Look> = rest.map(|(look, _)| *look).collect();
        extent = extent.join(&self.inner(&rest, &measured));
        self.places().for_each(|place| measured.add(&mut extent, place));
        if self.bodies.iter().all(Body::is_empty) {
            measured.add(&mut extent, self.middle() + EMPTY);
        }
        extent
    }

    /// An extent that holds a block at its places, from its box; `None` for an empty one.
    fn outer(&self, look: &Look, measured: &Measured) -> Option<Extent> {
        let body = &self.bodies[look.body];
        let [low, high] = body.boxes[look.block];
        let slack = ROUNDING * low.abs().max(high.abs()).max_element();
        let mut outer = measured.known;
        for place in &body.places[look.places.clone()] {
            let slack = slack + ROUNDING * place.abs().max_element();
            corners([low - slack, high + slack]).for_each(|corner| measured.add(&mut outer, corner + *place));
        }
        (low.x <= high.x).then_some(outer)
    }

    /// The extent of some blocks at their places, from their vertices.
    fn inner(&self, looks: &[&Look], measured: &Measured) -> Extent {
        let one = |scratch: &mut Scratch, look: &&Look| {
            let mut extent = measured.known;
            let body = &self.bodies[look.body];
            let mesh = body.block(look.block, &mut scratch.mesh);
            for place in &body.places[look.places.clone()] {
                let points = mesh.vertices.iter().map(|vertex| at(vertex) + *place);
                let seen = points.filter(|point| point.z >= measured.lowest);
                seen.for_each(|point| measured.add(&mut extent, point));
            }
            extent
        };
        looks.par_iter().map_init(Scratch::default, one).reduce(|| measured.known, |a, b| a.join(&b))
    }

    /// The light over it, for a sun at an azimuth and an elevation, radians. Of an organ in focus the box that is seen
    /// is given: what stands beyond it throws no shadow, so that an organ within a crown is not dark, and shadows are
    /// as fine as the box allows. Where organs are large enough to show it the grid of the sky is smooth.
    pub fn light(&self, sun: [f32; 2], seen: Option<[Vec3; 2]>) -> Light {
        let [low, high] = self.bounds();
        let [near, far] = seen.unwrap_or([low, high]);
        let smooth = self.bodies.iter().any(|body| body.is_near(seen.is_some()));
        let (shadow, crown) = (Shadow::over(near, far, sun), Crown::over(low, high, smooth));
        self.each_look(
            |_| true,
            |look, scratch| {
                let body = &self.bodies[look.body];
                let mesh = body.block(look.block, &mut scratch.mesh);
                for (place, face) in
                    body.places[look.places.clone()].iter().flat_map(|p| mesh.faces.iter().map(move |f| (p, f)))
                {
                    let vertices = face.indices().map(|index| &mesh.vertices[index as usize]);
                    let corners = vertices.map(|vertex| at(vertex) + *place);
                    if seen.is_some_and(|seen| is_beyond(&corners, seen)) {
                        continue;
                    }
                    shadow.cast(&corners);
                    if body.is_obstacle() {
                        crown.add_obstacle(&corners);
                    } else {
                        crown.add(&corners, body.stuff_of(&vertices[0].tag()).thin);
                    }
                }
            },
            || (),
            |(), ()| (),
        );
        Light { shadow, sky: crown.lighten() }
    }

    /// Draws it on the film for a camera and a window of samples, `fine` samples per pixel each way. With `painting`
    /// this is the second pass, else the first.
    pub fn expose(&self, camera: &Camera, film: &Film, window: &Window, fine: f32, painting: bool) {
        let rows = [window.rows.start as f32, window.rows.end as f32];
        let in_rows = |look: &Look, place: Vec3| {
            let reached = self.reached(look, camera, place + self.offset);
            reached.is_some_and(|[a, b]| a.y * fine - 1.0 <= rows[1] && b.y * fine + 1.0 >= rows[0])
        };
        let places = |look: &Look| &self.bodies[look.body].places[look.places.clone()];
        self.each_look(
            |look| places(look).iter().any(|place| in_rows(look, *place)),
            |look, scratch| {
                let body = &self.bodies[look.body];
                let mesh = body.block(look.block, &mut scratch.mesh);
                for place in places(look).iter().filter(|place| in_rows(look, **place)) {
                    project(mesh, camera, *place + self.offset, fine, &mut scratch.corners);
                    body.expose(mesh, &scratch.corners, film, window, (self.number, painting));
                }
            },
            || (),
            |(), ()| (),
        );
    }

    /// The columns of a picture, pixels, that it may reach; `None` without anything to see.
    pub fn columns(&self, camera: &Camera) -> Option<[f32; 2]> {
        let of = |look: &Look| {
            let places = self.bodies[look.body].places[look.places.clone()].iter();
            let reached = places.filter_map(|place| self.reached(look, camera, *place + self.offset));
            reached.map(|[low, high]| [low.x - 1.0, high.x + 1.0]).reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])
        };
        self.looks.par_iter().filter_map(of).reduce_with(|[a, b], [c, d]| [a.min(c), b.max(d)])
    }

    /// The rectangle of the picture, pixels, that a block may reach at a place; `None` for an empty block.
    fn reached(&self, look: &Look, camera: &Camera, place: Vec3) -> Option<[Vec3; 2]> {
        let [low, high] = self.bodies[look.body].boxes[look.block];
        let mut reached = [Vec3::INFINITY, Vec3::NEG_INFINITY];
        if low.x > high.x {
            return None;
        }
        for corner in corners([low, high]) {
            // A block that the eye stands beside or in may reach anything, as around an organ in focus.
            let Some(seen) = camera.project(corner + place) else {
                return Some([Vec3::NEG_INFINITY, Vec3::INFINITY]);
            };
            reached = [reached[0].min(seen), reached[1].max(seen)];
        }
        Some(reached)
    }

    /// Calls a function with every selected block, on all threads, and joins the results in any order.
    fn each_look<T: Send>(
        &self,
        wanted: impl Fn(&Look) -> bool + Sync,
        look: impl Fn(&Look, &mut Scratch) -> T + Sync,
        none: impl Fn() -> T + Sync + Send,
        join: impl Fn(T, T) -> T + Sync + Send,
    ) -> T {
        let looks = self.looks.par_iter().filter(|look| wanted(look));
        looks.map_init(Scratch::default, |scratch, found| look(found, scratch)).reduce(none, join)
    }
}

/// Whether a triangle lies outside of a box.
fn is_beyond([a, b, c]: &[Vec3; 3], [low, high]: [Vec3; 2]) -> bool {
    let (least, most) = (a.min(*b).min(*c), a.max(*b).max(*c));
    most.cmplt(low).any() || least.cmpgt(high).any()
}

/// The blocks that may reach farthest, each measure of an extent by itself.
fn farthest<'l>(beyond: &[(&'l Look, Extent)]) -> Vec<&'l Look> {
    let measures: Vec<_> = beyond.iter().map(|(_, outer)| outer.measures()).collect();
    let most = |k: usize| (0..beyond.len()).max_by(|a, b| measures[*a][k].total_cmp(&measures[*b][k]));
    let mut found: Vec<usize> = (0..Extent::MEASURES).filter_map(most).collect();
    found.sort_unstable();
    found.dedup();
    found.into_iter().map(|place| beyond[place].0).collect()
}

/// The places in the picture, in samples, of the vertices of a block that is moved by `offset`.
fn project(mesh: &Mesh, camera: &Camera, offset: Vec3, fine: f32, corners: &mut Vec<Vec3>) {
    let place = |vertex: &Vertex| {
        let seen = camera.project(at(vertex) + offset).unwrap_or(Vec3::NAN);
        Vec3::new(seen.x * fine, seen.y * fine, seen.z)
    };
    corners.clear();
    corners.extend(mesh.vertices.iter().map(place));
}
