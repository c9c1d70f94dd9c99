//! The keys of a JSON object with the paper's names: `"1Length": 0.3`, or lists of levels as `"nLength": [1, 0.3]`.
//!
//! Absent: JSON objects with the keys of tree-gen or Sapling, which those tables read.

use crate::fault::{Wrong, said};
use crate::mapping::{Mapping, Rule};
use crate::paper::{Key, OF_LEVEL, Setting};
use crate::value::{Entry, Value};

/// What a key of the paper's own names is.
pub(crate) fn rule(key: &str) -> Option<Rule> {
    match key {
        "name" | "Species" => Some(Rule::Nothing("it is the name of the tree", &[])),
        "children" => Some(Rule::By(children)),
        _ => match key.strip_prefix('n').and_then(|name| OF_LEVEL.iter().find(|known| **known == name)) {
            Some(name) => Some(Rule::Each(name)),
            None => Key::named(key).map(|_| Rule::Same),
        },
    }
}

fn children(mapping: &mut Mapping<'_>, entry: &Entry) -> Result<(), Wrong> {
    match &entry.node.value {
        Value::Text(word) if word == "above_base" => {
            mapping.set("children", Setting::Word("above_base"), "as stated");
            mapping.take(entry, "children = \"above_base\"");
            Ok(())
        }
        Value::Text(word) => {
            let problem = format!("`{}` is no way to count children", said(word));
            Err(Wrong::new(entry.node.bytes.clone(), problem, "`above_base`"))
        }
        _ => Err(mapping.wrong(&entry.node, "`above_base`")),
    }
}

/// What the paper leaves at nothing where it is not stated.
pub(crate) fn default(_: Key) -> Option<f64> {
    None
}
