//! Tables of cylinders with names of columns: those of aRchi and rTwig, and of SimpleForest.
//!
//! Names tell the columns, whatever their order, and blanks around them do not count. A parent that is 0 or below, and
//! that no cylinder has as its number, is none. Columns of other names are left out, since they follow from these.
//! Absent: what the tree is (`tree`).

use super::super::contract::MOST_ENTITIES;
use super::super::numbers::number;
use super::super::report::Report;
use super::super::text::said;
use super::super::vectors::{norm, unit};
use super::tree::{Cylinder, Cylinders};
use std::collections::HashMap;

/// What a column holds, and the names that programs give it.
const COLUMNS: [(&str, &[&str]); 12] = [
    ("the number of the cylinder", &["cyl_ID", "ID", "id"]),
    ("that of its parent", &["parent_ID", "parentID", "parent"]),
    ("its axis", &["axis_ID", "branchID", "BranchID", "branch_ID", "branch"]),
    ("start x", &["startX", "start_x", "start.x"]),
    ("start y", &["startY", "start_y", "start.y"]),
    ("start z", &["startZ", "start_z", "start.z"]),
    ("end x", &["endX", "end_x", "end.x"]),
    ("end y", &["endY", "end_y", "end.y"]),
    ("end z", &["endZ", "end_z", "end.z"]),
    ("the radius", &["radius_cyl", "radius"]),
    ("the length", &["length"]),
    ("the order of the axis", &["branching_order", "branchOrder", "BranchOrder", "branch_order"]),
];
/// The first column that a table may do without.
const NEEDED: usize = 10;

/// Whether a text begins as such a table does.
pub(super) fn is_like(bytes: &[u8]) -> bool {
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(4000)]).into_owned();
    start.lines().next().is_some_and(|line| {
        let names: Vec<String> = cells(line, separator(line)).into_iter().map(|(cell, _)| cell).collect();
        [3, 9].into_iter().all(|column| COLUMNS[column].1.iter().any(|name| names.iter().any(|known| known == name)))
    })
}

/// The cylinders of a table.
pub(super) fn read(text: &str, report: &mut Report) -> Option<Cylinders> {
    let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let Some((_, head)) = lines.next() else {
        report.fault((0, 0), "the file has no lines", "a line of names, and a row a cylinder");
        return None;
    };
    let separator = separator(head);
    let names = cells(head, separator);
    let columns = columns(&names, report)?;
    let (mut numbers, mut parents, mut all) = (Vec::new(), Vec::new(), Vec::new());
    for (place, line) in lines {
        let line_number = place + 1;
        if all.len() == MOST_ENTITIES {
            report.fault((line_number, 0), "there are too many cylinders", format!("at most {MOST_ENTITIES}"));
            break;
        }
        let row = cells(line, separator);
        if row.len() != names.len() {
            let expected = format!("{}, as there are names", names.len());
            report.fault((line_number, 0), format!("the row has {} cells", row.len()), expected);
            continue;
        }
        let read = Row { line: line_number, cells: &row, columns: &columns };
        if let Some((number, parent, cylinder)) = read.cylinder(report) {
            numbers.push(number);
            parents.push(parent);
            all.push(cylinder);
        }
    }
    if all.is_empty() && !report.is_refused() {
        report.fault((0, 0), "the table has no cylinders", "a row a cylinder below the names");
    }
    find_parents(&numbers, &parents, &mut all, report);
    Some(Cylinders { all, features: Vec::new() })
}

/// Where each of [`COLUMNS`] stands; told where one is missing or stands twice.
fn columns(names: &[(String, usize)], report: &mut Report) -> Option<[Option<usize>; COLUMNS.len()]> {
    let mut found = [None; COLUMNS.len()];
    for (place, (what, known)) in COLUMNS.iter().enumerate() {
        let named = known.iter().find_map(|known| names.iter().position(|(name, _)| name == known));
        found[place] = named;
        if named.is_none() && place < NEEDED {
            let expected = format!("a column `{}`", known.join("` or `"));
            report.fault((1, 0), format!("the table has no column for {what}"), expected);
        }
    }
    (!report.is_refused()).then_some(found)
}

/// A row whose cells are read.
struct Row<'a> {
    line: usize,
    cells: &'a [(String, usize)],
    columns: &'a [Option<usize>; COLUMNS.len()],
}

impl Row<'_> {
    fn cylinder(&self, report: &mut Report) -> Option<(i64, i64, Cylinder)> {
        let number = self.whole(0, report)?;
        let parent = self.whole(1, report)?;
        let axis = self.whole(2, report)?;
        let mut places = [0.0; 6];
        for (k, place) in places.iter_mut().enumerate() {
            *place = self.real(3 + k, report)?;
        }
        let radius = self.size(9, report)?;
        let [x, y, z, ex, ey, ez] = places;
        let along = [ex - x, ey - y, ez - z];
        let length = match self.columns[10] {
            Some(_) => self.size(10, report)?,
            None => norm(along),
        };
        let order = match self.columns[11] {
            Some(_) => Some(self.whole(11, report)?),
            None => None,
        };
        // By the stated length, so that what is written ends where it ends here.
        let direction = if length > 0.0 { unit(along.map(|of| of / length)) } else { unit(along) };
        let cylinder = Cylinder {
            line: self.line,
            parent: None,
            axis,
            order,
            start: [x, y, z],
            direction,
            length,
            radius,
            values: Vec::new(),
        };
        Some((number, parent, cylinder))
    }

    fn real(&self, column: usize, report: &mut Report) -> Option<f64> {
        let (cell, at) = &self.cells[self.columns[column]?];
        let found = number(cell);
        if found.is_none() {
            let problem = format!("{} is `{}`", COLUMNS[column].0, said(cell));
            report.fault((self.line, *at), problem, "a number");
        }
        found
    }

    fn size(&self, column: usize, report: &mut Report) -> Option<f64> {
        let found = self.real(column, report)?;
        if found < 0.0 {
            let at = self.cells[self.columns[column]?].1;
            report.fault((self.line, at), format!("{} is {found}", COLUMNS[column].0), "a number that is not below 0");
            return None;
        }
        Some(found)
    }

    fn whole(&self, column: usize, report: &mut Report) -> Option<i64> {
        let found = self.real(column, report)?;
        if found.fract() != 0.0 || found.abs() > 1e15 {
            let at = self.cells[self.columns[column]?].1;
            report.fault((self.line, at), format!("{} is {found}", COLUMNS[column].0), "a whole number");
            return None;
        }
        Some(found as i64)
    }
}

/// Finds parents by their numbers.
fn find_parents(numbers: &[i64], parents: &[i64], all: &mut [Cylinder], report: &mut Report) {
    let mut place_of = HashMap::with_capacity(numbers.len());
    for (place, number) in numbers.iter().enumerate() {
        if place_of.insert(*number, place as u32).is_some() {
            report.fault(
                (all[place].line, 0),
                format!("a second cylinder has the number {number}"),
                "a number of its own",
            );
        }
    }
    for (cylinder, parent) in all.iter_mut().zip(parents) {
        cylinder.parent = place_of.get(parent).copied();
        if cylinder.parent.is_none() && *parent > 0 {
            let problem = format!("the parent is {parent}, which is the number of no cylinder");
            report.fault((cylinder.line, 0), problem, "the number of a cylinder, or 0 or -1 for none");
        }
    }
}

/// What stands between the cells of a line.
fn separator(line: &str) -> char {
    let count = |separator: char| line.matches(separator).count();
    [',', ';', '\t'].into_iter().max_by_key(|separator| (count(*separator), *separator == ',')).unwrap_or(',')
}

/// The cells of a line without the blanks and quotes around them, each with its column from 1. A separator in quotes
/// is a part of its cell.
fn cells(line: &str, separator: char) -> Vec<(String, usize)> {
    let mut found = vec![(String::new(), 1)];
    let mut is_quoted = false;
    for (place, character) in line.chars().enumerate() {
        if character == '"' {
            is_quoted = !is_quoted;
        } else if character == separator && !is_quoted {
            found.push((String::new(), place + 2));
        } else if let Some((cell, _)) = found.last_mut() {
            cell.push(character);
        }
    }
    found.into_iter().map(|(cell, at)| (cell.trim().to_owned(), at)).collect()
}
