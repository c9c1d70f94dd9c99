//! The branches of the plants of a run, as a person would have measured them at one age.
//!
//! They are the internodes of `records`, each from its base along its direction; one that continues another alone is
//! one branch with it (`phytomer_fits::gmt::Skeleton`). Absent: leaves, flowers and buds, which are no branches.

use phytomer_fits::gmt::Piece;
use phytomer_fits::gmt::skeleton::MOST_BRANCHES;
use phytomer_outputs::Table;
use phytomer_outputs::cells;
use phytomer_outputs::read::Run;
use std::collections::{BTreeMap, HashMap};
use std::path::Path;

/// The columns that are read.
const COLUMNS: [&str; 13] = [
    "plot_id",
    "plant_id",
    "age",
    "component_id",
    "parent_id",
    "kind",
    "x_m",
    "y_m",
    "z_m",
    "dir_x",
    "dir_y",
    "dir_z",
    "length_m",
];

/// The branches of a run at an age, or at the last one that it recorded.
///
/// # Errors
/// In words: no run, one that is not finished, without `records`, without branches at the age, or with too many.
pub fn of_run(folder: &Path, age: Option<u32>) -> Result<Vec<Piece>, String> {
    let shown = folder.display();
    let run = Run::open(folder).map_err(|error| error.to_string())?;
    if !run.is_complete() {
        return Err(format!("{shown}: the run is not finished; `phytomer grow --resume` ends it"));
    }
    let columns: Vec<&'static str> = COLUMNS.into_iter().chain(["diameter_m"]).collect();
    let (names, rows) =
        cells::of_run(&run, Table::Records, &columns).map_err(|problem| format!("{shown}: {problem}"))?;
    let place = |name: &&'static str| {
        let found = names.iter().position(|own| own == *name);
        found.ok_or_else(|| format!("{shown}: records has no column {name}: record them anew"))
    };
    let places = columns.iter().map(place).collect::<Result<Vec<usize>, String>>()?;
    let cell = |row: &'_ [String], k: usize| row[places[k]].clone();
    let is_branch = |row: &&Vec<String>| row[places[5]].ends_with("internode");
    let of_age = |row: &Vec<String>| row[places[2]].parse::<u32>().ok();
    let last = age.or_else(|| rows.iter().filter(is_branch).filter_map(of_age).max());
    let own: Vec<&Vec<String>> = rows.iter().filter(is_branch).filter(|row| of_age(row) == last).collect();
    if own.is_empty() {
        let at = age.map_or_else(String::new, |age| format!(" at age {age}"));
        return Err(format!("{shown}: no branch is recorded{at}; a scenario records them with `tables`"));
    }
    if own.len() > MOST_BRANCHES {
        return Err(format!("{shown}: there are {} branches, and at most {MOST_BRANCHES} are taken", own.len()));
    }
    let mut plants: BTreeMap<(String, String), u32> = BTreeMap::new();
    let mut known: HashMap<(u32, String), usize> = HashMap::with_capacity(own.len());
    for (at, row) in own.iter().enumerate() {
        let next = plants.len() as u32;
        let plant = *plants.entry((cell(row, 0), cell(row, 1))).or_insert(next);
        known.insert((plant, cell(row, 3)), at);
    }
    let piece = |row: &&Vec<String>| {
        let number = |k: usize| row[places[k]].parse::<f64>().unwrap_or_default();
        let plant = plants.get(&(cell(row, 0), cell(row, 1))).copied().unwrap_or_default();
        Piece {
            plant,
            mother: known.get(&(plant, cell(row, 4))).copied(),
            base: [6, 7, 8].map(number),
            vector: [9, 10, 11].map(|k| number(k) * number(12)),
            diameter: Some(number(13)).filter(|diameter| *diameter > 0.0),
        }
    };
    Ok(own.iter().map(piece).collect())
}
