//! A mesh at one age as Wavefront OBJ with its materials: a group for each run of a material slot, and a library of
//! materials beside the file, which names pictures beside it.
//!
//! Metres, Z up, counterclockwise from outside. Each vertex has its colour behind its place, as many readers take it,
//! its texture coordinates and its normal. A material without a picture has the mean colour of its vertices. Absent:
//! ages and component numbers, for which the format has no room, and where the files are.

use super::chunk::{Face, Vertex};
use super::drawing::Drawing;
use super::pictures::Pictures;
use super::slots::Slots;
use std::fmt::Write as _;
use std::io::{self, Write};

/// A full colour.
const FULL: f64 = 255.0;

/// A mesh whose materials are known.
pub struct Obj<'a> {
    mesh: &'a dyn Drawing,
    slots: Slots,
    /// The first vertex of each run of a slot, and the slot.
    runs: Vec<(u64, usize)>,
    /// For each slot its number of vertices and the sum of their colours.
    colours: Vec<(u64, [u64; 3])>,
}

impl<'a> Obj<'a> {
    /// Looks at the vertices of a mesh.
    ///
    /// # Errors
    /// Those of the mesh.
    pub fn of(mesh: &'a dyn Drawing) -> io::Result<Self> {
        let slots = mesh.slots();
        let (mut runs, mut colours) = (Vec::<(u64, usize)>::new(), vec![(0, [0; 3]); slots.list().len()]);
        let (mut in_turn, mut first) = (slots.in_turn(), 0);
        mesh.vertices(&mut |vertices| {
            for vertex in vertices {
                let slot = in_turn.next(vertex);
                if runs.last().is_none_or(|(_, last)| *last != slot) {
                    runs.push((first, slot));
                }
                first += 1;
                let (count, sum) = &mut colours[slot];
                *count += 1;
                (0..3).for_each(|k| sum[k] += u64::from(vertex.tag().colour[k]));
            }
            Ok(())
        })?;
        Ok(Self { mesh, slots, runs, colours })
    }

    /// Writes the mesh; `library` is the name of the file of its materials.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, library: &str, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "# phytomer {}\n# metres, Z up", env!("CARGO_PKG_VERSION"))?;
        for note in self.mesh.notes() {
            writeln!(out, "# {}", note.replace(['\n', '\r'], " "))?;
        }
        let [x, y, z] = self.mesh.place();
        writeln!(out, "# place_m {x:?} {y:?} {z:?}\nmtllib {library}\no plants")?;
        let mut text = String::new();
        for part in [put_place, put_texture, put_normal] {
            self.mesh.vertices(&mut |vertices| {
                text.clear();
                vertices.iter().for_each(|vertex| part(vertex, &mut text));
                out.write_all(text.as_bytes())
            })?;
        }
        let mut last = None;
        self.mesh.faces(&mut |faces| {
            text.clear();
            faces.iter().for_each(|face| self.put_face(face, &mut last, &mut text));
            out.write_all(text.as_bytes())
        })
    }

    fn put_face(&self, face: &Face, last: &mut Option<usize>, text: &mut String) {
        let corners = face.indices();
        let run = self.runs.partition_point(|(first, _)| *first <= u64::from(corners[0])).saturating_sub(1);
        let slot = self.runs.get(run).map_or(0, |(_, slot)| *slot);
        if *last != Some(slot) {
            let name = &self.slots.list()[slot].name;
            let _ = writeln!(text, "g {name}\nusemtl {name}");
            *last = Some(slot);
        }
        text.push('f');
        for corner in corners.map(|corner| u64::from(corner) + 1) {
            let _ = write!(text, " {corner}/{corner}/{corner}");
        }
        text.push('\n');
    }

    /// Writes the library of its materials, whose pictures lie beside it.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write_materials(&self, pictures: &Pictures, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "# phytomer {}", env!("CARGO_PKG_VERSION"))?;
        for (slot, (count, sum)) in self.slots.list().iter().zip(&self.colours).filter(|(_, (count, _))| *count > 0) {
            let mean = sum.map(|sum| sum as f64 / (*count as f64 * FULL));
            let [red, green, blue] = if slot.texture.is_some() { [1.0; 3] } else { mean };
            writeln!(out, "newmtl {}\nKa 0 0 0\nKd {red:.6} {green:.6} {blue:.6}\nKs 0 0 0\nd 1\nillum 1", slot.name)?;
            let Some(texture) = &slot.texture else { continue };
            let colours = pictures.name_of(&texture.colours);
            writeln!(out, "map_Kd {colours}")?;
            if texture.colours.has_alpha {
                writeln!(out, "map_d {colours}")?;
            }
            if let Some(normals) = &texture.normals {
                // The first is of programs of design, the second of those of physically based materials.
                let name = pictures.name_of(normals);
                writeln!(out, "map_Bump {name}\nnorm {name}")?;
            }
        }
        Ok(())
    }
}

fn put_place(vertex: &Vertex, text: &mut String) {
    let ([x, y, z], [red, green, blue, _]) = (vertex.position(), vertex.tag().colour);
    let [red, green, blue] = [red, green, blue].map(|byte| f64::from(byte) / FULL);
    let _ = writeln!(text, "v {x} {y} {z} {red:.4} {green:.4} {blue:.4}");
}

fn put_texture(vertex: &Vertex, text: &mut String) {
    let [s, t] = vertex.texture();
    let _ = writeln!(text, "vt {s} {t}");
}

fn put_normal(vertex: &Vertex, text: &mut String) {
    let [x, y, z] = vertex.normal();
    let _ = writeln!(text, "vn {x} {y} {z}");
}
