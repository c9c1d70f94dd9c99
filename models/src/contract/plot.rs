//! The clauses of a plot of several species: members interact only through the site that they share, and the number of
//! threads never changes the result.
//!
//! Absent on purpose: clauses of one species (`growth`).

use super::component::{assert_same, components, events, numbered};
use super::{grown, seed_of};
use phytomer_sim::clock::Tick;
use phytomer_sim::model::{Growth, GrowthModel};
use phytomer_sim::plant::{Cause, Plant};
use phytomer_sim::plot::{Plot, Sowing};
use phytomer_sim::pose::bud_frame;
use phytomer_sim::shape::{HalfSpace, Shape};
use phytomer_sim::site::{Manner, Obstacle, Side};
use std::sync::Arc;

/// Two species in one plot, sown at several ticks, grow as each does alone where they share nothing. Under a plane that
/// kills the buds that reach it no bud grows beyond it. On 1, 2 and 7 threads either plot is the same in every number.
/// The plane lies level, `height` metres above the ground.
///
/// # Panics
/// At the first difference, and where the threads cannot be started.
pub fn two_species_share_a_plot(models: [&dyn GrowthModel; 2], until: Tick, seed: u64, height: f64) {
    let sowings: Vec<Sowing> = (0..6).map(|k| sowing(k, seed)).collect();
    let open = on_threads(&models, &sowings, until, &[]);
    for (k, sowing) in sowings.iter().enumerate().filter(|(_, sowing)| sowing.sown < until) {
        let alone = grown(models[sowing.species], until - sowing.sown, &sowing.seed);
        let rule = "a plant of a plot of two species is that plant alone";
        assert_same(rule, &components(&alone), &components(&open.plants[k]));
    }
    let above = HalfSpace { point: [0.0, 0.0, height], normal: [0.0, 0.0, -1.0] };
    let roof = Obstacle { shape: Arc::new(Shape::HalfSpace(above)), kills: Side::Inside, manner: Manner::Kills };
    let under = on_threads(&models, &sowings, until, &[roof]);
    for (plant, member) in under.plants.iter().zip(&under.members) {
        if models[member.species].growth() == Growth::Extends {
            stays_under(plant, height);
        }
    }
}

/// The sowings of the plot: the two species in turn, three plants of each, three ticks apart, in a row on rising
/// ground.
fn sowing(k: u32, seed: u64) -> Sowing {
    let place = [0.4 * f64::from(k), 0.0, 0.05 * f64::from(k)];
    Sowing { species: k as usize % 2, seed: seed_of(seed, 10 + k), place, sown: 3 * (k / 2) }
}

/// The plot grown tick by tick on 1, 2 and 7 threads, with results that must agree. Returns the last plot.
fn on_threads<'m>(
    models: &[&'m dyn GrowthModel; 2],
    sowings: &[Sowing],
    until: Tick,
    obstacles: &[Obstacle],
) -> Plot<'m> {
    let grown = [1, 2, 7].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        pool.install(|| {
            let mut plot = Plot::new(0, models.to_vec(), sowings);
            plot.site.obstacles = obstacles.to_vec();
            for tick in 1..=until {
                super::grow(&mut plot, tick);
                plot.stand(tick);
            }
            plot
        })
    });
    let [one, two, seven] = grown;
    for other in [&two, &seven] {
        for (plant, same) in one.plants.iter().zip(&other.plants) {
            let rule = "a plot is the same on any number of threads";
            assert_same(rule, &components(plant), &components(same));
            assert!(numbered(plant) == numbered(same), "{rule}, to the numbers of its components");
            assert_same(&format!("{rule}, event for event"), &events(plant), &events(same));
            assert!(plant.frames.base == same.frames.base, "{rule}, to the places of its internodes");
        }
        assert!(one.lives == other.lives, "a plot is the same on any number of threads, to what models remember");
    }
    seven
}

/// Every bud that reached the plane was killed there at the next tick: the only living buds beyond it are those that
/// reached it in the last tick.
fn stays_under(plant: &Plant, height: f64) {
    let mut killed = 0;
    for (k, &fate) in plant.axes.apex_fate.iter().enumerate() {
        let axis = phytomer_sim::plant::AxisId(k as u32);
        let at = plant.place[2] + f64::from(bud_frame(plant, axis).base[2]);
        let last = plant.axes.last_node[k].some();
        let reached = last.map_or(plant.axes.appearance[k], |node| plant.nodes.birth[node.index()]);
        if at >= height && reached < plant.age {
            let end = plant.axes.apex_end[k];
            assert!(end <= reached + 1, "a bud dies at the tick after it has reached the plane: axis {k}, {end}");
        }
        killed += u32::from(fate.cause() == Cause::Killed);
        let below = fate.cause() == Cause::Killed && at < height - 1e-6;
        assert!(!below, "no bud is killed below the plane: axis {k} at {at} m");
    }
    assert!(killed > 0 || plant.age == 0, "buds of plant {} reach the plane", plant.id);
}
