//! Bounds of single values: numbers, the width of whole numbers, lengths of texts and lists.
//!
//! schemars writes the width of a Rust integer as `format` and only sometimes as bounds, so the format is read too:
//! serde must not refuse a value that passes here. Absent: `multipleOf`, `uniqueItems` and text patterns, which no type
//! of this project makes.

use serde_json::Value as Json;

use crate::document::{Node, Value};

/// The problem with a number or a text, in words ("0.0"); `None` where it is within its bounds.
pub fn of_scalar(schema: &Json, node: &Node) -> Option<String> {
    match &node.value {
        Value::Integer(n) => (!within(schema, *n as f64) || !fits_format(schema, *n)).then(|| n.to_string()),
        Value::Float(x) => (!within(schema, *x)).then(|| x.to_string()),
        Value::Text(text) => of_length(schema, text),
        _ => None,
    }
}

/// The problem with the length of a list, in words; `None` where it is within its bounds.
pub fn of_array(schema: &Json, items: &[Node]) -> Option<String> {
    let n = items.len();
    let outside = count(schema, "minItems").is_some_and(|least| n < least)
        || count(schema, "maxItems").is_some_and(|most| n > most);
    outside.then(|| match n {
        0 => "is empty".to_owned(),
        1 => "has 1 item".to_owned(),
        n => format!("has {n} items"),
    })
}

/// The problem with the number of keys of a table, in words; `None` where it is within its bounds.
pub fn of_table(schema: &Json, keys: usize) -> Option<String> {
    let few = count(schema, "minProperties").is_some_and(|least| keys < least);
    let many = count(schema, "maxProperties").is_some_and(|most| keys > most);
    (few || many).then(|| match keys {
        0 => "is an empty table".to_owned(),
        1 => "has 1 key".to_owned(),
        n => format!("has {n} keys"),
    })
}

/// The bound of a number that a keyword such as `minimum` states; `None` without the keyword.
pub fn number(schema: &Json, keyword: &str) -> Option<f64> {
    schema.get(keyword).and_then(Json::as_f64)
}

/// The bound of a length that a keyword such as `minItems` states; `None` without the keyword.
pub fn count(schema: &Json, keyword: &str) -> Option<usize> {
    schema.get(keyword).and_then(Json::as_u64).map(|n| n as usize)
}

/// The smallest and largest value of a Rust integer by its schemars format.
pub fn format_range(schema: &Json) -> Option<(i64, i64)> {
    Some(match schema.get("format").and_then(Json::as_str)? {
        "uint8" => (0, u8::MAX.into()),
        "uint16" => (0, u16::MAX.into()),
        "uint32" => (0, u32::MAX.into()),
        "uint64" | "uint" | "uint128" => (0, i64::MAX),
        "int8" => (i8::MIN.into(), i8::MAX.into()),
        "int16" => (i16::MIN.into(), i16::MAX.into()),
        "int32" => (i32::MIN.into(), i32::MAX.into()),
        _ => return None,
    })
}

fn within(schema: &Json, x: f64) -> bool {
    number(schema, "minimum").is_none_or(|least| x >= least)
        && number(schema, "maximum").is_none_or(|most| x <= most)
        && number(schema, "exclusiveMinimum").is_none_or(|below| x > below)
        && number(schema, "exclusiveMaximum").is_none_or(|above| x < above)
        && (schema.get("format").and_then(Json::as_str) != Some("float") || x.abs() <= f32::MAX.into())
}

fn fits_format(schema: &Json, n: i64) -> bool {
    format_range(schema).is_none_or(|(least, most)| (least..=most).contains(&n))
}

fn of_length(schema: &Json, text: &str) -> Option<String> {
    let n = text.chars().count();
    if count(schema, "minLength").is_some_and(|least| n < least) {
        return Some(if n == 0 { "empty".to_owned() } else { format!("only {n} characters long") });
    }
    count(schema, "maxLength").is_some_and(|most| n > most).then(|| format!("{n} characters long"))
}
