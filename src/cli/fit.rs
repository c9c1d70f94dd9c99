//! `fit`: from counts of plants to the keys of a species, with intervals.
//!
//! A table of measured plants is read, every rival of the law is fitted (`phytomer_fits`), and a species is written
//! that inherits from a base and has the fitted keys alone, with `fit.json` beside it. Absent: estimates and readers of
//! CSV, which are the library's.

mod abc;
mod gmt;
mod told;

use super::{Misuse, Verdict, refuse, terminal};
use anyhow::{Context, Result};
use clap::{Args, Subcommand, ValueEnum};
use phytomer::counted;
use phytomer_config::validate_texts;
use phytomer_fits::check::{Checked, Material, check};
use phytomer_fits::data::columns::LAWS;
use phytomer_fits::data::{Fault, Law, Table, read};
use phytomer_fits::outcome::{Outcome, fit};
use phytomer_fits::wanted::Wanted;
use phytomer_fits::{json, stated};
use phytomer_outputs::destination::{Destination, is_stdout};
use serde_json::json;
use sha2::{Digest, Sha256};
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// The most bytes of a file of data.
const MOST_BYTES: u64 = 1 << 30;

/// The seed of what a check draws.
const SEED: u64 = 1988;

/// Fit a law to measured plants, and write it as a species.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
#[command(after_help = "\
Examples:
  phytomer fit --sample nodes                   a table as it is read, with the columns of a law
  phytomer fit nodes.csv --law nodes            every rival law with its BIC, the one that is taken with intervals
  phytomer fit nodes.csv --law nodes --base poplar --order 2 --out my_poplar.toml
  phytomer fit days.csv --law activity --window 0..180 --base coffee --out my_coffee.toml
  phytomer fit nodes.csv --law nodes --json --check 20
  phytomer fit runs/coffee --law mortality --order 2                   what a run would have told
  phytomer fit seen.csv --law abc --base priors.toml --out fitted.toml   numbers with a `prior`, by simulation
  phytomer fit gmt --help                       ratios, angles and more of a geometric tree, from its branches
  phytomer fit runs/coffee --law abc --summary height_m@48 --base coffee --vary order.1.pause=0.02..0.3

Columns of each law (CSV with a header, or Parquet with these columns):
  activity     nodes made in one window by each axis; days of the window may be left out
               or axis, day, nodes: cumulative nodes, day by day; waiting times without --window
  mortality    age, axes, dead: axes of an age seen once; or age, died: axes followed to death (1) or the end (0)
  nodes        nodes of a growth unit; count of such units may be left out
  crown        above: nodes of the bearer above a pair of living branches; first, second: nodes of the two
  branching    axis, rank from 1, fate in a word (a state of the species, or latent)
  abc          summary (height_m@60; see `phytomer sensitivity --help`), value; plants may be left out
A column `plant` may stand beside those of any law: --check then leaves whole plants out. DATA may be a run folder:
axes of --order are counted, with ticks as days; activity then needs --window.

The species inherits from --base and holds the fitted keys alone, each with source, n and interval; fit.json, beside it,
has estimates, covariance, log-likelihood, BIC and tests of all rivals. docs/statistics.md has every formula. Exit code 3
where the file is wrong or the law cannot be estimated: nothing is written then.")]
pub struct Fit {
    #[command(subcommand)]
    tree: Option<Tree>,
    /// The table: .csv, .txt or .parquet; or a run folder.
    #[arg(value_name = "DATA", required_unless_present = "sample")]
    data: Option<PathBuf>,
    /// What is fitted.
    #[arg(long, value_enum, required_unless_present = "sample")]
    law: Option<Word>,
    /// The species file that is written; fit.json comes beside it.
    #[arg(long, value_name = "SPECIES.toml", requires = "base")]
    out: Option<PathBuf>,
    /// The species that it inherits from: the name of a shipped one, or a file.
    #[arg(long, value_name = "SPECIES")]
    base: Option<String>,
    /// The order of the measured axes; 1 is the trunk.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=64))]
    order: u32,
    /// Only rows with this text in a column.
    #[arg(long = "where", value_name = "COLUMN=TEXT")]
    only: Vec<String>,
    /// The days between which nodes are counted.
    #[arg(long, value_name = "FROM..TO")]
    window: Option<String>,
    /// Waiting times that began before this day.
    #[arg(long, value_name = "DAY")]
    before: Option<u32>,
    /// The variable of a hazard [default: cycle; of a run: dimension].
    #[arg(long, value_parser = ["cycle", "dimension", "age"])]
    over: Option<String>,
    /// The ranks of a zone of branching.
    #[arg(long, default_value_t = 6, value_parser = clap::value_parser!(u32).range(1..=1000))]
    zone: u32,
    /// The zones of a chain of branching.
    #[arg(long, default_value_t = 6, value_parser = clap::value_parser!(u32).range(2..=12))]
    chain: u32,
    /// The end from which ranks are counted.
    #[arg(long, default_value = "tip", value_parser = ["tip", "base"])]
    from: String,
    /// Where the data come from, for `source`; left out: the name of the file.
    #[arg(long, value_name = "TEXT")]
    source: Option<String>,
    /// Fit so many tables drawn from the fitted law, compare a measure that was not fitted, and predict what is left
    /// out.
    #[arg(long, value_name = "TIMES", num_args = 0..=1, default_missing_value = "200", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    check: Option<u32>,
    /// Print the sample table of a law instead.
    #[arg(long, value_name = "LAW", value_parser = ["activity", "activity-days", "mortality", "mortality-followed", "nodes", "crown", "branching", "abc"])]
    sample: Option<String>,
    /// The contents of fit.json on stdout.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    abc: abc::Abc,
}

/// What is fitted beside laws.
#[derive(Debug, Subcommand)]
enum Tree {
    Gmt(Box<gmt::Gmt>),
}

/// The laws that can be fitted.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Word {
    Activity,
    Mortality,
    Nodes,
    Crown,
    Branching,
    /// No likelihood: simulation of the numbers that have a prior.
    Abc,
}

impl Word {
    /// The law; `None` for what is simulated.
    fn law(self) -> Option<Law> {
        match self {
            Self::Activity => Some(Law::Activity),
            Self::Mortality => Some(Law::Mortality),
            Self::Nodes => Some(Law::Nodes),
            Self::Crown => Some(Law::Crown),
            Self::Branching => Some(Law::Branching),
            Self::Abc => None,
        }
    }
}

impl Fit {
    pub fn obey(self) -> Result<Verdict> {
        if let Some(Tree::Gmt(tree)) = self.tree {
            return tree.obey();
        }
        if let Some(law) = &self.sample {
            return sample(law);
        }
        let (Some(path), Some(law)) = (&self.data, self.law) else {
            return Err(Misuse("`fit` needs a table and --law".to_owned()).into());
        };
        self.check_out()?;
        let Some(law) = law.law() else { return abc::fit(&self, path) };
        if let Some(option) = self.abc.given() {
            return Err(Misuse(format!("{option} is for --law abc, which simulates; this law has a likelihood")).into());
        }
        let loaded = if path.is_dir() { self.counted(path, law)? } else { load(path)? };
        let (table, hash) = match loaded {
            Ok(loaded) => loaded,
            Err(faults) => return decline(&faults, self.json),
        };
        let table = match self.chosen(table)? {
            Ok(table) => table,
            Err(fault) => return decline(&[fault], self.json),
        };
        let data = match read(law, &table) {
            Ok(data) => data,
            Err(faults) => return decline(&faults, self.json),
        };
        let wanted = self.wanted(path)?;
        match fit(law, &data, &wanted) {
            Ok(outcome) => {
                let material = Material { outcome: &outcome, data: &data, table: &table, wanted: &wanted };
                let checked = self.check.map(|times| check(&material, times as usize, SEED));
                self.finish(&outcome, checked.as_ref(), path, &hash)
            }
            Err(problem) => self.not_estimated(path, &problem.to_string()),
        }
    }

    /// Tells why nothing was estimated.
    fn not_estimated(&self, path: &Path, problem: &str) -> Result<Verdict> {
        let problem = format!("{}: {problem}", path.display());
        if self.json {
            terminal::put_json(&json!({"status": "not estimated", "problem": problem}))?;
        } else {
            terminal::say(&problem);
        }
        Ok(Verdict::Invalid)
    }

    /// What is counted on the plants of a run, with the hash of its `run.json`, which has those of its tables.
    fn counted(&self, path: &Path, law: Law) -> Result<Loaded> {
        if law == Law::Activity && self.window.is_none() {
            let words = "a run knows its ticks: name the window in which growth is counted, such as --window 12..36";
            return Err(Misuse(format!("{}: {words}", path.display())).into());
        }
        let table = match counted::table(path, law, self.order) {
            Ok(table) => table,
            Err(problem) => {
                let expected = "a finished run with such axes".to_owned();
                let file = path.display().to_string();
                return Ok(Err(vec![Fault { file, line: None, column: None, problem, expected }]));
            }
        };
        let json = path.join("run.json");
        let bytes = std::fs::read(&json).with_context(|| format!("cannot read {}", json.display()))?;
        Ok(Ok((table, hash_of(&bytes))))
    }

    fn check_out(&self) -> Result<(), Misuse> {
        match &self.out {
            Some(out) if is_stdout(out) => {
                Err(Misuse("--out -: a species and fit.json are two files; name one".to_owned()))
            }
            Some(out) if out.extension().is_none_or(|ending| !ending.eq_ignore_ascii_case("toml")) => {
                Err(Misuse(format!("--out {}: a species file ends in .toml", out.display())))
            }
            _ => Ok(()),
        }
    }

    fn wanted(&self, path: &Path) -> Result<Wanted, Misuse> {
        let window = self.window.as_ref().map(|text| {
            let days = text.split_once("..").and_then(|(from, to)| Some((from.parse().ok()?, to.parse().ok()?)));
            let wrong = || Misuse(format!("--window {text}: two days in order are expected, such as 0..39"));
            days.filter(|(from, to): &(u32, u32)| from < to).ok_or_else(wrong)
        });
        let name = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        Ok(Wanted {
            window: window.transpose()?,
            before: self.before,
            over: self.over.clone().unwrap_or_else(|| if path.is_dir() { "dimension" } else { "cycle" }.to_owned()),
            zone: self.zone as usize,
            chain: self.chain as usize,
            from: self.from.clone(),
            source: self.source.clone().unwrap_or(name),
            ..Wanted::default()
        })
    }

    /// The rows that `--where` asks for.
    fn chosen(&self, mut table: Table) -> Result<Result<Table, Fault>, Misuse> {
        for only in &self.only {
            let Some((column, text)) = only.split_once('=') else {
                return Err(Misuse(format!("--where {only}: COLUMN=TEXT is expected, such as dataset=peup1")));
            };
            table = match table.only(column, text) {
                Ok(table) => table,
                Err(fault) => return Ok(Err(fault)),
            };
        }
        Ok(Ok(table))
    }

    fn finish(&self, outcome: &Outcome, checked: Option<&Checked>, path: &Path, hash: &str) -> Result<Verdict> {
        let mut object = json::object(outcome, &path.display().to_string(), hash);
        if let Some(checked) = checked {
            object["check"] = json::checked(checked);
        }
        if let (Some(out), Some(base)) = (&self.out, &self.base)
            && let Some(verdict) = self.write(outcome, (out, base), &object)?
        {
            return Ok(verdict);
        }
        if self.json {
            terminal::put_json(&object)?
        } else {
            terminal::put(&told::table(outcome))?;
            checked.map(|checked| terminal::put(&told::checked(checked))).transpose()?;
        }
        Ok(Verdict::Done)
    }

    /// Checks the species by the model, then writes both files; a verdict where the model refuses it.
    fn write(
        &self,
        outcome: &Outcome,
        (out, base): (&Path, &str),
        object: &serde_json::Value,
    ) -> Result<Option<Verdict>> {
        let name = out.file_stem().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        let about = format!("Fitted by phytomer fit: {}.", outcome.taken().law);
        let species = stated::species(base, &name, self.order as usize, &outcome.stated, &about);
        self.write_files(out, base, species, object)
    }

    /// Checks a species by its model, then writes it and fit.json; a verdict where the model refuses it.
    fn write_files(
        &self,
        out: &Path,
        base: &str,
        species: String,
        object: &serde_json::Value,
    ) -> Result<Option<Verdict>> {
        let shown = out.display().to_string();
        let of_base = if base.ends_with(".toml") {
            Some(std::fs::read_to_string(base).with_context(|| format!("cannot read {base}"))?)
        } else {
            None
        };
        let texts: Vec<(&str, &str)> = [(shown.as_str(), species.as_str())]
            .into_iter()
            .chain(of_base.as_deref().map(|text| (base, text)))
            .collect();
        if let Err(report) = validate_texts(&shown, &texts) {
            return refuse(&report, self.json).map(Some);
        }
        for (path, text) in [(out.to_owned(), species), (out.with_file_name("fit.json"), format!("{object:#}\n"))] {
            let mut file = Destination::create(&path)?;
            file.write_all(text.as_bytes()).with_context(|| format!("cannot write {}", path.display()))?;
            file.finish()?;
            terminal::say(&format!("{} is written", path.display()));
        }
        Ok(None)
    }
}

/// Tells what is wrong with a file.
fn decline(faults: &[Fault], as_json: bool) -> Result<Verdict> {
    if as_json {
        let faults: Vec<_> = faults
            .iter()
            .map(|f| json!({"file": f.file, "line": f.line, "column": f.column, "problem": f.problem, "expected": f.expected}))
            .collect();
        terminal::put_json(&json!({"status": "invalid", "faults": faults}))?;
    } else {
        faults.iter().for_each(|fault| terminal::say(&fault.to_string()));
    }
    Ok(Verdict::Invalid)
}

/// The sample of a law on stdout.
fn sample(law: &str) -> Result<Verdict> {
    if law == "abc" {
        return terminal::put(phytomer_fits::data::observed::SAMPLE.trim_end()).map(|()| Verdict::Done);
    }
    let words = match law {
        "activity-days" => "activity, day by day",
        "mortality" => "mortality, seen once",
        "mortality-followed" => "mortality, followed",
        other => other,
    };
    let sample = LAWS.iter().find(|(_, own, ..)| *own == words).map(|(.., sample)| *sample);
    let sample = sample.ok_or_else(|| Misuse(format!("no law is called {law}")))?;
    terminal::put(sample.trim_end())?;
    Ok(Verdict::Done)
}

/// A table with the hash of its file, or its faults.
type Loaded = std::result::Result<(Table, String), Vec<Fault>>;

/// The SHA-256 of bytes.
fn hash_of(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// A table with the hash of its file.
fn load(path: &Path) -> Result<Loaded> {
    let shown = path.display().to_string();
    let told = |problem: String, expected: &str| {
        vec![Fault { file: shown.clone(), line: None, column: None, problem, expected: expected.to_owned() }]
    };
    let length = std::fs::metadata(path).with_context(|| format!("cannot read {shown}"))?.len();
    if length > MOST_BYTES {
        return Ok(Err(told(
            format!("it has {length} bytes"),
            "a table of at most 1 GiB; count first, and fit the counts",
        )));
    }
    let bytes = std::fs::read(path).with_context(|| format!("cannot read {shown}"))?;
    let hash = hash_of(&bytes);
    if bytes.starts_with(b"PAR1") {
        return Ok(match phytomer_outputs::cells::read(path) {
            Ok((names, rows)) => {
                let rows = (1..).zip(rows).collect();
                Ok((Table { file: shown, names, rows }, hash))
            }
            Err(problem) => Err(told(format!("it {problem}"), "a Parquet file of numbers and texts")),
        });
    }
    Ok(Table::from_csv(&shown, &bytes).map(|table| (table, hash)))
}
