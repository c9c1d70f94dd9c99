//! Framings compared with closed forms: cameras that hold several pictures, points that are swept around an axis,
//! extents of all vertices, and a ground that stands still.

use super::camera::{Camera, Frame, tangents};
use super::cast::placed;
use super::extent::Extent;
use super::gaze::Gaze;
use super::tests::pole;
use super::*;
use phytomer_meshes::{MeshOptions, mesh_plant};
use phytomer_sim::math::sincosf;
use phytomer_sim::plant::{Habit, NewAxis, NewNode, Seed, Trend};
use std::f32::consts::TAU;

fn stand(plant: &Plant) -> Stand<'_> {
    let placed = Placed { plant, age: 1, place: [0.0; 3], own: Arc::default(), seen: Seen::default() };
    Stand { plants: vec![placed], obstacles: Vec::new(), label: "age 1".to_owned() }
}

fn style(view: View) -> Picture {
    Picture { size: [160, 120], view, ..Picture::default() }
}

#[test]
fn the_framing_of_one_picture_gives_that_picture() {
    let plant = pole(1.3, 0.2);
    for view in [View::Perspective, View::Top, View::Front, View::Side, View::Oblique] {
        for turn in [None, Some(0.7)] {
            let style = Picture { turn, ..style(view) };
            let mut survey = Survey::new(&style, None);
            survey.add(&stand(&plant));
            let framing = survey.framing().unwrap();
            let alone = draw_stands(&[stand(&plant)], "pole", &style);
            assert!(draw_framed(&stand(&plant), "pole", &style, &framing) == alone, "{view:?} {turn:?}");
        }
    }
}

#[test]
fn a_framing_of_several_is_that_of_the_largest_in_any_order() {
    let poles = [0.4, 1.3, 0.9].map(|length| pole(length, 0.1));
    let survey = |order: [usize; 3]| {
        let mut survey = Survey::new(&style(View::Perspective), None);
        order.iter().for_each(|k| survey.add(&stand(&poles[*k])));
        survey.framing().unwrap()
    };
    let framing = survey([0, 1, 2]);
    assert_eq!(framing, survey([2, 1, 0]));
    let largest = draw_framed(&stand(&poles[1]), "", &style(View::Perspective), &framing);
    assert!(largest == draw_stands(&[stand(&poles[1])], "", &style(View::Perspective)));
    assert!(Survey::new(&style(View::Front), None).framing().is_none(), "of nothing there is no framing");
}

/// The bounds of a swept point are those of the same point at many places of its circle, seen from anywhere.
#[test]
fn a_point_swept_around_the_axis_is_held_from_every_side() {
    let frame = Frame { left: 20.0, top: 10.0, right: 380.0, bottom: 260.0 };
    let points = [Vec3::new(1.0, 2.0, 0.5), Vec3::new(-0.3, 0.1, 4.0), Vec3::new(2.5, -1.5, 2.0)];
    for perspective in [true, false] {
        let tangents = tangents(&frame, 300.0, perspective);
        let gaze = Gaze::towards(0.4, 0.3);
        let (mut swept, mut around) = (Extent::new(gaze, tangents), Extent::new(gaze, tangents));
        points.iter().for_each(|point| swept.sweep(*point));
        for (step, point) in (0..3600_u16).flat_map(|step| points.map(|point| (step, point))) {
            let (sin, cos) = sincosf(f32::from(step) * PI / 1800.0);
            around.add(Vec3::new(cos * point.x - sin * point.y, sin * point.x + cos * point.y, point.z));
        }
        // A tenth of a degree off the farthest place: r (1 − cos 0.05°) = 4·10⁻⁷ r.
        (0..4).for_each(|k| assert!((swept.most[k] - around.most[k]).abs() < 1e-5, "{swept:?} {around:?}"));
        (0..2).for_each(|k| assert!((swept.depths[k] - around.depths[k]).abs() < 1e-5));
        for turn in 0..8_u8 {
            let gaze = Gaze::towards(f32::from(turn), 0.3);
            let camera = Camera::fitting(&Extent { gaze, ..swept }, &frame, 300.0, f32::INFINITY);
            for point in points {
                let seen = camera.project(point).unwrap();
                let inside = seen.x > 19.9 && seen.x < 380.1 && seen.y > 9.9 && seen.y < 260.1;
                assert!(inside, "{seen} from {turn}");
            }
        }
    }
}

#[test]
fn bare_ground_is_the_same_whatever_stands_on_it() {
    let poles = [0.3, 1.0].map(|length| pole(length, 0.05));
    let style = Picture { caption: false, ..style(View::Perspective) };
    let mut survey = Survey::new(&style, None);
    poles.iter().for_each(|plant| survey.add(&stand(plant)));
    let framing = survey.framing().unwrap();
    let [small, large] = poles.each_ref().map(|plant| draw_framed(&stand(plant), "", &style, &framing));
    let differs = |at: &usize| small.pixels[*at] != large.pixels[*at];
    let count = (0..small.pixels.len()).filter(differs).count();
    assert!(count > 50, "the poles differ");
    // The pole stands in the middle, and its shade falls to the right of it, away from the sun over the left shoulder.
    // It takes light of the sky up to 30 cells of 1/72 of its height away, which are 0.42 m and less than 50 pixels.
    let left = (0..small.pixels.len()).filter(|at| at % 160 < 28);
    assert!(left.into_iter().all(|at| !differs(&at)));
    let (a, b) = (draw_stands(&[stand(&poles[0])], "", &style), &large);
    let corner = |canvas: &Canvas| canvas.at(2, 117);
    assert!(corner(&a) != corner(b), "each by its own camera has a ground of its own");
}

/// A hank of a thousand internodes that lie anyhow, some of them below the ground.
fn hank() -> Plant {
    let habit = Habit { trends: vec![Trend::STRAIGHT], ..Habit::default() };
    let seed = Seed { plant: 0, draws: 0, run_seed: 1, component_limit: 9999, keep_events: false };
    let mut plant = Plant::new(&seed, Arc::new(habit));
    plant.add_axis(NewAxis::OF_THE_SEED);
    // Two bytes of a multiplicative hash (Knuth), in [0, 1).
    let part = |k: u32| (k.wrapping_mul(2_654_435_761) >> 16) as f32 / 65_536.0;
    for k in 0..1000_u32 {
        let node = NewNode { length: 0.3 * part(7 * k), diameter: 0.1 * part(7 * k + 1), ..NewNode::OF_THE_TRUNK };
        plant.add_node(node);
        let (sin, cos) = sincosf(TAU * part(7 * k + 2));
        let (high, low) = sincosf(PI * (part(7 * k + 3) - 0.5));
        plant.frames.base.push([3, 4, 5].map(|of| 4.0 * part(7 * k + of) - if of == 5 { 0.5 } else { 2.0 }));
        plant.frames.heading.push([low * cos, low * sin, high]);
        plant.frames.up.push([-high * cos, -high * sin, low]);
    }
    plant
}

/// Few vertices are made for the extent of a plant, and none is missed: to the bit it is that of all vertices.
#[test]
fn the_extent_of_a_plant_is_that_of_all_its_vertices() {
    let plant = hank();
    let stand = Stand { plants: vec![Placed { age: 1, ..stand(&plant).plants.remove(0) }], ..stand(&plant) };
    let vertices = mesh_plant(&plant, 1, &MeshOptions::default()).vertices;
    let points: Vec<Vec3> = vertices.iter().map(|vertex| Vec3::from_array(vertex.position())).collect();
    let frame = Frame { left: 20.0, top: 10.0, right: 380.0, bottom: 260.0 };
    for (view, turn) in [(View::Perspective, 0.0), (View::Perspective, 2.1), (View::Top, 0.3), (View::Oblique, 4.0)] {
        let placed = placed(&stand, &style(view));
        let (gaze, tangents) = (view.gaze(turn), tangents(&frame, 300.0, view == View::Perspective));
        for (buried, pivot) in [(false, None), (true, None), (true, Some(Vec3::new(0.2, -0.1, 0.0)))] {
            let known = Extent::new(gaze, tangents);
            let mut all = known;
            let mut add = |point: &Vec3| match pivot {
                Some(pivot) => all.sweep(*point - pivot),
                None => all.add(*point),
            };
            points.iter().filter(|point| buried || point.z >= 0.0).for_each(&mut add);
            add(&Vec3::ZERO);
            assert_eq!(placed.extent_beyond(&known, pivot, buried), all, "{view:?} {turn} {buried} {pivot:?}");
            assert_eq!(placed.extent_beyond(&all, pivot, buried), all, "what is held already adds nothing");
        }
        let (low, high) = points.iter().fold((Vec3::ZERO, Vec3::ZERO), |(a, b), point| (a.min(*point), b.max(*point)));
        assert_eq!(placed.bounds(), [low, high]);
    }
}
