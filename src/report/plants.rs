//! The plants of runs by group, read once from `summary`: a group is a treatment of a run.
//!
//! Plants of one age are taken together, at whichever tick of its plot each has it; standing dead plants are not
//! measured. Absent: charts.

use super::Reported;
use phytomer_measures::Moments;
use phytomer_measures::survival::{Fate, Lives};
use phytomer_outputs::Error;
use phytomer_outputs::read::SummaryRow;
use std::collections::BTreeMap;

/// A column of `summary` that is reported.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Measure {
    /// The column.
    pub column: &'static str,
    /// What it is.
    pub title: &'static str,
    /// Its unit.
    pub unit: &'static str,
    of: Of,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Of {
    Height,
    Crown,
    Leaves,
    Wood,
    Internodes,
}

/// The measures, in the order of the report.
pub const MEASURES: [Measure; 5] = [
    Measure { column: "height_m", title: "height", unit: "m", of: Of::Height },
    Measure { column: "crown_width_m", title: "crown width", unit: "m", of: Of::Crown },
    Measure { column: "leaf_area_m2", title: "leaf area", unit: "m²", of: Of::Leaves },
    Measure { column: "wood_volume_m3", title: "wood volume", unit: "m³", of: Of::Wood },
    Measure { column: "internodes", title: "living internodes", unit: "", of: Of::Internodes },
];

/// The treatment of measured plants, as their tables have it.
const MEASURED: &str = "measured";

/// One value a measure.
pub type Values = [Option<f64>; MEASURES.len()];

/// The plants of a treatment of a run.
#[derive(Debug, Clone)]
pub struct Group {
    /// Its name in legends.
    pub name: String,
    /// The run, as an index into those that are reported.
    pub run: usize,
    /// Whether its plants grow; else they were measured.
    pub grows: bool,
    /// How many plants were recorded.
    pub plants: u64,
    /// By age the moments of each measure over the living plants.
    pub ages: BTreeMap<u32, [Moments; MEASURES.len()]>,
    /// How long its plants lived.
    pub lives: Lives,
    /// The living plants at the last recorded age, by replicate and number, which plants of other treatments share.
    pub last: BTreeMap<(u32, u32), Values>,
}

/// The plants of all runs.
#[derive(Debug, Clone)]
pub struct Grown {
    /// The groups: of each run, its treatments.
    pub groups: Vec<Group>,
    /// The last age that any plant was recorded at.
    pub last_age: u32,
    /// The unit of ages: ticks, and how long one is.
    pub tick: String,
}

impl Measure {
    fn of(self, row: &SummaryRow) -> Option<f64> {
        match self.of {
            Of::Height => row.height_m,
            Of::Crown => row.crown_width_m,
            Of::Leaves => Some(row.leaf_area_m2),
            Of::Wood => Some(row.wood_volume_m3),
            Of::Internodes => Some(f64::from(row.internodes)),
        }
    }
}

impl Grown {
    /// Reads the plants of runs.
    ///
    /// # Errors
    /// Where `summary` cannot be read.
    pub fn read(runs: &[Reported]) -> Result<Self, Error> {
        let mut grown = Self { groups: Vec::new(), last_age: 0, tick: tick_in_words(runs) };
        for (place, reported) in runs.iter().enumerate() {
            grown.add(place, reported, runs.len() > 1)?;
        }
        Ok(grown)
    }

    fn add(&mut self, place: usize, reported: &Reported, several: bool) -> Result<(), Error> {
        let rows = reported.run.summary()?;
        let last_age = rows.iter().map(|row| row.age).max().unwrap_or(0);
        self.last_age = self.last_age.max(last_age);
        let treatments: Vec<&str> = match reported.trial {
            Some(trial) => trial.treatments().iter().map(|treatment| treatment.name.as_str()).collect(),
            None => vec![MEASURED],
        };
        let name = |treatment: &str| match (several, treatments.len() > 1) {
            (false, true) => treatment.to_owned(),
            (true, true) => format!("{}: {treatment}", reported.name),
            (_, false) => reported.name.clone(),
        };
        let first = self.groups.len();
        self.groups.extend(treatments.iter().map(|treatment| Group {
            name: name(treatment),
            run: place,
            grows: reported.trial.is_some(),
            plants: 0,
            ages: BTreeMap::new(),
            lives: Lives::default(),
            last: BTreeMap::new(),
        }));
        let mut latest: BTreeMap<u32, (u32, Option<u32>)> = BTreeMap::new();
        for row in &rows {
            let (treatment, key) = of_plant(reported, row.plant_id);
            if row.alive {
                self.groups[first + treatment].measure(row, (row.age == last_age).then_some(key));
            }
            latest.insert(row.plant_id, (row.age, row.death_age));
        }
        for (plant, (age, death)) in latest {
            let group = &mut self.groups[first + of_plant(reported, plant).0];
            // A plant that lives at the end of the run, or whose plot ended at a limit, is known to its last row.
            let (ticks, fate) = death.map_or((age, Fate::Censored), |death| (death, Fate::Ended(0)));
            group.lives.add(plant, ticks, fate);
            group.plants += 1;
        }
        Ok(())
    }
}

/// The treatment of a plant, and its replicate and number; measured plants have their numbers alone.
fn of_plant(reported: &Reported, plant: u32) -> (usize, (u32, u32)) {
    match reported.trial.map(|trial| trial.plant(plant)) {
        Some(of) => (of.treatment, (of.replicate, of.number)),
        None => (0, (0, plant)),
    }
}

impl Group {
    fn measure(&mut self, row: &SummaryRow, at_last: Option<(u32, u32)>) {
        // Of measured plants `summary` has no area and no volume where none was measured, which are read as 0.
        let is_told = |value: &f64| self.grows || *value > 0.0;
        let values = MEASURES.map(|measure| measure.of(row).filter(is_told));
        let moments = self.ages.entry(row.age).or_default();
        for (moments, value) in moments.iter_mut().zip(values) {
            value.into_iter().for_each(|value| moments.add(value));
        }
        if let Some(key) = at_last {
            self.last.insert(key, values);
        }
    }
}

/// "ticks of one month"; of several runs with other ticks, "ticks". Ages of measured plants are days where their file
/// has dates.
fn tick_in_words(runs: &[Reported]) -> String {
    let dated = |reported: &Reported| {
        let dates = &reported.run.json()["resolved_scenario"]["measured"]["dates"];
        dates.as_array().is_some_and(|dates| !dates.is_empty())
    };
    if runs.iter().all(dated) {
        return "days since the first date".to_owned();
    }
    let mut ticks = runs.iter().flat_map(|reported| &reported.species).map(|species| species.about.tick.as_str());
    let measured = runs.iter().any(|reported| reported.trial.is_none());
    let Some(first) = ticks.next().filter(|_| !measured) else { return "ticks".to_owned() };
    if ticks.all(|tick| tick == first) { format!("ticks of {first}") } else { "ticks".to_owned() }
}
