//! The keys of a parametric tree in one table: those of the whole tree, and those of each level behind its number, as
//! in the paper's parameter files (`0SegSplits`, `1DownAngleV`).
//!
//! A file is read key by key: a key that begins with the number of a level belongs to the table of that level. Absent:
//! the parameters (`params`).

use super::params::{Branches, Tree, Trunk, Whole};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::{DeserializeOwned, Error as _, MapAccess, Visitor};
use serde::ser::{Error as _, SerializeMap as _};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::{Map, Value};
use std::borrow::Cow;
use std::fmt;

/// The numbers of the levels that have parameters of their own.
const LEVELS: [&str; 4] = ["0", "1", "2", "3"];

/// The level that a key belongs to, and the rest of the key; `None` for a key of the whole tree.
fn level_of(key: &str) -> Option<(usize, &str)> {
    LEVELS.iter().enumerate().find_map(|(level, digit)| Some((level, key.strip_prefix(digit)?)))
}

impl Serialize for Tree {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let table = |value: serde_json::Result<Value>| match value {
            Ok(Value::Object(table)) => Ok(table),
            Ok(_) => Ok(Map::new()),
            Err(error) => Err(S::Error::custom(error)),
        };
        let mut levels = vec![table(serde_json::to_value(&self.trunk))?];
        for level in self.branches.iter() {
            levels.push(table(serde_json::to_value(level))?);
        }
        let mut map = serializer.serialize_map(None)?;
        for (key, value) in table(serde_json::to_value(&self.whole))? {
            map.serialize_entry(&key, &value)?;
        }
        for (digit, level) in LEVELS.iter().zip(levels) {
            for (key, value) in level {
                map.serialize_entry(&format!("{digit}{key}"), &value)?;
            }
        }
        map.end()
    }
}

impl<'de> Deserialize<'de> for Tree {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Keys)
    }
}

struct Keys;

impl<'de> Visitor<'de> for Keys {
    type Value = Tree;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the parameters of a parametric tree")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Tree, A::Error> {
        let (mut whole, mut levels) = (Map::new(), LEVELS.map(|_| Map::new()));
        while let Some((key, value)) = map.next_entry::<String, Value>()? {
            let (table, key) = match level_of(&key) {
                Some((level, rest)) => (&mut levels[level], rest.to_owned()),
                None => (&mut whole, key),
            };
            if table.insert(key.clone(), value).is_some() {
                return Err(A::Error::custom(format!("the key `{key}` is given twice")));
            }
        }
        let [trunk, first, second, third] = levels;
        Ok(Tree {
            whole: read(whole, "")?,
            trunk: read(trunk, LEVELS[0])?,
            branches: Box::new([read(first, LEVELS[1])?, read(second, LEVELS[2])?, read(third, LEVELS[3])?]),
        })
    }
}

/// The parameters of a table whose keys stood behind `digit`.
fn read<T: DeserializeOwned, E: serde::de::Error>(table: Map<String, Value>, digit: &str) -> Result<T, E> {
    serde_json::from_value(Value::Object(table)).map_err(|error| match digit {
        "" => E::custom(error),
        level => E::custom(format!("among the keys of level {level}: {error}")),
    })
}

impl JsonSchema for Tree {
    fn schema_name() -> Cow<'static, str> {
        "Tree".into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut schema = Whole::json_schema(generator);
        let trunk = Trunk::json_schema(generator);
        let branches = Branches::json_schema(generator);
        for (level, digit) in LEVELS.iter().enumerate() {
            let of_level = if level == 0 { &trunk } else { &branches };
            for (keyword, keys) in [("properties", keys_of(of_level)), ("required", required_of(of_level))] {
                add(&mut schema, keyword, keys, digit);
            }
        }
        schema
    }
}

/// The keys of a table with their schemas.
fn keys_of(schema: &Schema) -> Vec<(String, Value)> {
    let keys = schema.get("properties").and_then(Value::as_object);
    keys.into_iter().flatten().map(|(key, value)| (key.clone(), value.clone())).collect()
}

/// The keys that a table must have.
fn required_of(schema: &Schema) -> Vec<(String, Value)> {
    let keys = schema.get("required").and_then(Value::as_array);
    keys.into_iter().flatten().filter_map(Value::as_str).map(|key| (key.to_owned(), Value::Null)).collect()
}

/// Adds keys behind the number of their level.
fn add(schema: &mut Schema, keyword: &str, keys: Vec<(String, Value)>, digit: &str) {
    match schema.get_mut(keyword) {
        Some(Value::Object(known)) => known.extend(keys.into_iter().map(|(key, of)| (format!("{digit}{key}"), of))),
        Some(Value::Array(known)) => known.extend(keys.iter().map(|(key, _)| Value::from(format!("{digit}{key}")))),
        _ => {}
    }
}
