//! `mesh`: one plant at one age, or all plants of a plot at one tick, as a mesh file, grown again from their seeds.
//!
//! It is the same plant, with the same component numbers, that the run has recorded. In a wind it is a frame of that
//! plant, which the wind moves for the mesh alone.

mod dressing;
mod formats;
mod joints;
mod keyed;
mod life;
mod lods;
mod measured;
mod plot_lods;
mod rig;
mod usd;

use super::afar::{self, Part};
use super::budget::{Asked, Budget, in_words, too_few};
use super::colouring;
use super::constants::Constants;
use super::measured::Measured;
use super::out;
use super::regrown::{Breeze, Fall, Regrown};
use super::span::age;
use super::{Misuse, Verdict, amounts};
use anyhow::{Context, Result};
use clap::Args;
use dressing::Dressing;
use formats::Format;
use joints::Joining;
use life::Growing;
use lods::Lods;
use phytomer::run::drawing::{check_size, options_of};
use phytomer::run::picturing::{PicturedStand, pictured_plants_at, pictured_plot_at, plot_mesh};
use phytomer_outputs::Destination;
use phytomer_outputs::meshes::{Afar, MeshOptions, PlotMesh, Scene, Seen, Tolerance, fitting, nearest};
use phytomer_outputs::usd::Organs;
use phytomer_sim::Tick;
use phytomer_sim::between::Moment;
use phytomer_sim::plant::Plant;
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
  phytomer mesh under_a_roof --plot --age 12 --colour-by order --out orders.ply
  phytomer mesh coffee --age 36 --tolerance 1mm --out coffee.glb
  phytomer mesh coffee --ages 1..48 --keys 12 --seconds 8 --tolerance 2mm --out life.glb
  phytomer mesh my_plant/scenario.toml --age 24 --wind 8 --rig 60 --out sway.glb
  phytomer mesh coffee --ages 1..48/4 --seconds 12 --out life.usdc
  phytomer mesh coffee --age 36 --tolerance 1mm --out print.stl
  phytomer mesh willow --age 60 --joints welded --out sculpture.stl
  phytomer mesh abop/2.8a --age 4 -D lr=1.2 --out tall.ply
  phytomer mesh monocarp --age 34 --detail 3 --out sunflower.glb
  phytomer mesh monocarp --ages 20..34 --detail 2 --out bloom.usdc
  phytomer mesh runs/walnut --joints welded --out walnut.stl
  phytomer mesh wp/quaking_aspen --levels 0-1 --out collision.ply
  phytomer mesh wp/quaking_aspen --lods 4 --cards --out levels.glb
  phytomer mesh coffee --age 36 --lods 8k,4k --out coffee.ply
  phytomer mesh wp/quaking_aspen --lods 4 --out levels.usdc
  phytomer mesh under_a_roof --plot --age 12 --lods 3 --out plot.glb
  phytomer mesh under_a_roof --plot --age 12 --lods 3 --out plot.usdc
  phytomer mesh wp/quaking_aspen --range 120 --fov 30 --bark 0.5 --out far.glb
  phytomer mesh wp/quaking_aspen --wind 5 --gust 3 --time 0.4 --out swaying.ply

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
    /// `.obj` (with a library of materials beside it), or USD: `.usdc` (binary), `.usda` (text), `.usdz` (a package).
    /// Pictures of materials stand beside an OBJ file and beside USD that is no package. `-` is PLY on stdout. A link
    /// stays, and its target is replaced; a pipe or a device is written through.
    #[arg(long, value_name = "FILE.ply|.glb|.stl|.usdc|.obj")]
    out: PathBuf,
    /// Sides of the tube that an internode is drawn as.
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u32).range(3..=64))]
    sides: u32,
    #[command(flatten)]
    constants: Constants,
    #[command(flatten)]
    budget: Budget,
    #[command(flatten)]
    part: Part,
    /// Draw a tree of stems as it is seen from so many metres away: stems become lines, tubes of three sides, leaves
    /// points, one triangle each, and both become fewer (Weber & Penn 1995 §5). Without it each vertex of such a tree
    /// tells the range until which it is drawn, as `until_m`.
    #[arg(long, value_name = "METRES", allow_negative_numbers = true, value_parser = afar::metres, conflicts_with_all = ["triangles", "ages"])]
    range: Option<f64>,
    #[command(flatten)]
    joining: Joining,
    #[command(flatten)]
    dressing: Dressing,
    #[command(flatten)]
    fall: Fall,
    #[command(flatten)]
    growing: Growing,
    #[command(flatten)]
    lods: Lods,
    #[command(flatten)]
    rig: Rig,
    #[command(flatten)]
    breeze: Breeze,
}

/// Takes a plant as it is drawn, with what is told of it, and returns what is told in the end.
type Take<'t> = dyn FnMut(&str, &Scene) -> Result<Result<String, Misuse>> + 't;

impl Mesh {
    pub fn obey(self) -> Result<Verdict> {
        let format = self.growing.of(Format::of(&self.out)?, self.rig.asked().is_some())?;
        if let (Some(_), false) = (self.rig.asked(), format.holds("rig")) {
            return Err(format.holds_no("rig").into());
        }
        if let Some(measured) = Measured::of(&self.name)? {
            self.dressing.check_format(format, self.plot.is_some(), false)?;
            return measured::write(&self, &measured, format);
        }
        self.joining.check(self.growing.is_asked() || self.rig.asked().is_some())?;
        self.lods.check(&self.out, format)?;
        colouring::whole("--age", self.age.as_slice(), self.dressing.colour_by.as_ref())?;
        let ages: Vec<Tick> = self.age.iter().map(|age| age.tick()).chain(self.growing.last()).collect();
        match Regrown::find(&self.name, &self.constants, &ages)? {
            Ok(regrown) => {
                let range: &[&'static str] = if self.range.is_some() { &["--range"] } else { &[] };
                let regrown = self.part.of(regrown, range)?;
                if self.growing.is_asked() {
                    self.part.needs_age()?;
                }
                self.shows_whole_leaves(format, &regrown)?;
                self.dressing.check(format, self.plot.is_some(), self.growing.is_asked(), &regrown)?;
                self.write(&regrown, format)
            }
            Err(verdict) => Ok(verdict),
        }
    }

    /// Refuses what gives leaves vertices of their own, or leaves some out, where a GLB file has instances of them.
    fn shows_whole_leaves(&self, format: Format, regrown: &Regrown) -> Result<(), Misuse> {
        let stems = || regrown.species().iter().any(|species| species.model.levelled(1).is_some());
        let fewer = || matches!(self.budget.asked(), Asked::Triangles(_)) && stems();
        let range = self.range.map(|_| "--range").or_else(|| fewer().then_some("--triangles"));
        match range.or(self.part.of_a_part()).or(self.dressing.of_each_leaf()) {
            Some(option) if format == Format::Glb(Organs::Instances) => Err(Misuse(format!(
                "{option}: instances show every leaf, and all alike; leave out --leaves instances, or write USD"
            ))),
            _ => Ok(()),
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
            None if self.lods.asked().is_some() => lods::write(self, regrown, format),
            None => self.write_plant(regrown, format),
        }
    }

    fn write_plant(&self, regrown: &Regrown, format: Format) -> Result<Verdict> {
        let mut file = Destination::create(&self.out)?;
        let told = self.show_plant(regrown, &mut |what, scene| {
            let written =
                check_size(scene).and_then(|()| format.write_plant(scene, regrown.scenario.seed, &mut file, &self.out));
            written.with_context(|| self.failing())?;
            Ok(Ok(what.to_owned()))
        })?;
        self.tell(file, &told)
    }

    /// Shows the plant as it is asked for, with what is told of it; returns what the taker tells.
    fn show_plant(&self, regrown: &Regrown, take: &mut Take) -> Result<String> {
        let age = self.age.unwrap_or_else(|| regrown.trial.last_age_of(self.plant).into());
        regrown.check(("--age", &[age.age()]), ("--plant", &[self.plant]))?;
        let regrowth = regrown.regrowth(&self.breeze)?.falling(self.fall.fall);
        let own = regrown.forms.get(regrown.trial.species_of_plant(self.plant)).cloned().unwrap_or_default();
        let mut options = options_of(self.sides, &own);
        self.joining.dress(&mut options);
        let mut by = String::new();
        if self.dressing.colour_by.is_some() {
            let pictured = pictured_plants_at(&regrowth, &regrown.species(), &[self.plant], &[age])?;
            let (colours, meaning) = self.dressing.paint(&pictured, regrown)?;
            (options.colours, by) = (colours.into_iter().next(), meaning);
        }
        let what = format!("plant {} at age {}", self.plant, age.age());
        let (mut told, mut refused) = (String::new(), Ok(()));
        regrowth.show_at(self.plant, &[age], &mut |age, plant| {
            let age = age.tick();
            options.seen = self.part.seen(regrown.species_of(self.plant), age, self.range, true);
            self.dressing.dress(&mut options, regrown, plant);
            refused = self.settle(&what, (plant, age), &mut options);
            if refused.is_err() {
                return Ok(());
            }
            let scene = Scene::new(plant, age, &options);
            refused = self.joining.has_wood(&what, [&scene]);
            if refused.is_ok() {
                let seen = self.part.in_words() + &afar::in_words(options.seen.afar);
                let (within, joined) = (in_words(options.tolerance.as_ref()), self.joining.in_words());
                match take(&format!("{what}{seen}{within}{joined}{by}"), &scene)? {
                    Ok(words) => told = words,
                    Err(misuse) => refused = Err(misuse),
                }
            }
            Ok(())
        })?;
        refused?;
        Ok(told)
    }

    /// Makes the mesh of a plant as fine as it is asked for: of a tree of stems that may have so many triangles, by the
    /// nearest range that fits, else by a tolerance of its wood.
    fn settle(&self, what: &str, (plant, age): (&Plant, Tick), options: &mut MeshOptions) -> Result<(), Misuse> {
        let faces = |options: &MeshOptions| Scene::new(plant, age, options).counts().faces;
        let plain = options.clone();
        match (self.budget.asked(), options.seen.afar) {
            (Asked::Triangles(most), Some(afar)) => {
                let at = |metres| Seen { afar: Some(Afar { metres: Some(metres), ..afar }), ..plain.seen };
                let ends = Scene::new(plant, age, &plain).ends();
                let found = nearest(most, &ends, |metres| faces(&MeshOptions { seen: at(metres), ..plain.clone() }));
                options.seen = found.map(at).map_err(|few| too_few(most, what, few))?;
            }
            _ => {
                let within = |tolerance: &Tolerance| MeshOptions { tolerance: Some(*tolerance), ..plain.clone() };
                options.tolerance = self.tolerance(what, |tolerance| faces(&within(tolerance)))?;
            }
        }
        Ok(())
    }

    fn write_plot(&self, regrown: &Regrown, plot: u32, format: Format) -> Result<Verdict> {
        let at = self.age.unwrap_or(regrown.scenario.ages.until.into());
        let tick = at.age();
        regrown.check_plot(("--age", &[tick]), plot)?;
        let (regrowth, species) = (regrown.regrowth(&self.breeze)?.falling(self.fall.fall), regrown.species());
        let mut file = Destination::create(&self.out)?;
        let mut within = None;
        let apart = self.dressing.colour_by.is_some();
        let pictured = pictured_plot_at(&regrowth, &species, (plot, &[at]), apart)?;
        let (colours, by) = self.dressing.paint(&pictured, regrown)?;
        for stand in &pictured.stands {
            let mut mesh = plot_mesh(stand, &regrowth, (plot, tick), (&species, &regrown.forms), self.sides);
            self.dress_plot(&mut mesh, stand, regrown);
            // Kept apart, plants and bodies are in one order.
            mesh.bodies.iter_mut().zip(&colours).for_each(|(body, of)| body.options.colours = Some(of.clone()));
            let what = format!("plot {plot} at tick {tick}");
            within = self.tolerance(&what, |tolerance| mesh.faces_within(tolerance))?;
            within.iter().for_each(|tolerance| mesh.within(*tolerance));
            let scenes = mesh.bodies.iter().map(|body| Scene::new(body.plant, body.age, &body.options));
            self.joining.has_wood(&what, &scenes.collect::<Vec<_>>())?;
            if self.lods.asked().is_some() {
                return plot_lods::write(self, &mesh, format, &what);
            }
            format.write_plot(&mesh, &mut file, &self.out).with_context(|| self.failing())?;
        }
        let joined = self.joining.in_words();
        let plants = amounts::of(pictured.stands.iter().map(|stand| stand.members.len() as u64).sum(), "plant");
        self.tell(file, &format!("plot {plot} at tick {tick}, {plants}{}{joined}{by}", in_words(within.as_ref())))
    }

    /// States for each plant of a plot what of it is drawn.
    fn dress_plot(&self, mesh: &mut PlotMesh, stand: &PicturedStand, regrown: &Regrown) {
        for (place, body) in mesh.bodies.iter_mut().enumerate() {
            let of = stand.members.iter().find(|member| member.plant == place);
            if let Some(species) = of.and_then(|of| regrown.species().get(of.species).copied()) {
                body.options.seen = self.part.seen(species, body.age, self.range, false);
            }
            self.joining.dress(&mut body.options);
            self.dressing.dress_all(&mut body.options);
        }
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
