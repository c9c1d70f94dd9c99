//! Inheritance on small trees: which file's value is taken, and that a value keeps the span in its own file.
//!
//! Absent: reading the files, and the check of what is merged (`load`).

use serde_json::json;

use super::merge_chain;
use crate::document::{self, Node};
use crate::source::{Origin, Source, Sources};

fn merged(texts: &[&str]) -> (Node, Sources) {
    let schema = json!({
        "type": "object",
        "properties": {
            "site": {"type": "object", "properties": {"a": {}, "b": {}}},
            "order": {"type": "array", "items": {"$ref": "#/definitions/Order"}},
        },
        "definitions": {
            "Order": {"type": "object", "properties": {"death": {"allOf": [{"$ref": "#/definitions/Law"}]}}},
            "Law": {"anyOf": [{"type": "number"}, {"type": "object"}]},
        },
    });
    let mut sources = Sources::default();
    let mut chain = Vec::new();
    for (i, text) in texts.iter().enumerate() {
        let origin = Origin::Preset(i.to_string());
        let id = sources.add(Source { name: i.to_string(), origin, text: (*text).into(), bytes: None });
        let mut faults = Vec::new();
        chain.extend(document::parse(&sources, id, &mut faults));
        assert_eq!(faults, []);
    }
    (
        merge_chain(&schema, phytomer_models::buds::Buds::CARD.keys.by_place.as_ref(), chain)
            .expect("a chain of at least one"),
        sources,
    )
}

#[test]
fn tables_merge_and_laws_are_replaced() {
    let old =
        "inherits = \"x\"\nsite = { a = 1, b = 2 }\nlist = [1, 2]\n[[order]]\ndeath = { linear = 1 }\npause = 1\n";
    let new = "site.b = 3\nlist = [9]\n[[order]]\ndeath = { step = 2 }\n";
    let (node, _) = merged(&[old, new]);
    let expected = json!({
        "site": {"a": 1, "b": 3}, "list": [9], "order": [{"death": {"step": 2}, "pause": 1}],
    });
    assert_eq!(node.to_json(), expected);
}

#[test]
fn the_nearer_file_wins_and_in_a_file_the_order() {
    let old = "[every_order]\na = 1\nb = 1\nc = 1\nd = 1\n[[order]]\nb = 2\nc = 2\nd = 2\n";
    let new = "[every_order]\nc = 3\nd = 3\n[[order]]\nd = 4\n[[order]]\ne = 5\n";
    let (node, _) = merged(&[old, new]);
    let orders = json!({"order": [{"a": 1, "b": 2, "c": 3, "d": 4}, {"a": 1, "b": 1, "c": 3, "d": 3, "e": 5}]});
    assert_eq!(node.to_json(), orders);
    let (node, _) = merged(&[old, "[every_order]\nd = 7\n"]);
    assert_eq!(node.to_json()["order"], json!([{"a": 1, "b": 2, "c": 2, "d": 7}]));
}

#[test]
fn a_value_keeps_the_place_where_it_was_typed() {
    let (node, sources) = merged(&["[[order]]\ndeath = 0.5\n", "\n\n[[order]]\npause = 0.25\n"]);
    let order = node.get("order").map(|o| match &o.value {
        document::Value::Array(items) => items[0].clone(),
        _ => panic!("order is a list"),
    });
    let order = order.expect("order is there");
    let place = |node: &Node| (node.span.source.0, sources.place(node.span));
    assert_eq!(place(order.get("death").unwrap()), (0, (2, 9)));
    assert_eq!(place(order.get("pause").unwrap()), (1, (4, 9)));
    assert_eq!(place(&order), (1, (3, 1)));
}
