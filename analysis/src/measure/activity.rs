//! Measure of activity: the share of the clock steps at which a living bud grew and did not pause.
//!
//! b = grew / (grew + paused) over the rows of `events` (de Reffye et al. 1988 §3), a mean of buds' steps within
//! plants. Unit: share of steps. A bud that dies at a step is no part of it. Absent: the estimate from counts of nodes
//! alone, which is a fit and not a measure.

use super::columns::Columns;
use super::fault::Fault;
use super::source::Source;
use super::stream::{RowOf, Unit};
use phytomer_measures::moments::Moments;
use phytomer_outputs::Table;

/// The steps of buds.
pub(super) struct Steps;

impl Steps {
    /// The columns by which steps are grouped.
    pub const GROUPS: [&'static str; 3] = ["order", "state", "age"];
}

impl Unit for Steps {
    type Row = f64;
    type OfPlant = Moments;

    fn table(&self) -> Table {
        Table::Events
    }

    fn columns(&self) -> Vec<&'static str> {
        vec!["event"]
    }

    fn rows<'a>(&'a self, _: &'a Source, columns: &'a Columns<'a>) -> Result<RowOf<'a, f64>, Fault> {
        let events = columns.words("event")?;
        let grew: Vec<Option<f64>> = events.words.iter().map(|event| value(event)).collect();
        Ok(Box::new(move |row| events.at(row).and_then(|event| grew[event])))
    }

    fn add(&self, own: &mut Moments, row: f64) {
        own.add(row);
    }
}

fn value(event: &str) -> Option<f64> {
    match event {
        "grew" => Some(1.0),
        "paused" => Some(0.0),
        _ => None,
    }
}
