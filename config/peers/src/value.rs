//! The values that files of trees are made of, each with its bytes in the text.
//!
//! Absent: which key wants which value (`mapping`).

use std::ops::Range;

/// A value and where it stands.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Node {
    /// What it is.
    pub value: Value,
    /// Its bytes.
    pub bytes: Range<usize>,
}

/// A value of a file.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Value {
    /// A finite number.
    Number(f64),
    /// A text.
    Text(String),
    /// True or false.
    Bool(bool),
    /// `None` or `null`.
    Nothing,
    /// A list or a tuple.
    List(Vec<Node>),
    /// A dictionary, in the order of the file.
    Map(Vec<Entry>),
}

/// A key with its value.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Entry {
    /// The key.
    pub key: String,
    /// The bytes of the key.
    pub at: Range<usize>,
    /// What is stated.
    pub node: Node,
}

impl Value {
    /// What sort of value it is.
    pub fn sort(&self) -> &'static str {
        match self {
            Self::Number(_) => "a number",
            Self::Text(_) => "a text",
            Self::Bool(_) => "true or false",
            Self::Nothing => "nothing",
            Self::List(_) => "a list",
            Self::Map(_) => "a dictionary",
        }
    }
}
