//! Colours and materials: a material for each class of components, and the colours of vertices in linear light.
//!
//! Meshes have colours as screens take them (sRGB, IEC 61966-2-1); glTF multiplies the base colour by colours of
//! vertices in linear light (glTF 2.0 §3.9.2). 16 bits a channel keep every one of the 256 steps apart. Both sides of a
//! face are seen, since leaves are single faces. A material with a picture has its colours alone: its vertices are
//! white.

use super::document::Document;
use phytomer_meshes::Slot;
pub use phytomer_meshes::{CLASSES, class_of, class_of_kind};
use serde_json::{Value, json};
use std::sync::LazyLock;

/// How rough the surface of each class is.
const ROUGHNESS: [f64; CLASSES.len()] = [0.9, 0.6, 0.7, 0.5, 0.9];
/// What is less opaque is cut out.
const CUT: f64 = 0.5;

/// The material of a class.
pub fn material(class: usize) -> Value {
    json!({
        "name": CLASSES[class],
        "doubleSided": true,
        "pbrMetallicRoughness": { "metallicFactor": 0, "roughnessFactor": ROUGHNESS[class] },
    })
}

/// Enters the material of a slot, with its pictures, whose bytes are added to those of the views; its index.
pub fn enter_material(slot: &Slot, file: &mut Document, bytes: &mut Vec<u8>) -> usize {
    let mut of = material(slot.class);
    of["name"] = slot.name.as_str().into();
    if let Some(texture) = &slot.texture {
        let repeats = slot.class == 0;
        of["pbrMetallicRoughness"]["baseColorTexture"] =
            json!({ "index": file.texture(&texture.colours, repeats, bytes) });
        if let Some(normals) = &texture.normals {
            of["normalTexture"] = json!({ "index": file.texture(normals, repeats, bytes), "scale": 1 });
        }
        if texture.colours.has_alpha {
            of["alphaMode"] = "MASK".into();
            of["alphaCutoff"] = CUT.into();
        }
    }
    file.material(of)
}

/// A colour in linear light, opaque.
#[inline]
pub fn linear([red, green, blue, _]: [u8; 4]) -> [u16; 4] {
    let [red, green, blue] = [red, green, blue].map(|channel| LINEAR[usize::from(channel)]);
    [red, green, blue, u16::MAX]
}

/// White, opaque: the colour of vertices on which a picture lies.
pub const WHITE: [u16; 4] = [u16::MAX; 4];

static LINEAR: LazyLock<[u16; 256]> = LazyLock::new(|| {
    std::array::from_fn(|channel| (phytomer_meshes::linear(channel as u8) * f64::from(u16::MAX)).round() as u16)
});

#[cfg(test)]
mod tests {
    use super::*;

    /// Known points of the curve: black, white, and the grey of 18 % reflectance at 118; every step is kept apart.
    #[test]
    fn colours_are_in_linear_light() {
        assert_eq!(linear([0, 255, 0, 0]), [0, u16::MAX, 0, u16::MAX]);
        let [grey, ..] = linear([118, 0, 0, 255]);
        assert!((f64::from(grey) / f64::from(u16::MAX) - 0.1812).abs() < 1e-3, "{grey}");
        assert!(LINEAR.windows(2).all(|pair| pair[0] < pair[1]));
    }
}
