//! The tables of a run: what there is, what a scenario that names none has, and what goes with those that it names.
//!
//! Absent: their columns, and how they are written, which are `outputs`'.

use super::Scenario;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// A table of the run folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Table {
    /// A row per component that ever lived.
    Components,
    /// A row per living component per recorded age, with its pose.
    Records,
    /// What became of the buds.
    Events,
    /// A row per plant per age.
    Summary,
    /// A row per plant, with its place in the plot.
    Plants,
}

/// Every table, for a scenario that names none.
pub(super) fn all() -> BTreeSet<Table> {
    BTreeSet::from([Table::Components, Table::Records, Table::Events, Table::Summary, Table::Plants])
}

impl Scenario {
    /// The tables that are written: those that are asked for, and with any of them `plants`. Without the places of the
    /// plants none of the others tells where anything stands.
    pub fn written_tables(&self) -> BTreeSet<Table> {
        let plants = (!self.tables.is_empty()).then_some(Table::Plants);
        self.tables.iter().copied().chain(plants).collect()
    }
}
