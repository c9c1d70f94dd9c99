//! Summaries by their names: `height_m@60` is the mean height of living plants at age 60.
//!
//! A column of `summary`, its deviation `sd(height_m)@60`, the share of living plants `living@60`, or a measure of
//! `phytomer measure` that tells one number, in all or in a group: `nodes-per-axis(order=2)@60`. A text that begins
//! with SELECT is a query, which needs the feature `sql`. Absent: how a summary is found.

use phytomer_analysis::measure::{Card, MEASURES};
use phytomer_models::law::spelling::nearest;
use phytomer_outputs::tables;
use phytomer_sim::Tick;
use phytomer_sim::clock::LAST_TICK;

/// A number of a plant at an age.
pub type Size = fn(&tables::Summary) -> f64;

/// What is summarised.
#[derive(Debug, Clone)]
pub enum What {
    /// The mean of a number of living plants, or its standard deviation.
    Size {
        /// The column of `summary`.
        column: &'static str,
        /// The number of a plant.
        size: Size,
        /// Whether it is the deviation.
        spread: bool,
    },
    /// The share of plants that live.
    Living,
    /// A measure of recorded runs, at the end of a run to the age.
    Measure {
        /// The measure.
        card: &'static Card,
        /// The column and the value of its group.
        group: Option<(String, String)>,
    },
    /// The first number that a query gives, of a run to the age.
    #[cfg(feature = "sql")]
    Query(String),
}

/// A summary with its name.
#[derive(Debug, Clone)]
pub struct Summary {
    /// Its name as it was typed.
    pub name: String,
    /// The age of the plants, ticks.
    pub age: Tick,
    /// What it is of.
    pub what: What,
}

/// The columns of `summary`.
const SIZES: [(&str, Size); 17] = [
    ("height_m", |own| own.height),
    ("crown_width_m", |own| own.crown_width),
    ("leaf_area_m2", |own| own.leaf_area),
    ("wood_volume_m3", |own| own.wood_volume),
    ("basal_diameter_m", |own| own.basal_diameter),
    ("diameter_at_1_3_m", |own| own.breast_diameter),
    ("lowest_leaf_m", |own| own.lowest_leaf),
    ("internodes", |own| f64::from(own.internodes)),
    ("leaves", |own| f64::from(own.leaves)),
    ("flowers", |own| f64::from(own.flowers)),
    ("fruits", |own| f64::from(own.fruits)),
    ("buds", |own| f64::from(own.buds)),
    ("dead_internodes", |own| f64::from(own.dead_internodes)),
    ("axes", |own| f64::from(own.axes)),
    ("max_order", |own| f64::from(own.max_order)),
    ("harvested_fruits", |own| f64::from(own.harvested_fruits)),
    ("harvested_fresh_mass_kg", |own| own.harvested_mass),
];

/// Measures that are the mean of a column.
const MEANS: [(&str, &str); 4] = [
    ("height", "height_m"),
    ("crown-width", "crown_width_m"),
    ("leaf-area", "leaf_area_m2"),
    ("wood-volume", "wood_volume_m3"),
];

/// The mean of values, or their standard deviation; `None` for too few.
pub fn summarised(values: &[f64], spread: bool) -> Option<f64> {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let square = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>();
    match (spread, values.len()) {
        (_, 0) | (true, 1) => None,
        (true, _) => Some((square / (n - 1.0)).sqrt()),
        (false, _) => Some(mean),
    }
}

/// Reads the name of a summary.
///
/// # Errors
/// In words: what is wrong with it, and what was meant.
pub fn read(name: &str) -> Result<Summary, String> {
    let name = name.trim();
    let begins = |word: &str| name.get(..word.len()).is_some_and(|own| own.eq_ignore_ascii_case(word));
    if begins("select ") || begins("with ") {
        return query(name);
    }
    let Some((what, age)) = name.rsplit_once('@') else {
        return Err(format!("`{}` names no age: a summary at an age is expected, such as height_m@60", clip(name)));
    };
    let age = age_of(name, age)?;
    let what = match what.split_once('(').map(|(word, rest)| (word, rest.strip_suffix(')'))) {
        None => plain(what)?,
        Some((_, None)) => return Err(format!("`{}` has a bracket that does not end", clip(name))),
        Some(("sd", Some(column))) => deviation(column)?,
        Some((word, Some(group))) => grouped(word, group)?,
    };
    Ok(Summary { name: name.to_owned(), age, what })
}

fn age_of(name: &str, age: &str) -> Result<Tick, String> {
    let expected = || format!("`{}`: a whole age from 1 to {LAST_TICK} ticks is expected after @", clip(name));
    age.parse::<Tick>().ok().filter(|age| (1..=LAST_TICK).contains(age)).ok_or_else(expected)
}

#[cfg(feature = "sql")]
fn query(text: &str) -> Result<Summary, String> {
    match text.rsplit_once('@') {
        Some((sql, age)) => {
            let age = age_of(text, age.trim())?;
            Ok(Summary { name: text.to_owned(), age, what: What::Query(sql.trim().to_owned()) })
        }
        None => Err(format!("`{}` names no age: end it with the age of the run, such as @60", clip(text))),
    }
}

#[cfg(not(feature = "sql"))]
fn query(text: &str) -> Result<Summary, String> {
    Err(format!(
        "`{}` is SQL, and this program was built without it: name a summary, such as height_m@60, or build one with \
         `cargo install --path . --features sql`, in many minutes",
        clip(text)
    ))
}

fn size(column: &str) -> Option<(&'static str, Size)> {
    let column = MEANS.iter().find(|(name, _)| *name == column).map_or(column, |(_, column)| column);
    SIZES.iter().find(|(name, _)| *name == column).copied()
}

fn plain(word: &str) -> Result<What, String> {
    if word == "living" {
        return Ok(What::Living);
    }
    match size(word) {
        Some((column, size)) => Ok(What::Size { column, size, spread: false }),
        None => Ok(What::Measure { card: card(word)?, group: None }),
    }
}

fn deviation(column: &str) -> Result<What, String> {
    let (column, size) = size(column).ok_or_else(|| unknown(column))?;
    Ok(What::Size { column, size, spread: true })
}

fn grouped(word: &str, group: &str) -> Result<What, String> {
    let card = card(word)?;
    let Some((by, value)) = group.split_once('=') else {
        return Err(format!("`{word}({})`: a group is expected, such as order=2", clip(group)));
    };
    if !card.groups.contains(&by) {
        let groups = if card.groups.is_empty() { "none".to_owned() } else { card.groups.join(", ") };
        let near = nearest(by, card.groups.iter().copied())
            .map_or_else(String::new, |near| format!("; the nearest is `{near}`"));
        return Err(format!("`{word}` has no groups by `{}`; it has: {groups}{near}", clip(by)));
    }
    Ok(What::Measure { card, group: Some((by.to_owned(), value.to_owned())) })
}

fn card(word: &str) -> Result<&'static Card, String> {
    let card = MEASURES.iter().find(|card| card.name == word).ok_or_else(|| unknown(word))?;
    match card.tells_a_number() {
        true => Ok(card),
        false => Err(format!("`{word}` tells more than one number of a run and cannot be a summary; {}", listed())),
    }
}

fn unknown(word: &str) -> String {
    let near = nearest(word, names()).map_or_else(listed, |near| format!("the nearest is `{near}`"));
    format!("there is no measure `{}`; {near}", clip(word))
}

fn names() -> impl Iterator<Item = &'static str> {
    let measures = MEASURES.iter().filter(|card| card.tells_a_number()).map(|card| card.name);
    SIZES.iter().map(|(name, _)| *name).chain(["living"]).chain(measures)
}

fn listed() -> String {
    format!("there are: {}", names().collect::<Vec<_>>().join(", "))
}

/// The first letters of a text, for a message.
fn clip(text: &str) -> String {
    let clipped: String = text.chars().take(60).collect();
    if clipped.len() < text.len() { format!("{clipped}…") } else { clipped }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_or_told() {
        let good = [
            "height_m@60",
            "sd(leaves)@5",
            "living@9",
            "height@3",
            "nodes-per-axis(order=2)@12",
            "activity@4",
            "branching@8",
        ];
        for name in good {
            read(name).unwrap_or_else(|problem| panic!("{problem}"));
        }
        let told = |name: &str, words: &str| {
            let problem = read(name).unwrap_err();
            assert!(problem.contains(words), "{problem}");
        };
        told("heigth_m@60", "the nearest is `height_m`");
        told("height_m", "names no age");
        told("height_m@0", "a whole age from 1");
        told("height_m@2.5", "a whole age from 1");
        told("sd(hight_m)@5", "`height_m`");
        told("sd(height_m@5", "does not end");
        told("crown-profile@9", "more than one number");
        told("nodes-per-axis(oder=2)@9", "the nearest is `order`");
        told("nodes-per-axis(2)@9", "a group is expected");
        told("divergance@9", "`divergence`");
        #[cfg(not(feature = "sql"))]
        told("SELECT avg(age) FROM summary", "built without it");
    }

    #[test]
    fn means_and_deviations() {
        assert_eq!(summarised(&[1.0, 2.0, 3.0, 6.0], false), Some(3.0));
        assert!((summarised(&[1.0, 2.0, 3.0, 6.0], true).unwrap() - (14.0_f64 / 3.0).sqrt()).abs() < 1e-15);
        assert_eq!((summarised(&[], false), summarised(&[1.0], true)), (None, None));
    }
}
