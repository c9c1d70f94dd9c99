//! `measure`: a measure of one or several runs, as a table for the terminal, as JSON or as a file.
//!
//! The last word is the name of the measure, all words before it are runs. What could not be estimated is told beside
//! the table. Absent: the measures, which are `phytomer_analysis::measure`'s.

mod shown;

use super::named::run_folder;
use super::out::{self, Format};
use super::{Misuse, Verdict, terminal};
use anyhow::{Context, Result};
use clap::Args;
use phytomer_analysis::measure::{Asked, Card, Fault, MEASURES, Measured, measure};
use phytomer_outputs::destination::is_stdout;
use serde_json::{Value, json};
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// Measure recorded runs: survival, activity, nodes, branching, angles, sizes, allometry, contrasts, power.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer measure --list
  phytomer measure runs/coffee bud-life --by order
  phytomer measure runs/coffee height --by age
  phytomer measure runs/coffee nodes-per-axis --by order --json
  phytomer measure runs/coffee branching --out branching.csv
  phytomer measure runs/coffee effective-leaf-area --sun 30,180
  phytomer measure runs/coffee power --of height_m --difference 0.1

The plant is the unit: intervals are of plant values or of a bootstrap by plant, and the design effect tells how much more
a mean of buds, axes or leaves varies than one of as many independent units would. The end of a run, a cut and a limit of
components censor lives. docs/statistics.md has the formula and the source of each measure, and when not to use it.")]
pub struct Measure {
    /// Run folders, or runs below runs/ by their names; then the name of a measure.
    #[arg(value_name = "RUN... NAME", required_unless_present = "list")]
    words: Vec<String>,
    /// List the measures with their units, groups and sources.
    #[arg(long, conflicts_with = "words")]
    list: bool,
    /// Group by run, treatment, a factor, species, replicate, block, plot, or a column that the measure lists.
    #[arg(long, value_name = "GROUP")]
    by: Option<String>,
    /// The age, for measures of plants at an age [default: the last recorded].
    #[arg(long, value_name = "TICKS")]
    age: Option<u32>,
    /// The number of plants that contrast, variance, power and allometry are of [default: height_m].
    #[arg(long, value_name = "COLUMN", value_parser = name)]
    of: Option<String>,
    /// The x of allometry [default: crown_width_m].
    #[arg(long, value_name = "COLUMN", value_parser = name)]
    x: Option<String>,
    /// The level of intervals.
    #[arg(long, default_value_t = 0.95)]
    level: f64,
    /// The thickness of the layers of a crown profile, metres.
    #[arg(long, value_name = "METRES", default_value_t = 0.5)]
    layer: f64,
    /// The sun that effective-leaf-area is seen from: altitude, and azimuth from north over east, degrees [default:
    /// above].
    #[arg(long, value_name = "ALTITUDE,AZIMUTH", allow_hyphen_values = true, value_parser = sun)]
    sun: Option<[f64; 2]>,
    /// The difference that `power` is to find, in the unit of --of.
    #[arg(long, allow_negative_numbers = true)]
    difference: Option<f64>,
    /// The probability with which `power` is to find it.
    #[arg(long, default_value_t = 0.8)]
    power: f64,
    /// Write a file instead of telling it: .csv has the first table, .json all of them.
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// As one JSON object on stdout.
    #[arg(long)]
    json: bool,
}

const FORMATS: [Format; 2] = [Format { name: "CSV", extension: "csv" }, Format { name: "JSON", extension: "json" }];

/// A name that is not empty.
fn name(word: &str) -> Result<String, String> {
    if word.is_empty() { Err("the name of a column is expected".to_owned()) } else { Ok(word.to_owned()) }
}

/// Two numbers with a comma between them.
fn sun(word: &str) -> Result<[f64; 2], String> {
    let numbers = word
        .split_once(',')
        .and_then(|(altitude, azimuth)| Some([altitude.trim().parse().ok()?, azimuth.trim().parse().ok()?]));
    numbers.ok_or_else(|| "an altitude and an azimuth in degrees are expected, such as 30,180".to_owned())
}

impl Measure {
    pub fn obey(self) -> Result<Verdict> {
        if self.list {
            return list(self.json);
        }
        let (card, folders) = self.named()?;
        if let Some(path) = &self.out {
            out::check(path, "measure", &FORMATS)?;
        }
        let paths: Vec<&Path> = folders.iter().map(PathBuf::as_path).collect();
        let measured = match measure(&paths, card, &self.asked()) {
            Ok(measured) => measured,
            Err(fault @ (Fault::Asked(_) | Fault::Grouping { .. } | Fault::Age { .. })) => {
                return Err(Misuse(fault.to_string()).into());
            }
            Err(fault) => return Err(fault.into()),
        };
        match &self.out {
            Some(path) => self.write(path, card, &folders, &measured)?,
            None if self.json => terminal::put_json(&self.as_json(card, &folders, &measured))?,
            None => terminal::put(&shown::table(card, &measured))?,
        }
        Ok(Verdict::Done)
    }

    /// The measure and the run folders that the words name.
    fn named(&self) -> Result<(&'static Card, Vec<PathBuf>)> {
        let Some((last, runs)) = self.words.split_last() else {
            return Err(Misuse("a run and the name of a measure are expected".to_owned()).into());
        };
        let card = MEASURES.iter().find(|card| card.name == last.as_str()).ok_or_else(|| {
            let names: Vec<&str> = MEASURES.iter().map(|card| card.name).collect();
            Misuse(format!("there is no measure `{last}`; there are: {}", names.join(", ")))
        })?;
        if runs.is_empty() {
            return Err(Misuse(format!("measure {last}: a run is expected before the name of the measure")).into());
        }
        let folder = |run: &String| -> Result<PathBuf> {
            let missing = || Misuse(format!("there is no run `{run}`: a run folder or a run below runs/ is expected"));
            Ok(run_folder(run).ok_or_else(missing)?)
        };
        Ok((card, runs.iter().map(folder).collect::<Result<_>>()?))
    }

    fn asked(&self) -> Asked {
        let Self { by, age, of, x, level, layer, sun, difference, power, .. } = self;
        Asked {
            by: by.clone(),
            level: *level,
            age: *age,
            of: of.clone(),
            x: x.clone(),
            layer_m: *layer,
            sun_deg: *sun,
            difference: *difference,
            power: *power,
        }
    }

    fn as_json(&self, card: &Card, folders: &[PathBuf], measured: &Measured) -> Value {
        json!({
            "measure": card.name,
            "tells": card.tells,
            "formula": card.formula,
            "unit": card.unit,
            "runs": folders.iter().map(|folder| folder.display().to_string()).collect::<Vec<_>>(),
            "by": self.by,
            "level": self.level,
            "tables": shown::as_json(measured),
            "notes": measured.notes,
        })
    }

    fn write(&self, path: &Path, card: &Card, folders: &[PathBuf], measured: &Measured) -> Result<()> {
        let is_csv = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv"));
        let text = match is_csv {
            true => measured.sheets.first().map(shown::csv).unwrap_or_default(),
            false => serde_json::to_string_pretty(&self.as_json(card, folders, measured))? + "\n",
        };
        let writing = || format!("cannot write {}", path.display());
        match is_stdout(path) {
            true => std::io::stdout().lock().write_all(text.as_bytes()).with_context(writing)?,
            false => fs::write(path, text).with_context(writing)?,
        }
        measured.notes.iter().for_each(|note| terminal::say(&format!("note: {note}")));
        let rows = measured.sheets.first().map_or(0, |sheet| sheet.rows.len());
        out::tell(path, &format!("{} of {}", super::amounts::of(rows as u64, "row"), card.name))
    }
}

/// The list of measures.
fn list(as_json: bool) -> Result<Verdict> {
    if as_json {
        let of = |card: &Card| {
            json!({
                "name": card.name, "tells": card.tells, "formula": card.formula, "unit": card.unit, "by": card.groups,
            })
        };
        terminal::put_json(&MEASURES.iter().map(of).collect::<Vec<_>>())?;
    } else {
        terminal::put(shown::list(&MEASURES).trim_end())?;
    }
    Ok(Verdict::Done)
}
