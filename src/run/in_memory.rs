//! A run whose tables stay in memory, as Arrow record batches: for query engines, and for programs that bind this
//! crate.
//!
//! The batches have the rows, the schema and the metadata of the Parquet files that the same scenario writes; a batch
//! is a row group of one part. Absent: meshes, a journal, resuming and any file.

use super::{Grower, Keeper, Program, Progress, RunError, forms, in_turn, plan_of, pool};
use phytomer_config::Resolved;
use phytomer_outputs::tables::{MemoryTables, Room, TableBatches, treatments};
use phytomer_outputs::{OvergrownPlot, RunPlan, Table};
use phytomer_sim::{Ending, Plot, RecordError, Recorder, Tick};
use std::sync::Arc;

/// What a run in memory has made.
#[derive(Debug, Clone, Default)]
pub struct InMemory {
    /// The record batches of each table that the scenario asks for, in the order of its rows. A table without rows is
    /// one empty batch.
    pub batches: TableBatches,
    /// The plots that ended by a limit.
    pub overgrown: Vec<OvergrownPlot>,
}

/// Grows every plant of a scenario and keeps its tables in memory, on so many threads; 0 takes as many as the machine
/// has.
///
/// All rows are in memory at once: about 0.1 kB a row of `records` and of `components`, which
/// [`Forecast`](super::forecast::Forecast) counts beforehand. The number of threads does not change the rows, nor how
/// they are parted into batches.
///
/// ```
/// use phytomer::outputs::Table;
/// use phytomer::run::{self, Progress};
///
/// let scenario = "name = \"trial\"\nspecies = \"coffee\"\nplants = 2\nages = { until = 12, record = [6, 12] }";
/// let resolved = phytomer::config::validate_texts("trial", &[("trial", scenario)])
///     .map_err(|report| report.render(false))
///     .unwrap();
/// let run = run::in_memory(&resolved, 0, &Progress::default()).unwrap();
/// let rows: usize = run.batches[&Table::Summary].iter().map(|batch| batch.num_rows()).sum();
/// assert_eq!(rows, 4, "two plants at two ages");
/// ```
///
/// # Errors
/// [`RunError::Stopped`] where it was told to stop; a plant of more components than a table can hold; a mesh of the
/// species' own that is gone.
pub fn in_memory(resolved: &Resolved, threads: usize, progress: &Progress) -> Result<InMemory, RunError> {
    in_memory_within(resolved, threads, Room::default(), progress)
}

/// As [`in_memory`], in a bounded room.
///
/// # Errors
/// As [`in_memory`], and [`TableError::NoRoom`](phytomer_outputs::tables::TableError::NoRoom) where the tables outgrow
/// it.
pub fn in_memory_within(
    resolved: &Resolved,
    threads: usize,
    room: Room,
    progress: &Progress,
) -> Result<InMemory, RunError> {
    let (resolved, _) = forms::settled(resolved)?;
    let plan = plan_of(&resolved, &Program::default())?;
    grown(&resolved, &plan, (threads, room), progress)
}

/// As [`in_memory`], on the thread that calls it and in the pool that the thread is of: for callers that grow many
/// small runs side by side.
///
/// # Errors
/// As [`in_memory`].
pub fn in_memory_here(resolved: &Resolved) -> Result<InMemory, RunError> {
    let (resolved, _) = forms::settled(resolved)?;
    let (plan, progress) = (plan_of(&resolved, &Program::default())?, Progress::default());
    let (grower, room) = (Grower::of(&resolved, &plan, &progress), Arc::default());
    let shards: Result<Vec<InMemory>, RunError> =
        (0..plan.shards()).map(|shard| MemoryKeeper::grown(&grower, &room, shard)).collect();
    joined(shards?, &plan)
}

fn grown(
    resolved: &Resolved,
    plan: &RunPlan,
    (threads, room): (usize, Room),
    progress: &Progress,
) -> Result<InMemory, RunError> {
    progress.begin(&resolved.scenario, resolved.trial().plants().into(), plan.shards() as usize);
    let (grower, room) = (Grower::of(resolved, plan, progress), Arc::new(room));
    let all: Vec<u32> = (0..plan.shards()).collect();
    let grown = |shard| MemoryKeeper::grown(&grower, &room, shard);
    let shards = pool(threads)?.install(|| in_turn::on_all_threads(&all, grown))?;
    joined(shards, plan)
}

/// The tables of all shards, in their order.
fn joined(shards: Vec<InMemory>, plan: &RunPlan) -> Result<InMemory, RunError> {
    let mut run = InMemory::default();
    for shard in shards {
        for (table, batches) in shard.batches {
            run.batches.entry(table).or_default().extend(batches);
        }
        run.overgrown.extend(shard.overgrown);
    }
    for batches in run.batches.values_mut() {
        let first = batches.first().map(|batch| batch.slice(0, 0));
        batches.retain(|batch| batch.num_rows() > 0);
        if batches.is_empty() {
            batches.extend(first);
        }
    }
    if plan.tables.contains(&Table::Treatments) {
        let rows = treatments::batch(plan).map_err(phytomer_outputs::Error::from)?;
        run.batches.insert(Table::Treatments, vec![rows]);
    }
    Ok(run)
}

/// Shows each plot of a shard to tables in memory.
struct MemoryKeeper<'a> {
    grower: &'a Grower<'a>,
    tables: MemoryTables,
    overgrown: Vec<OvergrownPlot>,
}

impl<'a> MemoryKeeper<'a> {
    /// The tables of one shard.
    fn grown(grower: &'a Grower<'a>, room: &Arc<Room>, shard: u32) -> Result<InMemory, RunError> {
        let mut keeper = Self { grower, tables: MemoryTables::of(grower.plan, room), overgrown: Vec::new() };
        if !grower.grow_shard(shard, &mut keeper)? {
            return Err(RunError::Stopped);
        }
        let batches = keeper.tables.finish().map_err(phytomer_outputs::Error::from)?;
        Ok(InMemory { batches, overgrown: keeper.overgrown })
    }
}

impl Keeper for MemoryKeeper<'_> {
    fn begin_plot(&mut self, _plot: u32) {}

    fn end_plot(&mut self, plot: &Plot, ending: Ending) -> Result<(), RunError> {
        self.tables.end_plot(plot, &ending).map_err(phytomer_outputs::Error::from)?;
        if let Ending::Overgrown { age, limit } = ending {
            let stopped = limit.stopped.as_deref().map(str::to_owned);
            let (plant, limit) = (limit.plant, limit.limit);
            self.overgrown.push(OvergrownPlot { plot: plot.id, plant, tick: age, limit, stopped });
        }
        Ok(())
    }
}

impl Recorder for MemoryKeeper<'_> {
    fn wants(&self, age: Tick) -> bool {
        self.grower.must_make(age) || self.tables.wants(age)
    }

    fn grown(&mut self, until: Tick, plot: &Plot) -> Result<(), RecordError> {
        self.tables.grown(until, plot)
    }

    fn record(&mut self, age: Tick, plot: &Plot) -> Result<(), RecordError> {
        self.grower.progress.check()?;
        if self.tables.wants(age) {
            self.tables.record(age, plot)?;
        }
        self.grower.progress.end_age(plot, 0);
        Ok(())
    }
}
