//! D0L-systems of cells that have a file of their own (Aono & Kunii 1984, "L-system model"): their start and their
//! rules are read from it, and what is wrong with them is told at its line.
//!
//! A system is the same whether its strings stand in the species file or in a file beside it ([`d0l`](super::d0l)).
//! Absent: the text's language (`phytomer_rewriting`), and what the cells are drawn as.

use super::text::Wrong;
use super::view::TextFault;
use phytomer_rewriting::{Cells, Place, Program, Reading, Refused};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The strings of a file, and where they stand in it.
pub(super) struct Strings {
    /// The start.
    pub axiom: String,
    /// The rules, by their cells.
    pub production: BTreeMap<String, String>,
    /// The file and the place of the start, and of each rule.
    start: (String, Place),
    rules: BTreeMap<String, (String, Place)>,
}

/// Reads the strings of a file, of which all texts stand in `texts`.
pub(super) fn strings(file: &str, texts: &BTreeMap<String, String>) -> Result<Strings, Vec<Wrong>> {
    let cells = with_text(file, texts, Cells::read)?;
    let place = |place: Place| (cells.files.get(place.file as usize).cloned().unwrap_or_default(), place);
    let rules = cells.productions.iter().map(|(cell, becomes)| (cell.clone(), place(becomes.place)));
    let production = cells.productions.iter().map(|(cell, becomes)| (cell.clone(), becomes.text.clone()));
    let start = place(cells.axiom.place);
    Ok(Strings { start, rules: rules.collect(), production: production.collect(), axiom: cells.axiom.text.clone() })
}

/// The program of a file, which derives its strings, with constants set.
pub(super) fn program(
    file: &str,
    texts: &BTreeMap<String, String>,
    define: &[(String, f64)],
) -> Result<Program, Vec<Wrong>> {
    with_text(file, texts, |text, reading| {
        Program::read(text, &Reading { define, outside: Arc::clone(&reading.outside), ..*reading })
    })
}

impl Strings {
    /// What is wrong with the start, or with the rule of a cell, at its place in the file; `None` for a cell without a
    /// rule.
    pub fn wrong(&self, rule: Option<&str>, problem: String, expected: String) -> Option<Wrong> {
        let (file, Place { line, column, .. }) = match rule {
            None => &self.start,
            Some(cell) => self.rules.get(cell)?,
        };
        let fault = TextFault { line: *line, column: *column, problem, expected };
        Some(Wrong::Text { file: file.clone(), fault })
    }
}

fn with_text<T>(
    file: &str,
    texts: &BTreeMap<String, String>,
    read: impl FnOnce(&str, &Reading<'_>) -> Result<T, Refused>,
) -> Result<T, Vec<Wrong>> {
    let missing = || "there is no such file in the folder of the L-system".to_owned();
    let include = |name: &str| texts.get(name).cloned().ok_or_else(missing);
    let reading = Reading { cells: true, include: &include, ..Reading::of(file) };
    let Some(text) = texts.get(file) else { return Err(vec![Wrong::missing(file)]) };
    read(text, &reading).map_err(|refused| Wrong::all(&refused))
}
