//! Greene's plants of one plot: no voxel is had by two of them, none lies in the house, and no result depends on the
//! threads; a seed in a voxel that another plant has does not grow.
//!
//! The voxels are found again from the poses of the plants. Absent: a plant by itself (`tests_greene`).

use super::tests_greene::{PLACE, compiled, house, joined, points, vine};
use super::voxels::{Lattice, Voxel};
use crate::contract;
use phytomer_sim::plant::{NodeId, Plant};
use phytomer_sim::pose::pose;
use phytomer_sim::site::{Manner, Obstacle, Side};
use phytomer_sim::{GrowthModel, Plot, Sowing};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Plants beside a house, at places beside that of the plot, grown by the clock and posed.
fn grown<'m>(model: &'m dyn GrowthModel, beside: &[[f64; 3]], until: u32, shared: bool) -> Plot<'m> {
    let sowing = |(number, beside): (u32, &[f64; 3])| {
        let place = [0, 1, 2].map(|k| PLACE[k] + beside[k]);
        Sowing { species: 0, seed: contract::seed_of(4, number), place, sown: 0 }
    };
    let sowings: Vec<Sowing> = (0..).zip(beside).map(sowing).collect();
    let mut plot = Plot::new(0, vec![model], &sowings);
    plot.site.obstacles =
        vec![Obstacle { shape: Arc::new(house().moved(PLACE)), kills: Side::Inside, manner: Manner::Kills }];
    plot.site.cells.shared = shared;
    plot.site.cells.origin = PLACE;
    assert!(!plot.ahead(until), "it follows the clock");
    for tick in 1..=until {
        plot.site.begin(tick);
        plot.grow_to(tick).expect("room to grow");
    }
    plot.plants.iter_mut().for_each(|plant| pose(plant, until));
    plot
}

/// Whether a place, in edges, is too near to a border between two voxels for single precision.
fn is_at_a_border(place: [f64; 3]) -> bool {
    place.iter().any(|x| (x - x.round()).abs() < 1e-4)
}

/// The internodes in each voxel of the lattice of a plot, each with its plant.
fn passed(plants: &[Plant], edge: f64) -> BTreeMap<Voxel, Vec<(usize, NodeId)>> {
    let lattice = Lattice::shared(edge, [0.0; 3]);
    let mut passed: BTreeMap<Voxel, Vec<(usize, NodeId)>> = BTreeMap::new();
    for (number, plant) in plants.iter().enumerate() {
        for (node, at) in points(plant) {
            let at = [0, 1, 2].map(|k| at[k] + plant.place[k] - PLACE[k]);
            if !is_at_a_border([at[0] / edge + 0.5, at[1] / edge + 0.5, at[2] / edge]) {
                let of_voxel = passed.entry(lattice.voxel_of(at)).or_default();
                if !of_voxel.contains(&(number, node)) {
                    of_voxel.push((number, node));
                }
            }
        }
    }
    passed
}

/// The pairs of internodes in one voxel that do not meet in a joint: of two plants, and of one.
fn in_common(plants: &[Plant], edge: f64) -> [usize; 2] {
    let mut pairs = [0; 2];
    for nodes in passed(plants, edge).values() {
        for (k, (plant, one)) in nodes.iter().enumerate() {
            for (other_plant, other) in &nodes[..k] {
                let same = plant == other_plant;
                pairs[usize::from(same)] += usize::from(!same || !joined(&plants[*plant], *one, *other));
            }
        }
    }
    pairs
}

const BESIDE: [[f64; 3]; 3] = [[0.0; 3], [0.03, 0.31, 0.0], [0.02, -0.27, 0.0]];

#[test]
fn vines_of_a_plot_have_no_voxel_in_common() {
    let model = compiled(&vine());
    let apart = grown(&model, &BESIDE, 45, false);
    assert!(in_common(&apart.plants, 0.1)[0] > 50, "vines that do not share voxels pass through one another");
    let plot = grown(&model, &BESIDE, 45, true);
    assert_eq!(in_common(&plot.plants, 0.1), [0, 0]);
    let house = house();
    for plant in &plot.plants {
        assert!(plant.nodes.len() > 50, "each of them grows: {}", plant.nodes.len());
        let beside = [0, 1, 2].map(|k| plant.place[k] - PLACE[k]);
        for (node, at) in points(plant) {
            let at = [0, 1, 2].map(|k| at[k] + beside[k]);
            assert!(!house.inside(at) && at[2] >= -1e-6, "internode {node:?} at {at:?}");
        }
    }
    // Each internode lies in voxels that its plant was granted.
    for (voxel, nodes) in passed(&plot.plants, 0.1) {
        let holder = plot.site.cells.holder(voxel);
        assert!(nodes.iter().all(|(number, _)| holder == Some(plot.plants[*number].id)), "{voxel:?}: {nodes:?}");
    }
}

#[test]
fn vines_of_a_plot_are_the_same_on_any_number_of_threads() {
    let model = compiled(&vine());
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        pool.install(|| grown(&model, &BESIDE, 30, true))
    };
    let one = on(1);
    for threads in [2, 8] {
        let other = on(threads);
        assert!(one.lives == other.lives, "{threads} threads");
        for (plant, same) in one.plants.iter().zip(&other.plants) {
            assert!(plant.frames.base == same.frames.base && plant.nodes.parent == same.nodes.parent);
        }
    }
    // Back at its seeds the plot grows again as it did.
    let mut again = on(2);
    again.restart();
    for tick in 1..=30 {
        again.site.begin(tick);
        again.grow_to(tick).expect("room to grow");
    }
    assert!(one.lives == again.lives, "all voxels are given back");
}

/// Two seeds in one voxel: the first in the order of the plot grows. A plant that is alone in a plot of shared voxels
/// has the voxels that it has by itself.
#[test]
fn a_seed_in_a_voxel_of_another_does_not_grow() {
    let model = compiled(&vine());
    let plot = grown(&model, &[[0.0; 3], [0.02, 0.01, 0.0]], 12, true);
    assert!(plot.plants[0].nodes.len() > 10);
    assert_eq!(plot.plants[1].nodes.len(), 0);
    let [alone, by_itself] = [true, false].map(|shared| grown(&model, &[[0.0; 3]], 12, shared));
    let headings = |plot: &Plot<'_>| plot.plants[0].frames.heading.clone();
    assert_eq!(headings(&alone), headings(&by_itself));
}
