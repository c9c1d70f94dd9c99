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
    /// Components of one plot, of one plant where it has no members, by the last tick, by order from the trunk.
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
    /// Bytes of memory that one plant takes at its end; the largest of those of a plot.
    pub bytes_a_plant: f64,
    /// Bytes of memory that the plants of one plot take at its end, all of which are in memory at once.
    pub bytes_a_plot: f64,
    /// The most components that a plant may have.
    pub component_limit: u32,
    #[serde(skip)]
    work_a_plot: f64,
}

impl Forecast {
    /// The forecast of a run; `None` where the sum for one of its species would take too long.
    pub fn of(resolved: &Resolved) -> Option<Self> {
        let scenario = &resolved.scenario;
        let plot = PlotForecast::of(resolved)?;
        let plots = f64::from(scenario.plots());
        let rows = |table: Table, rows: f64| if scenario.tables.contains(&table) { rows * plots } else { 0.0 };
        let records_rows = rows(Table::Records, plot.shown);
        let summary_rows = rows(Table::Summary, plot.summary_rows);
        let component_rows = rows(Table::Components, plot.components);
        Some(Self {
            plants: scenario.plants,
            components_are: plot.certainty.into(),
            // As if nothing that the plants have made had ended.
            records_rows_are: plot.certainty.max(Certainty::AtMost).into(),
            components: plot.components * plots,
            components_by_order: plot.by_order,
            records_rows,
            summary_rows,
            table_bytes: records_rows * BYTES_A_RECORD
                + component_rows * BYTES_A_COMPONENT_ROW
                + summary_rows * BYTES_A_SUMMARY_ROW,
            bytes_a_plant: plot.largest * BYTES_A_COMPONENT as f64,
            bytes_a_plot: plot.components * BYTES_A_COMPONENT as f64,
            component_limit: scenario.limits.components(),
            work_a_plot: plot.components + if records_rows > 0.0 { plot.shown } else { 0.0 },
        })
    }

    /// The work of one plot, in components that are grown or shown to a table.
    pub fn work_a_plot(&self) -> f64 {
        self.work_a_plot
    }
}

/// What is expected of one plot: the sums over its members, each at its own age.
struct PlotForecast {
    /// Components by the last tick.
    components: f64,
    /// The same by order from the trunk.
    by_order: Vec<f64>,
    /// Components of the largest member.
    largest: f64,
    /// Components by each recorded tick, summed over the ticks.
    shown: f64,
    /// Recorded ticks at which a member is sown, summed over the members.
    summary_rows: f64,
    certainty: Certainty,
}

impl PlotForecast {
    fn of(resolved: &Resolved) -> Option<Self> {
        let scenario = &resolved.scenario;
        let models = resolved.models().into_iter().enumerate();
        let expected = models.map(|(place, model)| model.expectation(scenario.last_age_of_species(place)));
        let expected: Vec<Expectation> = expected.collect::<Option<_>>()?;
        let recorded = scenario.ages.recorded();
        let mut plot = Self {
            components: 0.0,
            by_order: Vec::new(),
            largest: 0.0,
            shown: 0.0,
            summary_rows: 0.0,
            // Events change plants in ways that no expectation knows.
            certainty: if resolved.scenario.event.is_empty() { Certainty::Exact } else { Certainty::About },
        };
        for member in scenario.plot_members() {
            let Some(expected) = expected.get(scenario.species_of(&member)) else { continue };
            plot.add(expected, scenario.ages.until.saturating_sub(member.sown), || {
                recorded.iter().filter_map(|tick| tick.checked_sub(member.sown))
            });
        }
        Some(plot)
    }

    /// Adds a member that reaches the age `until` and is recorded at `ages`.
    fn add<A: Iterator<Item = u32>>(&mut self, expected: &Expectation, until: u32, ages: impl Fn() -> A) {
        let components = expected.components(until);
        self.components += components;
        self.largest = self.largest.max(components);
        self.by_order.resize(self.by_order.len().max(expected.orders.len()), 0.0);
        let of_orders = expected.orders.iter().map(|order| order.components(until));
        self.by_order.iter_mut().zip(of_orders).for_each(|(sum, more)| *sum += more);
        self.shown += ages().map(|age| expected.components(age)).sum::<f64>();
        self.summary_rows += ages().count() as f64;
        self.certainty = self.certainty.max(expected.certainty());
    }
}
