//! Measures of recorded runs as summaries: a run of so many plants whose tables stay in memory, measured as a run
//! folder is.
//!
//! One run for each age that is asked for. Only the tables that its measures read are made. A query needs a run folder,
//! which is made in the system's temporary one and removed. Absent: sizes of plants, which are read from the plants
//! themselves.

use super::summaries::{Summary, What};
use super::{COMPONENT_LIMIT, Failure, told};
use crate::run;
use phytomer_analysis::measure::{Asked, Card, measure_runs};
use phytomer_config::scenario::{Ages, Limits, Record, Table};
use phytomer_config::{Resolved, ResolvedSpecies, Species, Treatment};
use phytomer_outputs::read::Run;
use phytomer_sim::Tick;
use serde_json::json;
use std::collections::{BTreeMap, BTreeSet};

/// The runs of the ages that are asked for.
pub(super) struct Measures {
    runs: Vec<OfAge>,
}

struct OfAge {
    age: Tick,
    resolved: Resolved,
    /// The places of its summaries.
    asked: Vec<(usize, What)>,
}

impl Measures {
    /// The runs that the summaries need.
    pub fn of(species: &ResolvedSpecies, name: &str, asked: &[Summary], plants: u32) -> Self {
        let mut by_age: BTreeMap<Tick, Vec<(usize, What)>> = BTreeMap::new();
        for (place, summary) in asked.iter().enumerate() {
            if !matches!(summary.what, What::Size { .. } | What::Living) {
                by_age.entry(summary.age).or_default().push((place, summary.what.clone()));
            }
        }
        if by_age.is_empty() {
            return Self { runs: Vec::new() };
        }
        let alone = species.clone().alone(name);
        let runs = by_age.into_iter().map(|(age, asked)| OfAge::of(&alone, age, asked, plants));
        Self { runs: runs.collect() }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.runs.is_empty()
    }

    /// The measures, by the places of their summaries; those without a value are left out.
    ///
    /// # Errors
    /// A species that does not compile, and plants that grow too large.
    pub fn taken(&self, species: &Species, seed: u64) -> Result<BTreeMap<usize, f64>, Failure> {
        let mut found = BTreeMap::new();
        for of_age in &self.runs {
            of_age.taken(species, seed, &mut found)?;
        }
        Ok(found)
    }
}

impl OfAge {
    fn of(alone: &Resolved, age: Tick, asked: Vec<(usize, What)>, plants: u32) -> Self {
        let mut resolved = alone.clone();
        let scenario = &mut resolved.scenario;
        scenario.plants = plants;
        scenario.ages = Ages { until: age, record: Record::List(BTreeSet::from([age])) };
        scenario.tables = asked.iter().flat_map(|(_, what)| tables_of(what)).collect();
        scenario.limits = Limits { max_components: COMPONENT_LIMIT, ..Limits::default() };
        resolved.treatments = vec![Treatment::control(&resolved.scenario)];
        Self { age, resolved, asked }
    }

    fn taken(&self, species: &Species, seed: u64, found: &mut BTreeMap<usize, f64>) -> Result<(), Failure> {
        let mut resolved = self.resolved.clone();
        resolved.species = species.clone();
        resolved.scenario.seed = seed;
        resolved.treatments.iter_mut().for_each(|treatment| treatment.scenario.seed = seed);
        resolved.compile().map_err(|(_, faults)| Failure::Refused(told(&faults)))?;
        #[cfg(feature = "sql")]
        if self.asked.iter().any(|(_, what)| matches!(what, What::Query(_))) {
            return asked::in_folder(&resolved, |run| self.read(run, found));
        }
        let grown = run::in_memory_here(&resolved).map_err(|error| Failure::Table(error.to_string()))?;
        if let Some(overgrown) = grown.overgrown.first() {
            return Err(Failure::Overgrown(overgrown.tick));
        }
        let json = json!({"status": "complete", "until": self.age, "recorded_ages": [self.age], "seed": seed});
        self.read(&Run::in_memory("simulated", json, grown.batches), found)
    }

    fn read(&self, run: &Run, found: &mut BTreeMap<usize, f64>) -> Result<(), Failure> {
        for (place, what) in &self.asked {
            let value = value(what, run).map_err(Failure::Table)?;
            found.extend(value.map(|value| (*place, value)));
        }
        Ok(())
    }
}

/// The number that a summary is in a run.
pub(super) fn value(what: &What, run: &Run) -> Result<Option<f64>, String> {
    match what {
        What::Measure { card, group } => of_card(card, group.as_ref(), run),
        #[cfg(feature = "sql")]
        What::Query(sql) => asked::first(sql, run),
        What::Size { .. } | What::Living => Ok(None),
    }
}

fn of_card(card: &'static Card, group: Option<&(String, String)>, run: &Run) -> Result<Option<f64>, String> {
    let by = group.map(|(by, _)| by.clone());
    let measured = measure_runs(vec![run.clone()], card, &Asked { by, ..Asked::default() });
    let measured = measured.map_err(|fault| fault.to_string())?;
    Ok(measured.number(group.map(|(_, value)| value.as_str())))
}

/// Queries, which the engine asks of run folders alone.
#[cfg(feature = "sql")]
mod asked {
    use super::{Failure, Resolved, Run, run};
    use phytomer_query::{Engine, First, Settings, Stop};
    use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

    static NEXT: AtomicU64 = AtomicU64::new(0);

    /// The first number that a query gives of a run.
    pub fn first(sql: &str, run: &Run) -> Result<Option<f64>, String> {
        let engine = Engine::over(&[("simulated".to_owned(), run.clone())], &Settings::default());
        let mut rows = First::default();
        let asked = engine.and_then(|engine| engine.query(sql, &Stop::default(), &mut rows));
        asked.map(|_| rows.0).map_err(|error| error.to_string())
    }

    /// Grows a run into a folder of the system's temporary one, reads it, and removes it.
    pub fn in_folder(resolved: &Resolved, read: impl FnOnce(&Run) -> Result<(), Failure>) -> Result<(), Failure> {
        let name = format!("phytomer-simulated-{}-{}", std::process::id(), NEXT.fetch_add(1, Relaxed));
        let folder = std::env::temp_dir().join(name);
        let settings = run::Settings { threads: 1, ..run::Settings::in_folder(&folder) };
        let found = run::run(resolved, &settings, &run::Progress::default())
            .map_err(|error| Failure::Table(error.to_string()))
            .and_then(|_| Run::open(&folder).map_err(|error| Failure::Table(error.to_string())))
            .and_then(|run| read(&run));
        let _ = std::fs::remove_dir_all(&folder);
        found
    }
}

fn tables_of(what: &What) -> BTreeSet<Table> {
    let of = |table: phytomer_outputs::Table| match table {
        phytomer_outputs::Table::Records => Table::Records,
        phytomer_outputs::Table::Events => Table::Events,
        phytomer_outputs::Table::Summary => Table::Summary,
        _ => Table::Components,
    };
    match what {
        What::Measure { card, .. } => BTreeSet::from([of(card.table())]),
        #[cfg(feature = "sql")]
        What::Query(_) => BTreeSet::from([Table::Components, Table::Records, Table::Events, Table::Summary]),
        What::Size { .. } | What::Living => BTreeSet::new(),
    }
}
