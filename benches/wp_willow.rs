//! The willow of Weber & Penn 1995 as its parameters are printed, with and without pruning, and its aspen: growth
//! beside the writing of the mesh.
//!
//! The bars: the willow without pruning grows within half of the time that its mesh takes to be written, and with it
//! within three times the time without; the aspen grows and is meshed within 1.5 times the time of a plant of the bud
//! model with as many components. Absent: degradation at range.

mod specimen;

use criterion::{Criterion, criterion_group, criterion_main};
use phytomer::config::validate_texts;
use phytomer::sim::Plot;
use specimen::Specimen;
use specimen::turns::by_turns;
use std::hint::black_box;

/// A scenario of one plant of a species that inherits from a shipped one.
fn inheriting(name: &'static str, from: &str, keys: &str) -> Specimen {
    let scenario =
        format!("name = \"{name}\"\nspecies = \"{name}_species\"\nplants = 1\nseed = 1995\n\n[ages]\nuntil = 1\n");
    let species = format!("name = \"{name}_species\"\ninherits = \"{from}\"\n{keys}\n");
    let texts = [(name, scenario.as_str()), (&*format!("{name}_species"), species.as_str())];
    let resolved = validate_texts(name, &texts).unwrap_or_else(|report| panic!("{}", report.render(false)));
    Specimen { name, resolved }
}

const UNPRUNED: (&str, &str, &str) = ("wp_willow_unpruned", "wp/weeping_willow", "PruneRatio = 0");
const PRUNED: (&str, &str, &str) = ("wp_willow", "wp/weeping_willow", "");
const ASPEN: (&str, &str, &str) = ("wp_aspen", "wp/quaking_aspen", "");

fn wp_willow(criterion: &mut Criterion) {
    for (name, from, keys) in [UNPRUNED, PRUNED, ASPEN] {
        let specimen = inheriting(name, from, keys);
        specimen.growth(criterion, false);
        specimen.ply(criterion);
    }
}

/// The internodes and organs of a plant.
fn components(plot: &Plot<'_>) -> usize {
    plot.plants[0].nodes.len() + plot.plants[0].organs.len()
}

/// A plant of the bud model with as many components as another one: the apple at the first age at which it has them.
fn budded(wanted: usize) -> Specimen {
    let at = |until: u32| {
        let text = format!("name = \"apple_{until}\"\nspecies = \"apple\"\nplants = 1\nages = {{ until = {until} }}\n");
        Specimen::of_text("an_apple", &text)
    };
    (1..200).map(at).find(|specimen| components(&specimen.grown()) >= wanted).expect("an apple of that size")
}

/// The ratios by turns, for `PHYTOMER_PAIRS=10 cargo bench --bench wp_willow -- turns`.
fn turns(_: &mut Criterion) {
    let Some(pairs) = std::env::var("PHYTOMER_PAIRS").ok().and_then(|pairs| pairs.parse().ok()) else { return };
    let [unpruned, pruned, aspen] = [UNPRUNED, PRUNED, ASPEN].map(|(name, from, keys)| inheriting(name, from, keys));
    let (drawn, mut plot) = (unpruned.grown(), unpruned.sown());
    println!("{}: {} components", unpruned.name, components(&drawn));
    let mut grow = || unpruned.grow_again(black_box(&mut plot));
    by_turns("wp_willow_unpruned: growth beside its mesh", pairs, || (), &mut grow, || unpruned.write_mesh(&drawn));
    let mut plot = pruned.sown();
    by_turns("wp_willow: pruned beside unpruned", pairs, || (), || pruned.grow_again(&mut plot), &mut grow);
    let of_aspen = components(&aspen.grown());
    let apple = budded(of_aspen);
    let of_apple = components(&apple.grown());
    let name = format!("wp_aspen of {of_aspen} components grown and meshed beside an apple of {of_apple}");
    by_turns(&name, pairs, || (), || aspen.write_mesh(&aspen.grown()), || apple.write_mesh(&apple.grown()));
}

criterion_group!(benches, wp_willow, turns);
criterion_main!(benches);
