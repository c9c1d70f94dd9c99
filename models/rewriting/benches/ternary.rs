//! The ternary tree of *The Algorithmic Beauty of Plants* (Fig. 2.8), derived: beside the crate symbios, the fastest
//! engine that was found; and beside a plain copy of the bytes of all its strings.
//!
//! symbios makes each string anew from the last, without identities; it ends with a full state at the twelfth step, of
//! 4.8 million modules. The bars: .7 of its time at the tenth step, 25 copies at the twelfth; and 200 steps of L-system
//! 5 of Synthetic Topiary in nine times the time of 100, which make an eighth of the modules.

use criterion::{BenchmarkGroup, Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use phytomer_rewriting::{Derived, Program, Reading, Unanswered};
use phytomer_sim::random::PlantRandom;
use std::hint::black_box;
use std::time::Duration;

const TERNARY: &str = "#define d1 94.74\n#define d2 132.63\n#define a 18.95\n#define lr 1.109\n#define vr 1.732\n\
    ω : !(1)F(200)/(45)A\np1 : A → !(vr)F(50)[&(a)F(50)A]/(d1)[&(a)F(50)A]/(d2)[&(a)F(50)A]\n\
    p2 : F(l) → F(l*lr)\np3 : !(w) → !(w*vr)\n";

/// Synthetic Topiary, L-system 5: a tree whose apices branch with a probability that falls with the step.
const BRANCHING: &str = "#define φ 90\n#define α 32\n#define β 20\nω : FA(1)\n\
    p1 : A(k) → /(φ)[+(α)FA(k+1)]−(β)FA(k+1) : min{1, (2k+1)/k^2}\n\
    p2 : A(k) → /(φ)B−(β)FA(k+1) : max{0, 1−(2k+1)/k^2}\n";

fn program(text: &str) -> Program {
    Program::read(text, &Reading::of("bench")).expect("a program")
}

fn derived(program: &Program, steps: u32) -> Derived {
    let mut derived = program.sow(PlantRandom::new(1, 1), &mut Unanswered).expect("an axiom");
    (0..steps).for_each(|_| program.step(&mut derived, &mut Unanswered).expect("a step"));
    derived
}

/// The same tree in the words of symbios.
fn by_symbios(steps: usize) -> Result<usize, symbios::system::SystemError> {
    let mut system = symbios::System::new();
    let successor = "!(1.732) F(50) [ &(18.95) F(50) A ] /(94.74) [ &(18.95) F(50) A ] /(132.63) [ &(18.95) F(50) A ]";
    system.add_rule(&format!("A -> {successor}"))?;
    system.add_rule("F(l) -> F(l*1.109)")?;
    system.add_rule("!(w) -> !(w*1.732)")?;
    system.set_axiom("!(1) F(200) /(45) A")?;
    system.derive(steps)?;
    Ok(black_box(&system).state.len())
}

fn settle(group: &mut BenchmarkGroup<'_, criterion::measurement::WallTime>, modules: usize) {
    group.throughput(Throughput::Elements(modules as u64)).sample_size(10).sampling_mode(SamplingMode::Flat);
    group.measurement_time(Duration::from_secs(3)).warm_up_time(Duration::from_millis(500));
}

fn ten_steps(criterion: &mut Criterion) {
    let program = program(TERNARY);
    let modules = derived(&program, 10).string().len();
    assert_eq!(modules, by_symbios(10).expect("a string"));
    let mut group = criterion.benchmark_group("ternary/ten steps (modules)");
    settle(&mut group, modules);
    group.bench_function("derivation", |bencher| bencher.iter(|| black_box(derived(&program, 10))));
    group.bench_function("symbios 1.5 (baseline)", |bencher| bencher.iter(|| by_symbios(10)));
    group.finish();
    assert!(by_symbios(12).is_err(), "symbios ends with a full state");
}

fn twelve_steps(criterion: &mut Criterion) {
    let program = program(TERNARY);
    let strings: Vec<Derived> = (0..=12).map(|steps| derived(&program, steps)).collect();
    let bytes: Vec<Vec<u8>> = strings.iter().map(|derived| vec![1; derived.string().bytes()]).collect();
    let modules = strings.last().map_or(0, |last| last.string().len());
    drop(strings);
    let mut group = criterion.benchmark_group("ternary/twelve steps (modules)");
    settle(&mut group, modules);
    group.bench_function("derivation", |bencher| bencher.iter(|| black_box(derived(&program, 12))));
    let mut copy = bytes.clone();
    group.bench_function("plain copy of the bytes of all strings (baseline)", |bencher| {
        bencher.iter(|| {
            copy.iter_mut().zip(&bytes).for_each(|(copy, bytes)| copy.copy_from_slice(black_box(bytes)));
            black_box(&copy);
        });
    });
    group.finish();
}

fn branching(criterion: &mut Criterion) {
    let program = program(BRANCHING);
    let mut group = criterion.benchmark_group("L-system 5 (modules)");
    for steps in [200, 100] {
        settle(&mut group, derived(&program, steps).string().len());
        let name = format!("{steps} steps{}", if steps == 100 { " (baseline)" } else { "" });
        group.bench_function(name, |bencher| bencher.iter(|| black_box(derived(&program, steps))));
    }
    group.finish();
}

criterion_group!(benches, ten_steps, twelve_steps, branching);
criterion_main!(benches);
