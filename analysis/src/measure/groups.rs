//! Groups of rows: by a column of the table, by what is known of the plant, or by a factor of the experiment.
//!
//! A group has a number as soon as a row of it is met; results come in the order of its name, numbers by size. Absent:
//! what is done with the rows.

use super::columns::{Columns, Words};
use super::fault::Fault;
use super::source::Source;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// What rows are grouped by.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum By {
    /// All rows are one group.
    Nothing,
    Run,
    Treatment,
    Species,
    Replicate,
    Block,
    Plot,
    /// The level of a factor.
    Factor(String),
    /// A column of words of the table.
    Word(&'static str),
    /// A column of whole numbers of the table.
    Int(&'static str),
}

/// Groupings that any measure has, but for factors.
const OF_PLANTS: [(&str, By); 6] = [
    ("run", By::Run),
    ("treatment", By::Treatment),
    ("species", By::Species),
    ("replicate", By::Replicate),
    ("block", By::Block),
    ("plot", By::Plot),
];

/// Groupings by columns, for measures whose tables have them.
const OF_ROWS: [(&str, By); 6] = [
    ("order", By::Int("order")),
    ("kind", By::Word("kind")),
    ("state", By::Int("state")),
    ("origin", By::Word("origin")),
    ("age", By::Int("age")),
    ("cycle", By::Int("cycle")),
];

impl By {
    /// The grouping of a word. `rows` are the columns by which the measure can group.
    ///
    /// # Errors
    /// [`Fault::Grouping`] with the groupings that there are.
    pub fn of(word: Option<&str>, measure: &'static str, rows: &[&str], sources: &[Source]) -> Result<Self, Fault> {
        let Some(word) = word else { return Ok(Self::Nothing) };
        let of_rows = OF_ROWS.iter().filter(|(name, _)| rows.contains(name));
        if let Some((_, by)) = OF_PLANTS.iter().chain(of_rows.clone()).find(|(name, _)| *name == word) {
            return Ok(by.clone());
        }
        let factors: Vec<&String> = sources.iter().flat_map(|source| source.levels.keys()).collect();
        if factors.iter().any(|factor| *factor == word) {
            return Ok(Self::Factor(word.to_owned()));
        }
        let mut allowed: Vec<&str> = OF_PLANTS.iter().chain(of_rows).map(|(name, _)| *name).collect();
        for factor in factors {
            if !allowed.contains(&factor.as_str()) {
                allowed.push(factor);
            }
        }
        Err(Fault::Grouping { by: word.to_owned(), measure, allowed: allowed.join(", ") })
    }

    /// The columns of the table that the grouping reads.
    pub fn columns(&self) -> Vec<&'static str> {
        match self {
            Self::Word(name) | Self::Int(name) => vec![name],
            _ => Vec::new(),
        }
    }
}

/// The groups met so far.
pub(super) struct Groups {
    pub by: By,
    names: Vec<String>,
    numbers: BTreeMap<String, u32>,
}

/// The group of each row of a batch.
pub(super) enum Keyed<'a> {
    Constant(u32),
    Words(Words<'a>, Vec<u32>),
    Ints(Cow<'a, [i32]>, BTreeMap<i32, u32>),
    OfPlant(Vec<u32>),
}

impl Groups {
    pub fn new(by: By) -> Self {
        Self { by, names: Vec::new(), numbers: BTreeMap::new() }
    }

    /// The number of a group.
    pub fn number(&mut self, name: &str) -> u32 {
        if let Some(number) = self.numbers.get(name) {
            return *number;
        }
        let number = self.names.len() as u32;
        self.names.push(name.to_owned());
        self.numbers.insert(name.to_owned(), number);
        number
    }

    /// The groups of the plants of a run, where the grouping is known of a plant.
    pub fn of_plants(&mut self, source: &Source) -> Option<Vec<u32>> {
        let name = |value: i32| if value < 0 { "none".to_owned() } else { value.to_string() };
        let of: Box<dyn Fn(&super::source::Plant) -> String> = match self.by.clone() {
            By::Nothing => Box::new(|_| "all".to_owned()),
            By::Run => Box::new(|_| source.label.clone()),
            By::Treatment => Box::new(|plant| source.treatments[plant.treatment as usize].clone()),
            By::Species => {
                let of = |plant: &super::source::Plant| source.species.get(plant.species as usize);
                Box::new(move |plant| of(plant).cloned().unwrap_or_else(|| "none".to_owned()))
            }
            By::Replicate => Box::new(move |plant| name(plant.replicate)),
            By::Block => Box::new(move |plant| name(plant.block)),
            By::Plot => Box::new(move |plant| name(plant.plot)),
            By::Factor(factor) => Box::new(move |plant| level(source, plant.treatment, &factor)),
            By::Word(_) | By::Int(_) => return None,
        };
        Some(source.plants.iter().map(|plant| self.number(&of(plant))).collect())
    }

    /// The group of each row of a batch.
    pub fn keyed<'a>(
        &mut self,
        source: &Source,
        columns: &Columns<'a>,
        of_plants: Option<&[u32]>,
    ) -> Result<Keyed<'a>, Fault> {
        match self.by.clone() {
            By::Nothing => Ok(Keyed::Constant(self.number("all"))),
            By::Run => Ok(Keyed::Constant(self.number(&source.label))),
            By::Word(name) => {
                let words = columns.words(name)?;
                let numbers = words.words.iter().map(|word| self.number(word)).collect();
                Ok(Keyed::Words(words, numbers))
            }
            By::Int(name) => {
                let values = columns.ints(name)?;
                let mut numbers = BTreeMap::new();
                for value in values.iter() {
                    if !numbers.contains_key(value) {
                        let word = if *value < 0 { "none".to_owned() } else { value.to_string() };
                        numbers.insert(*value, self.number(&word));
                    }
                }
                Ok(Keyed::Ints(values, numbers))
            }
            _ => {
                let plants = columns.ints("plant_id")?;
                let of = |plant: &i32| usize::try_from(*plant).ok().and_then(|plant| of_plants?.get(plant).copied());
                let of = plants.iter().map(|plant| of(plant).unwrap_or_default()).collect();
                Ok(Keyed::OfPlant(of))
            }
        }
    }

    /// The groups by name, with the number of each.
    pub fn sorted(&self) -> Vec<(u32, &str)> {
        let mut sorted: Vec<(u32, &str)> = (0..).zip(self.names.iter().map(String::as_str)).collect();
        let key = |name: &str| (name.parse::<u64>().unwrap_or(u64::MAX), name.to_owned());
        sorted.sort_by_key(|(_, name)| key(name));
        sorted
    }
}

/// The level of a factor in a treatment of a run.
pub(super) fn level(source: &Source, treatment: u32, factor: &str) -> String {
    let treatment = &source.treatments[treatment as usize];
    source.levels.get(factor).and_then(|levels| levels.get(treatment)).cloned().unwrap_or_else(|| "none".to_owned())
}

impl Keyed<'_> {
    pub fn at(&self, row: usize) -> u32 {
        match self {
            Self::Constant(group) => *group,
            Self::Words(words, numbers) => words.at(row).map_or(0, |at| numbers[at]),
            Self::Ints(values, numbers) => numbers.get(&values[row]).copied().unwrap_or_default(),
            Self::OfPlant(groups) => groups[row],
        }
    }
}
