//! Triangles out of a binary glTF 2.0 (GLB): the scene's nodes with their transforms, the triangles of their meshes.
//!
//! The JSON chunk is read with serde_json, the binary chunk by hand. glTF has y up: a point (x, y, z) becomes (x, −z,
//! y). Absent: strips and fans, sparse accessors, compressed meshes, buffers in files of their own; each is a fault.

use super::{MOST_TRIANGLES, MeshFault, Read, Soup};
use serde_json::Value;

const MAGIC: &[u8] = b"glTF";
const JSON: &[u8] = b"JSON";
const BINARY: &[u8] = b"BIN\0";

/// The largest depth of nodes within nodes; a deeper file is faulty or circular.
const DEEPEST: usize = 32;
/// The most nodes and primitives visited in all, since a node may stand in several places.
const MOST_VISITED: usize = 4096;
/// The most vertices read in all, used or not: a small file can refer to the same vertices many times.
const MOST_POINTS: usize = 30 * MOST_TRIANGLES;

/// The four columns of a transform.
type Matrix = [[f32; 4]; 4];

const IDENTITY: Matrix = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

/// Reads the triangles of a GLB file.
pub fn read(bytes: &[u8]) -> Read<Soup> {
    let (json, binary) = chunks(bytes)?;
    let json: Value = serde_json::from_slice(json).map_err(|error| {
        MeshFault::new("the JSON chunk", error.to_string().chars().take(200).collect::<String>(), "JSON")
    })?;
    if json["extensionsRequired"].as_array().is_some_and(|list| !list.is_empty()) {
        let problem = "extensions that a reader must know";
        return Err(MeshFault::new("extensionsRequired", problem, "a mesh without compression or other extensions"));
    }
    let mut reading = Reading { json: &json, binary, soup: Soup::default(), visited: 0 };
    reading.scene()?;
    Ok(reading.soup)
}

/// The JSON chunk and the binary chunk; the binary chunk is empty where there is none.
fn chunks(bytes: &[u8]) -> Read<(&[u8], &[u8])> {
    let word = |at: usize| bytes.get(at..at + 4).and_then(|word| word.try_into().ok()).map(u32::from_le_bytes);
    if bytes.get(..4) != Some(MAGIC) || word(4) != Some(2) {
        return Err(MeshFault::new("byte 0", "no head of a binary glTF 2.0", "`glTF` and the version 2"));
    }
    let mut found: [&[u8]; 2] = [&[], &[]];
    let mut at = 12;
    while at < bytes.len() {
        let cut =
            || MeshFault::new(format!("byte {at}"), "a chunk that is cut off", "its length, its type and its bytes");
        let length = word(at).ok_or_else(cut)? as usize;
        let kind = bytes.get(at + 4..at + 8).ok_or_else(cut)?;
        let body = length.checked_add(at + 8).and_then(|end| bytes.get(at + 8..end)).ok_or_else(cut)?;
        match kind {
            JSON if found[0].is_empty() => found[0] = body,
            BINARY if found[1].is_empty() => found[1] = body,
            _ => {}
        }
        at += 8 + length;
    }
    Ok((found[0], found[1]))
}

struct Reading<'a> {
    json: &'a Value,
    binary: &'a [u8],
    soup: Soup,
    visited: usize,
}

/// The numbers of an accessor, in the binary chunk.
struct Accessor<'a> {
    bytes: &'a [u8],
    count: usize,
    stride: usize,
    component: u64,
}

impl<'a> Reading<'a> {
    /// Reads the nodes of the default scene; without a scene every mesh, once.
    fn scene(&mut self) -> Read<()> {
        let json = self.json;
        let scene = json["scene"].as_u64().unwrap_or(0) as usize;
        let roots = json["scenes"].get(scene).and_then(|scene| scene["nodes"].as_array());
        match roots {
            Some(roots) => roots.iter().try_for_each(|node| self.node(node, &IDENTITY, 0)),
            None => {
                let meshes = json["meshes"].as_array().map_or(0, Vec::len);
                (0..meshes).try_for_each(|mesh| self.mesh(mesh, &IDENTITY))
            }
        }
    }

    /// Counts one more node or primitive.
    fn visit(&mut self, place: &str) -> Read<()> {
        self.visited += 1;
        if self.visited > MOST_VISITED {
            let problem = format!("more than {MOST_VISITED} nodes and primitives");
            return Err(MeshFault::new(place, problem, "a mesh of fewer parts, each where it stands"));
        }
        Ok(())
    }

    fn node(&mut self, number: &Value, above: &Matrix, depth: usize) -> Read<()> {
        let json = self.json;
        let index = number.as_u64().map(|index| index as usize);
        let place = || format!("node {number}");
        let node = index.and_then(|index| json["nodes"].get(index));
        let node = node.ok_or_else(|| MeshFault::new(place(), "a node that is not there", "one of `nodes`"))?;
        if depth > DEEPEST {
            return Err(MeshFault::new(place(), "nodes within nodes without end", "a tree of nodes"));
        }
        self.visit(&place())?;
        let own = times(above, &transform(node));
        if let Some(mesh) = node["mesh"].as_u64() {
            self.mesh(mesh as usize, &own)?;
        }
        let children = node["children"].as_array().map(Vec::as_slice).unwrap_or_default();
        children.iter().try_for_each(|child| self.node(child, &own, depth + 1))
    }

    fn mesh(&mut self, number: usize, transform: &Matrix) -> Read<()> {
        let json = self.json;
        let primitives = json["meshes"].get(number).and_then(|mesh| mesh["primitives"].as_array());
        let primitives = primitives.ok_or_else(|| {
            MeshFault::new(format!("mesh {number}"), "a mesh that is not there", "one of `meshes`, with `primitives`")
        })?;
        primitives.iter().try_for_each(|primitive| self.primitive(primitive, &format!("mesh {number}"), transform))
    }

    fn primitive(&mut self, primitive: &Value, place: &str, transform: &Matrix) -> Read<()> {
        self.visit(place)?;
        if primitive["mode"].as_u64().unwrap_or(4) != 4 {
            return Err(MeshFault::new(place, "points, lines, strips or fans", "triangles (mode 4)"));
        }
        let positions = self.accessor(&primitive["attributes"]["POSITION"], "VEC3", 3, place)?;
        if positions.component != 5126 || positions.count > 3 * MOST_TRIANGLES {
            let problem = format!("{} positions of component type {}", positions.count, positions.component);
            return Err(MeshFault::new(place, problem, format!("at most {} of floats (5126)", 3 * MOST_TRIANGLES)));
        }
        let corners: Vec<u32> = match &primitive["indices"] {
            Value::Null => (0..positions.count as u32).collect(),
            indices => {
                let indices = self.accessor(indices, "SCALAR", 1, place)?;
                (0..indices.count.min(3 * MOST_TRIANGLES + 3))
                    .map(|k| indices.whole(k))
                    .collect::<Option<_>>()
                    .ok_or_else(|| {
                        MeshFault::new(
                            place,
                            "indices that are no whole numbers",
                            "bytes, shorts or ints (5121, 5123, 5125)",
                        )
                    })?
            }
        };
        if self.soup.points.len() + positions.count > MOST_POINTS {
            let problem = format!("more than {MOST_POINTS} vertices in all, used or not");
            return Err(MeshFault::new(place, problem, "primitives with vertices of their own"));
        }
        let first = self.soup.points.len() as u32;
        self.soup.points.extend((0..positions.count).map(|k| placed(transform, positions.vector(k))));
        let whole = corners.chunks_exact(3);
        if !whole.remainder().is_empty() {
            return Err(MeshFault::new(place, format!("{} corners", corners.len()), "three for each triangle"));
        }
        for corners in whole {
            let shifted: Vec<u32> = corners.iter().map(|corner| corner.saturating_add(first)).collect();
            self.soup.polygon(&shifted, || place.to_owned())?;
        }
        Ok(())
    }

    fn accessor(&self, number: &Value, kind: &str, components: usize, place: &str) -> Read<Accessor<'a>> {
        let place = || format!("{place}, accessor {number}");
        let there =
            |what: &str| MeshFault::new(place(), format!("{what} that is not there"), "what the file says of itself");
        let accessor =
            number.as_u64().and_then(|n| self.json["accessors"].get(n as usize)).ok_or_else(|| there("an accessor"))?;
        if accessor["type"] != kind || !accessor["sparse"].is_null() {
            return Err(MeshFault::new(
                place(),
                format!("the type {}", accessor["type"]),
                format!("`{kind}`, not sparse"),
            ));
        }
        let component = accessor["componentType"].as_u64().unwrap_or(0);
        let size = match component {
            5120 | 5121 => 1,
            5122 | 5123 => 2,
            5125 | 5126 => 4,
            _ => return Err(MeshFault::new(place(), format!("the component type {component}"), "one of glTF 2.0")),
        };
        let view = accessor["bufferView"]
            .as_u64()
            .and_then(|n| self.json["bufferViews"].get(n as usize))
            .ok_or_else(|| there("a buffer view"))?;
        if view["buffer"].as_u64() != Some(0) {
            return Err(MeshFault::new(place(), "a buffer outside the file", "buffer 0, the binary chunk"));
        }
        let natural = size * components;
        let count = accessor["count"].as_u64().unwrap_or(0) as usize;
        let stride = view["byteStride"].as_u64().map_or(natural, |stride| stride as usize);
        let offset = |value: &Value| value["byteOffset"].as_u64().unwrap_or(0) as usize;
        let start = offset(view).checked_add(offset(accessor));
        let length = count.saturating_sub(1).checked_mul(stride).and_then(|bytes| bytes.checked_add(natural));
        let bytes = match (count, start, length) {
            (0, ..) => Some(&self.binary[..0]),
            (_, Some(start), Some(length)) => start.checked_add(length).and_then(|end| self.binary.get(start..end)),
            _ => None,
        };
        Ok(Accessor { bytes: bytes.ok_or_else(|| there("a stretch of the binary chunk"))?, count, stride, component })
    }
}

impl Accessor<'_> {
    fn word<const N: usize>(&self, at: usize) -> Option<[u8; N]> {
        self.bytes.get(at..at + N)?.try_into().ok()
    }

    fn whole(&self, place: usize) -> Option<u32> {
        let at = place * self.stride;
        match self.component {
            5121 => self.word(at).map(|[byte]| u32::from(byte)),
            5123 => self.word(at).map(u16::from_le_bytes).map(u32::from),
            5125 => self.word(at).map(u32::from_le_bytes),
            _ => None,
        }
    }

    fn vector(&self, place: usize) -> [f32; 3] {
        [0, 4, 8].map(|axis| self.word(place * self.stride + axis).map_or(f32::NAN, f32::from_le_bytes))
    }
}

/// The transform of a node: its matrix, or its scale, rotation and translation.
fn transform(node: &Value) -> Matrix {
    let numbers = |key: &str| -> Vec<f32> {
        let list = node[key].as_array().map(Vec::as_slice).unwrap_or_default();
        list.iter().filter_map(Value::as_f64).map(|x| x as f32).collect()
    };
    if let Ok(m) = <[f32; 16]>::try_from(numbers("matrix")) {
        return [0, 1, 2, 3].map(|column| [0, 1, 2, 3].map(|row| m[4 * column + row]));
    }
    let [x, y, z, w] = numbers("rotation").try_into().unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let scale: [f32; 3] = numbers("scale").try_into().unwrap_or([1.0; 3]);
    let [tx, ty, tz] = numbers("translation").try_into().unwrap_or([0.0; 3]);
    let turned = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)],
        [2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)],
        [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)],
    ];
    let column = |k: usize| [turned[k][0] * scale[k], turned[k][1] * scale[k], turned[k][2] * scale[k], 0.0];
    [column(0), column(1), column(2), [tx, ty, tz, 1.0]]
}

fn times(a: &Matrix, b: &Matrix) -> Matrix {
    b.map(|column| [0, 1, 2, 3].map(|row| (0..4).map(|k| a[k][row] * column[k]).sum()))
}

/// A point of a mesh in the scene, with z up.
fn placed(transform: &Matrix, [x, y, z]: [f32; 3]) -> [f32; 3] {
    let at =
        [0, 1, 2].map(|row| transform[0][row] * x + transform[1][row] * y + transform[2][row] * z + transform[3][row]);
    [at[0], -at[2], at[1]]
}
