//! A poplar of thirty years, with its leaves: growth, meshing, PLY and a picture.
//!
//! The mesh has the vertices of a whole crown; growth, vertices and PLY are compared with plain writes of the same
//! columns and bytes. `docs/performance.md` has the table.

mod specimen;

use criterion::{Criterion, criterion_group, criterion_main};
use specimen::Specimen;
use specimen::picture::picture;

fn poplar(criterion: &mut Criterion) {
    let poplar = Specimen::of("poplar_30y");
    poplar.growth(criterion, true);
    poplar.meshing(criterion);
    poplar.ply(criterion);
    picture(&poplar, criterion);
}

criterion_group!(benches, poplar);
criterion_main!(benches);
