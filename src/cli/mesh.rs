//! `mesh`: one plant at one age as a PLY file, grown again from its seed.
//!
//! Draws are keyed by the run's seed and the plant, so it is the same plant, with the same component numbers, that the
//! run has recorded; nothing is read from the run's tables. In a wind it is a frame of that plant, which the wind moves
//! for the mesh alone.

use super::named::{self, Named, Recorded};
use super::{Misuse, Verdict, amounts, refuse, terminal};
use anyhow::{Context, Result};
use clap::Args;
use phytomer::run::drawing::{options_of, write_mesh};
use phytomer::run::{place_of, seed_of};
use phytomer_config::{Model, Scenario, Species};
use phytomer_outputs::meshes::MeshOptions;
use phytomer_sim::mechanics::Bench;
use phytomer_sim::mechanics::sway::{Unmoved, sway, yielding};
use phytomer_sim::site::Wind;
use phytomer_sim::{Ending, GrowthModel, Plot, RecordError, Recorder, Tick, grow};
use std::borrow::Cow;
use std::fs;
use std::path::{Path, PathBuf};

/// The strongest wind that a mesh is asked for, m/s: as in a scenario's site.
const MOST_WIND: f64 = 100.0;

/// Grow one plant of a run or a scenario again, and write it as a PLY mesh.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer mesh coffee --plant 0 --age 12 --out coffee.ply
  phytomer mesh runs/coffee --plant 3 --out third.ply --sides 12
  phytomer mesh my_plant/scenario.toml --age 24 --wind 8 --time 0.40 --out frame-010.ply

A gusty wind repeats every 8 seconds, so frames of --time 0 to 8 make a film that loops.")]
pub struct Mesh {
    /// A run folder, a shipped scenario or species by its name, or a file of one by its path.
    #[arg(value_name = "RUN|SCENARIO|SPECIES")]
    name: String,
    /// The plant's number, from 0.
    #[arg(long, default_value_t = 0)]
    plant: u32,
    /// Its age in ticks; the last of the run if not given.
    #[arg(long)]
    age: Option<Tick>,
    /// The file to write.
    #[arg(long, value_name = "FILE.ply")]
    out: PathBuf,
    /// Sides of the tube that an internode is drawn as.
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u32).range(3..=64))]
    sides: u32,
    /// A gusty wind of so many metres a second, for this mesh alone; the species needs wood that bends. 0 is calm.
    #[arg(long, value_name = "M/S", allow_negative_numbers = true, value_parser = wind_speed)]
    wind: Option<f64>,
    /// The direction towards which the wind blows, degrees from the X axis (east) to the Y axis (north).
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, requires = "wind", allow_negative_numbers = true, value_parser = finite)]
    wind_towards: f64,
    /// The moment of the frame, seconds.
    #[arg(long, value_name = "SECONDS", default_value_t = 0.0, requires = "wind", allow_negative_numbers = true, value_parser = finite)]
    time: f64,
}

impl Mesh {
    pub fn obey(self) -> Result<Verdict> {
        let found = match named::find(&self.name) {
            Ok(found) => found,
            Err(report) => return refuse(&report, false),
        };
        match found {
            Named::Run(folder) => {
                let recorded = Recorded::of(&folder)?;
                let model = recorded.compile()?;
                self.write(&recorded.scenario, &recorded.species, model.as_ref())
            }
            Named::Scenario(resolved) => self.write(&resolved.scenario, &resolved.species, resolved.model.as_ref()),
            Named::Species(species) => {
                let alone = species.alone(&self.name);
                self.write(&alone.scenario, &alone.species, alone.model.as_ref())
            }
        }
    }

    fn write(&self, scenario: &Scenario, species: &Species, model: &dyn GrowthModel) -> Result<Verdict> {
        let age = self.age.unwrap_or(scenario.ages.until);
        self.check(scenario, age)?;
        let air = self.air();
        if air.is_some() {
            yielding(&model.habit()).map_err(|unmoved| self.unmoved(unmoved, scenario, species))?;
        }
        let mut plot = Plot::of_one(model, &seed_of(scenario, self.plant));
        plot.site = scenario.site.felt();
        plot.plants[0].place = place_of(scenario, self.plant);
        let staged = beside(&self.out);
        let options = options_of(self.sides);
        let mut drawer = Drawer { age, seed: scenario.seed, options, path: &staged, air, drawn: false };
        // To the last age of the run, not to the mesh's: that is what numbers the components.
        let ending =
            grow(model, &mut plot, scenario.ages.until, &mut drawer).map_err(|error| anyhow::anyhow!(error))?;
        if let (false, Ending::Overgrown { age, limit }) = (drawer.drawn, ending) {
            anyhow::bail!("{limit} at age {age}, before the age of the mesh");
        }
        fs::rename(&staged, &self.out).with_context(|| format!("cannot write {}", self.out.display()))?;
        let bytes = fs::metadata(&self.out).map(|metadata| metadata.len()).unwrap_or_default();
        let bytes = amounts::bytes(bytes as f64);
        let wind = air.map(|air| format!(" in a wind of {} m/s at {} s", air.wind.speed, air.time)).unwrap_or_default();
        terminal::put(&format!("{}: plant {} at age {age}{wind}, {bytes}", self.out.display(), self.plant))?;
        Ok(Verdict::Done)
    }

    /// The moving air that is asked for; a calm is none.
    fn air(&self) -> Option<Air> {
        let speed = self.wind.filter(|speed| *speed > 0.0)?;
        Some(Air { wind: Wind { speed, towards: self.wind_towards.to_radians() }, time: self.time })
    }

    /// What to do where wind cannot move the species.
    fn unmoved(&self, unmoved: Unmoved, scenario: &Scenario, species: &Species) -> Misuse {
        let name = &species.about.name;
        let (lacks, needs) = match unmoved {
            Unmoved::Stiff => ("no wood that bends", "a `[wood]` table, such as `like = \"birch\"`"),
            Unmoved::NoDrag => ("wood without drag", "`drag` in its `[wood]`, such as `drag = { c = 2, n = 0.5 }`"),
        };
        let file = &scenario.species;
        let wind = self.wind.unwrap_or_default();
        Misuse(match &species.model {
            Model::Buds(_) => format!(
                "--wind {wind}: the species `{name}` has {lacks}. Its file (`{file}`) needs {needs}; a species that ships is \
                 extended by a file of your own with `inherits = \"{name}\"`. `phytomer list woods` has the woods"
            ),
            model => {
                let model = model.name().word();
                format!(
                    "--wind {wind}: the species `{name}` has {lacks}, and its model `{model}` knows none: only `buds` does"
                )
            }
        })
    }

    fn check(&self, scenario: &Scenario, age: Tick) -> Result<()> {
        let (until, plants) = (scenario.ages.until, scenario.plants);
        if !(1..=until).contains(&age) {
            return Err(Misuse(format!("--age {age}: the run has the ages 1 to {until}")).into());
        }
        if self.plant >= plants {
            let plant = self.plant;
            return Err(Misuse(format!("--plant {plant}: the run has the plants 0 to {}", plants - 1)).into());
        }
        Ok(())
    }
}

/// Air that moves a plant for one mesh.
#[derive(Debug, Clone, Copy)]
struct Air {
    wind: Wind,
    /// Seconds.
    time: f64,
}

/// Draws the plot's first plant at one age.
struct Drawer<'a> {
    age: Tick,
    seed: u64,
    options: MeshOptions,
    path: &'a Path,
    air: Option<Air>,
    drawn: bool,
}

impl Recorder for Drawer<'_> {
    fn wants(&self, age: Tick) -> bool {
        age == self.age
    }

    fn record(&mut self, age: Tick, plot: &Plot) -> Result<(), RecordError> {
        let mut plant = Cow::Borrowed(&plot.plants[0]);
        if let Some(Air { wind, time }) = self.air {
            sway(plant.to_mut(), age, &plot.site, wind, time, &mut Bench::default())?;
        }
        write_mesh(&plant, age, self.seed, &self.options, self.path)?;
        self.drawn = true;
        Ok(())
    }
}

fn wind_speed(text: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(speed) if (0.0..=MOST_WIND).contains(&speed) => Ok(speed),
        _ => Err(format!("a speed from 0 to {MOST_WIND} m/s is expected")),
    }
}

fn finite(text: &str) -> std::result::Result<f64, String> {
    text.parse::<f64>().ok().filter(|number| number.is_finite()).ok_or_else(|| "a number is expected".to_owned())
}

/// The name beside the final one under which a file is written.
fn beside(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".tmp");
    path.with_file_name(name)
}
