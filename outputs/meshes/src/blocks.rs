//! A scene in blocks of neighbouring components, for pictures, which draw it on all threads, and for files that need
//! each component with its own vertices.
//!
//! Absent: files of a mesh in one piece, which take the vertices and triangles of `scene` in chunks.

use super::Mesh;
use super::chunk::{Face, Vertex};
use super::outline::{OrganForm, Shown};
use super::reduced::Reduced;
use super::scene::Scene;
use bytemuck::Zeroable;
use phytomer_sim::plant::OrganId;
use std::convert::Infallible;
use std::ops::Range;

/// The number of entries of a column in one block of a scene.
pub(super) const BLOCK: usize = 256;

/// What is done with the vertices and the triangles of a component.
pub type TakeAlone<'a> = dyn FnMut(&[Vertex], &[[u32; 3]]) + 'a;

impl Scene<'_> {
    /// The number of blocks of the scene, for [`Scene::block`].
    pub fn blocks(&self) -> usize {
        self.wood.blocks() + self.stem_places().div_ceil(BLOCK) + self.organ_blocks()
    }

    /// The mesh of an organ alone.
    pub fn mesh_of(&self, organ: OrganId) -> Mesh {
        let form = self.form(organ);
        let mut vertices = vec![Vertex::zeroed(); form.vertices()];
        let faces = form.faces().iter().map(|face| Face::new(*face)).collect();
        self.write_organ(form, organ, &mut vertices);
        Mesh { vertices, faces }
    }

    /// The number of triangles of an organ.
    pub fn faces_of(&self, organ: OrganId) -> u64 {
        self.form(organ).faces().len() as u64
    }

    /// The number of triangles of its internodes.
    pub fn wood_faces(&self) -> u64 {
        let mut faces = self.wood.counts().faces;
        let Ok::<(), Infallible>(()) = self.each_stem(0..self.stem_places(), |node| {
            faces += self.stems().form(node).faces().len() as u64;
            Ok(())
        });
        faces
    }

    /// Calls `take` with the coarser forms of an organ, the finest first: the distance, metres, from which on a
    /// tolerance of organs allows it or a coarser one, and its triangles.
    pub fn coarser_of(&self, organ: OrganId, take: &mut dyn FnMut(f32, u32)) {
        if let Shown::Whole(OrganForm::Shape(shape)) = self.form(organ) {
            let (organs, place) = (&self.plant().organs, organ.index());
            shape.each_coarser([organs.length[place], organs.width[place]], take);
        }
    }

    /// How many of its blocks are those of organs, which are the last and do not depend on how wood is drawn.
    pub fn organ_blocks(&self) -> usize {
        self.plant().organs.len().div_ceil(BLOCK)
    }

    /// Replaces `mesh` by one block of neighbouring components; triangles refer to the block's own vertices. All blocks
    /// in their order are the mesh of the scene, and each can be made alone, on any thread. A block may be empty. Takes
    /// O(1) per component of the block.
    pub fn block(&self, block: usize, mesh: &mut Mesh) {
        mesh.vertices.clear();
        mesh.faces.clear();
        let of_stems = self.stem_places().div_ceil(BLOCK);
        let Some(block) = block.checked_sub(self.wood.blocks()) else {
            return self.append_wood(block, mesh);
        };
        if block < of_stems {
            let Ok::<(), Infallible>(()) = self.each_stem(span(block, self.stem_places()), |node| {
                let stem = self.stems().form(node);
                self.stems().write(stem, node, appended(mesh, stem.vertices(), stem.faces()));
                Ok(())
            });
        } else {
            self.organs_of(span(block - of_stems, self.plant().organs.len())).for_each(|organ| {
                let form = self.form(organ);
                self.write_organ(form, organ, appended(mesh, form.vertices(), form.faces()));
            });
        }
    }

    /// The place of a block among those of internodes that are drawn by themselves; `None` for another block.
    pub(super) fn stem_block(&self, block: usize) -> Option<usize> {
        block.checked_sub(self.wood.blocks()).filter(|block| *block < self.stem_places().div_ceil(BLOCK))
    }

    fn append_wood(&self, block: usize, mesh: &mut Mesh) {
        let tubes = self.wood.tubes().and_then(|reduced| Some((reduced, reduced.blocks().get(block)?)));
        if let Some((reduced, tubes)) = tubes {
            self.append_tubes(reduced, tubes.clone(), mesh);
        } else if let Some(welded) = self.wood.welded() {
            mesh.vertices.extend_from_slice(&welded.vertices);
            mesh.faces.extend_from_slice(&welded.faces);
        }
    }

    fn append_tubes(&self, reduced: &Reduced, tubes: Range<usize>, mesh: &mut Mesh) {
        let mut places = Vec::new();
        for tube in tubes {
            let first = mesh.vertices.len();
            let put = reduced.each_part(self.stems(), tube, &mut places, &mut |vertices, write| {
                write(with_room(&mut mesh.vertices, vertices));
                Ok(())
            });
            let joined = reduced.each_skin(tube, first as u32, &mut |skin| {
                skin.write(with_room(&mut mesh.faces, skin.faces()));
                Ok(())
            });
            debug_assert!(put.is_ok() && joined.is_ok(), "memory does not fail");
        }
    }

    /// Calls `take` with the vertices and the triangles of each component that is drawn by itself, in the order of the
    /// mesh: organs, and internodes along which no tube of several runs. Triangles refer to the component's own
    /// vertices.
    pub fn each_alone(&self, take: &mut TakeAlone<'_>) {
        let mut vertices = Vec::new();
        let Ok::<(), Infallible>(()) = self.each_stem(0..self.stem_places(), |node| {
            let stem = self.stems().form(node);
            vertices.clear();
            self.stems().write(stem, node, with_room(&mut vertices, stem.vertices()));
            take(&vertices, stem.faces());
            Ok(())
        });
        for organ in self.organs() {
            let form = self.form(organ);
            vertices.clear();
            self.write_organ(form, organ, with_room(&mut vertices, form.vertices()));
            take(&vertices, form.faces());
        }
    }
}

/// The entries of a column of `length` entries in a block.
pub(super) fn span(block: usize, length: usize) -> Range<usize> {
    block * BLOCK..((block + 1) * BLOCK).min(length)
}

/// Adds room for `more` entries at the end of a list.
fn with_room<T: Zeroable + Clone>(list: &mut Vec<T>, more: usize) -> &mut [T] {
    let first = list.len();
    list.resize(first + more, T::zeroed());
    &mut list[first..]
}

/// Adds room for `vertices` vertices at the end of `mesh`, and adds their triangles.
#[inline]
fn appended<'m>(mesh: &'m mut Mesh, vertices: usize, faces: &[[u32; 3]]) -> &'m mut [Vertex] {
    let first = mesh.vertices.len();
    mesh.faces.extend(faces.iter().map(|face| Face::new(face.map(|corner| first as u32 + corner))));
    mesh.vertices.resize(first + vertices, Vertex::zeroed());
    &mut mesh.vertices[first..]
}
