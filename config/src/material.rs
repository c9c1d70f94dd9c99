//! Materials of a species: which picture of colours, and of relief, covers its bark, its leaves, its flowers or its
//! fruits in meshes.
//!
//! A picture lies in the folder of the file that names it, or below it. After inheritance that may be an ancestor's
//! file, so each name is replaced by the path of the picture. Absent: what a picture file may hold (`phytomer_meshes`),
//! and the files of meshes that take pictures.

use crate::document::{Node, Value};
use crate::library::shown;
use crate::report;
use crate::source::{Origin, Sources};
use phytomer_law::fault::{Fault, Path};
use phytomer_law::{Constant, ValueRange};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Component, Path as FilePath, PathBuf};

/// The key of the materials in a species file.
pub(crate) const MATERIAL: &str = "material";
/// The keys of a material that name a picture.
const PICTURES: [&str; 2] = ["texture", "normal"];
/// The width of a picture of bark.
const WIDTH: ValueRange = ValueRange { min: 0.001, max: 1000.0, what: "a width in metres" };
/// What is expected of the name of a picture.
const BESIDE: &str = "the name of a PNG or JPEG file in this file's folder, or in a folder below it";

/// What covers a part of the plant in meshes that hold textures (GLB, USD, OBJ).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// The part that it covers.
    pub of: Covered,
    /// The order of the axes on which it holds, the trunk 1; left out: all orders that have none of their own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 255))]
    pub order: Option<u8>,
    /// The picture of its colours, PNG or JPEG, as seen from this file, in whose folder it lies or in one below. A part
    /// whose picture is transparent is cut out there.
    #[schemars(length(min = 1))]
    pub texture: String,
    /// The picture of its relief: directions of the surface as red, green and blue, with green upwards.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(length(min = 1))]
    pub normal: Option<String>,
    /// How many metres of bark the picture is wide. Leaves, flowers and fruits state none: the whole picture covers
    /// each of them, from base to tip, with the midrib in its middle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width_m: Option<Constant>,
}

/// A part of a plant that a material covers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Covered {
    /// All wood.
    Bark,
    /// Leaves, and what stands as leaves do.
    Leaf,
    /// Flowers and their parts.
    Flower,
    /// Fruits.
    Fruit,
}

impl Material {
    /// The pictures that it names, with their paths below its own.
    pub fn pictures(&self, path: &Path) -> Vec<(Path, &str)> {
        let normal = self.normal.as_ref().map(|name| (path.key(PICTURES[1]), name.as_str()));
        [(path.key(PICTURES[0]), self.texture.as_str())].into_iter().chain(normal).collect()
    }
}

/// The path of a material by its place.
pub fn path_of(place: usize) -> Path {
    Path::root().key(MATERIAL).index(place)
}

/// What is wrong with materials beyond their schema.
pub(crate) fn faults(materials: &[Material]) -> Vec<Fault> {
    let mut faults = Vec::new();
    for (place, material) in materials.iter().enumerate() {
        let path = path_of(place);
        let same = |other: &Material| (other.of, other.order) == (material.of, material.order);
        if materials[..place].iter().any(same) {
            let problem = "a second material of the same part and order";
            faults.push(Fault::new(&path, problem, "one for each part, or one for each of its orders"));
        }
        let width = path.key("width_m");
        match (&material.width_m, material.of) {
            (Some(metres), Covered::Bark) => faults.extend(metres.within(&width, WIDTH).err()),
            (None, Covered::Bark) => {
                let expected = "`width_m`: how many metres of bark the picture is wide, such as 0.5";
                faults.push(Fault::new(&path, "bark without a width of its picture", expected));
            }
            (Some(_), _) => {
                let problem = "a width of a picture that is not of bark";
                faults.push(Fault::new(&width, problem, "no width: the whole picture covers the organ"));
            }
            (None, _) => {}
        }
    }
    faults
}

/// Replaces the name of each picture by the path of its file; one that is not there, or outside the folder, is a fault.
pub(crate) fn resolve(species: &mut Node, sources: &Sources, faults: &mut Vec<report::Fault>) {
    let Some(Value::Array(materials)) = entry(species, MATERIAL).map(|list| &mut list.value) else { return };
    for (place, material) in materials.iter_mut().enumerate() {
        for key in PICTURES {
            let Some(name) = entry(material, key) else { continue };
            if let Err((problem, expected)) = found(name, sources) {
                faults.push(report::Fault::new(name.span, &path_of(place).key(key), problem, expected));
            }
        }
    }
}

fn entry<'n>(node: &'n mut Node, key: &str) -> Option<&'n mut Node> {
    let Value::Table(entries) = &mut node.value else { return None };
    entries.iter_mut().find(|entry| entry.key == key).map(|entry| &mut entry.node)
}

/// Replaces a name by a path; else the problem and what was expected.
fn found(node: &mut Node, sources: &Sources) -> Result<(), (String, String)> {
    let Some(name) = node.text().filter(|name| !name.is_empty()).map(str::to_owned) else { return Ok(()) };
    let Origin::File(file) = &sources.get(node.span.source).origin else {
        let whose = match &sources.get(node.span.source).origin {
            Origin::Memory(_) => "a species in memory",
            _ => "a species that ships",
        };
        return Err((
            format!("{whose} names the picture `{name}`"),
            "no material, since no folder is beside it".into(),
        ));
    };
    let refused = |problem: String| Err((problem, BESIDE.to_owned()));
    let within = |part: Component| matches!(part, Component::Normal(_) | Component::CurDir);
    // A backslash and a colon lead out of the folder on some systems alone.
    if !FilePath::new(&name).components().all(within) || name.contains(['\\', ':']) {
        return refused(format!("the picture `{name}` would be outside the folder"));
    }
    let folder = file.parent().map_or_else(PathBuf::new, FilePath::to_path_buf);
    let picture = folder.join(&name);
    if !picture.is_file() {
        return refused(format!("there is no picture `{}`", shown(&picture)));
    }
    let whole = if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder };
    let leads_out = match (whole.canonicalize(), picture.canonicalize()) {
        (Ok(folder), Ok(picture)) => !picture.starts_with(folder),
        _ => true,
    };
    if leads_out {
        return refused(format!("the picture `{}` is a link out of the folder", shown(&picture)));
    }
    node.value = Value::Text(shown(&picture));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn material(of: Covered, order: Option<u8>, width: Option<f64>) -> Material {
        Material { of, order, texture: "a.png".to_owned(), normal: None, width_m: width.map(Constant::from) }
    }

    #[test]
    fn bark_has_a_width_and_organs_have_none() {
        let told = |list: &[Material]| faults(list).iter().map(ToString::to_string).collect::<Vec<_>>();
        assert!(told(&[material(Covered::Bark, None, Some(0.5)), material(Covered::Leaf, None, None)]).is_empty());
        assert!(
            told(&[material(Covered::Bark, Some(1), Some(0.5)), material(Covered::Bark, None, Some(0.1))]).is_empty()
        );
        for (list, expected) in [
            (vec![material(Covered::Bark, None, None)], "material[0]: bark without a width"),
            (vec![material(Covered::Bark, None, Some(0.0))], "material[0].width_m"),
            (vec![material(Covered::Fruit, None, Some(0.1))], "material[0].width_m: a width of a picture that is not"),
            (vec![material(Covered::Leaf, None, None); 2], "material[1]: a second material of the same part"),
        ] {
            let told = told(&list);
            assert!(told.len() == 1 && told[0].starts_with(expected), "{told:?}");
        }
    }
}
