//! A species that inherits from another one and states the values that hold some of its numbers, as they were
//! estimated.
//!
//! A law, a distribution and a list are stated whole, as inheritance replaces them whole. Where the table of a law has
//! the keys, each is stated with `source`, `n` and `interval`; its prior is left out. Absent: files.

use phytomer_law::fault::Segment;
use serde_json::{Map, Value as Json, json};

use super::{Number, Numbers, at_mut, shown};
use crate::schema::{forms, resolve};

/// An estimate of a number.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimated {
    /// The place of the number in [`Numbers::all`].
    pub number: usize,
    /// The estimate.
    pub value: f64,
    /// Its interval of 95 %.
    pub interval: [f64; 2],
}

impl Numbers {
    /// The TOML text of a species that inherits from `base` and states these estimates, found from `n` observations.
    ///
    /// # Errors
    /// A number that the model refuses by its type.
    pub fn overlay(
        &self,
        base: &str,
        name: &str,
        found: &[Estimated],
        n: Option<usize>,
        source: &str,
    ) -> Result<String, String> {
        let set: Vec<(usize, f64)> = found.iter().map(|own| (own.number, own.value)).collect();
        let changed = self.with(&set)?.model.to_json().map_err(|error| error.to_string())?;
        let mut own = json!({"inherits": base, "name": name});
        let mut stated: Vec<&[Segment]> = Vec::new();
        for estimate in found {
            let number = &self.all[estimate.number];
            let unit = &number.path[..number.unit];
            if stated.contains(&unit) {
                continue;
            }
            stated.push(unit);
            let within: Vec<(&Number, &Estimated)> = found
                .iter()
                .map(|own| (&self.all[own.number], own))
                .filter(|(number, _)| number.path[..number.unit] == *unit)
                .collect();
            let mut value = at(&changed, unit).ok_or("no such path")?.clone();
            self.document(&mut value, unit, &within, n, source);
            put(&mut own, unit, value);
        }
        toml::to_string(&own).map_err(|error| error.to_string())
    }

    /// Adds what is known of the estimates, as far as the table has keys for it.
    fn document(
        &self,
        value: &mut Json,
        unit: &[Segment],
        own: &[(&Number, &Estimated)],
        n: Option<usize>,
        source: &str,
    ) {
        let keys = self.keys(unit);
        let has = |key: &str| keys.iter().any(|known| known == key);
        if value.is_number() && has("value") {
            *value = json!({"value": value.take()});
        }
        let Some(table) = value.as_object_mut() else { return };
        table.remove("prior");
        table.remove("assumed");
        table.remove("interval");
        if has("source") {
            table.insert("source".to_owned(), source.into());
        }
        table.remove("n");
        if let Some(n) = n.filter(|_| has("n")) {
            table.insert("n".to_owned(), n.into());
        }
        if has("interval") {
            let named = own.iter().map(|(number, estimate)| {
                let below = shown(&number.path[unit.len()..]);
                let last = below.rsplit('.').next().unwrap_or_default().to_owned();
                let alone = own.iter().filter(|(other, _)| other.name.ends_with(&format!(".{last}"))).count() < 2;
                let name = if below.is_empty() {
                    "value".to_owned()
                } else if alone {
                    last
                } else {
                    below
                };
                (name, json!(estimate.interval))
            });
            table.insert("interval".to_owned(), Json::Object(named.collect::<Map<_, _>>()));
        }
    }

    /// The keys that the table of a value may have, over all its forms.
    fn keys(&self, unit: &[Segment]) -> Vec<String> {
        let root = self.model.schema();
        let mut schema = resolve(root, root);
        for segment in unit {
            let below = schema.and_then(|schema| match segment {
                Segment::Key(key) => schema.get("properties")?.get(key),
                Segment::Index(_) => schema.get("items"),
            });
            schema = below.and_then(|below| resolve(root, below));
        }
        let Some(schema) = schema else { return Vec::new() };
        let of = |form: &Json| {
            let keys = resolve(root, form).and_then(|form| form.get("properties")).and_then(Json::as_object);
            keys.map(|keys| keys.keys().cloned().collect::<Vec<_>>()).unwrap_or_default()
        };
        forms(schema).iter().chain([schema]).flat_map(of).collect()
    }
}

fn at<'j>(json: &'j Json, path: &[Segment]) -> Option<&'j Json> {
    path.iter().try_fold(json, |at, segment| match segment {
        Segment::Key(key) => at.get(key),
        Segment::Index(place) => at.get(*place),
    })
}

/// Puts a value at a path; tables before it in a list are empty, since they merge by place.
fn put(json: &mut Json, path: &[Segment], value: Json) {
    for (steps, segment) in path.iter().enumerate() {
        let Some(above) = at_mut(json, &path[..steps]) else { return };
        match segment {
            Segment::Key(key) => {
                if above.is_null() {
                    *above = json!({});
                }
                if let Some(table) = above.as_object_mut() {
                    table.entry(key.clone()).or_insert(Json::Null);
                }
            }
            Segment::Index(place) => {
                if above.is_null() {
                    *above = json!([]);
                }
                if let Some(list) = above.as_array_mut() {
                    while list.len() <= *place {
                        list.push(json!({}));
                    }
                }
            }
        }
    }
    if let Some(last) = at_mut(json, path) {
        *last = value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{validate_species, validate_texts};

    #[test]
    fn estimates_are_written_over_a_base() {
        let coffee = validate_species("coffee", 24).unwrap().species;
        let numbers = Numbers::of(&coffee).unwrap();
        let found =
            [("order.1.pause", 0.2), ("order.2.internode.length_cm.normal.mean", 6.0), ("order.1.trend.1.share", 0.07)]
                .into_iter()
                .filter_map(|(name, value)| Some((numbers.find(name).ok()?, value)))
                .map(|(number, value)| Estimated { number, value, interval: [value * 0.9, value * 1.1] });
        let found: Vec<Estimated> = found.collect();
        assert!(found.len() >= 2);
        let text = numbers.overlay("coffee", "mine", &found, Some(40), "simulated").unwrap();
        let resolved = validate_texts("mine", &[("mine", text.as_str())])
            .unwrap_or_else(|r| panic!("{}\n{text}", r.render(false)));
        let told = Numbers::of(&resolved.species).unwrap();
        for own in &found {
            let name = &numbers.all()[own.number].name;
            let place = told.find(name).unwrap_or_else(|unknown| panic!("{unknown}\n{text}"));
            assert_eq!(told.all()[place].value, own.value, "{name}\n{text}");
        }
        assert!(
            text.contains("n = 40") && text.contains("source = \"simulated\"") && text.contains("interval"),
            "{text}"
        );
        assert!(!text.contains("leaf"), "{text}");
    }
}
