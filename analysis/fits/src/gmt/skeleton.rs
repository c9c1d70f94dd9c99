//! Measured trees as branches: each with its mother, its growth level, its vector from base to tip, and its diameter.
//!
//! A table has a row for each branch, with its tip; a branch begins at the tip of its parent, and the first branch of a
//! plant, which has no parent, at an origin. A branch that bears one other alone is one with it, so that a branch leads
//! from branching to branching. Growth level 0 is the first branch. Absent: what a branching looks like (`fork`).

use crate::data::table::{Fault, MOST_FAULTS, Table, column_of};
use std::collections::HashMap;

/// The most rows that are read.
pub const MOST_BRANCHES: usize = 200_000;

/// The largest coordinate or diameter that is taken.
const FARTHEST: f64 = 1e9;

/// A table as `phytomer fit gmt --data` reads it: *Aucuba japonica* of three growth levels, drawn with scatter.
pub const SAMPLE: &str = include_str!("../../samples/branches.csv");

/// A branch as it was measured, before its mother is known.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// Its plant.
    pub plant: u32,
    /// The place of its mother among the pieces; `None` of a first branch.
    pub mother: Option<usize>,
    /// Where it begins.
    pub base: [f64; 3],
    /// From its base to its tip, of a length above 0.
    pub vector: [f64; 3],
    /// Its diameter, if it was measured.
    pub diameter: Option<f64>,
}

/// A branch from branching to branching.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch {
    /// Its plant.
    pub plant: u32,
    /// The place of its mother, which is before its own.
    pub mother: Option<usize>,
    /// Its growth level.
    pub level: u32,
    /// Where it begins.
    pub base: [f64; 3],
    /// From its base to its tip.
    pub vector: [f64; 3],
    /// Its diameter at its base, if it was measured.
    pub diameter: Option<f64>,
    /// The places of its children.
    pub children: Vec<usize>,
}

/// Trees as branches, those of lower growth levels first.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Skeleton {
    /// All branches.
    pub branches: Vec<Branch>,
}

impl Skeleton {
    /// The trees of pieces, of which each comes to a first branch by its mothers.
    pub fn of(pieces: &[Piece]) -> Self {
        let mut borne: Vec<Vec<usize>> = vec![Vec::new(); pieces.len()];
        for (place, piece) in pieces.iter().enumerate() {
            if let Some(of) = piece.mother.and_then(|mother| borne.get_mut(mother)) {
                of.push(place);
            }
        }
        let mut branches: Vec<Branch> = Vec::with_capacity(pieces.len());
        let firsts = pieces.iter().enumerate().filter(|(_, piece)| piece.mother.is_none());
        let mut waiting: Vec<(usize, Option<usize>)> = firsts.map(|(place, _)| (place, None)).collect();
        while !waiting.is_empty() {
            let mut next = Vec::new();
            for (piece, mother) in waiting {
                let (branch, last) = joined(pieces, &borne, piece, mother, &branches);
                let own = branches.len();
                if let Some(mother) = mother {
                    branches[mother].children.push(own);
                }
                branches.push(branch);
                next.extend(borne[last].iter().map(|child| (*child, Some(own))));
            }
            waiting = next;
        }
        Self { branches }
    }

    /// The last growth level.
    pub fn levels(&self) -> u32 {
        self.branches.last().map_or(0, |branch| branch.level)
    }
}

/// A piece with those that continue it alone, and the last of them.
fn joined(
    pieces: &[Piece],
    borne: &[Vec<usize>],
    first: usize,
    mother: Option<usize>,
    known: &[Branch],
) -> (Branch, usize) {
    let (mut last, Piece { plant, base, diameter, mut vector, .. }) = (first, pieces[first].clone());
    while let [only] = borne[last].as_slice() {
        last = *only;
        (0..3).for_each(|k| vector[k] += pieces[last].vector[k]);
    }
    let level = mother.map_or(0, |mother| known[mother].level + 1);
    (Branch { plant, mother, level, base, vector, diameter, children: Vec::new() }, last)
}

/// The columns of a table.
struct Places {
    id: usize,
    parent: usize,
    tip: [usize; 3],
    diameter: usize,
    plant: Option<usize>,
}

/// A table with its text, for the places of faults.
struct Told<'a> {
    table: &'a Table,
    text: Option<&'a [u8]>,
}

impl Told<'_> {
    /// A fault of a cell.
    fn at(&self, row: usize, cell: usize, problem: String, expected: &str) -> Fault {
        let line = self.table.rows[row].0;
        let column = self.text.and_then(|text| column_of(text, line, cell));
        Fault { column, ..self.table.fault(Some(line), problem, expected) }
    }
}

/// The pieces of a table with the columns id, parent, x, y, z and diameter, and perhaps plant; first branches begin at
/// `origin`. `text` is that of the file, if it is one of text.
///
/// # Errors Every fault with line and column: a missing column, an id that stands twice, an unknown parent, two first
/// branches in a plant, a cycle, what is no number, a branch without length.
pub fn read(table: &Table, text: Option<&[u8]>, origin: [f64; 3]) -> Result<Vec<Piece>, Vec<Fault>> {
    let (places, told) = (places(table)?, Told { table, text });
    if table.rows.len() > MOST_BRANCHES {
        let problem = format!("there are {} branches", table.rows.len());
        return Err(vec![table.fault(None, problem, &format!("at most {MOST_BRANCHES}: leave out the youngest"))]);
    }
    let mut faults = Vec::new();
    let mut known: HashMap<(&str, &str), usize> = HashMap::with_capacity(table.rows.len());
    for (row, (_, cells)) in table.rows.iter().enumerate() {
        if faults.len() >= MOST_FAULTS {
            return Err(faults);
        }
        let id = cells[places.id].as_str();
        if id.is_empty() {
            faults.push(told.at(row, places.id, "a branch has no id".to_owned(), "an id of its own for each branch"));
        } else if let Some(first) = known.insert((plant_of(cells, &places), id), row) {
            let problem = format!("the id `{id}` stands twice, first on line {}", table.rows[first].0);
            faults.push(told.at(row, places.id, problem, "an id of its own for each branch of a plant"));
        }
    }
    let mut plants: Vec<&str> = table.rows.iter().map(|(_, cells)| plant_of(cells, &places)).collect();
    plants.sort_unstable();
    plants.dedup();
    let mut tips = Vec::with_capacity(table.rows.len());
    let mut pieces = Vec::with_capacity(table.rows.len());
    for (row, (_, cells)) in table.rows.iter().enumerate() {
        if faults.len() >= MOST_FAULTS {
            return Err(faults);
        }
        let plant = plants.binary_search(&plant_of(cells, &places)).unwrap_or_default() as u32;
        let parent = cells[places.parent].as_str();
        let mother = known.get(&(plant_of(cells, &places), parent)).copied().filter(|_| !parent.is_empty());
        if mother.is_none() && !parent.is_empty() {
            let problem = format!("no branch has the id `{parent}`");
            faults.push(told.at(row, places.parent, problem, "the id of a branch of the plant, or nothing"));
        }
        tips.push(places.tip.map(|cell| number(&told, row, cell, &mut faults)));
        let diameter = diameter(&told, row, places.diameter, &mut faults);
        pieces.push(Piece { plant, mother, base: origin, vector: [0.0; 3], diameter });
    }
    if faults.is_empty() {
        check_trees(&told, &places, &pieces, plants.len(), &mut faults);
    }
    let are_trees = faults.is_empty();
    for row in 0..pieces.len() {
        let base = pieces[row].mother.map_or(origin, |mother| tips[mother]);
        let vector = [0, 1, 2].map(|k| tips[row][k] - base[k]);
        let told_all = faults.len() >= MOST_FAULTS;
        if are_trees && !told_all && vector.iter().map(|x| x * x).sum::<f64>().sqrt() <= f64::MIN_POSITIVE {
            let problem = "the branch ends where it begins: it has no length".to_owned();
            let from =
                if pieces[row].mother.is_some() { "a tip that is not its parent's" } else { "a tip above the origin" };
            faults.push(told.at(row, places.tip[0], problem, from));
        }
        (pieces[row].base, pieces[row].vector) = (base, vector);
    }
    faults.truncate(MOST_FAULTS);
    if faults.is_empty() { Ok(pieces) } else { Err(faults) }
}

fn places(table: &Table) -> Result<Places, Vec<Fault>> {
    let mut faults = Vec::new();
    let mut column = |name: &str| {
        table.column(name).unwrap_or_else(|fault| {
            faults.push(fault);
            0
        })
    };
    let [id, parent, x, y, z, diameter] = ["id", "parent", "x", "y", "z", "diameter"].map(&mut column);
    let plant = table.find("plant");
    if faults.is_empty() { Ok(Places { id, parent, tip: [x, y, z], diameter, plant }) } else { Err(faults) }
}

fn plant_of<'a>(cells: &'a [String], places: &Places) -> &'a str {
    places.plant.map_or("", |place| cells[place].as_str())
}

/// A coordinate; 0 where it is told to be wrong.
fn number(told: &Told<'_>, row: usize, cell: usize, faults: &mut Vec<Fault>) -> f64 {
    let text = &told.table.rows[row].1[cell];
    let read = text.parse::<f64>().ok().filter(|number| number.abs() <= FARTHEST);
    read.unwrap_or_else(|| {
        let problem = format!("the {} of a tip is `{text}`", told.table.names[cell]);
        faults.push(told.at(row, cell, problem, "a number, in the unit of all lengths of the table"));
        0.0
    })
}

fn diameter(told: &Told<'_>, row: usize, cell: usize, faults: &mut Vec<Fault>) -> Option<f64> {
    let text = told.table.rows[row].1[cell].as_str();
    if text.is_empty() {
        return None;
    }
    let read = text.parse::<f64>().ok().filter(|number| *number > 0.0 && *number <= FARTHEST);
    if read.is_none() {
        let problem = format!("the diameter is `{text}`");
        faults.push(told.at(row, cell, problem, "a number above 0, or nothing where it was not measured"));
    }
    read
}

/// One first branch in each plant, and no cycle.
fn check_trees(told: &Told<'_>, places: &Places, pieces: &[Piece], plants: usize, faults: &mut Vec<Fault>) {
    let mut firsts: Vec<Option<usize>> = vec![None; plants];
    for (row, piece) in pieces.iter().enumerate().filter(|(_, piece)| piece.mother.is_none()) {
        let first = &mut firsts[piece.plant as usize];
        if faults.len() >= MOST_FAULTS {
            return;
        }
        if let Some(first) = first {
            let problem = format!("a second branch has no parent; the first is on line {}", told.table.rows[*first].0);
            let expected = "one first branch in a plant; a column `plant` tells several plants apart";
            faults.push(told.at(row, places.parent, problem, expected));
        }
        first.get_or_insert(row);
    }
    // 0: not seen, 1: on the way that is being followed, 2: comes to a first branch, or was told.
    let mut seen = vec![0_u8; pieces.len()];
    for start in 0..pieces.len() {
        if faults.len() >= MOST_FAULTS {
            return;
        }
        let (mut way, mut at) = (Vec::new(), Some(start));
        while let Some(place) = at.filter(|place| seen[*place] == 0) {
            seen[place] = 1;
            way.push(place);
            at = pieces[place].mother;
        }
        if let Some(place) = at.filter(|place| seen[*place] == 1) {
            let id = &told.table.rows[place].1[places.id];
            let problem = format!("the parents of the branch `{id}` lead back to it");
            faults.push(told.at(place, places.parent, problem, "parents that lead to a first branch, which has none"));
        }
        way.into_iter().for_each(|place| seen[place] = 2);
    }
}
