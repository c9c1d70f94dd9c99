//! What is expected of a plant before it grows: means by order and age, where a model's laws allow them in closed form.
//!
//! A run can be told its size before its first tick, and a growth explosion refused. Absent: the sums, which belong to
//! the models.

use crate::clock::Tick;

/// The means of what a plant has made by each age, living or dead.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Expectation {
    /// One entry an order, the trunk first.
    pub orders: Vec<OrderExpectation>,
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
    /// Leaves, flowers and fruits.
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
        let by = |column: &[f64]| column.get(age as usize).or(column.last()).copied().unwrap_or(0.0);
        by(&self.axes) + by(&self.nodes) + by(&self.organs)
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
    /// Components of all orders made by `age`.
    pub fn components(&self, age: Tick) -> f64 {
        self.orders.iter().map(|order| order.components(age)).sum()
    }
}
