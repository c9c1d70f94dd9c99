//! The calendars of the replicates of a treatment: one that all of them have, or one for each.
//!
//! Replicates that grow in different years, or on soils that supply different nitrogen, have calendars of their own.
//! Absent: how a calendar is made (`calendar`).

use super::calendar::Calendar;
use std::sync::Arc;

/// The calendars of the replicates of a treatment; without any, ticks have no dates.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Calendars(Vec<Arc<Calendar>>);

impl Calendars {
    /// The calendars of the replicates in their order. The replicates after the last have that of the last, so one
    /// calendar is that of all replicates.
    pub fn new(of_replicates: Vec<Arc<Calendar>>) -> Self {
        Self(of_replicates)
    }

    /// The calendar of a replicate; `None` where ticks have no dates.
    pub fn of(&self, replicate: u32) -> Option<&Arc<Calendar>> {
        self.0.get(replicate as usize).or(self.0.last())
    }

    /// All of them: none, one, or one for each replicate.
    pub fn all(&self) -> &[Arc<Calendar>] {
        &self.0
    }
}

impl From<Calendar> for Calendars {
    fn from(of_all: Calendar) -> Self {
        Self(vec![Arc::new(of_all)])
    }
}
