//! A forest: a raster of what grows where, the species that its bits stand for, and how they are planted (Weber & Penn
//! 1995 §6).
//!
//! [`forest`] reads and checks the file with all its species. Absent: the rasters themselves (`phytomer_forest`), whose
//! faults are told at the keys that name them ([`ResolvedForest::report`]).

use std::collections::BTreeSet;
use std::path::{Path as FilePath, PathBuf};
use std::sync::OnceLock;

use phytomer_law::fault::{self, Path};
use phytomer_models::parameters::{Keys, Surroundings};
use phytomer_sim::clock::LAST_TICK;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value as Json;

use crate::about::About;
use crate::document::Node;
use crate::library::Kind;
use crate::load::{Loader, Mention};
use crate::report::Report;
use crate::resolved::placed;
use crate::schema;
use crate::source::{Origin, Sources};
use crate::species_of_run::check_species;
use crate::validate::{ResolvedSpecies, SPECIES_ALONE_UNTIL};

/// A forest as its file states it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Forest {
    /// The name of the forest.
    #[schemars(length(min = 1))]
    pub name: String,
    /// What it is.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub description: String,
    /// The seed of all plants and places.
    #[serde(default)]
    #[schemars(range(min = 0, max = 9_223_372_036_854_775_807_u64))]
    pub seed: u64,
    /// What grows where: 16 bits a cell.
    pub cover: Raster,
    /// The height of the ground; 0 if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Elevation")]
    pub elevation: Option<Elevation>,
    /// The trees, each with a bit of its own.
    #[serde(default)]
    pub tree: Vec<Tree>,
    /// The grasses, each with a number of its own.
    #[serde(default)]
    pub grass: Vec<Grass>,
}

/// A raster, and where its cells lie where its file does not say so.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Raster {
    /// The file: PNG or PGM of 16 bits, or an ESRI ASCII grid; beside this file, or by its path from there.
    #[schemars(length(min = 1))]
    pub file: String,
    /// The side of a cell, metres. An ASCII grid states its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", extend("exclusiveMinimum" = 0, "maximum" = 1_000_000))]
    pub cell_m: Option<f64>,
    /// The x and the y of the south-western corner, metres; 0 if not given.
    #[serde(default)]
    #[schemars(inner(range(min = -1e9, max = 1e9)))]
    pub corner_m: [f64; 2],
}

/// A raster of heights: number × `scale_m` + `offset_m`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Elevation {
    /// The file, as that of the cover.
    #[schemars(length(min = 1))]
    pub file: String,
    /// The side of a cell, metres; that of the cover if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", extend("exclusiveMinimum" = 0, "maximum" = 1_000_000))]
    pub cell_m: Option<f64>,
    /// The x and the y of the south-western corner, metres; those of the cover if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "[f64; 2]", inner(range(min = -1e9, max = 1e9)))]
    pub corner_m: Option<[f64; 2]>,
    /// The metres that the number 1 stands for.
    #[serde(default = "one")]
    #[schemars(range(min = -1e6, max = 1e6))]
    pub scale_m: f64,
    /// The metres that the number 0 stands for.
    #[serde(default)]
    #[schemars(range(min = -1e6, max = 1e6))]
    pub offset_m: f64,
}

/// What stands in the cells that have a bit or a number.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Tree {
    /// Its bit, from 0.
    #[schemars(range(max = 13))]
    pub bit: u8,
    /// How many stand on a hectare, in the mean; one in each cell if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "f64", extend("exclusiveMinimum" = 0, "maximum" = 1_000_000))]
    pub trees_ha: Option<f64>,
    /// The species: a shipped one by its name, or a file by its path from this file.
    #[schemars(length(min = 1))]
    pub species: String,
    /// The age at which it is shown, ticks; that of its species if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "u32", range(min = 1, max = 65_535))]
    pub age: Option<u32>,
    /// The number of its variants, each with a seed of its own.
    #[serde(default = "a_few")]
    #[schemars(range(min = 1, max = 1000))]
    pub variants: u32,
    /// The least and the greatest size over that of the variant.
    #[serde(default = "as_grown")]
    #[schemars(inner(range(min = 0.001, max = 1000)))]
    pub scale: [f64; 2],
}

/// Tufts of a grass.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Grass {
    /// Its number: bits 14 and 15 of a cell.
    #[schemars(range(min = 1, max = 3))]
    pub number: u8,
    /// How many tufts stand on a square metre, in the mean.
    #[serde(default = "a_tuft")]
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 10_000))]
    pub tufts_m2: f64,
    /// The species, as that of a tree.
    #[schemars(length(min = 1))]
    pub species: String,
    /// The age at which it is shown, ticks; that of its species if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "u32", range(min = 1, max = 65_535))]
    pub age: Option<u32>,
    /// The number of its variants.
    #[serde(default = "a_few")]
    #[schemars(range(min = 1, max = 1000))]
    pub variants: u32,
    /// The least and the greatest size over that of the variant.
    #[serde(default = "as_grown")]
    #[schemars(inner(range(min = 0.001, max = 1000)))]
    pub scale: [f64; 2],
}

fn one() -> f64 {
    1.0
}

fn a_tuft() -> f64 {
    1.0
}

fn a_few() -> u32 {
    3
}

fn as_grown() -> [f64; 2] {
    [1.0, 1.0]
}

impl Forest {
    /// The species and the ages of trees and then of grasses.
    pub fn mentions(&self) -> impl Iterator<Item = (&str, Option<u32>)> {
        let trees = self.tree.iter().map(|tree| (tree.species.as_str(), tree.age));
        trees.chain(self.grass.iter().map(|grass| (grass.species.as_str(), grass.age)))
    }

    fn faults(&self) -> Vec<fault::Fault> {
        let mut faults = Vec::new();
        let mut tell = |path: Path, problem: String, expected: &str| {
            faults.push(fault::Fault::new(&path, problem, expected));
        };
        if self.tree.is_empty() && self.grass.is_empty() {
            tell(Path::root(), "the forest has no plants".to_owned(), "a `[[tree]]` or a `[[grass]]`");
        }
        let (mut bits, mut numbers) = (BTreeSet::new(), BTreeSet::new());
        for (place, tree) in self.tree.iter().enumerate() {
            let path = Path::root().key("tree").index(place);
            if !bits.insert(tree.bit) {
                tell(path.key("bit"), format!("a second tree has the bit {}", tree.bit), "a bit of its own");
            }
            if tree.scale[0] > tree.scale[1] {
                tell(path.key("scale"), "the least size is above the greatest".to_owned(), "[least, greatest]");
            }
        }
        for (place, grass) in self.grass.iter().enumerate() {
            let path = Path::root().key("grass").index(place);
            if !numbers.insert(grass.number) {
                tell(path.key("number"), format!("a second grass has the number {}", grass.number), "one of its own");
            }
            if grass.scale[0] > grass.scale[1] {
                tell(path.key("scale"), "the least size is above the greatest".to_owned(), "[least, greatest]");
            }
        }
        faults
    }
}

/// A forest whose species are ready to grow.
#[derive(Debug, Clone)]
pub struct ResolvedForest {
    /// The forest.
    pub forest: Forest,
    /// The species of its trees and then of its grasses.
    pub species: Vec<ResolvedSpecies>,
    folder: PathBuf,
    sources: Sources,
    tree: Node,
}

impl ResolvedForest {
    /// The path of a file that the forest names.
    pub fn path_of(&self, file: &str) -> PathBuf {
        self.folder.join(file)
    }

    /// A report of faults that were found later, as of a raster; their paths start at the top of the file.
    pub fn report(&self, faults: Vec<fault::Fault>) -> Report {
        placed(&self.sources, &self.tree, faults)
    }
}

/// Reads and checks the file of a forest and its species.
///
/// # Errors
/// A [`Report`] with every fault of the file and of its species.
pub fn forest(path: &str) -> Result<ResolvedForest, Report> {
    let mut loader = Loader::default();
    let found = check(&mut loader, path);
    match found {
        Some(found) if loader.faults.is_empty() => Ok(ResolvedForest { sources: loader.sources, ..found }),
        _ => Err(Report::new(loader.sources, loader.faults)),
    }
}

/// The JSON Schema of the file of a forest.
pub fn forest_schema() -> &'static Json {
    static SCHEMA: OnceLock<Json> = OnceLock::new();
    SCHEMA.get_or_init(schema::of_type::<Forest>)
}

fn check(loader: &mut Loader, path: &str) -> Option<ResolvedForest> {
    let source = loader.find(Kind::Scenario, &Mention { name: path.to_owned(), place: None })?;
    let folder = match &source.origin {
        Origin::File(file) => file.parent().unwrap_or(FilePath::new("")).to_path_buf(),
        _ => PathBuf::new(),
    };
    let (_, node) = loader.parse(source);
    let node = node?;
    let mut refused = Vec::new();
    schema::check(forest_schema(), &node, &mut refused);
    let forest: Option<Forest> = loader.read(&node, &Keys::PLAIN, &refused, serde_path_to_error::deserialize);
    let is_whole = refused.is_empty();
    loader.faults.extend(refused);
    let forest = forest?;
    if is_whole {
        loader.tell(&node, forest.faults());
    }
    let mut species = Vec::new();
    let places =
        |key: &str, count: usize| (0..count).map(|place| Path::root().key(key).index(place)).collect::<Vec<_>>();
    let paths = [places("tree", forest.tree.len()), places("grass", forest.grass.len())].concat();
    for ((name, age), path) in forest.mentions().zip(paths) {
        let path = path.key("species");
        let mention = Mention { name: name.to_owned(), place: Some((node.locate(&path), path)) };
        let until = |about: Option<&About>| {
            let shown = about.and_then(|about| about.shown_at).unwrap_or(1).max(SPECIES_ALONE_UNTIL);
            age.unwrap_or(shown).clamp(1, LAST_TICK)
        };
        let found = check_species(loader, &mention, until, &Surroundings::default());
        species.extend(found.map(|found| ResolvedSpecies::of(found, &loader.sources)));
    }
    Some(ResolvedForest { forest, species, folder, sources: Sources::default(), tree: node })
}
