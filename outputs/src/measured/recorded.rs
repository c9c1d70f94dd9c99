//! What `records` and `plants` hold of measured plants, read once: the rows of each plant at each tick.
//!
//! A value that nobody measured is none. Absent: the plants themselves, which can be drawn (`drawn`).

use crate::cells::of_run;
use crate::read::Run;
use crate::tables::Table;
use crate::tables::columns::{RECORDS, RECORDS_OF_POSE};
use crate::tables::schema::Type;
use phytomer_sim::Tick;
use phytomer_sim::plant::Kind;
use std::collections::BTreeMap;

/// The most components of a plant: twice the entities that a file may have, each with a bud.
const MOST_COMPONENTS: f64 = 64e6;

/// A row of `records`.
#[derive(Debug, Clone)]
pub struct Row {
    /// Its component number.
    pub number: u32,
    /// What bears it.
    pub parent: Option<u32>,
    /// Its axis, by the number of the bud.
    pub axis: u32,
    /// The order of its axis.
    pub order: u32,
    /// What it is.
    pub kind: Kind,
    /// Its base, metres.
    pub place: Option<[f64; 3]>,
    /// The direction along it.
    pub heading: Option<[f64; 3]>,
    /// Its upper side.
    pub up: Option<[f64; 3]>,
    /// Its length, metres.
    pub length: Option<f64>,
    /// Its diameter at the base, or its width, metres.
    pub base: Option<f64>,
    /// Its diameter at the tip, metres.
    pub tip: Option<f64>,
    /// The area of one side, m².
    pub area: Option<f64>,
    /// All columns of `records` in their order: words by their places in their lists, truths as 1 and 0, NaN for none.
    pub values: Box<[f64]>,
}

/// A measured plant, but for what was seen of it.
#[derive(Debug, Clone, Default)]
struct Subject {
    place: Option<[f64; 3]>,
    species: Option<String>,
}

/// The plants of a run of measured plants.
#[derive(Debug)]
pub struct MeasuredPlants {
    rows: BTreeMap<Tick, BTreeMap<u32, Vec<Row>>>,
    subjects: Vec<Subject>,
}

impl MeasuredPlants {
    /// Reads them.
    ///
    /// # Errors
    /// In words: a table that cannot be read, lacks a column, or has numbers that no plant has.
    pub fn of(run: &Run) -> Result<Self, String> {
        let subjects = subjects(run)?;
        let columns: Vec<&str> = RECORDS[..RECORDS_OF_POSE].iter().map(|column| column.name).collect();
        let (names, cells) = of_run(run, Table::Records, &columns)?;
        let mut rows: BTreeMap<Tick, BTreeMap<u32, Vec<Row>>> = BTreeMap::new();
        if cells.is_empty() {
            return Ok(Self { rows, subjects });
        }
        let at = columns.iter().map(|name| {
            let found = names.iter().position(|known| known == name);
            found.ok_or_else(|| format!("records has no column {name}"))
        });
        let at: Vec<usize> = at.collect::<Result<_, _>>()?;
        let place = |name: &str| columns.iter().position(|known| *known == name).unwrap_or_default();
        let [plant, tick] = ["plant_id", "tick"].map(place);
        for cells in &cells {
            let row = row(at.iter().map(|place| cells[*place].as_str()), &place)?;
            let [plant, tick] = [plant, tick].map(|column| row.values[column]);
            if plant.is_nan() || plant >= subjects.len() as f64 || tick.is_nan() {
                return Err(format!("records has a row of the plant {plant} at the tick {tick}, which is none"));
            }
            rows.entry(tick as Tick).or_default().entry(plant as u32).or_default().push(row);
        }
        Ok(Self { rows, subjects })
    }

    /// How many plants there are, also those of which nothing is told.
    pub fn count(&self) -> u32 {
        self.subjects.len() as u32
    }

    /// The ticks at which something was measured, ascending.
    pub fn ticks(&self) -> Vec<Tick> {
        self.rows.keys().copied().collect()
    }

    /// The place of a plant in its plot, metres; the origin where the file tells none.
    pub fn place(&self, plant: u32) -> [f64; 3] {
        self.subjects.get(plant as usize).and_then(|subject| subject.place).unwrap_or_default()
    }

    /// The species of a plant, where the file tells it.
    pub fn species(&self, plant: u32) -> Option<&str> {
        self.subjects.get(plant as usize)?.species.as_deref()
    }

    /// What was seen of each plant by a tick; nothing at a tick at which nothing was measured.
    pub fn rows(&self, tick: Tick) -> impl Iterator<Item = (u32, &[Row])> {
        self.rows.get(&tick).into_iter().flatten().map(|(plant, rows)| (*plant, rows.as_slice()))
    }
}

fn subjects(run: &Run) -> Result<Vec<Subject>, String> {
    let columns = ["plant_id", "species", "x_m", "y_m", "z_m"];
    let (names, rows) = of_run(run, Table::Plants, &columns)?;
    let at = |name: &str| names.iter().position(|known| known == name);
    let mut subjects = vec![Subject::default(); rows.len()];
    for row in &rows {
        let text = |name: &str| at(name).map(|place| row[place].as_str()).unwrap_or_default();
        let number = |name: &str| text(name).parse::<f64>().ok();
        let Some(subject) = number("plant_id").and_then(|plant| subjects.get_mut(plant as usize)) else {
            return Err(format!("plants has the plant `{}` among {}", text("plant_id"), rows.len()));
        };
        let [x, y, z] = ["x_m", "y_m", "z_m"].map(number);
        subject.place = x.zip(y).zip(z).map(|((x, y), z)| [x, y, z]);
        subject.species = Some(text("species").to_owned()).filter(|species| !species.is_empty());
    }
    Ok(subjects)
}

fn row<'c>(cells: impl Iterator<Item = &'c str>, place: &dyn Fn(&str) -> usize) -> Result<Row, String> {
    let value = |(column, cell): (&crate::tables::schema::Column, &str)| match column.holds {
        Type::Word(words) => words.iter().position(|word| *word == cell).map(|place| place as f64),
        Type::Name(_) => None,
        _ => cell.parse::<f64>().ok().filter(|value| value.is_finite()),
    };
    let values: Box<[f64]> = RECORDS.iter().zip(cells).map(|of| value(of).unwrap_or(f64::NAN)).collect();
    let told = |name: &str| Some(values[place(name)]).filter(|value| !value.is_nan());
    let vector = |names: [&str; 3]| {
        let [x, y, z] = names.map(told);
        Some([x?, y?, z?])
    };
    let number = |name: &str| match told(name) {
        Some(number) if !(0.0..MOST_COMPONENTS).contains(&number) => {
            Err(format!("records has {number} as a {name}: at most {MOST_COMPONENTS} are expected"))
        }
        number => Ok(number.map(|number| number as u32)),
    };
    let kind = told("kind").and_then(|kind| Kind::ALL.get(kind as usize).copied());
    Ok(Row {
        number: number("component_id")?.unwrap_or_default(),
        parent: number("parent_id")?,
        axis: number("axis_id")?.unwrap_or_default(),
        order: told("order").unwrap_or(1.0) as u32,
        kind: kind.unwrap_or(Kind::Internode),
        place: vector(["x_m", "y_m", "z_m"]),
        heading: vector(["dir_x", "dir_y", "dir_z"]),
        up: vector(["up_x", "up_y", "up_z"]),
        length: told("length_m"),
        base: told("diameter_m"),
        tip: told("diameter_tip_m"),
        area: told("area_m2"),
        values,
    })
}
