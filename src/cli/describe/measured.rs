//! What a run folder of measured plants holds: their file, their tables, the dates of observation as ages, and the
//! architectural models of its first plants.

use super::super::amounts;
use anyhow::Result;
use phytomer_analysis::architecture::qualified;
use phytomer_analysis::population;
use phytomer_outputs::read::Run;
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::Path;

/// What `run.json` says of measured plants; `None` of plants that were grown.
pub fn stated(run: &Run) -> Option<&Value> {
    run.json()["resolved_scenario"].get("measured")
}

/// What it holds, for a person and as JSON.
///
/// # Errors
/// Where a table cannot be read.
pub fn told(run: &Run, folder: &Path) -> Result<(String, Value)> {
    let stated = stated(run).cloned().unwrap_or_default();
    let plants = stated["plants"].as_u64().unwrap_or_default();
    let word = |key: &str| stated[key].as_str().unwrap_or("unknown").to_owned();
    let mut text = format!(
        "{}: {} as measured, from {} ({}, SHA-256 {})\n",
        folder.display(),
        amounts::of(plants, "plant"),
        word("file"),
        word("format"),
        word("sha256")
    );
    let mut tables = serde_json::Map::new();
    for (table, rows) in run.rows()? {
        let _ = writeln!(text, "  {}: {}", table.name(), amounts::of(rows, "row"));
        tables.insert(table.name().to_owned(), json!(rows));
    }
    let ages = population(run)?;
    let dates = stated["dates"].as_array().cloned().unwrap_or_default();
    let mut told = Vec::new();
    for (age, at) in &ages {
        let height = at.height_m.mean;
        let high = if at.height_m.n == 0 { String::new() } else { format!(", {height:.2} m high") };
        let internodes = at.internodes.mean;
        let _ = writeln!(text, "  age {age}: {}, {internodes:.1} internodes{high}", amounts::of(at.living, "plant"));
        let height = (at.height_m.n > 0).then_some(height);
        told.push(json!({"age": age, "plants": at.living, "internodes": internodes, "height_m": height}));
    }
    if !dates.is_empty() {
        let dates: Vec<&str> = dates.iter().filter_map(Value::as_str).collect();
        let _ = writeln!(text, "  dates: {}; ages are days since the first", dates.join(", "));
    }
    let found = qualified(run, plants.try_into().unwrap_or(u32::MAX))?;
    let models: Vec<&str> = found.iter().flat_map(|found| found.models.keys().copied()).collect();
    if !models.is_empty() {
        let _ = writeln!(text, "  architectural models that its first plants may be of: {}", models.join(", "));
    }
    let without = stated["plants_without_places"].as_u64().unwrap_or_default();
    if without > 0 {
        let _ = writeln!(text, "  without places, so that they cannot be drawn: {}", amounts::of(without, "plant"));
    }
    let json = json!({"kind": "measured", "run": folder.display().to_string(), "measured": stated, "tables": tables,
        "ages": told, "architectural_models": models});
    Ok((text, json))
}
