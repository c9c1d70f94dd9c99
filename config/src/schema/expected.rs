//! Words for schemas and values in messages: "a number in [0, 1]", "one of `a`, `b`", "a table with `shape` and
//! `scale`".
//!
//! Each description fits into one line of a message; long lists are cut, since `phytomer schema` shows them whole. The
//! words are chosen for botanists: text, whole number, list, table. Absent: the descriptions in the schema, which are
//! sentences for editors.

use serde_json::Value as Json;

use super::bounds::{count, format_range, number};
use super::parts::{forms, known_keys, missing_keys, options, resolve};
use crate::document::{Node, Value};

/// The most keys or options that a message names.
const LISTED: usize = 40;

/// A value as it was typed, in words.
pub fn found(node: &Node) -> String {
    match &node.value {
        Value::Text(text) if text.chars().count() <= 40 => format!("the text {text:?}"),
        Value::Text(_) => "a text".to_owned(),
        Value::Integer(n) => format!("the whole number {n}"),
        Value::Float(x) => format!("the number {x:?}"),
        Value::Boolean(b) => b.to_string(),
        Value::Date(_) => "a date".to_owned(),
        Value::Array(_) => "a list".to_owned(),
        Value::Table(_) => "a table".to_owned(),
    }
}

/// The values that a schema allows, in words.
pub fn describe(root: &Json, schema: &Json) -> String {
    describe_at(root, schema, 0)
}

fn describe_at(root: &Json, schema: &Json, depth: usize) -> String {
    let Some(schema) = resolve(root, schema) else { return "a value".to_owned() };
    if depth > 3 {
        return "a value".to_owned();
    }
    if let Some(part) = schema.get("allOf").and_then(|all| all.get(0)) {
        return describe_at(root, part, depth + 1);
    }
    if !forms(schema).is_empty() {
        return describe_forms(root, schema, depth);
    }
    if let Some(options) = options(schema) {
        return list_options(&options);
    }
    match schema.get("type").and_then(Json::as_str) {
        Some("integer") => interval("a whole number", schema),
        Some("number") => interval("a number", schema),
        Some("string") => if count(schema, "minLength") > Some(0) { "a text, not empty" } else { "a text" }.to_owned(),
        Some("boolean") => "`true` or `false`".to_owned(),
        Some("array") => describe_list(root, schema, depth),
        Some("object") => describe_table(schema),
        _ => "a value".to_owned(),
    }
}

fn interval(what: &str, schema: &Json) -> String {
    let range = format_range(schema).filter(|_| what != "a number");
    let least = number(schema, "minimum").or(range.map(|r| r.0 as f64));
    let most = number(schema, "maximum").or(range.map(|r| r.1 as f64));
    match (least, most, number(schema, "exclusiveMinimum"), number(schema, "exclusiveMaximum")) {
        (Some(least), Some(most), ..) if most < 1e18 => format!("{what} in [{least}, {most}]"),
        (Some(least), _, _, Some(above)) => format!("{what} in [{least}, {above})"),
        (Some(least), ..) => format!("{what} of at least {least}"),
        (_, Some(most), Some(below), _) => format!("{what} in ({below}, {most}]"),
        (_, Some(most), ..) => format!("{what} of at most {most}"),
        (_, _, Some(below), Some(above)) => format!("{what} in ({below}, {above})"),
        (_, _, Some(below), _) => format!("{what} above {below}"),
        (_, _, _, Some(above)) => format!("{what} below {above}"),
        _ => what.to_owned(),
    }
}

fn describe_list(root: &Json, schema: &Json, depth: usize) -> String {
    let item = schema.get("items").filter(|i| i.is_object());
    let of = item.map_or(String::new(), |item| format!(", each {}", describe_at(root, item, depth + 1)));
    match (count(schema, "minItems"), count(schema, "maxItems")) {
        (Some(least), Some(most)) if least == most => format!("a list of {least} items{of}"),
        (Some(least), Some(most)) => format!("a list of {least} to {most} items{of}"),
        (Some(1), None) => format!("a list of at least 1 item{of}"),
        (Some(least), None) if least > 0 => format!("a list of at least {least} items{of}"),
        (_, Some(most)) => format!("a list of at most {most} items{of}"),
        _ => format!("a list{of}"),
    }
}

fn describe_table(schema: &Json) -> String {
    let required = missing_keys(schema, &[]);
    let keys = if required.is_empty() { known_keys(schema) } else { required };
    match keys.as_slice() {
        [] => "a table".to_owned(),
        keys if keys.len() > 24 => "a table".to_owned(),
        keys => format!("a table with {}", keys.iter().map(|k| format!("`{k}`")).collect::<Vec<_>>().join(", ")),
    }
}

/// All forms in one sentence; tables with one naming key are described together.
fn describe_forms(root: &Json, schema: &Json, depth: usize) -> String {
    if let Some((tag, names)) = tag_of(root, forms(schema)) {
        return format!("a table whose `{tag}` is {}", list_options(&names));
    }
    let mut words: Vec<String> = Vec::new();
    let mut keys: Vec<&str> = Vec::new();
    let mut named: Vec<&Json> = Vec::new();
    for form in forms(schema) {
        let Some(resolved) = resolve(root, form) else { continue };
        if let Some(options) = options(resolved) {
            named.extend(options);
            continue;
        }
        let required = missing_keys(resolved, &[]);
        match required.as_slice() {
            [] => push_new(&mut words, describe_at(root, form, depth + 1)),
            required => keys.extend(required.iter().filter(|k| !keys.contains(k)).copied().collect::<Vec<_>>()),
        }
    }
    if !named.is_empty() {
        words.insert(0, list_options(&named));
    }
    if !keys.is_empty() {
        words.push(format!("a table with {}", list_keys(&keys)));
    }
    words.join(", or ")
}

/// The key that names the form in every form, with its possible values; `None` where there is no such key.
fn tag_of<'s>(root: &'s Json, forms: &'s [Json]) -> Option<(&'s str, Vec<&'s Json>)> {
    let constants = |form| {
        let properties = resolve(root, form)?.get("properties")?.as_object()?;
        properties.iter().find_map(|(key, schema)| Some((key.as_str(), schema.get("const")?)))
    };
    let named: Option<Vec<(&str, &Json)>> = forms.iter().map(constants).collect();
    let named = named.filter(|named| named.windows(2).all(|pair| pair[0].0 == pair[1].0))?;
    let (tag, _) = *named.first()?;
    Some((tag, named.into_iter().map(|(_, name)| name).collect()))
}

/// Whether the schema is that of an array of tables.
pub fn is_list_of_tables(root: &Json, schema: &Json) -> bool {
    let item = schema.get("items").and_then(|item| resolve(root, item));
    item.and_then(|item| item.get("type")).is_some_and(|t| t == "object")
}

fn push_new(words: &mut Vec<String>, word: String) {
    if !words.contains(&word) {
        words.push(word);
    }
}

/// The options in words: "one of `a`, `b`".
pub fn list_options(options: &[&Json]) -> String {
    let names: Vec<String> =
        options.iter().map(|o| o.as_str().map_or_else(|| o.to_string(), |s| s.to_owned())).collect();
    list_keys(&names.iter().map(String::as_str).collect::<Vec<_>>())
}

/// The keys in words: "one of `a`, `b`", shortened when there are many.
pub fn list_keys(keys: &[&str]) -> String {
    let shown: Vec<String> = keys.iter().take(LISTED).map(|k| format!("`{k}`")).collect();
    match shown.len() {
        0 => "no key here".to_owned(),
        1 => shown.concat(),
        _ if keys.len() > LISTED => format!("one of {}, …", shown.join(", ")),
        _ => format!("one of {}", shown.join(", ")),
    }
}
