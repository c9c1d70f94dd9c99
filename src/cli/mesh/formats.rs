//! The formats of `mesh` by the endings of their names: the one list, and what writes each.
//!
//! A new format is a line in `FORMATS`, a variant, and its two arms. Absent: how each is written
//! (`phytomer_outputs::meshes`, `phytomer_outputs::gltf` and `phytomer_outputs::usd`).

use super::super::{Misuse, out};
use phytomer_outputs::Destination;
use phytomer_outputs::gltf::{write_plant_instanced, write_plot_instanced, write_still};
use phytomer_outputs::meshes::{MeshWriter, PlantDrawing, PlotMesh, Ply, Scene, write_stl};
use phytomer_outputs::usd::{self, Asked, Encoding, Organs};
use std::io;
use std::path::Path;

/// A format of meshes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    Ply,
    Glb(Organs),
    Stl,
    Usd(Encoding, Organs),
}

/// The formats, with their names and endings. A name without an ending, and stdout, get the first.
const FORMATS: [(Format, out::Format); 6] = [
    (Format::Ply, out::Format { name: "PLY", extension: "ply" }),
    (Format::Glb(Organs::Merged), out::Format { name: "GLB", extension: "glb" }),
    (Format::Stl, out::Format { name: "STL", extension: "stl" }),
    (Format::Usd(Encoding::Binary, Organs::Instances), out::Format { name: "USD", extension: "usdc" }),
    (Format::Usd(Encoding::Text, Organs::Instances), out::Format { name: "USD", extension: "usda" }),
    (Format::Usd(Encoding::Package, Organs::Instances), out::Format { name: "USD", extension: "usdz" }),
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
            Self::Ply | Self::Stl => false,
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

    /// Writes a plant at an age.
    ///
    /// # Errors
    /// Those of `out`; a mesh that is larger than the format can hold.
    pub fn write_plant(self, scene: &Scene, run_seed: u64, out: &mut Destination) -> io::Result<()> {
        let about = scene.about(run_seed);
        match self {
            Self::Ply => Ply.write(scene, &about, out),
            Self::Glb(Organs::Merged) => write_still(&PlantDrawing { scene, about }, out),
            Self::Glb(Organs::Instances) => write_plant_instanced(scene, run_seed, out),
            Self::Stl => write_stl(&PlantDrawing { scene, about }, out),
            Self::Usd(encoding, organs) => {
                let asked = Asked { encoding, organs, words: about.in_words() };
                usd::write_plant(&asked, scene, run_seed, out)
            }
        }
    }

    /// Writes the plants of a plot, with its obstacles.
    ///
    /// # Errors
    /// As [`Format::write_plant`].
    pub fn write_plot(self, plot: &PlotMesh, out: &mut Destination) -> io::Result<()> {
        match self {
            Self::Ply => plot.write(out),
            Self::Glb(Organs::Merged) => write_still(&plot.drawing()?, out),
            Self::Glb(Organs::Instances) => write_plot_instanced(plot, out),
            Self::Stl => write_stl(&plot.drawing()?, out),
            Self::Usd(encoding, organs) => {
                usd::write_plot(&Asked { encoding, organs, words: plot.name.clone() }, plot, out)
            }
        }
    }
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
            ("plain", Format::Ply),
            ("-", Format::Ply),
        ] {
            assert_eq!(Format::of(Path::new(name)).map_err(|misuse| misuse.0), Ok(format), "{name}");
        }
        let told = Format::of(Path::new("a.obj")).expect_err("no format").0;
        assert_eq!(
            told,
            "--out a.obj: `mesh` cannot write `.obj`; the formats that it has: PLY (.ply), GLB (.glb), STL (.stl), \
             USD (.usdc), USD (.usda), USD (.usdz)"
        );
    }
}
