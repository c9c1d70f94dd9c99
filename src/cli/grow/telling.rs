//! What `grow` tells: at the end what came of the run, before a run what is expected of it.
//!
//! The same figures as text for people and as one JSON object for programs. Absent: how they came about.

use super::super::{Verdict, amounts, terminal};
use super::shown;
use anyhow::Result;
use phytomer::run::forecast::{Figure, Forecast};
use phytomer::run::{Outcome, Settings};
use phytomer_config::scenario::Member;
use phytomer_config::{Resolved, Trial};
use phytomer_outputs::{Space, Table};
use serde_json::{Value, json};
use std::fmt::Write as _;

/// A run and what came of it.
pub struct Told<'a> {
    pub resolved: &'a Resolved,
    pub settings: &'a Settings,
    pub outcome: &'a Outcome,
    /// What a resumed run found in its folder.
    pub found: Option<Value>,
}

/// How a run ended.
fn verdict_of(outcome: &Outcome) -> Verdict {
    match outcome {
        outcome if outcome.is_interrupted() => Verdict::Interrupted,
        outcome if !outcome.report.overgrown.is_empty() => Verdict::Failed,
        _ => Verdict::Done,
    }
}

/// How a run ended, in a word for programs.
pub fn status(outcome: &Outcome) -> &'static str {
    match verdict_of(outcome) {
        Verdict::Interrupted => "interrupted",
        Verdict::Failed => "limited",
        _ => "complete",
    }
}

impl Told<'_> {
    /// How it ended.
    pub fn verdict(&self) -> Verdict {
        verdict_of(self.outcome)
    }

    /// One object with everything.
    pub fn as_json(&self) -> Value {
        let Self { resolved, settings, outcome, .. } = self;
        let report = &outcome.report;
        json!({
            "status": status(outcome),
            "shard": settings.share,
            "run": settings.folder.display().to_string(),
            "scenario": resolved.scenario.name,
            "species": species_in_words(resolved),
            "seed": resolved.scenario.seed,
            "until": resolved.scenario.ages.until,
            "version": settings.program.version,
            "git_hash": settings.program.git_hash,
            "plants": report.living + report.dead,
            "living": report.living,
            "dead": report.dead,
            "components": report.components,
            "rows": report.rows,
            "files": report.files.len(),
            "bytes": report.bytes,
            "parts": outcome.shards,
            "parts_committed": outcome.committed,
            "parts_grown_now": outcome.grown_now,
            "components_grown_now": outcome.components_now,
            "seconds": outcome.seconds,
            "components_per_second": self.rate().round(),
            "waited_for_writer": outcome.waited,
            "peak_memory_bytes": amounts::peak_memory(),
            "overgrown": report.overgrown,
            "found": self.found,
        })
    }

    fn rate(&self) -> f64 {
        self.outcome.components_now as f64 / self.outcome.seconds.max(1e-6)
    }

    /// What a person wants to know.
    pub fn as_text(&self) -> String {
        let Self { resolved, settings, outcome, .. } = self;
        let (scenario, report) = (&resolved.scenario, &outcome.report);
        let plants = amounts::of(report.living + report.dead, "plant");
        let species = species_in_words(resolved);
        let time = amounts::time(outcome.seconds);
        let shard = self.settings.share.map(|share| format!(", shard {share}")).unwrap_or_default();
        let mut text =
            format!("{plants} of `{species}`{shard} grown to {} {} in {time}\n", clock(resolved), scenario.ages.until);
        let mut line = |name: &str, value: String| {
            let _ = writeln!(text, "  {name:<11} {value}");
        };
        line("plants", format!("{} living, {} dead", amounts::count(report.living), amounts::count(report.dead)));
        line("components", format!("{}{}", amounts::count(report.components), self.rate_in_words()));
        line("rows", self.rows_in_words());
        line("seed", scenario.seed.to_string());
        line(
            "memory",
            amounts::peak_memory().map_or("unknown".into(), |b| format!("{} at most", amounts::bytes(b as f64))),
        );
        let files = amounts::of(report.files.len() as u64, "file");
        line("folder", format!("{} ({files}, {})", settings.folder.display(), amounts::bytes(report.bytes as f64)));
        text += "\nNext:";
        self.next_commands().iter().for_each(|command| text += &format!("\n  {command}"));
        text
    }

    fn rate_in_words(&self) -> String {
        match self.outcome.grown_now {
            0 => ", all of them there already".to_owned(),
            _ => format!(", {} a second", amounts::about(self.rate().round())),
        }
    }

    fn rows_in_words(&self) -> String {
        let rows = self.outcome.report.rows.iter();
        let words: Vec<_> = rows.map(|(table, rows)| format!("{} {}", amounts::count(*rows), table.name())).collect();
        if words.is_empty() { "no tables".to_owned() } else { words.join(", ") }
    }

    fn next_commands(&self) -> Vec<String> {
        let folder = self.settings.folder.display().to_string();
        let mut commands: Vec<String> = self.query(&folder).into_iter().collect();
        commands.push(format!("phytomer describe {}", shown(&folder)));
        // Midway: at the last age a plant may be dead and gone.
        let ages = self.resolved.scenario.ages.recorded();
        let age = ages.get(ages.len() / 2).copied().unwrap_or(self.resolved.scenario.ages.until);
        commands.push(format!("phytomer mesh {} --plant 0 --age {age} --out plant.ply", shown(&folder)));
        commands
    }

    /// A query whose result says something, for the first table that it can be asked of.
    fn query(&self, folder: &str) -> Option<String> {
        let rows = &self.outcome.report.rows;
        let from = |table: Table| format!("FROM '{folder}/{}/*.parquet'", table.name());
        let sql = if rows.contains_key(&Table::Summary) {
            let what = "age, count(*) AS plants, avg(height_m) AS height_m, avg(internodes) AS internodes";
            format!("SELECT {what} {} GROUP BY age ORDER BY age", from(Table::Summary))
        } else if rows.contains_key(&Table::Records) {
            format!("SELECT age, kind, count(*) {} GROUP BY ALL ORDER BY ALL", from(Table::Records))
        } else if rows.contains_key(&Table::Components) {
            format!("SELECT kind, cause_of_death, count(*) {} GROUP BY ALL ORDER BY ALL", from(Table::Components))
        } else if rows.contains_key(&Table::Events) {
            format!("SELECT age, event, count(*) {} GROUP BY ALL ORDER BY ALL", from(Table::Events))
        } else {
            format!("SELECT * {}", from(Table::Plants))
        };
        (!rows.is_empty()).then(|| format!("duckdb -c \"{sql}\""))
    }

    /// Which plots ended by a limit.
    pub fn overgrown(&self) -> String {
        const SHOWN: usize = 5;
        let overgrown = &self.outcome.report.overgrown;
        let plots = amounts::of(overgrown.len() as u64, "plant");
        let came_to = if overgrown.iter().any(|plot| plot.stopped.is_some()) { "a stop" } else { "the limit" };
        let mut text = format!("error: {plots} came to {came_to}; the ages before it are recorded, the others grew on");
        for plot in overgrown.iter().take(SHOWN) {
            let limit = || format!("more than {} components", amounts::count(plot.limit.into()));
            let why = plot.stopped.clone().unwrap_or_else(limit);
            let _ = write!(text, "\n  plant {} at tick {}: {why}", plot.plant, plot.tick);
        }
        if overgrown.len() > SHOWN {
            let _ = write!(text, "\n  … and {} more (run.json has them all)", overgrown.len() - SHOWN);
        }
        let by_limit = overgrown.iter().any(|plot| plot.stopped.is_none());
        let remedy = "\nraise limits.max_components or limits.max_memory_mb, or end the run earlier (ages.until)";
        if by_limit { text + remedy } else { text }
    }

    /// How to go on with what was stopped.
    pub fn interrupted(&self, again: &str) -> String {
        let Outcome { committed, shards, .. } = self.outcome;
        format!("stopped: {committed} of {shards} parts are complete; go on with\n  {again}")
    }
}

/// Tells what is expected of a run.
pub fn forecast(
    resolved: &Resolved,
    forecast: Option<&Forecast>,
    (parts, room): (u32, Option<Space>),
    as_json: bool,
) -> Result<()> {
    let scenario = &resolved.scenario;
    if as_json {
        let free = room.map(|space| space.free);
        let (name, seed) = (&scenario.name, scenario.seed);
        let what = json!({
            "status": "dry_run",
            "scenario": name,
            "seed": seed,
            "expected": forecast,
            "parts": parts,
            "free_bytes": free,
        });
        return terminal::put_json(&what);
    }
    let trial = resolved.trial();
    let plants = amounts::of(trial.plants().into(), "plant");
    let species = species_in_words(resolved);
    let (clock, until) = (clock(resolved), scenario.ages.until);
    let mut text = format!("{plants} of `{species}` to {clock} {until}, seed {}\n", scenario.seed);
    match forecast {
        Some(forecast) => text += &(in_words(forecast, trial.most_members()) + &treatments_in_words(forecast, &trial)),
        None => text += "  no forecast: the expectation of this species takes too long to sum up\n",
    }
    let dealt = "of each table, so at most so many shards";
    let _ = writeln!(text, "  {:<11} {:>7} {:>10} {dealt}", "parts", "", amounts::count(parts.into()));
    let free = room.map_or("unknown".to_owned(), |space| amounts::bytes(space.free as f64));
    let _ = writeln!(text, "  {:<11} {free:>10} on the disk of the run folder", "free");
    terminal::put(&(text + "nothing was written"))
}

/// What is expected of each treatment of an experiment, a line each.
fn treatments_in_words(forecast: &Forecast, trial: &Trial) -> String {
    let mut text = String::new();
    let replicates = amounts::of(trial.replicates().into(), "replicate");
    for of in &forecast.treatments {
        let (plants, components) = (amounts::of(of.plants.into(), "plant"), amounts::about(of.components));
        let (rows, bytes) = (amounts::about(of.records_rows), amounts::bytes(of.table_bytes));
        let name = &of.name;
        let _ = writeln!(
            text,
            "  {name}: {plants} in {replicates}, {components} components, {rows} rows of records, {bytes} of tables"
        );
    }
    text
}

/// The names of all species: "a, b".
pub fn species_in_words(resolved: &Resolved) -> String {
    resolved.distinct_species().iter().map(|species| species.about.name.as_str()).collect::<Vec<_>>().join(", ")
}

/// What the last tick of a run is to its plants: their age, unless some are sown later.
pub fn clock(resolved: &Resolved) -> &'static str {
    if is_sown_later(resolved) { "tick" } else { "age" }
}

/// Whether a plant of any treatment is sown after tick 0.
fn is_sown_later(resolved: &Resolved) -> bool {
    let trial = resolved.trial();
    let later = |member: &Member| member.sown > 0 || member.replaces.is_some();
    trial.treatments().iter().any(|treatment| treatment.scenario.stated_members().iter().any(later))
}

fn in_words(forecast: &Forecast, members: u32) -> String {
    let whole = if members > 1 { "a plot" } else { "a plant" };
    let mut text = String::new();
    let components = forecast.components_are;
    let mut line = |name: &str, figure: Figure, value: String, unit: &str| {
        let _ = writeln!(text, "  {name:<11} {:>7} {value:>10} {unit}", figure.word());
    };
    for (order, value) in (1..).zip(&forecast.components_by_order) {
        line(&format!("order {order}"), components, amounts::about(*value), &format!("components {whole}"));
    }
    line("in all", components, amounts::about(forecast.components), "components");
    if forecast.sampled < forecast.plants {
        line("sample", Figure::Exact, amounts::count(forecast.sampled.into()), "plants in components, records, events");
    }
    line("records", forecast.records_rows_are, amounts::about(forecast.records_rows), "rows");
    line("summary", Figure::Exact, amounts::about(forecast.summary_rows), "rows");
    let tables = "of tables, if nothing is shed";
    line("disk", Figure::About, amounts::bytes(forecast.table_bytes), tables);
    line("memory", Figure::About, amounts::bytes(forecast.bytes_a_plot), &format!("{whole} while it grows"));
    text
}
