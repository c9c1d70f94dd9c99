//! Laws and distributions, the numbers that models are stated in: what a bud's fate, a growth unit's nodes and an
//! internode's shape depend on (de Reffye et al. 1988 §§3–4), or what a plant draws once.
//!
//! A [`Law`] gives a number at each point (the [`Variable`]s and the state) of an order; a [`Count`] and a [`Variate`]
//! are random variables whose parameters are laws; [`Speeds`] are exact ratios, a [`Quantity`] is a whole number and a
//! [`Constant`] a real number that is not drawn. All are written in TOML, checked over their whole [`Domain`] and
//! compiled to tables before the first tick; during growth a draw is one look-up and one comparison. What is wrong with
//! a parameter is a [`fault`] with the parameter's path. Absent on purpose: any model, files, spans and the random
//! words (a draw takes one 32-bit word from its caller).

mod bare;
mod clamped;
pub mod condition;
mod constant;
mod count;
mod count_source;
mod count_table;
mod curves;
mod dates;
mod domain;
mod expression;
pub mod fault;
mod form;
mod formula;
mod grid;
mod guides;
mod mass;
mod own_age;
mod parser;
mod quantile;
mod quantity;
mod range;
mod responding;
mod responses;
mod speed;
pub mod spelling;
mod steps;
mod table;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_dates;
#[cfg(test)]
mod tests_draws;
#[cfg(test)]
mod tests_guides;
mod variable;
mod variate;
mod variate_table;
mod varies;

pub use constant::{Constant, ConstantForm};
pub use count::{Binomial, Count, CountComponent, CountForm, NegativeBinomial, Poisson};
pub use count_table::{CountAt, CountTable};
pub use curves::{
    Beyond, ExponentialLaw, GompertzLaw, LinearLaw, LogisticLaw, RobustaLaw, StepLaw, TableLaw, WeibullLaw,
};
pub use domain::{At, Domain, Longest};
pub use form::{Law, LawForm};
pub use quantity::{Quantity, QuantityForm};
pub use range::ValueRange;
pub use responding::Responding;
pub use responses::{LinearPlateauLaw, MitscherlichLaw, QuadraticPlateauLaw};
pub use speed::{SpeedForm, SpeedTable, SpeedText, Speeds};
pub use steps::{HEIGHT_STEP, LIGHT_STEP, SHADE_STEPS, height_in_steps, shade_in_steps};
pub use table::{Along, ProbabilityTable, Threshold, ValueTable, happens};
pub use variable::{Asked, Variable};
pub use variate::{Lognormal, Normal, Uniform, Variate, VariateForm};
pub use variate_table::{Parameters, VariateAt, VariateTable};
pub use varies::Varies;

/// The most cells that one compiled law may have (64 MiB of thresholds).
pub const MAX_CELLS: u64 = 16 * 1024 * 1024;
/// The most steps of evaluation that one law may take to compile: some seconds.
const MAX_WORK: u64 = 1 << 28;
