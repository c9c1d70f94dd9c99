//! A poplar of thirty years, with its leaves: growth, meshing and PLY.
//!
//! The mesh has the vertices of a whole crown; growth, vertices and PLY are compared with plain writes of the same columns
//! and bytes. `docs/performance.md` has the table.

mod specimen;

use criterion::{Criterion, criterion_group, criterion_main};
use specimen::Specimen;

fn poplar(criterion: &mut Criterion) {
    let poplar = Specimen::of("poplar_30y");
    poplar.growth(criterion, true);
    poplar.meshing(criterion);
    poplar.ply(criterion);
}

criterion_group!(benches, poplar);
criterion_main!(benches);
