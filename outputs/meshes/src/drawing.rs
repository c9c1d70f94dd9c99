//! A mesh as formats see it: its size, where it is, and its vertices and triangles piece by piece.
//!
//! A plant at an age, and all plants of a plot with its obstacles, are drawn alike, as often as a format asks for them,
//! without a whole mesh in memory. A format is a function of a [`Drawing`]. Absent: PLY files of one plant, which pass
//! the chunks of a scene on to the disk without a copy.

use super::chunk::{Chunk, Face, Vertex};
use super::{About, Columns, Counts, Scene, Slots, Tolerance};
use std::io;

/// A function that takes some entries of a mesh, in their order.
pub type Take<'t, T> = dyn FnMut(&[T]) -> io::Result<()> + 't;

/// A mesh that is drawn piece by piece.
pub trait Drawing {
    /// Its size.
    fn counts(&self) -> Counts;

    /// How near the wood is drawn; `None`: each internode by itself.
    fn tolerance(&self) -> Option<Tolerance>;

    /// What a file says of it: its name, and what stands in it, a line each.
    fn notes(&self) -> Vec<String>;

    /// The place of its origin, metres. Added to the vertices, it gives their places in the run.
    fn place(&self) -> [f64; 3];

    /// What its vertices tell beside the properties of every mesh.
    fn columns(&self) -> Option<&Columns<'_>> {
        None
    }

    /// The materials that its vertices have.
    fn slots(&self) -> Slots {
        Slots::default()
    }

    /// Draws all vertices.
    ///
    /// # Errors
    /// Those of `take`.
    fn vertices(&self, take: &mut Take<'_, Vertex>) -> io::Result<()>;

    /// Draws all triangles, by the indices of their vertices.
    ///
    /// # Errors
    /// Those of `take`.
    fn faces(&self, take: &mut Take<'_, Face>) -> io::Result<()>;
}

/// A plant at an age, by itself.
#[derive(Debug)]
pub struct PlantDrawing<'a> {
    /// What is drawn.
    pub scene: &'a Scene<'a>,
    /// What it is called.
    pub about: About,
}

impl Drawing for PlantDrawing<'_> {
    fn counts(&self) -> Counts {
        self.scene.counts()
    }

    fn tolerance(&self) -> Option<Tolerance> {
        self.scene.tolerance()
    }

    fn notes(&self) -> Vec<String> {
        vec![self.about.in_words()]
    }

    fn place(&self) -> [f64; 3] {
        self.about.place
    }

    fn columns(&self) -> Option<&Columns<'_>> {
        self.scene.columns()
    }

    fn slots(&self) -> Slots {
        Slots::of([(self.scene.plant(), self.scene.options(), self.counts().vertices)])
    }

    fn vertices(&self, take: &mut Take<'_, Vertex>) -> io::Result<()> {
        self.scene.vertices(&mut Chunk::new(), &mut |chunk| emptied(chunk, take))
    }

    fn faces(&self, take: &mut Take<'_, Face>) -> io::Result<()> {
        self.scene.faces(&mut Chunk::new(), &mut |chunk| emptied(chunk, take))
    }
}

/// Hands on the content of a chunk, which must hold nothing but entries of one type.
fn emptied<T: bytemuck::Pod>(chunk: &mut Chunk, take: &mut Take<'_, T>) -> io::Result<()> {
    take(bytemuck::cast_slice(chunk.filled()))?;
    chunk.clear();
    Ok(())
}
