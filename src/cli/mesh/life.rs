//! A whole life in one file: `mesh --ages`, a plant grown once and shown at each of some ages.
//!
//! Absent: what a life is (`phytomer_outputs::life`), and how it is written (`phytomer_outputs::usd`).

use super::super::budget::{Asked as Fineness, in_words};
use super::super::regrown::Regrown;
use super::super::span::{Span, shown, span};
use super::super::{Misuse, Verdict};
use super::{Format, Mesh, keyed};
use anyhow::{Context, Result};
use clap::{Args, ValueEnum};
use phytomer::run::drawing::options_of;
use phytomer_outputs::Destination;
use phytomer_outputs::life::{Life, Maker, Nearness};
use phytomer_outputs::meshes::{MeshOptions, Tolerance};
use phytomer_outputs::usd::{self, Asked, Member, Organs, Pace, Plants};
use phytomer_sim::Tick;

/// How near a life is to the plant where nothing is said, metres.
const NEAR: f32 = 1e-3;
/// The time codes of a second.
const A_SECOND: f64 = 24.0;
/// The longest life, seconds.
const LONGEST: f64 = 3600.0;

/// A life instead of an age.
#[derive(Debug, Clone, Args)]
pub struct Growing {
    /// A whole life instead of one age, in a file that plays (GLB, USD): the ages from the first to the last, of a plot
    /// the ticks; after a slash the step between them, such as 1..48/4. It is within 1 mm of the plant, or within
    /// --tolerance.
    #[arg(long, value_name = "FIRST..LAST[/STEP]", value_parser = span, conflicts_with_all = ["age", "wind", "triangles", "sides"])]
    pub(super) ages: Option<Span>,
    /// The length of a life, seconds. If not given: of GLB 12; of USD, which has 24 frames a second, a frame a tick, so
    /// that frame 36 shows age 36.
    #[arg(long, value_name = "SECONDS", requires = "ages", allow_negative_numbers = true, value_parser = seconds)]
    pub(super) seconds: Option<f64>,
    /// At how many of its ages, evenly from the first to the last, a life in a GLB file stands exactly as it has grown:
    /// its morph targets, 16 if not given. Between two of them everything goes evenly from one to the other.
    #[arg(long, value_name = "AGES", requires = "ages", value_parser = clap::value_parser!(u32).range(2..=256))]
    pub(super) keys: Option<u32>,
    /// How USD has leaves, flowers and fruits. Instances are small files; Blender plays them from 4.5 on, and before
    /// shows them for ever as they are at the first age.
    #[arg(long, value_enum)]
    leaves: Option<Leaves>,
}

/// How USD has organs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Leaves {
    /// As instances of a few models.
    Instances,
    /// Merged into one mesh.
    Merged,
}

impl Growing {
    /// The format with its organs as they are asked for.
    ///
    /// # Errors
    /// A format that cannot do what is asked for.
    pub fn of(&self, format: Format, plot: bool) -> Result<Format, Misuse> {
        if self.is_asked() && !format.holds("ages") {
            return Err(format.holds_no("ages"));
        }
        let Format::Usd(encoding, _) = format else {
            return self.leaves.map_or(Ok(format), |_| {
                Err(Misuse("--leaves: this is for files of USD, whose names end in .usdc, .usda or .usdz".to_owned()))
            });
        };
        if self.keys.is_some() {
            return Err(Misuse("--keys: this is for a life as GLB; USD has every age".to_owned()));
        }
        if plot && self.is_asked() {
            return Err(Misuse(
                "--plot: USD has the life of a single plant, by --plant; GLB that of a plot".to_owned(),
            ));
        }
        let merged = self.leaves == Some(Leaves::Merged);
        Ok(Format::Usd(encoding, if merged { Organs::Merged } else { Organs::Instances }))
    }

    /// Whether a life is asked for.
    pub fn is_asked(&self) -> bool {
        self.ages.is_some()
    }

    /// The last age, to which a species by itself must grow.
    pub fn last(&self) -> Option<Tick> {
        self.ages.map(|ages| ages.last)
    }

    fn pace(&self, ages: Span) -> Pace {
        let ticks = f64::from(ages.last - ages.first);
        let a_tick = self.seconds.filter(|_| ticks > 0.0).map_or(1.0, |seconds| seconds * A_SECOND / ticks);
        Pace { a_tick, a_second: A_SECOND }
    }
}

impl Mesh {
    /// Writes the life of a plant.
    pub fn write_life(&self, regrown: &Regrown, format: Format) -> Result<Verdict> {
        let Format::Usd(encoding, organs) = format else { return keyed::write(self, regrown) };
        let (_, ages) = shown(regrown, (self.plant, None), self.growing.ages, "--ages")?;
        let regrowth = regrown.regrowth(&self.breeze)?;
        let mut file = Destination::create(&self.out)?;
        let own = regrown.forms.get(regrown.trial.species_of_plant(self.plant)).cloned().unwrap_or_default();
        let within = match self.budget.asked() {
            Fineness::Within(tolerance) => tolerance,
            Fineness::Full | Fineness::Triangles(_) => Tolerance::of(NEAR),
        };
        let options = options_of(self.sides, &own);
        let life = life_of(&regrowth, self.plant, ages, (within.distance, &options))?;
        let what = format!("plant {} from age {} to age {}", self.plant, ages.first, ages.last);
        let words = format!("{what}, seed {}", regrown.scenario.seed);
        let (lives, options) = ([life], [options]);
        let plants = Plants { lives: &lives, options: &options, members: &[Member::default()] };
        let asked = Asked { encoding, organs, words };
        let pace = self.growing.pace(ages);
        usd::write_life(&asked, &plants, within.distance, &pace, &mut file).with_context(|| self.failing())?;
        self.tell(file, &format!("{what}{}", in_words(Some(&within))))
    }
}

/// The life of a plant at the ages of a span.
fn life_of(
    regrowth: &phytomer::run::regrowth::Regrowth,
    plant: u32,
    ages: Span,
    (distance, options): (f32, &MeshOptions),
) -> Result<Life> {
    let mut maker = Maker::new(Nearness::of(distance), options);
    let ages: Vec<Tick> = (ages.first..=ages.last).step_by(ages.step as usize).collect();
    regrowth.show(plant, &ages, &mut |age, plant| {
        maker.show(plant, age);
        Ok(())
    })?;
    Ok(maker.finish())
}

/// A length of a life.
fn seconds(text: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds > 0.0 && seconds <= LONGEST => Ok(seconds),
        _ => Err(format!("a length above 0 and up to {LONGEST} seconds is expected")),
    }
}
