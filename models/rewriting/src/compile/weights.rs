//! Weights of productions that compete: those that are constant should sum to 1, or to 100.
//!
//! A production is drawn with its weight over the sum of the weights of all that apply, whatever that sum is. Another
//! sum is a warning, for the file may mean probabilities.

use crate::code::{Code, Rule, Rules};
use crate::fault::Fault;

/// Warns of productions of one predecessor whose constant weights sum to neither 1 nor 100.
pub(super) fn check(rules: &Rules, warnings: &mut Vec<Fault>) {
    let mut told = vec![false; rules.rules.len()];
    for (number, first) in rules.rules.iter().enumerate() {
        if told[number] || first.weight.is_none() {
            continue;
        }
        let Some(kind) = first.strict.first() else { continue };
        let crate::code::Item::Module(kind, _) = *kind else { continue };
        let group: Vec<usize> = rules
            .of(kind)
            .iter()
            .map(|&other| other as usize)
            .filter(|&other| alike(first, &rules.rules[other]))
            .collect();
        let weights: Option<Vec<f64>> = group.iter().map(|&other| constant(&rules.rules[other])).collect();
        group.iter().for_each(|&other| told[other] = true);
        let Some(weights) = weights else { continue };
        let sum: f64 = weights.iter().sum();
        if (sum - 1.0).abs() > 1e-6 && (sum - 100.0).abs() > 1e-4 {
            let problem = format!("the weights of the productions of this predecessor sum to {sum}");
            let expected = "1, or 100; each is taken as its share of the sum";
            warnings.push(Fault::new(first.place, problem, expected));
        }
    }
}

fn alike(a: &Rule, b: &Rule) -> bool {
    a.strict == b.strict && a.left == b.left && a.right == b.right && a.condition == b.condition && a.before == b.before
}

fn constant(rule: &Rule) -> Option<f64> {
    match rule.weight {
        Some(Code::Number(weight)) => Some(weight),
        _ => None,
    }
}
