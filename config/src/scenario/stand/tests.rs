//! Layouts against their distances, densities and grounds; what is drawn against its shares and its bounds.

use super::*;
use phytomer_sim::random::PlantRandom;

fn stand(text: &str) -> Stand {
    toml::from_str(text).unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn places(text: &str) -> Vec<[f64; 3]> {
    stand(text).members().iter().map(Member::place).collect()
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|axis| (a[axis] - b[axis]) * (a[axis] - b[axis])).sum::<f64>().sqrt()
}

fn near(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12)
}

const ROWS: &str = "layout = { form = \"rows\", plant_spacing_m = 0.2, row_spacing_m = 0.75, rows = 3, plants = 5 }";

#[test]
fn plants_of_rows_stand_in_the_middle_of_their_cells() {
    let places = places(ROWS);
    assert_eq!(places.len(), 15);
    for (place, expected) in [(0, [0.375, 0.1]), (1, [0.375, 0.3]), (5, [1.125, 0.1]), (14, [1.875, 0.9])] {
        assert!(near(&places[place], &expected), "{place}: {:?}", places[place]);
    }
    let stand = stand(ROWS);
    assert!(near(&stand.ground().most, &[2.25, 1.0]) && near(&stand.ground().least, &[0.0, 0.0]));
    let areas: f64 = (0..15).map(|plant| stand.ground_area_m2(plant).expect("rows have cells")).sum();
    assert!((areas - 2.25).abs() < 1e-12, "cells fill the ground: {areas}");
}

/// Rows to the east lie one south of another, as those of `planting` do.
#[test]
fn rows_turn_with_their_ground() {
    let east = ROWS.replace("rows = 3", "rows = 3, row_direction = 90");
    let places = places(&east);
    assert!(near(&places[1], &[0.3, -0.375, 0.0]), "{:?}", places[1]);
    let ground = stand(&east).ground();
    assert!(near(&ground.least, &[0.0, -2.25]) && near(&ground.most, &[1.0, 0.0]), "{ground:?}");
    let aslant = places_at(30.0);
    assert!((distance(aslant[0], aslant[1]) - 0.2).abs() < 1e-12);
    assert!((distance(aslant[0], aslant[5]) - 0.75).abs() < 1e-12);
}

fn places_at(direction: f64) -> Vec<[f64; 3]> {
    places(&ROWS.replace("rows = 3", &format!("rows = 3, row_direction = {direction}")))
}

/// In equilateral triangles six neighbours stand at the distance, and a plant has the ground a² √3/2.
#[test]
fn triangles_have_six_neighbours() {
    let text = "layout = { form = \"triangular\", plant_spacing_m = 2, rows = 5, plants = 5 }";
    let places = places(text);
    let inner = places[12];
    let near = places.iter().filter(|place| (distance(inner, **place) - 2.0).abs() < 1e-9).count();
    assert_eq!(near, 6);
    let area = stand(text).ground_area_m2(0).expect("rows have cells");
    assert!((area - 12.0_f64.sqrt()).abs() < 1e-12, "{area}");
    let [east, north] = stand(text).ground().sides();
    assert!((east * north - 25.0 * area).abs() < 1e-9);
    assert!(places.iter().all(|place| (0.0..east).contains(&place[0]) && (0.0..north).contains(&place[1])));
}

#[test]
fn a_ground_holds_as_many_rows_as_have_room() {
    let text = |size: &str| {
        format!("layout = {{ form = \"rows\", plant_spacing_m = 0.1, row_spacing_m = 0.3, size_m = {size} }}")
    };
    assert_eq!(stand(&text("[0.9, 1.0]")).plants(), 30);
    assert_eq!(stand(&text("[0.89, 0.99]")).plants(), 18);
    assert_eq!(stand(&text("[0.01, 0.01]")).plants(), 1);
}

#[test]
fn plants_of_a_hill_stand_on_a_ring() {
    let text = "layout = { form = \"hills\", hill_spacing_m = 1, rows = 2, hills = 2, plants = 3, radius_m = 0.1 }";
    let places = places(text);
    assert_eq!(places.len(), 12);
    assert!(near(&places[0], &[0.5, 0.6, 0.0]), "the first one stands north of the centre: {:?}", places[0]);
    for hill in places.chunks(3) {
        let centre = [0, 1, 2].map(|axis| hill.iter().map(|place| place[axis]).sum::<f64>() / 3.0);
        assert!(hill.iter().all(|place| (distance(*place, centre) - 0.1).abs() < 1e-12));
    }
    assert_eq!(stand(text).ground_area_m2(0), Some(1.0 / 3.0));
}

const FAN: &str = "layout = { form = \"nelder\", spokes = 20, arcs = 6, innermost_m = 1, ratio = 1.3 }";

/// The grounds of the plants between two arcs fill the ring between the geometric means of the radii.
#[test]
fn the_grounds_of_a_fan_grow_with_the_square_of_the_radius() {
    let fan = stand(FAN);
    let area = |arc: u64| fan.ground_area_m2(arc * 20).expect("a fan has grounds");
    assert!((1..6).all(|arc| (area(arc) / area(arc - 1) - 1.69).abs() < 1e-12));
    let radius = |arc: f64| phytomer_sim::math::pow(1.3, arc);
    let ring = std::f64::consts::PI * (radius(5.5) * radius(5.5) - radius(-0.5) * radius(-0.5));
    let all: f64 = (0..120).map(|plant| fan.ground_area_m2(plant).expect("a fan has grounds")).sum();
    assert!((all / ring - 1.0).abs() < 1e-12, "{all} of {ring} m²");
    let places = places(FAN);
    assert!(near(&places[0], &[0.0, 1.0, 0.0]) && near(&places[5], &[1.0, 0.0, 0.0]));
    assert!(near(&places[20], &[0.0, 1.3, 0.0]));
}

#[test]
fn guards_are_the_outer_rows() {
    let guards = |text: &str| {
        let members = stand(text).members();
        members.iter().enumerate().filter(|(_, member)| !member.guard).map(|(number, _)| number).collect::<Vec<_>>()
    };
    assert_eq!(guards(&format!("{ROWS}\nguard_rows = 1")), [6, 7, 8]);
    assert_eq!(guards(&format!("{FAN}\nguard_rows = 2")), (40..80).collect::<Vec<_>>());
    let open = FAN.replace("ratio = 1.3", "ratio = 1.3, spoke_angle_deg = 10");
    assert_eq!(guards(&format!("{open}\nguard_rows = 2")), [42..58, 62..78].into_iter().flatten().collect::<Vec<_>>());
    let list = "[layout]\nform = \"places\"\nat = [{ x_m = 1, guard = true }, { y_m = 2 }]";
    assert_eq!(guards(list), [1]);
}

fn species(text: &str) -> String {
    let letter = |member: &Member| member.species.as_ref().map_or('-', |name| name.chars().next().unwrap_or('?'));
    stand(text).members().iter().map(letter).collect()
}

#[test]
fn species_take_rows_or_places_in_turn() {
    let of = |mixed: &str, plant: &str| {
        species(&format!(
            "layout = {{ form = \"rows\", plant_spacing_m = 1, rows = 4, plants = 3 }}\nmixed = \"{mixed}\"\nplant = [{plant}]"
        ))
    };
    let two = "{ species = \"apple\" }, { species = \"beech\" }";
    assert_eq!(of("rows", two), "aaabbbaaabbb");
    assert_eq!(of("plants", two), "ababababababa"[..12]);
    assert_eq!(of("rows", "{ species = \"apple\", share = 2 }, {}"), "aaaaaa---aaa");
    let fan = "plant = [{ species = \"apple\" }, { species = \"beech\" }]\n\
        layout = { form = \"nelder\", spokes = 4, arcs = 2, innermost_m = 1, ratio = 2 }";
    assert_eq!(species(fan), "abababab", "whole spokes");
}

/// A share p of n places: within 4 √(p (1 − p)/n) of p.
#[test]
fn shares_by_chance_are_those_stated() {
    const N: f64 = 10_000.0;
    let text = "layout = { form = \"rows\", plant_spacing_m = 1, rows = 100, plants = 100 }\nmixed = \"chance\"\n\
        emergence = [5, 3, 2]\nplant = [{ species = \"apple\", share = 0.3 }, { species = \"beech\", share = 1.2 }]";
    let members = stand(text).members();
    let share = |has: &dyn Fn(&Member) -> bool| members.iter().filter(|member| has(member)).count() as f64 / N;
    let holds = |found: f64, p: f64| (found - p).abs() <= 4.0 * (p * (1.0 - p) / N).sqrt();
    let apples = share(&|member| member.species.as_deref() == Some("apple"));
    assert!(holds(apples, 0.2), "{apples}");
    for (late, p) in [(0, 0.5), (1, 0.3), (2, 0.2)] {
        let found = share(&|member| member.sown == late);
        assert!(holds(found, p), "{late} ticks late: {found}");
    }
    let both = share(&|member| member.species.as_deref() == Some("apple") && member.sown == 2);
    assert!(holds(both, 0.04), "species and emergence are drawn apart: {both}");
    assert_ne!(stand(&format!("{text}\nseed = 7")).members(), members, "another seed, another mix");
    assert_eq!(stand(text).members(), members);
}

/// Of a point that is even over a side, the mean is 1/2 and the variance 1/12; of a disc of radius R, the mean square
/// of the distance is R²/2 with a variance of R⁴/12.
#[test]
fn random_places_and_jitter_are_even() {
    const N: u32 = 10_000;
    let random = stand("layout = { form = \"random\", plants = 4, size_m = [2, 3] }");
    let shaken = stand(&format!("{ROWS}\njitter_m = 0.5"));
    let draws = |number: u32| PlantRandom::new(3, u64::from(number));
    let sides: Vec<[f64; 2]> = (0..N).map(|number| random.shift(&draws(number))).collect();
    let bound = 4.0 * (1.0 / 12.0 / f64::from(N)).sqrt();
    for (axis, side) in [(0, 2.0), (1, 3.0)] {
        let mean = sides.iter().map(|place| place[axis] / side).sum::<f64>() / f64::from(N);
        assert!((mean - 0.5).abs() < bound, "{mean}");
        assert!(sides.iter().all(|place| (0.0..side).contains(&place[axis])));
    }
    let squares: Vec<f64> = (0..N).map(|number| shaken.shift(&draws(number))).map(|[x, y]| x * x + y * y).collect();
    assert!(squares.iter().all(|square| *square <= 0.25 + 1e-12));
    let mean = squares.iter().sum::<f64>() / f64::from(N);
    assert!((mean - 0.125).abs() < 4.0 * (0.0625 / 12.0 / f64::from(N)).sqrt(), "{mean}");
    assert_eq!(stand(ROWS).shift(&draws(0)), [0.0; 2]);
}
