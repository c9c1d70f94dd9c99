//! TreeQSM text: a cylinder a row, with 15 or 17 numbers, whose meaning their place tells.
//!
//! First come radius, length, start, direction, parent and extension in any of them. Then 17 columns go on with
//! branch, order, position, deviation, coverage, added, unmodified radius; 15 as aRchi has them with added,
//! unmodified radius, branch, order, position; 15 as older TreeQSM wrote them with branch, order, position, added,
//! unmodified radius. Which of the two a file of 15 has is seen from its whole numbers. Absent: what the tree is
//! (`tree`).

use super::super::contract::MOST_ENTITIES;
use super::super::numbers::{number, words};
use super::super::report::Report;
use super::super::text::said;
use super::super::vectors::unit;
use super::tree::{Cylinder, Cylinders};

/// Columns before those whose place differs.
const SHARED: usize = 10;

/// The places of the columns that differ.
struct Layout {
    branch: usize,
    order: usize,
    position: usize,
    /// The features, by name.
    features: &'static [(&'static str, usize)],
}

const SEVENTEEN: Layout = Layout {
    branch: 10,
    order: 11,
    position: 12,
    features: &[("mad", 13), ("SurfCov", 14), ("added", 15), ("UnmodRadius", 16)],
};
const ARCHI: Layout = Layout { branch: 12, order: 13, position: 14, features: &[("added", 10), ("UnmodRadius", 11)] };
const OLDER: Layout = Layout { branch: 10, order: 11, position: 12, features: &[("added", 13), ("UnmodRadius", 14)] };

/// Whether a text begins as such a file does.
pub(super) fn is_like(bytes: &[u8]) -> bool {
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(4000)]).into_owned();
    let mut lines = start.lines().filter(|line| !line.trim().is_empty());
    let Some(first) = lines.next() else { return false };
    let is_row = |line: &str| {
        let row: Option<Vec<f64>> = line.split_ascii_whitespace().map(number).collect();
        row.is_some_and(|row| matches!(row.len(), 15 | 17))
    };
    is_row(first) || first.trim_start().starts_with("radius") && lines.next().is_some_and(is_row)
}

/// The cylinders of a text.
pub(super) fn read(text: &str, report: &mut Report) -> Option<Cylinders> {
    let mut rows: Vec<(usize, [f64; 17])> = Vec::new();
    let mut width = None;
    let mut is_first = true;
    for (place, line) in text.lines().enumerate() {
        let line_number = place + 1;
        if line.trim().is_empty() {
            continue;
        }
        let is_head = std::mem::take(&mut is_first) && line.split_ascii_whitespace().next().and_then(number).is_none();
        if is_head {
            continue;
        }
        if rows.len() == MOST_ENTITIES {
            report.fault((line_number, 0), "there are too many cylinders", format!("at most {MOST_ENTITIES}"));
            break;
        }
        if let Some(row) = row(line, line_number, &mut width, report) {
            rows.push((line_number, row));
        }
    }
    let Some(width) = width else {
        report.fault((0, 0), "the file has no cylinders", "rows of 15 or 17 numbers");
        return None;
    };
    let layout = if width == 17 { &SEVENTEEN } else { of_fifteen(&rows) };
    let all = rows.iter().map(|(line, row)| cylinder(*line, row, layout, rows.len(), report)).collect();
    Some(super::rows::without_stand_ins(Cylinders {
        all,
        features: layout.features.iter().map(|(name, _)| *name).collect(),
    }))
}

/// The numbers of a row; told and none where it is none.
fn row(line: &str, number_of_line: usize, width: &mut Option<usize>, report: &mut Report) -> Option<[f64; 17]> {
    let mut found = [0.0; 17];
    let mut count = 0;
    for (word, at) in words(line, 0) {
        let column = line[..at].chars().count() + 1;
        match number(word) {
            Some(number) if count < 17 => found[count] = number,
            Some(_) => {}
            None => {
                report.fault((number_of_line, column), format!("`{}` is no number", said(word)), "a number");
                return None;
            }
        }
        count += 1;
    }
    let known = *width.get_or_insert(count);
    if !matches!(count, 15 | 17) || count != known {
        let expected = if matches!(known, 15 | 17) { format!("{known}, as before") } else { "15 or 17".to_owned() };
        report.fault((number_of_line, 0), format!("the row has {count} columns"), expected);
        return None;
    }
    Some(found)
}

/// The layout of rows of 15 numbers.
fn of_fifteen(rows: &[(usize, [f64; 17])]) -> &'static Layout {
    let are_whole =
        |columns: &[usize]| rows.iter().all(|(_, row)| columns.iter().all(|column| row[*column].fract() == 0.0));
    if !are_whole(&[ARCHI.branch, ARCHI.order, ARCHI.position]) && are_whole(&[10, 11, 12]) { &OLDER } else { &ARCHI }
}

fn cylinder(line: usize, row: &[f64; 17], layout: &Layout, rows: usize, report: &mut Report) -> Cylinder {
    let [radius, length, x, y, z, dx, dy, dz, parent, _] = row[..SHARED].try_into().unwrap_or_default();
    for (value, what) in [(radius, "radius"), (length, "length")] {
        if value < 0.0 {
            report.fault((line, 0), format!("the {what} is {value}"), "a number that is not below 0");
        }
    }
    let mut whole = |value: f64, what: &str| {
        if value.fract() != 0.0 || value.abs() > 1e15 {
            report.fault((line, 0), format!("the {what} is {value}"), "a whole number");
            return 0;
        }
        value as i64
    };
    let axis = whole(row[layout.branch], "branch");
    let order = whole(row[layout.order], "order");
    whole(row[layout.position], "position");
    let parent = whole(parent, "parent");
    if parent < 0 || parent > rows as i64 {
        let expected = format!("the number of a row from 1 to {rows}, or 0 for none");
        report.fault((line, 0), format!("the parent is {parent}"), expected);
    }
    Cylinder {
        line,
        parent: u32::try_from(parent - 1).ok().filter(|parent| (*parent as usize) < rows),
        axis,
        order: Some(order),
        start: [x, y, z],
        direction: unit([dx, dy, dz]),
        length,
        radius,
        values: layout.features.iter().map(|(_, column)| row[*column]).collect(),
    }
}
