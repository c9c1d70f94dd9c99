//! `view`: the whole life of plants as one page that opens in a browser, without network and without a server.
//!
//! The plants are grown again as for meshes and films. Absent: growing, which is `run::viewing`'s, and the page, which
//! is `phytomer_outputs::pages`'.

mod measured;

use super::budget::{length, tolerance};
use super::constants::Constants;
use super::measured::Measured;
use super::out::{self, Format};
use super::regrown::Regrown;
use super::span::{Span, shown, span};
use super::{Misuse, Verdict, amounts, bar, interrupt, terminal};
use anyhow::{Context, Result};
use clap::Args;
use phytomer::run::RunError;
use phytomer::run::filming::Filming;
use phytomer::run::regrowth::{Regrowth, Whose};
use phytomer::run::viewing::View as Shown;
use phytomer_outputs::Destination;
use phytomer_sim::Tick;
use phytomer_sim::between::Moment;
use std::path::PathBuf;
use std::sync::Arc;

const FORMATS: [Format; 2] = [Format { name: "HTML", extension: "html" }, Format { name: "HTML", extension: "htm" }];
/// The most plants side by side.
const MOST_PLANTS: usize = 64;

/// Write the whole life of plants of a run, a scenario or a species as one page for a browser.
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  phytomer view coffee --out life.html
  phytomer view coffee --plants 0,1,2 --ages 0..72 --out three.html
  phytomer view coffee --ages 0..96/4 --tolerance 2mm --out small.html
  phytomer view under_a_roof --plot --out plot.html
  phytomer view monocarp --detail 3 --out sunflower.html
  phytomer view runs/walnut --out walnut.html     plants that were measured, at the dates at which they were

The page is one file. It opens by a double click and asks for nothing from the network. A link may name an age:
life.html#age=48. A mouse, touch or the keys turn the plants; the page itself tells its keys.")]
pub struct View {
    /// A run folder, a scenario or a species: a shipped one by its name, or a file by its path.
    #[arg(value_name = "RUN|SCENARIO|SPECIES")]
    name: String,
    /// The plant's number, from 0.
    #[arg(long, default_value_t = 0)]
    plant: u32,
    /// Several plants side by side, in one scale.
    #[arg(long, value_delimiter = ',', value_name = "PLANT,PLANT,…", conflicts_with = "plant")]
    plants: Vec<u32>,
    /// All plants of a plot in their places; the plot's number, from 0.
    #[arg(long, value_name = "PLOT", num_args = 0..=1, default_missing_value = "0", conflicts_with_all = ["plant", "plants"])]
    plot: Option<u32>,
    /// The ages, of a plot the ticks: from the first to the last, after a slash the step between them; from 0 to the
    /// last of the run if not given. The page goes evenly from one to the next; with 0..48/0.25 it shows how a tick
    /// passes, so that the nodes of a growth unit lengthen one after another. Rows are those of whole ticks.
    #[arg(long, value_name = "FIRST..LAST[/STEP]", value_parser = span)]
    ages: Option<Span>,
    /// How near the page is to the plants, such as 1mm: axes and their motion are simplified within this distance. If
    /// not given, half a pixel of a screen that shows the plants whole.
    #[arg(long, value_name = "LENGTH", value_parser = tolerance, allow_hyphen_values = true)]
    tolerance: Option<f32>,
    /// How finely leaves, flowers and fruits are drawn: 0, a few polygons, to 3, for close-ups. Where a browser would
    /// have too many triangles to draw it is less, which is told.
    #[arg(long, value_name = "0…3", default_value_t = 0, value_parser = clap::value_parser!(u8).range(0..=3))]
    detail: u8,
    /// The file to write, `-` for stdout. A link stays, and its target is replaced; a pipe or a device is written
    /// through.
    #[arg(long, value_name = "FILE.html")]
    out: PathBuf,
    /// Show no progress.
    #[arg(long, short)]
    quiet: bool,
    #[command(flatten)]
    constants: Constants,
}

impl View {
    pub fn obey(self) -> Result<Verdict> {
        out::check(&self.out, "view", &FORMATS)?;
        if self.plants.len() > MOST_PLANTS {
            return Err(Misuse(format!("--plants: one page has at most {MOST_PLANTS} plants side by side")).into());
        }
        if let Some(measured) = Measured::of(&self.name)? {
            return measured::obey(&self, &measured);
        }
        let asked: Vec<Tick> = self.ages.iter().map(Span::until).collect();
        match Regrown::find(&self.name, &self.constants, &asked)? {
            Ok(regrown) => self.write(&regrown),
            Err(verdict) => Ok(verdict),
        }
    }

    fn write(&self, regrown: &Regrown) -> Result<Verdict> {
        let (whose, ages) = self.shown(regrown)?;
        let ages = with_whole(ages);
        let regrowth = Regrowth::new(regrown.trial.clone(), regrown.models(), None);
        let species = regrown.species();
        let view = Shown {
            regrowth: &regrowth,
            species: &species,
            forms: &regrown.forms,
            whose,
            ages,
            tolerance: self.tolerance,
            mechanics: regrown.scenario.output.mechanics,
            detail: self.detail,
        };
        let mut file = Destination::create(&self.out)?;
        let filming = Arc::new(Filming::default());
        let (asked, told) = (Arc::clone(&filming), Arc::clone(&filming));
        interrupt::listen(move || asked.is_stopped(), move || told.stop(), "stopping; nothing is written")?;
        let page = match bar::viewing(&filming, self.quiet, || view.page(&filming)) {
            Err(RunError::Stopped) => {
                terminal::say("stopped; nothing was written");
                return Ok(Verdict::Interrupted);
            }
            page => page?,
        };
        let (plants, within) = (page.subjects.len(), length(f64::from(page.tolerance)));
        let detail = self.detail_in_words(page.detail);
        page.write(&mut file).with_context(|| format!("cannot write {}", self.out.display()))?;
        let bytes = amounts::bytes(file.finish()? as f64);
        let plants = amounts::of(plants as u64, "plant");
        let ages = amounts::of(view.ages.len() as u64, "age");
        out::tell(&self.out, &format!("{plants} at {ages}, within {within}{detail}, {bytes}"))?;
        Ok(Verdict::Done)
    }

    /// The detail of a page, and why it is not the one that is asked for.
    fn detail_in_words(&self, detail: u8) -> String {
        match (self.detail, detail) {
            (0, _) => String::new(),
            (asked, detail) if asked == detail => format!(", detail {detail}"),
            (asked, detail) => format!(", detail {detail} (at detail {asked} it would have too many triangles)"),
        }
    }

    /// What is shown, and its ages.
    fn shown(&self, regrown: &Regrown) -> Result<(Vec<Whose>, Span)> {
        let plants = if self.plants.is_empty() { vec![self.plant] } else { self.plants.clone() };
        if self.plot.is_some() {
            let (whose, ages) = shown(regrown, (0, self.plot), self.ages, "--ages")?;
            return Ok((vec![whose], Span { first: self.ages.map_or(0.0, |ages| ages.first), ..ages }));
        }
        regrown
            .check(("--ages", &[] as &[f64]), (if self.plants.is_empty() { "--plant" } else { "--plants" }, &plants))?;
        let mut last = f64::MAX;
        for (place, plant) in plants.iter().enumerate() {
            if plants[..place].contains(plant) {
                return Err(Misuse(format!("--plants: plant {plant} is named twice")).into());
            }
            let (_, ages) = shown(regrown, (*plant, None), self.ages, "--ages")?;
            last = last.min(ages.last);
        }
        let ages = self.ages.unwrap_or(Span { first: 0.0, last, step: None });
        Ok((plants.into_iter().map(Whose::Plant).collect(), ages))
    }
}

/// The ages of a span, and where some lie between two ticks all whole ones too, which have the rows.
fn with_whole(ages: Span) -> Vec<Moment> {
    let mut all = ages.moments();
    if all.iter().any(|moment| moment.share().is_some()) {
        all.extend((ages.first.ceil() as Tick..=ages.last.floor() as Tick).map(Moment::from));
        all.sort_unstable();
        all.dedup();
    }
    all
}
