//! The shipped table of woods, and the key by which a species refers to it: `[wood] like = "scots_pine"`.
//!
//! Stiffness, green density and drag of a row hold where the species' own `[wood]` states none. Each value keeps its
//! place in the table, so that a fault in it is shown there. Absent: the use of these numbers
//! (`phytomer_sim::mechanics`).

use crate::document::{Node, Value, parse};
use crate::report::Fault;
use crate::source::{Origin, Source, Sources};
use phytomer_models::fault::Path;
use phytomer_models::law::spelling::nearest;
use phytomer_models::parameters::Keys;

const TABLE: &str = include_str!("../presets/wood.toml");

/// The names of a row of the table of woods.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ShippedWood {
    /// The name of the wood as the key `like` takes it.
    pub name: String,
    /// The botanical name of the measured plant.
    pub scientific_name: String,
}

/// Every wood of the shipped table, in its order. Parses the table at each call.
pub fn woods() -> Vec<ShippedWood> {
    let rows = read(&mut Sources::default());
    let row = |(name, row): &(String, Node)| ShippedWood {
        name: name.clone(),
        scientific_name: row.get("scientific_name").and_then(Node::text).unwrap_or_default().to_owned(),
    };
    rows.iter().map(row).collect()
}

/// Fills the keys that the species' `[wood]` leaves out from the wood that its key `like` names.
pub(crate) fn fill(species: &mut Node, keys: &Keys, sources: &mut Sources, faults: &mut Vec<Fault>) {
    let Some(table) = keys.wood.as_ref().map(|wood| wood.table) else { return };
    let Some(like) = species.get(table).and_then(|wood| wood.get("like")) else { return };
    let Some(name) = like.text().map(str::to_owned) else { return };
    let span = like.span;
    let rows = read(sources);
    let Some((_, row)) = rows.iter().find(|(known, _)| *known == name) else {
        let near = nearest(&name, rows.iter().map(|(known, _)| known.as_str())).map(str::to_owned);
        let path = Path::root().key(table).key("like");
        let expected = "a wood of the shipped table (`phytomer list woods` has them)";
        faults.push(Fault::new(span, &path, format!("there is no wood `{name}`"), expected).suggest(near));
        return;
    };
    let Value::Table(entries) = &mut species.value else { return };
    let Some(wood) = entries.iter_mut().find(|entry| entry.key == table) else { return };
    let Value::Table(own) = &mut wood.node.value else { return };
    for entry in row.entries() {
        let stated = own.iter().any(|known| known.key == entry.key);
        if !stated && entry.key != "scientific_name" {
            own.push(entry.clone());
        }
    }
}

/// The rows of the table by name; its text is added to the sources, so that spans point into it.
fn read(sources: &mut Sources) -> Vec<(String, Node)> {
    let origin = Origin::Preset("wood".to_owned());
    let source = sources.add(Source { name: "preset:wood".to_owned(), origin, text: TABLE.into(), bytes: None });
    let table = parse(sources, source, &mut Vec::new());
    let entries = table.as_ref().map(Node::entries).unwrap_or_default();
    entries.iter().map(|entry| (entry.key.clone(), entry.node.clone())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_every_wood_with_its_numbers_and_their_source() {
        let rows = read(&mut Sources::default());
        assert_eq!(rows.len(), 14);
        for (name, row) in rows {
            for key in ["modulus_gpa", "density_kg_m3"] {
                let sourced = row.get(key).and_then(|value| value.get("source")).and_then(Node::text);
                assert!(sourced.is_some_and(|source| !source.is_empty()), "{name}: {key}");
            }
            assert!(row.get("drag").is_some() || name == "apple_branch", "{name}");
        }
    }
}
