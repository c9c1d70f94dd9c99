//! Where the numbers come from: the sentences for a section on methods, and what each run folder says of itself.

use super::plants::Grown;
use super::{LEVEL, Reported, percent};
use phytomer_reports::{Cell, Part, Table};
use serde_json::Value;

/// The line below the title.
pub fn about(runs: &[Reported], grown: &Grown) -> String {
    let plants: u64 = grown.groups.iter().map(|group| group.plants).sum();
    let names: Vec<&str> = runs.iter().map(|reported| reported.name.as_str()).collect();
    format!("{plants} plants of {} {}", if runs.len() == 1 { "the run" } else { "the runs" }, names.join(", "))
}

/// What a paper says in its section on methods: a sentence for each run, and one on intervals.
pub fn methods(runs: &[Reported], grown: &Grown) -> String {
    let of_runs: Vec<String> = runs.iter().map(of_run).collect();
    let lacking: Vec<String> =
        runs.iter().filter(|reported| !reported.run.is_complete()).map(|reported| reported.name.clone()).collect();
    let unfinished = match lacking.is_empty() {
        true => String::new(),
        false => format!(" Not finished, and reported as far as written: {}.", lacking.join(", ")),
    };
    format!(
        "{} Ages are {}. The plant is the unit: intervals are {} Student intervals of plant values.{unfinished}",
        of_runs.join(" "),
        grown.tick,
        percent(LEVEL)
    )
}

fn of_run(reported: &Reported) -> String {
    let json = reported.run.json();
    let Some(trial) = reported.trial else { return of_measured(reported) };
    let mut species: Vec<String> = Vec::new();
    for one in &reported.species {
        let latin = one.about.scientific_name.as_deref().map(|latin| format!(" ({latin})")).unwrap_or_default();
        let told = format!("{}{latin}, a model in which {}", one.about.name, one.model.name().card().about);
        species.extend((!species.contains(&told)).then_some(told));
    }
    let treatments = match trial.treatments() {
        [_] => String::new(),
        several => {
            let names: Vec<&str> = several.iter().map(|treatment| treatment.name.as_str()).collect();
            format!(" in {} treatments ({}) and {} replicates", names.len(), names.join(", "), trial.replicates())
        }
    };
    format!(
        "{} plants of {}{treatments} were simulated from sowing to tick {} with phytomer {} ({}), seed {}.",
        trial.plants(),
        species.join("; "),
        trial.scenario().ages.until,
        words(json, "version"),
        words(json, "git_hash"),
        json["seed"]
    )
}

/// The sentence for a run of measured plants.
fn of_measured(reported: &Reported) -> String {
    let json = reported.run.json();
    let told = &json["resolved_scenario"]["measured"];
    let count = |key: &str| told[key].as_u64().unwrap_or_default();
    let dates: Vec<&str> = told["dates"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
    let when = match dates.as_slice() {
        [] => String::new(),
        [only] => format!(" on {only}"),
        [first, .., last] => format!(" on {} dates from {first} to {last}", dates.len()),
    };
    let without = match count("plants_without_places") {
        0 => String::new(),
        without => format!(" Of {without} the file tells no places, so that they cannot be drawn."),
    };
    let plants = count("plants");
    let plants = if plants == 1 { "1 plant".to_owned() } else { format!("{plants} plants") };
    let was = if plants == "1 plant" { "was" } else { "were" };
    format!(
        "{plants} of {} {was} measured{when}: the {} file {} was read with phytomer {} ({}). Values that it does not tell are \
         left out.{without}",
        reported.name,
        words(told, "format"),
        words(told, "file"),
        words(json, "version"),
        words(json, "git_hash"),
    )
}

/// What each run folder says of itself.
pub fn parts(runs: &[Reported]) -> Vec<Part> {
    let columns = ["run", "what", "value"].map(str::to_owned).into();
    let rows = runs.iter().flat_map(|reported| {
        let json = reported.run.json();
        let mut rows = vec![("folder".to_owned(), reported.run.path().display().to_string())];
        for key in
            ["scenario", "status", "version", "git_hash", "schema_version", "seed", "scenario_sha256", "components"]
        {
            rows.push((key.to_owned(), words(json, key)));
        }
        let inputs = json["inputs"].as_array().map(Vec::as_slice).unwrap_or_default();
        rows.extend(inputs.iter().map(|input| (format!("input {}", words(input, "path")), words(input, "sha256"))));
        if reported.trial.is_some() {
            let overgrown = json["overgrown"].as_array().map_or(0, Vec::len);
            rows.push(("plots that ended at a limit".to_owned(), overgrown.to_string()));
        }
        rows.into_iter().map(|(what, value)| [reported.name.clone(), what, value].map(Cell::Text).into())
    });
    vec![Part::Table("What the run folders say".to_owned(), Table { columns, rows: rows.collect() })]
}

fn words(json: &Value, key: &str) -> String {
    match &json[key] {
        Value::String(words) => words.clone(),
        Value::Null => "unknown".to_owned(),
        other => other.to_string(),
    }
}
