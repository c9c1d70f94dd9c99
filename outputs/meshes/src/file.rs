//! Mesh files of a run: `meshes/plant-00000_age-0010.ply`, one per plant and age.
//!
//! A file is written beside its final name as `….tmp`, synced and renamed, so that a name never stands for half a mesh.
//! Absent: the choice of plants and ages, and the journal of the run folder, which names the files.

use super::chunk::MOST_VERTICES;
use super::{Counts, MeshOptions, MeshWriter, Scene};
use phytomer_sim::clock::Tick;
use phytomer_sim::plant::Plant;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// The error of a mesh that was not written.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// The file system returned an error.
    #[error("cannot {doing} {}", path.display())]
    Io {
        /// What was tried.
        doing: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
    /// The mesh has more vertices than its format can index.
    #[error(
        "the mesh of plant {plant} at age {age} would have {vertices} vertices, and a mesh file holds at most {}: \
         choose fewer sides or kinds, or a larger tolerance",
        MOST_VERTICES
    )]
    TooLarge {
        /// The plant's number.
        plant: u32,
        /// Its age.
        age: Tick,
        /// The number of vertices.
        vertices: u64,
    },
}

/// A mesh file that was written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MeshFile {
    /// The path of the file.
    pub path: PathBuf,
    /// The number of the plant that is drawn.
    pub plant: u32,
    /// The age of the plant.
    pub age: Tick,
    /// The size of the mesh.
    pub counts: Counts,
    /// The size of the file, bytes.
    pub bytes: u64,
}

/// Writes the mesh of `plant` at `age` into `folder`, which must exist; a file of the same name is replaced.
///
/// # Errors
/// [`MeshError::TooLarge`] before anything is written, [`MeshError::Io`] where the file system refuses.
pub fn write_mesh(
    writer: &dyn MeshWriter,
    plant: &Plant,
    age: Tick,
    run_seed: u64,
    options: &MeshOptions,
    folder: &Path,
) -> Result<MeshFile, MeshError> {
    let scene = Scene::new(plant, age, options);
    let counts = scene.counts();
    if counts.vertices > MOST_VERTICES {
        return Err(MeshError::TooLarge { plant: plant.id, age, vertices: counts.vertices });
    }
    let name = format!("plant-{:05}_age-{age:04}.{}", plant.id, writer.extension());
    let path = folder.join(&name);
    let beside = folder.join(name + ".tmp");
    let bytes = (|| {
        let mut file = File::create(&beside)?;
        writer.write(&scene, &scene.about(run_seed), &mut file)?;
        file.sync_all()?;
        file.metadata().map(|metadata| metadata.len())
    })()
    .map_err(failed("write", &beside))?;
    fs::rename(&beside, &path).map_err(failed("rename", &beside))?;
    Ok(MeshFile { path, plant: plant.id, age, counts, bytes })
}

fn failed(doing: &'static str, path: &Path) -> impl FnOnce(io::Error) -> MeshError {
    let path = path.to_path_buf();
    move |source| MeshError::Io { doing, path, source }
}
