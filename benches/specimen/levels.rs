//! Four levels of detail in a GLB file, beside the first alone.
//!
//! The plant stands; what is measured is the search for the levels and the writing of the files. Aim: at most twice the
//! processor time of the first level alone.

use super::Specimen;
use super::turns::by_turns;
use phytomer::outputs::gltf::{Level, write_levels, write_still};
use phytomer::outputs::meshes::{MeshOptions, PlantDrawing, Scene};
use phytomer::outputs::pictures::levels::levels;
use phytomer::run::regrowth::Regrowth;
use phytomer::sim::Tick;
use phytomer::sim::plant::Plant;
use serde_json::Map;
use std::hint::black_box;

/// The pairs.
const PAIRS: usize = 15;

impl Specimen {
    /// The first plant at an age: four levels beside the first alone.
    pub fn levels_of_detail(&self, age: Tick) {
        let mut plant = None;
        let shown = Regrowth::of(&self.resolved).show(0, &[age], &mut |_, shown| {
            plant = Some(shown.clone());
            Ok(())
        });
        shown.expect("a plant");
        let plant = plant.expect("a plant");
        let name = format!("{}: four levels of detail beside the first", self.name);
        by_turns(&name, PAIRS, || (), || four(&plant, age), || one(&plant, age));
    }
}

/// Writes four levels into memory.
pub fn four(plant: &Plant, age: Tick) {
    let options = MeshOptions::default();
    let found = levels(plant, age, &options, &[None; 3]).expect("levels");
    let scenes: Vec<Scene> = found.iter().map(|level| Scene::new(plant, age, &level.options)).collect();
    let drawn: Vec<PlantDrawing> = scenes.iter().map(|scene| PlantDrawing { scene, about: scene.about(0) }).collect();
    let levels: Vec<Level> =
        drawn.iter().zip(&found).map(|(mesh, level)| Level { mesh, screen: level.screen, told: Map::new() }).collect();
    let mut out = Vec::new();
    write_levels(&levels, None, &mut out).expect("memory");
    black_box(out);
}

/// Writes the first level into memory.
pub fn one(plant: &Plant, age: Tick) {
    let scene = Scene::new(plant, age, &MeshOptions::default());
    let mut out = Vec::new();
    write_still(&PlantDrawing { scene: &scene, about: scene.about(0) }, &mut out).expect("memory");
    black_box(out);
}
