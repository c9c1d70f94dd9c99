//! The formats of `mesh` by the endings of their names: the one list, and what writes each.
//!
//! A new format is a line in `FORMATS`, a variant, and its two arms. Absent: how each is written
//! (`phytomer_outputs::meshes`, `phytomer_outputs::gltf` and `phytomer_outputs::usd`).

use super::super::{Misuse, out};
use phytomer_outputs::Destination;
use phytomer_outputs::gltf::{write_plant_instanced, write_plot_instanced, write_still};
use phytomer_outputs::meshes::{Drawing, MeshWriter, Obj, Pictures, PlantDrawing, PlotMesh, Ply, Scene, write_stl};
use phytomer_outputs::usd::{self, Asked, Encoding, Organs};
use std::ffi::OsStr;
use std::io::{self, Write};
use std::path::Path;

/// A format of meshes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    Ply,
    Glb(Organs),
    Stl,
    Usd(Encoding, Organs),
    Obj,
}

/// The formats, with their names and endings. A name without an ending, and stdout, get the first.
const FORMATS: [(Format, out::Format); 7] = [
    (Format::Ply, out::Format { name: "PLY", extension: "ply" }),
    (Format::Glb(Organs::Merged), out::Format { name: "GLB", extension: "glb" }),
    (Format::Stl, out::Format { name: "STL", extension: "stl" }),
    (Format::Usd(Encoding::Binary, Organs::Instances), out::Format { name: "USD", extension: "usdc" }),
    (Format::Usd(Encoding::Text, Organs::Instances), out::Format { name: "USD", extension: "usda" }),
    (Format::Usd(Encoding::Package, Organs::Instances), out::Format { name: "USD", extension: "usdz" }),
    (Format::Obj, out::Format { name: "OBJ", extension: "obj" }),
];

impl Format {
    /// The format that a name asks for.
    ///
    /// # Errors
    /// A folder; an ending of no mesh, with those that there are.
    pub fn of(path: &Path) -> Result<Self, Misuse> {
        out::check(path, "mesh", &FORMATS.map(|(_, format)| format))?;
        let asked = |(_, format): &&(Self, out::Format)| {
            path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(format.extension))
        };
        Ok(FORMATS.iter().find(asked).map_or(FORMATS[0].0, |(format, _)| *format))
    }

    /// Whether a file of it holds what an option asks for: a whole life, or a skeleton.
    pub fn holds(self, option: &str) -> bool {
        match self {
            Self::Glb(_) => ["ages", "rig"].contains(&option),
            Self::Usd(..) => option == "ages",
            Self::Ply | Self::Stl | Self::Obj => false,
        }
    }

    /// That the format cannot hold what an option asks for, with those that can.
    pub fn holds_no(self, option: &str) -> Misuse {
        let named = |(_, format): &(Self, out::Format)| format!("{} (.{})", format.name, format.extension);
        let own = FORMATS.iter().find(|(format, _)| *format == self).map_or_else(|| "USD".to_owned(), named);
        let can: Vec<String> = FORMATS.iter().filter(|(format, _)| format.holds(option)).map(named).collect();
        Misuse(format!(
            "--{option}: {own} holds a plant that stands still at one age; the formats that hold more: {}",
            can.join(", ")
        ))
    }

    /// Whether a file of it holds materials.
    pub fn holds_materials(self) -> bool {
        matches!(self, Self::Glb(_) | Self::Usd(..) | Self::Obj)
    }

    /// Writes a plant at an age; what stands beside the file has names that begin with that of `path`.
    ///
    /// # Errors
    /// Those of the files; a mesh that is larger than the format can hold.
    pub fn write_plant(self, scene: &Scene, run_seed: u64, out: &mut Destination, path: &Path) -> io::Result<()> {
        let about = scene.about(run_seed);
        let drawing = PlantDrawing { scene, about };
        match self {
            Self::Ply => Ply.write(scene, &about, out),
            Self::Glb(Organs::Merged) => write_still(&drawing, out),
            Self::Glb(Organs::Instances) => write_plant_instanced(scene, run_seed, out),
            Self::Stl => write_stl(&drawing, out),
            Self::Usd(encoding, organs) => {
                let pictures = Pictures::of(&drawing.slots(), stem(path));
                let asked = Asked { encoding, organs, words: about.in_words(), pictures };
                usd::write_plant(&asked, scene, run_seed, out)?;
                beside_usd(&asked, path)
            }
            Self::Obj => write_obj(&drawing, out, path),
        }
    }

    /// Writes levels of detail of a plant, the finest first, into one file of USD, with words about them.
    ///
    /// # Errors
    /// As [`Format::write_plant`]; a format that has a file for each level.
    pub fn write_levels(
        self,
        levels: &[Scene],
        (run_seed, told): (u64, &str),
        out: &mut Destination,
        path: &Path,
    ) -> io::Result<()> {
        let (Self::Usd(encoding, organs), Some(first)) = (self, levels.first()) else {
            return Err(io::Error::other("levels of detail are in one file in GLB and USD alone"));
        };
        let about = first.about(run_seed);
        let pictures = Pictures::of(&PlantDrawing { scene: first, about }.slots(), stem(path));
        let words = format!("{}; {told}", about.in_words());
        let asked = Asked { encoding, organs, words, pictures };
        usd::write_levels(&asked, levels, run_seed, out)?;
        beside_usd(&asked, path)
    }

    /// Writes levels of detail of the plants of a plot, the finest first, into one file of USD, with words about them.
    ///
    /// # Errors
    /// As [`Format::write_levels`].
    pub fn write_plot_levels(
        self,
        levels: &[&PlotMesh],
        told: &str,
        out: &mut Destination,
        path: &Path,
    ) -> io::Result<()> {
        let (Self::Usd(encoding, organs), Some(first)) = (self, levels.first()) else {
            return Err(io::Error::other("levels of detail are in one file in GLB and USD alone"));
        };
        let pictures = Pictures::of(&first.drawing()?.slots(), stem(path));
        let asked = Asked { encoding, organs, words: format!("{}; {told}", first.name), pictures };
        usd::write_plot_levels(&asked, levels, out)?;
        beside_usd(&asked, path)
    }

    /// Writes the plants of a plot, with its obstacles.
    ///
    /// # Errors
    /// As [`Format::write_plant`].
    pub fn write_plot(self, plot: &PlotMesh, out: &mut Destination, path: &Path) -> io::Result<()> {
        match self {
            Self::Ply => plot.write(out),
            Self::Glb(Organs::Merged) => write_still(&plot.drawing()?, out),
            Self::Glb(Organs::Instances) => write_plot_instanced(plot, out),
            Self::Stl => write_stl(&plot.drawing()?, out),
            Self::Usd(encoding, organs) => {
                let pictures = Pictures::of(&plot.drawing()?.slots(), stem(path));
                let asked = Asked { encoding, organs, words: plot.name.clone(), pictures };
                usd::write_plot(&asked, plot, out)?;
                beside_usd(&asked, path)
            }
            Self::Obj => write_obj(&plot.drawing()?, out, path),
        }
    }
}

/// The name of a file without its ending.
pub fn stem(path: &Path) -> &str {
    path.file_stem().and_then(OsStr::to_str).unwrap_or("plant")
}

/// Writes an OBJ file with its library of materials and its pictures.
fn write_obj(mesh: &dyn Drawing, out: &mut Destination, path: &Path) -> io::Result<()> {
    let (obj, library) = (Obj::of(mesh)?, format!("{}.mtl", stem(path)));
    obj.write(&library, out)?;
    let pictures = Pictures::of(&mesh.slots(), stem(path));
    beside(path, &library, &mut |file| obj.write_materials(&pictures, file))?;
    write_pictures(&pictures, path)
}

/// Writes the pictures of a USD file that is no package.
pub fn beside_usd(asked: &Asked, path: &Path) -> io::Result<()> {
    if asked.encoding == Encoding::Package { Ok(()) } else { write_pictures(&asked.pictures, path) }
}

fn write_pictures(pictures: &Pictures, path: &Path) -> io::Result<()> {
    pictures
        .files()
        .iter()
        .try_for_each(|(picture, name)| beside(path, name, &mut |file| file.write_all(&picture.bytes)))
}

/// Writes a file beside the one that is named.
fn beside(path: &Path, name: &str, fill: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let told = |error: &dyn std::fmt::Display| io::Error::other(format!("{name} beside it: {error}"));
    let mut file = Destination::create(&path.with_file_name(name)).map_err(|error| told(&error))?;
    fill(&mut file).map_err(|error| told(&error))?;
    file.finish().map(drop).map_err(|error| told(&error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_decides() {
        for (name, format) in [
            ("a.ply", Format::Ply),
            ("A.STL", Format::Stl),
            ("a.Glb", Format::Glb(Organs::Merged)),
            ("a.ply.stl", Format::Stl),
            ("a.usdc", Format::Usd(Encoding::Binary, Organs::Instances)),
            ("a.USDA", Format::Usd(Encoding::Text, Organs::Instances)),
            ("a.usdz", Format::Usd(Encoding::Package, Organs::Instances)),
            ("a.obj", Format::Obj),
            ("plain", Format::Ply),
            ("-", Format::Ply),
        ] {
            assert_eq!(Format::of(Path::new(name)).map_err(|misuse| misuse.0), Ok(format), "{name}");
        }
        let told = Format::of(Path::new("a.fbx")).expect_err("no format").0;
        assert_eq!(
            told,
            "--out a.fbx: `mesh` cannot write `.fbx`; the formats that it has: PLY (.ply), GLB (.glb), STL (.stl), \
             USD (.usdc), USD (.usda), USD (.usdz), OBJ (.obj)"
        );
    }
}
