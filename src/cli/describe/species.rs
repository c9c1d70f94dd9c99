//! What a species is made of: its laws order by order, where its numbers come from, and what is assumed.
//!
//! Written for any model from its parameters as data: what stands at its default is left out. Absent: meanings, which
//! the schema has (`phytomer schema species`).

use anyhow::Result;
use phytomer_config::Species;
use phytomer_config::published::{Measure, Published, Range};
use serde_json::{Map, Value, json};
use std::fmt::Write as _;

/// A number with a note on where it comes from.
struct Note {
    place: String,
    source: Option<String>,
    assumed: bool,
}

/// The species with its notes gathered.
///
/// # Errors
/// A number that JSON cannot hold, which no checked species has.
pub fn as_json(species: &Species) -> Result<Value> {
    let json = species.to_json()?;
    let notes = notes_of(&json).into_iter();
    let notes: Vec<Value> =
        notes.map(|note| json!({"place": note.place, "source": note.source, "assumed": note.assumed})).collect();
    Ok(json!({"kind": "species", "species": json, "notes": notes}))
}

/// The same for people.
///
/// # Errors
/// As [`as_json`].
pub fn as_text(species: &Species) -> Result<String> {
    let json = species.to_json()?;
    let mut text = heading(species);
    let model = species.model.name();
    let keys = &model.card().keys;
    if let Some(wood) = keys.wood.as_ref().and_then(|wood| json.get(wood.table)) {
        text += &wood_in_words(wood);
    }
    match keys.by_place.as_ref().map(|tables| tables.list) {
        Some(list) => {
            let default = model.default_table().unwrap_or_default();
            for (number, table) in (1..).zip(json[list].as_array().into_iter().flatten()) {
                let _ = writeln!(text, "\n  {list} {number}");
                laws(table, &default, &mut text);
            }
        }
        None => {
            text += "\n  parameters\n";
            let about = serde_json::to_value(&species.about)?;
            let own = json.as_object().into_iter().flatten();
            own.filter(|(key, _)| about.get(key).is_none() && *key != "model")
                .for_each(|(key, value)| law(key, value.get("value").unwrap_or(value), &mut text));
        }
    }
    text += &notes_in_words(&notes_of(&json));
    Ok(text)
}

fn heading(species: &Species) -> String {
    let about = &species.about;
    let mut text = format!("{}: a species of the model `{}`\n", about.name, species.model.name().word());
    let architecture = about.architectural_model.and_then(|model| serde_json::to_value(model).ok());
    let architecture = architecture.and_then(|model| model.as_str().map(str::to_owned));
    let lines = [
        ("botanical", about.scientific_name.clone()),
        ("common", about.common_name.clone()),
        ("architecture", architecture.map(|model| format!("{model} (Hallé & Oldeman)"))),
        ("tick", Some(about.tick.clone())),
        ("ticks per year", species.ticks_per_year().map(|ticks| ticks.to_string())),
        ("about", about.description.clone()),
        ("source", about.source.clone()),
    ];
    for (name, value) in lines {
        if let Some(value) = value {
            let _ = writeln!(text, "  {name:<18} {}", value.split_whitespace().collect::<Vec<_>>().join(" "));
        }
    }
    about.published.iter().for_each(|row| published(row, &mut text));
    text
}

/// What was published of its plants at one age.
fn published(row: &Published, text: &mut String) {
    let range =
        |(measure, [least, most]): (Measure, Range)| format!("{} {least} to {most}{}", measure.name(), measure.unit());
    let ranges: Vec<String> = row.ranges().map(range).collect();
    let _ = writeln!(text, "  {:<18} {}", format!("at age {}", row.at_age), ranges.join(", "));
}

/// The wood: what it is like, how stiff and heavy, whether it bends and how it thickens.
fn wood_in_words(stated: &Value) -> String {
    let with_unit = |(key, unit): (&str, &str)| Some(format!("{} {unit}", amount(stated.get(key)?)));
    let like = stated.get("like").and_then(Value::as_str);
    let mut words: Vec<String> = like.iter().map(|like| format!("like {like}")).collect();
    words.extend([("modulus_gpa", "GPa"), ("density_kg_m3", "kg/m³")].into_iter().filter_map(with_unit));
    let bends = stated.get("bends") != Some(&Value::Bool(false));
    words.push(if bends { "it bends" } else { "it does not bend" }.to_owned());
    let thickens = match stated.get("thickening") {
        Some(rule) => in_words(rule),
        None => "by the law of each internode".to_owned(),
    };
    format!("  {:<18} {}\n  {:<18} {thickens}\n", "wood", words.join(", "), "thickening")
}

/// A number without the note that may stand beside it, or a law.
fn amount(value: &Value) -> String {
    in_words(value.get("value").unwrap_or(value))
}

/// What a table states beyond the defaults.
fn laws(stated: &Value, default: &Value, text: &mut String) {
    for (key, value) in stated.as_object().into_iter().flatten() {
        if let Some(value) = beyond(value, &default[key]) {
            law(key, &value, text);
        }
    }
}

/// The part of a value that is not the default's.
fn beyond(value: &Value, default: &Value) -> Option<Value> {
    match (value, default) {
        (value, default) if value == default => None,
        (Value::Object(value), Value::Object(default)) if value.keys().all(|key| default.contains_key(key)) => {
            let rest: Map<_, _> = value
                .iter()
                .filter(|(key, value)| default[*key] != **value)
                .map(|(k, v)| (k.clone(), v.clone()))
                .collect();
            Some(rest.into())
        }
        _ => Some(value.clone()),
    }
}

fn law(key: &str, value: &Value, text: &mut String) {
    let _ = writeln!(text, "    {key:<16} {}", in_words(value));
}

/// A value on one line, in the manner of TOML.
fn in_words(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Number(number) => match number.as_f64() {
            Some(x) if x.fract() != 0.0 && x.abs() < 1e-3 => format!("{x:e}"),
            Some(x) if x.fract() == 0.0 && x.abs() < 1e15 => format!("{x:.0}"),
            _ => number.to_string(),
        },
        Value::Array(items) => format!("[{}]", items.iter().map(in_words).collect::<Vec<_>>().join(", ")),
        Value::Object(keys) => keys
            .iter()
            .filter(|(key, _)| !["source", "assumed"].contains(&key.as_str()))
            .map(|(key, value)| match value {
                Value::Object(_) => format!("{key} {{ {} }}", in_words(value)),
                _ => format!("{key} {}", in_words(value)),
            })
            .collect::<Vec<_>>()
            .join(", "),
        other => other.to_string(),
    }
}

/// Every number in the parameters that says where it comes from or that it is assumed.
fn notes_of(species: &Value) -> Vec<Note> {
    let mut notes = Vec::new();
    for (key, value) in species.as_object().into_iter().flatten() {
        gather(key, value, &mut notes);
    }
    notes
}

fn gather(place: &str, value: &Value, notes: &mut Vec<Note>) {
    match value {
        Value::Object(keys) => {
            let source = keys.get("source").and_then(Value::as_str).map(str::to_owned);
            let assumed = keys.get("assumed").and_then(Value::as_bool).unwrap_or(false);
            if source.is_some() || assumed {
                notes.push(Note { place: place.to_owned(), source, assumed });
            }
            keys.iter().for_each(|(key, value)| gather(&format!("{place}.{key}"), value, notes));
        }
        Value::Array(items) => {
            (1..).zip(items).for_each(|(number, item)| gather(&format!("{place} {number}"), item, notes));
        }
        _ => {}
    }
}

fn notes_in_words(notes: &[Note]) -> String {
    let mut text = String::new();
    for (title, assumed) in [("with a source", false), ("assumed", true)] {
        let of_kind: Vec<&Note> = notes.iter().filter(|note| note.assumed == assumed).collect();
        if of_kind.is_empty() {
            continue;
        }
        let _ = writeln!(text, "\n  {title}");
        for note in of_kind {
            let source = note.source.as_deref().unwrap_or("");
            let _ = writeln!(text, "    {}", format!("{}: {source}", note.place).trim_end_matches(": "));
        }
    }
    text
}
