//! The files of `--data`: whole plants by age, or distributions of one order, told from one another by their columns.
//!
//! Absent: what is compared (`phytomer::report`).

use super::ReportVerb;
use crate::cli::{Misuse, amounts};
use anyhow::{Context, Result};
use phytomer::report::field::Field;
use phytomer::report::laws::Asked;
use phytomer::report::laws::measured::{Measured, law_of, measured};
use phytomer_fits::data::{Fault, Table};
use std::fs;
use std::path::Path;

/// The most bytes of a file.
const MOST_BYTES: u64 = 256 << 20;

/// What was measured, or what is wrong with the files, a line each.
pub type Read = std::result::Result<(Option<Field>, Asked), Vec<String>>;

enum OfFile {
    Plants(Field),
    Axes(Vec<Measured>),
}

/// Reads all files.
pub fn read(verb: &ReportVerb) -> Result<Read> {
    let (mut plants, mut asked) = (None, Asked { from_base: verb.from == "base", ..Asked::default() });
    for path in &verb.data {
        match of_file(verb, path)? {
            Err(faults) => return Ok(Err(faults)),
            Ok(OfFile::Axes(found)) => asked.measured.extend(found),
            Ok(OfFile::Plants(field)) => {
                if let Some(before) = plants.replace(field) {
                    let (first, second) = (before.name, path.display());
                    return Err(
                        Misuse(format!("--data: {first} and {second} both have plants by age; give one")).into()
                    );
                }
            }
        }
    }
    Ok(Ok((plants, asked)))
}

fn of_file(verb: &ReportVerb, path: &Path) -> Result<std::result::Result<OfFile, Vec<String>>> {
    let bytes = bytes(path)?;
    let shown = path.display().to_string();
    let told = |faults: Vec<Fault>| faults.iter().map(ToString::to_string).collect();
    let table = Table::from_csv(&shown, &bytes);
    let (law, mut chosen) = match table.map(|table| (law_of(&table), table)) {
        Err(faults) if is_of_axes(&bytes) => return Ok(Err(told(faults))),
        Ok((Some(law), table)) => (law, table),
        _ => return Ok(Field::read(&shown, &bytes).map(OfFile::Plants).map_err(|fault| vec![fault.to_string()])),
    };
    for only in &verb.only {
        let Some((column, text)) = only.split_once('=') else {
            return Err(Misuse(format!("--where {only}: COLUMN=TEXT is expected, such as cultivar=fuji")).into());
        };
        chosen = match chosen.only(column, text) {
            Ok(chosen) => chosen,
            Err(fault) => return Ok(Err(vec![fault.to_string()])),
        };
    }
    Ok(measured(law, &chosen, verb.order).map(OfFile::Axes).map_err(told))
}

/// Whether the first line names a column that only tables of axes have.
fn is_of_axes(bytes: &[u8]) -> bool {
    let line = bytes.split(|byte| *byte == b'\n').next().unwrap_or_default();
    line.split(|byte| *byte == b',').any(|name| matches!(name.trim_ascii(), b"nodes" | b"fate" | b"dead" | b"died"))
}

fn bytes(path: &Path) -> Result<Vec<u8>> {
    let doing = || format!("cannot read {}", path.display());
    let about = fs::metadata(path).with_context(doing)?;
    if !about.is_file() || about.len() > MOST_BYTES {
        let (shown, most) = (path.display(), amounts::bytes(MOST_BYTES as f64));
        return Err(Misuse(format!("--data {shown}: a file of at most {most} is expected")).into());
    }
    fs::read(path).with_context(doing)
}
