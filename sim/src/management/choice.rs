//! Which things an operation concerns: those for which a condition holds, of these the first by a rank, at most a
//! share.
//!
//! A condition is a formula over columns that is not 0. The language of formulas stands above this crate; here a
//! formula is what gives a number where it is told the values of columns. Absent: what is done with the chosen.

use super::column::Column;
use std::cmp::Ordering;
use std::fmt::Debug;
use std::sync::Arc;

/// A formula over columns.
pub trait Formula: Debug + Send + Sync {
    /// Its value where `known` tells the columns; NaN where it is undefined.
    fn value(&self, known: &mut dyn FnMut(Column) -> f64) -> f64;

    /// The columns that it names.
    fn columns(&self) -> Vec<Column>;
}

/// A formula that several operations may share.
pub type SharedFormula = Arc<dyn Formula>;

/// Whether a condition holds: its value is neither 0 nor undefined. No condition always holds.
pub fn holds(condition: Option<&SharedFormula>, known: &mut dyn FnMut(Column) -> f64) -> bool {
    condition.is_none_or(|condition| {
        let value = condition.value(known);
        value != 0.0 && !value.is_nan()
    })
}

/// The choice of the things that an operation concerns.
#[derive(Debug, Clone, Default)]
pub struct Choice {
    /// Only those for which this holds; all if not stated.
    pub only: Option<SharedFormula>,
    /// Those for which this holds are kept, with what they need to stay.
    pub protect: Option<SharedFormula>,
    /// The greatest values of this are taken first.
    pub first: Option<SharedFormula>,
    /// At most this share of those that may be taken, rounded down.
    pub share: Option<f64>,
    /// At most this number.
    pub most: Option<u32>,
}

impl Choice {
    /// Every formula of the choice.
    pub fn formulas(&self) -> impl Iterator<Item = &SharedFormula> {
        [&self.only, &self.protect, &self.first].into_iter().flatten()
    }

    /// Whether a thing is kept whatever else holds.
    pub fn protects(&self, known: &mut dyn FnMut(Column) -> f64) -> bool {
        self.protect.is_some() && holds(self.protect.as_ref(), known)
    }

    /// The places of the chosen among `count` things, rising. `allowed` tells which may be taken at all, `known` the
    /// columns of each. Of equal ranks the earlier thing is taken first.
    pub fn of(
        &self,
        count: usize,
        allowed: impl Fn(usize) -> bool,
        mut known: impl FnMut(usize, Column) -> f64,
    ) -> Vec<usize> {
        let candidates = (0..count).filter(|&thing| allowed(thing));
        let mut chosen: Vec<usize> =
            candidates.filter(|&thing| holds(self.only.as_ref(), &mut |column| known(thing, column))).collect();
        let most = self.limit(chosen.len());
        if most >= chosen.len() {
            return chosen;
        }
        if let Some(first) = &self.first {
            let mut ranked: Vec<(f64, usize)> =
                chosen.iter().map(|&thing| (first.value(&mut |column| known(thing, column)), thing)).collect();
            ranked.sort_by(|a, b| falling(a.0, b.0).then(a.1.cmp(&b.1)));
            chosen = ranked.into_iter().map(|(_, thing)| thing).collect();
        }
        chosen.truncate(most);
        chosen.sort_unstable();
        chosen
    }

    fn limit(&self, candidates: usize) -> usize {
        // The tiny addition keeps 0.3 of 10 at 3: decimal shares have no exact binary form.
        let share = self.share.map_or(candidates, |share| (share * candidates as f64 + 1e-9) as usize);
        share.min(self.most.map_or(usize::MAX, |most| most as usize))
    }
}

/// Greatest first, undefined values last.
fn falling(a: f64, b: f64) -> Ordering {
    a.is_nan().cmp(&b.is_nan()).then(b.total_cmp(&a))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A column, or whether it is above a number.
    #[derive(Debug)]
    struct Plain(Column, Option<f64>);

    impl Formula for Plain {
        fn value(&self, known: &mut dyn FnMut(Column) -> f64) -> f64 {
            let value = known(self.0);
            self.1.map_or(value, |above| f64::from(u8::from(value > above)))
        }

        fn columns(&self) -> Vec<Column> {
            vec![self.0]
        }
    }

    #[test]
    fn at_most_a_share_of_those_that_may_be_taken_the_greatest_first() {
        let lengths = [4.0, 9.0, f64::NAN, 1.0, 7.0, 9.0, 8.0, 2.0, 3.0, 5.0, 6.0, 10.0];
        let known = |thing: usize, _: Column| lengths[thing];
        let first: SharedFormula = Arc::new(Plain(Column::Length, None));
        let above: SharedFormula = Arc::new(Plain(Column::Length, Some(2.5)));
        let all = Choice::default();
        assert_eq!(all.of(4, |_| true, known), [0, 1, 2, 3]);
        let strong = Choice { share: Some(0.3), first: Some(first.clone()), ..Choice::default() };
        assert_eq!(strong.of(10, |_| true, known), [1, 5, 6], "three of ten, the strongest");
        assert_eq!(strong.of(10, |thing| thing != 1, known), [5, 6], "0.3 of nine are two");
        let some = Choice { only: Some(above), first: Some(first), most: Some(2), ..Choice::default() };
        assert_eq!(some.of(12, |_| true, known), [1, 11], "of equal lengths the earlier");
        let undefined = Choice { share: Some(0.99), ..some };
        assert!(!undefined.of(12, |_| true, known).contains(&2), "an undefined length is not above 2.5");
    }
}
