//! Pictures compared with closed forms: places of points, sizes of a ball and a tube, hidden triangles, lengths of
//! shadows, coverage of edges, lengths of scale bars.
//!
//! Pictures made with different numbers of threads are compared as well.

use super::camera::{Camera, Frame, Lens, tangents};
use super::caption::{INK, bar_length, length_in_words, letter_size, lone_label};
use super::extent::Extent;
use super::film::{Film, Paint};
use super::raster::{UPRIGHT, Window, cover};
use super::shadow::Shadow;
use super::sky::{Crown, falling_on};
use super::*;
use phytomer_meshes::{Seen, Solid};
use phytomer_sim::math::{sincosf, tan};
use phytomer_sim::plant::{Habit, NewAxis, NewNode, Seed, Trend};
use phytomer_sim::pose::pose;
use phytomer_sim::shape::{Cuboid, Shape};
use std::sync::Arc;

const WHITE: Paint = Paint { colour: [255; 3], thin: false, stained: false, subject: 0 };

fn window(width: u32, height: u32) -> Window {
    Window { columns: 0..width, rows: 0..height, shifts: UPRIGHT }
}

fn picture(size: [u32; 2], view: View) -> Picture {
    Picture { size, view, transparent: true, ground: false, caption: false, ..Picture::default() }
}

/// One upright internode.
pub fn pole(length: f32, diameter: f32) -> Plant {
    let habit = Habit { trends: vec![Trend::STRAIGHT], ..Habit::default() };
    let seed = Seed { plant: 0, draws: 0, run_seed: 1, component_limit: 9, keep_events: false };
    let mut plant = Plant::new(&seed, Arc::new(habit));
    plant.add_axis(NewAxis::OF_THE_SEED);
    plant.add_node(NewNode { length, diameter, ..NewNode::OF_THE_TRUNK });
    pose(&mut plant, 1);
    plant
}

fn alone(plant: &Plant, age: Tick, picture: &Picture) -> Canvas {
    let subject = Subject { plant, age, label: "a".to_owned() };
    draw(&[subject], "b", picture)
}

#[test]
fn points_come_to_lie_where_they_should() {
    let front = Gaze::towards(FRAC_PI_2, 0.0);
    let lens = Lens::Perspective { focal: 100.0 };
    let camera = Camera { gaze: front, eye: Vec3::new(0.0, -10.0, 1.0), lens, centre: [50.0, 40.0] };
    let seen = camera.project(Vec3::new(2.0, 10.0, 3.0)).unwrap();
    assert!((seen - Vec3::new(60.0, 30.0, 0.05)).length() < 1e-4, "{seen}");
    assert_eq!(camera.project(Vec3::new(0.0, -11.0, 0.0)), None, "behind the eye");
    let plan = Camera::parallel(Gaze::down(0.0), [0.0, 0.0], [-5.0, 0.0], 8.0, [50.0, 40.0]);
    let seen = plan.project(Vec3::new(1.0, 2.0, 5.0)).unwrap();
    assert!((seen.x, seen.y) == (58.0, 24.0) && seen.z > plan.project(Vec3::ZERO).unwrap().z, "{seen}");
    for camera in [camera, plan] {
        let point = Vec3::new(0.3, 2.0, -0.7);
        let seen = camera.project(point).unwrap();
        assert!((camera.unproject(seen.x, seen.y, seen.z) - point).length() < 1e-4);
    }
    let ground = camera.ground(50.0, 50.0).unwrap();
    assert!((ground - Vec3::new(0.0, 0.0, 0.0)).length() < 1e-4, "a tenth down over ten metres: {ground}");
    assert_eq!(camera.ground(50.0, 30.0), None, "the sky");
}

#[test]
fn a_fitted_camera_sees_every_point_and_touches_the_frame() {
    let points: Vec<Vec3> = (0..60)
        .map(|k| {
            let (sin, cos) = sincosf(k as f32 * 1.7);
            Vec3::new(3.0 * cos, 2.0 * sin, k as f32 * 0.1)
        })
        .collect();
    let frame = Frame { left: 20.0, top: 10.0, right: 380.0, bottom: 260.0 };
    for perspective in [true, false] {
        let tangents = tangents(&frame, 300.0, perspective);
        let mut extent = Extent::new(Gaze::towards(1.9, 0.2), tangents);
        points.iter().for_each(|point| extent.add(*point));
        let moved = extent.moved(Vec3::new(4.0, -2.0, 1.0));
        let camera = Camera::fitting(&moved, &frame, 300.0, f32::INFINITY);
        let seen = points.iter().map(|point| camera.project(*point + Vec3::new(4.0, -2.0, 1.0)).unwrap());
        let seen: Vec<Vec3> = seen.collect();
        let bound = |f: &dyn Fn(&Vec3) -> f32| seen.iter().map(f).fold(f32::MAX, f32::min);
        let [left, top] = [bound(&|p| p.x - 20.0), bound(&|p| p.y - 10.0)];
        let [right, bottom] = [bound(&|p| 380.0 - p.x), bound(&|p| 260.0 - p.y)];
        let sides = [left, top, right, bottom];
        assert!(sides.iter().all(|room| *room > -0.01), "{sides:?}");
        assert!((left - right).abs() < 0.02 && left < 0.02 || (top - bottom).abs() < 0.02 && top < 0.02, "{sides:?}");
    }
}

/// The area of a triangle in samples, at any place: the mean error is far below the length of its edge.
#[test]
fn a_triangle_covers_its_area_and_neighbours_leave_no_gap() {
    let window = window(400, 300);
    let corners = [Vec3::new(10.3, 20.9, 1.0), Vec3::new(371.2, 111.7, 1.0), Vec3::new(88.8, 271.1, 1.0)];
    let mut hits = vec![0_u8; window.len()];
    cover(&corners, &window, |sample| hits[sample.index] += 1);
    let area = 0.5 * super::raster::turn(&corners).abs();
    let count = hits.iter().map(|hit| f32::from(*hit)).sum::<f32>();
    assert!((count - area).abs() < 0.003 * area, "{count} of {area}");
    // The triangle cut into three from a point inside: every sample is still covered, and none far outside.
    let within = Vec3::new(150.0, 130.0, 1.0);
    let mut cut = vec![0_u8; window.len()];
    for k in 0..3 {
        cover(&[corners[k], corners[(k + 1) % 3], within], &window, |sample| cut[sample.index] += 1);
    }
    assert!(hits.iter().zip(&cut).all(|(hit, cut)| *hit == 0 || *cut > 0));
}

#[test]
fn the_nearer_of_two_triangles_is_seen_in_either_order() {
    let window = window(20, 20);
    let flat = |depth: f32| [Vec3::new(0.0, 0.0, depth), Vec3::new(40.0, 0.0, depth), Vec3::new(0.0, 40.0, depth)];
    let paints = [Paint { colour: [1, 2, 3], ..WHITE }, Paint { colour: [200, 9, 9], thin: true, ..WHITE }];
    for order in [[0, 1], [1, 0]] {
        let mut film = Film::default();
        film.clear(&window);
        order.iter().for_each(|&k| film.deepen(&flat([0.25, 0.5][k]), &window));
        order.iter().for_each(|&k| film.paint(&flat([0.25, 0.5][k]), &window, || ([Vec3::Z; 3], paints[k])));
        let seen = film.seen(window.index(5, 5)).unwrap();
        assert_eq!((seen.paint, seen.depth), (paints[1], 0.5));
        assert!((seen.normal - Vec3::Z).length() < 2e-3);
        assert!(film.seen(window.index(19, 19)).is_some() && film.seen(window.index(0, 0)).is_some());
    }
}

/// A pole of height h throws a shadow of h / tan e.
#[test]
fn the_shadow_of_a_pole_is_as_long_as_it_should_be() {
    let pole = crossed(2.0, 0.02);
    for elevation in [25.0_f64, 45.0, 70.0] {
        let sun = [0.4, elevation.to_radians() as f32];
        let shadow = Shadow::over(Vec3::new(-0.02, -0.02, 0.0), Vec3::new(0.02, 0.02, 2.0), sun);
        pole.iter().for_each(|corners| shadow.cast(corners));
        let (sin, cos) = sincosf(0.4);
        let share = |far: f32| shadow.share(Vec3::new(-cos * far, -sin * far, 0.0));
        let long = (2.0 / tan(elevation.to_radians())) as f32;
        assert!(share(0.5 * long) < 0.4, "{elevation}: {}", share(0.5 * long));
        let end = (0..2000).map(|k| k as f32 * 2.5e-3).filter(|far| share(*far) < 0.9).fold(0.0, f32::max);
        assert!((end - long).abs() < 0.06 * long + 0.03, "{elevation}: {end} of {long}");
        assert_eq!(share(-0.5), 1.0, "towards the sun");
    }
}

/// Two crossed upright rectangles.
fn crossed(height: f32, radius: f32) -> Vec<[Vec3; 3]> {
    let sides = [Vec3::X * radius, Vec3::Y * radius];
    let tall = Vec3::Z * height;
    sides.iter().flat_map(|side| [[-*side, *side, tall + *side], [-*side, tall + *side, tall - *side]]).collect()
}

/// A level sheet of leaves of area index L, G = ½, lets exp(−L / 2 sin e) of each direction through; nothing above it.
#[test]
fn a_canopy_darkens_the_sky_by_beers_law() {
    let crown = Crown::over(Vec3::ZERO, Vec3::new(1.0, 1.0, 0.2), false);
    let step = 0.01;
    for (i, j) in (0..100).flat_map(|i| (0..100).map(move |j| (i, j))) {
        let at = Vec3::new(i as f32 * step, j as f32 * step, 0.1);
        // Two triangles of half the square each make an area index of 1.
        crown.add(&[at, at + Vec3::X * step, at + Vec3::Y * step], true);
        crown.add(&[at + Vec3::X * step, at + Vec3::new(step, step, 0.0), at + Vec3::Y * step], true);
    }
    let sky = crown.lighten();
    let above = falling_on(sky.at(Vec3::new(0.5, 0.5, 0.19)), Vec3::Z);
    let below = falling_on(sky.at(Vec3::new(0.5, 0.5, 0.05)), Vec3::Z);
    assert!((above - 1.0).abs() < 1e-3, "{above}");
    let expected = {
        let weigh = |(e, share): (f64, f64)| {
            let sin = phytomer_sim::math::sin(e.to_radians());
            let through = phytomer_sim::math::exp(-0.5 / sin);
            [share * through * 0.5, share * sin, share * sin * through]
        };
        let rings = [(22.0, 0.5), (42.0, 0.3), (64.0, 0.16), (90.0, 0.04)].map(weigh);
        let sum = |k: usize| rings.iter().map(|ring| ring[k]).sum::<f64>();
        sum(0) + 0.5 * sum(2) / sum(1)
    };
    assert!((f64::from(below) - expected).abs() < 0.02, "{below} where {expected} is expected");
    assert!(falling_on(sky.at(Vec3::new(0.5, 0.5, 0.05)), Vec3::NEG_Z) < 0.05, "no light from below");
}

/// The widths, in diameters, of an octagon with the area of the circle: √(π / (4 sin 45°)) across a corner, and this
/// times cos 22.5° across a flat.
const ACROSS: [f64; 2] = [0.9737, 1.0539];

/// A single upright internode: its silhouette is a rectangle of length times diameter.
#[test]
fn a_tube_is_as_large_as_its_silhouette() {
    let plant = pole(1.0, 0.25);
    let canvas = alone(&plant, 1, &picture([300, 300], View::Front));
    let opacity: f64 = canvas.pixels.iter().map(|pixel| f64::from(pixel[3]) / 255.0).sum();
    // The height fills the frame, which leaves 4.5 % on each side.
    let scale = 300.0 * 0.91;
    // An octagon with the circle's area, seen across a flat and across a corner.
    let [least, most] = ACROSS.map(|share| 0.25 * share * scale * scale);
    assert!(opacity > 0.99 * least && opacity < 1.01 * most, "{opacity} of {least} to {most}");
}

/// Each row of pixels that the edge of an upright tube passes has the same opacity: the share of the pixel that it
/// covers.
#[test]
fn an_edge_covers_a_share_of_its_pixels() {
    let plant = pole(1.0, 0.25);
    let canvas = alone(&plant, 1, &picture([300, 300], View::Front));
    let row = |y: u32| (0..300).map(|x| u32::from(canvas.at(x, y)[3])).sum::<u32>();
    let width = f64::from(row(150)) / 255.0;
    let expected = 0.25 * 300.0 * 0.91;
    // Sixteen samples per pixel resolve a sixteenth on each of two edges.
    let [least, most] = ACROSS.map(|share| share * expected);
    assert!(width <= most + 0.13 && width >= least - 0.13, "{width} of {expected}");
    assert!((20..280).all(|y| row(y).abs_diff(row(150)) <= 2 * 16));
    let partial = (0..300).filter(|x| !matches!(canvas.at(*x, 150)[3], 0 | 255)).count();
    assert!(partial <= 2, "only edges are half covered");
}

#[test]
fn a_transparent_picture_shows_what_is_behind_it() {
    let plant = pole(1.0, 0.1);
    let bare = alone(&plant, 1, &picture([200, 200], View::Perspective));
    assert_eq!(bare.at(3, 3)[3], 0);
    assert!(bare.pixels.iter().any(|pixel| pixel[3] == 255), "the plant itself is solid");
    let shadow = alone(&plant, 1, &Picture { ground: true, ..picture([200, 200], View::Perspective) });
    let half = shadow.pixels.iter().filter(|pixel| (40..240).contains(&pixel[3])).count();
    assert!(half > 50, "a shadow half hides what is below it: {half}");
    let opaque = alone(&plant, 1, &Picture { transparent: false, ground: true, ..picture([200, 200], View::Front) });
    assert!(opaque.pixels.iter().all(|pixel| pixel[3] == 255));
}

#[test]
fn the_scale_bar_is_as_long_as_it_says() {
    assert_eq!(bar_length(100.0, 260.0).map(length_in_words).as_deref(), Some("2 m"));
    assert_eq!(bar_length(1000.0, 260.0).map(length_in_words).as_deref(), Some("20 cm"));
    assert_eq!(bar_length(1e5, 260.0).map(length_in_words).as_deref(), Some("2 mm"));
    let plant = pole(2.0, 0.1);
    let drawn = alone(&plant, 1, &Picture { caption: true, ..picture([800, 600], View::Front) });
    let size = letter_size(600);
    let row = (600.0 - 1.4 * size - 1.0) as u32;
    let ink: Vec<u32> = (0..200).filter(|x| drawn.at(*x, row)[3] > 127 && drawn.at(*x, row)[..3] == INK).collect();
    let scale = (600.0 - 0.045 * 600.0 - 4.6 * size) / 2.0;
    let metres = ink.len() as f32 / scale;
    assert!((metres - 0.2).abs() < 1.5 / scale, "{metres} m where 20 cm fit, by {} pixels", ink.len());
}

#[test]
fn threads_show_nowhere() {
    let plant = pole(2.0, 0.1);
    let style = Picture { ground: true, caption: true, transparent: false, ..picture([160, 120], View::Perspective) };
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| alone(&plant, 1, &style))
    };
    let one = with(1);
    assert!([2, 7, 1].into_iter().all(|threads| with(threads) == one));
}

#[test]
fn a_place_where_nothing_is_left_is_drawn_too() {
    let plant = pole(2.0, 0.1);
    for view in [View::Perspective, View::Top, View::Front, View::Oblique] {
        let style = Picture { ground: true, caption: true, transparent: false, ..picture([160, 120], view) };
        assert!(alone(&plant, 0, &style).pixels.iter().all(|pixel| pixel[3] == 255));
        let bare = Picture { ground: true, ..picture([160, 120], view) };
        assert!(view == View::Front || alone(&plant, 0, &bare).pixels.iter().all(|pixel| pixel[3] == 0));
    }
    let empty = Subject { plant: &plant, age: 0, label: String::new() };
    assert_eq!(sheet(&[empty], "", &picture([99, 77], View::Top)).pixels.len(), 99 * 77);
}

/// Amounts run from one end of the ramp to the other, classes have colours of their own, and the legend names them.
#[test]
fn values_become_colours_and_a_legend() {
    use super::colouring::colours;
    use super::value_colours::{NOTHING, of_class, of_share};
    let of = |scale: Scale, values: Vec<f64>| colours(&Colouring { name: "a".to_owned(), values: vec![values], scale });
    let (amounts, legend) = of(Scale::Amounts, vec![2.0, f64::NAN, 4.0, 3.0]);
    assert_eq!(amounts, [[of_share(0.0), NOTHING, of_share(1.0), of_share(0.5)]]);
    assert!(legend.is_some());
    let names = ["order 1", "order 2", "order 3"].map(str::to_owned).to_vec();
    let (classes, legend) = of(Scale::Classes { first: 1, names }, vec![3.0, 2.0, f64::NAN]);
    assert_eq!(classes, [[of_class(2), of_class(1), NOTHING]]);
    let told = format!("{:?}", legend.expect("a legend"));
    assert!(told.contains("order 2") && told.contains("order 3") && !told.contains("order 1"), "{told}");
    assert_eq!(of(Scale::Amounts, vec![f64::NAN]), (vec![vec![NOTHING]], None));
}

/// A wall of 2 × 1 m, seen from the front in parallel projection: as high as half of its width, in the colour that is
/// stated. It hides the pole behind it, and where the plant stands does not move.
#[test]
fn an_obstacle_is_drawn_with_its_stand() {
    let plant = pole(0.5, 0.05);
    let wall = Shape::Cuboid(Cuboid::on([0.0, -1.0, 0.0], [2.0, 0.2, 1.0]));
    let mesh = Arc::new(Solid::of(&wall).expect("it has an end").obstacle(Some([200, 30, 30])));
    let drawn = |obstacles: Vec<Arc<Mesh>>, view: View| {
        let placed = Placed { plant: &plant, age: 1, place: [0.0; 3], own: Arc::default(), seen: Seen::default() };
        let stand = Stand { plants: vec![placed], obstacles, label: String::new() };
        draw_stands(&[stand], "", &picture([200, 160], view))
    };
    let canvas = drawn(vec![Arc::clone(&mesh)], View::Front);
    let seen: Vec<(u32, u32)> =
        (0..160).flat_map(|y| (0..200).map(move |x| (x, y))).filter(|(x, y)| canvas.at(*x, *y)[3] == 255).collect();
    let extent = |of: &dyn Fn(&(u32, u32)) -> u32| {
        let all = seen.iter().map(of);
        all.clone().max().unwrap_or(0) - all.min().unwrap_or(0)
    };
    let (wide, tall) = (extent(&|at| at.0), extent(&|at| at.1));
    assert!(wide.abs_diff(2 * tall) <= 3, "{wide} × {tall}");
    assert_eq!(seen.len() as u32, (wide + 1) * (tall + 1), "nothing but the wall");
    assert!(seen.iter().all(|(x, y)| canvas.at(*x, *y)[0] > 2 * canvas.at(*x, *y)[1]), "it is red");
    assert!(drawn(vec![mesh], View::Top) != drawn(Vec::new(), View::Top));
}

/// The scale bar has 0.16 of the width, the title the right part; the label is written under its foot, or beside the
/// bar, or above both, so that no text meets another.
#[test]
fn a_label_gives_way_to_the_scale_bar() {
    let (free, of) = ([160.0, 500.0], (400.0, 10.0));
    assert_eq!(lone_label(300.0, 50.0, free, of), [300.0, 400.0], "there is room");
    assert_eq!(lone_label(60.0, 50.0, free, of), [210.0, 400.0], "beside the bar");
    assert_eq!(lone_label(480.0, 50.0, free, of), [480.0, 381.0], "above the title");
    let [x, line] = lone_label(220.0, 200.0, free, of);
    // The length of the bar is written 0.75 sizes above the line, a size high; stems reach a third of a size down.
    assert!(x == 220.0 && line + 10.0 / 3.0 < 400.0 - 7.5 - 10.0, "{line}");
}
