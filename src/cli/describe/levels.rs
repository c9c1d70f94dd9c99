//! What a level sets, as people read it: a key and its value a line, with the unit in which it is given and in SI.
//!
//! Keys name their unit by their end (`nitrogen_kg_ha`), or are names of the ICASA dictionary, whose units are listed
//! here. Absent: what the keys mean (`phytomer schema scenario`).

use serde_json::{Map, Value};

/// A unit: the end of the keys that have it, or a key itself; its name where the key does not tell it; the factor to
/// SI, and the SI unit.
type Unit = (&'static str, &'static str, f64, &'static str);

/// The units in which people give values that are other ones in SI.
const UNITS: [Unit; 11] = [
    ("_kg_ha", "", 1e-4, "kg/m²"),
    ("N_in_applied_fertilizer", "kg[N]/ha", 1e-4, "kg/m²"),
    ("_deg", "", std::f64::consts::PI / 180.0, "rad"),
    ("row_direction", "° from north", std::f64::consts::PI / 180.0, "rad"),
    ("_cm", "", 1e-2, "m"),
    ("row_spacing", "cm", 1e-2, "m"),
    ("plant_spacing", "cm", 1e-2, "m"),
    ("harvest_cut_height", "cm", 1e-2, "m"),
    ("plant_pop_at_planting", "plants/m²", 1.0, "m⁻²"),
    ("_percent", "", 1e-2, "as a share"),
    ("germination", "%", 1e-2, "as a share"),
];

/// What a level sets, a line each; none where it sets nothing.
pub fn lines(sets: &Map<String, Value>) -> Vec<String> {
    let mut lines = Vec::new();
    sets.iter().for_each(|(key, value)| add(key, value, &mut lines));
    lines
}

fn add(path: &str, value: &Value, lines: &mut Vec<String>) {
    match value {
        Value::Object(keys) => keys.iter().for_each(|(key, value)| add(&format!("{path}.{key}"), value, lines)),
        Value::Array(items) if items.iter().any(Value::is_object) => {
            lines.extend(items.iter().map(|item| format!("{path}: {}", table(item))));
        }
        value => lines.push(stated(path, value)),
    }
}

/// A table on one line.
fn table(item: &Value) -> String {
    let Value::Object(keys) = item else { return words(item) };
    keys.iter().map(|(key, value)| stated(key, value)).collect::<Vec<_>>().join(", ")
}

/// A key with its value. A switch that is on is told by its key alone.
fn stated(key: &str, value: &Value) -> String {
    match value {
        Value::Bool(true) => key.to_owned(),
        Value::Number(number) => format!("{key} = {number}{}", unit_of(key, number.as_f64().unwrap_or(f64::NAN))),
        value => format!("{key} = {}", words(value)),
    }
}

/// The unit of the value of a key, with the value in SI: " cm (0.75 m)".
fn unit_of(key: &str, value: f64) -> String {
    let own = key.rsplit('.').next().unwrap_or(key);
    let has = |(name, ..): &&Unit| if name.starts_with('_') { own.ends_with(name) } else { own == *name };
    let Some((_, given, factor, si)) = UNITS.iter().find(has) else { return String::new() };
    let space = if given.is_empty() || given.starts_with('°') { "" } else { " " };
    // Nine decimals: what a product of two decimal numbers has beyond is no digit of theirs.
    let in_si = (value * factor * 1e9).round() / 1e9;
    format!("{space}{given} ({in_si} {si})")
}

fn words(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Array(items) => format!("[{}]", items.iter().map(words).collect::<Vec<_>>().join(", ")),
        Value::Object(_) => format!("{{ {} }}", table(value)),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn what_a_level_sets_is_told_in_given_and_si_units() {
        let sets = json!({
            "planting_date": "2001-04-12",
            "planting": {"row_spacing": 75, "plant_pop_at_planting": 6.5, "row_direction": 90},
            "soil": {"nitrogen_kg_ha": 40.5},
            "site": {"wind": {"speed_m_s": 9, "towards_deg": 45}},
            "fertilizer": [{"fertilization_date": "2001-05-01", "N_in_applied_fertilizer": 60, "yearly": true}],
            "event": [{"operation": "topping", "when": "height_m > 1.5", "only": ["a", "b"]}],
        });
        let Value::Object(sets) = sets else { panic!("a table") };
        let told = lines(&sets);
        for line in [
            "planting_date = 2001-04-12",
            "planting.row_spacing = 75 cm (0.75 m)",
            "planting.plant_pop_at_planting = 6.5 plants/m² (6.5 m⁻²)",
            "planting.row_direction = 90° from north (1.570796327 rad)",
            "soil.nitrogen_kg_ha = 40.5 (0.00405 kg/m²)",
            "site.wind.speed_m_s = 9",
            "site.wind.towards_deg = 45 (0.785398163 rad)",
            "fertilizer: fertilization_date = 2001-05-01, N_in_applied_fertilizer = 60 kg[N]/ha (0.006 kg/m²), yearly",
            "event: operation = topping, when = height_m > 1.5, only = [a, b]",
        ] {
            assert!(told.iter().any(|other| other == line), "{line}: {told:#?}");
        }
    }
}
