//! The verbs, one file each, and what they share: the exit codes and the examples of `--help`.
//!
//! A verb reads its arguments, asks the library and tells what came of it. Absent: any work that a program without a
//! terminal could want; that is the library's.

mod afar;
mod amounts;
mod animate;
mod asystem;
mod bar;
mod budget;
pub mod causes;
mod colouring;
mod completions;
mod constants;
mod convert;
mod derive;
mod describe;
mod events;
mod findings;
mod fit;
mod forest;
mod grow;
mod init;
mod interrupt;
mod list;
mod man;
mod measure;
mod measured;
mod merge;
mod mesh;
pub mod named;
mod out;
mod picture;
mod query;
mod regrown;
mod report;
mod schema;
mod sensitivity;
mod shade;
mod simulated;
mod span;
pub mod terminal;
mod validate;
mod verify;
mod view;

pub use grow::folder_name;

use anyhow::Result;
use clap::{Parser, Subcommand};
use phytomer_config::Report;
use serde_json::json;
use std::ffi::OsString;
use std::io;
use std::process::ExitCode;

const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), " (", env!("PHYTOMER_GIT_HASH"), ")");

const EXAMPLES: &str = "\
Examples:
  phytomer init my_plant                        a species and a scenario to begin with
  phytomer grow coffee                          grow a shipped scenario into runs/coffee
  phytomer merge whole runs/coffee-shard-1-of-2 runs/coffee-shard-2-of-2
  phytomer validate my_plant/scenario.toml      every fault at once
  phytomer derive topiary/4 --step 94           the string of an L-system
  phytomer convert my_tree.xml my_tree.toml     a tree of Arbaro, tree-gen, Sapling or Helios as a species
  phytomer verify runs/coffee                   whether every file of a run is as it was written
  phytomer describe coffee                      what a run, a scenario or a species holds
  phytomer measure runs/coffee bud-life --by order   how long buds live, with intervals of plants
  phytomer list                                 everything that ships
  phytomer schema species                       the JSON Schema of a species file
  phytomer mesh coffee --plant 0 --age 12 --out coffee.ply
  phytomer picture coffee --age 48 --out coffee.png
  phytomer animate coffee --out life.webp       a film of its life
  phytomer view coffee --out life.html          its life as a page that opens in a browser
  phytomer fit nodes.csv --law nodes            a law fitted to counts, with intervals and rivals
  phytomer query --views runs/coffee            its tables as views for DuckDB, or SQL with the feature `sql`
  phytomer forest my_site/site.toml             a landscape from a raster, as a table, meshes and a scene
  phytomer sensitivity coffee --of height_m@48   which of its numbers matter for its height
  phytomer report runs/coffee --out told.html   what became of its plants, as a page with charts
  phytomer asystem my_trees.asys --out drawn    trees by the commands of the A-system
  phytomer shade my_court/site.toml             hours of shade on the zones of a plan, month by month
  phytomer completions bash                     what a shell needs to complete verbs and options
  phytomer man pages                            a manual page for each verb

`phytomer help <verb>` has more of each.";

/// Grow any plant from seed to death, a million at a time, and query the result like a database.
#[derive(Debug, Parser)]
#[command(name = "phytomer", version = VERSION, after_help = EXAMPLES, arg_required_else_help = true)]
pub struct Cli {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    Init(init::Init),
    Grow(grow::Grow),
    Merge(merge::Merge),
    Validate(validate::Validate),
    Derive(derive::Derive),
    Convert(convert::Convert),
    Verify(verify::Verify),
    Describe(describe::Describe),
    Measure(measure::Measure),
    List(list::List),
    Schema(schema::Schema),
    Mesh(mesh::Mesh),
    Picture(picture::Picture),
    Animate(animate::Animate),
    View(view::View),
    Fit(fit::Fit),
    Query(query::Query),
    Forest(forest::ForestVerb),
    Report(report::ReportVerb),
    Sensitivity(sensitivity::Sensitivity),
    Asystem(asystem::Asystem),
    Shade(shade::ShadeVerb),
    Completions(completions::Completions),
    Man(man::ManVerb),
}

/// How the program ends, other than by an error.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// All is done.
    Done = 0,
    /// The run failed, or a plot ended at a limit.
    Failed = 1,
    /// The command line asks for what cannot be.
    Usage = 2,
    /// A file is wrong.
    Invalid = 3,
    /// Ctrl-C.
    Interrupted = 130,
}

impl From<Verdict> for ExitCode {
    fn from(verdict: Verdict) -> Self {
        Self::from(verdict as u8)
    }
}

/// The arguments contradict each other or the input.
#[derive(Debug, Clone, thiserror::Error)]
#[error("{0}")]
pub struct Misuse(pub String);

/// Obeys a command line, whose first word is the name of the program: parse, dispatch, exit code.
///
/// 0 ok, 1 the run failed, 2 usage, 3 invalid input, 130 interrupted. stdout carries data, stderr messages and
/// progress; a reader that closes stdout early (`| head`) ends the program quietly. `--help` and a command line that
/// cannot be parsed end the process.
pub fn main(words: impl IntoIterator<Item = impl Into<OsString> + Clone>) -> Verdict {
    match Cli::parse_from(words).obey() {
        Ok(verdict) => verdict,
        Err(error) if is_closed_pipe(&error) => Verdict::Done,
        Err(error) => {
            terminal::say(&format!("error: {}", causes::in_words(&error)));
            let misuse = error.is::<Misuse>();
            if misuse { Verdict::Usage } else { Verdict::Failed }
        }
    }
}

fn is_closed_pipe(error: &anyhow::Error) -> bool {
    let closed = |cause: &(dyn std::error::Error + 'static)| {
        cause.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
    };
    error.chain().any(closed)
}

impl Cli {
    /// Does what the verb says.
    ///
    /// # Errors
    /// Whatever keeps it from being done.
    pub fn obey(self) -> Result<Verdict> {
        match self.verb {
            Verb::Init(verb) => verb.obey(),
            Verb::Grow(verb) => verb.obey(),
            Verb::Merge(verb) => verb.obey(),
            Verb::Validate(verb) => verb.obey(),
            Verb::Derive(verb) => verb.obey(),
            Verb::Convert(verb) => verb.obey(),
            Verb::Verify(verb) => verb.obey(),
            Verb::Describe(verb) => verb.obey(),
            Verb::Measure(verb) => verb.obey(),
            Verb::List(verb) => verb.obey(),
            Verb::Schema(verb) => verb.obey(),
            Verb::Mesh(verb) => verb.obey(),
            Verb::Picture(verb) => verb.obey(),
            Verb::Animate(verb) => verb.obey(),
            Verb::View(verb) => verb.obey(),
            Verb::Fit(verb) => verb.obey(),
            Verb::Query(verb) => verb.obey(),
            Verb::Forest(verb) => verb.obey(),
            Verb::Report(verb) => verb.obey(),
            Verb::Sensitivity(verb) => verb.obey(),
            Verb::Asystem(verb) => verb.obey(),
            Verb::Shade(verb) => verb.obey(),
            Verb::Completions(verb) => verb.obey(),
            Verb::Man(verb) => verb.obey(),
        }
    }
}

/// Tells every fault: as one JSON object on stdout, or with source lines on stderr.
fn refuse(report: &Report, as_json: bool) -> Result<Verdict> {
    if as_json {
        terminal::put_json(&json!({"status": "invalid", "faults": report.records()}))?;
    } else {
        terminal::say(report.render(terminal::stderr_has_colour()).trim_end());
    }
    Ok(Verdict::Invalid)
}
