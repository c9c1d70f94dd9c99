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

/// The view of a run with `records` and `plants`: the rows of `records` with the places of components in the plot. The
/// sums are in double precision, as the places of plants are.
const WORLD: (&str, &str) = (
    "Records with their places in the plot, `world_x_m`, `world_y_m` and `world_z_m`, beside those from the plant's seed.",
    "records_world AS SELECT r.*, p.x_m + r.x_m AS world_x_m, p.y_m + r.y_m AS world_y_m, p.z_m + r.z_m AS world_z_m \
     FROM records r JOIN plants p USING (plot_id, plant_id)",
);

/// The macros of `views.sql`: the tables that each needs, its description, and its SQL.
const MACROS: [(&[Table], &str, &str); 10] = [
    (
        &[Table::Records],
        "Everything that stands on plants of an age: SELECT kind, count(*) FROM at_age(10) GROUP BY kind;",
        "at_age(a) AS TABLE SELECT * FROM {records} WHERE age = a",
    ),
    (
        &[Table::Records],
        "Everything that stands at a tick of the plot, which is the age of plants that were sown at tick 0.",
        "at_tick(t) AS TABLE SELECT * FROM {records} WHERE tick = t",
    ),
    (
        &[Table::Records],
        "The internodes of each order at an age, with their length and wood volume, by plant.",
        "orders_at(a) AS TABLE SELECT plant_id, \"order\", count(*) AS internodes, sum(length_m) AS length_m, \
         sum(pi() / 12 * length_m * (diameter_m ** 2 + diameter_m * diameter_tip_m + diameter_tip_m ** 2)) AS \
         wood_volume_m3 FROM records WHERE age = a AND ends_with(kind, 'internode') GROUP BY ALL ORDER BY ALL",
    ),
    (
        &[Table::Components],
        "What was alive at any age of its plant, recorded or not.",
        "alive_at(a) AS TABLE SELECT * FROM components WHERE birth_age <= a AND (death_age IS NULL OR death_age > a)",
    ),
    (
        &[Table::Components],
        "One row an axis.",
        "axes() AS TABLE SELECT b.plant_id, b.axis_id, b.bearing_axis_id, b.\"order\", b.origin, b.birth_age, b.death_age, \
         count(i.component_id) AS internodes, sum(i.length_m) AS length_m FROM components b LEFT JOIN components i ON \
         i.plant_id = b.plant_id AND i.axis_id = b.axis_id AND ends_with(i.kind, 'internode') WHERE b.kind = \
         'apical_bud' GROUP BY ALL ORDER BY ALL",
    ),
    (
        &[Table::Events],
        "How often each fate befell a bud, by age.",
        "fates() AS TABLE SELECT age, event, count(*) AS buds FROM events GROUP BY ALL ORDER BY ALL",
    ),
    (
        &[Table::Site],
        "What the date brought to each treatment and replicate, tick by tick, its parts together.",
        "sites() AS TABLE SELECT treatment, replicate, block, tick, max(date) AS date, max(degree_days) AS degree_days, \
         max(degree_day_sum) AS degree_day_sum, max(day_length_h) AS day_length_h, max(nitrogen_kg_ha) AS \
         nitrogen_kg_ha, sum(plots) AS plots, sum(living_plants) AS living_plants FROM site GROUP BY ALL ORDER BY ALL",
    ),
    (
        &[Table::Summary, Table::Plants],
        "Means over the plants of each treatment and species, by age.",
        "growth() AS TABLE SELECT s.treatment, p.species, s.age, count(*) AS plants, count(*) FILTER (alive) AS alive, \
         avg(internodes) AS internodes, avg(leaves) AS leaves, avg(height_m) AS height_m, avg(leaf_area_m2) AS \
         leaf_area_m2 FROM summary s JOIN plants p USING (plot_id, plant_id) GROUP BY ALL ORDER BY ALL",
    ),
    (
        &[Table::Summary, Table::Treatments],
        "The means of each treatment at an age, with its level of each factor.",
        "treatments_at(a) AS TABLE SELECT t.*, count(*) AS plants, count(*) FILTER (s.alive) AS alive, \
         avg(s.internodes) AS internodes, avg(s.leaves) AS leaves, avg(s.height_m) AS height_m, avg(s.leaf_area_m2) AS \
         leaf_area_m2 FROM treatments t JOIN summary s USING (treatment) WHERE s.age = a GROUP BY ALL ORDER BY treatment_index",
    ),
    (
        &[Table::Summary, Table::Plants],
        "The plants at an age with what pairs them across treatments: replicate, and number within it. Plants of the same \
         replicate and number have the same draws.",
        "pairs_at(a) AS TABLE SELECT p.replicate, p.block, p.number, s.* FROM summary s JOIN (SELECT plot_id, plant_id, \
         replicate, block, row_number() OVER (PARTITION BY treatment, replicate ORDER BY plant_id) - 1 AS number FROM \
         plants) p USING (plot_id, plant_id) WHERE s.age = a ORDER BY ALL",
    ),
];

/// The macro of a run with the columns of mechanics.
const MECHANICS: (&str, &str) = (
    "What each plant weighs at an age, in kg, and where it is bent most, in N m and 1/m.",
    "mechanics_at(a) AS TABLE SELECT plant_id, sum(wood_volume_m3) AS wood_volume_m3, sum(fresh_mass_kg) AS fresh_mass_kg, \
     max(bending_moment_N_m) AS bending_moment_N_m, max(curvature_per_m) AS curvature_per_m FROM records WHERE age = a \
     GROUP BY ALL ORDER BY ALL",
);

fn views(plan: &RunPlan) -> String {
    let mut sql =
        String::from("-- For DuckDB. Paths are relative: start DuckDB in this folder, then `.read views.sql`.\n");
    for table in &plan.tables {
        let name = table.name();
        sql += &format!("\n-- {}\n", table.description());
        sql += &format!("CREATE OR REPLACE VIEW {name} AS SELECT * FROM read_parquet('{name}/part-*.parquet');\n");
    }
    let has = |tables: &[Table]| tables.iter().all(|table| plan.tables.contains(table));
    let located = has(&[Table::Records, Table::Plants]);
    if located {
        let (comment, body) = WORLD;
        sql += &format!("\n-- {comment}\nCREATE OR REPLACE VIEW {body};\n");
    }
    let wanted = MACROS.iter().filter(|(tables, ..)| has(tables)).map(|(_, comment, body)| (*comment, *body));
    let mechanics = plan.mechanics && has(&[Table::Records]);
    for (comment, body) in wanted.chain(mechanics.then_some(MECHANICS)) {
        let body = body.replace("{records}", if located { "records_world" } else { "records" });
        sql += &format!("\n-- {comment}\nCREATE OR REPLACE MACRO {body};\n");
    }
    sql
}
