//! The tables of a run: their names, the default of a scenario that names none, and the tables that are always added.
//!
//! Absent: the columns of the tables, and writing them (`phytomer_outputs`).

use super::Scenario;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// A table of the run folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Table {
    /// A row per component that ever lived: its identity, birth and fate.
    Components,
    /// A row per living component per recorded age, with its pose.
    Records,
    /// A row per fate of a bud or a branch.
    Events,
    /// A row per plant per recorded age.
    Summary,
    /// A row per plant, with its species and its place in the plot.
    Plants,
    /// A row per treatment, with its level of each factor.
    Treatments,
    /// A row per treatment, replicate and recorded tick, with its date and what the date brings.
    Site,
}

/// Every table, for a scenario that names none.
pub(crate) fn all() -> BTreeSet<Table> {
    BTreeSet::from([
        Table::Components,
        Table::Records,
        Table::Events,
        Table::Summary,
        Table::Plants,
        Table::Treatments,
        Table::Site,
    ])
}

impl Scenario {
    /// The tables that are written: those of the scenario, and with any of them `plants`, without which the place of a
    /// plant is unknown, and `treatments`, without which its levels are.
    pub fn written_tables(&self) -> BTreeSet<Table> {
        let with_any = [Table::Plants, Table::Treatments].into_iter().filter(|_| !self.tables.is_empty());
        self.tables.iter().copied().chain(with_any).collect()
    }
}
