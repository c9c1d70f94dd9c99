//! The ternary tree of Aono & Kunii 1984, Fig. 12a, at growth level 13: 2,391,484 branches, beside the binary tree of
//! Fig. 7b at growth level 20, 2,097,151 branches; and that tree with four controllers.
//!
//! The bars: the ternary tree grows at least 0.8 × as many branches a second as the binary one, and four controllers
//! take at most twice the time. `PHYTOMER_PAIRS=9 cargo bench -p phytomer-models --bench gmt3_12a -- turns` tells both
//! ratios by turns, which hold on a machine that does other work too.

use criterion::{Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use phytomer_models::fault::Path;
use phytomer_models::geometric::{Controller, Descriptor, Falloff, GeometricModel, GeometricTree, Rule, TreeType};
use phytomer_sim::plant::{MOST_COMPONENTS, Seed};
use phytomer_sim::plot::Plot;
use std::hint::black_box;
use std::time::{Duration, Instant};

fn model(of: TreeType, rule: Rule, levels: u32) -> GeometricModel {
    let tree = GeometricTree::from(Descriptor { first_length_m: 10.0.into(), ..Descriptor::new(rule, levels) });
    tree.compile(of, levels + 1, &Path::root()).expect("a sound tree")
}

fn rule([h1, h2]: [f64; 2], [r1, r2]: [f64; 2]) -> Rule {
    let [h1_deg, h2_deg, r1, r2, ratio, divergence] = [h1, h2, r1, r2, 0.7, 140.0].map(|number| Some(number.into()));
    Rule { h1_deg, h2_deg, r1, r2, diameter_ratio: ratio, divergence_deg: divergence, ..Rule::default() }
}

fn binary() -> Rule {
    rule([0.0, -45.0], [0.9, 0.7])
}

fn controlled() -> Rule {
    let places = [[30.0, 0.0, 0.0], [-30.0, 15.0, 0.0], [0.0, -30.0, 40.0], [10.0, 30.0, 60.0]];
    let falloff = Falloff::None;
    let controller = |at_m| Controller { factor: 0.1.into(), at_m, from_level: None, to_level: None, falloff };
    Rule { controller: Some(places.map(controller).to_vec()), ..binary() }
}

fn ternary() -> Rule {
    Rule { r0: Some(0.9.into()), ..rule([60.0, -60.0], [0.6, 0.6]) }
}

/// A tree that grows again and again in the same memory.
struct Sitter<'m> {
    name: &'static str,
    plot: Plot<'m>,
    age: u32,
    branches: usize,
}

impl<'m> Sitter<'m> {
    fn new(name: &'static str, model: &'m GeometricModel, levels: u32) -> Self {
        let mut sitter = Self { name, plot: Plot::of_one(model, &seed()), age: levels + 1, branches: 0 };
        sitter.grow();
        sitter.branches = sitter.plot.plants[0].nodes.len();
        sitter
    }

    fn grow(&mut self) {
        self.plot.resow(&seed());
        self.plot.grow_to(self.age).expect("room to grow");
        black_box(&self.plot);
    }

    /// Seconds a branch.
    fn timed(&mut self) -> f64 {
        let start = Instant::now();
        self.grow();
        start.elapsed().as_secs_f64() / self.branches as f64
    }
}

fn seed() -> Seed {
    Seed { plant: 0, draws: 0, run_seed: 1, component_limit: MOST_COMPONENTS, keep_events: false }
}

fn gmt3_12a(criterion: &mut Criterion) {
    let models = [
        model(TreeType::Gmt1, binary(), 20),
        model(TreeType::Gmt3, ternary(), 13),
        model(TreeType::Gmt2, controlled(), 20),
    ];
    let names = [("binary (baseline)", 20), ("ternary", 13), ("four controllers", 20)];
    for ((name, levels), model) in names.into_iter().zip(&models) {
        let mut sitter = Sitter::new(name, model, levels);
        let mut group = criterion.benchmark_group("gmt3_12a/growth (branches)");
        group.throughput(Throughput::Elements(sitter.branches as u64)).sampling_mode(SamplingMode::Flat);
        group.sample_size(10).measurement_time(Duration::from_secs(5));
        group.bench_function(sitter.name, |bencher| bencher.iter(|| sitter.grow()));
        group.finish();
    }
}

/// The two ratios by turns.
fn turns(_: &mut Criterion) {
    let Some(pairs) = std::env::var("PHYTOMER_PAIRS").ok().and_then(|pairs| pairs.parse::<usize>().ok()) else {
        return;
    };
    let baseline = model(TreeType::Gmt1, binary(), 20);
    for (name, of, rule, levels) in
        [("ternary", TreeType::Gmt3, ternary(), 13), ("four controllers", TreeType::Gmt2, controlled(), 20)]
    {
        let own = model(of, rule, levels);
        let (mut ours, mut theirs) = (Sitter::new(name, &own, levels), Sitter::new("binary", &baseline, 20));
        let mut ratios: Vec<f64> = (0..pairs).map(|_| ours.timed() / theirs.timed()).collect();
        ratios.sort_by(f64::total_cmp);
        println!("{name}: {:.2} x the time of the binary tree a branch, median of {pairs} pairs", ratios[pairs / 2]);
    }
}

criterion_group!(benches, gmt3_12a, turns);
criterion_main!(benches);
