//! What a run will come to, before its first tick, from the closed-form expectation of its model (`--dry-run`).
//!
//! Each figure says what it is: the expectation, a bound of it from above, or an estimate. The means are of what plants
//! have *made*; what they have shed by a recorded age is counted as if it still stood, so that the rows of `records`
//! are a bound from above. Absent: memory and time, which the machine decides.

use phytomer_config::scenario::{BYTES_A_COMPONENT, Table};
use phytomer_config::{Resolved, Scenario, Treatment, Trial};
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
            Certainty::AtMost | Certainty::Bound => Self::AtMost,
            Certainty::About => Self::About,
        }
    }
}

/// What is expected of a run.
#[derive(Debug, Clone, Serialize)]
pub struct Forecast {
    /// Plants of the run.
    pub plants: u32,
    /// Plants with rows in `components`, `records` and `events`.
    pub sampled: u32,
    /// Components of one plot, of one plant where it has no members, by the last tick, by order from the trunk; of an
    /// experiment of the mean plot.
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
    /// What is expected of each treatment; empty where one grows alone.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub treatments: Vec<OfTreatment>,
    /// Whether the number of axes is but a bound from above, which may be far from what grows: nothing is then decided
    /// by it.
    #[serde(skip)]
    pub is_loose: bool,
    #[serde(skip)]
    work_a_plot: f64,
}

/// What is expected of all replicates of a treatment.
#[derive(Debug, Clone, Serialize)]
pub struct OfTreatment {
    /// The treatment.
    pub name: String,
    /// Its plants.
    pub plants: u32,
    /// Their components by the last age.
    pub components: f64,
    /// Their rows of `records`.
    pub records_rows: f64,
    /// Their rows of `summary`.
    pub summary_rows: f64,
    /// Bytes of their tables, about.
    pub table_bytes: f64,
}

impl Forecast {
    /// The forecast of a run; `None` where the sum for one of its species would take too long.
    pub fn of(resolved: &Resolved) -> Option<Self> {
        let trial = resolved.trial();
        let plots = plots_of(resolved, &trial)?;
        let treatments: Vec<OfTreatment> =
            trial.treatments().iter().zip(&plots).map(|(treatment, plot)| plot.of_all(&trial, treatment)).collect();
        let mean = PlotForecast::of_trial(&trial, &plots);
        let sum = |of: fn(&OfTreatment) -> f64| treatments.iter().map(of).fold(0.0, |sum, more| sum + more);
        let records_rows = sum(|of| of.records_rows);
        let most = |of: fn(&PlotForecast) -> f64| plots.iter().map(of).fold(0.0, f64::max);
        let of_scenario = &resolved.scenario;
        let sampled = sampled_share(of_scenario);
        Some(Self {
            plants: trial.plants(),
            sampled: (f64::from(trial.plants()) * sampled).round() as u32,
            components_are: mean.certainty.into(),
            // As if nothing that the plants have made had ended.
            records_rows_are: mean.certainty.max(Certainty::AtMost).into(),
            components: sum(|of| of.components),
            components_by_order: mean.by_order,
            records_rows,
            summary_rows: sum(|of| of.summary_rows),
            table_bytes: sum(|of| of.table_bytes),
            bytes_a_plant: most(|plot| plot.largest) * BYTES_A_COMPONENT as f64,
            bytes_a_plot: most(|plot| plot.components) * BYTES_A_COMPONENT as f64,
            component_limit: of_scenario.limits.components(),
            is_loose: plots.iter().any(|plot| plot.is_loose),
            work_a_plot: mean.components + if records_rows > 0.0 { mean.shown * sampled } else { 0.0 },
            treatments: if treatments.len() > 1 { treatments } else { Vec::new() },
        })
    }

    /// The work of one plot, in components that are grown or shown to a table.
    pub fn work_a_plot(&self) -> f64 {
        self.work_a_plot
    }
}

/// The share of the plants of a scenario with rows in `components`, `records` and `events`.
fn sampled_share(scenario: &Scenario) -> f64 {
    f64::from(scenario.sampled()) / f64::from(scenario.plants.max(1))
}

/// What is expected of a plot of each treatment.
fn plots_of(resolved: &Resolved, trial: &Trial) -> Option<Vec<PlotForecast>> {
    let models = trial.cohorts().iter().zip(resolved.models());
    let expected: Vec<Expectation> =
        models.map(|(cohort, model)| model.expectation(cohort.until)).collect::<Option<_>>()?;
    let recorded = resolved.scenario.ages.recorded();
    let plot = |(place, treatment): (usize, &Treatment)| {
        let rows = trial.rows_of_cohorts(place);
        let weight = 1.0 / rows.len().max(1) as f64;
        let of_rows =
            rows.iter().map(|cohorts| (weight, PlotForecast::of(&treatment.scenario, cohorts, &expected, &recorded)));
        PlotForecast::mean(&of_rows.collect::<Vec<_>>())
    };
    Some(trial.treatments().iter().enumerate().map(plot).collect())
}

/// What is expected of one plot: the sums over its members, each at its own age.
#[derive(Clone)]
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
    /// Whether nothing but a bound is known of the axes of a member.
    is_loose: bool,
}

impl PlotForecast {
    const NOTHING: Self = Self {
        components: 0.0,
        by_order: Vec::new(),
        largest: 0.0,
        shown: 0.0,
        summary_rows: 0.0,
        certainty: Certainty::Exact,
        is_loose: false,
    };

    /// The plot of a scenario whose members are of these cohorts.
    fn of(scenario: &Scenario, cohorts: &[usize], expected: &[Expectation], recorded: &[u32]) -> Self {
        // No closed form knows which plants a pest attacks, what events take off, or what light buds will have.
        let foreseen = scenario.pest.is_empty() && scenario.event.is_empty() && scenario.light.is_none();
        let certainty = if foreseen { Certainty::Exact } else { Certainty::About };
        let mut plot = Self { certainty, ..Self::NOTHING };
        for (member, cohort) in scenario.plot_members().into_iter().zip(cohorts) {
            let Some(expected) = expected.get(*cohort) else { continue };
            plot.add(expected, scenario.ages.until.saturating_sub(member.sown), || {
                recorded.iter().filter_map(|tick| tick.checked_sub(member.sown))
            });
        }
        plot.germinated(scenario.planting.germination / 100.0)
    }

    /// The same where a share of the seeds germinates, on which growth does not depend.
    fn germinated(mut self, share: f64) -> Self {
        self.by_order.iter_mut().for_each(|components| *components *= share);
        self.components *= share;
        self.shown *= share;
        self.summary_rows *= share;
        self
    }

    /// The mean plot of a trial: that of each treatment weighs as many as it has.
    fn of_trial(trial: &Trial, plots: &[Self]) -> Self {
        let weighed = trial.treatments().iter().zip(plots).map(|(treatment, plot)| {
            let of_treatment = u64::from(treatment.scenario.plots()) * u64::from(trial.replicates());
            (of_treatment as f64 / f64::from(trial.plots().max(1)), plot.clone())
        });
        Self::mean(&weighed.collect::<Vec<_>>())
    }

    /// The mean of plots with their weights; its largest member is that of all.
    fn mean(plots: &[(f64, Self)]) -> Self {
        let mut mean = Self::NOTHING;
        for (weight, plot) in plots {
            mean.components += weight * plot.components;
            mean.shown += weight * plot.shown;
            mean.summary_rows += weight * plot.summary_rows;
            mean.largest = mean.largest.max(plot.largest);
            mean.by_order.resize(mean.by_order.len().max(plot.by_order.len()), 0.0);
            mean.by_order.iter_mut().zip(&plot.by_order).for_each(|(sum, more)| *sum += weight * more);
            mean.certainty = mean.certainty.max(plot.certainty);
            mean.is_loose |= plot.is_loose;
        }
        mean
    }

    /// What is expected of all plots of a treatment, each of which is like this.
    fn of_all(&self, trial: &Trial, Treatment { name, scenario, .. }: &Treatment) -> OfTreatment {
        let plots = f64::from(scenario.plots()) * f64::from(trial.replicates());
        let rows = |table: Table, rows: f64| if scenario.tables.contains(&table) { rows * plots } else { 0.0 };
        let sampled = sampled_share(scenario);
        let records_rows = rows(Table::Records, self.shown * sampled);
        let summary_rows = rows(Table::Summary, self.summary_rows);
        let table_bytes = records_rows * BYTES_A_RECORD
            + rows(Table::Components, self.components * sampled) * BYTES_A_COMPONENT_ROW
            + summary_rows * BYTES_A_SUMMARY_ROW;
        let plants = scenario.plants.saturating_mul(trial.replicates());
        let components = self.components * plots;
        OfTreatment { name: name.clone(), plants, components, records_rows, summary_rows, table_bytes }
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
        self.is_loose |= expected.axes == Certainty::Bound;
    }
}
