//! Meshes of plants, with a form for each component (de Reffye 1988 §6), in metres, Z up. The file profile suits ten
//! readers: Blender, MeshLab, CloudCompare, Open3D, trimesh, PyVista, meshio, plyfile, three.js, ply-rs-bw.
//!
//! A [`Scene`] is the standing part of a plant at an age, relative to the plant's seed: single precision then suffices
//! wherever the plant stands, and a comment of the file states the place. A scene gives vertices and triangles in
//! chunks of packed bytes, and a [`MeshWriter`] writes them to a file. Other formats are functions of a [`Drawing`],
//! one file each and one line here; which format is written is the caller's choice. Vertices are not shared between
//! components. Absent: buds, which have no form, and bending, which is part of the pose.

mod attributes;
mod bare;
mod blocks;
mod boxes;
mod budget;
mod cards;
mod chunk;
mod collection;
mod colour;
mod columns;
mod detail;
mod drawing;
mod drawn_organ;
mod dress;
mod file;
mod foot;
mod forms;
mod lamina;
#[cfg(test)]
mod measure;
mod model;
mod near;
mod node_leaves;
mod obj;
mod organ_base;
mod outline;
mod palette;
mod patched;
mod pictures;
mod plot;
mod ply;
pub mod range;
mod reduced;
mod scene;
mod section;
mod slots;
mod solid;
mod stem;
mod stem_near;
mod stl;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_range;
#[cfg(test)]
mod tests_stated;
mod texture;
mod thinned;
mod tube;
mod turned;
mod welded;
mod wood;

pub use bare::{Held, OrganBox, Room, TakePlaces};
pub use blocks::TakeAlone;
pub use boxes::Boxing;
pub use budget::{TooFew, fitting, nearest};
pub use cards::{Card, Cards};
pub use chunk::{Chunk, Counts, Face, Sink, Tag, Vertex};
pub use collection::Collection;
pub use colour::linear;
pub use columns::{Columns, UNTIL};
pub use detail::{Afar, Primitive, Seen};
pub use drawing::{Drawing, PlantDrawing, Take};
pub use drawn_organ::DrawnOrgan;
pub use dress::bark_covers;
pub use file::{MeshError, MeshFile, write_mesh};
pub use foot::Foot;
pub use forms::own::{MeshFault, OwnForms, check as check_form};
pub use forms::{Depth, FormMesh, Point as FormPoint};
pub use model::Model;
pub use near::{NearForm, Nears, SharedNears};
pub use obj::Obj;
pub use outline::OwnForm;
pub use patched::Patched;
pub use phytomer_looks::MOST_DETAIL;
pub use pictures::Pictures;
pub use plot::{PlotBody, PlotDrawing, PlotMember, PlotMesh};
pub use ply::Ply;
pub use reduced::chain::{Found, Sample, chains};
pub use reduced::simplify::{fits, simplify};
pub use reduced::{corners_of_area, meeting, sides as sides_within};
pub use scene::Scene;
pub use slots::{CLASSES, InTurn, Slot, Slots, Slotting, class_of, class_of_kind};
pub use solid::{Solid, Undrawn};
pub use stem::Stems;
pub use stl::write_stl;
pub use texture::{MOST_PICTURE_BYTES, MOST_PIXELS, Picture, PictureFault, Texture, Textures};
pub use thinned::{ClassSums, MOST_LARGER, Thinned, organ_class, organ_number};
pub use tube::Frustum;

pub use phytomer_looks::Flare;
use phytomer_looks::place_of_own;
use phytomer_sim::clock::Tick;
use phytomer_sim::gusts::Swing;
use phytomer_sim::plant::{Form, Kind, Plant};
use std::io::{self, Write};
use std::sync::Arc;

/// How near wood is drawn to its internodes, with as few triangles as that allows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// The distance, metres: internodes of an axis are drawn as one while the line of the axis and its radius stay
    /// within it, and a tube is as round as it asks. No point of the round tubes of the internodes is farther than
    /// twice this distance from the mesh.
    pub distance: f32,
    /// The share of its radius by which the radius of wood may be off, where that is less than the distance; infinite
    /// where the distance alone counts.
    pub share: f32,
    /// The most that colours differ, in each of three bytes, between internodes that are drawn as one.
    pub colour: u8,
    /// What the polygons around the wood keep of its circles.
    pub keeps: Keeping,
    /// Whether organs have fewer triangles too, where none of their corners moves farther than the distance.
    pub organs: bool,
}

/// What a polygon keeps of the circle that it is drawn for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Keeping {
    /// Its area, so that wood keeps its volume.
    Section,
    /// Its circumference, which is π times the mean width, so that thin wood is seen as wide as it is.
    Width,
    /// The circumference of the polygon of so many sides that keeps its area, so that wood is seen as wide as tubes of
    /// single internodes of as many sides are.
    Tube(u8),
}

impl Tolerance {
    /// The least distance, metres: a hundredth of a millimetre. Single precision holds the places of a plant of a
    /// hundred metres no better.
    pub const LEAST: f32 = 1e-5;

    /// The most by which a radius may be off, metres.
    #[inline]
    pub fn of_radius(&self, radius: f32) -> f32 {
        // Of no radius an infinite share is no number, and the distance counts.
        self.distance.min(self.share * radius)
    }

    /// Within a distance, metres, whatever the colours.
    pub fn of(distance: f32) -> Self {
        let distance = distance.max(Self::LEAST);
        Self { distance, share: f32::INFINITY, colour: u8::MAX, keeps: Keeping::Section, organs: false }
    }

    /// Within a distance, metres, for a picture: wood keeps its width, and a face has one colour, which is nearly that
    /// of all internodes along it. Organs are within it as well.
    pub fn of_a_picture(distance: f32) -> Self {
        Self { colour: 6, keeps: Keeping::Width, organs: true, ..Self::of(distance) }
    }
}

/// How internodes hang together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Joints {
    /// Each tube ends on its own, and those that meet go through one another.
    #[default]
    Open,
    /// As open, and the foot of each branch widens into its bearer.
    Collar,
    /// All wood is one closed surface, a sphere by the way in which it hangs together.
    Welded,
}

impl Joints {
    /// What a file says of them; nothing of open ones.
    pub fn in_words(self) -> Option<&'static str> {
        match self {
            Self::Open => None,
            Self::Collar => Some("joints collar: the foot of each branch widens into its bearer"),
            Self::Welded => Some("joints welded: the wood is one closed surface, t in metres from the ground"),
        }
    }
}

/// Options for drawing plants.
#[derive(Debug, Clone)]
pub struct MeshOptions {
    /// The number of sides of an internode's tube, at least 3.
    pub sides: u8,
    /// How near the wood is drawn; `None`: each internode by itself.
    pub tolerance: Option<Tolerance>,
    /// How internodes hang together.
    pub joints: Joints,
    /// For each kind, by the number of [`Kind`], whether it is drawn.
    pub kinds: [bool; Kind::ALL.len()],
    /// The mesh files that the species names as forms; empty where it names none.
    pub own: Arc<OwnForms>,
    /// What of a tree of stems is drawn.
    pub seen: Seen,
    /// How long a bark texture is on every stem, metres; `None`: as long as an internode, once around it.
    pub bark_m: Option<f32>,
    /// Whether leaf normals point out of the crown.
    pub crown_normals: bool,
    /// The colour of each component by its number, in place of that of its kind and its age.
    pub colours: Option<Arc<Vec<[u8; 3]>>>,
    /// How each axis sways, for vertices that tell it; `None`: they do not.
    pub swings: Option<Arc<Vec<Swing>>>,
    /// Whether vertices tell order, radius, path length and phase.
    pub attributes: bool,
    /// How finely organs are drawn, from 0, a few polygons, to [`phytomer_looks::MOST_DETAIL`].
    pub detail: u8,
    /// How many materials a mesh has.
    pub slotting: Slotting,
    /// The forms from near that plants with these options have met.
    pub nears: SharedNears,
    /// Which organs are drawn, each for others too; `None`: all.
    pub thinned: Option<Thinned>,
}

impl MeshOptions {
    /// The colour that is stated for a component.
    #[inline]
    fn colour_of(&self, component: u32) -> Option<[u8; 4]> {
        let [red, green, blue] = *self.colours.as_ref()?.get(component as usize)?;
        Some([red, green, blue, 255])
    }

    /// Writes an organ, with the tints of its parts from near over its colours, unless colours stand for values.
    fn write(&self, form: &FormMesh, place: &forms::Placement, tags: &[Tag; 2], out: &mut [Vertex]) {
        form.write(place, tags, out);
        if self.detail > 0 && self.colours.is_none() {
            form.tint(out);
        }
    }

    /// The shape of a form.
    #[inline]
    pub fn shape(&self, form: Form) -> &forms::FormMesh {
        place_of_own(form).and_then(|place| self.own.shape(place)).unwrap_or_else(|| forms::shape(form))
    }
}

impl Default for MeshOptions {
    /// Eight sides, every kind.
    fn default() -> Self {
        let kinds = [true; Kind::ALL.len()];
        Self {
            sides: 8,
            tolerance: None,
            joints: Joints::Open,
            kinds,
            own: Arc::default(),
            seen: Seen::default(),
            bark_m: None,
            crown_normals: false,
            colours: None,
            swings: None,
            attributes: false,
            detail: 0,
            slotting: Slotting::Kind,
            nears: SharedNears::default(),
            thinned: None,
        }
    }
}

/// The identity of a mesh, which its file states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct About {
    /// The plant's number in the run.
    pub plant: u32,
    /// The age that it shows, in ticks since the seed; between two ticks it has a fraction.
    pub age: f64,
    /// The seed of the run's random draws.
    pub run_seed: u64,
    /// The place of the plant's seed in the plot, metres. Added to the vertices, it gives their places in the plot.
    pub place: [f64; 3],
}

impl About {
    /// The plant, its age and its run.
    pub fn in_words(&self) -> String {
        format!("plant {} age {} seed {}", self.plant, self.age, self.run_seed)
    }
}

/// A format of mesh files.
pub trait MeshWriter {
    /// The ending of the format's file names, without the dot.
    fn extension(&self) -> &'static str;

    /// Writes a whole file; `scene` must have at most 2³¹ − 1 vertices.
    ///
    /// # Errors
    /// The errors of `out`.
    fn write(&self, scene: &Scene, about: &About, out: &mut (dyn Write + Send)) -> io::Result<()>;
}

/// A mesh in memory.
#[derive(Debug, Clone, Default)]
pub struct Mesh {
    /// Its vertices.
    pub vertices: Vec<Vertex>,
    /// Its triangles.
    pub faces: Vec<Face>,
}

/// The mesh of the standing components of `plant` at `age`, whose frames and diameters must be those of that age. First
/// come internodes in the order of their nodes, then leaves, flowers and fruits in the order of organs. Takes O(n) for
/// n components, and holds all vertices (49 bytes each) and triangles (13 bytes each) in memory.
pub fn mesh_plant(plant: &Plant, age: Tick, options: &MeshOptions) -> Mesh {
    let scene = Scene::new(plant, age, options);
    let mut mesh = Mesh::default();
    let vertices = scene.vertices(&mut Chunk::new(), &mut |chunk| {
        mesh.vertices.extend_from_slice(bytemuck::cast_slice(chunk.filled()));
        chunk.clear();
        Ok(())
    });
    let faces = scene.faces(&mut Chunk::new(), &mut |chunk| {
        mesh.faces.extend_from_slice(bytemuck::cast_slice(chunk.filled()));
        chunk.clear();
        Ok(())
    });
    debug_assert!(vertices.is_ok() && faces.is_ok(), "memory does not fail");
    mesh
}
