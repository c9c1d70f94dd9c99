//! `?E` against closed forms: tips in a plane, a lone tip, the square grid of Ulam, the field of a shape; and the many
//! points of a plant against a comparison of all pairs.

use super::environment::{Asked, Environment};
use super::{TextModel, TextSystem};
use crate::lsystem::turtle::Vector;
use phytomer_rewriting::{Answers, Derived, Interpreter, Program};
use phytomer_sim::random::PlantRandom;
use phytomer_sim::shape::{Shape, Sphere};
use std::sync::Arc;

fn model(text: &str, environment: Environment, step_m: f64) -> TextModel {
    let texts = [("plant.l", text), ("plant.v", "angle increment: 90")];
    let texts = texts.map(|(name, text)| (name.to_owned(), text.to_owned())).into();
    let (file, view) = ("plant.l".to_owned(), Some("plant.v".to_owned()));
    let system = TextSystem { file, view, texts, environment: Some(environment), step_m, ..TextSystem::default() };
    system.compile().unwrap_or_else(|wrong| panic!("{wrong:?}"))
}

fn derived(model: &TextModel, steps: u32) -> Derived {
    model.derive(PlantRandom::new(1, 0), steps).unwrap_or_else(|stopped| panic!("{stopped}"))
}

/// The parameters of all queries, in the order of the string.
fn answers(model: &TextModel, steps: u32) -> Vec<Vec<f64>> {
    let derived = derived(model, steps);
    let symbols = model.program().symbols();
    let queries = derived.string().modules().filter(|module| symbols.name(module.symbol) == "?E");
    queries.map(|query| query.parameters.to_vec()).collect()
}

/// Two tips 2·sin 30° = 1 step apart are near within that and within more, and not within less; the node that bears a
/// query never counts, and what is behind the first parameter stays.
#[test]
fn two_tips_in_a_plane() {
    let tips = "Lsystem: 1\nAxiom: [+(30)F?E(7,8)][-(30)F?E(7,8)]\nendlsystem\n";
    let found = |radius_m| answers(&model(tips, Environment::Collision { radius_m }, 0.5), 0);
    assert_eq!(found(0.499), [[1.0, 8.0]; 2]);
    assert_eq!(found(0.501), [[0.0, 8.0]; 2]);
    // A tip over the node of another line, 3 and 4 steps away: exactly 5 steps are near.
    let over = "Lsystem: 1\nAxiom: [f(3)F(1)][f(-1)-f(4)+F(1)?E(9)]\nendlsystem\n";
    let found = |radius_m| answers(&model(over, Environment::Collision { radius_m }, 1.0), 0);
    let distance = 32.0_f64.sqrt();
    assert_eq!((found(distance - 1e-9), found(distance + 1e-9)), (vec![vec![1.0]], vec![vec![0.0]]));
}

/// A lone tip grows on for ever; within more than a step it sees the node below that which bears it.
#[test]
fn a_lone_tip() {
    let lone = "Lsystem: 1\nAxiom: FA?E(1)\nA > ?E(x) : x == 1 --> FA\nA > ?E(x) : x == 0 --> *\nendlsystem\n";
    let length = |radius_m, steps| {
        let model = model(lone, Environment::Collision { radius_m }, 1.0);
        let derived = derived(&model, steps);
        derived.string().modules().filter(|m| model.program().symbols().name(m.symbol) == "F").count()
    };
    assert_eq!(length(0.99, 9), 10);
    // From two lines on the node below is at the distance of a step.
    assert_eq!(length(1.01, 9), 2);
}

/// Ulam's square grid: a tip tries the cells ahead and beside it; where two tips would meet in a cell, or the cell is
/// taken, none grows, and the queries stay there, so that none grows later. 1, 5, 9, 21, 25, 37, 49, 85 cells are 4, 8,
/// 20, 24, 36, 48, 84 lines beside the first cell.
#[test]
fn the_square_grid_of_ulam() {
    let text = "Lsystem: 1\nAxiom: [T][+T][++T][+++T]\nT --> fA?E(1)\n\
                A > ?E(x) : x == 1 --> f(-1)FB\nA --> *\nB --> [T][+T][-T]\n?E(x) : x == 1 --> *\nendlsystem\n";
    let model = model(text, Environment::Collision { radius_m: 0.1 }, 1.0);
    // A try, a decision and a branching are three steps.
    let lines = |generation: u32| {
        let derived = derived(&model, 3 * generation - 1);
        derived.string().modules().filter(|m| model.program().symbols().name(m.symbol) == "F").count()
    };
    assert_eq!([1, 2, 3, 4, 5, 6, 7].map(lines), [4, 8, 20, 24, 36, 48, 84]);
}

#[test]
fn the_field_of_a_shape() {
    // The turtle's (2, 6, −4) is the plant's (1, 2, 3) where a step is half a metre.
    let text = "Lsystem: 1\nAxiom: @M(2,6,-4)?E(0)@M(2.5,6,-4)?E(0,5)\nendlsystem\n";
    let ball = Shape::Sphere(Sphere { centre: [1.0, 2.0, 3.0], radius: 0.25 });
    let found = answers(&model(text, Environment::Field(Arc::new(ball)), 0.5), 0);
    assert_eq!(found, [vec![0.75], vec![0.5, 5.0]]);
}

/// Queries that nothing can answer are not there, and an environment that nothing asks is told.
#[test]
fn an_environment_that_nothing_asks() {
    let texts = [("plant.l".to_owned(), "Lsystem: 1\nAxiom: F\nendlsystem\n".to_owned())].into();
    let environment = Some(Environment::Collision { radius_m: 1.0 });
    let system = TextSystem { file: "plant.l".to_owned(), texts, environment, step_m: 1.0, ..TextSystem::default() };
    let told: Vec<String> = system.compile().expect_err("it is told").iter().map(ToString::to_string).collect();
    assert_eq!(told, ["no module `?E` asks the environment; expected such a module"]);
}

/// Takes the slots of queries of a string.
struct Slots(Vec<phytomer_rewriting::Slot>);

impl Interpreter for Slots {
    fn answer(&mut self, _: &Program, derived: &Derived, _: &mut Answers) -> Result<(), (String, String)> {
        self.0 = derived.string().modules().map(|module| module.slot).collect();
        Ok(())
    }
}

/// Three thousand points, some in one place, against all pairs.
#[test]
fn cells_find_what_all_pairs_find() {
    let text = format!("Lsystem: 1\nAxiom: {}\nendlsystem\n", "?E(0)".repeat(3000));
    let program = Program::read(&text, &phytomer_rewriting::Reading::of("many.l")).expect("a program");
    let mut slots = Slots(Vec::new());
    program.sow(PlantRandom::new(1, 0), &mut slots).expect("an axiom");
    let share = |k: usize, step: f64| (k as f64 * step).fract() - 0.5;
    let at = |k: usize| -> Vector {
        let k = if k % 50 == 7 { k - 1 } else { k };
        [40.0 * share(k, 0.819_172_513_4), 40.0 * share(k, 0.671_043_606_7), 40.0 * share(k, 0.549_700_477_9)]
    };
    let asked = slots.0.iter().enumerate().map(|(k, &query)| Asked { query, at: at(k), on: u32::MAX, rest: [0.0; 2] });
    let asked: Vec<Asked> = asked.collect();
    let found = Environment::Collision { radius_m: 2.0 }.answers(&asked, &[], 1.0);
    let distance = |a: Vector, b: Vector| (0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum::<f64>();
    let is_free = |k: usize| asked.iter().enumerate().all(|(o, other)| o == k || distance(asked[k].at, other.at) > 4.0);
    let expected: Vec<f64> = (0..asked.len()).map(|k| f64::from(is_free(k))).collect();
    assert_eq!(found, expected);
    let free = expected.iter().sum::<f64>();
    assert!((300.0..2700.0).contains(&free), "both answers are there: {free}");
}
