//! The plants of a picture, each told from its seed and put where it is to be seen, and the ways through their
//! triangles.
//!
//! Meshes are those of [`phytomer_meshes`], made block by block on whatever thread is free, looked at and thrown away:
//! a picture of ten million triangles needs no more memory than one of ten. What is left by them is sums of whole
//! numbers and maxima, so their order shows nowhere.

use super::camera::Camera;
use super::extent::Extent;
use super::film::{Film, Paint};
use super::gaze::Gaze;
use super::raster::{Window, turn};
use super::shade::Light;
use super::shadow::Shadow;
use super::sky::Crown;
use glam::Vec3;
use phytomer_looks::Paints;
use phytomer_meshes::{Mesh, MeshOptions, Scene, Tag, Vertex};
use phytomer_sim::Tick;
use phytomer_sim::plant::{Class, InternodeLook, Kind, Plant, Shape};
use rayon::prelude::*;

/// Where nothing is left of a plant, a picture shows the place where it stood, a metre high from its seed.
const EMPTY: Vec3 = Vec3::Z;

/// A plant at an age in a picture.
#[derive(Debug)]
pub struct PlacedPlant<'a> {
    scene: Scene<'a>,
    /// The colours of its components by their numbers, where they do not have their own.
    colours: Option<Vec<[u8; 3]>>,
    /// The boxes of its blocks; those of empty ones are inside out.
    boxes: Vec<[Vec3; 2]>,
    stuff: [Stuff; Kind::ALL.len()],
    /// From its seed to where it stands in the picture.
    pub offset: Vec3,
    /// Its place in the picture.
    pub number: u8,
}

/// A block of triangles before a camera.
struct Seen {
    mesh: Mesh,
    corners: Vec<Vec3>,
}

impl<'a> PlacedPlant<'a> {
    /// A plant as it stands at `age`.
    pub fn new(plant: &'a Plant, age: Tick, options: &MeshOptions, colours: Option<Vec<[u8; 3]>>, number: u8) -> Self {
        let scene = Scene::new(plant, age, options);
        let boxes = (0..scene.blocks()).into_par_iter().map_init(Mesh::default, |mesh, block| {
            scene.block(block, mesh);
            mesh.vertices
                .iter()
                .map(at)
                .fold([Vec3::INFINITY, Vec3::NEG_INFINITY], |[low, high], point| [low.min(point), high.max(point)])
        });
        let boxes = boxes.collect();
        Self { scene, colours, boxes, stuff: stuff(plant), offset: Vec3::ZERO, number }
    }

    /// The box around it as it grew, its foot within.
    pub fn bounds(&self) -> [Vec3; 2] {
        self.boxes.iter().fold([Vec3::ZERO; 2], |[low, high], [a, b]| [low.min(*a), high.max(*b)])
    }

    /// How wide it is along a direction, about: the boxes of its blocks are.
    pub fn width(&self, right: Vec3) -> f32 {
        let full = self.boxes.iter().filter(|[low, high]| low.x <= high.x);
        let ends = full.fold([0.0_f32; 2], |[least, most], [low, high]| {
            let (middle, half) = (0.5 * (*low + *high), 0.5 * (*high - *low));
            let (at, reach) = (middle.dot(right), half.dot(right.abs()));
            [least.min(at - reach), most.max(at + reach)]
        });
        ends[1] - ends[0]
    }

    /// How far it reaches as it grew, to be seen along a gaze within tangents; what lies below its foot counts where it
    /// is to be seen too.
    pub fn extent(&self, gaze: Gaze, tangents: [f32; 4], buried: bool) -> Extent {
        let lowest = if buried { f32::NEG_INFINITY } else { 0.0 };
        let empty = || Extent::new(gaze, tangents);
        let mut extent = self.each_block(
            |_| true,
            |mesh| {
                let mut extent = empty();
                mesh.vertices.iter().map(at).filter(|point| point.z >= lowest).for_each(|point| extent.add(point));
                extent
            },
            empty,
            |a, b| a.join(&b),
        );
        extent.add(Vec3::ZERO);
        if self.boxes.iter().all(|[low, high]| low.x > high.x) {
            extent.add(EMPTY);
        }
        extent
    }

    /// The light over it, the sun at an azimuth and an elevation.
    pub fn light(&self, sun: [f32; 2]) -> Light {
        let [low, high] = self.bounds();
        let (shadow, crown) = (Shadow::over(low, high, sun), Crown::over(low, high));
        self.each_block(
            |_| true,
            |mesh| {
                for face in &mesh.faces {
                    let vertices = face.indices().map(|index| &mesh.vertices[index as usize]);
                    let corners = vertices.map(at);
                    shadow.cast(&corners);
                    crown.add(&corners, self.stuff_of(&vertices[0].tag()).thin);
                }
            },
            || (),
            |(), ()| (),
        );
        Light { shadow, sky: crown.lighten() }
    }

    /// Leaves on the film what a camera sees of it in a window of samples, `fine` to a pixel each way.
    pub fn expose(&self, camera: &Camera, film: &Film, window: &Window, fine: f32, painting: bool) {
        let rows = [window.rows.start as f32, window.rows.end as f32];
        let in_rows =
            |block: usize| self.rows_of(block, camera, fine).is_some_and(|[a, b]| a <= rows[1] && b >= rows[0]);
        self.each_block(
            in_rows,
            |mesh| {
                let mut seen = Seen { mesh: std::mem::take(mesh), corners: Vec::new() };
                seen.project(camera, self.offset, fine);
                self.expose_block(&seen, film, window, painting);
                *mesh = seen.mesh;
            },
            || (),
            |(), ()| (),
        );
    }

    fn expose_block(&self, seen: &Seen, film: &Film, window: &Window, painting: bool) {
        for face in &seen.mesh.faces {
            let indices = face.indices().map(|index| index as usize);
            let corners = indices.map(|index| seen.corners[index]);
            let vertices = indices.map(|index| &seen.mesh.vertices[index]);
            let tag = vertices[0].tag();
            let Stuff { thin, closed } = self.stuff_of(&tag);
            // The far side of what is closed is never seen. Corners behind the eye are no numbers and compare as false.
            if closed && turn(&corners) > 0.0 {
                continue;
            }
            if painting {
                let normals = vertices.map(|vertex| Vec3::from_array(vertex.normal()));
                film.paint(&corners, &normals, &self.paint(&tag, thin), window);
            } else {
                film.deepen(&corners, window);
            }
        }
    }

    #[inline]
    fn stuff_of(&self, tag: &Tag) -> Stuff {
        self.stuff[usize::from(tag.kind) % Kind::ALL.len()]
    }

    fn paint(&self, tag: &Tag, thin: bool) -> Paint {
        let [r, g, b, _] = tag.colour;
        let component = tag.component.unsigned_abs();
        let colour = match &self.colours {
            Some(colours) => colours.get(component as usize).copied().unwrap_or([128; 3]),
            None if thin => varied([r, g, b], component),
            None => [r, g, b],
        };
        Paint { colour, thin, stained: self.colours.is_some(), subject: self.number }
    }

    /// The rows of samples that a block may reach; `None` for one that is empty.
    fn rows_of(&self, block: usize, camera: &Camera, fine: f32) -> Option<[f32; 2]> {
        let [low, high] = self.boxes[block];
        let mut rows = [f32::INFINITY, f32::NEG_INFINITY];
        if low.x > high.x {
            return None;
        }
        for corner in 0..8 {
            let side = |bit: usize| if corner >> bit & 1 == 0 { low } else { high };
            let seen = camera.project(Vec3::new(side(0).x, side(1).y, side(2).z) + self.offset)?;
            rows = [rows[0].min(seen.y * fine - 1.0), rows[1].max(seen.y * fine + 1.0)];
        }
        Some(rows)
    }

    /// Looks at every block that is wanted, on all threads, and joins what comes of it in any order.
    fn each_block<T: Send>(
        &self,
        wanted: impl Fn(usize) -> bool + Sync,
        look: impl Fn(&mut Mesh) -> T + Sync,
        none: impl Fn() -> T + Sync + Send,
        join: impl Fn(T, T) -> T + Sync + Send,
    ) -> T {
        let blocks = (0..self.boxes.len()).into_par_iter().filter(|block| wanted(*block));
        let looked = blocks.map_init(Mesh::default, |mesh, block| {
            self.scene.block(block, mesh);
            look(mesh)
        });
        looked.reduce(none, join)
    }
}

impl Seen {
    fn project(&mut self, camera: &Camera, offset: Vec3, fine: f32) {
        let place = |vertex: &Vertex| {
            let seen = camera.project(at(vertex) + offset).unwrap_or(Vec3::NAN);
            Vec3::new(seen.x * fine, seen.y * fine, seen.z)
        };
        self.corners.clear();
        self.corners.extend(self.mesh.vertices.iter().map(place));
    }
}

#[inline]
fn at(vertex: &Vertex) -> Vec3 {
    Vec3::from_array(vertex.position())
}

/// What the components of each kind are for light.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Stuff {
    /// Light comes through, and both sides are seen: leaves, flowers, internodes that are blades.
    thin: bool,
    /// Its far side is never seen: internodes that are tubes and nothing else.
    closed: bool,
}

/// The stuff of each kind of a plant.
fn stuff(plant: &Plant) -> [Stuff; Kind::ALL.len()] {
    let paints = Paints::of(&plant.habit);
    let looks = plant.habit.looks.internodes.iter().chain(&plant.habit.looks.apart);
    Kind::ALL.map(|kind| {
        let stem = kind.class() == Class::Internode;
        let look =
            |look: &&InternodeLook| look.kind == kind || (kind == Kind::ShortInternode && look.kind == Kind::Internode);
        let thin =
            if stem { looks.clone().filter(look).any(|look| look.shape == Shape::Blade) } else { is_leafy(kind) };
        let closed = stem
            && looks
                .clone()
                .filter(look)
                .all(|look| paints.internode(look.paint).form.is_none() && look.shape != Shape::Blade);
        Stuff { thin, closed }
    })
}

fn is_leafy(kind: Kind) -> bool {
    matches!(kind.class(), Class::Leaf | Class::Flower)
}

/// A colour made a little lighter or darker, warmer or cooler, as leaves differ; the same for a component at every age.
fn varied(colour: [u8; 3], component: u32) -> [u8; 3] {
    // Two bytes of a multiplicative hash (Knuth).
    let hash = component.wrapping_mul(2_654_435_761) >> 16;
    let (light, warm) = ((hash & 255) as f32 / 255.0 - 0.5, (hash >> 8 & 255) as f32 / 255.0 - 0.5);
    let scale = 1.0 + 0.16 * light;
    let tint = [0.10 * warm, 0.03 * warm, -0.08 * warm];
    [0, 1, 2].map(|k| (f32::from(colour[k]) * (scale + tint[k]) + 0.5).clamp(0.0, 255.0) as u8)
}
