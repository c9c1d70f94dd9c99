//! The attributes that a written OPF file has of an entity: those that the description has fields for, and the names of
//! those that it calls features.

use super::super::decimals::{push, push_whole};
use super::super::description::{Description, Entity, Individual, Observation};
use super::super::losses::Losses;
use super::super::numbers::is_lacking;
use super::super::xml::escaped;
use super::parts::CM;
use super::words::{Known, is_structure, known};
use std::collections::{BTreeMap, BTreeSet};

/// Places behind the point of numbers of geometry: 10⁻⁹ cm.
pub(super) const PLACES: usize = 9;
/// Of sizes.
pub(super) const SIZES: usize = 10;

/// A value of a field, before it is written.
pub(super) enum Written<'a> {
    /// A number, and its places.
    Number(f64, usize),
    /// Ticks.
    Ticks(u32),
    /// True or false.
    Truth(bool),
    /// Characters.
    Text(&'a str),
}

impl Written<'_> {
    /// Adds it to a text.
    pub fn push(&self, out: &mut String) {
        match self {
            Self::Number(number, places) => push(out, *number, *places),
            Self::Ticks(ticks) => push_whole(out, *ticks),
            Self::Truth(truth) => out.push_str(if *truth { "true" } else { "false" }),
            Self::Text(text) => out.push_str(&escaped(text.trim())),
        }
    }
}

/// The fields that an entity has a value for, in the order of [`KNOWN`]; what is told of the plant stands with its
/// first.
pub(super) fn fields<'a>(
    described: &Description,
    plant: &'a Individual,
    number: usize,
    entity: &'a Entity,
    mut take: impl FnMut(Known, Written<'a>),
) {
    let mut give = |field, value: Option<Written<'a>>| value.into_iter().for_each(|value| take(field, value));
    let size =
        |of: fn(&Observation) -> Option<f64>| entity.latest().and_then(of).map(|x| Written::Number(x * CM, SIZES));
    give(Known::Length, size(|seen| seen.length));
    give(Known::Width, size(|seen| seen.base_diameter));
    give(Known::TipWidth, size(|seen| seen.tip_diameter));
    let area = entity.latest().and_then(|seen| seen.area);
    give(Known::Area, area.map(|area| Written::Number(area * CM * CM, SIZES)));
    give(Known::Index, entity.index.map(|index| Written::Number(index, PLACES)));
    give(Known::BirthAge, entity.birth.map(Written::Ticks));
    give(Known::DeathAge, entity.death.map(Written::Ticks));
    give(Known::Dead, entity.dead.map(Written::Truth));
    if number == 0 {
        let text = |of: &'a Option<String>| of.as_deref().filter(|of| !is_lacking(of.trim())).map(Written::Text);
        give(Known::PlantName, text(&plant.name));
        give(Known::Species, text(&plant.species));
        give(Known::PlantAge, plant.age.map(Written::Ticks));
        give(Known::TicksPerYear, described.ticks_per_year.map(|ticks| Written::Number(ticks, PLACES)));
    }
}

/// A name of an attribute for each feature: its own where it may be the name of an element, else one like it.
pub(super) fn names(described: &Description, losses: &mut Losses) -> Vec<String> {
    let (mut taken, mut numbers) = (BTreeSet::new(), BTreeMap::new());
    let mut made = Vec::with_capacity(described.features.len());
    for feature in &described.features {
        let mut name: String = feature.name.chars().take(150).map(|c| if is_of_name(c) { c } else { '_' }).collect();
        if !name.starts_with(|c: char| c.is_alphabetic() || c == '_') {
            name.insert(0, '_');
        }
        if is_structure(&name) || known(&name).is_some() {
            name.push('_');
        }
        let plain = name.clone();
        // Numbers go on from the last, so that many like names take no longer than others.
        while taken.contains(&name) {
            let next = numbers.entry(plain.clone()).or_insert(1_u32);
            *next += 1;
            name = format!("{plain}_{next}");
        }
        losses.add("names of features that no attribute can have", u64::from(name != feature.name), "similar names");
        taken.insert(name.clone());
        made.push(name);
    }
    made
}

fn is_of_name(c: char) -> bool {
    c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.') || (!c.is_ascii() && c.is_alphanumeric())
}
