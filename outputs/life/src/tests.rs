//! Lives of a small plant that is written by hand: what is kept, and what is known again.
//!
//! A trunk of six internodes, one a tick, bends at the third node; whole species are compared with their lives in
//! `tests/lives.rs` of the root.

#[path = "specimen.rs"]
mod specimen;

use super::{Life, Maker, Nearness, What};
use phytomer_looks::{Flare, Paints, Surface};
use phytomer_meshes::{MeshOptions, OwnForms, Scene, Textures};
use phytomer_sim::Tick;
use phytomer_sim::plant::{Habit, OrganId, Plant};
use specimen::{TALL, plant};
use std::sync::Arc;

fn life(plant: &Plant, ages: impl IntoIterator<Item = Tick>) -> Life {
    let mut maker = Maker::new(Nearness::of(1e-3), &MeshOptions::default());
    ages.into_iter().for_each(|age| maker.show(plant, age));
    maker.finish()
}

/// A straight trunk that grows evenly is two points: its base stands, and its tip has two keys.
#[test]
fn a_trunk_that_grows_evenly_is_two_points() {
    let plant = plant();
    let life = life(&plant, 0..=TALL);
    assert_eq!((life.lines.len(), life.points.len()), (1, 2));
    let [base, tip] = &life.points[..] else { panic!("two points") };
    assert_eq!((life.places(base).len(), life.places(tip).len()), (1, 2));
    assert_eq!(
        [base, tip].map(|point| (point.component, point.birth, point.from, point.tip)),
        [(plant.nodes.component[0], 1.0, 1.0, false), (plant.nodes.component[5], 1.0, 1.0, true)]
    );
    for age in 1..=TALL {
        let heights: Vec<f32> = life.line_at(&life.lines[0], age as f32).map(|(_, place)| place[2]).collect();
        assert!((heights[1] - 0.1 * age as f32).abs() < 1e-6 && heights[0] == 0.0, "{heights:?} at {age}");
    }
    assert!(life.line_at(&life.lines[0], 0.0).next().is_none());
}

/// A plant that stands still needs no further key, at however many ages it is shown; and an age that is not later than
/// the last is left out.
#[test]
fn a_plant_that_stands_still_needs_no_more_keys() {
    let plant = plant();
    let few = life(&plant, TALL..TALL + 3);
    // Bark changes its colour for a while, within two keys or so an internode.
    let many = life(&plant, (TALL..TALL + 2000).flat_map(|age| [age, age, 1]));
    assert_eq!(many.ages.len(), 2000);
    assert_eq!((few.points.len(), few.places(&few.points[0]).len()), (2, 1));
    assert_eq!((many.points.len(), many.places(&many.points[0]).len(), many.places(&many.points[1]).len()), (2, 1, 1));
    assert!(many.keys() < 40, "{}", many.keys());
}

/// A node that the line passes at first and no more after the trunk has bent there becomes a point at that age.
#[test]
fn a_node_becomes_a_point_when_the_line_leaves_it() {
    let straight = plant();
    let mut bent = straight.clone();
    for (k, node) in (3..6).enumerate() {
        bent.frames.base[node] = [0.1 * k as f32, 0.0, 0.3];
        (bent.frames.heading[node], bent.frames.up[node]) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
    }
    let mut maker = Maker::new(Nearness::of(1e-3), &MeshOptions::default());
    maker.show(&straight, 6);
    maker.show(&bent, 7);
    maker.show(&straight, 8);
    let life = maker.finish();
    let of = |age: f32| -> Vec<u32> { life.line_at(&life.lines[0], age).map(|(point, _)| point.component).collect() };
    let number = |node: usize| bent.nodes.component[node];
    assert_eq!(of(6.0), [number(0), number(5)]);
    assert_eq!(of(7.0), [number(0), number(3), number(5)]);
    assert_eq!(of(8.0), of(7.0), "it stays a point");
    let corner = &life.points[1];
    assert_eq!((corner.birth, corner.from, corner.death), (4.0, 7.0, f32::INFINITY));
}

#[test]
fn a_leaf_stands_from_its_birth_to_its_fall_and_a_trunk_until_it_is_shed() {
    let mut plant = plant();
    plant.axes.shed[0] = 6;
    let life = life(&plant, 0..=8);
    let [leaf] = &life.parts[..] else { panic!("one leaf") };
    assert_eq!((leaf.birth, leaf.from, leaf.death), (2.0, 2.0, 5.0));
    assert_eq!((leaf.component, leaf.bearer), (plant.organs.component[0], plant.nodes.component[0]));
    assert_eq!(life.poses(leaf).len(), 1, "it does not move");
    assert_eq!([1.0, 2.0, 4.0, 5.0].map(|age| leaf.stands(age)), [false, true, true, false]);
    assert!(life.points.iter().all(|point| point.death == 6.0));
    assert_eq!(Maker::new(Nearness::of(0.0), &MeshOptions::default()).finish().keys(), 0);
}

/// A leaf that is a curved surface comes back with the surface, and its points are the vertices of the mesh.
#[test]
fn an_organ_that_is_a_curved_surface_can_be_drawn_from_its_life() {
    let mut plant = plant();
    let up = [0.0, 0.0, 1.0];
    let points = [[0.0, 0.0, 0.0], [2.0, -0.5, 0.1], [2.0, 0.5, 0.3]].map(|at| (at, up, [0.0; 2]));
    let surface = Surface::of(&points, &[[0, 1, 2]]);
    let mut paints = Paints::default();
    let place = paints.add_surface(surface.clone()) as u32;
    let habit = Habit { for_drawing: paints.into_habit(), ..(*plant.habit).clone() };
    plant.habit = Arc::new(habit);
    plant.state_surface(OrganId(0), place, [0.1, 0.2, 0.4], 0.01);
    let life = life(&plant, 3..=4);
    assert_eq!((life.parts[0].what, &life.surfaces[..]), (What::Surface(0), &[surface][..]));
    let pose = life.pose_at(&life.parts[0], 3.0);
    assert_eq!(pose.size, [0.1, 0.2, 0.4]);
    let [h, u] = [pose.heading, pose.up];
    let left = [u[1] * h[2] - u[2] * h[1], u[2] * h[0] - u[0] * h[2], u[0] * h[1] - u[1] * h[0]];
    let drawn = life.surfaces[0].points().iter().map(|point| {
        let [x, y, z] = [0, 1, 2].map(|k| pose.size[k] * point.at[k]);
        [0, 1, 2].map(|k| pose.base[k] + x * h[k] + y * left[k] + z * u[k])
    });
    let scene = Scene::new(&plant, 3, &MeshOptions::default());
    let mut mesh = phytomer_meshes::Mesh::default();
    scene.block(scene.blocks() - 1, &mut mesh);
    assert_eq!(mesh.vertices.len(), 3);
    for (vertex, point) in mesh.vertices.iter().zip(drawn) {
        assert!((0..3).all(|k| (vertex.position()[k] - point[k]).abs() < 1e-6), "{point:?}");
    }
}

/// In a plot that is shown at ticks of its own a life has these ticks; births and sizes are the plant's.
#[test]
fn a_life_in_a_plot_has_its_ticks() {
    let own = life(&plant(), 0..=8);
    let ticks: Vec<f32> = (1..=12).map(|tick| tick as f32).collect();
    let in_plot = own.clone().in_plot(4.0, &ticks);
    assert_eq!((in_plot.ages.as_slice(), in_plot.sown), (ticks.as_slice(), 4.0));
    let [leaf] = &in_plot.parts[..] else { panic!("one leaf") };
    assert_eq!((leaf.birth, leaf.from, leaf.death), (2.0, 6.0, 9.0));
    assert!(in_plot.points.iter().all(|point| (point.birth, point.from, point.death) == (1.0, 5.0, f32::INFINITY)));
    for age in 1..=8 {
        let at =
            |life: &Life, age: f32| -> Vec<[f32; 4]> { life.line_at(&life.lines[0], age).map(|at| at.1).collect() };
        assert_eq!(at(&own, age as f32), at(&in_plot, age as f32 + 4.0), "{age}");
    }
}

/// A polygon that is written anew with other corners is another part from then on; one that stays is the same.
#[test]
fn an_organ_whose_outline_changes_is_drawn_as_it_is_at_each_age() {
    let outlined = |side: f32| {
        let mut plant = plant();
        plant.state_outline(OrganId(0), &[[0.0; 3], [side, 0.0, 0.0], [side, side, 0.0]]);
        plant
    };
    let mut maker = Maker::new(Nearness::of(1e-3), &MeshOptions::default());
    for (age, side) in [(2, 0.1), (3, 0.1), (4, 0.2)] {
        maker.show(&outlined(side), age);
    }
    let life = maker.finish();
    let told: Vec<_> = life.parts.iter().map(|part| (part.component, part.from, part.death, part.what)).collect();
    let component = plant().organs.component[0];
    let expected = [(component, 2.0, 4.0, What::Outlined(0)), (component, 4.0, f32::INFINITY, What::Outlined(1))];
    assert_eq!(told, expected);
    assert_eq!(life.outlines.iter().map(|corners| corners[1][0]).collect::<Vec<_>>(), [0.1, 0.2]);
}

/// The flare of a trunk is a part that narrows from the ground to where it ends, half of the trunk at most; the trunk
/// stays the line that it is.
#[test]
fn a_flare_is_a_part_of_the_lowest_internode() {
    let flare = Flare { width: 0.5, height: Some(8.0), lobes: 4, depth: 0.5 };
    let own = Arc::new(OwnForms::default().with(Textures::default(), Some(flare)));
    let plant = plant();
    let shown = |options: &MeshOptions| {
        let mut maker = Maker::new(Nearness::of(1e-3), options);
        (0..=TALL).for_each(|age| maker.show(&plant, age));
        maker.finish()
    };
    let (with, without) = (shown(&MeshOptions { own, ..MeshOptions::default() }), shown(&MeshOptions::default()));
    assert_eq!((&with.lines, &with.points), (&without.lines, &without.points));
    assert_eq!(with.parts.len(), without.parts.len() + 1);
    let part = with.parts.iter().find(|part| part.what == What::Internode).expect("the flare");
    assert_eq!((part.component, part.birth), (plant.nodes.component[0], 1.0));
    for age in 1..=TALL {
        let [length, width, _] = with.pose_at(part, age as f32).size;
        // Internodes of 0.1 m are 0.01 m thick, so that the flare is 0.08 m high, but for half of a trunk of one.
        let high = 0.08_f32.min(0.05 * age as f32);
        assert!((length - high).abs() < 1e-3 && (width - 0.01).abs() < 1e-3, "{length} {width} at {age}");
    }
    assert!(with.stems.iter().any(|model| model.mesh.vertices.len() > 400));
}
