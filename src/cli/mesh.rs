//! `mesh`: one plant at one age as a PLY file, grown again from its seed.
//!
//! Draws are keyed by the run's seed and the plant, so it is the same plant, with the same component numbers, that the
//! run has recorded; nothing is read from the run's tables.

use super::named::{self, Named, Recorded};
use super::{Misuse, Verdict, amounts, refuse, terminal};
use anyhow::{Context, Result};
use clap::Args;
use phytomer::run::drawing::{options_of, write_mesh};
use phytomer::run::{place_of, seed_of};
use phytomer_config::Scenario;
use phytomer_outputs::meshes::MeshOptions;
use phytomer_sim::{Ending, GrowthModel, Plot, RecordError, Recorder, Tick, grow};
use std::fs;
use std::path::{Path, PathBuf};

/// Grow one plant of a run or a scenario again, and write it as a PLY mesh.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer mesh coffee --plant 0 --age 12 --out coffee.ply
  phytomer mesh runs/coffee --plant 3 --out third.ply --sides 12")]
pub struct Mesh {
    /// A run folder, a shipped scenario by its name, or a scenario file by its path.
    #[arg(value_name = "RUN|SCENARIO")]
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
                self.write(&recorded.scenario, model.as_ref())
            }
            Named::Scenario(resolved) => self.write(&resolved.scenario, resolved.model.as_ref()),
            Named::Species(_) => {
                let name = &self.name;
                Err(Misuse(format!("`{name}` is a species: name a scenario or a run, which says how it is grown"))
                    .into())
            }
        }
    }

    fn write(&self, scenario: &Scenario, model: &dyn GrowthModel) -> Result<Verdict> {
        let age = self.age.unwrap_or(scenario.ages.until);
        self.check(scenario, age)?;
        let mut plot = Plot::of_one(model, &seed_of(scenario, self.plant));
        plot.site = scenario.site.felt();
        plot.plants[0].place = place_of(scenario, self.plant);
        let staged = beside(&self.out);
        let options = options_of(self.sides);
        let mut drawer = Drawer { age, seed: scenario.seed, options, path: &staged, drawn: false };
        // To the last age of the run, not to the mesh's: that is what numbers the components.
        let ending =
            grow(model, &mut plot, scenario.ages.until, &mut drawer).map_err(|error| anyhow::anyhow!(error))?;
        if let (false, Ending::Overgrown { age, limit }) = (drawer.drawn, ending) {
            anyhow::bail!("{limit} at age {age}, before the age of the mesh");
        }
        fs::rename(&staged, &self.out).with_context(|| format!("cannot write {}", self.out.display()))?;
        let bytes = fs::metadata(&self.out).map(|metadata| metadata.len()).unwrap_or_default();
        let bytes = amounts::bytes(bytes as f64);
        terminal::put(&format!("{}: plant {} at age {age}, {bytes}", self.out.display(), self.plant))?;
        Ok(Verdict::Done)
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

/// Draws the plot's first plant at one age.
struct Drawer<'a> {
    age: Tick,
    seed: u64,
    options: MeshOptions,
    path: &'a Path,
    drawn: bool,
}

impl Recorder for Drawer<'_> {
    fn wants(&self, age: Tick) -> bool {
        age == self.age
    }

    fn record(&mut self, age: Tick, plot: &Plot) -> Result<(), RecordError> {
        write_mesh(&plot.plants[0], age, self.seed, &self.options, self.path)?;
        self.drawn = true;
        Ok(())
    }
}

/// The name beside the final one under which a file is written.
fn beside(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".tmp");
    path.with_file_name(name)
}
