//! The activity b of a bud: the probability that it grows at a tick (de Reffye et al. 1988 §3).
//!
//! `counts` estimates b from the mean and the variance of what axes made in one window; `waiting` from the days between
//! successive nodes; `stationarity` tells whether a window may be used at all. Absent: an activity that changes with
//! dimension or age; divide the record into windows for it.

pub mod counts;
pub mod stationarity;
pub mod waiting;
