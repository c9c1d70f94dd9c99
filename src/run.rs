//! A run: from a scenario to its run folder.
//!
//! The plants are dealt into shards of neighbours. Each shard sows its plants one after another into the same columns,
//! grows each from seed to the last age, shows it to the tables and the meshes at the ages asked for, and commits its
//! files; shards grow in parallel. A draw depends on the run's seed and the plant alone, so neither the number of
//! threads nor an interruption shows in a single byte.
//!
//! Absent: growth (`sim`, `models`), files (`outputs`), and everything that a person sees (`cli`).

pub mod again;
pub mod disk;
pub mod drawing;
pub mod forecast;
pub mod forms;
mod plan;
mod progress;

pub use plan::{Program, component_limit, place_of, plan_of, seed_of};
pub use progress::Progress;

use anyhow::{Context, Result};
use drawing::Drawing;
use phytomer_config::Resolved;
use phytomer_outputs::meshes::OwnForms;
use phytomer_outputs::{
    Checkup, FreeSpace, Mode, Opening, RunFolder, RunPlan, RunReport, Shard, ShardReport, SystemSpace,
};
use phytomer_sim::plant::Hands;
use phytomer_sim::{Plot, RecordError, Recorder, Tick, grow};
use progress::Stopped;
use rayon::ThreadPool;
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use std::borrow::Cow;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

/// How a run is made, beside what its scenario says. Nothing here shows in the bytes of a table or a mesh but the
/// program's name.
#[derive(Debug, Clone)]
pub struct Settings {
    /// The run folder.
    pub folder: PathBuf,
    /// What to do where the folder holds files already.
    pub mode: Mode,
    /// Threads; 0 takes as many as the machine has.
    pub threads: usize,
    /// The program that the files name as their maker.
    pub program: Program,
    /// Who knows the free space of the disk.
    pub space: Arc<dyn FreeSpace>,
    /// Whether a run begins that the disk seems too small for.
    pub ignore_disk: bool,
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
        }
    }
}

/// What came of a run.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// What was written; of an interrupted run the shards of this start alone.
    pub report: RunReport,
    /// How many shards the run has.
    pub shards: u32,
    /// How many of them are on the disk.
    pub committed: u32,
    /// How many of them this start has grown.
    pub grown_now: u32,
    /// Components of the plants that this start has grown.
    pub components_now: u64,
    /// How long it took, seconds.
    pub seconds: f64,
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
/// As [`begin`], and where a file cannot be written.
pub fn run(resolved: &Resolved, settings: &Settings, progress: &Progress) -> Result<Outcome> {
    begin(resolved, settings, progress)?.grow(progress)
}

/// A run whose folder is ready, before its first tick.
pub struct Begun<'a> {
    resolved: Cow<'a, Resolved>,
    forms: Arc<OwnForms>,
    folder: RunFolder,
    pool: ThreadPool,
    start: Instant,
}

/// Makes the run folder ready, or looks at what an earlier start has left in it.
///
/// # Errors
/// Where a file cannot be written, where the folder holds another run or another process fills it, or where the disk is
/// too small ([`disk::TooSmall`]).
pub fn begin<'a>(resolved: &'a Resolved, settings: &Settings, progress: &Progress) -> Result<Begun<'a>> {
    let start = Instant::now();
    let (resolved, forms) = forms::settled(resolved)?;
    let plan = plan_of(&resolved, &settings.program)?;
    let pool = pool(settings.threads)?;
    disk::check(&resolved, settings, disk::there(settings)?)?;
    let folder = pool.install(|| open(plan, settings, progress))?;
    Ok(Begun { resolved, forms, folder, pool, start })
}

fn open(plan: RunPlan, settings: &Settings, progress: &Progress) -> Result<RunFolder, phytomer_outputs::Error> {
    let opening = Opening { checking: progress.checking(), space: Arc::clone(&settings.space) };
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
    pub fn grow(self, progress: &Progress) -> Result<Outcome> {
        let Self { resolved, forms, folder, pool, start } = self;
        let shards = folder.plan().shards();
        let missing = folder.missing_shards();
        progress.begin(&resolved, missing.iter().map(|shard| folder.plan().plots_of(*shard).len() as u64).sum());
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
        Ok(Outcome { report, shards, committed, grown_now, components_now, seconds })
    }
}

/// A pool of so many threads, apart from any that the caller may have.
fn pool(threads: usize) -> Result<ThreadPool> {
    let builder = rayon::ThreadPoolBuilder::new().num_threads(threads).thread_name(|i| format!("grow-{i}"));
    builder.build().context("cannot start the threads")
}

/// The shards that were committed; fewer than `missing` after a stop.
fn grow_shards(
    resolved: &Resolved,
    forms: &Arc<OwnForms>,
    folder: &RunFolder,
    missing: &[u32],
    progress: &Progress,
) -> Result<Vec<ShardReport>> {
    let grown: Result<Vec<_>> = missing
        .into_par_iter()
        .map(|shard| {
            let grown = Grower { resolved, folder, progress, forms }.grow_shard(*shard);
            // A failed write ends the run: the other shards need not go on.
            grown.inspect_err(|_| progress.stop())
        })
        .collect();
    Ok(grown?.into_iter().flatten().collect())
}

/// What the plants of all shards share.
struct Grower<'a> {
    resolved: &'a Resolved,
    folder: &'a RunFolder,
    progress: &'a Progress,
    /// The forms of its own that the species names.
    forms: &'a Arc<OwnForms>,
}

impl Grower<'_> {
    /// Grows the plants of one shard, one after another in the same columns; `None` where it was told to stop.
    fn grow_shard(&self, shard: u32) -> Result<Option<ShardReport>> {
        let plants = self.folder.plan().plots_of(shard);
        let model = self.resolved.model.as_ref();
        let scenario = &self.resolved.scenario;
        let mut plot = Plot::of_one(model, &seed_of(scenario, plants.start));
        plot.site = scenario.site.felt();
        plot.plants[0].hands = self.hands();
        let drawing = Drawing::of(self.resolved, self.forms, self.folder.plan().shards());
        let mut keeper = Keeper { shard: self.folder.shard(shard)?, drawing, grower: self, plant: plants.start };
        for plant in plants {
            if self.progress.is_stopped() {
                return Ok(None);
            }
            plot.resow(&seed_of(scenario, plant));
            plot.plants[0].place = place_of(scenario, plant);
            if !keeper.grow_plot(&mut plot, plant)? {
                return Ok(None);
            }
        }
        // A large plant takes as long to give back its memory as a file to reach the disk.
        let plants = plot.plants;
        rayon::spawn(move || drop(plants));
        keeper.commit().map(Some)
    }

    /// The threads for which there is no shard help with the plants of the others. Where every thread has a shard of
    /// its own none helps: one that waits for its helper would begin with a further shard meanwhile, and keep two
    /// plants.
    fn hands(&self) -> Hands {
        let shards = self.folder.plan().shards() as usize;
        Hands { threads: (rayon::current_num_threads() / shards).max(1), ..Hands::default() }
    }
}

/// Shows each plot of a shard to the shard's tables and meshes.
struct Keeper<'a> {
    shard: Shard<'a>,
    drawing: Option<Drawing<'a>>,
    grower: &'a Grower<'a>,
    plant: u32,
}

impl Keeper<'_> {
    /// Grows one plot to its end; `false` where it was told to stop.
    fn grow_plot(&mut self, plot: &mut Plot<'_>, plant: u32) -> Result<bool> {
        self.plant = plant;
        let Grower { resolved, progress, .. } = self.grower;
        let ending = match grow(plot, resolved.scenario.ages.until, self) {
            Ok(ending) => ending,
            Err(error) if error.is::<Stopped>() => return Ok(false),
            Err(error) => return Err(anyhow::anyhow!(error)),
        };
        self.shard.end_plot(plot, ending)?;
        self.drawing.iter_mut().try_for_each(Drawing::end_plant)?;
        progress.end_plant(&plot.plants[0]);
        Ok(true)
    }

    fn commit(mut self) -> Result<ShardReport> {
        self.drawing.iter_mut().try_for_each(Drawing::finish)?;
        Ok(self.shard.commit()?)
    }

    fn draws(&self, age: Tick) -> bool {
        self.drawing.as_ref().is_some_and(|drawing| drawing.wants(self.plant, age))
    }
}

impl Recorder for Keeper<'_> {
    /// A model that makes the plant anew must also make it at the last age, of which the components are written.
    fn wants(&self, age: Tick) -> bool {
        let resolved = self.grower.resolved;
        let last = age == resolved.scenario.ages.until && !resolved.model.growth().keeps_its_past();
        last || self.shard.wants(age) || self.draws(age)
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
            && let Some(drawing) = &mut self.drawing
        {
            self.shard.look_at_disk()?;
            drawing.draw(age, &plot.plants[0], &mut self.shard)?;
        }
        self.grower.progress.end_age();
        Ok(())
    }
}
