//! De Reffye's bud model (de Reffye, Edelin, Françon, Jaeger & Puech 1988, §§2–5).
//!
//! [`Buds`] are the parameters as people state them, in the laws of [`crate::law`]; [`BudModel`] is the compiled
//! species that grows. [`expectation`] gives the mean of what grows in closed form.

mod alike;
mod around;
mod attack;
mod birth;
mod bud;
mod card;
mod columns;
mod compile;
mod contact;
mod cuts;
pub mod expectation;
mod follow;
mod grow;
mod lives;
mod model;
mod node;
mod organ;
pub mod params;
mod plain;
mod plan;
mod planned;
mod record;
mod simple;
mod site;
mod start;
mod steps;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_apart;
#[cfg(test)]
mod tests_chain;
#[cfg(test)]
mod tests_columns;
#[cfg(test)]
mod tests_contact;
#[cfg(test)]
mod tests_cuts;
#[cfg(test)]
mod tests_dates;
#[cfg(test)]
mod tests_drawn;
#[cfg(test)]
mod tests_faults;
#[cfg(test)]
mod tests_height;
#[cfg(test)]
mod tests_light;
#[cfg(test)]
mod tests_making;
#[cfg(test)]
mod tests_pests;
#[cfg(test)]
mod tests_random;
#[cfg(test)]
mod tests_replanting;
#[cfg(test)]
mod tests_responses;
#[cfg(test)]
mod tests_sets;
#[cfg(test)]
mod tests_stems;
#[cfg(test)]
mod tests_training;
#[cfg(test)]
mod tests_variables;
mod together;

pub use bud::{ApicalBud, LivingBuds};
pub use compile::BudModel;
pub use params::{Buds, Order};
