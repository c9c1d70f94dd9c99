//! A bare poplar of five million internodes: growth on long axes, frames, and the tables at ten ages.
//!
//! Growth and frames are compared with plain writes of their columns, bending with the pose at rest, the tables with
//! the parquet crate alone on ready batches of the same rows. `docs/performance.md` has the table.

mod specimen;

use criterion::{Criterion, criterion_group, criterion_main};
use specimen::Specimen;

fn poplar(criterion: &mut Criterion) {
    let poplar = Specimen::of("poplar_5m");
    poplar.growth(criterion, true);
    poplar.frames(criterion);
    poplar.bending(criterion);
    poplar.records(criterion);
}

criterion_group!(benches, poplar);
criterion_main!(benches);
