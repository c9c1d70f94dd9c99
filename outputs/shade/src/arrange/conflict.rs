//! Which rules of a plan contradict each other.
//!
//! Rules are given up one by one; one without which there is still no arrangement is left out for good. What remains
//! is a set of rules that cannot hold together, while each part of it can (the deletion filter of Chinneck & Dravnieks
//! 1991, *ORSA Journal on Computing* 3: 157–168).

use super::{Plan, Rule, Unsolved, program};

/// Rules that cannot hold together, of a plan without an arrangement; each of them is needed for the conflict.
///
/// # Errors
/// Where the solver itself fails.
pub fn conflict(plan: &Plan) -> Result<Vec<Rule>, Unsolved> {
    // Only whether there is an arrangement is asked.
    let plain = Plan { gains: vec![0.0; plan.gains.len()], ..plan.clone() };
    let mut rules = plain.rules();
    let mut place = 0;
    while place < rules.len() {
        let without = rules[..place].iter().chain(&rules[place + 1..]).copied().collect::<Vec<Rule>>();
        match program::solve(&plain, &without)? {
            Some(_) => place += 1,
            None => rules = without,
        }
    }
    Ok(rules)
}
