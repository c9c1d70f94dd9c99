//! The bud model against published numbers and closed forms: de Reffye 1988 Examples 1–4, one axis, order-specific
//! means, extinction, and the prefix traversal of §4 against growth by the clock.
//!
//! Statistical tests have fixed seeds, at least 20,000 plants, and a bound of 4 standard errors of the sample itself.

mod examples;
mod expectation;
mod forecast;
mod grown;
mod laws;
mod organs;
mod traversal;
