//! Successors: planted where a plant is dead, was taken or did not germinate; each is the plant that is sown at that
//! tick.
//!
//! Absent: their numbers in a run, and its tables (`tests/replanting.rs` of the root).

use super::tests::{chimera, hydra};
use super::{BudModel, Buds};
use crate::contract::{components, seed_of};
use phytomer_sim::management::{Act, Choice, Column, Formula, Management, Operation, Start, Successor, When};
use phytomer_sim::plot::{Plot, Sowing};
use phytomer_sim::{NEVER, Tick, grow};
use std::sync::Arc;

const LAST: Tick = 30;

/// Whether a column has a value.
#[derive(Debug)]
struct Is(Column, f64);

impl Formula for Is {
    fn value(&self, known: &mut dyn FnMut(Column) -> f64) -> f64 {
        f64::from(u8::from(known(self.0) == self.1))
    }

    fn columns(&self) -> Vec<Column> {
        vec![self.0]
    }
}

fn compiled(buds: &Buds) -> BudModel {
    buds.compile(LAST, &crate::fault::Path::root()).unwrap_or_else(|faults| panic!("{faults:?}"))
}

/// The first member is taken at tick 6; places are planted at the ticks 9, 18 and 27.
fn calendar() -> Vec<Operation> {
    let take = |member: f64, tick| Operation {
        act: Act::Remove,
        when: When::once(Start::Tick(tick)),
        plants: Some(Arc::new(Is(Column::Member, member))),
        choice: Choice::default(),
    };
    let plant = When { every: Some(9), ..When::once(Start::Tick(9)) };
    let plant = Operation { act: Act::Replant, when: plant, plants: None, choice: Choice::default() };
    vec![plant, take(0.0, 6)]
}

/// Three members, of which the last did not germinate, and the successors of the first, of the third and of the fourth.
fn managed(model: &BudModel) -> Plot<'_> {
    let sown = [0, 2, NEVER, NEVER, NEVER, NEVER];
    let sowing = |(number, sown): (u32, Tick)| Sowing { species: 0, seed: seed_of(3, number), place: [0.0; 3], sown };
    let mut plot = Plot::new(0, vec![model], &(0..).zip(sown).map(sowing).collect::<Vec<_>>());
    let successors = [(3, 0), (4, 2), (5, 3)].map(|(member, follows)| Successor { member, follows });
    plot.manage(Management::of(calendar().into()).with_successors(successors.into()));
    plot
}

fn sown(plot: &Plot<'_>) -> Vec<Tick> {
    plot.members.iter().map(|member| member.sown).collect()
}

#[test]
fn a_successor_is_the_plant_that_is_sown_when_its_place_is_free() {
    for buds in [chimera(), hydra()] {
        let model = compiled(&buds);
        let mut plot = managed(&model);
        grow(&mut plot, LAST, &mut ()).expect("nothing is recorded");
        let planted = sown(&plot);
        // The third place is planted first, since its seed did not germinate; its plant is the fifth of the plot.
        assert_eq!(planted[..5], [0, 2, NEVER, 9, 9]);
        let follower = &plot.plants[3];
        let died = follower.death.saturating_add(9);
        let expected = [18, 27].into_iter().find(|tick| *tick >= died).unwrap_or(NEVER);
        assert_eq!(planted[5], expected, "the successor of the first died at tick {died}");
        for (place, tick) in planted.iter().enumerate().skip(3).filter(|(_, tick)| **tick < NEVER) {
            let seed = seed_of(3, place as u32);
            let mut alone = Plot::of_one(&model, &seed);
            grow(&mut alone, LAST - tick, &mut ()).expect("nothing is recorded");
            if plot.plants[place].cuts.is_empty() {
                assert_eq!(components(&plot.plants[place]), components(&alone.plants[0]), "plant {place}");
            }
        }
        plot.restart();
        assert_eq!(sown(&plot), [0, 2, NEVER, NEVER, NEVER, NEVER], "seeds again");
    }
}

/// Where no seed of a plot germinates its successors are planted all the same, for replanting is work on the plot.
#[test]
fn a_place_is_planted_where_no_seed_germinates() {
    let model = compiled(&chimera());
    let sowing = |number| Sowing { species: 0, seed: seed_of(3, number), place: [0.0; 3], sown: NEVER };
    let mut plot = Plot::new(0, vec![&model], &[sowing(0), sowing(1)]);
    let successors = [Successor { member: 1, follows: 0 }];
    plot.manage(Management::of(calendar().into()).with_successors(successors.into()));
    grow(&mut plot, LAST, &mut ()).expect("nothing is recorded");
    assert_eq!(sown(&plot), [NEVER, 9]);
}

#[test]
fn successors_are_planted_alike_ahead_and_by_the_clock_on_any_number_of_threads() {
    let model = compiled(&chimera());
    let mut clock = managed(&model);
    for tick in 1..=LAST {
        clock.site.begin(tick);
        clock.operate(tick).expect("no limit");
        clock.grow_to(tick).expect("no limit");
    }
    for threads in [1, 2, 7] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        let mut plot = managed(&model);
        pool.install(|| grow(&mut plot, LAST, &mut ())).expect("nothing is recorded");
        assert_eq!(sown(&plot), sown(&clock));
        for (one, other) in plot.plants.iter().zip(&clock.plants) {
            assert_eq!(components(one), components(other));
        }
    }
}
