//! Nodes that are made at once are those that are made one by one: species drawn at random, component for component and
//! event for event, ahead, by leaps and by the clock, in fragments and at limits.
//!
//! The whole campaign of ten thousand species runs with `PHYTOMER_CAMPAIGN=1`. Absent: the species (`tests_random`).

use super::BudModel;
use super::bud::LivingBuds;
use super::tests_random::RandomSpecies;
use crate::fault::Path;
use phytomer_sim::clock::Tick;
use phytomer_sim::model::{Grow, Overgrown};
use phytomer_sim::plant::{Plant, Seed, ThreadBudget};
use phytomer_sim::site::{Site, View};

/// The last age of the plants.
const UNTIL: Tick = 24;

/// The ways in which a plant is grown.
#[derive(Debug, Clone, Copy)]
struct Way {
    /// The ages to which it is grown, one after another.
    leap: Tick,
    threads: usize,
    limit: u32,
    keeps: bool,
}

/// A plant with its living buds, and how its growth ended.
type Grown = (Plant, LivingBuds, Result<(), Overgrown>);

fn grown(model: &BudModel, number: u32, way: Way) -> Grown {
    let Way { leap, threads, limit, keeps } = way;
    let seed = Seed { plant: number, draws: number.into(), run_seed: 19, component_limit: limit, keep_events: keeps };
    let mut plant = Plant::new(&seed, model.habit());
    plant.budget = ThreadBudget { threads, least_axes: 2 };
    plant.dormant.keep(keeps);
    let site = Site::default();
    let mut living = model.sow(&mut plant);
    let mut ages = (1..=UNTIL).filter(|age| age.is_multiple_of(leap) || *age == UNTIL);
    let end = ages.try_for_each(|age| model.grow_to(age, &mut plant, &mut living, &View::of(&site)));
    (plant, living, end)
}

/// The same species, whose axes make their nodes one by one.
fn node_by_node(model: &BudModel) -> BudModel {
    let mut model = model.clone();
    model.orders.iter_mut().for_each(|laws| laws.node.block = 0);
    model
}

fn compare(one: &Grown, other: &Grown, told: &str) {
    assert_eq!(one.2, other.2, "{told}: the end of growth");
    if one.2.is_err() {
        return;
    }
    let (a, b) = (&one.0, &other.0);
    assert!(a.axes == b.axes, "{told}: axes");
    assert!(a.nodes == b.nodes, "{told}: nodes");
    assert!(a.organs == b.organs, "{told}: organs");
    assert!(a.events == b.events, "{told}: events");
    assert!(a.dormant == b.dormant, "{told}: dormant buds");
    assert_eq!(format!("{:?}", a.own_trends), format!("{:?}", b.own_trends), "{told}: trends");
    assert_eq!((a.components(), a.age), (b.components(), b.age), "{told}");
    assert!(one.1 == other.1, "{told}: living buds");
}

/// Grows one species in several ways, with its nodes made at once and one by one; the components compared.
fn try_species(species: &mut RandomSpecies, number: u32) -> u64 {
    let Some((text, buds)) = species.next() else { return 0 };
    let Ok(mut model) = buds.compile(UNTIL, &Path::root()) else { return 0 };
    // Small blocks, so that growth units are parted among them.
    let block = [4, 7, 17, 256][number as usize % 4];
    model.orders.iter_mut().for_each(|laws| laws.node.block = block);
    let slow = node_by_node(&model);
    let leap = [UNTIL, 9, 5, 1, 1][number as usize % 5];
    let usual = Way { leap, threads: 1, limit: 60_000, keeps: number.is_multiple_of(2) };
    let whole = grown(&model, number, usual);
    compare(&whole, &grown(&slow, number, usual), &format!("{number} {text}"));
    let components = whole.0.components();
    let in_fragments = Way { threads: 4, ..usual };
    compare(&grown(&model, number, in_fragments), &grown(&slow, number, in_fragments), &format!("fragments {text}"));
    for limit in [components / 2, components.saturating_sub(1), components] {
        let way = Way { limit, ..usual };
        let (at_limit, slow) = (grown(&model, number, way), grown(&slow, number, way));
        compare(&at_limit, &slow, &format!("limit {limit} {text}"));
        assert!(at_limit.0.components() <= slow.0.components(), "limit {limit} {text}");
    }
    if whole.2.is_ok() { u64::from(components) } else { 0 }
}

#[test]
fn nodes_made_at_once_are_those_made_one_by_one() {
    let wanted = if std::env::var_os("PHYTOMER_CAMPAIGN").is_some() { 10_000 } else { 300 };
    let mut species = RandomSpecies::new(2);
    let (mut number, mut sound, mut components) = (0, 0, 0);
    while sound < wanted {
        let compared = try_species(&mut species, number);
        number += 1;
        sound += u32::from(compared > 1);
        components += compared;
        assert!(number < 100 + 20 * wanted, "only {sound} of {number} species grow");
    }
    assert!(components > 200 * u64::from(wanted), "{components} components in {number} species");
}
