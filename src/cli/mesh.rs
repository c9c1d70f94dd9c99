//! `mesh`: one plant at one age, or all plants of a plot at one tick, as a mesh file, grown again from their seeds.
//!
//! It is the same plant, with the same component numbers, that the run has recorded. In a wind it is a frame of that
//! plant, which the wind moves for the mesh alone.

mod formats;
mod keyed;
mod life;
mod rig;
mod usd;

use super::budget::{Asked, Budget, in_words, too_few};
use super::constants::Constants;
use super::out;
use super::regrown::{Breeze, Fall, Regrown};
use super::span::age;
use super::{Misuse, Verdict, amounts};
use anyhow::{Context, Result};
use clap::Args;
use formats::Format;
use life::Growing;
use phytomer::run::drawing::{check_size, options_of};
use phytomer::run::picturing::{pictured_plot_at, plot_mesh};
use phytomer_outputs::Destination;
use phytomer_outputs::meshes::{MeshOptions, Scene, Tolerance, fitting};
use phytomer_sim::Tick;
use phytomer_sim::between::Moment;
use rig::Rig;
use std::path::PathBuf;

/// Grow one plant or one plot of a run or a scenario again, and write it as a mesh.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer mesh coffee --plant 0 --age 12 --out coffee.ply
  phytomer mesh coffee --age 36 --tolerance 1mm --out light.ply
  phytomer mesh coffee --age 36 --triangles 10k --out lighter.ply
  phytomer mesh runs/coffee --plant 3 --out third.ply --sides 12
  phytomer mesh my_plant/scenario.toml --age 24 --wind 8 --time 0.40 --out frame-010.ply
  phytomer mesh under_a_roof --plot --age 12 --out plot.ply
  phytomer mesh coffee --age 36 --tolerance 1mm --out coffee.glb
  phytomer mesh coffee --ages 1..48 --keys 12 --seconds 8 --tolerance 2mm --out life.glb
  phytomer mesh my_plant/scenario.toml --age 24 --wind 8 --rig 60 --out sway.glb
  phytomer mesh coffee --ages 1..48/4 --seconds 12 --out life.usdc
  phytomer mesh coffee --age 36 --tolerance 1mm --out print.stl
  phytomer mesh abop/2.8a --age 4 -D lr=1.2 --out tall.ply

A gusty wind repeats every 8 seconds, so frames of --time 0 to 8 make a film that loops.")]
pub struct Mesh {
    /// A run folder, a shipped scenario by its name, or a scenario file by its path.
    #[arg(value_name = "RUN|SCENARIO")]
    name: String,
    /// The plant's number, from 0.
    #[arg(long, default_value_t = 0)]
    plant: u32,
    /// All plants of a plot, each in its place, told from the place of the plot, and the obstacles of its site; the
    /// plot's number, from 0.
    #[arg(long, value_name = "PLOT", num_args = 0..=1, default_missing_value = "0", conflicts_with = "plant")]
    plot: Option<u32>,
    /// Its age in ticks, of a plot its tick; the last of the run if not given. 3.5 is halfway from tick 3 to tick 4.
    #[arg(long, value_parser = age)]
    age: Option<Moment>,
    /// The file to write; its ending tells the format: `.ply`, `.glb` (glTF, Y up), `.stl` (binary, triangles alone),
    /// or USD: `.usdc` (binary), `.usda` (text), `.usdz` (a package). `-` is PLY on stdout. A link stays, and its
    /// target is replaced; a pipe or a device is written through.
    #[arg(long, value_name = "FILE.ply|.glb|.stl|.usdc")]
    out: PathBuf,
    /// Sides of the tube that an internode is drawn as.
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u32).range(3..=64))]
    sides: u32,
    #[command(flatten)]
    constants: Constants,
    #[command(flatten)]
    budget: Budget,
    #[command(flatten)]
    fall: Fall,
    #[command(flatten)]
    growing: Growing,
    #[command(flatten)]
    rig: Rig,
    #[command(flatten)]
    breeze: Breeze,
}

impl Mesh {
    pub fn obey(self) -> Result<Verdict> {
        let format = self.growing.of(Format::of(&self.out)?, self.rig.asked().is_some())?;
        if let (Some(_), false) = (self.rig.asked(), format.holds("rig")) {
            return Err(format.holds_no("rig").into());
        }
        let ages: Vec<Tick> = self.age.iter().map(|age| age.tick()).chain(self.growing.last()).collect();
        match Regrown::find(&self.name, &self.constants, &ages)? {
            Ok(regrown) => self.write(&regrown, format),
            Err(verdict) => Ok(verdict),
        }
    }

    fn write(&self, regrown: &Regrown, format: Format) -> Result<Verdict> {
        if let Some(joints) = self.rig.asked() {
            return rig::write(self, regrown, format, joints);
        }
        match self.plot {
            _ if self.growing.is_asked() && matches!(format, Format::Usd(..)) => usd::write(self, regrown, format),
            _ if self.growing.is_asked() => keyed::write(self, regrown),
            Some(plot) => self.write_plot(regrown, plot, format),
            None => self.write_plant(regrown, format),
        }
    }

    fn write_plant(&self, regrown: &Regrown, format: Format) -> Result<Verdict> {
        let age = self.age.unwrap_or_else(|| regrown.trial.last_age_of(self.plant).into());
        regrown.check(("--age", &[age.age()]), ("--plant", &[self.plant]))?;
        let regrowth = regrown.regrowth(&self.breeze)?.falling(self.fall.fall);
        let mut file = Destination::create(&self.out)?;
        let own = regrown.forms.get(regrown.trial.species_of_plant(self.plant)).cloned().unwrap_or_default();
        let mut options = options_of(self.sides, &own);
        let (seed, what) = (regrown.scenario.seed, format!("plant {} at age {}", self.plant, age.age()));
        let mut refused = None;
        regrowth.show_at(self.plant, &[age], &mut |age, plant| {
            let age = age.tick();
            let faces = |tolerance: &Tolerance| {
                let options = MeshOptions { tolerance: Some(*tolerance), ..options.clone() };
                Scene::new(plant, age, &options).counts().faces
            };
            match self.tolerance(&what, faces) {
                Ok(tolerance) => options.tolerance = tolerance,
                Err(misuse) => {
                    refused = Some(misuse);
                    return Ok(());
                }
            }
            let scene = Scene::new(plant, age, &options);
            let written = check_size(&scene).and_then(|()| format.write_plant(&scene, seed, &mut file));
            Ok(written.with_context(|| self.failing())?)
        })?;
        match refused {
            Some(misuse) => Err(misuse.into()),
            None => self.tell(file, &format!("{what}{}", in_words(options.tolerance.as_ref()))),
        }
    }

    fn write_plot(&self, regrown: &Regrown, plot: u32, format: Format) -> Result<Verdict> {
        let at = self.age.unwrap_or(regrown.scenario.ages.until.into());
        let tick = at.age();
        regrown.check_plot(("--age", &[tick]), plot)?;
        let (regrowth, species) = (regrown.regrowth(&self.breeze)?.falling(self.fall.fall), regrown.species());
        let mut file = Destination::create(&self.out)?;
        let mut within = None;
        let pictured = pictured_plot_at(&regrowth, &species, (plot, &[at]), false)?;
        for stand in &pictured.stands {
            let mut mesh = plot_mesh(stand, &regrowth, (plot, tick), (&species, &regrown.forms), self.sides);
            let what = format!("plot {plot} at tick {tick}");
            within = self.tolerance(&what, |tolerance| mesh.faces_within(tolerance))?;
            within.iter().for_each(|tolerance| mesh.within(*tolerance));
            format.write_plot(&mesh, &mut file).with_context(|| self.failing())?;
        }
        let plants = amounts::of(pictured.stands.iter().map(|stand| stand.members.len() as u64).sum(), "plant");
        self.tell(file, &format!("plot {plot} at tick {tick}, {plants}{}", in_words(within.as_ref())))
    }

    /// The tolerance that is asked for, or that gives at most the triangles that are asked for.
    fn tolerance(&self, what: &str, faces: impl FnMut(&Tolerance) -> u64) -> Result<Option<Tolerance>, Misuse> {
        match self.budget.asked() {
            Asked::Full => Ok(None),
            Asked::Within(tolerance) => Ok(Some(tolerance)),
            Asked::Triangles(most) => fitting(most, faces).map(Some).map_err(|few| too_few(most, what, few)),
        }
    }

    fn failing(&self) -> String {
        format!("cannot write {}", self.out.display())
    }

    fn tell(&self, file: Destination, what: &str) -> Result<Verdict> {
        let bytes = amounts::bytes(file.finish()? as f64);
        let wind = self.breeze.in_words();
        out::tell(&self.out, &format!("{what}{wind}, {bytes}"))?;
        Ok(Verdict::Done)
    }
}
