//! A weeping willow that bends at every tick of its life, until it has some twenty thousand internodes.
//!
//! Growth with bending is compared with growth alone. `docs/performance.md` has the table.

mod specimen;

use criterion::{Criterion, criterion_group, criterion_main};
use specimen::Specimen;

fn willow(criterion: &mut Criterion) {
    Specimen::of("willow").life(criterion, 69);
}

criterion_group!(benches, willow);
criterion_main!(benches);
