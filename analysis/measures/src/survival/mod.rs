//! Lives of buds, axes and leaves by their duration in ticks: Kaplan–Meier, the log-rank test, Aalen–Johansen.
//!
//! A life is a whole number of ticks and ends by a cause, or is censored: by the end of the run, a cut, a limit of
//! components. One that is censored at a duration was at risk at that duration. Lives are counted by duration and
//! plant; variances are given for independent lives, as textbooks do, and of plants, by the infinitesimal jackknife
//! (Efron 1982, ch. 6; Lin & Wei 1989), which holds where the lives of a plant are alike. Absent: models of hazards.

mod aalen_johansen;
mod kaplan_meier;
mod lives;
mod log_rank;
mod solve;
#[cfg(test)]
mod tests;

pub use aalen_johansen::{Incidence, aalen_johansen};
pub use kaplan_meier::{Curve, Step, kaplan_meier};
pub use lives::{CLUSTERS, Fate, Lives};
pub use log_rank::{LogRank, log_rank, log_rank_of_plants};
