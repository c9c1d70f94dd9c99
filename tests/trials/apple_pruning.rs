//! `apple_pruning`: each system keeps its tree within the bounds that its cuts and ties state, trees are alike before
//! the first cut, and each block has each system once.
//!
//! The trees are grown for nine years instead of twelve, to a tick of cuts. What has grown since the last cut may stand
//! beyond it, so bounds are those of older internodes. Absent: what single operations do (`sim::management`).

use super::program::{run, write};
use super::read::Columns;
use phytomer::config::{Kind, presets};
use phytomer::sim::math::hypot;
use std::collections::BTreeSet;
use std::path::Path;

const SYSTEMS: [&str; 4] = ["free", "central leader", "open vase", "palmette"];
/// The tick of the last cuts, which is also the last of the run.
const LAST: f64 = 36.0;
/// Places are recorded in tenths of a millimetre.
const ROUNDING: f64 = 2e-4;

/// An internode that stands at the last tick and stood before the last cuts: its order, its base and its tip.
struct Wood {
    order: f64,
    tip: [f64; 3],
}

fn wood(records: &Columns, system: &str) -> Vec<Wood> {
    let number = |name: &str| records.numbers(name);
    let (ticks, births, lengths, orders) = (number("tick"), number("birth_age"), number("length_m"), number("order"));
    let (kinds, treatments) = (records.words("kind"), records.words("treatment"));
    let (base, direction) = (["x_m", "y_m", "z_m"].map(number), ["dir_x", "dir_y", "dir_z"].map(number));
    let old = |row: &usize| ticks[*row] == LAST && births[*row] < LAST && kinds[*row].ends_with("internode");
    let rows = (0..ticks.len()).filter(|row| treatments[*row] == system).filter(old);
    rows.map(|row| Wood {
        order: orders[row],
        tip: std::array::from_fn(|k| base[k][row] + lengths[row] * direction[k][row]),
    })
    .collect()
}

#[test]
fn trees_are_alike_before_the_first_cut_and_keep_the_bounds_of_their_system() {
    let (_, text) = presets(Kind::Scenario).iter().find(|(name, _)| *name == "apple_pruning").expect("it ships");
    let short =
        text.replace("until = 48\n", "until = 36\n").replace("record = [8, 16, 24, 32, 40, 48]", "record = [36]");
    assert!(short.contains("until = 36\n") && short.contains("record = [36]"), "the shorter run is made by these keys");
    let home = tempfile::tempdir().expect("a temporary folder");
    write(home.path(), "short.toml", &short);
    run(home.path(), &["grow", "short.toml", "--name", "short", "--quiet"]).ending(0);
    let folder = home.path().join("runs/short");
    check_bounds(&folder);
    check_sizes(&folder);
    check_youth(&folder);
}

fn check_bounds(run: &Path) {
    let records = Columns::of(run, "records");
    let of = |system: &str| {
        let wood = wood(&records, system);
        assert!(wood.len() > 1000, "{system}: {} internodes", wood.len());
        wood
    };
    let reaches = |wood: &[Wood], of: fn(&Wood) -> f64| wood.iter().map(of).fold(0.0, f64::max);
    let [free, leader, vase, palmette] = SYSTEMS.map(of);
    assert!(reaches(&free, |wood| wood.tip[2]) > 3.6, "a free tree is higher than the trained ones");
    assert!(reaches(&leader, |wood| wood.tip[2]) <= 3.0 + ROUNDING);
    assert!(reaches(&vase, |wood| wood.tip[2]) <= 2.4 + ROUNDING);
    assert!(reaches(&palmette, |wood| wood.tip[2]) <= 2.4 + ROUNDING);
    assert!(reaches(&palmette, |wood| wood.tip[1].abs()) <= 0.35 + ROUNDING, "a fan as thick as its hedge");
    assert!(reaches(&palmette, |wood| wood.tip[0].abs()) > 1.2, "and as wide as its row");
    // The trunk of a vase ends where the maiden was headed, and its limbs lean outwards; others have wood there.
    let share = |wood: &[Wood]| {
        let upper: Vec<&Wood> = wood.iter().filter(|wood| wood.tip[2] > 1.2).collect();
        let middle = upper.iter().filter(|wood| hypot(wood.tip[0], wood.tip[1]) < 0.1).count();
        middle as f64 / upper.len() as f64
    };
    println!("wood in the middle: {} of a free tree, {} of a vase", share(&free), share(&vase));
    assert!(share(&vase) < share(&free) / 2.0, "the centre of the vase is open");
    assert!(palmette.iter().any(|wood| wood.order == 1.0 && wood.tip[2] > 1.5), "the palmette has a leader");
}

/// A trained tree is lower, bears less than a free one in its first years, and bears.
fn check_sizes(run: &Path) {
    let summary = Columns::of(run, "summary");
    let of = |system: &str, column: &str| -> f64 {
        let is = |row: &usize| summary.words("treatment")[*row] == system && summary.numbers("age")[*row] == LAST;
        (0..summary.words("treatment").len()).filter(is).map(|row| summary.numbers(column)[row]).sum()
    };
    for column in ["harvested_fruits", "height_m"] {
        let [free, trained @ ..] = SYSTEMS.map(|system| of(system, column));
        assert!(trained.iter().all(|trained| *trained > 0.0 && *trained < free), "{column}: {free}, {trained:?}");
    }
}

/// Before the first cut all trees of a replicate are one tree, and each block has each system once.
fn check_youth(run: &Path) {
    let components = Columns::of(run, "components");
    let young = |system: &str| -> Vec<[u64; 4]> {
        let births = components.numbers("birth_age");
        let rows = (0..births.len()).filter(|row| births[*row] < 8.0 && components.words("treatment")[*row] == system);
        // Components are numbered through the life of a plant, so their numbers differ later on.
        let columns = ["birth_age", "order", "rank", "length_m"];
        let mut rows: Vec<[u64; 4]> =
            rows.map(|row| columns.map(|column| components.numbers(column)[row].to_bits())).collect();
        rows.sort_unstable();
        rows
    };
    let [free, trained @ ..] = SYSTEMS.map(young);
    assert!(free.len() > 400 && trained.iter().all(|trained| *trained == free), "{} components", free.len());
    let plants = Columns::of(run, "plants");
    let blocks = plants.numbers("block").iter().map(|block| *block as u32);
    let plots: BTreeSet<(u32, &str)> = blocks.zip(plants.words("treatment").iter().map(String::as_str)).collect();
    assert_eq!((plots.len(), plants.numbers("block").len()), (12, 12), "three blocks of four systems");
}
