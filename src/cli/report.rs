//! `report`: runs as one page without script, with the files of its figures where they are asked for.
//!
//! Absent: what a report says (`phytomer::report`).

mod data;

use super::measured::Measured;
use super::named::{Recorded, run_folder};
use super::out::{self, Format};
use super::{Misuse, Verdict, amounts, terminal};
use anyhow::{Context, Result};
use clap::Args;
use phytomer::report::{Reported, report};
use phytomer::run::forms;
use phytomer::run::picturing::pictured_plants;
use phytomer::run::regrowth::Regrowth;
use phytomer_config::{Species, Trial};
use phytomer_outputs::Destination;
use phytomer_outputs::pictures::{Compression, Picture as Style, Placed, Stand, draw_stands, write_png};
use phytomer_reports::{Figure, Picture, page, png, svg, vega_lite};
use phytomer_sim::plant::Plant;
use phytomer_sim::{GrowthModel, Tick};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::{fs, io};

const FORMATS: [Format; 2] = [Format { name: "HTML", extension: "html" }, Format { name: "HTML", extension: "htm" }];
/// The most plants in a picture.
const MOST_PICTURED: u32 = 8;
/// The width of a plant in a picture and the height of the picture, pixels.
const WIDTH: u32 = 400;
const HEIGHT: u32 = 560;

/// Tell of runs in one page: growth, survival, contrasts of treatments, measured plants, pictures, provenance.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer report runs/coffee --out coffee.html
  phytomer report runs/coffee --data field.csv --plants 5 --out beside_field.html
  phytomer report runs/coffee --data mortality.csv --order 2 --out beside_counts.html
  phytomer report runs/dry runs/wet --title Summers --figures figures --out both.html

The page is one file without any script. Each figure has its numbers as CSV. --figures FOLDER writes each figure as SVG,
PNG, CSV and as a specification of Vega-Lite. A file of --data has the column `age` in ticks and one or more columns of
`summary` (height_m, crown_width_m, leaf_area_m2, wood_volume_m3, internodes), a row a plant; or it is a table as
`phytomer fit` reads (nodes per growth unit, mortality, fates of buds; `phytomer fit --sample LAW` prints one), whose column
`order`, or --order, tells the axes that were measured. --data may be given several times.")]
pub struct ReportVerb {
    /// Run folders.
    #[arg(value_name = "RUN", required = true)]
    runs: Vec<String>,
    /// The file that is written; `-` for stdout.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Measured plants, growth units, axes or buds, as CSV.
    #[arg(long, value_name = "FIELD.csv")]
    data: Vec<PathBuf>,
    /// The order of the measured axes, where their table has no column `order`; 1 is the trunk.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=64))]
    order: u32,
    /// Only rows of measured axes with this text in a column.
    #[arg(long = "where", value_name = "COLUMN=TEXT")]
    only: Vec<String>,
    /// The end from which the ranks of buds are counted.
    #[arg(long, default_value = "tip", value_parser = ["tip", "base"])]
    from: String,
    /// The title; the names of the runs if not given.
    #[arg(long)]
    title: Option<String>,
    /// A folder for the files of the figures.
    #[arg(long, value_name = "FOLDER")]
    figures: Option<PathBuf>,
    /// How many plants of each run are drawn side by side, grown again; 0 for none.
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(0..=i64::from(MOST_PICTURED)))]
    plants: u32,
}

/// A run, by how its plants came about.
enum Source {
    Grown(Box<Recorded>),
    Measured(Box<Measured>),
}

impl ReportVerb {
    pub fn obey(self) -> Result<Verdict> {
        out::check(&self.out, "report", &FORMATS)?;
        let folders: Vec<PathBuf> = self.runs.iter().map(|name| folder(name)).collect::<Result<_>>()?;
        let of = |folder: &PathBuf| match Measured::of(&folder.display().to_string())? {
            Some(measured) => Ok(Source::Measured(Box::new(measured))),
            None => Recorded::of(folder).map(|recorded| Source::Grown(Box::new(recorded))),
        };
        let recorded: Vec<Source> = folders.iter().map(of).collect::<Result<_>>()?;
        let (field, asked) = match data::read(&self)? {
            Ok(read) => read,
            Err(faults) => {
                faults.iter().for_each(|fault| terminal::say(&format!("error: {fault}")));
                return Ok(Verdict::Invalid);
            }
        };
        let file = Destination::create(&self.out)?;
        let mut pictures = Vec::new();
        for (name, recorded) in self.runs.iter().zip(&recorded) {
            pictures.extend(match recorded {
                Source::Grown(recorded) => drawn(name, recorded, self.plants)?,
                Source::Measured(measured) => drawn_as_measured(name, measured, self.plants)?,
            });
        }
        let runs = self.runs.iter().zip(&recorded).map(|(name, recorded)| match recorded {
            Source::Grown(of) => Reported {
                name: short(name),
                run: &of.run,
                trial: Some(&of.trial),
                species: of.all_species().collect(),
            },
            Source::Measured(of) => Reported { name: short(name), run: &of.run, trial: None, species: Vec::new() },
        });
        let runs: Vec<Reported> = runs.collect();
        let names: Vec<&str> = runs.iter().map(|reported| reported.name.as_str()).collect();
        let title = self.title.clone().unwrap_or_else(|| names.join(", "));
        let report = report(&title, &runs, (field.as_ref(), &asked), pictures)?;
        if let Some(folder) = &self.figures {
            for figure in report.figures() {
                put(figure, folder).with_context(|| format!("cannot write the figures into {}", folder.display()))?;
            }
        }
        let bytes =
            write(file, page(&report).as_bytes()).with_context(|| format!("cannot write {}", self.out.display()))?;
        let figures = amounts::of(report.figures().count() as u64, "figure");
        out::tell(&self.out, &format!("{figures}, {}", amounts::bytes(bytes as f64)))?;
        Ok(Verdict::Done)
    }
}

fn write(mut file: Destination, bytes: &[u8]) -> Result<u64> {
    file.write_all(bytes)?;
    file.finish()?;
    Ok(bytes.len() as u64)
}

/// The folder of a run.
fn folder(name: &str) -> Result<PathBuf> {
    let lacks = || Misuse(format!("{name} is no run folder; `phytomer grow` makes one, as runs/coffee"));
    Ok(run_folder(name).ok_or_else(lacks)?)
}

/// The last part of the path of a run.
fn short(name: &str) -> String {
    Path::new(name).file_name().map_or_else(|| name.to_owned(), |last| last.to_string_lossy().into_owned())
}

/// The first plants of a run side by side, grown again to the age at which the first of them shows what it is.
fn drawn(name: &str, recorded: &Recorded, count: u32) -> Result<Option<Picture>> {
    if count == 0 {
        return Ok(None);
    }
    let models = recorded.compile()?;
    let species: Vec<&Species> = recorded.all_species().collect();
    let forms = species.iter().map(|species| forms::of_run(species, &recorded.run));
    let forms: Vec<_> = forms.collect::<std::result::Result<_, _>>()?;
    let models: Vec<&dyn GrowthModel> = models.iter().map(AsRef::as_ref).collect();
    let regrowth = Regrowth::new(recorded.trial.clone(), models, None);
    let plants = dealt(&recorded.trial, count);
    let of = species[recorded.trial.species_of_plant(0)];
    let age = regrowth.shown_at(of, 0)?;
    let pictured = pictured_plants(&regrowth, &species, &plants, &[age])?;
    let size = [(WIDTH * plants.len() as u32).clamp(2 * WIDTH, 4 * WIDTH), HEIGHT];
    let canvas = draw_stands(&pictured.stands(&forms), &pictured.title, &Style { size, ..Style::default() });
    let mut png = Vec::new();
    write_png(&canvas, &pictured.note, Compression::Balanced, &mut png)?;
    let whom = amounts::of(plants.len() as u64, "plant");
    let trial = &recorded.trial;
    let treatment = |plant: &u32| trial.treatments()[trial.plant(*plant).treatment].name.clone();
    let of_treatments = match trial.treatments() {
        [_] => String::new(),
        _ => format!(", from the left of {}", plants.iter().map(treatment).collect::<Vec<_>>().join(", ")),
    };
    let caption = format!("{}: {whom} at age {age} in one scale{of_treatments}.", short(name));
    let words = format!("{whom} of {} side by side at age {age}, in sunshine, with their shadows", of.about.name);
    Ok(Some(Picture { png, caption, words }))
}

/// The first plants of a run of measured plants that have places, as they were last measured.
fn drawn_as_measured(name: &str, measured: &Measured, count: u32) -> Result<Option<Picture>> {
    let age = measured.age(None)?;
    let plants = measured.plants.at(age);
    let chosen: Vec<&Plant> = plants.values().take(count as usize).collect();
    if chosen.is_empty() {
        return Ok(None);
    }
    let stands: Vec<Stand> = chosen.into_iter().map(|plant| stand_of(plant, age)).collect();
    let size = [(WIDTH * stands.len() as u32).clamp(2 * WIDTH, 4 * WIDTH), HEIGHT];
    let canvas = draw_stands(&stands, &short(name), &Style { size, ..Style::default() });
    let mut png = Vec::new();
    write_png(&canvas, &format!("{}: measured plants", short(name)), Compression::Balanced, &mut png)?;
    let whom = amounts::of(stands.len() as u64, "plant");
    let caption = format!("{}: {whom} as measured at {} in one scale.", short(name), measured.caption(age));
    let words =
        format!("{whom} of {} side by side as measured at age {age}, in sunshine, with their shadows", short(name));
    Ok(Some(Picture { png, caption, words }))
}

/// A measured plant by itself.
fn stand_of(plant: &Plant, age: Tick) -> Stand<'_> {
    let (own, seen) = Default::default();
    let placed = Placed { plant, age, place: [0.0; 3], own, seen };
    Stand { plants: vec![placed], obstacles: Vec::new(), label: format!("plant {}", plant.id) }
}

/// Plants of a run, the first of each treatment, then the second of each. Plants are numbered treatment by treatment.
fn dealt(trial: &Trial, count: u32) -> Vec<u32> {
    let plants = trial.plants();
    let treatments = trial.treatments().len();
    let first = |treatment: usize| {
        let (mut low, mut high) = (0, plants);
        while low < high {
            let middle = low + (high - low) / 2;
            if trial.plant(middle).treatment < treatment { low = middle + 1 } else { high = middle }
        }
        low
    };
    let firsts: Vec<u32> = (0..=treatments).map(first).collect();
    let of_round = |round: u32| {
        let of = firsts.windows(2).map(move |pair| (pair[0].saturating_add(round), pair[1]));
        of.filter(|(plant, end)| plant < end).map(|(plant, _)| plant).collect::<Vec<u32>>()
    };
    (0..count).flat_map(of_round).take(count as usize).collect()
}

/// Writes a figure as SVG, PNG, CSV and Vega-Lite.
fn put(figure: &Figure, folder: &Path) -> Result<()> {
    fs::create_dir_all(folder)?;
    let save = |ending: &str, bytes: &[u8]| -> Result<()> {
        let mut file = Destination::create(&folder.join(format!("{}.{ending}", figure.id)))?;
        file.write_all(bytes)?;
        file.finish()?;
        Ok(())
    };
    let Figure { id, title, words, plotted, .. } = figure;
    save("csv", plotted.table().csv().as_bytes())?;
    if let Some(drawn) = svg(plotted, id, title, words) {
        save("svg", drawn.as_bytes())?;
    }
    if let Some(drawn) = png(plotted) {
        save("png", &drawn)?;
    }
    if let Some(specification) = vega_lite(plotted, title, words) {
        let text = serde_json::to_string_pretty(&specification).map_err(io::Error::from)?;
        save("vl.json", (text + "\n").as_bytes())?;
    }
    Ok(())
}
