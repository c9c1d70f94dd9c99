//! A run from a scenario to its folder, by way of a cluster: which parts are missing, their answers, and the merge.
//!
//! Growth itself is the executors'. When all parts are there they are checked byte for byte and get their names in the
//! run folder, as `phytomer merge` does it, and the folder of the parts is removed. Whatever ends in between is gone on
//! with by `--resume`: whole parts are kept. Absent: what a person sees (`cli`).

use super::fault::Fault;
use super::order::{Order, Stated};
use super::parts::{Answer, Grown, Piece, counted};
use super::store::{Held, Store, StoreError};
use super::submission::{ask, greet};
use phytomer::config::{Report, Resolved};
use phytomer::outputs::{
    self as outputs, Checking, Depth, Files, Merged, Mode, Opening, RunPlan, State, SystemSpace, fingerprint, merge_by,
};
use phytomer::run::{self, Program, RunError};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A run as it is asked for.
#[derive(Debug, Clone)]
pub struct Asked {
    /// The scenario.
    pub stated: Stated,
    /// The run folder.
    pub out: PathBuf,
    /// What to do where the folder holds files already.
    pub mode: Mode,
    /// Whether parts begin that the disk seems too small for.
    pub ignore_disk: bool,
    /// HOST:PORT of the scheduler.
    pub scheduler: String,
    /// The program that asks.
    pub program: Program,
}

/// Why a run failed.
#[derive(Debug, thiserror::Error)]
pub enum GrowError {
    /// The scenario is wrong.
    #[error("the scenario is wrong")]
    Invalid(Box<Report>),
    /// The scenario has no plan.
    #[error(transparent)]
    Plan(#[from] RunError),
    /// The run folder, or a merge.
    #[error(transparent)]
    Outputs(#[from] outputs::Error),
    /// The folder of the parts.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The scheduler, or the run as a whole.
    #[error("the cluster did not grow the run; {there} of {shards} parts are whole and kept")]
    Cluster {
        /// Parts that are there.
        there: u32,
        /// Parts of the run.
        shards: u32,
        /// Why.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// Parts that executors could not grow.
    #[error("{} of {shards} parts were not grown; the others are kept:\n{}", .faults.len(), told(.faults))]
    Parts {
        /// Parts of the run.
        shards: u32,
        /// The answers with faults: the part, the executor, the fault.
        faults: Vec<(Option<u32>, String, Fault)>,
    },
    /// The answers are not one for each part.
    #[error("{0}")]
    Counts(Fault),
}

/// Each fault once, with its parts and executors.
fn told(faults: &[(Option<u32>, String, Fault)]) -> String {
    let mut by_text: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for (shard, executor, fault) in faults {
        let part = shard.map_or("a part".to_owned(), |shard| format!("part {shard}"));
        by_text.entry(&fault.text).or_default().push(format!("{part} on {executor}"));
    }
    let lines = by_text.iter().map(|(text, parts)| {
        let more = if parts.len() > 5 { format!(" and {} more", parts.len() - 5) } else { String::new() };
        format!("  {}{more}: {text}", parts.iter().take(5).cloned().collect::<Vec<_>>().join(", "))
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// What came of a run.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// The merged run.
    pub merged: Merged,
    /// Parts that this asking has grown.
    pub grown_now: u32,
    /// Parts by the executor that grew them, in this asking.
    pub by_executor: BTreeMap<String, u32>,
}

/// A run that is checked, and whose folder of parts is taken.
pub struct Ready {
    asked: Asked,
    plan: RunPlan,
    held: Held,
    missing: Vec<Piece>,
    submission: String,
}

/// Reads the scenario, calls the scheduler, and finds the parts that are missing; `None` where a run that is to be gone
/// on with is complete.
///
/// # Errors
/// [`GrowError`]; nothing is begun.
pub async fn prepare(asked: Asked) -> Result<Option<Ready>, GrowError> {
    let resolved = asked.stated.resolved().map_err(|report| GrowError::Invalid(Box::new(report)))?;
    let plan = run::plan_of(&resolved, &asked.program)?;
    drop::<Resolved>(resolved);
    check_out(&asked.out, asked.mode)?;
    if asked.mode == Mode::Resume && is_complete(&asked.out, &fingerprint(&plan)) {
        return Ok(None);
    }
    let shards = plan.shards();
    greet(&asked.scheduler, &asked.program).await.map_err(|error| cluster(error, 0, shards))?;
    let store = Store::of(
        &std::path::absolute(Store::beside(&asked.out))
            .map_err(|source| StoreError::Io { path: asked.out.clone(), source })?,
        &fingerprint(&plan),
        shards,
    );
    let io = |path: &Path| {
        let path = path.to_path_buf();
        move |source| StoreError::Io { path, source }
    };
    let held = Held::take(store, (asked.mode == Mode::Resume, asked.mode == Mode::Overwrite))?;
    let submission = held.begin().map_err(io(held.store().folder()))?;
    let whole = |shard: &u32| held.store().whole(*shard, Depth::Bytes).is_none();
    let missing: Vec<u32> = (0..shards).into_par_iter().filter(whole).collect();
    for shard in &missing {
        held.remove(*shard).map_err(io(&held.store().part(*shard)))?;
    }
    let missing = missing.into_iter().map(|shard| Piece { shard, plots: plan.plots_of(shard) }).collect();
    Ok(Some(Ready { asked, plan, held, missing, submission }))
}

/// Whether a folder has the whole run, as it was written.
fn is_complete(out: &Path, fingerprint: &str) -> bool {
    let run = fs::read(out.join("run.json")).ok().and_then(|text| serde_json::from_slice::<Value>(&text).ok());
    run.is_some_and(|run| run["fingerprint"] == fingerprint && run["shard"].is_null())
        && outputs::check(out, Depth::Bytes, &Checking::default()).is_ok_and(|found| found.state == State::Complete)
}

/// Refuses a run folder that must not be changed, before anything is grown: merging would refuse it in the end.
fn check_out(out: &Path, mode: Mode) -> Result<(), GrowError> {
    let occupied = fs::read_dir(out).is_ok_and(|mut entries| entries.next().is_some());
    if !occupied {
        return Ok(());
    }
    let path = out.to_path_buf();
    match (mode, outputs::check(out, Depth::Lengths, &Checking::default())) {
        (Mode::New, _) => Err(outputs::Error::Occupied { path }.into()),
        (_, Err(error)) => Err(error.into()),
        (_, Ok(found)) if found.state == State::InProgress && found.holder.is_some() => {
            let holder = found.holder.into_iter().next();
            Err(holder
                .map_or(outputs::Error::NotARun { path: path.clone() }, |holder| outputs::Error::InProgress {
                    path,
                    holder,
                })
                .into())
        }
        _ => Ok(()),
    }
}

fn cluster(error: anyhow::Error, there: u32, shards: u32) -> GrowError {
    GrowError::Cluster { there, shards, source: error.into() }
}

impl Ready {
    /// The parts of the run.
    pub fn shards(&self) -> u32 {
        self.plan.shards()
    }

    /// How many of them are to be grown.
    pub fn missing(&self) -> u32 {
        self.missing.len() as u32
    }

    /// The folder of the parts.
    pub fn store(&self) -> Store {
        self.held.store().clone()
    }

    /// Ends the asking; what is whole is kept.
    pub fn stop(&self) {
        self.held.stop();
    }

    /// Asks the cluster for the missing parts. An asking that is given up is to be told by [`Ready::stop`].
    ///
    /// The answers of an executor that has ended are lost, and the parts that it grew are not: what is not there is
    /// then asked for once more, as long as each asking brings a part. So there may be parts without an answer; the
    /// merge checks them as all others.
    ///
    /// # Errors
    /// [`GrowError`], with the parts that were not grown, each with its executor and what to do.
    pub async fn grow(&self) -> Result<Vec<Answer>, GrowError> {
        let store = self.held.store();
        loop {
            let left = |piece: &&Piece| !store.part(piece.shard).is_dir();
            let missing: Vec<Piece> = self.missing.iter().filter(left).cloned().collect();
            if missing.is_empty() {
                return Ok(Vec::new());
            }
            let before = store.there();
            match self.asked_once(&missing).await {
                Err(GrowError::Cluster { source, .. }) if !gives_up(source.as_ref()) && store.there() > before => {}
                done => return done,
            }
        }
    }

    async fn asked_once(&self, missing: &[Piece]) -> Result<Vec<Answer>, GrowError> {
        let order = Arc::new(self.order());
        let (Asked { scheduler, program, .. }, shards) = (&self.asked, self.shards());
        let answers = match ask(scheduler, missing, &order, program).await {
            Ok(answers) => answers,
            Err(error) => {
                // Where the scheduler is gone, that is the reason, and not what it looked like from here.
                let error = greet(scheduler, program).await.err().unwrap_or(error);
                return Err(cluster(error, self.held.store().there(), shards));
            }
        };
        counted(missing, &answers).map_err(GrowError::Counts)?;
        let faulty = answers.iter().filter_map(|answer| {
            let fault = answer.outcome.as_ref().err()?;
            Some((answer.shard, answer.executor.clone(), fault.clone()))
        });
        let faults: Vec<_> = faulty.collect();
        if !faults.is_empty() {
            return Err(GrowError::Parts { shards, faults });
        }
        Ok(answers)
    }

    fn order(&self) -> Order {
        let store = self.held.store();
        Order {
            version: self.asked.program.version.clone(),
            git_hash: self.asked.program.git_hash.clone(),
            stated: self.asked.stated.clone(),
            fingerprint: fingerprint(&self.plan),
            shards: self.shards(),
            folder: store.folder().to_path_buf(),
            submission: self.submission.clone(),
            ignore_disk: self.asked.ignore_disk,
        }
    }

    /// Merges the parts, which must be what the executors answered, and removes their folder.
    ///
    /// # Errors
    /// [`GrowError`]; the parts are kept.
    pub fn finish(self, answers: &[Answer]) -> Result<Outcome, GrowError> {
        let store = self.held.store();
        let differing: Vec<(Option<u32>, String, Fault)> = answers
            .iter()
            .filter_map(|answer| Some((answer, answer.shard?, answer.outcome.as_ref().ok()?)))
            .filter_map(|(answer, shard, grown)| {
                let fault = differing(grown, store.whole(shard, Depth::Lengths).as_ref(), &store.part(shard))?;
                Some((Some(shard), answer.executor.clone(), fault))
            })
            .collect();
        if !differing.is_empty() {
            return Err(GrowError::Parts { shards: self.shards(), faults: differing });
        }
        let parts: Vec<PathBuf> = (0..self.shards()).map(|shard| store.part(shard)).collect();
        let checking = Checking::default();
        let opening = Opening { checking: &checking, space: Arc::new(SystemSpace), share: None };
        let merged = merge_by(Files::Linked, &self.asked.out, &parts, (self.asked.mode, &opening))?;
        let mut by_executor: BTreeMap<String, u32> = BTreeMap::new();
        let grown = answers.iter().filter(|answer| answer.outcome.as_ref().is_ok_and(|grown| grown.now));
        for answer in grown {
            *by_executor.entry(answer.executor.clone()).or_default() += 1;
        }
        let folder = store.folder().to_path_buf();
        self.held.remove_folder().map_err(|source| StoreError::Io { path: folder, source })?;
        Ok(Outcome { merged, grown_now: by_executor.values().sum(), by_executor })
    }
}

/// Whether the scheduler has given the run up; else it was an answer that could not be fetched, or a scheduler that is
/// gone.
fn gives_up(error: &(dyn std::error::Error + 'static)) -> bool {
    std::iter::successors(Some(error), |error| error.source()).any(|error| error.to_string().contains("Job "))
}

/// What is wrong with a part whose rows are not those that the executor answered.
fn differing(answered: &Grown, there: Option<&Grown>, part: &Path) -> Option<Fault> {
    let there = there.map(|there| (&there.rows, there.bytes));
    if there == Some((&answered.rows, answered.bytes)) {
        return None;
    }
    let text = match there {
        Some((rows, _)) => format!(
            "{} has {} rows, and the executor has written {}: --resume grows the part again",
            part.display(),
            rows.values().sum::<u64>(),
            answered.rows.values().sum::<u64>()
        ),
        None => format!(
            "{} is not whole here: every machine must see the folder under the same path; --resume grows the part again",
            part.display()
        ),
    };
    Some(Fault::new(super::fault::Kind::NotShared, text))
}
