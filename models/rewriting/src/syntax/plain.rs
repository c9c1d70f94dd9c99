//! What a D0L-system of cells may say: an axiom, and productions of single cells without interaction.
//!
//! The rules `( → (` and `) → )`, which Aono & Kunii 1984 list with those of the cells, say nothing and are passed
//! over. Absent: which cells there are, and what may bear a branch (`phytomer_models::lsystem::d0l`).

use super::file::{File, Section};
use super::production::Production;
use crate::fault::{Fault, Place};

/// What is expected where more is said.
const EXPECTED: &str = "a cell, an arrow and a string of cells: a D0L-system has no interaction";

/// Leaves the productions of cells in the file; all that a D0L-system cannot have is a fault.
pub(crate) fn plain(file: &mut File, faults: &mut Vec<Fault>) {
    for (section, what) in [(&file.decomposition, "decomposition"), (&file.homomorphism, "homomorphism")] {
        if let Some(production) = section.productions.first() {
            faults.push(Fault::new(production.place, format!("a {what} begins"), EXPECTED));
        }
    }
    let beside = [
        (file.ring, "a ring"),
        (file.consider.is_some() || file.ignore.is_some(), "what contexts see"),
        (!file.functions.is_empty(), "a function"),
        (file.rewriting.seed.is_some(), "a seed"),
        ([&file.define, &file.start, &file.start_each, &file.end_each].iter().any(|b| !b.is_empty()), "a block"),
    ];
    let first = Place { file: 0, line: 1, column: 1 };
    for (_, what) in beside.into_iter().filter(|(stated, _)| *stated) {
        faults.push(Fault::new(first, format!("the file states {what}"), EXPECTED));
    }
    let Section { productions, .. } = &mut file.rewriting;
    productions.retain(|production| !is_bracket(production));
    let mut known: Vec<&str> = Vec::new();
    for production in productions.iter() {
        if let Some(problem) = more(production) {
            faults.push(Fault::new(production.place, problem, EXPECTED));
        } else if let Some(cell) = production.strict.first() {
            if known.contains(&cell.symbol.as_str()) {
                let problem = format!("`{}` has two productions", cell.symbol);
                faults.push(Fault::new(production.place, problem, "one: a D0L-system is deterministic"));
            }
            known.push(&cell.symbol);
        }
    }
}

/// Whether a parenthesis stays as it is.
fn is_bracket(production: &Production) -> bool {
    let [cell] = &production.strict[..] else { return false };
    let [same] = &production.successor[..] else { return false };
    cell.symbol == same.symbol && matches!(cell.symbol.as_str(), "[" | "]") && more_than_cells(production).is_none()
}

/// What a production has beside a cell and its string.
fn more(production: &Production) -> Option<String> {
    match &production.strict[..] {
        [cell] if matches!(cell.symbol.as_str(), "[" | "]") => Some("a parenthesis is rewritten".to_owned()),
        [_] => more_than_cells(production),
        several => Some(format!("{} cells are rewritten together", several.len())),
    }
}

fn more_than_cells(production: &Production) -> Option<String> {
    let parts = [
        (!production.left.is_empty() || !production.right.is_empty(), "a context"),
        (production.condition.is_some(), "a condition"),
        (!production.before.is_empty() || !production.after.is_empty(), "statements"),
        (production.weight.is_some(), "a weight"),
    ];
    let found = parts.iter().find(|(stated, _)| *stated)?;
    Some(format!("this production has {}", found.1))
}
