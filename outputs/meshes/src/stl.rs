//! The STL format, binary: triangles without colours, ages or numbers, for printers and for programs of mechanics.
//!
//! 80 bytes of header, the number of triangles, then 50 bytes a triangle: its normal and three corners in single
//! precision, and two bytes that are 0 (*StereoLithography Interface Specification*, 3D Systems 1988). Metres, Z up;
//! STL itself knows no unit. The header must not begin with `solid`, by which readers know the form in text. The
//! corners are kept in memory, 12 bytes each, while triangles are drawn and written one after another. What STL cannot
//! hold is left out: colours, textures, ages, numbers of components and kinds.

use super::chunk::MOST_VERTICES;
use super::drawing::Drawing;
use std::io::{self, Write};

/// The bytes of the header.
const HEADER: usize = 80;
/// The bytes of a triangle.
const TRIANGLE: usize = 50;

/// Writes a whole STL file.
///
/// # Errors
/// Those of `out`; a mesh of more triangles or corners than the format counts, before anything is written.
pub fn write_stl(mesh: &dyn Drawing, out: &mut (dyn Write + Send)) -> io::Result<()> {
    let counts = mesh.counts();
    let Some(count) = u32::try_from(counts.faces).ok().filter(|_| counts.vertices <= MOST_VERTICES) else {
        return Err(io::Error::other(format!(
            "the mesh would have {} triangles and {} vertices, and an STL file holds at most {} and {MOST_VERTICES}: \
             choose fewer sides or a larger tolerance",
            counts.faces,
            counts.vertices,
            u32::MAX
        )));
    };
    out.write_all(&header(mesh))?;
    out.write_all(&count.to_le_bytes())?;
    let mut corners: Vec<[f32; 3]> = Vec::with_capacity(counts.vertices as usize);
    mesh.vertices(&mut |vertices| {
        corners.extend(vertices.iter().map(|vertex| vertex.position()));
        Ok(())
    })?;
    let mut bytes = Vec::new();
    mesh.faces(&mut |faces| {
        bytes.clear();
        bytes.reserve(faces.len() * TRIANGLE);
        for face in faces {
            let of_face = face.indices().map(|corner| corners[corner as usize]);
            let vectors = [normal(of_face)].into_iter().chain(of_face);
            vectors.flatten().for_each(|x| bytes.extend_from_slice(&x.to_le_bytes()));
            bytes.extend_from_slice(&[0; 2]);
        }
        out.write_all(&bytes)
    })
}

/// What the file is, cut off where the header is full and filled with spaces.
fn header(mesh: &dyn Drawing) -> [u8; HEADER] {
    let words = format!("phytomer {} metres Z up {}", env!("CARGO_PKG_VERSION"), mesh.notes().join(" "));
    let mut header = [b' '; HEADER];
    let letters = words.bytes().filter(u8::is_ascii);
    header.iter_mut().zip(letters).for_each(|(place, letter)| *place = letter);
    header
}

/// The unit normal of a triangle whose corners run counterclockwise as seen from outside; zero where it has no area.
fn normal([a, b, c]: [[f32; 3]; 3]) -> [f32; 3] {
    let [to_b, to_c] = [b, c].map(|end| [0, 1, 2].map(|k| f64::from(end[k]) - f64::from(a[k])));
    let cross = [0, 1, 2].map(|k| {
        let [i, j] = [(k + 1) % 3, (k + 2) % 3];
        to_b[i] * to_c[j] - to_b[j] * to_c[i]
    });
    let length = cross.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length > 0.0 { cross.map(|x| (x / length) as f32) } else { [0.0; 3] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::PlantDrawing;
    use crate::tests::specimen;
    use crate::{MeshOptions, Scene, mesh_plant};

    /// Each triangle has the corners of the mesh, and a unit normal that looks as the normals of its corners do.
    #[test]
    fn triangles_are_those_of_the_mesh() {
        let plant = specimen();
        let scene = Scene::new(&plant, 6, &MeshOptions::default());
        let mut bytes = Vec::new();
        write_stl(&PlantDrawing { scene: &scene, about: scene.about(42) }, &mut bytes).expect("written");
        let mesh = mesh_plant(&plant, 6, &MeshOptions::default());
        assert!(bytes.starts_with(b"phytomer ") && String::from_utf8_lossy(&bytes[..HEADER]).contains("plant "));
        assert_eq!(bytes[HEADER..HEADER + 4], (mesh.faces.len() as u32).to_le_bytes());
        assert_eq!(bytes.len(), HEADER + 4 + mesh.faces.len() * TRIANGLE);
        let mut looks_alike = 0;
        for (face, bytes) in mesh.faces.iter().zip(bytes[HEADER + 4..].chunks_exact(TRIANGLE)) {
            let vector = |place: usize| -> [f32; 3] {
                [0, 1, 2].map(|k| bytemuck::pod_read_unaligned(&bytes[12 * place + 4 * k..12 * place + 4 * k + 4]))
            };
            let corners = face.indices().map(|corner| &mesh.vertices[corner as usize]);
            assert_eq!([1, 2, 3].map(vector), corners.map(|vertex| vertex.position()));
            assert_eq!(bytes[48..], [0, 0]);
            let normal = vector(0);
            let square: f32 = normal.iter().map(|x| x * x).sum();
            assert!((square - 1.0).abs() < 1e-5 || square == 0.0, "{square}");
            let along: f32 = corners.iter().flat_map(|vertex| [0, 1, 2].map(|k| vertex.normal()[k] * normal[k])).sum();
            assert!(along >= -1e-4, "a triangle looks inwards");
            looks_alike += usize::from(along > 0.0);
        }
        assert_eq!(looks_alike, mesh.faces.len());
    }
}
