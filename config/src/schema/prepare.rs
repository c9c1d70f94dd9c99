//! The JSON Schema of a type, prepared for files that people type.
//!
//! TOML has no null, so an optional key is one that may be absent: the null forms that schemars adds are removed. Draft
//! 7 is used, which the taplo editor plugin reads best. Schemas for files that inherit, without required keys, and
//! schemas that join the keys of two table types are made here too.

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde_json::{Map, Value as Json};

use super::parts::forms;

/// The JSON Schema of a type, without nulls.
pub fn of_type<T: JsonSchema>() -> Json {
    let schema = SchemaSettings::draft07().into_generator().into_root_schema_for::<T>();
    let mut json = Json::from(schema);
    tidy(&mut json);
    json
}

/// Removes `null` from types and forms, and the line breaks of the source from descriptions. A choice with one form
/// left is replaced by this form.
fn tidy(json: &mut Json) {
    match json {
        Json::Array(items) => items.iter_mut().for_each(tidy),
        Json::Object(map) => {
            map.values_mut().for_each(tidy);
            drop_null_type(map);
            drop_null_forms(map);
            if let Some(Json::String(text)) = map.get_mut("description") {
                *text = text.replace('\n', " ");
            }
            map.retain(|key, value| !(key == "default" && value.is_null()));
        }
        _ => {}
    }
}

fn drop_null_type(map: &mut Map<String, Json>) {
    let Some(Json::Array(types)) = map.get_mut("type") else { return };
    types.retain(|t| t != "null");
    if let [only] = types.as_slice() {
        let only = only.clone();
        map.insert("type".to_owned(), only);
    }
    if let Some(Json::Array(options)) = map.get_mut("enum") {
        options.retain(|o| !o.is_null());
    }
}

fn drop_null_forms(map: &mut Map<String, Json>) {
    for keyword in ["anyOf", "oneOf"] {
        let Some(Json::Array(forms)) = map.get_mut(keyword) else { continue };
        forms.retain(|form| form.get("type") != Some(&Json::from("null")));
        if forms.len() != 1 {
            continue;
        }
        let only = forms.pop();
        map.remove(keyword);
        if let Some(Json::Object(only)) = only {
            only.into_iter().for_each(|(key, value)| _ = map.entry(key).or_insert(value));
        }
    }
}

/// The schema of a table type for a file that may leave keys to its ancestors: no key is required in any table that
/// merges, nor in the tables of the list `by_place`.
pub fn partial(root: &Json, by_place: Option<&str>) -> Json {
    let mut schema = root.clone();
    let mut tables = vec![String::new()];
    let mut seen = 0;
    while let Some(pointer) = tables.get(seen).cloned() {
        seen += 1;
        for below in plain_tables(root, &pointer, by_place) {
            if !tables.contains(&below) {
                tables.push(below);
            }
        }
        if let Some(Json::Object(table)) = schema.pointer_mut(&pointer) {
            table.remove("required");
        }
    }
    schema
}

/// JSON pointers to the types of a table's values that are tables with one form, or lists of such tables.
fn plain_tables(root: &Json, pointer: &str, by_place: Option<&str>) -> Vec<String> {
    let Some(table) = root.pointer(pointer) else { return Vec::new() };
    let properties = table.get("properties").and_then(Json::as_object);
    let keys = properties.into_iter().flat_map(|p| p.keys());
    let places = keys.map(|key| (key, format!("{pointer}/properties/{}", key.replace('~', "~0").replace('/', "~1"))));
    let table = |(key, place): (&String, String)| {
        plain_table(root, if by_place == Some(key.as_str()) { place + "/items" } else { place })
    };
    places.filter_map(table).collect()
}

/// Follows references from `pointer` to a table with one form; the pointer to it, or `None` where they lead elsewhere.
fn plain_table(root: &Json, mut pointer: String) -> Option<String> {
    for _ in 0..8 {
        let schema = root.pointer(&pointer)?;
        let all = schema.get("allOf").and_then(Json::as_array).filter(|all| all.len() == 1);
        if let Some(reference) = schema.get("$ref").and_then(Json::as_str) {
            pointer = reference.strip_prefix('#')?.to_owned();
        } else if all.is_some() {
            pointer += "/allOf/0";
        } else {
            return (forms(schema).is_empty() && schema.get("properties").is_some()).then_some(pointer);
        }
    }
    None
}

/// Adds the keys, the required keys and the definitions of the table type `other` to `schema`.
pub fn join(schema: &mut Json, other: &Json) {
    for keyword in ["properties", "definitions"] {
        let Some(more) = other.get(keyword).and_then(Json::as_object) else { continue };
        let own = &mut schema[keyword];
        if own.is_null() {
            *own = Json::Object(Map::new());
        }
        if let Some(own) = own.as_object_mut() {
            own.extend(more.iter().map(|(k, v)| (k.clone(), v.clone())));
        }
    }
    let more = other.get("required").and_then(Json::as_array).cloned().unwrap_or_default();
    match schema.get_mut("required").and_then(Json::as_array_mut) {
        Some(own) => own.extend(more),
        None if more.is_empty() => {}
        None => schema["required"] = Json::Array(more),
    }
}
