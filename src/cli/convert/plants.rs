//! `convert` of plants: from a run, a scenario or a file of another program to a file of another program.
//!
//! A plant is grown again at an age, as `picture` does it. What is wrong with a file is told all at once; what a format
//! cannot hold is told in any case. Absent: the formats (`phytomer_outputs::exchange`).

use super::super::constants::Constants;
use super::super::regrown::{Breeze, Regrown};
use super::super::{Misuse, Verdict, amounts, named, terminal};
use super::{Convert, read_at_most};
use anyhow::{Context, Result};
use phytomer::run::Program;
use phytomer_outputs::destination::{Destination, is_stdout};
use phytomer_outputs::exchange::{
    Description, FORMATS, Format, Incoming, Losses, MOST_BYTES, Outgoing, Report, Units, by_ending, by_word, grown,
};
use phytomer_outputs::measured::{self, Source};
use phytomer_outputs::{Input, Mode};
use phytomer_sim::Tick;
use phytomer_sim::between::Moment;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use std::ffi::OsStr;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// What is read, and the words for it.
struct Read {
    description: Description,
    report: Report,
    /// The word of its format; `None` of what was grown.
    format: Option<&'static str>,
}

/// The words of all formats of plants.
pub fn words() -> impl Iterator<Item = &'static str> {
    FORMATS.into_iter().map(|format| format.word())
}

/// The endings of all formats of plants, each once, with their dots.
pub fn endings() -> Vec<String> {
    let mut endings: Vec<String> = Vec::new();
    for ending in FORMATS.iter().flat_map(|format| format.endings()).map(|ending| format!(".{ending}")) {
        if !endings.contains(&ending) {
            endings.push(ending);
        }
    }
    endings
}

/// The format that plants are to be written in; `None` where a species or a run folder is meant.
///
/// # Errors
/// A format that is read only.
pub fn asked(convert: &Convert) -> Result<Option<&'static dyn Format>, Misuse> {
    let stated = convert.to.as_deref().and_then(by_word);
    let by_name = || {
        let ending = convert.out.extension().and_then(OsStr::to_str)?;
        // Of several formats with this ending the first that can be written.
        let known = by_ending(ending);
        known.iter().find(|format| format.writes()).or(known.first()).copied()
    };
    let found = stated.or_else(by_name);
    match found {
        Some(format) if !format.writes() => {
            Err(Misuse(format!("{}: {} is read and not written", convert.out.display(), format.title())))
        }
        found => Ok(found),
    }
}

/// The format of a file whose plants are to become a run folder, which has no ending; `None` where something else is
/// meant.
///
/// # Errors
/// As [`asked`] of a file.
pub fn taken(convert: &Convert) -> Result<Option<&'static dyn Format>> {
    if convert.out.extension().is_some() || is_stdout(&convert.out) {
        return Ok(None);
    }
    incoming(convert)
}

/// Makes a run folder of the plants of a file.
pub fn take(convert: &Convert, format: &'static dyn Format) -> Result<Verdict> {
    let name = convert.input.display().to_string();
    let read = of_file(convert, &name, format)?;
    if read.report.is_refused() {
        return refuse(convert, &read.report);
    }
    let bytes = read_at_most(&convert.input, MOST_BYTES)?;
    let sha256: String = Sha256::digest(&bytes).iter().map(|byte| format!("{byte:02x}")).collect();
    let program = Program::default();
    let source = Source {
        name: convert.out.file_name().and_then(OsStr::to_str).unwrap_or("measured").to_owned(),
        file: Input { path: name, sha256 },
        format: format.word().to_owned(),
        version: program.version,
        git_hash: program.git_hash,
    };
    let taken = measured::write(&convert.out, &read.description, source, Mode::New)?;
    let mut losses = Losses::default();
    let told = "its tables are written, and no picture of it can be drawn";
    losses.add("places, which the file does not tell, of plants", taken.without_places, told);
    let entities = &read.description.individuals;
    let values = entities.iter().flat_map(|one| &one.entities).flat_map(|entity| &entity.observations);
    let values: usize = values.map(|seen| seen.values.len()).sum();
    losses.add("values of features", values as u64, "the tables of a run have no columns for them");
    let bytes = taken.report.files.iter().map(|file| file.bytes).sum();
    tell(convert, &read, "run", (&losses, bytes))?;
    Ok(Verdict::Done)
}

/// Converts to a format.
pub fn obey(convert: &Convert, to: &'static dyn Format) -> Result<Verdict> {
    let name = convert.input.display().to_string();
    let Some(read) = (match incoming(convert)? {
        Some(format) => Some(of_file(convert, &name, format)?),
        None => of_grown(convert, &name)?,
    }) else {
        return Ok(Verdict::Invalid);
    };
    if read.report.is_refused() {
        return refuse(convert, &read.report);
    }
    let mut files = Files { out: convert.out.clone(), bytes: 0 };
    let mut losses = Losses::default();
    let written = to.write(&read.description, &mut files, &mut losses);
    written.with_context(|| format!("cannot write {}", convert.out.display()))?;
    tell(convert, &read, to.word(), (&losses, files.bytes))?;
    Ok(Verdict::Done)
}

/// The format of the file that is read; `None` where the name is that of a run, a scenario or a species.
fn incoming(convert: &Convert) -> Result<Option<&'static dyn Format>> {
    if let Some(stated) = convert.from.as_deref().and_then(by_word) {
        return Ok(Some(stated));
    }
    let ending = convert.input.extension().and_then(OsStr::to_str).unwrap_or_default();
    let known: Vec<_> = by_ending(ending).into_iter().filter(|format| format.reads()).collect();
    let shown = convert.input.display().to_string();
    if known.is_empty() || named::run_folder(&shown).is_some() {
        return Ok(None);
    }
    if let [only] = known[..] {
        return Ok(Some(only));
    }
    let head = read_at_most(&convert.input, 1 << 16)?;
    let alike = known.iter().find(|format| format.is_like(&head)).copied();
    alike.map(Some).ok_or_else(|| {
        let words: Vec<&str> = known.iter().map(|format| format.word()).collect();
        Misuse(format!("{shown}: it may be of several formats; --from tells which: {}", words.join(", "))).into()
    })
}

fn of_file(convert: &Convert, name: &str, format: &'static dyn Format) -> Result<Read> {
    if convert.plant.is_some() || convert.plot.is_some() || convert.age.is_some() {
        let told = format!("{name}: --plant, --plot and --age are for plants that are grown");
        return Err(Misuse(told).into());
    }
    let bytes = read_at_most(&convert.input, MOST_BYTES)?;
    let mut report = Report::new(name);
    if bytes.len() > MOST_BYTES {
        report.fault((0, 0), "the file is too large", format!("at most {MOST_BYTES} bytes"));
        return Ok(Read { description: Description::default(), report, format: Some(format.word()) });
    }
    let folder = convert.input.parent().map(Path::to_path_buf).unwrap_or_default();
    let beside = |name: &str| -> io::Result<Vec<u8>> {
        read_at_most(&folder.join(name), MOST_BYTES).map_err(|error| io::Error::other(format!("{error:#}")))
    };
    let units = convert
        .unit
        .map(|unit| Units { length_m: unit.metres(), diameter_m: convert.diameter_unit.unwrap_or(unit).metres() });
    let incoming = Incoming { name, bytes: &bytes, units, beside: &beside };
    let description = format.read(&incoming, &mut report);
    Ok(Read { description, report, format: Some(format.word()) })
}

/// A plant or a plot, grown again; nothing where the file of the scenario is wrong, which is told.
fn of_grown(convert: &Convert, name: &str) -> Result<Option<Read>> {
    let ages: Vec<Tick> = convert.age.into_iter().collect();
    let regrown = match Regrown::find(name, &Constants::default(), &ages)? {
        Ok(regrown) => regrown,
        Err(_) => return Ok(None),
    };
    let regrowth = regrown.regrowth(&Breeze::default())?;
    let mut description = grown::of_grown(None);
    let species = |number: u32| regrown.species_of(number).about.name.clone();
    match convert.plot {
        Some(plot) => {
            regrown.check_plot(("--age", &ages), plot)?;
            let tick = convert.age.unwrap_or(regrown.scenario.ages.until);
            regrowth.show_plot(plot, &[Moment::from(tick)], &mut |_, standing| {
                for one in standing {
                    let number = one.plant.id;
                    let told = grown::Told {
                        name: Some(format!("plant_{number}")),
                        species: Some(species(number)),
                        place: Some(regrown.trial.place_in_plot(number)),
                    };
                    grown::add(&mut description, &one.plant, one.age, &told);
                }
                Ok(())
            })?;
        }
        None => {
            let plant = convert.plant.unwrap_or(0);
            regrown.check(("--age", &ages), ("--plant", &[plant]))?;
            let age = match convert.age {
                Some(age) => age,
                None => regrowth.shown_at(regrown.species_of(plant), plant)?,
            };
            let told = grown::Told { species: Some(species(plant)), ..grown::Told::default() };
            regrowth.show(plant, &[age], &mut |age, plant| {
                grown::add(&mut description, plant, age, &told);
                Ok(())
            })?;
        }
    }
    let first = description.individuals.first().and_then(|individual| individual.species.as_deref());
    let year = regrown.species().into_iter().find(|species| Some(species.about.name.as_str()) == first);
    description.ticks_per_year = year.and_then(|species| species.ticks_per_year());
    Ok(Some(Read { description, report: Report::new(name), format: None }))
}

/// The files that are written, beside one another.
struct Files {
    out: PathBuf,
    bytes: u64,
}

impl Outgoing for Files {
    fn stem(&self) -> &str {
        self.out.file_stem().and_then(OsStr::to_str).filter(|stem| *stem != "-").unwrap_or("plant")
    }

    fn file(&mut self, beside: Option<&str>, fill: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
        let path = match beside {
            None => self.out.clone(),
            Some(name) if is_stdout(&self.out) => {
                let told = format!("stdout takes one file, and {name} would stand beside it: name a file");
                return Err(io::Error::new(io::ErrorKind::InvalidInput, told));
            }
            Some(name) => self.out.with_file_name(name),
        };
        let mut file = Destination::create(&path).map_err(io::Error::other)?;
        fill(&mut file)?;
        self.bytes += file.finish().map_err(io::Error::other)?;
        Ok(())
    }
}

fn refuse(convert: &Convert, report: &Report) -> Result<Verdict> {
    if convert.json {
        let faults = report.faults().iter().map(|fault| {
            json!({"file": &*fault.place.file, "line": fault.place.line, "column": fault.place.column,
                "problem": fault.problem, "expected": fault.expected, "help": fault.help})
        });
        let faults: Vec<Value> = faults.collect();
        terminal::put_json(&json!({"status": "invalid", "faults": faults, "more_faults": report.more_faults()}))?;
        return Ok(Verdict::Invalid);
    }
    report.faults().iter().for_each(|fault| terminal::say(&fault.to_string()));
    let count = report.faults().len() as u64 + report.more_faults();
    terminal::say(&format!("{}; nothing is written", amounts::of(count, "fault")));
    Ok(Verdict::Invalid)
}

fn tell(convert: &Convert, read: &Read, to: &str, (losses, bytes): (&Losses, u64)) -> Result<()> {
    let out = convert.out.display().to_string();
    let (plants, entities) = (read.description.individuals.len(), read.description.entities());
    let warnings = read.report.warnings();
    let told = if convert.json {
        let warnings: Vec<Value> = warnings
            .iter()
            .map(|warning| json!({"line": warning.place.line, "text": warning.text, "count": warning.count}))
            .collect();
        let lost =
            losses.told().iter().map(|loss| json!({"what": loss.what, "count": loss.count, "instead": loss.instead}));
        let lost: Vec<Value> = lost.collect();
        let object = json!({"status": "done", "in": convert.input.display().to_string(), "out": out,
            "from": read.format.unwrap_or("grown"), "to": to, "plants": plants, "entities": entities,
            "bytes": bytes, "warnings": warnings, "lost": lost});
        format!("{object:#}")
    } else {
        let warned = warnings.iter().map(|warning| format!("{warning}\n"));
        let lost = losses.told().iter().map(|loss| format!("{out}: {loss}\n"));
        let lines: String = warned.chain(lost).collect();
        let plural = if entities == 1 { "entity" } else { "entities" };
        let (plants, entities) = (amounts::of(plants as u64, "plant"), amounts::count(entities as u64));
        format!("{lines}{out}: {plants}, {entities} {plural}, {}", amounts::bytes(bytes as f64))
    };
    if is_stdout(&convert.out) {
        terminal::say(&told);
        return Ok(());
    }
    terminal::put(&told)
}
