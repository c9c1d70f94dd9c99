//! Rows of cylinders as text and as a table.
//!
//! Lengths and radii have all their digits, so that their sums stay as they are; places have nine places behind the
//! point, directions twelve.

use super::super::decimals::push;
use super::rows::Row;
use std::fmt::Write as _;
use std::io::{self, Write};

/// So many bytes are gathered before they are written.
const GATHERED: usize = 1 << 16;

/// TreeQSM text: 17 columns with a header, or 15 without one.
pub(super) fn text(rows: &[Row], is_wide: bool, file: &mut dyn Write) -> io::Result<()> {
    let mut out = String::new();
    if is_wide {
        out.push_str("radius (m)\tlength (m)\tstart_point\taxis_direction\tparent\textension\tbranch\tbranch_order\t");
        out.push_str("position_in_branch\tmad\tSurfCov\tadded\tUnmodRadius (m)\n");
    }
    for row in rows {
        let _ = write!(out, "{}\t{}", row.radius, row.length);
        row.start.iter().for_each(|place| tabbed(&mut out, *place, 9));
        row.direction.iter().for_each(|part| tabbed(&mut out, *part, 12));
        let [mad, coverage, added, unmodified] = row.told;
        let _ = write!(out, "\t{}\t{}", number(row.parent), number(row.extension));
        let of_axis = format!("{}\t{}\t{}", row.axis, row.order, row.position);
        let _ = if is_wide {
            writeln!(out, "\t{of_axis}\t{mad}\t{coverage}\t{added}\t{unmodified}")
        } else {
            writeln!(out, "\t{added}\t{unmodified}\t{of_axis}")
        };
        flush(&mut out, GATHERED, file)?;
    }
    flush(&mut out, 0, file)
}

/// A table as rTwig and aRchi have it.
pub(super) fn table(rows: &[Row], file: &mut dyn Write) -> io::Result<()> {
    let segments = segments(rows);
    let mut out = String::from(
        "startX,startY,startZ,endX,endY,endZ,cyl_ID,parent_ID,extension_ID,radius_cyl,length,volume,axis_ID,segment_ID,\
         node_ID,branching_order\n",
    );
    for (place, row) in rows.iter().enumerate() {
        let end = [0, 1, 2].map(|k| row.start[k] + row.direction[k] * row.length);
        for number in row.start.into_iter().chain(end) {
            push(&mut out, number, 9);
            out.push(',');
        }
        let [segment, node] = segments[place];
        let volume = std::f64::consts::PI * row.radius * row.radius * row.length;
        let _ = write!(out, "{},{},{},", place + 1, number(row.parent), number(row.extension));
        let _ = write!(out, "{},{},{volume},{},", row.radius, row.length, row.axis);
        let _ = writeln!(out, "{segment},{node},{}", row.order);
        flush(&mut out, GATHERED, file)?;
    }
    flush(&mut out, 0, file)
}

/// Of each row the last row of its segment, and that of the segment before it, from 1; 0 where none is before it. A
/// segment goes from one branching to the next.
fn segments(rows: &[Row]) -> Vec<[usize; 2]> {
    let mut children = vec![0_u32; rows.len()];
    rows.iter().filter_map(|row| row.parent).for_each(|parent| children[parent as usize] += 1);
    let mut found: Vec<[usize; 2]> = (1..=rows.len()).map(|number| [number, 0]).collect();
    for (place, row) in rows.iter().enumerate().rev() {
        if let Some(parent) = row.parent.filter(|parent| children[*parent as usize] == 1) {
            found[parent as usize][0] = found[place][0];
        }
    }
    for (place, row) in rows.iter().enumerate() {
        if let Some(parent) = row.parent {
            let [segment, node] = found[parent as usize];
            found[place][1] = if segment == found[place][0] { node } else { segment };
        }
    }
    found
}

/// The number of a row in the file; 0 for none.
fn number(row: Option<u32>) -> u32 {
    row.map_or(0, |row| row + 1)
}

fn tabbed(out: &mut String, number: f64, places: usize) {
    out.push('\t');
    push(out, number, places);
}

/// Hands on what was gathered, where it is more than so many bytes.
fn flush(out: &mut String, most: usize, file: &mut dyn Write) -> io::Result<()> {
    if out.len() > most {
        file.write_all(out.as_bytes())?;
        out.clear();
    }
    Ok(())
}
