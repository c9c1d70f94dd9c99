//! Buds among stems: a shoot passes the stem of a neighbour as a tangent does and never comes nearer than the wood lets
//! it, nor to other axes of its own plant; a climber stays within its reach of a trunk; neither the order of plants nor
//! threads show; and what is never met changes nothing.
//!
//! Distances are found here by points along the new internode, not by the engine's nearest points of two segments.

use super::BudModel;
use super::tests_contact::{bush, compiled, fraction, nodes};
use crate::contract::{components, grown_by_the_clock, seed_of};
use phytomer_sim::plant::{NodeId, Plant, Rest};
use phytomer_sim::plot::{Plot, Sowing};
use phytomer_sim::pose::node_frame;
use phytomer_sim::rotation::Rotation;
use phytomer_sim::shape::Point;
use phytomer_sim::site::solids::CLEARANCE;
use phytomer_sim::site::stems::{Stems, Whose};
use phytomer_sim::{Tick, grow};

/// What rounding and the last round leave of a distance, metres.
const TOLERANCE: f64 = 2e-5;

/// A post of 20 internodes, made at once.
fn post(diameter_mm: f64, length_cm: f64, thickening: f64) -> BudModel {
    let text = serde_json::json!({"order": [{
        "pause": {"expression": "min(1, max(0, age - 1))"}, "growth_unit": {"nodes": 20},
        "internode": {"length_cm": length_cm, "diameter_mm": diameter_mm,
            "thickening_mm": {"linear": {"over": "dimension", "start": 0, "slope": thickening}}},
    }]});
    compiled(text, 80)
}

/// A level shoot along the X axis.
fn level(length_cm: f64, diameter_mm: f64) -> BudModel {
    let text = serde_json::json!({"order": [{
        "insertion_deg": 90, "internode": {"length_cm": length_cm, "diameter_mm": diameter_mm},
    }]});
    compiled(text, 80)
}

fn sowing(species: usize, number: u32, place: Point, sown: Tick) -> Sowing {
    Sowing { species, seed: seed_of(5, number), place, sown }
}

fn grown<'m>(models: Vec<&'m BudModel>, sowings: &[Sowing], whose: Whose, until: Tick) -> Plot<'m> {
    let mut plot = Plot::new(0, models.into_iter().map(|model| model as _).collect(), sowings);
    plot.site.whose_stems = whose;
    grow(&mut plot, until, &mut ()).expect("nothing is recorded");
    plot.stand(until);
    plot
}

/// The ends of an internode, metres in the plot.
fn ends(plant: &Plant, node: usize) -> [Point; 2] {
    let node = NodeId(node as u32);
    [plant.frames.at(node).base, node_frame(plant, node).base]
        .map(|end| [0, 1, 2].map(|k| plant.place[k] + f64::from(end[k])))
}

/// A straight piece of wood that was there: its ends, its radii, its plant and its axis.
type Wood = ([Point; 2], [f64; 2], u32, u32);

fn standing(plot: &Plot<'_>) -> Vec<Wood> {
    let of = |plant: &Plant| {
        let one = |node: usize| {
            let radii = [plant.nodes.diameter[node], plant.nodes.diameter_tip[node]].map(|d| 0.5 * f64::from(d));
            (ends(plant, node), radii, plant.id, plant.nodes.axis[node].0)
        };
        (0..plant.nodes.len()).map(one).collect::<Vec<_>>()
    };
    plot.plants.iter().flat_map(of).collect()
}

/// The distance from a point to the bark.
fn to_bark(point: Point, ([start, end], radii, ..): &Wood) -> f64 {
    let along = [0, 1, 2].map(|k| end[k] - start[k]);
    let dot = |a: Point, b: Point| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
    let share = (dot(along, [0, 1, 2].map(|k| point[k] - start[k])) / dot(along, along)).clamp(0.0, 1.0);
    let out = [0, 1, 2].map(|k| point[k] - start[k] - share * along[k]);
    dot(out, out).sqrt() - radii[0] - share * (radii[1] - radii[0])
}

/// The least distance from an internode to the bark of an axis, at 200 points.
fn least(ends: [Point; 2], wood: &[&Wood]) -> f64 {
    let at = |k: u32| {
        let share = f64::from(k) / 200.0;
        [0, 1, 2].map(|k| ends[0][k] + share * (ends[1][k] - ends[0][k]))
    };
    (0..=200).flat_map(|k| wood.iter().map(move |wood| to_bark(at(k), wood))).fold(f64::INFINITY, f64::min)
}

/// A shoot grows at a post that stands upright in its way, somewhat aside. The internode that would touch it turns as
/// far as it must: so that it is a tangent to the circle about the post whose radius is that of both and the clearance,
/// or so that its end lies on that circle, by the law of cosines.
#[test]
fn a_shoot_passes_the_stem_of_a_neighbour_as_its_tangent() {
    // Diameters in mm, lengths in cm.
    let (diameters, sizes) = ([4.0, 9.0, 20.0, 60.0], [(1.0, 1.0), (2.5, 3.0), (4.0, 5.0), (6.0, 8.0)]);
    let posts = diameters.map(|diameter| post(diameter, 4.0, 0.0));
    let shoots = sizes.map(|(length, diameter)| level(length, diameter));
    let (mut state, mut tangents, mut ended, mut passed, mut climbed) = (11, 0, 0, 0, 0);
    for pair in 0..1000_u32 {
        let [thicker, thinner] = [pair as usize % 4, pair as usize / 4 % 4];
        let (post, shoot) = (&posts[thicker], &shoots[thinner]);
        let mut draw = |from: f64, to: f64| from + (to - from) * fraction(&mut state);
        let (radius, thick) = (0.0005 * diameters[thicker], 0.0005 * sizes[thinner].1);
        let aside = draw(-1.3, 1.3) * (radius + thick + CLEARANCE);
        let (place, start) = ([draw(0.05, 0.2) + radius, aside, 0.0], [0.0, 0.0, draw(0.2, 0.6)]);
        let sowings = [sowing(0, 0, place, 0), sowing(1, 1, start, 1)];
        let plot = grown(vec![post, shoot], &sowings, Whose::Neighbours, 25);
        let wood = standing(&plot);
        let wood: Vec<&Wood> = wood.iter().filter(|(_, _, plant, _)| *plant == 0).collect();
        let plant = &plot.plants[1];
        for node in 0..plant.nodes.len() {
            let near = least(ends(plant, node), &wood);
            assert!(near >= thick + 0.25 * CLEARANCE - TOLERANCE, "pair {pair}, node {node}: {near} m");
        }
        let circle = radius + thick + CLEARANCE;
        let turned = (0..plant.nodes.len()).find(|node| ends(plant, *node)[1][1].abs() > 1e-6);
        let Some(node) = turned else {
            // A shoot that goes by is not turned.
            assert!(aside.abs() > circle - CLEARANCE - 1e-6 || plant.nodes.len() < 24, "pair {pair}: {aside}");
            assert!(plant.stated.is_empty());
            passed += 1;
            continue;
        };
        let [from, end] = ends(plant, node);
        let way = [0, 1].map(|k| end[k] - from[k]);
        let to_post = [0, 1].map(|k| place[k] - from[k]);
        let length = |v: [f64; 2]| (v[0] * v[0] + v[1] * v[1]).sqrt();
        let (far, long) = (length(to_post), length(way));
        let cosine = (way[0] * to_post[0] + way[1] * to_post[1]) / (far * long);
        if cosine.abs() < 0.05 {
            // So nearly head on that the rounds end before it is free: it goes along the bark, aside or up.
            assert!(aside.abs() < 0.75 * circle, "pair {pair}: {aside}");
            climbed += 1;
            continue;
        }
        // The rounds may end once the stem is free: at most the clearance less a quarter within the circle.
        let free = circle - 0.75 * CLEARANCE;
        let tangent = |circle: f64| (far * far - circle * circle).max(0.0).sqrt() / far;
        let by_sides = |circle: f64| (far * far + long * long - circle * circle) / (2.0 * far * long);
        let is_tangent = far * far - circle * circle <= long * long;
        let least = if is_tangent { tangent(circle) } else { by_sides(circle) };
        let most = if far * far - free * free <= long * long { tangent(free) } else { by_sides(free) };
        assert!((least - 1e-4..=most + 1e-4).contains(&cosine), "pair {pair}: {cosine}, not in {least} to {most}");
        (tangents, ended) = (tangents + u32::from(is_tangent), ended + u32::from(!is_tangent));
    }
    assert!(
        tangents > 300 && ended > 50 && passed > 100 && climbed < 150,
        "{tangents} tangents, {ended} ends, {passed} pass by, {climbed} along the bark"
    );
}

/// Every internode of bushes that meet their own axes and those of their neighbours, at the tick at which it grew: it
/// comes no nearer to another axis than its radius and a quarter of the clearance, or than it began.
#[test]
fn no_internode_comes_nearer_to_an_axis_than_the_wood_lets_it() {
    let models = ["deflect", "pause", "die"]
        .map(|answer| compiled(bush(serde_json::json!({"answer": answer, "reach_m": 0.02})), 9));
    let (mut turned, mut looked, mut ended) = (0, 0, 0);
    for number in 0..12_u32 {
        let model = &models[number as usize % 3];
        let sowings = [0, 1, 2].map(|k| sowing(0, 3 * number + k, [0.04 * f64::from(k), 0.0, 0.0], k));
        let mut plot = Plot::new(0, vec![model], &sowings);
        plot.site.whose_stems = Whose::All;
        for tick in 1..=9 {
            let before = standing(&plot);
            let known: Vec<usize> = plot.plants.iter().map(|plant| plant.nodes.len()).collect();
            plot.site.begin(tick);
            plot.grow_to(tick).expect("room to grow");
            plot.stand(tick);
            for (plant, known) in plot.plants.iter().zip(known) {
                for node in known..plant.nodes.len() {
                    let new = ends(plant, node);
                    let (axis, thick) = (plant.nodes.axis[node].0, 0.5 * f64::from(plant.nodes.primary_diameter[node]));
                    let middle = [0, 1, 2].map(|k| 0.5 * (new[0][k] + new[1][k]));
                    // Wood that is farther cannot be touched by an internode of at most 3 cm.
                    let may_touch = |wood: &&Wood| (wood.2, wood.3) != (plant.id, axis) && to_bark(middle, wood) < 0.04;
                    let mut others: Vec<&Wood> = before.iter().filter(may_touch).collect();
                    others.sort_by_key(|wood| (wood.2, wood.3));
                    for of_axis in others.chunk_by(|a, b| (a.2, a.3) == (b.2, b.3)) {
                        let began = least([new[0]; 2], of_axis);
                        let (near, may) = (least(new, of_axis), (thick + 0.25 * CLEARANCE).min(began));
                        assert!(near >= may - TOLERANCE, "plot {number}, tick {tick}: {near} m, not {may}");
                        looked += 1;
                    }
                }
            }
        }
        turned += plot.plants.iter().filter(|plant| !plant.stated.is_empty()).count();
        ended += plot.plants.iter().flat_map(|plant| &plant.axes.apex_fate).filter(|fate| **fate == OBSTRUCTED).count();
    }
    assert!(turned > 10 && looked > 5_000 && ended > 10, "{turned} plants turned, {looked} looked at, {ended} died");
}

const OBSTRUCTED: phytomer_sim::plant::ApexFate = phytomer_sim::plant::ApexFate::Obstructed;

/// A climber beside a post that grows thicker: at the tick at which it grows each node is on the bark or out of it, and
/// within its reach; it comes to the top.
#[test]
fn a_climber_stays_within_reach_of_the_trunk_of_a_neighbour() {
    let trunk = post(80.0, 5.0, 0.4);
    let climber = |support: f64| {
        let contact = serde_json::json!({
            "answer": "fasten", "reach_m": 0.02, "cling_m": 0.006, "hold_m": 0.02, "support_cm": support,
        });
        let text = serde_json::json!({"contact": contact, "order": [{
            "internode": {"length_cm": 2, "diameter_mm": 2}, "trend": {"inclination_deg": 20, "share": 0.1},
        }]});
        compiled(text, 80)
    };
    let (holding, not_holding) = (climber(1.0), climber(20.0));
    let begin = |climber| {
        let sowings = [sowing(0, 0, [0.0; 3], 0), sowing(1, 1, [-0.055, 0.01, 0.01], 2)];
        let mut plot = Plot::new(0, vec![&trunk, climber], &sowings);
        plot.site.whose_stems = Whose::Neighbours;
        plot
    };
    let mut plot = begin(&holding);
    let mut highest = 0.0_f64;
    for tick in 1..=60 {
        let before = standing(&plot);
        let wood: Vec<&Wood> = before.iter().filter(|(_, _, plant, _)| *plant == 0).collect();
        let known = plot.plants[1].nodes.len();
        plot.site.begin(tick);
        plot.grow_to(tick).expect("room to grow");
        plot.stand(tick);
        let plant = &plot.plants[1];
        for node in known..plant.nodes.len() {
            let [from, end] = ends(plant, node);
            let (began, near) = (least([from; 2], &wood), least([end; 2], &wood));
            assert!(near <= 0.02 + TOLERANCE && near >= began.min(0.001), "tick {tick}: {near} m after {began}");
            highest = highest.max(end[2]);
        }
    }
    assert!(highest > 0.9, "{highest}");
    // To wood that is too thin it does not hold: it goes off.
    let mut plot = begin(&not_holding);
    grow(&mut plot, 60, &mut ()).expect("nothing is recorded");
    plot.stand(60);
    let wood = standing(&plot);
    let wood: Vec<&Wood> = wood.iter().filter(|(_, _, plant, _)| *plant == 0).collect();
    let tip = nodes(&plot.plants[1]).last().expect("nodes");
    assert!(least([tip; 2], &wood) > 0.05, "{tip:?}");
}

/// Six bushes in each other's way, on 1, 2, 3 and 8 threads, and in another order.
#[test]
fn neither_threads_nor_the_order_of_plants_show() {
    let model = compiled(bush(serde_json::json!({"answer": "deflect", "reach_m": 0.02})), 9);
    let sowings: Vec<Sowing> = (0..6).map(|k| sowing(0, k, [0.05 * f64::from(k), 0.0, 0.0], k % 3)).collect();
    for whose in [Whose::Neighbours, Whose::All] {
        let all = [1, 2, 3, 8].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
            pool.install(|| grown(vec![&model], &sowings, whose, 9).plants)
        });
        let backward: Vec<Sowing> = sowings.iter().rev().cloned().collect();
        let mut backward = grown(vec![&model], &backward, whose, 9).plants;
        backward.reverse();
        for (one, other) in all[1..].iter().chain([&backward]).flat_map(|plants| plants.iter().zip(&all[0])) {
            assert!(components(one) == components(other));
            assert!(one.frames.base == other.frames.base && one.stated == other.stated);
        }
        assert!(all[0].iter().any(|plant| !plant.stated.is_empty()), "some are turned");
    }
}

/// Stems that are kept from tick to tick are those of the plants: they come, grow thicker, fall with dead branches, and
/// move as plants bend.
#[test]
fn stems_that_are_kept_are_those_of_the_plants() {
    let order = |insertion: f64, death: f64| {
        serde_json::json!({
            "insertion_deg": insertion, "death": death, "shed_after": 1,
            "axillary": {"buds": 2, "ramification": 0.5},
            "internode": {"length_cm": 6, "diameter_mm": 3,
                "thickening_mm": {"linear": {"over": "dimension", "start": 0, "slope": 2}}},
        })
    };
    let text = serde_json::json!({"order": [order(5.0, 0.0), order(60.0, 0.2), order(50.0, 0.3)]});
    let model = compiled(text, 20);
    for whose in [Whose::Neighbours, Whose::All] {
        let sowings: Vec<Sowing> = (0..4).map(|k| sowing(0, k, [0.2 * f64::from(k), 0.0, 0.0], 2 * k)).collect();
        let mut plot = Plot::new(0, vec![&model], &sowings);
        plot.site.whose_stems = whose;
        let mut fallen = 0;
        for tick in 1..=16 {
            let ages: Vec<Option<Tick>> = plot.members.iter().map(|member| member.age_at(tick - 1)).collect();
            let fresh = Stems::of(&plot.plants, &ages, whose);
            plot.site.begin(tick);
            plot.grow_to(tick).expect("room to grow");
            assert!(plot.site.stems.as_deref() == Some(&fresh), "tick {tick}");
            plot.stand(tick);
            let falls = |plant: &Plant| plant.axes.shed.iter().filter(|shed| **shed == tick).count();
            fallen += plot.plants.iter().map(falls).sum::<usize>();
            if tick == 10 {
                // As where a plant bends: all frames are made anew, somewhere else.
                let node = NodeId(0);
                plot.plants[1].state_rest(node, Rest::Turned(Rotation::about([1.0, 0.0, 0.0], 0.3)));
                plot.stand(tick);
            }
        }
        assert!(fallen > 20, "{fallen}");
    }
}

/// Neighbours far away change nothing; nor do other axes where none is met; nor does the key where nobody is near.
#[test]
fn stems_that_are_never_met_change_nothing() {
    let model = compiled(bush(serde_json::json!({"answer": "die", "reach_m": 0.1})), 9);
    let far: Vec<Sowing> = (0..4).map(|k| sowing(0, k, [5.0 * f64::from(k), 0.0, 0.0], 0)).collect();
    let shoots = level(3.0, 4.0);
    let alone: Vec<Sowing> = (0..4).map(|k| sowing(0, k, [0.0, 0.5 * f64::from(k), 0.0], 0)).collect();
    for (model, sowings, whose) in [(&model, &far, Whose::Neighbours), (&shoots, &alone, Whose::All)] {
        let plot = grown(vec![model], sowings, whose, 9);
        for (plant, sowing) in plot.plants.iter().zip(sowings) {
            let open = grown_by_the_clock(model, 9, &sowing.seed);
            assert!(components(&open) == components(plant) && plant.stated.is_empty(), "plant {}", plant.id);
        }
    }
}
