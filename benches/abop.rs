//! The ternary tree of *The Algorithmic Beauty of Plants* (Fig. 2.8a), an L-system of a file: its string drawn by the
//! turtle, beside the pose of the plant that it describes; and its records at every step, beside the parquet crate.
//!
//! The bars: twice the time of the pose for as many segments, and 1.3 times that of the writer. Absent: the derivation,
//! which has a bench of its own (`models/rewriting/benches/ternary.rs`).

mod specimen;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use phytomer::models::lsystem::turtle::{Command, Drawing, Turtle};
use phytomer::models::lsystem::view::View;
use phytomer::sim::pose::pose;
use phytomer::sim::random::PlantRandom;
use phytomer_rewriting::{Derived, Program, Reading, Symbol, Unanswered};
use specimen::Specimen;
use specimen::turns::by_turns;
use std::hint::black_box;

/// The steps of the plant, which then has 13,121 segments.
const STEPS: u32 = 8;
const TERNARY: &str = "ω : !(1)F(200)/(45)A\n\
    p1 : A → !(1.732)F(50)[&(18.95)F(50)A]/(94.74)[&(18.95)F(50)A]/(132.63)[&(18.95)F(50)A]\n\
    p2 : F(l) → F(l*1.109)\np3 : !(w) → !(w*1.732)\n";
const VIEW: &str = "tropism direction: 0.00,-1.00,0.00\ninitial elasticity: 0.22\n";

fn string() -> (Program, Derived) {
    let program = Program::read(TERNARY, &Reading::of("2.8a")).expect("a program");
    let mut derived = program.sow(PlantRandom::new(1, 1), &mut Unanswered).expect("an axiom");
    (0..STEPS).for_each(|_| program.step(&mut derived, &mut Unanswered).expect("a step"));
    (program, derived)
}

/// So many plants, of which every step is recorded.
fn specimen_of(plants: u32) -> Specimen {
    let scenario = format!(
        "name = \"abop\"\nspecies = \"abop/2.8a\"\nplants = {plants}\nages = {{ until = {STEPS}, record = \"all\" }}\n"
    );
    Specimen::of_text("abop", &scenario)
}

/// A turtle, and the string that it reads.
struct Reader {
    program: Program,
    derived: Derived,
    commands: Vec<Command>,
    turtle: Turtle,
}

impl Reader {
    fn new() -> Self {
        let (program, derived) = string();
        let symbols = program.symbols();
        let commands = (0..symbols.len()).map(|n| Command::of(symbols.name(Symbol(n as u16)))).collect();
        Self { program, derived, commands, turtle: Turtle::new(&View::read(VIEW).expect("a view")) }
    }

    /// Lets the turtle read the string; how many lines it has drawn.
    fn read(&mut self) -> usize {
        let Self { program, derived, commands, turtle } = self;
        let mut lines = 0;
        turtle.restart();
        let drawn = program.draw(derived, |module| {
            let command = commands[usize::from(module.symbol.0)];
            lines += usize::from(matches!(turtle.follow(command, module.parameters), Some(Drawing::Line { .. })));
        });
        drawn.expect("a drawing");
        lines
    }
}

fn abop(criterion: &mut Criterion) {
    let specimen = specimen_of(8);
    let mut reader = Reader::new();
    let segments = reader.read();
    assert_eq!(segments, specimen.grown().plants[0].nodes.len());
    let mut group = specimen.group(criterion, "interpretation (internodes)", Throughput::Elements(segments as u64));
    group.bench_function("turtle", |bencher| bencher.iter(|| black_box(reader.read())));
    group.finish();
    specimen.frames(criterion);
    specimen.records(criterion);
}

/// The ratios by turns, for `PHYTOMER_PAIRS=20 cargo bench --bench abop -- turns`: the turtle beside the pose, and the
/// records of eight plants and of sixty-four.
fn turns(_: &mut Criterion) {
    const TIMES: usize = 50;
    let Some(pairs) = std::env::var("PHYTOMER_PAIRS").ok().and_then(|pairs| pairs.parse().ok()) else { return };
    let (specimen, mut reader) = (specimen_of(8), Reader::new());
    let mut plot = specimen.grown();
    let read = || {
        for _ in 0..TIMES {
            black_box(reader.read());
        }
    };
    let posed = || {
        for _ in 0..TIMES {
            plot.plants[0].frames.clear();
            pose(&mut plot.plants[0], STEPS);
        }
    };
    by_turns("abop: turtle beside the pose", pairs, || (), read, posed);
    [8, 64].into_iter().for_each(|plants| specimen_of(plants).records_by_turns(pairs));
}

criterion_group!(benches, abop, turns);
criterion_main!(benches);
