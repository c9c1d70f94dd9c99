//! The keys of a species whose model is an L-system: of a file of its own ([`text`](super::text)), or a D0L-system of
//! Aono & Kunii 1984 ([`d0l`](super::d0l)), whose strings stand in the species file itself or in a file of their own.
//!
//! A model reads no file: `config` puts the texts of the files into the table `texts`, so that a species carries them
//! wherever it goes. Absent: what the keys do.

mod of_cells;

use super::d0l::Cell;
use super::text::{Environment, TextModel, TextSystem, Wrong};
use crate::fault::{Fault, Path, Segment};
use crate::law::{Constant, Domain, ValueRange, Variate, VariateTable};
use crate::parameters::{Card, Keys, Parameters, Surroundings};
use crate::shapes::{Named, ShapeOrName, Shapes, one};
use phytomer_rewriting::Limits;
use phytomer_sim::Tick;
use phytomer_sim::clock::LAST_TICK;
use phytomer_sim::model::GrowthModel;
use phytomer_sim::plant::Kind;
use phytomer_sim::site::calendar::Dates;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The length of a step, and the diameter of a line of width 1.
const MEASURE: ValueRange = ValueRange { min: 1e-9, max: 1000.0, what: "a length in m" };

/// A constant of a file.
pub const CONSTANT: ValueRange = ValueRange { min: -1e30, max: 1e30, what: "a number" };

/// An L-system: of a file of its own, or a D0L-system of cells that are stated here.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lsystem {
    /// Of a D0L-system: the string at age 0: cells by their letters, and branches in parentheses, each behind a cell.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String", length(min = 1, max = 10_000))]
    pub axiom: Option<String>,
    /// Of a D0L-system: what each cell becomes at a tick: a string that begins with a cell, or an empty string where
    /// the cell vanishes. A cell that vanishes may bear no branch, and no axis may end with it. A cell without a
    /// production stays as it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "BTreeMap<String, String>")]
    pub production: Option<BTreeMap<String, String>>,
    /// Of a D0L-system: the cells, each by its letter.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "BTreeMap<String, Cell>")]
    pub cell: Option<BTreeMap<String, Cell>>,
    /// Of a D0L-system: the angle between a branch and what bears it, degrees (drawing rule 5).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Constant", extend("minimum" = 0, "maximum" = 180))]
    pub branching_deg: Option<Constant>,
    /// The file of an L-system (`.l`) in the folder of the species file, in the dialect of cpfg or in that of the
    /// papers, or in the `syntax` that is stated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String", length(min = 1, max = 255))]
    pub file: Option<String>,
    /// How the file is read: `d0l` for a D0L-system, which has its `axiom` and its productions in the file, with
    /// branches in parentheses (Aono & Kunii 1984). If not given, the file is in the dialect of cpfg or of the papers.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Syntax")]
    pub syntax: Option<Syntax>,
    /// Its view file; if not given, the view file (`.v`) of the same name, or the only one of the folder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String", length(min = 1, max = 255))]
    pub view: Option<String>,
    /// Its map of colours (`.map`) or of materials (`.mat`); if not given, that of the same name, or the only one of
    /// the folder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String", length(min = 1, max = 255))]
    pub colours: Option<String>,
    /// The length of a step of 1, metres; 1 if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Constant", extend("exclusiveMinimum" = 0, "maximum" = 1000))]
    pub step_m: Option<Constant>,
    /// The diameter of a line of width 1, metres; if not given, `step_m`, or a fiftieth of it where the view file
    /// counts widths in pixels.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Constant", extend("exclusiveMinimum" = 0, "maximum" = 1000))]
    pub width_m: Option<Constant>,
    /// Constants of the file: they stand for its `#define` of the same names. A plant draws a random one once for its
    /// whole life.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub define: BTreeMap<String, Variate>,
    /// Shapes by their names, as `[shape.NAME]`, metres from the seed of each plant. The file may call them:
    /// `inside_NAME(x, y, z)` and `field_NAME(x, y, z)`, and `prune(x, y, z)` where a shape has the name `prune`.
    #[serde(default, skip_serializing_if = "Shapes::is_empty")]
    pub shape: Shapes,
    /// What answers the query `?E` of the file after each step; if not given, it keeps its parameters.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "StatedEnvironment")]
    pub environment: Option<StatedEnvironment>,
    /// What modules are, by their names: `A = "apical_bud"`, `"@o" = "axillary_bud"`, `"~p" = "petal"`. A line is an
    /// internode and a surface or a polygon a leaf where nothing is stated.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub kinds: BTreeMap<String, String>,
    /// Which module of a successor goes on as the predecessor of the same name: `first`, if not given, or `last` where
    /// growth is intercalary.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub continues: BTreeMap<String, Continues>,
    /// The texts of the L-system and of the files beside it, by their names; what is not given is read from the folder
    /// of the species file. Maps of colours and materials are written as hexadecimal digits.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub texts: BTreeMap<String, String>,
}

/// How the file of an L-system is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Syntax {
    /// A D0L-system of cells, with branches in parentheses (Aono & Kunii 1984).
    D0l,
}

/// What answers the query `?E`, by what it `gives`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "gives", rename_all = "snake_case", deny_unknown_fields)]
pub enum StatedEnvironment {
    /// 1 where no other `?E` and no node of the plant is within a distance of the query, else 0. A node is the end of a
    /// line; that on which the query stands does not count.
    Collision {
        /// The distance, metres.
        #[schemars(range(min = 1e-9, max = 1e6))]
        radius_m: f64,
    },
    /// The light at the query; no site has light yet.
    Light {},
    /// The field of a shape at the query: ½ on its surface, greater within.
    Field {
        /// The shape: a table, or the name of a shape.
        shape: ShapeOrName,
    },
}

/// The module of a successor that goes on as its predecessor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Continues {
    /// The first of the same name.
    First,
    /// The last of the same name.
    Last,
}

impl Lsystem {
    /// The card of this model.
    pub const CARD: Card = Card {
        word: "lsystem",
        about: "a string of modules is rewritten at each tick and drawn by a turtle (Lindenmayer; Prusinkiewicz)",
        keys: Keys { referred_to: &["cell"], texts: Some("file"), ..Keys::PLAIN },
    };

    /// The L-system of the file that this names, compiled; `None` for a D0L-system of cells. The parameters stand
    /// at `top`.
    ///
    /// # Errors
    /// Every fault of the file, of what lies beside it, and of what is stated of it.
    pub fn text_model(&self, top: &Path) -> Option<Result<TextModel, Vec<Fault>>> {
        let system = self.text_system(top)?;
        Some(system.and_then(|system| system.compile().map_err(|wrong| Self::all_placed(wrong, top))))
    }

    /// The L-system of the file that this names, with all that is stated of it; `None` for a D0L-system of cells.
    ///
    /// # Errors
    /// Every fault of what is stated of it.
    pub fn text_system(&self, top: &Path) -> Option<Result<TextSystem, Vec<Fault>>> {
        Some(self.of_file(self.file.as_ref().filter(|_| !self.is_of_cells())?, top))
    }

    /// The L-system of a file.
    fn of_file(&self, file: &str, top: &Path) -> Result<TextSystem, Vec<Fault>> {
        let mut faults = Vec::new();
        let of_cells = [
            ("axiom", self.axiom.is_some()),
            ("production", self.production.is_some()),
            ("cell", self.cell.is_some()),
            ("branching_deg", self.branching_deg.is_some()),
        ];
        for (key, _) in of_cells.into_iter().filter(|(_, stated)| *stated) {
            let problem = format!("`{key}` stands beside `file`");
            faults.push(Fault::new(&top.key(key), problem, "a D0L-system, or an L-system of a file"));
        }
        let mut measure = |key: &str, stated: &Option<Constant>| {
            let stated = stated.as_ref().map(|measure| measure.within(&top.key(key), MEASURE));
            stated.and_then(|measure| measure.map_err(|fault| faults.push(fault)).ok())
        };
        let (step_m, width_m) = (measure("step_m", &self.step_m), measure("width_m", &self.width_m));
        let kinds = self.kinds(top, &mut faults);
        let (texts, maps) = self.texts(top, &mut faults);
        let define = self.constants(top, &mut faults);
        let shapes = Named::of(&self.shape, &top.key("shape"), &mut faults);
        let environment = self.environment(&shapes, &top.key("environment"), &mut faults);
        let last = self.continues.iter().filter(|(_, which)| **which == Continues::Last);
        let system = TextSystem {
            file: file.to_owned(),
            view: self.view.clone(),
            colours: self.colours.clone(),
            texts,
            maps,
            define,
            shapes,
            environment,
            kinds,
            continues_last: last.map(|(name, _)| name.clone()).collect(),
            limits: Limits::default(),
            step_m: step_m.unwrap_or(1.0),
            width_m,
        };
        if faults.is_empty() { Ok(system) } else { Err(faults) }
    }

    fn constants(&self, top: &Path, faults: &mut Vec<Fault>) -> Vec<(String, VariateTable)> {
        let mut constants = Vec::new();
        for (name, law) in &self.define {
            match law.compile(&Domain::ONCE, &top.key("define").key(name), CONSTANT) {
                Ok(law) => constants.push((name.clone(), law)),
                Err(found) => faults.extend(found),
            }
        }
        constants
    }

    fn environment(&self, shapes: &Named, path: &Path, faults: &mut Vec<Fault>) -> Option<Environment> {
        match self.environment.as_ref()? {
            StatedEnvironment::Collision { radius_m } => Some(Environment::Collision { radius_m: *radius_m }),
            StatedEnvironment::Field { shape } => {
                one(shape, shapes, &path.key("shape"), faults).map(Environment::Field)
            }
            StatedEnvironment::Light {} => {
                let problem = "no site has light yet, so nothing can answer `?E` by it";
                faults.push(Fault::new(&path.key("gives"), problem, "\"collision\" or \"field\""));
                None
            }
        }
    }

    fn kinds(&self, top: &Path, faults: &mut Vec<Fault>) -> BTreeMap<String, Kind> {
        let mut kinds = BTreeMap::new();
        for (module, tag) in &self.kinds {
            match Kind::ALL.into_iter().find(|kind| kind.tag() == tag) {
                Some(kind) => _ = kinds.insert(module.clone(), kind),
                None => {
                    let expected = format!("one of {}", Kind::ALL.map(Kind::tag).join(", "));
                    let path = top.key("kinds").key(module);
                    faults.push(Fault::new(&path, format!("unknown kind `{tag}`"), expected));
                }
            }
        }
        kinds
    }

    /// The texts, and the bytes of maps.
    fn texts(&self, top: &Path, faults: &mut Vec<Fault>) -> (BTreeMap<String, String>, BTreeMap<String, Vec<u8>>) {
        let (mut texts, mut maps) = (BTreeMap::new(), BTreeMap::new());
        for (name, text) in &self.texts {
            if !is_map(name) {
                texts.insert(name.clone(), text.clone());
                continue;
            }
            match bytes_of(text) {
                Some(bytes) => _ = maps.insert(name.clone(), bytes),
                None => {
                    let path = top.key("texts").key(name);
                    faults.push(Fault::new(&path, "these are no hexadecimal digits", "two digits for each byte"));
                }
            }
        }
        (texts, maps)
    }

    fn all_placed(wrong: Vec<Wrong>, top: &Path) -> Vec<Fault> {
        wrong.into_iter().map(|wrong| Self::placed(wrong, top)).collect()
    }

    /// What is wrong, at its place: in a text by its line and column, as the last two steps of the path.
    fn placed(wrong: Wrong, top: &Path) -> Fault {
        match wrong {
            Wrong::Text { file, fault } => {
                let path = top.key("texts").key(&file);
                let place = [fault.line, fault.column].map(|number| Segment::Index(number as usize));
                let path = Path(path.0.into_iter().chain(place).collect());
                Fault::new(&path, fault.problem, fault.expected)
            }
            Wrong::Constant(name) => {
                let problem = format!("no constant is named `{name}`");
                Fault::new(&top.key("define").key(&name), problem, "a name of the file of the L-system")
            }
            Wrong::Unasked => {
                let problem = "no module `?E` of the file asks the environment";
                Fault::new(&top.key("environment"), problem, "a file with such modules, or no `environment`")
            }
            Wrong::Kind { module, problem, expected } => Fault::new(&top.key("kinds").key(&module), problem, expected),
        }
    }
}

impl Parameters for Lsystem {
    fn card(&self) -> &'static Card {
        &Self::CARD
    }

    fn model(&self, until: Tick, _: Option<&Dates>, top: &Path) -> Result<Arc<dyn GrowthModel>, Vec<Fault>> {
        if self.is_of_cells() {
            return Ok(Arc::new(self.d0l(until, top)?));
        }
        if until > LAST_TICK {
            let fault = Fault::new(top, format!("the last age is {until}"), format!("at most {LAST_TICK}"));
            return Err(vec![fault]);
        }
        match self.text_model(top) {
            Some(model) => Ok(Arc::new(model?)),
            None => Err(Vec::new()),
        }
    }

    fn reads_surroundings(&self) -> bool {
        !self.is_of_cells()
    }

    fn surround(&mut self, surroundings: &Surroundings) {
        let Surroundings { shapes, constants } = surroundings;
        self.shape.extend(shapes.iter().map(|(name, shape)| (name.clone(), shape.clone())));
        self.define.extend(constants.iter().map(|(name, law)| (name.clone(), law.clone())));
    }

    /// The derivation length that the file states.
    fn full_grown_at(&self) -> Option<Tick> {
        let steps = match self.cell_program(&Path::root(), &[]) {
            Some(program) => program.ok()?.settings().steps,
            None => self.text_model(&Path::root())?.ok()?.derivation_length(),
        };
        steps.filter(|steps| (1..=LAST_TICK).contains(steps))
    }
}

/// Whether the bytes of a file are no text.
pub fn is_map(name: &str) -> bool {
    name.ends_with(".map") || name.ends_with(".mat")
}

/// Bytes as hexadecimal digits.
pub fn digits_of(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The bytes of hexadecimal digits.
fn bytes_of(digits: &str) -> Option<Vec<u8>> {
    let digits: Vec<u32> = digits.trim().chars().map(|digit| digit.to_digit(16)).collect::<Option<_>>()?;
    let pairs = digits.len().is_multiple_of(2).then(|| digits.chunks_exact(2))?;
    Some(pairs.map(|pair| (pair[0] * 16 + pair[1]) as u8).collect())
}
