//! The check of a document against the JSON Schema that schemars makes from the types; every fault is collected.
//!
//! Editors get the same schema (`phytomer schema species`), so editor and program agree. The keywords that schemars
//! writes for the types of this project are checked. Where a value has several forms (`anyOf`, `oneOf`), the form that
//! fits best is chosen first and only its faults are reported. Absent: annotations, `not`, `if` and remote references,
//! which no type of this project makes.

mod bounds;
mod choice;
mod expected;
mod parts;
mod prepare;

pub use parts::{forms, resolve};
pub use prepare::{join, of_type, partial};

use std::collections::BTreeSet;

use phytomer_law::fault::{Path, Segment};
use serde_json::Value as Json;

use parts::{MAX_FORMS, item_schema, known_keys, missing_keys, property};

use crate::document::{Entry, Node, Value};
use crate::report::{Fault, MOST_FAULTS};
use crate::source::Span;
use phytomer_models::law::spelling::nearest;

/// The most visits of values in one document while forms are tried; after that the first form that fits by shape is
/// taken.
const FUEL: usize = 200_000;

/// Checks `node` against `schema`, whose `$ref`s lead into `schema` itself, and adds the faults to `faults`. Stops
/// after a thousand faults.
pub fn check(schema: &Json, node: &Node, faults: &mut Vec<Fault>) {
    let mut walk = Walk { root: schema, faults: Vec::new(), fuel: FUEL };
    walk.visit(schema, &Place { node, at: node.span, path: Path::root() }, 0);
    faults.append(&mut walk.faults);
}

/// A value during the walk, with its path and the span that is underlined when the whole value is wrong.
struct Place<'n> {
    node: &'n Node,
    at: Span,
    path: Path,
}

impl Place<'_> {
    fn fault(&self, problem: impl Into<String>, expected: impl Into<String>) -> Fault {
        Fault::new(self.at, &self.path, problem, expected)
    }

    /// The name of the value in messages.
    fn name(&self) -> String {
        match self.path.0.last() {
            Some(Segment::Key(key)) => format!("`{key}`"),
            Some(Segment::Index(i)) => format!("item {} of the list", i + 1),
            None => "the file".to_owned(),
        }
    }
}

struct Walk<'s> {
    root: &'s Json,
    faults: Vec<Fault>,
    fuel: usize,
}

impl<'s> Walk<'s> {
    fn visit(&mut self, schema: &'s Json, place: &Place<'_>, depth: usize) {
        if self.faults.len() >= MOST_FAULTS {
            return;
        }
        self.fuel = self.fuel.saturating_sub(1);
        if depth > MAX_FORMS * 4 {
            self.faults.push(place.fault("nested too deep", "a simpler value"));
            return;
        }
        let Some(schema) = resolve(self.root, schema) else { return };
        for part in schema.get("allOf").and_then(Json::as_array).into_iter().flatten() {
            self.visit(part, place, depth + 1);
        }
        let forms = forms(schema);
        if !forms.is_empty() {
            self.choose(forms, schema, place, depth);
        }
        if self.check_type(schema, place) {
            self.check_value(schema, place, depth);
        }
    }

    /// Whether the value has the schema's type; adds a fault if not.
    fn check_type(&mut self, schema: &Json, place: &Place<'_>) -> bool {
        let fits = parts::has_type(schema, place.node);
        if !fits {
            let problem = format!("{} is {}", place.name(), expected::found(place.node));
            let mut expected = expected::describe(self.root, schema);
            if let (Value::Table(_), true) = (&place.node.value, expected::is_list_of_tables(self.root, schema)) {
                expected += &format!(": `[[{}]]` in place of `[{}]`", place.path, place.path);
            }
            self.faults.push(place.fault(problem, expected));
        }
        fits
    }

    fn check_value(&mut self, schema: &'s Json, place: &Place<'_>, depth: usize) {
        if let Some(options) = parts::options(schema) {
            self.check_options(&options, place, &expected::list_options(&options));
        }
        match &place.node.value {
            Value::Integer(_) | Value::Float(_) | Value::Text(_) => {
                if let Some(problem) = bounds::of_scalar(schema, place.node) {
                    let problem = format!("{} is {problem}", place.name());
                    self.faults.push(place.fault(problem, expected::describe(self.root, schema)));
                }
            }
            Value::Array(items) => self.check_array(schema, items, place, depth),
            Value::Table(entries) => self.check_table(schema, entries, place, depth),
            Value::Boolean(_) | Value::Date(_) => {}
        }
    }

    fn check_options(&mut self, options: &[&Json], place: &Place<'_>, expected: &str) {
        let value = place.node.to_json();
        if options.iter().any(|option| **option == value) {
            return;
        }
        let problem = format!("{} is {}", place.name(), expected::found(place.node));
        let near = place.node.text().and_then(|t| nearest(t, options.iter().filter_map(|o| o.as_str())));
        self.faults.push(place.fault(problem, expected).suggest(near));
    }

    fn check_array(&mut self, schema: &'s Json, items: &[Node], place: &Place<'_>, depth: usize) {
        if let Some(problem) = bounds::of_array(schema, items) {
            let problem = format!("{} {problem}", place.name());
            self.faults.push(place.fault(problem, expected::describe(self.root, schema)));
        }
        if schema.get("uniqueItems") == Some(&Json::Bool(true)) {
            self.check_unique(items, place);
        }
        for (i, item) in items.iter().enumerate() {
            if let Some(item_schema) = item_schema(schema, i) {
                let below = Place { node: item, at: item.span, path: place.path.index(i) };
                self.visit(item_schema, &below, depth + 1);
            }
        }
    }

    fn check_unique(&mut self, items: &[Node], place: &Place<'_>) {
        let mut seen = BTreeSet::new();
        for (i, item) in items.iter().enumerate() {
            if !seen.insert(item.to_json().to_string()) {
                let problem = format!("{} is in the list twice", expected::found(item));
                self.faults.push(Fault::new(item.span, &place.path.index(i), problem, "each item once"));
            }
        }
    }

    fn check_table(&mut self, schema: &'s Json, entries: &[Entry], place: &Place<'_>, depth: usize) {
        if let Some(problem) = bounds::of_table(schema, entries.len()) {
            let problem = format!("{} {problem}", place.name());
            self.faults.push(place.fault(problem, expected::list_keys(&known_keys(schema))));
        }
        let missing = missing_keys(schema, entries);
        let mut meant = Vec::new();
        for entry in entries {
            if self.faults.len() >= MOST_FAULTS {
                return;
            }
            let below = Place { node: &entry.node, at: entry.node.span, path: place.path.key(&entry.key) };
            match property(schema, &entry.key) {
                Some(Some(property)) => self.visit(property, &below, depth + 1),
                Some(None) => {}
                None => meant.extend(self.unknown_key(schema, entry, &below)),
            }
        }
        // A key that is only misspelt is not reported as missing too.
        for key in missing.into_iter().filter(|key| !meant.contains(key)) {
            let expected = property(schema, key).flatten().map(|p| expected::describe(self.root, p));
            // The path is not in the message: so a gap that appears again through inheritance is reported once.
            let problem = format!("the key `{key}` is missing");
            self.faults.push(place.fault(problem, format!("`{key}`: {}", expected.unwrap_or_default())));
        }
    }

    /// Adds a fault for a key that is not allowed; returns the key nearest in spelling, which was probably meant.
    fn unknown_key(&mut self, schema: &'s Json, entry: &Entry, below: &Place<'_>) -> Option<&'s str> {
        let known = known_keys(schema);
        let near = nearest(&entry.key, known.iter().copied());
        let fault = Fault::new(
            entry.key_span,
            &below.path,
            format!("unknown key `{}`", entry.key),
            expected::list_keys(&known),
        );
        self.faults.push(fault.suggest(near));
        near
    }
}

#[cfg(test)]
mod tests;
