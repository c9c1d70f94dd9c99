//! A law of one variable as a response: its value at each age of the plant, and its value at a reference.
//!
//! A plant's age decides the variable, so that a response is a row of numbers, made once. The reference is a value of
//! the variable and need not occur at any age. Absent: what responds.

use super::domain::{At, Domain};
use super::form::Law;
use super::formula::Formula;
use super::range::ValueRange;
use crate::fault::{Fault, Path};

/// The values of a response.
#[derive(Debug, Clone, PartialEq)]
pub struct Responding {
    /// At each age of the plant, from 0.
    pub by_age: Vec<f64>,
    /// At the reference.
    pub at_reference: f64,
}

impl Law {
    /// The values of the law over the ages of `domain`, and its value where its variable is `reference`; each within
    /// `range`.
    ///
    /// # Errors
    /// Every fault of the law: values outside `range`, a variable that a response cannot know, more than one variable.
    pub fn respond(
        &self,
        domain: &Domain,
        reference: f64,
        path: &Path,
        range: ValueRange,
    ) -> Result<Responding, Vec<Fault>> {
        let formula = Formula::checked(self, domain, path, &range, false)?;
        if formula.uses.variables().count() > 1 {
            let names: Vec<&str> = formula.uses.variables().map(|variable| variable.name()).collect();
            let problem = format!("the response depends on {}", names.join(" and "));
            return Err(vec![Fault::new(path, problem, "a law of one variable, of which `reference` is a value")]);
        }
        let mut stack = Vec::new();
        let mut value = |age| formula.value(At { age, ..At::default() }, &mut stack);
        let by_age = (0..=domain.until).map(|age| value(age.max(1))).collect();
        let at_reference = value(reference as u32);
        if !range.holds(at_reference) {
            let problem = format!("the response is {} at the reference {reference}", range.show(at_reference));
            return Err(vec![Fault::new(path, problem, range.expected())]);
        }
        Ok(Responding { by_age, at_reference })
    }
}
