//! A sample of a species, grown in memory, and whether it is what its file says that it is: a species that names an
//! `architectural_model` must have plants that qualify for it (Hallé, Oldeman & Tomlinson 1978).
//!
//! Plants are grown to the age at which the species is shown, from the default seed, so that the answer is always the same.
//! For `validate` alone: a run begins without it, because it takes longer than a start may. Absent: the qualifiers, which
//! are `phytomer-analysis`'s.

use crate::run::seed_of;
use phytomer_analysis::architecture::{Architecture, Characters, architecture, architectures};
use phytomer_config::{Report, Resolved, ResolvedSpecies};
use phytomer_outputs::rows::{PoseRow, components_of, poses_of};
use phytomer_sim::plant::Seed;
use phytomer_sim::{Ending, Plot, RecordError, Recorder, Tick, grow};

/// How many plants are looked at; more than half of them must qualify, since chance may kill or cripple some.
pub const SAMPLE: u32 = 5;

/// A plant of a sample may have so many components.
const LIMIT: u32 = 3_000_000;

/// The characters of plants `0..plants` of a scenario at its last age; of those that come to their limit, none.
///
/// # Errors
/// A plant too large for a table.
pub fn characters(resolved: &Resolved, plants: u32) -> Result<Vec<Characters>, RecordError> {
    let mut found = Vec::new();
    let (model, until) = (resolved.model.as_ref(), resolved.scenario.ages.until);
    for plant in 0..plants {
        let seed = Seed { component_limit: LIMIT, keep_events: false, ..seed_of(&resolved.scenario, plant) };
        let mut plot = Plot::of_one(model, &seed);
        plot.site = resolved.scenario.site.felt();
        let ages = if resolved.scenario.output.mechanics { resolved.scenario.ages.recorded() } else { Vec::new() };
        let mut poses = Poses { ages, rows: Vec::new() };
        if let Ending::Complete = grow(model, &mut plot, until, &mut poses)? {
            let components = components_of(&plot, &plot.plants[0], until)?;
            found.push(Characters::of(&components, &poses.rows));
        }
    }
    Ok(found)
}

/// How the internodes of a plant lie at some ages.
struct Poses {
    ages: Vec<Tick>,
    rows: Vec<PoseRow>,
}

impl Recorder for Poses {
    fn wants(&self, age: Tick) -> bool {
        self.ages.binary_search(&age).is_ok()
    }

    fn record(&mut self, age: Tick, plot: &Plot) -> Result<(), RecordError> {
        self.rows.extend(poses_of(plot, &plot.plants[0], age)?);
        Ok(())
    }
}

/// Checks that a sample of the species qualifies for the architectural model that its file names; nothing where it names
/// none.
///
/// # Errors
/// What the plants lack, at the place of the key.
pub fn check_architecture(species: ResolvedSpecies, name: &str) -> Result<(), Report> {
    let Some(model) = species.species.about.architectural_model.and_then(|model| architecture(model.word())) else {
        return Ok(());
    };
    let alone = species.clone().alone(name);
    let until = alone.scenario.ages.until;
    let plants = match characters(&alone, SAMPLE) {
        Ok(plants) if !plants.is_empty() => plants,
        _ => {
            let problem = format!("a plant grown to age {until} has more than {LIMIT} components: it cannot be judged");
            let expected = "an earlier `shown_at`, at which a plant is smaller and shows its architecture".to_owned();
            return Err(species.fault("shown_at", problem, expected, None));
        }
    };
    judge(model, &plants, until).map_err(|(problem, expected, near)| {
        species.fault("architectural_model", problem, expected, near)
    })
}

type Misfit = (String, String, Option<&'static str>);

fn judge(model: &Architecture, plants: &[Characters], until: Tick) -> Result<(), Misfit> {
    let lacking: Vec<&str> = plants.iter().filter_map(|plant| model.qualify(plant).err()).collect();
    let Some(lacks) = lacking.first().filter(|_| 2 * lacking.len() >= plants.len()) else {
        return Ok(());
    };
    let (failed, all, name) = (lacking.len(), plants.len(), model.name);
    let problem = format!("{failed} of {all} plants grown to age {until} are not of the model `{name}`");
    let expected = format!("plants of which this holds: {lacks}");
    let near = plants.first().map(architectures).and_then(|models| models.first().copied());
    Err((problem, expected, near))
}
