//! Colours: linear numbers for the bytes of sRGB, the list of those that a surface has, and the materials.
//!
//! Surfaces name their colours by their places in a list (an indexed primvar), which keeps files small. One material
//! a kind of part reads them; it is a UsdPreviewSurface, which artists may replace by their own.

use super::layer::{Attribute, Data, Layer, Value};
use phytomer_meshes::linear;
use std::collections::BTreeMap;
use std::io;

/// The colours of surfaces, each once.
#[derive(Debug, Clone, Default)]
pub struct Palette {
    places: BTreeMap<[u8; 3], i32>,
    colours: Vec<[f32; 3]>,
    /// The last colour that was asked for, and its place: neighbours mostly have one colour.
    last: Option<([u8; 3], i32)>,
}

impl Palette {
    /// The place of a colour, which is added where it is new.
    pub fn place(&mut self, colour: [u8; 3]) -> i32 {
        let Self { places, colours, last } = self;
        if let Some((_, place)) = last.filter(|(known, _)| *known == colour) {
            return place;
        }
        let place = *places.entry(colour).or_insert_with(|| {
            colours.push(colour.map(|byte| linear(byte) as f32));
            colours.len() as i32 - 1
        });
        *last = Some((colour, place));
        place
    }

    /// The colours, as linear numbers.
    pub fn colours(&self) -> &[[f32; 3]] {
        &self.colours
    }
}

/// Writes the materials of these names, each with how rough it is.
///
/// # Errors
/// Those of the file.
pub fn write_materials(layer: &mut dyn Layer, root: &str, materials: &[(&str, f32)]) -> io::Result<()> {
    layer.begin("Scope", "materials", &[])?;
    for &(name, roughness) in materials {
        let path = |rest: &str| format!("{}/{rest}", path_of(root, name));
        layer.begin("Material", name, &[])?;
        layer.attribute(Attribute::new("outputs:surface", "token"), Value::Of(&path("surface.outputs:surface")))?;
        layer.begin("Shader", "surface", &[])?;
        let always = |layer: &mut dyn Layer, attribute, data| layer.attribute(attribute, Value::Always(data));
        always(layer, Attribute::uniform("info:id", "token"), Data::Token("UsdPreviewSurface"))?;
        let colour = path("colour.outputs:result");
        layer.attribute(Attribute::new("inputs:diffuseColor", "color3f"), Value::Of(&colour))?;
        always(layer, Attribute::new("inputs:roughness", "float"), Data::Float(roughness))?;
        layer.attribute(Attribute::new("outputs:surface", "token"), Value::None)?;
        layer.end()?;
        layer.begin("Shader", "colour", &[])?;
        always(layer, Attribute::uniform("info:id", "token"), Data::Token("UsdPrimvarReader_float3"))?;
        always(layer, Attribute::new("inputs:varname", "string"), Data::Text("displayColor"))?;
        always(layer, Attribute::new("inputs:fallback", "float3"), Data::Triple([0.2, 0.3, 0.1]))?;
        layer.attribute(Attribute::new("outputs:result", "float3"), Value::None)?;
        layer.end()?;
        layer.end()?;
    }
    layer.end()
}

/// The path of a material.
pub fn path_of(root: &str, material: &str) -> String {
    format!("/{root}/materials/{material}")
}
