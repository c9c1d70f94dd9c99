//! An executor at work on a part: it makes sure that it is the same program with the same scenario, grows the part as
//! `phytomer grow --shard` does, and gives it its name.
//!
//! While it grows it looks once a second whether it is still asked for. Absent: tasks and rows (`plan`), where parts
//! are (`store`).

use super::fault::{Fault, Kind};
use super::order::{Order, Stated};
use super::parts::{Answer, Grown, Piece};
use super::program::named;
use super::store::Store;
use phytomer::config::Resolved;
use phytomer::outputs::{Depth, FreeSpace, Mode, SystemSpace, fingerprint};
use phytomer::run::disk::TooSmall;
use phytomer::run::{self, Program, Progress, RunError, Settings};
use std::fs;
use std::io;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

/// How often a part that is grown looks whether it is still asked for.
const LOOK: Duration = Duration::from_secs(1);

/// An executor, as its parts see it.
#[derive(Debug)]
pub struct Worker {
    /// Its name in answers and messages.
    pub name: String,
    /// The program that it is.
    pub program: Program,
    /// What tells the free space of the disk: the system, or a test.
    pub space: Arc<dyn FreeSpace>,
    /// The scenario of the last part, read and checked once.
    known: Mutex<Option<(String, Stated, Arc<Resolved>)>>,
}

/// A failure of a part.
#[derive(Debug)]
pub enum Failure {
    /// It will not pass by itself.
    Fault(Fault),
    /// It may pass: the task is tried again.
    Passing(io::Error),
}

impl From<Fault> for Failure {
    fn from(fault: Fault) -> Self {
        Self::Fault(fault)
    }
}

impl Worker {
    /// An executor of this program.
    pub fn new(name: impl Into<String>) -> Self {
        let (program, space) = (Program::default(), Arc::new(SystemSpace));
        Self { name: name.into(), program, space, known: Mutex::new(None) }
    }

    /// The same as another program, or with other free space: for tests of what is told.
    #[must_use]
    pub fn acting_as(self, program: Program, space: Arc<dyn FreeSpace>) -> Self {
        Self { program, space, ..self }
    }

    /// Grows a part, and answers; `is_left` tells that nobody waits for the answer any more.
    ///
    /// # Errors
    /// What may pass by itself, for which Ballista tries the task again.
    pub fn answer(&self, order: &Order, piece: Result<Piece, Fault>, is_left: &AtomicBool) -> io::Result<Answer> {
        let shard = piece.as_ref().ok().map(|piece| piece.shard);
        let outcome = match piece.map_err(Failure::Fault).and_then(|piece| self.grow(order, &piece, is_left)) {
            Ok(grown) => Ok(grown),
            Err(Failure::Fault(fault)) => Err(fault),
            Err(Failure::Passing(error)) => return Err(error),
        };
        Ok(Answer { shard, executor: self.name.clone(), outcome })
    }

    fn grow(&self, order: &Order, piece: &Piece, is_left: &AtomicBool) -> Result<Grown, Failure> {
        self.check_program(order)?;
        let store = Store::of(&order.folder, &order.fingerprint, order.shards);
        store.holds(&order.submission)?;
        let resolved = self.resolved(order)?;
        let plan = run::plan_of(&resolved, &self.program).map_err(|error| failure(error.into()))?;
        let own = (plan.shards(), (piece.shard < plan.shards()).then(|| plan.plots_of(piece.shard)));
        if own != (order.shards, Some(piece.plots.clone())) {
            let (shards, plots) = (order.shards, &piece.plots);
            let text = format!(
                "part {} of {shards} with the plots {} to {} was asked for; the run has {} parts, and that one is {:?}",
                piece.shard, plots.start, plots.end, own.0, own.1
            );
            return Err(Fault::new(Kind::WrongRow, text).into());
        }
        // A task that is given to this executor since another was lost may be done already.
        if let Some(there) = store.whole(piece.shard, Depth::Lengths) {
            return Ok(there);
        }
        let attempt = store.attempt(piece.shard);
        let done = self.grown(&resolved, order, (&store, piece.shard), &attempt, is_left);
        // After a rename nothing is there; else what is left of the part is of no use.
        let _ = fs::remove_dir_all(&attempt);
        done
    }

    /// Grows the part in the folder `attempt`, and gives it its name.
    fn grown(
        &self,
        resolved: &Resolved,
        order: &Order,
        (store, shard): (&Store, u32),
        attempt: &Path,
        is_left: &AtomicBool,
    ) -> Result<Grown, Failure> {
        let settings = Settings {
            mode: Mode::New,
            threads: 1,
            program: self.program.clone(),
            space: Arc::clone(&self.space),
            ignore_disk: order.ignore_disk,
            share: store.share(shard),
            ..Settings::in_folder(attempt)
        };
        let progress = Progress::default();
        let ended = AtomicBool::new(false);
        let outcome = thread::scope(|scope| {
            let looking = scope.spawn(|| {
                while !ended.load(Relaxed) {
                    if is_left.load(Relaxed) || store.holds(&order.submission).is_err() {
                        return progress.stop();
                    }
                    thread::park_timeout(LOOK);
                }
            });
            let outcome = run::run(resolved, &settings, &progress);
            ended.store(true, Relaxed);
            looking.thread().unpark();
            outcome
        });
        store.holds(&order.submission)?;
        match outcome {
            Ok(outcome) if outcome.is_interrupted() => {
                return Err(Failure::Passing(io::Error::other("the part was given up while it was grown")));
            }
            Ok(_) => {}
            Err(error) => return Err(failure(error.into())),
        }
        let now = store.commit(attempt, shard).map_err(Failure::Passing)?;
        let whole = store.whole(shard, Depth::Lengths);
        whole.map(|grown| Grown { now, ..grown }).ok_or_else(|| {
            Failure::Passing(io::Error::other(format!("{} is not as it was written", store.part(shard).display())))
        })
    }

    fn check_program(&self, order: &Order) -> Result<(), Fault> {
        let asking = Program { version: order.version.clone(), git_hash: order.git_hash.clone() };
        if asking == self.program {
            return Ok(());
        }
        let text = format!(
            "the executor is {}, and the run was asked for by {}: install the same version on every machine of the cluster",
            named(&self.program),
            named(&asking)
        );
        Err(Fault::new(Kind::ForeignVersion, text))
    }

    /// The scenario as it is read here, if it is the one that is grown.
    fn resolved(&self, order: &Order) -> Result<Arc<Resolved>, Fault> {
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((fingerprint, stated, resolved)) = &*known
            && (fingerprint, stated) == (&order.fingerprint, &order.stated)
        {
            return Ok(Arc::clone(resolved));
        }
        let name = &order.stated.scenario;
        let foreign = |text: String| Fault::new(Kind::ForeignScenario, text);
        let resolved = order.stated.resolved().map_err(|report| {
            foreign(format!(
                "the scenario {name} cannot be read here, and must be the same file on every machine:\n{}",
                report.render(false).trim_end()
            ))
        })?;
        let plan = run::plan_of(&resolved, &self.program).map_err(|error| foreign(format!("{name}: {error}")))?;
        let here = fingerprint(&plan);
        if here != order.fingerprint {
            return Err(foreign(format!(
                "the scenario {name} is another one here (its run has the fingerprint {here}, and {} is grown): it must be \
                 the same file, with the same files beside it, on every machine",
                order.fingerprint
            )));
        }
        let resolved = Arc::new(resolved);
        *known = Some((here, order.stated.clone(), Arc::clone(&resolved)));
        Ok(resolved)
    }
}

/// What is told of an error, and whether it may pass.
fn failure(error: anyhow::Error) -> Failure {
    let too_small = error.chain().any(|cause| cause.is::<TooSmall>())
        || matches!(error.downcast_ref(), Some(RunError::TooSmall(_)));
    let full = too_small || phytomer::cli::causes::is_full_disk(&error);
    let text = phytomer::cli::causes::in_words(&error);
    if full {
        return Fault::new(Kind::FullDisk, text).into();
    }
    match error.chain().any(|cause| cause.is::<io::Error>()) {
        true => Failure::Passing(io::Error::other(text)),
        false => Fault::new(Kind::Failed, text).into(),
    }
}
