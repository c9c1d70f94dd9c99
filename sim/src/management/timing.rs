//! When an operation is done: at a tick of the plot or an age of the plant, when a condition first holds, again and
//! again.
//!
//! An operation of tick t is done between the ticks t − 1 and t: on the plant as it stood at the end of t − 1, and what
//! it takes does not stand at t any more. Dates of a calendar become ticks of the plot before they come here. Absent:
//! what is done.

use super::choice::SharedFormula;
use crate::clock::Tick;
use std::sync::Arc;

/// From when on an operation is done.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Start {
    /// From a tick of the plot.
    Tick(Tick),
    /// From an age of each plant.
    Age(Tick),
    /// At each of these ticks of the plot, which rise: those of a day of each year, which are not equally far apart.
    Each(Arc<[Tick]>),
}

/// When an operation is done.
#[derive(Debug, Clone)]
pub struct When {
    /// The first time; with a condition, the first time at which it is asked.
    pub start: Start,
    /// Done for the first time when this holds of the plant; asked at each tick until then.
    pub condition: Option<SharedFormula>,
    /// The ticks from each time to the next; done once if not stated.
    pub every: Option<Tick>,
    /// The last time, counted as the first.
    pub last: Option<Tick>,
}

/// Whether an operation is done at a tick.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Due {
    /// It is not.
    No,
    /// It is where its condition holds.
    Asked,
    /// It is.
    Yes,
}

impl When {
    /// An operation that is done once.
    pub fn once(start: Start) -> Self {
        Self { start, condition: None, every: None, last: None }
    }

    /// The tick of the plot of a time that is counted as the start is, for a plant that was sown at `sown`; no plant is
    /// worked on before its age 1.
    fn tick(&self, time: Tick, sown: Tick) -> Tick {
        match self.start {
            Start::Tick(_) | Start::Each(_) => time,
            Start::Age(_) => sown.saturating_add(time),
        }
    }

    fn first(&self, sown: Tick) -> Tick {
        match &self.start {
            Start::Tick(time) | Start::Age(time) => self.tick(*time, sown),
            Start::Each(times) => times.first().copied().unwrap_or(Tick::MAX),
        }
    }

    /// The first of listed ticks after `after`; `None` where the ticks are not listed, or none is left.
    fn listed(&self, after: Tick) -> Option<Option<Tick>> {
        let Start::Each(times) = &self.start else { return None };
        Some(times.get(times.partition_point(|time| *time <= after)).copied())
    }

    /// The first tick after `after` at which the operation is done, or its condition asked, for a plant that was sown
    /// at `sown`; `begun` is the tick at which its condition first held.
    pub fn next(&self, after: Tick, sown: Tick, begun: Option<Tick>) -> Option<Tick> {
        // A tick of the plot at or before the sowing is passed over, not put off.
        let after = after.max(sown);
        if let (None, Some(next)) = (&self.condition, self.listed(after)) {
            return next.filter(|next| *next <= self.end(sown));
        }
        let origin = if self.condition.is_some() { begun } else { Some(self.first(sown)) };
        let next = match (origin, self.every) {
            (None, _) => self.first(sown).max(after.checked_add(1)?),
            (Some(origin), _) if origin > after => origin,
            (Some(_), None) => return None,
            (Some(origin), Some(every)) => {
                let every = every.max(1);
                origin.checked_add(((after - origin) / every).checked_add(1)?.checked_mul(every)?)?
            }
        };
        (next <= self.end(sown)).then_some(next)
    }

    /// The last tick at which it may be done.
    fn end(&self, sown: Tick) -> Tick {
        self.last.map_or(Tick::MAX, |last| self.tick(last, sown))
    }

    /// Whether it is done at `tick`.
    pub fn due(&self, tick: Tick, sown: Tick, begun: Option<Tick>) -> Due {
        if tick <= sown || tick > self.end(sown) {
            return Due::No;
        }
        let origin = match (&self.condition, begun) {
            (Some(_), None) if tick >= self.first(sown) => return Due::Asked,
            (Some(_), None) => return Due::No,
            (Some(_), Some(begun)) => begun,
            (None, _) => self.first(sown),
        };
        if let (None, Some(next)) = (&self.condition, self.listed(tick - 1)) {
            return if next == Some(tick) { Due::Yes } else { Due::No };
        }
        let again = self.every.is_some_and(|every| tick > origin && (tick - origin).is_multiple_of(every.max(1)));
        if tick == origin || again { Due::Yes } else { Due::No }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::management::column::Column;
    use std::sync::Arc;

    #[derive(Debug)]
    struct Never;

    impl super::super::choice::Formula for Never {
        fn value(&self, _: &mut dyn FnMut(Column) -> f64) -> f64 {
            0.0
        }

        fn columns(&self) -> Vec<Column> {
            Vec::new()
        }
    }

    fn ticks(when: &When, sown: Tick, begun: Option<Tick>) -> Vec<Tick> {
        let mut ticks = Vec::new();
        while let Some(tick) = when.next(ticks.last().copied().unwrap_or(0), sown, begun).filter(|tick| *tick <= 40) {
            ticks.push(tick);
        }
        ticks
    }

    /// `next` names exactly the ticks at which `due` holds.
    #[test]
    fn the_next_time_is_the_next_that_is_due() {
        let condition: SharedFormula = Arc::new(Never);
        let listed = Start::Each([3, 4, 11, 30].into());
        for start in [Start::Tick(1), Start::Tick(7), Start::Age(1), Start::Age(5), listed] {
            for every in [None, Some(1), Some(6)] {
                for (condition, begun) in
                    [(None, None), (Some(condition.clone()), None), (Some(condition.clone()), Some(11))]
                {
                    for (last, sown) in [(None, 0), (Some(20), 0), (None, 9), (Some(18), 9)] {
                        let when = When { start: start.clone(), condition: condition.clone(), every, last };
                        let due: Vec<Tick> = (1..=40).filter(|tick| when.due(*tick, sown, begun) != Due::No).collect();
                        assert_eq!(ticks(&when, sown, begun), due, "{when:?} of a plant sown at {sown}, {begun:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_calendar_by_age_follows_the_sowing() {
        let when = When { start: Start::Age(14), condition: None, every: Some(10), last: None };
        assert_eq!(ticks(&when, 0, None), [14, 24, 34]);
        assert_eq!(ticks(&when, 3, None), [17, 27, 37]);
        let once = When::once(Start::Tick(5));
        assert_eq!((ticks(&once, 0, None), ticks(&once, 5, None)), (vec![5], vec![]), "not sown yet");
        let yearly = When::once(Start::Each([5, 17, 30].into()));
        assert_eq!((ticks(&yearly, 0, None), ticks(&yearly, 5, None)), (vec![5, 17, 30], vec![17, 30]));
    }
}
