//! A law of one variable as a response: its value at each age of the plant, and its value at a reference.
//!
//! A plant's age decides the variable, so that a response is a row of numbers, made once; a response to the light of a
//! bud is a row of its own, by the steps of shade. The reference is a value of
//! the variable and need not occur at any age. A variable of the date that the scenario does not tell stands at the
//! reference, so that a species which responds to nitrogen can be grown without a soil. Absent: what responds.

use super::domain::{At, Domain};
use super::form::Law;
use super::formula::Formula;
use super::range::ValueRange;
use super::steps::SHADE_STEPS;
use super::variable::Variable;
use crate::fault::{Fault, Path};

/// The values of a response.
#[derive(Debug, Clone, PartialEq)]
pub struct Responding {
    /// At each age of the plant, from 0; one value where it is the same at all.
    pub by_age: Vec<f64>,
    /// At each step of shade, from full light; empty where the law does not name the light.
    pub by_shade: Vec<f64>,
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
        let held = Domain { held: Some(reference), ..domain.clone() };
        let formula = Formula::new(self, &held, path)?;
        let named = formula.named();
        if named.len() > 1 {
            let names: Vec<&str> = named.iter().map(|variable| variable.name()).collect();
            let problem = format!("the response depends on {}", names.join(" and "));
            return Err(vec![Fault::new(path, problem, "a law of one variable, of which `reference` is a value")]);
        }
        let mut stack = Vec::new();
        let at_reference = formula.value(At::default(), &mut stack);
        if !range.holds(at_reference) {
            let problem = format!("the response is {} at the reference {reference}", range.show(at_reference));
            return Err(vec![Fault::new(path, problem, range.expected())]);
        }
        let is_unknown = |variable: &Variable| variable.is_of_the_date() && domain.on_date(*variable, 1).is_none();
        if named.first().is_some_and(is_unknown) {
            return Ok(Responding { by_age: vec![at_reference], by_shade: Vec::new(), at_reference });
        }
        let formula = Formula::checked(self, domain, path, &range, false)?;
        if named.first() == Some(&Variable::Light) {
            let by_shade = (0..=SHADE_STEPS).map(|shade| formula.value(At { shade, ..At::default() }, &mut stack));
            return Ok(Responding { by_age: vec![at_reference], by_shade: by_shade.collect(), at_reference });
        }
        let mut value = |age| formula.value(At { age, ..At::default() }, &mut stack);
        let by_age = (0..=domain.until).map(|age| value(age.max(1))).collect();
        Ok(Responding { by_age, by_shade: Vec::new(), at_reference })
    }
}
