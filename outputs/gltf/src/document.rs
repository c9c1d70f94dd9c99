//! A GLB file: the JSON that says what is in it, and the binary part that follows (glTF 2.0 §4.4).
//!
//! Views and accessors are entered before their bytes are made, so that the JSON, which stands first in the file, can
//! be written first, and the bytes after it as they come. Every view begins at a multiple of four bytes. Pictures are
//! in the file. Absent: what the bytes are, and anything that refers to other files.

use phytomer_meshes::Picture;
use serde_json::{Map, Value, json};
use std::io::{self, Write};
use std::sync::Arc;

/// The largest file, bytes: its length is a number of 32 bits.
pub const MOST_BYTES: u64 = u32::MAX as u64;

/// What a view is for.
pub const VERTICES: u32 = 34962;
/// As [`VERTICES`], of indices.
pub const INDICES: u32 = 34963;

/// The type of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Number {
    I8 = 5120,
    U8 = 5121,
    I16 = 5122,
    U16 = 5123,
    U32 = 5125,
    F32 = 5126,
}

/// The numbers of an accessor.
#[derive(Debug, Clone)]
pub struct Accessor {
    /// The view; `None` where all that is not in `sparse` is 0.
    pub view: Option<usize>,
    /// The first byte in the view.
    pub offset: u64,
    pub number: Number,
    pub normalized: bool,
    /// `SCALAR`, `VEC3` and so on.
    pub shape: &'static str,
    pub count: u64,
    /// The least and the largest, where they must be told.
    pub bounds: Option<[Vec<f64>; 2]>,
    /// Those that differ from what the view has: how many, the view and type of their places, the view of their values.
    pub sparse: Option<(u64, usize, Number, usize)>,
}

impl Accessor {
    /// Numbers from the beginning of a view on.
    pub fn of(view: usize, number: Number, shape: &'static str, count: u64) -> Self {
        Self { view: Some(view), offset: 0, number, normalized: false, shape, count, bounds: None, sparse: None }
    }

    /// The same, in a view of several properties of vertices.
    pub fn at(self, offset: u64) -> Self {
        Self { offset, ..self }
    }

    /// The same, as shares of the largest number of their type.
    pub fn normalized(self) -> Self {
        Self { normalized: true, ..self }
    }

    /// The same, with the least and the largest.
    pub fn within<const N: usize>(self, [low, high]: [[f32; N]; 2]) -> Self {
        let wide = |bound: [f32; N]| bound.map(f64::from).to_vec();
        Self { bounds: Some([wide(low), wide(high)]), ..self }
    }
}

/// What a file has.
#[derive(Debug, Default)]
pub struct Document {
    /// What the file says of itself.
    pub extras: Map<String, Value>,
    pub nodes: Vec<Value>,
    /// The nodes of the scene.
    pub roots: Vec<usize>,
    pub meshes: Vec<Value>,
    materials: Vec<Value>,
    images: Vec<Value>,
    samplers: Vec<Value>,
    textures: Vec<Value>,
    /// The pictures that are in the file, and their images.
    pictures: Vec<(Arc<Picture>, usize)>,
    pub skins: Vec<Value>,
    pub animations: Vec<Value>,
    /// Extensions that the file uses, and those of them without which it cannot be read.
    pub uses: Vec<&'static str>,
    pub requires: Vec<&'static str>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    bytes: u64,
}

impl Document {
    /// Enters a view of so many bytes; its index. `stride`: the bytes from one vertex to the next.
    pub fn view(&mut self, bytes: u64, stride: Option<u64>, target: Option<u32>) -> usize {
        let mut view = json!({ "buffer": 0, "byteOffset": self.bytes, "byteLength": bytes });
        if let Some(stride) = stride {
            view["byteStride"] = stride.into();
        }
        if let Some(target) = target {
            view["target"] = target.into();
        }
        self.bytes += padded(bytes);
        self.views.push(view);
        self.views.len() - 1
    }

    /// Enters an accessor; its index.
    pub fn accessor(&mut self, accessor: Accessor) -> usize {
        let Accessor { view, offset, number, normalized, shape, count, bounds, sparse } = accessor;
        let mut entry = json!({ "componentType": number as u32, "count": count, "type": shape });
        if let Some(view) = view {
            entry["bufferView"] = view.into();
        }
        if offset > 0 {
            entry["byteOffset"] = offset.into();
        }
        if normalized {
            entry["normalized"] = true.into();
        }
        if let Some([low, high]) = bounds {
            (entry["min"], entry["max"]) = (low.into(), high.into());
        }
        if let Some((count, places, of_places, values)) = sparse {
            entry["sparse"] = json!({
                "count": count,
                "indices": { "bufferView": places, "componentType": of_places as u32 },
                "values": { "bufferView": values },
            });
        }
        self.accessors.push(entry);
        self.accessors.len() - 1
    }

    /// Enters a node; its index.
    pub fn node(&mut self, node: Value) -> usize {
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    /// Enters a material, unless it is there; its index.
    pub fn material(&mut self, material: Value) -> usize {
        place_in(&mut self.materials, material)
    }

    /// Enters a picture as a texture, unless it is there; its index. Its bytes are added to those of the views. On bark
    /// it repeats, on an organ it ends at its edges.
    pub fn texture(&mut self, picture: &Arc<Picture>, repeats: bool, bytes: &mut Vec<u8>) -> usize {
        let known = self.pictures.iter().find(|(known, _)| known == picture).map(|(_, image)| *image);
        let image = known.unwrap_or_else(|| {
            let kind = if picture.is_jpeg { "image/jpeg" } else { "image/png" };
            let image = self.image((&picture.name, kind), &picture.bytes, bytes);
            self.pictures.push((Arc::clone(picture), image));
            image
        });
        self.sampled(image, repeats)
    }

    /// Enters the bytes of a picture with a name and a type, and adds them to those of the views; its index.
    pub fn image(&mut self, (name, kind): (&str, &str), picture: &[u8], bytes: &mut Vec<u8>) -> usize {
        let view = self.view(picture.len() as u64, None, None);
        bytes.extend_from_slice(picture);
        bytes.resize(padded(bytes.len() as u64) as usize, 0);
        self.images.push(json!({ "name": name, "bufferView": view, "mimeType": kind }));
        self.images.len() - 1
    }

    /// Enters an image as a texture that repeats or ends at its edges, unless it is there; its index.
    pub fn sampled(&mut self, image: usize, repeats: bool) -> usize {
        let wrap = if repeats { 10497 } else { 33071 };
        // Linear between pixels, and between the pictures of two sizes.
        let sampler = json!({ "magFilter": 9729, "minFilter": 9987, "wrapS": wrap, "wrapT": wrap });
        let sampler = place_in(&mut self.samplers, sampler);
        place_in(&mut self.textures, json!({ "source": image, "sampler": sampler }))
    }

    /// Writes all that stands before the bytes of the views, which must follow, in their order, each padded to a
    /// multiple of four bytes.
    ///
    /// # Errors
    /// Those of `out`; a file that would be too large, before anything is written.
    pub fn write_head(self, out: &mut (dyn Write + Send)) -> io::Result<()> {
        let bytes = self.bytes;
        let mut json = serde_json::to_vec(&self.json())?;
        json.resize(padded(json.len() as u64) as usize, b' ');
        let binary = if bytes > 0 { 8 + bytes } else { 0 };
        let all = 12 + 8 + json.len() as u64 + binary;
        let length = u32::try_from(all).map_err(|_| too_large(all))?;
        for word in [*b"glTF", 2_u32.to_le_bytes(), length.to_le_bytes(), (json.len() as u32).to_le_bytes(), *b"JSON"] {
            out.write_all(&word)?;
        }
        out.write_all(&json)?;
        if bytes > 0 {
            out.write_all(&(bytes as u32).to_le_bytes())?;
            out.write_all(b"BIN\0")?;
        }
        Ok(())
    }

    fn json(self) -> Value {
        let mut asset = json!({ "version": "2.0", "generator": format!("phytomer {}", env!("CARGO_PKG_VERSION")) });
        if !self.extras.is_empty() {
            asset["extras"] = self.extras.into();
        }
        let mut file = json!({ "asset": asset, "scene": 0, "scenes": [{ "nodes": self.roots }] });
        if self.bytes > 0 {
            file["buffers"] = json!([{ "byteLength": self.bytes }]);
        }
        let lists = [
            ("nodes", self.nodes),
            ("meshes", self.meshes),
            ("materials", self.materials),
            ("textures", self.textures),
            ("samplers", self.samplers),
            ("images", self.images),
            ("skins", self.skins),
            ("animations", self.animations),
            ("accessors", self.accessors),
            ("bufferViews", self.views),
            ("extensionsUsed", self.uses.into_iter().map(Value::from).collect()),
            ("extensionsRequired", self.requires.into_iter().map(Value::from).collect()),
        ];
        // glTF knows no empty lists.
        for (name, list) in lists.into_iter().filter(|(_, list)| !list.is_empty()) {
            file[name] = list.into();
        }
        file
    }
}

/// The place of a value in a list, to which it is added unless it is there.
fn place_in(list: &mut Vec<Value>, value: Value) -> usize {
    list.iter().position(|known| *known == value).unwrap_or_else(|| {
        list.push(value);
        list.len() - 1
    })
}

/// The next multiple of four.
pub fn padded(bytes: u64) -> u64 {
    bytes.div_ceil(4) * 4
}

/// Writes what fills a view up to a multiple of four bytes.
///
/// # Errors
/// Those of `out`.
pub fn pad(bytes: u64, out: &mut (dyn Write + Send)) -> io::Result<()> {
    out.write_all(&[0; 3][..(padded(bytes) - bytes) as usize])
}

/// That a file would be larger than its format allows.
pub fn too_large(bytes: u64) -> io::Error {
    io::Error::other(format!(
        "the GLB file would have {bytes} bytes, and its format holds at most {MOST_BYTES}: choose fewer sides, a larger \
         tolerance or fewer keys"
    ))
}
