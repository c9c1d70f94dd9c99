//! What a run will come to, before its first tick, from the closed-form expectation of its model (`--dry-run`).
//!
//! Each figure says what it is: the expectation, a bound of it from above, or an estimate. The means are of what plants
//! have *made*; what they have shed by a recorded age is counted as if it still stood, so that the rows of `records`
//! are a bound from above. Absent: memory and time, which the machine decides.

use phytomer_config::Resolved;
use phytomer_config::scenario::{BYTES_A_COMPONENT, Table};
use phytomer_sim::expectation::{Certainty, Expectation};
use serde::Serialize;

/// Bytes of a row of `records`, compressed: measured on trees (docs/performance.md).
pub const BYTES_A_RECORD: f64 = 31.0;

/// Bytes of a row of `components`, of `events` and of `summary`, likewise.
const BYTES_A_COMPONENT_ROW: f64 = 20.0;
const BYTES_A_SUMMARY_ROW: f64 = 60.0;

/// What a figure of a forecast is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Figure {
    /// The expectation.
    Exact,
    /// The expectation is not above it.
    AtMost,
    /// An estimate.
    About,
}

impl Figure {
    /// The word before the number; none before an expectation.
    pub fn word(self) -> &'static str {
        match self {
            Self::Exact => "",
            Self::AtMost => "at most",
            Self::About => "about",
        }
    }
}

impl From<Certainty> for Figure {
    fn from(certainty: Certainty) -> Self {
        match certainty {
            Certainty::Exact => Self::Exact,
            Certainty::AtMost => Self::AtMost,
            Certainty::About => Self::About,
        }
    }
}

/// What is expected of a run.
#[derive(Debug, Clone, Serialize)]
pub struct Forecast {
    /// Plants of the run.
    pub plants: u32,
    /// Components of one plant by the last age, by order from the trunk.
    pub components_by_order: Vec<f64>,
    /// Components of all plants by the last age.
    pub components: f64,
    /// What these numbers of components are.
    pub components_are: Figure,
    /// Rows of `records`.
    pub records_rows: f64,
    /// What that number of rows is.
    pub records_rows_are: Figure,
    /// Rows of `summary`.
    pub summary_rows: f64,
    /// Bytes of the tables, about; events are not foreseen.
    pub table_bytes: f64,
    /// Bytes of memory that one plant takes at its end.
    pub bytes_a_plant: f64,
    /// The most components that a plant may have.
    pub component_limit: u32,
    #[serde(skip)]
    shown_a_plant: f64,
}

impl Forecast {
    /// The forecast of a run; `None` where the sum for its species would take too long.
    pub fn of(resolved: &Resolved) -> Option<Self> {
        let scenario = &resolved.scenario;
        let until = scenario.ages.until;
        let expected: Expectation = resolved.model.expectation(until)?;
        let plants = f64::from(scenario.plants);
        let components_by_order: Vec<f64> = expected.orders.iter().map(|order| order.components(until)).collect();
        let a_plant = expected.components(until);
        let recorded = scenario.ages.recorded();
        let shown_a_plant: f64 = recorded.iter().map(|age| expected.components(*age)).sum();
        let rows = |table: Table, rows: f64| if scenario.tables.contains(&table) { rows * plants } else { 0.0 };
        let records_rows = rows(Table::Records, shown_a_plant);
        let summary_rows = rows(Table::Summary, recorded.len() as f64);
        let component_rows = rows(Table::Components, a_plant);
        let certainty = expected.certainty();
        Some(Self {
            plants: scenario.plants,
            components_are: certainty.into(),
            // As if nothing that the plants have made had ended.
            records_rows_are: certainty.max(Certainty::AtMost).into(),
            components: a_plant * plants,
            components_by_order,
            records_rows,
            summary_rows,
            table_bytes: records_rows * BYTES_A_RECORD
                + component_rows * BYTES_A_COMPONENT_ROW
                + summary_rows * BYTES_A_SUMMARY_ROW,
            bytes_a_plant: a_plant * BYTES_A_COMPONENT as f64,
            component_limit: scenario.limits.components(),
            shown_a_plant,
        })
    }

    /// The work of one plant, in components that are grown or shown to a table.
    pub fn work_a_plant(&self) -> f64 {
        let grown = self.components / f64::from(self.plants.max(1));
        grown + if self.records_rows > 0.0 { self.shown_a_plant } else { 0.0 }
    }
}
