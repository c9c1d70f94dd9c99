//! The command line of `phytomer-cluster`: a scheduler, an executor, and a run that is asked for.
//!
//! stdout carries data, stderr messages; exit codes are those of `phytomer`: 0 all is done, 1 the run failed, 2 usage,
//! 3 the scenario is wrong, 130 after Ctrl-C. Absent: what the verbs do.

mod grow;
mod process;
mod serving;

use clap::{Parser, Subcommand};
use phytomer::cli::{Misuse, Verdict, causes, terminal};
use std::process::ExitCode;

/// Grow a run on many machines: its parts are dealt to executors, and become the files of `phytomer grow`.
#[derive(Debug, Parser)]
#[command(
    name = "phytomer-cluster",
    version,
    arg_required_else_help = true,
    after_help = "\
Examples:
  phytomer-cluster grow coffee --executors 2             a cluster on this machine, for this run
  phytomer-cluster scheduler --listen 10.0.0.1:50050     on one machine
  phytomer-cluster executor --scheduler 10.0.0.1:50050 --listen 10.0.0.2
  phytomer-cluster grow coffee --scheduler 10.0.0.1:50050

All machines have one version of the program and see the run folder under one path. A cluster trusts its network: nothing
is encrypted, and whoever reaches a port can ask for work. `phytomer-cluster help <verb>` has more of each."
)]
struct Cli {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    Scheduler(serving::SchedulerVerb),
    Executor(serving::ExecutorVerb),
    Grow(grow::GrowVerb),
}

/// Obeys the command line of the process.
pub fn main() -> ExitCode {
    let done = match Cli::parse().verb {
        Verb::Scheduler(verb) => verb.obey(),
        Verb::Executor(verb) => verb.obey(),
        Verb::Grow(verb) => verb.obey(),
    };
    let verdict = done.unwrap_or_else(|error| {
        terminal::say(&format!("error: {}", causes::in_words(&error)));
        if error.is::<Misuse>() { Verdict::Usage } else { Verdict::Failed }
    });
    verdict.into()
}
