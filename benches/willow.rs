//! A weeping willow that bends at every tick of its life, until it has some twenty thousand internodes; its mesh within
//! a millimetre at 92, the description of its life, and files of binary USD.
//!
//! Growth with bending is compared with growth alone, the mesh with the full one, the life with growing and standing.
//! `docs/performance.md` has the table.

mod specimen;

use criterion::{Criterion, criterion_group, criterion_main};
use specimen::Specimen;

fn willow(criterion: &mut Criterion) {
    let specimen = Specimen::of("willow");
    specimen.life(criterion, 69);
    specimen.within_a_millimetre(criterion, 92);
    specimen.keyframes(criterion);
    specimen.usd(criterion, &(1..=96).collect::<Vec<_>>());
}

criterion_group!(benches, willow);
criterion_main!(benches);
