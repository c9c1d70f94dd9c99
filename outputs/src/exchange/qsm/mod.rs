//! Quantitative structure models: trees as cylinders, one a row, as laser scans are turned into.
//!
//! Three kinds of files. TreeQSM writes text of 15 or 17 columns, where the number of a row is that of its cylinder
//! and the parent 0 is none; aRchi reads the 15 without a header, Helios and TreeQSM itself the 17 with one. rTwig
//! and aRchi have tables with names (`startX` … `branching_order`), as has SimpleForest, where the parent −1 is none.
//! All of them hold wood alone. Order 0 is the trunk. Absent: what cylinders are in a description (`tree`, `rows`).

mod rows;
mod table;
mod text;
mod tree;
mod write;

use super::contract::{Format, Incoming, Outgoing};
use super::description::Description;
use super::losses::Losses;
use super::report::Report;
use super::text::decoded;
use rows::{Row, Rows};
use std::io::{self, Write};

/// TreeQSM text of 17 columns; also reads those of 15.
pub struct TreeQsm;

/// TreeQSM text of 15 columns.
pub struct TreeQsm15;

/// Tables of rTwig, aRchi and SimpleForest; written as those of aRchi.
pub struct QsmTable;

impl Format for TreeQsm {
    fn word(&self) -> &'static str {
        "treeqsm"
    }

    fn title(&self) -> &'static str {
        "TreeQSM text, 17 columns with a header, as TreeQSM 2.4 and Helios have it; also reads 15 columns"
    }

    fn endings(&self) -> &'static [&'static str] {
        &["txt"]
    }

    fn is_like(&self, bytes: &[u8]) -> bool {
        text::is_like(bytes)
    }

    fn read(&self, incoming: &Incoming<'_>, report: &mut Report) -> Description {
        let characters = decoded(incoming.bytes, report);
        text::read(&characters, report).map(|rows| tree::described(rows, report)).unwrap_or_default()
    }

    fn write(&self, description: &Description, out: &mut dyn Outgoing, losses: &mut Losses) -> io::Result<()> {
        each(description, out, losses, "txt", |rows, file| write::text(rows, true, file))
    }
}

impl Format for TreeQsm15 {
    fn word(&self) -> &'static str {
        "treeqsm15"
    }

    fn title(&self) -> &'static str {
        "TreeQSM text, 15 columns without a header, as aRchi reads it"
    }

    fn endings(&self) -> &'static [&'static str] {
        &[]
    }

    fn read(&self, incoming: &Incoming<'_>, report: &mut Report) -> Description {
        TreeQsm.read(incoming, report)
    }

    fn write(&self, description: &Description, out: &mut dyn Outgoing, losses: &mut Losses) -> io::Result<()> {
        each(description, out, losses, "txt", |rows, file| write::text(rows, false, file))
    }
}

impl Format for QsmTable {
    fn word(&self) -> &'static str {
        "rtwig"
    }

    fn title(&self) -> &'static str {
        "tables of cylinders of rTwig and aRchi; also reads those of SimpleForest"
    }

    fn endings(&self) -> &'static [&'static str] {
        &["csv"]
    }

    fn is_like(&self, bytes: &[u8]) -> bool {
        table::is_like(bytes)
    }

    fn read(&self, incoming: &Incoming<'_>, report: &mut Report) -> Description {
        let characters = decoded(incoming.bytes, report);
        table::read(&characters, report).map(|rows| tree::described(rows, report)).unwrap_or_default()
    }

    fn write(&self, description: &Description, out: &mut dyn Outgoing, losses: &mut Losses) -> io::Result<()> {
        each(description, out, losses, "csv", write::table)
    }
}

/// Writes the first plant into the file that is asked for, and each other one beside it.
fn each(
    description: &Description,
    out: &mut dyn Outgoing,
    losses: &mut Losses,
    ending: &str,
    write: impl Fn(&[Row], &mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let rows = Rows::of(description, losses);
    let stem = out.stem().to_owned();
    out.file(None, &mut |file| write(rows.plants.first().map_or(&[], Vec::as_slice), file))?;
    for (place, plant) in rows.plants.iter().enumerate().skip(1) {
        out.file(Some(&format!("{stem}_{}.{ending}", place + 1)), &mut |file| write(plant, file))?;
    }
    Ok(())
}
