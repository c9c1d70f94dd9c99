//! An L-system of a text as a growth model: a step a tick, each string drawn, and the plant written anew from it.
//!
//! The axiom is age 0. Queries are answered by drawing the string after each step. Absent: the language
//! (`phytomer_rewriting`), drawing (`draft`), numbers (`numbers`).

use super::columns::{Measures, write};
use super::draft::{Draft, Walk};
use super::environment::{Asked, Environment};
use super::events::{self, Noted};
use super::form::ViewForms;
use super::numbers::{Bud, Numbered, Numbers};
use super::script::{Script, Scripts};
use crate::lsystem::turtle::{Query, Turtle};
use phytomer_rewriting::{Answers, Derived, Drawn, Interpreter, Program, Stopped};
use phytomer_sim::clock::Tick;
use phytomer_sim::key::LineageKey;
use phytomer_sim::model::{Grow, Growth, Overgrown};
use phytomer_sim::plant::{ApexFate, AxisId, Class, EventKind, Habit, NodeId, OrganId, Plant, Shape};
use phytomer_sim::random::PlantRandom;
use phytomer_sim::site::View;
use std::cell::Cell;
use std::collections::BTreeSet;
use std::sync::Arc;

/// An L-system of a text, read and checked.
#[derive(Debug)]
pub struct TextModel {
    pub(super) script: Arc<Script>,
    /// Where plants draw constants: the script is then of one plant each.
    pub(super) drawn: Option<Box<dyn Scripts>>,
    pub(super) turtle: Turtle,
    pub(super) view: ViewForms,
    /// What answers `?E`; `None`: it keeps its parameters.
    pub(super) environment: Option<Environment>,
    pub(super) measures: Measures,
    pub(super) tapered: bool,
    pub(super) habit: Arc<Habit>,
}

/// What is remembered of a plant between ticks: its string, and the numbers of what stands.
#[derive(Debug, Clone)]
pub struct Life {
    /// The string, or why it came to a stop.
    derived: Result<Derived, Arc<str>>,
    script: Arc<Script>,
    numbers: Numbers,
    turtle: Turtle,
}

/// Memory that is used again at each tick, and from plant to plant.
#[derive(Debug, Default)]
struct Scratch {
    draft: Draft,
    numbered: Numbered,
    noted: Noted,
}

thread_local! {
    /// The scratch of a thread, so that a plot of many plants needs no more of it. It is taken out while it is used.
    static SCRATCH: Cell<Scratch> = Cell::default();
}

impl PartialEq for Life {
    fn eq(&self, other: &Self) -> bool {
        let same = |one: &Derived, other: &Derived| {
            let modules =
                |derived: &Derived| derived.string().modules().map(|m| (m.symbol, m.identity)).collect::<Vec<_>>();
            modules(one) == modules(other)
        };
        let strings = match (&self.derived, &other.derived) {
            (Ok(one), Ok(other)) => same(one, other),
            (one, other) => one.as_ref().err() == other.as_ref().err(),
        };
        strings && self.numbers == other.numbers
    }
}

/// Draws a string, and answers its queries by where they stand.
struct Drawing<'d> {
    model: &'d TextModel,
    script: &'d Script,
    turtle: &'d mut Turtle,
    draft: &'d mut Draft,
    /// Whether the string as it is now was drawn.
    drawn: bool,
}

impl Drawing<'_> {
    /// Makes the axiom of a plant, perhaps in the memory of another, and draws it.
    fn sow(&mut self, plant: &Plant, memory: Option<Derived>) -> Result<Derived, Stopped> {
        let derived = self.script.program.sow_again(memory, plant.random.clone(), self)?;
        if !self.drawn {
            self.draw(&self.script.program, &derived, |_, _, _| ())?;
        }
        Ok(derived)
    }

    /// Makes a step, and draws the string.
    fn step(&mut self, derived: &mut Derived) -> Result<(), Stopped> {
        self.script.program.step(derived, self)?;
        if !self.drawn {
            self.draw(&self.script.program, derived, |_, _, _| ())?;
        }
        Ok(())
    }

    fn draw(
        &mut self,
        program: &Program,
        derived: &Derived,
        mut answer: impl FnMut(&Drawn<'_>, Query, &Walk<'_>),
    ) -> Result<(), Stopped> {
        let mut walk = Walk::begin(self.script, &self.model.view, self.turtle, self.draft, derived);
        program.draw(derived, |drawn| {
            if let Some(query) = walk.go_on(&drawn) {
                answer(&drawn, query, &walk);
            }
        })?;
        walk.end();
        self.drawn = true;
        Ok(())
    }
}

impl Interpreter for Drawing<'_> {
    fn answer(&mut self, program: &Program, derived: &Derived, answers: &mut Answers) -> Result<(), (String, String)> {
        let mut asked = Vec::new();
        let told = self.draw(program, derived, |drawn, query, walk| {
            let frame = &walk.turtle().state().frame;
            let values = match query {
                // What a homomorphism draws is no module of the string.
                _ if drawn.depth > 0 => return,
                Query::Position => frame.position,
                Query::Axis(axis) => frame.axis(axis),
                Query::Environment => {
                    let rest = [1, 2].map(|place| drawn.parameters.get(place).copied().unwrap_or(0.0));
                    return asked.push(Asked { query: drawn.of, at: frame.position, on: walk.bearer(), rest });
                }
            };
            answers.give(drawn.of, values);
        });
        told.map_err(|stopped| (stopped.problem, stopped.expected))?;
        let Some(environment) = &self.model.environment else { return Ok(()) };
        let values = environment.answers(&asked, self.draft.lines(), self.model.measures.step);
        for (Asked { query, rest: [second, third], .. }, value) in asked.into_iter().zip(values) {
            if !value.is_finite() {
                return Err((format!("the answer to a query `?E` is {value}"), "a finite number".to_owned()));
            }
            answers.give(query, [value, second, third]);
        }
        Ok(())
    }
}

impl TextModel {
    /// How many steps the file asks for.
    pub fn derivation_length(&self) -> Option<Tick> {
        self.script.program.settings().steps
    }

    /// What the text says, as it is derived.
    pub fn program(&self) -> &Program {
        &self.script.program
    }

    /// Derives the string of a plant without making the plant: its queries are answered as in a plant that grows.
    /// Constants that plants draw have the middle of what they draw.
    ///
    /// # Errors
    /// Why a step cannot be made.
    pub fn derive(&self, random: PlantRandom, steps: Tick) -> Result<Derived, Stopped> {
        let (mut turtle, mut draft) = (self.turtle.clone(), Draft::default());
        let Script { program, .. } = &*self.script;
        let mut drawing =
            Drawing { model: self, script: &self.script, turtle: &mut turtle, draft: &mut draft, drawn: false };
        let mut derived = program.sow(random, &mut drawing)?;
        for _ in 0..steps {
            program.step(&mut derived, &mut drawing)?;
        }
        Ok(derived)
    }

    /// Draws a plant's string and writes its columns, at `age`; what stood before and stands no more departs.
    fn stand(&self, age: Tick, plant: &mut Plant, life: &mut Life, scratch: &mut Scratch) -> Result<(), Overgrown> {
        let Life { derived: Ok(derived), script, numbers, .. } = life else { return Ok(()) };
        let Scratch { draft, numbered, noted } = scratch;
        numbers.number(draft, age, plant, numbered);
        if plant.is_overgrown() {
            return Err(Overgrown::of(plant));
        }
        let lost = Lost::of(draft, derived);
        noted.begin(plant);
        // Without stated apices every bud lives on.
        if script.roles.states_apices {
            end_buds(draft, numbered, numbers, &lost, age, noted);
        }
        depart(plant, numbered, numbers, &lost, age, noted);
        plant.begin_rewriting();
        let bud = |number| if script.roles.states_apices { *numbers.bud(number) } else { Bud::ALIVE };
        write(draft, numbered, &self.measures, plant, bud);
        plant.age = age;
        events::note(plant, age, noted);
        Ok(())
    }

    /// Makes a step, and writes the plant that the string describes then.
    fn step(&self, plant: &mut Plant, life: &mut Life, scratch: &mut Scratch) -> Result<(), Overgrown> {
        let Life { derived, script, turtle, .. } = &mut *life;
        let derived = derived.as_mut().map_err(|why| Overgrown::stopped(plant, why))?;
        let draft = &mut scratch.draft;
        if let Err(stopped) = (Drawing { model: self, script, turtle, draft, drawn: false }).step(derived) {
            let why: Arc<str> = stopped.to_string().into();
            life.derived = Err(Arc::clone(&why));
            return Err(Overgrown::stopped(plant, &why));
        }
        self.stand(plant.age + 1, plant, life, scratch)
    }

    /// Sows a plant; its string and its numbers stand in the memory of others that are needed no more.
    fn sown(&self, plant: &mut Plant, memory: Option<Derived>, mut numbers: Numbers) -> Life {
        plant.name_by_number();
        numbers.clear();
        let (mut turtle, mut scratch) = (self.turtle.clone(), SCRATCH.take());
        let own = self.script_of(plant);
        let script = own.as_ref().unwrap_or(&self.script);
        let draft = &mut scratch.draft;
        let mut drawing = Drawing { model: self, script, turtle: &mut turtle, draft, drawn: false };
        let sown = drawing.sow(plant, memory).map_err(|stopped| stopped.to_string().into());
        let derived = own.clone().and(sown);
        let script = Arc::clone(script);
        let mut life = Life { derived, script, numbers, turtle };
        if life.derived.is_ok()
            && let Err(overgrown) = self.stand(0, plant, &mut life, &mut scratch)
        {
            life.derived = Err(overgrown.to_string().into());
        }
        SCRATCH.set(scratch);
        if life.derived.is_err() {
            plant.begin_rewriting();
            events::sow_alone(plant);
        }
        life
    }

    /// The script of a plant: its own where plants draw constants.
    fn script_of(&self, plant: &Plant) -> Result<Arc<Script>, Arc<str>> {
        match &self.drawn {
            Some(drawn) => drawn.script(&plant.random).map(Arc::new).map_err(Arc::from),
            None => Ok(Arc::clone(&self.script)),
        }
    }
}

/// The buds of axes that have lost their last apex end.
fn end_buds(draft: &Draft, numbered: &Numbered, numbers: &mut Numbers, lost: &Lost, age: Tick, noted: &mut Noted) {
    for (axis, born) in draft.axes.iter().zip(&numbered.axes) {
        let bud = numbers.bud(born.number);
        if bud.end.1 != ApexFate::Alive {
            continue;
        }
        match (axis.apex, bud.apex) {
            (Some((key, _)), _) => bud.apex = Some(key),
            (None, before) => {
                bud.end = (age, before.map_or(ApexFate::Completed, |key| lost.fate_of(key)));
                if age > 0 {
                    noted.add(born.number, event_of(bud.end.1), 1);
                }
            }
        }
    }
}

fn event_of(fate: ApexFate) -> EventKind {
    match fate {
        ApexFate::Flowered => EventKind::Flowered,
        ApexFate::Pruned => EventKind::Pruned,
        ApexFate::Completed => EventKind::Completed,
        _ => EventKind::Rewritten,
    }
}

/// Why modules are lost: which have become flowers, and which were cut off; all others were rewritten.
struct Lost {
    flowered: BTreeSet<LineageKey>,
    cut: BTreeSet<LineageKey>,
}

impl Lost {
    fn of(draft: &Draft, derived: &Derived) -> Self {
        let flowers = draft.organs.iter().filter(|organ| organ.kind.class() == Class::Flower);
        let flowered = flowers.map(|organ| organ.predecessor).collect();
        Self { flowered, cut: derived.cut().iter().copied().collect() }
    }

    fn fate_of(&self, key: LineageKey) -> ApexFate {
        if self.cut.contains(&key) {
            ApexFate::Pruned
        } else if self.flowered.contains(&key) {
            ApexFate::Flowered
        } else {
            ApexFate::Rewritten
        }
    }
}

/// Enters into the ledger what stands in the columns and stands no more.
fn depart(plant: &mut Plant, numbered: &Numbered, numbers: &mut Numbers, lost: &Lost, age: Tick, noted: &mut Noted) {
    let stands = |number: u32| numbered.stands.get(number as usize).copied().unwrap_or(false);
    for organ in (0..plant.organs.len()).map(|place| OrganId(place as u32)) {
        let number = plant.organs.component[organ.index()];
        if !stands(number) {
            let cause = lost.fate_of(numbers.module(number)).cause();
            let axis = plant.nodes.axis[plant.organs.node[organ.index()].index()];
            noted.add(plant.axes.component[axis.index()], EventKind::Rewritten, 1);
            plant.depart_organ(organ, age, cause);
        }
    }
    for node in (0..plant.nodes.len()).map(|place| NodeId(place as u32)) {
        let number = plant.nodes.component[node.index()];
        if !stands(number) {
            let cause = lost.fate_of(numbers.module(number)).cause();
            noted.add(plant.axes.component[plant.nodes.axis[node.index()].index()], EventKind::Rewritten, 1);
            plant.depart(node, age, cause);
        }
    }
    for axis in (0..plant.axes.len()).map(|place| AxisId(place as u32)) {
        let number = plant.axes.component[axis.index()];
        if !stands(number) {
            let bracket = numbers.module(number);
            let bud: Bud = *numbers.bud(number);
            let fate = lost.fate_of(bud.apex.unwrap_or(bracket));
            if bud.end.1 == ApexFate::Alive {
                noted.add(number, event_of(fate), 1);
            }
            plant.depart_axis(axis, age, fate.cause());
        }
    }
}

impl Grow for TextModel {
    type Life = Life;

    fn growth(&self) -> Growth {
        Growth::Rewrites
    }

    fn habit(&self) -> Arc<Habit> {
        Arc::clone(&self.habit)
    }

    fn sow(&self, plant: &mut Plant) -> Life {
        self.sown(plant, None, Numbers::default())
    }

    fn sow_again(&self, plant: &mut Plant, life: &mut Life) {
        let numbers = std::mem::take(&mut life.numbers);
        let memory = std::mem::replace(&mut life.derived, Err(Arc::default())).ok();
        *life = self.sown(plant, memory, numbers);
    }

    fn grow_to(&self, age: Tick, plant: &mut Plant, life: &mut Life, _: &View<'_>) -> Result<(), Overgrown> {
        let mut scratch = SCRATCH.take();
        let mut grown = Ok(());
        while grown.is_ok() && plant.age < age {
            grown = self.step(plant, life, &mut scratch);
        }
        SCRATCH.set(scratch);
        grown
    }

    /// A line has its own width where it begins; where lines are tapered it ends with the width of the line that
    /// follows on its axis.
    fn thicken(&self, _age: Tick, plant: &mut Plant) {
        let nodes = &mut plant.nodes;
        nodes.diameter.copy_from_slice(&nodes.primary_diameter);
        nodes.diameter_tip.copy_from_slice(&nodes.primary_diameter);
        if self.tapered {
            for node in 0..nodes.len() {
                let below = nodes.parent[node].some().map(NodeId::index);
                if let Some(below) = below.filter(|below| nodes.axis[*below] == nodes.axis[node]) {
                    nodes.diameter_tip[below] = nodes.primary_diameter[node];
                }
            }
        }
    }
}

/// The shape of internodes.
pub(super) fn shape(tapered: bool) -> Shape {
    if tapered { Shape::Cone } else { Shape::Cylinder }
}
