//! A flat petal facet in the sun has one luminance: neither the texels of the shadow map nor the light of the sky show
//! on it, however high the sun stands and however large the facet is in the picture.
//!
//! The facet stands on a tall pole, so that the shadow map that holds both has texels of a millimetre, as that of a
//! whole plant has, or on a short one, so that it cuts through many cells of the light of the sky. Luminance is Y of
//! the pixels, in linear light; one step of a dark byte is two hundredths of it, so that rounding is set aside.

use phytomer::outputs::meshes::MeshOptions;
use phytomer::outputs::pictures::{Canvas, Focus, Picture, Subject, Wanted, draw};
use phytomer::sim::NEVER;
use phytomer::sim::math::{pow, sincosf};
use phytomer::sim::plant::{Cause, Class, Form, Habit, Kind, NewAxis, NewNode, NewOrgan, NodeId, Plant, Seed, Trend};
use phytomer::sim::pose::pose;
use phytomer::sim::rotation::Rotation;
use std::sync::Arc;

/// The heights of the poles, metres.
const POLES: [f32; 2] = [0.002, 2.0];
const SIDE: f32 = 0.04;
/// The most by which luminance may vary, of its mean.
const MOST: f64 = 0.02;
/// The same of a petal that is all of its plant, so that the few cells of the light of the sky end at its rim: two
/// hundredths are not held there.
const MOST_ALONE: f64 = 0.04;
/// The pixels that count lie this share of the picture within the facet. On its rim the grid of the sky looks past it:
/// a petal by itself, which is all of its crown, is up to a twentieth lighter there.
const RIM: u32 = 6;

fn unit([azimuth, elevation]: [f32; 2]) -> [f32; 3] {
    let ((sin, cos), (up, level)) = (sincosf(azimuth), sincosf(elevation));
    [cos * level, sin * level, up]
}

/// A square petal on the tip of a pole, whose upper side points along a direction.
fn petal(normal: [f32; 3], tall: f32) -> Plant {
    let habit = Habit { trends: vec![Trend::STRAIGHT], ..Habit::default() };
    let seed = Seed { plant: 0, draws: 0, run_seed: 1, component_limit: 9, keep_events: false };
    let mut plant = Plant::new(&seed, Arc::new(habit));
    plant.add_axis(NewAxis::OF_THE_SEED);
    plant.add_node(NewNode { length: tall, diameter: 1e-4, ..NewNode::OF_THE_TRUNK });
    let organ = plant.add_organ(NewOrgan {
        node: NodeId(0),
        kind: Kind::Flower,
        position: 0,
        birth: 0,
        death: NEVER,
        cause: Cause::None,
        form: Form(0),
        length: SIDE,
        width: SIDE,
        area: SIDE * SIDE,
        azimuth: 0.0,
        insertion: 0.0,
    });
    let half = 0.5 * SIDE;
    plant.state_outline(organ, &[[0.0, -half, -half], [0.0, half, -half], [0.0, half, half], [0.0, -half, half]]);
    // The frame of the upright internode: along it, to its left and to its upper side.
    let local = |[x, y, z]: [f32; 3]| [z, -y, x].map(f64::from);
    let beside = if normal[2].abs() > 0.9 { [1.0, 0.0, 0.0] } else { [0.0, 0.0, 1.0] };
    plant.state_organ(organ, Rotation::to(local(normal), local(beside)), [0.01, 0.0, 0.0]);
    pose(&mut plant, 1);
    plant
}

/// The light of a place on the scale of bytes of a screen colour (sRGB, IEC 61966-2-1).
fn light(byte: f64) -> f64 {
    let screen = byte / 255.0;
    if screen <= 0.040_45 { screen / 12.92 } else { pow((screen + 0.055) / 1.055, 2.4) }
}

/// By how much the luminance of the pixels within what is drawn varies at least, whatever was rounded away, of its
/// mean; and the number of pixels.
fn varies(canvas: &Canvas) -> (f64, usize) {
    let of = |[red, green, blue, _]: [u8; 4], rounded: f64| {
        let at = |byte: u8| light(f64::from(byte) + rounded);
        0.2126 * at(red) + 0.7152 * at(green) + 0.0722 * at(blue)
    };
    // What is seen of a square is convex: it is enough to look to eight sides.
    let rim = canvas.width / RIM;
    let inner = |x: u32, y: u32| {
        let mut around = [0, rim, 2 * rim].into_iter().flat_map(|dx| [0, rim, 2 * rim].map(move |dy| (dx, dy)));
        around.all(|(dx, dy)| canvas.at(x + dx - rim, y + dy - rim)[3] == 255)
    };
    let ([mut least, mut most], mut sum, mut count) = ([f64::INFINITY, 0.0_f64], 0.0, 0);
    for (x, y) in (rim..canvas.width - rim).flat_map(|x| (rim..canvas.height - rim).map(move |y| (x, y))) {
        if inner(x, y) {
            let pixel = canvas.at(x, y);
            // The light before rounding was at most the one, at least the other.
            (least, most) = (least.min(of(pixel, 0.5)), most.max(of(pixel, -0.5)));
            (sum, count) = (sum + of(pixel, 0.0), count + 1);
        }
    }
    ((most - least) * count as f64 / sum, count)
}

/// The variation of luminance over a petal under a sun, of its mean, on each of the poles.
fn variations(normal: [f32; 3], sun: [f32; 2], side: u32) -> [f64; 2] {
    POLES.map(|tall| variation_on(&petal(normal, tall), sun, side))
}

fn variation_on(plant: &Plant, sun: [f32; 2], side: u32) -> f64 {
    let wanted = Wanted::Largest(Class::Flower);
    let focus = Focus::of(plant, 1, &MeshOptions::default(), wanted).expect("a flower");
    let picture = Picture {
        size: [side; 2],
        transparent: true,
        ground: false,
        caption: false,
        sun: Some(sun),
        focus: Some(Arc::new(focus)),
        ..Picture::default()
    };
    let canvas = draw(&[Subject { plant, age: 1, label: String::new() }], "", &picture);
    let (varies, count) = varies(&canvas);
    assert!(count > (side * side / 30) as usize, "{count} pixels of the petal");
    varies
}

fn degrees([azimuth, elevation]: [f32; 2]) -> [f32; 2] {
    [azimuth.to_radians(), elevation.to_radians()]
}

#[test]
fn a_flat_petal_in_the_sun_has_one_luminance() {
    let mut seen = 0;
    for normal in [[0.0, 88.0], [-40.0, 50.0], [-80.0, 20.0]] {
        for sun in [[-60.0, 12.0], [-100.0, 35.0], [-20.0, 65.0]] {
            let (facing, from) = (unit(degrees(normal)), unit(degrees(sun)));
            if (0..3).map(|k| facing[k] * from[k]).sum::<f32>() < 0.15 {
                continue;
            }
            for side in [60, 320] {
                let found = variations(facing, degrees(sun), side);
                assert!(
                    found[1] < MOST && found[0] < MOST_ALONE,
                    "normal {normal:?}, sun {sun:?}, {side} pixels: {found:?}"
                );
                seen += 1;
            }
        }
    }
    assert!(seen >= 10, "{seen} petals");
}

/// Where the sun grazes a petal its own texels of the shadow map lie above and below it by turns, and a petal that is
/// put into the grid of the sky cell by cell cuts it into stripes: both once drew parallel waves over petals.
#[test]
fn no_waves_run_over_a_petal_that_the_sun_grazes() {
    for azimuth in [0.0, 17.0, 45.0] {
        for above in [4.0, 9.0] {
            // The petal leans away from the sun until it stands so many degrees above its plane.
            let (normal, sun) = ([azimuth + 180.0, 90.0 - (40.0 - above)], [azimuth, 40.0]);
            let found = variations(unit(degrees(normal)), degrees(sun), 240);
            assert!(
                found.iter().all(|found| *found < MOST),
                "sun {above} degrees above the petal, azimuth {azimuth}: {found:?}"
            );
        }
    }
}
