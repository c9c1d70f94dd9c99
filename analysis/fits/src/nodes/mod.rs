//! The number of nodes of growth units (de Reffye et al. 1988 §4): Poisson, binomial, negative binomial, each from 0 or
//! shifted, and mixtures of two parts by EM (Dempster, Laird & Rubin 1977).
//!
//! `part` has one distribution and its largest likelihood from weighted counts; `mixture` two of them; `laws` all
//! rivals of a histogram. The n of a binomial part is profiled, and counts as a parameter, as a shift does. Absent:
//! laws that change with age; divide the counts into groups for them.

pub mod laws;
mod mixture;
pub mod part;

pub use laws::{fit_all, fit_mixture, fit_single};
pub use part::{Family, Part};
