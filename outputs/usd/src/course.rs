//! The course of a life in time codes: spans of constant topology, and the states at which they are written.
//!
//! USD goes linearly between two samples of equal length and holds any other. So a life is cut into spans in which
//! nothing appears and nothing ends: what comes within the span is there from its beginning, collapsed to a point, and
//! what goes at its end is there up to it. At the end of a span, at the time t, stand three samples: the old topology
//! at t − 2ε, the new one at t − ε and again at t, all of them with the plant as it stands at t, but that the old one
//! still has what goes and the new one has what is to come. With ε = 0.001 growth is smooth to the eye, and at t
//! itself, where readers come by a division of frames that may be off in the last digit, nothing is shown but what
//! stands.

use phytomer_life::Life;

/// The time between two samples at the end of a span, in time codes.
const BESIDE: f64 = 0.001;

/// Numbers of values at times.
pub type Times = Vec<(f64, usize)>;

/// Ages between which the topology is constant, by their places among those of the life.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Span {
    /// The first.
    pub first: usize,
    /// The last.
    pub last: usize,
}

/// A span at one of its ages.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct State {
    /// The span.
    pub span: usize,
    /// The age, by its place.
    pub age: usize,
}

/// Ages in time codes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pace {
    /// The time codes of a tick.
    pub a_tick: f64,
    /// The time codes of a second.
    pub a_second: f64,
}

/// The spans and states of a life.
#[derive(Debug, Clone, Default)]
pub struct Course {
    /// The spans, in their order.
    pub spans: Vec<Span>,
    /// The states, span by span and age by age.
    pub states: Vec<State>,
    times: Option<[Times; 3]>,
}

impl Course {
    /// A plant at its one age.
    pub fn still() -> Self {
        let (span, state) = (Span { first: 0, last: 0 }, State { span: 0, age: 0 });
        Self { spans: vec![span], states: vec![state], times: None }
    }

    /// The course of several lives that were shown at the same ages.
    pub fn of(ages: &[f32], lives: &[Life], pace: &Pace) -> Self {
        let mut changes = vec![false; ages.len() + 1];
        let mut change = |from: f32, death: f32| {
            // What is there from an age on is in the topology from the age before on; what goes is in it up to its end.
            if let Some(before) = ages.partition_point(|age| *age < from).checked_sub(1) {
                changes[before] = true;
            }
            changes[ages.partition_point(|age| *age < death)] = true;
        };
        for life in lives {
            life.points.iter().for_each(|point| change(point.from, point.death));
            life.parts.iter().for_each(|part| change(part.from, part.death));
        }
        let mut course = Self::default();
        let Some(end) = ages.len().checked_sub(1) else { return course };
        let mut first = 0;
        for last in (1..=end).filter(|age| changes[*age]).chain([end]) {
            if last > first || course.spans.is_empty() {
                course.spans.push(Span { first, last });
            }
            first = last;
        }
        // What ends at the last age needs a topology without it.
        let ends = |death: f32| ages.last() == Some(&death);
        let any = lives.iter().any(|life| {
            life.points.iter().any(|point| ends(point.death)) || life.parts.iter().any(|part| ends(part.death))
        });
        if any && end > 0 {
            course.spans.push(Span { first: end, last: end });
        }
        let states = course.spans.iter().enumerate();
        course.states =
            states.flat_map(|(span, of)| (of.first..=of.last).map(move |age| State { span, age })).collect();
        course.times = Some(course.in_time_codes(ages, pace));
        course
    }

    /// The times of states, of topologies, and of what is held from one age to the next.
    fn in_time_codes(&self, ages: &[f32], pace: &Pace) -> [Times; 3] {
        let at = |age: usize| f64::from(ages[age]) * pace.a_tick;
        let least =
            ages.windows(2).map(|pair| f64::from(pair[1] - pair[0]) * pace.a_tick).fold(f64::INFINITY, f64::min);
        let beside = BESIDE.min(least / 8.0);
        let [mut states, mut spans, mut held] = [Times::new(), Times::new(), Times::new()];
        for (number, state) in self.states.iter().enumerate() {
            let (span, time) = (self.spans[state.span], at(state.age));
            let begins = state.age == span.first;
            let ends = state.age == span.last && state.span + 1 < self.spans.len();
            if begins {
                let early = if state.span > 0 { time - beside } else { time };
                spans.push((early, state.span));
                held.push((early, number));
                if state.span > 0 {
                    states.push((early, number));
                }
            }
            if ends && !begins {
                states.push((time - 2.0 * beside, number));
            } else {
                states.push((time, number));
                if !begins {
                    held.push((time, number));
                }
            }
        }
        [states, spans, held]
    }

    /// The times of all states; `None` for a still.
    pub fn of_states(&self) -> Option<&Times> {
        self.times.as_ref().map(|[states, ..]| states)
    }

    /// The times at which spans begin.
    pub fn of_spans(&self) -> Option<&Times> {
        self.times.as_ref().map(|[_, spans, _]| spans)
    }

    /// The times of the states of which the values are held.
    pub fn of_held(&self) -> Option<&Times> {
        self.times.as_ref().map(|[.., held]| held)
    }

    /// The states of the spans in whose topology something is.
    pub fn states_of(&self, ages: &[f32], (from, death): (f32, f32)) -> &[State] {
        let begin = self.states.partition_point(|state| ages[self.spans[state.span].last] < from);
        let end = self.states.partition_point(|state| ages[self.spans[state.span].first] < death);
        &self.states[begin..end.max(begin)]
    }

    /// Whether something is in the topology of a span.
    pub fn has(&self, span: usize, ages: &[f32], (from, death): (f32, f32)) -> bool {
        let Span { first, last } = self.spans[span];
        from <= ages[last] && ages[first] < death
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::{life, plant};

    /// The leaf comes at 2 and goes at 5: a topology up to 1, with it from 1 to 5, without it from 5 on.
    #[test]
    fn a_life_is_cut_where_something_comes_or_goes() {
        let life = life(&plant(), 1..=6);
        let ages = life.ages.clone();
        let course = Course::of(&ages, &[life], &Pace { a_tick: 10.0, a_second: 24.0 });
        assert_eq!(course.spans, [Span { first: 0, last: 4 }, Span { first: 4, last: 5 }]);
        let times: Vec<f64> = course.of_states().expect("a life").iter().map(|(time, _)| *time).collect();
        assert_eq!(times, [10.0, 20.0, 30.0, 40.0, 49.998, 49.999, 50.0, 60.0]);
        let spans: Vec<(f64, usize)> = course.of_spans().expect("a life").clone();
        assert_eq!(spans, [(10.0, 0), (49.999, 1)]);
        let held: Vec<f64> = course.of_held().expect("a life").iter().map(|(time, _)| *time).collect();
        assert_eq!(held, [10.0, 20.0, 30.0, 40.0, 49.999, 60.0]);
    }
}
