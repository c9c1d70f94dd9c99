//! A run folder of measured plants, for the verbs that draw plants: those that are asked for, at an age at which they
//! were measured, and what is said of those that cannot be drawn.
//!
//! Absent: what is made of them, which is the verbs', and the plants themselves (`phytomer_outputs::measured`).

use super::{Misuse, named};
use anyhow::{Result, anyhow};
use phytomer_outputs::measured::MeasuredPlants;
use phytomer_outputs::read::Run;
use phytomer_sim::Tick;
use phytomer_sim::between::Moment;
use phytomer_sim::plant::Plant;
use phytomer_sim::site::date::Date;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The most ages that a fault lists.
const LISTED: usize = 12;

/// A run of measured plants.
pub struct Measured {
    /// Its folder.
    pub folder: PathBuf,
    /// Its tables.
    pub run: Run,
    /// What they have of the plants.
    pub plants: MeasuredPlants,
}

impl Measured {
    /// The run of a name, where its plants were measured; `None` where they grow.
    ///
    /// # Errors
    /// A table that cannot be read.
    pub fn of(name: &str) -> Result<Option<Self>> {
        let Some(folder) = named::measured_run(name) else { return Ok(None) };
        let run = Run::open(&folder)?;
        let plants = MeasuredPlants::of(&run).map_err(|told| anyhow!("{}: {told}", folder.display()))?;
        Ok(Some(Self { folder, run, plants }))
    }

    /// The folder, to be told.
    pub fn shown(&self) -> String {
        self.folder.display().to_string()
    }

    /// Refuses options that are for plants that grow.
    ///
    /// # Errors
    /// The first that is used.
    pub fn refuse<'o>(&self, options: impl IntoIterator<Item = (&'o str, bool)>) -> Result<(), Misuse> {
        match options.into_iter().find(|(_, used)| *used) {
            Some((option, _)) => Err(Misuse(format!(
                "{option}: the plants of {} were measured, and this is for plants that grow",
                self.shown()
            ))),
            None => Ok(()),
        }
    }

    /// The age that is asked for, the last one if none is.
    ///
    /// # Errors
    /// An age at which nothing was measured.
    pub fn age(&self, asked: Option<Moment>) -> Result<Tick, Misuse> {
        let ticks = self.plants.ticks();
        let Some(asked) = asked else { return Ok(ticks.last().copied().unwrap_or(0)) };
        let known = ticks.contains(&asked.tick()) && asked.share().is_none();
        if known { Ok(asked.tick()) } else { Err(self.no_age(&format!("--age {}", asked.age()))) }
    }

    /// An age in words, with its date where the file has dates.
    pub fn caption(&self, age: Tick) -> String {
        let dates = &self.run.json()["resolved_scenario"]["measured"]["dates"];
        let first = dates[0].as_str().and_then(|text| Date::parse(text.get(..10)?));
        let date = first.map(|first| format!(" · {}", first.plus(age as i32))).unwrap_or_default();
        format!("age {age}{date}")
    }

    /// That nothing was measured at an age, with the ages that there are.
    pub fn no_age(&self, asked: &str) -> Misuse {
        let ticks = self.plants.ticks();
        let listed: Vec<String> = ticks.iter().take(LISTED).map(Tick::to_string).collect();
        let more = if ticks.len() > LISTED { format!(" … {}", ticks[ticks.len() - 1]) } else { String::new() };
        let ages = match listed.as_slice() {
            [] => "at none".to_owned(),
            listed => format!("at {}{more}", listed.join(", ")),
        };
        Misuse(format!("{asked}: nothing of {} was measured then, but {ages}", self.shown()))
    }

    /// One of the plants that can be drawn.
    ///
    /// # Errors
    /// A plant without places, or one that the run does not have.
    pub fn plant<'p>(&self, plants: &'p BTreeMap<u32, Plant>, number: u32) -> Result<&'p Plant, Misuse> {
        plants.get(&number).ok_or_else(|| self.lacks(number))
    }

    /// Why a plant cannot be drawn.
    pub fn lacks(&self, number: u32) -> Misuse {
        let (shown, count) = (self.shown(), self.plants.count());
        Misuse(match count {
            0 => format!("{shown} has no plants"),
            _ if number < count => format!(
                "plant {number} of {shown} has no places: the file does not tell where its parts are, and it cannot be drawn"
            ),
            _ => format!("{shown} has the plants 0 to {}", count - 1),
        })
    }
}
