//! Growth on threads of its own, while the interpreter waits, tells its progress and hears Ctrl-C.
//!
//! The interpreter is released; it is asked for signals twenty times a second. Ctrl-C, or an exception of the
//! function that is told the progress, stops growth and is raised at once or after `PATIENCE`. Growth that has not
//! ended by then ends by itself; before another run begins in this process it is waited for, so that a run folder is
//! free again. Absent: the run itself (`phytomer::run`).

use super::plants::Again;
use super::raise;
use super::run::Run;
use super::scenario::Stated;
use phytomer::outputs::tables::Room;
use phytomer::outputs::{Mode, read};
use phytomer::run::{self, InMemory, Outcome, Program, Progress, RunError, Settings, forms};
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::json;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// How often the interpreter looks for signals.
const LOOK: Duration = Duration::from_millis(50);
/// How long an interrupted run is waited for before the exception is raised.
const PATIENCE: Duration = Duration::from_millis(120);

/// Runs that were interrupted and had not ended when that was raised.
static STOPPING: Mutex<Vec<JoinHandle<()>>> = Mutex::new(Vec::new());

/// How a run is made.
#[derive(FromPyObject)]
pub struct Asked {
    plants: Option<u32>,
    seed: Option<u64>,
    threads: usize,
    out: Option<PathBuf>,
    resume: bool,
    overwrite: bool,
    max_memory_mb: u64,
    progress: Option<Py<PyAny>>,
}

/// Grows the plants of a scenario, in memory or into a run folder. `asked` has how, as attributes.
#[pyfunction]
pub fn grow(py: Python<'_>, name: String, texts: Vec<(String, String)>, asked: Asked) -> PyResult<Run> {
    let stated = Stated { name, texts };
    let resolved = py.detach(|| checked(&stated, &asked)).map_err(|report| raise::faulty(py, &report))?;
    wait_for_others(py)?;
    let progress = Arc::new(Progress::default());
    let Some(out) = asked.out.clone() else {
        let (threads, room) = (asked.threads, Room::of(asked.max_memory_mb.saturating_mul(1_000_000)));
        let grown = {
            let (resolved, progress) = (resolved.clone(), Arc::clone(&progress));
            move || run::in_memory_within(&resolved, threads, room, &progress)
        };
        let grown = waited_for(py, &progress, asked.progress.as_ref(), grown)?;
        return in_memory(py, resolved, grown);
    };
    let mode = match (asked.resume, asked.overwrite) {
        (true, true) => return Err(PyValueError::new_err("resume and overwrite exclude each other")),
        (true, false) => Mode::Resume,
        (false, true) => Mode::Overwrite,
        (false, false) => Mode::New,
    };
    let settings = Settings { mode, threads: asked.threads, ..Settings::in_folder(&out) };
    let grown = {
        let (resolved, progress) = (resolved, Arc::clone(&progress));
        move || run::run(&resolved, &settings, &progress)
    };
    let outcome: Outcome = waited_for(py, &progress, asked.progress.as_ref(), grown)?;
    if outcome.is_interrupted() {
        return Err(PyKeyboardInterrupt::new_err("the run was told to stop; resume=True goes on with it"));
    }
    let run = Run::open(py, out)?;
    limits(py, run, &outcome.report.overgrown)
}

/// The scenario with what is asked for in the place of what it states.
fn checked(stated: &Stated, asked: &Asked) -> Result<phytomer::config::Resolved, phytomer::config::Report> {
    let mut resolved = stated.resolved()?;
    forms::settle(&mut resolved)?;
    if let Some(seed) = asked.seed {
        resolved.reseed(seed)?;
    }
    if let Some(plants) = asked.plants {
        resolved.grow_only(plants);
        let faults = resolved.faults().into_iter().map(|(_, fault)| fault).collect::<Vec<_>>();
        if !faults.is_empty() {
            return Err(resolved.report(faults));
        }
    }
    Ok(resolved)
}

/// A run whose tables are in memory.
fn in_memory(py: Python<'_>, resolved: phytomer::config::Resolved, grown: InMemory) -> PyResult<Run> {
    let until = resolved.scenario.ages.until;
    let ages: Vec<u32> = resolved.scenario.ages.recorded().into_iter().collect();
    let plan = run::plan_of(&resolved, &Program::default()).map_err(|error| raise::failed(py, &error))?;
    let json = json!({
        "status": "complete",
        "name": resolved.scenario.name,
        "seed": resolved.scenario.seed,
        "until": until,
        "recorded_ages": ages,
        "resolved_scenario": plan.provenance.resolved,
    });
    let tables = read::Run::in_memory(&resolved.scenario.name, json, grown.batches);
    let run = Run::of(py, tables, Again::of(resolved).map_err(|error| raise::failed(py, &error))?)?;
    limits(py, run, &grown.overgrown)
}

/// The run, or that some of its plots have ended by a limit: the exception then has the run.
fn limits(py: Python<'_>, run: Run, overgrown: &[phytomer::outputs::OvergrownPlot]) -> PyResult<Run> {
    let Some(first) = overgrown.first() else { return Ok(run) };
    let text = format!(
        "{} of the plots ended by a limit, the first, plot {}, with plant {} at {} components at tick {}; the others have grown \
         to the end, and `run` of this exception has all of them. Raise max_components or max_memory_mb of the scenario",
        overgrown.len(),
        first.plot,
        first.plant,
        first.limit,
        first.tick
    );
    Err(raise::own(py, "LimitReached", (text, run)))
}

/// Waits for runs of this process that were interrupted and have not ended yet.
fn wait_for_others(py: Python<'_>) -> PyResult<()> {
    loop {
        let mut stopping = STOPPING.lock().unwrap_or_else(PoisonError::into_inner);
        stopping.retain(|run| !run.is_finished());
        let none = stopping.is_empty();
        drop(stopping);
        if none {
            return Ok(());
        }
        py.detach(|| thread::sleep(LOOK));
        py.check_signals()?;
    }
}

/// What `work` returns, on a thread of its own; signals and progress are looked at meanwhile.
fn waited_for<T: Send + 'static>(
    py: Python<'_>,
    progress: &Progress,
    told: Option<&Py<PyAny>>,
    work: impl FnOnce() -> Result<T, RunError> + Send + 'static,
) -> PyResult<T> {
    let (done, mut results) = channel();
    let thread = thread::Builder::new().name("phytomer".to_owned()).spawn(move || {
        // A receiver that is gone has been interrupted, and wants no result.
        let _ = done.send(work());
    })?;
    loop {
        let results: &mut Receiver<_> = &mut results;
        let result = py.detach(move || results.recv_timeout(LOOK));
        let looked = py.check_signals().and_then(|()| tell(py, told, progress));
        match result {
            Ok(Ok(grown)) => return looked.map(|()| grown),
            Ok(Err(error)) => return Err(raise::failed(py, &error)),
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err("growth has ended in a panic, which stderr tells"));
            }
            Err(RecvTimeoutError::Timeout) => {}
        }
        if let Err(stopped) = looked {
            progress.stop();
            let begun = Instant::now();
            py.detach(|| {
                while !thread.is_finished() && begun.elapsed() < PATIENCE {
                    thread::sleep(Duration::from_millis(2));
                }
            });
            if !thread.is_finished() {
                STOPPING.lock().unwrap_or_else(PoisonError::into_inner).push(thread);
            }
            return Err(stopped);
        }
    }
}

/// How far the run has come, told to the function of the caller as a dictionary.
fn tell(py: Python<'_>, told: Option<&Py<PyAny>>, progress: &Progress) -> PyResult<()> {
    let Some(told) = told else { return Ok(()) };
    let reading = progress.reading();
    let now = PyDict::new(py);
    now.set_item("seconds", reading.seconds)?;
    now.set_item("share", reading.share)?;
    now.set_item("plants", reading.plants)?;
    now.set_item("plants_in_all", reading.plants_in_all)?;
    now.set_item("components", reading.components)?;
    now.set_item("components_per_s", reading.components_per_s)?;
    now.set_item("bytes", reading.bytes)?;
    now.set_item("left_s", reading.left_s)?;
    told.call1(py, (now,))?;
    Ok(())
}
