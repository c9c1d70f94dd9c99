//! What is expected of a plant before it grows: means by order and age, with what each figure is: the mean, a bound of
//! it or an estimate.
//!
//! A run can be told its size before its first tick, and a growth explosion refused, where the figure is a mean and not
//! an estimate. Absent: the sums, which belong to the models.

use crate::clock::Tick;

/// How a figure stands to the mean that it foretells. Of two figures together the greater of both holds.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Certainty {
    /// It is the mean, to rounding.
    #[default]
    Exact,
    /// The mean is not above it.
    AtMost,
    /// The mean is not above it, and may be far below it: nothing is decided by it.
    Bound,
    /// It is an estimate; the mean may lie on either side of it.
    About,
}

/// The means of what a plant has made by each age, living or dead.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Expectation {
    /// One entry an order, the trunk first.
    pub orders: Vec<OrderExpectation>,
    /// What the figures of axes, growth units and nodes are.
    pub axes: Certainty,
    /// What the figures of organs are.
    pub organs: Certainty,
}

/// The means of what the axes of one order have made; each column has an entry an age, from 0.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OrderExpectation {
    /// Axes that have appeared, if only as buds.
    pub axes: Vec<f64>,
    /// Growth units.
    pub units: Vec<f64>,
    /// Internodes.
    pub nodes: Vec<f64>,
    /// Leaves, flowers and fruits that have appeared: a flower after its delay, a fruit after its flower.
    pub organs: Vec<f64>,
}

impl OrderExpectation {
    /// Zeros for the ages 0 to `until`.
    pub fn zero(until: Tick) -> Self {
        let column = vec![0.0; until as usize + 1];
        Self { axes: column.clone(), units: column.clone(), nodes: column.clone(), organs: column }
    }

    /// Components made by `age`: internodes, organs and apical buds.
    pub fn components(&self, age: Tick) -> f64 {
        self.stems(age) + by(&self.organs, age)
    }

    /// The internodes and apical buds among them.
    fn stems(&self, age: Tick) -> f64 {
        by(&self.axes, age) + by(&self.nodes, age)
    }

    /// Turns what happens at each tick into what has happened by each tick.
    pub fn accumulate(&mut self) {
        for column in [&mut self.axes, &mut self.units, &mut self.nodes, &mut self.organs] {
            for age in 1..column.len() {
                column[age] += column[age - 1];
            }
        }
    }
}

impl Expectation {
    /// Components of all orders made by `age`; [`Expectation::certainty`] says what the figure is.
    pub fn components(&self, age: Tick) -> f64 {
        self.orders.iter().map(|order| order.components(age)).sum()
    }

    /// What the figures of components are.
    pub fn certainty(&self) -> Certainty {
        self.axes.max(self.organs)
    }

    /// Components of all orders of which the mean by `age` is not below this: those of which the figures are exact.
    pub fn least_components(&self, age: Tick) -> f64 {
        match (self.axes, self.organs) {
            (Certainty::Exact, Certainty::Exact) => self.components(age),
            (Certainty::Exact, _) => self.orders.iter().map(|order| order.stems(age)).sum(),
            _ => 0.0,
        }
    }
}

fn by(column: &[f64], age: Tick) -> f64 {
    column.get(age as usize).or(column.last()).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_exact_is_a_lower_bound() {
        let order = OrderExpectation { axes: vec![1.0], units: vec![2.0], nodes: vec![2.0], organs: vec![4.0] };
        let of = |axes, organs| Expectation { orders: vec![order.clone(); 2], axes, organs };
        let (exact, most, about) = (Certainty::Exact, Certainty::AtMost, Certainty::About);
        assert_eq!(of(exact, exact).least_components(0), 14.0);
        assert_eq!(of(exact, most).least_components(9), 6.0);
        assert_eq!(of(most, most).least_components(0), 0.0);
        assert_eq!(of(about, about).least_components(0), 0.0);
        assert_eq!(of(exact, most).certainty(), most);
        assert_eq!(of(most, about).certainty(), about);
    }
}
