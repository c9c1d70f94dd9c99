//! D0L-systems of cells as text (Aono & Kunii 1984, "L-system model"): `w = g` or `ω : g` is the start, `g → d(g)g` a
//! rule, and parentheses are branches.
//!
//! Comments, macros, included texts and arrows are those of every other L-system. [`Cells`] is what such a text says,
//! as strings; [`Program`](crate::Program) derives it. Absent: what the strings mean, and how they are drawn.

use crate::fault::{Place, Refused};
use crate::program::{Reading, tree};
use crate::syntax::ModuleText;
use std::sync::Arc;

/// The start and the rules of a D0L-system of cells.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cells {
    /// The names of the files, by the numbers in [`Place`].
    pub files: Vec<String>,
    /// The string at age 0.
    pub axiom: CellString,
    /// What each cell becomes, by the cell.
    pub productions: Vec<(String, CellString)>,
}

/// A string of cells.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CellString {
    /// Where its statement begins.
    pub place: Place,
    /// The string, with a blank for each column of its line before it and between its cells, so that a cell stands in
    /// this text at its column in the file.
    pub text: String,
}

impl Cells {
    /// Reads the text of a D0L-system of cells.
    ///
    /// # Errors
    /// Everything that is wrong with the text.
    pub fn read(text: &str, reading: &Reading<'_>) -> Result<Self, Refused> {
        let reading = Reading { cells: true, outside: Arc::clone(&reading.outside), ..*reading };
        let (file, files, faults) = tree(text, &reading)?;
        let Some((place, axiom)) = file.axiom.filter(|_| faults.is_empty()) else {
            // A file without an axiom has a fault already.
            return Err(Refused::new(files, faults, Vec::new()));
        };
        let axiom = string(place, &axiom);
        let mut productions = Vec::new();
        for production in &file.rewriting.productions {
            let Some(cell) = production.strict.first() else { continue };
            productions.push((cell.symbol.clone(), string(production.place, &production.successor)));
        }
        Ok(Self { files, axiom, productions })
    }
}

/// The text of a string, in which each cell stands at its column.
fn string(place: Place, modules: &[ModuleText]) -> CellString {
    let mut text = String::new();
    let mut columns = 0;
    for module in modules {
        let before = module.place.column.saturating_sub(1).min(1000);
        while columns < before {
            text.push(' ');
            columns += 1;
        }
        let written = match module.symbol.as_str() {
            "[" => "(",
            "]" => ")",
            symbol => symbol,
        };
        text.push_str(written);
        columns += written.chars().count() as u32;
    }
    CellString { place, text }
}
