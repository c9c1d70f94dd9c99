//! Wood at the scale of whole plants: hanging branches hang by their weight, and no trunk is too slender for its
//! height.
//!
//! The equations themselves are compared with closed forms in the tests of `sim::mechanics`. Absent: the look of
//! plants.

use phytomer_config::{Kind, Model, presets, validate_species};
use phytomer_models::buds::params::{Buds, Wood};
use phytomer_models::fault::Path;
use phytomer_sim::plant::{AxisId, EventKind, NodeId, Plant, Seed};
use phytomer_sim::site::Site;
use phytomer_sim::{Plot, Tick, grow};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use std::collections::BTreeMap;

fn buds(species: &str) -> Option<Buds> {
    match validate_species(species, 1).expect("a shipped species").species.model {
        Model::Buds(buds) => Some(buds),
        _ => None,
    }
}

fn grown(buds: &Buds, until: Tick, gravity: f64) -> Plant {
    let model = buds.compile(until, &Path::root()).expect("a shipped species compiles");
    let seed = Seed { plant: 0, draws: 0, run_seed: 1988, component_limit: u32::MAX, keep_events: true };
    let mut plot = Plot::of_one(&model, &seed);
    plot.site = Site { gravity, ..Site::default() };
    grow(&mut plot, until, &mut ()).expect("nothing is written");
    plot.plants.remove(0)
}

/// The share of the living internodes of an order that point below the horizontal.
fn hanging(plant: &Plant, order: u8) -> f64 {
    let living = |node: &usize| plant.death_of(NodeId(*node as u32)) > plant.age;
    let of_order = |node: &usize| plant.axes.order[plant.nodes.axis[*node].index()] == order;
    let twigs: Vec<usize> = (0..plant.nodes.len()).filter(living).filter(of_order).collect();
    let down = twigs.iter().filter(|&&node| plant.frames.heading[node][2] < 0.0).count();
    down as f64 / twigs.len() as f64
}

#[test]
fn the_willow_weeps_by_its_weight_and_its_slender_wood() {
    let willow = buds("willow").expect("the willow grows from buds");
    let until = 94;
    let weeping = hanging(&grown(&willow, until, 9.80665), 4);
    let weightless = hanging(&grown(&willow, until, 0.0), 4);
    let mut of_iron = willow.clone();
    of_iron.wood.as_mut().expect("it has wood").modulus_gpa = Some(phytomer_models::law::Law::from(200.0));
    let stiff = hanging(&grown(&of_iron, until, 9.80665), 4);
    assert!(weeping > 0.5, "{weeping} of its twigs hang");
    assert!(weightless < 0.25 && stiff < 0.3, "without weight {weightless}, of iron {stiff}");
}

/// The age that a shipped species is grown to where no scenario says one.
const WITHOUT_SCENARIO: Tick = 20;

/// The last age of the scenarios of each shipped species that has any.
fn last_ages() -> BTreeMap<String, Tick> {
    let mut ages = BTreeMap::new();
    for (name, _) in presets(Kind::Scenario) {
        let Ok(resolved) = phytomer_config::validate(name) else { continue };
        let age = ages.entry(resolved.scenario.species).or_insert(0);
        *age = resolved.scenario.ages.until.max(*age);
    }
    ages
}

/// Species whose stems do not carry themselves: the tomato hangs on a string, which the model does not know.
const ON_STRINGS: [&str; 1] = ["tomato"];

/// Greenhill's limit with the whole crown as its load: the stiffness that is left under load stays positive at every
/// age.
#[test]
fn the_trunk_of_every_shipped_species_stands_at_every_age() {
    let ages = last_ages();
    presets(Kind::Species).par_iter().for_each(|(name, _)| {
        let Some(mut buds) = buds(name).filter(|_| !ON_STRINGS.contains(name)) else { return };
        // Species that state no wood are given that of a birch.
        let wood = buds.wood.get_or_insert_with(Wood::default);
        wood.bends = true;
        wood.modulus_gpa.get_or_insert_with(|| 9.9.into());
        wood.density_kg_m3.get_or_insert_with(|| 900.0.into());
        let plant = grown(&buds, ages.get(*name).copied().unwrap_or(WITHOUT_SCENARIO), 9.80665);
        let events = plant.events.as_ref().expect("events are kept");
        let buckled = events.iter().find(|event| event.kind == EventKind::Buckled && event.axis == AxisId::TRUNK);
        assert_eq!(buckled, None, "{name}");
        assert!(!events.iter().any(|event| event.kind == EventKind::Unsettled), "{name}");
    });
}
