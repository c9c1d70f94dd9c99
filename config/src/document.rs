//! A TOML file as a tree in which every key and value has its file and its range of bytes in the file.
//!
//! The toml crate's own tree does not serve: a species is merged from several files (`inherit`), and each value must
//! still point into its own file. Every fault that the parser finds is reported, but only the first fault of a line:
//! recovery after a mistake finds more on the same line that only follow from it. Absent: the meaning of keys, which
//! the schema states.

use phytomer_law::fault::{Path, Segment};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::report::{Fault, MOST_FAULTS};
use crate::source::{SourceId, Sources, Span};

/// The deepest nesting of tables and arrays; no species needs a quarter of it.
pub const MAX_DEPTH: usize = 48;

/// A value and where it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// The bytes of the value; of a table with a header, the header; of a table made by dotted keys, its key.
    pub span: Span,
    /// The value.
    pub value: Value,
}

/// A TOML value.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A string.
    Text(String),
    /// A whole number.
    Integer(i64),
    /// A number with a point or an exponent; finite.
    Float(f64),
    /// `true` or `false`.
    Boolean(bool),
    /// A date or time; no key of a species or a scenario takes such a value.
    Date(String),
    /// An array or an array of tables.
    Array(Vec<Node>),
    /// A table, in the order of the file.
    Table(Vec<Entry>),
}

/// A key of a table with its value.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// The key, unquoted.
    pub key: String,
    /// Where the key stands.
    pub key_span: Span,
    /// Its value.
    pub node: Node,
}

impl Node {
    /// The entries of a table, in the order of the file; empty for any other value.
    pub fn entries(&self) -> &[Entry] {
        match &self.value {
            Value::Table(entries) => entries,
            _ => &[],
        }
    }

    /// The entry of a table with the key `key`; `None` where the table has no such key, or the value is no table. One
    /// pass over the entries.
    pub fn entry(&self, key: &str) -> Option<&Entry> {
        self.entries().iter().find(|e| e.key == key)
    }

    /// The value of a table's key; `None` where there is no such key, or the value is no table.
    pub fn get(&self, key: &str) -> Option<&Node> {
        self.entry(key).map(|e| &e.node)
    }

    /// The items of an array, in their order; empty for any other value.
    pub fn items(&self) -> &[Node] {
        match &self.value {
            Value::Array(items) => items,
            _ => &[],
        }
    }

    /// The text of a string; `None` for any other value.
    pub fn text(&self) -> Option<&str> {
        match &self.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// Removes a key from a table and returns its entry; `None` where there is no such key.
    pub fn remove(&mut self, key: &str) -> Option<Entry> {
        let Value::Table(entries) = &mut self.value else { return None };
        let at = entries.iter().position(|e| e.key == key)?;
        Some(entries.remove(at))
    }

    /// The span of the last key of `path`; `None` where `path` does not lead to a key.
    pub fn locate_key(&self, path: &Path) -> Option<Span> {
        let (last, above) = path.0.split_last()?;
        let Segment::Key(key) = last else { return None };
        let (table, true) = self.follow(above) else { return None };
        table.entry(key).map(|e| e.key_span)
    }

    /// The value at `path`; `None` where `path` leads to no value.
    pub fn at(&self, path: &Path) -> Option<&Node> {
        let (node, whole) = self.follow(&path.0);
        whole.then_some(node)
    }

    /// The span of the value at `path`, or of the last value on the way where `path` leads to no value.
    pub fn locate(&self, path: &Path) -> Span {
        self.follow(&path.0).0.span
    }

    /// The last value on the way along `path`, and whether the whole path was followed.
    fn follow(&self, path: &[Segment]) -> (&Node, bool) {
        let mut node = self;
        for segment in path {
            let next = match (segment, &node.value) {
                (Segment::Key(key), Value::Table(_)) => node.get(key),
                (Segment::Index(i), Value::Array(items)) => items.get(*i),
                _ => None,
            };
            match next {
                Some(next) => node = next,
                None => return (node, false),
            }
        }
        (node, true)
    }

    /// The tree as JSON, without spans, for serde.
    pub fn to_json(&self) -> serde_json::Value {
        match &self.value {
            Value::Text(text) | Value::Date(text) => text.clone().into(),
            Value::Integer(n) => (*n).into(),
            Value::Float(x) => (*x).into(),
            Value::Boolean(b) => (*b).into(),
            Value::Array(items) => items.iter().map(Node::to_json).collect(),
            Value::Table(entries) => entries.iter().map(|e| (e.key.clone(), e.node.to_json())).collect(),
        }
    }
}

/// The tree of a source. Syntax faults go into `faults`; the tree then holds what could be understood, or is `None`
/// where further reading would only report consequences of a mistake.
pub fn parse(sources: &Sources, id: SourceId, faults: &mut Vec<Fault>) -> Option<Node> {
    let text = &sources.get(id).text;
    let (table, errors) = DeTable::parse_recoverable(text);
    let mut syntax = Vec::new();
    let mut whole = true;
    for error in errors.into_iter().take(MOST_FAULTS) {
        let (fault, harmless) = syntax_fault(id, text, &error);
        whole &= harmless;
        syntax.push(fault);
    }
    let mut reader = Reader { id, faults: Vec::new(), too_deep: false };
    let root = Span { source: id, start: 0, end: 0 };
    let node = Node { span: root, value: Value::Table(reader.table(table.into_inner(), 1)) };
    faults.extend(first_of_each_line(sources, syntax));
    if whole {
        faults.extend(reader.faults);
    }
    (whole && !reader.too_deep).then_some(node)
}

/// A parser's error as a fault, and whether the tree can be used after it.
fn syntax_fault(id: SourceId, text: &str, error: &toml::de::Error) -> (Fault, bool) {
    let range = error.span().unwrap_or(0..0);
    let span = Span { source: id, start: range.start, end: range.end };
    let (problem, expected) = error.message().split_once(", expected ").unwrap_or((error.message(), ""));
    let key = || text.get(range.clone()).unwrap_or("?").trim();
    let (problem, expected) = match (problem, expected) {
        ("duplicate key", _) => (format!("the key `{}` is given twice", key()), "each key once in its table"),
        ("cannot recurse further; max recursion depth met" | "recursion limit", _) => {
            ("nested too deep".to_owned(), "fewer levels of tables and lists")
        }
        ("string values must be quoted", _) if value_is_absent(text, range.start) => {
            ("there is no value".to_owned(), "a value after `=`")
        }
        ("unexpected key or value", _) if is_decimal_comma(text, range.start) => {
            ("this number has a comma".to_owned(), "a decimal point, as in `0.92`")
        }
        (other, "literal string") => (other.to_owned(), "a text in quotes"),
        (other, "nothing") => (other.to_owned(), "nothing more here"),
        (other, "") => (other.to_owned(), "TOML (https://toml.io)"),
        (other, expected) => (other.to_owned(), expected),
    };
    (Fault::new(span, &Path::root(), problem, expected), error.message().starts_with("duplicate key"))
}

fn value_is_absent(text: &str, at: usize) -> bool {
    text.get(at..).and_then(|rest| rest.lines().next()).unwrap_or("").trim().is_empty()
}

/// Whether a comma stands at `at` between two digits.
fn is_decimal_comma(text: &str, at: usize) -> bool {
    let digit = |b: Option<&u8>| b.is_some_and(u8::is_ascii_digit);
    let bytes = text.as_bytes();
    bytes.get(at) == Some(&b',') && at > 0 && digit(bytes.get(at - 1)) && digit(bytes.get(at + 1))
}

/// The first fault of each line: the rest of a line's syntax faults follow from it.
fn first_of_each_line(sources: &Sources, mut faults: Vec<Fault>) -> Vec<Fault> {
    faults.sort_by_key(|f| f.span);
    let mut last = 0;
    faults.retain(|fault| {
        let line = fault.span.map_or(0, |span| sources.line(span));
        std::mem::replace(&mut last, line) != line
    });
    faults
}

struct Reader {
    id: SourceId,
    faults: Vec<Fault>,
    too_deep: bool,
}

impl Reader {
    fn span(&self, range: std::ops::Range<usize>) -> Span {
        Span { source: self.id, start: range.start, end: range.end }
    }

    fn table(&mut self, table: DeTable<'_>, depth: usize) -> Vec<Entry> {
        let mut entries = Vec::with_capacity(table.len());
        for (key, value) in table {
            let key_span = self.span(key.span());
            let node = self.node(value, key_span, depth);
            entries.push(Entry { key: key.into_inner().into_owned(), key_span, node });
        }
        entries.sort_by_key(|e| e.key_span);
        entries
    }

    fn node(&mut self, value: Spanned<DeValue<'_>>, key: Span, depth: usize) -> Node {
        let range = value.span();
        let span = if range.is_empty() { key } else { self.span(range) };
        if depth > MAX_DEPTH {
            self.too_deep = true;
            self.fault(span, "nested too deep", format!("at most {MAX_DEPTH} levels of tables and lists"));
            return Node { span, value: Value::Table(Vec::new()) };
        }
        let value = match value.into_inner() {
            DeValue::String(text) => Value::Text(text.into_owned()),
            DeValue::Integer(n) => self.integer(n.as_str(), n.radix(), span),
            DeValue::Float(x) => self.float(x.as_str(), span),
            DeValue::Boolean(b) => Value::Boolean(b),
            DeValue::Datetime(date) => Value::Date(date.to_string()),
            DeValue::Array(items) => {
                Value::Array(items.into_iter().map(|item| self.node(item, span, depth + 1)).collect())
            }
            DeValue::Table(table) => Value::Table(self.table(table, depth + 1)),
        };
        Node { span, value }
    }

    fn integer(&mut self, digits: &str, radix: u32, span: Span) -> Value {
        Value::Integer(i64::from_str_radix(digits, radix).unwrap_or_else(|_| {
            self.fault(span, "this whole number is too large", "at most 9223372036854775807 in size");
            0
        }))
    }

    fn float(&mut self, digits: &str, span: Span) -> Value {
        let x = digits.parse().unwrap_or(f64::NAN);
        if !x.is_finite() {
            let problem = if x.is_nan() { "this is not a number" } else { "this number is infinite" };
            self.fault(span, problem, "a finite number");
            return Value::Float(0.0);
        }
        Value::Float(x)
    }

    fn fault(&mut self, span: Span, problem: &str, expected: impl Into<String>) {
        self.faults.push(Fault::new(span, &Path::root(), problem, expected));
    }
}
