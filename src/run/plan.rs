//! What a scenario means for a run: its plan of tables and parts.
//!
//! Everything here follows from the scenario alone, never from the machine, so that a run can be resumed anywhere and
//! ends with the same bytes.

use super::RunError;
use super::forecast::Forecast;
use phytomer_config::{Resolved, Scenario, Treatment, Trial, scenario};
use phytomer_outputs::tables::{Factor, OfMember};
use phytomer_outputs::{Input, Provenance, RunPlan, Sample, Table};
use sha2::{Digest, Sha256};

/// The work of a part file, in components shown to a table: about 60 MB of `records`, some seconds of one core.
const WORK_A_PART: f64 = 2e6;

/// A smaller part is not worth its file, however many threads wait for work.
const LEAST_WORK_A_PART: f64 = 2.5e5;

/// Parts that even a small run is dealt into, so that it uses several threads and can be resumed.
const PARTS_OF_A_SMALL_RUN: f64 = 16.0;

/// Components of a plant of which nothing can be expected.
const UNFORESEEN: f64 = 1e4;

/// The program that the files name as their maker.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Program {
    /// Its version.
    pub version: String,
    /// The commit that it was built from; `unknown` outside a checkout.
    pub git_hash: String,
}

impl Default for Program {
    fn default() -> Self {
        Self { version: env!("CARGO_PKG_VERSION").to_owned(), git_hash: env!("PHYTOMER_GIT_HASH").to_owned() }
    }
}

/// The plan of a scenario's run.
///
/// # Errors
/// Where the scenario cannot be written as JSON, which no checked scenario can fail to be.
pub fn plan_of(resolved: &Resolved, program: &Program) -> Result<RunPlan, RunError> {
    let (scenario, trial) = (&resolved.scenario, resolved.trial());
    Ok(RunPlan {
        tables: scenario.written_tables().into_iter().map(table).collect(),
        sample: scenario.sample.and_then(|sample| Sample::of(scenario.seed, sample, scenario.plants)),
        recorded: scenario.ages.recorded(),
        until: scenario.ages.until,
        plots: trial.plots(),
        plots_per_part: plots_per_part(resolved),
        compression_level: match scenario.output.compression {
            scenario::Compression::Zstd1 => 1,
            scenario::Compression::Zstd3 => 3,
        },
        precision_m: scenario.output.float_precision_m,
        mechanics: scenario.output.mechanics || scenario.output.light,
        light: scenario.output.light,
        measured: false,
        calendars: trial.calendars().to_vec(),
        members: trial.treatments().iter().map(|treatment| members(&treatment.scenario)).collect(),
        species_of_models: trial.cohorts().iter().map(|cohort| cohort.species).collect(),
        provenance: Provenance {
            scenario: scenario.name.clone(),
            treatments: trial.treatments().iter().map(|treatment| treatment.name.clone()).collect(),
            factors: factors(&trial),
            species: resolved.all_species().iter().map(|species| species.about.name.clone()).collect(),
            states: resolved.all_species().iter().map(|species| species.model.states().to_vec()).collect(),
            ticks_per_year: resolved.all_species().iter().map(|species| species.ticks_per_year()).collect(),
            seed: scenario.seed,
            version: program.version.clone(),
            git_hash: program.git_hash.clone(),
            resolved: resolved.to_json().map_err(RunError::Scenario)?,
            inputs: inputs(resolved)?,
        },
    })
}

fn table(table: scenario::Table) -> Table {
    match table {
        scenario::Table::Components => Table::Components,
        scenario::Table::Records => Table::Records,
        scenario::Table::Events => Table::Events,
        scenario::Table::Summary => Table::Summary,
        scenario::Table::Plants => Table::Plants,
        scenario::Table::Treatments => Table::Treatments,
        scenario::Table::Site => Table::Site,
    }
}

/// What a scenario states of each member of its plots; once where it is the same of all.
fn members(scenario: &Scenario) -> Vec<OfMember> {
    let stated = scenario.stated_members();
    let of = |number: u32| OfMember {
        ground_area_m2: scenario.ground_area_m2(number),
        guard: stated.get(number as usize).is_some_and(|member| member.guard),
    };
    let all: Vec<OfMember> = (0..scenario.members()).map(of).collect();
    match all.first() {
        Some(first) if all.iter().all(|member| member == first) => vec![*first],
        _ => all,
    }
}

/// The factors of the experiment, with the level of each treatment.
fn factors(trial: &Trial) -> Vec<Factor> {
    let levels_of = |place: usize| {
        let of_treatment = |treatment: &Treatment| treatment.levels.get(place).cloned().unwrap_or_default();
        trial.treatments().iter().map(of_treatment).collect()
    };
    let factors = trial.scenario().experiment.factor.iter().enumerate();
    factors.map(|(place, factor)| Factor { name: factor.name.clone(), levels: levels_of(place) }).collect()
}

fn inputs(resolved: &Resolved) -> Result<Vec<Input>, RunError> {
    let hash = |bytes: &[u8]| Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect();
    let texts = resolved.sources.iter().map(|source| {
        let bytes = source.bytes.as_deref().unwrap_or(source.text.as_bytes());
        Input { path: source.name.clone(), sha256: hash(bytes) }
    });
    // A weather file may be read for several treatments.
    let mut inputs: Vec<Input> = Vec::new();
    texts.for_each(|input| inputs.extend(Some(input).filter(|input| !inputs.contains(input))));
    for species in resolved.all_species() {
        let own = super::forms::inputs(species)?;
        inputs.extend(own.into_iter().filter(|own| !inputs.contains(own)).collect::<Vec<_>>());
    }
    Ok(inputs)
}

/// How many plots share a part file: as many as hold the plants that the scenario says, else by the expected work of a
/// plot.
fn plots_per_part(resolved: &Resolved) -> u32 {
    let (scenario, trial) = (&resolved.scenario, resolved.trial());
    let (plots, plants) = (trial.plots(), trial.plants());
    if let Some(a_part) = scenario.output.plants_per_part {
        // Of plots of different sizes the largest are counted.
        return (a_part / trial.most_members()).clamp(1, plots.max(1));
    }
    let unforeseen = UNFORESEEN * f64::from(plants) / f64::from(plots.max(1));
    let forecast = Forecast::of(resolved).filter(|forecast| !forecast.is_loose);
    let work = forecast.map_or(unforeseen, |forecast| forecast.work_a_plot()).max(1.0);
    let in_all = work * f64::from(plots);
    let parts = (in_all / LEAST_WORK_A_PART).clamp(1.0, PARTS_OF_A_SMALL_RUN).max(in_all / WORK_A_PART);
    (f64::from(plots) / parts).ceil().max(1.0) as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use phytomer_config::Scenario;
    use phytomer_config::validate;

    fn changed(change: impl FnOnce(&mut Scenario)) -> Resolved {
        let mut resolved = validate("example1").unwrap_or_else(|report| panic!("{}", report.render(false)));
        change(&mut resolved.scenario);
        resolved
    }

    #[test]
    fn parts_have_a_fair_size_and_do_not_depend_on_the_machine() {
        let plan = |plants, a_part| {
            let resolved = changed(|scenario| {
                scenario.plants = plants;
                scenario.output.plants_per_part = a_part;
            });
            plan_of(&resolved, &Program::default()).unwrap()
        };
        assert_eq!(plan(7, Some(3)).shards(), 3);
        assert_eq!(plan(2, Some(30)).plots_per_part, 2);
        assert_eq!(plan(10, None).shards(), 1);
        let many = plan(1_000_000, None).shards();
        assert!((8..2_000).contains(&many), "{many} parts");
    }
}
