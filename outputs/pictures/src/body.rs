//! A plant, or an obstacle, of a picture at all its places: its blocks of triangles, the boxes around them, what light
//! does to its parts, and how its triangles come onto the film.
//!
//! Blocks are made when they are used and dropped; those of a plant that stands at several places are made once and
//! kept, and so are those of an obstacle, and those of plants that are small near a camera. Absent: what stands
//! together (`placed`).

use super::camera::Camera;
use super::extent::corners;
use super::film::{Film, Paint};
use super::raster::{Window, turn};
use glam::Vec3;
use phytomer_looks::{Blade, Near, Paints, Section};
use phytomer_meshes::{Boxing, Mesh, MeshOptions, Scene, Tag, Tolerance, Vertex};
use phytomer_sim::Tick;
use phytomer_sim::plant::{Class, InternodeLook, Kind, Plant, Shape};
use rayon::prelude::*;
use std::sync::Arc;

/// A plant at an age, with the places where it stands; or an obstacle, whose meshes are all kept.
#[derive(Debug)]
pub struct Body<'a> {
    scene: Option<Scene<'a>>,
    /// The colours of its components by number; `None` for natural colours.
    colours: Option<Vec<[u8; 3]>>,
    /// The bounding boxes of its blocks; an empty block has its lower corner above its upper corner.
    pub boxes: Vec<[Vec3; 2]>,
    stuff: [Stuff; Kind::ALL.len()],
    /// How finely its organs are drawn near a camera, at most.
    detail: u8,
    /// Where it stands.
    pub places: Vec<Vec3>,
    /// The meshes of its blocks, where they are kept; else empty, and blocks are made when they are used.
    kept: Vec<Arc<Mesh>>,
    /// The numbers of components that are not drawn, in their order.
    left_out: Arc<[u32]>,
}

impl<'a> Body<'a> {
    /// A plant at `age`, at each of some places. Near a camera its organs have up to such a detail.
    pub fn new(
        (plant, age): (&'a Plant, Tick),
        (options, detail): (&MeshOptions, u8),
        colours: Option<Vec<[u8; 3]>>,
        places: Vec<Vec3>,
    ) -> Self {
        let keeps = places.len() > 1;
        Self { detail, ..Self::of(Scene::new(plant, age, options), colours, places, keeps) }
    }

    /// A scene at its places; whether its blocks are made once and kept.
    fn of(scene: Scene<'a>, colours: Option<Vec<[u8; 3]>>, places: Vec<Vec3>, keeps: bool) -> Self {
        let blocks = 0..if keeps { scene.blocks() } else { 0 };
        let kept = blocks.into_par_iter().map(|block| {
            let mut mesh = Mesh::default();
            scene.block(block, &mut mesh);
            Arc::new(mesh)
        });
        let (kept, blocks) = (kept.collect(), scene.blocks());
        let stuff = stuff(scene.plant(), scene.options().detail);
        let detail = scene.options().detail;
        let left_out = Arc::default();
        Self { scene: Some(scene), colours, boxes: Vec::new(), stuff, detail, places, kept, left_out }.boxed(blocks)
    }

    /// The same plant without some components, by their numbers in their order.
    pub fn without(mut self, left_out: Arc<[u32]>) -> Self {
        if !left_out.is_empty() {
            self.kept.iter_mut().for_each(|mesh| leave_out(&left_out, Arc::make_mut(mesh)));
        }
        Self { left_out, ..self }
    }

    /// An obstacle: a closed mesh in the coordinates of its stand.
    pub fn obstacle(mesh: &Arc<Mesh>) -> Self {
        let (kept, stuff) =
            (vec![Arc::clone(mesh)], [Stuff { thin: false, closed: true, even: false, pale: 0 }; Kind::ALL.len()]);
        let (places, left_out) = (vec![Vec3::ZERO], Arc::default());
        Self { scene: None, colours: None, boxes: Vec::new(), stuff, detail: 0, places, kept, left_out }.boxed(1)
    }

    /// With the bounding boxes of its blocks.
    fn boxed(mut self, blocks: usize) -> Self {
        let body = &self;
        let boxes = (0..blocks).into_par_iter().map_init(Boxing::default, |working, block| match &body.scene {
            Some(scene) if body.kept.is_empty() => scene.block_box(block, working),
            _ => around(body.kept.get(block).into_iter().flat_map(|mesh| &mesh.vertices).map(at)),
        });
        self.boxes = boxes.collect();
        self
    }

    /// The meshes that are kept: of an obstacle all.
    pub fn meshes(&self) -> &[Arc<Mesh>] {
        &self.kept
    }

    /// Whether it is an obstacle.
    pub fn is_obstacle(&self) -> bool {
        self.scene.is_none()
    }

    /// The same plant with its wood and its organs within half a pixel of a camera that sees its stand at `offset`;
    /// `None` for an obstacle. Its blocks are kept where there is `room` for its vertices, which they then take.
    pub fn near(&self, camera: &Camera, offset: Vec3, room: &mut u64) -> Option<Self> {
        let scene = self.scene.as_ref()?;
        let seen = self.placed_boxes().flat_map(corners).map(|corner| camera.scale_at(corner + offset));
        let most = seen.fold(f32::MIN_POSITIVE, f32::max);
        let (tolerance, detail) = (Some(Tolerance::of_a_picture(0.5 / most)), self.detail);
        let options = MeshOptions { tolerance, detail, ..scene.options().clone() };
        let near = Scene::new(scene.plant(), scene.age(), &options);
        let left = room.checked_sub(near.counts().vertices);
        *room = left.unwrap_or(*room);
        let near = Self::of(near, None, self.places.clone(), left.is_some() || self.places.len() > 1);
        Some(near.without(Arc::clone(&self.left_out)))
    }

    /// Whether single organs fill so much of the picture that light must not change from cell to cell on them: a plant
    /// from near with an organ in focus, with organs at detail 2, or with internodes that are blades, as petals.
    pub fn is_near(&self, focused: bool) -> bool {
        let scene = self.scene.as_ref().filter(|scene| scene.options().detail > 0);
        scene.is_some_and(|scene| {
            let blades = Kind::ALL.iter().zip(&self.stuff).any(|(kind, stuff)| stuff.thin && !is_leafy(*kind));
            focused || blades || scene.finest() > 1
        })
    }

    /// A block of it, made in `mesh` where it is not kept.
    pub fn block<'m>(&'m self, block: usize, mesh: &'m mut Mesh) -> &'m Mesh {
        if let Some(kept) = self.kept.get(block) {
            return kept;
        }
        if let Some(scene) = &self.scene {
            scene.block(block, mesh);
            if !self.left_out.is_empty() {
                leave_out(&self.left_out, mesh);
            }
        }
        mesh
    }

    /// Whether nothing of it is seen.
    pub fn is_empty(&self) -> bool {
        self.boxes.iter().all(|[low, high]| low.x > high.x)
    }

    /// The bounding boxes of its blocks that are not empty, at all its places.
    pub fn placed_boxes(&self) -> impl Iterator<Item = [Vec3; 2]> {
        let full = self.boxes.iter().filter(|[low, high]| low.x <= high.x);
        full.flat_map(|[low, high]| self.places.iter().map(|place| [*low + *place, *high + *place]))
    }

    /// The optical properties of a part.
    #[inline]
    pub fn stuff_of(&self, tag: &Tag) -> Stuff {
        self.stuff[usize::from(tag.kind) % Kind::ALL.len()]
    }

    /// Draws a block, of which the corners are given in samples, on the film.
    pub fn expose(&self, mesh: &Mesh, corners: &[Vec3], film: &Film, window: &Window, (subject, painting): (u8, bool)) {
        for face in &mesh.faces {
            let indices = face.indices().map(|index| index as usize);
            let corners = indices.map(|index| corners[index]);
            let vertices = indices.map(|index| &mesh.vertices[index]);
            let tag = vertices[0].tag();
            let Stuff { thin, closed, even, pale } = self.stuff_of(&tag);
            // The far side of a closed surface is never seen. Corners behind the eye are NaN, so the comparison is
            // false.
            if closed && turn(&corners) > 0.0 {
                continue;
            }
            if painting {
                film.paint(&corners, window, || {
                    let normals = vertices.map(|vertex| Vec3::from_array(vertex.normal()));
                    let mut paint = self.paint(&tag, (thin, even), subject);
                    if pale > 0 && !paint.stained && turn(&corners) > 0.0 {
                        paint.colour = paler(paint.colour, pale);
                    }
                    (normals, paint)
                });
            } else {
                film.deepen(&corners, window);
            }
        }
    }

    fn paint(&self, tag: &Tag, (thin, even): (bool, bool), subject: u8) -> Paint {
        let [r, g, b, _] = tag.colour;
        let component = tag.component.unsigned_abs();
        let colour = match &self.colours {
            Some(colours) => colours.get(component as usize).copied().unwrap_or([128; 3]),
            None if thin && !even => varied([r, g, b], component),
            None => [r, g, b],
        };
        Paint { colour, thin, stained: self.colours.is_some(), subject }
    }
}

/// Takes the triangles of some components out of a mesh.
fn leave_out(components: &[u32], mesh: &mut Mesh) {
    let Mesh { vertices, faces } = mesh;
    let number = |first: u32| vertices.get(first as usize).map_or(u32::MAX, |vertex| vertex.tag().component as u32);
    faces.retain(|face| components.binary_search(&number(face.indices()[0])).is_err());
}

/// The box around some points.
fn around(points: impl Iterator<Item = Vec3>) -> [Vec3; 2] {
    points.fold([Vec3::INFINITY, Vec3::NEG_INFINITY], |[low, high], point| [low.min(point), high.max(point)])
}

/// The place of a vertex.
#[inline]
pub fn at(vertex: &Vertex) -> Vec3 {
    Vec3::from_array(vertex.position())
}

/// The optical properties of the components of a kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stuff {
    /// Light passes through, and both sides are seen: leaves, flowers, internodes that are blades.
    pub thin: bool,
    /// The far side is never seen: internodes that are tubes and nothing else.
    pub closed: bool,
    /// Its components do not differ in colour: from near the pieces of a petal are one blade.
    pub even: bool,
    /// The share of a paler colour that its underside has, of 255; none at detail 0.
    pub pale: u8,
}

/// The optical properties of each kind of a plant.
fn stuff(plant: &Plant, detail: u8) -> [Stuff; Kind::ALL.len()] {
    let paints = Paints::of(&plant.habit);
    let solid = paints.sections().iter().all(Section::is_closed);
    let looks = plant.habit.looks.internodes.iter().chain(&plant.habit.looks.apart);
    Kind::ALL.map(|kind| {
        let stem = kind.class() == Class::Internode;
        let look =
            |look: &&InternodeLook| look.kind == kind || (kind == Kind::ShortInternode && look.kind == Kind::Internode);
        let thin =
            if stem { looks.clone().filter(look).any(|look| look.shape == Shape::Blade) } else { is_leafy(kind) };
        let closed = stem
            && solid
            && looks
                .clone()
                .filter(look)
                .all(|look| paints.internode(look.paint).form.is_none() && look.shape != Shape::Blade);
        Stuff {
            thin,
            closed,
            even: stem && detail > 0,
            pale: if detail > 0 && kind.class() == Class::Leaf { underside(plant, paints) } else { 0 },
        }
    })
}

/// How much paler the undersides of leaves are, of 255: as the first blade says that the species states, else a
/// quarter.
fn underside(plant: &Plant, paints: &Paints) -> u8 {
    let leaves = plant.habit.looks.organs.iter().map(|looks| paints.organ(looks.leaf.paint));
    let stated = leaves.filter_map(|paint| match paints.nears().get(usize::from(paint.near?)) {
        Some(Near::Blade(blade)) => Some(blade.pale),
        _ => None,
    });
    (255.0 * stated.into_iter().next().unwrap_or(Blade::default().pale)) as u8
}

/// A colour on the underside of a leaf.
fn paler(colour: [u8; 3], share: u8) -> [u8; 3] {
    const PALE: [u32; 3] = [206, 214, 192];
    let share = u32::from(share);
    [0, 1, 2].map(|k| ((u32::from(colour[k]) * (255 - share) + PALE[k] * share + 127) / 255) as u8)
}

fn is_leafy(kind: Kind) -> bool {
    matches!(kind.class(), Class::Leaf | Class::Flower)
}

/// A colour made a little lighter or darker, warmer or cooler, as leaves differ; constant for a component at every age.
fn varied(colour: [u8; 3], component: u32) -> [u8; 3] {
    // Two bytes of a multiplicative hash (Knuth).
    let hash = component.wrapping_mul(2_654_435_761) >> 16;
    let (light, warm) = ((hash & 255) as f32 / 255.0 - 0.5, (hash >> 8 & 255) as f32 / 255.0 - 0.5);
    let scale = 1.0 + 0.16 * light;
    let tint = [0.10 * warm, 0.03 * warm, -0.08 * warm];
    [0, 1, 2].map(|k| (f32::from(colour[k]) * (scale + tint[k]) + 0.5).clamp(0.0, 255.0) as u8)
}
