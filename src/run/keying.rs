//! A plant, or a plot, grown once and shown at the key ages of a life in one file.
//!
//! Keys lie evenly between the first age and the last, on whole ticks, each once. Absent: the file, which is a writer's
//! (`phytomer_outputs::gltf`), and ages between ticks.

use super::RunError;
use super::picturing::obstacles_of;
use super::regrowth::{Regrowth, Whose};
use phytomer_outputs::gltf::{Body, Growth, KeyMaker, Keyed};
use phytomer_outputs::meshes::{MeshOptions, OwnForms, Tolerance};
use phytomer_sim::between::Moment;
use std::collections::BTreeMap;
use std::sync::Arc;

/// How a life is keyed.
#[derive(Debug, Clone)]
pub struct Keying {
    /// The keys, each later than the one before.
    pub ages: Vec<Moment>,
    /// How near the wood is drawn.
    pub tolerance: Tolerance,
    /// How long the animation is, seconds.
    pub seconds: f64,
    /// How finely organs are drawn.
    pub detail: u8,
}

/// Grows a plant or a plot and shows it at the keys; `forms` are those of its own that each species names.
///
/// # Errors
/// Those of growing.
pub fn keyed(regrowth: &Regrowth, whose: Whose, keying: &Keying, forms: &[Arc<OwnForms>]) -> Result<Growth, RunError> {
    let count = keying.ages.len();
    let of =
        |own: &Arc<OwnForms>| MeshOptions { own: Arc::clone(own), detail: keying.detail, ..MeshOptions::default() };
    let options: Vec<MeshOptions> = forms.iter().map(of).collect();
    let maker =
        |species: usize| KeyMaker::new(keying.tolerance, &options.get(species).cloned().unwrap_or_default(), count);
    let (bodies, name, origin) = match whose {
        Whose::Plant(plant) => {
            let (body, place) = plant_keyed(regrowth, plant, &keying.ages, &maker)?;
            (vec![body], format!("plant {plant}"), place)
        }
        Whose::Plot(plot) => {
            (plot_keyed(regrowth, plot, &keying.ages, &maker)?, format!("plot {plot}"), regrowth.plot_place(plot))
        }
    };
    Ok(Growth {
        bodies,
        ages: keying.ages.iter().map(|age| age.age() as f32).collect(),
        seconds: keying.seconds,
        tolerance: keying.tolerance.distance,
        note: format!("{name} seed {}", regrowth.trial().scenario().seed),
        origin,
    })
}

/// A plant, and its place.
fn plant_keyed(
    regrowth: &Regrowth,
    plant: u32,
    ages: &[Moment],
    maker: &dyn Fn(usize) -> KeyMaker,
) -> Result<(Body, [f64; 3]), RunError> {
    let mut maker = maker(regrowth.trial().species_of_plant(plant));
    let mut place = [0.0; 3];
    regrowth.show_at(plant, ages, &mut |age, plant| {
        place = plant.place;
        ages.binary_search(&age).into_iter().for_each(|key| maker.show(key, plant, age.tick()));
        Ok(())
    })?;
    Ok((Body { name: format!("plant {plant}"), place: [0.0; 3], keyed: maker.finish() }, place))
}

/// The plants of a plot in their places, and its obstacles.
fn plot_keyed(
    regrowth: &Regrowth,
    plot: u32,
    ticks: &[Moment],
    maker: &dyn Fn(usize) -> KeyMaker,
) -> Result<Vec<Body>, RunError> {
    let trial = regrowth.trial();
    let mut makers: BTreeMap<u32, KeyMaker> = BTreeMap::new();
    regrowth.show_plot(plot, ticks, &mut |tick, standing| {
        let Ok(key) = ticks.binary_search(&tick) else { return Ok(()) };
        for shown in standing {
            let of_plant = makers.entry(shown.plant.id).or_insert_with(|| maker(shown.species));
            of_plant.show(key, &shown.plant, shown.age);
        }
        Ok(())
    })?;
    let body = |(plant, maker): (u32, KeyMaker)| Body {
        name: format!("plant {plant}"),
        place: trial.place_in_plot(plant),
        keyed: maker.finish(),
    };
    let mut bodies: Vec<Body> = makers.into_iter().map(body).collect();
    let obstacles = obstacles_of(trial, plot);
    if !obstacles.is_empty() {
        let keyed = Keyed::still(&obstacles, ticks.len());
        bodies.push(Body { name: "obstacles".to_owned(), place: [0.0; 3], keyed });
    }
    Ok(bodies)
}
