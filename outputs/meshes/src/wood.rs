//! The wood of a scene: each internode by itself, tubes along several, or one welded surface.
//!
//! What a surface leaves out, because it is no tube, is drawn by itself whatever the rest is. Absent: how the surfaces
//! are made (`reduced`, `welded`).

use super::chunk::{Chunk, Counts, Face, Sink, Vertex};
use super::reduced::Reduced;
use super::stem::Stems;
use super::welded::Welded;
use super::{Joints, MeshOptions, Tolerance};
use bytemuck::Pod;
use phytomer_sim::plant::NodeId;
use std::io;

/// The wood of a scene.
#[derive(Debug)]
pub enum Wood {
    /// Each internode by itself.
    Each,
    /// Tubes along several internodes, within a tolerance.
    Within(Reduced),
    /// One closed surface.
    Welded(Welded),
    /// Each internode by itself or tubes along several, with collars, with a flare, or with both.
    Collared(Box<Self>, Welded),
}

impl Wood {
    /// The wood of these internodes as the options ask for it.
    pub fn of(stems: &Stems, options: &MeshOptions) -> Self {
        match (options.joints, &options.tolerance) {
            (Joints::Welded, tolerance) => Self::Welded(Welded::of(stems, tolerance.as_ref())),
            (Joints::Collar, tolerance) => {
                let (collars, open) = (Welded::collars(stems), Self::open(stems, tolerance.as_ref()));
                let beside = Welded::flare(stems, tolerance.as_ref()).unwrap_or_default();
                Self::Collared(Box::new(open), collars.with(beside))
            }
            (Joints::Open, tolerance) => {
                let open = Self::open(stems, tolerance.as_ref());
                match Welded::flare(stems, tolerance.as_ref()) {
                    Some(flare) => Self::Collared(Box::new(open), flare),
                    None => open,
                }
            }
        }
    }

    /// Tubes by themselves.
    fn open(stems: &Stems, tolerance: Option<&Tolerance>) -> Self {
        tolerance.map_or(Self::Each, |tolerance| Self::Within(Reduced::of(stems, tolerance)))
    }

    /// The tubes along several internodes, where there are such.
    pub fn tubes(&self) -> Option<&Reduced> {
        match self {
            Self::Within(reduced) => Some(reduced),
            Self::Collared(open, _) => open.tubes(),
            Self::Each | Self::Welded(_) => None,
        }
    }

    /// The welded surface, or the collars and the flare, where there are such.
    pub fn welded(&self) -> Option<&Welded> {
        match self {
            Self::Welded(welded) | Self::Collared(_, welded) => Some(welded),
            Self::Each | Self::Within(_) => None,
        }
    }

    /// The internodes that are drawn by themselves; `None`: all.
    pub fn apart(&self) -> Option<&[NodeId]> {
        match self {
            Self::Each => None,
            Self::Within(reduced) => Some(reduced.apart()),
            Self::Welded(welded) => Some(&welded.apart),
            Self::Collared(open, _) => open.apart(),
        }
    }

    /// The size of what is not drawn internode by internode.
    pub fn counts(&self) -> Counts {
        match self {
            Self::Each => Counts::default(),
            Self::Within(reduced) => reduced.counts(),
            Self::Welded(welded) => welded.counts(),
            Self::Collared(open, collars) => {
                let (mut counts, more) = (open.counts(), collars.counts());
                counts.vertices += more.vertices;
                counts.faces += more.faces;
                counts
            }
        }
    }

    /// The number of blocks of what is not drawn internode by internode.
    pub fn blocks(&self) -> usize {
        match self {
            Self::Each => 0,
            Self::Within(reduced) => reduced.blocks().len(),
            Self::Welded(_) => 1,
            Self::Collared(open, _) => open.blocks() + 1,
        }
    }

    /// Writes the vertices of what is not drawn internode by internode.
    ///
    /// # Errors
    /// Those of `sink`.
    pub fn vertices(&self, stems: &Stems, chunk: &mut Chunk, sink: &mut Sink) -> io::Result<()> {
        match self {
            Self::Each => Ok(()),
            Self::Within(reduced) => {
                let mut places = Vec::new();
                (0..reduced.tubes()).try_for_each(|tube| {
                    reduced.each_part(stems, tube, &mut places, &mut |vertices, write| {
                        write(chunk.room(vertices, sink)?);
                        Ok(())
                    })
                })
            }
            Self::Welded(welded) => copy(&welded.vertices, Vertex::BYTES, chunk, sink),
            Self::Collared(open, collars) => {
                open.vertices(stems, chunk, sink)?;
                copy(&collars.vertices, Vertex::BYTES, chunk, sink)
            }
        }
    }

    /// Writes its triangles, and returns the number of its vertices.
    ///
    /// # Errors
    /// Those of `sink`.
    pub fn faces(&self, chunk: &mut Chunk, sink: &mut Sink) -> io::Result<u32> {
        let mut first = 0;
        match self {
            Self::Each => {}
            Self::Within(reduced) => {
                for tube in 0..reduced.tubes() {
                    reduced.each_skin(tube, first, &mut |skin| {
                        skin.write(chunk.room(skin.faces(), sink)?);
                        Ok(())
                    })?;
                    first += reduced.vertices(tube) as u32;
                }
            }
            Self::Welded(welded) => {
                copy(&welded.faces, Face::BYTES, chunk, sink)?;
                first = welded.vertices.len() as u32;
            }
            Self::Collared(open, collars) => {
                first = open.faces(chunk, sink)?;
                let shifted = |face: &Face| Face::new(face.indices().map(|corner| corner + first));
                let faces: Vec<Face> = collars.faces.iter().map(shifted).collect();
                copy(&faces, Face::BYTES, chunk, sink)?;
                first += collars.vertices.len() as u32;
            }
        }
        Ok(first)
    }
}

/// Copies entries in pieces that fit a chunk.
fn copy<T: Pod>(entries: &[T], bytes: usize, chunk: &mut Chunk, sink: &mut Sink) -> io::Result<()> {
    for piece in entries.chunks(Chunk::BYTES / 16 / bytes) {
        chunk.room(piece.len(), sink)?.copy_from_slice(piece);
    }
    Ok(())
}
