//! The shapes of leaves of Weber & Penn 1995 §4.9, and which of them stands for a leaf of another program.
//!
//! Absent: their meshes.

use crate::mapping::Mapping;
use crate::value::Entry;

/// The oval.
pub(crate) const OVAL: f64 = 0.0;
/// The triangle.
pub(crate) const TRIANGLE: f64 = 1.0;
/// Three lobes of an oak.
pub(crate) const OAK: f64 = 2.0;
/// Five lobes of a maple.
pub(crate) const MAPLE: f64 = 4.0;

/// Gives the tree a leaf.
pub(crate) fn give(mapping: &mut Mapping<'_>, entry: &Entry, shape: f64, note: Option<&str>) {
    mapping.give(entry, &[("LeafShape".to_owned(), shape)], note);
}
