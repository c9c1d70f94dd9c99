//! From the letters of a file to those of a program: macros, conditions, included files.
//!
//! What comes out is one sequence of letters, each with the place from which it is told in faults. The meaning of the
//! letters is the matter of `syntax`.

mod condition;
mod directives;
mod macros;
mod strange;

pub(crate) use directives::{Asked, Prepared, prepare};
