//! How often intervals of 95 % of mixtures and of the crown hold the truth, in 4,000 keyed repetitions.
//!
//! ```sh
//! cargo run --release -p phytomer-fits --example coverage [TIMES [WORDS]]
//! ```
//!
//! With WORDS only the designs whose names have them are repeated. Repetitions are shared by the threads of the machine
//! and do not depend on them. Beside each share stands the one of the intervals that have both limits. Absent: the
//! designs (`tests/coverage/designs.rs`), and laws that are quick enough for a test of 4,000 (`tests/coverage.rs`).

#[path = "../tests/coverage/designs.rs"]
mod designs;

use designs::{DESIGNS, Held};
use rayon::prelude::*;

fn main() {
    let times: u64 = std::env::args().nth(1).and_then(|word| word.parse().ok()).unwrap_or(4000);
    let words = std::env::args().nth(2).unwrap_or_default();
    for design in DESIGNS.iter().filter(|design| design.name.contains(&words)) {
        let of = |time| design.repeat(time, 1);
        let add = |mut sum: Vec<Held>, told: Vec<Held>| {
            sum.iter_mut().zip(told).for_each(|(sum, told)| {
                sum.held += told.held;
                sum.closed += told.closed;
            });
            sum
        };
        let none = || vec![Held::default(); design.truths.len()];
        let told = (0..times).into_par_iter().map(of).reduce(none, add);
        println!("{}, {times} times", design.name);
        for ((name, truth), told) in design.truths.iter().zip(told) {
            let share = |count: u64| 100.0 * count as f64 / times as f64;
            println!("  {name} = {truth}: {:.1} %; both limits {:.1} %", share(told.held), share(told.closed));
        }
    }
}
