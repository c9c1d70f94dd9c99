//! From letters to a tree of items, productions and expressions.
//!
//! Names stay as they are written. Absent: the preparation of the letters (`text`), and what names mean (`compile`).

mod expression;
mod file;
mod keyword;
mod lines;
mod module;
mod plain;
mod production;
mod statement;
mod tree;

pub(crate) use expression::Parser;
pub(crate) use file::{File, Section, parse};
pub(crate) use module::{Formal, ModuleText};
pub(crate) use plain::plain;
pub(crate) use production::Production;
pub(crate) use statement::Statement;
pub(crate) use tree::{Expression, Name, Operator};
