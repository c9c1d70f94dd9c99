//! Colours: linear numbers for the bytes of sRGB, the list of those that a surface has, and the materials.
//!
//! Surfaces name their colours by their places in a list (an indexed primvar), which keeps files small. One material
//! a kind of part reads them; it is a UsdPreviewSurface, which artists may replace by their own. A texture of a species
//! is read from its pictures instead.

use super::layer::{Attribute, Data, Layer, Value};
use phytomer_meshes::{CLASSES, Pictures, Slot, Texture, linear};
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

/// A material.
pub struct Material<'a> {
    /// Its name.
    pub name: &'a str,
    /// How rough it is.
    pub roughness: f32,
    /// The pictures that cover it, and whether they repeat, as those of bark do.
    pub texture: Option<(&'a Texture, bool)>,
}

impl<'a> Material<'a> {
    /// A material in the colours of its surface.
    pub fn plain(name: &'a str, roughness: f32) -> Self {
        Self { name, roughness, texture: None }
    }

    /// That of a slot.
    pub fn of(slot: &'a Slot) -> Self {
        let is_wood = [0, CLASSES.len() - 1].contains(&slot.class);
        let texture = slot.texture.as_deref().map(|texture| (texture, is_wood));
        Self { name: &slot.name, roughness: if is_wood { 0.85 } else { 0.6 }, texture }
    }
}

/// Writes materials, whose pictures have these names.
///
/// # Errors
/// Those of the file.
pub fn write_materials(
    layer: &mut dyn Layer,
    root: &str,
    pictures: &Pictures,
    materials: &[Material],
) -> io::Result<()> {
    layer.begin("Scope", "materials", &[])?;
    for &Material { name, roughness, texture } in materials {
        let path = |rest: &str| format!("{}/{rest}", path_of(root, name));
        layer.begin("Material", name, &[])?;
        layer.attribute(Attribute::new("outputs:surface", "token"), Value::Of(&path("surface.outputs:surface")))?;
        layer.begin("Shader", "surface", &[])?;
        always(layer, Attribute::uniform("info:id", "token"), Data::Token("UsdPreviewSurface"))?;
        let colour = path(if texture.is_some() { "texture.outputs:rgb" } else { "colour.outputs:result" });
        layer.attribute(Attribute::new("inputs:diffuseColor", "color3f"), Value::Of(&colour))?;
        always(layer, Attribute::new("inputs:roughness", "float"), Data::Float(roughness))?;
        if let Some((Texture { colours, normals, .. }, _)) = texture {
            if colours.has_alpha {
                layer.attribute(Attribute::new("inputs:opacity", "float"), Value::Of(&path("texture.outputs:a")))?;
                always(layer, Attribute::new("inputs:opacityThreshold", "float"), Data::Float(0.5))?;
            }
            if normals.is_some() {
                layer.attribute(Attribute::new("inputs:normal", "normal3f"), Value::Of(&path("relief.outputs:rgb")))?;
            }
        }
        layer.attribute(Attribute::new("outputs:surface", "token"), Value::None)?;
        layer.end()?;
        match texture {
            None => write_colours(layer)?,
            Some((texture, repeats)) => write_texture(layer, &path_of(root, name), pictures, (texture, repeats))?,
        }
        layer.end()?;
    }
    layer.end()
}

fn always(layer: &mut dyn Layer, attribute: Attribute, data: Data) -> io::Result<()> {
    layer.attribute(attribute, Value::Always(data))
}

/// Writes the shader that reads the colours of a surface.
fn write_colours(layer: &mut dyn Layer) -> io::Result<()> {
    layer.begin("Shader", "colour", &[])?;
    always(layer, Attribute::uniform("info:id", "token"), Data::Token("UsdPrimvarReader_float3"))?;
    always(layer, Attribute::new("inputs:varname", "string"), Data::Text("displayColor"))?;
    always(layer, Attribute::new("inputs:fallback", "float3"), Data::Triple([0.2, 0.3, 0.1]))?;
    layer.attribute(Attribute::new("outputs:result", "float3"), Value::None)?;
    layer.end()
}

/// Writes the shaders that read the pictures of a texture.
fn write_texture(
    layer: &mut dyn Layer,
    path: &str,
    pictures: &Pictures,
    (texture, repeats): (&Texture, bool),
) -> io::Result<()> {
    layer.begin("Shader", "st", &[])?;
    always(layer, Attribute::uniform("info:id", "token"), Data::Token("UsdPrimvarReader_float2"))?;
    always(layer, Attribute::new("inputs:varname", "string"), Data::Text("st"))?;
    layer.attribute(Attribute::new("outputs:result", "float2"), Value::None)?;
    layer.end()?;
    let relief = texture.normals.as_ref().map(|normals| ("relief", "raw", normals));
    for (name, space, picture) in [("texture", "sRGB", &texture.colours)].into_iter().chain(relief) {
        layer.begin("Shader", name, &[])?;
        always(layer, Attribute::uniform("info:id", "token"), Data::Token("UsdUVTexture"))?;
        let file = format!("./{}", pictures.name_of(picture));
        always(layer, Attribute::new("inputs:file", "asset"), Data::File(&file))?;
        always(layer, Attribute::new("inputs:sourceColorSpace", "token"), Data::Token(space))?;
        let st = format!("{path}/st.outputs:result");
        layer.attribute(Attribute::new("inputs:st", "float2"), Value::Of(&st))?;
        for way in ["inputs:wrapS", "inputs:wrapT"] {
            always(layer, Attribute::new(way, "token"), Data::Token(if repeats { "repeat" } else { "clamp" }))?;
        }
        if name == "relief" {
            // Bytes from 0 to 1 are directions from −1 to 1.
            always(layer, Attribute::new("inputs:scale", "float4"), Data::Quad([2.0, 2.0, 2.0, 1.0]))?;
            always(layer, Attribute::new("inputs:bias", "float4"), Data::Quad([-1.0, -1.0, -1.0, 0.0]))?;
        }
        layer.attribute(Attribute::new("outputs:rgb", "float3"), Value::None)?;
        layer.attribute(Attribute::new("outputs:a", "float"), Value::None)?;
        layer.end()?;
    }
    Ok(())
}

/// The path of a material.
pub fn path_of(root: &str, material: &str) -> String {
    format!("/{root}/materials/{material}")
}
