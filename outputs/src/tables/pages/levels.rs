//! Which rows of a column have a value, and the definition levels that say so in its pages.
//!
//! Absent: repetition levels, since no column has lists.

use super::hybrid::{put, put_run};
use std::borrow::Cow;
use std::ops::Range;

/// Which rows have a value.
#[derive(Debug, PartialEq, Eq)]
pub enum Levels {
    /// Every row, in a column that is never null.
    Always(usize),
    /// Every row, or none, in a column that may be null.
    Alike { rows: usize, present: bool },
    /// 1 for a row with a value, 0 for null.
    Mixed(Vec<u8>),
}

impl Levels {
    /// The levels of a column with these values, of which some do not apply if it may be null.
    pub fn of<T: Copy>(values: &[T], nullable: bool, applies: impl Fn(T) -> bool) -> Self {
        let rows = values.len();
        if !nullable {
            return Self::Always(rows);
        }
        let levels: Vec<u8> = values.iter().map(|value| u8::from(applies(*value))).collect();
        match levels.iter().map(|level| u64::from(*level)).sum::<u64>() {
            present if present == rows as u64 => Self::Alike { rows, present: true },
            0 => Self::Alike { rows, present: false },
            _ => Self::Mixed(levels),
        }
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        match self {
            Self::Always(rows) | Self::Alike { rows, .. } => *rows,
            Self::Mixed(levels) => levels.len(),
        }
    }

    /// The number of values in some rows.
    pub fn present(&self, rows: Range<usize>) -> usize {
        match self {
            Self::Always(_) | Self::Alike { present: true, .. } => rows.len(),
            Self::Alike { present: false, .. } => 0,
            Self::Mixed(levels) => levels[rows].iter().map(|level| u64::from(*level)).sum::<u64>() as usize,
        }
    }

    /// The values without the nulls between them.
    pub fn values<'a, T: Copy>(&self, values: &'a [T]) -> Cow<'a, [T]> {
        match self {
            Self::Always(_) | Self::Alike { present: true, .. } => Cow::Borrowed(values),
            Self::Alike { present: false, .. } => Cow::Borrowed(&[]),
            Self::Mixed(levels) => {
                let mut present = Vec::with_capacity(values.len());
                present.extend(values.iter().zip(levels).filter(|(_, level)| **level != 0).map(|(value, _)| *value));
                Cow::Owned(present)
            }
        }
    }

    /// Adds the levels of some rows, after their length in bytes; nothing of a column that is never null.
    pub fn put(&self, rows: Range<usize>, out: &mut Vec<u8>) {
        let from = out.len();
        match self {
            Self::Always(_) => return,
            Self::Alike { present, .. } => {
                out.extend([0; 4]);
                put_run(u32::from(*present), rows.len(), 1, out);
            }
            Self::Mixed(levels) => {
                out.extend([0; 4]);
                put(&levels[rows], 1, out);
            }
        }
        let bytes = (out.len() - from - 4) as u32;
        out[from..from + 4].copy_from_slice(&bytes.to_le_bytes());
    }
}
