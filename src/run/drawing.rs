//! The meshes that a scenario asks for, drawn while its plants grow and registered with the shard that they belong to.
//!
//! A file belongs to the shard of its plants, so it is committed, resumed and removed with that shard's tables.
//! Absent: forms and formats, which are `phytomer_outputs::meshes`'.

use anyhow::{Context, Result, ensure};
use phytomer_config::{Resolved, Scenario};
use phytomer_outputs::Shard;
use phytomer_outputs::meshes::{MeshOptions, MeshWriter, Ply, Scene};
use phytomer_sim::plant::Plant;
use phytomer_sim::{RecordError, Tick};
use std::fs::File;
use std::path::Path;

/// The most vertices that 32-bit signed indices reach.
const MOST_VERTICES: u64 = i32::MAX as u64;

/// What is drawn of the plants of one shard.
pub struct Drawing<'a> {
    scenario: &'a Scenario,
    ages: Vec<Tick>,
    options: MeshOptions,
}

/// The mesh options of a scenario.
pub fn options_of(sides: u32) -> MeshOptions {
    MeshOptions { sides: u8::try_from(sides).unwrap_or(u8::MAX).max(3), ..MeshOptions::default() }
}

/// Writes the mesh of what stands of `plant` at `age` into a new file.
///
/// # Errors
/// Where the mesh has too many vertices for its format, or the file cannot be written.
pub fn write_mesh(plant: &Plant, age: Tick, run_seed: u64, options: &MeshOptions, path: &Path) -> Result<()> {
    let scene = Scene::new(plant, age, options);
    let vertices = scene.counts().vertices;
    ensure!(
        vertices <= MOST_VERTICES,
        "the mesh of plant {} at age {age} would have {vertices} vertices, and a mesh file holds at most {MOST_VERTICES}: \
         choose fewer sides",
        plant.id
    );
    let doing = || format!("cannot write the mesh {}", path.display());
    let mut file = File::create(path).with_context(doing)?;
    Ply.write(&scene, &scene.about(run_seed), &mut file).with_context(doing)
}

impl<'a> Drawing<'a> {
    /// What is drawn of a run; `None` where the scenario asks for no meshes.
    pub fn of(resolved: &'a Resolved) -> Option<Self> {
        let scenario = &resolved.scenario;
        let meshes = scenario.meshes.as_ref()?;
        Some(Self { scenario, ages: scenario.mesh_ages(), options: options_of(meshes.sides) })
    }

    /// Whether this plant is drawn at this age.
    pub fn wants(&self, plant: u32, age: Tick) -> bool {
        self.ages.binary_search(&age).is_ok() && self.scenario.draws(plant)
    }

    /// Draws a plant as it stands.
    ///
    /// # Errors
    /// Where its mesh cannot be written.
    pub fn draw(&self, age: Tick, plant: &Plant, shard: &mut Shard) -> Result<(), RecordError> {
        let path = shard.stage(&format!("meshes/plant-{:05}_age-{age:04}.ply", plant.id))?;
        Ok(write_mesh(plant, age, self.scenario.seed, &self.options, &path)?)
    }
}
