//! Plants, plots and whole lives as USD: `.usda` (text), `.usdc` (binary) and `.usdz` (a package with a binary layer).
//!
//! A file has one root with the wood as a mesh, the organs as a PointInstancer or merged into a mesh, and materials, in
//! metres, Z up. A still is a plant at an age; a life has time samples, cut into spans of constant topology (`course`).
//! What is written goes through a `Layer`, of which there is one for each encoding; a new encoding is one file and
//! one line here. Memory holds two values at a time at most. The same plants give the same bytes. Absent: growing,
//! lives (`phytomer_life`), triangles of wood and forms (`phytomer_meshes`), and which file is written.

mod binary;
mod changing;
mod course;
mod covers;
mod layer;
mod models;
mod package;
mod paint;
mod parts;
mod scene;
mod skeleton;
mod still;
#[cfg(test)]
mod tests;
mod text;
mod tubes;

pub use course::Pace;
pub use covers::slots_of;
pub use phytomer_life::{Member, Organs};
pub use phytomer_meshes::Patched;
pub use scene::{Each, Planted, Stand, Take, write_scene};
pub use still::{write_levels, write_plant, write_plot, write_plot_levels};

use binary::Binary;
use course::Course;
use covers::Slotted;
use layer::{Header, Layer, Variants};
use package::Package;
use paint::Material;
use parts::Parts;
use phytomer_life::{Life, Models, StillOrgans, between};
use phytomer_meshes::{Columns, Drawing, MeshOptions, Pictures, Slot, Slots, Texture};
use phytomer_sim::plant::Kind;
use skeleton::Skeleton;
use std::io;
use text::Text;
use tubes::Tubes;

/// How a layer is encoded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Encoding {
    /// Text.
    Text,
    /// Binary.
    Binary,
    /// A package with a binary layer.
    Package,
}

/// What is written, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct Asked {
    /// The encoding.
    pub encoding: Encoding,
    /// How organs are written.
    pub organs: Organs,
    /// What the file says of itself, in words.
    pub words: String,
    /// The pictures of its materials, with the names that they have beside the file, or in a package.
    pub pictures: Pictures,
}

/// The plants of a file.
pub struct Plants<'a> {
    /// Their lives, equal ones once; of a still, lives of one age.
    pub lives: &'a [Life],
    /// The options of each life.
    pub options: &'a [MeshOptions],
    /// What stands where.
    pub members: &'a [Member],
    /// What stands among them and never changes, if anything does.
    pub obstacles: Option<&'a dyn Drawing>,
    /// What is told of each component of a single plant beside the properties of every file.
    pub columns: Option<&'a Columns<'a>>,
}

impl<'a> Plants<'a> {
    /// Plants of which nothing more is told, among nothing.
    pub fn of(lives: &'a [Life], options: &'a [MeshOptions], members: &'a [Member]) -> Self {
        Self { lives, options, members, obstacles: None, columns: None }
    }
}

/// The name of the prim at the root.
const ROOT: &str = "plant";

/// Writes plants at an age: wood as it is drawn, and the organs of lives of that one age.
fn write_still(
    asked: &Asked,
    wood: &dyn Drawing,
    (organs, columns): (&StillOrgans, Option<&Columns>),
    out: &mut dyn Patched,
) -> io::Result<()> {
    in_layer(asked, None, out, &mut |layer| put_still(layer, asked, wood, (organs, columns)))
}

/// Writes plants at an age within what is open.
fn put_still(
    layer: &mut dyn Layer,
    asked: &Asked,
    wood: &dyn Drawing,
    (organs, columns): (&StillOrgans, Option<&Columns>),
) -> io::Result<()> {
    let plants = &Plants { columns, ..Plants::of(&organs.lives, &organs.options, &organs.members) };
    let course = Course::still();
    let skeletons = skeletons(plants, &course);
    let slots = wood.slots();
    let mut slotted = Vec::new();
    if wood.counts().faces > 0 {
        slotted = still::write_mesh(layer, (ROOT, "wood", "wood"), wood, &slots)?;
    }
    write_organs(layer, (asked, slotted), (plants, &skeletons), &course, None)
}

/// Writes lives that were shown at the same ages; wood is round within a tolerance, metres.
///
/// # Errors
/// Those of `out`.
pub fn write_life(
    asked: &Asked,
    plants: &Plants,
    tolerance: f32,
    pace: &Pace,
    out: &mut dyn Patched,
) -> io::Result<()> {
    let ages = plants.lives.first().map_or(&[][..], |life| &life.ages);
    let course = Course::of(ages, plants.lives, pace);
    let ends = [ages.first(), ages.last()].map(|age| f64::from(age.copied().unwrap_or(0.0)) * pace.a_tick);
    let skeletons = skeletons(plants, &course);
    in_layer(asked, Some([ends[0], ends[1], pace.a_second]), out, &mut |layer| {
        let slots = slots_of(plants);
        let mut slotted = write_wood(layer, (plants, &skeletons), &slots, (&course, tolerance))?;
        if let Some(obstacles) = plants.obstacles {
            let own = slots.list().last().filter(|_| !slots.is_plain());
            let material = own.map_or("wood", |slot| &slot.name);
            still::write_mesh(layer, (ROOT, "obstacles", material), obstacles, &Slots::default())?;
            slotted.extend(own.cloned());
        }
        write_organs(layer, (asked, slotted), (plants, &skeletons), &course, Some(&slots))
    })
}

/// Writes the wood of lives, a mesh for each of its materials, and returns these where they are not one for all.
fn write_wood(
    layer: &mut dyn Layer,
    (plants, skeletons): (&Plants, &[Skeleton]),
    slots: &Slots,
    (course, tolerance): (&Course, f32),
) -> io::Result<Vec<Slot>> {
    if slots.is_plain() {
        let tubes = Tubes::of(skeletons, plants.members, tolerance, None);
        if !tubes.is_empty() {
            changing::write(layer, (ROOT, "wood", "wood"), &tubes, course)?;
        }
        return Ok(Vec::new());
    }
    let mut written = Vec::new();
    for (slot, of_slot) in Slotted::each(slots, plants.options).filter(|(slot, _)| slot.class == 0) {
        let tubes = Tubes::of(skeletons, plants.members, tolerance, Some(of_slot));
        if !tubes.is_empty() {
            changing::write(layer, (ROOT, &slot.name, &slot.name), &tubes, course)?;
            written.push(slot.clone());
        }
    }
    Ok(written)
}

fn skeletons<'a>(plants: &Plants<'a>, course: &'a Course) -> Vec<Skeleton<'a>> {
    plants.lives.iter().map(|life| Skeleton::of(life, course)).collect()
}

/// Told at once, and not when a whole plant has been written.
fn check_goes_back(out: &mut dyn Patched) -> io::Result<()> {
    out.patch(0, &[]).map_err(|error| {
        let told = "binary USD is put right at its beginning when it is whole, which a pipe or a device does not allow: \
                    name a file, or one that ends in .usda";
        io::Error::new(error.kind(), format!("{told} ({error})"))
    })
}

fn in_layer(
    asked: &Asked,
    time: Option<[f64; 3]>,
    out: &mut dyn Patched,
    write: &mut dyn FnMut(&mut dyn Layer) -> io::Result<()>,
) -> io::Result<()> {
    layered(asked, time, out, &mut |layer| {
        layer.begin("Xform", ROOT, &[])?;
        write(layer)?;
        layer.end()
    })
}

/// Writes the variants of the one prim at the root.
fn in_variants(
    asked: &Asked,
    variants: &Variants,
    out: &mut dyn Patched,
    write: &mut dyn FnMut(usize, &mut dyn Layer) -> io::Result<()>,
) -> io::Result<()> {
    layered(asked, None, out, &mut |layer| {
        layer.begin_varied("Xform", ROOT, variants)?;
        for (number, name) in variants.names.iter().enumerate() {
            layer.begin_variant(name)?;
            write(number, layer)?;
            layer.end()?;
        }
        layer.end()?;
        layer.end()
    })
}

fn layered(
    asked: &Asked,
    time: Option<[f64; 3]>,
    out: &mut dyn Patched,
    write: &mut dyn FnMut(&mut dyn Layer) -> io::Result<()>,
) -> io::Result<()> {
    let header = Header { root: ROOT.to_owned(), words: asked.words.clone(), time };
    if asked.encoding != Encoding::Text {
        check_goes_back(out)?;
    }
    match asked.encoding {
        Encoding::Text => whole(&mut Text::begin(out, &header)?, write),
        Encoding::Binary => whole(&mut Binary::begin(out, &header)?, write),
        Encoding::Package => {
            let mut package = Package::begin(out, "plant.usdc")?;
            whole(&mut Binary::begin(&mut package, &header)?, write)?;
            package.finish(asked.pictures.files())
        }
    }
}

fn whole(layer: &mut dyn Layer, write: &mut dyn FnMut(&mut dyn Layer) -> io::Result<()>) -> io::Result<()> {
    write(layer)?;
    layer.finish()
}

/// Writes organs, and of lives internodes that are drawn by themselves, and the materials; `slotted` are the slots of
/// the wood where it has other materials than one, and `slots` are those of lives.
fn write_organs(
    layer: &mut dyn Layer,
    (asked, mut slotted): (&Asked, Vec<Slot>),
    (plants, skeletons): (&Plants, &[Skeleton]),
    course: &Course,
    slots: Option<&Slots>,
) -> io::Result<()> {
    let models = met(plants, course);
    let (members, columns) = (plants.members, plants.columns);
    let parts = |internodes, slot| Parts { skeletons, members, models: &models, internodes, columns, slot };
    let stems = parts(true, None);
    let textured = slots.filter(|slots| !slots.is_plain());
    if slots.is_some() && !stems.is_empty() {
        // Internodes that are drawn by a form of their own have no bark, which is laid around tubes.
        let material = if textured.is_some() { "stems" } else { "wood" };
        changing::write(layer, (ROOT, "stems", material), &stems, course)?;
        slotted.extend(textured.map(|_| Slot { class: 0, name: material.to_owned(), texture: None }));
    }
    let merged = asked.organs == Organs::Merged;
    let apart = textured.filter(|_| still::are_slotted(plants.options.iter(), merged));
    for (slot, of_slot) in apart.into_iter().flat_map(|slots| Slotted::each(slots, plants.options)) {
        let parts = parts(false, Some(of_slot));
        if !parts.is_empty() {
            changing::write(layer, (ROOT, &slot.name, &slot.name), &parts, course)?;
            slotted.push(slot.clone());
        }
    }
    let parts = parts(false, None);
    let mut materials = vec![Material::plain("wood", 0.85)];
    if !slotted.is_empty() {
        materials = slotted.iter().map(Material::of).collect();
    }
    if !parts.is_empty() && apart.is_none() {
        match asked.organs {
            Organs::Instances => {
                parts.write_instances(layer, ROOT, course)?;
                materials.extend(models::kinds(&models).into_iter().map(|kind| {
                    let texture = texture_of(plants, kind).map(|texture| (texture, false));
                    Material { name: kind.tag(), roughness: 0.6, texture }
                }));
            }
            Organs::Merged => {
                changing::write(layer, (ROOT, "organs", "organs"), &parts, course)?;
                materials.push(Material::plain("organs", 0.6));
            }
        }
    }
    paint::write_materials(layer, ROOT, &asked.pictures, &materials)
}

/// What covers the organs of a kind, which is the same for all plants where they are instances.
fn texture_of<'p>(plants: &Plants<'p>, kind: Kind) -> Option<&'p Texture> {
    let textures = plants.options.first()?.own.textures();
    let texture: &Texture = &textures.list[textures.find(kind.class(), 1)?];
    Some(texture)
}

/// The models of all parts in all their colours.
fn met<'a>(plants: &Plants<'a>, course: &Course) -> Models<'a> {
    let mut models = Models::of(plants.lives, plants.options);
    for (number, life) in plants.lives.iter().enumerate() {
        for part in &life.parts {
            for state in course.states_of(&life.ages, (part.from, part.death)) {
                models.meet(number, part, between(life.tints_of_part(part), life.ages[state.age]));
            }
        }
    }
    models
}
