//! Levels of detail of a plant in one GLB file: a node for each, of which the first names the others (MSFT_lod).
//!
//! The first node alone stands in the scene, so that a program that does not know the extension shows the finest level
//! and no other. Its `MSFT_screencoverage` tells down to which part of the area of the screen each level is shown; the
//! last is shown however small it is. Crossed cards may be the last level: their atlas, colours with opacity and
//! normals, is in the file, and what is more than half opaque is shown. What is told of each level is in
//! `asset.extras.levels`. Absent: which levels there are (`phytomer_pictures::levels`).

use super::document::{Accessor, Document, INDICES, MOST_BYTES, Number, VERTICES, too_large};
use super::still::{Still, unit, y_up};
use phytomer_meshes::{Cards, Drawing};
use serde_json::{Map, Value, json};
use std::io::{self, Write};

const EXTENSION: &str = "MSFT_lod";

/// A level of detail.
pub struct Level<'a> {
    /// Its mesh.
    pub mesh: &'a dyn Drawing,
    /// The part of the area of the screen down to which it is shown.
    pub screen: f64,
    /// What is told of it.
    pub told: Map<String, Value>,
}

/// Cards as the last level, and what is told of them.
pub struct LastCards<'a> {
    /// The cards.
    pub cards: &'a Cards,
    /// What is told of them.
    pub told: Map<String, Value>,
}

/// Writes levels of detail, the finest first, and cards after them.
///
/// # Errors
/// Those of `out`; a file that is larger than its format can hold, before anything is written.
pub fn write_levels(levels: &[Level], cards: Option<&LastCards>, out: &mut (dyn Write + Send)) -> io::Result<()> {
    let stills = levels.iter().map(|level| Still::of(level.mesh, None)).collect::<io::Result<Vec<_>>>()?;
    let bytes: u64 = stills.iter().map(Still::bytes).sum();
    if bytes > MOST_BYTES {
        return Err(too_large(bytes));
    }
    let (mut file, mut pictures) = (Document::default(), Vec::new());
    let mut nodes = Vec::new();
    // The pictures of all levels are before the vertices of the first, which are written as they come.
    stills.iter().for_each(|still| still.enter_materials(&mut file, &mut pictures));
    for (number, still) in stills.iter().enumerate() {
        let node = still.enter_node(&mut file, &format!("_lod{number}"), &mut pictures);
        nodes.push(file.node(node));
    }
    let mut of_cards = Vec::new();
    if let Some(last) = cards {
        let name = levels.first().and_then(|level| level.mesh.notes().into_iter().next()).unwrap_or_default();
        let node = enter_cards(&mut file, last.cards, &format!("{name}_lod{}", stills.len()), &mut of_cards);
        nodes.push(file.node(node));
    }
    if let [first, others @ ..] = &nodes[..] {
        file.roots.push(*first);
        if !others.is_empty() {
            let screens: Vec<f64> = levels.iter().map(|level| level.screen).chain(cards.map(|_| 0.0)).collect();
            file.nodes[*first]["extensions"] = json!({ EXTENSION: { "ids": others } });
            file.nodes[*first]["extras"] = json!({ "MSFT_screencoverage": screens });
            file.uses.push(EXTENSION);
        }
    }
    if let Some(level) = levels.first() {
        file.extras.extend(super::still::extras_of(level.mesh));
    }
    let told: Vec<&Map<String, Value>> =
        levels.iter().map(|level| &level.told).chain(cards.map(|last| &last.told)).collect();
    file.extras.insert("levels".to_owned(), json!(told));
    file.write_head(out)?;
    out.write_all(&pictures)?;
    stills.iter().try_for_each(|still| still.write_bytes(out))?;
    out.write_all(&of_cards)
}

/// Enters cards with their atlas, and makes the bytes of their views; their node.
fn enter_cards(file: &mut Document, cards: &Cards, name: &str, bytes: &mut Vec<u8>) -> Value {
    const STRIDE: u64 = 48;
    let (mut corners, mut faces) = (Vec::new(), Vec::new());
    let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    for (number, card) in (0..).zip(&cards.cards) {
        let right: [f32; 3] = std::array::from_fn(|k| card.corners[1][k] - card.corners[0][k]);
        let right = unit(right);
        for (at, [s, t]) in card.corners.iter().zip(card.texture) {
            let at = y_up(*at);
            (0..3).for_each(|k| (low[k], high[k]) = (low[k].min(at[k]), high[k].max(at[k])));
            let numbers = at.into_iter().chain(y_up(card.normal)).chain([s, 1.0 - t]);
            // The normals of the atlas are told to the right, up and towards the viewer.
            let numbers = numbers.chain(y_up(right)).chain([1.0]);
            corners.extend(numbers.flat_map(f32::to_le_bytes));
        }
        faces.extend(Cards::FACES.iter().flatten().flat_map(|corner| (4 * number + corner).to_le_bytes()));
    }
    let count = 4 * cards.cards.len() as u64;
    let view = file.view(corners.len() as u64, Some(STRIDE), Some(VERTICES));
    let of = |shape, offset| Accessor::of(view, Number::F32, shape, count).at(offset);
    let attributes = json!({
        "POSITION": file.accessor(of("VEC3", 0).within([low, high])),
        "NORMAL": file.accessor(of("VEC3", 12)),
        "TEXCOORD_0": file.accessor(of("VEC2", 24)),
        "TANGENT": file.accessor(of("VEC4", 32)),
    });
    let of_faces = file.view(faces.len() as u64, None, Some(INDICES));
    let indices = file.accessor(Accessor::of(of_faces, Number::U32, "SCALAR", 3 * cards.faces()));
    // Both are whole multiples of four bytes.
    bytes.extend_from_slice(&corners);
    bytes.extend_from_slice(&faces);
    let [colours, normals] = [("cards", &cards.colours), ("cards' normals", &cards.normals)].map(|(name, png)| {
        let image = file.image((name, "image/png"), png, bytes);
        file.sampled(image, false)
    });
    let material = file.material(json!({
        "name": "cards",
        "doubleSided": true,
        "alphaMode": "MASK",
        "alphaCutoff": 0.5,
        "normalTexture": { "index": normals },
        "pbrMetallicRoughness": { "baseColorTexture": { "index": colours }, "metallicFactor": 0, "roughnessFactor": 0.8 },
    }));
    let primitive = json!({ "attributes": attributes, "indices": indices, "material": material });
    file.meshes.push(json!({ "name": name, "primitives": [primitive] }));
    json!({ "name": name, "mesh": file.meshes.len() - 1 })
}
