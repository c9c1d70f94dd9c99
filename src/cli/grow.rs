//! `grow`: the main job, from a scenario's name to a run folder, with what a person wants to know on the way.
//!
//! Ctrl-C gives up the parts that are being grown, keeps those that are complete and tells how to go on; a second one
//! ends at once. Absent: the run itself (`phytomer::run`), and what is told at its end ([`telling`]).

mod telling;

pub use telling::{clock, species_in_words};

use super::constants::{Constants, OF_A_SCENARIO};
use super::named::RUNS;
use super::{Misuse, Verdict, bar, causes, events, findings, interrupt, refuse, terminal};
use anyhow::Result;
use clap::{Args, ValueEnum};
use phytomer::outputs::{Error, Mode, Share};
use phytomer::run::forecast::Forecast;
use phytomer::run::{self, Begun, Outcome, Progress, RunError, Settings};
use phytomer::run::{disk, forms};
use phytomer_config::scenario::MOST_SEED;
use phytomer_config::{Kind, Resolved, kind_of, validate_with};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Grow the plants of a scenario from seed to the last age, into a run folder of tables and meshes.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer grow coffee
  phytomer grow coffee --dry-run
  phytomer grow my_plant/scenario.toml --seed 7 --name another_seed
  phytomer grow coffee --plants 20 --out twenty --threads 2
  phytomer grow coffee --resume
  phytomer grow coffee --shard 1/2
  phytomer grow coffee --progress json
  phytomer grow halle/massart
  phytomer grow abop/2.8a -D lr=1.2

Exit code 1 where a plant came to its limit, where another process fills the folder, where the disk is too small or a file
could not be written, 3 where the scenario is wrong, 130 after Ctrl-C; --resume then goes on and ends with the same bytes.
It reads and compares every file that it keeps, and grows damaged or missing parts again.")]
pub struct Grow {
    /// A shipped scenario by its name, or a scenario file by its path. A species by itself is one plant, grown to the
    /// age at which its file says that it shows its architecture.
    scenario: String,
    #[command(flatten)]
    constants: Constants,
    /// Threads; as many as the machine has if not given. No result depends on it.
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// The seed of every draw, from 0 to 2^63 - 1, in the place of the scenario's.
    #[arg(long, allow_negative_numbers = true, value_parser = seed)]
    seed: Option<u64>,
    /// How many plants grow, in the place of the scenario's number; of plots with several members whole plots.
    /// Meshes of plants that then do not grow are left out.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=1_000_000_000))]
    plants: Option<u32>,
    /// The run folder; `runs/<name>` if not given.
    #[arg(long, value_name = "DIR", conflicts_with = "name")]
    out: Option<PathBuf>,
    /// The folder's name below `runs`; that of the scenario if not given.
    #[arg(long)]
    name: Option<String>,
    /// Go on with an interrupted run, or mend a damaged one; what is complete and sound is kept.
    #[arg(long, conflicts_with = "overwrite")]
    resume: bool,
    /// Replace the run that is in the folder.
    #[arg(long)]
    overwrite: bool,
    /// Grow a fixed part of the run alone, such as 3/16, on one of several machines: every sixteenth of its part files,
    /// into `runs/<name>-shard-03-of-16` if no folder is given. `phytomer merge` makes the run of all shards.
    #[arg(long, value_name = "NUMBER/ALL")]
    shard: Option<Share>,
    /// Begin even where more is expected than the disk has room for. The run still ends before the disk is full.
    #[arg(long)]
    ignore_disk: bool,
    /// Tell what is expected of the run, and write nothing.
    #[arg(long)]
    dry_run: bool,
    /// Tell what came of it as one JSON object on stdout.
    #[arg(long)]
    json: bool,
    /// How progress is shown: a bar where stderr is a terminal, or `json`, an event a line on stderr.
    #[arg(long, value_enum, default_value_t)]
    progress: Shown,
    /// Show no progress, and at the end nothing but trouble.
    #[arg(long, short)]
    quiet: bool,
}

/// How progress is shown.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
enum Shown {
    /// A bar where stderr is a terminal.
    #[default]
    Bar,
    /// A JSON object a line on stderr, for programs.
    Json,
}

impl Grow {
    pub fn obey(self) -> Result<Verdict> {
        if !self.constants.is_empty() && kind_of(&self.scenario) == Kind::Scenario {
            return Err(Misuse(OF_A_SCENARIO.to_owned()).into());
        }
        let mut resolved = match validate_with(&self.scenario, &self.constants.surroundings()) {
            Ok(resolved) => resolved,
            Err(report) => return refuse(&report, self.json),
        };
        if !self.constants.is_empty() && !resolved.species.reads_surroundings() {
            return Err(Misuse(format!("-D: `{}` has no L-system in a file of its own", self.scenario)).into());
        }
        if let Err(report) = forms::settle(&mut resolved) {
            return refuse(&report, self.json);
        }
        if let Some(seed) = self.seed
            && let Err(report) = resolved.reseed(seed)
        {
            return refuse(&report, self.json);
        }
        self.override_plants(&mut resolved)?;
        let settings = self.settings(&resolved)?;
        if self.dry_run {
            let parts = run::plan_of(&resolved, &settings.program)?.shards();
            let forecast = Forecast::of(&resolved);
            telling::forecast(&resolved, forecast.as_ref(), (parts, disk::room(&settings)), self.json)?;
            return Ok(Verdict::Done);
        }
        let progress = Arc::new(Progress::default());
        Self::listen(&progress)?;
        match self.grow(&resolved, &settings, &progress) {
            Err(error) if matches!(error.downcast_ref(), Some(RunError::Outputs(Error::Stopped))) => {
                terminal::say(&format!("stopped before anything was grown; go on with\n  {}", self.again()));
                Ok(Verdict::Interrupted)
            }
            Err(error) if causes::is_full_disk(&error) => {
                terminal::say(&format!("error: {}; go on with\n  {}", causes::in_words(&error), self.again()));
                Ok(Verdict::Failed)
            }
            verdict => verdict,
        }
    }

    /// Makes the folder ready, tells what was found in it, and grows.
    fn grow(&self, resolved: &Resolved, settings: &Settings, progress: &Progress) -> Result<Verdict> {
        let begin = || run::begin(resolved, settings, progress);
        let begun = match self.progress {
            Shown::Json if !self.quiet => events::checking(progress.checking(), begin)?,
            _ => bar::checking(progress.checking(), self.quiet || self.json, begin)?,
        };
        say_before(&begun);
        let found = begun.found().map(findings::as_json);
        let grow = || begun.grow(progress);
        let outcome = match self.progress {
            Shown::Json if !self.quiet => events::growing(progress, status, grow)?,
            _ => bar::growing(progress, self.quiet || self.json, grow)?,
        };
        self.tell(&telling::Told { resolved, settings, outcome: &outcome, found })
    }

    /// The number of plants as the command line has it.
    fn override_plants(&self, resolved: &mut Resolved) -> Result<()> {
        let Some(plants) = self.plants else { return Ok(()) };
        let left_out = resolved.grow_only(plants);
        if left_out > 0 && !self.quiet {
            let (noun, verb) = if left_out == 1 { ("plant", "does") } else { ("plants", "do") };
            terminal::say(&format!(
                "note: the meshes of {left_out} {noun} that the scenario asks for are left out: with --plants {plants} the \
                 {noun} {verb} not grow"
            ));
        }
        match resolved.faults().first() {
            Some((_, fault)) => {
                Err(Misuse(format!("--plants {plants}: {}; expected {}", fault.problem, fault.expected)).into())
            }
            None => Ok(()),
        }
    }

    fn settings(&self, resolved: &Resolved) -> Result<Settings> {
        let name = self.name.as_ref().unwrap_or(&resolved.scenario.name);
        let folder = match &self.out {
            Some(folder) => folder.clone(),
            None => Path::new(RUNS).join(folder_name(name)? + &self.shard.map(end_of_name).unwrap_or_default()),
        };
        let mode = match (self.resume, self.overwrite) {
            (true, _) => Mode::Resume,
            (_, true) => Mode::Overwrite,
            _ => Mode::New,
        };
        let threads = self.threads.unwrap_or(0).into();
        let (ignore_disk, share) = (self.ignore_disk, self.shard);
        Ok(Settings { mode, threads, ignore_disk, share, ..Settings::in_folder(folder) })
    }

    fn listen(progress: &Arc<Progress>) -> Result<()> {
        let (asked, told) = (Arc::clone(progress), Arc::clone(progress));
        let words = "stopping; complete parts are kept";
        interrupt::listen(move || asked.is_stopped(), move || told.stop(), words)
    }

    fn tell(&self, told: &telling::Told) -> Result<Verdict> {
        let verdict = told.verdict();
        if self.json {
            terminal::put_json(&told.as_json())?;
        } else if verdict != Verdict::Interrupted && !self.quiet {
            terminal::put(&told.as_text())?;
        }
        if !told.outcome.report.overgrown.is_empty() {
            terminal::say(&told.overgrown());
        }
        if verdict == Verdict::Interrupted {
            terminal::say(&told.interrupted(&self.again()));
        }
        Ok(verdict)
    }

    /// The command that goes on with this run.
    fn again(&self) -> String {
        let mut words = vec!["phytomer".to_owned(), "grow".to_owned(), shown(&self.scenario)];
        let mut option = |name: &str, value: Option<String>| {
            words.extend(value.into_iter().flat_map(|value| [format!("--{name}"), shown(&value)]));
        };
        option("seed", self.seed.map(|seed| seed.to_string()));
        option("plants", self.plants.map(|plants| plants.to_string()));
        option("out", self.out.as_ref().map(|folder| folder.display().to_string()));
        option("name", self.name.clone());
        option("shard", self.shard.map(|share| share.to_string()));
        words.extend(self.constants.words().map(|word| shown(&word)));
        words.extend(self.ignore_disk.then(|| "--ignore-disk".to_owned()));
        words.push("--resume".to_owned());
        words.join(" ")
    }
}

/// How growth ended, in a word.
fn status(result: &std::result::Result<Outcome, RunError>) -> &'static str {
    result.as_ref().map_or("failed", telling::status)
}

/// What follows the name of the run in the name of a shard's folder: "-shard-03-of-16", so that names sort as numbers.
fn end_of_name(share: Share) -> String {
    let digits = share.of().to_string().len();
    format!("-shard-{:0digits$}-of-{}", share.number(), share.of())
}

/// A seed that a scenario can state too.
fn seed(text: &str) -> std::result::Result<u64, String> {
    text.parse::<u64>()
        .ok()
        .filter(|seed| *seed <= MOST_SEED)
        .ok_or_else(|| format!("a whole number from 0 to {MOST_SEED} (2^63 - 1) is expected"))
}

/// Tells what a person should know before anything grows: that a lock is missing, and what a resumed run mends.
fn say_before(begun: &Begun) {
    if let Some(why) = begun.unlockable() {
        terminal::say(&format!(
            "warning: the file system cannot lock the run folder ({why}): see to it that no second run fills it"
        ));
    }
    let Some(found) = begun.found().filter(|found| !found.findings.is_empty()) else { return };
    let list = |foreign: bool| -> String {
        found.findings(foreign).map(|finding| format!("\n  {}: {}", finding.path, finding.trouble.in_words())).collect()
    };
    let (own, foreign) = (list(false), list(true));
    if !own.is_empty() {
        let parts = match found.to_grow.as_slice() {
            [] => "no part is grown again, and what is damaged or missing is written anew".to_owned(),
            parts => format!("parts to grow: {}", parts.iter().map(u32::to_string).collect::<Vec<_>>().join(", ")),
        };
        terminal::say(&format!("not as the run had written it:{own}\n{parts}"));
    }
    if !foreign.is_empty() {
        terminal::say(&format!("foreign files, left alone:{foreign}"));
    }
}

/// A word as a shell takes it.
fn shown(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "/._-+=:,@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

/// A name as a folder's: what some system might take amiss becomes `-`.
///
/// # Errors
/// Where nothing is left of it.
pub fn folder_name(name: &str) -> Result<String> {
    let plain = |c: char| if c.is_alphanumeric() || "._-+".contains(c) { c } else { '-' };
    let folder: String = name.trim().chars().map(plain).collect();
    let folder = folder.trim_start_matches('.').to_owned();
    if folder.is_empty() {
        return Err(Misuse(format!("`{name}` cannot be the name of a folder: choose one by --name or --out")).into());
    }
    Ok(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stay_below_the_folder_of_runs() {
        let name = |name: &str| folder_name(name).unwrap();
        assert_eq!(name("coffee"), "coffee");
        assert_eq!(name("gmt1/5a"), "gmt1-5a");
        assert_eq!(name("../../etc"), "-..-etc");
        assert_eq!(name("Kaffee, süß"), "Kaffee--süß");
        assert!(folder_name("..").is_err());
    }

    #[test]
    fn words_are_quoted_for_the_shell() {
        assert_eq!([shown("a/b.toml"), shown("my plant"), shown("it's")], ["a/b.toml", "'my plant'", "'it'\\''s'"]);
    }
}
