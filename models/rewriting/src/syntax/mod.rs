//! From letters to a tree: what the text says, in its own words. Names are names here; what they mean is the matter of
//! `compile`.

mod expression;
mod file;
mod keyword;
mod lines;
mod module;
mod production;
mod statement;
mod tree;

pub(crate) use expression::Parser;
pub(crate) use file::{File, Section, parse};
pub(crate) use module::{Formal, MOST_PARAMETERS, ModuleText};
pub(crate) use production::Production;
pub(crate) use statement::Statement;
pub(crate) use tree::{Expression, Name, Operator};
