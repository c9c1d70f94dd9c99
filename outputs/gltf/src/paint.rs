//! Colours and materials: a material for each class of components, and the colours of vertices in linear light.
//!
//! Meshes have colours as screens take them (sRGB, IEC 61966-2-1); glTF multiplies the base colour by colours of
//! vertices in linear light (glTF 2.0 §3.9.2). 16 bits a channel keep every one of the 256 steps apart. Both sides of a
//! face are seen, since leaves are single faces. Absent: textures.

use phytomer_meshes::Tag;
use phytomer_sim::plant::{Class, Kind};
use serde_json::{Value, json};
use std::sync::LazyLock;

/// The classes that are meshes of their own, each with its material: its name and its roughness.
pub const CLASSES: [(&str, f64); 5] =
    [("wood", 0.9), ("leaves", 0.6), ("flowers", 0.7), ("fruits", 0.5), ("obstacles", 0.9)];

/// The class of a vertex, as a place among [`CLASSES`].
#[inline]
pub fn class_of(tag: &Tag) -> usize {
    if tag.component < 0 {
        return 4;
    }
    Kind::ALL.get(usize::from(tag.kind)).map_or(0, |kind| class_of_kind(*kind))
}

/// The class of a kind of components, as a place among [`CLASSES`].
#[inline]
pub fn class_of_kind(kind: Kind) -> usize {
    match kind.class() {
        Class::Leaf => 1,
        Class::Flower => 2,
        Class::Fruit => 3,
        _ => 0,
    }
}

/// The material of a class.
pub fn material(class: usize) -> Value {
    let (name, roughness) = CLASSES[class];
    json!({
        "name": name,
        "doubleSided": true,
        "pbrMetallicRoughness": { "metallicFactor": 0, "roughnessFactor": roughness },
    })
}

/// A colour in linear light, opaque.
#[inline]
pub fn linear([red, green, blue, _]: [u8; 4]) -> [u16; 4] {
    let [red, green, blue] = [red, green, blue].map(|channel| LINEAR[usize::from(channel)]);
    [red, green, blue, u16::MAX]
}

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
