//! Plants between two ticks: they go from the one to the other without a jump, by the rule of growth units, and at the
//! ticks themselves they are the recorded plants to the byte.
//!
//! Places of components are compared by their numbers from moment to moment. Plants of buds, one that bends among them,
//! one that is made anew, one that stands there at once, and L-systems whose rules put internodes between others and
//! take some away are shown. Absent: pictures and films of them (`tests/films.rs`), and their lives (`tests/lives.rs`).

use phytomer::config::{Resolved, validate, validate_texts};
use phytomer::outputs::meshes::{Chunk, MeshOptions, Scene, Vertex, mesh_plant};
use phytomer::run::regrowth::Regrowth;
use phytomer::run::seed_of;
use phytomer::sim::between::Moment;
use phytomer::sim::plant::{Cause, NodeId, OrganId, Plant};
use phytomer::sim::{Growth, Plot, Tick, grow_and_look};
use std::collections::BTreeMap;

type Point = [f32; 3];

/// The ends of a component, its width and its colour, as it is drawn.
#[derive(Debug, Clone, Copy)]
struct Seen {
    ends: [Point; 2],
    width: f32,
    colour: [u8; 3],
}

fn distance(a: Point, b: Point) -> f32 {
    (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f32>().sqrt()
}

/// A species in a run that is no longer than it must be: a plant is grown to the last tick of its run.
fn resolved(species: &str, until: Tick) -> Resolved {
    let scenario = format!(
        "name = \"short\"\nspecies = \"{species}\"\nplants = 1\nages = {{ until = {until}, record = \"all\" }}\n"
    );
    let resolved = validate_texts("short", &[("short", &scenario)]);
    resolved.unwrap_or_else(|report| panic!("{}", report.render(false)))
}

/// An L-system of cells by its axiom and rules.
fn cells(axiom: &str, rules: &str, kinds: &str) -> Resolved {
    let lengths = kinds.chars().map(|cell| format!("[cell.{cell}]\nlength_m = {{ value = 0.1, assumed = true }}\n"));
    let species = format!(
        "name = \"cells\"\nmodel = \"lsystem\"\ntick = \"a step\"\naxiom = \"{axiom}\"\nproduction = {{ {rules} }}\n\
         branching_deg = 45\n{}",
        lengths.collect::<String>()
    );
    let scenario = "name = \"few\"\nspecies = \"cells\"\nplants = 1\nages = { until = 6, record = \"all\" }\n";
    let resolved = validate_texts("few", &[("few", scenario), ("cells", &species)]);
    resolved.unwrap_or_else(|report| panic!("{}", report.render(false)))
}

fn doubling() -> Resolved {
    cells("F", "F = \"FF\"", "F")
}

/// The components that stand, by their numbers.
fn seen(plant: &Plant, age: Tick) -> BTreeMap<u32, Seen> {
    let scene = Scene::new(plant, age, &MeshOptions::default());
    let mut all = BTreeMap::new();
    for node in (0..plant.nodes.len() as u32).map(NodeId).filter(|node| plant.stands(*node, age)) {
        let frame = plant.frames.at(node);
        let ends = [frame.base, frame.advanced(plant.posed_length(node)).base];
        let width = plant.nodes.diameter[node.index()];
        all.insert(plant.nodes.component[node.index()], Seen { ends, width, colour: scene.stems().colour(node) });
    }
    for organ in scene.organs() {
        let drawn = scene.organ(organ);
        let tip = std::array::from_fn(|k| drawn.base[k] + drawn.size[0] * drawn.heading[k]);
        let [r, g, b, _] = drawn.colours[0];
        let seen = Seen { ends: [drawn.base, tip], width: drawn.size[1], colour: [r, g, b] };
        all.insert(plant.organs.component[organ.index()], seen);
    }
    all
}

/// What stands at each of some ages, in their order.
fn at_ages(resolved: &Resolved, ages: &[f64], falls: bool) -> Vec<BTreeMap<u32, Seen>> {
    let moments: Vec<Moment> = ages.iter().map(|age| Moment::of(*age).unwrap()).collect();
    let mut all = Vec::new();
    let shown = Regrowth::of(resolved).falling(falls).show_at(0, &moments, &mut |at, plant| {
        assert_eq!(plant.shown_age(at.tick()), (at.age() * 1e6).round() / 1e6);
        all.push(seen(plant, at.tick()));
        Ok(())
    });
    shown.expect("a plant");
    assert_eq!(all.len(), ages.len());
    all
}

/// How far anything that stands in both moves.
fn moved(before: &BTreeMap<u32, Seen>, after: &BTreeMap<u32, Seen>) -> f32 {
    let each = before.iter().filter_map(|(number, was)| Some((was, after.get(number)?)));
    let moved = |(was, is): (&Seen, &Seen)| {
        let ends = (0..2).map(|k| distance(was.ends[k], is.ends[k])).fold(0.0, f32::max);
        ends.max((was.width - is.width).abs())
    };
    each.map(moved).fold(0.0, f32::max)
}

/// From a tick to just after it, and from just before a tick to it, nothing moves, changes its colour or is there at
/// once; what has gone was there until then.
fn no_jump(resolved: &Resolved, ticks: impl IntoIterator<Item = Tick>) {
    const BESIDE: f64 = 2e-6;
    for tick in ticks.into_iter().map(f64::from) {
        let [was, after, before, is] =
            at_ages(resolved, &[tick, tick + BESIDE, tick + 1.0 - BESIDE, tick + 1.0], false).try_into().unwrap();
        assert!(moved(&was, &after) < 1e-4, "just after {tick}: {} m", moved(&was, &after));
        assert!(moved(&before, &is) < 1e-4, "just before {}: {} m", tick + 1.0, moved(&before, &is));
        assert!(was.keys().chain(is.keys()).all(|number| after.contains_key(number) && before.contains_key(number)));
        for (number, new) in after.iter().filter(|(number, _)| !was.contains_key(number)) {
            assert!(distance(new.ends[0], new.ends[1]) < 1e-4, "{number} is there at once after {tick}: {new:?}");
        }
        for (one, other) in [(&was, &after), (&before, &is)] {
            for (number, colour) in one.iter().map(|(number, seen)| (number, seen.colour)) {
                let Some(other) = other.get(number) else { continue };
                assert!((0..3).all(|k| colour[k].abs_diff(other.colour[k]) <= 1), "{number} at {tick}: {colour:?}");
            }
        }
    }
}

#[test]
fn nothing_jumps_at_a_tick() {
    no_jump(&resolved("fir", 7), [0, 1, 4, 6]);
    no_jump(&resolved("willow", 18), [3, 11, 17]);
    no_jump(&resolved("coffee", 25), [0, 7, 24]);
    no_jump(&resolved("gmt1/5a", 7), [0, 1, 4, 6]);
    no_jump(&resolved("weber_penn/clump", 2), [0, 1]);
    no_jump(&doubling(), [0, 1, 4]);
    no_jump(&resolved("abop/2.7a", 5), [0, 2, 4]);
}

/// Cells that vanish, and branches that are put under others.
#[test]
fn nothing_jumps_where_rules_take_cells_away() {
    no_jump(&cells("A", "A = \"A(A)BA\", B = \"\"", "AB"), 0..5);
    no_jump(&cells("A", "A = \"CB(A)A\", B = \"CB\", C = \"\"", "ABC"), 0..5);
}

/// Half the step, half the largest movement.
#[test]
fn half_the_step_halves_the_largest_movement() {
    let largest = |resolved: &Resolved, first: f64, steps: u32| {
        let ages: Vec<f64> = (0..=steps).map(|k| first + f64::from(k) / f64::from(steps)).collect();
        at_ages(resolved, &ages, false).windows(2).map(|pair| moved(&pair[0], &pair[1])).fold(0.0, f32::max)
    };
    for (name, first) in [("fir", 5), ("willow", 17), ("coffee", 18)] {
        let (resolved, first) = (resolved(name, first + 1), f64::from(first));
        let [whole, half] = [32, 64].map(|steps| largest(&resolved, first, steps));
        assert!(whole > 0.0 && (half / whole - 0.5).abs() < 0.05, "{name}: {half} of {whole} m");
    }
    for resolved in [resolved("gmt1/5a", 6), doubling()] {
        let [whole, half] = [32, 64].map(|steps| largest(&resolved, 4.0, steps));
        assert!((half / whole - 0.5).abs() < 0.05, "{half} of {whole} m");
    }
}

/// Node k of n has the share clamp(n f − k + 1, 0, 1) of its length; old nodes keep theirs, and diameters are linear.
#[test]
fn a_growth_unit_elongates_node_by_node() {
    let resolved = resolved("fir", 6);
    let (tick, mut plants) = (5, Vec::new());
    let shares = [0.1_f32, 0.37, 0.5, 0.93];
    let ages = shares.map(|share| Moment::of(f64::from(tick) + f64::from(share)).unwrap());
    let ages = [&[Moment::from(tick)][..], &ages, &[Moment::from(tick + 1)]].concat();
    let shown = Regrowth::of(&resolved).show_at(0, &ages, &mut |_, plant| {
        plants.push(plant.clone());
        Ok(())
    });
    shown.expect("a plant");
    let [was, between @ .., is] = &plants[..] else { panic!("all ages") };
    let mut most = 0;
    for (plant, share) in between.iter().zip(shares) {
        let mut new: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for node in (0..is.nodes.len()).filter(|node| is.nodes.birth[*node] == tick + 1) {
            new.entry(is.nodes.axis[node].0).or_default().push(node);
        }
        for unit in new.values() {
            most = most.max(unit.len());
            for (k, node) in (1_u16..).zip(unit) {
                let grown = (unit.len() as f32 * share - f32::from(k) + 1.0).clamp(0.0, 1.0);
                let length = plant.posed_length(NodeId(*node as u32));
                assert!(
                    (length - grown * is.nodes.length[*node]).abs() < 1e-6,
                    "node {k} of {} at {share}",
                    unit.len()
                );
            }
        }
        for node in (0..is.nodes.len()).filter(|node| is.nodes.birth[*node] <= tick) {
            let [from, to] = [was, is].map(|plant| plant.nodes.diameter[node]);
            assert!((plant.nodes.diameter[node] - (from + share * (to - from))).abs() < 1e-7);
            assert_eq!(plant.posed_length(NodeId(node as u32)), is.nodes.length[node]);
        }
    }
    assert!(most > 1, "a growth unit has several nodes");
}

/// The mesh of a plant, as bytes.
fn mesh(plant: &Plant, age: Tick) -> Vec<u8> {
    let mut bytes = Vec::new();
    let scene = Scene::new(plant, age, &MeshOptions::default());
    let written = scene.vertices(&mut Chunk::new(), &mut |chunk| {
        bytes.extend_from_slice(chunk.filled());
        chunk.clear();
        Ok(())
    });
    written.expect("memory does not fail");
    bytes
}

/// Whatever is shown between, and on however many threads.
#[test]
fn ticks_are_the_recorded_plants_to_the_byte_and_the_rest_does_not_depend_on_threads() {
    for resolved in [resolved("fir", 5), resolved("willow", 6), resolved("gmt1/5a", 5), doubling()] {
        let mut recorded = Vec::new();
        let regrowth = Regrowth::of(&resolved);
        let shown = regrowth.show(0, &[4, 5], &mut |age, plant| {
            recorded.push(mesh(plant, age));
            Ok(())
        });
        shown.expect("a plant");
        let moments = [4.0, 4.25, 4.75, 5.0].map(|age| Moment::of(age).unwrap());
        let on_threads = |threads: usize| {
            let mut all = Vec::new();
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let shown = pool.install(|| {
                regrowth.show_at(0, &moments, &mut |age, plant| {
                    all.push(mesh(plant, age.tick()));
                    Ok(())
                })
            });
            shown.expect("a plant");
            all
        };
        let first = on_threads(1);
        assert!(first[0] == recorded[0] && first[3] == recorded[1], "the plants of the ticks");
        assert!(first[1] != first[0] && first[1] != first[2] && first[2] != first[3], "they grow");
        assert!([2, 8].into_iter().all(|threads| on_threads(threads) == first));
    }
}

/// Leaves that fall lie on the ground at the end of their tick, have been on their way there before, and go with it.
#[test]
fn what_falls_drops_to_the_ground_first_where_it_is_asked_for() {
    let resolved = resolved("willow", 24);
    let mut fall = None;
    let shown = Regrowth::of(&resolved).show(0, &[24], &mut |_, plant| {
        let organs = &plant.organs;
        let season = (0..organs.len()).filter(|k| organs.cause[*k] == Cause::Season && organs.death[*k] <= 24);
        fall = season.map(|k| organs.death[k]).max();
        let gone =
            (0..organs.len() as u32).map(OrganId).filter(|organ| organs.death[organ.index()] == fall.unwrap_or(0));
        assert!(gone.count() > 10, "a season takes many");
        Ok(())
    });
    shown.expect("a plant");
    let end = f64::from(fall.expect("leaves fall"));
    let ages = [end - 1.0, end - 0.5, end - 1e-5, end];
    let [hangs, drops, lies, gone] = at_ages(&resolved, &ages, true).try_into().unwrap();
    let stays = at_ages(&resolved, &ages, false);
    let falling: Vec<u32> = hangs.keys().filter(|number| !gone.contains_key(number)).copied().collect();
    let height = |of: &BTreeMap<u32, Seen>, number: &u32| of[number].ends[0][2];
    let mean = |of: &BTreeMap<u32, Seen>| {
        falling.iter().map(|number| f64::from(height(of, number))).sum::<f64>() / falling.len() as f64
    };
    assert!(falling.len() > 10);
    assert!(falling.iter().all(|number| height(&lies, number) < 0.2 && lies[number].ends[1][2] < 0.25));
    let [at_first, halfway] = [&hangs, &drops].map(mean);
    assert!(halfway < 0.95 * at_first && halfway > 0.3 * at_first, "{halfway} of {at_first} m");
    assert!((mean(&stays[1]) - at_first).abs() < 0.05 * at_first, "they stay where nothing is asked for");
    assert!(moved(&drops, &stays[1]) > 0.1 && moved(&gone, &stays[3]) == 0.0);
}

#[test]
fn models_say_how_they_grow() {
    for (name, growth) in
        [("fir", Growth::Extends), ("gmt1/5a", Growth::Rebuilds), ("weber_penn/clump", Growth::Rebuilds)]
    {
        assert_eq!(resolved(name, 2).model.growth(), growth, "{name}");
    }
    assert_eq!(doubling().model.growth(), Growth::Rewrites);
}

/// The mesh of the first plant of a scenario at the first of some ages, at which it is shown.
fn shown_first(resolved: &Resolved, ages: &[Tick]) -> Vec<Vertex> {
    let mut first = Vec::new();
    let shown = Regrowth::of(resolved).show(0, ages, &mut |age, plant| {
        if age == ages[0] {
            first = mesh_plant(plant, age, &MeshOptions::default()).vertices;
        }
        Ok(())
    });
    shown.expect("a plant");
    first
}

/// A plant that is shown at an early age stands at no later one, and is still that of the whole run to the byte, with
/// the numbers of its components: plants that are grown ahead, by the clock and with what people do to them, and one
/// that is made anew.
#[test]
fn a_plant_that_is_shown_early_is_that_of_the_whole_run() {
    for (name, age) in [("willow", 12), ("coffee", 30), ("under_a_roof", 6), ("apple_pruning", 5), ("gmt1", 4)] {
        let resolved = validate(name).unwrap_or_else(|report| panic!("{}", report.render(false)));
        let until = resolved.scenario.ages.until;
        let [early, whole] = [vec![age], vec![age, until]].map(|ages| shown_first(&resolved, &ages));
        assert!(!whole.is_empty() && early == whole, "{name} at {age}");
    }
    let resolved = validate("willow").unwrap_or_else(|report| panic!("{}", report.render(false)));
    let looked = |last: Tick| {
        let mut plot = Plot::of_one(resolved.model.as_ref(), &seed_of(&resolved.scenario, 0));
        grow_and_look(&mut plot, [last, 40], &mut ()).expect("nothing is recorded");
        (plot.site.tick, plot.plants[0].components())
    };
    let (early, whole) = (looked(12), looked(40));
    assert_eq!((early.0, whole.0), (12, 40));
    assert_eq!(early.1, whole.1, "growth runs ahead");
}
