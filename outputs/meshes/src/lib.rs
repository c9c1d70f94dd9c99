//! Meshes of plants, for the ten readers of the profile (Blender, MeshLab, CloudCompare, Open3D, trimesh, PyVista,
//! meshio, plyfile, three.js, ply-rs-bw): a form for each component (de Reffye 1988 §6), in metres, Z up.
//!
//! A [`Scene`] is what stands of a plant at an age, told from the plant's seed: single precision then holds it wherever
//! the plant stands, and a comment of the file says where that is. A scene hands out vertices and triangles in chunks
//! of packed bytes, and a [`MeshWriter`] puts them into a file. A new format is one file and the line that names it
//! here; what a run and `phytomer mesh` write is chosen where they call it.
//! Vertices are not shared between components. Absent: buds, which have no form; curvature, which is the pose's.

mod chunk;
mod collection;
mod colour;
mod file;
mod forms;
#[cfg(test)]
mod measure;
mod outline;
mod palette;
mod plot;
mod ply;
mod scene;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_stated;
mod tube;

pub use chunk::{Chunk, Face, Sink, Tag, Vertex};
pub use collection::Collection;
pub use file::{MeshError, MeshFile, write_mesh};
pub use forms::own::{MeshFault, OwnForms, check as check_form};
pub use plot::{PlotBody, PlotMember, PlotMesh};
pub use ply::Ply;
pub use scene::{Counts, Scene};

use phytomer_looks::place_of_own;
use phytomer_sim::clock::Tick;
use phytomer_sim::plant::{Form, Kind, Plant};
use std::io::{self, Write};
use std::sync::Arc;

/// How plants are drawn.
#[derive(Debug, Clone)]
pub struct MeshOptions {
    /// The sides of an internode's tube, at least 3.
    pub sides: u8,
    /// Which kinds are drawn, by the numbers of [`Kind`].
    pub kinds: [bool; Kind::ALL.len()],
    /// The meshes of its own that the species names; empty where it names none.
    pub own: Arc<OwnForms>,
}

impl MeshOptions {
    /// The shape of a form.
    #[inline]
    pub(crate) fn shape(&self, form: Form) -> &forms::FormMesh {
        place_of_own(form).and_then(|place| self.own.shape(place)).unwrap_or_else(|| forms::shape(form))
    }
}

impl Default for MeshOptions {
    /// Eight sides, every kind.
    fn default() -> Self {
        Self { sides: 8, kinds: [true; Kind::ALL.len()], own: Arc::default() }
    }
}

/// What a file says of its mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct About {
    /// The plant's number in the run.
    pub plant: u32,
    /// Its age, in ticks since the seed.
    pub age: Tick,
    /// The seed of the run's draws.
    pub run_seed: u64,
    /// Where the plant's seed lies in the plot, metres: what is to be added to its vertices.
    pub place: [f64; 3],
}

/// A format of mesh files.
pub trait MeshWriter {
    /// The ending of its files' names, without the dot.
    fn extension(&self) -> &'static str;

    /// Writes a whole file; `scene` has at most 2³¹ − 1 vertices.
    ///
    /// # Errors
    /// Those of `out`.
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

/// The mesh of what stands of `plant` at `age`, whose frames and diameters must be those of that age: internodes in the
/// order of their nodes, then leaves, flowers and fruits in theirs.
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
