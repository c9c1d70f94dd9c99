//! The PLY format, `binary_little_endian`: header and elements through ply-rs-bw, vertices and triangles in bulk.
//!
//! Counts are in the header, so the scene is counted first and then written in one pass. For a large scene the next
//! chunk is drawn while the last chunk is written, on two threads, with the same bytes. Comments state the unit, the
//! conserved measures of tubes and leaves, the plant, its age, the run's seed and the plant's place in the plot. The
//! file has no face properties and no edges.

use super::chunk::{Chunk, Face, Vertex};
use super::{About, Columns, Counts, MeshWriter, Scene, Tolerance};
use ply_rs_bw::ply::{Addable, DefaultElement, ElementDef, Encoding, Header, PropertyDef, PropertyType, ScalarType};
use ply_rs_bw::writer::Writer;
use std::io::{self, Write};
use std::sync::mpsc::sync_channel;
use std::thread;

/// The size of vertices and triangles, bytes, above which drawing and writing overlap.
const OVERLAP_FROM: u64 = 8 << 20;

/// The number of chunks between the drawing and the writing thread.
const UNDER_WAY: usize = 3;

/// The PLY format.
#[derive(Debug, Clone, Copy, Default)]
pub struct Ply;

impl MeshWriter for Ply {
    fn extension(&self) -> &'static str {
        "ply"
    }

    fn write(&self, scene: &Scene, about: &About, out: &mut (dyn Write + Send)) -> io::Result<()> {
        let counts = scene.counts();
        let mut comments = vec![about.in_words(), place_comment(about.place)];
        comments.extend(scene.options().joints.in_words().map(str::to_owned));
        comments.extend(scene.options().thinned.map(|thinned| thinned.in_words()));
        if let Some(columns) = scene.columns() {
            return write_with(columns, scene, comments, out);
        }
        out.write_all(&header_of(scene.tolerance(), comments, counts)?)?;
        if counts.vertices * Vertex::BYTES as u64 + counts.faces * Face::BYTES as u64 > OVERLAP_FROM {
            write_overlapped(scene, out)
        } else {
            write_in_turn(scene, out)
        }
    }
}

/// Writes a file whose vertices have columns of their own, after the properties of every mesh.
fn write_with(
    columns: &Columns,
    scene: &Scene,
    mut comments: Vec<String>,
    out: &mut (dyn Write + Send),
) -> io::Result<()> {
    comments.extend(columns.in_words());
    let mut header = header(scene.tolerance(), comments, scene.counts());
    if let Some(element) = header.elements.get_mut("vertex") {
        let float = PropertyType::Scalar(ScalarType::Float);
        columns.names().iter().for_each(|name| {
            element.properties.add(PropertyDef::new((*name).into(), float.clone()));
        });
    }
    let mut bytes = Vec::new();
    Writer::<DefaultElement>::new().write_header(&mut bytes, &header)?;
    out.write_all(&bytes)?;
    let mut row = Vec::new();
    let mut chunk = Chunk::new();
    scene.vertices(&mut chunk, &mut |chunk| {
        bytes.clear();
        for vertex in bytemuck::cast_slice::<u8, Vertex>(chunk.filled()) {
            row.clear();
            columns.put(vertex, &mut row);
            bytes.extend_from_slice(bytemuck::bytes_of(vertex));
            row.iter().for_each(|number| bytes.extend_from_slice(&number.to_le_bytes()));
        }
        chunk.clear();
        out.write_all(&bytes)
    })?;
    scene.faces(&mut chunk, &mut |chunk| {
        out.write_all(chunk.filled())?;
        chunk.clear();
        Ok(())
    })
}

fn write_in_turn(scene: &Scene, out: &mut (dyn Write + Send)) -> io::Result<()> {
    let mut chunk = Chunk::new();
    let mut sink = |chunk: &mut Chunk| {
        out.write_all(chunk.filled())?;
        chunk.clear();
        Ok(())
    };
    scene.vertices(&mut chunk, &mut sink)?;
    scene.faces(&mut chunk, &mut sink)
}

/// Draws on a thread of its own, which sends full chunks to the writer and gets them back empty.
fn write_overlapped(scene: &Scene, out: &mut (dyn Write + Send)) -> io::Result<()> {
    let (full, to_write) = sync_channel::<Chunk>(UNDER_WAY);
    let (empty, to_fill) = sync_channel::<Chunk>(UNDER_WAY);
    for _ in 1..UNDER_WAY {
        empty.send(Chunk::new()).map_err(io::Error::other)?;
    }
    thread::scope(|scope| {
        let drawing = scope.spawn(move || {
            let mut chunk = Chunk::new();
            // A closed channel means that the writer failed; it reports why.
            let mut sink = |chunk: &mut Chunk| {
                let next = to_fill.recv().map_err(io::Error::other)?;
                full.send(std::mem::replace(chunk, next)).map_err(|_| io::ErrorKind::BrokenPipe.into())
            };
            scene.vertices(&mut chunk, &mut sink)?;
            scene.faces(&mut chunk, &mut sink)
        });
        let written = to_write.iter().try_for_each(|mut chunk| {
            out.write_all(chunk.filled())?;
            chunk.clear();
            // The drawing thread may have ended and need no more chunks.
            let _ = empty.send(chunk);
            Ok(())
        });
        drop((to_write, empty));
        let drawn = drawing.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        written.and(drawn)
    })
}

/// The comment with the origin of a file's vertices, in the shortest decimals that read back as the same numbers.
pub(super) fn place_comment([x, y, z]: [f64; 3]) -> String {
    format!("place_m {x:?} {y:?} {z:?}")
}

/// What a comment says of the wood.
fn wood_comment(tolerance: Option<Tolerance>) -> String {
    let Some(Tolerance { distance, .. }) = tolerance else {
        return "tubes keep the section of their diameters and the volume of the wood".into();
    };
    format!(
        "tolerance_m {distance:?}: wood in tubes of several internodes, a ring has the number of the one that begins there"
    )
}

/// The whole header, with comments of how its wood is drawn and of what the file holds.
pub(super) fn header_of(tolerance: Option<Tolerance>, comments: Vec<String>, counts: Counts) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    Writer::<DefaultElement>::new().write_header(&mut bytes, &header(tolerance, comments, counts))?;
    Ok(bytes)
}

fn header(tolerance: Option<Tolerance>, comments: Vec<String>, counts: Counts) -> Header {
    let mut header = Header::new();
    header.encoding = Encoding::BinaryLittleEndian;
    header.comments = vec![
        format!("phytomer {}", env!("CARGO_PKG_VERSION")),
        "unit metre, Z up".into(),
        "ages in ticks since the seed, death_age inf while the component lives".into(),
        wood_comment(tolerance),
        "leaves keep area_m2 of the tables: one side, of closed forms half the surface".into(),
    ];
    header.comments.extend(comments);
    header.elements.add(vertex_element(counts.vertices as usize));
    header.elements.add(face_element(counts.faces as usize));
    header
}

fn vertex_element(count: usize) -> ElementDef {
    let mut element = ElementDef::new("vertex".into());
    element.count = count;
    let floats = |names: &'static [&'static str]| names.iter().map(|&name| (name, ScalarType::Float));
    let bytes = |names: &'static [&'static str]| names.iter().map(|&name| (name, ScalarType::UChar));
    let properties = floats(&["x", "y", "z", "nx", "ny", "nz"])
        .chain(bytes(&["red", "green", "blue", "alpha"]))
        .chain(floats(&["s", "t", "birth_age", "death_age"]))
        .chain([("component_id", ScalarType::Int), ("kind", ScalarType::UChar)]);
    for (name, scalar) in properties {
        element.properties.add(PropertyDef::new(name.into(), PropertyType::Scalar(scalar)));
    }
    element
}

fn face_element(count: usize) -> ElementDef {
    let mut element = ElementDef::new("face".into());
    element.count = count;
    let corners = PropertyType::List(ScalarType::UChar, ScalarType::Int);
    element.properties.add(PropertyDef::new("vertex_indices".into(), corners));
    element
}
