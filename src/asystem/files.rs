//! What a stage writes: the sheets and meshes of workstations, and the frames with their times. All files lie in one
//! folder, under the names of their workstations.

use super::drawn::add;
use super::stars::stars;
use super::stations::Station;
use super::trees::Tree;
use phytomer_asystem::WorkstationType;
use phytomer_outputs::meshes::{MeshOptions, PlotBody, PlotMember, PlotMesh};
use phytomer_outputs::pictures::{Compression, write_png};
use phytomer_outputs::{Destination, FileError};
use phytomer_sim::Tick;
use phytomer_sim::plant::Plant;
use phytomer_strokes::{Colour, Drawing, Sheet};
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The corners of a branch in a model where no girth states them.
const CORNERS: u32 = 8;

/// Why a script cannot go on.
#[derive(Debug, thiserror::Error)]
pub enum StageError {
    /// A tree cannot be grown.
    #[error("the tree `{0}` cannot be grown: {1}")]
    Tree(String, String),
    /// A file cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A file cannot be written to.
    #[error("cannot write {0}")]
    Write(PathBuf, #[source] io::Error),
}

/// A tree of a stage, grown to a tick.
pub struct Grown<'a> {
    /// Its name.
    pub name: &'a str,
    /// The tree.
    pub tree: &'a Tree,
    /// Its plant.
    pub plant: &'a Plant,
    /// The age of the plant.
    pub age: Tick,
}

/// The drawing of some trees.
pub fn drawing_of(all: &[Grown<'_>]) -> Drawing {
    let mut drawing = Drawing::default();
    all.iter().for_each(|grown| add(&mut drawing, grown.tree, (grown.plant, grown.age)));
    drawing
}

/// Writes the file of a workstation.
///
/// # Errors
/// Those of the file.
pub fn write(station: &Station, background: Colour, all: &[Grown<'_>], path: &Path) -> Result<(), StageError> {
    match station.kind {
        WorkstationType::Model => write_model(all, station.controllers, path),
        _ => {
            let drawing = drawing_of(all);
            write_sheet(station.kind, &station.sheet(background, &drawing), &drawing, path)
        }
    }
}

/// Writes a drawing as a sheet.
///
/// # Errors
/// Those of the file.
pub fn write_sheet(kind: WorkstationType, sheet: &Sheet, drawing: &Drawing, path: &Path) -> Result<(), StageError> {
    if kind == WorkstationType::Plotter {
        return put(path, |out| out.write_all(sheet.svg(drawing).as_bytes()));
    }
    let canvas = sheet.pixels(drawing);
    put(path, |out| write_png(&canvas, "phytomer asystem", Compression::High, out))
}

/// Writes trees as a mesh, each in its place, and their controllers as stars.
fn write_model(all: &[Grown<'_>], controllers: bool, path: &Path) -> Result<(), StageError> {
    let sides = |tree: &Tree| tree.girth.map_or(CORNERS, |form| form.corners);
    let mut bodies = Vec::with_capacity(all.len());
    for Grown { tree, plant, age, .. } in all {
        let sides = u8::try_from(sides(tree)).unwrap_or(u8::MAX);
        bodies.push(PlotBody { plant, age: *age, options: MeshOptions { sides, ..MeshOptions::default() } });
    }
    let member = |(body, grown): (usize, &Grown<'_>)| PlotMember {
        body,
        place: grown.tree.stands_at(),
        name: grown.name.to_owned(),
    };
    let members = all.iter().enumerate().map(member).collect();
    let obstacles = all.iter().filter(|_| controllers).flat_map(|grown| stars(grown.tree)).collect();
    let mesh = PlotMesh { bodies, members, obstacles, name: "a stage".to_owned(), place: [0.0; 3] };
    put(path, |out| mesh.write(out))
}

/// Writes the times of frames as FFmpeg's demuxer `concat` reads them.
///
/// # Errors
/// Those of the file.
pub fn write_times(names: &[String], seconds: &[f64], path: &Path) -> Result<(), StageError> {
    let mut text = "ffconcat version 1.0\n".to_owned();
    for (name, seconds) in names.iter().zip(seconds) {
        text += &format!("file '{name}'\nduration {seconds}\n");
    }
    put(path, |out| out.write_all(text.as_bytes()))
}

fn put(path: &Path, write: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>) -> Result<(), StageError> {
    let wrong = |error| StageError::Write(path.to_owned(), error);
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(wrong)?;
    }
    let mut file = Destination::create(path)?;
    write(&mut file).map_err(wrong)?;
    Ok(file.finish().map(drop)?)
}
