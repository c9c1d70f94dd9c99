//! The mean of what grows, in closed form: expectations by order and age, and the probability of extinction.
//!
//! The mean is summed over cohorts: the axes of one order born at one tick in one state, of which each clock step
//! kills, rests, ends or grows a share. Means are linear, so the sum is exact whatever the random numbers of nodes and
//! buds, as long as they are drawn independently. Where an axis draws its speed or a growth unit the ranks of its
//! zones, the mean is taken over them too; where relays stand below the last node, axes too short for them are counted
//! apart. Organs that never appear because their branch dies first are subtracted (`lost`). Absent: falls; the counts
//! are of components made.

mod asked;
mod cohort;
mod frame;
mod gone;
mod lost;
mod needs;
mod unit;

use super::compile::BudModel;
use cohort::Cohorts;
use phytomer_sim::Tick;
use phytomer_sim::expectation::{Certainty, Expectation, OrderExpectation};

impl BudModel {
    /// The means of what an axis of order `order` and all axes that it bears have made by each age from 0 to `until`,
    /// counted from the birth of the axis; `None` where the sum would take too long, or there is no such order.
    ///
    /// For laws that depend on the order alone, with one bud in k at each node of order o, survival s = 1 − d and
    /// growth g = 1 − p, the mean number of growth units of order q that a bud of order o has made after n ticks is
    /// M(o,q)(n) = s_o [M(o,q)(n − 1) + g_o (1{o = q} + k_o a_o M(o+1,q)(n − 1))], M(0) = 0.
    ///
    /// Means without a closed form are marked ([`Certainty`]). Where laws depend on more than is known of a cohort they
    /// are estimates. They are bounds from above for organs on branches that die otherwise than independently (released
    /// dormant buds, drawn zones), or too many to be followed, as if no branch died before them; and for relays that
    /// may stand more than 64 nodes below the last one, as if every axis were long enough. The time is at most that of
    /// some 70 million steps of summation.
    pub fn expectation_from(&self, order: u8, until: Tick) -> Option<Expectation> {
        if !self.has_order(order) {
            return None;
        }
        let until = until.min(self.until);
        let Cohorts { births, expected: mut orders, .. } = Cohorts::from(self, order, until)?;
        let (axes, mut organs) = (needs::of_axes(self), needs::of_organs(self));
        match lost::organs(self, &births, until) {
            Some(lost) => orders.iter_mut().zip(lost).for_each(|(order, lost)| take_off(order, &lost)),
            None => organs = organs.max(Certainty::AtMost),
        }
        orders.iter_mut().for_each(OrderExpectation::accumulate);
        Some(Expectation { orders, axes, organs })
    }
}

/// Subtracts the organs that never appear; rounding takes no number below 0.
fn take_off(order: &mut OrderExpectation, lost: &[f64]) {
    order.organs.iter_mut().zip(lost).for_each(|(organs, lost)| *organs = (*organs - lost).max(0.0));
}

/// The probability that one bud and all its descendants are dead after `ticks` ticks, for buds of one type: at each
/// tick a bud dies with probability `death`, else pauses with probability `pause`, else grows and bears another such
/// bud with probability `ramification` (k = 1). The limit is the smallest root of q = d + s q [p + g (1 − a + a q)]:
/// q = min(1, d/(s g a)). Linear in `ticks`.
///
/// ```
/// use phytomer_models::buds::expectation::{extinct_by, extinction};
/// assert!((extinction(0.1, 0.0, 0.5) - 2.0 / 9.0).abs() < 1e-15);
/// assert!((extinct_by(0.1, 0.0, 0.5, 200) - 2.0 / 9.0).abs() < 1e-12);
/// ```
pub fn extinct_by(death: f64, pause: f64, ramification: f64, ticks: Tick) -> f64 {
    let (survives, grows) = (1.0 - death, 1.0 - pause);
    let branches = |q: f64| 1.0 - ramification + ramification * q;
    (0..ticks).fold(0.0, |q, _| death + survives * q * (pause + grows * branches(q)))
}

/// The probability that one bud and all its descendants ever die out: the limit of [`extinct_by`] for many ticks.
pub fn extinction(death: f64, pause: f64, ramification: f64) -> f64 {
    let births = (1.0 - death) * (1.0 - pause) * ramification;
    match death {
        0.0 => 0.0,
        _ if births <= death => 1.0,
        _ => death / births,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extinction_is_certain_where_deaths_outweigh_births() {
        assert_eq!(extinction(0.5, 0.0, 0.5), 1.0);
        assert_eq!(extinction(0.0, 0.5, 0.5), 0.0);
        assert!((extinct_by(0.5, 0.0, 0.5, 10_000) - 1.0).abs() < 1e-9);
    }
}
