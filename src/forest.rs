//! From a checked forest to its files: `instances.parquet`, a mesh of each variant, and `scene.usda`.
//!
//! Each variant is a plant of its species, grown with the forest's seed and its number. Each file is written beside its
//! name and renamed, and memory holds the rasters, one plant, and a row group. Absent: the file of the forest
//! (`phytomer_config::forest`), and where plants stand (`phytomer_forest`).

use crate::run::RunError;
use crate::run::drawing::{check_size, options_of};
use crate::run::forms;
use crate::run::regrowth::Regrowth;
use phytomer_config::forest::{Elevation, Forest, Raster, ResolvedForest};
use phytomer_config::{Resolved, ResolvedSpecies, Trial};
use phytomer_forest::{Count, Cover, Georeference, Heights, Planting, RasterFault, What, write_instances};
use phytomer_models::fault::{Fault, Path};
use phytomer_outputs::meshes::{Drawing, MeshOptions, Pictures, PlantDrawing, Scene, Tolerance};
use phytomer_outputs::{Destination, FileError};
use phytomer_usd::{Asked, Encoding, Organs, Planted, Stand, write_plant, write_scene};
use std::fs;
use std::io::{self, BufWriter, Read, Write};
use std::path::Path as FilePath;

/// The greatest number of plants of one species: what USD can number.
const MOST_PLANTS: f64 = 2_147_483_647.0;
/// The most bytes of a raster's file.
const MOST_BYTES: u64 = 4 << 30;
/// The most components of a variant.
const MOST_COMPONENTS: u32 = 4_000_000;
/// The sides of the tubes of a variant's mesh.
const SIDES: u32 = 8;

/// Why a forest is not written.
#[derive(Debug, thiserror::Error)]
pub enum ForestError {
    /// The rasters or the densities are wrong; paths are those of the forest's file.
    #[error("the forest is wrong")]
    Wrong(Vec<Fault>),
    /// A variant cannot be grown.
    #[error("{0} cannot be grown")]
    Variant(String, #[source] Box<RunError>),
    /// A file cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A file cannot be written to.
    #[error("cannot write {0}")]
    Write(String, #[source] io::Error),
    /// The table cannot be written.
    #[error(transparent)]
    Table(#[from] phytomer_forest::TableError),
}

/// The rasters of a forest, and how its plants are planted.
pub struct Landscape {
    cover: Cover,
    heights: Option<Heights>,
    /// Of trees and then of grasses.
    plantings: Vec<Planting>,
}

/// A species of a forest that is written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// Its name.
    pub species: String,
    /// How many of it there are.
    pub plants: u64,
    /// The files of its variants.
    pub files: Vec<String>,
}

impl Landscape {
    /// Reads the rasters of a forest.
    ///
    /// # Errors
    /// What is wrong with them, at the keys that name them.
    pub fn read(resolved: &ResolvedForest) -> Result<Self, Vec<Fault>> {
        let forest = &resolved.forest;
        let cover = cover(resolved, &forest.cover).map_err(|fault| vec![fault])?;
        let heights = forest.elevation.as_ref().map(|elevation| heights(resolved, elevation, &cover));
        let heights = heights.transpose().map_err(|fault| vec![fault])?;
        let plantings = plantings(forest);
        let many = plantings.iter().zip(paths(forest)).filter(|(planting, _)| planting.at_most(&cover) > MOST_PLANTS);
        let faults = many.map(|(planting, path)| {
            let problem = format!("there would be up to {:.0} plants", planting.at_most(&cover));
            Fault::new(&path, problem, format!("at most {MOST_PLANTS} of one species"))
        });
        let faults: Vec<Fault> = faults.collect();
        if faults.is_empty() { Ok(Self { cover, heights, plantings }) } else { Err(faults) }
    }

    /// Columns and rows of the raster.
    pub fn size(&self) -> [u32; 2] {
        self.cover.size()
    }
}

fn bytes_of(resolved: &ResolvedForest, file: &str, path: &Path) -> Result<Vec<u8>, Fault> {
    let read = || {
        let opened = fs::File::open(resolved.path_of(file))?;
        let about = opened.metadata()?;
        if !about.is_file() || about.len() > MOST_BYTES {
            return Err(io::Error::other(format!("it is no file of at most {MOST_BYTES} bytes")));
        }
        let mut bytes = Vec::new();
        opened.take(MOST_BYTES).read_to_end(&mut bytes)?;
        Ok(bytes)
    };
    read().map_err(|error| {
        Fault::new(path, format!("the raster `{file}` cannot be read: {error}"), "a file, by its path from this one")
    })
}

/// A fault of a raster at the key that names it.
fn told(file: &str, path: &Path) -> impl Fn(RasterFault) -> Fault {
    let (file, path) = (file.to_owned(), path.clone());
    move |RasterFault { at, problem, expected }| Fault::new(&path, format!("{file}, {at}: {problem}"), expected)
}

fn cover(resolved: &ResolvedForest, raster: &Raster) -> Result<Cover, Fault> {
    let path = Path::root().key("cover").key("file");
    let bytes = bytes_of(resolved, &raster.file, &path)?;
    let [west_m, south_m] = raster.corner_m;
    let stated = raster.cell_m.map(|cell_m| Georeference { cell_m, west_m, south_m });
    Cover::read(&bytes, stated).map_err(told(&raster.file, &path))
}

fn heights(resolved: &ResolvedForest, elevation: &Elevation, cover: &Cover) -> Result<Heights, Fault> {
    let path = Path::root().key("elevation").key("file");
    let bytes = bytes_of(resolved, &elevation.file, &path)?;
    let Georeference { cell_m, west_m, south_m } = cover.place();
    let [west_m, south_m] = elevation.corner_m.unwrap_or([west_m, south_m]);
    let stated = Georeference { cell_m: elevation.cell_m.unwrap_or(cell_m), west_m, south_m };
    let read = Heights::read(&bytes, Some(stated), elevation.scale_m, elevation.offset_m);
    let heights = read.map_err(told(&elevation.file, &path))?;
    let place = cover.place();
    if heights.covers([place.west_m, place.south_m], cover.far_edges()) {
        return Ok(heights);
    }
    let problem = format!("{} does not reach over the whole cover", elevation.file);
    Err(Fault::new(&path, problem, "heights of every cell of the cover: see `cell_m` and `corner_m`"))
}

fn plantings(forest: &Forest) -> Vec<Planting> {
    let seed = forest.seed;
    let trees = forest.tree.iter().map(|tree| Planting {
        what: What::Tree(tree.bit),
        count: tree.trees_ha.map_or(Count::One, |density| Count::PerSquareMetre(density / 10_000.0)),
        variants: tree.variants,
        scale: tree.scale,
        seed,
    });
    let grasses = forest.grass.iter().map(|grass| Planting {
        what: What::Grass(grass.number),
        count: Count::PerSquareMetre(grass.tufts_m2),
        variants: grass.variants,
        scale: grass.scale,
        seed,
    });
    trees.chain(grasses).collect()
}

/// The path of each species' table in the file of the forest.
fn paths(forest: &Forest) -> impl Iterator<Item = Path> {
    let trees = (0..forest.tree.len()).map(|place| Path::root().key("tree").index(place));
    trees.chain((0..forest.grass.len()).map(|place| Path::root().key("grass").index(place)))
}

/// Writes a forest into a folder; `say` hears of each file before it is written.
///
/// # Errors
/// Where a variant cannot be grown, or a file not be written.
pub fn write(
    resolved: &ResolvedForest,
    landscape: &Landscape,
    folder: &FilePath,
    tolerance: Option<Tolerance>,
    say: &mut dyn FnMut(&str),
) -> Result<Vec<Written>, ForestError> {
    let meshes = folder.join("meshes");
    fs::create_dir_all(&meshes).map_err(|error| ForestError::Write(meshes.display().to_string(), error))?;
    let mut stands = Vec::new();
    for (number, species) in resolved.species.iter().enumerate() {
        let planting = &landscape.plantings[number];
        let age = resolved.forest.mentions().nth(number).and_then(|(_, age)| age);
        let variants = Variants { species, planting, age, tolerance };
        stands.push(variants.write(folder, say)?);
    }
    say("instances.parquet");
    let named: Vec<(&str, Planting)> = resolved
        .species
        .iter()
        .zip(&landscape.plantings)
        .map(|(species, planting)| (species.species.about.name.as_str(), *planting))
        .collect();
    let mut file = Destination::create(&folder.join("instances.parquet"))?;
    let version = env!("CARGO_PKG_VERSION");
    let counts = write_instances(&landscape.cover, landscape.heights.as_ref(), &named, version, &mut file)?;
    file.finish()?;
    say("scene.usda");
    write_stands(resolved, landscape, folder, &stands)?;
    let written = named.iter().zip(counts).zip(stands).map(|(((species, _), plants), stand)| Written {
        species: (*species).to_owned(),
        plants,
        files: stand.files,
    });
    Ok(written.collect())
}

/// `scene.usda`: places are told from the corner of the raster, so that single precision holds them.
fn write_stands(
    resolved: &ResolvedForest,
    landscape: &Landscape,
    folder: &FilePath,
    stands: &[Stand],
) -> Result<(), ForestError> {
    let path = folder.join("scene.usda");
    let mut file = Destination::create(&path)?;
    let place = landscape.cover.place();
    let corner = [place.west_m, place.south_m, 0.0];
    let words = format!("{}: places are told from x {} m, y {} m", resolved.forest.name, corner[0], corner[1]);
    let mut each = |number: usize, take: &mut phytomer_usd::Take<'_>| {
        landscape.plantings[number].each(&landscape.cover, landscape.heights.as_ref(), |instance| {
            let place_m = [0, 1, 2].map(|axis| (instance.place_m[axis] - corner[axis]) as f32);
            let (variant, turn_rad, scale) = (instance.variant, instance.turn_rad, instance.scale as f32);
            take(Planted { variant, place_m, turn_rad, scale })
        })
    };
    let mut buffered = BufWriter::with_capacity(1 << 16, &mut file);
    let written = write_scene(&mut buffered, &words, stands, &mut each).and_then(|()| buffered.flush());
    drop(buffered);
    written.map_err(|error| ForestError::Write(path.display().to_string(), error))?;
    file.finish()?;
    Ok(())
}

/// Writes the pictures of a mesh beside it.
fn write_pictures(pictures: &Pictures, folder: &FilePath) -> Result<(), ForestError> {
    for (picture, name) in pictures.files() {
        let path = folder.join(name);
        let mut file = Destination::create(&path)?;
        let written = file.write_all(&picture.bytes);
        written.map_err(|error| ForestError::Write(path.display().to_string(), error))?;
        file.finish()?;
    }
    Ok(())
}

/// The variants of a species.
struct Variants<'a> {
    species: &'a ResolvedSpecies,
    planting: &'a Planting,
    age: Option<u32>,
    tolerance: Option<Tolerance>,
}

impl Variants<'_> {
    /// Grows and writes each of them.
    fn write(&self, folder: &FilePath, say: &mut dyn FnMut(&str)) -> Result<Stand, ForestError> {
        let name = self.species.species.about.name.clone();
        let failed = |error: RunError| ForestError::Variant(name.clone(), Box::new(error));
        let age = self.age.unwrap_or_else(|| self.species.shown_at()).max(1);
        let alone = self.species.clone().alone(&name);
        let Resolved { mut scenario, species, .. } = alone;
        scenario.ages.until = age;
        scenario.plants = self.planting.variants;
        scenario.seed = self.planting.seed;
        scenario.limits.max_components = MOST_COMPONENTS;
        let model = species.model.compile(age).map_err(ForestError::Wrong)?;
        let own = forms::of(&species).map_err(failed)?;
        let options = MeshOptions { tolerance: self.tolerance, ..options_of(SIDES, &own) };
        let regrowth = Regrowth::new(Trial::of(&scenario, &[]), vec![model.as_ref()], None);
        let mut files = Vec::new();
        for variant in 0..self.planting.variants {
            let file = format!("meshes/{}_{variant}.usdc", self.file_name(&name));
            say(&file);
            let mut out = Destination::create(&folder.join(&file))?;
            let mut asked = Asked {
                encoding: Encoding::Binary,
                organs: Organs::Merged,
                words: format!("{name}, variant {variant} at age {age}"),
                pictures: Pictures::default(),
            };
            let shown = regrowth.show(variant, &[age], &mut |age, plant| {
                let scene = Scene::new(plant, age, &options);
                check_size(&scene)?;
                let drawing = PlantDrawing { scene: &scene, about: scene.about(scenario.seed) };
                asked.pictures = Pictures::of(&drawing.slots(), &self.file_name(&name));
                write_plant(&asked, &scene, scenario.seed, &mut out)?;
                Ok(())
            });
            shown.map_err(failed)?;
            out.finish()?;
            write_pictures(&asked.pictures, &folder.join("meshes"))?;
            files.push(file);
        }
        Ok(Stand { name, files })
    }

    /// A name that no other species of the forest has.
    fn file_name(&self, name: &str) -> String {
        let plain: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
        match self.planting.what {
            What::Tree(bit) => format!("tree_{bit}_{plain}"),
            What::Grass(number) => format!("grass_{number}_{plain}"),
        }
    }
}
