//! Plants that grow into cells of space, through the loop: of two tips that claim one cell at most one gets it, and no
//! result depends on the threads.
//!
//! Absent: the claims by themselves (`cells`).

use crate::cells::{Cell, Claims};
use crate::clock::Tick;
use crate::model::{Grow, Growth, Overgrown};
use crate::plant::{Habit, NewAxis, Plant, Seed};
use crate::plot::{Plot, Sowing};
use crate::site::{Site, View};
use std::sync::Arc;

/// A plant that is a list of cells on a line: at each tick its tip claims the next cell to the right, and stays in
/// place where the claim is refused.
struct Creeper;

impl Grow for Creeper {
    type Life = Vec<Cell>;

    fn growth(&self) -> Growth {
        Growth::Extends
    }

    fn habit(&self) -> Arc<Habit> {
        Arc::default()
    }

    fn sow(&self, plant: &mut Plant) -> Vec<Cell> {
        plant.add_axis(NewAxis::OF_THE_SEED);
        Vec::new()
    }

    fn grow_to(&self, age: Tick, plant: &mut Plant, cells: &mut Vec<Cell>, view: &View<'_>) -> Result<(), Overgrown> {
        if view.granted == [true] {
            cells.push(next(plant, cells));
        }
        plant.age = age;
        Ok(())
    }

    fn thicken(&self, _age: Tick, _plant: &mut Plant) {}

    fn claim(&self, plant: &Plant, cells: &mut Vec<Cell>, _: &Site, claims: &mut Claims) {
        claims.0.push(vec![next(plant, cells)]);
    }
}

fn next(plant: &Plant, cells: &[Cell]) -> Cell {
    let first = [plant.place[0] as i32, 0, 0];
    cells.last().map_or(first, |[x, y, z]| [x + 1, *y, *z])
}

/// The cells of three plants after five ticks: at 0 and at 3, and a third at 3 as well.
fn grown(threads: usize) -> Vec<Vec<i32>> {
    let sowing = |(number, place): (u32, f64)| Sowing {
        species: 0,
        seed: Seed { plant: number, draws: number.into(), run_seed: 1, component_limit: 9, keep_events: false },
        place: [place, 0.0, 0.0],
        sown: 0,
    };
    let sowings: Vec<Sowing> = (0..).zip([0.0, 3.0, 3.0]).map(sowing).collect();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
    pool.install(|| {
        let mut plot = Plot::new(0, vec![&Creeper], &sowings);
        plot.site.cells.shared = true;
        assert!(!plot.ahead(5), "what shares cells follows the clock");
        for tick in 1..=5 {
            plot.site.begin(tick);
            plot.grow_to(tick).expect("room to grow");
        }
        let of = |life: &crate::Life| life.get::<Vec<Cell>>().iter().map(|cell| cell[0]).collect();
        plot.lives.iter().map(of).collect()
    })
}

/// The first comes as far as the cell before the second's first; the third never gets the cell that the second has.
#[test]
fn a_cell_is_granted_once_in_the_order_of_the_plot_on_any_number_of_threads() {
    let cells = grown(1);
    assert_eq!(cells, [vec![0, 1, 2], vec![3, 4, 5, 6, 7], vec![]]);
    assert_eq!(grown(2), cells);
    assert_eq!(grown(7), cells);
}
