//! Triangles from a GLB, the binary form of glTF 2.0: the triangles of its scene, each mesh where its nodes place it.
//!
//! glTF counts in metres with y upward; here z is upward, so x, y, z become x, −z, y. Positions are single-precision
//! numbers, indices of 8, 16 or 32 bits. Refused: sparse and compressed data, strips and fans, buffers in other files.
//! Absent: materials, skins and animations, which are skipped.

use super::triangles::{MOST_ELEMENTS, Refused, Triangles};
use serde_json::Value;

/// The most nodes of a scene.
const MOST_NODES: usize = 10_000;
/// The number of a chunk of JSON, and of binary data.
const JSON: u32 = 0x4e4f_534a;
const BINARY: u32 = 0x004e_4942;
const FLOAT: u64 = 5126;

/// A matrix of four columns.
type Matrix = [[f64; 4]; 4];

/// Reads the triangles of a GLB file.
pub(super) fn read(bytes: &[u8]) -> Result<Triangles, Refused> {
    let (json, binary) = chunks(bytes).ok_or_else(|| {
        Refused::new(
            "its header",
            "it is no GLB, or it is cut off",
            "a GLB of version 2: a chunk of JSON and one of data",
        )
    })?;
    let file: Value =
        serde_json::from_slice(json).map_err(|error| Refused::new("its JSON", error.to_string(), "glTF 2.0"))?;
    let file = File { file: &file, binary };
    let mut triangles = Triangles::default();
    let mut waiting: Vec<(u64, Matrix)> = file.roots().into_iter().map(|root| (root, IDENTITY)).collect();
    let mut seen = 0;
    while let Some((number, above)) = waiting.pop() {
        seen += 1;
        let place = || format!("node {number}");
        if seen > MOST_NODES {
            return Err(Refused::new(place(), "there are too many nodes", format!("at most {MOST_NODES}, none twice")));
        }
        let node = file.at("nodes", number).ok_or_else(|| Refused::new(place(), "it is not there", "a node"))?;
        let matrix = times(&above, &own_matrix(node));
        if let Some(mesh) = node.get("mesh").and_then(Value::as_u64) {
            file.add_mesh(mesh, &matrix, &mut triangles)?;
        }
        let children = node.get("children").and_then(Value::as_array).into_iter().flatten();
        waiting.extend(children.filter_map(Value::as_u64).map(|child| (child, matrix)));
    }
    if triangles.faces.is_empty() {
        return Err(Refused::new("as a whole", "there are no triangles", "a scene with a mesh of triangles"));
    }
    Ok(triangles)
}

fn number_at(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_le_bytes(bytes.get(at..at.checked_add(4)?)?.try_into().ok()?))
}

/// The first chunk of JSON and the first of binary data.
fn chunks(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    if bytes.get(..4)? != b"glTF" || number_at(bytes, 4)? != 2 {
        return None;
    }
    let (mut json, mut binary, mut at) = (None, &[][..], 12);
    while let (Some(length), Some(kind)) = (number_at(bytes, at), number_at(bytes, at + 4)) {
        let chunk = bytes.get(at + 8..(at + 8).checked_add(length as usize)?)?;
        match kind {
            JSON if json.is_none() => json = Some(chunk),
            BINARY if binary.is_empty() => binary = chunk,
            _ => {}
        }
        at += 8 + length as usize;
    }
    Some((json?, binary))
}

const IDENTITY: Matrix = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

fn times(a: &Matrix, b: &Matrix) -> Matrix {
    b.map(|column| [0, 1, 2, 3].map(|row| (0..4).map(|k| a[k][row] * column[k]).sum()))
}

fn numbers<const N: usize>(of: &Value, key: &str) -> Option<[f64; N]> {
    let list: Vec<f64> = of.get(key)?.as_array()?.iter().filter_map(Value::as_f64).collect();
    list.try_into().ok()
}

/// The matrix of a node: stated, or made of its translation, rotation and scale.
fn own_matrix(node: &Value) -> Matrix {
    if let Some(m) = numbers::<16>(node, "matrix") {
        return [0, 4, 8, 12].map(|at| [m[at], m[at + 1], m[at + 2], m[at + 3]]);
    }
    let [tx, ty, tz] = numbers(node, "translation").unwrap_or([0.0; 3]);
    let [x, y, z, w] = numbers(node, "rotation").unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let [sx, sy, sz] = numbers(node, "scale").unwrap_or([1.0; 3]);
    let column = |of: [f64; 3], scale: f64| [of[0] * scale, of[1] * scale, of[2] * scale, 0.0];
    [
        column([1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)], sx),
        column([2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)], sy),
        column([2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)], sz),
        [tx, ty, tz, 1.0],
    ]
}

struct File<'f> {
    file: &'f Value,
    binary: &'f [u8],
}

impl<'f> File<'f> {
    fn at(&self, list: &str, number: u64) -> Option<&'f Value> {
        self.file.get(list)?.get(usize::try_from(number).ok()?)
    }

    /// The nodes of the scene that is shown; of a file without scenes all that are no child of another.
    fn roots(&self) -> Vec<u64> {
        let list = |of: &Value, key: &str| -> Vec<u64> {
            of.get(key).and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_u64).collect()
        };
        let shown = self.file.get("scene").and_then(Value::as_u64).unwrap_or(0);
        if let Some(scene) = self.at("scenes", shown) {
            return list(scene, "nodes");
        }
        let nodes = self.file.get("nodes").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
        let children: Vec<u64> = nodes.iter().flat_map(|node| list(node, "children")).collect();
        (0..nodes.len() as u64).filter(|node| !children.contains(node)).collect()
    }

    fn add_mesh(&self, number: u64, matrix: &Matrix, triangles: &mut Triangles) -> Result<(), Refused> {
        let place = || format!("mesh {number}");
        let primitives = self.at("meshes", number).and_then(|mesh| mesh.get("primitives")).and_then(Value::as_array);
        for primitive in primitives.into_iter().flatten() {
            let mode = primitive.get("mode").and_then(Value::as_u64).unwrap_or(4);
            if mode != 4 {
                let problem = format!("it has a primitive of the mode {mode}");
                return Err(Refused::new(place(), problem, "triangles: the mode 4"));
            }
            let positions = primitive.get("attributes").and_then(|of| of.get("POSITION")).and_then(Value::as_u64);
            let points = positions.and_then(|accessor| self.points(accessor)).ok_or_else(|| {
                Refused::new(
                    place(),
                    "its positions cannot be read",
                    "`POSITION` as three plain single-precision numbers",
                )
            })?;
            let indices = match primitive.get("indices").and_then(Value::as_u64) {
                Some(accessor) => self.indices(accessor).ok_or_else(|| {
                    Refused::new(place(), "its indices cannot be read", "plain whole numbers of 8, 16 or 32 bits")
                })?,
                None => (0..points.len() as u32).collect(),
            };
            add(points, &indices, (matrix, &place), triangles)?;
        }
        Ok(())
    }

    /// The parts of an accessor, each as its bytes, and the number of the type of its components.
    fn parts(&self, accessor: u64, numbers_a_part: usize) -> Option<(Vec<&'f [u8]>, u64)> {
        let accessor = self.at("accessors", accessor)?;
        if accessor.get("sparse").is_some() {
            return None;
        }
        let whole = |of: &Value, key: &str| of.get(key).and_then(Value::as_u64).and_then(|x| usize::try_from(x).ok());
        let view = self.at("bufferViews", accessor.get("bufferView")?.as_u64()?)?;
        let own = self.at("buffers", view.get("buffer")?.as_u64()?)?.get("uri").is_none();
        let (count, kind) = (whole(accessor, "count")?, accessor.get("componentType")?.as_u64()?);
        let size = numbers_a_part
            * match kind {
                5121 => 1,
                5123 => 2,
                5125 | FLOAT => 4,
                _ => return None,
            };
        let stride = whole(view, "byteStride").unwrap_or(size).max(size);
        let start = whole(view, "byteOffset").unwrap_or(0).checked_add(whole(accessor, "byteOffset").unwrap_or(0))?;
        if !own || count > MOST_ELEMENTS {
            return None;
        }
        let part = |number: usize| {
            let at = start.checked_add(number.checked_mul(stride)?)?;
            self.binary.get(at..at.checked_add(size)?)
        };
        Some(((0..count).map(part).collect::<Option<Vec<_>>>()?, kind))
    }

    fn points(&self, accessor: u64) -> Option<Vec<[f64; 3]>> {
        if self.at("accessors", accessor)?.get("type")?.as_str()? != "VEC3" {
            return None;
        }
        let (parts, kind) = self.parts(accessor, 3)?;
        let point = |part: &&[u8]| [0, 4, 8].map(|at| f32::from_bits(number_at(part, at).unwrap_or(0)).into());
        (kind == FLOAT).then(|| parts.iter().map(point).collect())
    }

    fn indices(&self, accessor: u64) -> Option<Vec<u32>> {
        let (parts, kind) = self.parts(accessor, 1)?;
        let index = |part: &&[u8]| part.iter().rev().fold(0, |sum, byte| sum << 8 | u32::from(*byte));
        (kind != FLOAT).then(|| parts.iter().map(index).collect())
    }
}

/// Adds the triangles of a primitive, placed by its node.
fn add(
    points: Vec<[f64; 3]>,
    indices: &[u32],
    (matrix, place): (&Matrix, &impl Fn() -> String),
    triangles: &mut Triangles,
) -> Result<(), Refused> {
    let first = triangles.points.len();
    if first + points.len() > MOST_ELEMENTS {
        return Err(Refused::new(place(), format!("there are more than {MOST_ELEMENTS} vertices"), "a smaller mesh"));
    }
    for [x, y, z] in points {
        let placed = [0, 1, 2].map(|k| matrix[0][k] * x + matrix[1][k] * y + matrix[2][k] * z + matrix[3][k]);
        if !placed.iter().all(|x| x.is_finite()) {
            return Err(Refused::new(place(), "a coordinate is no finite number", "metres"));
        }
        triangles.points.push([placed[0], -placed[2], placed[1]]);
    }
    for face in indices.chunks(3) {
        let corners: Vec<u32> = face.iter().map(|corner| corner.saturating_add(first as u32)).collect();
        triangles.add(place, &corners)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tetrahedron whose node is moved by 2 m along x and turned by nothing, with indices of 16 bits.
    fn file(change: impl Fn(String) -> String) -> Vec<u8> {
        let points: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mut binary: Vec<u8> = points.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        binary.extend([0_u16, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2].iter().flat_map(|x| x.to_le_bytes()));
        let json = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
            "nodes":[{"children":[1],"scale":[2,2,2]},{"mesh":0,"translation":[1,0,0]}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
            "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
                {"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],
            "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],
            "buffers":[{"byteLength":72}]}"#;
        let json = change(json.to_owned());
        let mut bytes = b"glTF".to_vec();
        for number in [2, (28 + json.len() + binary.len()) as u32, json.len() as u32, JSON] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend(json.as_bytes());
        bytes.extend((binary.len() as u32).to_le_bytes());
        bytes.extend(BINARY.to_le_bytes());
        bytes.extend(binary);
        bytes
    }

    #[test]
    fn a_mesh_stands_where_its_nodes_place_it_with_z_upward() {
        let read = read(&file(|json| json)).expect("a tetrahedron");
        assert_eq!(read.points, [[2.0, 0.0, 0.0], [4.0, 0.0, 0.0], [2.0, 0.0, 2.0], [2.0, -2.0, 0.0]]);
        assert_eq!(read.faces, Triangles::tetrahedron().faces);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        let told = |from: &str, to: &str| {
            let refused = read(&file(|json| json.replace(from, to))).expect_err("a fault");
            format!("{}: {}", refused.place, refused.problem)
        };
        assert_eq!(told("\"count\":4", "\"count\":9"), "mesh 0: its positions cannot be read");
        assert_eq!(told("5123", "5122"), "mesh 0: its indices cannot be read");
        assert_eq!(told("\"indices\":1", "\"mode\":5"), "mesh 0: it has a primitive of the mode 5");
        assert_eq!(told("\"children\":[1]", "\"children\":[7]"), "node 7: it is not there");
        assert_eq!(told("\"children\":[1]", "\"children\":[0]"), "node 0: there are too many nodes");
        assert_eq!(told("\"mesh\":0", "\"other\":0"), "as a whole: there are no triangles");
        assert_eq!(told("\"count\":12", "\"count\":11"), "mesh 0: it has 2 corners");
        assert!(read(b"glTF").is_err() && read(&file(|_| "{".to_owned())).is_err());
        let whole = file(|json| json);
        assert!((0..whole.len()).all(|cut| read(&whole[..cut]).is_err()), "cut off anywhere");
    }
}
