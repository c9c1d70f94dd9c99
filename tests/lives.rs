//! The life of a plant gives the plant back at each age at which it was shown, within its tolerance.
//!
//! Each base and tip of every internode, with its radius, is compared with the line of its axis, each point of a line
//! with the internodes of its axis, and each organ with the part of its number. Plants of buds, one that bends, one
//! that is made anew at each age and one whose rules put internodes between others are compared. Absent: files that are
//! made from a life.

use phytomer::config::{Resolved, validate, validate_texts};
use phytomer::outputs::life::{Life, Lives, Maker, Nearness, What};
use phytomer::outputs::meshes::{MeshOptions, Scene};
use phytomer::run::regrowth::Regrowth;
use phytomer::run::seed_of;
use phytomer::sim::between::Moment;
use phytomer::sim::plant::{NodeId, Plant};
use phytomer::sim::{Plot, Recorder, Sowing, Tick, grow};
use std::collections::BTreeMap;

type Point = [f32; 3];

fn distance(a: Point, b: Point) -> f32 {
    (0..3).map(|k| (a[k] - b[k]) * (a[k] - b[k])).sum::<f32>().sqrt()
}

/// How far a place with a radius is from a piece of a line, in place or in radius, whichever is more.
fn off(at: Point, radius: f32, from: [f32; 4], to: [f32; 4]) -> f32 {
    let along: Point = std::array::from_fn(|k| to[k] - from[k]);
    let seen: Point = std::array::from_fn(|k| at[k] - from[k]);
    let dot = |a: Point, b: Point| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let square = dot(along, along);
    let share = if square > 0.0 { (dot(seen, along) / square).clamp(0.0, 1.0) } else { 0.0 };
    let near: [f32; 4] = std::array::from_fn(|k| from[k] + share * (to[k] - from[k]));
    distance(at, [near[0], near[1], near[2]]).max((radius - near[3]).abs())
}

/// The ends of the standing internodes of each axis, by the number of its bud.
fn internodes(plant: &Plant, age: Tick) -> BTreeMap<u32, Vec<[[f32; 4]; 2]>> {
    let mut axes: BTreeMap<u32, Vec<[[f32; 4]; 2]>> = BTreeMap::new();
    for node in (0..plant.nodes.len() as u32).map(NodeId).filter(|node| plant.stands(*node, age)) {
        let frame = plant.frames.at(node);
        let tip = frame.advanced(plant.posed_length(node)).base;
        let radii = [&plant.nodes.diameter, &plant.nodes.diameter_tip].map(|column| 0.5 * column[node.index()]);
        let end = |[x, y, z]: Point, radius: f32| [x, y, z, radius];
        let bud = plant.axes.component[plant.nodes.axis[node.index()].index()];
        axes.entry(bud).or_default().push([end(frame.base, radii[0]), end(tip, radii[1])]);
    }
    axes
}

/// Compares a life with the plant as it stood at an age.
fn compare(life: &Life, plant: &Plant, age: Tick, within: f32) {
    let at = plant.shown_age(age) as f32;
    let axes = internodes(plant, age);
    let mut lines: BTreeMap<u32, Vec<Vec<[f32; 4]>>> = BTreeMap::new();
    for line in &life.lines {
        let points: Vec<[f32; 4]> = life.line_at(line, at).map(|(_, place)| place).collect();
        if !points.is_empty() {
            lines.entry(line.axis).or_default().push(points);
        }
    }
    assert_eq!(lines.keys().collect::<Vec<_>>(), axes.keys().collect::<Vec<_>>(), "the axes at {age}");
    let near = |place: &[f32; 4], pieces: &mut dyn Iterator<Item = [[f32; 4]; 2]>| {
        let [x, y, z, radius] = *place;
        let off = pieces.map(|[from, to]| off([x, y, z], radius, from, to)).fold(f32::INFINITY, f32::min);
        assert!(off <= within * 1.01, "at {age}: {off} m from the other, and {within} m is the tolerance");
    };
    for (axis, internodes) in &axes {
        let lines = &lines[axis];
        let pieces = || lines.iter().flat_map(|points| points.windows(2).map(|pair| [pair[0], pair[1]]));
        internodes.iter().flatten().for_each(|place| near(place, &mut pieces()));
        lines.iter().flatten().for_each(|place| near(place, &mut internodes.iter().copied()));
    }
    compare_organs(life, plant, (age, at), within);
}

fn compare_organs(life: &Life, plant: &Plant, (age, at): (Tick, f32), within: f32) {
    let standing = life.parts.iter().filter(|part| part.stands(at));
    let parts: BTreeMap<u32, _> = standing.map(|part| (part.component, part)).collect();
    let scene = Scene::new(plant, age, &MeshOptions::default());
    assert_eq!(scene.organs().count(), parts.len(), "the organs at {age}");
    for organ in scene.organs() {
        let drawn = scene.organ(organ);
        let part = parts[&plant.organs.component[organ.index()]];
        assert_eq!(part.kind, plant.organs.kind[organ.index()]);
        assert!(matches!(part.what, What::Organ(form) if form == plant.organs.form[organ.index()]));
        let pose = life.pose_at(part, at);
        let end = |base: Point, along: Point, size: f32| std::array::from_fn(|k| base[k] + size * along[k]);
        let pairs = [
            (drawn.base, pose.base),
            (end(drawn.base, drawn.heading, drawn.size[0]), end(pose.base, pose.heading, pose.size[0])),
            (end(drawn.base, drawn.up, drawn.size[1]), end(pose.base, pose.up, pose.size[1])),
        ];
        for (one, other) in pairs {
            let off = distance(one, other);
            assert!(off <= within * 1.01, "an organ at {age} is {off} m off, and {within} m is the tolerance");
        }
    }
}

/// Shows a plant at ages and compares its life with it at each of them.
fn give_back(resolved: &Resolved, ages: &[Tick], within: f32) -> Life {
    let mut maker = Maker::new(Nearness::of(within), &MeshOptions::default());
    let mut seen: Vec<(Tick, Plant)> = Vec::new();
    let shown = Regrowth::of(resolved).show(0, ages, &mut |age, plant| {
        maker.show(plant, age);
        seen.push((age, plant.clone()));
        Ok(())
    });
    shown.expect("a plant");
    let life = maker.finish();
    assert_eq!(life.ages.len(), ages.len());
    for (age, plant) in &seen {
        compare(&life, plant, *age, within);
    }
    life
}

fn resolved(name: &str) -> Resolved {
    validate(name).unwrap_or_else(|report| panic!("{}", report.render(false)))
}

#[test]
fn a_willow_that_bends_comes_back_at_each_age() {
    let ages: Vec<Tick> = (0..=18).collect();
    let [coarse, fine] = [5e-3, 5e-4].map(|within| give_back(&resolved("willow"), &ages, within));
    assert!(coarse.keys() < fine.keys(), "{} of {}", coarse.keys(), fine.keys());
}

#[test]
fn coffee_and_fir_come_back_at_each_age() {
    let ages = |last: Tick| (0..=last).collect::<Vec<_>>();
    give_back(&resolved("coffee"), &ages(20), 1e-3);
    give_back(&resolved("coffee"), &[3, 12, 24], 1e-3);
    give_back(&resolved("fir"), &ages(8), 1e-3);
}

#[test]
fn a_plant_that_is_made_anew_comes_back_at_each_age() {
    let life = give_back(&resolved("gmt1"), &(0..=8).collect::<Vec<_>>(), 1e-3);
    assert!(life.points.iter().all(|point| point.death.is_infinite()), "nothing of it ever falls");
}

/// F → FF doubles a straight axis at each tick: its line has its two ends, of which the upper moves.
#[test]
fn an_axis_into_which_internodes_are_put_comes_back_at_each_age() {
    let species = "name = \"doubling\"\nmodel = \"lsystem\"\ntick = \"a step\"\naxiom = \"F\"\nproduction = { F = \"FF\" }\n\
                   branching_deg = 45\n[cell.F]\nlength_m = { value = 0.1, assumed = true }\n";
    let scenario = "name = \"twice\"\nspecies = \"doubling\"\nplants = 1\nages = { until = 7, record = \"all\" }\n";
    let resolved = validate_texts("twice", &[("twice", scenario), ("doubling", species)]);
    let resolved = resolved.unwrap_or_else(|report| panic!("{}", report.render(false)));
    let life = give_back(&resolved, &(0..=7).collect::<Vec<_>>(), 1e-3);
    let line = &life.lines[0];
    let tips: Vec<f32> =
        (0..=7).filter_map(|age| life.line_at(line, age as f32).last().map(|(_, place)| place[2])).collect();
    assert_eq!(life.line_at(line, 7.0).count(), 2);
    for (age, tip) in tips.iter().enumerate() {
        assert!((tip - 0.1 * f32::from(1_u8 << age)).abs() < 1e-3, "{tip} at {age}");
    }
}

/// Between ticks a life is the plant on its way: what appears grows from next to nothing, and what falls goes at the
/// end.
#[test]
fn a_life_between_ticks_grows() {
    let ages = [0.0, 3.25, 4.5, 5.75, 6.0].map(|age| Moment::of(age).unwrap());
    for (mut resolved, falls) in [(resolved("fir"), false), (resolved("willow"), true), (resolved("gmt1"), false)] {
        resolved.scenario.ages.until = 6;
        let mut plot = Plot::of_one(resolved.model.as_ref(), &seed_of(&resolved.scenario, 0));
        let mut lives = Lives::new(Nearness::of(1e-3), Vec::new(), (0..=6).collect()).between(4, falls);
        grow(&mut plot, resolved.scenario.ages.until, &mut lives).expect("it grows");
        let life = lives.finish().remove(0).expect("a life");
        assert_eq!(life.ages.len(), 7 + 6 * 4);
        let shown = Regrowth::of(&resolved).falling(falls).show_at(0, &ages, &mut |age, plant| {
            compare(&life, plant, age.tick(), 1e-3);
            Ok(())
        });
        shown.expect("a plant");
        for part in life.parts.iter().filter(|part| part.from > 0.0 && part.from < part.birth) {
            let size = |age: f32| life.pose_at(part, age).size[0];
            assert!(size(part.from) <= 0.05 * size(part.birth), "{part:?}");
        }
        assert!(life.parts.iter().all(|part| part.death.is_infinite() || part.death.fract() == 0.0));
    }
}

/// A plot in which the second plant is sown later and elsewhere: each life has its own ages, and its place.
#[test]
fn a_plot_has_a_life_for_each_plant() {
    let resolved = resolved("coffee");
    let sowing = |number: u32, sown: Tick| Sowing {
        species: 0,
        seed: seed_of(&resolved.scenario, number),
        place: [f64::from(number) * 2.0, 0.0, 0.0],
        sown,
    };
    let sowings = [sowing(0, 0), sowing(1, 5), sowing(2, phytomer::sim::NEVER)];
    let mut plot = Plot::new(0, vec![resolved.model.as_ref()], &sowings);
    let mut lives = Lives::new(Nearness::of(1e-3), Vec::new(), vec![0, 6, 12, 18]);
    assert!(lives.wants(12) && !lives.wants(13));
    grow(&mut plot, 18, &mut lives).expect("it grows");
    let lives = lives.finish();
    let ages: Vec<_> = lives.iter().map(|life| life.as_ref().map(|life| life.ages.clone())).collect();
    assert_eq!(ages, [Some(vec![0.0, 6.0, 12.0, 18.0]), Some(vec![1.0, 7.0, 13.0]), None]);
    let [Some(first), Some(second), None] = &lives[..] else { panic!("two plants are sown") };
    assert_eq!([first.place[0], second.place[0]], [0.0, 2.0]);
    plot.plants.iter().zip([first, second]).for_each(|(plant, life)| {
        assert_eq!(plant.id, life.plant);
        compare(life, plant, if plant.id == 0 { 18 } else { 13 }, 1e-3);
    });
}
