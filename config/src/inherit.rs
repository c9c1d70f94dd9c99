//! Inheritance between species, and the defaults that all orders share.
//!
//! The file nearer to the species wins; within one file an `[[order]]` wins over `[every_order]`, as the bud model
//! calls its tables that merge by place. Tables merge key by key. A list is replaced whole, and so is a value with
//! several forms (a law, a number or its distribution). `[[order]]` tables merge by their place: the second of the
//! child over the second of the parent; a further order of the child starts from the `[every_order]` of both files. So
//! each value comes from the nearest file that states it, and keeps its span. Absent: several parents.

use serde_json::Value as Json;

use phytomer_models::parameters::ByPlace;

use crate::document::{Entry, Node, Value};
use crate::schema::{forms, resolve};

/// Merges the files of a species, `chain`, into one tree; the eldest ancestor comes first. `schema` is that of the
/// species' growth model, and `by_place` names the model's tables that merge by place. `None` for an empty chain.
pub fn merge_chain(schema: &Json, by_place: Option<&ByPlace>, chain: Vec<Node>) -> Option<Node> {
    let merge = Merge { root: schema, by_place };
    let mut generations = chain.into_iter();
    let eldest = generations.next()?;
    let start = Node { span: eldest.span, value: Value::Table(Vec::new()) };
    let mut merged = merge.generation(start, eldest);
    for child in generations {
        merged = merge.generation(merged, child);
    }
    if let Some(tables) = by_place {
        merged.remove(tables.every);
    }
    merged.remove("inherits");
    Some(merged)
}

struct Merge<'s> {
    root: &'s Json,
    by_place: Option<&'s ByPlace>,
}

impl<'s> Merge<'s> {
    /// Merges one file over all its ancestors.
    fn generation(&self, mut parent: Node, mut child: Node) -> Node {
        let Some(tables) = self.by_place else { return self.node(Some(self.root), parent, child) };
        let (old_every, new_every) = (parent.remove(tables.every), child.remove(tables.every));
        let (old_orders, new_orders) = (parent.remove(tables.list), child.remove(tables.list));
        let orders = self.orders(old_orders, old_every.as_ref(), new_every.as_ref(), new_orders);
        let every = match (old_every, new_every) {
            (Some(old), Some(new)) => Some(self.entry(Some(self.order_schema()), old, new)),
            (old, new) => new.or(old),
        };
        let mut merged = self.node(Some(self.root), parent, child);
        if let Value::Table(entries) = &mut merged.value {
            entries.extend(orders);
            entries.extend(every);
        }
        merged
    }

    /// Merges the orders of both generations, with the defaults of the nearer one in between.
    fn orders(
        &self,
        old: Option<Entry>,
        old_every: Option<&Entry>,
        new_every: Option<&Entry>,
        new: Option<Entry>,
    ) -> Option<Entry> {
        let template = new.as_ref().or(old.as_ref())?;
        let (key, key_span, span) = (template.key.clone(), template.key_span, template.node.span);
        let mut olds = match old.map(|e| e.node.value) {
            Some(Value::Array(items)) => items,
            _ => Vec::new(),
        };
        let news = match new.map(|e| e.node.value) {
            None => Vec::new(),
            Some(Value::Array(items)) => items,
            // The value is not a list: the schema has already reported it.
            Some(value) => return Some(Entry { key, key_span, node: Node { span, value } }),
        };
        let known = olds.len();
        let fresh = old_every.map(|e| e.node.clone());
        let mut items: Vec<Node> = Vec::new();
        let mut news = news.into_iter();
        for old in olds.drain(..) {
            items.push(self.order(old, new_every, news.next()));
        }
        items.extend(news.map(|new| {
            let empty = || Node { span: new.span, value: Value::Table(Vec::new()) };
            self.order(fresh.clone().unwrap_or_else(empty), new_every, Some(new))
        }));
        debug_assert!(items.len() >= known);
        Some(Entry { key, key_span, node: Node { span, value: Value::Array(items) } })
    }

    fn order(&self, below: Node, every: Option<&Entry>, own: Option<Node>) -> Node {
        let span = own.as_ref().unwrap_or(&below).span;
        let layers = every.map(|e| e.node.clone()).into_iter().chain(own);
        let schema = Some(self.order_schema());
        let merged = layers.fold(below, |old, new| self.node(schema, old, new));
        Node { span, ..merged }
    }

    fn order_schema(&self) -> &'s Json {
        let list = self.by_place.and_then(|tables| self.below(Some(self.root), tables.list));
        list.and_then(|list| list.get("items")).and_then(|item| resolve(self.root, item)).unwrap_or(&Json::Null)
    }

    fn node(&self, schema: Option<&'s Json>, old: Node, new: Node) -> Node {
        let schema = schema.and_then(|schema| resolve(self.root, schema));
        let single = schema.is_some_and(|schema| forms(schema).is_empty());
        match (old.value, new.value) {
            (Value::Table(olds), Value::Table(news)) if single => {
                Node { span: new.span, value: Value::Table(self.entries(schema, olds, news)) }
            }
            (_, value) => Node { span: new.span, value },
        }
    }

    fn entries(&self, schema: Option<&'s Json>, mut olds: Vec<Entry>, news: Vec<Entry>) -> Vec<Entry> {
        for new in news {
            let below = self.below(schema, &new.key);
            match olds.iter().position(|old| old.key == new.key) {
                Some(at) => {
                    let old = olds.remove(at);
                    olds.insert(at, self.entry(below, old, new));
                }
                None => olds.push(new),
            }
        }
        olds
    }

    fn entry(&self, schema: Option<&'s Json>, old: Entry, new: Entry) -> Entry {
        Entry { key: new.key, key_span: new.key_span, node: self.node(schema, old.node, new.node) }
    }

    /// The schema of a key of a table; `None` for an unknown key, whose value is replaced.
    fn below(&self, schema: Option<&'s Json>, key: &str) -> Option<&'s Json> {
        let schema = schema?;
        let property = schema.get("properties").and_then(|p| p.get(key));
        let property = property.or_else(|| schema.get("additionalProperties").filter(|a| a.is_object()))?;
        resolve(self.root, property)
    }
}

#[cfg(test)]
mod tests;
