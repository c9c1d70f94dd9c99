//! `mesh --wind 8 --rig 100`: a plant on a skeleton that the wind moves, as an animation that loops.
//!
//! Absent: the skeleton and its motion (`phytomer_outputs::gltf`).

use super::super::budget::in_words;
use super::super::regrown::{Breeze, Regrown};
use super::super::{Misuse, Verdict, amounts, out};
use super::Mesh;
use super::formats::Format;
use anyhow::{Context, Result};
use clap::Args;
use phytomer::run::drawing::{check_size, options_of};
use phytomer::run::regrowth::Whose;
use phytomer_outputs::Destination;
use phytomer_outputs::gltf::{MOST_JOINTS, Sway};
use phytomer_outputs::meshes::{PlantDrawing, Scene};
use phytomer_sim::mechanics::sway::GUSTS_S;

/// What belongs to a skeleton.
#[derive(Debug, Clone, Args)]
pub struct Rig {
    /// Hang the plant on a skeleton of at most so many joints along its thick axes, which sways in the wind: an
    /// animation of 8 seconds that loops. How far it is from the full solution is told.
    #[arg(long, value_name = "JOINTS", requires = "wind", conflicts_with_all = ["plot", "ages", "time", "closes"],
        value_parser = clap::value_parser!(u32).range(2..=i64::from(MOST_JOINTS)))]
    rig: Option<u32>,
}

impl Rig {
    /// The joints that are asked for.
    pub fn asked(&self) -> Option<u32> {
        self.rig
    }
}

/// Writes the plant of a mesh on a skeleton.
pub fn write(mesh: &Mesh, regrown: &Regrown, format: Format, joints: u32) -> Result<Verdict> {
    let asked = mesh.age.unwrap_or_else(|| regrown.trial.last_age_of(mesh.plant).into());
    regrown.check(("--age", &[asked.age()]), ("--plant", &[mesh.plant]))?;
    if asked.share().is_some() {
        return Err(Misuse(format!(
            "--age {}: a skeleton is that of a plant at a whole age; leave out the fraction",
            asked.age()
        ))
        .into());
    }
    let age = asked.tick();
    let Some(air) = mesh.breeze.air() else {
        return Err(Misuse(format!("--rig {joints}: a calm moves nothing; --wind must be above 0")).into());
    };
    let sways = regrown.models()[regrown.trial.cohort_of_plant(mesh.plant)].sways();
    let breeze = if sways { mesh.breeze.closing(GUSTS_S) } else { mesh.breeze.clone() };
    let windy = regrown.regrowth(&breeze)?;
    let what = format!("plant {} at age {age}", mesh.plant);
    let mut stood = None;
    regrown.regrowth(&Breeze::default())?.show(mesh.plant, &[age], &mut |_, plant| {
        stood = Sway::of(plant, age, joints).map(|sway| (plant.clone(), sway));
        Ok(())
    })?;
    let Some((plant, mut sway)) = stood else {
        return Err(Misuse(format!("--rig {joints}: {what} has no wood that a skeleton could follow")).into());
    };
    let moments = |_| Sway::moments();
    windy.show_timed(Whose::Plant(mesh.plant), &[asked], &moments, &mut |_, standing| {
        standing.iter().for_each(|standing| sway.show(&standing.plant));
        Ok(())
    })?;
    let own = regrown.forms.get(regrown.trial.species_of_plant(mesh.plant)).cloned().unwrap_or_default();
    let mut options = options_of(mesh.sides, &own);
    options.seen = mesh.part.seen(regrown.species_of(mesh.plant), age, mesh.range, true);
    mesh.dressing.dress(&mut options, regrown, &plant);
    mesh.settle(&what, (&plant, age), &mut options)?;
    let scene = Scene::new(&plant, age, &options);
    let mut file = Destination::create(&mesh.out)?;
    let wind = format!("{} m/s towards {} degrees", air.wind.speed, air.wind.towards.to_degrees());
    let drawing = PlantDrawing { scene: &scene, about: scene.about(regrown.scenario.seed) };
    let written = match format {
        Format::Glb(_) => check_size(&scene).and_then(|()| sway.write(&drawing, &wind, &mut file)),
        Format::Ply | Format::Stl | Format::Usd(..) | Format::Obj => return Err(format.holds_no("rig").into()),
    };
    written.with_context(|| mesh.failing())?;
    let bytes = amounts::bytes(file.finish()? as f64);
    let told = format!(
        "{what} in a wind of {} m/s{}, {}, at most {:.1} mm from the full solution, {bytes}",
        air.wind.speed,
        in_words(options.tolerance.as_ref()),
        amounts::of(sway.joints() as u64, "joint"),
        1000.0 * sway.farthest(),
    );
    out::tell(&mesh.out, &told)?;
    Ok(Verdict::Done)
}
