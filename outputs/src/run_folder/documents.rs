//! The documents of a run folder: `run.json`, `datapackage.json` (Frictionless Data Package 1) and `views.sql`
//! (DuckDB).
//!
//! `run.json` names the other documents with their hashes and ends with a check of itself, so that damage to any of
//! them is found. Absent: the tables, and the journal, which lists the shards until these documents are written.

use super::error::Error;
use super::identity::{fingerprint, identity};
use super::journal::{FileReport, JOURNAL, OvergrownPlot, ShardReport};
use super::seal::DOCUMENT;
use super::share::{SHARE, Share};
use crate::storage::durable;
use crate::tables::arrow::plant_ontology;
use crate::tables::schema::{Column, Type};
use crate::tables::{Factor, RunPlan, Table, treatments};
use crate::views::{Tables, for_duckdb};
use serde::Serialize;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::path::Path;

/// The identity of the run, and at its end its results.
pub const RUN: &str = "run.json";
/// The tables and their columns, for programs that read Data Packages.
pub const PACKAGE: &str = "datapackage.json";
/// SQL views and macros over the tables, for DuckDB.
pub const VIEWS: &str = "views.sql";

/// The results of a finished run.
#[derive(Debug, Clone, Serialize)]
pub struct RunReport {
    /// The number of plants that live at the last tick of their plot.
    pub living: u64,
    /// The number of plants that have died.
    pub dead: u64,
    /// The number of components that ever lived.
    pub components: u64,
    /// The number of rows of each table.
    pub rows: BTreeMap<Table, u64>,
    /// The size of all files, bytes.
    pub bytes: u64,
    /// All files of the shards.
    pub files: Vec<FileReport>,
    /// The plots that ended because a plant reached its limit.
    pub overgrown: Vec<OvergrownPlot>,
}

impl RunReport {
    /// Adds up the reports of shards: of all shards of a run, or of some of them for a part of it.
    pub fn of<'a>(shards: impl IntoIterator<Item = &'a ShardReport>) -> Self {
        let empty = BTreeMap::new();
        let mut run =
            Self { living: 0, dead: 0, components: 0, rows: empty, bytes: 0, files: Vec::new(), overgrown: Vec::new() };
        for shard in shards {
            run.living += shard.living;
            run.dead += shard.dead;
            run.components += shard.components;
            run.bytes += shard.bytes();
            for file in &shard.files {
                if let (Some(table), Some(rows)) = (file.table, file.rows) {
                    *run.rows.entry(table).or_default() += rows;
                }
            }
            run.files.extend(shard.files.iter().cloned());
            run.overgrown.extend(shard.overgrown.iter().cloned());
        }
        run
    }
}

/// Writes the documents of a new run.
///
/// `run.json` comes first, so that a folder with any other file of the run also holds it: a run that was killed at its
/// start can be resumed.
pub fn write_start(path: &Path, plan: &RunPlan, share: Option<Share>) -> Result<(), Error> {
    let mut run = run(plan, share, "running");
    run.insert("documents".to_owned(), json!([document(VIEWS, views(plan).as_bytes())]));
    write_run(path, run)?;
    write_views(path, plan)
}

/// Writes `views.sql`, which depends on the plan alone.
pub fn write_views(path: &Path, plan: &RunPlan) -> Result<(), Error> {
    Ok(durable::write(&path.join(VIEWS), views(plan).as_bytes())?)
}

/// Writes the documents of a finished run, whose journal must be in order.
pub fn write_end(
    path: &Path,
    (plan, share): (&RunPlan, Option<Share>),
    done: &BTreeMap<u32, ShardReport>,
    timings: &[(&str, f64)],
) -> Result<RunReport, Error> {
    let report = RunReport::of(done.values());
    let (run, package) = (run(plan, share, "complete"), data_package(plan, &report));
    write_results(path, run, (&package, views(plan).as_bytes()), &report, timings)?;
    Ok(report)
}

/// Writes `datapackage.json`, and `run.json` with the results of the run; `run` is what stands in it before them.
pub fn write_results(
    path: &Path,
    mut run: Map<String, Value>,
    (package, views): (&Value, &[u8]),
    report: &RunReport,
    timings: &[(&str, f64)],
) -> Result<(), Error> {
    let package = pretty(&path.join(PACKAGE), package)?;
    durable::write(&path.join(PACKAGE), &package)?;
    let (bytes, sha256) = durable::sync_and_hash(&path.join(JOURNAL))?;
    let journal = FileReport { path: JOURNAL.to_owned(), table: None, rows: None, bytes, sha256 };
    let documents = [journal, document(PACKAGE, &package), document(VIEWS, views)];
    let timings: Map<String, Value> =
        timings.iter().map(|(name, seconds)| ((*name).to_owned(), json!(seconds))).collect();
    run.insert("timings_s".to_owned(), Value::Object(timings));
    let result = serde_json::to_value(report).map_err(Error::json(&path.join(RUN)))?;
    if let Value::Object(result) = result {
        run.extend(result);
    }
    run.insert("documents".to_owned(), json!(documents));
    write_run(path, run)
}

fn run(plan: &RunPlan, share: Option<Share>, status: &str) -> Map<String, Value> {
    let mut run = Map::from_iter([("format".to_owned(), json!("phytomer run")), ("status".to_owned(), json!(status))]);
    run.extend(share.map(|share| (SHARE.to_owned(), json!(share))));
    run.extend(identity(plan));
    run.insert("fingerprint".to_owned(), json!(fingerprint(plan)));
    run.insert("resolved_scenario".to_owned(), plan.provenance.resolved.clone());
    run
}

/// A document as `run.json` names it.
pub fn document(name: &str, content: &[u8]) -> FileReport {
    let sha256 = durable::sha256_of(content);
    FileReport { path: name.to_owned(), table: None, rows: None, bytes: content.len() as u64, sha256 }
}

/// Writes `run.json`, with its check.
pub fn write_run(path: &Path, run: Map<String, Value>) -> Result<(), Error> {
    let file = path.join(RUN);
    let text = serde_json::to_vec_pretty(&Value::Object(run)).map_err(Error::json(&file))?;
    Ok(durable::write(&file, &DOCUMENT.put(text))?)
}

fn pretty(path: &Path, value: &Value) -> Result<Vec<u8>, Error> {
    let mut text = serde_json::to_vec_pretty(value).map_err(Error::json(path))?;
    text.push(b'\n');
    Ok(text)
}

fn data_package(plan: &RunPlan, report: &RunReport) -> Value {
    let resources: Vec<Value> = plan.tables.iter().map(|table| resource(plan, *table, report)).collect();
    json!({
        "profile": "data-package",
        "name": slug(&plan.provenance.scenario),
        "title": format!("phytomer run of {}", plan.provenance.scenario),
        "description": "Plants grown from seed; SI units, ticks of the plot, ages in ticks since the plant was sown, Z up. The places of components are told \
                        from the seed of their plant, whose place in the plot is in the table plants. Null: does not apply.",
        "version": plan.provenance.version,
        "resources": resources,
    })
}

/// A name as the Data Package specification requires it: lower case letters, digits and `-`.
fn slug(name: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
    name.chars().map(plain).collect()
}

fn resource(plan: &RunPlan, table: Table, report: &RunReport) -> Value {
    let paths: Vec<&str> =
        report.files.iter().filter(|file| file.table == Some(table)).map(|file| file.path.as_str()).collect();
    let declared = plan.columns(table).iter().map(field);
    let factors = plan.provenance.factors.iter().filter(|_| table == Table::Treatments).map(factor_field);
    let fields: Vec<Value> = declared.chain(factors).collect();
    let mut schema = json!({ "fields": fields, "missingValues": [] });
    if table != Table::Events {
        schema["primaryKey"] = json!(table.sorted_by());
    }
    json!({
        "profile": "data-resource",
        "name": table.name(),
        "description": table.description(),
        "path": paths,
        "format": "parquet",
        "mediatype": "application/vnd.apache.parquet",
        "rows": report.rows.get(&table).copied().unwrap_or(0),
        "schema": schema,
    })
}

fn field(column: &Column) -> Value {
    let mut field = json!({
        "name": column.name,
        "type": match column.holds {
            Type::Bool => "boolean",
            Type::Int | Type::Key => "integer",
            Type::Date => "date",
            Type::Float | Type::Double => "number",
            Type::Word(_) | Type::Name(_) => "string",
        },
        "description": column.description,
        "constraints": { "required": !column.nullable },
    });
    if !column.unit.is_empty() {
        field["unit"] = json!(column.unit);
    }
    if let Type::Word(words) = column.holds {
        field["constraints"]["enum"] = json!(words);
    }
    if column.name == "kind" {
        field["plantOntology"] = plant_ontology();
    }
    field
}

/// The column of a factor in `treatments`.
fn factor_field(factor: &Factor) -> Value {
    let mut levels: Vec<&String> = factor.levels.iter().collect();
    levels.sort();
    levels.dedup();
    json!({
        "name": factor.name,
        "type": "string",
        "description": treatments::description_of(factor),
        "constraints": { "required": true, "enum": levels },
    })
}

fn views(plan: &RunPlan) -> String {
    let about = "Paths are relative: start DuckDB in this folder, then `.read views.sql`. `phytomer query --views` prints \
                 the same with whole paths, also of several runs.";
    for_duckdb(about, &[Tables::of_plan(plan)])
}
