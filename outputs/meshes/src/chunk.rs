//! The packed vertex and face of the mesh profile, and the chunks of bytes that carry them to a file.
//!
//! A vertex is `float x y z nx ny nz, uchar red green blue alpha, float s t, float birth_age death_age, int
//! component_id, uchar kind`: 49 bytes without padding, little endian on every platform. A face is `uchar 3, int, int,
//! int`: 13 bytes. Both are made of bytes alone, so a chunk is read as either without a copy and is written as it is.

use bytemuck::{Pod, Zeroable};
use std::io;

type Word = [u8; 4];

/// The most vertices of one mesh file: 32-bit signed indices reach no further.
pub const MOST_VERTICES: u64 = i32::MAX as u64;

/// The size of a mesh.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counts {
    /// The number of its components.
    pub components: u64,
    /// The number of its vertices.
    pub vertices: u64,
    /// The number of its triangles.
    pub faces: u64,
}

/// A vertex with the layout of the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct Vertex {
    position: [Word; 3],
    normal: [Word; 3],
    texture_and_tag: Tagged,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
struct Tagged {
    colour: [u8; 4],
    texture: [Word; 2],
    ages: [Word; 2],
    component: Word,
    kind: u8,
}

/// A triangle with the layout of the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub struct Face {
    corners: u8,
    indices: [Word; 3],
}

/// The properties that all vertices of a component share.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tag {
    /// Red, green, blue and opacity, 0 to 255.
    pub colour: [u8; 4],
    /// The age of the plant at the component's birth, ticks.
    pub birth: f32,
    /// The age of the plant at the component's death, ticks; +∞ while it lives.
    pub death: f32,
    /// The component number.
    pub component: i32,
    /// The number of its [`phytomer_sim::plant::Kind`].
    pub kind: u8,
}

impl Vertex {
    /// The size of a vertex in a file, bytes.
    pub const BYTES: usize = size_of::<Self>();

    /// A vertex at `position`, metres, with a unit `normal` and texture coordinates.
    #[inline]
    pub fn new(position: [f32; 3], normal: [f32; 3], texture: [f32; 2], tag: &Tag) -> Self {
        Self {
            position: position.map(f32::to_le_bytes),
            normal: normal.map(f32::to_le_bytes),
            texture_and_tag: Tagged {
                colour: tag.colour,
                texture: texture.map(f32::to_le_bytes),
                ages: [tag.birth.to_le_bytes(), tag.death.to_le_bytes()],
                component: tag.component.to_le_bytes(),
                kind: tag.kind,
            },
        }
    }

    /// The position, metres from the seed of the plant.
    pub fn position(&self) -> [f32; 3] {
        self.position.map(f32::from_le_bytes)
    }

    /// Moves the vertex by `offset`, metres; the sum is in double precision and then rounded.
    pub fn move_by(&mut self, offset: [f64; 3]) {
        let from = self.position();
        self.position = [0, 1, 2].map(|k| ((f64::from(from[k]) + offset[k]) as f32).to_le_bytes());
    }

    /// The unit normal.
    pub fn normal(&self) -> [f32; 3] {
        self.normal.map(f32::from_le_bytes)
    }

    /// The texture coordinates: s around or across the component, t along it.
    pub fn texture(&self) -> [f32; 2] {
        self.texture_and_tag.texture.map(f32::from_le_bytes)
    }

    /// Gives it another unit normal.
    pub fn set_normal(&mut self, normal: [f32; 3]) {
        self.normal = normal.map(f32::to_le_bytes);
    }

    /// Lays a colour over its own, by a share of 255.
    pub fn lay_over(&mut self, [red, green, blue, share]: [u8; 4]) {
        let colour = &mut self.texture_and_tag.colour;
        for (own, over) in colour.iter_mut().zip([red, green, blue]) {
            let share = u32::from(share);
            *own = ((u32::from(*own) * (255 - share) + u32::from(over) * share + 127) / 255) as u8;
        }
    }

    /// Gives it other texture coordinates.
    pub fn set_texture(&mut self, texture: [f32; 2]) {
        self.texture_and_tag.texture = texture.map(f32::to_le_bytes);
    }

    /// The properties that the vertex shares with its component.
    pub fn tag(&self) -> Tag {
        let Tagged { colour, ages, component, kind, .. } = self.texture_and_tag;
        let [birth, death] = ages.map(f32::from_le_bytes);
        Tag { colour, birth, death, component: i32::from_le_bytes(component), kind }
    }
}

impl Face {
    /// The size of a face in a file, bytes.
    pub const BYTES: usize = size_of::<Self>();

    /// A triangle of three vertices, by their indices, which must be below 2³¹.
    #[inline]
    pub fn new(indices: [u32; 3]) -> Self {
        Self { corners: 3, indices: indices.map(u32::to_le_bytes) }
    }

    /// The indices of its vertices, counterclockwise as seen from outside.
    pub fn indices(&self) -> [u32; 3] {
        self.indices.map(u32::from_le_bytes)
    }
}

/// A buffer of bytes that is filled, written and filled again.
#[derive(Debug)]
pub struct Chunk {
    bytes: Vec<u8>,
    used: usize,
}

/// A function that takes the content of a full chunk and leaves the chunk empty.
pub type Sink<'a> = dyn FnMut(&mut Chunk) -> io::Result<()> + 'a;

impl Chunk {
    /// The size of a chunk, bytes: it fits the second-level cache of a core, and one system call per chunk costs
    /// little.
    pub const BYTES: usize = 1 << 20;

    /// An empty chunk.
    pub fn new() -> Self {
        Self { bytes: vec![0; Self::BYTES], used: 0 }
    }

    /// Room for `count` values of type `T`, which the caller must write. `sink` is called first where the chunk has too
    /// little room.
    ///
    /// # Errors
    /// The errors of `sink`.
    ///
    /// # Panics
    /// Where `count` values do not fit into an empty chunk.
    #[inline]
    pub fn room<T: Pod>(&mut self, count: usize, sink: &mut Sink) -> io::Result<&mut [T]> {
        let bytes = count * size_of::<T>();
        if self.used + bytes > self.bytes.len() {
            sink(self)?;
        }
        let start = self.used;
        self.used += bytes;
        Ok(bytemuck::cast_slice_mut(&mut self.bytes[start..start + bytes]))
    }

    /// The bytes that were written.
    pub fn filled(&self) -> &[u8] {
        &self.bytes[..self.used]
    }

    /// The written bytes as values of type `T`, to be changed. The chunk must hold no other type.
    pub fn filled_mut<T: Pod>(&mut self) -> &mut [T] {
        bytemuck::cast_slice_mut(&mut self.bytes[..self.used])
    }

    /// Empties the chunk.
    pub fn clear(&mut self) {
        self.used = 0;
    }
}

impl Default for Chunk {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vertex_and_a_face_are_packed() {
        assert_eq!((Vertex::BYTES, Face::BYTES), (49, 13));
        let tag = Tag { colour: [1, 2, 3, 255], birth: 4.0, death: f32::INFINITY, component: 77, kind: 2 };
        let vertex = Vertex::new([0.5, -1.0, 2.0], [0.0, 0.0, 1.0], [0.25, 0.75], &tag);
        let bytes = bytemuck::bytes_of(&vertex);
        assert_eq!(bytes[..4], 0.5_f32.to_le_bytes());
        assert_eq!(bytes[24..28], [1, 2, 3, 255]);
        assert_eq!(bytes[44..], [77, 0, 0, 0, 2]);
        assert_eq!((vertex.tag(), vertex.texture()), (tag, [0.25, 0.75]));
    }

    #[test]
    fn a_full_chunk_goes_to_the_sink_first() {
        let (mut chunk, mut handed) = (Chunk::new(), 0);
        let mut sink = |chunk: &mut Chunk| {
            handed += chunk.filled().len();
            chunk.clear();
            Ok(())
        };
        let per_chunk = Chunk::BYTES / Face::BYTES;
        for _ in 0..=per_chunk {
            chunk.room::<Face>(1, &mut sink).unwrap()[0] = Face::new([0, 1, 2]);
        }
        assert_eq!((handed, chunk.filled().len()), (per_chunk * 13, 13));
    }
}
