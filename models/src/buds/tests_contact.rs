//! Buds among solids: nothing leaves a closed box or enters one, nothing grows below the ground, a climber stays within
//! its reach of a wire, each answer does what it says, and what is never met changes nothing.
//!
//! Nodes are looked at in the pose in which they grew: these plants do not bend. Absent: the way of one internode
//! (`phytomer_sim::site::way`).

use super::{BudModel, Buds};
use crate::contract::{components, grown_by_the_clock, seed_of};
use crate::fault::Path;
use phytomer_sim::plant::{ApexFate, EventKind, NodeId, OrganId, Plant};
use phytomer_sim::plot::{Plot, Sowing};
use phytomer_sim::pose::{node_frame, organ_frame};
use phytomer_sim::shape::{Cuboid, HalfSpace, Mesh, Point, Polyline, Shape};
use phytomer_sim::site::{Manner, Obstacle, Side};
use phytomer_sim::{Tick, grow};
use std::sync::Arc;

pub(super) fn compiled(text: serde_json::Value, until: Tick) -> BudModel {
    let buds: Buds = serde_json::from_value(text).expect("parameters");
    buds.compile(until, &Path::root()).unwrap_or_else(|faults| panic!("{faults:?}"))
}

/// Three orders that spread in all directions, hanging and rising, with units of several nodes.
pub(super) fn bush(contact: serde_json::Value) -> serde_json::Value {
    let order = |length: f64, insertion: f64, inclination: f64| {
        serde_json::json!({
            "pause": 0.2, "growth_unit": {"nodes": 2, "per_step": 2}, "axillary": {"buds": 1, "ramification": 0.4},
            "internode": {"length_cm": length, "diameter_mm": 2}, "insertion_deg": insertion, "phyllotaxis": 137.5,
            "trend": {"inclination_deg": inclination, "share": 0.1}, "leaf": {
                "per_node": 1, "length_cm": 4, "width_cm": 1, "insertion_deg": 50,
                "trend": {"inclination_deg": 150, "share": {"linear": {"over": "dimension", "start": 0, "slope": 0.1, "max": 0.8}}},
            },
            "traumatic": {"probability": 0.5},
        })
    };
    let orders = [order(3.0, 8.0, 20.0), order(2.5, 70.0, 120.0), order(2.0, 50.0, 60.0)];
    serde_json::json!({"contact": contact, "order": orders})
}

fn blocks(shape: Shape, side: Side) -> Obstacle {
    Obstacle { shape: Arc::new(shape), kills: side, manner: Manner::Blocks { holds: true } }
}

fn grown(model: &BudModel, until: Tick, number: u32, change: impl FnOnce(&mut Plot<'_>)) -> Plant {
    let mut plot = Plot::of_one(model, &seed_of(5, number));
    plot.plants[0].events = Some(Vec::new());
    change(&mut plot);
    grow(&mut plot, until, &mut ()).expect("nothing is recorded");
    plot.stand(until);
    plot.plants.remove(0)
}

/// The nodes of a plant, metres in the plot.
pub(super) fn nodes(plant: &Plant) -> impl Iterator<Item = Point> {
    (0..plant.nodes.len()).map(|node| {
        let tip = node_frame(plant, NodeId(node as u32)).base;
        [0, 1, 2].map(|k| plant.place[k] + f64::from(tip[k]))
    })
}

fn box_mesh(low: Point, high: Point) -> Mesh {
    let points: Vec<Point> =
        (0..8).map(|corner| [0, 1, 2].map(|k| if corner >> k & 1 == 0 { low[k] } else { high[k] })).collect();
    let faces = [
        [0, 2, 1],
        [1, 2, 3],
        [4, 5, 6],
        [5, 7, 6],
        [0, 1, 4],
        [1, 5, 4],
        [2, 6, 3],
        [3, 6, 7],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
    ];
    Mesh::of(&points, &faces).expect("a closed mesh")
}

/// A number from 0 to 1 for each of a sequence, equal on every machine.
pub(super) fn fraction(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 40) as f64 / (1_u64 << 24) as f64
}

/// A thousand random boxes: a plant in a hollow box never leaves it, and its neighbours outside never enter it, be it a
/// box or a closed mesh.
#[test]
fn nothing_leaves_a_closed_box_or_enters_a_closed_mesh() {
    let models = ["deflect", "pause", "die", "fasten"]
        .map(|answer| compiled(bush(serde_json::json!({"answer": answer, "reach_m": 0.02})), 7));
    let (mut state, mut turned, mut reached) = (7, 0, 0);
    for number in 0..1000_u32 {
        let model = &models[number as usize % 4];
        let mut draw = |from: f64, to: f64| from + (to - from) * fraction(&mut state);
        // The seed is in the box.
        let low = [draw(-0.3, -0.02), draw(-0.3, -0.02), draw(-0.3, -0.02)];
        let high = [draw(0.02, 0.3), draw(0.02, 0.3), draw(0.05, 0.4)];
        let hollow = Shape::Cuboid(Cuboid { low, high });
        let within = grown(model, 7, number, |plot| plot.site.obstacles.push(blocks(hollow.clone(), Side::Outside)));
        let left = nodes(&within).enumerate().find(|(_, at)| !hollow.inside(*at));
        assert!(left.is_none(), "box {number}: {low:?} {high:?}, node {left:?}");
        // A box beside the seed.
        let low = [draw(0.02, 0.1), draw(-0.2, 0.0), draw(-0.1, 0.1)];
        let high = [low[0] + draw(0.01, 0.3), low[1] + draw(0.05, 0.4), low[2] + draw(0.05, 0.4)];
        let solid = match number % 2 {
            0 => Shape::Cuboid(Cuboid { low, high }),
            _ => Shape::Mesh(Arc::new(box_mesh(low, high))),
        };
        let beside = grown(model, 7, number, |plot| plot.site.obstacles.push(blocks(solid.clone(), Side::Inside)));
        let entered = nodes(&beside).enumerate().find(|(_, at)| solid.inside(*at));
        assert!(entered.is_none(), "box {number}: {low:?} {high:?}, node {entered:?}");
        turned += usize::from(!within.stated.is_empty()) + usize::from(!beside.stated.is_empty());
        reached += within.nodes.len() + beside.nodes.len();
    }
    // Pausing and dying plants turn too, where their cones end short of an internode.
    assert!(turned > 600 && reached > 20_000, "{turned} plants turned, {reached} nodes");
}

#[test]
fn nothing_grows_below_the_ground_where_it_is_one() {
    let model = compiled(bush(serde_json::json!({"answer": "deflect"})), 9);
    let lowest = |plant: &Plant| {
        let leaf = |organ: usize| {
            let frame = organ_frame(plant, OrganId(organ as u32), 9);
            f64::from(frame.base[2]) + f64::from(plant.organs.length[organ] * frame.heading[2])
        };
        let leaves = (0..plant.organs.len()).map(leaf);
        nodes(plant).map(|at| at[2]).chain(leaves).fold(f64::INFINITY, f64::min)
    };
    let mut below = 0;
    for number in 0..50 {
        let on_ground = grown(&model, 9, number, |plot| plot.site.ground = Some(0.0));
        assert!(lowest(&on_ground) > 0.0, "plant {number}");
        below += usize::from(lowest(&grown(&model, 9, number, |_| ())) < 0.0);
    }
    assert!(below > 10, "in the open leaves of {below} plants hang below the seed");
}

/// A shoot whose growth units come near no wall, but whose leaves would pass through it: each leaf then lies along it.
#[test]
fn leaves_lie_along_a_wall_that_their_shoot_is_far_from() {
    let model = compiled(
        serde_json::json!({"order": [{
            "growth_unit": {"nodes": 9}, "internode": {"length_cm": 0.3, "diameter_mm": 2}, "phyllotaxis": 137.5,
            "leaf": {"per_node": 1, "length_cm": 9, "width_cm": 1, "insertion_deg": 60},
        }]}),
        9,
    );
    let wall = Shape::HalfSpace(HalfSpace { point: [0.05, 0.0, 0.0], normal: [-1.0, 0.0, 0.0] });
    let farthest = |plant: &Plant| {
        let tip = |organ: usize| {
            let frame = organ_frame(plant, OrganId(organ as u32), 9);
            f64::from(frame.base[0]) + f64::from(plant.organs.length[organ] * frame.heading[0])
        };
        (0..plant.organs.len()).map(tip).fold(f64::NEG_INFINITY, f64::max)
    };
    let open = grown(&model, 9, 0, |_| ());
    let beside = grown(&model, 9, 0, |plot| plot.site.obstacles.push(blocks(wall.clone(), Side::Inside)));
    assert!(farthest(&open) > 0.07 && farthest(&beside) < 0.05, "{} {}", farthest(&open), farthest(&beside));
    assert!(open.organs.len() == beside.organs.len() && beside.stated.is_empty());
}

/// An obstacle that is never reached leaves every bit, and so does an answer of the species.
#[test]
fn what_is_never_met_changes_nothing() {
    let model = compiled(bush(serde_json::json!({"answer": "die", "reach_m": 0.1})), 9);
    let other = compiled(bush(serde_json::json!({"answer": "fasten"})), 9);
    let far = Shape::Cuboid(Cuboid { low: [9.0, -1.0, 0.0], high: [10.0, 1.0, 2.0] });
    for number in 0..10 {
        let open = grown_by_the_clock(&model, 9, &seed_of(5, number));
        let beside = grown(&model, 9, number, |plot| plot.site.obstacles.push(blocks(far.clone(), Side::Inside)));
        assert!(components(&open) == components(&beside), "plant {number}");
        assert!(beside.stated.is_empty());
        assert!(components(&grown(&other, 9, number, |_| ())) == components(&open), "plant {number}");
    }
}

fn shoot(contact: serde_json::Value, pause: serde_json::Value) -> BudModel {
    let text = serde_json::json!({"contact": contact, "order": [{
        "pause": pause, "internode": {"length_cm": 1, "diameter_mm": 2}, "phyllotaxis": 137.5,
        "trend": {"inclination_deg": 0, "share": 0.1},
    }]});
    compiled(text, 40)
}

fn roof(height: f64) -> Obstacle {
    blocks(Shape::HalfSpace(HalfSpace { point: [0.0, 0.0, height], normal: [0.0, 0.0, -1.0] }), Side::Inside)
}

/// A shoot of 1 cm a tick under a roof at 10.5 cm: the number of nodes at which each answer ends it, by hand.
#[test]
fn each_answer_does_what_it_says() {
    let under = |contact, pause| grown(&shoot(contact, pause), 30, 0, |plot| plot.site.obstacles.push(roof(0.105)));
    let none = || serde_json::json!(0);
    // A cone of 2.2 cm meets the roof from 9 nodes on.
    let pausing = under(serde_json::json!({"answer": "pause", "reach_m": 0.022}), none());
    assert_eq!(pausing.nodes.len(), 9);
    assert_eq!(pausing.axes.apex_fate[0], ApexFate::Alive);
    let dying = under(serde_json::json!({"answer": "die", "reach_m": 0.022}), none());
    assert_eq!((dying.nodes.len(), dying.axes.apex_fate[0], dying.axes.apex_end[0]), (9, ApexFate::Obstructed, 10));
    let events = dying.events.as_ref().expect("they are kept");
    assert!(events.iter().any(|event| event.kind == EventKind::Obstructed && event.tick == 10));
    // Without a cone the shoot comes as near as it can: to 10 nodes.
    let blind = under(serde_json::json!({"answer": "die"}), none());
    assert_eq!((blind.nodes.len(), blind.axes.apex_end[0]), (10, 11));
    let turning = under(serde_json::json!({}), none());
    let highest = nodes(&turning).map(|at| at[2]).fold(0.0, f64::max);
    assert!(turning.nodes.len() == 30 && highest < 0.105 && highest > 0.1, "{highest}");
    let tip = nodes(&turning).last().expect("nodes");
    assert!(tip[0] * tip[0] + tip[1] * tip[1] > 0.15 * 0.15, "it goes on below the roof: {tip:?}");
    // A law of contact: where the shoot feels the roof it pauses.
    let lawful = under(serde_json::json!({"reach_m": 0.022}), serde_json::json!({"expression": "contact"}));
    assert_eq!(lawful.nodes.len(), 9);
    // In the open the same law is 0.
    let open = grown(&shoot(serde_json::json!({}), serde_json::json!({"expression": "contact"})), 30, 0, |_| ());
    assert_eq!(open.nodes.len(), 30);
}

/// A climber that has reached a wire stays within its reach of it, node by node, round a bend of the wire.
#[test]
fn a_climber_stays_within_reach_of_its_wire() {
    let model = shoot(serde_json::json!({"answer": "fasten", "cling_m": 0.004, "hold_m": 0.012}), serde_json::json!(0));
    let points = [[0.01, 0.0, 0.0], [0.01, 0.0, 0.1], [0.11, 0.1, 0.15], [0.4, 0.1, 0.15]];
    let wire = Shape::Polyline(Polyline::of(points.map(|point| (point, 0.001)).to_vec()));
    let plant = grown(&model, 40, 0, |plot| plot.site.obstacles.push(blocks(wire.clone(), Side::Inside)));
    assert!(plant.nodes.len() > 30, "{}", plant.nodes.len());
    for (node, at) in nodes(&plant).enumerate() {
        let distance = wire.distance(at);
        assert!(distance > 0.0 && distance <= 0.012 + 1e-5, "node {node} at {distance} m");
    }
    let farthest = nodes(&plant).map(|at| at[0]).fold(0.0, f64::max);
    assert!(farthest > 0.2, "it follows the wire: {farthest}");
}

/// Six plants in one room, on 1, 2, 3 and 8 threads.
#[test]
fn plants_among_solids_are_one_on_any_number_of_threads() {
    let model = compiled(bush(serde_json::json!({"answer": "deflect", "reach_m": 0.02})), 9);
    let sowing = |k: u32| Sowing { species: 0, seed: seed_of(5, k), place: [0.2 * f64::from(k), 0.0, 0.0], sown: k };
    let all = [1, 2, 3, 8].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        pool.install(|| {
            let mut plot = Plot::new(0, vec![&model], &(0..6).map(sowing).collect::<Vec<_>>());
            plot.site.ground = Some(0.0);
            plot.site.obstacles.push(roof(0.15));
            grow(&mut plot, 9, &mut ()).expect("nothing is recorded");
            plot.stand(9);
            plot.plants
        })
    });
    for (one, other) in all[1..].iter().flat_map(|plants| plants.iter().zip(&all[0])) {
        assert!(components(one) == components(other));
        assert!(one.frames.base == other.frames.base && one.stated == other.stated);
    }
    assert!(all[0].iter().any(|plant| !plant.stated.is_empty()), "some are turned");
}
