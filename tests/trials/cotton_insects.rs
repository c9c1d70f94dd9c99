//! `cotton_insects`: the shares that insects take are those of the scenario, aggregation keeps their mean and not their
//! spread, and plants that have lost their tip make others.
//!
//! Each boll lives for 17 ticks and is exposed to the ticks of the attack in which it stands, so its chance follows
//! from its age alone; pickers come after the attack. Absent: the distributions themselves (`sim/draws`).

use super::grown;
use super::read::Columns;
use phytomer::sim::math::pow;
use std::collections::BTreeMap;
use std::path::Path;

/// The plants of a treatment.
const PLANTS: usize = 60;
/// The ticks in which bollworms eat, and the ticks that a boll stands.
const EATING: std::ops::RangeInclusive<u32> = 18..=26;
const BOLL: u32 = 17;

/// What insects did to one plant.
#[derive(Debug, Default, Clone)]
struct Toll {
    /// Bolls that were eaten; how many were to be expected, and the variance of their number.
    eaten: f64,
    expected: f64,
    variance: f64,
    /// Whether a tipworm killed the bud of its first stem.
    tipped: bool,
    /// The stems that it ever had.
    stems: u32,
}

fn tolls(run: &Path, treatment: &str, eaten: f64) -> Vec<Toll> {
    let components = Columns::of(run, "components");
    let number = |name: &str| components.numbers(name);
    let (plants, births, orders, axes) = (number("plant_id"), number("birth_age"), number("order"), number("axis_id"));
    let (kinds, causes) = (components.words("kind"), components.words("cause_of_death"));
    let mut tolls: BTreeMap<u32, Toll> = BTreeMap::new();
    for row in (0..kinds.len()).filter(|row| components.words("treatment")[*row] == treatment) {
        let toll = tolls.entry(plants[row] as u32).or_default();
        let attacked = causes[row] == "attacked";
        match kinds[row].as_str() {
            "fruit" => {
                let birth = births[row] as u32;
                let exposed = EATING.filter(|tick| (birth + 1..birth + BOLL).contains(tick)).count();
                let p = 1.0 - pow(1.0 - eaten, exposed as f64 / EATING.count() as f64);
                toll.expected += p;
                toll.variance += p * (1.0 - p);
                toll.eaten += f64::from(u8::from(attacked));
            }
            "apical_bud" if orders[row] == 1.0 => {
                toll.stems += 1;
                toll.tipped |= attacked && axes[row] == 0.0;
            }
            _ => {}
        }
    }
    assert_eq!(tolls.len(), PLANTS, "{treatment}");
    tolls.into_values().collect()
}

fn sum(tolls: &[Toll], of: impl Fn(&Toll) -> f64) -> f64 {
    tolls.iter().map(of).sum()
}

#[test]
fn insects_take_their_shares_and_plants_make_new_tips() {
    let (_home, run) = grown("cotton_insects");
    for (level, tips, bolls) in [("none", 0.0, 0.0), ("few", 0.25, 0.15), ("many", 0.75, 0.45)] {
        for spread in ["at random", "aggregated"] {
            let name = format!("{level} + {spread}");
            let tolls = tolls(&run, &name, bolls);
            let tipped = sum(&tolls, |toll| f64::from(u8::from(toll.tipped)));
            // One stem a plant: aggregation within a plant does not show.
            let n = PLANTS as f64;
            assert!((tipped - n * tips).abs() <= 4.0 * (n * tips * (1.0 - tips)).sqrt(), "{name}: {tipped} tips");
            let scores: Vec<f64> = tolls
                .iter()
                .filter(|toll| toll.variance > 0.0)
                .map(|toll| (toll.eaten - toll.expected) * (toll.eaten - toll.expected) / toll.variance)
                .collect();
            let (eaten, expected) = (sum(&tolls, |toll| toll.eaten), sum(&tolls, |toll| toll.expected));
            if spread == "at random" {
                let error = sum(&tolls, |toll| toll.variance).sqrt();
                assert!((eaten - expected).abs() <= 4.0 * error, "{name}: {eaten} bolls, expected {expected}");
            } else if bolls > 0.0 {
                // Each score has the mean 1 and a variance of about 2 where plants are equal.
                let (n, total) = (scores.len() as f64, scores.iter().sum::<f64>());
                assert!(total > n + 4.0 * (2.0 * n).sqrt(), "{name}: scores {total} of {n} plants");
            }
            // The accessory bud wakes with a probability of .85, and an axillary bud may too.
            let renewed = tolls.iter().filter(|toll| toll.tipped && toll.stems > 1).count() as f64;
            assert!(tipped == 0.0 || renewed >= 0.7 * tipped, "{name}: {renewed} of {tipped}");
            println!("{name}: {tipped} tips, {eaten} bolls eaten of {expected} expected, {renewed} plants renewed");
        }
    }
}

/// Without insects it does not matter how they are spread: the same plants, row by row.
#[test]
fn no_insects_are_none_however_they_are_spread() {
    let (_home, run) = grown("cotton_insects");
    let records = Columns::of(&run, "records");
    let of = |spread: &str| -> Vec<Vec<u64>> {
        let name = format!("none + {spread}");
        let rows = (0..records.words("treatment").len()).filter(|row| records.words("treatment")[*row] == name);
        let columns = ["tick", "component_id", "birth_age", "x_m", "y_m", "z_m", "length_m"];
        rows.map(|row| columns.map(|column| records.numbers(column)[row].to_bits()).to_vec()).collect()
    };
    let random = of("at random");
    assert!(random.len() > 10_000, "{} rows", random.len());
    assert!(random == of("aggregated"), "the plants differ");
    let summary = Columns::of(&run, "summary");
    let picked = |level: &str| -> f64 {
        let name = format!("{level} + at random");
        let of = |row: &usize| summary.words("treatment")[*row] == name && summary.numbers("age")[*row] == 70.0;
        let rows = (0..summary.words("treatment").len()).filter(of);
        rows.map(|row| summary.numbers("harvested_fruits")[row]).sum()
    };
    let [none, few, many] = ["none", "few", "many"].map(picked);
    assert!(none > few && few > many && many > 0.0, "bolls picked: {none}, {few} and {many}");
}
