//! `convert`: a parametric tree of another program as a species, and plants between programs.
//!
//! What is written tells which: a species ends in `.toml`, the files of plants have endings of their own (`plants`).
//! What becomes of each key of a species is told on stdout, or on stderr where stdout carries it. Nothing is written
//! where the model does not take the numbers. Absent: reading and mapping (`phytomer_peers`).

mod plants;

use super::{Misuse, Verdict, terminal};
use anyhow::{Context, Result};
use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::{Args, ValueEnum};
use phytomer_config::{FaultRecord, Report, validate_texts};
use phytomer_outputs::destination::{Destination, is_folder, is_stdout};
use phytomer_peers::{Asked, Converted, Failed, Format, MOST_BYTES, Refused, convert};
use phytomer_sim::Tick;
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::fs::File;
use std::io::{Read, Write as _};
use std::path::{Path, PathBuf};

/// Convert a parametric tree of another program into a species file, and plants into files of other programs.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer convert my_tree.xml my_tree.toml                      Arbaro
  phytomer convert my_tree.py my_tree.toml                       tree-gen or Sapling, told apart by their keys
  phytomer convert preset.txt my_tree.toml --from sapling        a file whose ending tells nothing
  phytomer convert library.xml almond.toml --tree Almond         Helios: one of the trees of a library
  phytomer convert my_tree.json my_tree.toml --json              the paper's names, or keys of tree-gen or Sapling
  phytomer convert coffee coffee.mtg --age 48                    a plant of a scenario, a species or a run, as an MTG
  phytomer convert walnut.mtg runs/walnut --unit cm              measured plants, as the tables of a run

Python files are read as data, and nothing of them is run. Each key of the file is listed as taken, mapped or without
counterpart, with its line and column; docs/convert.md tells how each program's keys are mapped. Exit code 3 where the
file is wrong or the model does not take its numbers: nothing is written then.
Plants are told apart by OUT: docs/exchange.md has the formats and what each cannot hold, which is told each time.")]
pub struct Convert {
    /// The file of the other program; of plants also a run folder, a scenario or a species.
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// What is written: a species (.toml), plants by the ending of their format, or without an ending a run folder with
    /// the plants of a file; `-` is stdout.
    #[arg(value_name = "OUT")]
    out: PathBuf,
    /// Whose file it is, or its format, where its ending and its keys do not tell.
    #[arg(long, value_name = "PROGRAM|FORMAT", value_parser = PossibleValuesParser::new(words_of_from()))]
    from: Option<String>,
    /// The format of plants that is written, where the ending of OUT does not tell.
    #[arg(long, value_name = "FORMAT", value_parser = PossibleValuesParser::new(plants::words().map(PossibleValue::new)))]
    to: Option<String>,
    /// The plant of a run or a scenario, by its number from 0; 0 if not given.
    #[arg(long, conflicts_with = "plot")]
    plant: Option<u32>,
    /// All plants of a plot of a run or a scenario, by its number from 0.
    #[arg(long, value_name = "PLOT", num_args = 0..=1, default_missing_value = "0")]
    plot: Option<u32>,
    /// Its age in ticks, that of its prime if not given; of a plot its tick, the last if not given.
    #[arg(long)]
    age: Option<Tick>,
    /// The unit of the lengths and places of a file that states none; metres if not given.
    #[arg(long, value_enum)]
    unit: Option<Unit>,
    /// The unit of its diameters, where it is another.
    #[arg(long, value_enum, requires = "unit")]
    diameter_unit: Option<Unit>,
    /// Which tree of a file with several, by its name there.
    #[arg(long, value_name = "NAME")]
    tree: Option<String>,
    /// What became of each key, as one JSON object.
    #[arg(long)]
    json: bool,
}

/// The units of files that state none.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Unit {
    M,
    Cm,
    Mm,
    In,
    Ft,
}

impl Unit {
    fn metres(self) -> f64 {
        match self {
            Self::M => 1.0,
            Self::Cm => 0.01,
            Self::Mm => 0.001,
            Self::In => 0.0254,
            Self::Ft => 0.3048,
        }
    }
}

/// The words of `--from`: programs of parametric trees, then formats of plants.
fn words_of_from() -> Vec<PossibleValue> {
    let programs = Program::value_variants().iter().filter_map(ValueEnum::to_possible_value);
    programs.chain(plants::words().map(PossibleValue::new)).collect()
}

/// The programs whose files are read.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Program {
    Arbaro,
    TreeGen,
    Sapling,
    Helios,
    Json,
}

impl From<Program> for Format {
    fn from(program: Program) -> Self {
        match program {
            Program::Arbaro => Self::Arbaro,
            Program::TreeGen => Self::TreeGen,
            Program::Sapling => Self::Sapling,
            Program::Helios => Self::Helios,
            Program::Json => Self::Json,
        }
    }
}

impl Convert {
    pub fn obey(self) -> Result<Verdict> {
        if let Some(format) = plants::asked(&self)? {
            return plants::obey(&self, format);
        }
        if let Some(format) = plants::taken(&self)? {
            return plants::take(&self, format);
        }
        self.check_out()?;
        self.check_species()?;
        let name = self.input.display().to_string();
        let bytes = read_at_most(&self.input, MOST_BYTES)?;
        let from = self.from.as_deref().and_then(|word| Program::from_str(word, true).ok());
        let asked = Asked { from: from.map(Format::from), tree: self.tree.as_deref() };
        match convert(&name, &bytes, asked) {
            Ok(converted) => self.write(&name, &converted),
            Err(Failed::Refused(refused)) => self.refuse(refused),
            Err(failed) => Err(Misuse(failed.to_string()).into()),
        }
    }

    fn check_out(&self) -> Result<(), Misuse> {
        let shown = self.out.display();
        if is_stdout(&self.out) {
            return Ok(());
        }
        if is_folder(&self.out) {
            return Err(Misuse(format!("{shown}: this is a folder, and the name of a file is expected")));
        }
        match self.out.extension() {
            Some(ending) if ending.eq_ignore_ascii_case("toml") => Ok(()),
            _ => Err(Misuse(format!(
                "{shown}: a species file ends in .toml, and files of plants in {}",
                plants::endings().join(", ")
            ))),
        }
    }

    /// Refuses what is for plants alone.
    fn check_species(&self) -> Result<(), Misuse> {
        let stated = [
            ("--plant", self.plant.is_some()),
            ("--plot", self.plot.is_some()),
            ("--age", self.age.is_some()),
            ("--unit", self.unit.is_some()),
        ];
        match stated.into_iter().find(|(_, stated)| *stated) {
            Some((option, _)) => Err(Misuse(format!("{option}: it is for plants, and a species is asked for"))),
            None => Ok(()),
        }
    }

    fn write(&self, name: &str, converted: &Converted) -> Result<Verdict> {
        let out = self.out.display().to_string();
        if let Err(report) = validate_texts(&out, &[(&out, &converted.species)]) {
            return self.decline(name, converted, &report);
        }
        let mut file = Destination::create(&self.out)?;
        file.write_all(converted.species.as_bytes()).with_context(|| format!("cannot write {out}"))?;
        file.finish()?;
        let told = if self.json { as_json(name, &out, converted) } else { listed(name, &out, converted) };
        if is_stdout(&self.out) {
            terminal::say(&told)
        } else {
            terminal::put(&told)?
        }
        Ok(Verdict::Done)
    }

    /// The file itself is at fault.
    fn refuse(&self, refused: Refused) -> Result<Verdict> {
        let faults = refused.faults.iter().map(|fault| {
            json!({"file": refused.name, "line": fault.line, "column": fault.column, "problem": fault.problem,
                "expected": fault.expected})
        });
        if self.json {
            terminal::put_json(&json!({"status": "invalid", "faults": faults.collect::<Vec<_>>()}))?;
        } else {
            terminal::say(refused.to_string().trim_end());
        }
        Ok(Verdict::Invalid)
    }

    /// The model does not take the numbers: each fault with the line of the file that it came from.
    fn decline(&self, name: &str, converted: &Converted, report: &Report) -> Result<Verdict> {
        let faults: Vec<(Option<(usize, usize)>, FaultRecord)> =
            report.records().into_iter().map(|fault| (origin(converted, &fault.path), fault)).collect();
        if self.json {
            let told = faults.iter().map(|(place, fault)| {
                json!({"file": name, "line": place.map(|place| place.0), "column": place.map(|place| place.1),
                    "path": fault.path, "problem": fault.problem, "expected": fault.expected})
            });
            terminal::put_json(&json!({"status": "invalid", "faults": told.collect::<Vec<_>>()}))?;
            return Ok(Verdict::Invalid);
        }
        for (place, fault) in &faults {
            let place = place.map_or_else(String::new, |(line, column)| format!("{line}:{column}: "));
            let FaultRecord { path, problem, expected, .. } = fault;
            terminal::say(&format!("{name}:{place}`{path}`: {problem}; expected {expected}"));
        }
        terminal::say("the model does not take these numbers; nothing is written");
        Ok(Verdict::Invalid)
    }
}

/// At most one byte beyond what a file may have, so that a file of any length takes little memory.
fn read_at_most(path: &Path, most: usize) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let file = File::open(path).with_context(|| format!("cannot read {}", path.display()))?;
    let read = file.take(most as u64 + 1).read_to_end(&mut bytes);
    read.with_context(|| format!("cannot read {}", path.display()))?;
    Ok(bytes)
}

/// The place of the key that gave a key of the species its value.
fn origin(converted: &Converted, path: &str) -> Option<(usize, usize)> {
    let gives =
        |written: &str| !path.is_empty() && written.split(", ").any(|one| one.split(" = ").next() == Some(path));
    converted.told.iter().find(|told| gives(&told.written)).map(|told| (told.line, told.column))
}

/// A line for each key.
fn listed(name: &str, out: &str, converted: &Converted) -> String {
    let mut text = String::new();
    for told in &converted.told {
        let _ = write!(text, "{name}:{}:{}: {}: {}", told.line, told.column, told.key, told.fate.word());
        if !told.written.is_empty() {
            let _ = write!(text, ": {}", told.written);
        }
        if let Some(note) = &told.note {
            let _ = write!(text, " ({note})");
        }
        text.push('\n');
    }
    let program = converted.format.program();
    let label = converted.label.as_ref().map_or_else(String::new, |label| format!("{label}, "));
    let _ = write!(text, "{out}: {label}a species from a file of {program}");
    text
}

fn as_json(name: &str, out: &str, converted: &Converted) -> String {
    let key = |told: &phytomer_peers::Told| {
        json!({"key": told.key, "line": told.line, "column": told.column, "fate": told.fate.word(),
            "written": told.written, "note": told.note})
    };
    let keys: Vec<Value> = converted.told.iter().map(key).collect();
    let object = json!({"status": "done", "in": name, "out": out, "from": converted.format.word(),
        "tree": converted.label, "keys": keys});
    format!("{object:#}")
}
