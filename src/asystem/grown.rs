//! The trees of a stage as plants: grown to a tick, turned about their main axes, with their roots at the origin.

use super::trees::Tree;
use phytomer_asystem::Colour;
use phytomer_config::scenario::DEFAULT_SEED;
use phytomer_looks::{Bark, InternodePaint, Paints};
use phytomer_models::fault::Path;
use phytomer_models::geometric::{GeometricModel, GeometricTree, TreeType};
use phytomer_sim::plant::{Habit, Plant, Seed};
use phytomer_sim::rotation::Rotation;
use phytomer_sim::{Ending, Plot, RecordError, Recorder, Tick, grow};
use std::sync::Arc;

/// The most branches, buds and leaves of a tree of a stage.
pub const MOST_COMPONENTS: u32 = 8_000_000;

/// The number of components that a tree comes to have; `None` where its numbers are wrong.
pub fn foretold(tree: &Tree) -> Option<u64> {
    let grows = tree.grows(1)?;
    let (last, tree_type) = (grows.full_grown_at(), tree.tree_type());
    Some(model(&grows, tree_type, last).ok()?.components_at(last))
}

fn model(grows: &GeometricTree, tree_type: TreeType, until: Tick) -> Result<GeometricModel, String> {
    grows.compile(tree_type, until, &Path::root()).map_err(|faults| {
        let told: Vec<String> = faults.iter().map(|fault| format!("{}: {}", fault.path, fault.problem)).collect();
        told.join("; ")
    })
}

/// A tree at a tick of so many to a growth level; the last one where the tick is beyond it.
///
/// # Errors
/// What keeps it from growing.
pub fn plant_of(tree: &Tree, steps: u32, tick: Tick) -> Result<(Plant, Tick), String> {
    let grows = tree.grows(steps).ok_or("a tree of nothing")?;
    let age = tick.min(grows.full_grown_at());
    let mut plant = grown_at(&grows, tree.tree_type(), age)?;
    turn(&mut plant, tree.segment.degrees);
    if let Some(colour) = tree.colour {
        paint(&mut plant, colour);
    }
    Ok((plant, age))
}

/// A geometric tree when it is full-grown, and its age then.
///
/// # Errors
/// What keeps it from growing.
pub fn full_grown(grows: &GeometricTree, of: TreeType) -> Result<(Plant, Tick), String> {
    let age = grows.full_grown_at();
    Ok((grown_at(grows, of, age)?, age))
}

fn grown_at(grows: &GeometricTree, of: TreeType, age: Tick) -> Result<Plant, String> {
    let model = model(grows, of, age)?;
    if model.components_at(age) > u64::from(MOST_COMPONENTS) {
        return Err(format!("it would have more than {MOST_COMPONENTS} components at age {age}"));
    }
    let seed =
        Seed { plant: 0, draws: 0, run_seed: DEFAULT_SEED, component_limit: MOST_COMPONENTS, keep_events: false };
    let mut plot = Plot::of_one(&model, &seed);
    let mut last = Last { age, plant: None };
    match grow(&mut plot, age, &mut last).map_err(|error| error.to_string())? {
        Ending::Complete => {}
        Ending::Overgrown { age, .. } => {
            return Err(format!("it has more than {MOST_COMPONENTS} components at age {age}"));
        }
    }
    last.plant.ok_or_else(|| "it does not stand".to_owned())
}

/// Keeps the plant as it stands at an age.
struct Last {
    age: Tick,
    plant: Option<Plant>,
}

impl Recorder for Last {
    fn wants(&self, age: Tick) -> bool {
        age == self.age
    }

    fn record(&mut self, _: Tick, plot: &Plot) -> Result<(), RecordError> {
        self.plant = plot.plants.first().cloned();
        Ok(())
    }
}

/// Gives all wood of a plant a colour, as a mesh shows it.
fn paint(plant: &mut Plant, colour: Colour) {
    let mut paints = Paints::of(&plant.habit).clone();
    let bark = Bark { shoot: Some(colour), young: Some(colour), old: Some(colour), ..Bark::default() };
    let paint = paints.add_internode(InternodePaint { bark, ..InternodePaint::default() });
    let mut habit = Habit::clone(&plant.habit);
    habit.looks.internodes.iter_mut().for_each(|look| look.paint = paint);
    habit.for_drawing = paints.into_habit();
    plant.habit = Arc::new(habit);
}

/// Turns a plant about the direction of its first branch, which leads through its root.
fn turn(plant: &mut Plant, degrees: f64) {
    let Some(axis) = plant.frames.heading.first().copied().filter(|_| degrees % 360.0 != 0.0) else { return };
    let rotation = Rotation::about(axis.map(f64::from), (degrees % 360.0).to_radians());
    let turned = |place: [f32; 3]| rotation.turned(place.map(f64::from)).map(|x| x as f32);
    let frames = &mut plant.frames;
    for column in [&mut frames.base, &mut frames.heading, &mut frames.up] {
        column.iter_mut().for_each(|place| *place = turned(*place));
    }
}
