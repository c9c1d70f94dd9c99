//! The effective leaf area of plants at an age: what their leaves cover together as seen from above or along the sun.
//!
//! Each leaf is a disc of its own area about the middle of its length, facing the direction (`phytomer_measures::cover`
//! has formula and source); the area of their union is exact. Means of plants, a plant without leaves counts 0;
//! intervals are Student's of plants. Beside the mean stand that of the whole leaf area and the share of it that is
//! effective. Leaves of other plants of a plot shade nothing here. Unit: m².

use super::columns::Columns;
use super::fault::Fault;
use super::groups::Groups;
use super::result::{Cells, Column, Measured, Sheet};
use super::source::Source;
use super::stream::{RowOf, Unit, each_plant, of_group};
use phytomer_measures::cover::{Direction, Disc, area};
use phytomer_measures::moments::Moments;
use phytomer_outputs::Table;
use phytomer_outputs::read::Run;
use std::collections::{BTreeMap, BTreeSet};

/// The leaves of plants at an age, as seen from a direction.
pub(super) struct Foliage {
    pub age: u32,
    pub direction: Direction,
}

impl Unit for Foliage {
    type Row = Option<Disc>;
    type OfPlant = Vec<Disc>;

    fn table(&self) -> Table {
        Table::Records
    }

    fn columns(&self) -> Vec<&'static str> {
        [&["age"][..], &COLUMNS].concat()
    }

    fn rows<'a>(&'a self, _: &'a Source, columns: &'a Columns<'a>) -> Result<RowOf<'a, Self::Row>, Fault> {
        let ages = columns.ints("age")?;
        let leaf = leaf(columns)?;
        Ok(Box::new(move |row| {
            // Other components keep a plant without leaves among the plants.
            let is_of_age = ages[row].unsigned_abs() == self.age;
            is_of_age.then(|| leaf(row).map(|(place, area)| self.direction.leaf(place, area)))
        }))
    }

    fn add(&self, own: &mut Vec<Disc>, row: Self::Row) {
        own.extend(row);
    }
}

/// The columns that tell a leaf.
const COLUMNS: [&str; 9] = ["kind", "x_m", "y_m", "z_m", "dir_x", "dir_y", "dir_z", "length_m", "area_m2"];

/// The middle of a leaf and its area.
type Leaf = ([f64; 3], f64);

/// From the number of a row to its leaf; `None` for what is no leaf.
fn leaf<'a>(columns: &Columns<'a>) -> Result<RowOf<'a, Leaf>, Fault> {
    let kinds = columns.words("kind")?;
    let is_leaf: Vec<bool> = kinds.words.iter().map(|kind| kind == "leaf" || kind == "leaflet").collect();
    let number = |name: &str| columns.numbers(name);
    let base = [number("x_m")?, number("y_m")?, number("z_m")?];
    let along = [number("dir_x")?, number("dir_y")?, number("dir_z")?];
    let (length, area) = (number("length_m")?, number("area_m2")?);
    Ok(Box::new(move |row| {
        kinds.at(row).filter(|kind| is_leaf[*kind])?;
        let half = 0.5 * length[row].unwrap_or_default();
        let place = |i: usize| Some(base[i][row]? + half * along[i][row].unwrap_or_default());
        Some(([place(0)?, place(1)?, place(2)?], area[row]?))
    }))
}

/// The sums over the plants of a run of their effective leaf areas from above, m², by recorded age. Reads the leaves of
/// `records` once; empty where the run has no such table. Memory is that of the leaves of one plant.
///
/// # Errors
/// A part that cannot be read.
pub fn effective_leaf_areas(run: &Run) -> Result<BTreeMap<u32, f64>, Fault> {
    let mut sums = BTreeMap::new();
    if run.parts(Table::Records)?.is_empty() {
        return Ok(sums);
    }
    let (mut now, mut discs): ([i32; 3], Vec<Disc>) = ([-1; 3], Vec::new());
    let mut end = |[_, age, _]: [i32; 3], discs: &mut Vec<Disc>| {
        *sums.entry(age.unsigned_abs()).or_insert(0.0) += area(discs);
        discs.clear();
    };
    let names = [&["plot_id", "age", "plant_id"][..], &COLUMNS].concat();
    for batch in run.batches_with(Table::Records, &names)? {
        let batch = batch?;
        let columns = Columns { batch: &batch, run: run.path(), table: Table::Records.name() };
        let of = [columns.ints("plot_id")?, columns.ints("age")?, columns.ints("plant_id")?];
        let leaf = leaf(&columns)?;
        for (row, (place, area)) in (0..columns.rows()).filter_map(|row| Some((row, leaf(row)?))) {
            // Rows are sorted by plot, tick and plant.
            let plant = [0, 1, 2].map(|column| of[column][row]);
            if plant != now {
                end(now, &mut discs);
                now = plant;
            }
            discs.push(Direction::ABOVE.leaf(place, area));
        }
    }
    end(now, &mut discs);
    // Before the first plant there is none.
    sums.retain(|_, sum| *sum > 0.0);
    Ok(sums)
}

#[derive(Default)]
struct Found {
    effective: Moments,
    whole: Moments,
}

/// The mean of plants in each group.
pub(super) fn measure(unit: &Foliage, sources: &[Source], groups: &mut Groups, level: f64) -> Result<Measured, Fault> {
    let mut found: Vec<Found> = Vec::new();
    for source in sources {
        each_plant(unit, source, groups, |of, discs| {
            let group = of_group(&mut found, of.group);
            group.effective.add(area(&discs));
            group.whole.add(discs.iter().map(|disc| disc.area()).sum());
        })?;
    }
    let columns: [Column; 9] = [
        ("group", ""),
        ("plants", ""),
        ("mean", "m2"),
        ("sd", "m2"),
        ("monte_carlo_error", "m2"),
        ("low", "m2"),
        ("high", "m2"),
        ("leaf_area", "m2"),
        ("share", ""),
    ];
    let (mut sheet, mut notes) = (Sheet::new("effective_leaf_area", &columns), BTreeSet::new());
    for (number, name) in groups.sorted() {
        let Some(of) = found.get(number as usize).filter(|of| of.effective.n > 0) else { continue };
        let estimate = of.effective.mean_of_plants(level);
        let row = Cells::of(name, &mut notes).count(of.effective.n).real(of.effective.mean);
        let row = row.maybe(of.effective.standard_deviation());
        let row = row.estimate("interval", estimate.map(|of| of.standard_error));
        let row = row.maybe(estimate.ok().map(|of| of.interval.low)).maybe(estimate.ok().map(|of| of.interval.high));
        let share = (of.whole.mean > 0.0).then(|| of.effective.mean / of.whole.mean);
        sheet.rows.push(row.real(of.whole.mean).maybe(share).done());
    }
    if sheet.rows.is_empty() {
        notes.insert(format!("no mean: no plant stands at age {}", unit.age));
    }
    Ok(Measured { notes, ..Measured::of(vec![sheet]) })
}
