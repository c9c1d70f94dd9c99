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
    /// How USD and GLB have leaves, flowers and fruits. USD has instances if nothing is asked for: small files, which
    /// Blender plays from 4.5 on, and before shows for ever as they are at the first age. GLB has one mesh if nothing
    /// is asked for, and instances of one age alone: Blender makes an object of each, which takes it seconds.
    #[arg(long, value_enum)]
    leaves: Option<Leaves>,
}

/// How a file has organs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Leaves {
    /// As instances of a few models.
    Instances,
    /// Merged into one mesh.
    Merged,
}

impl Leaves {
    fn organs(self) -> Organs {
        match self {
            Self::Instances => Organs::Instances,
            Self::Merged => Organs::Merged,
        }
    }
}

impl Growing {
    /// The format with its organs as they are asked for; `rig` is whether a skeleton is.
    ///
    /// # Errors
    /// A format that cannot do what is asked for.
    pub fn of(&self, format: Format, rig: bool) -> Result<Format, Misuse> {
        if self.is_asked() && !format.holds("ages") {
            return Err(format.holds_no("ages"));
        }
        match (format, self.leaves) {
            (Format::Usd(encoding, organs), leaves) => {
                if self.keys.is_some() {
                    return Err(Misuse("--keys: this is for a life as GLB; USD has every age".to_owned()));
                }
                Ok(Format::Usd(encoding, leaves.map_or(organs, Leaves::organs)))
            }
            (_, None) => Ok(format),
            (Format::Glb(_), Some(Leaves::Instances)) if self.is_asked() || rig => Err(Misuse(
                "--leaves instances: a GLB file whose vertices move has its organs merged; USD has instances at every age"
                    .to_owned(),
            )),
            (Format::Glb(_), Some(leaves)) => Ok(Format::Glb(leaves.organs())),
            (Format::Ply | Format::Stl | Format::Obj, Some(_)) => Err(Misuse(
                "--leaves: this is for USD and GLB, whose names end in .usdc, .usda, .usdz or .glb".to_owned(),
            )),
        }
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
