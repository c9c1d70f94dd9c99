//! The keys of a D0L-system of Aono & Kunii 1984: its strings stand in the species file, or in a file of their own that
//! is read with `syntax = "d0l"`; what its cells are drawn as stands in the species file.
//!
//! Absent: reading the file ([`cells`]), and what the keys do ([`d0l`](crate::lsystem::d0l)).

use super::{Lsystem, Syntax};
use crate::fault::{Fault, Path, Segment};
use crate::lsystem::cells;
use crate::lsystem::d0l::{D0l, D0lModel};
use phytomer_rewriting::Program;
use phytomer_sim::Tick;
use std::collections::BTreeMap;

/// What is drawn by what, where a D0L-system has a file.
const BY_WHICH_CELLS: &str = "`cell` and `branching_deg`, by which the cells of the file are drawn";

impl Lsystem {
    /// The D0L-system of this species; its strings stand in the species file, or in a file of their own.
    pub(super) fn d0l(&self, until: Tick, top: &Path) -> Result<D0lModel, Vec<Fault>> {
        let Some(file) = &self.file else {
            if self.syntax.is_some() {
                return Err(vec![Fault::new(
                    &top.key("syntax"),
                    "`syntax` stands without `file`",
                    "the file that it is of",
                )]);
            }
            return self.stated(self.axiom.clone(), &self.production, top)?.compile(until, top);
        };
        self.check_beside(top)?;
        let strings = cells::strings(file, &self.texts).map_err(|wrong| Self::all_placed(wrong, top))?;
        let stated = self.stated(Some(strings.axiom.clone()), &Some(strings.production.clone()), top)?;
        let (start, rules) = (top.key("axiom"), top.key("production"));
        let in_file = |fault: Fault| {
            let rule = match fault.path.0.strip_prefix(&rules.0[..]) {
                Some([Segment::Key(cell)]) => Some(cell.as_str()),
                _ if fault.path == start => None,
                _ => return fault,
            };
            let wrong = strings.wrong(rule, fault.problem.clone(), fault.expected.clone());
            wrong.map_or(fault, |wrong| Self::placed(wrong, top))
        };
        stated.compile(until, top).map_err(|faults| faults.into_iter().map(in_file).collect())
    }

    /// The D0L-system with these strings.
    fn stated(
        &self,
        axiom: Option<String>,
        production: &Option<BTreeMap<String, String>>,
        top: &Path,
    ) -> Result<D0l, Vec<Fault>> {
        let missing = |key: &str| {
            let inline = "`file`, or `axiom`, `cell` and `branching_deg` of a D0L-system";
            let expected = if self.file.is_some() { BY_WHICH_CELLS } else { inline };
            Fault::new(top, format!("the key `{key}` is missing"), expected)
        };
        match (axiom, &self.cell, &self.branching_deg) {
            (Some(axiom), Some(cell), Some(branching_deg)) => Ok(D0l {
                axiom,
                production: production.clone().unwrap_or_default(),
                cell: cell.clone(),
                branching_deg: branching_deg.clone(),
            }),
            (None, None, None) => Err(vec![missing("file")]),
            (axiom, cell, angle) => {
                let stated = [("axiom", axiom.is_some()), ("cell", cell.is_some()), ("branching_deg", angle.is_some())];
                Err(stated.into_iter().filter(|(_, stated)| !stated).map(|(key, _)| missing(key)).collect())
            }
        }
    }

    /// A fault for each key that means nothing for the file of a D0L-system.
    fn check_beside(&self, top: &Path) -> Result<(), Vec<Fault>> {
        let others = [
            ("axiom", self.axiom.is_some()),
            ("production", self.production.is_some()),
            ("view", self.view.is_some()),
            ("colours", self.colours.is_some()),
            ("step_m", self.step_m.is_some()),
            ("width_m", self.width_m.is_some()),
            ("define", !self.define.is_empty()),
            ("shape", !self.shape.is_empty()),
            ("environment", self.environment.is_some()),
            ("kinds", !self.kinds.is_empty()),
            ("continues", !self.continues.is_empty()),
        ];
        let fault =
            |key: &str| Fault::new(&top.key(key), format!("`{key}` stands beside `syntax = \"d0l\"`"), BY_WHICH_CELLS);
        let faults: Vec<Fault> = others.into_iter().filter(|(_, stated)| *stated).map(|(key, _)| fault(key)).collect();
        if faults.is_empty() { Ok(()) } else { Err(faults) }
    }

    /// Whether this is a D0L-system of cells, whose strings are stated here or stand in a file.
    pub fn is_of_cells(&self) -> bool {
        self.file.is_none() || self.syntax == Some(Syntax::D0l)
    }

    /// The program that derives the strings of a D0L-system of a file, with these constants set; `None` for all other
    /// L-systems. The parameters stand at `top`.
    ///
    /// # Errors
    /// Every fault of the file.
    pub fn cell_program(&self, top: &Path, define: &[(String, f64)]) -> Option<Result<Program, Vec<Fault>>> {
        let file = self.file.as_ref().filter(|_| self.is_of_cells())?;
        Some(cells::program(file, &self.texts, define).map_err(|wrong| Self::all_placed(wrong, top)))
    }
}
