//! `mesh` of a run of measured plants: one of them, or all in their places, where they were measured, at an age at
//! which they were.
//!
//! Components have the numbers of the tables. What the file does not say of a size is drawn as `picture` draws it.
//! Absent: everything that needs a plant that grows.

use super::super::budget::in_words;
use super::super::measured::Measured;
use super::super::{Misuse, Verdict, amounts};
use super::{Format, Mesh};
use anyhow::{Context, Result};
use phytomer::run::drawing::{check_size, options_of};
use phytomer_outputs::Destination;
use phytomer_outputs::meshes::{MeshOptions, PlotBody, PlotMember, PlotMesh, Scene};
use phytomer_sim::Tick;
use phytomer_sim::plant::Plant;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The seed that the file states: nothing was drawn at random.
const NO_SEED: u64 = 0;

/// Writes the plant or the plants that are asked for.
pub fn write(mesh: &Mesh, measured: &Measured, format: Format) -> Result<Verdict> {
    refuse(mesh, measured)?;
    let age = measured.age(mesh.age)?;
    let plants = measured.plants.at(age);
    if mesh.plot.is_some() {
        all(mesh, measured, (age, &plants), format)
    } else {
        one(mesh, measured, (age, &plants), format)
    }
}

fn refuse(mesh: &Mesh, measured: &Measured) -> Result<(), Misuse> {
    let part = mesh.part.used().next();
    measured.refuse([
        ("--ages", mesh.growing.is_asked()),
        ("--rig", mesh.rig.asked().is_some()),
        ("--wind", mesh.breeze.is_stated()),
        ("--fall", mesh.fall.fall),
        ("-D", !mesh.constants.is_empty()),
        ("--range", mesh.range.is_some()),
        ("--lods", mesh.lods.asked().is_some()),
        ("--colour-by", mesh.dressing.colour_by.is_some()),
        ("--wind-data", mesh.dressing.has_wind_data()),
        (part.unwrap_or_default(), part.is_some()),
    ])
}

fn options(mesh: &Mesh) -> MeshOptions {
    let mut options = options_of(mesh.sides, &Arc::default());
    mesh.joining.dress(&mut options);
    mesh.dressing.dress_all(&mut options);
    options
}

fn one(
    mesh: &Mesh,
    measured: &Measured,
    (age, plants): (Tick, &BTreeMap<u32, Plant>),
    format: Format,
) -> Result<Verdict> {
    let plant = measured.plant(plants, mesh.plant)?;
    let what = format!("plant {} as measured at age {age}", mesh.plant);
    let mut options = options(mesh);
    mesh.settle(&what, (plant, age), &mut options)?;
    let scene = Scene::new(plant, age, &options);
    mesh.joining.has_wood(&what, [&scene])?;
    let mut file = Destination::create(&mesh.out)?;
    let written = check_size(&scene).map_err(anyhow::Error::from);
    written
        .and_then(|()| Ok(format.write_plant(&scene, NO_SEED, &mut file, &mesh.out)?))
        .with_context(|| mesh.failing())?;
    let joined = mesh.joining.in_words();
    mesh.tell(file, &format!("{what}{}{joined}", in_words(options.tolerance.as_ref())))
}

/// All plants that have places, each in its own.
fn all(
    mesh: &Mesh,
    measured: &Measured,
    (age, plants): (Tick, &BTreeMap<u32, Plant>),
    format: Format,
) -> Result<Verdict> {
    if let Some(plot) = mesh.plot.filter(|plot| *plot > 0) {
        return Err(Misuse(format!("--plot {plot}: {} has one plot, 0", measured.shown())).into());
    }
    if plants.is_empty() {
        return Err(measured.lacks(0).into());
    }
    let options = options(mesh);
    let body = |plant| PlotBody { plant, age, options: options.clone() };
    let member = |(body, number): (usize, &u32)| PlotMember {
        body,
        place: measured.plants.place(*number),
        name: match measured.plants.species(*number) {
            Some(species) => format!("plant {number} species {species}"),
            None => format!("plant {number}"),
        },
    };
    let mut all = PlotMesh {
        bodies: plants.values().map(body).collect(),
        members: plants.keys().enumerate().map(member).collect(),
        obstacles: Vec::new(),
        name: format!("measured plants age {age}"),
        place: [0.0; 3],
    };
    let what = format!("plot 0 as measured at age {age}");
    let within = mesh.tolerance(&what, |tolerance| all.faces_within(tolerance))?;
    within.iter().for_each(|tolerance| all.within(*tolerance));
    let scenes = all.bodies.iter().map(|body| Scene::new(body.plant, body.age, &body.options));
    mesh.joining.has_wood(&what, &scenes.collect::<Vec<_>>())?;
    let mut file = Destination::create(&mesh.out)?;
    format.write_plot(&all, &mut file, &mesh.out).with_context(|| mesh.failing())?;
    let without = u64::from(measured.plants.count()).saturating_sub(plants.len() as u64);
    let without = if without == 0 { String::new() } else { format!(" ({without} without places are not drawn)") };
    let (plants, joined) = (amounts::of(plants.len() as u64, "plant"), mesh.joining.in_words());
    mesh.tell(file, &format!("{what}, {plants}{without}{}{joined}", in_words(within.as_ref())))
}
