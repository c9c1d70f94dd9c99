//! A picture of a full tree at detail 3 beside the same at detail 0: at most 1.3 times as long, since an organ has the
//! detail that its size in the picture deserves.
//!
//! `cargo bench --bench wild_cherry [-- PAIRS]` draws a wild cherry in blossom and an apple tree by turns. Absent:
//! growing, which is done once, and encoding.

#[path = "specimen/turns.rs"]
mod turns;

use phytomer::config::validate_species;
use phytomer::outputs::pictures::{Picture, Subject, draw};
use phytomer::run::regrowth::Regrowth;
use std::hint::black_box;

/// The pairs of pictures where none are asked for.
const PAIRS: usize = 7;

fn main() {
    let pairs = std::env::args().filter_map(|word| word.parse().ok()).next().unwrap_or(PAIRS);
    for name in ["wild_cherry", "apple"] {
        let found = validate_species(name, 1).unwrap_or_else(|report| panic!("{}", report.render(false)));
        let age = found.shown_at();
        let found = validate_species(name, age).unwrap_or_else(|report| panic!("{}", report.render(false)));
        let mut full = None;
        let shown = Regrowth::of(&found.alone(name)).show(0, &[age], &mut |_, plant| {
            full = Some(plant.clone());
            Ok(())
        });
        shown.expect("a plant");
        let plant = full.expect("a plant");
        let drawn = |detail: u8| {
            let style = Picture { detail, ..Picture::default() };
            black_box(draw(&[Subject { plant: &plant, age, label: String::new() }], "", &style));
        };
        turns::by_turns(&format!("{name} at detail 3 over detail 0"), pairs, || (), || drawn(3), || drawn(0));
    }
}
