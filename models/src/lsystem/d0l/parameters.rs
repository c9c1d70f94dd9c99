//! The parameters of a D0L-system (Aono & Kunii 1984, "L-system model"): its cells, its axiom, its productions, and how
//! its strings are drawn.
//!
//! K = ⟨G, w, P⟩: the symbols G are the cells of the table `cell` with the two parentheses, w is `axiom`, and P the
//! table `production`; a cell without a production stays as it is, as d → d does in the paper. Absent: the meaning of
//! strings (`text`).

use phytomer_sim::clock::{LAST_TICK, Tick};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

use super::model::D0lModel;
use super::string::{MOST_CELLS, Rules};
use super::text::{Symbol, UNREADABLE, bearing, last_cell, parse};
use crate::fault::{Fault, Path};
use crate::law::{Constant, ValueRange};

/// The length of a cell.
const LENGTH: ValueRange = ValueRange { min: 0.0, max: 1000.0, what: "a length in m" };
/// The diameter of a cell.
const DIAMETER: ValueRange = ValueRange { min: 0.0, max: 1e6, what: "a diameter in mm" };
/// The angle of a branch.
const ANGLE: ValueRange = ValueRange { min: 0.0, max: 180.0, what: "an angle in degrees" };

/// A deterministic L-system without interaction, and the drawing rules of its strings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct D0l {
    /// The string at age 0: cells by their letters, and branches in parentheses, each behind a cell.
    #[schemars(length(min = 1, max = 10_000))]
    pub axiom: String,
    /// What each cell becomes at a tick: a string that begins with a cell, or an empty string where the cell vanishes.
    /// A cell that vanishes may bear no branch, and no axis may end with it. A cell without a production stays as it
    /// is.
    #[serde(default)]
    pub production: BTreeMap<String, String>,
    /// The cells, each by its letter.
    pub cell: BTreeMap<String, Cell>,
    /// The angle between a branch and what bears it, degrees (drawing rule 5).
    #[schemars(with = "Constant", extend("minimum" = 0, "maximum" = 180))]
    pub branching_deg: Constant,
}

/// What a cell is drawn as: a straight internode (drawing rules 1 and 3).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cell {
    /// Its length, metres.
    #[schemars(with = "Constant", extend("minimum" = 0, "maximum" = 1000))]
    pub length_m: Constant,
    /// Its diameter, millimetres; 50 (assumed) if not given, for the paper draws lines.
    #[serde(default = "assumed_diameter")]
    #[schemars(with = "Constant", extend("minimum" = 0, "maximum" = 1_000_000))]
    pub diameter_mm: Constant,
}

fn assumed_diameter() -> Constant {
    Constant::from(crate::law::ConstantForm { value: 50.0, assumed: true, ..crate::law::ConstantForm::default() })
}

impl D0l {
    /// The model, grown at most to the age `until`; the parameters stand at `path` in their file.
    ///
    /// # Errors
    /// Every fault found, each with its path below `path`.
    pub fn compile(&self, until: Tick, path: &Path) -> Result<D0lModel, Vec<Fault>> {
        let mut faults = Vec::new();
        if until > LAST_TICK {
            faults.push(Fault::new(path, format!("the last age is {until}"), format!("at most {LAST_TICK}")));
        }
        let letters = self.letters(path, &mut faults);
        let mut sizes = Vec::new();
        for (letter, cell) in &self.cell {
            let path = path.key("cell").key(letter);
            let length = cell.length_m.within(&path.key("length_m"), LENGTH);
            let diameter = cell.diameter_mm.within(&path.key("diameter_mm"), DIAMETER);
            sizes.push([length, diameter].map(|size| size.map_err(|fault| faults.push(fault)).unwrap_or_default()));
        }
        let angle = self.branching_deg.within(&path.key("branching_deg"), ANGLE);
        let angle = angle.map_err(|fault| faults.push(fault)).unwrap_or_default();
        let axiom = text(&self.axiom, &letters, &path.key("axiom"), &mut faults);
        let productions = self.productions(&letters, path, &mut faults);
        if faults.is_empty() {
            self.check_deaths(&Rules { axiom: axiom.clone(), productions: productions.clone() }, path, &mut faults);
        }
        if faults.is_empty() {
            Ok(D0lModel::new(Rules { axiom, productions }, &sizes, angle.to_radians()))
        } else {
            Err(faults)
        }
    }

    /// The letters of the cells, in the order of their numbers.
    fn letters(&self, path: &Path, faults: &mut Vec<Fault>) -> Vec<char> {
        let path = path.key("cell");
        if self.cell.len() > MOST_CELLS {
            let problem = format!("there are {} cells", self.cell.len());
            faults.push(Fault::new(&path, problem, format!("at most {MOST_CELLS}")));
        }
        let letter = |name: &String| {
            let mut characters = name.chars();
            let letter = characters.next().filter(|letter| letter.is_alphanumeric());
            letter.filter(|_| characters.next().is_none()).unwrap_or_else(|| {
                let expected = "one letter or digit, such as `g`";
                faults.push(Fault::new(
                    &path.key(name),
                    format!("the cell `{name}` is not named by one letter"),
                    expected,
                ));
                UNREADABLE
            })
        };
        self.cell.keys().map(letter).collect()
    }

    fn productions(&self, letters: &[char], path: &Path, faults: &mut Vec<Fault>) -> Vec<Option<Vec<Symbol>>> {
        let path = path.key("production");
        for name in self.production.keys().filter(|name| !self.cell.contains_key(*name)) {
            let expected = format!("one of {}", self.cell.keys().cloned().collect::<Vec<_>>().join(", "));
            faults.push(Fault::new(&path.key(name), format!("unknown cell `{name}`"), expected));
        }
        let of = |name: &String| self.production.get(name).map(|becomes| (path.key(name), becomes));
        let mut becomes = |(path, becomes): (Path, &String)| match becomes.trim() {
            "" => Vec::new(),
            _ => text(becomes, letters, &path, faults),
        };
        let productions = self.cell.keys().map(of);
        productions.map(|rule| rule.map(&mut becomes)).collect()
    }

    /// Adds a fault for each string that has, or comes to have, a cell that vanishes and that an apex or a branch rests
    /// on: both would hang in the air.
    fn check_deaths(&self, rules: &Rules, path: &Path, faults: &mut Vec<Fault>) {
        let names: Vec<&String> = self.cell.keys().collect();
        let ends_in = vanishing(&rules.productions);
        let by_name = |letter: usize| path.key("production").key(names[letter]);
        let strings = rules.productions.iter().enumerate();
        let strings = strings.filter_map(|(letter, rule)| rule.as_ref().map(|rule| (by_name(letter), rule, false)));
        for (path, string, ends) in [(path.key("axiom"), &rules.axiom, true)].into_iter().chain(strings) {
            let rests = bearing(string, ends).into_iter();
            let Some((cell, gone)) = rests.filter_map(|cell| Some((cell, ends_in[usize::from(cell)]?))).next() else {
                continue;
            };
            let (cell, gone) = (names[usize::from(cell)], names[gone]);
            let becomes = if cell == gone { String::new() } else { format!(" becomes `{gone}`, which") };
            let problem = format!("`{cell}` ends an axis or bears a branch, and it{becomes} vanishes");
            let expected = format!("another cell there, or a production of `{gone}` that is not empty");
            faults.push(Fault::new(&path, problem, expected));
        }
    }
}

/// For each letter the letter that vanishes and that stands, after some ticks, at the end of what the letter has
/// become; `None` where there is none, so that something may rest on the letter for ever.
fn vanishing(productions: &[Option<Vec<Symbol>>]) -> Vec<Option<usize>> {
    let follow = |start: usize| {
        let mut letter = start;
        for _ in 0..=productions.len() {
            match productions[letter].as_deref() {
                None => return None,
                Some([]) => return Some(letter),
                Some(symbols) => letter = usize::from(last_cell(symbols)?),
            }
        }
        None
    };
    (0..productions.len()).map(follow).collect()
}

fn text(text: &str, letters: &[char], path: &Path, faults: &mut Vec<Fault>) -> Vec<Symbol> {
    parse(text, letters).unwrap_or_else(|(problem, expected)| {
        faults.push(Fault::new(path, problem, expected));
        Vec::new()
    })
}
