//! The treatments of an experiment as trees: the tree of the scenario with the levels of each treatment laid over it.
//!
//! Every value keeps its span, so that a fault in a level is shown at the level's line. Tables are merged key by key; a
//! list, and a value with several forms, is replaced whole; the lists that several factors add to are joined, the
//! scenario's own items first. An item with the name of an item before it, as pests have them, is laid over that one.
//! Absent: which treatments there are (`scenario::experiment`), and reading the trees.

use phytomer_law::fault::Path;
use serde_json::Value as Json;

use crate::document::{Node, Value};
use crate::inherit::merge_chain;
use crate::scenario::experiment::{Chosen, JOINED};

/// The tree of the scenario of a treatment.
#[derive(Debug, Clone)]
pub(crate) struct Expanded {
    /// The treatment.
    pub chosen: Chosen,
    /// Its scenario, without `experiment`.
    pub node: Node,
}

/// The trees of all treatments. `schema` is that of a scenario, and `node` the tree of the file.
pub(crate) fn expand(schema: &Json, node: &Node, chosen: Vec<Chosen>) -> Vec<Expanded> {
    let mut base = node.clone();
    base.remove("experiment");
    let treatment = |chosen: Chosen| {
        let levels = chosen.levels.iter().enumerate().filter_map(|(factor, level)| level_of(node, factor, *level));
        let laid = levels.fold(base.clone(), |below, level| laid_over(schema, below, level));
        Expanded { chosen, node: laid }
    };
    chosen.into_iter().map(treatment).collect()
}

/// The keys that a level sets.
fn level_of(node: &Node, factor: usize, level: usize) -> Option<Node> {
    let path = Path::root().key("experiment").key("factor").index(factor).key("level").index(level);
    let mut level = node.at(&path)?.clone();
    level.remove("name");
    if let Value::Table(entries) = &mut level.value {
        entries.iter_mut().filter(|entry| entry.key == "genotype_name").for_each(|entry| entry.key = "species".into());
    }
    Some(level)
}

fn laid_over(schema: &Json, below: Node, mut level: Node) -> Node {
    let Value::Table(entries) = &mut level.value else { return below };
    for entry in entries.iter_mut().filter(|entry| JOINED.contains(&entry.key.as_str())) {
        let before = below.get(&entry.key).map(Node::items).unwrap_or_default();
        if let Value::Array(items) = &mut entry.node.value {
            *items = joined(before, std::mem::take(items));
        }
    }
    let span = below.span;
    let laid = merge_chain(schema, None, vec![below.clone(), level]).unwrap_or(below);
    Node { span, ..laid }
}

/// The items of a list with those that a level adds: an item of the same name as one before it changes the keys that it
/// states, any other is put at the end.
fn joined(before: &[Node], added: Vec<Node>) -> Vec<Node> {
    let name = |item: &Node| item.get("name").and_then(Node::text).map(str::to_owned);
    let mut items = before.to_vec();
    for item in added {
        let known = name(&item).and_then(|named| items.iter().position(|known| name(known) == Some(named.clone())));
        match known.filter(|place| *place < before.len()) {
            Some(place) => items[place] = changed(items[place].clone(), item),
            None => items.push(item),
        }
    }
    items
}

/// A table with the keys of another over its own, tables in it likewise.
fn changed(mut below: Node, over: Node) -> Node {
    match (&mut below.value, over.value) {
        (Value::Table(entries), Value::Table(news)) => {
            for new in news {
                match entries.iter_mut().find(|known| known.key == new.key) {
                    Some(known) => {
                        known.key_span = new.key_span;
                        known.node = changed(known.node.clone(), new.node);
                    }
                    None => entries.push(new),
                }
            }
        }
        (_, value) => return Node { span: over.span, value },
    }
    Node { span: over.span, ..below }
}
