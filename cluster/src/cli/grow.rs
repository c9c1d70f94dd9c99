//! `grow`: asks a cluster for a run, and tells what came of it.

use super::process::{host_and_port, runtime, threads_here};
use crate::growing::{Asked, GrowError, Outcome, Ready, prepare};
use crate::local::Local;
use crate::order::Stated;
use crate::parts::Answer;
use crate::store::Store;
use anyhow::Result;
use clap::Args;
use phytomer::cli::{Verdict, causes, folder_name, named::RUNS, terminal};
use phytomer::outputs::Mode;
use phytomer::run::Program;
use serde_json::json;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Grow the plants of a scenario on the executors of a cluster, into the run folder that `phytomer grow` makes.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer-cluster grow coffee --executors 2
  phytomer-cluster grow my_plant/scenario.toml --scheduler 10.0.0.1:50050 --seed 7
  phytomer-cluster grow coffee --scheduler 10.0.0.1:50050 --out /shared/runs/coffee --resume

A scenario file, the files beside it and the run folder must lead to the same files on every machine. Parts are grown in a
folder beside the run folder (`coffee.parts`) and get their names in it when all are there. Exit code 1 where the run
failed or a plant came to its limit, 3 where the scenario is wrong, 130 after Ctrl-C; --resume then goes on, and grows no
part that is whole.")]
pub struct GrowVerb {
    /// A shipped scenario by its name, or a scenario file by its path.
    scenario: String,
    /// A scheduler that runs already.
    #[arg(long, value_name = "HOST:PORT", value_parser = host_and_port, required_unless_present = "executors")]
    scheduler: Option<(String, u16)>,
    /// A scheduler and so many executors on this machine, for this run.
    #[arg(long, value_name = "NUMBER", conflicts_with = "scheduler", value_parser = clap::value_parser!(u16).range(1..=256))]
    executors: Option<u16>,
    /// The threads of each of these executors; if not given, those of the machine are shared.
    #[arg(long, requires = "executors", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// The seed of every draw, in the place of the scenario's.
    #[arg(long)]
    seed: Option<u64>,
    /// How many plants grow, in the place of the scenario's number.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=1_000_000_000))]
    plants: Option<u32>,
    /// The run folder; `runs/<name>` if not given.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Go on with an interrupted run; parts that are whole are kept.
    #[arg(long, conflicts_with = "overwrite")]
    resume: bool,
    /// Replace the run that is in the folder.
    #[arg(long)]
    overwrite: bool,
    /// Begin even where more is expected than the disk has room for.
    #[arg(long)]
    ignore_disk: bool,
    /// Tell what came of it as one JSON object on stdout.
    #[arg(long)]
    json: bool,
    /// Show no progress, and at the end nothing but trouble.
    #[arg(long, short)]
    quiet: bool,
}

impl GrowVerb {
    pub fn obey(self) -> Result<Verdict> {
        let local = self.executors.map(|executors| {
            let executors = usize::from(executors);
            let threads = self.threads.map_or_else(|| (threads_here() / executors).max(1), usize::from);
            Local::start(executors, threads)
        });
        let local = local.transpose()?;
        let there = self.scheduler.as_ref().map(|(host, port)| format!("{host}:{port}"));
        let scheduler = local.as_ref().map(|local| local.scheduler.clone()).or(there).unwrap_or_default();
        let stated = Stated { scenario: self.scenario.clone(), seed: self.seed, plants: self.plants }.from_the_root();
        let out = match &self.out {
            Some(out) => out.clone(),
            None => match stated.resolved() {
                Ok(resolved) => Path::new(RUNS).join(folder_name(&resolved.scenario.name)?),
                Err(report) => return refuse(&report, self.json),
            },
        };
        let mode = match (self.resume, self.overwrite) {
            (true, _) => Mode::Resume,
            (_, true) => Mode::Overwrite,
            _ => Mode::New,
        };
        let program = Program::default();
        let asked = Asked { stated, out: out.clone(), mode, ignore_disk: self.ignore_disk, scheduler, program };
        match self.grown(asked) {
            Ok(Some(outcome)) => self.tell(&out, &outcome),
            Ok(None) => Ok(Verdict::Interrupted),
            Err(GrowError::Invalid(report)) => refuse(&report, self.json),
            Err(error @ (GrowError::Cluster { .. } | GrowError::Parts { .. } | GrowError::Counts(_))) => {
                terminal::say(&format!("error: {}", causes::in_words(&error.into())));
                terminal::say("what is whole is kept; the same command with --resume goes on");
                Ok(Verdict::Failed)
            }
            Err(error) => Err(error.into()),
        }
    }

    /// Grows and merges; `None` after Ctrl-C.
    fn grown(&self, asked: Asked) -> Result<Option<Option<Outcome>>, GrowError> {
        let threads = |error: anyhow::Error| GrowError::Cluster { there: 0, shards: 0, source: error.into() };
        let runtime = runtime().map_err(threads)?;
        let answers = runtime.block_on(async {
            let Some(ready) = prepare(asked).await? else { return Ok(Some(None)) };
            self.say(&format!("{} parts of {} are to be grown", ready.missing(), ready.shards()));
            Ok::<_, GrowError>(self.answers(&ready).await?.map(|answers| Some((ready, answers))))
        })?;
        match answers {
            None => Ok(None),
            Some(None) => Ok(Some(None)),
            Some(Some((ready, answers))) => Ok(Some(Some(ready.finish(&answers)?))),
        }
    }

    /// The answers of the executors; `None` after Ctrl-C.
    async fn answers(&self, ready: &Ready) -> Result<Option<Vec<Answer>>, GrowError> {
        let answers = tokio::select! {
            answers = ready.grow() => answers.map(Some),
            _ = tokio::signal::ctrl_c() => Ok(None),
            () = self.watch(ready.store(), ready.shards()) => Ok(None),
        };
        match &answers {
            Ok(Some(_)) => {}
            Ok(None) => {
                ready.stop();
                terminal::say("stopped; what is whole is kept, and the same command with --resume goes on");
            }
            // Nobody waits for the other parts any more.
            Err(_) => ready.stop(),
        }
        answers
    }

    /// Says how many parts there are, whenever it has changed.
    async fn watch(&self, store: Store, shards: u32) {
        let mut said = 0;
        loop {
            tokio::time::sleep(Duration::from_secs(1)).await;
            let there = store.there();
            if there != said {
                self.say(&format!("{there} of {shards} parts are whole"));
                said = there;
            }
        }
    }

    fn say(&self, text: &str) {
        if !self.quiet && !self.json {
            terminal::say(text);
        }
    }

    fn tell(&self, out: &Path, outcome: &Option<Outcome>) -> Result<Verdict> {
        let Some(Outcome { merged, grown_now, by_executor }) = outcome else {
            if self.json {
                terminal::put_json(
                    &json!({ "status": "complete", "run": out.display().to_string(), "parts_grown_now": 0 }),
                )?;
            }
            self.say(&format!("{} is complete already", out.display()));
            return Ok(Verdict::Done);
        };
        let report = &merged.report;
        let plants = report.living + report.dead;
        if self.json {
            terminal::put_json(&json!({
                "status": "complete",
                "run": out.display().to_string(),
                "plants": plants,
                "living": report.living,
                "dead": report.dead,
                "components": report.components,
                "rows": report.rows,
                "files": report.files.len(),
                "bytes": report.bytes,
                "parts": merged.shards,
                "parts_grown_now": grown_now,
                "parts_by_executor": by_executor,
                "overgrown": report.overgrown,
            }))?;
        } else if !self.quiet {
            let (parts, out) = (merged.shards, out.display());
            let by: Vec<String> = by_executor.iter().map(|(name, parts)| format!("  {name}: {parts}")).collect();
            terminal::put(&format!(
                "{out}: a complete run: {parts} parts, {plants} plants, {} files\nparts grown now: {grown_now}\n{}\n\nNext:\n  \
                 phytomer verify {out}",
                report.files.len(),
                by.join("\n")
            ))?;
        }
        if report.overgrown.is_empty() {
            return Ok(Verdict::Done);
        }
        terminal::say(&format!("{} plots ended at a limit; run.json names them", report.overgrown.len()));
        Ok(Verdict::Failed)
    }
}

/// Tells every fault of a scenario.
fn refuse(report: &phytomer::config::Report, as_json: bool) -> Result<Verdict> {
    if as_json {
        terminal::put_json(&json!({ "status": "invalid", "faults": report.records() }))?;
    } else {
        terminal::say(report.render(terminal::stderr_has_colour()).trim_end());
    }
    Ok(Verdict::Invalid)
}
