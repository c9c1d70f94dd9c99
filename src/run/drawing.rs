//! The meshes that a scenario asks for, drawn while its plants grow and registered with the shard that they belong to.
//!
//! A file belongs to the shard of its plants, so it is committed, resumed and removed with that shard's tables. All
//! plants at an age are therefore one file where the run has one part, and one a part where it has more.
//! Absent: forms and formats, which are `phytomer_outputs::meshes`'.

use super::RunError;
use super::regrowth::Regrowth;
use phytomer_config::scenario::{MeshFile, Meshes};
use phytomer_config::{About, Resolved, Scenario, Species};
use phytomer_outputs::Shard;
use phytomer_outputs::meshes::{Collection, MeshOptions, MeshWriter, OwnForms, Ply, Scene};
use phytomer_outputs::pictures::Subject;
use phytomer_sim::Tick;
use phytomer_sim::plant::Plant;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Write};
use std::sync::Arc;

/// The most vertices that 32-bit signed indices reach.
const MOST_VERTICES: u64 = i32::MAX as u64;

/// What is drawn of the plants of one shard.
pub struct RunMeshes<'a> {
    scenario: &'a Scenario,
    meshes: &'a Meshes,
    ages: Vec<Tick>,
    options: MeshOptions,
    parts: u32,
    /// The files that are not complete yet, by their paths in the run folder.
    open: BTreeMap<String, Collection>,
}

/// The mesh options of a scenario whose species has such forms of its own.
pub fn options_of(sides: u32, own: &Arc<OwnForms>) -> MeshOptions {
    let sides = u8::try_from(sides).unwrap_or(u8::MAX).max(3);
    MeshOptions { sides, own: Arc::clone(own), ..MeshOptions::default() }
}

/// Writes the mesh of what stands of `plant` at `age`.
///
/// # Errors
/// Where the mesh has too many vertices for its format, and those of `out`.
pub fn write_mesh(
    plant: &Plant,
    age: Tick,
    run_seed: u64,
    options: &MeshOptions,
    out: &mut (dyn Write + Send),
) -> io::Result<()> {
    let scene = Scene::new(plant, age, options);
    let vertices = scene.counts().vertices;
    if vertices > MOST_VERTICES {
        return Err(io::Error::other(format!(
            "the mesh of plant {} at age {age} would have {vertices} vertices, and a mesh file holds at most \
             {MOST_VERTICES}: choose fewer sides",
            plant.id
        )));
    }
    Ply.write(&scene, &scene.about(run_seed), out)
}

impl<'a> RunMeshes<'a> {
    /// What is drawn of a run of so many parts; `None` where the scenario asks for no meshes.
    pub fn of(resolved: &'a Resolved, own: &Arc<OwnForms>, parts: u32) -> Option<Self> {
        let scenario = &resolved.scenario;
        let meshes = scenario.meshes.as_ref()?;
        let options = options_of(meshes.sides, own);
        Some(Self { scenario, meshes, ages: scenario.mesh_ages(), options, parts, open: BTreeMap::new() })
    }

    /// Whether this plant is drawn at this age.
    pub fn wants(&self, plant: u32, age: Tick) -> bool {
        self.ages.binary_search(&age).is_ok() && self.scenario.draws(plant)
    }

    /// Draws a plant as it stands.
    ///
    /// # Errors
    /// Where its mesh cannot be written.
    pub fn draw(&mut self, age: Tick, plant: &Plant, shard: &mut Shard) -> Result<(), RunError> {
        let id = plant.id;
        match self.meshes.per {
            MeshFile::PlantAge => {
                let path = shard.stage(&format!("meshes/plant-{id:05}_age-{age:04}.ply"))?;
                let seed = self.scenario.seed;
                let written =
                    File::create(&path).and_then(|mut file| write_mesh(plant, age, seed, &self.options, &mut file));
                written.map_err(failed(&path.display().to_string()))
            }
            MeshFile::Plant => self.collect(format!("meshes/plant-{id:05}.ply"), age, plant, shard),
            MeshFile::Age if self.parts == 1 => self.collect(format!("meshes/age-{age:04}.ply"), age, plant, shard),
            MeshFile::Age => {
                let path = format!("meshes/age-{age:04}_part-{:05}.ply", shard.number());
                self.collect(path, age, plant, shard)
            }
        }
    }

    fn collect(&mut self, path: String, age: Tick, plant: &Plant, shard: &mut Shard) -> Result<(), RunError> {
        let scene = Scene::new(plant, age, &self.options);
        if !self.open.contains_key(&path) {
            let new = Collection::create(&shard.stage(&path)?).map_err(failed(&path))?;
            self.open.insert(path.clone(), new);
        }
        let Some(collection) = self.open.get_mut(&path) else { return Ok(()) };
        collection.add(&scene, &scene.about(self.scenario.seed)).map_err(failed(&path))
    }

    /// The last age of a plant is past.
    ///
    /// # Errors
    /// Where its file cannot be written.
    pub fn end_plant(&mut self) -> Result<(), RunError> {
        if self.meshes.per == MeshFile::Plant { self.finish() } else { Ok(()) }
    }

    /// Completes the files that are open.
    ///
    /// # Errors
    /// Where they cannot be written.
    pub fn finish(&mut self) -> Result<(), RunError> {
        for (path, collection) in std::mem::take(&mut self.open) {
            collection.finish().map_err(failed(&path))?;
        }
        Ok(())
    }
}

/// Tells which mesh could not be written.
fn failed(path: &str) -> impl FnOnce(io::Error) -> RunError {
    let path = path.to_owned();
    move |source| RunError::Mesh { path, source }
}

/// The plants of one picture, and what is written on it.
#[derive(Debug)]
pub struct PicturedPlants {
    /// Each plant at each age, with what is written below it.
    pub subjects: Vec<(Plant, Tick, String)>,
    /// The name of the species.
    pub title: String,
    /// What the file says of itself.
    pub note: String,
}

impl PicturedPlants {
    /// The plants as a picture takes them.
    pub fn subjects(&self) -> Vec<Subject<'_>> {
        let all = self.subjects.iter();
        all.map(|(plant, age, label)| Subject { plant, age: *age, label: label.clone() }).collect()
    }
}

/// Grows some plants again and keeps each at some ages: plant after plant, each age by age in the order asked for.
///
/// # Errors
/// Those of growing.
pub fn pictured_plants(
    regrowth: &Regrowth,
    species: &Species,
    plants: &[u32],
    ages: &[Tick],
) -> Result<PicturedPlants, RunError> {
    let about = &species.about;
    let mut subjects = Vec::new();
    for &number in plants {
        let mut seen = BTreeMap::new();
        regrowth.show(number, ages, &mut |age, plant| {
            seen.insert(age, plant.clone());
            Ok(())
        })?;
        for age in ages {
            let whose = if plants.len() > 1 { format!("plant {number}, ") } else { String::new() };
            let years = species.ticks_per_year().map(|ticks| in_years(*age, ticks)).unwrap_or_default();
            let Some(plant) = seen.get(age) else { continue };
            subjects.push((plant.clone(), *age, format!("{whose}age {age}{years}")));
        }
    }
    let title = title_of(about);
    let note = format!("{}: plants {plants:?} at the ages {ages:?} of seed {}", about.name, regrowth.scenario.seed);
    Ok(PicturedPlants { subjects, title, note })
}

/// What a species is called below its picture: by its scientific name, if it is one and no list of examples.
fn title_of(about: &About) -> String {
    let one = about.scientific_name.as_ref().filter(|name| !name.contains(", "));
    let model = || about.architectural_model.map(|model| format!("{model:?}'s model"));
    one.or(about.common_name.as_ref()).cloned().or_else(model).unwrap_or_else(|| about.name.clone())
}

/// An age in years, where a tick is not one itself.
fn in_years(age: Tick, ticks_per_year: f64) -> String {
    let years = f64::from(age) / ticks_per_year;
    match years {
        _ if (ticks_per_year - 1.0).abs() < 1e-9 => String::new(),
        years if (years - years.round()).abs() < 0.05 && (years - 1.0).abs() < 0.05 => " · 1 year".to_owned(),
        years if (years - years.round()).abs() < 0.05 => format!(" · {years:.0} years"),
        years => format!(" · {years:.1} years"),
    }
}
