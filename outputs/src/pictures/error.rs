//! Why plants cannot be drawn as they were asked for.

use crate::tables::TableError;

/// A failure of a picture.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// A picture was to be coloured by a column that `records` does not have.
    #[error("`records` has no column `{column}` to colour by")]
    NoSuchColumn {
        /// The column.
        column: String,
    },
    /// No component that is drawn has a value in the column that a picture was to be coloured by.
    #[error("no component has a value of `{column}` to colour by: {reason}")]
    NothingToColour {
        /// The column.
        column: &'static str,
        /// What its values would need.
        reason: &'static str,
    },
    /// The values of the column cannot be told.
    #[error(transparent)]
    Table(#[from] TableError),
}
