//! What is wrong with a raster, and where in its file.
//!
//! Absent: the name of the file, which the caller has.

use std::fmt;

/// Where in a file of a raster something is wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Where {
    /// In the line and at the column of a text, from 1.
    Text(usize, usize),
    /// At the byte of a file of bytes, from 0.
    Byte(usize),
}

impl fmt::Display for Where {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Text(line, column) => write!(f, "line {line}, column {column}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// What is wrong with a raster.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{problem} ({at}); expected {expected}")]
pub struct RasterFault {
    /// Where.
    pub at: Where,
    /// What is wrong, in a sentence without a full stop.
    pub problem: String,
    /// What would be right.
    pub expected: String,
}

impl RasterFault {
    pub(crate) fn new(at: Where, problem: impl Into<String>, expected: impl Into<String>) -> Self {
        Self { at, problem: problem.into(), expected: expected.into() }
    }
}
