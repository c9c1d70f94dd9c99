//! The parts of a JSON Schema: the target of a reference, the forms of a value, its type and options, the keys of a
//! table type.
//!
//! The walk, the choice of a form and the words of messages read schemas through these functions. Absent: bounds
//! (`bounds`), and messages.

use serde_json::Value as Json;

use crate::document::{Entry, Node, Value};

/// The largest depth of references and forms at one value.
pub const MAX_FORMS: usize = 32;

/// The schema to which `$ref` leads; the schema itself where it has none. Draft 7 wraps a reference that has a
/// description into an `allOf` with one item, which is followed too. `None` for a reference that leads nowhere or in
/// circles.
pub fn resolve<'s>(root: &'s Json, mut schema: &'s Json) -> Option<&'s Json> {
    for _ in 0..MAX_FORMS {
        schema = match (schema.get("$ref").and_then(Json::as_str), wrapped(schema)) {
            (Some(reference), _) => root.pointer(reference.strip_prefix('#')?)?,
            (None, Some(inner)) => inner,
            (None, None) => return Some(schema),
        };
    }
    None
}

/// Keywords that may stand beside an `allOf` with one item and add no condition.
const ASKS_NOTHING: [&str; 7] = ["allOf", "description", "default", "title", "minimum", "maximum", "exclusiveMinimum"];

/// The item of an `allOf` with one item and no further condition beside it. Bounds beside it are for editors, which
/// check a bare number alone: where a distribution may stand for the number, the model checks all values that can be
/// drawn.
fn wrapped(schema: &Json) -> Option<&Json> {
    let keys = schema.as_object()?;
    let [inner] = keys.get("allOf")?.as_array()?.as_slice() else { return None };
    keys.keys().all(|key| ASKS_NOTHING.contains(&key.as_str())).then_some(inner)
}

/// The forms that a value may have: the branches of `anyOf` or `oneOf`; empty for a value with one form.
pub fn forms(schema: &Json) -> &[Json] {
    let branches = schema.get("anyOf").or_else(|| schema.get("oneOf"));
    branches.and_then(Json::as_array).map_or(&[], Vec::as_slice)
}

/// Whether the schema's `type` allows the node's type. Without a `type` every node is allowed but a date.
pub fn has_type(schema: &Json, node: &Node) -> bool {
    match schema.get("type") {
        None => !matches!(node.value, Value::Date(_)),
        Some(Json::Array(types)) => types.iter().filter_map(Json::as_str).any(|t| is_type(t, node)),
        Some(one) => one.as_str().is_some_and(|t| is_type(t, node)),
    }
}

fn is_type(name: &str, node: &Node) -> bool {
    match &node.value {
        Value::Text(_) => name == "string",
        Value::Integer(_) => name == "integer" || name == "number",
        Value::Float(_) => name == "number",
        Value::Boolean(_) => name == "boolean",
        Value::Array(_) => name == "array",
        Value::Table(_) => name == "object",
        Value::Date(_) => false,
    }
}

/// The values that `enum` or `const` allow.
pub fn options(schema: &Json) -> Option<Vec<&Json>> {
    match schema.get("enum").and_then(Json::as_array) {
        Some(options) => Some(options.iter().collect()),
        None => schema.get("const").map(|one| vec![one]),
    }
}

/// The schema of an array's item: that of its place (`prefixItems`, or `items` as a list), else that of all items.
pub fn item_schema(schema: &Json, i: usize) -> Option<&Json> {
    match (schema.get("prefixItems"), schema.get("items")) {
        (Some(Json::Array(places)), rest) if i < places.len() => places.get(i).or(rest),
        (_, Some(Json::Array(places))) => places.get(i).or_else(|| schema.get("additionalItems")),
        (_, rest) => rest,
    }
}

/// The schema of a key of a table type. `None`: the key is not allowed. `Some(None)`: the key is allowed with any
/// value.
pub fn property<'s>(schema: &'s Json, key: &str) -> Option<Option<&'s Json>> {
    if let Some(property) = schema.get("properties").and_then(|p| p.get(key)) {
        return Some(Some(property));
    }
    match schema.get("additionalProperties") {
        Some(Json::Bool(false)) => None,
        Some(Json::Bool(true)) | None => Some(None),
        Some(other) => Some(Some(other)),
    }
}

/// The keys that a table type names.
pub fn known_keys(schema: &Json) -> Vec<&str> {
    let properties = schema.get("properties").and_then(Json::as_object);
    properties.into_iter().flat_map(|p| p.keys().map(String::as_str)).collect()
}

/// The required keys that are not among the entries.
pub fn missing_keys<'s>(schema: &'s Json, entries: &[Entry]) -> Vec<&'s str> {
    let required = schema.get("required").and_then(Json::as_array).into_iter().flatten();
    required.filter_map(Json::as_str).filter(|key| entries.iter().all(|e| e.key != **key)).collect()
}
