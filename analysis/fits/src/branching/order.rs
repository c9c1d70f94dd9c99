//! The Markov order of sequences of states: whether the next state depends on none, one or two states before it.
//!
//! ln L of each order from the counts of its transitions, all orders on the same places (from the third on), so that
//! BIC compares them. Absent: transitions that change with rank.

use super::Shoots;
use crate::fit::Fit;
use crate::problem::Problem;
use crate::special::x_ln_y;
use std::collections::BTreeMap;

/// The highest order that is tried.
const HIGHEST: usize = 2;

/// The fits of orders 0, 1 and 2.
///
/// # Errors
/// No sequence has more than two states.
pub fn orders(shoots: &Shoots) -> Result<Vec<Fit>, Problem> {
    let places: usize = shoots.shoots.iter().map(|shoot| shoot.len().saturating_sub(HIGHEST)).sum();
    if places == 0 {
        let (what, purpose) = ("places after two others", "a Markov order");
        return Err(Problem::TooFew { what, found: 0, needed: 1, purpose });
    }
    Ok((0..=HIGHEST).map(|order| of_order(shoots, order, places)).collect())
}

fn of_order(shoots: &Shoots, order: usize, places: usize) -> Fit {
    let mut counts: BTreeMap<&[usize], Vec<f64>> = BTreeMap::new();
    for shoot in &shoots.shoots {
        for place in HIGHEST..shoot.len() {
            let row = counts.entry(&shoot[place - order..place]).or_insert_with(|| vec![0.0; shoots.fates]);
            row[shoot[place]] += 1.0;
        }
    }
    let ln = |row: &Vec<f64>| row.iter().map(|count| x_ln_y(*count, *count / row.iter().sum::<f64>())).sum::<f64>();
    let free = |row: &Vec<f64>| row.iter().filter(|count| **count > 0.0).count() - 1;
    Fit {
        law: format!("Markov chain of order {order}"),
        estimates: Vec::new(),
        covariance: Vec::new(),
        log_likelihood: Some(counts.values().map(ln).sum()),
        parameters: counts.values().map(free).sum(),
        n: places,
        tests: Vec::new(),
        notes: Vec::new(),
    }
}
