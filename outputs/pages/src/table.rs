//! The rows of `records` of one plant over its ages, column by column and component by component.
//!
//! Of each component are kept the first age at which it has a row, the age from which it has none, and of each column
//! the values that change. Whole numbers, words and truths hold until the next value, exactly. Real numbers are kept on
//! a logarithmic scale (`streams`), as keyframes between which linear interpolation on that scale stays within [`NEAR`]
//! steps: with rounding, three parts in a hundred. Memory does not grow with the number of ages, but with what changes.
//! Absent: which columns there are, and where their values come from.

use super::roll;
use super::streams::{Last, Stream, Streams, logarithmic};
use phytomer_life::{Key, Track};
use std::collections::BTreeMap;

/// The steps of the logarithmic scale by which a real number may be off.
const NEAR: f32 = 0.8;
/// The places on that scale of nothing, and of no value.
const NOTHING: f32 = -1024.0;
const NO_VALUE: f32 = -2048.0;

/// What the values of a column are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Holds {
    /// Whole numbers.
    Whole,
    /// Words, by their places in a list.
    Words(Vec<String>),
    /// True or false.
    Truth,
    /// Real numbers, none of them below 0.
    Real,
}

/// A column of `records`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Its name.
    pub name: &'static str,
    /// Its unit; empty where it has none.
    pub unit: &'static str,
    /// What it says, in a sentence.
    pub description: &'static str,
    /// What its values are.
    pub holds: Holds,
    /// Whether a table has its values; those of the others follow from the plant, its age and its form.
    pub kept: bool,
}

/// The span of ages at which a component has rows, by their numbers; the last is `u32::MAX` while it has.
#[derive(Debug, Clone, Copy)]
struct Span {
    from: u32,
    until: u32,
    seen: u32,
}

const NEVER_SEEN: Span = Span { from: u32::MAX, until: u32::MAX, seen: u32::MAX };

/// The values of a column while rows come.
#[derive(Debug, Clone)]
enum Values {
    /// The last value of each component; what changes is kept with its component and age.
    Held(Vec<i32>, Vec<(u32, u32, i32)>),
    /// The last bits and the track of each component.
    Tracked(Vec<(u32, Track<1>)>, Vec<(u32, Key<1>)>),
}

impl Default for Values {
    fn default() -> Self {
        Self::Held(Vec::new(), Vec::new())
    }
}

/// The rows of a plant.
#[derive(Debug, Clone, Default)]
pub struct Table {
    ages: Vec<f32>,
    spans: Vec<Span>,
    columns: Vec<Values>,
    /// How internodes are turned about their directions.
    rolls: Values,
    /// The column of the kinds.
    kind: Option<usize>,
}

impl Table {
    /// A table of those of these columns that are kept, without rows.
    pub fn new(columns: &[Column]) -> Self {
        let of = |column: &Column| match column.holds {
            Holds::Real => Values::Tracked(Vec::new(), Vec::new()),
            _ => Values::default(),
        };
        let kept = || columns.iter().filter(|column| column.kept);
        let kind = kept().position(|column| column.name == "kind");
        Self { columns: kept().map(of).collect(), kind, ..Self::default() }
    }

    /// Begins a later age.
    pub fn begin(&mut self, age: f32) {
        self.end();
        self.ages.push(age);
    }

    /// A row of the present age: a component, and its values in the order of the columns that are kept; NaN for none.
    pub fn row(&mut self, component: u32, values: impl IntoIterator<Item = f64>) {
        let place = component as usize;
        if place >= self.spans.len() {
            self.spans.resize(place + 1, NEVER_SEEN);
        }
        let number = self.ages.len() as u32;
        let Some(now) = number.checked_sub(1) else { return };
        let span = &mut self.spans[place];
        let first = span.from == u32::MAX;
        *span = Span { from: span.from.min(now), until: u32::MAX, seen: now };
        for (values, value) in self.columns.iter_mut().zip(values) {
            values.take((component, now, first), value);
        }
    }

    /// Where an internode points that has a row of the present age, and where its upper side is: unit vectors.
    pub fn turned(&mut self, component: u32, heading: [f64; 3], up: [f64; 3]) {
        let Some(now) = (self.ages.len() as u32).checked_sub(1) else { return };
        let Values::Held(last, _) = &self.rolls else { return };
        let last = last.get(component as usize).copied().filter(|last| *last >= 0);
        let number = roll::number(heading, up, last);
        self.rolls.take((component, now, last.is_none()), f64::from(number));
    }

    /// The number of components.
    pub fn components(&self) -> usize {
        self.spans.len()
    }

    /// The first values of a column of whole numbers or words, for all components; −1 for none.
    pub fn first_values(&self, column: usize) -> Vec<i32> {
        let mut first = vec![i32::MIN; self.spans.len()];
        if let Some(Values::Held(_, kept)) = self.columns.get(column) {
            for (component, _, value) in kept {
                let first = &mut first[*component as usize];
                *first = if *first == i32::MIN { *value } else { *first };
            }
        }
        first.into_iter().map(|value| value.max(-1)).collect()
    }

    /// The numbers of components that have rows from an age on, and until then, by the value of a column: for each age
    /// and value how many begin and how many end.
    pub fn changes(&self, column: usize, mut tell: impl FnMut(f32, i32, i64)) {
        let values = self.first_values(column);
        for (span, value) in self.spans.iter().zip(values).filter(|(span, _)| span.from != u32::MAX) {
            tell(self.ages[span.from as usize], value, 1);
            if let Some(age) = self.ages.get(span.until as usize) {
                tell(*age, value, -1);
            }
        }
    }

    /// Ends the spans of what the present age did not show.
    fn end(&mut self) {
        let Some(now) = (self.ages.len() as u32).checked_sub(1) else { return };
        for span in self.spans.iter_mut().filter(|span| span.until == u32::MAX && span.seen != u32::MAX) {
            if span.seen != now {
                span.until = now;
            }
        }
    }

    /// Writes the streams of the table; `place` numbers its ages among those of the page.
    pub fn write(mut self, name: &str, place: &dyn Fn(f32) -> u32, streams: &mut Streams) {
        self.end();
        let [mut from, mut lasts] = [Stream::default(), Stream::default()];
        let mut last = Last::default();
        let at = |number: u32| self.ages.get(number as usize).map(|age| place(*age));
        for span in &self.spans {
            // A component without a row has no first age.
            let begins = at(span.from);
            from.put(last.step(begins.map_or(-1, i64::from)));
            lasts.put(begins.zip(at(span.until)).map_or(0, |(begins, ends)| i64::from(ends) - i64::from(begins)));
        }
        streams.add(name, [("from", from), ("lasts", lasts)]);
        let kinds = self.kind.map_or_else(|| vec![-1; self.spans.len()], |kind| self.first_values(kind));
        for (number, values) in self.columns.into_iter().enumerate() {
            values.write(&format!("{name}.{number}"), &kinds, &|number| place(self.ages[number as usize]), streams);
        }
        self.rolls.write(&format!("{name}.roll"), &kinds, &|number| place(self.ages[number as usize]), streams);
    }
}

impl Values {
    fn take(&mut self, (component, now, first): (u32, u32, bool), value: f64) {
        let place = component as usize;
        match self {
            Self::Held(last, kept) => {
                let value = if value.is_nan() { -1 } else { value as i32 };
                last.resize(last.len().max(place + 1), -1);
                if first || last[place] != value {
                    last[place] = value;
                    kept.push((component, now, value));
                }
            }
            Self::Tracked(last, kept) => {
                let bits = (value as f32).to_bits();
                let empty = (0, Track::begin((0.0, [NO_VALUE])));
                last.resize(last.len().max(place + 1), empty);
                let (before, track) = &mut last[place];
                let now = now as f32;
                if first {
                    let key = (now, [on_scale(value)]);
                    (*before, *track) = (bits, Track::begin(key));
                    kept.push((component, key));
                    return;
                }
                // What holds its value is on the scale where it was.
                let on = if bits == *before { track.latest() } else { [on_scale(value)] };
                *before = bits;
                kept.extend(track.add(now, on, &[NEAR]).map(|key| (component, key)));
            }
        }
    }

    /// Real numbers differ from those of the component of the same kind before, others from those of the component
    /// before.
    fn write(self, name: &str, kinds: &[i32], place: &dyn Fn(u32) -> u32, streams: &mut Streams) {
        let by_kind = matches!(self, Self::Tracked(..));
        let kept = self.into_keys();
        let [mut counts, mut at, mut values]: [Stream; 3] = Default::default();
        let mut firsts: BTreeMap<i32, Last> = BTreeMap::new();
        let mut rest = kept.as_slice();
        for (component, kind) in (0..).zip(kinds) {
            let own;
            (own, rest) = rest.split_at(rest.iter().take_while(|(of, ..)| *of == component).count());
            counts.put(own.len() as i64);
            let first = firsts.entry(if by_kind { *kind } else { 0 }).or_default();
            let (mut age, mut value) = (Last::default(), *first);
            for (number, (_, when, what)) in own.iter().enumerate() {
                let step = age.step(i64::from(place(*when)));
                // The first key is at the first age of the component.
                if number > 0 {
                    at.put(step);
                }
                values.put(value.step(*what));
                if number == 0 {
                    *first = value;
                }
            }
        }
        streams.add(name, [("counts", counts), ("ages", at), ("values", values)]);
    }

    /// The keys by component, those of each in the order of their ages: component, number of the age, value.
    fn into_keys(self) -> Vec<(u32, u32, i64)> {
        let mut kept: Vec<(u32, u32, i64)> = match self {
            Self::Held(_, kept) => kept.into_iter().map(|(of, at, value)| (of, at, i64::from(value))).collect(),
            Self::Tracked(last, mut kept) => {
                let ends = (0..).zip(&last).filter_map(|(of, (_, track))| track.end().map(|key| (of, key)));
                kept.extend(ends);
                kept.into_iter().map(|(of, (at, [value]))| (of, at as u32, of_scale(value))).collect()
            }
        };
        kept.sort_by_key(|(of, ..)| *of);
        kept
    }
}

fn on_scale(value: f64) -> f32 {
    match logarithmic(value) {
        _ if value.is_nan() => NO_VALUE,
        0 => NOTHING,
        place => place as f32,
    }
}

/// −1 for no value, 0 for nothing, else the place.
fn of_scale(value: f32) -> i64 {
    match value {
        value if value <= NO_VALUE => -1,
        value if value <= NOTHING => 0,
        value => (value + 0.5) as i64,
    }
}
