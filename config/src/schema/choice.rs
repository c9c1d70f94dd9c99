//! The choice of the form that a value was meant to have, where its schema allows several (a bare number or a
//! distribution; many laws).
//!
//! A form is chosen by type first, then by the constants that name it (`model = "buds"`), then by its keys; among equal
//! forms, by the fewest faults. Only the faults of the chosen form are reported. For a key of no form the nearest
//! spelling among the keys of all forms is suggested.

use serde_json::Value as Json;

use super::parts::{forms, has_type, known_keys, missing_keys, options, property, resolve};
use super::{Place, Walk, expected};
use crate::document::{Entry, Value};
use crate::report::Fault;
use phytomer_models::law::spelling::nearest;

impl<'s> Walk<'s> {
    /// Checks a value against the form that fits it best.
    pub(super) fn choose(&mut self, forms: &'s [Json], whole: &'s Json, place: &Place<'_>, depth: usize) {
        let flat = flatten(self.root, forms, 0);
        let mut fitting: Vec<&'s Json> = flat.iter().copied().filter(|form| has_type(form, place.node)).collect();
        if fitting.is_empty() {
            let problem = format!("{} is {}", place.name(), expected::found(place.node));
            self.faults.push(place.fault(problem, expected::describe(self.root, whole)));
            return;
        }
        match &place.node.value {
            Value::Text(_) if fitting.iter().all(|form| options(form).is_some()) => {
                let all: Vec<&Json> = fitting.iter().filter_map(|form| options(form)).flatten().collect();
                return self.check_options(&all, place, &expected::describe(self.root, whole));
            }
            Value::Table(entries) => {
                if self.no_tag_agrees(&fitting, entries, place) || self.no_form_known(&fitting, entries, place) {
                    return;
                }
                let best = fitting.iter().map(|form| score(self.root, form, entries)).max();
                fitting.retain(|form| Some(score(self.root, form, entries)) == best);
            }
            _ => {}
        }
        self.try_forms(&fitting, place, depth);
    }

    /// Reports the faults of the form with the fewest, among forms that fit equally well by shape.
    fn try_forms(&mut self, fitting: &[&'s Json], place: &Place<'_>, depth: usize) {
        let mut best: Option<Vec<Fault>> = None;
        for form in fitting {
            let before = std::mem::take(&mut self.faults);
            self.visit(form, place, depth + 1);
            let found = std::mem::replace(&mut self.faults, before);
            let clean = found.is_empty();
            if best.as_ref().is_none_or(|b| found.len() < b.len()) {
                best = Some(found);
            }
            if clean || self.fuel == 0 {
                break;
            }
        }
        self.faults.extend(best.unwrap_or_default());
    }

    /// Reports a key that names the form in every form (`model`) where its value names none of the forms.
    fn no_tag_agrees(&mut self, fitting: &[&'s Json], entries: &[Entry], place: &Place<'_>) -> bool {
        for entry in entries {
            let tags: Option<Vec<Vec<&Json>>> =
                fitting.iter().map(|form| options(resolve(self.root, property(form, &entry.key)??)?)).collect();
            let all: Vec<&Json> = tags.into_iter().flatten().flatten().collect();
            let value = entry.node.to_json();
            if fitting.len() > 1 && !all.is_empty() && all.iter().all(|option| **option != value) {
                let below = Place { node: &entry.node, at: entry.node.span, path: place.path.key(&entry.key) };
                self.check_options(&all, &below, &expected::list_options(&all));
                return true;
            }
        }
        false
    }

    /// Reports a table with no key of any form: one fault for the whole table, not one per form.
    fn no_form_known(&mut self, fitting: &[&'s Json], entries: &[Entry], place: &Place<'_>) -> bool {
        if fitting.iter().any(|form| entries.iter().any(|e| property(form, &e.key).is_some())) {
            return false;
        }
        let mut keys: Vec<&str> = Vec::new();
        for key in fitting.iter().flat_map(|form| naming_keys(form)) {
            if !keys.contains(&key) {
                keys.push(key);
            }
        }
        let Some(entry) = entries.first() else {
            let problem = format!("{} is an empty table", place.name());
            self.faults.push(place.fault(problem, expected::list_keys(&keys)));
            return true;
        };
        let near = nearest(&entry.key, keys.iter().copied());
        let path = place.path.key(&entry.key);
        let problem = format!("unknown key `{}`", entry.key);
        self.faults.push(Fault::new(entry.key_span, &path, problem, expected::list_keys(&keys)).suggest(near));
        true
    }
}

/// The keys by which a form is told from the others: its required keys, or all keys where none is required.
fn naming_keys(form: &Json) -> Vec<&str> {
    let required = missing_keys(form, &[]);
    if required.is_empty() { known_keys(form) } else { required }
}

/// All forms in one list: references are followed, and forms that have forms themselves are replaced by these.
fn flatten<'s>(root: &'s Json, branches: &'s [Json], depth: usize) -> Vec<&'s Json> {
    let mut flat = Vec::new();
    for branch in branches {
        let Some(form) = resolve(root, branch) else { continue };
        let inner = forms(form);
        if inner.is_empty() || depth > 8 || form.get("type").is_some() {
            flat.push(form);
        } else {
            flat.extend(flatten(root, inner, depth + 1));
        }
    }
    flat
}

/// How well a table's shape fits a form, larger for a better fit: constants that agree less those that differ, then
/// keys that are known or nearly so, then required keys that are present.
fn score(root: &Json, form: &Json, entries: &[Entry]) -> (isize, usize, isize) {
    let mut constants = 0;
    let mut known = 0;
    for entry in entries {
        let Some(key) = property(form, &entry.key) else {
            known += usize::from(nearest(&entry.key, known_keys(form)).is_some());
            continue;
        };
        known += 1;
        let key = key.and_then(|schema| resolve(root, schema));
        if let Some(options) = key.and_then(options) {
            let agrees = options.contains(&&entry.node.to_json());
            constants += if agrees { 1 } else { -1 };
        }
    }
    (constants, known, -(missing_keys(form, entries).len() as isize))
}
