//! A run: from a scenario to its run folder, or to its tables in memory.
//!
//! The plots are dealt into shards of neighbours. Each shard sows its plots one after another into the same columns,
//! grows each to the last tick, shows it to the tables and the meshes at the ticks asked for, and commits its files;
//! shards grow in parallel, and so do the plants of a plot. A draw depends on the run's seed and the plant alone, so
//! neither the number of threads nor an interruption shows in a single byte.
//!
//! Absent: growth (`sim`, `models`), files (`outputs`), and everything that a person sees (`cli`).

mod captions;
pub mod disk;
pub mod drawing;
mod error;
mod field;
pub mod filming;
pub mod forecast;
pub mod forms;
mod in_memory;
mod in_turn;
pub mod keying;
pub mod living;
pub mod measured;
mod moving;
pub mod picturing;
mod plan;
pub mod plots;
mod progress;
pub mod regrowth;
pub mod viewing;

pub use error::RunError;
pub use in_memory::{InMemory, in_memory, in_memory_here, in_memory_within};
pub use plan::{Program, plan_of};
pub use plots::{component_limit, seed_of};
pub use progress::{Progress, Reading};

use drawing::RunMeshes;
use phytomer_config::{Resolved, Trial};
use phytomer_outputs::meshes::OwnForms;
use phytomer_outputs::{
    Checkup, FreeSpace, Mode, Opening, RunFolder, RunPlan, RunReport, Shard, ShardReport, Share, SystemSpace, WaitFor,
};
use phytomer_sim::plant::ThreadBudget;
use phytomer_sim::{Ending, Plot, RecordError, Recorder, Tick, grow};
use plots::Plots;
use rayon::ThreadPool;
use serde::Serialize;
use std::borrow::Cow;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

/// How a run is made, beside what its scenario says. Of all this only the name of the program is in the bytes of tables
/// and meshes.
#[derive(Debug, Clone)]
pub struct Settings {
    /// The run folder.
    pub folder: PathBuf,
    /// What to do where the folder holds files already.
    pub mode: Mode,
    /// The number of threads; it never changes the result. 0 takes as many as the machine has.
    pub threads: usize,
    /// The program that the files name as their maker.
    pub program: Program,
    /// What tells the free space of the disk: the system, or a test.
    pub space: Arc<dyn FreeSpace>,
    /// Whether a run begins that the disk seems too small for.
    pub ignore_disk: bool,
    /// The share of the run that is grown, to be merged with the others later; `None` grows the whole run.
    pub share: Option<Share>,
}

impl Settings {
    /// A new run in `folder`, on every thread of the machine.
    pub fn in_folder(folder: impl Into<PathBuf>) -> Self {
        Self {
            folder: folder.into(),
            mode: Mode::New,
            threads: 0,
            program: Program::default(),
            space: Arc::new(SystemSpace),
            ignore_disk: false,
            share: None,
        }
    }
}

/// What came of a run.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// What was written; of an interrupted run the shards of this start alone.
    pub report: RunReport,
    /// How many shards the run has; of a share of it, how many that share has.
    pub shards: u32,
    /// How many of them are on the disk.
    pub committed: u32,
    /// How many of them this start has grown.
    pub grown_now: u32,
    /// Components of the plants that this start has grown.
    pub components_now: u64,
    /// How long it took, seconds.
    pub seconds: f64,
    /// How long its threads waited for the writer.
    pub waited: Waited,
}

/// The shares of the time of all threads of a run in which they waited for the writer, in [0, 1].
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Waited {
    /// For columns that other threads encode.
    pub columns: f64,
    /// For the disk, at the end of each part.
    pub disk: f64,
}

impl Waited {
    fn of(folder: &RunFolder, threads_seconds: f64) -> Self {
        let share = |what| folder.waited(what).as_secs_f64() / threads_seconds.max(1e-9);
        Self { columns: share(WaitFor::Columns), disk: share(WaitFor::Disk) }
    }
}

impl Outcome {
    /// Whether the run was stopped before its end; `Mode::Resume` goes on with it.
    pub fn is_interrupted(&self) -> bool {
        self.committed < self.shards
    }
}

/// Grows every plant of a scenario and writes the run folder.
///
/// # Errors
/// [`RunError`]: as [`begin`], and where a file cannot be written.
pub fn run(resolved: &Resolved, settings: &Settings, progress: &Progress) -> Result<Outcome, RunError> {
    begin(resolved, settings, progress)?.grow(progress)
}

/// A run whose folder is ready, before its first tick.
pub struct Begun<'a> {
    resolved: Cow<'a, Resolved>,
    forms: Vec<Arc<OwnForms>>,
    folder: RunFolder,
    pool: ThreadPool,
    start: Instant,
}

/// Makes the run folder ready, or looks at what an earlier start has left in it.
///
/// # Errors
/// Where a file cannot be written, where the folder holds another run or another process fills it, or where the disk is
/// too small ([`disk::TooSmall`]).
pub fn begin<'a>(resolved: &'a Resolved, settings: &Settings, progress: &Progress) -> Result<Begun<'a>, RunError> {
    let start = Instant::now();
    let (resolved, forms) = forms::settled(resolved)?;
    let plan = plan_of(&resolved, &settings.program)?;
    let pool = pool(settings.threads)?;
    disk::check(&resolved, settings, disk::there(settings)?)?;
    let folder = pool.install(|| open(plan, settings, progress))?;
    Ok(Begun { resolved, forms, folder, pool, start })
}

fn open(plan: RunPlan, settings: &Settings, progress: &Progress) -> Result<RunFolder, phytomer_outputs::Error> {
    let opening = Opening { checking: progress.checking(), space: Arc::clone(&settings.space), share: settings.share };
    RunFolder::open(&settings.folder, plan, settings.mode, &opening)
}

impl Begun<'_> {
    /// What a resumed run found in its folder, before it removed what is left over and forgot what is damaged.
    pub fn found(&self) -> Option<&Checkup> {
        self.folder.found()
    }

    /// Why another run in the same folder would not be noticed, if it would not.
    pub fn unlockable(&self) -> Option<&str> {
        self.folder.unlockable()
    }

    /// Grows the plants of all shards that are missing.
    ///
    /// # Errors
    /// Where a file cannot be written.
    pub fn grow(self, progress: &Progress) -> Result<Outcome, RunError> {
        let Self { resolved, forms, folder, pool, start } = self;
        let shards = folder.own_shards().count() as u32;
        let missing = folder.missing_shards();
        let trial = resolved.trial();
        let plants = missing.iter().map(|shard| plants_in(&trial, folder.plan().plots_of(*shard))).sum();
        progress.begin(&resolved.scenario, plants, missing.len());
        let grown = pool.install(|| grow_shards(&resolved, &forms, &folder, &missing, progress))?;
        let seconds = start.elapsed().as_secs_f64();
        let components_now = grown.iter().map(|shard| shard.components).sum();
        let grown_now = grown.len() as u32;
        let committed = shards - missing.len() as u32 + grown_now;
        let report = if committed == shards {
            folder.finish(&[("growing_and_writing", seconds)])?
        } else {
            RunReport::of(&grown)
        };
        let waited = Waited::of(&folder, seconds * pool.current_num_threads() as f64);
        Ok(Outcome { report, shards, committed, grown_now, components_now, seconds, waited })
    }
}

/// A pool of so many threads, apart from any that the caller may have.
fn pool(threads: usize) -> Result<ThreadPool, RunError> {
    let builder = rayon::ThreadPoolBuilder::new().num_threads(threads).thread_name(|i| format!("grow-{i}"));
    builder.build().map_err(RunError::Threads)
}

/// The number of plants in a range of plots.
fn plants_in(trial: &Trial, plots: Range<u32>) -> u64 {
    let before = |plot: u32| if plot < trial.plots() { trial.plot(plot).first_plant } else { trial.plants() };
    u64::from(before(plots.end) - before(plots.start))
}

/// The shards that were committed; fewer than `missing` after a stop.
fn grow_shards(
    resolved: &Resolved,
    forms: &[Arc<OwnForms>],
    folder: &RunFolder,
    missing: &[u32],
    progress: &Progress,
) -> Result<Vec<ShardReport>, RunError> {
    let grower = Grower::of(resolved, folder.plan(), progress);
    let grow = |shard: u32| {
        let meshes = RunMeshes::of(grower.plots.trial(), forms, folder.plan().shards());
        let mut keeper = FolderKeeper { grower: &grower, folder, shard: folder.shard(shard)?, meshes, plot: 0 };
        Ok(if grower.grow_shard(shard, &mut keeper)? { Some(keeper.commit()?) } else { None })
    };
    // A failed write ends the run: the other shards need not go on.
    let grown = in_turn::on_all_threads(missing, |shard| grow(shard).inspect_err(|_: &RunError| progress.stop()))?;
    Ok(grown.into_iter().flatten().collect())
}

/// What the plots of all shards share.
struct Grower<'a> {
    plots: Plots<'a>,
    plan: &'a RunPlan,
    progress: &'a Progress,
    /// Whether a model makes its plants anew at each tick that is looked at.
    remakes: bool,
}

/// What keeps the plots of a shard, in files or in memory.
trait Keeper: Recorder {
    /// A plot is about to grow.
    fn begin_plot(&mut self, plot: u32);

    /// A plot has come to its end.
    fn end_plot(&mut self, plot: &Plot, ending: Ending) -> Result<(), RunError>;
}

impl<'a> Grower<'a> {
    fn of(resolved: &'a Resolved, plan: &'a RunPlan, progress: &'a Progress) -> Self {
        let plots = Plots::of(resolved.trial(), resolved.models());
        let remakes = plots.models().iter().any(|model| !model.growth().keeps_its_past());
        Self { plots, plan, progress, remakes }
    }

    /// Grows the plots of one shard, one after another in the same columns; `false` where it was told to stop.
    fn grow_shard(&self, shard: u32, keeper: &mut impl Keeper) -> Result<bool, RunError> {
        let plots = self.plan.plots_of(shard);
        let mut plot = self.plots.sow(plots.start, self.budget());
        for number in plots {
            if self.progress.is_stopped() {
                return Ok(false);
            }
            if number != plot.id {
                self.plots.sow_again(&mut plot, number);
            }
            if !self.grow_plot(&mut plot, keeper)? {
                return Ok(false);
            }
        }
        // A large plant takes as long to give back its memory as a file to reach the disk.
        let plants = plot.plants;
        rayon::spawn(move || drop(plants));
        Ok(true)
    }

    /// Grows one plot to its end; `false` where it was told to stop.
    fn grow_plot(&self, plot: &mut Plot<'_>, keeper: &mut impl Keeper) -> Result<bool, RunError> {
        keeper.begin_plot(plot.id);
        if let Some(sample) = self.plan.sample {
            let others = plot.plants.iter_mut().filter(|plant| !sample.has(plant.id));
            others.for_each(|plant| plant.events = None);
        }
        let ending = match grow(plot, self.plan.until, keeper).map_err(RunError::of_recorder) {
            Ok(ending) => ending,
            Err(RunError::Stopped) => return Ok(false),
            Err(error) => return Err(error),
        };
        keeper.end_plot(plot, ending)?;
        self.progress.end_plants(&plot.plants);
        Ok(true)
    }

    /// Whether a model must make its plants at this tick whatever is recorded: one that makes them anew must at the
    /// last, of which the components are written.
    fn must_make(&self, tick: Tick) -> bool {
        tick == self.plan.until && self.remakes
    }

    /// The threads that may grow one plant: those for which there is no shard help with the plants of other shards.
    /// Where every thread has a shard of its own there is no help: a thread that waits for its helper would begin a
    /// further shard meanwhile, and keep two plants in memory. The plants of a plot share the helpers of their shard.
    fn budget(&self) -> ThreadBudget {
        let plants = self.plan.shards() as usize * self.plots.trial().most_members() as usize;
        ThreadBudget { threads: (rayon::current_num_threads() / plants.max(1)).max(1), ..ThreadBudget::default() }
    }
}

/// Shows each plot of a shard to the shard's tables and meshes.
struct FolderKeeper<'a> {
    grower: &'a Grower<'a>,
    folder: &'a RunFolder,
    shard: Shard<'a>,
    meshes: Option<RunMeshes<'a>>,
    plot: u32,
}

impl FolderKeeper<'_> {
    fn commit(mut self) -> Result<ShardReport, RunError> {
        self.meshes.iter_mut().try_for_each(RunMeshes::finish)?;
        let report = self.shard.commit()?;
        self.grower.progress.end_part(self.folder.written());
        Ok(report)
    }

    fn draws(&self, tick: Tick) -> bool {
        self.meshes.as_ref().is_some_and(|meshes| meshes.wants(self.plot, tick))
    }
}

impl Keeper for FolderKeeper<'_> {
    fn begin_plot(&mut self, plot: u32) {
        self.plot = plot;
    }

    fn end_plot(&mut self, plot: &Plot, ending: Ending) -> Result<(), RunError> {
        self.shard.end_plot(plot, ending)?;
        self.meshes.iter_mut().try_for_each(RunMeshes::end_plot)
    }
}

impl Recorder for FolderKeeper<'_> {
    fn wants(&self, age: Tick) -> bool {
        self.grower.must_make(age) || self.shard.wants(age) || self.draws(age)
    }

    fn grown(&mut self, until: Tick, plot: &Plot) -> Result<(), RecordError> {
        self.shard.grown(until, plot)
    }

    fn record(&mut self, age: Tick, plot: &Plot) -> Result<(), RecordError> {
        self.grower.progress.check()?;
        if self.shard.wants(age) {
            self.shard.record(age, plot)?;
        }
        if self.draws(age)
            && let Some(meshes) = &mut self.meshes
        {
            self.shard.look_at_disk()?;
            meshes.draw(age, plot, &mut self.shard)?;
        }
        self.grower.progress.end_age(plot, self.folder.written());
        Ok(())
    }
}
