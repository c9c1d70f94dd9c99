//! The field of a trial: where each plot stands, so that no two field plots overlap.
//!
//! A field plot is one replicate of one treatment: its plots stand on the grid of its scenario, which grows by square
//! shells. Field plots lie in equal cells, as many in a row of cells as there are treatments. In randomised blocks each
//! row is a block and has each treatment once; else any replicate of any treatment lies in any cell. Either order is
//! drawn from the seed of the run. One field plot alone begins at the origin. Absent: members, which stand beside the
//! place of their plot.

use phytomer_config::scenario::{Design, Grid};
use phytomer_config::{PlotPlace, Scenario, Trial};
use phytomer_sim::plant::LineageKey;
use phytomer_sim::random::{PlantRandom, Purpose};

/// The places of the field plots of a trial.
#[derive(Clone)]
pub struct Field {
    /// The grid of each treatment.
    grids: Vec<Option<Grid>>,
    /// The cell of each field plot, by treatment and replicate; empty where there is one.
    cells: Vec<u32>,
    /// The place of the first plot of a treatment in its cell, metres.
    starts: Vec<[f64; 2]>,
    /// The sides of a cell, metres.
    cell: [f64; 2],
}

impl Field {
    /// The field of a trial; its cells are as large as the largest field plot, with a free strip around it.
    pub fn of(trial: &Trial) -> Self {
        let scenarios: Vec<&Scenario> = trial.treatments().iter().map(|treatment| &treatment.scenario).collect();
        let grids: Vec<Option<Grid>> = scenarios.iter().map(|scenario| scenario.grid()).collect();
        let alone = scenarios.len() == 1 && trial.replicates() == 1;
        if alone || grids.iter().all(Option::is_none) {
            return Self { starts: vec![[0.0; 2]; grids.len()], grids, cells: Vec::new(), cell: [0.0; 2] };
        }
        let boxes = scenarios.iter().zip(&grids);
        let boxes: Vec<([f64; 2], [f64; 2])> = boxes.map(|(scenario, grid)| box_of(scenario, grid.as_ref())).collect();
        let side = |axis: usize| boxes.iter().map(|(least, most)| most[axis] - least[axis]).fold(0.0, f64::max);
        let strip = grids.iter().flatten().map(Grid::widest_step).fold(0.0, f64::max);
        Self {
            grids,
            cells: dealt(trial),
            starts: boxes.iter().map(|(least, _)| least.map(|least| 0.0 - least)).collect(),
            cell: [side(0) + strip, side(1) + strip],
        }
    }

    /// The place of a plot, metres: on the grid of its field plot; each at an origin of its own where there is no grid.
    pub fn place(&self, trial: &Trial, plot: u32) -> [f64; 3] {
        let PlotPlace { treatment, replicate, number, .. } = trial.plot(plot);
        let Some(grid) = self.grids.get(treatment).and_then(Option::as_ref) else { return [0.0; 3] };
        let [row, rank] = lattice_of(number);
        let [x, y] = grid.place(row, rank);
        let Some(cell) = self.cells.get(treatment * trial.replicates() as usize + replicate as usize) else {
            return [x, y, 0.0];
        };
        let treatments = trial.treatments().len() as u32;
        let (column, row) = (cell % treatments, cell / treatments);
        let start = self.starts[treatment];
        [x + start[0] + f64::from(column) * self.cell[0], y + start[1] + f64::from(row) * self.cell[1], 0.0]
    }
}

/// The box around the plants of a field plot: its least and its largest coordinates, metres.
fn box_of(scenario: &Scenario, grid: Option<&Grid>) -> ([f64; 2], [f64; 2]) {
    // n plots fill the square of side ⌈√n⌉, or part of it.
    let last = scenario.plots().saturating_sub(1).isqrt();
    let corners = [(0, 0), (last, 0), (0, last), (last, last)];
    let corners = corners.map(|(row, rank)| grid.map_or([0.0; 2], |grid| grid.place(row, rank)));
    let beside: Vec<[f64; 3]> = scenario.plot_members().iter().map(|member| member.place()).collect();
    let ground = scenario.stand.as_ref().map(|stand| stand.ground());
    let beside = beside
        .into_iter()
        .chain(ground.iter().flat_map(|ground| [ground.least, ground.most]).map(|[x, y]| [x, y, 0.0]));
    let beside: Vec<[f64; 3]> = beside.collect();
    let edge = |axis: usize, pick: fn(f64, f64) -> f64| {
        let of_plots = corners.iter().map(|corner| corner[axis]).fold(corners[0][axis], pick);
        let of_members = beside.iter().map(|place| place[axis]).fold(0.0, pick);
        of_plots + of_members
    };
    ([edge(0, f64::min), edge(1, f64::min)], [edge(0, f64::max), edge(1, f64::max)])
}

/// The cell of each field plot, treatment by treatment, drawn from the seed of the run.
fn dealt(trial: &Trial) -> Vec<u32> {
    let (treatments, replicates) = (trial.treatments().len() as u32, trial.replicates());
    let random = PlantRandom::new(trial.scenario().seed, 0);
    let mut cells = vec![0; (treatments * replicates) as usize];
    match trial.scenario().experiment.experimental_design {
        Design::CompletelyRandomised => shuffled(treatments * replicates, &random, 0)
            .into_iter()
            .zip(0..)
            .for_each(|(field_plot, cell)| cells[field_plot as usize] = cell),
        Design::RandomisedBlocks => {
            for block in 0..replicates {
                for (treatment, column) in shuffled(treatments, &random, u64::from(block)).into_iter().zip(0..) {
                    cells[(treatment * replicates + block) as usize] = block * treatments + column;
                }
            }
        }
    }
    cells
}

/// The numbers below `count` in a random order (Fisher & Yates 1938, *Statistical Tables*). A place among n is
/// ⌊u·n/2³²⌋ for a word u, whose bias is below n/2³².
fn shuffled(count: u32, random: &PlantRandom, block: u64) -> Vec<u32> {
    let mut stream = random.stream(LineageKey(block), Purpose::Field);
    let mut order: Vec<u32> = (0..count).collect();
    for left in (1..count).rev() {
        let other = (u64::from(stream.word()) * (u64::from(left) + 1)) >> 32;
        order.swap(left as usize, other as usize);
    }
    order
}

/// The row and the place in it of a plot on a square grid that grows by shells, whatever the number of plots.
///
/// Shell s holds the 2s + 1 places whose larger coordinate is s, so the shells before it fill the square of s² places,
/// and plot i stands in shell s = ⌊√i⌋ at its place k = i − s². The shell goes up the column s from row 0 to the
/// corner and back along the row s to column 0: (s, k) where k ≤ s, else (2s − k, s). Plot 0 is at the origin.
fn lattice_of(plot: u32) -> [u32; 2] {
    let shell = plot.isqrt();
    let along = plot - shell * shell;
    if along <= shell { [shell, along] } else { [2 * shell - along, shell] }
}

#[cfg(test)]
mod tests {
    use super::super::plots::Plots;
    use super::*;
    use phytomer_config::scenario::{Experiment, Member};
    use phytomer_config::{Resolved, validate, validate_texts};
    use std::collections::BTreeSet;

    fn changed(change: impl FnOnce(&mut Scenario)) -> Resolved {
        let mut resolved = validate("example1").unwrap_or_else(|report| panic!("{}", report.render(false)));
        change(&mut resolved.scenario);
        resolved
    }

    fn plots(resolved: &Resolved) -> Plots<'_> {
        Plots::of(resolved.trial(), resolved.models())
    }

    #[test]
    fn plants_keep_their_places_however_many_grow() {
        let place = |plants, spacing_m, plant| {
            let resolved = changed(|scenario| {
                scenario.plants = plants;
                scenario.spacing_m = spacing_m;
            });
            plots(&resolved).place_of(plant)
        };
        for plants in [3, 4, 9, 10, 1_000_000] {
            let first = [0, 1, 2].map(|plant| place(plants, Some(2.5), plant));
            assert_eq!(first, [[0.0; 3], [2.5, 0.0, 0.0], [2.5, 2.5, 0.0]], "{plants} plants");
        }
        assert_eq!(place(9, Some(1.0), 8), [0.0, 2.0, 0.0]);
        assert_eq!(place(9, None, 8), [0.0; 3]);
    }

    #[test]
    fn members_stand_beside_the_place_of_their_plot() {
        let resolved = changed(|scenario| {
            let aside = Member { at_m: vec![0.5, -1.0], ..Member::default() };
            (scenario.plants, scenario.spacing_m) = (8, Some(10.0));
            scenario.member = vec![Member::default(), aside];
        });
        let places = [0, 1, 2, 5].map(|plant| plots(&resolved).place_of(plant));
        assert_eq!(places, [[0.0; 3], [0.5, -1.0, 0.0], [10.0, 0.0, 0.0], [10.5, 9.0, 0.0]]);
    }

    /// Rows to the east: the plants of a row lie along x, the next row lies south of it.
    #[test]
    fn rows_run_in_their_direction_at_their_distances() {
        let resolved = changed(|scenario| {
            (scenario.plants, scenario.spacing_m) = (4, None);
            let planting = &mut scenario.planting;
            (planting.row_spacing, planting.plant_spacing, planting.row_direction) = (Some(75.0), Some(20.0), 90.0);
        });
        let places: Vec<[f64; 3]> = (0..4).map(|plant| plots(&resolved).place_of(plant)).collect();
        let expected = [[0.0; 3], [0.0, -0.75, 0.0], [0.2, -0.75, 0.0], [0.2, 0.0, 0.0]];
        for (place, expected) in places.iter().zip(expected) {
            assert!((0..3).all(|axis| (place[axis] - expected[axis]).abs() < 1e-12), "{places:?}");
        }
    }

    fn trial(design: &str, seed: u64) -> Resolved {
        let text = format!(
            "name = \"t\"\nspecies = \"example1\"\nplants = 5\nages = {{ until = 3 }}\nspacing_m = 2\nseed = {seed}\n\
             [experiment]\nreplicates = 6\nexperimental_design = \"{design}\"\n[[experiment.factor]]\nname = \"density\"\n\
             level = [{{ name = \"wide\" }}, {{ name = \"dense\", plants = 12, spacing_m = 1 }}, {{ name = \"few\", plants = 1 }}]"
        );
        validate_texts("t", &[("t", &text)]).unwrap_or_else(|report| panic!("{}", report.render(false)))
    }

    /// The smallest distance between plants of different field plots.
    fn least_distance(resolved: &Resolved) -> f64 {
        let plots = plots(resolved);
        let plants = (0..plots.trial().plants()).map(|plant| {
            let at = plots.trial().plant(plant);
            ((at.treatment, at.replicate), plots.place_of(plant))
        });
        let plants: Vec<_> = plants.collect();
        let pairs = plants.iter().flat_map(|a| plants.iter().filter(move |b| a.0 != b.0).map(move |b| (a.1, b.1)));
        let squares = pairs.map(|(a, b)| (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]));
        squares.fold(f64::INFINITY, f64::min).sqrt()
    }

    #[test]
    fn field_plots_do_not_overlap() {
        for design in ["completely_randomised", "randomised_blocks"] {
            for seed in 0..20 {
                let least = least_distance(&trial(design, seed));
                assert!(least >= 2.0 - 1e-9, "{design}, seed {seed}: {least} m");
            }
        }
    }

    /// In blocks each row of cells has each treatment once. Of all orders (3!)⁶ (6!)³ / 18! do, one in 368.
    #[test]
    fn blocks_have_each_treatment_once() {
        let rows = |resolved: &Resolved| {
            let trial = resolved.trial();
            let mut rows = vec![Vec::new(); 6];
            for (cell, field_plot) in dealt(&trial).into_iter().zip(0..) {
                rows[(cell / 3) as usize].push(field_plot / trial.replicates());
            }
            rows.iter_mut().for_each(|row| row.sort_unstable());
            rows
        };
        let blocks = rows(&trial("randomised_blocks", 4));
        assert!(blocks.iter().all(|row| *row == [0, 1, 2]), "{blocks:?}");
        let orders: BTreeSet<Vec<u32>> = (0..40).map(|seed| dealt(&trial("randomised_blocks", seed).trial())).collect();
        assert!(orders.len() > 35, "each seed has an order of its own");
        let free =
            (0..10).filter(|seed| rows(&trial("completely_randomised", *seed)).iter().all(|row| *row == [0, 1, 2]));
        assert_eq!(free.count(), 0);
    }

    #[test]
    fn one_replicate_alone_is_no_experiment() {
        let lone = changed(|scenario| scenario.experiment = Experiment { replicates: 1, ..Experiment::default() });
        assert!(Field::of(&lone.trial()).cells.is_empty());
    }

    #[test]
    fn shells_fill_squares_place_by_place() {
        let places: Vec<[u32; 2]> = (0..10_000).map(lattice_of).collect();
        for side in 1..=100_u32 {
            let square: BTreeSet<[u32; 2]> = places[..(side * side) as usize].iter().copied().collect();
            assert_eq!(square.len(), (side * side) as usize, "each place once");
            assert!(square.iter().flatten().all(|step| *step < side), "within the square of side {side}");
        }
        for pair in places.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            let steps = a[0].abs_diff(b[0]) + a[1].abs_diff(b[1]);
            let to_next_shell = b[1] == 0;
            assert!(steps == 1 || to_next_shell, "neighbours in a shell are a spacing apart: {a:?} {b:?}");
        }
        // The first and the last of the largest shell that 32 bits number.
        let shell = u32::MAX.isqrt();
        assert_eq!(lattice_of(shell * shell), [shell, 0]);
        assert_eq!(lattice_of(u32::MAX), [0, shell]);
    }
}
