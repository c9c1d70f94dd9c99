//! The willow of Weber & Penn 1995 as its parameters are printed, with and without pruning, and its aspen: growth
//! beside the writing of the mesh.
//!
//! The bars: the willow without pruning grows within half of the time that its mesh takes to be written, and with it
//! within three times the time without; the aspen grows and is meshed within 1.5 times the time of a plant of the bud
//! model with as many components. Absent: degradation at range.

mod specimen;

use criterion::{Criterion, criterion_group, criterion_main};
use phytomer::config::validate_texts;
use specimen::Specimen;

/// A scenario of one plant of a species that inherits from a shipped one.
fn inheriting(name: &'static str, from: &str, keys: &str) -> Specimen {
    let scenario = format!("name = \"{name}\"\nspecies = \"{name}_species\"\nplants = 1\nseed = 1995\n\n[ages]\nuntil = 1\n");
    let species = format!("name = \"{name}_species\"\ninherits = \"{from}\"\n{keys}\n");
    let texts = [(name, scenario.as_str()), (&*format!("{name}_species"), species.as_str())];
    let resolved = validate_texts(name, &texts).unwrap_or_else(|report| panic!("{}", report.render(false)));
    Specimen { name, resolved }
}

fn wp_willow(criterion: &mut Criterion) {
    let trees = [
        inheriting("wp_willow_unpruned", "wp/weeping_willow", "PruneRatio = 0"),
        inheriting("wp_willow", "wp/weeping_willow", ""),
        inheriting("wp_aspen", "wp/quaking_aspen", ""),
    ];
    for specimen in trees {
        specimen.growth(criterion, false);
        specimen.ply(criterion);
    }
}

criterion_group!(benches, wp_willow);
criterion_main!(benches);
