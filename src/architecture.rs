//! Whether a species is what its file says that it is: one that names an `architectural_model` must have plants that
//! qualify for it (Hallé, Oldeman & Tomlinson 1978).
//!
//! Plants are grown in memory to the age at which the species is shown, from the default seed, so that the answer is
//! always the same. For `validate` alone: a run begins without it, because it takes longer than a start may. Absent:
//! the qualifiers, which are `phytomer-analysis`'s.

use phytomer_analysis::architecture::{Architecture, Characters, architecture, architectures};
use phytomer_config::scenario::DEFAULT_SEED;
use phytomer_config::{SPECIES_ALONE_UNTIL, Species, recorded_alone};
use phytomer_models::fault::{Fault, Path};
use phytomer_outputs::rows::{PoseRow, components_of, poses_of};
use phytomer_sim::plant::Seed;
use phytomer_sim::{Ending, GrowthModel, Plot, RecordError, Recorder, Tick, grow};
use rayon::iter::{IntoParallelIterator, ParallelIterator};

/// How many plants are looked at; more than half of them must qualify, since chance may kill or cripple some.
pub const SAMPLE: u32 = 5;

/// No more plants are looked at than have about so many components: large plants average over their own parts.
const ENOUGH: u32 = 250_000;

/// A plant that is looked at may have so many components.
const LIMIT: u32 = 1_000_000;

/// The characters of the plants from 0 on at the age `until`, `plants` of them unless they are large; of those that
/// come to their limit, none.
///
/// # Errors
/// A plant that no table could hold.
pub fn characters(model: &dyn GrowthModel, until: Tick, plants: u32) -> Result<Vec<Characters>, RecordError> {
    let first = characters_of(0, model, until)?;
    let size = first.as_ref().map_or(0, |(_, components)| *components);
    let others = (1..plants.min(ENOUGH.div_ceil(size.max(1)))).into_par_iter();
    let others = others.map(|plant| characters_of(plant, model, until)).collect::<Result<Vec<_>, _>>()?;
    Ok(std::iter::once(first).chain(others).flatten().map(|(characters, _)| characters).collect())
}

/// The characters of one plant at the age `until`, and its components; nothing where it comes to its limit.
fn characters_of(plant: u32, model: &dyn GrowthModel, until: Tick) -> Result<Option<(Characters, u32)>, RecordError> {
    let seed = Seed { plant, draws: plant.into(), run_seed: DEFAULT_SEED, component_limit: LIMIT, keep_events: false };
    let mut plot = Plot::of_one(model, &seed);
    let bends = model.habit().wood.as_ref().is_some_and(|wood| wood.bends);
    let mut poses = Poses { ages: if bends { recorded_alone(until) } else { Vec::new() }, rows: Vec::new() };
    let Ending::Complete = grow(&mut plot, until, &mut poses)? else { return Ok(None) };
    let components = components_of(&plot, 0, until)?;
    Ok(Some((Characters::of(&components, &poses.rows), plot.plants[0].components())))
}

/// How the internodes of a plant lie at some ages.
struct Poses {
    ages: Vec<Tick>,
    rows: Vec<PoseRow>,
}

impl Recorder for Poses {
    fn wants(&self, tick: Tick) -> bool {
        self.ages.binary_search(&tick).is_ok()
    }

    fn record(&mut self, tick: Tick, plot: &Plot) -> Result<(), RecordError> {
        self.rows.extend(poses_of(plot, 0, tick)?);
        Ok(())
    }
}

/// What keeps a sample of the species from being of the architectural model that its file names; nothing where it names
/// none.
pub fn faults(species: &Species) -> Vec<Fault> {
    let Some(model) = species.about.architectural_model.and_then(|model| architecture(model.word())) else {
        return Vec::new();
    };
    let compiled = match species.model.compile(species.about.shown_at.unwrap_or(SPECIES_ALONE_UNTIL)) {
        Ok(compiled) => compiled,
        Err(faults) => return faults,
    };
    let until = species.shown_at(compiled.as_ref());
    match characters(compiled.as_ref(), until, SAMPLE) {
        Ok(plants) if !plants.is_empty() => misfit(model, &plants, until).into_iter().collect(),
        _ => {
            let problem =
                format!("plants grown to age {until} have more than {LIMIT} components: none can be looked at");
            let expected = "an earlier `shown_at`, at which a plant is smaller and shows its architecture";
            vec![Fault::new(&Path::root().key("architectural_model"), problem, expected)]
        }
    }
}

fn misfit(model: &Architecture, plants: &[Characters], until: Tick) -> Option<Fault> {
    let lacking: Vec<&str> = plants.iter().filter_map(|plant| model.qualify(plant).err()).collect();
    let lacks = lacking.first().filter(|_| 2 * lacking.len() >= plants.len())?;
    let (failed, all, name) = (lacking.len(), plants.len(), model.name);
    let problem = format!("{failed} of {all} plants grown to age {until} are not of the model {name}");
    let others: Vec<&str> = plants.first().map(architectures).unwrap_or_default();
    let others = if others.is_empty() { String::new() } else { format!("; the first is of {}", others.join(", ")) };
    let expected = format!("plants of which this holds: {lacks}{others}");
    Some(Fault::new(&Path::root().key("architectural_model"), problem, expected))
}
