//! Faults of meaning, which the growth models find, shown at the values in the file.
//!
//! A model reports a path and words; the file, the line and the column come from the tree. Where the schema has refused
//! some keys, the models still check the rest: refused values are taken out first ([`without`]), so that all faults are
//! reported at once and no fault is a consequence of another. Absent: the checks themselves.

use phytomer_models::fault::{self, Path, Segment};
use phytomer_models::parameters::Keys;

use crate::document::{Node, Value};
use crate::report::Fault;
use crate::source::{Sources, Span};
use phytomer_models::law::spelling::nearest;

/// The tree without the values that were refused; `keys` are the roles of the model's keys. `None` where nothing useful
/// is left.
pub fn without(node: &Node, keys: &Keys, faults: &[Fault]) -> Option<Node> {
    let mut rest = node.clone();
    let wood = keys.wood.as_ref();
    let is_wood = |key: &str| wood.is_some_and(|wood| wood.table == key);
    let by_place = |key: &str| keys.by_place.as_ref().is_some_and(|tables| tables.list == key);
    for fault in faults {
        match fault.path.0.as_slice() {
            [] => {}
            [Segment::Key(table), Segment::Key(key), ..]
                if wood.is_some_and(|wood| wood.table == table && wood.apart.contains(&key.as_str())) =>
            {
                remove_below(&mut rest, table, key);
            }
            [Segment::Key(key), ..] | [_, _, Segment::Key(key), ..] if is_wood(key) => forget(&mut rest, keys, key),
            [Segment::Key(list), Segment::Index(i), Segment::Key(key), ..] if by_place(list) => {
                remove_from_item(&mut rest, list, *i, key);
            }
            [Segment::Key(key), ..] if keys.referred_to.contains(&key.as_str()) => return None,
            [Segment::Key(table), Segment::Key(key), ..] => remove_below(&mut rest, table, key),
            [Segment::Key(key), ..] => _ = rest.remove(key),
            _ => return None,
        }
    }
    Some(rest)
}

/// Removes a table from the species and from each of its tables that merge by place.
fn forget(node: &mut Node, keys: &Keys, table: &str) {
    node.remove(table);
    let Some(tables) = &keys.by_place else { return };
    if let Some(Value::Array(items)) = entry_mut(node, tables.list).map(|list| &mut list.value) {
        items.iter_mut().for_each(|item| _ = item.remove(table));
    }
}

fn entry_mut<'n>(node: &'n mut Node, key: &str) -> Option<&'n mut Node> {
    let Value::Table(entries) = &mut node.value else { return None };
    entries.iter_mut().find(|e| e.key == key).map(|e| &mut e.node)
}

fn remove_below(node: &mut Node, table: &str, key: &str) {
    if let Some(table) = entry_mut(node, table) {
        table.remove(key);
    }
}

fn remove_from_item(node: &mut Node, list: &str, i: usize, key: &str) {
    if let Some(Value::Array(items)) = entry_mut(node, list).map(|list| &mut list.value)
        && let Some(item) = items.get_mut(i)
    {
        item.remove(key);
    }
}

/// A model's fault with its file, line and column.
pub fn place(sources: &Sources, node: &Node, fault: fault::Fault) -> Fault {
    let fault::Fault { path, problem, expected } = fault;
    let at_key = node.locate_key(&path).filter(|_| problem.starts_with("unknown"));
    let typed = match (at_key, path.0.last()) {
        (Some(_), Some(Segment::Key(key))) => Some(key.as_str()),
        _ => node.at(&path).and_then(Node::text),
    };
    let near = typed.and_then(|typed| nearest(typed, quoted(&expected)).filter(|near| *near != typed));
    let near = near.map(str::to_owned);
    let span = at_key.unwrap_or_else(|| node.locate(&path));
    if let Some(fault) = in_text(sources, node, &path, &problem, &expected) {
        return fault;
    }
    match in_expression(sources, node, &path, &problem) {
        Some((span, problem)) => Fault::new(span, &path, problem, expected).suggest(near),
        None => Fault::new(span, &path, problem, expected).suggest(near),
    }
}

/// A fault at a line and a column of a text of the species, which are the last two steps of its path. Where the text is
/// written in the species file so that its lines cannot be found, they stand in the message.
fn in_text(sources: &Sources, node: &Node, path: &Path, problem: &str, expected: &str) -> Option<Fault> {
    let [above @ .., Segment::Index(line), Segment::Index(column)] = path.0.as_slice() else { return None };
    let above = Path(above.to_vec());
    let (text, span) = node.at(&above).and_then(|node| Some((node.text()?, node.span)))?;
    let typed = sources.get(span.source).text.get(span.start..span.end).unwrap_or_default();
    let Some(first) = typed.find(text) else {
        let problem = format!("line {line}, column {column}: {problem}");
        return Some(Fault::new(span, &above, problem, expected));
    };
    let start = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum::<usize>();
    let rest = text.get(start..).unwrap_or_default();
    let within: usize = rest.chars().take(column.saturating_sub(1)).map(char::len_utf8).sum();
    let at = &rest[within..];
    let ends = |c: char| c.is_whitespace() || ",:()[]{}".contains(c);
    let word = at.find(ends).unwrap_or(at.len()).max(at.chars().next().map_or(0, char::len_utf8));
    let start = span.start + first + start + within;
    Some(Fault::new(Span { start, end: start + word, ..span }, &above, problem, expected))
}

/// The names that a text offers: the words in quotes or backticks, or those after "one of".
fn quoted(text: &str) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for mark in ['"', '`'] {
        names.extend(text.split(mark).skip(1).step_by(2));
    }
    if let Some(list) = text.strip_prefix("one of ") {
        names.extend(list.split(", "));
    }
    // A number in quotes is an example, not a name.
    names.retain(|name| name.starts_with(char::is_alphabetic));
    names
}

/// The place inside an expression to which "column 8 of the expression: …" points, and the rest of the message. `None`
/// where the text in the file is written so that columns and bytes differ (escapes, several lines).
fn in_expression<'p>(sources: &Sources, node: &Node, path: &Path, problem: &'p str) -> Option<(Span, &'p str)> {
    let (column, words) = problem.strip_prefix("column ")?.split_once(" of the expression: ")?;
    let column: usize = column.parse().ok()?;
    let span = node.at(path).map(|node| node.span)?;
    let typed = sources.get(span.source).text.get(span.start..span.end)?;
    let inside = typed.get(1..typed.len().checked_sub(1)?)?;
    if !inside.is_ascii() || inside.contains(['\\', '\n', '"', '\'']) {
        return None;
    }
    let rest = inside.get(column.checked_sub(1)?..)?;
    let word = rest.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(rest.len()).max(1);
    let start = span.start + column;
    Some((Span { start, end: start + word, ..span }, words))
}
