//! `summary`, `records` and `components` agree on a plant: on its living and standing parts, their ages and their
//! sizes.
//!
//! Every column of `summary` is recomputed from the rows of the other two, read back from Parquet, for every shipped
//! species and every fixture at all recorded ages; and the rows of `records` at an age are the components that stand
//! then by `components`, living or dead alike. Counts, ages and places agree exactly. Areas and volumes agree to the
//! rounding of single precision, in which `records` holds each of them and `summary` does not.

mod read;
#[path = "program/side_by_side.rs"]
mod side_by_side;

use phytomer::config::scenario::stand::Layout;
use phytomer::config::scenario::{Every, Laid, Record, Scenario};
use phytomer::config::{self, Kind, Resolved, SPECIES_ALONE_UNTIL, presets, validate, validate_species};
use phytomer::run::{self, Progress, Settings};
use read::Columns;
use side_by_side::each;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The most components that a plant is expected to have at the last tested age.
const COMPONENTS: f64 = 1500.0;

/// The last age of plants without an expectation.
const UNFORESEEN: u32 = 24;

/// Ages recorded of one plant, about.
const AGES: u32 = 24;

/// Sums of numbers that were rounded to single precision, a few roundings each, over the sum of the exact ones.
const ROUNDING: f64 = 1e-6;

/// One plant at one age, computed from the rows of the other tables.
#[derive(Debug, Default)]
struct Told {
    counts: BTreeMap<&'static str, f64>,
    axes: BTreeSet<u32>,
    max_order: f64,
    /// The least and the greatest coordinates of the tips of living internodes, in single precision as in the rows.
    low: [f32; 3],
    high: [f32; 3],
    leaf_area: f64,
    wood_volume: f64,
    /// The axis of the seed by the least number of an axis that stands on the seed, with the diameter at its base.
    base: Option<(f64, f64)>,
    /// The greatest diameter at 1.3 m of living internodes of order 1.
    at_breast_height: f64,
    lowest_leaf: f64,
    /// Each component with whether it lives, by number.
    standing: Vec<(u32, bool)>,
}

impl Told {
    /// What is told of a plant of which nothing stands.
    fn of_nothing() -> Self {
        let (low, high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        Self { low, high, at_breast_height: f64::NAN, lowest_leaf: f64::NAN, ..Self::default() }
    }
}

/// Plants by number and age.
type Plants = BTreeMap<(u32, u32), Told>;

/// Tests all plants of every shipped scenario, and one plant of every other species and fixture.
fn all() -> Vec<Resolved> {
    let report = |name: &str, report: config::Report| -> Resolved { panic!("{name}: {}", report.render(false)) };
    let scenario = |name: &str| validate(name).unwrap_or_else(|told| report(name, told));
    let species = |name: &str| match validate_species(name, SPECIES_ALONE_UNTIL) {
        Ok(found) => found.alone(name),
        Err(told) => report(name, told),
    };
    let mut all: Vec<Resolved> = presets(Kind::Scenario).iter().map(|(name, _)| scenario(name)).collect();
    let seen: BTreeSet<String> = all.iter().map(|resolved| resolved.scenario.species.clone()).collect();
    let others = presets(Kind::Species).iter().map(|(name, _)| *name).filter(|name| !seen.contains(*name));
    all.extend(others.map(species));
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    for folder in ["config/tests/good", "tests/data/runs"] {
        let files = std::fs::read_dir(here.join(folder)).expect("fixtures").map(|file| file.expect("a file").path());
        let mut files: Vec<String> = files.map(|file| file.display().to_string()).collect();
        files.sort();
        for file in files.iter().filter(|file| file.ends_with(".toml")) {
            match config::kind_of(file) {
                Kind::Scenario => all.push(scenario(file)),
                Kind::Species => all.push(species(file)),
            }
        }
    }
    all
}

/// A few plants of a stand, in each replicate and treatment: two of a row, the inner ones of a spoke, of a list one of
/// each species, sown at an age that is tested; of hills and of drawn places one plant.
fn thin(scenario: &mut Scenario, last_sowing: u32) {
    let Some(stand) = &mut scenario.stand else { return };
    match &mut stand.layout {
        Layout::Rows(rows) | Layout::Triangular(rows) => {
            let guards = 2 * stand.guard_rows;
            (rows.rows, rows.plants, rows.size_m) = (Some(guards + 2), Some(guards + 1), None);
        }
        Layout::Nelder(fan) => (fan.spokes, fan.arcs) = (1, fan.arcs.min(2 * stand.guard_rows + 1)),
        Layout::Places(places) => {
            let mut species = BTreeSet::new();
            places.at.retain(|place| species.insert(place.species.clone()));
            places.at.iter_mut().for_each(|place| place.sown = place.sown.map(|sown| sown.min(last_sowing)));
        }
        Layout::Hills(_) | Layout::Random(_) => scenario.stand = None,
    }
    scenario.laid = Laid::default();
    scenario.plants = scenario.members();
}

/// The scenario with two plots, at an age that is quickly tested, with all tables and the columns of mechanics. Of the
/// members of its plots the first of each species is kept, of a stand a few plants.
fn small(mut resolved: Resolved) -> Resolved {
    let scenario = &mut resolved.scenario;
    let until = scenario.ages.until;
    let is_small = |age: &u32| {
        let expected = resolved.model.expectation(*age);
        expected.map_or(*age <= UNFORESEEN, |expected| expected.components(*age) <= COMPONENTS)
    };
    let until = (1..=until).rev().find(is_small).unwrap_or(1);
    let every = until.div_ceil(AGES);
    scenario.ages.until = until;
    scenario.ages.record = Record::Every(Every { every, from: Some(until - every * ((until - 1) / every)) });
    let mut species = BTreeSet::new();
    scenario.member.retain(|member| species.insert(member.species.clone()));
    scenario.plants = 2 * scenario.members();
    let last_sowing = until - 1;
    scenario.member.iter_mut().for_each(|member| member.sown = member.sown.min(last_sowing));
    thin(scenario, last_sowing);
    resolved.treatments.iter_mut().for_each(|treatment| thin(&mut treatment.scenario, last_sowing));
    scenario.meshes = None;
    scenario.output.mechanics = true;
    scenario.output.float_precision_m = None;
    scenario.tables = compared_tables();
    resolved
}

fn compared_tables() -> BTreeSet<config::scenario::Table> {
    use config::scenario::Table;
    BTreeSet::from([Table::Components, Table::Records, Table::Summary])
}

/// The plants by `records`.
fn by_records(records: &Columns) -> Plants {
    let number = |name: &str| records.numbers(name);
    let (plant, age, component, axis) = (number("plant_id"), number("age"), number("component_id"), number("axis_id"));
    let (order, alive, area, volume) = (number("order"), number("alive"), number("area_m2"), number("wood_volume_m3"));
    let (diameter, diameter_tip) = (number("diameter_m"), number("diameter_tip_m"));
    let (rank, parent) = (number("rank"), number("parent_id"));
    let (length, kind) = (number("length_m"), records.words("kind"));
    let (base, dir) = (["x_m", "y_m", "z_m"].map(number), ["dir_x", "dir_y", "dir_z"].map(number));
    let mut plants = Plants::new();
    let mut told = &mut Told::of_nothing();
    for row in 0..plant.len() {
        // Rows of one plant at one age follow one another, mostly.
        if row == 0 || (plant[row], age[row]) != (plant[row - 1], age[row - 1]) {
            told = plants.entry((plant[row] as u32, age[row] as u32)).or_insert_with(Told::of_nothing);
        }
        let lives = alive[row] == 1.0;
        told.standing.push((component[row] as u32, lives));
        let stem = kind[row].ends_with("internode");
        let counted = match kind[row].as_str() {
            _ if stem && lives => "internodes",
            _ if stem => "dead_internodes",
            "leaf" => "leaves",
            "flower" | "inflorescence" | "spikelet" => "flowers",
            "fruit" | "infructescence" | "strobilus" => "fruits",
            "apical_bud" => "buds",
            _ => "others",
        };
        *told.counts.entry(counted).or_default() += 1.0;
        if stem || counted == "buds" {
            told.axes.insert(axis[row] as u32);
            told.max_order = told.max_order.max(order[row]);
        }
        if counted == "internodes" {
            for k in 0..3 {
                let tip = base[k][row] as f32 + length[row] as f32 * dir[k][row] as f32;
                told.low[k] = told.low[k].min(tip);
                told.high[k] = told.high[k].max(tip);
            }
            if order[row] == 1.0 {
                let tip = base[2][row] as f32 + length[row] as f32 * dir[2][row] as f32;
                let (low, top) = (base[2][row], f64::from(tip));
                if low <= 1.3 && 1.3 < top {
                    let slope = (diameter_tip[row] - diameter[row]) / (top - low);
                    told.at_breast_height = told.at_breast_height.max(diameter[row] + slope * (1.3 - low));
                }
            }
            if rank[row] == 1.0 && parent[row].is_nan() && told.base.is_none_or(|(known, _)| axis[row] < known) {
                told.base = Some((axis[row], diameter[row]));
            }
        }
        if matches!(kind[row].as_str(), "leaf" | "leaflet") {
            told.leaf_area += if area[row].is_nan() { 0.0 } else { area[row] };
            told.lowest_leaf = told.lowest_leaf.min(base[2][row]);
        }
        told.wood_volume += if stem { volume[row] } else { 0.0 };
    }
    plants.values_mut().for_each(|told| told.standing.sort_unstable());
    plants
}

/// `components`, with the rows of each plant, so that an age of a plant looks at its own rows alone.
struct Components<'a> {
    columns: &'a Columns,
    of: BTreeMap<u32, Vec<usize>>,
}

impl<'a> Components<'a> {
    fn new(columns: &'a Columns) -> Self {
        let mut of = BTreeMap::<u32, Vec<usize>>::new();
        for (row, plant) in columns.numbers("plant_id").iter().enumerate() {
            of.entry(*plant as u32).or_default().push(row);
        }
        Self { columns, of }
    }

    fn of(&self, plant: u32) -> &[usize] {
        self.of.get(&plant).map_or(&[], Vec::as_slice)
    }

    /// The components that stand at an age, living or dead, and the age at which the last of them died.
    fn standing(&self, plant: u32, age: u32) -> (Vec<(u32, bool)>, f64) {
        let number = |name: &str| self.columns.numbers(name);
        let (component, birth) = (number("component_id"), number("birth_age"));
        let (death, shed) = (number("death_age"), number("shed_age"));
        let (mut standing, mut last) = (Vec::new(), f64::NAN);
        let age = f64::from(age);
        // Null is NaN and stands for a tick that never comes.
        let before = |tick: f64| tick.is_nan() || age < tick;
        for row in self.of(plant).iter().copied().filter(|row| birth[*row] <= age) {
            assert!(shed[row].is_nan() || shed[row] >= death[row], "nothing falls before its death: component {row}");
            if before(shed[row]) {
                standing.push((component[row] as u32, before(death[row])));
            }
            if !before(death[row]) {
                last = death[row].max(last);
            }
        }
        standing.sort_unstable();
        (standing, last)
    }

    /// The fruits of a plant that were harvested by an age.
    fn harvested(&self, plant: u32, age: u32) -> f64 {
        let death = self.columns.numbers("death_age");
        let (kind, cause) = (self.columns.words("kind"), self.columns.words("cause_of_death"));
        let fruit = |row: &&usize| matches!(kind[**row].as_str(), "fruit" | "infructescence" | "strobilus");
        let rows = self.of(plant).iter().filter(|row| death[**row] <= f64::from(age));
        rows.filter(fruit).filter(|row| cause[**row] == "harvested").count() as f64
    }
}

/// Compares the columns of one row of `summary` with the other tables.
fn check(summary: &Columns, row: usize, told: &Told, last_death: f64) {
    let number = |name: &str| summary.numbers(name)[row];
    for column in ["internodes", "leaves", "flowers", "fruits", "buds", "dead_internodes"] {
        assert_eq!(number(column), told.counts.get(column).copied().unwrap_or_default(), "{column}");
    }
    assert_eq!((number("axes"), number("max_order")), (told.axes.len() as f64, told.max_order), "axes, max_order");
    let lives = told.standing.iter().any(|(_, lives)| *lives);
    assert_eq!(number("alive") == 1.0, lives, "alive");
    let death = if lives { f64::NAN } else { last_death };
    assert_eq!(number("death_age").to_bits(), death.to_bits(), "death_age");
    let stands = number("internodes") > 0.0;
    let extent = |k: usize| f64::from(told.high[k]) - f64::from(told.low[k]);
    let (height, width) = match stands {
        true => (f64::from(told.high[2]), (extent(0) + extent(1)) / 2.0),
        false => (f64::NAN, f64::NAN),
    };
    assert_eq!(number("height_m").to_bits(), height.to_bits(), "height_m: {height}");
    assert_eq!(number("crown_width_m").to_bits(), width.to_bits(), "crown_width_m: {width}");
    let base = told.base.map_or(f64::NAN, |(_, diameter)| diameter);
    assert_eq!(number("basal_diameter_m").to_bits(), base.to_bits(), "basal_diameter_m: {base}");
    assert_eq!(number("lowest_leaf_m").to_bits(), told.lowest_leaf.to_bits(), "lowest_leaf_m: {}", told.lowest_leaf);
    let (stated, at) = (number("diameter_at_1_3_m"), told.at_breast_height);
    let agree = (stated.is_nan() && at.is_nan()) || (stated - at).abs() <= ROUNDING * at;
    assert!(agree, "diameter_at_1_3_m: {stated}, and by records {at}");
    for (column, sum) in [("leaf_area_m2", told.leaf_area), ("wood_volume_m3", told.wood_volume)] {
        let stated = number(column);
        assert!((stated - sum).abs() <= ROUNDING * sum, "{column}: {stated}, and its parts are {sum}");
    }
}

/// The number of rows compared, and of rows of plants that live without a bud.
fn compare(resolved: Resolved) -> [u32; 2] {
    let name = resolved.scenario.name.clone();
    let folder = tempfile::tempdir().expect("a temporary folder");
    let settings = Settings { threads: 2, ..Settings::in_folder(folder.path().join("run")) };
    run::run(&resolved, &settings, &Progress::default()).unwrap_or_else(|error| panic!("{name}: {error:#}"));
    let [summary, records, components] =
        ["summary", "records", "components"].map(|table| Columns::of(&settings.folder, table));
    let (told, components) = (by_records(&records), Components::new(&components));
    let (plants, ages) = (summary.numbers("plant_id"), summary.numbers("age"));
    let recorded = resolved.scenario.ages.recorded();
    // A seed that does not germinate has no tick of sowing, and no row.
    let sowings = Columns::of(&settings.folder, "plants");
    let of = |sown: &f64| recorded.iter().filter(|tick| f64::from(**tick) >= *sown).count();
    // Nor has a guard of a stand.
    let guards = sowings.names().any(|name| name == "guard").then(|| sowings.numbers("guard"));
    let is_guard = |plant: usize| guards.is_some_and(|guards| guards[plant] == 1.0);
    let sown = sowings.numbers("sown_tick").iter().enumerate().filter(|(plant, _)| !is_guard(*plant));
    let expected = sown.map(|(_, sown)| of(sown)).sum::<usize>();
    assert_eq!(plants.len(), expected, "{name}: a row a plant and recorded tick from its sowing on");
    let nothing = Told::of_nothing();
    let mut budless = 0;
    for row in 0..plants.len() {
        let (plant, age) = (plants[row] as u32, ages[row] as u32);
        let told = told.get(&(plant, age)).unwrap_or(&nothing);
        let (standing, last_death) = components.standing(plant, age);
        let agree = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
            assert_eq!(told.standing, standing, "what stands by records, and by components");
            check(&summary, row, told, last_death);
            let picked = components.harvested(plant, age);
            assert_eq!(summary.numbers("harvested_fruits")[row], picked, "harvested_fruits");
        }));
        assert!(agree.is_ok(), "{name}: plant {plant} at age {age} disagrees");
        budless += u32::from(summary.numbers("alive")[row] == 1.0 && summary.numbers("buds")[row] == 0.0);
    }
    [plants.len() as u32, budless]
}

#[test]
fn summary_says_what_records_and_components_say() {
    let compared = each(all(), |resolved| {
        let name = resolved.scenario.name.clone();
        let [rows, budless] = compare(small(resolved));
        println!("{name}: {rows} rows, {budless} of plants alive without a bud");
        [rows, budless]
    });
    let seen = compared.into_iter().fold([0; 2], |sum, of| [sum[0] + of[0], sum[1] + of[1]]);
    println!("{} plants at ages, {} of them alive without a bud", seen[0], seen[1]);
    assert!(seen[0] > 2000 && seen[1] > 10, "{seen:?}: too little is compared");
}
