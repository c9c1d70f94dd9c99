//! A scenario: what one run grows, for how long, and what it records.
//!
//! A scenario is one TOML file. Its `experiment` says which treatments are compared: each is the scenario with other
//! values at some keys. A key that has no meaning is refused, so that a file never states something that has no effect.
//! Absent: the species, which is a file of its own, and the place of the run folder, which the command line states.

mod calendar;
mod days;
mod events;
pub mod experiment;
mod field_plot;
pub(crate) mod icasa;
mod light;
mod member;
mod meshes;
mod pests;
mod planting;
mod plots;
mod sample;
mod site;
pub mod stand;
mod surroundings;
pub(crate) mod tables;

pub use calendar::{Calendar, Fertilizer, Soil, TickLength};
pub use events::{Event, Work};
pub use experiment::{Design, Experiment};
pub use field_plot::FieldPlot;
pub use light::Light;
pub use member::Member;
pub use meshes::{MeshAges, MeshAgesWord, MeshFile, MeshPlants, Meshes};
pub use pests::{Attacked, Clustered, Host, Larvae, Pest, exposure};
pub use planting::{Grid, Planting};
pub use plots::Laid;
pub use site::{DrawnObstacle, Kills, Obstacle, Plane, Site, Stems, Wind};
pub use stand::Stand;
pub use tables::Table;

use std::collections::{BTreeMap, BTreeSet};

use phytomer_law::Variate;
use phytomer_law::fault::{Fault, Path};
use phytomer_sim::clock::LAST_TICK;
use phytomer_sim::site::calendar::Calendar as Ticks;
use phytomer_weather::WeatherFile;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The seed of a run that states none: the year of de Reffye's paper. It is printed and recorded like any other seed.
pub const DEFAULT_SEED: u64 = 1988;

/// The largest seed, 2⁶³ − 1: TOML has no larger whole number, and every seed must be one that a scenario can state.
pub const MOST_SEED: u64 = i64::MAX as u64;

/// The memory of one component, about, in bytes: topology, fates and pose together.
pub const BYTES_A_COMPONENT: u64 = 96;

/// A run: species, number of plants, ages, and the tables and meshes that are written.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// The name of the run, and of its folder unless the command line states another.
    #[schemars(length(min = 1, max = 200))]
    pub name: String,
    /// The purpose of the run, in words.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub description: Option<String>,
    /// The species: a shipped species by its name, or a species file by its path from the folder of this file.
    #[schemars(length(min = 1))]
    pub species: String,
    /// The number of plants, of an experiment in each replicate of each treatment; where plots have several members, a
    /// multiple of the number of members.
    #[schemars(range(min = 1, max = 1_000_000_000))]
    pub plants: u32,
    /// The seed of all random draws: an equal seed gives equal bytes. From 0 to 2⁶³ − 1; 1988 if not given.
    #[serde(default = "default_seed")]
    #[schemars(range(min = 0, max = MOST_SEED))]
    pub seed: u64,
    /// The distance between plots, metres, on a square grid; a plot has one plant unless `member` states more. Plot 0
    /// stands at the origin, and square shells of plots follow around it: shell s runs along x = s, then back along y =
    /// s. A plot has the same place whatever the number of plots, and the first n² plots fill a square. If not given,
    /// each plot has an origin of its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(max = 1000.0), extend("exclusiveMinimum" = 0))]
    pub spacing_m: Option<f64>,
    /// The rows of plants and the share of seeds that germinate, by the names and units of the ICASA dictionary.
    #[serde(default, skip_serializing_if = "Planting::is_default")]
    pub planting: Planting,
    /// The treatments that are compared, and their replicates. One treatment, `control`, if not given.
    #[serde(default, skip_serializing_if = "Experiment::is_default")]
    pub experiment: Experiment,
    /// External influences on the plants: gravity, wind, and shapes that kill buds.
    #[serde(default, skip_serializing_if = "Site::is_default")]
    pub site: Site,
    /// The light in the plots. Without it every bud has full light.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub light: Option<Light>,
    /// Constants of the species whose model is an L-system of a file, as `[define]`: they take the place of those that
    /// the species states, and each of these species must have a constant of the name. None if not given.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub define: BTreeMap<String, Variate>,
    /// The pests of the run, as `[[pest]]`. None if not given.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pest: Vec<Pest>,
    /// The plants of each plot, as `[[member]]`. If not given, a plot is one plant of the scenario's species, sown at
    /// tick 0.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub member: Vec<Member>,
    /// Many plants in each plot by a layout, as `[stand]`, instead of `member`: rows, triangles, hills, random places,
    /// a fan, a file. `plants` may then be left out for one plot.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stand: Option<Stand>,
    /// The members of the stand.
    #[serde(skip)]
    #[schemars(skip)]
    pub laid: Laid,
    /// What people do to the plants, as `[[event]]`: pruning, thinning, harvest. Nothing if not given. Of one tick they
    /// are done in the order of this file.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub event: Vec<Event>,
    /// The last tick of the plots, and the recorded ticks.
    pub ages: Ages,
    /// The day of planting, as YYYY-MM-DD: tick 0 is the midnight with which it begins.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub planting_date: Option<String>,
    /// The ticks on the calendar, for laws that depend on the date. Without it ticks have no dates.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub calendar: Option<Calendar>,
    /// The weather of the site.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weather: Option<WeatherFile>,
    /// The nitrogen of the soil.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub soil: Option<Soil>,
    /// Applications of fertilizer, as `[[fertilizer]]`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[schemars(length(max = 1000))]
    pub fertilizer: Vec<Fertilizer>,
    /// The tables that are written. All if not given. With any table, `plants` and `treatments` are written too, since
    /// they state the place and the treatment of each plant.
    #[serde(default = "tables::all")]
    pub tables: BTreeSet<Table>,
    /// The number of plants with rows in `components`, `records` and `events`; all if not given. The plants are drawn
    /// by the seed: `sampled` in `plants` tells which. `summary` and `plants` have rows of all plants.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1, max = 1_000_000_000))]
    pub sample: Option<u32>,
    /// The meshes that are written. None if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub meshes: Option<Meshes>,
    /// The largest size of a plant; a plot stops growing when one of its plants reaches it.
    #[serde(default)]
    pub limits: Limits,
    /// The format of the tables.
    #[serde(default)]
    pub output: Output,
}

/// The last tick of the plots, and the recorded ticks.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ages {
    /// The last tick of the plots; for a plant that is sown at tick 0 it is the last age.
    #[schemars(range(min = 1, max = 65_535))]
    pub until: u32,
    /// The ticks of the plots at which the living components are recorded: `"all"`, a list, or `{ every = 5 }`. All if
    /// not given. For a plant that is sown at tick 0 these are ages.
    #[serde(default)]
    pub record: Record,
}

/// The recorded ages.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Record {
    /// Every age from 1, by the word `all`. Age 0, the seed or the axiom, is recorded only where a list or `from` names
    /// it.
    All(All),
    /// The ages of the list.
    List(#[schemars(length(min = 1))] BTreeSet<u32>),
    /// Ages at equal distances.
    Every(Every),
}

/// Recorded ages at equal distances.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Every {
    /// The number of ticks between two recorded ages.
    #[schemars(range(min = 1))]
    pub every: u32,
    /// The first recorded age. Equal to `every` if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<u32>,
}

/// The word `all`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum All {
    /// Everything: all recorded ages, or all plants.
    All,
}

impl Default for Record {
    fn default() -> Self {
        Self::All(All::All)
    }
}

/// The largest size of a plant; a plot stops growing when one of its plants reaches it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Limits {
    /// The largest number of components of a plant.
    #[schemars(range(min = 1, max = 1_073_741_823))]
    pub max_components: u32,
    /// The largest memory of one plant while it grows, in MB of 10⁶ bytes, at about 96 bytes per component. No limit if
    /// not given.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 16))]
    pub max_memory_mb: Option<u32>,
}

impl Default for Limits {
    fn default() -> Self {
        Self { max_components: 50_000_000, max_memory_mb: None }
    }
}

impl Limits {
    /// The largest number of components of a plant: the smaller of `max_components` and the number that the stated
    /// memory holds.
    ///
    /// The memory is that of one plant. The number of plants that grow at once depends on the machine, and a limit must
    /// not.
    pub fn components(&self) -> u32 {
        self.components_in_memory().map_or(self.max_components, |fitting| fitting.min(self.max_components))
    }

    /// The key of the limit that is reached first.
    pub fn binding(&self) -> &'static str {
        let by_memory = self.components_in_memory().is_some_and(|fitting| fitting < self.max_components);
        if by_memory { "max_memory_mb" } else { "max_components" }
    }

    fn components_in_memory(&self) -> Option<u32> {
        let bytes = u64::from(self.max_memory_mb?) * 1_000_000;
        Some(u32::try_from(bytes / BYTES_A_COMPONENT).unwrap_or(u32::MAX))
    }
}

/// The format of the tables.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Output {
    /// The compression: `zstd1` is faster, `zstd3` gives smaller files.
    pub compression: Compression,
    /// The number of plants in one part file, rounded to whole plots, at least one plot. If not given, it is chosen
    /// from the expected size of the plants.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1))]
    pub plants_per_part: Option<u32>,
    /// The precision of the places of components, metres, from the seed of their plant: 0.0001 saves a quarter of the
    /// bytes. Exact if not given. The places of plants are always exact.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(max = 1.0), extend("exclusiveMinimum" = 0))]
    pub float_precision_m: Option<f64>,
    /// Whether `records` has the columns of mechanics: wood volume, fresh mass, curvature and bending moment.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub mechanics: bool,
    /// Whether tables have the columns of light: `light` in `records`, `intercepted_light_m2` and `light_competition`
    /// in `summary`, `leaf_area_index` and `ground_light` in `site`.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub light: bool,
}

/// The compression of the tables.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Compression {
    /// Level 1 of zstd: faster.
    #[default]
    Zstd1,
    /// Level 3 of zstd: smaller files.
    Zstd3,
}

fn default_seed() -> u64 {
    DEFAULT_SEED
}

impl Ages {
    /// The recorded ticks of the plots, rising.
    pub fn recorded(&self) -> Vec<u32> {
        let until = self.until.min(LAST_TICK);
        match &self.record {
            Record::All(_) => (1..=until).collect(),
            Record::List(ages) => ages.iter().copied().collect(),
            Record::Every(Every { every, from }) => {
                (from.unwrap_or(*every)..=until).step_by((*every).max(1) as usize).collect()
            }
        }
    }
}

impl Scenario {
    /// The faults that the schema cannot state: ages after the last, plants beyond their number, a run that writes
    /// nothing.
    pub fn faults(&self) -> Vec<Fault> {
        self.faults_in_run_of(self.plants, Some(&self.experiment))
    }

    /// The same for the scenario of one treatment of a run that has so many plants in all, in this experiment; `None`
    /// where the experiment could not be read.
    pub fn faults_in_run_of(&self, plants: u32, experiment: Option<&Experiment>) -> Vec<Fault> {
        let mut faults = Vec::new();
        let ages = Path::root().key("ages");
        match &self.ages.record {
            Record::List(list) => self.check_ages(list, &ages.key("record"), &mut faults),
            Record::Every(every) => self.check_every(every, &ages.key("record"), &mut faults),
            Record::All(_) => {}
        }
        let meshes = Path::root().key("meshes");
        if let Some(MeshAges::List(list)) = self.meshes.as_ref().map(|m| &m.ages) {
            self.check_ages(list, &meshes.key("ages"), &mut faults);
        }
        self.check_mesh_plants(plants, &meshes.key("plants"), &mut faults);
        self.check_stand(&mut faults);
        self.check_members(&mut faults);
        self.check_sample(&mut faults);
        let run = pests::Run {
            until: self.ages.until,
            has_places: self.spacing_m.is_some(),
            has_calendar: self.calendar.is_some(),
        };
        pests::check(&self.pest, run, &Path::root().key("pest"), &mut faults);
        self.check_planting(&mut faults);
        let shapes = self.site.shapes(&mut faults);
        self.check_events(&shapes, &mut faults);
        self.check_calendar(&mut faults);
        self.check_constants(&mut faults);
        self.check_light(&mut faults);
        if let Some(experiment) = experiment {
            self.check_years(experiment, &mut faults);
            self.check_blocks(experiment, &mut faults);
        }
        self.site.check_obstacles(&shapes, &Path::root().key("site"), &mut faults);
        if self.tables.is_empty() && self.meshes.is_none() {
            let problem = "this run would write nothing: no table and no mesh is asked for";
            faults.push(Fault::new(&Path::root().key("tables"), problem, "at least one table, or `[meshes]`"));
        }
        if self.output.mechanics && !self.tables.contains(&Table::Records) {
            let problem = "the columns of mechanics belong to the table `records`, which is not written";
            faults.push(Fault::new(&Path::root().key("output").key("mechanics"), problem, "\"records\" in `tables`"));
        }
        faults
    }

    /// The faults of days that do not lie in the calendar of its ticks.
    pub(crate) fn faults_of_days(&self, calendar: &Ticks) -> Vec<Fault> {
        let mut faults = Vec::new();
        self.check_days_of_events(calendar, &mut faults);
        pests::check_days(&self.pest, calendar, &Path::root().key("pest"), &mut faults);
        faults
    }

    fn check_ages(&self, list: &BTreeSet<u32>, path: &Path, faults: &mut Vec<Fault>) {
        let until = self.ages.until;
        let outside: Vec<String> = list.iter().filter(|age| **age > until).map(u32::to_string).collect();
        if !outside.is_empty() {
            let (noun, verb) = if outside.len() == 1 { ("age", "is") } else { ("ages", "are") };
            let list = list_some(&outside);
            let problem = format!("the {noun} {list} {verb} outside the run, which ends at {until}");
            faults.push(Fault::new(path, problem, format!("ages in [0, {until}]")));
        }
    }

    fn check_every(&self, every: &Every, path: &Path, faults: &mut Vec<Fault>) {
        let (key, first) = every.from.map_or(("every", every.every), |from| ("from", from));
        if first > self.ages.until {
            let problem = format!("no age is recorded: the first is {first} and the run ends at {}", self.ages.until);
            faults.push(Fault::new(&path.key(key), problem, format!("a first age in [0, {}]", self.ages.until)));
        }
    }
}

/// The items with commas between them, shortened when there are many: "3, 4, 5, 6, … (12 in all)".
fn list_some(items: &[String]) -> String {
    const SHOWN: usize = 4;
    match items.len() {
        n if n <= SHOWN => items.join(", "),
        n => format!("{}, … ({n} in all)", items[..SHOWN].join(", ")),
    }
}
