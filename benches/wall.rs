//! The price of obstacles in a tick, beside the same plants in the open that grow and stand tick by tick: ivies by a
//! wall with a window; coffee trees among two hundred boxes that are far from every bud but the nearest, on solid
//! ground alone, and where they meet the stems of their neighbours.
//!
//! Pairs by turns, so that the ratios hold on a machine that does other work too; `PHYTOMER_PAIRS=20` for more of them.
//! Plants that meet something are other plants, so the number of their components is told beside the ratios. Absent: a
//! site without feedback, whose plants grow ahead and need no tick.

#[path = "specimen/met.rs"]
mod met;
#[path = "specimen/turns.rs"]
mod turns;

use met::{Met, blocks};
use phytomer::config::{Resolved, validate};
use phytomer::run::seed_of;
use phytomer::sim::site::stems::Whose;
use phytomer::sim::{Plot, Sowing, Tick};
use std::cell::Cell;

/// Twelve plants in three rows, on the ground or before a wall.
fn sown<'a>(resolved: &'a Resolved, met: &Met, [between, rows]: [f64; 2]) -> Plot<'a> {
    let sowing = |plant: u32| {
        let place = [f64::from(plant % 4) * between - 1.5 * between, 0.12 + rows * f64::from(plant / 4), 0.0];
        Sowing { species: 0, seed: seed_of(&resolved.scenario, plant), place, sown: 0 }
    };
    let mut plot = Plot::new(0, vec![resolved.model.as_ref()], &(0..12).map(sowing).collect::<Vec<_>>());
    met.lie_on(&mut plot);
    plot
}

/// Growth that follows the clock and stands at each tick, with or without anything to meet; the components made.
fn grown(mut plot: Plot<'_>, until: Tick) -> u64 {
    for tick in 1..=until {
        plot.site.begin(tick);
        plot.grow_to(tick).expect("room to grow");
        plot.stand(tick);
    }
    plot.plants.iter().map(|plant| plant.lived_by(until)).sum()
}

fn main() {
    let pairs = std::env::var("PHYTOMER_PAIRS").ok().and_then(|pairs| pairs.parse().ok()).unwrap_or(7);
    let only: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let far = |k: u32| blocks([f64::from(k % 20) * 3.0 - 30.0, 8.0 + f64::from(k / 20) * 3.0, 0.0], [2.0, 2.0, 3.0]);
    let front = vec![blocks([-2.3, -0.2, 0.0], [4.6, 0.2, 4.0]), blocks([-0.55, -0.06, 1.2], [1.1, 0.12, 1.3])];
    let many = (0..200).map(far).collect();
    let ground = Met { ground: Some(0.0), ..Met::default() };
    let cases = [
        ("ivies by a wall with a window", "wall", 30, [1.2, 1.5], Met { obstacles: front, ..ground.clone() }),
        ("coffee and two hundred boxes", "coffee", 60, [1.2, 1.5], Met { obstacles: many, ..ground.clone() }),
        ("coffee on solid ground", "coffee", 60, [1.2, 1.5], ground),
        ("coffee and its neighbours", "coffee", 60, [0.8, 1.0], Met { stems: Whose::Neighbours, ..Met::default() }),
        ("coffee and all stems", "coffee", 60, [0.8, 1.0], Met { stems: Whose::All, ..Met::default() }),
    ];
    for (name, scenario, until, apart, met) in cases {
        if !only.is_empty() && !only.iter().any(|word| name.contains(word.as_str())) {
            continue;
        }
        let species = validate(scenario).unwrap_or_else(|report| panic!("{}", report.render(false)));
        let made = [Cell::new(0), Cell::new(0)];
        let among = || made[0].set(grown(sown(&species, &met, apart), until));
        let open = || made[1].set(grown(sown(&species, &Met::default(), apart), until));
        turns::by_turns(&format!("{name}, {until} ticks, beside the open"), pairs, || (), among, open);
        println!("  {} components, {} in the open", made[0].get(), made[1].get());
    }
}
