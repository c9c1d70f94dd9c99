//! `mesh`: one plant at one age as a PLY file, grown again from its seed.
//!
//! It is the same plant, with the same component numbers, that the run has recorded. In a wind it is a frame of that
//! plant, which the wind moves for the mesh alone.

use super::out::{self, Format};
use super::regrown::{Breeze, Regrown};
use super::{Verdict, amounts};
use anyhow::{Context, Result};
use clap::Args;
use phytomer::run::drawing::{options_of, write_mesh};
use phytomer_outputs::Destination;
use phytomer_sim::Tick;
use std::path::PathBuf;

/// The formats of meshes.
const FORMATS: [Format; 1] = [Format { name: "PLY", extension: "ply" }];

/// Grow one plant of a run or a scenario again, and write it as a PLY mesh.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer mesh coffee --plant 0 --age 12 --out coffee.ply
  phytomer mesh runs/coffee --plant 3 --out third.ply --sides 12
  phytomer mesh my_plant/scenario.toml --age 24 --wind 8 --time 0.40 --out frame-010.ply

A gusty wind repeats every 8 seconds, so frames of --time 0 to 8 make a film that loops.")]
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
    /// The file to write, `-` for stdout. A link stays, and its target is replaced; a pipe or a device is written
    /// through.
    #[arg(long, value_name = "FILE.ply")]
    out: PathBuf,
    /// Sides of the tube that an internode is drawn as.
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u32).range(3..=64))]
    sides: u32,
    #[command(flatten)]
    breeze: Breeze,
}

impl Mesh {
    pub fn obey(self) -> Result<Verdict> {
        out::check(&self.out, "mesh", &FORMATS)?;
        match Regrown::find(&self.name, self.age.as_slice())? {
            Ok(regrown) => self.write(&regrown),
            Err(verdict) => Ok(verdict),
        }
    }

    fn write(&self, regrown: &Regrown) -> Result<Verdict> {
        let age = self.age.unwrap_or(regrown.scenario.ages.until);
        regrown.check(("--age", &[age]), ("--plant", &[self.plant]))?;
        let regrowth = regrown.regrowth(&self.breeze)?;
        let mut file = Destination::create(&self.out)?;
        let options = options_of(self.sides, &regrown.forms);
        let seed = regrown.scenario.seed;
        regrowth.show(self.plant, &[age], &mut |age, plant| {
            let written = write_mesh(plant, age, seed, &options, &mut file);
            Ok(written.with_context(|| format!("cannot write {}", self.out.display()))?)
        })?;
        let bytes = amounts::bytes(file.finish()? as f64);
        let wind = self.breeze.in_words();
        out::tell(&self.out, &format!("plant {} at age {age}{wind}, {bytes}", self.plant))?;
        Ok(Verdict::Done)
    }
}
