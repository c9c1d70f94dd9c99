//! What plants are foretold that go on by one segment a tip and tick and may branch: a bound from above.
//!
//! A tip is followed by itself and, with the probability `branching`, by a branch of the next order; the first segment
//! of a plant bears none. So the mean number of tips is at most (1 + branching)ᵃ⁻¹ at the age a. Tips that are crowded,
//! blocked or refused make it less, how much less depends on all that stands around; so the bound may be far above the
//! mean, and no run is refused for it. Absent: plants of cells, whose numbers are known exactly (`ulam`).

use phytomer_sim::clock::Tick;
use phytomer_sim::expectation::{Certainty, Expectation, OrderExpectation};

/// The most orders that are told apart.
const MOST_ORDERS: usize = 255;
/// The most ages of all orders together; of more the last order told holds the higher ones too.
const MOST_AGES: usize = 1_000_000;

/// The bound of a plant up to the age `until`, of which a tip branches with the probability `branching` at most.
pub(super) fn at_most(until: Tick, branching: f64) -> Expectation {
    let ages = until as usize + 1;
    let most = MOST_ORDERS.min(MOST_AGES / ages).clamp(1, ages);
    let count = if branching > 0.0 { most } else { 1 };
    let mut orders = vec![OrderExpectation::zero(until); count];
    // The tips of each order at the end of a tick, the trunk first.
    let mut tips = vec![0.0; count];
    orders[0].axes[0] = 1.0;
    for age in 1..ages {
        if age == 1 {
            tips[0] = 1.0;
        } else {
            for order in (0..count).rev() {
                let from = if order > 0 { tips[order - 1] } else { 0.0 };
                // The branches of the last order are of that order.
                let own = if order + 1 == count && order > 0 { tips[order] } else { 0.0 };
                let new = branching * (from + own);
                orders[order].axes[age] = new;
                tips[order] += new;
            }
        }
        for (order, tips) in orders.iter_mut().zip(&tips) {
            order.nodes[age] = *tips;
            order.units[age] = *tips;
        }
    }
    orders.iter_mut().for_each(OrderExpectation::accumulate);
    fold_the_rare(&mut orders);
    Expectation { orders, axes: Certainty::Bound, organs: Certainty::Exact }
}

/// Tells orders of which less than one axis is expected together with the order before them.
fn fold_the_rare(orders: &mut Vec<OrderExpectation>) {
    let told = orders.iter().rposition(|order| order.axes.last().is_some_and(|axes| *axes >= 1.0));
    let rare = orders.split_off(told.map_or(1, |last| last + 1));
    let Some(last) = orders.last_mut() else { return };
    for order in &rare {
        let columns = [(&mut last.axes, &order.axes), (&mut last.units, &order.units), (&mut last.nodes, &order.nodes)];
        for (sum, more) in columns {
            sum.iter_mut().zip(more).for_each(|(sum, more)| *sum += more);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The internodes of all orders are the sum of a geometric series, those of each order binomial terms.
    #[test]
    fn the_bound_is_a_geometric_series() {
        for (branching, until) in [(0.0, 40), (0.15, 90), (0.5, 30), (1.0, 20)] {
            let bound = at_most(until, branching);
            assert_eq!((bound.axes, bound.certainty()), (Certainty::Bound, Certainty::Bound));
            for age in 1..=until {
                let growth = (0..age - 1).fold(1.0, |power, _| power * (1.0 + branching));
                let series = (0..age).fold((0.0, 1.0), |(sum, term), _| (sum + term, term * (1.0 + branching)));
                let nodes: f64 = bound.orders.iter().map(|order| order.nodes[age as usize]).sum();
                let axes: f64 = bound.orders.iter().map(|order| order.axes[age as usize]).sum();
                assert!((nodes / series.0 - 1.0).abs() < 1e-12, "{branching}, {age}: {nodes}, not {}", series.0);
                assert!((axes / growth - 1.0).abs() < 1e-12, "a tip an axis: {axes}, not {growth}");
            }
            assert_eq!(bound.orders[0].nodes[until as usize], f64::from(until));
        }
        // Of the branches of the trunk at the age a the k-th order has branchingᵏ⁻¹ times (a − 1 over k − 1).
        let bound = at_most(9, 0.5);
        assert_eq!(bound.orders[2].axes[9] - bound.orders[2].axes[8], 0.25 * 7.0);
        assert!((bound.orders[3].axes[9] - 0.125 * 56.0).abs() < 1e-12);
    }

    /// A long life is told in few orders, and nothing is left out.
    #[test]
    fn many_ages_are_told_in_few_orders() {
        let bound = at_most(50_000, 0.0001);
        assert!(bound.orders.len() < 30, "{}", bound.orders.len());
        let axes: f64 = bound.orders.iter().map(|order| order.axes[50_000]).sum();
        let growth = phytomer_sim::math::pow(1.0001, 49_999.0);
        assert!((axes / growth - 1.0).abs() < 1e-9, "{axes}, not {growth}");
        assert!(at_most(65_535, 1.0).components(65_535).is_infinite());
    }
}
