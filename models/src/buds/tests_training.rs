//! Trained plants of the bud model: one plant whether growth runs from operation to operation or follows the clock, on
//! any number of threads, at every age; and nothing but the pose changes.
//!
//! Absent: the geometry of training (`sim::management`).

use super::tests::{chimera, hydra};
use super::{BudModel, Buds};
use crate::contract::{components, seed_of};
use phytomer_sim::management::{Act, Choice, Column, Formula, Management, Operation, Start, Support, Training, When};
use phytomer_sim::plant::{NodeId, Plant};
use phytomer_sim::plot::{Plot, Sowing};
use phytomer_sim::pose::pose;
use phytomer_sim::{NEVER, Tick, grow};
use std::collections::BTreeMap;
use std::sync::Arc;

const LAST: Tick = 24;

/// Whether a column is at least a number.
#[derive(Debug)]
struct AtLeast(Column, f64);

impl Formula for AtLeast {
    fn value(&self, known: &mut dyn FnMut(Column) -> f64) -> f64 {
        f64::from(u8::from(known(self.0) >= self.1))
    }

    fn columns(&self) -> Vec<Column> {
        vec![self.0]
    }
}

fn every(support: Support, first: Tick, every: Tick, least: Option<(Column, f64)>) -> Operation {
    let when = When { every: Some(every), ..When::once(Start::Age(first)) };
    let only = least.map(|(column, least)| Arc::new(AtLeast(column, least)) as Arc<dyn Formula>);
    let act = Act::Train(Training { support, stays: NEVER });
    Operation { act, when, plants: None, choice: Choice { only, ..Choice::default() } }
}

/// Two operations of one tick among them, of which the second meets what the first has moved.
fn calendar() -> Vec<Operation> {
    vec![
        every(Support::Stake(0.3), 3, 3, None),
        every(Support::Spreader { inclination: Some(1.2), azimuth: None }, 6, 5, Some((Column::Order, 2.0))),
        every(Support::Wires { heights: vec![0.1, 0.4], azimuth: 0.3 }, 6, 7, Some((Column::Length, 0.08))),
    ]
}

fn compiled(buds: &Buds) -> BudModel {
    buds.compile(LAST, &crate::fault::Path::root()).unwrap_or_else(|faults| panic!("{faults:?}"))
}

fn managed<'m>(model: &'m BudModel, operations: &[Operation]) -> Plot<'m> {
    let sowing = |number| Sowing { species: 0, seed: seed_of(5, number), place: [0.0; 3], sown: number % 2 };
    let mut plot = Plot::new(0, vec![model], &(0..8).map(sowing).collect::<Vec<_>>());
    plot.manage(Management::of(Arc::from(operations.to_vec())));
    plot
}

fn ahead(model: &BudModel, operations: &[Operation], threads: usize) -> Vec<Plant> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
    let mut plot = managed(model, operations);
    pool.install(|| grow(&mut plot, LAST, &mut ())).expect("nothing is recorded");
    plot.plants
}

/// What a plant is but for its frames at rest, which training states.
fn fates(plant: &Plant) -> Vec<(u64, Tick, Tick, Vec<u32>)> {
    components(plant).into_iter().map(|of| (of.key.0, of.birth, of.death, of.state)).collect()
}

/// The frame of each internode at an age, to the bit, by its lineage key.
fn frames(plant: &Plant, age: Tick) -> BTreeMap<u64, Vec<u32>> {
    let mut plant = plant.clone();
    pose(&mut plant, age);
    let mut frames = BTreeMap::new();
    plant.each_standing(age, |stretch| {
        for node in stretch.nodes().map(|node| NodeId(node as u32)) {
            let frame = plant.frames.at(node);
            let numbers = [frame.base, frame.heading, frame.up].into_iter().flatten();
            frames.insert(plant.node_key(node).0, numbers.map(f32::to_bits).collect());
        }
    });
    frames
}

#[test]
fn growth_ahead_and_by_the_clock_give_one_trained_plant_on_any_number_of_threads() {
    let mut moved = 0;
    for buds in [chimera(), hydra()] {
        let model = compiled(&buds);
        let grown = [1, 2, 7].map(|threads| ahead(&model, &calendar(), threads));
        let free = ahead(&model, &[], 2);
        let mut clock = managed(&model, &calendar());
        for tick in 1..=LAST {
            clock.site.begin(tick);
            clock.operate(tick).expect("no limit");
            clock.grow_to(tick).expect("no limit");
        }
        for (k, plant) in clock.plants.iter().enumerate() {
            assert!(fates(plant) == fates(&free[k]), "training changes the pose alone");
            assert!(plant.nodes.len() > 10 || plant.death < LAST);
            for age in [2, 5, 6, 11, LAST - 1] {
                let by_the_clock = frames(plant, age);
                for other in &grown {
                    assert!(by_the_clock == frames(&other[k], age), "plant {k} at age {age}");
                }
                moved += u32::from(by_the_clock != frames(&free[k], age));
                assert!(age > 2 || by_the_clock == frames(&free[k], age), "plant {k} before its training");
            }
        }
    }
    assert!(moved > 30, "the calendar trains: {moved}");
}
