//! The coffee tree: a bushy plant with leaves, flowers and fruits, and its population.
//!
//! Growth in both orders, and frames, each against a plain write of its columns; levels of detail beside the first.
//! `docs/performance.md` has the table.

mod specimen;

use criterion::{Criterion, criterion_group, criterion_main};
use specimen::Specimen;

fn coffee(criterion: &mut Criterion) {
    let coffee = Specimen::of("coffee");
    coffee.growth(criterion, true);
    coffee.frames(criterion);
    coffee.levels_of_detail(36);
}

criterion_group!(benches, coffee);
criterion_main!(benches);
