//! What keeps a query from its rows, in words, with the place in the SQL where DataFusion tells one.
//!
//! Absent: the words of DataFusion itself, which are told as they are.

use datafusion::common::{DataFusionError, Span};
use phytomer_outputs::FileError;

/// A query without rows.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The SQL cannot be understood, or names what there is not.
    #[error("{0}")]
    Sql(String),
    /// The SQL would change something.
    #[error("{0}: a query only reads. Expected a SELECT; rows are written by --out")]
    ReadOnly(String),
    /// The memory is too small, and writing to the disk does not help.
    #[error("{0}\nGive the query more memory (--memory), or ask for fewer rows or groups at a time")]
    Memory(String),
    /// It failed while it ran.
    #[error("the query failed: {0}")]
    Run(String),
    /// A run folder cannot be read.
    #[error(transparent)]
    Folder(#[from] phytomer_outputs::Error),
    /// The rows cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
    /// The rows cannot be written in the format.
    #[error("the rows cannot be written: {0}")]
    Write(String),
    /// It was told to stop.
    #[error("interrupted")]
    Interrupted,
}

impl Error {
    /// What DataFusion says of an SQL text before any row is read.
    pub(crate) fn of_sql(sql: &str, error: &DataFusionError) -> Self {
        let words = words_of(error);
        let place = error.diagnostic().and_then(|told| told.span).map(start_and_width).or_else(|| place_in(&words));
        Self::Sql(match place {
            Some(place) => format!("{words}\n{}", shown(sql, place)),
            None => words,
        })
    }

    /// What DataFusion says while a query runs.
    pub(crate) fn of_run(error: &DataFusionError) -> Self {
        match error.find_root() {
            DataFusionError::ResourcesExhausted(words) => Self::Memory(words.clone()),
            _ => Self::Run(words_of(error)),
        }
    }
}

/// The words of an error, without the kinds that DataFusion puts before them.
fn words_of(error: &DataFusionError) -> String {
    let words = error.strip_backtrace();
    let mut left = words.trim();
    for kind in ["SQL error: ", "Error during planning: ", "Schema error: ", "External error: "] {
        left = left.strip_prefix(kind).unwrap_or(left);
    }
    left.strip_prefix("ParserError(\"").and_then(|inner| inner.strip_suffix("\")")).unwrap_or(left).to_owned()
}

/// A line, a column, and a number of columns, each from 1.
type Place = (usize, usize, usize);

fn start_and_width(span: Span) -> Place {
    let (start, end) = (span.start, span.end);
    let width = if start.line == end.line { end.column.saturating_sub(start.column) } else { 1 };
    (start.line as usize, start.column as usize, width.max(1) as usize)
}

/// The place that the words of the parser name: `at Line: 1, Column: 15`.
fn place_in(words: &str) -> Option<Place> {
    let after = words.rsplit_once("at Line: ")?.1;
    let (line, after) = after.split_once(", Column: ")?;
    let digits: String = after.chars().take_while(char::is_ascii_digit).collect();
    Some((line.parse().ok()?, digits.parse().ok()?, 1))
}

/// The line of the SQL with its number, and marks below the place.
fn shown(sql: &str, (line, column, width): Place) -> String {
    let text = sql.lines().nth(line.saturating_sub(1)).unwrap_or_default();
    let text: String = text.chars().map(|character| if character.is_control() { ' ' } else { character }).collect();
    let number = line.to_string();
    let (margin, before) = (" ".repeat(number.len()), " ".repeat(column.saturating_sub(1)));
    let left = text.chars().count().saturating_sub(column.saturating_sub(1)).max(1);
    format!(" {number} | {text}\n {margin} | {before}{}", "^".repeat(width.min(left)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_place_of_the_parser_is_read_from_its_words() {
        assert_eq!(place_in("Expected: an expression, found: EOF at Line: 2, Column: 15"), Some((2, 15, 1)));
        assert_eq!(place_in("nothing of the kind"), None);
        assert_eq!(place_in("at Line: x, Column: 1"), None);
    }

    #[test]
    fn a_place_is_marked_below_its_line() {
        assert_eq!(shown("SELECT a,\n  b c d", (2, 3, 3)), " 2 |   b c d\n   |   ^^^");
        assert_eq!(shown("SELECT", (1, 7, 9)), " 1 | SELECT\n   |       ^");
        assert_eq!(shown("", (9, 1, 1)), " 9 | \n   | ^");
    }
}
