//! What of a tree of stems is drawn: `--levels`, `--quality`, and `--range` with the picture in which it is seen.
//!
//! They are for models whose stems have levels (Weber & Penn 1995 §5); others are refused. Absent: what is drawn at a
//! range (`phytomer_outputs::meshes::range`).

use super::Misuse;
use super::budget::length;
use super::regrown::Regrown;
use clap::Args;
use phytomer_config::Species;
use phytomer_outputs::meshes::range::{Scales, Zoom};
use phytomer_outputs::meshes::{Afar, Seen};
use phytomer_sim::Tick;

/// The largest numbers that are asked for: of levels, of the quality, of metres, degrees and pixels.
const MOST_LEVELS: u8 = 99;
const MOST_QUALITY: f64 = 100.0;
const MOST_METRES: f64 = 1e6;
const MOST_DEGREES: f64 = 180.0;
const MOST_PIXELS: f64 = 1e5;

/// What of a tree of stems is drawn.
#[derive(Debug, Clone, Default, Args)]
pub struct Part {
    /// Draw some levels of a tree of stems alone, such as 0-1: 0 is the trunk, and leaves have the level after that of
    /// their stem.
    #[arg(long, value_name = "FIRST-LAST", value_parser = levels)]
    levels: Option<[u8; 2]>,
    /// The quality of a tree of stems, which scales the number and the size of its leaves, and the ranges at which it
    /// becomes coarser; 1 is that of its file, unless that says otherwise.
    #[arg(long = "quality", value_name = "QUALITY", allow_negative_numbers = true, value_parser = quality)]
    quality: Option<f64>,
    /// The vertical angle of the picture in which a tree of stems is seen, degrees; 60 if not given.
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, value_parser = angle)]
    fov: Option<f64>,
    /// The height of that picture, pixels; 1000 if not given.
    #[arg(long, value_name = "PIXELS", allow_negative_numbers = true, value_parser = height)]
    image_height: Option<f64>,
}

impl Part {
    /// The options that are used, as they are written.
    pub fn used(&self) -> impl Iterator<Item = &'static str> {
        let used = [
            ("--levels", self.levels.is_some()),
            ("--quality", self.quality.is_some()),
            ("--fov", self.fov.is_some()),
            ("--image-height", self.image_height.is_some()),
        ];
        used.into_iter().filter(|(_, used)| *used).map(|(option, _)| option)
    }

    /// What they make of the plants of a run: those of the quality that is asked for. `more` are other options for
    /// trees of stems that are used.
    ///
    /// # Errors
    /// Where one of the species has no levels.
    pub fn of(&self, regrown: Regrown, more: &[&'static str]) -> anyhow::Result<Regrown> {
        if let Some(option) = self.used().chain(more.iter().copied()).next() {
            let without = |species: &&&Species| species.model.levelled(1).is_none();
            if let Some(species) = regrown.species().iter().find(without) {
                return Err(no_levels(option, species).into());
            }
        }
        match self.quality {
            Some(quality) => regrown.with_quality(quality),
            None => Ok(regrown),
        }
    }

    /// What is seen of a plant of a species at an age: of a tree of stems with the ranges of its elements where
    /// `ranges` says so, or at so many metres.
    pub fn seen(&self, species: &Species, age: Tick, metres: Option<f64>, ranges: bool) -> Seen {
        let zoom = Zoom::default();
        let height = self.image_height.unwrap_or(zoom.height);
        let zoom = Zoom { height, field_of_view_deg: self.fov.unwrap_or(zoom.field_of_view_deg) };
        let afar = species.model.levelled(age).filter(|_| ranges || metres.is_some()).map(|tree| Afar {
            scales: Scales { quality: tree.quality, in_leaf: tree.in_leaf, spring: tree.spring },
            zoom,
            metres,
        });
        Seen { levels: self.levels, afar }
    }

    /// Refuses the measures of a picture without a range that they belong to.
    ///
    /// # Errors
    /// The option that is used.
    pub fn needs_range(&self) -> Result<(), Misuse> {
        let of_a_range = |option: &&str| ["--fov", "--image-height"].contains(option);
        match self.used().find(of_a_range) {
            Some(option) => Err(Misuse(format!("{option}: it belongs to --range, which is not given"))),
            None => Ok(()),
        }
    }

    /// Refuses a part of a plant in the file of a whole life.
    ///
    /// # Errors
    /// The option that is used.
    pub fn needs_age(&self) -> Result<(), Misuse> {
        match self.of_a_part() {
            Some(option) => Err(Misuse(format!("{option}: this is for a plant at one age; leave out --ages"))),
            None => Ok(()),
        }
    }

    /// The option that shows a part of a plant, which instances of its leaves do not.
    pub fn of_a_part(&self) -> Option<&'static str> {
        self.used().find(|option| *option != "--quality")
    }

    /// The levels, to be told.
    pub fn in_words(&self) -> String {
        match self.levels {
            Some([first, last]) if first == last => format!(", level {first}"),
            Some([first, last]) => format!(", levels {first} to {last}"),
            None => String::new(),
        }
    }
}

/// From how far a tree is seen, to be told.
pub fn in_words(afar: Option<Afar>) -> String {
    let metres = afar.and_then(|afar| afar.metres).filter(|metres| *metres > 0.0);
    metres.map(|metres| format!(", as seen from {}", length(metres))).unwrap_or_default()
}

/// That the plants of a species have no levels.
pub fn no_levels(option: &str, species: &Species) -> Misuse {
    let (name, model) = (&species.about.name, species.model.name().word());
    Misuse(format!(
        "{option}: the species `{name}` is of the model `{model}`, whose plants have no levels of stems, as those \
         of `wp/quaking_aspen` have"
    ))
}

/// A range in metres.
///
/// # Errors
/// What is expected.
pub fn metres(text: &str) -> Result<f64, String> {
    within(text, 0.0, MOST_METRES, "a range from 0 to 1,000,000 m is expected")
}

/// Levels, as `0-1` or `2`.
fn levels(text: &str) -> Result<[u8; 2], String> {
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    let level = |text: &str| text.trim().parse::<u8>().ok().filter(|level| *level <= MOST_LEVELS);
    match (level(first), level(last)) {
        (Some(first), Some(last)) if first <= last => Ok([first, last]),
        _ => Err(format!("a level or two are expected, from 0 to {MOST_LEVELS}, such as 2 or 0-1")),
    }
}

fn quality(text: &str) -> Result<f64, String> {
    within(text, f64::MIN_POSITIVE, MOST_QUALITY, "a quality above 0 and up to 100 is expected")
}

fn angle(text: &str) -> Result<f64, String> {
    within(text, 1e-3, MOST_DEGREES, "an angle from 0.001 to 180 degrees is expected")
}

fn height(text: &str) -> Result<f64, String> {
    within(text, 1.0, MOST_PIXELS, "a height from 1 to 100,000 pixels is expected")
}

/// A number within limits.
///
/// # Errors
/// What is expected.
pub fn within(text: &str, least: f64, most: f64, expected: &str) -> Result<f64, String> {
    text.parse::<f64>().ok().filter(|number| (least..=most).contains(number)).ok_or_else(|| expected.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_one_or_two_in_their_order() {
        assert_eq!(["0-1", "2", "0 - 3"].map(levels), [Ok([0, 1]), Ok([2, 2]), Ok([0, 3])]);
        for text in ["1-0", "-1", "", "a", "0-", "0-256", "0..1", "0-1-2"] {
            assert!(levels(text).is_err(), "{text}");
        }
    }

    #[test]
    fn ranges_are_numbers_that_trees_are_seen_at() {
        assert_eq!(metres("600"), Ok(600.0));
        for text in ["-1", "NaN", "inf", "1e9", "", "600m"] {
            assert!(metres(text).is_err(), "{text}");
        }
    }
}
