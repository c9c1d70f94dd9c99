//! A whole life in one file: `mesh --ages`, a plant or a plot grown once and shown from its first age to its last.
//!
//! Absent: how each format writes it (`keyed`, `usd`).

use super::super::Misuse;
use super::super::span::{Span, span};
use super::Format;
use clap::{Args, ValueEnum};
use phytomer_outputs::usd::Organs;
use phytomer_sim::Tick;

/// The longest animation, seconds.
const LONGEST: f64 = 3600.0;

/// A life instead of an age.
#[derive(Debug, Clone, Args)]
pub struct Growing {
    /// A whole life instead of one age, in a file that plays (GLB, USD): the ages from the first to the last, of a plot
    /// the ticks; after a slash the step between them, such as 1..48/4. Wood is within 1 mm, or within --tolerance.
    #[arg(long, value_name = "FIRST..LAST[/STEP]", value_parser = span, conflicts_with_all = ["age", "wind", "triangles", "sides"])]
    pub ages: Option<Span>,
    /// The length of a life, seconds. If not given, a GLB file lasts 12, and in USD a tick is a frame of 24 a second,
    /// so that frame 36 shows age 36.
    #[arg(long, value_name = "SECONDS", requires = "ages", allow_negative_numbers = true, value_parser = seconds)]
    pub seconds: Option<f64>,
    /// At how many of its ages, evenly from the first to the last, a life in a GLB file stands exactly as it has grown:
    /// its morph targets, 16 if not given. Between two of them everything goes evenly from one to the other.
    #[arg(long, value_name = "AGES", requires = "ages", value_parser = clap::value_parser!(u32).range(2..=256))]
    pub keys: Option<u32>,
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

    /// The last tick, to which a species by itself must grow.
    pub fn last(&self) -> Option<Tick> {
        self.ages.map(|ages| ages.until())
    }
}

/// A length of a life.
fn seconds(text: &str) -> std::result::Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds > 0.0 && seconds <= LONGEST => Ok(seconds),
        _ => Err(format!("a length above 0 and up to {LONGEST} seconds is expected")),
    }
}
