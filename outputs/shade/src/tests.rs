//! Hours of shade against closed forms.

use super::*;
use phytomer_sim::math::{acos, sincos};
use phytomer_sim::site::date::Date;
use phytomer_sim::site::sun::Sun;
use std::f64::consts::PI;

fn sky(latitude_deg: f64) -> Sky {
    let latitude = latitude_deg.to_radians();
    Sky { latitude, longitude: 0.0, year: 2023, days_a_month: 2, step_h: 0.1, lowest: 0.0 }
}

fn rectangle(low: Point, high: Point) -> Polygon {
    Polygon { corners: vec![low, [high[0], low[1]], high, [low[0], high[1]]] }
}

fn building(body: &Body, place: Point, turn: f64) -> Caster<'_> {
    Caster { body, place, turn, leafless: [false; 12], cause: Cause::Building }
}

fn hours_of(sky: &Sky, samples: &Samples, casters: &[Caster<'_>]) -> Shade {
    shade(sky, samples, casters, &[], &Watch::default()).expect("nothing stops it")
}

/// How long a place lies in the shade of a wall without end from the west to the east, north of it by `distance`, on a
/// day: hours. Where the sun stands in the south, the shadow of its top reaches `height` × −north/up to the north; that
/// it reaches the place is linear in the cosine of the hour angle.
fn behind_a_wall(latitude: f64, declination: f64, height: f64, distance: f64) -> f64 {
    let ((sin_phi, cos_phi), (sin_delta, cos_delta)) = (sincos(latitude), sincos(declination));
    let half_day = acos((-sin_phi * sin_delta / (cos_phi * cos_delta)).clamp(-1.0, 1.0));
    let factor = cos_delta * (height * sin_phi - distance * cos_phi);
    let bound = sin_delta * (distance * sin_phi + height * cos_phi);
    // cos(hour angle) × factor ≥ bound, while the sun is up.
    let met = acos((bound / factor).clamp(-1.0, 1.0));
    let (from, to) = if factor > 0.0 { (0.0, met.min(half_day)) } else { (met.min(half_day), half_day) };
    (to - from) * 24.0 / PI
}

/// The mean of the wall's shade over a strip from the wall to a distance and over the days of a month.
fn strip_behind_a_wall(sky: &Sky, month: u32, height: f64, to: f64) -> f64 {
    let steps = 4000;
    let days = sky.days(month);
    let all: f64 = days.iter().map(|day| day.days).sum();
    let of_day = |day: &Day| {
        let declination = Sun::at_solar_time(day.date, 12.0, 0.0).declination;
        let at = |step: i32| {
            behind_a_wall(sky.latitude, declination, height, (f64::from(step) + 0.5) / f64::from(steps) * to)
        };
        (0..steps).map(at).sum::<f64>() / f64::from(steps) * day.days
    };
    days.iter().map(of_day).sum::<f64>() / all
}

#[test]
fn a_strip_behind_a_long_wall_has_the_hours_of_the_closed_form() {
    let (height, depth) = (4.0, 0.2);
    let wall = Body::cuboid([2e5, depth], [0.0, height]);
    for latitude in [48.2, 20.0, 66.0, -30.0] {
        let sky = Sky { step_h: 1.0 / 30.0, ..sky(latitude) };
        let samples = Samples::of(&[rectangle([0.0, 0.0], [1.0, 6.0])], 0.05).expect("few cells");
        let hours = hours_of(&sky, &samples, &[building(&wall, [0.0, -depth / 2.0], 0.0)]);
        for month in 1..=12 {
            let (found, known) = (&hours.zones[0][month as usize - 1], strip_behind_a_wall(&sky, month, height, 6.0));
            let off = (found.shade_h() - known).abs();
            assert!(off < 0.02, "{latitude}, {month}: {} and not {known}", found.shade_h());
            // Shade that is shorter than a step may fall between two moments.
            assert!(
                off < 3.0 * found.error_h + sky.step_h / 4.0,
                "{latitude}, {month}: off by {off}, told {}",
                found.error_h
            );
            assert_eq!(found.plant_h, 0.0);
        }
    }
}

/// The same points north instead of south.
fn mirrored(samples: &Samples) -> Samples {
    let mut samples = samples.clone();
    samples.all.iter_mut().for_each(|sample| sample.place[1] = -sample.place[1]);
    for grid in &mut samples.grids {
        grid.corner[1] = -(grid.corner[1] + grid.side[1] * grid.size[1] as f64);
        let rows: Vec<Vec<u32>> = grid.samples.chunks(grid.size[0]).map(<[u32]>::to_vec).collect();
        grid.samples = rows.into_iter().rev().flatten().collect();
    }
    samples
}

/// The same house in the north and in the south, under the suns of equal and opposite declinations: what is shaded
/// there is the mirror image of what is shaded here. (`sky` has the proof that these suns mirror each other.) And by
/// the calendar June here is December there, to what the ellipse of the earth's way makes the seasons differ by.
#[test]
fn the_hemispheres_mirror_each_other() {
    let body = Body::cuboid([3.0, 2.0], [0.0, 5.0]);
    let zones = [rectangle([-6.0, 2.0], [4.0, 7.0]), rectangle([2.0, -2.0], [9.0, 1.0])];
    let here = Samples::of(&zones, 0.25).expect("few cells");
    let there = mirrored(&here);
    let area = |samples: &Samples, turn: f64, shift: [f64; 2]| -> f64 {
        let mut marks = shadow::Marks::none(samples.all.len());
        shadow::cast(samples, &building(&body, [0.0, 0.0], turn), 0, shift, &mut marks);
        marks.beyond(None).map(|point| samples.all[point].area_m2).sum()
    };
    let mut shaded = 0.0;
    for moment in (1..=12).flat_map(|month| sky(40.0).days(month)).flat_map(|day| day.moments) {
        let [east, north] = moment.shift;
        let areas = [area(&here, 0.3, [east, north]), area(&there, -0.3, [east, -north])];
        assert!((areas[0] - areas[1]).abs() < 1e-9, "{areas:?}");
        shaded += areas[0];
    }
    assert!(shaded > 1000.0);
    let hours = |samples: &Samples, latitude: f64, turn: f64| {
        hours_of(&sky(latitude), samples, &[building(&body, [0.0, 0.0], turn)])
    };
    let (north, south) = (hours(&here, 40.0, 0.3), hours(&there, -40.0, -0.3));
    for (zone, other) in north.zones.iter().zip(&south.zones) {
        for month in 0..12 {
            let (here, there) = (zone[month].shade_h(), other[(month + 6) % 12].shade_h());
            assert!((here - there).abs() < 0.12 + 0.1 * here, "{month}: {here} {there}");
        }
    }
}

#[test]
fn mornings_and_afternoons_are_the_same() {
    let body = Body::cuboid([3.0, 2.0], [0.0, 5.0]);
    let zones = [rectangle([2.0, -5.0], [8.0, 5.0]), rectangle([-8.0, -5.0], [-2.0, 5.0])];
    let samples = Samples::of(&zones, 0.25).expect("few cells");
    let hours = hours_of(&sky(52.0), &samples, &[building(&body, [0.0, 0.0], 0.0)]);
    for month in 0..13 {
        let [east, west] = [0, 1].map(|zone| hours.zones[zone][month]);
        let (off, told) = ((east.shade_h() - west.shade_h()).abs(), east.error_h + west.error_h);
        assert!(off < 0.01 && off < 3.0 * told + 1e-3 && east.shade_h() > 0.1, "{month}: {east:?} {west:?}");
    }
}

#[test]
fn finer_grids_and_steps_converge_to_what_errors_tell() {
    let body = Body::cuboid([3.0, 2.0], [0.0, 5.0]);
    let zone = Polygon { corners: vec![[-6.0, 2.0], [4.0, 1.5], [5.0, 7.0], [1.0, 4.0], [-3.0, 8.0]] };
    let of = |spacing: f64, step_h: f64| {
        let samples = Samples::of(std::slice::from_ref(&zone), spacing).expect("few cells");
        let sky = Sky { step_h, days_a_month: 1, ..sky(45.0) };
        hours_of(&sky, &samples, &[building(&body, [0.0, 0.0], 0.6)]).zones[0]
    };
    let fine = of(0.04, 1.0 / 60.0);
    let mut last = [f64::INFINITY; 2];
    for (spacing, step_h) in [(1.0, 0.8), (0.25, 0.2), (0.1, 0.05)] {
        let coarse = of(spacing, step_h);
        let off = (0..12).map(|month| (coarse[month].shade_h() - fine[month].shade_h()).abs()).fold(0.0, f64::max);
        let told = coarse[..12].iter().map(|month| month.error_h).fold(0.0, f64::max);
        assert!(off < last[0] && told < last[1], "{spacing}: off by {off}, told {told}, before {last:?}");
        assert!(off < 2.0 * told, "{spacing}: off by {off}, told {told}");
        last = [off, told];
    }
    assert!(last[0] < 0.01, "{last:?}");
}

#[test]
fn polar_nights_have_no_hours_and_polar_days_have_all() {
    let body = Body::cuboid([50.0, 50.0], [3.0, 4.0]);
    let samples = Samples::of(&[rectangle([-1.0, -1.0], [1.0, 1.0])], 0.5).expect("few cells");
    for latitude in [80.0, 90.0, -80.0, -90.0] {
        let hours = hours_of(&sky(latitude), &samples, &[building(&body, [0.0, 0.0], 0.0)]);
        let (dark, light) = if latitude > 0.0 { (11, 5) } else { (5, 11) };
        let zone = &hours.zones[0];
        assert_eq!((zone[dark].sun_h, zone[dark].shade_h(), zone[dark].share()), (0.0, 0.0, None));
        assert_eq!((zone[dark].mostly_shaded, zone[dark].error_h), (0.0, 0.0));
        assert_eq!(zone[light].sun_h, 24.0);
        assert!(zone.iter().all(|month| month.shade_h().is_finite() && month.error_h.is_finite()));
        assert!(hours.points.iter().flatten().all(|hours| hours.is_finite()));
    }
}

/// What trials add one by one is what they add to the shade of the others, and sums are no less than the union.
#[test]
fn a_trial_adds_what_the_same_caster_adds() {
    let (house, tree) = (Body::cuboid([3.0, 2.0], [0.0, 5.0]), Body::cuboid([2.0, 2.0], [2.0, 4.0]));
    let zones = [rectangle([-4.0, 1.0], [4.0, 6.0]), rectangle([4.0, -6.0], [7.0, 6.0])];
    let samples = Samples::of(&zones, 0.25).expect("few cells");
    let house = building(&house, [0.0, 0.0], 0.2);
    let plant = |place: Point| Caster { cause: Cause::Plant, ..building(&tree, place, 0.7) };
    let trials = [plant([3.0, 0.5]), plant([3.4, 1.0]), plant([-90.0, 0.0])];
    let sky = sky(50.0);
    let bare = shade(&sky, &samples, &[house], &trials, &Watch::default()).expect("nothing stops it");
    let both = hours_of(&sky, &samples, &[house, trials[0], trials[1]]);
    for (number, trial) in trials.iter().enumerate() {
        let with = hours_of(&sky, &samples, &[house, *trial]);
        for zone in 0..2 {
            for month in 0..13 {
                let added = with.zones[zone][month].shade_h() - bare.zones[zone][month].shade_h();
                assert!((added - bare.added[number][zone][month]).abs() < 1e-9);
                assert!((added - with.zones[zone][month].plant_h).abs() < 1e-9);
            }
        }
    }
    let sum = |month: usize| bare.zones[0][month].shade_h() + bare.added[0][0][month] + bare.added[1][0][month];
    assert!((0..13).all(|month| both.zones[0][month].shade_h() <= sum(month) + 1e-9));
    assert!(both.zones[0][12].shade_h() < sum(12) - 0.05, "their shadows overlap");
    assert!(bare.added[0][0][12] > 0.1);
}

#[test]
fn hours_do_not_depend_on_the_number_of_threads() {
    let body = Body::cuboid([3.0, 2.0], [0.0, 5.0]);
    let samples = Samples::of(&[rectangle([-6.0, 2.0], [4.0, 7.0])], 0.3).expect("few cells");
    let caster = building(&body, [0.0, 0.0], 0.3);
    let by = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| shade(&sky(47.0), &samples, &[caster], &[caster], &Watch::default()))
    };
    assert_eq!(by(1), by(4));
    let watch = Watch::default();
    watch.stop();
    assert_eq!(shade(&sky(47.0), &samples, &[caster], &[], &watch), Err(Stopped));
}

/// A pole of height H at an equinox on the equator: its shadow is H/tan(altitude) long and lies along the east-west
/// line, so a point at a distance d is in its shade while the sun is lower than atan(H/d) on the other side.
#[test]
fn a_pole_on_the_equator_is_a_sundial() {
    let pole = Body::cuboid([0.02, 2000.0], [0.0, 3.0]);
    let samples = Samples::of(&[rectangle([4.99, -0.05], [5.01, 0.05])], 0.05).expect("few cells");
    let sky = Sky { step_h: 0.01, ..sky(0.0) };
    let date = Date::new(2023, 3, 21).expect("a day");
    let day = sky.day(date, 1.0);
    let marked = day.moments.iter().filter(|moment| {
        let mut marks = shadow::Marks::none(samples.all.len());
        shadow::cast(&samples, &building(&pole, [0.0, 0.0], 0.0), 2, moment.shift, &mut marks);
        marks.has(5)
    });
    let hours = marked.count() as f64 * day.sun_h / day.moments.len() as f64;
    let known = phytomer_sim::math::atan(3.0 / (samples.all[5].place[0] - 0.01)) * 12.0 / PI;
    assert!((hours - known).abs() < 0.02, "{hours} {known}");
}
