//! Measures of nodes: nodes per growth unit and nodes per axis, of what had grown by the end of the run.
//!
//! Internodes of an axis are counted in the order of `components`; a growth unit begins where `unit_rank` is 1. Growth
//! units without nodes leave no internode and are not counted. An axis is counted from its bud on, with no node too.
//! Axes that still grow are counted as they stand. Unit: nodes; means of units within plants. Absent: laws of the
//! counts.

use super::columns::Columns;
use super::fault::Fault;
use super::source::Source;
use super::stream::{RowOf, Unit};
use phytomer_measures::moments::Moments;
use phytomer_outputs::Table;
use std::collections::BTreeMap;

/// What nodes are counted on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Nodes {
    /// A growth unit.
    PerUnit,
    /// An axis.
    PerAxis,
}

impl Nodes {
    /// The columns by which nodes are grouped.
    pub const GROUPS: [&'static str; 3] = ["order", "state", "origin"];
}

/// The axes of a plant with the nodes that were counted last, and the moments of what is complete.
#[derive(Default)]
pub(super) struct OfPlant {
    counting: BTreeMap<i32, u32>,
    complete: Moments,
}

impl OfPlant {
    /// The moments, with what is still counted.
    pub fn moments(mut self) -> Moments {
        self.counting.values().for_each(|nodes| self.complete.add(f64::from(*nodes)));
        self.complete
    }
}

/// An internode with its rank in the growth unit, or an apical bud.
pub(super) struct Row {
    axis: i32,
    unit_rank: Option<i32>,
}

impl Unit for Nodes {
    type Row = Row;
    type OfPlant = OfPlant;

    fn table(&self) -> Table {
        Table::Components
    }

    fn columns(&self) -> Vec<&'static str> {
        vec!["axis_id", "kind", "unit_rank"]
    }

    fn rows<'a>(&'a self, _: &'a Source, columns: &'a Columns<'a>) -> Result<RowOf<'a, Row>, Fault> {
        let (kinds, axis, rank) = (columns.words("kind")?, columns.ints("axis_id")?, columns.ints("unit_rank")?);
        let of: Vec<(bool, bool)> =
            kinds.words.iter().map(|kind| (kind.ends_with("internode"), kind == "apical_bud")).collect();
        Ok(Box::new(move |row| {
            let (is_internode, is_bud) = of[kinds.at(row)?];
            let unit_rank = is_internode.then(|| rank[row]);
            (is_internode || (is_bud && *self == Self::PerAxis)).then(|| Row { axis: axis[row], unit_rank })
        }))
    }

    fn add(&self, own: &mut OfPlant, row: Row) {
        let nodes = own.counting.get(&row.axis).copied().unwrap_or(0);
        let begins = *self == Self::PerUnit && row.unit_rank == Some(1) && nodes > 0;
        if begins {
            own.complete.add(f64::from(nodes));
        }
        let before = if begins { 0 } else { nodes };
        own.counting.insert(row.axis, before + u32::from(row.unit_rank.is_some()));
    }
}
