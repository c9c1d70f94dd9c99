//! The meshes that a scenario asks for, drawn while its plants grow and registered with the shard that they belong to.
//!
//! A file belongs to the shard of its plants, so it is committed, resumed and removed with that shard's tables. All
//! plants at an age are therefore one file where the run has one part, and one a part where it has more.
//! Absent: forms and formats, which are `phytomer_outputs::meshes`'.

use super::RunError;
use phytomer_config::scenario::{MeshFile, Meshes};
use phytomer_config::{Scenario, Trial};
use phytomer_outputs::Shard;
use phytomer_outputs::meshes::{Collection, MeshOptions, MeshWriter, OwnForms, Ply, Scene};
use phytomer_sim::plant::Plant;
use phytomer_sim::{Plot, Tick};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Write};
use std::sync::Arc;

/// The most vertices that 32-bit signed indices reach.
const MOST_VERTICES: u64 = i32::MAX as u64;

/// What is drawn of the plants of one shard.
pub struct RunMeshes<'a> {
    scenario: &'a Scenario,
    trial: &'a Trial,
    meshes: &'a Meshes,
    ticks: Vec<Tick>,
    /// The options of each species.
    options: Vec<MeshOptions>,
    parts: u32,
    /// The files that are not complete yet, by their paths in the run folder.
    open: BTreeMap<String, Collection>,
}

/// The mesh options of a scenario whose species has such forms of its own.
pub fn options_of(sides: u32, own: &Arc<OwnForms>) -> MeshOptions {
    let sides = u8::try_from(sides).unwrap_or(u8::MAX).max(3);
    MeshOptions { sides, own: Arc::clone(own), ..MeshOptions::default() }
}

/// Writes the PLY mesh of what stands of `plant` at `age`.
fn write_mesh(
    plant: &Plant,
    age: Tick,
    run_seed: u64,
    options: &MeshOptions,
    out: &mut (dyn Write + Send),
) -> io::Result<()> {
    let scene = Scene::new(plant, age, options);
    check_size(&scene)?;
    Ply.write(&scene, &scene.about(run_seed), out)
}

/// Refuses a scene of more vertices than mesh files can index.
///
/// # Errors
/// The number of vertices, and what makes it smaller.
pub fn check_size(scene: &Scene) -> io::Result<()> {
    let vertices = scene.counts().vertices;
    if vertices > MOST_VERTICES {
        return Err(io::Error::other(format!(
            "the mesh of plant {} at age {} would have {vertices} vertices, and a mesh file holds at most \
             {MOST_VERTICES}: choose fewer sides or a larger tolerance",
            scene.plant().id,
            scene.age()
        )));
    }
    Ok(())
}

impl<'a> RunMeshes<'a> {
    /// What is drawn of a run of so many parts, whose species have such forms of their own; `None` where the scenario
    /// asks for no meshes.
    pub fn of(trial: &'a Trial, own: &[Arc<OwnForms>], parts: u32) -> Option<Self> {
        let scenario = trial.scenario();
        let meshes = scenario.meshes.as_ref()?;
        let options = own.iter().map(|own| options_of(meshes.sides, own)).collect();
        Some(Self { scenario, trial, meshes, ticks: scenario.mesh_ages(), options, parts, open: BTreeMap::new() })
    }

    /// Whether a plant of this plot is drawn at this tick.
    pub fn wants(&self, plot: u32, tick: Tick) -> bool {
        let of = self.trial.plot(plot);
        let members = self.trial.treatments()[of.treatment].scenario.members();
        self.ticks.binary_search(&tick).is_ok()
            && (0..members).any(|member| self.scenario.draws(of.first_plant + member))
    }

    /// Draws the plants of a plot that are sown and asked for, as they stand at a tick. Files are named by the tick,
    /// which is what the scenario asks for; what they say of themselves has the plant's age.
    ///
    /// # Errors
    /// Where a mesh cannot be written.
    pub fn draw(&mut self, tick: Tick, plot: &Plot, shard: &mut Shard) -> Result<(), RunError> {
        for (plant, member) in plot.plants.iter().zip(&plot.members) {
            if let (true, Some(age)) = (self.scenario.draws(plant.id), member.age_at(tick)) {
                self.draw_plant(tick, (plant, age), self.trial.cohorts()[member.species].species, shard)?;
            }
        }
        Ok(())
    }

    fn draw_plant(
        &mut self,
        tick: Tick,
        (plant, age): (&Plant, Tick),
        species: usize,
        shard: &mut Shard,
    ) -> Result<(), RunError> {
        let options = self.options.get(species).cloned().unwrap_or_default();
        let id = plant.id;
        let path = match self.meshes.per {
            MeshFile::PlantAge => {
                let path = shard.stage(&format!("meshes/plant-{id:05}_age-{tick:04}.ply"))?;
                let seed = self.scenario.seed;
                let written =
                    File::create(&path).and_then(|mut file| write_mesh(plant, age, seed, &options, &mut file));
                return written.map_err(failed(&path.display().to_string()));
            }
            MeshFile::Plant => format!("meshes/plant-{id:05}.ply"),
            MeshFile::Age if self.parts == 1 => format!("meshes/age-{tick:04}.ply"),
            MeshFile::Age => format!("meshes/age-{tick:04}_part-{:05}.ply", shard.number()),
        };
        self.collect(path, &Scene::new(plant, age, &options), shard)
    }

    fn collect(&mut self, path: String, scene: &Scene, shard: &mut Shard) -> Result<(), RunError> {
        if !self.open.contains_key(&path) {
            let new = Collection::create(&shard.stage(&path)?).map_err(failed(&path))?;
            self.open.insert(path.clone(), new);
        }
        let Some(collection) = self.open.get_mut(&path) else { return Ok(()) };
        collection.add(scene, &scene.about(self.scenario.seed)).map_err(failed(&path))
    }

    /// The last tick of a plot is past.
    ///
    /// # Errors
    /// Where its files cannot be written.
    pub fn end_plot(&mut self) -> Result<(), RunError> {
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
