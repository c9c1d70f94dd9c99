//! An L-system of a text with the files beside it, and what a species states of it; read, checked and compiled.
//!
//! Every text is handed over by its name: nothing is read here from a disk. Absent: which keys of a species these are
//! (`parameters`).

use super::columns::Measures;
use super::curves::Curves;
use super::environment::Environment;
use super::form::ViewForms;
use super::model::{TextModel, shape};
use super::role::Roles;
use super::script::{Script, Scripts};
use super::shapes::ShapeFunctions;
use super::world::World;
use crate::law::{At, VariateTable};
use crate::lsystem::turtle::Turtle;
use crate::lsystem::view::{Colours, Contour, Function, Surface, TextFault, View};
use crate::shapes::Named;
use phytomer_looks::{Bark, InternodePaint, OrganPaint, Paints, Section, Surface as Form};
use phytomer_rewriting::{Limits, Outside, Program, Reading, Refused};
use phytomer_sim::key::{LineageKey, mix};
use phytomer_sim::plant::{Class, Habit, InternodeLook, Kind, Looks, OrganLook, Trend};
use phytomer_sim::random::{PlantRandom, Purpose};
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

/// The module that the environment answers.
const ENVIRONMENT: &str = "?E";
/// The diameter of a line of a pixel in lengths of a step, where a view file counts widths in pixels. Assumed.
const PIXEL: f64 = 0.02;

/// An L-system of a text, and what is stated of it.
#[derive(Debug, Clone, Default)]
pub struct TextSystem {
    /// The name of its file.
    pub file: String,
    /// The name of its view file; `None` for the values of cpfg.
    pub view: Option<String>,
    /// The name of its map of colours (`.map`) or of materials (`.mat`).
    pub colours: Option<String>,
    /// Every text, by its name.
    pub texts: BTreeMap<String, String>,
    /// The bytes of maps, by their names.
    pub maps: BTreeMap<String, Vec<u8>>,
    /// The constants that are set, by their names; a plant draws each that is drawn once for its whole life.
    pub define: Vec<(String, VariateTable)>,
    /// The shapes that the file may call, by their names.
    pub shapes: Named,
    /// What answers the query `?E`.
    pub environment: Option<Environment>,
    /// The kinds of modules, by their names.
    pub kinds: BTreeMap<String, Kind>,
    /// The most that a derivation may come to.
    pub limits: Limits,
    /// The modules that go on as the last of their symbol in a successor.
    pub continues_last: Vec<String>,
    /// The length of a step of 1, metres.
    pub step_m: f64,
    /// The diameter of a line of width 1, metres; `None`: as the view file counts widths.
    pub width_m: Option<f64>,
}

/// What is wrong with a text or with what is stated of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Wrong {
    /// A place in a text.
    Text {
        /// The name of the text.
        file: String,
        /// What is wrong in it, and where.
        fault: TextFault,
    },
    /// A constant that is set and that the file does not name, by its name.
    Constant(String),
    /// The environment is stated, and no module asks it.
    Unasked,
    /// The kind of a module.
    Kind {
        /// The name of the module.
        module: String,
        /// What is wrong.
        problem: String,
        /// What would be right.
        expected: String,
    },
}

impl TextSystem {
    /// Reads and compiles it.
    ///
    /// # Errors
    /// Everything that is wrong with its texts and with what is stated of it.
    pub fn compile(&self) -> Result<TextModel, Vec<Wrong>> {
        let mut wrong = Vec::new();
        let view = self.view(&mut wrong);
        let shown = Shown { surfaces: self.surfaces(&view, &mut wrong), contours: self.contours(&view, &mut wrong) };
        let shapes = ShapeFunctions::of(&self.shapes, self.step_m);
        let world = Arc::new(World { curves: self.curves(&view, &mut wrong), shapes });
        let colours = self.colours(&mut wrong);
        let middle: Vec<(String, f64)> = self.constants(|_| u32::MAX / 2);
        match self.script(&middle, &world) {
            Ok(script) if self.environment.is_some() && script.program.symbols().symbol(ENVIRONMENT).is_none() => {
                Err(wrong.into_iter().chain([Wrong::Unasked]).collect())
            }
            Ok(script) if wrong.is_empty() => Ok(self.model(script, &world, &view, shown, colours.as_ref())),
            Ok(_) => Err(wrong),
            Err(more) => Err(wrong.into_iter().chain(more).collect()),
        }
    }

    /// The constants, each drawn by the word that `word` has for its name.
    fn constants(&self, word: impl Fn(&str) -> u32) -> Vec<(String, f64)> {
        let drawn = |(name, law): &(String, VariateTable)| (name.clone(), law.draw_f64(word(name), At::default()));
        self.define.iter().map(drawn).collect()
    }

    /// The program with these constants, and what its modules are.
    fn script(&self, define: &[(String, f64)], world: &Arc<World>) -> Result<Script, Vec<Wrong>> {
        let program = self.program(define, world)?;
        let kind = |(module, problem, expected)| Wrong::Kind { module, problem, expected };
        match Roles::of(program.symbols(), &self.kinds) {
            Ok(roles) => Ok(Script { program, roles }),
            Err(refused) => Err(refused.into_iter().map(kind).collect()),
        }
    }

    fn model(
        &self,
        script: Script,
        world: &Arc<World>,
        view: &View,
        shown: Shown,
        colours: Option<&Colours>,
    ) -> TextModel {
        let angle_deg = script.program.settings().angle_deg.unwrap_or(view.angle_deg);
        let turtle = Turtle::new(&View { angle_deg, ..view.clone() });
        let width = self.width_m.unwrap_or(if view.width_in_units { self.step_m } else { self.step_m * PIXEL });
        let mut kinds: Vec<Kind> = self.kinds.values().copied().filter(|k| k.class() == Class::Internode).collect();
        kinds.push(Kind::Internode);
        kinds.sort_unstable();
        kinds.dedup();
        let (looks, places, mut paints) = looks(&kinds, view.tapered_lines, colours);
        let named = shown.named(&mut paints);
        // A contour is as wide at the base of a part as at its tip in proportion, so that its share is that of areas.
        let bulks = paints.sections().iter().map(|section| section.bulk([1.0; 2], 1.0) as f32).collect();
        let measures = Measures { step: self.step_m, width, looks: places, coloured: colours.is_some(), bulks };
        let for_drawing = paints.into_habit();
        let habit = Habit { trends: vec![Trend::STRAIGHT], looks, for_drawing, ..Habit::default() };
        let tapered = view.tapered_lines;
        let is_drawn = self.define.iter().any(|(_, law)| law.is_random());
        let of_each = || Box::new(OfEachPlant { system: self.clone(), world: Arc::clone(world) });
        let drawn = is_drawn.then(|| of_each() as Box<dyn Scripts>);
        let (script, environment) = (Arc::new(script), self.environment.clone());
        TextModel { script, drawn, turtle, view: named, environment, measures, tapered, habit: Arc::new(habit) }
    }

    fn view(&self, wrong: &mut Vec<Wrong>) -> View {
        let Some((name, text)) = self.view.as_ref().and_then(|name| self.text(name, wrong)) else {
            // Without a view file a width is a length, as in the book.
            return View { width_in_units: false, ..View::default() };
        };
        View::read(text).unwrap_or_else(|faults| {
            wrong.extend(faults.into_iter().map(|fault| in_text(name, fault)));
            View::default()
        })
    }

    /// The text with a name; where there is none that is wrong.
    fn text<'t>(&'t self, name: &'t str, wrong: &mut Vec<Wrong>) -> Option<(&'t str, &'t str)> {
        let text = self.texts.get(name).map(|text| (name, text.as_str()));
        if text.is_none() {
            wrong.push(in_text(name, missing()));
        }
        text
    }

    /// The curved surfaces of the view file by their symbols.
    fn surfaces(&self, view: &View, wrong: &mut Vec<Wrong>) -> Vec<(char, Form)> {
        let mut surfaces = Vec::new();
        for named in &view.surfaces {
            let Some((name, text)) = self.text(&named.file, wrong) else { continue };
            match Surface::read(text) {
                Ok(surface) => surfaces.push((named.symbol, surface.form(named.size, named.steps))),
                Err(fault) => wrong.push(in_text(name, fault)),
            }
        }
        surfaces
    }

    /// The contours of the view file by their numbers.
    fn contours(&self, view: &View, wrong: &mut Vec<Wrong>) -> Vec<(i32, Section)> {
        let mut contours = Vec::new();
        for (number, file) in &view.contours {
            let Some((name, text)) = self.text(file, wrong) else { continue };
            match Contour::read(text) {
                Ok(contour) => contours.push((*number, contour.section(view.contour_sides))),
                Err(fault) => wrong.push(in_text(name, fault)),
            }
        }
        contours
    }

    fn curves(&self, view: &View, wrong: &mut Vec<Wrong>) -> Curves {
        let mut curves = Vec::new();
        if let Some((name, text)) = view.function_set.as_ref().and_then(|name| self.text(name, wrong)) {
            match Function::read_set(text) {
                Ok(functions) => curves = functions,
                Err(fault) => wrong.push(in_text(name, fault)),
            }
        }
        for name in &view.functions {
            let Some((name, text)) = self.text(name, wrong) else { continue };
            match Function::read(text) {
                Ok(function) => curves.push(function),
                Err(fault) => wrong.push(in_text(name, fault)),
            }
        }
        Curves(curves)
    }

    fn colours(&self, wrong: &mut Vec<Wrong>) -> Option<Colours> {
        let name = self.colours.as_ref()?;
        let Some(bytes) = self.maps.get(name) else {
            wrong.push(in_text(name, missing()));
            return None;
        };
        let read = if name.ends_with(".mat") { Colours::of_materials(bytes) } else { Colours::of_map(bytes) };
        read.map_err(|fault| wrong.push(in_text(name, fault))).ok()
    }

    fn program(&self, define: &[(String, f64)], world: &Arc<World>) -> Result<Program, Vec<Wrong>> {
        let mut wrong = Vec::new();
        let Some((_, text)) = self.text(&self.file, &mut wrong) else { return Err(wrong) };
        let include = |name: &str| {
            let missing = || {
                let problem = "there is no file of this name in the folder of the L-system that can be read";
                let outside = name.starts_with('/') || name.split(['/', '\\']).any(|part| part == "..");
                if outside { "it may lie outside the folder of the L-system" } else { problem }.to_owned()
            };
            self.texts.get(name).cloned().ok_or_else(missing)
        };
        let reading = Reading {
            define,
            outside: Arc::clone(world) as Arc<dyn Outside>,
            include: &include,
            continues_last: &self.continues_last,
            ..Reading::of(&self.file)
        };
        let mut program = Program::read(text, &reading).map_err(|refused| Wrong::all(&refused))?;
        program.limits = self.limits;
        Ok(program)
    }
}

impl Wrong {
    /// Everything that is wrong with the text of an L-system.
    pub(in crate::lsystem) fn all(refused: &Refused) -> Vec<Self> {
        let of = |fault: &phytomer_rewriting::Fault| {
            let (line, column) = (fault.place.line, fault.place.column);
            let (problem, expected) = (fault.problem.clone(), fault.expected.clone());
            in_text(refused.file(fault), TextFault { line, column, problem, expected })
        };
        let unknown = refused.unknown.iter().cloned().map(Self::Constant);
        refused.faults.iter().map(of).chain(unknown).collect()
    }

    /// There is no text of this name.
    pub(in crate::lsystem) fn missing(file: &str) -> Self {
        in_text(file, missing())
    }
}

/// What the view file names, ready to be drawn.
struct Shown {
    surfaces: Vec<(char, Form)>,
    contours: Vec<(i32, Section)>,
}

impl Shown {
    /// Puts all into the paints; the names in their places there.
    fn named(self, paints: &mut Paints) -> ViewForms {
        let mut named = ViewForms::default();
        for (symbol, form) in self.surfaces {
            paints.add_surface(form);
            named.surfaces.push(symbol);
        }
        for (number, section) in self.contours {
            paints.add_section(section);
            named.contours.push(number);
        }
        named
    }
}

/// A system of which each plant has constants of its own.
#[derive(Debug)]
struct OfEachPlant {
    system: TextSystem,
    world: Arc<World>,
}

impl Scripts for OfEachPlant {
    /// Each constant has a word of its own by its name, whether it is drawn or not.
    fn script(&self, random: &PlantRandom) -> Result<Script, String> {
        let word = |name: &str| {
            let key = name.bytes().fold(LineageKey::SEED.0, |key, byte| mix(key, byte.into()));
            random.stream(LineageKey(key), Purpose::Plant).word()
        };
        let told = |wrong: Vec<Wrong>| wrong.iter().map(Wrong::to_string).collect::<Vec<_>>().join("; ");
        self.system.script(&self.system.constants(word), &self.world).map_err(told)
    }
}

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Text { file, fault: TextFault { line, column, problem, expected } } => {
                write!(f, "{file}:{line}:{column}: {problem}; expected {expected}")
            }
            Self::Constant(name) => write!(f, "no constant is named `{name}`; expected a name of the file"),
            Self::Unasked => write!(f, "no module `{ENVIRONMENT}` asks the environment; expected such a module"),
            Self::Kind { module, problem, expected } => write!(f, "`{module}`: {problem}; expected {expected}"),
        }
    }
}

fn in_text(file: &str, fault: TextFault) -> Wrong {
    Wrong::Text { file: file.to_owned(), fault }
}

fn missing() -> TextFault {
    let problem = "there is no such file".to_owned();
    TextFault { line: 1, column: 1, problem, expected: "a file in the folder of the L-system".to_owned() }
}

/// The looks of internodes, by kinds and, where there are colours, by colour; the place of the first of each kind; and
/// how they are drawn.
fn looks(kinds: &[Kind], tapered: bool, colours: Option<&Colours>) -> (Looks, Vec<(Kind, u16)>, Paints) {
    let plain = Looks::of_shape(shape(tapered));
    let mut paints = Paints::default();
    let (mut apart, mut organs_apart, mut places) = (Vec::new(), Vec::new(), Vec::new());
    let numbers = if colours.is_some() { 0..256 } else { 0..1 };
    for &kind in kinds {
        places.push((kind, apart.len() as u16));
        for number in numbers.clone() {
            let colour = colours.and_then(|colours| colours.get(number));
            let bark = Bark { shoot: colour, young: colour, old: colour, ..Bark::default() };
            let paint = paints.add_internode(InternodePaint { bark, ..InternodePaint::default() });
            apart.push(InternodeLook { kind, paint, ..InternodeLook::of_shape(shape(tapered)) });
        }
    }
    for number in numbers.filter(|_| colours.is_some()) {
        let colour = colours.and_then(|colours| colours.get(number));
        let paint = paints.add_organ(OrganPaint { young: colour, old: colour, ..OrganPaint::default() });
        organs_apart.push(OrganLook { paint, expansion: Vec::new() });
    }
    (Looks { apart, organs_apart, ..plain }, places, paints)
}
